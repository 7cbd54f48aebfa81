"""VAMPIRE's wheel and rail profiles (``.whe``, ``.rai``).

Four lines, then rows of four numbers in millimetres: y and z of the left side, y and z of the right one, both
from the centre of the wheelset or track, y positive to the right.

=================================================  ==========================================================
``WHEELPROFILE``                                   ``RAILPROFILE``
title                                              title
``TREADDATUM`` EUROPEAN, US1, US2 or CUSTOM y      ``GAUGEPOINT`` EUROPEAN, US or CUSTOM depth
``FLANGEBACK`` distance of the flange backs        ``GAUGE`` gauge
=================================================  ==========================================================

The tread datum is the running circle's distance from the flange back: 70 mm, 2 27/32 in or 3 1/16 in. Source:
the reader of CONTACT (V-Tech CMCC, 2023, Apache-2.0). A wheel is placed by its flange back, so its running
circle is the toolkit's, 70 mm from there, whatever the file's datum; a rail keeps y from the track's centre.
"""

import re
from pathlib import Path

import numpy as np

from hh_exudyn.contact.profiles.points import VAMPIRE, RawPoints, plain_line, table
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE
from hh_exudyn.number_lines import leading_numbers

FIRST_LINE = re.compile(r"^\s*(WHEEL|RAIL)PROFILE\s*$", re.IGNORECASE)

_INCH = 25.4  # mm
_DATUM = {"EUROPEAN": 70.0, "US1": (2 + 27 / 32) * _INCH, "US2": (3 + 1 / 16) * _INCH}  # mm
_USUAL = 1e3 * FLANGE_BACK_TO_RUNNING_CIRCLE  # mm
_SAME = 0.01  # mm, largest difference of two equal sides


def read_vampire(path: Path, text: list[str], side: str | None) -> RawPoints:
    """One side of a VAMPIRE profile.

    Arguments: see the map of this folder.

    Parameters
    ----------
    side : str or None
        ``"left"`` or ``"right"``; None where both are the same.

    Raises
    ------
    ValueError
        Another form, or sides that differ and no `side`.
    """
    first = next(n for n, line in enumerate(text) if line.strip())
    match = FIRST_LINE.match(text[first])
    kind = match[1].lower() if match else ""
    datum, distance = ("TREADDATUM", "FLANGEBACK") if kind == "wheel" else ("GAUGEPOINT", "GAUGE")
    header = {"title": "".join(text[first + 1 : first + 2]).strip()}
    for n, key in ((first + 3, datum), (first + 4, distance)):
        line = "".join(text[n - 1 : n]).strip()
        if not line.upper().startswith(key):
            raise ValueError(f"profile {path}, line {n}: expected {key} with its value, got {line[:60]!r}")
        header[key] = line[len(key) :].strip()
    lines = [plain_line(n, line) for n, line in enumerate(text[first + 4 :], start=first + 5)]
    expected = "four numbers, y and z of the left and the right side in mm"
    right = table(path, lines, range(4, 5), (2, 3), expected)
    left = table(path, lines, range(4, 5), (0, 1), expected)
    differ = float(np.max(np.hypot(right[0] + left[0], right[1] - left[1]), initial=0.0))
    if side is None and differ > _SAME:
        raise ValueError(
            f"profile {path}: left and right side differ by up to {differ:.3g} mm; say which one: "
            "side 'left' or 'right'"
        )
    y, z, numbers = (-left[0], *left[1:]) if side == "left" else right
    notes = [] if side is None else [f"the {side} side"]
    if kind == "rail":
        return RawPoints(VAMPIRE, kind, y, z, numbers, header, tuple(notes))
    back = 0.5 * _value(path, first + 4, header[distance])
    running = _tread_datum(path, first + 3, header[datum])
    if running != _USUAL:
        notes.append(f"running circle {_USUAL:g} mm from the flange back, in the file {running:g} mm")
    return RawPoints(VAMPIRE, kind, y - back - _USUAL, z, numbers, header, tuple(notes))


def _tread_datum(path: Path, line: int, text: str) -> float:
    """Distance of the running circle from the flange back [mm]."""
    word, _, rest = text.partition(" ")
    if word.upper() == "CUSTOM":
        return _value(path, line, rest)
    if word.upper() not in _DATUM:
        raise ValueError(
            f"profile {path}, line {line}: TREADDATUM {text[:40]!r}, allowed {', '.join(_DATUM)}, CUSTOM y"
        )
    return _DATUM[word.upper()]


def _value(path: Path, line: int, text: str) -> float:
    """The number that a header's value begins with [mm]."""
    values, _ = leading_numbers(text)
    if not values or not 0.0 < values[0] < 5000.0:
        raise ValueError(f"profile {path}, line {line}: {text[:40]!r}, allowed a number of millimetres")
    return values[0]
