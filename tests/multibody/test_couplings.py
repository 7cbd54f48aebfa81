"""The coupling kernel of the ore wagon: balance, energy, friction loops and stops against closed forms.

Poses are set with scipy's rotations, energies with the description's numbers: nothing here uses the kernel
under test a second time.
"""

from dataclasses import fields, replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.couplings import RING_POINTS, coupling_forces
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import BODY_COORDINATES, Ledger, workspace
from vehicles.catalogue import vehicle
from vehicles.description import AxleBoxPad, CentrePlate, SideBearer, SpringNest, Wedge

WAGON = vehicle("iore_wagon_loaded")
NUMBERS = {body.name: i for i, body in enumerate(WAGON.bodies)}
DRAWING = np.array([body.position for body in WAGON.bodies])
SIZE = len(WAGON.bodies)
STILL = np.zeros((SIZE, 3))


class Bench:
    """A vehicle's couplings with poses and velocities put in by hand."""

    def __init__(self, wagon, case):
        model = assemble(wagon, case)
        self.couplings, self.work = model.couplings, workspace(model)
        self.sliders = np.zeros_like(self.work.new_sliders)
        self.place(DRAWING, Rotation.identity(SIZE))

    def place(self, position, rotation):
        self.work.position[:] = position
        self.work.rotation[:] = rotation.as_matrix()

    def forces(self, velocity=STILL, angular_velocity=STILL):
        """Global force and torque on every body, (n, 3) each."""
        work = self.work
        work.velocity[:], work.angular_velocity[:] = velocity, angular_velocity
        for array in (work.force, work.torque, work.ledger):
            array[:] = 0.0
        coupling_forces(self.couplings, self.sliders, False, work)
        return work.force.copy(), work.torque.copy()

    def commit(self):
        self.sliders[:] = self.work.new_sliders

    def displaced(self, name, offset=(0.0, 0.0, 0.0), turn=(0.0, 0.0, 0.0)):
        """Force and torque on one body, moved off the drawing."""
        position, rotation = DRAWING.copy(), np.zeros((SIZE, 3))
        position[NUMBERS[name]] += offset
        rotation[NUMBERS[name]] = turn
        self.place(position, Rotation.from_rotvec(rotation))
        force, torque = self.forces()
        return force[NUMBERS[name]], torque[NUMBERS[name]]


def only(*kinds, **changes):
    """The wagon with couplings of these kinds alone, and with changed numbers."""
    couplings = [replace(c, **changes) for c in WAGON.couplings if isinstance(c, kinds)]
    return replace(WAGON, couplings=tuple(couplings))


def without_loss():
    """The wagon without dry friction and dampers."""
    couplings = []
    for coupling in WAGON.couplings:
        names = [field.name for field in fields(coupling)]
        lossy = [name for name in names if name == "friction" or name.endswith("damping")]
        zero = {name: 0.0 * np.array(getattr(coupling, name)) for name in lossy}
        couplings.append(replace(coupling, **zero))
    return replace(WAGON, couplings=tuple(couplings))


def first(kind):
    return next(coupling for coupling in WAGON.couplings if isinstance(coupling, kind))


@pytest.fixture(scope="module")
def rest(demo):
    """Positions and rotations of the loaded wagon in static equilibrium."""
    model = assemble(WAGON, demo)
    state = equilibrium(WAGON, model, workspace(model))
    q = state.q[: BODY_COORDINATES * SIZE].reshape(SIZE, BODY_COORDINATES)
    return q[:, :3], Rotation.from_rotvec(q[:, 3:])


@pytest.fixture(scope="module")
def whole(demo):
    return Bench(WAGON, demo)


def random_state(rest, seed, length=3e-3, angle=2e-3, speed=0.1):
    """A state near equilibrium; wheelsets are turned anyhow about their axles, and spin."""
    rng = np.random.default_rng(seed)
    position = rest[0] + length * rng.uniform(-1, 1, (SIZE, 3))
    spin = np.zeros((SIZE, 3))
    turns = np.zeros((SIZE, 3))
    for wheelset in WAGON.wheelsets:
        turns[NUMBERS[wheelset.body], 1] = rng.uniform(-3, 3)
        spin[NUMBERS[wheelset.body], 1] = 40.0
    small = Rotation.from_rotvec(angle * rng.uniform(-1, 1, (SIZE, 3)))
    velocity = speed * rng.uniform(-1, 1, (SIZE, 3))
    angular_velocity = speed * rng.uniform(-1, 1, (SIZE, 3)) + small.apply(spin)
    sliders = 1e-3 * rng.uniform(-1, 1, (len(WAGON.couplings), 3))
    return position, small * rest[1] * Rotation.from_rotvec(turns), velocity, angular_velocity, sliders


@pytest.mark.parametrize("seed", range(10))
def test_action_is_reaction(whole, rest, seed):
    """Sum of forces, and of moments about the origin, over all bodies is zero."""
    position, rotation, velocity, angular_velocity, whole.sliders[:] = random_state(rest, seed)
    whole.place(position, rotation)
    force, torque = whole.forces(velocity, angular_velocity)
    moment = torque + np.cross(position, force)
    assert np.abs(force).max() > 1e4
    assert np.abs(force.sum(axis=0)).max() < 1e-12 * np.abs(force).sum()
    assert np.abs(moment.sum(axis=0)).max() < 1e-12 * np.abs(np.cross(position, force)).sum()


@pytest.mark.parametrize("seed", range(5))
def test_a_rigid_motion_of_the_whole_wagon_changes_nothing(whole, rest, seed):
    """Turned, shifted and swung as one body: forces turn with it, and no power is lost more or less."""
    position, rotation, velocity, angular_velocity, whole.sliders[:] = random_state(rest, seed)
    whole.place(position, rotation)
    force, torque = whole.forces(velocity, angular_velocity)
    ledger = whole.work.ledger.copy()

    rng = np.random.default_rng(100 + seed)
    turn, shift, swing = Rotation.random(rng=rng), rng.uniform(-50, 50, 3), rng.uniform(-1, 1, 3)
    moved = turn.apply(position) + shift
    whole.place(moved, turn * rotation)
    swung = whole.forces(
        turn.apply(velocity) + np.cross(swing, moved) + shift, turn.apply(angular_velocity) + swing
    )
    scale = np.abs(force).max()
    assert np.abs(swung[0] - turn.apply(force)).max() < 1e-7 * scale
    assert np.abs(swung[1] - turn.apply(torque)).max() < 1e-7 * scale
    assert whole.work.ledger == pytest.approx(ledger, rel=1e-7)
    assert ledger[Ledger.DAMPER_POWER] > 1.0


def stored_energy(position, rotation):
    """Elastic energy of the springs [J] from the description's numbers; friction elements store none here."""
    total = 0.0
    matrices = rotation.as_matrix()
    for c in WAGON.couplings:
        a, b = NUMBERS[c.body_a], NUMBERS[c.body_b]
        place = position[b] + matrices[b] @ (np.array(c.point) - DRAWING[b]) - position[a]
        d = matrices[a].T @ place - (np.array(c.point) - DRAWING[a])
        turn = Rotation.from_matrix(matrices[a].T @ matrices[b]).as_rotvec()
        match c:
            case AxleBoxPad():
                axle = matrices[a].T @ matrices[b][:, 1]
                total += np.dot(c.stiffness, d**2) / 2
                total += (c.roll_stiffness * axle[2] ** 2 + c.yaw_stiffness * axle[0] ** 2) / 2
            case SpringNest():
                beyond = max(-d[2] - c.second_from, 0.0)
                total += c.first_stiffness * max(-d[2], 0.0) ** 2 / 2
                total += (c.second_stiffness - c.first_stiffness) * beyond**2 / 2
                total += (c.longitudinal_stiffness * d[0] ** 2 + c.lateral_stiffness * d[1] ** 2) / 2
                total += c.stop_stiffness * max(abs(d[1]) - c.stop_clearance, 0.0) ** 2 / 2
                total += np.dot([c.roll_stiffness, c.pitch_stiffness, c.warp_stiffness], turn**2) / 2
            case Wedge():
                compression = c.preload / c.spring_stiffness - d[2] + c.direction * d[0] / np.tan(c.slope)
                total += c.spring_stiffness * max(compression, 0.0) ** 2 / 2
            case CentrePlate():
                around = 2 * np.pi * (np.arange(RING_POINTS) + 0.5) / RING_POINTS
                x, y = c.radius * np.cos(around), c.radius * np.sin(around)
                compression = -(d[2] + turn[0] * y - turn[1] * x)
                total += c.stiffness / RING_POINTS * (np.maximum(compression, 0.0) ** 2).sum() / 2
                total += c.rim_stiffness * max(np.hypot(d[0], d[1]) - c.rim_clearance, 0.0) ** 2 / 2
            case SideBearer():
                total += c.stiffness * max(c.preload / c.stiffness - d[2], 0.0) ** 2 / 2
                total += c.stop_stiffness * max(-d[2] - c.stop_clearance, 0.0) ** 2 / 2
    return total


@pytest.mark.parametrize(("angle", "tolerance"), [(0.0, 1e-8), (1e-3, 1e-5)])
@pytest.mark.parametrize("seed", range(6))
def test_power_goes_into_springs_friction_or_dampers(whole, rest, seed, angle, tolerance):
    """Power of the forces on the bodies + ledger + rate of the springs' energy = 0, in any state of motion.

    Exact but for the moment laws of small rotations, which leave a share of the order of the angle.
    """
    state = random_state(rest, seed, angle=angle)
    position, rotation, velocity, angular_velocity, whole.sliders[:] = state
    angular_velocity = angular_velocity if angle else STILL
    rotation = rotation if angle else rest[1]
    whole.place(position, rotation)
    force, torque = whole.forces(velocity, angular_velocity)
    power = (force * velocity).sum() + (torque * angular_velocity).sum()
    lost = whole.work.ledger[Ledger.DAMPER_POWER] + whole.work.ledger[Ledger.FRICTION_POWER]
    step = 1e-6
    later, earlier = (
        stored_energy(position + h * velocity, Rotation.from_rotvec(h * angular_velocity) * rotation)
        for h in (step, -step)
    )
    stored = (later - earlier) / (2 * step)
    scale = np.abs(force * velocity).sum() + np.abs(torque * angular_velocity).sum()
    assert abs(lost) > 1e-3 * scale
    assert abs(power + lost + stored) < tolerance * scale


@pytest.mark.parametrize(
    ("length", "angle", "tolerance"),
    [
        (1e-4, 0.0, 1e-9),  # no contact opens or stops: the midpoint rule is exact on a smooth closed path
        (2e-3, 1e-3, 1e-4),  # plates tip, moment laws of small rotations
    ],
)
@pytest.mark.parametrize("seed", range(3))
def test_no_work_around_a_closed_path_without_friction(demo, rest, seed, length, angle, tolerance):
    """Work of all forces around an ellipse in the space of poses, over the swing of the stored energy."""
    bench = Bench(without_loss(), demo)
    rng = np.random.default_rng(seed)
    around = np.linspace(0.0, 2 * np.pi, 401)
    shift, turn = length * rng.uniform(-1, 1, (2, SIZE, 3)), angle * rng.uniform(-1, 1, (2, SIZE, 3))

    def pose(t):
        c, s = np.cos(t), np.sin(t)
        turned = Rotation.from_rotvec(turn[0] * c + turn[1] * s) * rest[1]
        return rest[0] + shift[0] * c + shift[1] * s, turned

    work, energy = 0.0, []
    for t, u in pairwise(around):
        (x0, r0), (x1, r1) = pose(t), pose(u)
        bench.place(*pose((t + u) / 2))
        force, torque = bench.forces()
        work += (force * (x1 - x0)).sum() + (torque * (r1 * r0.inv()).as_rotvec()).sum()
        energy.append(stored_energy(x0, r0))
    assert np.ptp(energy) > 10.0
    assert abs(work) < tolerance * np.ptp(energy)
    assert np.abs(bench.work.ledger).max() == 0.0


def test_pads_do_not_feel_wheel_spin(demo, rest):
    """Any turn about the axle leaves the forces as they are; no torque acts about the axle."""
    bench = Bench(only(AxleBoxPad), demo)
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


def loop_area(low, high, wedge):
    """Area [J] of one wedge's friction loop between two compressions: sticking flanks, sliding bounds.

    Sliding friction is mu Fs / (tan(a) -+ mu) upwards and downwards; sticking rises with the contact's
    stiffness (vehicles.md 1.3). Corners by intersecting lines, area by the shoelace formula.
    """
    k, mu = wedge.spring_stiffness, wedge.friction
    up = mu * k / (wedge.tan_slope - mu)
    down = -mu * k / (wedge.tan_slope + mu)
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
    bench = Bench(only(Wedge), demo)
    c = first(Wedge)
    low, high = 0.04, 0.07
    down = np.linspace(low, high, 3001)
    cycle = np.concatenate([down, down[-2::-1]])
    drive_bolster(bench, cycle)  # the first cycle fits the sliders
    lifts, friction = drive_bolster(bench, cycle)
    work = np.trapezoid(lifts, cycle)
    preload = c.preload / c.spring_stiffness
    expected = 4 * loop_area(low + preload, high + preload, c)
    assert work == pytest.approx(expected, rel=1e-3)
    assert friction == pytest.approx(expected, rel=1e-3)


def test_centre_plate_yaw_torque_saturates(demo):
    """Elastic first, then (2/3) mu N R, however far; and it comes back by the same elastic slope."""
    bench = Bench(only(CentrePlate), demo)
    c = first(CentrePlate)
    arm = 2 / 3 * c.radius
    sunk = 4e-4
    load = c.stiffness * sunk
    bound = c.friction * load * arm
    for yaw in (1e-6, 1e-3, 2e-3, 0.02, 0.05):
        force, torque = bench.displaced("bolster_1", (0.0, 0.0, sunk), (0.0, 0.0, yaw))
        bench.commit()
        assert force[2] == pytest.approx(-load)
        assert torque[2] == pytest.approx(-min(c.stick_stiffness * arm**2 * np.sin(yaw), bound), rel=1e-9)
    turned_back = np.arcsin(np.sin(yaw) - 0.5 * bound / (c.stick_stiffness * arm**2))
    _, torque = bench.displaced("bolster_1", (0.0, 0.0, sunk), (0.0, 0.0, turned_back))
    assert torque[2] == pytest.approx(-0.5 * bound, rel=1e-9)
    assert bound > 5e3


def test_centre_plate_tilts_over_its_ring(demo):
    """A plate that stands on one half carries its load within the ring: its arm nears R cos(pi/8)."""
    bench = Bench(only(CentrePlate), demo)
    c = first(CentrePlate)
    outermost = c.radius * np.cos(np.pi / RING_POINTS)
    for roll in (1e-3, 0.01):
        for axis in (0, 1):
            turn = [roll if k == axis else 0.0 for k in range(3)]
            sunk = -0.9 * roll * outermost  # the plates part in the middle and meet on one edge
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
