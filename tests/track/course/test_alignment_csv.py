"""Alignments from CSV tables: the same geometry as from parameters, and errors that say where."""

import math
from pathlib import Path

import numpy as np
import pytest

from track.course.alignment import Alignment, Curve, Grade, Straight, Transition, inclined_frame
from track.course.alignment_csv import read_alignment_csv

TABLE = """\
# a made-up line: compound and reverse curve, gauge widening, a summit
length_m,radius_m,hand,cant_mm,gradient_per_mille,gauge_mm
120,,straight,0,4,1435
60,450,left,100,4,1445
150,450,left,100,4,1445
40,300,left,120,-6,1450
80,300,left,120,-6,1450
90,600,right,45,-6,1440
110,600,right,45,-6,1440
70,,straight,0,-6,1435
100,,straight,0,-6,1435
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "line.csv"
    path.write_text(text)
    return path


def test_a_table_is_the_alignment_of_its_sections(tmp_path: Path) -> None:
    read = read_alignment_csv(written(tmp_path, TABLE))
    made = Alignment.from_sections(
        [
            Straight(120.0),
            Transition(60.0),
            Curve(150.0, 450.0, "left", 0.100, 1.445),
            Transition(40.0),
            Curve(80.0, 300.0, "left", 0.120, 1.450),
            Transition(90.0),
            Curve(110.0, 600.0, "right", 0.045, 1.440),
            Transition(70.0),
            Straight(100.0),
        ],
        grades=[Grade(330.0, 0.004), Grade(40.0, 0.004, -0.006), Grade(450.0, -0.006)],
    )
    for s in np.linspace(-50.0, made.length + 50.0, 333):
        assert inclined_frame(read.table, s) == pytest.approx(inclined_frame(made.table, s), abs=1e-9)
    assert read.section_at(200.0) == Curve(150.0, 450.0, "left", 0.100, 1.445)
    assert read.length == 820.0


def test_curvature_stands_for_radius_and_hand(tmp_path: Path) -> None:
    rows = [line.split(",") for line in TABLE.splitlines()[2:]]
    sign = {"left": 1.0, "right": -1.0}
    lines = ["length_m,curvature_1_per_m,cant_mm,gradient_per_mille,gauge_mm"]
    for length, radius, hand, *rest in rows:
        lines.append(",".join([length, str(sign[hand] / float(radius)) if radius else "0", *rest]))
    one = read_alignment_csv(written(tmp_path, TABLE)).table
    other = read_alignment_csv(written(tmp_path, "\n".join(lines))).table
    assert other.nodes == pytest.approx(one.nodes, abs=1e-9)


def test_only_length_and_curvature_are_needed(tmp_path: Path) -> None:
    text = "length_m,curvature_1_per_m\n50,0\n80,-0.002\n200,-0.002\n"
    table = read_alignment_csv(written(tmp_path, text)).table
    _, _, z, heading, _, roll, curvature, gauge = inclined_frame(table, 300.0)
    assert (z, roll, gauge) == (0.0, 0.0, 1.435)
    assert curvature == pytest.approx(-0.002, abs=1e-18)
    assert heading == pytest.approx(-0.002 * (40.0 + 170.0), abs=1e-12)


def test_start_m_closes_the_table(tmp_path: Path) -> None:
    text = "start_m,length_m,curvature_1_per_m\n1000,50,0\n1050,80,-0.002\n1130,200,-0.002\n"
    assert math.isclose(read_alignment_csv(written(tmp_path, text)).length, 330.0)


HEAD = "length_m,radius_m,hand,cant_mm,gradient_per_mille,gauge_mm\n100,,straight,0,0,1435\n"
FAULTS = {
    "negative length": (
        HEAD + "-5,,straight,0,0,1435",
        r"line 3: length_m is -5, allowed are numbers from 0.001",
    ),
    "gap": (HEAD + "50,,straight,,0,1435", r"line 3: cant_mm is missing, allowed are numbers from 0 to 180"),
    "text": (HEAD + "50,500,left,ten,0,1435", r"line 3: cant_mm is 'ten', allowed are numbers from 0 to 180"),
    "nan": (
        HEAD + "50,nan,left,10,0,1435",
        r"line 3: radius_m is nan, allowed are numbers from 100 to 100000",
    ),
    "sharp": (
        HEAD + "50,90,left,10,0,1435",
        r"line 3: radius_m is 90, allowed are numbers from 100 to 100000",
    ),
    "hand": (HEAD + "50,500,lef,10,0,1435", r"line 3: hand is 'lef', allowed are left, right and straight"),
    "straight": (
        HEAD + "50,500,straight,0,0,1435",
        r"line 3: radius_m is 500 in a straight, allowed is an empty",
    ),
    "cant": (HEAD + "50,,straight,20,0,1435", r"line 3: cant_mm is 20 without any curve, allowed is 0"),
    "cant in m": (
        HEAD + "50,500,left,0.1,0,1435",
        r"line 3: cant_mm is 0.1 at most in the table.* in metres\?",
    ),
    "gauge in m": (
        HEAD + "50,500,left,80,0,1.435",
        r"line 3: gauge_mm is 1.435, allowed are numbers from 900",
    ),
    "slope": (
        HEAD + "50,,straight,0,0.01,1435",
        r"line 3: gradient_per_mille is 0.01 at most.* without unit\?",
    ),
    "steep": (
        HEAD + "50,,straight,0,60,1435",
        r"line 3: gradient_per_mille is 60, allowed are numbers from -50",
    ),
    "summit": (HEAD + "5,,straight,0,20,1435", r"line 3: vertical radius of a Grade is 250 m"),
    "fields": (HEAD + "50,500,left", r"line 3: has 3 fields, 6 are needed"),
    "unit": (
        "length_km,curvature_1_per_m\n5,0",
        r"line 1: unknown column 'length_km', known .* length_m meant\?",
    ),
    "missing": ("radius_m,hand\n500,left", r"line 1: column length_m is missing"),
    "double": ("length_m,length_m\n5,5", r"line 1: column length_m is there 2 times"),
    "no curvature": (
        "length_m,cant_mm\n5,0",
        r"line 2: give either column curvature_1_per_m or columns radius_m",
    ),
    "no hand": ("length_m,radius_m\n5,500", r"line 2: columns radius_m and hand are needed together"),
    "curvature": (
        "length_m,curvature_1_per_m\n5,2",
        r"line 2: curvature_1_per_m is 2, allowed are numbers from -0.0",
    ),
    "flat": (
        "length_m,curvature_1_per_m\n5,1e-6",
        r"line 2: curvature_1_per_m is 1e-06, allowed are 0 and radii",
    ),
    "no rows": ("length_m,curvature_1_per_m\n", r"has no rows, a header line and one row or more are needed"),
    "overlap": (
        "start_m,length_m,curvature_1_per_m\n0,50,0\n40,80,0",
        r"line 3: start_m is 40, allowed is 50 where the row before ends: overlap of 10 m",
    ),
    "hole": (
        "start_m,length_m,curvature_1_per_m\n0,50,0\n60,80,0",
        r"line 3: start_m is 60, allowed is 50 where the row before ends: gap of 10 m",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_named_with_its_line(name: str, tmp_path: Path) -> None:
    text, message = FAULTS[name]
    with pytest.raises(ValueError, match=message) as caught:
        read_alignment_csv(written(tmp_path, text))
    assert "line.csv" in str(caught.value)


def test_a_file_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"none\.csv: cannot be read"):
        read_alignment_csv(tmp_path / "none.csv")
    (tmp_path / "line.csv").write_bytes(b"\xff\xfe\x00length")
    with pytest.raises(ValueError, match="has no rows, a header line and one row or more are needed"):
        read_alignment_csv(tmp_path / "line.csv")
