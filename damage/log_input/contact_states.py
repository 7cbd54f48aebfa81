"""The contact log as damage reads it: in chunks, checked, each row with the output interval it stands for."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import pyarrow
from numpy.typing import NDArray

from damage.log_input.bad_rows import BadRows, Chunk
from damage.log_input.contact_source import ContactSource, batches

DAMAGE_COLUMNS = (
    *("time", "vehicle", "bogie", "wheelset", "side", "y_wheel", "contact_angle", "rolling_radius"),
    *("normal_force", "a", "b", "p_max", "nu_x", "nu_y", "phi", "friction", "speed"),
    *("force_x", "force_y", "moment_z"),
)

CHUNK_ROWS = 20_000  # bounds the memory of one chunk to a few megabytes


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


def output_clock(source: ContactSource, skip_bad_rows: bool = False) -> OutputClock:
    """Read the output times of a contact log.

    Parameters
    ----------
    source
        The contact log.
    skip_bad_rows
        Bad rows do not count among the rows at a time; the time itself stays, unless it is no number.

    Raises
    ------
    ValueError
        The log has no rows, or no row with a time.
    """
    times: NDArray[np.float64] = np.empty(0)
    rows: NDArray[np.int64] = np.empty(0, dtype=np.int64)
    for chunk in _clock_chunks(source, skip_bad_rows):
        good = chunk.pop("good")
        new, place = np.unique(chunk["time"], return_inverse=True)
        counts = np.bincount(place, weights=good, minlength=new.size)
        times, place = np.unique(np.concatenate([times, new]), return_inverse=True)
        rows = np.bincount(place, weights=np.concatenate([rows, counts])).astype(np.int64)
    if times.size == 0:
        raise ValueError("the contact log has no rows")
    steps = np.ones(1) if times.size == 1 else np.diff(times, prepend=2.0 * times[0] - times[1])
    return OutputClock(times, steps, rows)


def _clock_chunks(source: ContactSource, skip_bad_rows: bool) -> Iterator[Chunk]:
    """Times of all rows that have one, and 1 in `good` for those that count, else 0."""
    if not skip_bad_rows:
        for chunk in contact_chunks(source, ("time",)):
            yield chunk | {"good": np.ones(chunk["time"].size)}
        return
    for batch in batches(source, DAMAGE_COLUMNS, CHUNK_ROWS):
        chunk = _chunk(batch, DAMAGE_COLUMNS)
        times = chunk["time"][np.isfinite(chunk["time"])]
        good = BadRows().sift(chunk)["time"]
        yield {
            "time": np.concatenate([times, good]),
            "good": np.concatenate([np.zeros(times.size), np.ones(good.size)]),
        }


def contact_chunks(
    source: ContactSource,
    columns: Sequence[str] = DAMAGE_COLUMNS,
    rows: int = CHUNK_ROWS,
    bad_rows: BadRows | None = None,
) -> Iterator[Chunk]:
    """The contact log in chunks: column name to (n,) values as float64.

    Parameters
    ----------
    source
        The contact log.
    columns
        Names of the wanted columns; `time` must be among them.
    rows
        Largest number of rows of a chunk.
    bad_rows
        Bad rows are left out and told to it; None refuses them.

    Raises
    ------
    ValueError
        Missing columns; or NaN or infinite values, values outside their range or forces above friction: how
        many rows of the whole log, and the first times.
    """
    for batch in batches(source, columns, rows):
        chunk = _chunk(batch, columns)
        if bad_rows is not None:
            chunk = bad_rows.sift(chunk)
        elif BadRows().sift(chunk) is not chunk:
            found = BadRows()
            for other in batches(source, columns, rows):
                found.sift(_chunk(other, columns))
            raise ValueError(f"contact log: {found}")
        yield chunk


def _chunk(batch: pyarrow.RecordBatch, columns: Sequence[str]) -> Chunk:
    return {name: batch.column(name).to_numpy(zero_copy_only=False).astype(np.float64) for name in columns}
