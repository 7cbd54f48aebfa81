"""Every kind of coupling of the ore wagon against closed forms: stages, stops, friction loops, tipping."""

from dataclasses import fields, replace

import numpy as np
import pytest
from coupling_bench import DRAWING, NUMBERS, SIZE, STILL, WAGON, Bench, first, only, random_state
from scipy.spatial.transform import Rotation

from hh_exudyn.multibody.couplings.three_piece_bogie import RING_RADIUS, RING_X, RING_Y
from hh_exudyn.multibody.model import Ledger
from vehicles.couplings import AxleBox, AxleBoxPad, CentrePlate, SideBearer, SpringNest, Wedge


def linear_pads():
    """The wagon on pads alone, with the numbers of its axle boxes."""
    names = [field.name for field in fields(AxleBoxPad) if field.name != "preload"]
    boxes = [c for c in WAGON.couplings if isinstance(c, AxleBox)]
    pads = tuple(AxleBoxPad(**{name: getattr(box, name) for name in names}) for box in boxes)
    return replace(WAGON, couplings=pads)


@pytest.mark.parametrize("wagon", [linear_pads(), only(AxleBox)], ids=["pads", "axle boxes"])
def test_axle_boxes_do_not_feel_wheel_spin(demo, rest, wagon):
    """Any turn about the axle leaves the forces as they are; no torque acts about the axle."""
    bench = Bench(wagon, demo)
    position, rotation, velocity, _, _ = random_state(rest, 1, angle=5e-3)
    bench.place(position, rotation)
    spin = np.zeros((SIZE, 3))
    wheelsets = [NUMBERS[wheelset.body] for wheelset in WAGON.wheelsets]
    still = bench.forces(velocity)
    for turn in (0.3, 2.0, 3.1):
        spin[wheelsets, 1] = turn
        turned = rotation * Rotation.from_rotvec(spin)
        bench.place(position, turned)
        rolling = bench.forces(velocity, turned.apply(100.0 * spin))
        for a, b in zip(still, rolling, strict=True):
            assert a == pytest.approx(b, abs=1e-9 * np.abs(still[0]).max())
    axles = bench.work.rotation[wheelsets][:, :, 1]
    assert np.abs((rolling[1][wheelsets] * axles).sum(axis=1)).max() < 1e-9 * np.abs(still[1]).max()


def test_two_stage_nest(demo):
    """Vertical force of both nests of a bolster over its compression; they never pull."""
    bench = Bench(only(SpringNest), demo)
    c = first(SpringNest)
    for compression, expected in (
        (-0.01, 0.0),
        (0.5 * c.second_from, c.first_stiffness * 0.5 * c.second_from),
        (c.second_from, c.first_stiffness * c.second_from),
        (0.07, c.first_stiffness * c.second_from + c.second_stiffness * (0.07 - c.second_from)),
    ):
        force, torque = bench.displaced("bolster_1", (0.0, 0.0, -compression))
        assert force == pytest.approx([0.0, 0.0, 2 * expected], abs=1e-3)
        assert torque == pytest.approx([0.0, 0.0, 0.0], abs=1e-3)


def test_nest_stops_at_the_gibs(demo):
    bench = Bench(only(SpringNest), demo)
    c = first(SpringNest)
    for lateral in (0.5 * c.stop_clearance, 1.5 * c.stop_clearance, -2.0 * c.stop_clearance):
        beyond = np.sign(lateral) * max(abs(lateral) - c.stop_clearance, 0.0)
        force, _ = bench.displaced("bolster_2", (0.0, lateral, -0.07))
        assert force[1] == pytest.approx(-2 * (c.lateral_stiffness * lateral + c.stop_stiffness * beyond))


def test_rotation_stops_limit_the_warp(demo):
    """Free up to the clearance but for the coils, then the lugs' stiffness, of both side frames."""
    bench = Bench(only(SpringNest), demo)
    c = first(SpringNest)
    for yaw in (0.5 * c.rotation_clearance, -0.9 * c.rotation_clearance, 2.0 * c.rotation_clearance):
        beyond = np.sign(yaw) * max(abs(np.sin(yaw)) - c.rotation_clearance, 0.0)
        _, torque = bench.displaced("bolster_1", turn=(0.0, 0.0, yaw))
        # at half the spacing, the coils shear as well
        shear = c.longitudinal_stiffness * c.point[1] ** 2 * np.sin(yaw) * np.cos(yaw)
        moment = c.warp_stiffness * np.sin(yaw) + c.rotation_stop_stiffness * beyond
        assert torque[2] == pytest.approx(-2 * (moment + shear), rel=2e-3)


def loop_area(low, high, wedge):
    """Area [J] of a wedge's friction loop between two ways down its column: sticking flanks, sliding bounds.

    Sliding friction is mu Fs cos a / (sin d -+ mu cos d) upwards and downwards, with d = a - t; sticking
    rises with the contact's stiffness (vehicles.md 1.3). Corners by intersecting lines, area by the shoelace
    formula.
    """
    k, mu, angle = wedge.spring_stiffness * np.cos(wedge.toe), wedge.friction, wedge.slope - wedge.toe
    up = mu * k * np.cos(wedge.slope) / (np.sin(angle) - mu * np.cos(angle))
    down = -mu * k * np.cos(wedge.slope) / (np.sin(angle) + mu * np.cos(angle))
    stick = wedge.stick_stiffness
    # from each turning point (c, slope c) along the flank of slope `stick` to the other bound
    below = high * (stick - up) / (stick - down)
    above = low * (stick - down) / (stick - up)
    corners = np.array([(high, up * high), (below, down * below), (low, down * low), (above, up * above)])
    x, y = corners.T
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def drive_bolster(bench, compressions, speed=1e-4):
    """Move bolster_1 down to each compression in turn, sliders committed: lifts [N] and friction work [J]."""
    number = NUMBERS["bolster_1"]
    change = np.diff(compressions, prepend=compressions[0])
    lifts, friction = [], 0.0
    for compression, way in zip(compressions, change, strict=True):
        position, velocity = DRAWING.copy(), STILL.copy()
        position[number, 2] -= compression
        velocity[number, 2] = -np.sign(way) * speed
        bench.place(position, Rotation.identity(SIZE))
        lifts.append(bench.forces(velocity)[0][number, 2])
        friction += bench.work.ledger[Ledger.FRICTION_POWER] * abs(way) / speed
        bench.commit()
    return np.array(lifts), friction


def test_wedge_loop(demo):
    """Driven slowly down and up, four wedges of a bolster lose the area of four loops, within 0.1 %.

    The work of the forces, the closed form, and the friction power over time agree.
    """
    smooth = {"slope_friction": 0.0}  # with a toe, the slope slips a little as well
    bench = Bench(only(Wedge, **smooth), demo)
    c = replace(first(Wedge), **smooth)
    low, high = 0.04, 0.07
    down = np.linspace(low, high, 3001)
    cycle = np.concatenate([down, down[-2::-1]])
    drive_bolster(bench, cycle)  # the first cycle fits the sliders
    lifts, friction = drive_bolster(bench, cycle)
    work = np.trapezoid(lifts, cycle)
    down_the_column = 1 / (1 - np.tan(c.toe) / np.tan(c.slope))  # over down with the bolster
    ends = [(c.compression + z * down_the_column) / np.cos(c.toe) for z in (low, high)]
    expected = 4 * loop_area(*ends, c)
    assert work == pytest.approx(expected, rel=1e-3)
    assert friction == pytest.approx(expected, rel=1e-3)


def disc_arm(plate):
    """Friction arm of the rings, nearly that of a uniformly loaded disc."""
    arm = plate.radius * RING_RADIUS.mean()
    assert arm == pytest.approx(2 / 3 * plate.radius, rel=0.012)
    return arm


def test_centre_plate_yaw_torque_saturates(demo):
    """Elastic first, then (2/3) mu N R, however far; and it comes back by the same elastic slope."""
    bench = Bench(only(CentrePlate), demo)
    c = first(CentrePlate)
    sunk = 4e-4
    load = c.stiffness * sunk
    bound = c.friction * load * disc_arm(c)
    for yaw in (1e-6, 1e-4, 2e-4, 0.02, 0.05):
        force, torque = bench.displaced("bolster_1", (0.0, 0.0, sunk), (0.0, 0.0, yaw))
        bench.commit()
        assert force[2] == pytest.approx(-load)
        assert torque[2] == pytest.approx(-min(c.yaw_stiffness * np.sin(yaw), bound), rel=1e-9)
    turned_back = np.arcsin(np.sin(yaw) - 0.5 * bound / c.yaw_stiffness)
    _, torque = bench.displaced("bolster_1", (0.0, 0.0, sunk), (0.0, 0.0, turned_back))
    assert torque[2] == pytest.approx(-0.5 * bound, rel=1e-9)
    assert bound > 5e3
    assert 2e-4 < bound / c.yaw_stiffness < 2e-3  # where it breaks away


def test_shear_and_yaw_of_the_centre_plate_share_one_bound(demo):
    """Once it slides in yaw, a shear of any size turns the friction: the torque gives way."""
    c = first(CentrePlate)
    sunk = 4e-4
    bound, arm = c.friction * c.stiffness * sunk, disc_arm(c)
    torques = []
    for shear in (0.0, 1e-3, 5e-3):
        bench = Bench(only(CentrePlate, rim_clearance=1.0), demo)
        bench.displaced("bolster_1", (0.0, 0.0, sunk), (0.0, 0.0, 0.02))
        bench.commit()
        force, torque = bench.displaced("bolster_1", (shear, 0.0, sunk), (0.0, 0.0, 0.02))
        assert np.hypot(force[0] / bound, torque[2] / (bound * arm)) == pytest.approx(1.0, rel=1e-9)
        torques.append(-torque[2] / (bound * arm))
    assert torques[0] == pytest.approx(1.0)
    assert torques[0] > torques[1] > torques[2]
    assert torques[2] < 0.2


def test_the_rings_are_a_disc(demo):
    """Tilting stiffness, load and friction arm of uniform contact over a disc: K R^2/4, K, 2/3 R."""
    c = first(CentrePlate)
    assert (RING_X**2).mean() == pytest.approx(1 / 4, rel=1e-12)
    assert (RING_X * RING_Y).mean() == pytest.approx(0.0, abs=1e-12)
    assert RING_RADIUS.mean() == pytest.approx(2 / 3, rel=0.012)
    bench = Bench(only(CentrePlate), demo)
    roll, sunk = 1e-4, 4e-4
    turn = (roll, 0.0, 0.0)
    arm = np.array(c.point) - DRAWING[NUMBERS["bolster_1"]]
    turned = Rotation.from_rotvec(turn).apply(arm)
    force, torque = bench.displaced("bolster_1", arm - turned + [0.0, 0.0, sunk], turn)
    moment = torque - np.cross(turned, force)
    assert moment[0] == pytest.approx(-c.stiffness * c.radius**2 / 4 * roll, rel=1e-3)


def test_centre_plate_tilts_over_its_ring(demo):
    """A plate that stands on one edge: its arm is that of the outermost contacts, or between two of them."""
    bench = Bench(only(CentrePlate), demo)
    c = first(CentrePlate)
    for axis, places in ((0, RING_Y), (1, RING_X)):
        outermost = c.radius * places.max()
        inner = c.radius * np.unique(places.round(12))[-2]
        for roll in (1e-3, 0.01):
            turn = [roll if k == axis else 0.0 for k in range(3)]
            sunk = -0.5 * roll * (outermost + inner)  # only the outermost contacts meet
            # about the plate's middle, so that it only tilts there
            arm = Rotation.from_rotvec(turn).apply(np.array(c.point) - DRAWING[NUMBERS["bolster_1"]])
            offset = np.array(c.point) - DRAWING[NUMBERS["bolster_1"]] - arm
            force, torque = bench.displaced("bolster_1", offset + np.array([0.0, 0.0, sunk]), turn)
            plate_moment = torque - np.cross(arm, force)
            assert -force[2] > 1e3
            assert abs(plate_moment[axis] / force[2]) == pytest.approx(outermost, rel=2e-2)


def test_rim_stops_the_centre_plate(demo):
    """Free within the clearance, then radial with the rim's stiffness, in any direction."""
    bench = Bench(only(CentrePlate, friction=0.0), demo)
    c = first(CentrePlate)
    for angle in np.linspace(0.0, 2 * np.pi, 7):
        towards = np.array([np.cos(angle), np.sin(angle), 0.0])
        for shear in (0.5 * c.rim_clearance, 1.2 * c.rim_clearance, 2.0 * c.rim_clearance):
            force, _ = bench.displaced("bolster_1", shear * towards)
            expected = c.rim_stiffness * max(shear - c.rim_clearance, 0.0)
            assert force == pytest.approx(-expected * towards, abs=1e-6)


def test_side_bearer_stop_and_lift_off(demo):
    """Preload on the drawing, soft spring, solid beyond the clearance, nothing once lifted off."""
    bench = Bench(only(SideBearer), demo)
    c = first(SideBearer)
    for compression, expected in (
        (0.0, c.preload),
        (c.stop_clearance, c.preload + c.stiffness * c.stop_clearance),
        (0.008, c.preload + c.stiffness * 0.008 + c.stop_stiffness * (0.008 - c.stop_clearance)),
        (-0.5 * c.preload / c.stiffness, 0.5 * c.preload),
        (-2.0 * c.preload / c.stiffness, 0.0),
    ):
        force, _ = bench.displaced("bolster_1", (0.0, 0.0, compression))
        assert force[2] == pytest.approx(-2 * expected, rel=1e-9, abs=1e-6)


def test_side_bearers_hold_by_friction_only(demo):
    """Shear far beyond sticking: mu times the load of both bearers, against the motion."""
    bench = Bench(only(SideBearer), demo)
    c = first(SideBearer)
    force, _ = bench.displaced("bolster_1", (0.05, 0.0, 0.0))
    assert force[0] == pytest.approx(-2 * c.friction * c.preload, rel=1e-9)
