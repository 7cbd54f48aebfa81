"""Static equilibrium of the loaded and the empty wagon."""

import numpy as np
import pytest

from hh_exudyn.contact.types import Patch
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import FORCE_TOLERANCE, equilibrium
from hh_exudyn.multibody.model import Ledger, workspace
from vehicles.catalogue import vehicle
from vehicles.parameters import load_parameters


def settle(case):
    wagon = vehicle(case.vehicle)
    model = assemble(wagon, case)
    work = workspace(model)
    return wagon, work, equilibrium(wagon, model, work)


@pytest.fixture(scope="module", params=["iore_wagon_loaded", "iore_wagon_empty"])
def settled(request, demo):
    return settle(demo.with_changes(vehicle=request.param))


def drop(wagon, state, name):
    """How far a body is below the drawing [m]."""
    i = [body.name for body in wagon.bodies].index(name)
    return wagon.bodies[i].position[2] - state.q[6 * i + 2]


def test_wheel_loads_carry_the_weight(settled):
    wagon, work, _ = settled
    loads = -work.rail_force[:, :, 1]
    assert loads.sum() == pytest.approx(wagon.mass * GRAVITY, rel=1e-6)
    assert np.ptp(loads) < 1e-3 * loads.mean()
    assert np.abs(work.generalized_force).max() <= FORCE_TOLERANCE


def test_left_and_right_are_mirror_images(settled):
    _, work, _ = settled
    assert np.abs(work.frame_position[:, 1]).max() < 1e-9
    left, right = work.patches[:, 0, 0], work.patches[:, 1, 0]
    odd = [Patch.NU_Y, Patch.PHI, Patch.FORCE_Y, Patch.MOMENT_Z]
    right[:, odd] *= -1.0
    assert left == pytest.approx(right, rel=1e-6, abs=1e-6)


def test_load_springs_deflect_as_their_law_says(settled):
    """Nest and wedges of one side carry a quarter of the sprung weight: closed form of the two stages."""
    wagon, _, state = settled
    p = load_parameters("iore_wagon")
    sprung = sum(body.mass for body in wagon.bodies if body.kind in ("car_body", "bolster"))
    # a column that closes by its toe drives the wedge further down than the bolster, and its lift grows alike
    toe, slope = np.radians([p["wedge.toe"], p["wedge.slope"]])
    drive = 1 / (1 - np.tan(toe) / np.tan(slope))
    load = sprung * GRAVITY / 4 - 2 * p["wedge.preload"] * drive
    wedges = 2 * p["wedge.spring_stiffness"] * drive**2
    first = p["spring_nest.first_stiffness"] + wedges
    second = p["spring_nest.second_stiffness"] + wedges
    touch = p["spring_nest.second_from"]
    deflection = load / first if load < first * touch else touch + (load - first * touch) / second
    found = drop(wagon, state, "bolster_1") - drop(wagon, state, "side_frame_1L")
    assert found == pytest.approx(deflection, rel=1e-3)


def test_deflections_are_plausible(demo):
    """Loaded 60..80 mm, empty 12..22 mm in the springs; 1..3 mm of track; a pad under 1 mm."""
    for name, low, high in (("iore_wagon_loaded", 0.060, 0.080), ("iore_wagon_empty", 0.012, 0.022)):
        wagon, work, state = settle(demo.with_changes(vehicle=name))
        springs = drop(wagon, state, "bolster_1") - drop(wagon, state, "side_frame_1L")
        assert low < springs < high
        pads = drop(wagon, state, "side_frame_1L") - drop(wagon, state, "wheelset_1")
        assert 0.0 < pads < 1e-3
        if name == "iore_wagon_loaded":
            assert 1e-3 < -work.rail_position[0, 0, 1] < 3e-3


def test_wheels_roll_and_the_train_hardly_pulls(settled):
    """On straight track only spin creepage and normal damping cost anything: below 10 N of coupler force."""
    _, work, _ = settled
    assert abs(work.ledger[Ledger.COUPLER_FORCE]) < 10.0
    assert np.abs(work.patches[:, :, 0, Patch.NU_X]).max() < 1e-6


def test_a_track_that_begins_in_a_curve_is_refused(demo):
    curve = {"kind": "curve", "length_m": 60.0, "radius_m": 450.0, "hand": "left"}
    case = demo.with_changes(track={"sections": [curve]})
    with pytest.raises(ValueError, match=r"first 11\.3 m must be straight"):
        settle(case)
