"""SIMPACK's profiles (``.prw``, ``.prr``).

y and z are those of a RIGHT wheel or rail, y outwards (away from the track centre), z DOWN, in the unit that
``units.len.f`` gives per metre, after the file's own shift, bounds and mirroring. A wheel's y is counted from
its running circle (Manchester benchmark) or from its flange back (worn wheels of CONTACT).
"""

import re
from pathlib import Path

import numpy as np

from hh_exudyn.contact.profiles.miniprof import header_number
from hh_exudyn.contact.profiles.points import SIMPACK, Line, RawPoints, table

FIRST_LINE = re.compile(r"^\s*(header|spline|point)\.begin\b", re.IGNORECASE)


def read_simpack(path: Path, text: list[str]) -> RawPoints:
    """``point.begin`` .. ``point.end`` inside keys with values; ``!`` and ``%`` start comments.

    Arguments: see the map of this folder.
    """
    header: dict[str, str] = {}
    rows: list[Line] = []
    section = ""
    inside = ended = False
    for number, line in enumerate(text, start=1):
        line = re.split("[!%]", line)[0].strip()
        word = line.lower()
        if word == "point.begin":
            if inside or ended:
                raise ValueError(f"profile {path}, line {number}: a second point.begin, allowed one")
            inside = True
        elif word == "point.end":
            inside, ended = False, True
        elif inside and line:
            rows.append(Line(number, line))
        elif word in ("header.begin", "spline.begin"):
            section = word.partition(".")[0] + "."
        elif "=" in line:
            key, _, value = line.partition("=")
            header[section + key.strip()] = value.strip().strip("'\"")
    if not ended:
        raise ValueError(f"profile {path}: no point.begin .. point.end: is the file cut off?")
    y, z, lines = table(path, rows, range(2, 4), (0, 1), "y, z and at most a weight")
    kinds = {"0": "rail", "1": "wheel"}
    kind = header.get("header.type", "")
    if kind not in ("", *kinds):
        raise ValueError(f"profile {path}: header type = {kind[:40]!r}, allowed 0 (rail) and 1 (wheel)")

    def number_of(key: str, default: float = 0.0) -> float:
        return header_number(path, header, "spline." + key, default)

    per_metre = number_of("units.len.f", 1000.0)
    if not 1e-3 <= per_metre <= 1e9:
        raise ValueError(
            f"profile {path}: units.len.f = {per_metre:g} (units per metre), allowed 1e-3 .. 1e9"
        )
    if (angle := number_of("rotate")) != 0.0:
        raise ValueError(f"profile {path}: rotate = {angle:g}, allowed 0: turn the profile in SIMPACK first")
    notes = []
    shift_y, shift_z = number_of("shift.y"), number_of("shift.z")
    if shift_y or shift_z:
        y, z = y + shift_y, z + shift_z
        notes.append(f"moved by the file's shift.y = {shift_y:g}, shift.z = {shift_z:g}")
    in_bounds = np.ones(len(y), dtype=bool)
    for values, axis in ((y, "y"), (z, "z")):
        low, high = number_of(f"bound.{axis}.min", 1.0), number_of(f"bound.{axis}.max", 0.0)
        if low < high:  # otherwise the file has no bounds
            in_bounds &= ~((values < low) | (values > high))
    if not in_bounds.all():
        notes.append(f"{np.count_nonzero(~in_bounds)} points outside the file's bounds")
        y, z = y[in_bounds], z[in_bounds]
        lines = [number for number, good in zip(lines, in_bounds, strict=True) if good]
    for axis in ("y", "z"):
        if number_of(f"mirror.{axis}") == 1.0:
            y, z = (-y, z) if axis == "y" else (y, -z)
    with np.errstate(over="ignore"):  # `reader` finds numbers that are not finite
        y, z = y * (1000.0 / per_metre), z * (1000.0 / per_metre)
    return RawPoints(SIMPACK, kinds.get(kind), y, z, lines, header, tuple(notes))
