"""MiniProf's files: ``key=value`` lines, several sections, and the older headers without keys.

Axes, in all of them. A wheel: X from the flange back (X = 0) to the field side, Y towards the flange tip (UP
in the plot); 1 mm of Y is 1 mm less radius. The file's own Sd, Sh and qR are reproduced with the running
circle at X = 70 mm. A rail: X lateral, towards the gauge side, from a zero of the user's choice; Y upwards.

Words behind the columns of ColumnDef are comments, and a line that begins with a quote is a point switched
off.
"""

import re
from itertools import pairwise
from pathlib import Path

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.points import (
    MINIPROF,
    MINIPROF_1994,
    MINIPROF_2020,
    Line,
    RawPoints,
    plain_line,
    switched_off,
    table,
)
from hh_exudyn.number_lines import leading_numbers, number

KEY_VALUE = re.compile(r'^\s*"?([A-Za-z][^=]*?)\s*=(.*?)"?\s*$')
USUAL_KEY = re.compile(r'^\s*"?(ColumnDef|XYPoints|ProgramName|MPTypeNo|[XY]Offset)\s*=', re.IGNORECASE)
OLD_HEADER = re.compile(r'^\s*"?(?:#MINI(WHEEL|RAIL)PROF|MINIPROF\s+\d)', re.IGNORECASE)
SECTION = re.compile(r"^\s*\[([^\]]+)\]\s*$")

_WHEEL_KEYS = {"wheelid", "axleno", "sd", "sh", "qr", "wheeladjustpoint", "wheeldiametertaperline"}
_RAIL_KEYS = {"rail", "crownradius", "w1", "w2", "w3", "basetilt", "railaligntype"}
_KIND_OF_MEASURES = {"Sd": "wheel", "Sh": "wheel", "W1": "rail"}
_FIRST_ROWS = 5  # lines of numbers in a row: there the points begin


def read_old(path: Path, text: list[str]) -> RawPoints:
    """A header without keys, measures one line above "(Sd/Sh/qR)" or before it; then two or three columns.

    Of three columns (1994) the last is the angle.

    Arguments: see the map of this folder.
    """
    lines = [plain_line(n, line) for n, line in enumerate(text, start=1)]
    filled = [line for line in lines if line.text]
    measures = re.compile(r"\(\w+/")
    widths = [
        0 if line.off or measures.search(line.text) else len(leading_numbers(line.text)[0]) for line in filled
    ]
    first = next(
        (
            k for k in range(len(filled))
            if min(widths[k : k + _FIRST_ROWS]) > 1
        ),
        len(filled),
    )  # fmt: skip
    begin = filled[first].number if first < len(filled) else len(text) + 1
    header: dict[str, str] = {}
    raw = [line.strip() for line in text[: begin - 1]]
    for above, line in zip(["", *raw], raw, strict=False):
        key, colon, value = line.partition(":")
        if colon:
            header[key.strip(" .\"'#")] = value.strip()
        elif match := re.search(r"\(([A-Za-z]\w+(?:/\w+)+)\)", line):
            before = line[: match.start()].strip(" \"'") or above.strip(" \"'")
            header |= dict(zip(match[1].split("/"), before.split(), strict=False))
    kinds = [found[1].lower() for line in raw if (found := OLD_HEADER.match(line)) and found[1]]
    kinds += [kind for key, kind in _KIND_OF_MEASURES.items() if key in header]
    count = max(widths[first:], default=2)
    rows = filled[first:]
    points = table(
        path, rows, range(2, max(count, 2) + 1 if count <= 3 else 3), (0, 1), "two numbers, X and Y in mm"
    )
    form = MINIPROF_2020 if raw and raw[0].lstrip('" ').startswith("#") else MINIPROF_1994
    return RawPoints(form, kinds[0] if kinds else None, *points, header, tuple(switched_off(rows)))


def read_keyed(path: Path, text: list[str]) -> RawPoints:
    """Lines ``key=value``, some in quotes, the last of equal keys valid; then the columns of ColumnDef.

    A file with sections (``[FileInfo]``, ``[ProfileXYPoints]``) has its points below those that end in
    "Points".

    Arguments: see the map of this folder.
    """
    header: dict[str, str] = {}
    rows: list[Line] = []
    starts: list[int] = []
    sections = any(SECTION.match(line) for line in text)
    inside = not sections
    for n, line in enumerate(text, start=1):
        if match := SECTION.match(line):
            inside = match[1].strip().lower().endswith("points")
            if inside:
                starts.append(len(rows))
        elif match := KEY_VALUE.match(line):
            header[match[1].strip()] = match[2].strip()
        elif inside and (plain := plain_line(n, line)).text and (rows or _is_row(plain)):
            rows.append(plain)
    names = [name.strip().upper() for name in header.get("ColumnDef", "X,Y").split(",")]
    if "X" not in names or "Y" not in names:
        raise ValueError(f"profile {path}: ColumnDef = {','.join(names)!r}, allowed with X and Y")
    columns = (names.index("X"), names.index("Y"))
    expected = f"{len(names)} numbers ({','.join(names)}; lengths in mm)"
    y, z, lines = table(path, rows, range(len(names), len(names) + 1), columns, expected)
    off = sum(line.off for line in rows)
    if header.get("XYPoints", "") and len(starts) <= 1:
        stated = header_number(path, header, "XYPoints")
        if stated not in (len(y), len(y) + off):
            raise ValueError(
                f"profile {path}: {len(y)} points, but XYPoints = {stated:g}: is the file cut off?"
            )
    _check_one_profile(path, rows, starts, dict(zip(lines, y, strict=True)))
    notes = switched_off(rows)
    shifts = [header_number(path, header, key) for key in ("XOffset", "YOffset")]
    if any(shifts):
        y, z = y + shifts[0], z + shifts[1]
        notes.append(f"moved by the file's offsets {shifts[0]:g} and {shifts[1]:g} mm")
    keys = {key.lower() for key in header}
    wheel, rail = bool(keys & _WHEEL_KEYS), bool(keys & _RAIL_KEYS)
    kind = ("wheel" if wheel else "rail") if wheel != rail else None
    return RawPoints(MINIPROF, kind, y, z, lines, header, tuple(notes))


def header_number(path: Path, header: dict[str, str], key: str, default: float = 0.0) -> float:
    """A finite number of a header, whatever the case of its key; `default` where absent or empty.

    Parameters
    ----------
    path : Path
        For messages.
    header : dict
        Key to text.
    key : str
        Of the number.
    default : float
        Where there is none.
    """
    text = next((value for name, value in header.items() if name.lower() == key.lower()), "")
    if not text:
        return default
    value = number(text)
    if value is None or not abs(value) < 1e9:
        raise ValueError(f"profile {path}: {key} = {text[:40]!r}, allowed a number")
    return value


def _is_row(line: Line) -> bool:
    """Whether a line may be the first point; titles stand above it."""
    return line.off or bool(leading_numbers(line.text)[0])


def _check_one_profile(path: Path, rows: list[Line], starts: list[int], place: dict[int, float]) -> None:
    """Refuse sections of points that lie at the same place: several profiles; parts of one follow each
    other."""
    spans: list[tuple[int, FloatArray]] = []
    if not starts:
        return
    for begin, end in zip(starts, [*starts[1:], len(rows)], strict=True):
        numbers = [line.number for line in rows[begin:end] if line.number in place]
        if numbers:
            spans.append((numbers[0], np.array([place[n] for n in numbers])))
    for (line, one), (other_line, other) in pairwise(spans):
        common = min(one.max(), other.max()) - max(one.min(), other.min())
        if common > 0.5 * min(np.ptp(one), np.ptp(other)):
            raise ValueError(
                f"profile {path}: two profiles, from line {line} and from line {other_line}; allowed is one"
            )
