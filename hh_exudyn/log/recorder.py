"""Writing the logs of a run: rows are buffered in numpy and written to disk in parts.

The last part of a log grows: about every second of wall time it is replaced by a longer one, until it is
full. So a killed run keeps all but its last second, and the parts of a finished run do not depend on the
clock. A thread writes them: bringing them to the disk takes a sixth of a run, most of it spent waiting. A
fault of the disk is raised at the next call. The layout on disk is that of `hh_exudyn.log.store`, which reads
it back.
"""

import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from functools import partial
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
import pyarrow
from numpy.typing import NDArray

from hh_exudyn.log.channels import LOGS, Column
from hh_exudyn.log.lock import locked
from hh_exudyn.log.parts import LOG_KEY, TEMPORARY_SUFFIX, part_path, part_paths, read_part, write_part

KEEP_INTERVAL = 0.7  # s of wall time after which rows are on disk; with the writing less than 1 s


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
        The directory holds anything but what a run leaves that was killed before its first file, or the name
        is a file. Nothing was written then.
    """
    if directory.exists() and (not directory.is_dir() or any(map(_is_content, directory.iterdir()))):
        kind = "is not empty" if directory.is_dir() else "is a file"
        raise FileExistsError(
            f"{directory} {kind}: a run is never overwritten; --out must name a new or an empty folder"
        )
    directory.mkdir(parents=True, exist_ok=True)
    for log in LOGS:
        (directory / log).mkdir(exist_ok=True)


def _is_content(path: Path) -> bool:
    if path.name in LOGS and path.is_dir():
        return any(path.iterdir())
    return path.suffix != TEMPORARY_SUFFIX


def _schema(columns: tuple[Column, ...], arrays: list[pyarrow.Array]) -> pyarrow.Schema:
    """Names and types of columns, with unit and meaning as the metadata of every field."""
    return pyarrow.schema(
        pyarrow.field(column.name, array.type, metadata={"unit": column.unit, "meaning": column.meaning})
        for column, array in zip(columns, arrays, strict=True)
    )


class _Buffer:
    """Rows of the growing part of one log; every column is float64."""

    def __init__(self, columns: tuple[Column, ...], rows: int) -> None:
        self.columns = columns
        self.rows = np.empty((rows, len(columns)))
        self.count = 0
        self.written = 0  # rows of this part that are on disk
        self.parts = 0  # full ones before it

    @property
    def total(self) -> int:
        """Rows of the log so far."""
        return self.parts * len(self.rows) + self.count


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
    resumed
        For each log of an interrupted run in the directory the number of rows that stay, to go on behind
        them; None for a new run.

    Raises
    ------
    FileExistsError
        The directory of a new run is not empty, or another process writes into it. Nothing was written then.
    ValueError
        An interrupted run has fewer rows on disk, or a broken part.
    """

    def __init__(
        self,
        directory: Path | str,
        metadata: Mapping[str, str],
        rows_per_part: int = 10_000,
        names: Mapping[str, Sequence[str]] | None = None,
        resumed: Mapping[str, int] | None = None,
    ) -> None:
        if rows_per_part < 1:
            raise ValueError(f"rows_per_part = {rows_per_part} must be at least 1")
        self.directory = Path(directory)
        self._metadata = {key.encode(): value.encode() for key, value in metadata.items()}
        self._names: dict[str, list[str]] = {key: list(value) for key, value in (names or {}).items()}
        self._rows_per_part = rows_per_part
        self._closed = False
        self._buffers: dict[str, _Buffer] = {}
        self._next_keeping = time.monotonic() + KEEP_INTERVAL
        self._writer = ThreadPoolExecutor(max_workers=1, thread_name_prefix="recorder")
        self._writing: list[Future[None]] = []  # begun, in turn
        if resumed is None:
            claim_directory(self.directory)
        self._lock = locked(self.directory)
        if resumed is not None:
            for log in LOGS:
                self._go_on(log, resumed.get(log, 0))

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
                self._begin_part(log, buffer)

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

    def keep(self) -> None:
        """Begin to write all rows, if that is `KEEP_INTERVAL` ago; call it when a time has all its rows.

        Raises
        ------
        OSError
            An earlier writing has failed, here and below.
        """
        if not self._waiting() and time.monotonic() >= self._next_keeping:
            self.flush()

    def flush(self, behind: Callable[[], None] | None = None) -> None:
        """Begin to write all rows; the last part of every log goes on growing.

        Where the disk is so slow that two writings wait already, nothing is done: the next call does it.

        Parameters
        ----------
        behind
            Called when they are on disk, in the thread that writes.
        """
        if self._waiting() > 1:
            return
        self._begin(self._growing(), behind)
        self._next_keeping = time.monotonic() + KEEP_INTERVAL

    def _begin_part(self, log: str, buffer: _Buffer) -> None:
        """Begin to write a full part; where the disk is slow, rows of two writings wait in memory at most."""
        while self._waiting() > 1:
            self._writing[0].result()
        full = partial(self._write, log, buffer.parts, buffer.rows)
        self._begin([*self._growing(but=log), full])  # no log ends long before the others, if it fails now
        buffer.rows = np.empty_like(buffer.rows)
        buffer.parts += 1
        buffer.count = buffer.written = 0

    def _growing(self, but: str = "") -> list[Callable[[], None]]:
        """What writes the rows of all logs but one, in the order in which the logs were begun."""
        writes: list[Callable[[], None]] = []
        for log, buffer in self._buffers.items():
            if log != but and buffer.count > buffer.written:
                rows = buffer.rows[: buffer.count].copy()
                writes.append(partial(self._write, log, buffer.parts, rows, growing=True))
                buffer.written = buffer.count
        return writes

    def _begin(self, writes: list[Callable[[], None]], behind: Callable[[], None] | None = None) -> None:
        """Begin to write; whatever is behind counts on what is before, so the first fault ends it all."""
        before = self._writing[-1] if self._writing else None

        def in_turn() -> None:
            if before is not None:
                before.result()
            for write in writes:
                write()
            if behind is not None:
                behind()

        self._writing.append(self._writer.submit(in_turn))

    def _waiting(self) -> int:
        """Writings that are not done; OSError where one has failed."""
        while self._writing and self._writing[0].done():
            self._writing.pop(0).result()
        return len(self._writing)

    def settle(self) -> None:
        """Wait until all that was begun is on disk; OSError where that has failed."""
        writings, self._writing = self._writing, []
        for writing in writings:
            writing.result()

    @property
    def totals(self) -> dict[str, int]:
        """Rows of every log so far."""
        return {log: buffer.total for log, buffer in self._buffers.items()}

    def close(self) -> None:
        """Write the buffered rows; further rows raise ValueError."""
        if not self._closed:
            self.settle()
            for log, buffer in self._buffers.items():
                if buffer.count:
                    self._write(log, buffer.parts, buffer.rows[: buffer.count])
            self._closed = True
            self._buffers.clear()
            self._writer.shutdown()
            self._lock.close()

    def __enter__(self) -> "Recorder":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        try:
            self.close()
        except OSError:
            self._writer.shutdown()
            self._lock.close()
            if not isinstance(error, OSError):  # else it is the same full disk
                raise

    def _new_buffer(self, log: str) -> _Buffer:
        if self._closed:
            raise ValueError(f"the recorder of {self.directory} is closed")
        buffer = _Buffer(check_log_name(log), self._rows_per_part)
        self._buffers[log] = buffer
        return buffer

    def _go_on(self, log: str, rows: int) -> None:
        """Take up a log behind its first rows; whatever is later is removed."""
        full, rest = divmod(rows, self._rows_per_part)
        paths = {path.name: path for path in part_paths(self.directory, log)}
        kept = [part_path(self.directory, log, number) for number in range(full + (rest > 0))]
        for path in kept:
            if path.name not in paths:
                raise ValueError(f"{path} is missing: the run cannot be resumed, begin it in a new folder")
        (self.directory / log).mkdir(exist_ok=True)
        if rows:
            buffer = self._new_buffer(log)
            buffer.parts = full
        if rest:
            columns = buffer.columns
            table = read_part(kept[-1], [column.name for column in columns]).slice(0, rest)
            if table.num_rows < rest:
                raise ValueError(f"{kept[-1]} is too short: it cannot be resumed, begin in a new folder")
            for index, column in enumerate(columns):
                values = table[column.name]
                texts = values.to_pylist() if column.kind == "string" else values.to_numpy()
                buffer.rows[:rest, index] = self._codes(column.name, texts)
            buffer.count = rest
            self._write(log, full, buffer.rows[:rest])
        for path in (*paths.values(), *(self.directory / log).glob(f"*{TEMPORARY_SUFFIX}")):
            if path not in kept:
                path.unlink()

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

    def _write(self, log: str, part: int, rows: NDArray[np.float64], growing: bool = False) -> None:
        """Write a part of a log, in place of a shorter one on disk."""
        columns = LOGS[log]
        arrays = [self._arrow_column(log, column, rows[:, index]) for index, column in enumerate(columns)]
        table = pyarrow.Table.from_arrays(arrays, schema=_schema(columns, arrays))
        table = table.replace_schema_metadata({**self._metadata, LOG_KEY: log.encode()})
        texts = [column.name for column in columns if column.kind == "string"]
        write_part(part_path(self.directory, log, part), table, texts, growing)

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
