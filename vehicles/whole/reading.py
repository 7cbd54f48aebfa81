"""Tables of a vehicle file to a `Document`.

    name = "my_wagon"
    source = "assumed: first draft"     # of every number that states none

    bodies = [                          # places on the drawing: x forward, y left, z up from the rails [m]
        { part = "car_body", name = "car_body", position = [0.0, 0.0, 1.9] },
        { part = "wheelset", name = "wheelset_1", position = [3.0, 0.0, 0.46] },
    ]
    couplings = [
        { part = "pad", name = "1L", body_a = "car_body", body_b = "wheelset_1", point = [3.0, 1.0, 0.46] },
    ]                                   # with mirror = true in it, 1R would follow

    [pad]                               # a part: what its entries share
    type = "AxleBoxPad"                 # class of a coupling (`vehicles.couplings`)
    stiffness = { value = [10, 5, 1], unit = "MN/m", source = "published: drawing 12" }
    damping = [1e4, 1e4, 1e4]           # SI where nothing is said

The sections are the fields of `vehicles.description.Vehicle`, the keys of an entry those of its class
(`vehicles.couplings`); any other table is a part. Values of an entry come before those of its part. Numbers:
`vehicles.whole.numbers`.
"""

import difflib
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from vehicles.description import Vehicle
from vehicles.whole.document import Document, Entry
from vehicles.whole.layout import (
    TYPE,
    Section,
    fields_of,
    hints,
    is_number,
    required,
    sections,
    unit_of,
)
from vehicles.whole.numbers import number, row

HEAD = ("name", "description", "source")
_OWN = ("part", "mirror", "source", TYPE)  # keys of an entry beside its fields
NO_SOURCE = "assumed: no source is stated"


class _Given(NamedTuple):
    """A file on its way to a document."""

    parts: dict[str, Mapping[str, Any]]
    kinds: dict[str, tuple[type, Section]]  # of the parts, by their entries
    source: str


def is_whole(tables: Mapping[str, Any]) -> bool:
    """Whether the tables of a file are a whole vehicle, by its bodies."""
    return "bodies" in tables


def read_tables(tables: Mapping[str, Any], name: str = "") -> Document:
    """The document in the tables of a vehicle file.

    Parameters
    ----------
    tables : mapping
        As a TOML reader gives them.
    name : str
        Of the vehicle, where the tables name none.

    Raises
    ------
    ValueError
        One line: an unknown or missing key, an unknown type or part, a number in no form or unit, or a
        vehicle that cannot be built.
    """
    known = {section.key for section in sections()}
    head = {key: _text(tables, key) for key in HEAD}
    parts = {key: table for key, table in tables.items() if key not in known and key not in HEAD}
    for key, table in parts.items():
        if not isinstance(table, Mapping):
            raise ValueError(f"unknown key {key} = {table!r}{_near(key, (*HEAD, *sorted(known)))}")
    given = _Given(parts, {}, head["source"] or NO_SOURCE)
    entries = {
        section.key: _section(section, tables[section.key], given)
        for section in sections()
        if section.key in tables
    }
    for section in sections():
        if section.key not in entries and required(fields_of(Vehicle)[section.key]):
            raise ValueError(f"{section.key} is missing")
    if unused := sorted(set(parts) - set(given.kinds)):
        raise ValueError(f"no entry has part = {unused[0]!r}{_near(unused[0], (*given.kinds, *known))}")
    shared = {
        part: _values(part, table, given.kinds[part][0], table.get("source", given.source))
        for part, table in parts.items()
    }
    document = Document(head["name"] or name, entries, shared, head["description"], head["source"])
    document.parameters()
    for section in sections():
        content = entries.get(section.key, ())
        for i, entry in enumerate(content if isinstance(content, tuple) else (content,)):
            if isinstance(entry, Entry):
                _require_complete(_label(section, entry.values, i), entry, shared)
    document.vehicle()
    return document


def _section(section: Section, content: Any, given: _Given) -> Any:
    """The entries of a section."""
    if section.many:
        if not isinstance(content, list):
            raise ValueError(f"{section.key}: allowed a list of tables, [[{section.key}]]")
        return tuple(_entry(section, table, i, given) for i, table in enumerate(content))
    if not isinstance(content, Mapping):
        raise ValueError(f"{section.key} = {content!r}: allowed a table, [{section.key}]")
    if section.kinds:
        return _entry(section, content, 0, given)
    source = content.get("source", given.source)
    unit = "m"  # dimensions of drawings
    return {
        key: number(f"{section.key}.{key}", value, unit, source)
        for key, value in content.items()
        if key != "source"
    }


def _entry(section: Section, table: Any, i: int, given: _Given) -> Entry:
    if not isinstance(table, Mapping):
        raise ValueError(f"{section.key}[{i}] = {table!r}: allowed a table")
    label = _label(section, table, i)
    part = table.get("part", "")
    if part and (not isinstance(part, str) or part not in given.parts):
        raise ValueError(
            f"{section.key} {label}: part = {part!r} is no table of the file{_near(str(part), given.parts)}"
        )
    shared = given.parts[part] if part else {}
    other = given.kinds[part][1].key if part in given.kinds else section.key
    kind = _kind(section, label, {**shared, **table}) if other == section.key else None
    if kind is None or (part and given.kinds.setdefault(part, (kind, section))[0] is not kind):
        raise ValueError(
            f"{section.key} {label}: part {part} is one of {other}, allowed are entries of one class"
        )
    mirror = table.get("mirror", False)
    if not isinstance(mirror, bool) or (mirror and not section.many):
        raise ValueError(f"{section.key} {label}: mirror = {mirror!r}: allowed true or false, in lists")
    source = table.get("source", shared.get("source", given.source))
    return Entry(kind, _values(label, table, kind, source), part, mirror)


def _label(section: Section, table: Mapping[str, Any], i: int) -> str:
    """Name of an entry, and of its own numbers."""
    if not section.many:
        return section.key
    name = table.get("name", table.get("body"))
    return name if isinstance(name, str) else f"{section.part}_{i + 1}"


def _kind(section: Section, label: str, table: Mapping[str, Any]) -> type:
    """The class of an entry."""
    if not section.tagged:
        if TYPE in table:
            raise ValueError(f"{section.key} {label}: unknown key {TYPE}")
        return section.kinds[0]
    kinds = {kind.__name__: kind for kind in section.kinds}
    name = table.get(TYPE)
    if name is None:
        raise ValueError(f"{section.key} {label}: {TYPE} is missing: allowed {', '.join(kinds)}")
    if not isinstance(name, str) or name not in kinds:
        raise ValueError(f"{section.key} {label}: {TYPE} = {name!r}{_near(str(name), kinds)}")
    return kinds[name]


def _values(label: str, table: Mapping[str, Any], kind: type, source: Any) -> dict[str, Any]:
    """The fields that a table gives, numbers as `Parameter`."""
    if not isinstance(source, str):
        raise ValueError(f"{label}: source = {source!r}: allowed a text")
    found: dict[str, Any] = {}
    for key, value in table.items():
        if key in _OWN:
            continue
        name = f"{label}.{key}"
        if key not in fields_of(kind):
            raise ValueError(f"{name}: unknown key of {kind.__name__}{_near(key, fields_of(kind))}")
        hint = hints(kind)[key]
        if is_number(hint):
            found[key] = row(name, value, hint, tuple(unit_of(kind, key).split(", ")), source)
        else:
            found[key] = _other(name, value, hint)
    return found


def _other(name: str, value: Any, hint: Any) -> Any:
    """A text, a flag, a whole number or a list of texts."""
    if hint in (str, int, bool):
        if type(value) is not hint:
            allowed = {str: "a text", int: "a whole number", bool: "true or false"}[hint]
            raise ValueError(f"{name} = {value!r}: allowed {allowed}")
        return value
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise ValueError(f"{name} = {value!r}: allowed a list of texts")
    return tuple(value)


def _require_complete(label: str, entry: Entry, parts: Mapping[str, Any]) -> None:
    given = {**parts.get(entry.part, {}), **entry.values}
    for key, one in fields_of(entry.kind).items():
        if key not in given and required(one):
            unit = unit_of(entry.kind, key)
            behind = f" [{unit}]" if is_number(hints(entry.kind)[key]) else ""
            raise ValueError(f"{label}: {key}{behind} of {entry.kind.__name__} is missing")


def _near(name: str, known: Iterable[str]) -> str:
    """The end of a message: the nearest known name, else all of them."""
    known = tuple(known)
    near = difflib.get_close_matches(name, known, n=1, cutoff=0.6)
    return f'; did you mean "{near[0]}"?' if near else f"; known: {', '.join(known) or 'none'}"


def _text(table: Mapping[str, Any], key: str) -> str:
    text = table.get(key, "")
    if not isinstance(text, str):
        raise ValueError(f"{key} = {text!r}: allowed a text")
    return text
