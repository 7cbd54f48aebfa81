"""A `Document` as tables and as the text of a vehicle file; `vehicles.whole.reading` gives it back."""

import json
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from hh_exudyn.sourced import Parameter
from vehicles.whole.document import Document, Entry
from vehicles.whole.layout import TYPE, Section, is_place, sections
from vehicles.whole.numbers import leaves

_WIDTH = 110
_INDENT = " " * 4


def to_tables(document: Document) -> dict[str, Any]:
    """The tables of its file."""
    tables: dict[str, Any] = {"name": document.name}
    if document.description:
        tables["description"] = document.description
    if document.source:
        tables["source"] = document.source
    value_of = partial(_value, otherwise=document.source)
    lists = sorted(sections(), key=lambda section: not section.many)
    for section in lists:
        if section.key not in document.entries:
            continue
        content = document.entries[section.key]
        if isinstance(content, tuple):
            if content:
                tables[section.key] = [_entry_table(section, entry, document) for entry in content]
        elif isinstance(content, Entry):
            tables[section.key] = _entry_table(section, content, document)
        else:
            tables[section.key] = {key: value_of(value) for key, value in content.items()}
    for part, values in document.parts.items():
        tables[part] = _tag(document, part) | {key: value_of(value) for key, value in values.items()}
    return tables


def to_toml(document: Document, comment: str = "") -> str:
    """The text of its file.

    Parameters
    ----------
    document : Document
        The vehicle.
    comment : str
        Lines for the head of the file.
    """
    lines = [f"# {line}".rstrip() for line in comment.splitlines()]
    for key, value in to_tables(document).items():
        if isinstance(value, list):
            lines += ["", f"{key} = ["]
            lines += [f"{_INDENT}{_inline(entry)}," for entry in value]
            lines.append("]")
        elif isinstance(value, Mapping):
            lines += ["", f"[{_key(key)}]"]
            for inner, item in value.items():
                lines += _assignment(inner, item)
        else:
            lines.append(f"{key} = {_inline(value)}")
    return "\n".join(lines).lstrip("\n") + "\n"


def _entry_table(section: Section, entry: Entry, document: Document) -> dict[str, Any]:
    table: dict[str, Any] = {"part": entry.part} if entry.part else {}
    if section.tagged and not entry.part:
        table[TYPE] = entry.kind.__name__
    places = [number for key in entry.values for number in _places(entry, key)]
    bare = len({number.source for number in places}) == 1
    otherwise = places[0].source if bare else document.source
    for key, value in entry.values.items():
        table[key] = _bare(value) if bare and any(_places(entry, key)) else _value(value, otherwise)
    if bare and places[0].source != document.source:
        table["source"] = places[0].source
    return table | ({"mirror": True} if entry.mirror else {})


def _places(entry: Entry, key: str) -> tuple[Parameter, ...]:
    """The coordinates in a field that is a place or several."""
    return tuple(leaves(entry.values[key])) if is_place(entry.kind, key) else ()


def _tag(document: Document, part: str) -> dict[str, Any]:
    """The class of a part's entries, where their section has several."""
    for section in sections():
        content = document.entries.get(section.key, ())
        if section.tagged:
            for entry in content:
                if entry.part == part:
                    return {TYPE: entry.kind.__name__}
    return {}


def _value(value: Any, otherwise: str) -> Any:
    """A value as a file has it: a row of one unit and source says them once, the source `otherwise` never."""
    numbers = tuple(leaves(value))
    if not numbers:
        return list(value) if isinstance(value, tuple) else value
    if isinstance(value, Parameter):
        return _stated(value, value.value, otherwise)
    if len({(one.unit, one.source, one.confirmed, one.range) for one in numbers}) == 1:
        return _stated(numbers[0], _bare(value), otherwise)
    return [_value(item, otherwise) for item in value]


def _stated(number: Parameter, value: Any, otherwise: str) -> dict[str, Any]:
    table = {"value": value, "unit": number.unit}
    if number.source != otherwise:
        table["source"] = number.source
    if not number.confirmed:
        table["confirmed"] = False
    if number.range is not None:
        table["range"] = list(number.range)
    return table


def _bare(value: Any) -> Any:
    return value.value if isinstance(value, Parameter) else [_bare(item) for item in value]


def _assignment(key: str, value: Any) -> Iterator[str]:
    """Lines of a key with its value; a long list has one line an item."""
    line = f"{_key(key)} = {_inline(value)}"
    if isinstance(value, list) and len(line) > _WIDTH:
        yield f"{_key(key)} = ["
        yield from (f"{_INDENT}{_inline(item)}," for item in value)
        yield "]"
    else:
        yield line


def _inline(value: Any) -> str:
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{_key(key)} = {_inline(item)}' for key, item in value.items())} }}"
    if isinstance(value, list):
        return f"[{', '.join(map(_inline, value))}]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007F")
    return str(value).lower() if isinstance(value, bool) else repr(value)


def _key(key: str) -> str:
    bare = key and all(letter.isascii() and (letter.isalnum() or letter in "_-") for letter in key)
    return key if bare else _inline(key)
