"""The contact log in chunks, checked for impossible rows."""

from collections.abc import Iterator, Sequence

import numpy as np
import pyarrow

from damage.log_input.bad_rows import BadRows, Chunk
from damage.log_input.contact_source import ContactSource, batches
from damage.log_input.states import POSE_COLUMNS, RAIL_COLUMNS, ContactStates

DAMAGE_COLUMNS = tuple(name for name in ContactStates._fields if name not in (*POSE_COLUMNS, *RAIL_COLUMNS))
"""Columns of the contact log that damage needs; where it rebuilds patches from the profiles also those of the
pose, `damage.log_input.states.POSE_COLUMNS`, and for the rails those of the place on them, `RAIL_COLUMNS`
there."""

CHUNK_ROWS = 20_000  # bounds the memory of one chunk to a few megabytes


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
        Impossible rows are skipped and counted in it; None raises.

    Raises
    ------
    ValueError
        Missing columns; or NaN or infinite values, values outside their range or forces above friction: how
        many rows of the whole log, and the first times.
    """
    return (good for _, good in sifted_chunks(source, columns, rows, bad_rows))


def sifted_chunks(
    source: ContactSource,
    columns: Sequence[str] = DAMAGE_COLUMNS,
    rows: int = CHUNK_ROWS,
    bad_rows: BadRows | None = None,
) -> Iterator[tuple[Chunk, Chunk]]:
    """Pairs of a chunk of the log and its good rows; parameters and errors as `contact_chunks`."""
    found = BadRows() if bad_rows is None else bad_rows
    for batch in batches(source, columns, rows):
        chunk = _chunk(batch, columns)
        good = found.sift(chunk)
        if bad_rows is None and found.count:
            continue  # the log is refused: the remainder is read for the count only
        yield chunk, good
    if bad_rows is None and found.count:
        raise ValueError(f"contact log: {found}")


def _chunk(batch: pyarrow.RecordBatch, columns: Sequence[str]) -> Chunk:
    return {name: batch.column(name).to_numpy(zero_copy_only=False).astype(np.float64) for name in columns}
