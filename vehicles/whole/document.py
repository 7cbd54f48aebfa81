"""The content of a vehicle file as a value: its numbers by name, and the `Vehicle` that they build."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from hh_exudyn.sourced import Parameter, ParameterSet
from vehicles.description import Vehicle
from vehicles.record import VehicleRecord
from vehicles.whole.layout import is_place, sections
from vehicles.whole.mirror import mirrored
from vehicles.whole.numbers import leaves

Values = Mapping[str, Any]  # of fields: numbers as `Parameter` or tuples of them, texts, flags, whole numbers


@dataclass(frozen=True)
class Entry:
    """A body, coupling, wheelset, ...: its class, own values, and the part from which it takes the others."""

    kind: type
    values: Values
    part: str = ""
    mirror: bool = False  # a copy on the other side follows


@dataclass(frozen=True)
class Document:
    """A whole vehicle with a source for every number.

    Attributes
    ----------
    name, description : str
        Of the vehicle.
    entries : mapping
        By field of `Vehicle`: a tuple of `Entry` for a list, one for a table, or numbers by name.
    parts : mapping
        Values that entries share, by name of the part.
    source : str
        Of the numbers for which the file states none.
    """

    name: str
    entries: Mapping[str, Any]
    parts: Mapping[str, Values] = field(default_factory=dict)
    description: str = ""
    source: str = ""

    def parameters(self) -> ParameterSet:
        """All its numbers in SI: those of a part, or of an entry by its name, ``wedge.friction``.

        Raises
        ------
        ValueError
            Two numbers have one name.
        """
        found: dict[str, Parameter] = {}
        for parameter in _numbers((self.parts, self.entries)):
            if parameter.name in found:
                raise ValueError(f"{parameter.name} is given twice: allowed one part or entry of a name")
            found[parameter.name] = parameter
        return ParameterSet(self.name, tuple(found.values()))

    def coordinates(self) -> frozenset[str]:
        """Names of the numbers that say where its entries are on the drawing."""
        return frozenset(
            number.name
            for content in self.entries.values()
            for entry in (content if isinstance(content, tuple) else (content,))
            if isinstance(entry, Entry)
            for key, value in entry.values.items()
            if is_place(entry.kind, key)
            for number in leaves(value)
        )

    def vehicle(self, name: str | None = None) -> Vehicle:
        """The vehicle, with another name where one is given.

        Raises
        ------
        ValueError
            The numbers are impossible, as for `Vehicle`.
        """
        built: dict[str, Any] = {}
        for section in sections():
            content = self.entries.get(section.key)
            if content is None:
                continue
            if not section.kinds:
                built[section.key] = {key: _plain(item) for key, item in content.items()}
            elif section.many:
                built[section.key] = tuple(one for entry in content for one in self._made(entry))
            else:
                built[section.key] = self._made(content)[0]
        return Vehicle(name=name or self.name, **built)

    def with_numbers(self, parameters: ParameterSet, name: str) -> "Document":
        """A copy with another name and other numbers.

        Parameters
        ----------
        parameters : ParameterSet
            All its numbers, some of them changed.
        name : str
            Of the copy.
        """
        parts = {part: _changed(values, parameters) for part, values in self.parts.items()}
        entries = {key: _changed(content, parameters) for key, content in self.entries.items()}
        return replace(self, name=name, parts=parts, entries=entries)

    def record(self) -> VehicleRecord:
        """As a record of the catalogue, so that a variant can change its numbers."""
        return VehicleRecord(self.name, partial(_build, self), self.parameters, self.description)

    def _made(self, entry: Entry) -> tuple[Any, ...]:
        given = {**self.parts.get(entry.part, {}), **entry.values}
        plain = {key: _plain(value) for key, value in given.items()}
        both = (plain, mirrored(entry.kind, plain)) if entry.mirror else (plain,)
        return tuple(entry.kind(**one) for one in both)


def _build(document: Document, name: str, parameters: ParameterSet) -> Vehicle:
    return document.with_numbers(parameters, name).vehicle()


def _numbers(value: Any) -> Iterator[Parameter]:
    """All numbers in entries, parts and values."""
    if isinstance(value, Entry):
        yield from _numbers(value.values)
    elif isinstance(value, Mapping):
        for item in value.values():
            yield from _numbers(item)
    elif isinstance(value, tuple):
        for item in value:
            yield from _numbers(item)
    elif isinstance(value, Parameter):
        yield value


def _changed(value: Any, parameters: ParameterSet) -> Any:
    """Entries, parts or values with the numbers of a set."""
    if isinstance(value, Parameter):
        return parameters.parameter(value.name)
    if isinstance(value, Entry):
        return replace(value, values=_changed(value.values, parameters))
    if isinstance(value, Mapping):
        return {key: _changed(item, parameters) for key, item in value.items()}
    return tuple(_changed(item, parameters) for item in value) if isinstance(value, tuple) else value


def _plain(value: Any) -> Any:
    """A value with the numbers in place of its parameters."""
    if isinstance(value, Parameter):
        return value.value
    return tuple(map(_plain, value)) if isinstance(value, tuple) else value
