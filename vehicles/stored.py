"""A vehicle as JSON and back: the copy in a run's folder, independent of later changes of data files.

Beside the description such a file may name its origin, the table of a variant (`vehicles.variants`) or the
tables of a vehicle file (`vehicles.whole`) that the vehicle was built from: for its sources, never for its
numbers.
"""

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Union, get_args

from pydantic import ConfigDict, Discriminator, Tag, TypeAdapter, ValidationError

from vehicles.couplings import Coupling
from vehicles.description import Vehicle

_TYPE = "type"  # key of a coupling's class
_ORIGIN = "origin"
VEHICLE_SUFFIX = ".json"  # of a file with a whole vehicle
_STRICT = ConfigDict(extra="forbid")  # of tuples around the dataclasses, which take no config themselves
_ANY_COUPLING: Any = Union[tuple(Annotated[kind, Tag(kind.__name__)] for kind in get_args(Coupling))]  # noqa: UP007
_TAGGED: Any = Annotated[_ANY_COUPLING, Discriminator(lambda entry: entry.pop(_TYPE))]
_COUPLINGS: TypeAdapter[Any] = TypeAdapter(tuple[_TAGGED, ...], config=_STRICT)
_VEHICLE = TypeAdapter(tuple[Vehicle], config=_STRICT)


def to_json(vehicle: Vehicle, origin: Mapping[str, Any] | None = None) -> str:
    """The whole description as text; `from_json` gives an equal one.

    Parameters
    ----------
    vehicle : Vehicle
        The description.
    origin : mapping or None
        Tables that it was built from, None for a vehicle built otherwise.
    """
    data = asdict(vehicle)
    for coupling, entry in zip(vehicle.couplings, data["couplings"], strict=True):
        entry[_TYPE] = type(coupling).__name__
    if origin is not None:
        data[_ORIGIN] = dict(origin)
    return json.dumps(data, indent=1) + "\n"


def from_json(text: str) -> Vehicle:
    """The description that `to_json` wrote.

    Raises
    ------
    ValueError
        The text is not a vehicle, or one of another version of the toolkit.
    """
    try:
        data = json.loads(text)
        data.pop(_ORIGIN, None)
        data["couplings"] = _COUPLINGS.validate_python(data["couplings"])
        return _VEHICLE.validate_python([data])[0]
    except (ValidationError, TypeError, KeyError, AttributeError, ValueError, RecursionError) as error:
        reason = " ".join(str(error).split())
        raise ValueError(f"not the description of a vehicle as this version has it: {reason}") from None


def read_vehicle(path: Path | str) -> Vehicle:
    """The vehicle in a file that `to_json` wrote.

    Raises
    ------
    ValueError
        The file cannot be read, or is not a vehicle of this version.
    """
    text = _read_text(path)
    try:
        return from_json(text)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def origin_of(path: Path | str) -> dict[str, Any] | None:
    """The origin of the vehicle in a file, None where the file names none. Errors as `read_vehicle`."""
    text = _read_text(path)
    try:
        return origin_in(text)
    except (ValueError, AttributeError) as error:
        raise ValueError(f"{path}: not the description of a vehicle: {error}") from None


def origin_in(text: str) -> dict[str, Any] | None:
    """The origin of the vehicle in a text that `to_json` wrote, None where it names none."""
    origin = json.loads(text).get(_ORIGIN)
    return origin if isinstance(origin, dict) else None


def _read_text(path: Path | str) -> str:
    """A text file (UTF-8); one that cannot be read is a ValueError that begins with its path."""
    try:
        return Path(path).read_text(encoding="utf-8")
    except OSError as error:
        raise ValueError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise ValueError(f"{path}: not UTF-8 at byte {error.start}") from None
