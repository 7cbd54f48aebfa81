"""Messages of one line from pydantic's errors: key, value, unit, what is allowed, the nearest known key."""

import difflib
import json
from collections.abc import Iterable
from typing import Any, get_args

from pydantic import BaseModel, Tag, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails


class CaseError(ValueError):
    """A fault of a case; the message is one line."""


def closest(word: str, known: Iterable[str]) -> str:
    """``; did you mean "..."?`` with the nearest known word; empty if none is near."""
    near = difflib.get_close_matches(word, list(known), n=1, cutoff=0.6)
    return f'; did you mean "{near[0]}"?' if near else ""


def explain(error: ValidationError, model: type[BaseModel]) -> str:
    """The first error of `model` as one line, and how many more there are.

    Unknown keys come first: a misspelt key is the cause of the missing one.
    """
    errors = sorted(error.errors(), key=lambda item: item["type"] != "extra_forbidden")
    line = " ".join(_line(errors[0], model).split())
    return line if len(errors) == 1 else f"{line} (and {len(errors) - 1} more)"


def _line(item: ErrorDetails, model: type[BaseModel]) -> str:
    """One error as text."""
    key, owner, field = _locate(model, item["loc"])
    extra = field.json_schema_extra if field is not None else None
    texts = extra if isinstance(extra, dict) else {}
    unit = "" if texts.get("unit", "-") == "-" else f" {texts['unit']}"
    value, context = item["input"], item.get("ctx", {})
    allowed = f"allowed {texts['allowed']}{unit}" if "allowed" in texts else ""

    match item["type"]:
        case "extra_forbidden":
            name = str(item["loc"][-1])
            known = list(owner.model_fields)
            hint = closest(name, known) or f"; known keys: {', '.join(known)}"
            return f"unknown key {key} = {_shown(value)}{hint}"
        case "missing":
            return f"{key} is missing" + (f": {allowed}" if allowed else "")
        case "union_tag_not_found":
            return f"{key}.kind is missing: allowed {', '.join(_tags(field))}"
        case "union_tag_invalid":
            tag, tags = str(context["tag"]), _tags(field)
            return f'{key}.kind = "{tag}": allowed {", ".join(tags)}{closest(tag, tags)}'
        case "literal_error":
            names = [] if field is None else list(get_args(field.annotation))
            hint = closest(value, names) if isinstance(value, str) else ""
            return f"{key} = {_shown(value)}: allowed {', '.join(names)}{hint}"
        case "value_error":
            reason = str(context["error"])
            if not key:
                return reason
            return f"{key}: {reason}" if isinstance(value, dict) else f"{key} = {_shown(value)}: {reason}"
    shown = f"{_shown(value)}{unit}" if isinstance(value, int | float) else _shown(value)
    return f"{key} = {shown}: {allowed or _expected(field) or item['msg']}"


def _locate(
    model: type[BaseModel], location: tuple[int | str, ...]
) -> tuple[str, type[BaseModel], FieldInfo | None]:
    """Key path as in the file, the table that holds the key, and its field (None if unknown)."""
    key, owner, field = "", model, None
    inner: list[type[BaseModel]] = [model]  # tables that the next key may belong to
    ways: list[str] = []  # forms of the value ("number", "table"): in pydantic's path, not in the file
    for part in location:
        if isinstance(part, int):
            key += f"[{part}]"
            continue
        if part in ways:
            ways = []
            continue
        tagged = [table for table in inner if _tag(table) == part]
        if tagged and len(inner) > 1:  # the kind of a section stands in pydantic's path, not in the file
            inner, field = tagged, None
            continue
        if not inner:  # a form of a value with several, such as a text or a number
            break
        owner = inner[0]
        key += f".{part}" if key else part
        field = owner.model_fields.get(part)
        if field is None:
            break
        inner, ways = _tables(field.annotation), _ways(field.annotation)
    return key, owner, field


def _tables(annotation: Any) -> list[type[BaseModel]]:
    """The models inside a type."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [table for inner in get_args(annotation) for table in _tables(inner)]


def _ways(annotation: Any) -> list[str]:
    """The tags of a type with several forms, such as a number or a table."""
    if isinstance(annotation, Tag):
        return [annotation.tag]
    return [tag for part in get_args(annotation) for tag in _ways(part)]


def _tag(table: type[BaseModel]) -> str | None:
    """The kind of a section model."""
    field = table.model_fields.get("kind")
    return None if field is None else str(field.default)


def _tags(field: FieldInfo | None) -> list[str]:
    """All kinds of a field."""
    tables = [] if field is None else _tables(field.annotation)
    return [str(_tag(table)) for table in tables]


def _expected(field: FieldInfo | None) -> str:
    """Allowed values of a field without a range, in words."""
    if field is None:
        return ""
    if _tables(field.annotation):
        return "allowed a table"
    kinds = set(_kinds(field.annotation))
    words = [word for kind, word in _WORDS.items() if kind in kinds]
    return f"allowed {' or '.join(words)}" if words else "allowed a text"


_WORDS: dict[Any, str] = {bool: "true or false", int: "a whole number", float: "a number", str: "a text"}


def _kinds(annotation: Any) -> list[Any]:
    """The plain types inside a type."""
    inner = [kind for part in get_args(annotation) for kind in _kinds(part)]
    return inner or [annotation]


def _shown(value: Any) -> str:
    """A value as in a file, shortened if long."""
    if isinstance(value, float):
        return f"{value:g}"
    try:
        text = json.dumps(value)
    except TypeError:
        text = str(value)
    return text if len(text) <= 60 else text[:57] + "..."
