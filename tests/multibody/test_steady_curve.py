"""The demo's steady curve against statics, energy, and what an ore wagon does."""

import numpy as np
import pytest
from run_tables import steady, table, wheel_means

from hh_exudyn.contact.profile import gauge_point, rail_profile
from hh_exudyn.conventions import GRAVITY, RAIL_TOP_DISTANCE
from hh_exudyn.multibody.simulate import simulate
from track.alignment import rotation, track_frame
from vehicles.catalogue import vehicle

RADIUS, CANT, GAUGE = 450.0, 0.065, 1.445
UP = np.array([0.0, 0.0, 1.0])
ROLL = np.arcsin(CANT / RAIL_TOP_DISTANCE)
WAGON = vehicle("iore_wagon_loaded")


@pytest.fixture(scope="module")
def contact(demo_run):
    return steady(table(demo_run, "contact"))


def test_the_run_reached_a_steady_state(contact):
    """Q and Y of every wheel move by less than 0.5 kN over the last two seconds."""
    first = contact.patch == 0
    for w in (1, 2, 3, 4):
        for side in (1, -1):
            wheel = first & (contact.wheelset == w) & (contact.side == side)
            assert np.ptp(contact.Q[wheel]) < 500.0
            assert np.ptp(contact.Y[wheel]) < 500.0


def test_lateral_forces_carry_the_cant_deficiency(contact):
    """Forces on the rails, to the left: m (g sin - v^2/R cos) of the left-hand curve, within 1 %."""
    to_the_left = (wheel_means(contact, "Y") * [1, -1]).sum()
    speed = contact.speed.mean()
    expected = WAGON.mass * (GRAVITY * np.sin(ROLL) - speed**2 / RADIUS * np.cos(ROLL))
    assert to_the_left == pytest.approx(expected, rel=0.01)
    assert to_the_left < 0.0  # cant deficiency: the outer, right rail carries the lateral force


def test_vertical_forces_carry_the_weight(contact):
    speed = contact.speed.mean()
    expected = WAGON.mass * (GRAVITY * np.cos(ROLL) + speed**2 / RADIUS * np.sin(ROLL))
    assert wheel_means(contact, "Q").sum() == pytest.approx(expected, rel=1e-3)


def test_wheel_load_difference_carries_the_overturning_moment(demo, demo_run):
    """Moment of all contact forces about the track under the wagon's middle, at the run's last output.

    Against weight, centripetal acceleration and the gyroscopic moment of the wheelsets, within 2 %; every
    contact in its own track frame, every body where it is. About 40 kN m, 57 kN of load from the inner to
    the outer wheels.
    """
    contact, motion = steady(table(demo_run, "contact"), 1e-6), steady(table(demo_run, "motion"), 1e-6)
    alignment = demo.alignment().table
    middle, axes = frame(alignment, motion.s[motion.body == "car_body"][0])
    rail = rail_profile("60E1", inclination=1 / 30)
    found = np.zeros(3)
    for k in range(contact.time.size):
        origin, local = frame(alignment, contact.s[k])
        side, roll = contact.side[k], contact.side[k] * contact.contact_angle[k]
        tilt = np.array([[np.cos(roll), -np.sin(roll)], [np.sin(roll), np.cos(roll)]])
        left, up = tilt @ [contact.force_y[k], contact.normal_force[k]]
        place = [
            contact.x_shift[k],
            side * (GAUGE / 2 + gauge_point(rail) - contact.y_rail[k]),
            np.interp(contact.y_rail[k], rail.y, rail.z),
        ]
        force = local @ [contact.force_x[k], left, up]
        found += np.cross(origin + local @ place - middle, force)

    wanted = np.zeros(3)
    for i, body in enumerate(WAGON.bodies):
        position = np.array([motion.x[i], motion.y[i], motion.z[i]])
        speed = np.hypot(motion.vx[i], motion.vy[i])
        inwards = frame(alignment, motion.s[i])[1][:, 1] * [1.0, 1.0, 0.0]
        pull = speed**2 / RADIUS * inwards / np.linalg.norm(inwards)
        wanted += np.cross(position - middle, body.mass * (pull + GRAVITY * UP))
        if body.kind == "wheelset":
            spin = body.inertia[1] * motion.wy[i] * frame(alignment, motion.s[i])[1][:, 1]
            wanted += np.cross([0.0, 0.0, speed / RADIUS], spin)
    assert found @ axes[:, 0] == pytest.approx(wanted @ axes[:, 0], rel=0.02)
    loads = wheel_means(contact, "Q")
    assert (loads[:, 1] > loads[:, 0] + 10e3).all()  # cant deficiency loads the outer, right wheels


def frame(alignment, s):
    """Origin and axes (3, 3) of the track frame at s."""
    x, y, z, heading, roll, *_ = track_frame(alignment, s)
    axes = np.zeros((3, 3))
    rotation(heading, roll, axes)
    return np.array([x, y, z]), axes


def test_the_train_pays_for_what_is_lost(demo_run):
    """Power of the coupler force against contacts, friction and dampers, within 2 %."""
    energy = steady(table(demo_run, "energy"))
    lost = energy.contact_power + energy.friction_power + energy.damper_power
    assert energy.coupler_power.mean() == pytest.approx(lost.mean(), rel=0.02)
    assert lost.mean() > 1000.0


def test_the_wagon_steers_as_an_ore_wagon(contact):
    """Leading wheelsets run under-radial on the outer flange, trailing ones near radial and inside them."""
    attack = -wheel_means(contact, "angle_of_attack")[:, 0]  # towards the outer rail in a left-hand curve
    outwards = -wheel_means(contact, "y_wheelset")[:, 0]
    for leading, trailing in ((0, 1), (2, 3)):
        assert 0.3e-3 < attack[leading] < 5e-3
        assert attack[leading] > attack[trailing]
        assert outwards[leading] > outwards[trailing] > 0.0
        outer = (contact.wheelset == leading + 1) & (contact.side == -1) & (contact.patch == 0)
        assert contact.contact_angle[outer].mean() > np.radians(15)  # on the flange root
    assert outwards[0] == outwards.max()


def test_lower_friction_steers_worse(demo, demo_run, runs, contact):
    """Longitudinal creep forces steer; with half the friction the leading angle of attack grows."""
    slippery = steady(table(simulate(demo.with_changes(friction=0.2), runs / "slippery"), "contact"))
    assert (
        -wheel_means(slippery, "angle_of_attack")[0, 0] > -1.5 * wheel_means(contact, "angle_of_attack")[0, 0]
    )
