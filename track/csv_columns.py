"""CSV tables of numbers with units in the names of their columns (``length_m``, ``cant_mm``).

Columns stand between commas, semicolons or tabs, whichever the header line has; between the latter two a
number may have a decimal comma.
"""

import csv
import math
import re
from collections.abc import Collection
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from hh_exudyn.number_lines import number as parsed
from hh_exudyn.text_files import read_text


@dataclass(frozen=True)
class CsvRow:
    """One row of a table: file, line, and its fields as text by column name."""

    source: str
    line: int
    fields: dict[str, str]

    def error(self, message: str) -> ValueError:
        """A ValueError that begins with file and line of the row."""
        return ValueError(f"{self.source}, line {self.line}: {message}")

    def number(self, name: str, low: float, high: float) -> float:
        """The number in column `name`, `low` to `high`, in the unit of the column's name.

        Raises ValueError with line, name, value and allowed range where it is missing, no number or outside.

        Parameters
        ----------
        name : of the column
        low, high : allowed range, ends included
        """
        text = self.fields[name]
        allowed = f"allowed are numbers from {low:g} to {high:g}"
        if not text:
            raise self.error(f"{name} is missing, {allowed}")
        value = parsed(text)
        if value is None:
            raise self.error(f"{name} is {text!r}, {allowed}")
        if not low <= value <= high or math.isnan(value):
            raise self.error(f"{name} is {text}, {allowed}")
        return value


def read_columns(path: str | Path, needed: Collection[str], optional: Collection[str] = ()) -> list[CsvRow]:
    """Rows of a table with one header line; lines that begin with ``#`` are comments.

    Parameters
    ----------
    path : of the file
    needed, optional : names of the columns that must and may be there

    Raises
    ------
    ValueError
        The file cannot be read or has no rows, a column is missing, unknown or double, or a row has too few
        or too many fields. Names file, line and column.
    """
    source = str(path)
    lines = read_text(path).splitlines()
    content = [
        (i, line) for i, line in enumerate(lines, 1) if line.strip() and not line.lstrip().startswith("#")
    ]
    separator = next((mark for mark in ";\t" if content and mark in content[0][1]), ",")
    rows = [(i, _fields(line, separator)) for i, line in content]
    if len(rows) < 2:
        raise ValueError(f"{source}: has no rows, a header line and one row or more are needed")
    line, header = rows[0]
    known = [*needed, *optional]
    for name in header:
        if name not in known:
            near = get_close_matches(name, known, n=1)
            hint = f", {near[0]} meant?" if near else ""
            raise ValueError(
                f"{source}, line {line}: unknown column {name!r}, known are {', '.join(known)}{hint}"
            )
        if header.count(name) > 1:
            raise ValueError(f"{source}, line {line}: column {name} is there {header.count(name)} times")
    for name in needed:
        if name not in header:
            raise ValueError(f"{source}, line {line}: column {name} is missing")
    for line, fields in rows[1:]:
        if len(fields) != len(header):
            raise ValueError(f"{source}, line {line}: has {len(fields)} fields, {len(header)} are needed")
    return [CsvRow(source, line, dict(zip(header, fields, strict=True))) for line, fields in rows[1:]]


def _fields(line: str, separator: str) -> list[str]:
    """The columns of a line, a decimal comma as a point."""
    fields = [part.strip() for part in next(csv.reader([line], delimiter=separator))]
    return fields if separator == "," else [re.sub(r"^([-+]?\d*),(\d+)$", r"\1.\2", part) for part in fields]
