"""Bushing, rod and bump stop against closed forms, and what no coupling may do: make energy or forces."""

from dataclasses import replace

import numpy as np
import pytest
from coupling_bench import DRAWING, NUMBERS, SIZE, STILL, WAGON, Bench
from scipy.spatial.transform import Rotation

from hh_exudyn.multibody.model import Ledger
from vehicles.couplings import BumpStop, Bushing, Rod

A, B = NUMBERS["bolster_1"], NUMBERS["car_body"]
BUSHING = Bushing(
    "bushing", "bolster_1", "car_body", (3.2, 0.4, 0.9), (2e6, 3e6, 5e6), (2e4, 3e4, 1e4),
    (4e5, 6e5, 7e5), (3e3, 2e3, 1e3), (1e3, -2e3, 4e4),
)  # fmt: skip
ROD = Rod("rod", "bolster_1", "car_body", (3.4, -0.2, 0.6), (1.9, 0.3, 1.1), 8e6, 5e4)
# lateral bump stop of Manchester vehicle 1 (sources: vehicles.md 3.1)
TABLE = tuple(
    (mm * 1e-3, force)
    for mm, force in (
        (25, 0.0), (30, 600.0), (35, 1760.0), (40, 3730.0), (45, 6870.0), (50, 11_580.0), (55, 17_170.0),
        (60, 29_200.0), (65, 230_000.0),
    )
)  # fmt: skip
STOP = BumpStop("stop", "bolster_1", "car_body", (3.385, 0.0, 0.65), (0.0, 1.0, 0.0), TABLE, odd=True)
SLANTED = BumpStop(
    "slanted", "bolster_1", "car_body", (3.0, 0.5, 0.8), (0.6, 0.0, -0.8), TABLE[:3], odd=False
)
ALL = (BUSHING, ROD, STOP, SLANTED)


def bench_with(case, *couplings):
    return Bench(replace(WAGON, couplings=couplings), case)


def anywhere(seed, length=0.05, angle=0.02):
    """A random state of motion of all bodies."""
    rng = np.random.default_rng(seed)
    position = DRAWING + length * rng.uniform(-1, 1, (SIZE, 3))
    rotation = Rotation.from_rotvec(angle * rng.uniform(-1, 1, (SIZE, 3)))
    return position, rotation, rng.uniform(-0.3, 0.3, (SIZE, 3)), rng.uniform(-0.3, 0.3, (SIZE, 3))


def test_bushing_has_its_stiffness_and_damping_in_six_directions(demo):
    bench = bench_with(demo, BUSHING)
    force, torque = bench.displaced("car_body")
    assert force == pytest.approx(BUSHING.preload)
    arm = np.array(BUSHING.point) - DRAWING[B]
    assert torque == pytest.approx(np.cross(arm, BUSHING.preload))
    for axis in range(3):
        step = np.eye(3)[axis]
        moved, _ = bench.displaced("car_body", 1e-3 * step)
        assert moved - force == pytest.approx(-BUSHING.stiffness[axis] * 1e-3 * step)
        turned = Rotation.from_rotvec(1e-4 * step)
        moved, moment = bench.displaced("car_body", arm - turned.apply(arm), 1e-4 * step)  # about its point
        moment = moment - np.cross(turned.apply(arm), moved)
        assert moment == pytest.approx(-BUSHING.rotational_stiffness[axis] * 1e-4 * step, rel=1e-6, abs=1e-3)
    bench.place(DRAWING, Rotation.identity(SIZE))
    velocity, spin = STILL.copy(), STILL.copy()
    velocity[B], spin[B] = (0.1, 0.2, 0.3), (0.05, -0.04, 0.02)
    velocity[B] -= np.cross(spin[B], arm)  # its point moves as given
    force, torque = bench.forces(velocity, spin)
    expected = np.array(BUSHING.preload) - np.array(BUSHING.damping) * (0.1, 0.2, 0.3)
    assert force[B] == pytest.approx(expected)
    moment = torque[B] - np.cross(arm, force[B])
    assert moment == pytest.approx(-np.array(BUSHING.rotational_damping) * spin[B])


def test_rod_pulls_along_its_line_only(demo):
    """Force by its elongation from end to end, however the bodies stand; none when it only swings."""
    bench = bench_with(demo, ROD)
    position, rotation, _, _ = anywhere(3)
    bench.place(position, rotation)
    force, torque = bench.forces()
    ends = [
        position[body] + rotation[body].apply(np.array(end) - DRAWING[body])
        for body, end in ((A, ROD.point_a), (B, ROD.point_b))
    ]
    line = ends[1] - ends[0]
    length = np.linalg.norm(line)
    expected = -ROD.stiffness * (length - ROD.length) * line / length
    assert force[B] == pytest.approx(expected, rel=1e-9)
    assert torque[B] == pytest.approx(np.cross(ends[1] - position[B], expected), rel=1e-9)
    assert torque[A] == pytest.approx(np.cross(ends[0] - position[A], -expected), rel=1e-9)
    # swung about its end A by 0.3 rad: as long as before, and no force
    swing = Rotation.from_euler("z", 0.3)
    place = np.array(ROD.point_a) + swing.apply(np.array(ROD.point_b) - ROD.point_a)
    force, torque = bench.displaced("car_body", place - ROD.point_b)
    assert np.abs(force).max() < 1e-9 * ROD.stiffness * ROD.length


def test_rod_damps_its_elongation(demo):
    bench = bench_with(demo, ROD)
    velocity = STILL.copy()
    velocity[B] = (0.2, -0.1, 0.05)
    line = (np.array(ROD.point_b) - ROD.point_a) / ROD.length
    rate = line @ velocity[B]
    force, _ = bench.forces(velocity)
    assert force[B] == pytest.approx(-ROD.damping * rate * line)
    assert bench.work.ledger[Ledger.DAMPER_POWER] == pytest.approx(ROD.damping * rate**2)


def test_bump_stop_follows_its_table(demo):
    """At, between and beyond its points; the same force the other way; nothing across its axis."""
    bench = bench_with(demo, STOP)
    for lateral, expected in (
        (0.0, 0.0), (0.024, 0.0), (0.0275, 300.0), (0.045, 6870.0), (0.0575, (17_170 + 29_200) / 2),
        (0.065, 230_000.0), (0.066, 230_000 + (230_000 - 29_200) / 5),
    ):  # fmt: skip
        for way in (1, -1):
            force, _ = bench.displaced("car_body", (0.02, way * lateral, -0.03))
            assert force == pytest.approx([0.0, -way * expected, 0.0], rel=1e-9, abs=1e-6)


def test_one_sided_stop(demo):
    """Stopped along its axis, free the other way, and its force lies on the axis."""
    bench = bench_with(demo, SLANTED)
    axis = np.array(SLANTED.axis)
    force, _ = bench.displaced("car_body", 0.0325 * axis + 0.01 * np.array([0.0, 1.0, 0.0]))
    assert force == pytest.approx(-1180.0 * axis)
    force, _ = bench.displaced("car_body", -0.06 * axis)
    assert np.abs(force).max() == 0.0


@pytest.mark.parametrize("seed", range(4))
def test_action_is_reaction_and_turns_with_the_vehicle(demo, seed):
    """Forces and moments about the origin sum to nothing; turned and shifted as one body, they turn too."""
    bench = bench_with(demo, *ALL)
    position, rotation, velocity, swing = anywhere(seed)
    bench.place(position, rotation)
    force, torque = bench.forces(velocity, swing)
    assert np.abs(force.sum(axis=0)).max() < 1e-12 * np.abs(force).sum()
    moment = torque + np.cross(position, force)
    assert np.abs(moment.sum(axis=0)).max() < 1e-12 * np.abs(moment).sum()
    rng = np.random.default_rng(seed)
    turn, shift = Rotation.random(rng=rng), rng.uniform(-50, 50, 3)
    bench.place(turn.apply(position) + shift, turn * rotation)
    moved = bench.forces(turn.apply(velocity) + shift, turn.apply(swing))
    assert moved[0] == pytest.approx(turn.apply(force), rel=1e-7, abs=1e-6 * np.abs(force).max())
    assert moved[1] == pytest.approx(turn.apply(torque), rel=1e-7, abs=1e-6 * np.abs(torque).max())


def stored(position, rotation):
    """Elastic energy [J] by the descriptions' numbers alone."""

    def displacement(point):
        place = position[B] + rotation[B].apply(np.array(point) - DRAWING[B]) - position[A]
        return rotation[A].inv().apply(place) - (np.array(point) - DRAWING[A])

    d = displacement(BUSHING.point)
    turn = (rotation[A].inv() * rotation[B]).as_rotvec()
    total = np.dot(BUSHING.stiffness, d**2) / 2 - np.dot(BUSHING.preload, d)
    total += np.dot(BUSHING.rotational_stiffness, turn**2) / 2
    ends = [
        position[body] + rotation[body].apply(np.array(end) - DRAWING[body])
        for body, end in ((A, ROD.point_a), (B, ROD.point_b))
    ]
    total += ROD.stiffness * (np.linalg.norm(ends[1] - ends[0]) - ROD.length) ** 2 / 2
    for stop in (STOP, SLANTED):
        depth = displacement(stop.point) @ np.array(stop.axis)
        table = np.array(stop.table)
        depth = abs(depth) if stop.odd else max(depth, 0.0)
        x = np.array([0.0, *(d for d, _ in stop.table if d < depth), depth])  # exact for lines between
        slope = (table[-1, 1] - table[-2, 1]) / (table[-1, 0] - table[-2, 0])
        beyond = np.maximum(x - table[-1, 0], 0.0) * slope
        total += np.trapezoid(np.interp(x, *table.T) + beyond, x)
    return total


@pytest.mark.parametrize(("angle", "tolerance"), [(0.0, 1e-7), (1e-3, 1e-4)])
@pytest.mark.parametrize("seed", range(4))
def test_power_goes_into_springs_or_dampers(demo, seed, angle, tolerance):
    """Power of the forces + dampers + rate of the stored energy = 0, but for the laws of small rotations."""
    bench = bench_with(demo, *ALL)
    position, rotation, velocity, swing = anywhere(seed, angle=angle)
    swing = swing if angle else STILL
    bench.place(position, rotation)
    force, torque = bench.forces(velocity, swing)
    power = (force * velocity).sum() + (torque * swing).sum()
    step = 1e-5
    later, earlier = (
        stored(position + h * velocity, Rotation.from_rotvec(h * swing) * rotation) for h in (step, -step)
    )
    lost = bench.work.ledger[Ledger.DAMPER_POWER]
    scale = np.abs(force * velocity).sum() + np.abs(torque * swing).sum()
    assert lost > 1e-3 * scale
    assert abs(power + lost + (later - earlier) / (2 * step)) < tolerance * scale


@pytest.mark.parametrize(
    ("kind", "changes", "message"),
    [
        (BUSHING, {"stiffness": (1.0, -1.0, 1.0)}, "bushing bushing: stiffness"),
        (BUSHING, {"rotational_damping": (0.0, 0.0, float("nan"))}, "N m s/rad must be >= 0"),
        (ROD, {"point_a": ROD.point_b}, "length > 0"),
        (ROD, {"damping": -1.0}, "damping -1.0 N s/m"),
        (STOP, {"axis": (0.0, 2.0, 0.0)}, "unit vector"),
        (STOP, {"table": TABLE[:1]}, "1 points; allowed: 2..10"),
        (STOP, {"table": TABLE[::-1]}, "must rise"),
        (STOP, {"table": TABLE[2:]}, "odd stop must start"),
    ],
)
def test_nonsense_is_refused(kind, changes, message):
    with pytest.raises(ValueError, match=message):
        replace(kind, **changes)


@pytest.mark.parametrize(
    ("coupling", "message"),
    [
        (replace(BUSHING, body_b="wheelset_1"), "axle's centre line"),
        (replace(ROD, body_a="wheelset_1"), "axle's centre line"),
        (replace(STOP, body_a="wheelset_1"), "axle's centre line"),
        (replace(ROD, body_b="wheelset_1"), "axle's centre line"),
    ],
)
def test_a_wheelset_spins(coupling, message):
    with pytest.raises(ValueError, match=message):
        replace(WAGON, couplings=(coupling,))


def test_a_rod_between_two_axles_does_not_feel_their_spin(demo):
    """Cross-anchors: force and torque stay as they are while both wheelsets turn; none acts on the spin."""
    axles = [WAGON.body(f"wheelset_{k}").position for k in (2, 1)]
    ends = [(x, y, z) for (x, _, z), y in zip(axles, (-1.0, 1.0), strict=True)]
    rod = Rod("anchor", "wheelset_2", "wheelset_1", *ends, 5e6, 1e4)
    bench = Bench(replace(WAGON, couplings=(rod,)), demo)
    rng = np.random.default_rng(1)
    position = DRAWING + 3e-3 * rng.uniform(-1, 1, (SIZE, 3))
    small = Rotation.from_rotvec(3e-3 * rng.uniform(-1, 1, (SIZE, 3)))
    velocity = rng.uniform(-1, 1, (SIZE, 3))
    found = []
    for turn in (0.0, 0.4, 2.5):
        spin = np.zeros((SIZE, 3))
        spin[[NUMBERS["wheelset_1"], NUMBERS["wheelset_2"]], 1] = turn, 0.7 * turn
        rotation = small * Rotation.from_rotvec(spin)
        bench.place(position, rotation)
        found.append(bench.forces(velocity, rotation.apply(20.0 * spin)))
        axle = rotation.as_matrix()[:, :, 1]
        assert np.abs((found[-1][1] * axle).sum(axis=1)).max() < 1e-7 * np.abs(found[0][1]).max()
    assert np.abs(found[0][0]).max() > 1e3
    for force, torque in found[1:]:
        assert force == pytest.approx(found[0][0], abs=1e-9 * np.abs(force).max())
        assert torque == pytest.approx(found[0][1], abs=1e-9 * np.abs(torque).max())
