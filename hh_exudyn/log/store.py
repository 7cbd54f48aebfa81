"""A run on disk, and reading it back.

    directory/case.toml                  the case that was run; its paths begin at this folder
    directory/vehicle.json               the complete vehicle of the run (`vehicles.stored`)
    directory/inputs/                    copies of profiles, irregularity, alignment of the case
    directory/provenance.json            what it was made with: versions, hash of the code, machine
    directory/status.json                end of the run: finished or not, and the reason
    directory/checkpoint.npz             state of an interrupted run, to resume from
    directory/<log>/part-00000.parquet   rows of one of the logs of `channels`, in order of time

Every file is renamed into place when it is complete and on disk (`hh_exudyn.log.parts`); temporary files are
ignored. The writer of the logs is `hh_exudyn.log.recorder.Recorder`.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pyarrow
import pyarrow.parquet

from hh_exudyn.log.channels import LOGS
from hh_exudyn.log.parts import (
    BrokenPart,
    part_columns,
    part_number,
    part_path,
    part_paths,
    read_part,
    write_bytes,
    write_text,
)
from hh_exudyn.log.recorder import Recorder, check_log_name

__all__ = ["Recorder", "Run", "open_run", "write_case", "write_inputs", "write_status"]

CASE_FILE = "case.toml"
VEHICLE_FILE = "vehicle.json"
INPUTS_FOLDER = "inputs"
PROVENANCE_FILE = "provenance.json"
STATUS_FILE = "status.json"
CHECKPOINT_FILE = "checkpoint.npz"


@dataclass(frozen=True)
class Run:
    """A run on disk.

    Its files are read on demand.

    Attributes
    ----------
    directory
        The folder of the run.
    skip_broken_parts
        Parts of its logs that cannot be read are left out; without, they are an error.
    """

    directory: Path
    skip_broken_parts: bool = False

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
            for part in part_paths(self.directory, log):
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
        try:
            status = json.loads(path.read_text(encoding="utf-8"))
            if isinstance(status, dict) and isinstance(status.get("finished"), bool):
                return {"reason": "unknown", **status}
        except (ValueError, OSError):
            pass
        return {"finished": False, "reason": f"{STATUS_FILE} is broken: whether the run ended is unknown"}

    @property
    def complete(self) -> bool:
        """Whether the run has finished, and all its logs are there."""
        if not self.status["finished"]:
            return False
        return all(part_paths(self.directory, log) for log in ("contact", "motion", "energy"))

    def broken_parts(self) -> list[BrokenPart]:
        """Parts of all logs that cannot be read, or are missing between others."""
        found = []
        for log in LOGS:
            for path in _numbered(self.directory, log):
                try:
                    read_part(path, part_columns(path))
                except BrokenPart as broken:
                    found.append(broken)
        return found

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
        tables = list(self._tables(parts, wanted))
        if not tables:
            raise FileNotFoundError(f"{self.directory} has no readable part of the log {log!r}")
        return pyarrow.concat_tables(tables).unify_dictionaries()

    def batches(
        self, log: str, columns: Sequence[str] | None = None, rows: int = 50_000
    ) -> Iterator[pyarrow.RecordBatch]:
        """A log in pieces of at most `rows` rows, in order of time and in constant memory.

        Parameters and errors are those of `read`. Errors come at once, but for damage inside of a part, which
        is found when its turn comes.
        """
        if rows < 1:
            raise ValueError(f"rows = {rows} must be at least 1")
        tables = self._tables(*self._wanted(log, columns))
        return (batch for table in tables for batch in table.combine_chunks().to_batches(max_chunksize=rows))

    def _tables(self, parts: Sequence[Path], wanted: Sequence[str]) -> Iterator[pyarrow.Table]:
        """Parts of a log, one after the other; broken ones are left out where that is wanted."""
        for path in parts:
            try:
                yield read_part(path, wanted)
            except BrokenPart:
                if not self.skip_broken_parts:
                    raise

    def _wanted(self, log: str, columns: Sequence[str] | None) -> tuple[list[Path], list[str]]:
        """Parts and column names of a log, checked; without broken parts where that is wanted."""
        schema = check_log_name(log)
        wanted = [column.name for column in schema] if columns is None else list(columns)
        parts = _numbered(self.directory, log)
        if not parts:
            raise FileNotFoundError(f"{self.directory} has no finished part of the log {log!r}")
        there: dict[Path, list[str]] = {}
        for path in parts:
            try:
                there[path] = part_columns(path)
            except BrokenPart:
                if not self.skip_broken_parts:
                    raise
        missing = [name for name in wanted if there and not any(name in names for names in there.values())]
        if missing:
            first, names = next(iter(there.items()))
            raise ValueError(f"{first} has no column {', '.join(missing)}; it has {', '.join(names)}")
        for path, names in list(there.items()):
            if double := [name for name in wanted if names.count(name) > 1]:
                raise ValueError(f"{path} has the column {', '.join(double)} more than once")
            if not set(wanted) <= set(names):
                if not self.skip_broken_parts:
                    raise BrokenPart(path, "has not the columns of the other parts")
                del there[path]
        return list(there), wanted


def _numbered(directory: Path, log: str) -> list[Path]:
    """Parts of a log from the first to the last one there, also those that are missing between."""
    there = part_paths(directory, log)
    last = part_number(there[-1]) if there else -1
    return [part_path(directory, log, number) for number in range(last + 1)]


def open_run(directory: Path | str, *, skip_broken_parts: bool = False) -> Run:
    """Open the directory of a run for reading.

    Parameters
    ----------
    directory
        Of the run.
    skip_broken_parts
        Leave out parts of the logs that cannot be read, for instance after a failure of the disk; without, a
        broken part is an error (`hh_exudyn.log.parts.BrokenPart`) when its log is read.

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
    return Run(path, skip_broken_parts)


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
    write_text(path, text)


def write_inputs(directory: Path | str, files: Mapping[str, bytes]) -> None:
    """Write the files that the case of a run refers to.

    Parameters
    ----------
    directory
        Of the run.
    files
        Content by name relative to the directory.
    """
    for name, content in files.items():
        path = Path(directory) / name
        path.parent.mkdir(exist_ok=True)
        write_bytes(path, content)


def write_status(directory: Path | str, status: dict[str, Any]) -> None:
    """Write the state of a run: ``finished`` (bool), ``reason`` of its end, wall times [s].

    Parameters
    ----------
    directory
        Of the run.
    status
        ``finished``, ``reason``, wall times [s].
    """
    write_text(Path(directory) / STATUS_FILE, json.dumps(status, indent=2) + "\n")
