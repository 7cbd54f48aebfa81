"""A flange back on a check rail: where it touches, how hard, what friction does, what is refused."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from straight_rails import no_forces, straight_rails
from wheelset_state import GAUGE, MODEL, R0, State

from hh_exudyn.contact.check_rail.forces import check_rail_forces
from hh_exudyn.contact.check_rail.table import (
    BACK_COLUMNS,
    BackContact,
    CheckRail,
    CheckRailTable,
    back_depth,
    check_rail_table,
)
from hh_exudyn.contact.friction import constant_friction
from hh_exudyn.contact.hertz import hertz_patch
from hh_exudyn.contact.profile import Profile, wheel_profile
from hh_exudyn.contact.types import ContactForces, WheelsetMotion
from hh_exudyn.contact.wheel_rail import wheel_rail_forces
from hh_exudyn.conventions import BACK_TO_BACK, LEFT, RIGHT

SPEED, FLANGEWAY = 15.0, 0.041
HEIGHT = R0 - 60e-6  # m, of the wheelset's centre: some 20 kN a wheel
STOP = 0.5 * GAUGE - FLANGEWAY - 0.5 * BACK_TO_BACK  # 717.5 - 41 - 680 = -3.5 mm: to the right by 3.5 mm
S1002 = wheel_profile("S1002")


GIVEN = {
    "stretches": ((LEFT, -50.0, 50.0),), "flangeway": FLANGEWAY, "height": 0.020, "corner_radius": 0.013,
    "flare_length": 3.0, "flare_opening": 0.040, "friction": 0.3, "stiffness": 100e6,
}  # fmt: skip


def table(**changes: Any) -> CheckRailTable:
    given = GIVEN | changes
    return check_rail_table(CheckRail(**given), [(S1002, S1002)], BACK_TO_BACK, R0)


RAIL = table()


def solve(
    y: float, yaw: float = 0.0, check: CheckRailTable = RAIL, place: float = 0.0, rails_too: bool = False
) -> tuple[ContactForces, np.ndarray, State]:
    """Forces and the records of both backs of a wheelset that rolls."""
    state = State(height=HEIGHT)
    state.position[0, 1] = y
    state.point(yaw)
    state.roll_on(SPEED)
    motion = WheelsetMotion(
        state.position, state.axle, state.velocity, state.angular_velocity, state.creep_lag
    )
    rails = straight_rails(MODEL, state.gauge, np.array([place]))
    forces = no_forces(1, 0.0)
    if rails_too:
        assert wheel_rail_forces(MODEL, motion, rails, constant_friction([[0.0, 0.0]]), forces) == 0
    records = np.full((1, 2, BACK_COLUMNS), np.nan)
    assert check_rail_forces(check, MODEL, motion, rails, forces, records) == 0
    return forces, records[0], state


def touch(yaw: float, check: CheckRailTable = RAIL) -> float:
    """Lateral place at which a stiff check rail begins to carry [m]."""
    low, high = -8e-3, 1e-3
    while high - low > 1e-7:
        y = 0.5 * (low + high)
        if solve(y, yaw, check)[1][0, BackContact.NORMAL_FORCE] > 0.0:
            low = y
        else:
            high = y
    return low


def drawn_touch(yaw: float) -> float:
    """The same from the drawings: points of a wheel's back, turned, against the outline of the check rail."""
    depth = back_depth(S1002)
    angle = np.concatenate([[0.0], np.linspace(0.0, 1.1, 600)])
    radii = R0 + depth + 20.5e-3 * np.sin(angle)
    radii[0] = R0 - 0.03  # of the plane
    axial = 0.5 * BACK_TO_BACK + 20.5e-3 * (1.0 - np.cos(angle))
    axial[0] = axial[1]
    around = np.linspace(-0.6, 0.6, 1201)
    x = radii[:, None] * np.sin(around) - axial[:, None] * math.sin(yaw)
    y = radii[:, None] * np.sin(around) * math.sin(yaw) + axial[:, None] * math.cos(yaw)
    z = HEIGHT - radii[:, None] * np.cos(around) + 0.0 * x
    rise = z - (0.020 - 0.013)
    arc = 0.013 - np.sqrt(np.maximum(0.013**2 - rise**2, 0.0))
    back = np.where(rise > 0.0, arc, rise**2 / 2.0)
    face = 0.5 * GAUGE - FLANGEWAY - back
    return float(np.where(rise < 0.012, face - y, np.inf).max(where=rise < 0.012, initial=-np.inf))


def test_a_straight_wheelset_is_stopped_where_the_drawing_says() -> None:
    assert touch(0.0) == pytest.approx(STOP, abs=5e-6)


@pytest.mark.parametrize("yaw", [-0.002, -0.010, -0.020, 0.010])
def test_an_angle_of_attack_stops_it_earlier_as_the_yawed_shape_says(yaw: float) -> None:
    found = touch(yaw)
    assert found == pytest.approx(drawn_touch(yaw), abs=1e-5)
    assert found - STOP > 0.05 * abs(yaw)
    record = solve(found - 0.2e-3, yaw)[1][0]
    assert record[BackContact.X_SHIFT] * -yaw > 0.0  # the end of the chord that points to the check rail
    assert 0.10 < abs(record[BackContact.X_SHIFT]) < 0.16


@pytest.mark.parametrize("yaw", [0.0, -0.0003, -0.005])
def test_the_force_is_continuous_and_grows_with_the_overlap(yaw: float) -> None:
    places = np.arange(touch(yaw), touch(yaw) - 0.6e-3, -4e-6)
    normal = np.array([solve(y, yaw)[1][0, BackContact.NORMAL_FORCE] for y in places])
    change = np.diff(normal)
    assert change.min() > 0.0
    assert change.max() < 100e6 * 4e-6 * 1.03  # no stiffer than what carries the check rail; edges are soft
    assert normal[-1] > 40e3


def test_from_one_end_of_the_chord_to_the_other_nothing_jumps() -> None:
    """About zero yaw the contact goes 0.24 m along the rail, within some tenths of a milliradian."""
    yaws = np.arange(-0.3e-3, 0.3e-3, 1e-6)
    records = np.array([solve(STOP - 0.3e-3, yaw)[1][0] for yaw in yaws])
    normal, shift = records[:, BackContact.NORMAL_FORCE], records[:, BackContact.X_SHIFT]
    assert np.abs(np.diff(normal)).max() < 2e-3 * normal.min()
    assert np.abs(np.diff(normal * shift)).max() < 0.015 * np.abs(normal * shift).max()
    assert np.all(np.diff(shift) < 1e-6)


def test_a_mirrored_wheelset_has_mirrored_forces_bit_for_bit() -> None:
    forces, records, _ = solve(-3.4e-3, -0.006)
    other, mirrored, _ = solve(3.4e-3, 0.006, table(stretches=((RIGHT, -50.0, 50.0),)))
    assert forces.wrench[0] @ np.ones(6) != 0.0
    assert np.array_equal(forces.wrench[0] * [1, -1, 1, -1, 1, -1], other.wrench[0])
    assert np.array_equal(forces.rail_force[0, 0] * [-1, 1], other.rail_force[0, 1])
    same = [column for column in BackContact if column != BackContact.FORCE_Y]
    assert np.array_equal(records[0, same], mirrored[1, same])
    assert not records[1].any()


@pytest.mark.parametrize("yaw", [-0.005, -0.010, -0.020])
def test_it_is_hertz_contact_on_a_spring(yaw: float) -> None:
    """Curvatures of the yawed wheel from the drawing; Hertz's approach and the spring make up the overlap.

    The pressure is 15 to 25 % below Hertz's of the arc: the flat face below the arc carries too.
    """
    overlap = 0.6e-3
    first = touch(yaw)
    record = solve(first - overlap, yaw)[1][0]
    start = solve(first - 2e-6, yaw)[1][0]
    x, below = start[BackContact.X_SHIFT], HEIGHT - start[BackContact.HEIGHT]

    def back(x: float, below: float) -> float:
        beyond = np.hypot(x, below) - R0 - back_depth(S1002)
        return 20.5e-3 - math.sqrt(20.5e-3**2 - max(beyond, 0.0) ** 2)

    h = 1e-4
    along = (back(x + h, below) + back(x - h, below) - 2.0 * back(x, below)) / h**2
    upright = (back(x, below + h) + back(x, below - h) - 2.0 * back(x, below)) / h**2 + 1.0 / 0.013
    corners = back(x + h, below + h) + back(x - h, below - h) - back(x + h, below - h)
    skew = (corners - back(x - h, below + h)) / (4.0 * h**2)
    low, high = 0.5 * np.linalg.eigvalsh([[along, skew], [skew, upright]])

    def excess(load: float) -> float:
        return hertz_patch(load, low, high).approach + load / 100e6 - overlap

    force = record[BackContact.NORMAL_FORCE]
    assert force == pytest.approx(brentq(excess, 1e2, 1e6), rel=0.05)
    assert 0.7 < record[BackContact.P_MAX] / hertz_patch(force, low, high).max_pressure < 1.0


def test_friction_is_full_and_against_the_slip() -> None:
    forces, records, state = solve(-3.2e-3, -0.010)
    record = records[0]
    normal = record[BackContact.NORMAL_FORCE]
    force = record[[BackContact.FORCE_X, BackContact.FORCE_Y, BackContact.FORCE_Z]]
    frictionless = solve(-3.2e-3, -0.010, table(friction=0.0))[1][0]
    friction = force - frictionless[[BackContact.FORCE_X, BackContact.FORCE_Y, BackContact.FORCE_Z]]
    assert np.linalg.norm(friction) == pytest.approx(0.3 * normal, rel=2e-3)
    assert friction[2] > 0.29 * normal  # ahead of the axle the back goes down
    assert friction[0] < 0.0  # 7 mm above the running circle's level, but the chord's slip is forwards
    assert 0.2 < record[BackContact.CREEPAGE] < 0.35
    power = forces.wrench[0, :3] @ state.velocity[0] + forces.wrench[0, 3:] @ state.angular_velocity[0]
    assert power == pytest.approx(-record[BackContact.POWER], rel=0.02)


def test_a_wheelset_pushed_sideways_is_held_by_both_rails() -> None:
    """Without friction the forces on the rails add up to the push, and the check rail takes most of it."""

    def lateral(y: float) -> float:
        return float(solve(y, -0.005, rails_too=True)[0].wrench[0, 1])

    push = 40e3
    y = brentq(lambda y: lateral(y) - push, -4.5e-3, -2.0e-3, xtol=1e-10)
    forces, records, _ = solve(y, -0.005, rails_too=True)
    assert -forces.rail_force[0, :, 0].sum() == pytest.approx(push, rel=1e-6)
    assert records[0, BackContact.FORCE_Y] > 0.5 * push


def test_where_it_ends_it_flares_out() -> None:
    inside = solve(-3.6e-3, 0.0, place=49.0)[1][0, BackContact.NORMAL_FORCE]
    flare = [
        solve(-5e-3, 0.0, place=50.0 + ds)[1][0, BackContact.NORMAL_FORCE] for ds in (0.2, 0.4, 0.6, 0.9)
    ]
    assert inside == pytest.approx(solve(-3.6e-3)[1][0, BackContact.NORMAL_FORCE], rel=1e-12)
    assert flare == sorted(flare, reverse=True)
    assert flare[0] > 0.0 == flare[-1]
    assert not solve(-5e-3, place=60.0)[1].any()


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"flangeway": -0.041}, "flangeway = -0.041 m, allowed 0.025 .. 0.12 m"),
        ({"height": 0.2}, "height = 0.2 m, allowed -0.015 .. 0.08 m"),
        ({"stiffness": math.nan}, "stiffness = nan N/m"),
        ({"stretches": ((0, 0.0, 1.0),)}, "side = 0, allowed 1"),
        ({"stretches": ((1, 5.0, 1.0),)}, "from s = 5 to 1 m"),
    ],
)
def test_bad_numbers_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        table(**changes)


def test_the_back_hangs_on_the_flange_tip() -> None:
    assert back_depth(S1002) == pytest.approx(9.519e-3, abs=1e-6)
    worn = Profile("worn", "wheel", S1002.y, np.where(S1002.y > 20e-3, S1002.z - 2e-3, S1002.z))
    assert back_depth(worn) == pytest.approx(11.519e-3, abs=1e-6)
