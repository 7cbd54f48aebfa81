"""Profiles as plain tables: two columns, with or without a header that names them and their unit.

Lines before the first number are a header. One that names the columns (``y_mm,z_mm``; ``Y [m]; Z [m]``; ``x
y`` with x lateral and y vertical) says which columns are read and their unit: mm, cm, m, in. A header line
with one whole number is the number of points. Without names there are two columns, perhaps behind a column
that counts the points.
"""

import re
from itertools import pairwise
from pathlib import Path

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.points import (
    TWO_COLUMN,
    Line,
    RawPoints,
    decimal_commas,
    plain_line,
    switched_off,
    table,
)
from hh_exudyn.number_lines import leading_numbers

UNITS = {
    "mm": 1.0, "millimetre": 1.0, "millimeter": 1.0, "millimetres": 1.0, "millimeters": 1.0,
    "cm": 10.0, "m": 1e3, "metre": 1e3, "meter": 1e3, "metres": 1e3, "meters": 1e3,
    "in": 25.4, "inch": 25.4, "inches": 25.4, '"': 25.4,
}  # fmt: skip

_UNIT_OF = re.compile(r"\s*[\[(]\s*([\w\"]+)\s*[\])]|[_/](" + "|".join(sorted(UNITS, reverse=True)) + r")\b")
_STATED_UNIT = re.compile(r"\bunits?\b\W*(?:are|is|of length|in)?\W*([a-z]+)", re.IGNORECASE)
_LATERAL = ("y", "x", "lateral", "horizontal", "position", "pos", "yw", "yr")
_VERTICAL = ("z", "y", "vertical", "height", "zw", "zr")
_OTHER = (
    "x",
    "s",
    "n",
    "no",
    "nr",
    "i",
    "index",
    "point",
    "angle",
    "a",
    "curvature",
    "c",
    "slope",
    "weight",
    "w",
)
_LEAST_SECTION = 20  # points; a shorter block is no profile of its own


def read_two_columns(path: Path, text: list[str]) -> RawPoints:
    """The points of a table.

    Arguments: see the map of this folder.

    Raises
    ------
    ValueError
        A line of another form behind the first number, more than two columns that nothing names, several
        profiles in the file, another number of points than stated.
    """
    lines = [plain_line(n, line) for n, line in enumerate(text, start=1)]
    filled = [line for line in lines if line.text]
    commas = decimal_commas(path, [line for line in filled if leading_numbers(line.text)[0]])
    first = next(
        (k for k, line in enumerate(filled) if len(leading_numbers(line.text, commas)[0]) > 1), len(filled)
    )
    header, rows = filled[:first], filled[first:]
    if not rows and header:
        raise ValueError(
            f"profile {path}, line {header[0].number}: expected two numbers, y and z in mm, got "
            f"{header[0].text[:60]!r}"
        )
    counts = [len(leading_numbers(line.text, commas)[0]) for line in rows if not line.off]
    count = max(set(counts), key=counts.count) if counts else 2
    commented = [
        Line(n, line.lstrip("#!%/ ")) for n, line in enumerate(text, 1) if line.lstrip()[:1] in "#!%/"
    ]
    named = [found for line in (*header, *commented) if (found := _named(line.text, count))]
    columns, factor = named[-1] if named else (_unnamed(path, rows, count, commas), 1.0)
    expected = "two numbers, y and z in mm" if count == 2 else f"{count} numbers, as on the other lines"
    y, z, numbers = table(path, rows, range(count, count + 1), columns, expected)
    _check_sections(path, text, numbers, y)
    notes = switched_off(rows)
    if factor == 1.0:
        factor = _stated_unit([line.text for line in header])
    if factor != 1.0:
        notes.append(f"{factor:g} mm are the unit of the file")
    _check_count(path, header, len(y), len(notes))
    with np.errstate(over="ignore"):  # `reader` finds numbers that are not finite
        return RawPoints(TWO_COLUMN, None, factor * y, factor * z, numbers, notes=tuple(notes))


def _named(text: str, count: int) -> tuple[tuple[int, int], float] | None:
    """Columns and unit where a line names as many columns as there are; None otherwise."""
    names, factors = [], []
    marked = _UNIT_OF.sub(lambda match: f"\N{BULLET}{match[1] or match[2]}", text.lower())
    for word in re.split(r"[;,\s]+", marked.strip()):
        name, _, unit = word.strip("'\"").partition("\N{BULLET}")
        names.append(name)
        factors.append(UNITS.get(unit, 1.0) if unit else 1.0)
    if len(names) != count or not set(names) <= {*_LATERAL, *_VERTICAL, *_OTHER}:
        return None
    lateral = next((name for name in _LATERAL if name in names), "")
    if lateral == "y" and not set(names) & set(_VERTICAL) - {"y"}:  # x and y: x is lateral
        lateral = "x" if "x" in names else ""
    vertical = next((name for name in _VERTICAL if name in names and name != lateral), "")
    if not lateral or not vertical or len(set(names)) < len(names):
        return None
    return (names.index(lateral), names.index(vertical)), factors[names.index(lateral)]


def _unnamed(path: Path, rows: list[Line], count: int, commas: bool) -> tuple[int, int]:
    """The two columns of a table without names; a first column that counts the points is passed over."""
    if count <= 2:
        return 0, 1
    values = [leading_numbers(line.text, commas)[0] for line in rows if not line.off]
    begin = [row[0] for row in values if len(row) == count]
    if count == 3 and begin == list(range(int(begin[0]), int(begin[0]) + len(begin))):
        return 1, 2
    raise ValueError(
        f"profile {path}, line {rows[0].number}: {count} columns; allowed are two, y and z in mm, or a "
        "header line that names y and z"
    )


def _stated_unit(header: list[str]) -> float:
    """Millimetres of the unit that a header states in words or in a line of units; 1 where it states none."""
    for text in header:
        units = re.findall(r"[a-z]+", text.lower())
        if len(set(units)) == 1 and len(units) > 1 and units[0] in UNITS:
            return UNITS[units[0]]
        if (match := _STATED_UNIT.search(text)) and match[1].lower() in UNITS:
            return UNITS[match[1].lower()]
    return 1.0


def _check_count(path: Path, header: list[Line], points: int, off: int) -> None:
    """Check a line of the header that holds one whole number, the number of points."""
    for line in header:
        if re.fullmatch(r"\d{2,6}", line.text) and int(line.text) != points and not off:
            raise ValueError(
                f"profile {path}, line {line.number}: {line.text} points stated, {points} found: is the file "
                "cut off?"
            )


def _check_sections(path: Path, text: list[str], numbers: list[int], y: FloatArray) -> None:
    """Refuse a file with two profiles: two blocks apart by empty lines that lie at the same y."""
    starts = [0] + [
        k for k in range(1, len(numbers))
        if any(not line.strip() for line in text[numbers[k - 1] : numbers[k] - 1])
    ]  # fmt: skip
    blocks = [
        (numbers[a], y[a:b]) for a, b in zip(starts, [*starts[1:], len(y)], strict=True)
        if b - a >= _LEAST_SECTION and np.isfinite(y[a:b]).all()
    ]  # fmt: skip
    for (line, one), (other_line, other) in pairwise(blocks):
        common = min(one.max(), other.max()) - max(one.min(), other.min())
        if common > 0.5 * min(np.ptp(one), np.ptp(other)):
            raise ValueError(
                f"profile {path}: two profiles, from line {line} and from line {other_line}; allowed is one"
            )
