"""Measured irregularities from CSV: what is read, and what every kind of bad file says."""

from pathlib import Path

import numpy as np
import pytest

from track.irregularity.irregularity import Irregularity, random_irregularity
from track.irregularity.irregularity_csv import read_irregularity

HEADER = "position_m,level_mm,alignment_mm,gauge_mm,cross_level_mm"


@pytest.fixture(scope="module")
def car() -> Irregularity:
    return random_irregularity("erri_high", 200.0, seed=11, start=1250.0)


def lines_of(track: Irregularity) -> list[str]:
    """The track as a recording car would write it, micrometres exact."""
    rows = zip(track.s, 1e3 * track.values, strict=True)
    return [",".join([f"{s:.2f}", *(f"{value:.3f}" for value in values)]) for s, values in rows]


def written(folder: Path, lines: list[str]) -> Path:
    path = folder / "car.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_what_was_written_is_read(tmp_path: Path, car: Irregularity) -> None:
    lines = lines_of(car)
    for header in (
        [],
        [HEADER],
        ["# a comment", "", HEADER.upper()],
        ["position [m];level;alignment;gauge;cross level"],
    ):
        separator = ";" if header and ";" in header[-1] else ","
        read = read_irregularity(written(tmp_path, header + [line.replace(",", separator) for line in lines]))
        assert read.start == 1250.0
        assert read.step == pytest.approx(0.25, rel=1e-12)
        assert np.abs(read.values - car.values).max() < 0.51e-6
    blanks = read_irregularity(written(tmp_path, [line.replace(",", "  ") + "  # note" for line in lines]))
    assert np.array_equal(blanks.values, read.values)


def test_named_columns_may_stand_in_any_order(tmp_path: Path, car: Irregularity) -> None:
    swapped = [",".join(line.split(",")[i] for i in (4, 0, 3, 2, 1)) for line in lines_of(car)]
    header = "cross_level,position,gauge,alignment,level"
    read = read_irregularity(written(tmp_path, [header, *swapped]))
    assert np.abs(read.values - car.values).max() < 0.51e-6


def test_signs_and_start_may_differ(tmp_path: Path, car: Irregularity) -> None:
    read = read_irregularity(written(tmp_path, lines_of(car)), start=-30.0, signs=(-1, -1, 1, -1))
    assert read.start == -30.0
    assert np.abs(read.values - car.values * [-1, -1, 1, -1]).max() < 0.51e-6


def change(line: str, column: int, text: str) -> str:
    """A line with one column replaced."""
    cells = line.split(",")
    cells[column] = text
    return ",".join(cells)


def test_bad_lines_are_named(tmp_path: Path, car: Irregularity) -> None:
    good = [HEADER, *lines_of(car)]
    cases = {
        r"line 7, column 4 \(gauge\): nan is not a finite number": (6, change(good[6], 3, "nan")),
        r"line 9, column 2 \(level\): no value": (8, change(good[8], 1, "")),
        r"line 12, column 5 \(cross_level\): '3\.\.1' is not a number": (11, change(good[11], 4, "3..1")),
        r"line 4: 4 columns, there must be 5: position, level": (3, good[3].rsplit(",", 1)[0]),
        r"line 21, column position: 1250 m does not lie ahead of 1254\.5 m on line 20": (
            20,
            change(good[20], 0, "1250"),
        ),
        r"line 1: the header names position, level, line, gauge, cross_level; it must": (
            0,
            HEADER.replace("alignment", "line"),
        ),
        r"line 30, column alignment: 4000 mm, allowed are -100 to 100 mm": (29, change(good[29], 2, "4000")),
        r"line 50, column position: a step of 0\.3 m where the spacing is 0\.25 m": (
            49,
            change(good[49], 0, "1262.05"),
        ),
    }
    for message, (at, line) in cases.items():
        bad = list(good)
        bad[at] = line
        with pytest.raises(ValueError, match=rf"car\.csv, {message}"):
            read_irregularity(written(tmp_path, bad))


def test_gaps_and_units_are_found(tmp_path: Path, car: Irregularity) -> None:
    good = lines_of(car)
    with pytest.raises(ValueError, match=r"line 101, column position: a gap of 2\.75 m after 1274\.75 m"):
        read_irregularity(written(tmp_path, good[:100] + good[110:]))
    rows = np.column_stack([car.s, 1e3 * car.values])
    for column, name in ((1, "level"), (2, "alignment"), (4, "cross_level")):
        metres = rows.copy()
        metres[:, column] *= 1e-3
        with pytest.raises(ValueError, match=rf"column {name}: .* mm is the largest of its column.*metres\?"):
            read_irregularity(written(tmp_path, [",".join(map(str, row)) for row in metres]))
    for factor, guess in ((1e-3, "kilometres"), (1e3, "millimetres")):
        other = rows * [factor, 1.0, 1.0, 1.0, 1.0]
        with pytest.raises(ValueError, match=rf"column position: the spacing is .*{guess}\?"):
            read_irregularity(written(tmp_path, [",".join(map(repr, row.tolist())) for row in other]))
    with pytest.raises(ValueError, match=r"5 lines of numbers, at least 10"):
        read_irregularity(written(tmp_path, good[:5]))
    (tmp_path / "car.csv").write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(ValueError, match=r"line 1: 1 columns, there must be 5"):
        read_irregularity(tmp_path / "car.csv")
    with pytest.raises(ValueError, match=r"signs is \(1, 0, 1, 1\)"):
        read_irregularity(tmp_path / "car.csv", signs=(1, 0, 1, 1))


def values_of(folder: Path, lines: list[str]) -> np.ndarray:
    return read_irregularity(written(folder, lines)).values


def shared_signals(rows: np.ndarray) -> np.ndarray:
    """The four signals from km, level left and right, alignment left and right, gauge, cross-level."""
    return 1e-3 * np.column_stack(
        [rows[:, 1:3].mean(axis=1), rows[:, 3:5].mean(axis=1), rows[:, 5] - 1435.0, -rows[:, 6]]
    )


LEFT_RIGHT = (
    "km,longitudinal level left,longitudinal level right,alignment left,alignment right,gauge,cross level"
)


def recording() -> np.ndarray:
    """60 rows of a recording car that counts cross-level positive where the left rail is higher."""
    s = 0.25 * np.arange(60)
    left, right = 3.0 * np.sin(s / 3.0), 2.5 * np.sin(s / 3.0 - 0.4)
    align = 1.5 * np.cos(s / 4.0)
    gauge = 1435.0 + align - 0.7 * align
    return np.column_stack([12.345 + 1e-3 * s, left, right, align, 0.7 * align, gauge, left - right])


def text_of(rows: np.ndarray, separator: str = ",") -> list[str]:
    return [separator.join(f"{value:.6f}" for value in row) for row in rows]


def test_left_and_right_rail_absolute_gauge_and_kilometres(tmp_path: Path) -> None:
    rows = recording()
    read = read_irregularity(written(tmp_path, [LEFT_RIGHT, *text_of(rows)]))
    assert read.start == pytest.approx(12345.0)
    assert read.step == pytest.approx(0.25)
    assert np.abs(read.values - shared_signals(rows)).max() < 1e-8
    assert np.abs(read.values[:, 3] - 1e-3 * (rows[:, 2] - rows[:, 1])).max() < 1e-8  # the right rail higher


def test_the_same_recording_in_other_forms(tmp_path: Path) -> None:
    """Decimal commas, units in a second line, other columns, no columns of differences, falling chainage."""
    rows = recording()
    expected = shared_signals(rows)

    def same(values: np.ndarray) -> None:
        assert np.abs(values - expected).max() < 1e-8

    decimal = [line.replace(".", ",") for line in text_of(rows, ";")]
    same(values_of(tmp_path, [LEFT_RIGHT.replace(",", ";"), *decimal]))
    tabs = [line.replace(".", ",") for line in text_of(rows, "\t")]
    units = "[km]\tmm\tmm\tmm\tmm\tmm\tmm"
    same(values_of(tmp_path, [LEFT_RIGHT.replace(",", "\t"), units, *tabs]))
    more = [f"{line},80.0,fine" for line in text_of(rows)]
    same(values_of(tmp_path, [LEFT_RIGHT + ",speed,remark", *more]))
    bare = text_of(rows[:, :5])
    header = "Chainage [km],Level L [mm],Level R [mm],Alignment L [mm],Alignment R [mm]"
    same(values_of(tmp_path, [header, *bare]))
    falling = rows.copy()
    falling[:, 0] = 20.0 - falling[:, 0]
    back = read_irregularity(written(tmp_path, [LEFT_RIGHT, *text_of(falling)]))
    assert back.start == pytest.approx(7655.0)
    same(back.values)
    metres = rows.copy()
    metres[:, 1:] *= 1e-3
    header = "km," + ",".join(f"{name} [m]" for name in LEFT_RIGHT.split(",")[1:])
    same(values_of(tmp_path, [header, *(",".join(map(repr, row.tolist())) for row in metres)]))


def test_gauge_is_counted_from_another_nominal_gauge(tmp_path: Path) -> None:
    rows = recording()
    rows[:, 5] += 1067.0 - 1435.0
    read = read_irregularity(written(tmp_path, [LEFT_RIGHT, *text_of(rows)]), nominal_gauge=1.067)
    assert np.abs(read.values[:, 2] - 1e-3 * (rows[:, 5] - 1067.0)).max() < 1e-8
    with pytest.raises(ValueError, match=r"column gauge: 106\d.* mm, allowed are -100 to 100 mm"):
        read_irregularity(tmp_path / "car.csv")


def test_headers_that_do_not_suffice_are_told(tmp_path: Path) -> None:
    lines = text_of(recording())
    for header, message in (
        (LEFT_RIGHT.replace("level left", "level of it"), r"line 1: the header names km, .*; it must name"),
        (LEFT_RIGHT.replace("level right", "level left"), r"line 1: the header names km"),
        (LEFT_RIGHT + ",gauge", r"line 1: 2 columns hold the gauge, allowed is 1"),
    ):
        more = ",0" if header.endswith(",gauge") else ""
        with pytest.raises(ValueError, match=message):
            read_irregularity(written(tmp_path, [header, *(line + more for line in lines)]))


def test_the_shared_recording_is_converted(shared_cases: Path) -> None:
    rows = np.loadtxt(shared_cases / "track_left_right.csv", delimiter=",", skiprows=1)
    read = read_irregularity(shared_cases / "track_left_right.csv")
    assert np.abs(read.values - shared_signals(rows)).max() < 1e-9
    assert np.abs(read.values[:, 3] - 1e-3 * (rows[:, 2] - rows[:, 1])).max() < 0.011e-3
    assert read.start == pytest.approx(12345.0)
    assert read.step == pytest.approx(0.25)
