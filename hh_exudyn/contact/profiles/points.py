"""The points of a profile file in the file's own axes, and the lines that they stand on."""

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.number_lines import has_decimal_commas, leading_numbers

TWO_COLUMN, SIMPACK, VAMPIRE = "two_column", "simpack", "vampire"
MINIPROF_2020, MINIPROF_1994, MINIPROF = "miniprof_2020", "miniprof_1994", "miniprof"

_COMMENT = re.compile(r"[#!%]|//")


@dataclass(frozen=True)
class RawPoints:
    """The points of a file, in the file's own axes.

    Attributes
    ----------
    format : str
        ``"two_column"``, ``"simpack"``, ``"vampire"``, ``"miniprof_1994"``, ``"miniprof_2020"`` or
        ``"miniprof"``.
    kind : str or None
        ``"wheel"`` or ``"rail"`` where the file says so.
    y, z : FloatArray
        Lateral and vertical values of the file in millimetres (another unit of the file is converted).
    lines : list of int
        Line number of each point.
    header : dict
        The header, key to text.
    notes : tuple of str
        Changes prescribed by the file itself: shifts, bounds, points switched off.
    """

    format: str
    kind: str | None
    y: FloatArray
    z: FloatArray
    lines: list[int]
    header: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Line:
    """A line with its number, without comment and quotes; `off` where a single quote switches it off."""

    number: int
    text: str
    off: bool = False


def plain_line(number: int, text: str) -> Line:
    """A line of a file.

    A comment begins with ``#``, ``!``, ``%`` or ``//``. Quotes in pairs are those of a table's cells; a
    single one at the beginning switches the line off (MiniProf), behind it begins a comment.

    Parameters
    ----------
    number : int
        Of the line.
    text : str
        The line.
    """
    text = _COMMENT.split(text, maxsplit=1)[0].strip()
    if text.count('"') % 2 == 0:
        return Line(number, text.replace('"', " ").strip())
    if text.startswith('"'):
        return Line(number, text[1:].strip(), off=True)
    return Line(number, text.split('"')[0].strip())


def table(
    path: Path, lines: list[Line], counts: range, columns: tuple[int, int], expected: str
) -> tuple[FloatArray, FloatArray, list[int]]:
    """Two columns of lines of numbers, words behind the columns left out; and the line numbers.

    Parameters
    ----------
    path : Path
        For messages.
    lines : list of Line
        The lines with numbers; empty ones and those switched off are passed over.
    counts : range
        Allowed numbers of columns.
    columns : tuple of int
        Index of the lateral and of the vertical column.
    expected : str
        What a line must be, for messages.

    Raises
    ------
    ValueError
        A line with another number of columns, named.
    """
    used = [line for line in lines if line.text and not line.off]
    commas = decimal_commas(path, used)
    values = []
    for line in used:
        row, _ = leading_numbers(line.text, commas)
        if len(row) not in counts:
            raise ValueError(
                f"profile {path}, line {line.number}: expected {expected}, got {line.text[:60]!r}"
            )
        values.append(row)
    y = np.array([row[columns[0]] for row in values], dtype=np.float64)
    z = np.array([row[columns[1]] for row in values], dtype=np.float64)
    return y, z, [line.number for line in used]


def decimal_commas(path: Path, lines: list[Line]) -> bool:
    """Whether a file has decimal commas; ValueError where its lines may be read in two ways.

    Parameters
    ----------
    path : Path
        For messages.
    lines : list of Line
        The lines with numbers.
    """
    try:
        return has_decimal_commas([line.text for line in lines])
    except ValueError as error:
        raise ValueError(f"profile {path}: {error}") from None


def switched_off(lines: list[Line]) -> list[str]:
    """A note on the points that a quote switches off; nothing without any."""
    off = [line.number for line in lines if line.off]
    if not off:
        return []
    return [f"{len(off)} points switched off by a quote (line {off[0]}{' and others' if off[1:] else ''})"]
