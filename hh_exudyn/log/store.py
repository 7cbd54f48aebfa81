"""A run on disk, and reading it back.

    directory/case.toml                  the case that was run
    directory/vehicle.json               the complete vehicle of the run (`vehicles.stored`)
    directory/status.json                end of the run: finished or not, and the reason
    directory/<log>/part-00000.parquet   rows of one of the logs of `channels`, in order of time

A part is renamed into place when it is complete, so a killed run leaves all its finished parts readable;
temporary files are ignored. The writer of the logs is `hh_exudyn.log.recorder.Recorder`.
"""

import json
import os
import shutil
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pyarrow
import pyarrow.parquet

from hh_exudyn.log.channels import LOGS
from hh_exudyn.log.recorder import PART_PATTERN, TEMPORARY_SUFFIX, Recorder, check_log_name

__all__ = ["Recorder", "Run", "open_run", "remove_logs", "write_case", "write_status", "write_vehicle"]

CASE_FILE = "case.toml"
VEHICLE_FILE = "vehicle.json"
STATUS_FILE = "status.json"


@dataclass(frozen=True)
class Run:
    """A run on disk.

    Its files are read on demand.

    Attributes
    ----------
    directory
        The folder of the run.
    """

    directory: Path

    @property
    def case_text(self) -> str:
        """The case (TOML), from its file or from the metadata of a part.

        Raises
        ------
        FileNotFoundError
            Neither exists.
        """
        path = self.directory / CASE_FILE
        if path.is_file():
            return path.read_text(encoding="utf-8")
        for log in LOGS:
            for part in _parts(self.directory, log):
                text = (pyarrow.parquet.read_schema(part).metadata or {}).get(b"case")
                if text is not None:
                    return str(text.decode("utf-8"))
        raise FileNotFoundError(f"{self.directory} holds no {CASE_FILE} and no part with a case")

    @property
    def vehicle_text(self) -> str | None:
        """The vehicle that ran (JSON); None in runs of versions that did not store it."""
        path = self.directory / VEHICLE_FILE
        return path.read_text(encoding="utf-8") if path.is_file() else None

    @property
    def status(self) -> dict[str, Any]:
        """End of the run as written by `write_status`; ``finished`` is False for a run cut off."""
        path = self.directory / STATUS_FILE
        if not path.is_file():
            return {"finished": False, "reason": f"no {STATUS_FILE}: the run was cut off, or is still going"}
        status: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        return status

    def contact(self) -> pyarrow.Table:
        """The whole contact log."""
        return self.read("contact")

    def motion(self) -> pyarrow.Table:
        """The whole motion log."""
        return self.read("motion")

    def energy(self) -> pyarrow.Table:
        """The whole energy ledger."""
        return self.read("energy")

    def read(self, log: str, columns: Sequence[str] | None = None) -> pyarrow.Table:
        """A log as one table.

        Parameters
        ----------
        log
            ``contact``, ``motion``, ``energy`` or ``control``.
        columns
            Names of the wanted columns, in the wanted order; None for all.

        Raises
        ------
        FileNotFoundError
            The log has no finished part.
        ValueError
            Unknown log or columns.
        """
        parts, wanted = self._wanted(log, columns)
        tables = [pyarrow.parquet.read_table(part, columns=wanted).select(wanted) for part in parts]
        return pyarrow.concat_tables(tables).unify_dictionaries()

    def batches(
        self, log: str, columns: Sequence[str] | None = None, rows: int = 50_000
    ) -> Iterator[pyarrow.RecordBatch]:
        """A log in pieces of at most `rows` rows, in order of time and in constant memory.

        Parameters and errors are those of `read`; errors come at once, not with the first piece.
        """
        if rows < 1:
            raise ValueError(f"rows = {rows} must be at least 1")
        parts, wanted = self._wanted(log, columns)
        return _batches(parts, wanted, rows)

    def _wanted(self, log: str, columns: Sequence[str] | None) -> tuple[list[Path], list[str]]:
        """Parts and column names of a log, checked."""
        schema = check_log_name(log)
        parts = _parts(self.directory, log)
        if not parts:
            raise FileNotFoundError(f"{self.directory} has no finished part of the log {log!r}")
        wanted = [column.name for column in schema] if columns is None else list(columns)
        for part in parts:
            there = pyarrow.parquet.read_schema(part).names
            missing = [name for name in wanted if name not in there]
            if missing:
                raise ValueError(f"{part} has no column {', '.join(missing)}; it has {', '.join(there)}")
            if double := [name for name in wanted if there.count(name) > 1]:
                raise ValueError(f"{part} has the column {', '.join(double)} more than once")
        return parts, wanted


def open_run(directory: Path | str) -> Run:
    """Open the directory of a run for reading.

    Raises
    ------
    FileNotFoundError
        There is no such directory, or it holds neither a log nor a case.
    """
    path = Path(directory)
    if not path.is_dir():
        raise FileNotFoundError(f"{path} is not a directory")
    if not (path / CASE_FILE).is_file() and not any((path / log).is_dir() for log in LOGS):
        raise FileNotFoundError(
            f"{path} is not the directory of a run: it has no {CASE_FILE} "
            f"and none of the logs {', '.join(LOGS)}"
        )
    return Run(path)


def remove_logs(run: Run) -> None:
    """Remove a run's logs, status, case and vehicle; other files of its directory remain."""
    for log in LOGS:
        shutil.rmtree(run.directory / log, ignore_errors=True)
    for name in (STATUS_FILE, CASE_FILE, VEHICLE_FILE):
        (run.directory / name).unlink(missing_ok=True)


def write_case(directory: Path | str, text: str) -> None:
    """Write the case of a run (TOML). Call it after the `Recorder` has claimed the directory.

    Parameters
    ----------
    directory
        Of the run.
    text
        The case, TOML.

    Raises
    ------
    FileExistsError
        The directory holds another case.
    """
    path = Path(directory) / CASE_FILE
    if path.exists() and path.read_text(encoding="utf-8") != text:
        raise FileExistsError(f"{path} holds another case; a run is never overwritten")
    _write_text(path, text)


def write_vehicle(directory: Path | str, text: str) -> None:
    """Write the vehicle of a run (JSON)."""
    _write_text(Path(directory) / VEHICLE_FILE, text)


def write_status(directory: Path | str, status: dict[str, Any]) -> None:
    """Write the state of a run: ``finished`` (bool), ``reason`` of its end, wall times [s].

    Parameters
    ----------
    directory
        Of the run.
    status
        ``finished``, ``reason``, wall times [s].
    """
    _write_text(Path(directory) / STATUS_FILE, json.dumps(status, indent=2) + "\n")


def _write_text(path: Path, text: str) -> None:
    """Write a complete file or none."""
    temporary = path.with_name(path.name + TEMPORARY_SUFFIX)
    temporary.write_text(text, encoding="utf-8")
    os.replace(temporary, path)


def _parts(directory: Path, log: str) -> list[Path]:
    """Finished parts of a log, in order of time."""
    parts = (directory / log).glob(PART_PATTERN)
    return sorted(parts, key=lambda part: int(part.stem.removeprefix("part-")))


def _batches(parts: list[Path], columns: list[str], rows: int) -> Iterator[pyarrow.RecordBatch]:
    for part in parts:
        with pyarrow.parquet.ParquetFile(part) as file:
            for batch in file.iter_batches(batch_size=rows, columns=columns):
                yield batch.select(columns)
