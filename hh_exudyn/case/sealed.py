"""A case with everything that it refers to, by content: what the folder of a run holds.

The vehicle becomes ``vehicle.json``; every file of the case (profiles, irregularity, alignment) a copy in
``inputs/``; the text of the case refers to these by relative paths. So the folder of a run can be moved,
sent, and run again: sealing a sealed case gives the same again.
"""

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any

import tomli_w

from hh_exudyn.case.case import Case
from hh_exudyn.case.files import named_files
from hh_exudyn.case.vehicle import is_stored, variant_behind
from vehicles.description import Vehicle
from vehicles.stored import read_vehicle, to_json

INPUTS = "inputs"
VEHICLE = "vehicle.json"


@dataclass(frozen=True)
class SealedCase:
    """A case by content.

    Attributes
    ----------
    text
        The case (TOML), with paths relative to the folder of a run.
    files
        Content by relative path: the vehicle, and the copies of the case's files.
    """

    text: str
    files: Mapping[str, bytes]

    @property
    def digest(self) -> str:
        """Hash (SHA-256, hexadecimal) of text, vehicle and files."""
        whole = hashlib.sha256(self.text.encode())
        for name in sorted(self.files):
            whole.update(name.encode() + b"\0" + hashlib.sha256(self.files[name]).digest())
        return whole.hexdigest()


def sealed(case: Case, vehicle: Vehicle | None = None) -> SealedCase:
    """A case with the vehicle that runs and the content of all its files, as they are now.

    Parameters
    ----------
    case : Case
        The case; its relative paths start at the working directory.
    vehicle : Vehicle or None
        A description in place of the vehicle of the case.

    Raises
    ------
    ValueError
        A file cannot be read any more.
    """
    data = case.model_dump(exclude_none=True)
    files: dict[str, bytes] = {VEHICLE: _vehicle(case, vehicle).encode()}
    for table, key in _places(data):
        path = Path(table[key])
        try:
            content = path.read_bytes()
        except OSError as error:
            raise ValueError(f"{key} {path}: cannot be read: {error.strerror}") from None
        table[key] = _place(files, path.name, content)
    data["vehicle"] = VEHICLE
    return SealedCase(tomli_w.dumps(data), files)


def _vehicle(case: Case, vehicle: Vehicle | None) -> str:
    """The vehicle that runs, as JSON with its origin."""
    if vehicle is None and isinstance(case.vehicle, str) and is_stored(case.vehicle):
        read_vehicle(case.vehicle)
        return Path(case.vehicle).read_text(encoding="utf-8")
    variant = variant_behind(case.vehicle)
    runs = case.described_vehicle() if vehicle is None else vehicle
    if variant is None or variant.vehicle() != runs:
        return to_json(runs)
    return to_json(runs, variant.origin())


def _places(data: dict[str, Any]) -> Iterator[tuple[dict[str, Any], str]]:
    """Tables and keys of a dumped case under which the path of a file stands."""
    yield from named_files(data)
    track = data["track"]
    if "alignment" in track:
        yield track, "alignment"
    if "centre_line" in track:
        yield track["centre_line"], "file"


def _place(files: dict[str, bytes], name: str, content: bytes) -> str:
    """Put a file among the copies; equal files of one name have one copy."""
    number = 1
    while True:
        place = str(PurePosixPath(INPUTS) / (name if number == 1 else f"{number}-{name}"))
        if files.setdefault(place, content) == content:
            return place
        number += 1
