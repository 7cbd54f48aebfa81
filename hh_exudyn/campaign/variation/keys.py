"""A value at a key of a campaign's file: ``gauge.deviation_mm``, ``season.dry.share_percent``.

A key is a path through the tables. An item of a list is named by its ``name``, or by its number from 0 in
brackets (``season[2]``), as in a case (`hh_exudyn.case.overrides`). Behind the vehicle of a running stands a
number of it, ``running.loaded.vehicle.wedge.friction``.
"""

import re
from collections.abc import Sequence
from typing import Any

from vehicles.variants import find_variant

VEHICLE = "vehicle"
_STEP = re.compile(r"([^.\[\]]+)|\[(\d+)\]")


def steps_of(key: str) -> tuple[str | int, ...]:
    """The steps of a path: names of tables, names or numbers of items.

    Parameters
    ----------
    key
        With dots and brackets.

    Raises
    ------
    ValueError
        It is empty, or has dots and brackets that name nothing.
    """
    found = _STEP.findall(key)
    whole = "".join(f"[{number}]" if number else f".{name}" for name, number in found)
    if not found or whole.lstrip(".") != key.strip():
        raise ValueError(f"{key!r}: allowed names with dots between them, and [0] for an item of a list")
    return tuple(name.strip() or int(number) for name, number in found)


def put(entries: dict[str, Any], key: str, value: Any) -> None:
    """Set the value at a key; tables that are not there are made, items of lists are not.

    Parameters
    ----------
    entries
        Tables of the file; changed.
    key
        As above.
    value
        As in the file.

    Raises
    ------
    ValueError
        There is no such item (the message has their names), or something that is no table stands in the way.
    """
    steps = steps_of(key)
    here: Any = entries
    for place, step in enumerate(steps[:-1]):
        if step == VEHICLE and isinstance(here, dict) and isinstance(here.get(VEHICLE), str):
            here[VEHICLE] = find_variant(here[VEHICLE]).to_table()
        here = _inside(here, step, steps[: place + 1], key)
    if isinstance(here, list):
        here[_item(here, steps[-1], steps[:-1], key)] = value
    elif isinstance(here, dict):
        here[str(steps[-1])] = value
    else:
        raise ValueError(f"{key}: {_shown(steps[:-1])} is {here!r}, no table")


def found_at(entries: dict[str, Any], key: str) -> Any:
    """What stands at a key; ValueError as `put`, or where nothing does."""
    here: Any = entries
    steps = steps_of(key)
    for place, step in enumerate(steps):
        if isinstance(here, dict) and step not in here:
            raise ValueError(f"{key}: there is no {_shown(steps[: place + 1])}; there are {', '.join(here)}")
        here = _inside(here, step, steps[: place + 1], key)
    return here


def _inside(here: Any, step: str | int, path: Sequence[str | int], key: str) -> Any:
    """The table, list or value one step further."""
    if isinstance(here, list):
        return here[_item(here, step, path[:-1], key)]
    if not isinstance(here, dict):
        raise ValueError(f"{key}: {_shown(path[:-1])} is {here!r}, no table")
    return here.setdefault(str(step), {})


def _item(items: list[Any], step: str | int, path: Sequence[str | int], key: str) -> int:
    """Index of an item by its number or its name."""
    if isinstance(step, int):
        if step < len(items):
            return step
        raise ValueError(f"{key}: {_shown(path)} has {len(items)} items, counted from 0")
    names = [item.get("name") if isinstance(item, dict) else None for item in items]
    if step in names:
        return names.index(step)
    known = ", ".join(str(name) for name in names if name is not None) or "numbers in brackets"
    raise ValueError(f"{key}: {_shown(path)} has no {step!r}: allowed {known}")


def _shown(path: Sequence[str | int]) -> str:
    return "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in path).lstrip(".")
