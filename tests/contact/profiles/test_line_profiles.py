"""The line's stand-in profiles: what the thesis says of the real ones (1.1.4, Table 1-8, Fig. 1-13, 1-14).

The thesis shows curves without numbers: its statements are orders, and tested as orders.
"""

import math

import numpy as np
import pytest

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.functions import ContactFunctions, contact_functions, contiguous
from hh_exudyn.contact.geometry.conicity import conicity_from_radius_difference
from hh_exudyn.contact.profile import (
    RAIL_PROFILES,
    WHEEL_PROFILES,
    gauge_point,
    rail_profile,
    wheel_profile,
)
from hh_exudyn.contact.profiles.malmbanan import LINE_RAILS, LINE_WHEELS
from hh_exudyn.contact.profiles.measures import flange_height, flange_steepness, flange_thickness
from hh_exudyn.contact.profiles.spline import spline_table

RADIUS = 0.457  # m; the statements do not depend on it
INCLINATION = 1 / 30  # thesis, Fig. 1-12
NOMINAL, AVERAGE = 1.435, 1.445  # m, gauges of Fig. 1-13
LATERAL = np.linspace(-11e-3, 11e-3, 441)
AMPLITUDES = np.arange(1.0, 7.0) * 1e-3
RAILS = ("60E1", "MB4_like", "MB1_like")
PAIRS = (("60E1", "60E1"), ("MB4_like", "MB4_like"), ("MB1_like", "MB4_like"), ("MB1_like", "60E1"))


@pytest.fixture(scope="module")
def contacts() -> dict[tuple[str, float], ContactFunctions]:
    """The left wheel on each rail at both gauges."""
    wheel = wheel_profile("WP4_like")
    return {
        (rail, gauge): contact_functions(
            wheel, rail_profile(rail, INCLINATION), lateral=LATERAL, radius=RADIUS, gauge=gauge
        )
        for rail in RAILS
        for gauge in (NOMINAL, AVERAGE)
    }


def conicities(contacts: dict[tuple[str, float], ContactFunctions], gauge: float) -> dict[tuple, FloatArray]:
    """Of the pairs of Table 1-7; the right rail is the mirror of a left one."""
    found = {}
    for left, right in PAIRS:
        difference = contacts[left, gauge].rolling_radius - contacts[right, gauge].rolling_radius[::-1]
        first, last = contiguous(difference)
        found[left, right] = conicity_from_radius_difference(
            LATERAL[first:last], difference[first:last], radius=RADIUS, tape_distance=1.5,
            amplitudes=AMPLITUDES,
        )  # fmt: skip
    return found


@pytest.mark.parametrize(("gauge", "best"), [(NOMINAL, "60E1"), (AVERAGE, "MB4_like")])
def test_which_rails_have_the_highest_conicity(
    contacts: dict[tuple[str, float], ContactFunctions], gauge: float, best: str
) -> None:
    """Fig. 1-13: UIC60 on both sides at 1435 mm, MB4 on both sides at 1445 mm."""
    found = conicities(contacts, gauge)
    highest = found.pop((best, best))
    for other in found.values():
        assert (highest > other).all()
    assert (highest > 0.05).all() and (highest < 0.4).all()  # what freight wagons live with


def covered(position: FloatArray) -> int:
    """How many millimetres of a profile touch."""
    return len(np.unique(np.floor(1e3 * position[np.isfinite(position) & (np.abs(LATERAL) <= 8e-3)])))


def test_60e1_spreads_the_contact_most_and_mb1_least(
    contacts: dict[tuple[str, float], ContactFunctions],
) -> None:
    """Fig. 1-14, on the wheel and on the rail."""
    on_rail = [covered(contacts[rail, NOMINAL].y_rail) for rail in RAILS]
    on_wheel = [covered(contacts[rail, NOMINAL].y_wheel) for rail in RAILS]
    assert on_rail[0] > on_rail[1] > on_rail[2]
    assert on_wheel[0] > on_wheel[1] > on_wheel[2]


def leap(wheel: str, rail: str, gauge: float) -> tuple[FloatArray, FloatArray]:
    """Contact angle [degrees] and position on the rail [mm] on both sides of the outer wheel's longest leap
    to its flange, displacements 0.05 mm apart."""
    outer = contact_functions(
        wheel_profile(wheel), rail_profile(rail, INCLINATION), lateral=np.arange(0.0, 22e-3, 0.05e-3),
        radius=RADIUS, gauge=gauge,
    )  # fmt: skip
    k = int(np.argmax(np.diff(outer.y_rail) * (outer.contact_angle[1:] > math.radians(40.0))))
    return np.degrees(outer.contact_angle[k : k + 2]), 1e3 * outer.y_rail[k : k + 2]


@pytest.mark.parametrize("gauge", [NOMINAL, AVERAGE])
@pytest.mark.parametrize("wheel", LINE_WHEELS)
def test_relief_gives_two_point_contact_on_the_outer_wheel(wheel: str, gauge: float) -> None:
    """Moving outwards, the contact leaps from the tread to the flange: where it leaps, both carry. On a 60E1
    it moves around the gauge corner."""
    for rail in ("MB4_like", "MB1_like"):
        angle, y_rail = leap(wheel, rail, gauge)
        assert angle[0] < 20.0
        assert angle[1] > 45.0
        assert np.diff(y_rail) > 8.0
    assert np.diff(leap(wheel, "60E1", gauge)[1]) < 1.0


@pytest.mark.parametrize("gauge", [NOMINAL, AVERAGE])
@pytest.mark.parametrize("wheel", LINE_WHEELS)
def test_the_gauge_corner_of_mb1_is_never_touched(wheel: str, gauge: float) -> None:
    """Up to the flange's face no displacement touches the rail between 18 mm from its axis and the face."""
    found = contact_functions(
        wheel_profile(wheel), rail_profile("MB1_like", INCLINATION), lateral=np.linspace(-22e-3, 22e-3, 881),
        radius=RADIUS, gauge=gauge,
    )  # fmt: skip
    until = found.lateral < found.lateral[np.nanargmax(found.contact_angle)]
    assert not ((found.y_rail[until] > 18e-3) & (found.y_rail[until] < 34e-3)).any()
    assert (found.y_rail > 34e-3).any()


@pytest.mark.parametrize(
    ("name", "expected"), [("WP4_like", (26.89, 29.08, 10.07)), ("WPL9_like", (32.5, 28.0, 10.8))]
)
def test_flange_measures(name: str, expected: tuple[float, float, float]) -> None:
    """Table 1-8, new wheel; the locomotive's flange is that of an S1002."""
    wheel = wheel_profile(name)
    found = flange_thickness(wheel), flange_height(wheel), flange_steepness(wheel)
    assert 1e3 * np.array(found) == pytest.approx(expected, abs=0.005)


@pytest.mark.parametrize("name", LINE_WHEELS)
def test_wheels_are_smooth(name: str) -> None:
    """From the field side to the flange tip: no kink, no curvature beyond that of the tip's arc."""
    wheel = wheel_profile(name)
    front = slice(0, int(np.argmin(wheel.z)))
    angle = np.arctan2(np.diff(wheel.z[front]), np.diff(wheel.y[front]))
    length = np.hypot(np.diff(wheel.z[front]), np.diff(wheel.y[front]))
    assert np.abs(np.diff(angle) / length[1:]).max() < 1.0 / 11.9e-3
    tread = wheel.y[front][:-1] < 0.03
    assert (np.diff(angle[tread[: len(angle)]]) < 1e-9).all()  # hollow or straight: it only gets steeper
    assert wheel.y[-1] == pytest.approx(0.07, abs=1e-9)  # the flange back


@pytest.mark.parametrize("name", LINE_RAILS)
def test_rails_are_60e1_ground_on_the_gauge_side(name: str) -> None:
    """Nothing is added, nothing taken from the field side, no hollow is ground in."""
    at = np.linspace(-0.036, 0.0355, 300)
    removed = lowered(name, at)
    assert removed.min() > -1e-9
    assert removed[at < -0.015] == pytest.approx(0.0, abs=1e-9)
    # the more, the nearer to the gauge face; in front of it less, for its flank is that of the 60E1
    assert np.diff(removed[at < 0.0345]).min() > -1e-9
    # a blunter corner goes into the flank lower than the gauge point
    back = gauge_point(rail_profile("60E1", 0.0)) - gauge_point(rail_profile(name, 0.0))
    assert 0.0 < back < 0.5e-3
    ground = rail_profile(name, 0.0)
    angle = np.arctan2(np.diff(ground.z), np.diff(ground.y))
    assert (np.diff(angle)[np.abs(ground.y[1:-1]) < 0.0355] < 1e-6).all()


def lowered(name: str, at: FloatArray) -> FloatArray:
    """How much lower than a 60E1 a rail lies [m], both upright with their field sides together."""
    new, ground = rail_profile("60E1", 0.0), rail_profile(name, 0.0)
    # every profile has its own top at zero: grinding of the crown shows on the field side
    shift = ground.z[0] - new.z[0]
    return np.interp(at, new.y, new.z) - np.interp(at, ground.y, ground.z - shift)


def test_mb4_is_slightly_ground_and_mb1_more() -> None:
    at = np.linspace(0.02, 0.034, 100)
    mb4, mb1 = lowered("MB4_like", at), lowered("MB1_like", at)
    assert (mb1 > mb4).all()
    assert mb4.max() < 1.1e-3


def test_stand_ins_are_known_by_name_like_the_standard_ones() -> None:
    assert set(LINE_WHEELS) == {"WP4_like", "WPL9_like"} <= set(WHEEL_PROFILES)
    assert set(LINE_RAILS) == {"MB1_like", "MB4_like"} <= set(RAIL_PROFILES)
    assert rail_profile("MB4_like", INCLINATION).name == "MB4_like 1:30"
    for name in LINE_WHEELS:
        assert np.isfinite(spline_table(wheel_profile(name)).second).all()
    assert math.isclose(rail_profile("MB1_like", INCLINATION).z.max(), 0.0)
