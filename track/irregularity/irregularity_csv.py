"""Measured irregularities from a CSV file: position [m], then level, alignment, gauge, cross-level [mm].

Columns are separated by commas, semicolons, tabs or blanks; decimals have a point. ``#`` starts a comment.
A header line may name the columns (``position, level, alignment, gauge, cross_level``, with or without
``_m``, ``_mm``, ``[m]``, ``[mm]``), then they may stand in any order; without it they stand in this one.
Signs are those of `track.irregularity.irregularity`; `signs` converts those of other recording cars. Gauge is
the deviation from nominal.

Nothing is repaired: gaps, missing values, other units and uneven spacing are errors with line and column.
"""

import re
from pathlib import Path

import numpy as np

from hh_exudyn.arrays import FloatArray
from track.irregularity.irregularity import Irregularity
from track.irregularity.spectra import SIGNALS

COLUMNS = ("position", *SIGNALS)

_LARGEST = 100.0  # mm; the limits for immediate action are far below (EN 13848-5)
_LEAST = 0.1  # mm, least maximum of a signal: 0.1 read as metres would be a track out of use
_ABSOLUTE_GAUGE = (1400.0, 1500.0)  # mm
_SPACING = (0.01, 10.0)  # m
_GAP = 1.5  # spacings; a larger step has lost samples
_UNEVEN = 0.1  # allowed deviation of a step over the spacing: positions are rounded to centimetres
_LEAST_ROWS = 10


def read_irregularity(
    path: str | Path,
    *,
    start: float | None = None,
    signs: tuple[int, int, int, int] = (1, 1, 1, 1),
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

    Raises
    ------
    ValueError
        A line that has not five numbers, values that are missing or NaN, positions that run backwards, leave
        gaps or are uneven, values or positions in another unit (by their magnitude), fewer than 10 lines, or
        unknown names in the header. The message names file, line and column.
    OSError
        The file cannot be read.
    """
    path = Path(path)
    if len(signs) != len(SIGNALS) or any(sign not in (-1, 1) for sign in signs):
        raise ValueError(f"signs is {signs}, it must be four of 1 or -1")
    lines, rows = _numbers(path)
    position = rows[:, 0]
    _check_positions(path, lines, position)
    _check_magnitudes(path, lines, rows[:, 1:])
    step = float(position[-1] - position[0]) / (len(position) - 1)
    first = float(position[0]) if start is None else start
    return Irregularity(first, step, 1e-3 * rows[:, 1:] * np.array(signs, dtype=float))


def _numbers(path: Path) -> tuple[list[int], FloatArray]:
    """Line numbers and (n, 5) numbers of a file, in the order of `COLUMNS`."""
    order = list(range(len(COLUMNS)))
    lines: list[int] = []
    rows: list[list[float]] = []
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise ValueError(
            f"{path} is not a text file in UTF-8 ({error.reason} at byte {error.start})"
        ) from None
    fresh = True
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.split("#")[0].strip()
        if not content:
            continue
        cells = _cells(content)
        if fresh and re.match(r"[A-Za-z_\"']", content) and not content.lower().startswith("nan"):
            order = _order(path, number, cells)
        else:
            lines.append(number)
            rows.append(_row(path, number, cells, order))
        fresh = False
    if len(rows) < _LEAST_ROWS:
        raise ValueError(f"{path} has {len(rows)} lines of numbers, at least {_LEAST_ROWS} are needed")
    return lines, np.array(rows)


def _cells(content: str) -> list[str]:
    """The columns of one line."""
    for separator in (";", "\t", ","):
        if separator in content:
            return [cell.strip() for cell in content.split(separator)]
    return content.split()


def _order(path: Path, number: int, cells: list[str]) -> list[int]:
    """Position of each of `COLUMNS` in a header line."""
    names = []
    for cell in cells:
        name = re.sub(r"\[.*\]|\(.*\)", "", cell.strip("\"' ").lower()).strip()
        name = re.sub(r"_mm?$", "", name)
        names.append(re.sub(r"[ -]", "_", name))
    if sorted(names) != sorted(COLUMNS):
        raise ValueError(
            f"{path}, line {number}: the header names {', '.join(names)}; it must name {', '.join(COLUMNS)}"
        )
    return [names.index(name) for name in COLUMNS]


def _row(path: Path, number: int, cells: list[str], order: list[int]) -> list[float]:
    """The numbers of one line in the order of `COLUMNS`."""
    if len(cells) != len(COLUMNS):
        raise ValueError(
            f"{path}, line {number}: {len(cells)} columns, there must be {len(COLUMNS)}: {', '.join(COLUMNS)}"
        )
    row = []
    for name, at in zip(COLUMNS, order, strict=True):
        where = f"{path}, line {number}, column {at + 1} ({name})"
        if not cells[at]:
            raise ValueError(f"{where}: no value")
        try:
            value = float(cells[at])
        except ValueError:
            raise ValueError(f"{where}: {cells[at]!r} is not a number") from None
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
        if name == "gauge" and _ABSOLUTE_GAUGE[0] < float(np.median(column)) < _ABSOLUTE_GAUGE[1]:
            raise ValueError(
                f"{where}: {largest:g} mm is the gauge itself, the deviation from nominal is wanted"
            )
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
