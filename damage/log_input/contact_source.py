"""Sources of contact states: a run, its directory, Parquet files, a table or arrays; read in batches."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pyarrow
import pyarrow.dataset
import pyarrow.fs
import pyarrow.parquet
from numpy.typing import ArrayLike

from hh_exudyn.log.store import Run, open_run

ContactSource: TypeAlias = Run | Path | str | pyarrow.Table | Mapping[str, ArrayLike]
"""A contact log: a run or its directory; a Parquet file, or a folder of such files alone (in the order of
their paths, at any depth); a table; or arrays by the name of their column."""

PARQUET = ".parquet"


def batches(source: ContactSource, columns: Sequence[str], rows: int) -> Iterator[pyarrow.RecordBatch]:
    """The wanted columns of a contact log in record batches, in constant memory where it lies on disk.

    Parameters
    ----------
    source
        The contact log.
    columns
        Names of the wanted columns.
    rows
        Largest number of rows of a batch.

    Raises
    ------
    FileNotFoundError
        There is no such run or file.
    ValueError
        The log lacks columns, or arrays of different lengths were given.
    """
    if isinstance(source, Mapping):
        source = _table(source)
    if isinstance(source, pyarrow.Table):
        _require("the contact log", source.column_names, columns)
        return iter(source.select(list(columns)).to_batches(max_chunksize=rows))
    run = run_of(source)
    if run is None:
        return _file_batches(_parquet_files(Path(source)), columns, rows)  # type: ignore[arg-type]
    return run.batches("contact", list(columns), rows)


def run_of(source: ContactSource) -> Run | None:
    """The run of a contact log; None for files, a table or arrays.

    Raises
    ------
    FileNotFoundError
        There is no such run or file.
    """
    if isinstance(source, Run):
        return source
    if isinstance(source, Mapping | pyarrow.Table) or _parquet_files(Path(source)):
        return None
    return open_run(source)


def has_column(source: ContactSource, name: str) -> bool:
    """Whether a contact log has a column: of a run always as its channels say.

    Parameters
    ----------
    source
        The contact log.
    name
        Of the column.
    """
    if isinstance(source, pyarrow.Table):
        return name in source.column_names
    if isinstance(source, Mapping):
        return name in source
    if run_of(source) is not None:
        return True
    files = _parquet_files(Path(source))  # type: ignore[arg-type]
    try:
        return all(name in pyarrow.parquet.read_schema(path).names for path in files)
    except pyarrow.ArrowInvalid:
        return False  # `batches` says which file it is


def _table(arrays: Mapping[str, ArrayLike]) -> pyarrow.Table:
    """Arrays as a table, without a copy where that is possible."""
    columns = {name: np.asarray(values) for name, values in arrays.items()}
    lengths = {name: column.size for name, column in columns.items()}
    if len(set(lengths.values())) > 1:
        text = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise ValueError(f"the arrays of a contact log must be equally long; they have {text} rows")
    return pyarrow.table(columns)


def _parquet_files(path: Path) -> list[Path]:
    """The Parquet files of a path; none where it may be a run's directory."""
    if path.is_file():
        return [path]
    if not path.is_dir() or (path / "contact").is_dir() or (path / "case.toml").is_file():
        return []
    return sorted(file for file in path.rglob(f"*{PARQUET}") if file.is_file())


def _file_batches(files: list[Path], columns: Sequence[str], rows: int) -> Iterator[pyarrow.RecordBatch]:
    parquet, local = pyarrow.dataset.ParquetFileFormat(), pyarrow.fs.LocalFileSystem()
    # a scan that reads ahead holds the whole file: 790 instead of 210 MB for a file of 600 MB
    stream = pyarrow.dataset.ParquetFragmentScanOptions(use_buffered_stream=True, pre_buffer=False)
    for path in files:
        part = parquet.make_fragment(str(path), filesystem=local)
        try:
            names = part.physical_schema.names
        except pyarrow.ArrowInvalid as error:
            raise ValueError(f"{path} cannot be read as Parquet: {error}") from None
        _require(str(path), names, columns)
        yield from part.to_batches(
            columns=list(columns), batch_size=rows, batch_readahead=0, use_threads=False,
            fragment_scan_options=stream,
        )  # fmt: skip


def _require(where: str, there: Sequence[str], wanted: Sequence[str]) -> None:
    missing = [name for name in wanted if name not in there]
    if missing:
        raise ValueError(f"{where} has no column {', '.join(missing)}; damage needs {', '.join(wanted)}")
