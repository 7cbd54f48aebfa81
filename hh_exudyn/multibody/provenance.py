"""What a run was made from and with: content of its inputs, versions, hash of the code, machine."""

import hashlib
import json
import os
import platform
from collections.abc import Mapping
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from hh_exudyn import __version__
from hh_exudyn.case.sealed import SealedCase
from hh_exudyn.kernel import source_hash
from hh_exudyn.log.channels import LOGS
from hh_exudyn.log.parts import part_paths, write_text
from hh_exudyn.log.store import CASE_FILE, PROVENANCE_FILE, STATUS_FILE

_PACKAGES = ("exudyn", "numba", "numpy", "scipy", "pyarrow")
_ROOT = Path(__file__).resolve().parents[2]
_DATA = ("hh_exudyn/data", "vehicles/data", "track/data")
_MUST_AGREE = {  # key of a provenance: what it is, for messages
    "inputs": "case, vehicle or files",
    "code": "code of hh-exudyn",
    "data": "data files of hh-exudyn",
    "packages": "versions of packages",
}


def provenance(sealed: SealedCase) -> dict[str, Any]:
    """Everything that the numbers of a run depend on, and where it is made.

    Parameters
    ----------
    sealed : SealedCase
        The case with its vehicle and files.
    """
    return {
        "inputs": sealed.digest,
        "files": {name: hashlib.sha256(content).hexdigest() for name, content in sealed.files.items()},
        **software(),
        "python": platform.python_version(),
        "machine": {
            "name": platform.node(),
            "system": platform.platform(),
            "processor": _processor(),
            "cores": os.cpu_count(),
        },
    }


@cache
def software() -> dict[str, Any]:
    """Code, data files and packages that the numbers of every run depend on: hashes and versions."""
    return {
        "code": source_hash("hh_exudyn.multibody"),
        "data": _data_hash(),
        "packages": {"hh-exudyn": __version__} | {name: _version(name) for name in _PACKAGES},
    }


def write_provenance(directory: Path | str, made: Mapping[str, Any]) -> None:
    """Write the provenance of a run into its folder."""
    write_text(Path(directory) / PROVENANCE_FILE, json.dumps(made, indent=2) + "\n")


def read_provenance(directory: Path | str) -> dict[str, Any]:
    """The provenance of a run; empty where it has none, or a broken one."""
    try:
        made = json.loads((Path(directory) / PROVENANCE_FILE).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return made if isinstance(made, dict) else {}


def disagreement(there: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """What differs between two provenances so that their runs may differ; the machine is not compared.

    Parameters
    ----------
    there, now : mapping
        Of a run on disk, and of a run to be made.
    """
    if not there:
        return [f"it has no readable {PROVENANCE_FILE}"]
    return [f"other {meaning}" for key, meaning in _MUST_AGREE.items() if there.get(key) != now[key]]


def is_begun(directory: Path) -> bool:
    """Whether a folder holds a run, however little of it."""
    files = (PROVENANCE_FILE, CASE_FILE, STATUS_FILE)
    return any((directory / name).is_file() for name in files) or any(
        part_paths(directory, log) for log in LOGS
    )


def require_same(directory: Path, made: Mapping[str, Any]) -> None:
    """Raise FileExistsError unless the run in a folder was begun from and with the same.

    Parameters
    ----------
    directory : Path
        Of a run that `is_begun`.
    made : mapping
        Provenance of the run that is to be made.
    """
    differs = disagreement(read_provenance(directory), made)
    if differs:
        raise FileExistsError(
            f"{directory} holds something other than this run: {', '.join(differs)}; begin in a new folder"
        )


@cache
def _data_hash() -> str:
    """Hash of the data files that a run may read."""
    digest = hashlib.sha256()
    for folder in _DATA:
        for path in sorted((_ROOT / folder).rglob("*")):
            if path.is_file():
                digest.update(path.relative_to(_ROOT).as_posix().encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "unknown"


def _processor() -> str:
    """Name of the processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor()
