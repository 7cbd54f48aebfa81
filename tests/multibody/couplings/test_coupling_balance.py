"""The coupling kernel of the ore wagon: balance of forces and of energy.

Poses are set with scipy's rotations, energies with the description's numbers: nothing here uses the kernel
under test a second time.
"""

from itertools import pairwise

import numpy as np
import pytest
from coupling_bench import DRAWING, NUMBERS, SIZE, STILL, WAGON, Bench, random_state, without_loss
from scipy.spatial.transform import Rotation

from hh_exudyn.multibody.couplings.three_piece_bogie import RING_X, RING_Y
from hh_exudyn.multibody.model import Ledger
from vehicles.couplings import AxleBox, CentrePlate, SideBearer, SpringNest, Wedge


@pytest.fixture(scope="module")
def whole(demo):
    return Bench(WAGON, demo)


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
            case AxleBox():
                axle = matrices[a].T @ matrices[b][:, 1]
                total += c.stiffness[2] * max(d[2], 0.0) ** 2 / 2
                clearances = np.array([c.longitudinal_clearance, c.lateral_clearance])
                total += c.stop_stiffness * (np.maximum(np.abs(d[:2]) - clearances, 0.0) ** 2).sum() / 2
                total += (c.roll_stiffness * axle[2] ** 2 + c.yaw_stiffness * axle[0] ** 2) / 2
            case SpringNest():
                beyond = max(-d[2] - c.second_from, 0.0)
                total += c.first_stiffness * max(-d[2], 0.0) ** 2 / 2
                total += (c.second_stiffness - c.first_stiffness) * beyond**2 / 2
                total += (c.longitudinal_stiffness * d[0] ** 2 + c.lateral_stiffness * d[1] ** 2) / 2
                total += c.stop_stiffness * max(abs(d[1]) - c.stop_clearance, 0.0) ** 2 / 2
                total += np.dot([c.roll_stiffness, c.pitch_stiffness, c.warp_stiffness], turn**2) / 2
                warped = max(abs(turn[2]) - c.rotation_clearance, 0.0)
                total += c.rotation_stop_stiffness * warped**2 / 2
            case Wedge():
                for y in (c.width / 2, -c.width / 2):
                    # down with the bolster, down its slope, and off a column that closes by the toe
                    ahead, drop = c.direction * (d[0] - turn[2] * y), -d[2] - turn[0] * y
                    down = drop * np.tan(c.slope) + ahead
                    way = c.compression + down / (np.tan(c.slope) - np.tan(c.toe))
                    way -= drop if c.constant_damping else 0.0
                    total += c.spring_stiffness / 2 * max(way, 0.0) ** 2 / 2
            case CentrePlate():
                x, y = c.radius * RING_X, c.radius * RING_Y
                compression = -(d[2] + turn[0] * y - turn[1] * x)
                total += c.stiffness / RING_X.size * (np.maximum(compression, 0.0) ** 2).sum() / 2
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


@pytest.mark.parametrize("name", ["car_body", "bolster_1", "side_frame_1L", "wheelset_1"])
def test_no_coupling_gives_back_more_than_it_took(whole, rest, name):
    """A body pushed in two fast steps and slowly back, 30 times anyhow, each from relaxed friction elements.

    At every step the work put in is at least the rise of the springs' energy. Bodies keep their rotation: a
    step then is straight in every coupling, and the inequality exact for forces at the end of the step.
    """
    rng = np.random.default_rng(1)
    start = stored_energy(*rest)
    for _ in range(30):
        position, rotation = rest
        whole.place(position, rotation)
        whole.relax()
        work, size = 0.0, 0.0
        ways = np.zeros((3, SIZE, 3))
        ways[:2, NUMBERS[name]] = (
            10.0 ** rng.uniform(-5.0, -3.5, (2, 1)) * rng.uniform(-1, 1, (2, 3)) * [1.0, 1.0, 0.05]
        )
        ways[2] = -ways[:2].sum(axis=0)
        for way, number, duration in zip(ways, (1, 1, 10), (4e-4, 4e-4, 1.0), strict=True):
            for _ in range(number):
                position = position + way / number
                whole.place(position, rotation)
                force, _ = whole.forces(way / number / duration)
                whole.commit()
                work -= (force * way).sum() / number
                size += np.abs(force * way).sum() / number
                assert work >= stored_energy(position, rotation) - start - 1e-9 * size
