"""An alignment from a CSV table, one section a row.

Columns, their units in their names:

    length_m            length of the section
    curvature_1_per_m   positive to the left, OR
    radius_m, hand      hand left, right or straight (then radius_m is empty)
    cant_mm             >= 0, the outer rail is higher; default 0; where a straight has cant, because a ramp
                        begins ahead of its transition or ends behind it, the outer rail is that of the next
                        curve, behind the last one of the curve before
    gradient_per_mille  positive uphill; default 0
    gauge_mm            default: the nominal gauge
    start_m             arc length at which the section begins, only to check for gaps and overlaps

A row's values hold AT ITS END: over its length they change linearly from those of the row before. So a row
with the values of the row before is a straight or curve, one with other values a transition (clothoid, cant
ramp, gauge ramp, vertical curve); the first row is constant. Compound and reverse curves are written the same
way. No value can jump.
"""

import math
from pathlib import Path

from hh_exudyn.conventions import NOMINAL_GAUGE
from track.course.alignment import Alignment
from track.course.sections import (
    CANT,
    CURVATURE,
    GAUGE,
    GRADIENT,
    HANDS,
    LENGTH,
    RADIUS,
    Curve,
    Grade,
    Ramp,
    Section,
    State,
    Straight,
)
from track.csv_columns import CsvRow, read_columns

_OPTIONAL = ("curvature_1_per_m", "radius_m", "hand", "cant_mm", "gradient_per_mille", "gauge_mm", "start_m")
_CLOSE = 1e-3  # m, tolerance of start_m
# least largest value of a column that is not all zero; a smaller one is in another unit
_LEAST_CANT_MM = 1.0
_LEAST_GRADIENT_PER_MILLE = 0.1


def read_alignment_csv(
    path: str | Path, step: float = 0.5, blend: float = 0.5, nominal_gauge: float = NOMINAL_GAUGE
) -> Alignment:
    """The alignment that a CSV table describes (see the module for its columns).

    Parameters
    ----------
    path : the file
    step, blend : as in `Alignment` [m]
    nominal_gauge : where there is no column for the gauge [m]

    Raises
    ------
    ValueError
        Unknown or missing columns, fields that are empty, no numbers or out of range, cant without curve,
        gaps or overlaps, values of the size of another unit: with line, name, value and
        what is allowed.
    """
    rows = read_columns(path, ("length_m",), _OPTIONAL)
    _check_columns(rows[0])
    radii = [_radius(row) for row in rows]
    hands = _hands(rows, radii)
    states = [
        _state(row, radius, hand, nominal_gauge) for row, radius, hand in zip(rows, radii, hands, strict=True)
    ]
    _check_units(rows)
    sections: list[Section] = []
    grades: list[Grade] = []
    start = _start(rows[0], 0.0)
    for i, row in enumerate(rows):
        length = row.number("length_m", *LENGTH)
        found = _start(row, start)
        if abs(found - start) > _CLOSE:
            kind = "gap" if found > start else "overlap"
            raise row.error(
                f"start_m is {found:g}, allowed is {start:g} where the row before ends: "
                f"{kind} of {abs(found - start):g} m"
            )
        start += length
        gradient, before = _gradient(row), _gradient(rows[max(i - 1, 0)])
        try:
            sections.append(_section(length, states[max(i - 1, 0)], states[i], radii[i]))
            grades.append(Grade(length, before, None if before == gradient else gradient))
        except ValueError as error:
            raise row.error(str(error)) from None
    return Alignment(tuple(sections), step, grades=tuple(grades), blend=blend)


def _section(length: float, first: State, last: State, radius: float) -> Section:
    """A straight or a curve where the values are constant, else a ramp."""
    if first != last:
        return Ramp(length, *zip(first, last, strict=True))
    _, cant, gauge = last
    if math.isinf(radius) and cant:
        return Ramp(length, *zip(first, last, strict=True))
    if math.isinf(radius):
        return Straight(length, gauge)
    return Curve(length, abs(radius), "left" if radius > 0.0 else "right", abs(cant), gauge)


def _check_columns(row: CsvRow) -> None:
    """Raise ValueError unless curvature is given in exactly one way."""
    names = row.fields
    if ("curvature_1_per_m" in names) == ("radius_m" in names):
        raise row.error("give either column curvature_1_per_m or columns radius_m and hand")
    if ("radius_m" in names) != ("hand" in names):
        raise row.error("columns radius_m and hand are needed together")


def _radius(row: CsvRow) -> float:
    """Radius at the end of the row [m], positive to the left, infinite where the track is straight."""
    if "curvature_1_per_m" in row.fields:
        value = row.number("curvature_1_per_m", *CURVATURE)
        if value != 0.0 and abs(value) * RADIUS[1] < 1.0:
            raise row.error(
                f"curvature_1_per_m is {value:g}, allowed are 0 and radii of {RADIUS[0]:g} to {RADIUS[1]:g} m"
            )
        return 1.0 / value if value else math.inf
    hand = row.fields["hand"]
    if hand == "straight":
        if row.fields["radius_m"]:
            raise row.error(f"radius_m is {row.fields['radius_m']} in a straight, allowed is an empty field")
        return math.inf
    if hand not in HANDS:
        raise row.error(f"hand is {hand!r}, allowed are left, right and straight")
    return HANDS[hand] * row.number("radius_m", *RADIUS)


def _hands(rows: list[CsvRow], radii: list[float]) -> list[int]:
    """+1 or -1 for each row: the hand of its own curve, else of the curves on both sides; 0 without any.

    Raises ValueError for cant on a straight between curves of different hands.
    """
    own = [0 if math.isinf(radius) else 1 if radius > 0.0 else -1 for radius in radii]
    before, behind = list(own), list(own)
    for i in range(1, len(own)):
        before[i] = own[i] or before[i - 1]
    for i in reversed(range(len(own) - 1)):
        behind[i] = own[i] or behind[i + 1]
    for row, one, other in zip(rows, before, behind, strict=True):
        if one * other < 0 and "cant_mm" in row.fields and row.number("cant_mm", -1e9, 1e9) != 0.0:
            raise row.error(
                f"cant_mm is {row.fields['cant_mm']} on the straight between curves of different hands, "
                "allowed is 0: which rail is raised?"
            )
    return [other or one for one, other in zip(before, behind, strict=True)]


def _state(row: CsvRow, radius: float, hand: int, nominal_gauge: float) -> State:
    """Curvature, signed cant and gauge at the end of the row; `hand` says which rail cant raises."""
    cant = row.number("cant_mm", CANT[0] * 1000, CANT[1] * 1000) / 1000 if "cant_mm" in row.fields else 0.0
    gauge = nominal_gauge
    if "gauge_mm" in row.fields:
        gauge = row.number("gauge_mm", GAUGE[0] * 1000, GAUGE[1] * 1000) / 1000
    if cant > 0.0 and not hand:
        raise row.error(f"cant_mm is {cant * 1000:g} without any curve, allowed is 0")
    return 1.0 / radius, -cant if hand < 0 else cant, gauge


def _gradient(row: CsvRow) -> float:
    """Gradient at the end of the row [-]."""
    if "gradient_per_mille" not in row.fields:
        return 0.0
    return row.number("gradient_per_mille", GRADIENT[0] * 1000, GRADIENT[1] * 1000) / 1000


def _start(row: CsvRow, expected: float) -> float:
    """Start of the row by its column start_m [m]; `expected` where that is empty."""
    return row.number("start_m", -1e7, 1e7) if "start_m" in row.fields else expected


def _check_units(rows: list[CsvRow]) -> None:
    """Raise ValueError for metres as millimetres or slopes as per mille, by the largest value of a column."""
    for name, least, other in (
        ("cant_mm", _LEAST_CANT_MM, "metres"),
        ("gradient_per_mille", _LEAST_GRADIENT_PER_MILLE, "a slope without unit"),
    ):
        if name not in rows[0].fields:
            continue
        top = max(rows, key=lambda row: abs(row.number(name, -1e4, 1e4)))
        largest = abs(top.number(name, -1e4, 1e4))
        if 0.0 < largest < least:
            raise top.error(
                f"{name} is {largest:g} at most in the table, allowed is 0 or a largest value from "
                f"{least:g}: given in {other}?"
            )
