"""Channels of recording cars by the names of their columns, and their conversion to the four signals.

A column is named by its quantity, perhaps with a side and a unit: ``level_mm``, ``longitudinal level left
[mm]``, ``Alignment R``, ``km``. Of left and right rail the mean is level and alignment, and the difference
(left less right of the alignment, right less left of the level) is what gauge and cross-level are without a
column of their own. Where both are there, the levels tell the sign of the cross-level, which half of the
recording cars count positive where the LEFT rail is higher. A gauge about the nominal one is the gauge
itself; its deviation is taken. Columns of other quantities (speed, twist, curvature) are passed over.
"""

import re
from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray

_NAMES = {
    "position": (
        "position", "chainage", "km", "kp", "pk", "station", "distance", "stationing", "kilometre",
        "kilometer",
    ),
    "level": (
        "level", "longitudinal level", "profile", "vertical profile", "vertical", "top", "surface",
        "vertical alignment",
    ),
    "alignment": ("alignment", "align", "lateral", "lateral alignment", "horizontal alignment"),
    "gauge": ("gauge", "gage", "track gauge", "gauge deviation"),
    "cross_level": ("cross level", "crosslevel", "xlevel", "x level"),
}  # fmt: skip
_SIDES = {"left": "left", "l": "left", "lh": "left", "right": "right", "r": "right", "rh": "right"}
_UNITS = {
    "mm": 1.0,
    "cm": 10.0,
    "m": 1e3,
    "in": 25.4,
    "inch": 25.4,
    "km": 1e6,
    "ft": 304.8,
    "mi": 1609344.0,
}  # mm
_UNIT = re.compile(r"[\[(]\s*([a-z]+)\s*[\])]|[_ /](mm|cm|m|km|in|ft|mi)$")
_ABSOLUTE = 0.06  # m from the nominal gauge: a median as near is the gauge itself
_TOLD = 0.3  # least correlation of the steps of cross-level and levels that tells the sign


@dataclass(frozen=True)
class Column:
    """What a column holds: ``level`` or ``level left``, and the factor to metres (position) or
    millimetres."""

    name: str
    factor: float


def column_of(cell: str, units: str = "") -> Column | None:
    """The column that a header names; None for another quantity.

    Parameters
    ----------
    cell : str
        Name of the column.
    units : str
        The cell below it in a second header line with units.
    """
    text = cell.strip("\"' ").lower()
    unit = units.strip("\"'[]() ").lower()
    if match := _UNIT.search(text):
        unit = unit or match[1] or match[2]
        text = _UNIT.sub(" ", text)
    words = re.findall(r"[a-z0-9]+", text)
    sides = {_SIDES[word] for word in words if word in _SIDES}
    base = " ".join(word for word in words if word not in _SIDES and word != "rail")
    name = next((key for key, names in _NAMES.items() if base in names), "")
    if not name or len(sides) > 1 or (sides and name not in ("level", "alignment")):
        return None
    if name == "position":
        usual = "km" if base in ("km", "kilometre", "kilometer") else "m"
        return Column(name, 1e-3 * _UNITS.get(unit or usual, 1e3))
    return Column(" ".join([name, *sides]), _UNITS.get(unit, 1.0))


def missing(names: list[str]) -> list[str]:
    """What of position and the four signals the columns do not give."""
    both = {name: {f"{name} left", f"{name} right"} <= set(names) for name in ("level", "alignment")}
    given = {
        "position": "position" in names,
        "level": "level" in names or both["level"],
        "alignment": "alignment" in names or both["alignment"],
        "gauge": "gauge" in names or both["alignment"],
        "cross_level": "cross_level" in names or both["level"],
    }
    return [name for name, there in given.items() if not there]


def signals_of(columns: dict[str, FloatArray], nominal_gauge: float) -> FloatArray:
    """Level, alignment, gauge and cross-level (n, 4) [mm] from the channels of a recording.

    Parameters
    ----------
    columns : dict
        Name to values [mm]; nothing is missing.
    nominal_gauge : float
        The gauge that deviations are counted from [m].
    """

    def mean(name: str) -> FloatArray:
        if name in columns:
            return columns[name]
        return 0.5 * (columns[f"{name} left"] + columns[f"{name} right"])

    sided = {"level left", "level right"} <= set(columns)
    across = columns["level right"] - columns["level left"] if sided else None
    cross_level = columns.get("cross_level", across)
    if cross_level is not None and across is not None and _opposed(cross_level, across):
        cross_level = -cross_level
    gauge = columns.get("gauge")
    if gauge is None:
        gauge = columns["alignment left"] - columns["alignment right"]
    elif abs(1e-3 * float(np.median(gauge)) - nominal_gauge) < _ABSOLUTE:
        gauge = gauge - 1e3 * nominal_gauge
    assert cross_level is not None  # the caller has asked `missing`
    return np.column_stack([mean("level"), mean("alignment"), gauge, cross_level])  # the order of `SIGNALS`


def _opposed(cross_level: FloatArray, across: FloatArray) -> bool:
    """Whether the cross-level has the opposite sign: by its steps, since it may hold the cant of curves."""
    one, other = np.diff(cross_level), np.diff(across)
    size = float(np.sqrt(np.sum(one**2) * np.sum(other**2)))
    return size > 0.0 and float(np.sum(one * other)) < -_TOLD * size
