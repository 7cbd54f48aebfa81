"""A case with some of its inputs changed by their names: ``speed_km_h``, ``track.rail``, ``wedge.friction``.

A key is a path in the case file (an item of a list by its number from 0, ``track.sections[2].radius_m``),
or the name of a number of its vehicle, in the unit of the vehicle's file. Values are as in a case file; in a
text the quotes may be left out, and a number of the vehicle may have its unit, ``"13 MN/m"``. `vehicle`
itself is a name or a file.
"""

import difflib
import os
import re
import tomllib
from collections.abc import Iterator, Mapping
from types import NoneType
from typing import Any, get_args

from pydantic import BaseModel

from hh_exudyn.case.case import Case
from hh_exudyn.case.errors import CaseError
from hh_exudyn.case.fields import is_path
from hh_exudyn.case.vehicle import variant_behind
from vehicles.variants import variant_of_table

SOURCE = "--set"  # of the numbers of a vehicle
_VEHICLE = "vehicle"
_OPEN = "wheel_profiles"  # table with keys of its own
_STEP = re.compile(r"([^.\[\]]+)|\[(\d+)\]")
_WITH_UNIT = re.compile(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s+(\S.*?)\s*")


def overridden(case: Case, changes: Mapping[str, Any]) -> Case:
    """A copy of a case with some inputs changed, checked again.

    Parameters
    ----------
    case : Case
        The case.
    changes : mapping of str to Any
        New values by key.

    Raises
    ------
    CaseError
        A key is neither one of the case nor a number of its vehicle (the message has the nearest), or a value
        is not allowed.
    """
    changes = dict(changes)
    if _VEHICLE in changes:
        given = changes.pop(_VEHICLE)
        path = isinstance(given, str) and is_path(given)
        case = case.with_changes(vehicle=os.path.realpath(given) if path else given)
    known = frozenset(dict(_keys(Case)))
    of_vehicle = {key: value for key, value in changes.items() if not _of_case(key, known)}
    nested: dict[str, Any] = {}
    for key, value in changes.items():
        if key not in of_vehicle:
            _put(nested, case, key, value)
    if of_vehicle:
        nested[_VEHICLE] = _changed_vehicle(case, of_vehicle, known)
    return case.with_changes(**nested)


def value_of_text(key: str, text: str) -> Any:
    """The value that a text means for a key, as in a case file; one that is no TOML is itself.

    Parameters
    ----------
    key : str
        As for `overridden`: what can only be a text is one, ``60E1`` for a rail.
    text : str
        The value.
    """
    if key.startswith(f"{_OPEN}.") or set(_kinds(dict(_keys(Case)).get(_plain(key)))) <= {str, NoneType}:
        return text.strip().strip("\"'")
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text.strip()


def _changed_vehicle(case: Case, changes: Mapping[str, Any], known: frozenset[str]) -> dict[str, Any]:
    """The vehicle of a case with other numbers, as the table of a variant."""
    variant = variant_behind(case.vehicle)
    if variant is None:
        raise CaseError(
            f"{next(iter(changes))}: vehicle {case.described_vehicle().name} has no named numbers"
        )
    names = [parameter.name for parameter in variant.parameters().parameters]
    table = variant.to_table()
    for key, value in changes.items():
        if key not in names:
            near = difflib.get_close_matches(key, (*known, *names), n=3, cutoff=0.5)
            hint = f"; did you mean {' or '.join(near)}?" if near else ""
            raise CaseError(f"unknown key {key}: neither of the case nor of vehicle {variant.name}{hint}")
        part, quantity = key.split(".", 1)
        table.setdefault(part, {})[quantity] = _with_unit(value)
    try:
        return variant_of_table(table, SOURCE).to_table()
    except ValueError as error:
        raise CaseError(str(error)) from None


def _with_unit(value: Any) -> Any:
    """A number of a vehicle with its unit, where a text has both."""
    found = _WITH_UNIT.fullmatch(value) if isinstance(value, str) else None
    return value if found is None else {"value": float(found[1]), "unit": found[2]}


def _keys(model: type[BaseModel], place: str = "") -> Iterator[tuple[str, Any]]:
    """All paths in a case file with their types, items of lists without their numbers."""
    for name, field in model.model_fields.items():
        yield f"{place}{name}", field.annotation
        if name != _VEHICLE:
            for inner in _tables(field.annotation):
                yield from _keys(inner, f"{place}{name}.")


def _tables(annotation: Any) -> Iterator[type[BaseModel]]:
    """The models in a type."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for inner in get_args(annotation):
        yield from _tables(inner)


def _kinds(annotation: Any) -> Iterator[Any]:
    """The plain types in a type."""
    inner = get_args(annotation)
    for kind in inner:
        yield from _kinds(kind)
    if not inner:
        yield annotation


def _of_case(key: str, known: frozenset[str]) -> bool:
    """Whether a key is one of the case: a known one, or any in the table of the wheels."""
    return _plain(key) in known or key.split(".")[0] == _OPEN


def _plain(key: str) -> str:
    """A key without the numbers of items."""
    return re.sub(r"\[\d+\]", "", key)


def _put(nested: dict[str, Any], case: Case, key: str, value: Any) -> None:
    """Put a value into the tables of changes; a list is changed as a whole, from the case's own."""
    steps = [name or int(number) for name, number in _STEP.findall(key)]
    here: Any = nested
    there: Any = case.model_dump()
    for step, following in zip(steps, [*steps[1:], None], strict=True):
        if isinstance(step, int) and not 0 <= step < len(here):
            raise CaseError(f"{key}: there are {len(here)} of these, counted from 0")
        there = there[step] if isinstance(step, int) else (there or {}).get(step)
        if following is None:
            here[step] = value
        elif isinstance(following, int):
            if not isinstance(here, list) and step not in here:
                here[step] = [dict(item) for item in there or ()]
            here = here[step]
        elif isinstance(step, int):
            here = here[step]
        else:
            here = here.setdefault(step, {})
