"""Axle-box arm, dampers, bushings on a wheelset: closed forms, energy, no moment about the axle."""

from dataclasses import replace

import numpy as np
import pytest
from coupling_bench import DRAWING, NUMBERS, SIZE, STILL, WAGON, Bench
from scipy.optimize import minimize_scalar
from scipy.spatial.transform import Rotation

from hh_exudyn.multibody.model import Ledger
from vehicles.couplings import AxleBoxPad, Bushing, Rod
from vehicles.passenger_bogie import AxleBoxArm, Damper, SeriesDamper

FRAME, AXLE = NUMBERS["side_frame_1L"], NUMBERS["wheelset_1"]
X, _, Z = DRAWING[AXLE]
ARM = AxleBoxArm(
    "arm", "side_frame_1L", "wheelset_1", (X, 1.055, Z), (X - 0.48, 1.055, Z + 0.0135), (17e6, 9e6, 17e6)
)
COIL = Bushing(
    "coil", "side_frame_1L", "wheelset_1", (X, 1.0, Z), (0.0, 0.0, 1.4e6), (0.0, 0.0, 1e4),
    (2e5, 7e5, 3e5), (2e2, 7e2, 3e2), (0.0, 0.0, -59e3),
)  # fmt: skip


def bench_with(case, *couplings):
    return Bench(replace(WAGON, couplings=couplings), case)


def test_a_longitudinal_load_meets_the_bushing_along_the_arm(demo):
    bench = bench_with(demo, ARM)
    force, torque = bench.displaced("wheelset_1", (1e-4, 0.0, 0.0))
    assert force[0] == pytest.approx(-17e6 * 1e-4, rel=2e-3)
    assert torque[1] == pytest.approx(0.0, abs=1e-9)


def test_the_arm_turns_away_under_a_vertical_load(demo):
    """The drawing's height difference alone holds: (0.0135/0.48)^2 of the stiffness."""
    bench = bench_with(demo, ARM)
    force, _ = bench.displaced("wheelset_1", (0.0, 0.0, 1e-4))
    assert abs(force[2]) < 2e-3 * 17e6 * 1e-4


def test_a_lateral_load_has_the_lever_of_the_arm(demo):
    bench = bench_with(demo, ARM)
    force, torque = bench.displaced("wheelset_1", (0.0, 1e-4, 0.0))
    assert force == pytest.approx([0.0, -900.0, 0.0], abs=1e-6)
    assert torque == pytest.approx([0.0135 * 900.0, 0.0, 0.48 * 900.0], rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(
    ("stiffness", "small", "tolerance"),
    [((9e6,) * 3, 1e-3, 1e-6), ((17e6, 9e6, 17e6), 1e-5, 3e-4), ((17e6, 9e6, 5e6), 1e-5, 3e-4)],
)
def test_the_condensed_arm_is_the_massless_arm_in_its_own_equilibrium(demo, stiffness, small, tolerance):
    """Energy of the bushing, least over the pitch of an arm on the axle: its derivatives are the forces.

    Exact for a bushing alike in all directions, else for small angles between axle and frame.
    """
    bench = bench_with(demo, replace(ARM, stiffness=stiffness))
    rng = np.random.default_rng(2)

    def energy(moved, turn):
        turned = Rotation.from_rotvec(turn)
        pivot = DRAWING[AXLE] + moved + turned.apply(np.array(ARM.point) - DRAWING[AXLE])

        def bushing(pitch):
            end = pivot + (turned * Rotation.from_rotvec([0.0, pitch, 0.0])).apply(ARM.arm)
            return 0.5 * float(stiffness @ (end - np.array(ARM.bushing)) ** 2)

        return minimize_scalar(bushing, bracket=(-0.01, 0.01), tol=1e-14).fun

    for _ in range(5):
        moved, turn = small * rng.uniform(-1, 1, 3), small * rng.uniform(-1, 1, 3)
        force, torque = bench.displaced("wheelset_1", moved, turn)
        step = 1e-2 * small
        slope = [
            (energy(moved + step * e, turn) - energy(moved - step * e, turn)) / (2 * step) for e in np.eye(3)
        ]
        assert force == pytest.approx(-np.array(slope), abs=tolerance * np.abs(force).max())
        turned = Rotation.from_rotvec(turn)
        about = [
            (
                energy(moved, (Rotation.from_rotvec(step * e) * turned).as_rotvec())
                - energy(moved, (Rotation.from_rotvec(-step * e) * turned).as_rotvec())
            )
            / (2 * step)
            for e in np.eye(3)
        ]
        assert torque == pytest.approx(-np.array(about), abs=tolerance * np.abs(torque).max())


@pytest.mark.parametrize("coupling", [ARM, replace(ARM, damping=(2e4, 1e4)), COIL])
def test_spin_changes_nothing_and_is_not_braked(demo, coupling):
    bench = bench_with(demo, coupling)
    rng = np.random.default_rng(7)
    position = DRAWING + 2e-3 * rng.uniform(-1, 1, (SIZE, 3))
    small = Rotation.from_rotvec(2e-3 * rng.uniform(-1, 1, (SIZE, 3)))
    velocity, turning = rng.uniform(-0.1, 0.1, (2, SIZE, 3))
    axle = small.apply([0.0, 1.0, 0.0])[AXLE]
    bench.place(position, small)
    force, torque = bench.forces(velocity, turning)
    spun, spin = np.zeros((SIZE, 3)), turning.copy()
    spun[AXLE, 1] = 2.1
    spin[AXLE] += 40.0 * axle
    bench.place(position, small * Rotation.from_rotvec(spun))
    force_spun, torque_spun = bench.forces(velocity, spin)
    assert force_spun == pytest.approx(force, rel=1e-9, abs=1e-6)
    assert torque_spun == pytest.approx(torque, rel=1e-9, abs=1e-6)
    assert torque[AXLE] @ axle == pytest.approx(0.0, abs=1e-9 * np.abs(force).max())


def test_a_bushing_on_a_wheelset_has_its_preload_and_its_angles(demo):
    bench = bench_with(demo, COIL)
    force, torque = bench.displaced("wheelset_1")
    assert force == pytest.approx(COIL.preload)
    bench.place(DRAWING, Rotation.identity(SIZE))
    turned = np.zeros((SIZE, 3))
    turned[AXLE] = (1e-4, 0.0, -2e-4)
    arm = np.array(COIL.point) - DRAWING[AXLE]
    position = DRAWING.copy()
    position[AXLE] += arm - Rotation.from_rotvec(turned[AXLE]).apply(arm)
    bench.place(position, Rotation.from_rotvec(turned))
    force, torque = bench.forces()
    moment = torque[AXLE] - np.cross(Rotation.from_rotvec(turned[AXLE]).apply(arm), force[AXLE])
    assert moment == pytest.approx([-2e5 * 1e-4, 0.0, 3e5 * 2e-4], rel=1e-3, abs=0.1)


@pytest.mark.parametrize(
    ("preloaded", "body", "expected"),
    [
        (
            AxleBoxPad("pad", "side_frame_1L", "wheelset_1", (X, 1.0, Z), (1e6,) * 3, (0.0,) * 3, 0.0, 0.0,
                       (1.0, 2.0, -5e4)),
            "wheelset_1",
            (1.0, 2.0, -5e4),
        ),
        (
            Rod("rod", "bolster_1", "car_body", (3.0, 0.0, 0.6), (1.0, 0.0, 0.6), 1e6, 0.0, 2e3),
            "car_body",
            (2e3, 0.0, 0.0),
        ),
        (
            Damper("gas", "bolster_1", "car_body", (3.0, 0.0, 0.6), (0.0, 1.0, 0.0), ((0.0, 0.0), (1.0, 1e4)),
                   300.0),
            "car_body",
            (0.0, 300.0, 0.0),
        ),
    ],
)  # fmt: skip
def test_preload_acts_on_the_drawing(demo, preloaded, body, expected):
    force, _ = bench_with(demo, preloaded).displaced(body)
    assert force == pytest.approx(expected)


TABLE = ((0.0, 0.0), (0.02, 12e3), (1.0, 12e3))


@pytest.mark.parametrize("kind", [Damper, SeriesDamper])
def test_a_damper_acts_along_its_axis_and_loses_what_it_takes(demo, kind):
    more = {"series_stiffness": 5e6} if kind is SeriesDamper else {}
    damper = kind("damper", "bolster_1", "car_body", (3.4, 1.2, 0.6), (1.0, 0.0, 0.0), TABLE, **more)
    bench = bench_with(demo, damper)
    bench.sliders[0, 2] = np.inf  # as the equilibrium leaves it
    velocity = STILL.copy()
    velocity[NUMBERS["car_body"]] = (0.01, 0.2, 0.3)
    force, torque = bench.forces(velocity)
    assert force[NUMBERS["car_body"]] == pytest.approx([-6e3, 0.0, 0.0])
    assert bench.work.ledger[Ledger.DAMPER_POWER] == pytest.approx(6e3 * 0.01)
    moment = torque + np.cross(DRAWING, force)
    assert np.abs(moment.sum(axis=0)).max() < 1e-9 * np.abs(moment).max()
    velocity[NUMBERS["car_body"], 0] = -0.5
    force, _ = bench.forces(velocity)
    assert force[NUMBERS["car_body"], 0] == pytest.approx(12e3)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"table": ((0.0, 1.0), (1.0, 2.0))}, "must start at"),
        ({"table": ((0.0, 0.0), (1.0, -2.0))}, "not fall"),
        ({"table": ((0.0, 0.0), (1.0, 0.0))}, "not fall"),
        ({"table": ((0.0, 0.0),)}, "has 1 points"),
        ({"axis": (1.0, 1.0, 0.0)}, "unit vector"),
        ({"series_stiffness": 0.0}, "series_stiffness 0.0 N/m must be > 0"),
    ],
)
def test_impossible_dampers(change, text):
    given = {"axis": (1.0, 0.0, 0.0), "table": TABLE, "series_stiffness": 1e6, **change}
    with pytest.raises(ValueError, match=text):
        SeriesDamper("damper", "a", "b", (0.0, 0.0, 0.0), **given)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"bushing": ARM.point}, "must be away from the axle"),
        ({"bushing": (X - 0.4, 0.9, Z)}, "at the same y"),
        ({"stiffness": (1e6, 0.0, 1e6)}, "must be > 0"),
        ({"damping": (-1.0, 0.0)}, "must be >= 0"),
    ],
)
def test_impossible_arms(change, text):
    with pytest.raises(ValueError, match=text):
        replace(ARM, **change)


def test_an_arm_turns_on_a_wheelset_alone():
    with pytest.raises(ValueError, match="turns on bolster_1, which is no wheelset"):
        replace(WAGON, couplings=(replace(ARM, body_b="bolster_1"),))
