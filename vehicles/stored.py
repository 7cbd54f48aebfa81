"""A vehicle as JSON and back: what a run keeps of its vehicle, whatever files and code become later."""

import json
from dataclasses import asdict, is_dataclass
from typing import Any, get_args, get_origin, get_type_hints

from vehicles.description import Vehicle

_TYPE = "type"  # key of a coupling's class


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
        The text is not one, or one of another version of the toolkit.
    """
    try:
        vehicle: Vehicle = _built(Vehicle, json.loads(text))
    except (TypeError, KeyError, AttributeError, json.JSONDecodeError) as error:
        raise ValueError(f"not the description of a vehicle as this version has it: {error}") from None
    return vehicle


def _built(hint: Any, value: Any) -> Any:
    """A value of JSON as the type that a field of a description has."""
    if is_dataclass(hint):
        hints = get_type_hints(hint)
        made: Any = hint
        return made(**{name: _built(hints[name], item) for name, item in value.items()})
    if get_origin(hint) is tuple:
        inner = get_args(hint)
        inner = inner[:1] * len(value) if inner[-1] is Ellipsis else inner
        return tuple(_built(kind, item) for kind, item in zip(inner, value, strict=True))
    kinds = {getattr(kind, "__name__", ""): kind for kind in get_args(hint) if is_dataclass(kind)}
    if kinds and isinstance(value, dict):
        kind = kinds[value[_TYPE]] if _TYPE in value or len(kinds) > 1 else next(iter(kinds.values()))
        return _built(kind, {name: item for name, item in value.items() if name != _TYPE})
    return value
