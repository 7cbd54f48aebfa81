"""Rails that change along the track: pure on both sides of a change, smooth and rigorous inside."""

import math

import numpy as np
import pytest
from straight_rails import no_forces, straight_rails

from hh_exudyn.contact.friction import constant_friction
from hh_exudyn.contact.geometry.rail_tables import RailCourse, rail_at, rail_tables, surface_slope
from hh_exudyn.contact.profile import Profile, gauge_point, rail_profile, wheel_profile
from hh_exudyn.contact.profiles.spline import spline_evaluate, spline_table, uniform_table
from hh_exudyn.contact.state import Patch
from hh_exudyn.contact.types import SplineTable, WheelRailModel, WheelsetMotion
from hh_exudyn.contact.wheel_rail import wheel_rail_forces, wheel_rail_model

R0, GAUGE, CHANGE = 0.46, 1.445, 100.0
ONE, OTHER = rail_profile("60E1"), rail_profile("MB1_like")
WHEEL = wheel_profile("S1002")
COURSE = RailCourse((ONE, OTHER), (CHANGE,))
TABLES = rail_tables(COURSE, 0.5e-3)


def model(left: Profile | RailCourse, right: Profile | RailCourse) -> WheelRailModel:
    return wheel_rail_model(WHEEL, WHEEL, left, right, nominal_radius=R0)


def forces(contact: WheelRailModel, s: np.ndarray, lateral: np.ndarray, mirrored: bool = False) -> np.ndarray:
    """Y and Q of both rails, then place and angle of the deepest patches: (n, 2, 2 + 3)."""
    n = len(s)
    flip = -1.0 if mirrored else 1.0
    yaw, roll = flip * 2e-3, flip * -0.5e-4
    axle = np.tile([-math.sin(yaw), math.cos(yaw), roll], (n, 1))
    position = np.tile([0.0, 0.0, R0 - 450e-6], (n, 1))
    position[:, 1] = flip * lateral
    velocity = np.tile([15.0, 0.0, 0.0], (n, 1))
    motion = WheelsetMotion(position, axle, velocity, axle * 15.0 / R0, np.zeros((n, 2, 2)))
    rails, found = straight_rails(contact, np.full(n, GAUGE), s), no_forces(n)
    assert wheel_rail_forces(contact, motion, rails, constant_friction([[0.3, 0.3]] * n), found) == 0
    columns = [Patch.Y_WHEEL, Patch.Y_RAIL, Patch.CONTACT_ANGLE]
    return np.concatenate([found.rail_force, found.patches[:, :, 0, columns]], axis=2)


@pytest.mark.parametrize(("s", "rail"), [(-1e3, ONE), (98.999, ONE), (101.001, OTHER), (1e4, OTHER)])
def test_outside_its_ramp_a_section_has_its_own_profile(s: float, rail: Profile) -> None:
    lateral = np.linspace(-0.012, 0.012, 49)
    found = forces(model(COURSE, COURSE), np.full(49, s), lateral)
    pure = forces(model(rail, rail), np.zeros(49), lateral)
    np.testing.assert_allclose(found, pure, rtol=1e-6, atol=1e-8)
    table, point = rail_at(TABLES, s)
    own = spline_table(rail)
    offset = round((own.start - table.start) / own.step)
    assert table.start + offset * table.step == pytest.approx(own.start, abs=1e-12)
    assert np.array_equal(table.z[offset : offset + own.z.size], own.z)
    assert point == gauge_point(rail)


@pytest.mark.parametrize("lateral", [0.0, 0.006, 0.010])
def test_inside_the_ramp_nothing_jumps(lateral: float) -> None:
    """Half the step, half the largest change from step to step: forces, places and angles are continuous."""
    contact = model(RailCourse((ONE, rail_profile("MB4_like")), (CHANGE,)), ONE)

    def steps(count: int) -> np.ndarray:
        s = np.linspace(98.8, 101.2, count + 1)
        return np.asarray(np.abs(np.diff(forces(contact, s, np.full(count + 1, lateral)), axis=0)))

    coarse, fine = (steps(count)[:, 0].max(axis=0) for count in (2000, 4000))
    moved = coarse > 1e-9
    assert moved[0] and moved[1]
    np.testing.assert_allclose(fine[moved] / coarse[moved], 0.5, atol=0.08)
    assert steps(200)[:, 1].max() == 0.0  # the other rail stays


def test_slopes_in_the_ramp_are_those_of_its_heights() -> None:
    for s in (99.2, 99.9, 100.0, 100.6):
        table, _ = rail_at(TABLES, s)
        exact = uniform_table(table.start, table.step, table.z, table.second)
        np.testing.assert_allclose(table.slope, exact.slope, rtol=1e-9, atol=1e-9)


def face(table: SplineTable, point: float) -> float:
    """How far the gauge face lies behind the gauge line, 10 mm below the top [m]."""
    y = np.linspace(0.0, 0.038, 4001)
    z = np.array([spline_evaluate(table, value)[0] for value in y])
    below = int(np.argmax((z < z.max() - 0.010) & (y > 0.02)))
    return float(point - y[below])


def test_the_gauge_is_kept_in_the_ramp() -> None:
    """The gauge face goes from one rail's to the other's, although their gauge points lie 0.7 mm apart."""
    assert gauge_point(ONE) - gauge_point(OTHER) > 0.6e-3
    places = [face(*rail_at(TABLES, s)) for s in (90.0, 99.5, 100.0, 100.5, 110.0)]
    low, high = sorted((places[0], places[-1]))
    assert all(low - 0.15e-3 < place < high + 0.15e-3 for place in places)
    middle, point = rail_at(TABLES, CHANGE)
    assert point == pytest.approx(0.5 * (gauge_point(ONE) + gauge_point(OTHER)), abs=1e-12)
    assert middle.z.max() == pytest.approx(0.0, abs=2e-5)  # rail tops at one height


def test_the_surface_slope_is_the_derivative_along_the_track() -> None:
    """Of the height at a constant distance from the gauge point; zero outside the ramp."""
    step, steepest = 1e-4, 0.0
    for s in np.linspace(CHANGE - 0.95, CHANGE + 0.95, 20):
        for inside in (-0.060, -0.040, -0.020, -0.003):  # m, of the gauge point, from field side to corner
            point = rail_at(TABLES, s)[1]
            heights = []
            for place in (s - step, s + step):
                table, at = rail_at(TABLES, place)
                heights.append(spline_evaluate(table, at + inside)[0])
            expected = (heights[1] - heights[0]) / (2 * step)
            assert surface_slope(TABLES, s, point + inside) == pytest.approx(expected, abs=1e-7)
            steepest = max(steepest, abs(expected))
    assert steepest > 2e-4
    assert surface_slope(TABLES, CHANGE - 1.5, 0.0) == surface_slope(TABLES, CHANGE + 1.5, 0.0) == 0.0


def test_mirrored_rails_give_mirrored_forces() -> None:
    s, lateral = np.linspace(98.9, 101.1, 23), np.linspace(-0.01, 0.01, 23)
    there = forces(model(COURSE, ONE), s, lateral)
    back = forces(model(ONE, COURSE), s, lateral, mirrored=True)[:, ::-1] * [-1, 1, 1, 1, 1]
    np.testing.assert_allclose(back, there, rtol=1e-9, atol=1e-9)


def test_several_changes_and_equal_neighbours() -> None:
    third = rail_profile("54E1")
    course = RailCourse((ONE, OTHER, OTHER, ONE, third), (10.0, 20.0, 30.0, 40.0), change_length=4.0)
    tables = rail_tables(course, 0.5e-3)
    assert len(tables.nodes) == 3 and list(tables.sections[:, 0]) == [0, 1, 0, 2]
    assert list(tables.sections[:, 3]) == [10.0, 30.0, 40.0, math.inf]
    for s, rail in ((20.0, OTHER), (35.0, ONE), (50.0, third)):
        assert rail_at(tables, s)[1] == gauge_point(rail)
    weights = course.weights(np.array([0.0, 8.0, 9.0, 10.0, 25.0, 40.0, 1e3]))
    np.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-15)
    assert weights[3, 0] == weights[5, 4] == pytest.approx(0.5)
    assert weights[0, 0] == weights[1, 0] == weights[4, 2] == weights[6, 4] == 1.0
    assert 0.0 < weights[2, 1] < 0.5
    inside = np.array([9.0])
    expected = (course.weights(inside) @ course.gauge_points())[0]  # as the kernel blends
    assert rail_at(tables, 9.0)[1] == pytest.approx(expected, abs=1e-12)


def test_a_rail_without_field_flank_cuts_the_others() -> None:
    """A measured rail that begins 20 mm beyond its axis: 60E1 keeps what lies inside of that."""
    kept = ONE.y > -0.020
    short = Profile("measured", "rail", ONE.y[kept], ONE.z[kept])
    tables = rail_tables(RailCourse((ONE, short), (CHANGE,)), 0.5e-3)
    assert tables.sections[0, 1] == pytest.approx(-0.0207, abs=3e-4)
    lateral = np.linspace(-0.010, 0.010, 21)
    cut = forces(model(RailCourse((ONE, short), (CHANGE,)), ONE), np.zeros(21), lateral)
    np.testing.assert_allclose(cut, forces(model(ONE, ONE), np.zeros(21), lateral), rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize(
    ("course", "message"),
    [
        (lambda: RailCourse((WHEEL,)), "profile 'S1002' is of kind 'wheel', needed: 'rail'"),
        (lambda: RailCourse(()), "0 profiles with 0 changes"),
        (lambda: RailCourse((ONE, OTHER)), "2 profiles with 0 changes"),
        (lambda: RailCourse((ONE, OTHER), (math.nan,)), "a change of rails at s = nan m"),
        (lambda: RailCourse((ONE, OTHER, ONE), (5.0, 6.9)), "at s = 6.9 m behind one at 5 m"),
        (lambda: RailCourse((ONE,), (), 0.0), "change_length = 0.0 m, allowed a number > 0 m"),
    ],
)
def test_bad_courses(course: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        course()  # type: ignore[operator]
