"""A vehicle as JSON and back: the copy in a run's folder, independent of later changes of data files."""

import json
from dataclasses import asdict
from typing import Annotated, Any, Union, get_args

from pydantic import ConfigDict, Discriminator, Tag, TypeAdapter, ValidationError

from vehicles.couplings import Coupling
from vehicles.description import Vehicle

_TYPE = "type"  # key of a coupling's class
_STRICT = ConfigDict(extra="forbid")  # of tuples around the dataclasses, which take no config themselves
_ANY_COUPLING: Any = Union[tuple(Annotated[kind, Tag(kind.__name__)] for kind in get_args(Coupling))]  # noqa: UP007
_TAGGED: Any = Annotated[_ANY_COUPLING, Discriminator(lambda entry: entry.pop(_TYPE))]
_COUPLINGS: TypeAdapter[Any] = TypeAdapter(tuple[_TAGGED, ...], config=_STRICT)
_VEHICLE = TypeAdapter(tuple[Vehicle], config=_STRICT)


def to_json(vehicle: Vehicle) -> str:
    """The whole description as text; `from_json` gives an equal one."""
    data = asdict(vehicle)
    for coupling, entry in zip(vehicle.couplings, data["couplings"], strict=True):
        entry[_TYPE] = type(coupling).__name__
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
        data["couplings"] = _COUPLINGS.validate_python(data["couplings"])
        return _VEHICLE.validate_python([data])[0]
    except (ValidationError, TypeError, KeyError, AttributeError, json.JSONDecodeError) as error:
        reason = " ".join(str(error).split())
        raise ValueError(f"not the description of a vehicle as this version has it: {reason}") from None
