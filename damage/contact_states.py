"""The contact log as damage reads it: in chunks, checked, each row with the output interval it stands for."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pyarrow
from numpy.typing import NDArray

from hh_exudyn.log.store import Run, open_run

ContactSource: TypeAlias = Run | Path | str | pyarrow.Table
"""What damage takes as a contact log: a run, its directory, or the log as a table."""

Chunk = dict[str, NDArray[np.float64]]

DAMAGE_COLUMNS = (
    *("time", "vehicle", "bogie", "wheelset", "side", "y_wheel", "contact_angle", "rolling_radius"),
    *("normal_force", "a", "b", "p_max", "nu_x", "nu_y", "phi", "friction", "speed"),
    *("force_x", "force_y", "moment_z"),
)

CHUNK_ROWS = 20_000  # bounds the memory of one chunk to a few megabytes

# name, unit, least value, whether the least value itself is allowed; only the loaded rows must obey
_LOADED_RANGES = (
    ("a", "m", 0.0, False),
    ("b", "m", 0.0, False),
    ("p_max", "Pa", 0.0, False),
    ("friction", "-", 0.0, False),
)
_RANGES = (
    ("normal_force", "N", 0.0, True),
    ("rolling_radius", "m", 0.0, False),
    ("speed", "m/s", 0.0, True),
)


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

    times: NDArray[np.float64]
    steps: NDArray[np.float64]
    rows: NDArray[np.int64]

    def of_rows(self, time: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Interval [s] of each row, and the number of rows that share it.

        Raises
        ------
        ValueError
            A time that the clock does not hold.
        """
        index = np.minimum(np.searchsorted(self.times, time), self.times.size - 1)
        if not np.array_equal(self.times[index], time):
            raise ValueError("the rows hold times that the clock was not made from")
        return self.steps[index], self.rows[index]


def output_clock(source: ContactSource) -> OutputClock:
    """Read the output times of a contact log.

    Raises
    ------
    ValueError
        The log has no rows.
    """
    times: NDArray[np.float64] = np.empty(0)
    rows: NDArray[np.int64] = np.empty(0, dtype=np.int64)
    for chunk in contact_chunks(source, ("time",)):
        new, counts = np.unique(chunk["time"], return_counts=True)
        times, place = np.unique(np.concatenate([times, new]), return_inverse=True)
        rows = np.bincount(place, weights=np.concatenate([rows, counts])).astype(np.int64)
    if times.size == 0:
        raise ValueError("the contact log has no rows")
    steps = np.ones(1) if times.size == 1 else np.diff(times, prepend=2.0 * times[0] - times[1])
    return OutputClock(times, steps, rows)


def contact_chunks(
    source: ContactSource, columns: Sequence[str] = DAMAGE_COLUMNS, rows: int = CHUNK_ROWS
) -> Iterator[Chunk]:
    """The contact log in chunks: column name to (n,) values as float64.

    Parameters
    ----------
    source
        A run, its directory, or the log as a table.
    columns
        Names of the wanted columns; `time` must be among them.
    rows
        Largest number of rows of a chunk.

    Raises
    ------
    ValueError
        Missing columns, NaN or infinite values, or values outside their range: how many rows of the whole
        log, and the time of the first.
    """
    for batch in _batches(source, columns, rows):
        chunk = {
            name: batch.column(name).to_numpy(zero_copy_only=False).astype(np.float64) for name in columns
        }
        if not all(np.isfinite(values).all() for values in chunk.values()):
            raise ValueError(_count_not_finite(source, columns, rows))
        _check_ranges(chunk)
        yield chunk


def _batches(source: ContactSource, columns: Sequence[str], rows: int) -> Iterator[pyarrow.RecordBatch]:
    """The log in record batches, in constant memory where it lies on disk."""
    if isinstance(source, pyarrow.Table):
        missing = [name for name in columns if name not in source.column_names]
        if missing:
            raise ValueError(f"the contact log has no column {', '.join(missing)}")
        yield from source.select(list(columns)).to_batches(max_chunksize=rows)
    else:
        run = source if isinstance(source, Run) else open_run(source)
        yield from run.batches("contact", list(columns), rows)


def _count_not_finite(source: ContactSource, columns: Sequence[str], rows: int) -> str:
    """Message on the rows with NaN or infinite values, counted over the whole log."""
    bad, total, first = 0, 0, math.nan
    affected: set[str] = set()
    for batch in _batches(source, columns, rows):
        total += batch.num_rows
        not_finite = np.zeros(batch.num_rows, dtype=np.bool_)
        for name in columns:
            here = ~np.isfinite(batch.column(name).to_numpy(zero_copy_only=False).astype(np.float64))
            if here.any():
                affected.add(name)
            not_finite |= here
        if not_finite.any() and bad == 0:
            first = float(batch.column("time").to_numpy(zero_copy_only=False)[not_finite][0])
        bad += int(not_finite.sum())
    names = [name for name in columns if name in affected]
    return (
        f"contact log: {bad} of {total} rows hold NaN or infinite values (in {', '.join(names)}), "
        f"the first at time = {first:.6g} s"
    )


def _check_ranges(chunk: Chunk) -> None:
    """Refuse values that no contact can have."""
    loaded = chunk["normal_force"] > 0.0 if "normal_force" in chunk else np.ones(chunk["time"].size, np.bool_)
    for ranges, rows in ((_RANGES, np.ones_like(loaded)), (_LOADED_RANGES, loaded)):
        for name, unit, least, allowed in ranges:
            if name in chunk:
                values = chunk[name]
                bad = rows & ((values < least) if allowed else (values <= least))
                _refuse(bad, chunk, name, unit, f"must be {'>=' if allowed else '>'} {least:g} {unit}")
    if "contact_angle" in chunk:
        bad = np.abs(chunk["contact_angle"]) >= 0.5 * math.pi
        _refuse(bad, chunk, "contact_angle", "rad", "must lie within -pi/2..pi/2 rad")
    if "side" in chunk:
        _refuse(np.abs(chunk["side"]) != 1.0, chunk, "side", "-", "must be +1 (left) or -1 (right)")


def _refuse(bad: NDArray[np.bool_], chunk: Chunk, name: str, unit: str, wanted: str) -> None:
    if bad.any():
        first = int(np.argmax(bad))
        raise ValueError(
            f"contact log: {name} = {chunk[name][first]:.6g} {unit} at time = {chunk['time'][first]:.6g} s "
            f"{wanted} ({int(bad.sum())} such rows among the {bad.size} read with it)"
        )
