"""The output times of a contact log: the output interval of every row, found while the log is read.

The interval of a row ends at its time and begins at the output time before it, and the rows of one time share
it. Both are known once a row of a later time has been read. A log in order of time is therefore read once: a
chunk waits for the next one, which completes the rows of its last time. For any size of the chunks, two of
them are in memory, and the intervals are the same. A log that is not in order of time is read twice, the
first time for its times alone (`output_clock`).
"""

import math
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from damage.log_input.bad_rows import BadRows, Chunk, Fault
from damage.log_input.contact_source import ContactSource
from damage.log_input.contact_states import CHUNK_ROWS, DAMAGE_COLUMNS, sifted_chunks
from damage.log_input.states import ContactStates, states_of
from hh_exudyn.arrays import FloatArray, IntArray

_FEWEST_STEPS = 10  # for a usual interval
_EQUAL, _EQUAL_SHARE = 0.01, 0.8  # relative; of the steps, so that there is a usual one
_GAP = 1.5  # of the usual interval


class OutOfOrder(Exception):
    """A row of the log is earlier than the row before it."""


class GapInTime(Exception):
    """Rows are missing between two output times; `fault` says where."""

    def __init__(self, fault: Fault) -> None:
        super().__init__(fault.first)
        self.fault = fault


class TimedStates(NamedTuple):
    """Contact states of a piece of a log, with their output intervals."""

    states: ContactStates
    interval: FloatArray  # (n,) output interval of each row [s]
    sharing: IntArray  # (n,) number of rows of the log in that interval


@dataclass(frozen=True)
class OutputClock:
    """The output times of a contact log.

    Attributes
    ----------
    times
        (n,) distinct times in ascending order [s].
    steps
        (n,) interval that ends at each time [s]; the first is taken as the second. A log of one time has
        the interval 1 s, which cancels from all means.
    rows
        (n,) rows of the log at each time.
    """

    times: FloatArray
    steps: FloatArray
    rows: IntArray

    def timed(self, chunk: Chunk) -> TimedStates:
        """The states of a chunk with their intervals.

        Raises
        ------
        ValueError
            A time that the clock does not hold.
        """
        states = states_of(chunk)
        index = np.minimum(np.searchsorted(self.times, states.time), self.times.size - 1)
        if not np.array_equal(self.times[index], states.time):
            raise ValueError("the rows hold times that the clock was not made from")
        return TimedStates(states, self.steps[index], self.rows[index])

    def without_gaps(self) -> "OutputClock":
        """The same with the usual interval behind every gap: what is missing there is given to no row."""
        fault = gap_in(self.times)
        return self if fault is None else replace(self, steps=np.minimum(self.steps, _usual(self.times)))


def _usual(times: FloatArray) -> float:
    """The usual interval of output times [s]; infinite where they are too few, or have none."""
    steps = np.diff(times)
    if steps.size < _FEWEST_STEPS:
        return math.inf
    usual = float(np.median(steps))
    equal = np.abs(steps - usual) <= _EQUAL * usual
    return usual if equal.mean() >= _EQUAL_SHARE else math.inf


def gap_in(times: FloatArray) -> Fault | None:
    """The gaps between distinct output times in ascending order, where these are mostly equally far apart.

    Parameters
    ----------
    times
        (n,) [s].
    """
    usual = _usual(times)
    wide = np.flatnonzero(np.diff(times) > _GAP * usual)
    if wide.size == 0:
        return None
    first, last = times[wide[0]], times[wide[0] + 1]
    return Fault(
        int(wide.size),
        f"no rows between time = {first:.6g} and {last:.6g} s, where they are {usual:.6g} s apart",
    )


class _Times:
    """Times of the rows read so far: of the rows whose interval is still open, and the one before them."""

    def __init__(self) -> None:
        self.times: FloatArray = np.empty(0)
        self.rows: IntArray = np.empty(0, dtype=np.int64)
        self._before: float | None = None
        self._forgotten: list[FloatArray] = []

    def add(self, times: FloatArray, good: FloatArray) -> None:
        """Add the finite times of all rows, and the times of the good rows, which share the intervals."""
        new = np.concatenate([self.times, times, good])
        count = np.concatenate([self.rows, np.zeros(times.size), np.ones(good.size)])
        self.times, place = np.unique(new, return_inverse=True)
        self.rows = np.bincount(place, weights=count, minlength=self.times.size).astype(np.int64)

    def forget(self, first: float) -> None:
        """Drop the times before `first` except the last of them, at which an interval begins."""
        gone = int(np.searchsorted(self.times, first))
        if gone:
            self._before = float(self.times[gone - 1])
            self._forgotten.append(self.times[:gone])
            self.times, self.rows = self.times[gone:], self.rows[gone:]

    @property
    def gap(self) -> Fault | None:
        """The gaps between all times so far."""
        return gap_in(np.concatenate([*self._forgotten, self.times]))

    @property
    def clock(self) -> OutputClock:
        """The clock of these times; ValueError where there are none."""
        if self.times.size == 0:
            raise ValueError("the contact log has no rows")
        if self._before is None and self.times.size == 1:
            return OutputClock(self.times, np.ones(1), self.rows)
        before = 2.0 * self.times[0] - self.times[1] if self._before is None else self._before
        return OutputClock(self.times, np.diff(self.times, prepend=before), self.rows)


def output_clock(
    source: ContactSource, skip_bad_rows: bool = False, columns: Sequence[str] = DAMAGE_COLUMNS
) -> OutputClock:
    """Read the output times of a contact log, in any order.

    Parameters
    ----------
    source
        The contact log.
    skip_bad_rows
        Bad rows do not count among the rows at a time; the time itself counts, unless it is NaN or infinite.
    columns
        That are read: a row is bad by any of them.

    Raises
    ------
    ValueError
        The log has no rows, or no row with a time; or bad rows or gaps in time, unless they are skipped.
    """
    times, found = _Times(), BadRows(ordered=False)
    for chunk, good in sifted_chunks(source, columns, bad_rows=found):
        times.add(_finite(chunk), good["time"])
    if not skip_bad_rows:
        require_good(found, times.gap)
    return times.clock.without_gaps()


def timed_states(
    source: ContactSource,
    rows: int = CHUNK_ROWS,
    bad_rows: BadRows | None = None,
    clock: OutputClock | None = None,
    columns: Sequence[str] = DAMAGE_COLUMNS,
) -> Iterator[TimedStates]:
    """The contact log in pieces, each row with its output interval, in one pass.

    Parameters
    ----------
    source, rows, bad_rows
        As for `damage.log_input.contact_states.contact_chunks`.
    clock
        Output times of the whole log where `source` is a piece of it, or is not in order of time; None finds
        them while reading.
    columns
        That are read.

    Raises
    ------
    OutOfOrder
        There is no clock, and a row is earlier than the one before it.
    GapInTime
        There is no clock, bad rows are skipped, and rows are missing for a while; known at the end.
    ValueError
        Missing columns, bad rows, gaps in time, no rows, or times that the clock does not hold.
    """
    if clock is not None:
        for _, good in sifted_chunks(source, columns, rows, bad_rows):
            yield clock.timed(good)
        return
    times, waiting, latest = _Times(), deque[Chunk](), -np.inf
    for chunk, good in sifted_chunks(source, columns, rows, bad_rows):
        seen = _finite(chunk)
        if np.any(np.diff(seen, prepend=latest) < 0.0):
            raise OutOfOrder
        latest = seen[-1] if seen.size else latest
        times.add(seen, good["time"])
        waiting.append(good)
        while waiting and _last_time(waiting[0]) < latest:
            yield times.clock.timed(waiting.popleft())
        times.forget(min((part["time"][0] for part in waiting if part["time"].size), default=latest))
    if (gap := times.gap) is not None:
        if bad_rows is not None:
            raise GapInTime(gap)
        require_good(BadRows(), gap)
    clock = times.clock
    for part in waiting:
        yield clock.timed(part)


def require_good(found: BadRows, gap: Fault | None = None) -> None:
    """Raise ValueError for bad rows, or for a gap between the output times."""
    if found.count:
        raise ValueError(f"contact log: {found}")
    if gap is not None:
        raise ValueError(
            f"contact log: rows are missing: {gap.first} ({gap.rows} such gap{'s' if gap.rows > 1 else ''})"
        )


def _last_time(chunk: Chunk) -> float:
    return float(chunk["time"][-1]) if chunk["time"].size else -np.inf


def _finite(chunk: Chunk) -> FloatArray:
    """Times of all rows that have one."""
    time: FloatArray = chunk["time"][np.isfinite(chunk["time"])]
    return time
