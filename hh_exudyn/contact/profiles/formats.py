"""The text formats of profile files, recognised by their content: from characters to points.

Each format has its own axes, in which the points are read here; `reader` converts them by `axes`:

* two columns: y and z in side coordinates, see `reader`.
* SIMPACK prw/prr: y and z of a RIGHT wheel or rail, y outwards (away from the track centre), z DOWN, in the
  unit that ``units.len.f`` gives per metre, after the file's own shift, bounds and mirroring. A wheel's y is
  counted from its running circle (Manchester benchmark) or from its flange back (worn wheels of CONTACT).
* MiniProf wheel: X from the flange back (X = 0) to the field side, Y towards the flange tip (UP in the plot);
  1 mm of Y is 1 mm less radius. The same in "MINIPROF 2020" text and in "MiniProf for Windows" files,
  where the file's own Sd, Sh and qR are reproduced with the running circle at X = 70 mm.
* MiniProf rail: X lateral, towards the gauge side, from a zero of the user's choice; Y upwards.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hh_exudyn.arrays import FloatArray

TWO_COLUMN, SIMPACK, MINIPROF_2020, MINIPROF = "two_column", "simpack", "miniprof_2020", "miniprof"

_MAX_BYTES = 10_000_000  # a profile has a few hundred lines
_MINIPROF_2020 = re.compile(r'^\s*"?#MINI(WHEEL|RAIL)PROF', re.IGNORECASE)
_KEY_VALUE = re.compile(r'^\s*"?([A-Za-z][\w .#]*?)\s*=(.*?)"?\s*$')
_SIMPACK = re.compile(r"^\s*(header|spline|point)\.begin\b", re.IGNORECASE)
_WHEEL_KEYS = {"wheelid", "axleno", "sd", "sh", "qr", "wheeladjustpoint", "wheeldiametertaperline"}
_RAIL_KEYS = {"rail", "crownradius", "w1", "w2", "w3", "basetilt", "railaligntype"}


@dataclass(frozen=True)
class RawPoints:
    """The points of a file, in the file's own axes.

    Attributes
    ----------
    format : str
        ``"two_column"``, ``"simpack"``, ``"miniprof_2020"`` or ``"miniprof"``.
    kind : str or None
        ``"wheel"`` or ``"rail"`` where the file says so.
    y, z : FloatArray
        Lateral and vertical values of the file in millimetres (a SIMPACK file's own unit converted).
    lines : list of int
        Line number of each point.
    header : dict
        The header, key to text.
    notes : tuple of str
        Changes prescribed by the file itself: shifts, bounds.
    """

    format: str
    kind: str | None
    y: FloatArray
    z: FloatArray
    lines: list[int]
    header: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def read_points(path: Path) -> RawPoints:
    """The points of a profile file of any known format.

    Raises
    ------
    ValueError
        A missing, empty, binary, too large or truncated file, or a line of another form; the message names
        file, line and the expected form.
    """
    text = _text(path).splitlines()
    filled = [line for line in text if line.strip()][:100]
    if any(_SIMPACK.match(line) for line in filled):
        return _simpack(path, text)
    if filled and _MINIPROF_2020.match(filled[0]):
        return _miniprof_2020(path, text)
    if filled and _KEY_VALUE.match(filled[0]):
        return _miniprof(path, text)
    return _two_column(path, text)


def _text(path: Path) -> str:
    """The file as text."""
    if not path.is_file():
        raise ValueError(f"profile: file not found: {path}")
    if (size := path.stat().st_size) > _MAX_BYTES:
        raise ValueError(f"profile {path}: {size} bytes, allowed up to {_MAX_BYTES}")
    data = path.read_bytes()
    if not data.strip():
        raise ValueError(f"profile {path}: the file is empty")
    if b"\0" in data:
        raise ValueError(f"profile {path}: a binary file, allowed is text")
    return data.decode("utf-8-sig", errors="replace")


def _numbers(path: Path, line: int, text: str, counts: range, expected: str) -> list[float]:
    """The numbers of one line; their count must lie in `counts`."""
    words = text.replace(",", " ").replace(";", " ").split()
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    if len(values) not in counts:
        raise ValueError(f"profile {path}, line {line}: expected {expected}, got {text.strip()[:60]!r}")
    return values


def _points(
    path: Path, rows: list[tuple[int, str]], counts: range, columns: tuple[int, int], expected: str
) -> tuple[FloatArray, FloatArray, list[int]]:
    """The two columns of the data lines of a file."""
    values = [_numbers(path, number, text, counts, expected) for number, text in rows]
    y = np.array([row[columns[0]] for row in values], dtype=np.float64)
    z = np.array([row[columns[1]] for row in values], dtype=np.float64)
    return y, z, [number for number, _ in rows]


def _two_column(path: Path, text: list[str]) -> RawPoints:
    """Two numbers a line; ``#`` and ``!`` start comments."""
    rows = [(n, re.split("[#!]", line)[0]) for n, line in enumerate(text, start=1)]
    rows = [(n, line) for n, line in rows if line.strip()]
    return RawPoints(
        TWO_COLUMN, None, *_points(path, rows, range(2, 3), (0, 1), "two numbers, y and z in mm")
    )


def _miniprof_2020(path: Path, text: list[str]) -> RawPoints:
    """A header up to the first blank line, its measures one line above "(Sd/Sh/qR)"; then two columns."""
    start = next(n for n, line in enumerate(text) if line.strip())
    match = _MINIPROF_2020.match(text[start])
    blank = next((n for n in range(start, len(text)) if not text[n].strip()), len(text))
    header = {}
    for above, line in zip(text[start:blank], text[start + 1 : blank], strict=False):
        key, colon, value = line.partition(":")
        if colon:
            header[key.strip(" .\"'")] = value.strip()
        elif line.strip().startswith("(") and "/" in line:
            names = line.strip(" ()\"'").split("/")
            header |= dict(zip(names, above.strip(" \"'").split(), strict=False))
    rows = [(n + 1, text[n]) for n in range(blank, len(text)) if text[n].strip()]
    points = _points(path, rows, range(2, 3), (0, 1), "two numbers, X and Y in mm")
    return RawPoints(MINIPROF_2020, match[1].lower() if match else None, *points, header)


def _miniprof(path: Path, text: list[str]) -> RawPoints:
    """Lines ``key=value``, some in quotes, the last of equal keys valid; then the columns of ColumnDef."""
    header: dict[str, str] = {}
    rows = []
    for number, line in enumerate(text, start=1):
        if match := _KEY_VALUE.match(line):
            header[match[1].strip()] = match[2].strip()
        elif line.strip():
            rows.append((number, line))
    names = [name.strip().upper() for name in header.get("ColumnDef", "X,Y").split(",")]
    if "X" not in names or "Y" not in names:
        raise ValueError(f"profile {path}: ColumnDef = {','.join(names)!r}, allowed with X and Y")
    columns = (names.index("X"), names.index("Y"))
    expected = f"{len(names)} numbers ({','.join(names)}; lengths in mm)"
    y, z, lines = _points(path, rows, range(len(names), len(names) + 1), columns, expected)
    if header.get("XYPoints", ""):
        stated = _header_number(path, header, "XYPoints")
        if stated != len(y):
            raise ValueError(
                f"profile {path}: {len(y)} points, but XYPoints = {stated:g}: is the file cut off?"
            )
    notes = []
    shifts = [_header_number(path, header, key) for key in ("XOffset", "YOffset")]
    if any(shifts):
        y, z = y + shifts[0], z + shifts[1]
        notes.append(f"moved by the file's offsets {shifts[0]:g} and {shifts[1]:g} mm")
    keys = {key.lower() for key in header}
    wheel, rail = bool(keys & _WHEEL_KEYS), bool(keys & _RAIL_KEYS)
    kind = ("wheel" if wheel else "rail") if wheel != rail else None
    return RawPoints(MINIPROF, kind, y, z, lines, header, tuple(notes))


def _header_number(path: Path, header: dict[str, str], key: str, default: float = 0.0) -> float:
    """A finite number of a header, whatever the case of its key; `default` where absent or empty."""
    text = next((value for name, value in header.items() if name.lower() == key.lower()), "")
    if not text:
        return default
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not abs(value) < 1e9:
        raise ValueError(f"profile {path}: {key} = {text[:40]!r}, allowed a number")
    return value


def _simpack(path: Path, text: list[str]) -> RawPoints:
    """``point.begin`` .. ``point.end`` inside keys with values; ``!`` and ``%`` start comments."""
    header: dict[str, str] = {}
    rows = []
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
            rows.append((number, line))
        elif word in ("header.begin", "spline.begin"):
            section = word.partition(".")[0] + "."
        elif "=" in line:
            key, _, value = line.partition("=")
            header[section + key.strip()] = value.strip().strip("'\"")
    if not ended:
        raise ValueError(f"profile {path}: no point.begin .. point.end: is the file cut off?")
    y, z, lines = _points(path, rows, range(2, 4), (0, 1), "y, z and at most a weight")
    kinds = {"0": "rail", "1": "wheel"}
    kind = header.get("header.type", "")
    if kind not in ("", *kinds):
        raise ValueError(f"profile {path}: header type = {kind[:40]!r}, allowed 0 (rail) and 1 (wheel)")

    def number_of(key: str, default: float = 0.0) -> float:
        return _header_number(path, header, "spline." + key, default)

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
