"""Measured irregularities from a CSV file: position [m], then level, alignment, gauge, cross-level [mm].

Columns are separated by commas, semicolons, tabs or blanks; decimals have a point, or a comma where other
separators stand between the columns. ``#`` starts a comment. A header line may name the columns (``position,
level, alignment, gauge, cross_level``, or those of left and right rail: `channels`) and their units (``_mm``,
``[m]``, ``(km)``, or a line of units below), then they may stand in any order; without it they stand in this
one, in metres and millimetres. Signs are those of `track.irregularity.irregularity`, left and right as seen
in the order of the rows; `signs` converts those of other recording cars. Gauge is the deviation from nominal,
or the gauge itself. Chainage may fall: the rows are in the order of the run.

Nothing is repaired: gaps, missing values, other units and uneven spacing are errors with line and column.
"""

import re
from itertools import zip_longest
from pathlib import Path

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.conventions import NOMINAL_GAUGE
from hh_exudyn.number_lines import has_decimal_commas
from hh_exudyn.number_lines import number as parsed
from hh_exudyn.text_files import read_text
from track.irregularity.channels import Column, column_of, missing, signals_of
from track.irregularity.irregularity import Irregularity
from track.irregularity.spectra import SIGNALS

COLUMNS = ("position", *SIGNALS)

_LARGEST = 100.0  # mm; the limits for immediate action are far below (EN 13848-5)
_LEAST = 0.1  # mm, least maximum of a signal: 0.1 read as metres would be a track out of use
_SPACING = (0.01, 10.0)  # m
_GAP = 1.5  # spacings; a larger step has lost samples
_UNEVEN = 0.1  # allowed deviation of a step over the spacing: positions are rounded to centimetres
_LEAST_ROWS = 10


def read_irregularity(
    path: str | Path,
    *,
    start: float | None = None,
    signs: tuple[int, int, int, int] = (1, 1, 1, 1),
    nominal_gauge: float = NOMINAL_GAUGE,
) -> Irregularity:
    """Read measured irregularities.

    Parameters
    ----------
    path : str or Path
        The file.
    start : float or None
        Arc length of the first sample [m]; None takes its position in the file.
    signs : four of +1 or -1
        Factors of level, alignment, gauge and cross-level.
    nominal_gauge : float
        What the deviation of a gauge is counted from, where the column is the gauge itself [m].

    Raises
    ------
    ValueError
        A line that has not five numbers, values that are missing or NaN, positions that run backwards, leave
        gaps or are uneven, values or positions in another unit (by their magnitude), fewer than 10 lines, or
        a header without the needed names. The message names file, line and column.
    """
    path = Path(path)
    if len(signs) != len(SIGNALS) or any(sign not in (-1, 1) for sign in signs):
        raise ValueError(f"signs is {signs}, it must be four of 1 or -1")
    lines, names, rows = _recorded(path)
    position = rows[:, names.index("position")]
    first = float(position[0]) if start is None else start
    if position[-1] < position[0]:  # recorded against the chainage: the rows are in the order of the run
        position = -position
    _check_positions(path, lines, position)
    channels = {name: column for name, column in zip(names, rows.T, strict=True) if name != "position"}
    values = signals_of(channels, nominal_gauge)
    _check_magnitudes(path, lines, values)
    step = float(position[-1] - position[0]) / (len(position) - 1)
    return Irregularity(first, step, 1e-3 * values * np.array(signs, dtype=float))


def _recorded(path: Path) -> tuple[list[int], list[str], FloatArray]:
    """Line numbers, names of the columns and (n, columns) numbers of a file, in metres and millimetres."""
    content = [
        (number, line.split("#")[0].strip()) for number, line in enumerate(read_text(path).splitlines(), 1)
    ]
    content = [(number, line) for number, line in content if line]
    try:
        commas = has_decimal_commas([line for _, line in content if re.match(r"[-+.\d\"]", line)])
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    columns: list[Column | None] = [Column(name, 1.0) for name in COLUMNS]
    first = 0
    if content and re.match(r"[A-Za-z_\"']", content[0][1]) and not content[0][1].lower().startswith("nan"):
        number, line = content[0]
        below = _cells(content[1][1]) if len(content) > 1 else []
        has_units = bool(below) and all(
            re.fullmatch(r"[\[(]?([kmc]?m|in|inch|ft|mi)[\])]?|-|", c.lower()) for c in below
        )
        columns = _columns(path, number, _cells(line), below if has_units else [])
        first = 2 if has_units else 1
    rows = [_row(path, number, _cells(line, commas), columns) for number, line in content[first:]]
    if len(rows) < _LEAST_ROWS:
        raise ValueError(f"{path} has {len(rows)} lines of numbers, at least {_LEAST_ROWS} are needed")
    names = [column.name for column in columns if column is not None]
    factors = np.array([column.factor for column in columns if column is not None])
    return [number for number, _ in content[first:]], names, np.array(rows) * factors


def _cells(content: str, decimal_commas: bool = False) -> list[str]:
    """The columns of one line."""
    if decimal_commas:
        content = re.sub(r"(?<=\d),(?=\d)", ".", content)
    for separator in (";", "\t", ","):
        if separator in content:
            return [cell.strip("\"' ") for cell in content.split(separator)]
    return content.split()


def _columns(path: Path, number: int, cells: list[str], units: list[str]) -> list[Column | None]:
    """What each column of a header line holds."""
    columns = [column_of(cell, unit) for cell, unit in zip_longest(cells, units[: len(cells)], fillvalue="")]
    names = [column.name for column in columns if column is not None]
    shown = ", ".join(re.sub(r"[ -]", "_", re.sub(r"_mm?$", "", cell.lower())) for cell in cells)
    if missing(names):
        raise ValueError(
            f"{path}, line {number}: the header names {shown}; it must name {', '.join(COLUMNS)} (level and "
            "alignment perhaps left and right)"
        )
    for name in names:
        if names.count(name) > 1:
            raise ValueError(
                f"{path}, line {number}: {names.count(name)} columns hold the {name}, allowed is 1"
            )
    return columns


def _row(path: Path, number: int, cells: list[str], columns: list[Column | None]) -> list[float]:
    """The numbers of one line in the columns that are used."""
    if len(cells) != len(columns):
        names = ", ".join("another" if column is None else column.name for column in columns)
        raise ValueError(
            f"{path}, line {number}: {len(cells)} columns, there must be {len(columns)}: {names}"
        )
    row = []
    for at, column in enumerate(columns):
        if column is None:
            continue
        where = f"{path}, line {number}, column {at + 1} ({column.name})"
        if not cells[at]:
            raise ValueError(f"{where}: no value")
        value = parsed(cells[at])
        if value is None:
            raise ValueError(f"{where}: {cells[at]!r} is not a number")
        if not np.isfinite(value):
            raise ValueError(f"{where}: {cells[at]} is not a finite number")
        row.append(value)
    return row


def _check_positions(path: Path, lines: list[int], position: FloatArray) -> None:
    """Raise ValueError unless positions run forwards in equal steps of metres."""
    steps = np.diff(position)
    spacing = float(np.median(steps))
    backwards = np.flatnonzero(steps <= 0.0)
    if backwards.size:
        i = int(backwards[0])
        raise ValueError(
            f"{path}, line {lines[i + 1]}, column position: {position[i + 1]:.10g} m does not lie ahead of "
            f"{position[i]:.10g} m on line {lines[i]}"
        )
    if not _SPACING[0] <= spacing <= _SPACING[1]:
        guess = "kilometres" if spacing < _SPACING[0] else "millimetres"
        raise ValueError(
            f"{path}, column position: the spacing is {spacing:g} m, allowed are {_SPACING[0]:g} to "
            f"{_SPACING[1]:g} m; are these {guess}?"
        )
    gaps = np.flatnonzero(steps > _GAP * spacing)
    if gaps.size:
        i = int(gaps[0])
        raise ValueError(
            f"{path}, line {lines[i + 1]}, column position: a gap of {steps[i]:.6g} m after "
            f"{position[i]:.10g} m (the spacing is {spacing:g} m; {gaps.size} such in the file)"
        )
    uneven = np.flatnonzero(np.abs(steps - spacing) > _UNEVEN * spacing)
    if uneven.size:
        i = int(uneven[0])
        raise ValueError(
            f"{path}, line {lines[i + 1]}, column position: a step of {steps[i]:.6g} m where the spacing is "
            f"{spacing:g} m, allowed are 10 % more or less ({uneven.size} such in the file): resample it"
        )


def _check_magnitudes(path: Path, lines: list[int], values: FloatArray) -> None:
    """Raise ValueError for values that cannot be millimetres."""
    for name, column in zip(SIGNALS, values.T, strict=True):
        at = int(np.argmax(np.abs(column)))
        largest = float(column[at])
        where = f"{path}, line {lines[at]}, column {name}"
        if abs(largest) > _LARGEST:
            raise ValueError(
                f"{where}: {largest:g} mm, allowed are {-_LARGEST:g} to {_LARGEST:g} mm; is this another "
                "unit?"
            )
        if 0.0 < abs(largest) < _LEAST:
            raise ValueError(
                f"{where}: {largest:g} mm is the largest of its column, some value must reach {_LEAST:g} mm; "
                "are these metres?"
            )
