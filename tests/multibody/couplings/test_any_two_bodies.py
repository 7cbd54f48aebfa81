"""Every kind of coupling between any two bodies, in either order, with its preload on the drawing."""

from dataclasses import replace

import numpy as np
import pytest
from coupling_bench import DRAWING, NUMBERS, SIZE, STILL, WAGON, Bench
from scipy.spatial.transform import Rotation

from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.model import CouplingRecord, Ledger
from vehicles.couplings import (
    AxleBox,
    AxleBoxPad,
    BumpStop,
    Bushing,
    CentrePlate,
    Rod,
    SideBearer,
    SpringNest,
    Wedge,
)
from vehicles.description import Vehicle
from vehicles.freight_couplings import DoubleLink, LenoirSuspension
from vehicles.passenger_bogie import AxleBoxArm, Damper, SeriesDamper

AXLE = tuple(DRAWING[NUMBERS["wheelset_1"]] + [0.0, 0.8, 0.0])
TO = ("", "", "", AXLE)
ANY = (  # kinds that tell their bodies apart by the order of the names alone
    Bushing(*TO, (2e6, 3e6, 5e6), (2e4, 3e4, 1e4), (4e5, 6e5, 7e5), (3e3, 2e3, 1e3), (1e3, -2e3, 4e4)),
    Rod(*TO, (AXLE[0], AXLE[1] - 0.3, AXLE[2]), 8e6, 5e4, 3e3),
    BumpStop(*TO, (0.6, 0.0, -0.8), ((0.0, 0.0), (0.01, 5e4)), False, 2e3),
    Damper(*TO, (0.6, 0.8, 0.0), ((0.0, 0.0), (1.0, 2e4)), 500.0),
    SeriesDamper(*TO, (0.6, 0.0, 0.8), ((0.0, 0.0), (1.0, 2e4)), 1e7, 500.0),
    SpringNest(
        *TO, 2e6, 4e6, 0.02, 1e6, 2e6, 1e5, 2e5, 3e5, 1e3, 2e3, 1e3, 1e3, 1e3, 0.002, 1e7, 0.01, 1e6, 5e4
    ),
    next(replace(c, point=AXLE) for c in WAGON.couplings if isinstance(c, Wedge)),
    CentrePlate(*TO, 0.2, 4e8, 1e5, 0.3, 1e7, 1e4, 1e6, 1e3, 0.003, 1e8, preload=2e5),
    SideBearer(*TO, 2e4, 1e6, 1e3, 0.006, 1e8, 0.3, 1e7, 1e3),
)  # fmt: skip
OF_AXLE_BOXES = (  # kinds that know their wheelset
    AxleBoxPad(*TO, (2e7, 6e6, 1e8), (1e4, 1e4, 1e5), 1e5, 2e5, (1e3, 2e3, -9e4)),
    AxleBox(*TO, (2e7, 6e6, 1e7), (1e4, 1e4, 1e5), 1e5, 2e5, 0.3, 0.004, 0.01, 1e8, 9e4),
    AxleBoxArm(*TO, (AXLE[0] - 0.48, AXLE[1], AXLE[2] + 0.1), (17e6, 9e6, 17e6), (1e3, 1e3), 2e3),
    LenoirSuspension(
        *TO, 1, 1e6, 2e6, 0.03, 5e5, 0.5, 0.3, 2e7, 0.25, 1e7, 1e4, 1e4, 0.01, 0.01, 2e7, 6e4
    ),
    DoubleLink(
        *TO, 1e6, 2e6, 0.04, 0.08, 6e6, 0.35, 0.5, 0.04, 0.05, 3e6, 1e4, 0.02, 0.02, 2e7, 6e4
    ),
)  # fmt: skip
PAIRS = (
    ("side_frame_1L", "wheelset_1"),
    ("wheelset_1", "side_frame_1L"),
    ("side_frame_1L", "car_body"),
    ("car_body", "side_frame_1L"),
)
WAY, RATE = np.array([2e-3, -3e-3, -4e-3]), np.array([0.02, 0.01, -0.03])


def name_of(coupling):
    return type(coupling).__name__


def between(coupling, a, b):
    return replace(coupling, name="tried", body_a=a, body_b=b)


def bench_of(case, coupling, a, b):
    return Bench(replace(WAGON, couplings=(between(coupling, a, b),)), case)


def response(bench, body):
    """Force on a body and its record, moved and swung by `WAY` and `RATE` without turning."""
    position, velocity = DRAWING.copy(), STILL.copy()
    position[NUMBERS[body]] += WAY
    velocity[NUMBERS[body]] = RATE
    bench.place(position, Rotation.identity(SIZE))
    bench.sliders[:] = 0.0
    force, _ = bench.forces(velocity)
    return force[NUMBERS[body]], bench.work.coupling_record[0].copy()


@pytest.mark.parametrize("coupling", ANY, ids=name_of)
def test_body_b_has_the_same_force_whichever_bodies_they_are(demo, coupling):
    """Of any two, in any order: force, displacement and record are those of body B against body A."""
    found = [response(bench_of(demo, coupling, a, b), b) for a, b in PAIRS]
    force, record = found[0]
    assert np.abs(force).max() > 10.0
    for other, its_record in found[1:]:
        assert other == pytest.approx(force, rel=1e-9, abs=1e-6)
        assert its_record == pytest.approx(record, rel=1e-9, abs=1e-6)
    if not isinstance(coupling, Rod):
        assert record[CouplingRecord.DISPLACEMENT_X :] == pytest.approx(WAY)


def mirrored(coupling):
    """The same element with the names of its bodies exchanged, where its own numbers can say that."""
    if isinstance(coupling, Bushing):
        return replace(coupling, preload=tuple(-force for force in coupling.preload))
    if isinstance(coupling, Rod):
        return replace(coupling, point_a=coupling.point_b, point_b=coupling.point_a)
    return replace(coupling, axis=tuple(-part for part in coupling.axis))


@pytest.mark.parametrize("coupling", ANY[:5], ids=name_of)
@pytest.mark.parametrize(("a", "b"), PAIRS[::2])
def test_exchanged_and_mirrored_it_is_the_same_element(demo, coupling, a, b):
    """Forces and moments on all bodies, in a state of motion of them all, rotations small."""
    rng = np.random.default_rng(3)
    position = DRAWING + 2e-3 * rng.uniform(-1, 1, (SIZE, 3))
    velocity = 0.05 * rng.uniform(-1, 1, (SIZE, 3))
    found = []
    for bench in (bench_of(demo, coupling, a, b), bench_of(demo, mirrored(coupling), b, a)):
        bench.place(position, Rotation.identity(SIZE))
        found.append(np.hstack(bench.forces(velocity)))
    scale = np.abs(found[0]).max()
    assert scale > 10.0
    if "wheelset_1" in (a, b) and not isinstance(coupling, Rod):
        assert found[1] == pytest.approx(found[0], rel=1e-12, abs=1e-12 * scale)
    else:  # its force stands at the point of the other body, some millimetres off
        assert found[1][:, :3] == pytest.approx(found[0][:, :3], rel=1e-9, abs=1e-9 * scale)
        assert found[1][:, 3:] == pytest.approx(found[0][:, 3:], abs=0.01 * scale)


@pytest.mark.parametrize("coupling", OF_AXLE_BOXES, ids=name_of)
def test_an_axle_box_element_knows_its_wheelset(demo, coupling):
    frame, axle = PAIRS[0]
    assert replace(WAGON, couplings=(between(coupling, axle, frame),)).couplings == (
        between(coupling, frame, axle),
    )
    force, _ = response(bench_of(demo, coupling, axle, frame), axle)
    assert np.abs(force).max() > 10.0


@pytest.mark.parametrize("coupling", ANY, ids=name_of)
@pytest.mark.parametrize("seed", range(3))
def test_a_wheelset_as_body_a_gets_no_moment_about_its_axle(demo, coupling, seed):
    """Balance of forces and moments in any state; its spin and its rolled angle change no force."""
    bench = bench_of(demo, coupling, "wheelset_1", "car_body")
    rng = np.random.default_rng(seed)
    position = DRAWING + 3e-3 * rng.uniform(-1, 1, (SIZE, 3))
    rotation = Rotation.from_rotvec(3e-3 * rng.uniform(-1, 1, (SIZE, 3)))
    velocity, spin = 0.1 * rng.uniform(-1, 1, (2, SIZE, 3))
    bench.place(position, rotation)
    force, torque = bench.forces(velocity, spin)
    size = np.abs(force).sum()
    assert size > 10.0
    assert np.abs(force.sum(axis=0)).max() < 1e-12 * size
    moment = torque + np.cross(position, force)
    assert np.abs(moment.sum(axis=0)).max() < 1e-10 * np.abs(np.cross(position, force)).sum()
    wheel = NUMBERS["wheelset_1"]
    axle = rotation[wheel].apply([0.0, 1.0, 0.0])
    assert abs(torque[wheel] @ axle) < 1e-9 * size
    rolled = [
        each if i != wheel else Rotation.from_rotvec(2.0 * axle) * each for i, each in enumerate(rotation)
    ]
    bench.place(position, Rotation.concatenate(rolled))
    spin = spin.copy()
    spin[wheel] += 40.0 * axle
    again = bench.forces(velocity, spin)
    assert again[0] == pytest.approx(force, abs=1e-7 * size)
    assert again[1] == pytest.approx(torque, abs=1e-7 * size)


@pytest.mark.parametrize("coupling", ANY, ids=name_of)
def test_a_wheelset_as_body_a_loses_what_it_takes(demo, coupling):
    """Power of the forces + ledger = 0 where no spring takes any: all springs at rest, rates alone."""
    bench = bench_of(demo, coupling, "wheelset_1", "car_body")
    velocity = STILL.copy()
    velocity[NUMBERS["car_body"]] = RATE
    still, _ = bench.forces()
    moving, _ = bench.forces(velocity)
    power = ((moving - still) * velocity).sum()
    lost = bench.work.ledger[Ledger.DAMPER_POWER] + bench.work.ledger[Ledger.FRICTION_POWER]
    assert power + lost == pytest.approx(0.0, abs=1e-9 * abs(lost) + 1e-9)


PRELOADS = {  # force on body B on the drawing
    SpringNest: (0.0, 0.0, 5e4),
    CentrePlate: (0.0, 0.0, 2e5),
    SideBearer: (0.0, 0.0, 2e4),
    Bushing: (1e3, -2e3, 4e4),
    Rod: (0.0, 3e3, 0.0),  # its end on B lies to the right of its end on A
    BumpStop: (0.6 * 2e3, 0.0, -0.8 * 2e3),
    Damper: (0.6 * 500.0, 0.8 * 500.0, 0.0),
    SeriesDamper: (0.6 * 500.0, 0.0, 0.8 * 500.0),
    AxleBoxPad: (1e3, 2e3, -9e4),
    AxleBox: (0.0, 0.0, -9e4),
    DoubleLink: (0.0, 0.0, -6e4),
}  # fmt: skip


@pytest.mark.parametrize("coupling", [c for c in (*ANY, *OF_AXLE_BOXES) if type(c) in PRELOADS], ids=name_of)
def test_the_preload_is_the_force_on_the_drawing(demo, coupling):
    frame, axle = PAIRS[0]
    force, _ = bench_of(demo, coupling, frame, axle).forces()
    assert force[NUMBERS[axle]] == pytest.approx(PRELOADS[type(coupling)], rel=1e-9, abs=1e-9)


def test_preloads_of_arm_and_lenoir_link(demo):
    """The arm pulls along itself; the Lenoir's plunger presses the box with its link's share."""
    frame, axle = PAIRS[0]
    arm, lenoir = OF_AXLE_BOXES[2], OF_AXLE_BOXES[3]
    force, _ = bench_of(demo, arm, frame, axle).forces()
    assert force[NUMBERS[axle]] == pytest.approx(2e3 * np.array([-0.48, 0.0, 0.1]) / np.hypot(0.48, 0.1))
    bench = bench_of(demo, lenoir, frame, axle)
    bench.relax()
    bench.sliders[:] = 0.0
    force, _ = bench.forces()
    plunger = np.tan(lenoir.link_angle) * lenoir.link_share * 6e4
    assert force[NUMBERS[axle]] == pytest.approx([-plunger, 0.0, -6e4])


@pytest.mark.parametrize("load", [0.0, 3e4, 4e4, 9e4])
def test_a_preloaded_nest_is_the_nest_compressed_so_far(demo, load):
    nest = ANY[5]
    bare = bench_of(demo, replace(nest, preload=0.0), *PAIRS[2])
    loaded = bench_of(demo, replace(nest, preload=load), *PAIRS[2])
    compression = replace(nest, preload=load).compression
    for way in (-0.01, 0.0, 0.005):
        wanted, _ = bare.displaced("car_body", (0.0, 0.0, way - compression))
        found, _ = loaded.displaced("car_body", (0.0, 0.0, way))
        assert found[2] == pytest.approx(wanted[2], abs=1e-6)


def test_a_wagon_drawn_loaded_stands_as_drawn(demo):
    """With the weight above it as the preload of plates and nests, the car body has no force left."""
    plates = [c for c in WAGON.couplings if isinstance(c, CentrePlate)]
    load = WAGON.body("car_body").mass * GRAVITY / len(plates)
    bench = Bench(replace(WAGON, couplings=tuple(replace(c, preload=load) for c in plates)), demo)
    force, torque = bench.forces()
    assert force[NUMBERS["car_body"]] == pytest.approx([0.0, 0.0, load * len(plates)])
    assert torque[NUMBERS["car_body"]] == pytest.approx([0.0, 0.0, 0.0], abs=1.0)


@pytest.mark.parametrize(
    ("coupling", "a", "b", "text"),
    [
        (ANY[0], "wheelset_1", "wheelset_2", "Bushing tried joins the wheelsets .* allowed .*: Rod"),
        (OF_AXLE_BOXES[0], "wheelset_1", "wheelset_2", "AxleBoxPad tried joins the wheelsets"),
        (OF_AXLE_BOXES[2], "side_frame_1L", "car_body", "AxleBoxArm tried turns on car_body, which is no"),
        (ANY[1], "car_body", "car_body", "Rod tried joins car_body to itself"),
        (ANY[5], "ground", "car_body", "no body named ground; the ground passes by .* `held_weight`"),
        (ANY[5], "roof", "car_body", "SpringNest tried: no body named roof; allowed: car_body"),
        (replace(ANY[0], point=(0.0, 0.0, 1.0)), "wheelset_1", "car_body", "on the axle's centre line"),
    ],
)
def test_impossible_combinations_name_the_element(coupling, a, b, text):
    with pytest.raises(ValueError, match=text):
        replace(WAGON, couplings=(between(coupling, a, b),))


@pytest.mark.parametrize("coupling", [ANY[5], ANY[7], *OF_AXLE_BOXES[1:2], *OF_AXLE_BOXES[3:]], ids=name_of)
def test_what_cannot_pull_has_no_preload_below_zero(coupling):
    with pytest.raises(ValueError, match=r"preload -1\.0 N must be >= 0, as it cannot pull"):
        replace(coupling, preload=-1.0)


def test_two_wheelsets_on_a_rod_are_a_vehicle():
    rod = between(ANY[1], "wheelset_1", "wheelset_2")
    end = tuple(DRAWING[NUMBERS["wheelset_2"]] + [0.0, 0.8, 0.0])
    assert isinstance(replace(WAGON, couplings=(replace(rod, point_b=end),)), Vehicle)
