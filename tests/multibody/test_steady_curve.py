"""The demo's steady curve against statics, energy, and what an ore wagon does."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from run_tables import steady, table, wheel_means
from scipy.spatial.transform import Rotation

from hh_exudyn.contact.profile import gauge_point, rail_profile
from hh_exudyn.conventions import GRAVITY, RAIL_TOP_DISTANCE
from hh_exudyn.multibody.simulate import simulate
from hh_exudyn.multibody.validation import curve_rows
from track.course.alignment import inclined_frame, inclined_rotation
from track.support.flexibility import track_flexibility
from vehicles.catalogue import vehicle
from vehicles.couplings import AxleBox

RADIUS, CANT, GAUGE = 450.0, 0.065, 1.445
UP = np.array([0.0, 0.0, 1.0])
ROLL = np.arcsin(CANT / RAIL_TOP_DISTANCE)
WAGON = vehicle("iore_wagon_loaded")


ROWS = np.full(9, 1.0 / 9.0)  # rows of 4 ms at 60 km/h: 0.6 m, a sleeper spacing
WINDOW = 4.0  # s at the end: several swings of the sway that dry friction, stuck, leaves to ring


@pytest.fixture(scope="module")
def contact(demo_run):
    return steady(table(demo_run, "contact"), WINDOW)


def test_the_run_settles(demo_run):
    """What is left of the curve entry is a sway below 2 % of the wheel load, and it dies away.

    In means over nine rows, which are one sleeper spacing: what passing sleepers do goes on.
    """
    log = table(demo_run, "contact")
    for w in (1, 2, 3, 4):
        for side in (1, -1):
            wheel = (log.patch == 0) & (log.wheelset == w) & (log.side == side)
            before, after = (
                np.ptp(np.convolve(log.Q[wheel & (log.time > end - 2.0) & (log.time <= end)], ROWS, "valid"))
                for end in (log.time.max() - WINDOW, log.time.max())
            )
            assert after < 0.8 * before
            assert after < 0.02 * 147e3


def test_sleepers_pass_at_speed_over_spacing(contact):
    """Above 10 Hz the wheel load's spectrum has its peak there, from a tenth of a per cent of the load."""
    sleepers = track_flexibility("concrete").sleeper_spacing
    for w in (1, 2, 3, 4):
        for side in (1, -1):
            wheel = (contact.patch == 0) & (contact.wheelset == w) & (contact.side == side)
            load, time = contact.Q[wheel], contact.time[wheel]
            window = np.hanning(load.size)
            amplitude = 2.0 * np.abs(np.fft.rfft((load - load.mean()) * window)) / window.sum()
            frequency = np.fft.rfftfreq(load.size, np.diff(time).mean())
            amplitude[frequency < 10.0] = 0.0
            peak = np.argmax(amplitude)
            passing = contact.speed[wheel].mean() / sleepers
            assert frequency[peak] == pytest.approx(passing, abs=1.0 / (time[-1] - time[0]))
            assert 0.15e3 < amplitude[peak] < 2e3


def test_forces_carry_cant_deficiency_and_weight_and_the_train_pays_for_what_is_lost(demo_run):
    """Sum of Y within 1 % of m (g sin - v^2/R cos), to the outer, right rail; of Q 0.1 %; power 0.3 %."""
    rows = curve_rows(demo_run)
    assert [row.quantity for row in rows if not row.holds] == []
    lateral, _, power = rows
    assert lateral.found < 0.0
    assert power.wanted > 1.0  # kW


def test_wheel_load_difference_carries_the_overturning_moment(demo, demo_run):
    """Moment of all contact forces about the track under the wagon's middle, mean of every tenth output.

    Against weight, centripetal acceleration and the gyroscopic moment of the wheelsets, within 2 %; every
    contact in its own track frame, every body where it is. About 38 kN m, 43 kN of load from the inner to
    the outer wheels.
    """
    alignment = demo.alignment().table
    contacts, motions = (by_output(steady(table(demo_run, log), WINDOW)) for log in ("contact", "motion"))
    sums = [
        moments(alignment, contact, motion)
        for contact, motion in zip(contacts[::10], motions[::10], strict=True)
    ]
    found, wanted = np.mean(sums, axis=0)
    assert found == pytest.approx(wanted, rel=0.02)
    loads = wheel_means(steady(table(demo_run, "contact"), WINDOW), "Q")
    assert (loads[:, 1] > loads[:, 0] + 10e3).all()  # cant deficiency loads the outer, right wheels


def by_output(log):
    """The rows of every output time."""
    return [
        SimpleNamespace(**{name: values[log.time == time] for name, values in vars(log).items()})
        for time in np.unique(log.time)
    ]


def moments(alignment, contact, motion):
    """Roll moment of the contact forces, and the one that weight and motion want, at one output [N m]."""
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
    return found @ axes[:, 0], wanted @ axes[:, 0]


def frame(alignment, s):
    """Origin and axes (3, 3) of the track frame at s."""
    x, y, z, heading, pitch, roll, *_ = inclined_frame(alignment, s)
    axes = np.zeros((3, 3))
    inclined_rotation(heading, pitch, roll, axes)
    return np.array([x, y, z]), axes


def test_the_wagon_steers_as_an_ore_wagon(contact):
    """Leading wheelsets run under-radial on the outer flange, trailing ones near radial and inside them.

    Both bogies stay square (the next test), so that the second wheelsets of both run alike, some millimetres
    inside of the first ones.
    """
    attack = -wheel_means(contact, "angle_of_attack")[:, 0]  # towards the outer rail in a left-hand curve
    outwards = -wheel_means(contact, "y_wheelset")[:, 0]
    for leading, trailing in ((0, 1), (2, 3)):
        assert 0.3e-3 < attack[leading] < 2e-3  # soft pads and dry rails: 75 % of the way to radial
        assert attack[leading] > attack[trailing]
        assert outwards[leading] > outwards[trailing]
        outer = (contact.wheelset == leading + 1) & (contact.side == -1) & (contact.patch == 0)
        assert contact.contact_angle[outer].mean() > np.radians(15)  # on the flange root
    assert outwards[0] == outwards.max()
    assert outwards[1] > 4e-3
    assert 4e-3 < outwards[3] < outwards[1]


def test_bogies_stay_square(demo_run):
    """No warp beyond 3 mrad in the curve; the wheelsets of a bogie stand within 6 mm behind each other.

    Plate and side bearers turn the trailing bolster with 21 kN m. A bogie that warps squeezes its wedges,
    which then slide on column and slope: their friction holds 40 kN m.
    """
    motion = table(demo_run, "motion")
    yaw, place = {}, {}
    for name in set(motion.body):
        own = motion.body == name
        quaternions = np.column_stack([motion.qx[own], motion.qy[own], motion.qz[own], motion.qw[own]])
        x, y = Rotation.from_quat(quaternions).as_matrix()[:, :2, 1].T  # of the axis to the left
        yaw[name] = np.unwrap(np.arctan2(-x, y))
        place[name] = np.column_stack([motion.x[own], motion.y[own]])
    warp = {(n, s): yaw[f"bolster_{n}"] - yaw[f"side_frame_{n}{s}"] for n in (1, 2) for s in "LR"}
    assert max(np.abs(angle).max() for angle in warp.values()) < 3e-3
    for number in (1, 2):
        front, rear = f"wheelset_{2 * number - 1}", f"wheelset_{2 * number}"
        heading = (yaw[front] + yaw[rear]) / 2
        apart = place[front] - place[rear]
        across = -np.sin(heading) * apart[:, 0] + np.cos(heading) * apart[:, 1]
        assert np.abs(across).max() < 6e-3


@pytest.mark.parametrize("change", ["damp rails", "stiff pads"])
def test_damp_rails_and_stiff_pads_steer_worse(demo, runs, contact, change):
    """Creep forces steer against the pads: half the friction, or pads three times as stiff, and the leading
    angle of attack is the 2..3 mrad of a bogie whose axles stay nearly parallel.
    """
    couplings = tuple(
        replace(c, stiffness=tuple(3 * k for k in c.stiffness)) if isinstance(c, AxleBox) else c
        for c in WAGON.couplings
    )
    case, wagon = (
        (demo.with_changes(friction=0.2), WAGON)
        if change == "damp rails"
        else (demo, replace(WAGON, couplings=couplings))
    )
    run = simulate(case, runs / change.replace(" ", "_"), vehicle=wagon)
    attack = -wheel_means(steady(table(run, "contact"), WINDOW), "angle_of_attack")[0, 0]
    assert 1.5e-3 < attack < 4e-3
    assert attack > -2.0 * wheel_means(contact, "angle_of_attack")[0, 0]
