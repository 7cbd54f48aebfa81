"""The table ``[track.check_rail]``: where check rails stand, and what is refused."""

from importlib.resources import files
from typing import Any

import pytest

from hh_exudyn.case import Case, CaseError, CheckRailCase
from hh_exudyn.case.check_rail import check_rails
from hh_exudyn.contact.profile import wheel_profile
from hh_exudyn.conventions import LEFT, RIGHT
from track.course.alignment import Alignment, Curve, Straight, Transition

S1002 = wheel_profile("S1002")
RIGHT_THEN_LEFT = Alignment(
    (
        Straight(40.0),
        Transition(30.0),
        Curve(50.0, radius=250.0, hand="right", cant=0.05),
        Transition(30.0),
        Straight(20.0),
        Transition(30.0),
        Curve(60.0, radius=400.0, hand="left", cant=0.05),
    )
)


def given(**changes: Any) -> CheckRailCase:
    return CheckRailCase(**({"flangeway_mm": 44.0, "below_radius_m": 500.0} | changes))


def test_it_stands_beside_the_inner_rail_of_curves_that_are_tight_enough() -> None:
    stretches = given().described(RIGHT_THEN_LEFT).stretches
    assert [side for side, _, _ in stretches] == [LEFT, RIGHT]
    (_, start, end), (_, first, last) = stretches
    # the right-hand curve from 70 to 120 m, and of its transitions the half that is tighter than 500 m
    assert (first, last) == (pytest.approx(55.0, abs=1.0), pytest.approx(135.0, abs=1.0))
    assert (start, end) == (pytest.approx(194.0, abs=1.0), pytest.approx(260.0, abs=1.0))
    (only,) = given(below_radius_m=300.0).described(RIGHT_THEN_LEFT).stretches
    assert only[0] == RIGHT


def test_it_stands_where_the_case_says() -> None:
    both = given(below_radius_m=None, from_m=10.0, to_m=30.0, side="both").described(RIGHT_THEN_LEFT)
    assert both.stretches == ((LEFT, 10.0, 30.0), (RIGHT, 10.0, 30.0))
    assert both.flangeway == pytest.approx(0.044)
    assert given(side="left").mirrored().side == "right"
    assert given().mirrored() == given()


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"from_m": 1.0, "to_m": 2.0}, "allowed either below_radius_m or from_m and to_m"),
        ({"below_radius_m": None}, "allowed either below_radius_m or from_m and to_m"),
        ({"below_radius_m": None, "from_m": 1.0}, "from_m and to_m together"),
        ({"below_radius_m": None, "from_m": 9.0, "to_m": 2.0}, "to_m = 2 m: allowed more than from_m = 9 m"),
        ({"flangeway_mm": -41.0}, "greater than or equal to 25"),
        ({"side": "outer"}, "'inner', 'left', 'right' or 'both'"),
    ],
)
def test_a_table_that_says_no_place_or_a_wrong_number_is_refused(
    changes: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        given(**changes)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"below_radius_m": 200.0}, "below_radius_m = 200 m: no curve of the track is that tight"),
        ({"below_radius_m": None, "from_m": 0.0, "to_m": 20.0}, "no curve there has an inner rail"),
        ({"flangeway_mm": 33.0}, r"flangeway_mm = 33 mm: allowed 33.5 mm and more, for a flange of 32.5 mm"),
        ({"flangeway_mm": 37.0, "side": "both"}, r"allowed 37.5 mm and more with check rails on both sides"),
    ],
)
def test_a_check_rail_that_stands_nowhere_or_in_the_way_is_refused(
    changes: dict[str, Any], message: str
) -> None:
    with pytest.raises(CaseError, match=f"track.check_rail.*{message}"):
        check_rails(given(**changes), RIGHT_THEN_LEFT, [(S1002, S1002)], 1.360, 0.46)
    assert check_rails(None, RIGHT_THEN_LEFT, [(S1002, S1002)], 1.360, 0.46).stretches.size == 0


def test_a_case_with_check_rails_is_written_and_read_again() -> None:
    text = (files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
    case = Case.from_toml(text).with_changes(
        track={"check_rail": {"flangeway_mm": 44.0, "side": "left", "from_m": 60.0, "to_m": 200.0}}
    )
    assert Case.from_toml(case.to_toml()) == case
    assert case.mirrored().track.check_rail.side == "right"
    assert Case.from_toml(text).to_toml().count("check_rail") == 0
