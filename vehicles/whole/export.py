"""Any vehicle as a `Document`: the round trip through its file gives an equal vehicle.

Entries of one class with equal numbers share a part; names, bodies, directions and places stay with each.
"""

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from hh_exudyn.sourced import ParameterSet, made
from vehicles.description import Vehicle
from vehicles.record import VehicleRecord
from vehicles.whole.document import Document, Entry
from vehicles.whole.layout import (
    PLACE,
    Section,
    fields_of,
    hints,
    is_number,
    is_place,
    required,
    sections,
    unit_of,
)
from vehicles.whole.numbers import names_in
from vehicles.whole.tracing import Address, Origins, origins, source_of

_CAPITAL = re.compile(r"(?<!^)(?=[A-Z])")
_STEM = re.compile(r"[A-Za-z]{2,}(?:_[A-Za-z]{2,})*")  # of a name: its words before a number or a side


class _Sources(NamedTuple):
    """Sources of the numbers of a vehicle."""

    known: Origins
    otherwise: str  # of numbers that rest on no parameter

    def of(self, address: Address, value: float, unit: str) -> str:
        """The source of a number."""
        found = self.known.get(address, ())
        return source_of(value, unit, found) if found else self.otherwise

    def of_places(self, addresses: list[Address]) -> str:
        """The one source of the places of an entry."""
        found = [
            one
            for known, ones in self.known.items()
            if any(known[: len(address)] == address for address in addresses)
            for one in ones
        ]
        return source_of(math.nan, PLACE, found) if found else self.otherwise


def document_of_record(record: VehicleRecord, name: str, parameters: ParameterSet) -> Document:
    """The document of the vehicle that a record builds from parameters, with their sources.

    Raises
    ------
    ValueError
        The record cannot build it.
    """
    otherwise = f"assumed: fixed in the model {record.name}"
    vehicle = record.build(name, parameters)
    return document_of(vehicle, otherwise, origins(record, parameters), record.description)


def document_of(
    vehicle: Vehicle, otherwise: str, known: Origins | None = None, description: str = ""
) -> Document:
    """The document of a vehicle.

    Parameters
    ----------
    vehicle : Vehicle
        Any.
    otherwise : str
        Source of numbers that rest on no parameter.
    known : mapping or None
        Parameters on which the others rest (`vehicles.whole.tracing`).
    description : str
        One line.
    """
    sources = _Sources(known or {}, otherwise)
    parts: dict[str, dict[str, Any]] = {}
    entries: dict[str, Any] = {}
    bodies = {body.name for body in vehicle.bodies}
    for section in sections():
        content = getattr(vehicle, section.key)
        field = fields_of(Vehicle)[section.key]
        if not required(field) and content == field.default:
            continue
        if section.many:
            names = _part_names(section, content, bodies)
            entries[section.key] = tuple(
                _entry(section, one, i, names.get(_shared(one, bodies), ""), parts, bodies, sources)
                for i, one in enumerate(content)
            )
        elif not section.kinds:
            entries[section.key] = {
                key: _number(f"{section.key}.{key}", value, float, PLACE, (section.key, key), sources)
                for key, value in content.items()
            }
        else:
            values = _values(section.key, content, dict(_given(content)), (section.key,), sources)
            entries[section.key] = Entry(type(content), values)
    return Document(vehicle.name, entries, parts, description, otherwise)


def _entry(
    section: Section,
    one: Any,
    i: int,
    part: str,
    parts: dict[str, dict[str, Any]],
    bodies: set[str],
    sources: _Sources,
) -> Entry:
    """An entry of a list, and its part where it is the first of it."""
    own = {key: value for key, value in _given(one) if _is_own(one, key, value, bodies)}
    address = (section.key, i)
    if part and part not in parts:
        shared = {key: value for key, value in _given(one) if key not in own}
        parts[part] = _values(part, one, shared, address, sources)
    label = getattr(one, "name", getattr(one, "body", f"{section.part}_{i + 1}"))
    return Entry(type(one), _values(label, one, own, address, sources), part)


def _values(
    label: str, one: Any, given: Mapping[str, Any], address: Address, sources: _Sources
) -> dict[str, Any]:
    """Fields of an entry, numbers as `Parameter`."""
    kind, found = _class(one), {}
    places = [(*address, key) for key in given if is_place(kind, key)]
    for key, value in given.items():
        hint = hints(kind)[key]
        if is_number(hint):
            own = _Sources({}, sources.of_places(places)) if is_place(kind, key) else sources
            value = _number(f"{label}.{key}", value, hint, unit_of(kind, key), (*address, key), own)
        found[key] = value
    return found


def _number(name: str, value: Any, hint: Any, unit: str, address: Address, sources: _Sources) -> Any:
    """A number, or a tuple of numbers."""
    if not isinstance(value, tuple):
        return made(name, value=float(value), unit=unit, source=sources.of(address, value, unit))
    kinds, units, names = names_in(name, hint, len(value), tuple(unit.split(", ")))
    return tuple(
        _number(place, item, kind, ", ".join(own), (*address, i), sources)
        for i, (place, item, kind, own) in enumerate(zip(names, value, kinds, units, strict=True))
    )


def _part_names(section: Section, content: tuple[Any, ...], bodies: set[str]) -> dict[Any, str]:
    """Name of the part of every group of entries with equal shared fields."""
    groups: dict[Any, list[Any]] = {}
    for one in content:
        if (shared := _shared(one, bodies))[1]:
            groups.setdefault(shared, []).append(one)
    plain = {shared: _plain_name(section, members[0]) for shared, members in groups.items()}
    names: dict[Any, str] = {}
    for shared, members in groups.items():
        several = list(plain.values()).count(plain[shared]) > 1
        stem = _STEM.match(getattr(members[0], "name", ""))
        name = stem[0] if several and stem else plain[shared]
        number = 1
        while (unique := name if number == 1 else f"{name}_{number}") in names.values():
            number += 1
        names[shared] = unique
    return names


def _plain_name(section: Section, one: Any) -> str:
    """Kind of a body, class of a coupling, or the section's word."""
    if hasattr(one, "kind"):
        return str(one.kind)
    return _CAPITAL.sub("_", type(one).__name__).lower() if hasattr(one, "name") else section.part


def _shared(one: Any, bodies: set[str]) -> tuple[type, tuple[tuple[str, Any], ...]]:
    """Class and fields of an entry that others may share."""
    return type(one), tuple(
        (key, value) for key, value in _given(one) if not _is_own(one, key, value, bodies)
    )


def _is_own(one: Any, key: str, value: Any, bodies: set[str]) -> bool:
    """Whether a field says which entry it is, and where."""
    if isinstance(value, str):
        return key == "name" or (key != "kind" and value in bodies)
    whole = isinstance(value, int) and not isinstance(value, bool) and hints(_class(one))[key] is int
    return whole or is_place(_class(one), key)


def _given(one: Any) -> Iterator[tuple[str, Any]]:
    """The fields of an entry that differ from their defaults."""
    for key, field in fields_of(_class(one)).items():
        value = getattr(one, key)
        if value is not None and (required(field) or value != field.default):
            yield key, value


def _class(one: Any) -> Any:
    """The dataclass of an entry."""
    return type(one)
