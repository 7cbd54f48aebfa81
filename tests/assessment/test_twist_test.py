"""The twist test: its twists, its track, and unloading as springs in series have it."""

from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from two_axle_wagon import two_axle_wagon

from hh_exudyn.assessment.twist_test import twist_case, twist_limits, twist_of, twist_result
from hh_exudyn.case import Case
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.simulate import simulate
from track.course.sections import Ramp
from vehicles.catalogue import vehicle

DEMO = Case.from_toml(files("hh_exudyn").joinpath("data/demo.toml").read_text(encoding="utf-8"))
SIMPLE = DEMO.with_changes(track={"flexibility": "rigid"}, contact={"theory": "polach", "normal": "hertz"})
CONTACTS = 0.75  # m, half the lateral distance of the contacts


def cross_level(case: Case, s: float) -> float:
    """Of the sections at an arc length, right rail over left [m]."""
    start = 0.0
    for section in case.alignment().sections:
        if start <= s <= start + section.length:
            if not isinstance(section, Ramp):
                return section.state[1]
            share = (s - start) / section.length
            return section.cant[0] + share * (section.cant[1] - section.cant[0])
        start += section.length
    raise ValueError(s)


def test_twists_of_the_wagon() -> None:
    """7 - 5/1.778 and 2 + 15/6.77 per mille; two axles alone have the body's, at most 7."""
    twist = twist_of(vehicle("iore_wagon_loaded"))
    assert twist.of_bogie == pytest.approx(4.18785e-3, rel=1e-5)
    assert twist.of_body == pytest.approx(4.21566e-3, rel=1e-5)
    alone = twist_of(two_axle_wagon())
    assert (alone.wheelbase, alone.of_bogie) == (0.0, 0.0)
    assert alone.of_body == pytest.approx(4.5e-3)
    with pytest.raises(ValueError, match="suspended_wheelset has one bogie or wheelset"):
        twist_of(vehicle("suspended_wheelset"))


@pytest.mark.parametrize("curve", [False, True])
def test_track_under_the_wagon(curve: bool) -> None:
    """With the trailing bogie's first wheelset at the end of the level, both twists are as asked."""
    case = twist_case(DEMO, curve)
    twist = twist_of(vehicle("iore_wagon_loaded"))
    sections = case.alignment().sections
    ends = np.cumsum([section.length for section in sections])
    end = float(ends[-2])  # of the steep part, before the level track
    leading = [cross_level(case, end), cross_level(case, end - twist.wheelbase)]
    trailing = [
        cross_level(case, end - twist.distance),
        cross_level(case, end - twist.distance - twist.wheelbase),
    ]
    sign = -1.0 if curve else 1.0  # the cant of the curve runs out
    assert trailing[0] == pytest.approx(trailing[1], abs=1e-9)
    assert sign * (leading[0] - leading[1]) == pytest.approx(twist.of_bogie * twist.wheelbase, rel=1e-6)
    body = np.mean(leading) - np.mean(trailing)
    assert sign * body == pytest.approx(twist.of_body * twist.distance, rel=1e-6)
    if curve:
        assert leading[0] == pytest.approx(0.0, abs=1e-9)
        assert {round(1.0 / section.curvature[1]) for section in sections[1:]} == {150}
    else:
        assert leading[0] == pytest.approx(-trailing[1], rel=1e-6)  # the vehicle leans to neither side
    assert case.speed_km_h == 10.0


@pytest.mark.slow
def test_two_axles_on_a_twist(tmp_path: Path) -> None:
    """Four springs k at b on a body that does not twist: dQ = k h (b / b0)^2 / 4 for a twist of h."""
    wagon = two_axle_wagon()
    result = twist_result(simulate(twist_case(SIMPLE, False, wagon), tmp_path / "run", vehicle=wagon))
    height = twist_of(wagon).height
    expected = 1.2e6 * height * (1.0 / CONTACTS) ** 2 / 4.0
    load = wagon.mass * GRAVITY / 4.0
    assert result.unloading[[0, 3]] == pytest.approx(expected / load, rel=0.03)  # front left, rear right
    assert result.unloading[[1, 2]].max() < 0.5 * expected / load  # on the ramp that leads down
    assert np.abs(result.y_over_q).max() < 0.1


@pytest.mark.slow
def test_a_coach_on_a_twist(tmp_path: Path) -> None:
    """Primary and secondary roll stiffness in series for the body's twist, the primary for the bogie's."""
    case = SIMPLE.with_changes(vehicle="manchester_vehicle_1")
    coach = vehicle("manchester_vehicle_1")
    twist = twist_of(coach)
    primary = 4 * 1.22e6 * 1.0**2  # N m/rad of a bogie
    secondary = 2 * (430e3 * 1.0**2 + 10.5e3) + 940e3
    roll = 1.0 / (1.0 / primary + 1.0 / secondary)
    angle = twist.of_body * twist.distance / (2 * CONTACTS)
    of_body = 0.5 * roll * angle / (2 * 2 * CONTACTS)
    of_bogie = 1.22e6 * twist.of_bogie * twist.wheelbase * (1.0 / CONTACTS) ** 2 / 4.0
    load = coach.mass * GRAVITY / 8.0
    result = twist_result(simulate(twist_case(case, False), tmp_path / "run"))
    assert result.unloading[:2].max() == pytest.approx((of_body + of_bogie) / load, rel=0.01)


def test_limits_have_sources() -> None:
    limits = twist_limits()
    assert {name: limit.value for name, limit in limits.items()} == {
        "unloading": 0.6,
        "y_over_q": 1.2,
        "lift": pytest.approx(5e-3),
    }
    assert all("from memory" in limit.source and not limit.confirmed for limit in limits.values())
