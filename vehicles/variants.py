"""Variants: a vehicle with some numbers changed by a small TOML file.

    base = "iore_wagon_loaded"      # a name of the catalogue, or another such file beside this one
    description = "wedges worn"     # optional

    [wedge]
    friction = 0.35                 # in the unit that the base has
    spring_stiffness = "0.4 MN/m"
    preload = { value = 1.5, unit = "kN", source = "assumed: a worn wedge stands higher" }

The base may be a file with a whole vehicle too (`vehicles.whole`), whose numbers then are those of its parts.
Other units are converted (`vehicles.units`), ranges are those of `vehicles.quantities`. A number alone has
the source "variant: <file>". A base may be such a file itself; the changes of all files are merged onto the
vehicle at the end of the chain, so a `Variant` no longer depends on files but a whole vehicle's. Bad files
raise ValueError of one line that begins with the file.
"""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hh_exudyn.sourced import VARIANT, Difference, Parameter, ParameterSet, differences, made
from hh_exudyn.text_files import read_toml
from vehicles.catalogue import catalogued
from vehicles.description import Vehicle
from vehicles.quantities import require_plausible, require_same_unit
from vehicles.record import VehicleRecord
from vehicles.units import converted
from vehicles.whole.document import Document
from vehicles.whole.export import document_of_record
from vehicles.whole.file import is_whole_file, read_whole
from vehicles.whole.numbers import FORMS, with_unit
from vehicles.whole.writing import to_tables

_KEYS = ("name", "base", "description")  # of a variant's table; everything else is a part
_ENTRY = {"value", "unit", "source"}


@dataclass(frozen=True)
class Variant:
    """A vehicle of the catalogue or of a file with changes; without any it is that vehicle.

    Raises
    ------
    ValueError
        The base is not known, a change is not one of its parameters, has another unit or no
        plausible value, or the vehicle cannot be built with them.
    """

    name: str
    base: str  # in the catalogue, or the path of a file with a whole vehicle
    changes: tuple[Parameter, ...] = ()
    description: str = ""

    def __post_init__(self) -> None:
        for change in self.changes:
            require_plausible(change)
        self.vehicle()

    @property
    def record(self) -> VehicleRecord:
        """The record of the base."""
        return read_whole(self.base).record() if is_vehicle_file(self.base) else catalogued(self.base)

    def parameters(self) -> ParameterSet:
        """All numbers, changed or not."""
        return self.record.parameters().with_parameters(self.changes, self.name)

    def vehicle(self) -> Vehicle:
        """The description with the changed numbers."""
        return self.record.build(self.name, self.parameters())

    def differences(self) -> tuple[Difference, ...]:
        """The numbers that differ from the base."""
        return differences(self.record.parameters(), self.parameters())

    def document(self) -> Document:
        """The whole vehicle with the source of every number."""
        if is_vehicle_file(self.base):
            return read_whole(self.base).with_numbers(self.parameters(), self.name)
        return document_of_record(self.record, self.name, self.parameters())

    def origin(self) -> dict[str, Any]:
        """What the vehicle was built from, as tables that need no file of the user."""
        return to_tables(self.document()) if is_vehicle_file(self.base) else self.to_table()

    def to_table(self) -> dict[str, Any]:
        """As the table that `variant_of_table` reads, every number with unit and source."""
        table: dict[str, Any] = {"name": self.name, "base": self.base}
        if self.description:
            table["description"] = self.description
        for change in self.changes:
            part, quantity = change.name.split(".", 1)
            entry = {"value": change.value, "unit": change.unit, "source": change.source}
            table.setdefault(part, {})[quantity] = entry
        return table


def find_variant(source: str | Path) -> Variant:
    """The vehicle of a file (.toml, .json), or the one of that name in the catalogue.

    Raises
    ------
    ValueError
        Neither a known name nor a valid vehicle file.
    """
    if is_vehicle_file(str(source)):
        return read_variant(source)
    name = str(source)
    return Variant(name, name, (), catalogued(name).description)


def is_vehicle_file(source: str) -> bool:
    """Whether a vehicle is given by its file: names of the catalogue have neither folder nor ending."""
    return "/" in source or "\\" in source or "." in source


def read_variant(path: str | Path) -> Variant:
    """The variant in a vehicle file.

    Raises
    ------
    ValueError
        The file cannot be read or is not TOML, its base is missing, unknown or leads back to it, a number is
        not one of the base's, in a foreign unit or not plausible, or the vehicle cannot be built.
    """
    return _read(Path(path), ())


def variant_of_table(table: Mapping[str, Any], source: str) -> Variant:
    """The variant in a table that may stand in another file; a base that is a file starts at its folder.

    Parameters
    ----------
    table : mapping
        As in a vehicle file, and with a name.
    source : str
        Source of the numbers that have none.

    Raises
    ------
    ValueError
        As `read_variant`.
    """
    return _variant(table, source, Path(), ())


def _read(path: Path, above: tuple[Path, ...]) -> Variant:
    """The variant in a file that the files `above` are based on."""
    place = Path(os.path.realpath(path))
    if is_whole_file(path):
        document = read_whole(path)
        return Variant(document.name, str(place), (), document.description)
    if place in above:
        chain = " -> ".join(file.name for file in (*above[above.index(place) :], place))
        raise ValueError(f"{path}: its base leads back to itself: {chain}")
    table = read_toml(path)
    try:
        return _variant({"name": path.stem, **table}, path.name, path.parent, (*above, place))
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _variant(table: Mapping[str, Any], source: str, folder: Path, above: tuple[Path, ...]) -> Variant:
    base = _text(table, "base")
    if not base:
        raise ValueError(
            'base is missing: allowed a name of the catalogue or a vehicle file (".toml"); a whole vehicle '
            "has bodies"
        )
    ground = _read(folder / base, above) if is_vehicle_file(base) else Variant(base, base)
    known = ground.parameters()
    changes = {change.name: change for change in ground.changes}
    for part, entries in table.items():
        if part in _KEYS:
            continue
        if not isinstance(entries, Mapping):
            raise ValueError(f"{part} = {entries!r}: unknown key; known are {', '.join(_KEYS)} and tables")
        for quantity, entry in entries.items():
            name = f"{part}.{quantity}"
            changes[name] = _parameter(name, entry, known, f"{VARIANT}: {source}")
    name = _text(table, "name") or ground.name
    return Variant(name, ground.base, tuple(changes.values()), _text(table, "description"))


def _parameter(name: str, entry: Any, known: ParameterSet, source: str) -> Parameter:
    """A changed number, checked; its unit is that of the base where the file gives none."""
    if isinstance(entry, str):
        found = with_unit(entry)
        if found is None:
            raise ValueError(f"{name} = {entry!r}: allowed {FORMS}")
        entry = {"value": found[0], **({"unit": found[1]} if found[1] else {})}
    if not isinstance(entry, Mapping):
        alone = known.replace({name: entry}, source).parameter(name)
        require_plausible(alone)
        require_same_unit(alone, known.parameter(name))
        return alone
    if "value" not in entry or set(entry) - _ENTRY:
        raise ValueError(f"{name} = {dict(entry)!r}: allowed {FORMS}")
    value = known.replace({name: entry["value"]}, source).parameter(name)
    try:
        number = converted(value.value, _text(entry, "unit") or value.unit, value.unit)
    except ValueError as error:
        raise ValueError(f"{name} is {error}") from None
    changed = made(name, value=number, unit=value.unit, source=_text(entry, "source") or value.source)
    if "unit" not in entry:
        require_same_unit(changed, known.parameter(name))
    return changed


def _text(table: Mapping[str, Any], key: str) -> str:
    """A text of a table, empty where it is not given."""
    text = table.get(key, "")
    if not isinstance(text, str):
        raise ValueError(f"{key} = {text!r}: allowed a text")
    return text
