"""Rails of a case: by side, by section, along the track, and from a line's section."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hh_exudyn.case import Case, CaseError, read_case
from hh_exudyn.case.line import case_on, section_name
from hh_exudyn.contact.geometry.rail_tables import rail_at
from hh_exudyn.contact.profile import gauge_point, rail_profile
from hh_exudyn.conventions import LEFT, RIGHT
from track.line.line import load_sections, read_line
from track.rails import Rails

SECTIONS: list[dict[str, Any]] = [
    {"kind": "straight", "length_m": 100.0},
    {"kind": "transition", "length_m": 40.0},
    {"kind": "curve", "length_m": 80.0, "radius_m": 450.0, "hand": "left", "cant_mm": 65.0,
     "rail_high": "MB1_like"},
    {"kind": "transition", "length_m": 20.0},
    {"kind": "curve", "length_m": 80.0, "radius_m": 500.0, "hand": "right", "cant_mm": 65.0,
     "rail_high": "MB1_like", "rail_low": "MB4_like"},
    {"kind": "transition", "length_m": 40.0},
    {"kind": "straight", "length_m": 10.0, "rail": "54E1"},
    {"kind": "straight", "length_m": 10.0, "rail": "54E1", "rail_right": "54E2"},
]  # fmt: skip


def case(**track: Any) -> Case:
    return Case(name="rails", speed_km_h=60.0, friction=0.4, track={"sections": SECTIONS, **track})


def names(of: Case, s: float) -> tuple[str, str]:
    rails = of.track.rails_along().at(s).rails
    return rails.left, rails.right


def test_the_high_rail_is_the_right_one_in_a_left_hand_curve() -> None:
    found = case()
    assert [part.start for part in found.track.rails_along().sections] == [0.0, 120.0, 230.0, 340.0, 370.0]
    assert names(found, 119.9) == ("60E1", "60E1")
    assert names(found, 180.0) == ("60E1", "MB1_like")  # changed in the middle of the transition
    assert names(found, 280.0) == ("MB1_like", "MB4_like")
    assert names(found, 365.0) == ("54E1", "54E1") and names(found, 380.0) == ("54E1", "54E2")
    mirror = found.mirrored()
    for s in (0.0, 180.0, 280.0, 365.0, 380.0):
        assert names(mirror, s) == names(found, s)[::-1]
    assert mirror.mirrored() == found


def test_the_track_has_rails_by_side() -> None:
    found = case(rail="54E1", rail_right="60E2")
    assert found.track.rails == Rails("54E1", "60E2", 1 / 30)
    assert names(found, 0.0) == ("54E1", "60E2") == names(found.mirrored(), 0.0)[::-1]
    assert names(found, 180.0) == ("54E1", "MB1_like")
    assert names(found, 365.0) == ("54E1", "54E1")  # `rail` of a section is for both sides


def test_the_contact_has_the_rails_of_the_case() -> None:
    model = case(inclination="1:20").contact_model()
    for tables, s, name in (
        (model.rails_left, 0.0, "60E1"),
        (model.rails_left, 280.0, "MB1_like"),
        (model.rails_right, 180.0, "MB1_like"),
        (model.rails_right, 400.0, "54E2"),
    ):
        assert rail_at(tables, s)[1] == gauge_point(rail_profile(name, 1 / 20))
    course = case().track.rail_course(LEFT)  # only where the left rail changes
    assert course.changes == (230.0, 340.0) and len(course.profiles) == 3
    assert len(Case(name="x", speed_km_h=60.0, friction=0.4,
                    track={"sections": SECTIONS[:1]}).track.rail_course(RIGHT).profiles) == 1  # fmt: skip


def test_rails_stand_in_the_file_and_start_at_its_folder(tmp_path: Path) -> None:
    rail = rail_profile("60E1")
    np.savetxt(tmp_path / "worn.txt", np.column_stack([rail.y, rail.z]) * 1000, fmt="%.8f")
    found = case()
    text = found.to_toml().replace('rail_low = "MB4_like"', 'rail_low = "./worn.txt"')
    path = tmp_path / "case.toml"
    path.write_text(text)
    read = read_case(path)
    assert names(read, 280.0) == ("MB1_like", str(tmp_path / "worn.txt"))
    assert Case.from_toml(found.to_toml()) == found and Case.from_toml(read.to_toml()) == read


@pytest.mark.parametrize(
    ("index", "change", "parts"),
    [
        (2, {"rail_high": "61E1"}, ["track.sections[2].rail_high", '"61E1"', "60E1", "MB1_like"]),
        (6, {"rail": "no/such.txt"}, ["track.sections[6].rail", "not found"]),
        (2, {"rail": "60E1"}, ["unknown key track.sections[2].rail"]),
        (0, {"rail_high": "60E1"}, ["unknown key track.sections[0].rail_high"]),
        (1, {"rail": "60E1"}, ["unknown key track.sections[1].rail"]),
        (6, {"length_m": 1.5, "rail": "60E1"}, ["allowed at least rail_change_m = 25 m apart"]),
    ],
)
def test_rails_that_are_not_allowed(index: int, change: dict[str, Any], parts: list[str]) -> None:
    changed = [dict(section) for section in SECTIONS]
    changed[index] |= change
    with pytest.raises(CaseError) as caught:
        case(sections=changed, rail_change_m=25.0)
    assert all(part in str(caught.value) for part in parts), str(caught.value)


def test_a_line_becomes_cases() -> None:
    """Every section of Malmbanan: geometry, rails, gauge and speed are those of the line."""
    base = case(rail="MB4_like", flexibility="wooden")
    sections = load_sections(read_line("malmbanan"), "iore_wagon_loaded", quality="QN1")
    assert len({section_name(section) for section in sections}) == len(sections)
    hands = set()
    for section in sections:
        found = case_on(base, section, length=120.0, approach=40.0)
        hands.add(section.hand)
        assert found.alignment().sections == section.alignment(120.0, 40.0).sections
        assert found.speed == pytest.approx(section.speed)
        assert found.track.flexibility == "wooden"
        rails = found.track.rails_along().at(found.alignment().length).rails
        assert (rails.left, rails.right) == (section.rails.left, section.rails.right)
        assert rails.inclination == pytest.approx(section.rail_inclination)
        if not math.isinf(section.radius):
            assert names(found, 0.0) == ("MB4_like", "MB4_like")
            assert (rails.right if section.hand == "left" else rails.left) == section.pair.high
    assert hands == {"left", "right", "straight"}
