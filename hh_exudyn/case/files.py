"""Files of a case: under which keys a path may stand, and where relative paths start."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from hh_exudyn.case.fields import from_folder, is_path
from hh_exudyn.case.vehicle import start_in

_RAILS = ("rail", "rail_left", "rail_right", "rail_high", "rail_low")
_KEYS = ("wheel_profile", "irregularity", *_RAILS)  # with a name or the path of a file
_WHEELS = "wheel_profiles"


def start_at(folder: Path, data: dict[str, Any]) -> None:
    """Make the relative paths of a raw case start at its folder; names of profiles are unchanged.

    Parameters
    ----------
    folder : Path
        Of the case.
    data : dict
        The tables of its file, changed.
    """
    start_in(folder, data)
    for table, key in named_files(data):
        from_folder(table, folder, key)
    track = data.get("track")
    if isinstance(track, dict):
        from_folder(track, folder, "alignment", "centre_line")
        from_folder(track.get("centre_line"), folder, "file")


def named_files(data: dict[str, Any]) -> Iterator[tuple[dict[str, Any], str]]:
    """Tables and keys of a raw case under which a path stands where a name may stand too.

    Parameters
    ----------
    data : dict
        The tables of its file, perhaps malformed.
    """
    track = data.get("track")
    track = track if isinstance(track, dict) else {}
    sections = track.get("sections")
    tables: list[Any] = [data, track, *(sections if isinstance(sections, list | tuple) else ())]
    for table in tables:
        for key in _KEYS:
            if isinstance(table, dict) and isinstance(table.get(key), str) and is_path(table[key]):
                yield table, key
    wheels = data.get(_WHEELS)
    if isinstance(wheels, dict):
        for key in list(wheels):
            if isinstance(wheels[key], str) and is_path(wheels[key]):
                yield wheels, key
