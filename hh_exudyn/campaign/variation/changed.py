"""The text of a campaign's file with other values: all else as it was, without comments.

Paths in the file start at its folder, those among new values at the working directory; in the text all are
absolute. Where a list of tables has ``share_percent``, the shares that are not set make room, and keep their
proportions. A range of an assumed number that its new value leaves is dropped. The name of the campaign says
what was changed.
"""

import difflib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import tomli_w

from hh_exudyn.campaign.life.plan import OWN_TABLES
from hh_exudyn.campaign.variation.handy import HANDY, vehicle_of
from hh_exudyn.campaign.variation.keys import VEHICLE, found_at, put, steps_of
from hh_exudyn.campaign.variation.shares import SHARE, set_shares
from hh_exudyn.case.files import start_at
from hh_exudyn.case.matrix import variant_name
from hh_exudyn.case.vehicle import start_in
from hh_exudyn.text_files import read_toml

_RANGES = "ranges"


def changed_text(file: Path | str, changes: Mapping[str, Any]) -> str:
    """The text of a campaign's file with changes; the order of the changes does not matter.

    Parameters
    ----------
    file
        Of the campaign.
    changes
        Values by key: a path in the file (`hh_exudyn.campaign.variation.keys`), a name of
        `hh_exudyn.campaign.variation.handy`, or a number of the vehicles that have it, ``wedge.friction``.

    Raises
    ------
    ValueError
        The file cannot be read, a key is none of these, or a value is not allowed there; the reader of
        campaigns checks the text itself.
    """
    file = Path(file)
    entries = read_toml(file)
    _make_absolute(entries, file.parent)
    plain = {key: value for key, value in changes.items() if key not in HANDY}
    shares: dict[str, dict[int, float]] = {}
    for key in sorted(plain):
        for own in _keys(entries, key):
            _set(entries, own, plain[key], shares)
    for key in (key for key in HANDY if key in changes):
        for own, value in HANDY[key](entries, changes[key]).items():
            _set(entries, own, value, shares)
    for place, values in shares.items():
        set_shares(found_at(entries, place), values, place)
    _make_absolute(entries, Path.cwd())
    _drop_ranges(entries)
    entries["name"] = f"{entries.get('name')}, {variant_name(dict(sorted(changes.items())))}"
    return tomli_w.dumps(entries)


def _keys(entries: Mapping[str, Any], key: str) -> list[str]:
    """The paths that a key means: itself, or those of a number of the vehicles that have it."""
    if steps_of(key)[0] in (*entries, *OWN_TABLES):
        return [key]
    numbers = {
        index: [one.name for one in vehicle_of(running).parameters().parameters]
        for index, running in enumerate(entries["running"])
    }
    found = [f"running[{index}].{VEHICLE}.{key}" for index, names in numbers.items() if key in names]
    if not found:
        known = {*_paths(entries), *HANDY, *(name for names in numbers.values() for name in names)}
        near = difflib.get_close_matches(key, sorted(known), n=3, cutoff=0.5)
        hint = f"; did you mean {' or '.join(near)}?" if near else ""
        tables = ", ".join(dict.fromkeys((*entries, *OWN_TABLES)))
        raise ValueError(
            f"unknown key {key}: allowed {', '.join(HANDY)}, a key in {tables}, "
            f"or a number of the vehicles{hint}"
        )
    return found


def _paths(entries: Mapping[str, Any], place: str = "") -> Iterator[str]:
    """Keys of the file, items of lists by name."""
    for name, value in entries.items():
        path = f"{place}{name}"
        if isinstance(value, dict):
            yield from _paths(value, f"{path}.")
        elif isinstance(value, list) and value and all(isinstance(item, dict) for item in value):
            for item in value:
                yield from _paths(item, f"{path}.{item.get('name')}.")
        else:
            yield path


def _set(entries: dict[str, Any], key: str, value: Any, shares: dict[str, dict[int, float]]) -> None:
    """Set a value at once, or note a share of a list of tables, which are set together."""
    place = key.removesuffix(f".{SHARE}")
    if place == key or not isinstance(items := _list_of(entries, place), list):
        put(entries, key, value)
        return
    item = found_at(entries, place)
    of = place[: place.rindex("[")] if place.endswith("]") else place[: place.rindex(".")]
    shares.setdefault(of, {})[next(i for i, one in enumerate(items) if one is item)] = value


def _list_of(entries: dict[str, Any], place: str) -> Any:
    """What an item stands in; None for a table of its own."""
    cut = max(place.rfind("["), place.rfind("."))
    return found_at(entries, place[:cut]) if cut > 0 else None


def _make_absolute(entries: dict[str, Any], folder: Path) -> None:
    """Let relative paths of line, vehicles, profiles and recordings start at a folder."""
    folder = folder.resolve()
    line = entries.get("line")
    if isinstance(line, str) and (folder / line).is_file():
        entries["line"] = str((folder / line).resolve())
    case, runnings = entries.get("case"), entries.get("running")
    if isinstance(case, dict):
        start_at(folder, case)
    for running in runnings if isinstance(runnings, list) else ():
        if isinstance(running, dict):
            start_in(folder, running)


def _drop_ranges(entries: Any) -> None:
    """Drop ranges that do not hold their numbers any more."""
    if isinstance(entries, list):
        for item in entries:
            _drop_ranges(item)
    if not isinstance(entries, dict):
        return
    ranges = entries.get(_RANGES)
    if isinstance(ranges, dict):
        for name, (low, high) in list(ranges.items()):
            value = entries.get(name)
            if isinstance(value, int | float) and not low <= value <= high:
                del ranges[name]
    for name, inner in entries.items():
        if name != _RANGES:
            _drop_ranges(inner)
