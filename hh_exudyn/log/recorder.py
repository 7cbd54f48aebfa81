"""Writing the logs of a run: rows are buffered in numpy and written to disk in parts.

The layout on disk is that of `hh_exudyn.log.store`, which reads it back.
"""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet
from numpy.typing import NDArray

from hh_exudyn.log.channels import LOGS, Column

PART_PATTERN = "part-*.parquet"  # finished parts; temporary files end differently and are never read
TEMPORARY_SUFFIX = ".tmp"


def part_path(directory: Path, log: str, number: int) -> Path:
    """Path of one finished part of a log.

    Parameters
    ----------
    directory, log
        Directory of the run, and ``contact``, ``motion``, ``energy`` or ``control``.
    number
        Of the part, from 0.
    """
    return directory / log / f"part-{number:05d}.parquet"


def check_log_name(log: str) -> tuple[Column, ...]:
    """The columns of a log.

    Raises
    ------
    ValueError
        There is no log of that name.
    """
    if log not in LOGS:
        raise ValueError(f"log {log!r} is unknown; the logs of a run are {', '.join(LOGS)}")
    return LOGS[log]


def claim_directory(directory: Path) -> None:
    """Make the directory of a new run.

    Raises
    ------
    FileExistsError
        The directory holds anything, or the name is a file. Nothing was written then.
    """
    if directory.exists() and (not directory.is_dir() or any(directory.iterdir())):
        kind = "is not empty" if directory.is_dir() else "is a file"
        raise FileExistsError(
            f"{directory} {kind}: a run is never overwritten; --out must name a new or an empty folder"
        )
    directory.mkdir(parents=True, exist_ok=True)
    for log in LOGS:
        (directory / log).mkdir()  # fails where a second process claimed the same folder just now


def write_part(path: Path, table: pyarrow.Table) -> None:
    """Write a table to a temporary file and rename it when it is complete and on disk."""
    temporary = path.with_name(path.name + TEMPORARY_SUFFIX)
    try:
        with open(temporary, "wb") as stream:
            pyarrow.parquet.write_table(table, stream, compression="zstd")
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(temporary, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


class _Buffer:
    """Buffered rows of one log, before they are written as a part; every column is float64."""

    def __init__(self, columns: tuple[Column, ...], rows: int) -> None:
        self.columns = columns
        self.rows = np.empty((rows, len(columns)))
        self.count = 0
        self.parts = 0


class Recorder:
    """Records the logs of one run into a new directory; a context manager.

    Make the recorder before anything else is written to the directory: it claims it. At the end of the
    ``with`` block, also by an exception or Ctrl-C, the buffered rows are written.

    Parameters
    ----------
    directory
        New or empty folder of the run.
    metadata
        Texts for the metadata of every Parquet file, for instance ``case`` (TOML).
    rows_per_part
        Rows of one part [-], at least 1.
    names
        For each string column (`body` of the motion log) the names of its integer codes.

    Raises
    ------
    FileExistsError
        The directory is not empty. Nothing was written then.
    """

    def __init__(
        self,
        directory: Path | str,
        metadata: Mapping[str, str],
        rows_per_part: int = 50_000,
        names: Mapping[str, Sequence[str]] | None = None,
    ) -> None:
        if rows_per_part < 1:
            raise ValueError(f"rows_per_part = {rows_per_part} must be at least 1")
        self.directory = Path(directory)
        self._metadata = {key.encode(): value.encode() for key, value in metadata.items()}
        self._names: dict[str, list[str]] = {key: list(value) for key, value in (names or {}).items()}
        self._rows_per_part = rows_per_part
        self._closed = False
        claim_directory(self.directory)
        self._buffers: dict[str, _Buffer] = {}

    def append_rows(self, log: str, rows: NDArray[np.float64]) -> None:
        """Append rows with the columns of the log in their order: the fast path.

        Parameters
        ----------
        log
            ``contact``, ``motion``, ``energy`` or ``control``.
        rows
            (n, ncolumns) values; integers as float64, strings as their codes in `names`.

        Raises
        ------
        ValueError
            Unknown log, wrong number of columns, or the recorder is closed.
        """
        buffer = self._buffers.get(log)
        if buffer is None:
            buffer = self._new_buffer(log)
        if rows.ndim != 2 or rows.shape[1] != len(buffer.columns):
            raise ValueError(
                f"rows of log {log} have shape {rows.shape}; (n, {len(buffer.columns)}) is wanted"
            )
        done, total = 0, rows.shape[0]
        while done < total:
            here = min(total - done, self._rows_per_part - buffer.count)
            buffer.rows[buffer.count : buffer.count + here] = rows[done : done + here]
            buffer.count += here
            done += here
            if buffer.count == self._rows_per_part:
                self._write(log, buffer)

    def append(self, log: str, columns: Mapping[str, Any]) -> None:
        """Append columns of equal length by name; all columns of the log must be there.

        Parameters
        ----------
        log
            ``contact``, ``motion``, ``energy`` or ``control``.
        columns
            Column name to n values. String columns take texts, or integer codes of `names`.

        Raises
        ------
        ValueError
            Missing or unknown columns, or lengths that differ.
        """
        schema = check_log_name(log)
        wanted = [column.name for column in schema]
        missing = [name for name in wanted if name not in columns]
        unknown = [name for name in columns if name not in wanted]
        if missing or unknown:
            raise ValueError(f"columns of log {log}: missing {missing}, unknown {unknown}")
        values = [
            self._codes(column.name, columns[column.name])
            if column.kind == "string"
            else np.atleast_1d(np.asarray(columns[column.name], dtype=np.float64))
            for column in schema
        ]
        lengths = {name: value.size for name, value in zip(wanted, values, strict=True)}
        if len(set(lengths.values())) > 1:
            raise ValueError(f"columns of log {log} differ in length: {lengths}")
        self.append_rows(log, np.column_stack(values))

    def flush(self) -> None:
        """Write the buffered rows of every log as a part, however few they are."""
        for log, buffer in self._buffers.items():
            if buffer.count:
                self._write(log, buffer)

    def close(self) -> None:
        """Write the buffered rows; further rows raise ValueError."""
        if not self._closed:
            self.flush()
            self._closed = True
            self._buffers.clear()

    def __enter__(self) -> "Recorder":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _new_buffer(self, log: str) -> _Buffer:
        if self._closed:
            raise ValueError(f"the recorder of {self.directory} is closed")
        buffer = _Buffer(check_log_name(log), self._rows_per_part)
        self._buffers[log] = buffer
        return buffer

    def _codes(self, column: str, values: Any) -> NDArray[np.float64]:
        """Integer codes of a string column; texts that are new get the next code."""
        array = np.atleast_1d(np.asarray(values))
        if array.dtype.kind not in "UO":
            return array.astype(np.float64)
        names = self._names.setdefault(column, [])
        for text in dict.fromkeys(array.tolist()):
            if text not in names:
                names.append(text)
        return np.array([names.index(text) for text in array.tolist()], dtype=np.float64)

    def _write(self, log: str, buffer: _Buffer) -> None:
        """Write the buffered rows as the next part and empty the buffer."""
        rows = buffer.rows[: buffer.count]
        arrays = [
            self._arrow_column(log, column, rows[:, index]) for index, column in enumerate(buffer.columns)
        ]
        table = pyarrow.table(arrays, names=[column.name for column in buffer.columns])
        table = table.replace_schema_metadata(self._metadata)
        write_part(part_path(self.directory, log, buffer.parts), table)
        buffer.parts += 1
        buffer.count = 0

    def _arrow_column(self, log: str, column: Column, values: NDArray[np.float64]) -> pyarrow.Array:
        if column.kind == "float64":
            return pyarrow.array(np.ascontiguousarray(values))
        if not np.array_equal(values, np.rint(values)):  # NaN is unequal to itself
            raise ValueError(f"log {log}: column {column.name} holds values that are not whole numbers")
        codes = values.astype(np.int32)
        if column.kind == "int32":
            return pyarrow.array(codes)
        names = self._names.get(column.name, [])
        if codes.min() < 0 or codes.max() >= len(names):
            raise ValueError(
                f"log {log}: column {column.name} holds code {codes.min()} to {codes.max()}, "
                f"names are given for 0 to {len(names) - 1}"
            )
        return pyarrow.DictionaryArray.from_arrays(pyarrow.array(codes), pyarrow.array(names))
