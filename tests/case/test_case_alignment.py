"""The alignment in a case file: three ways to give it, mirrored, written and read again, and its faults."""

from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hh_exudyn.case import Case, CaseError, read_case
from track.course.alignment import Alignment, Curve, Grade, Ramp, Straight, Transition, inclined_frame

DEMO = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text()
HEAD = DEMO[: DEMO.index("[[track.sections]]")]  # everything up to the sections
TABLE = """length_m,radius_m,hand,cant_mm,gradient_per_mille,gauge_mm
30,,straight,0,5,1440
50,450,left,65,5,1445
80,450,left,65,-3,1445
"""
WRITTEN = (
    HEAD
    + """
grades = [
  {length_m = 40.0, gradient_per_mille = -4.0},
  {length_m = 60.0, gradient_per_mille = -4.0, end_per_mille = 8.0},
]
sections = [
  {kind = "straight", length_m = 30.0, gauge_mm = 1435.0},
  {kind = "transition", length_m = 40.0, shape = "bloss", gauge_mm = 1442.0},
  {kind = "curve", length_m = 20.0, radius_m = 500.0, hand = "right", gauge_mm = 1445.0},
  {kind = "transition", length_m = 40.0},
  {kind = "curve", length_m = 20.0, radius_m = 500.0, hand = "right", cant_mm = 80.0, gauge_mm = 1445.0},
  {kind = "ramp", length_m = 60.0, radius_m = [-500, 0], cant_mm = [80, 0], gauge_mm = [1445, 1435]},
  {kind = "ramp", length_m = 40.0, radius_m = [0, 700.0], cant_mm = [0, 50.0]},
]
"""
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Case files of all three ways, and their tables in a folder below."""
    folder = tmp_path_factory.mktemp("cases")
    (folder / "lines").mkdir()
    (folder / "lines" / "table.csv").write_text(TABLE)
    table = _known().table
    rows = [inclined_frame(table, s)[:3] for s in np.arange(0.0, 300.1, 5.0)]
    points = "\n".join(f"{5e5 + x:.4f},{7e6 + y:.4f},{300.0 + z:.4f}" for x, y, z in rows)
    (folder / "lines" / "points.csv").write_text(f"x_m,y_m,z_m\n{points}\n")
    (folder / "sections.toml").write_text(WRITTEN)
    (folder / "table.toml").write_text(f'{HEAD}\nalignment = "lines/table.csv"\n')
    (folder / "points.toml").write_text(f'{HEAD}\ncentre_line = "lines/points.csv"\n')
    (folder / "smoothed.toml").write_text(
        f"{HEAD}\n[track.centre_line]\n"
        'file = "lines/points.csv"\nwavelength_m = 60.0\nbalance_speed_km_h = 50.0\nlargest_cant_mm = 60.0\n'
        "gauge_mm = 1440.0\napproach_m = 0.0\n"
    )
    return folder


WAYS = ("sections", "table", "points", "smoothed")


def _known() -> Alignment:
    plan = (Straight(60.0), Transition(60.0), Curve(180.0, 600.0, "left"))
    return Alignment(plan, grades=(Grade(100.0, 0.0), Grade(100.0, 0.0, 0.006)))


def case_of(folder: Path, way: str) -> Case:
    return read_case(folder / f"{way}.toml")


def test_sections_of_all_kinds_are_those_of_the_library(folder: Path) -> None:
    alignment = case_of(folder, "sections").alignment()
    assert alignment.sections == (
        Straight(30.0, 1.435),
        Transition(40.0, 1.442, "bloss"),
        Curve(20.0, 500.0, "right", 0.0, 1.445),
        Transition(40.0),
        Curve(20.0, 500.0, "right", 0.08, 1.445),
        Ramp(60.0, (-1 / 500, 0.0), (-0.08, 0.0), (1.445, 1.435)),
        Ramp(40.0, (0.0, 1 / 700), (0.0, 0.05)),
    )
    assert alignment.grades == (Grade(40.0, -0.004), Grade(60.0, -0.004, 0.008))
    # between curves of one radius a transition is a cant ramp
    *_, roll, curvature, _ = inclined_frame(alignment.table, 110.0)
    assert curvature == pytest.approx(-1 / 500, abs=1e-12)
    assert np.sin(roll) * 1.5 == pytest.approx(0.04, abs=1e-9)


def test_a_table_is_read_from_the_folder_of_the_case(folder: Path) -> None:
    case = case_of(folder, "table")
    assert case.track.alignment == str(folder / "lines" / "table.csv")
    alignment = case.alignment()
    assert alignment.length == 160.0
    *_, pitch, _, curvature, gauge = inclined_frame(alignment.table, 120.0)
    assert (curvature, gauge) == pytest.approx((1 / 450, 1.445))
    assert np.tan(-pitch) == pytest.approx(0.001)


def test_surveyed_points_become_an_alignment_behind_a_straight(folder: Path) -> None:
    alignment = case_of(folder, "points").alignment()
    assert alignment.sections[:2] == (Straight(30.0, 1.435), Transition(30.0))
    assert alignment.length == pytest.approx(360.0, abs=0.01)
    for s, place in ((150.0, 90.0), (270.0, 210.0)):  # middles of transition and curve
        wanted, found = inclined_frame(_known().table, place), inclined_frame(alignment.table, s)
        assert found[6] == pytest.approx(wanted[6], abs=2e-5)  # curvature
        assert np.tan(found[4]) == pytest.approx(np.tan(wanted[4]), abs=2e-4)  # gradient
        assert found[5] == 0.0  # no cant asked for


def test_keys_of_the_centre_line_are_those_of_the_fit(folder: Path) -> None:
    alignment = case_of(folder, "smoothed").alignment()
    *_, roll, curvature, gauge = inclined_frame(alignment.table, 230.0)
    assert gauge == pytest.approx(1.440)
    balance = 1.5 * (50.0 / 3.6) ** 2 / 9.81 * curvature  # 49 mm, below the 60 mm allowed
    assert -np.sin(roll) * 1.5 == pytest.approx(balance, rel=1e-3)
    assert alignment.length == pytest.approx(300.0, abs=0.01)
    assert case_of(folder, "smoothed").with_changes(
        track={"centre_line": {"largest_cant_mm": 30.0}}
    ).alignment().table.cant.max() == pytest.approx(0.030, abs=1e-5)


@pytest.mark.parametrize("way", WAYS)
def test_every_way_is_mirrored_and_written_and_read_again(folder: Path, way: str) -> None:
    case = case_of(folder, way)
    mirror = case.mirrored()
    assert mirror != case
    assert mirror.mirrored() == case
    assert mirror.with_changes(track=case.track) == case
    wanted, found = case.alignment().mirrored(), mirror.alignment()
    assert (found.sections, found.grades) == (wanted.sections, wanted.grades)
    for one in (case, mirror, case.with_changes(friction=0.2, track={"flexibility": "rigid"})):
        assert Case.from_toml(one.to_toml()) == one


def test_one_way_is_changed_for_another(folder: Path) -> None:
    table, sections = case_of(folder, "table"), case_of(folder, "sections")
    plan = {name: getattr(sections.track, name) for name in ("sections", "grades")}
    changed = table.with_changes(track={"alignment": None, **plan})
    assert changed.alignment() == sections.alignment()


RAMP = {"kind": "ramp", "length_m": 40.0, "radius_m": [-500.0, 0.0], "gauge_mm": [1435.0, 1435.0]}
PLAIN = {"kind": "straight", "length_m": 100.0}
FAULTS: dict[str, tuple[dict[str, Any], list[str]]] = {  # keys of [track]: parts of the message
    "none": ({}, ["track: none given", "exactly one of sections, alignment, centre_line"]),
    "two": ({"sections": [PLAIN], "alignment": "x.csv"}, ["sections and alignment given", "exactly one"]),
    "no such table": ({"alignment": "no/such.csv"}, ["track.alignment: no/such.csv", "No such file"]),
    "no such points": ({"centre_line": "no.csv"}, ["track.centre_line: no.csv", "No such file"]),
    "empty name": ({"alignment": ""}, ['track.alignment = ""', "allowed a file (.csv)"]),
    "misspelt": (
        {"centre_line": {"file": "x.csv", "wave_length_m": 80.0}},
        ["unknown key track.centre_line.wave_length_m = 80", '"wavelength_m"?'],
    ),
    "wavelength": (
        {"centre_line": {"file": "x.csv", "wavelength_m": 5.0}},
        ["track.centre_line.wavelength_m = 5 m", "allowed 20 to 1000 m"],
    ),
    "no file": ({"centre_line": {"wavelength_m": 80.0}}, ["track.centre_line.file is missing"]),
    "grades of a table": (
        {"alignment": "x.csv", "grades": [{"length_m": 10.0, "gradient_per_mille": 1.0}]},
        ["grades given with alignment", "allowed with sections"],
    ),
    "mirrored sections": ({"sections": [PLAIN], "alignment_mirrored": True}, ["alignment_mirrored = true"]),
    "steep": (
        {"sections": [PLAIN], "grades": [{"length_m": 10.0, "gradient_per_mille": 60.0}]},
        ["track.grades[0].gradient_per_mille = 60 per mille", "allowed -50 to 50 per mille"],
    ),
    "bent": (
        {
            "sections": [PLAIN],
            "grades": [{"length_m": 4.0, "gradient_per_mille": 0.0, "end_per_mille": 10.0}],
        },
        ["track.grades[0]: vertical radius of a Grade is 400 m", "500 m and more"],
    ),
    "jump of gradient": (
        {"sections": [PLAIN], "grades": [{"length_m": 9.0, "gradient_per_mille": g} for g in (0.0, 5.0)]},
        ["track.sections: gradient jumps from 0 to 0.005"],
    ),
    "grades too long": (
        {"sections": [PLAIN], "grades": [{"length_m": 200.0, "gradient_per_mille": 1.0}]},
        ["length of all grades is 200 m", "up to 100 m"],
    ),
    "shape": (
        {"sections": [PLAIN, {"kind": "transition", "length_m": 20.0, "shape": "blos"}]},
        ["track.sections[1].shape", "clothoid, helmert, bloss, cosine", '"bloss"?'],
    ),
    "narrow middle": (
        {"sections": [PLAIN, {"kind": "transition", "length_m": 20.0, "gauge_mm": 1420.0}, PLAIN]},
        ["track.sections[1].gauge_mm = 1420 mm", "allowed above 1425.0 up to 1470 mm"],
    ),
    "ramp radius": (
        {"sections": [RAMP | {"radius_m": [50.0, 0.0]}, PLAIN]},
        ["track.sections[0]: radius_m has 50 m", "0 in a straight, or 100 to 100000 m"],
    ),
    "ramp cant": (
        {"sections": [RAMP | {"cant_mm": [-40.0, 0.0]}, PLAIN]},
        ["track.sections[0]: cant_mm has -40 mm", "0 to 180 mm"],
    ),
    "ramp cant in a straight": (
        {"sections": [RAMP | {"cant_mm": [40.0, 40.0]}, PLAIN]},
        ["track.sections: cant jumps from -0.04 to 0 m between section 1 and section 2"],
    ),
    "ramp gauge": (
        {"sections": [RAMP | {"gauge_mm": [1500.0, 1435.0]}, PLAIN]},
        ["track.sections[0].gauge_mm = 1500 mm is too wide", "up to 1470 mm"],
    ),
    "one radius": (
        {"sections": [RAMP | {"radius_m": [500.0]}, PLAIN]},
        ["track.sections[0].radius_m", "two radii in m"],
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_one_line_with_key_value_and_range(name: str) -> None:
    track, parts = FAULTS[name]
    with pytest.raises(CaseError) as caught:
        Case(name="x", speed_km_h=60.0, friction=0.4, track=track)
    text = str(caught.value)
    assert "\n" not in text
    for part in parts:
        assert part in text


def test_a_fault_in_a_file_names_its_line(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "table.csv").write_text(TABLE.replace("80,450,left", "80,45,left"))
    (tmp_path / "case.toml").write_text(f'{HEAD}\nalignment = "table.csv"\n')
    with pytest.raises(CaseError, match=r"track\.alignment: .*table\.csv, line 4: radius_m is 45"):
        read_case(tmp_path / "case.toml")


def test_a_narrow_gauge_in_a_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "table.csv").write_text(TABLE.replace("1440", "1422"))
    (tmp_path / "case.toml").write_text(f'{HEAD}\nalignment = "table.csv"\n')
    with pytest.raises(CaseError, match=r"track\.alignment: gauge is 1422 to 1445 mm: allowed above 1425\.0"):
        read_case(tmp_path / "case.toml")
