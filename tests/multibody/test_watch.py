"""The watch over a run: every reason to stop is found, and nothing in a good state."""

import math

import numpy as np
import pytest
from run_tables import table

from hh_exudyn.contact.state import Patch
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.model import workspace
from hh_exudyn.multibody.simulate import simulate
from hh_exudyn.multibody.watch import (
    ALTERNATIONS,
    FLANGE_TIP_MARGIN,
    LARGEST_LATERAL,
    LIFT_OFF_TIME,
    REASONS,
    SMALLEST_ALTERNATION,
    Trouble,
    look,
    watch_state,
)
from vehicles.catalogue import vehicle

NOTHING = (Trouble.NONE, -1, -1)
STEP = 0.5e-3
LOAD = 150e3


@pytest.fixture
def watch(demo):
    """Work space of a wagon whose eight wheels stand on their treads, and a fresh watch."""
    model = assemble(vehicle(demo.vehicle), demo)
    work = workspace(model)
    work.patches[:, :, 0, Patch.NORMAL_FORCE] = LOAD
    work.rail_force[:, :, 1] = -LOAD
    return work, watch_state(model)


def test_nothing_in_a_good_state(watch):
    work, state = watch
    rng = np.random.default_rng(1)
    for k in range(1000):
        # a wheelset that swings: lateral force up and down, but not from step to step
        work.rail_force[:, :, 0] += rng.uniform(0.0, 0.1 * LOAD) * math.cos(0.1 * k)
        work.frame_position[:, 1] = 0.01 * math.sin(0.1 * k)
        assert look(work, state, STEP) == NOTHING


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("place", [0, -1])
def test_not_finite(watch, value, place):
    work, state = watch
    work.generalized_force[place] = value
    assert look(work, state, STEP) == (Trouble.NOT_FINITE, -1, -1)


@pytest.mark.parametrize(("wheelset", "side"), [(0, 0), (2, 1), (3, 0)])
def test_lift_off_after_a_tenth_of_a_second(watch, wheelset, side):
    work, state = watch
    work.patches[wheelset, side, 0, Patch.NORMAL_FORCE] = 0.0
    steps = 0
    while (found := look(work, state, STEP)) == NOTHING:
        steps += 1
        assert steps <= LIFT_OFF_TIME / STEP + 1
    assert found == (Trouble.LIFT_OFF, wheelset, side)
    assert steps * STEP == pytest.approx(LIFT_OFF_TIME, abs=1.1 * STEP)


def test_a_wheel_that_lands_again_is_no_derailment(watch):
    work, state = watch
    for _ in range(5):
        work.patches[1, 1, 0, Patch.NORMAL_FORCE] = 0.0
        for _ in range(round(0.9 * LIFT_OFF_TIME / STEP)):
            assert look(work, state, STEP) == NOTHING
        work.patches[1, 1, 0, Patch.NORMAL_FORCE] = 1.0
        assert look(work, state, STEP) == NOTHING


@pytest.mark.parametrize(("wheelset", "side", "patch"), [(0, 0, 0), (1, 1, 2), (3, 1, 1)])
def test_climb(watch, demo, wheelset, side, patch):
    """A loaded contact within 3 mm of the flange's lowest point, on any patch; the flange face is free."""
    work, state = watch
    wheel = demo.wheel
    tip = wheel.y[np.argmin(wheel.z)]
    face = np.interp(
        -(wheel.z.min() + FLANGE_TIP_MARGIN + 5e-3), -wheel.z[wheel.y < tip], wheel.y[wheel.y < tip]
    )
    work.patches[wheelset, side, patch, Patch.NORMAL_FORCE] = 10e3
    work.patches[wheelset, side, patch, Patch.Y_WHEEL] = face
    assert look(work, state, STEP) == NOTHING
    work.patches[wheelset, side, patch, Patch.Y_WHEEL] = tip
    assert look(work, state, STEP) == (Trouble.CLIMB, wheelset, side)


def test_the_row_of_a_patch_that_carries_nothing_is_not_looked_at(watch):
    work, state = watch
    work.patches[0, 0, 1, Patch.Y_WHEEL] = 0.06
    assert look(work, state, STEP) == NOTHING


@pytest.mark.parametrize(("sign", "side"), [(1, 0), (-1, 1)])
def test_off_track(watch, sign, side):
    work, state = watch
    work.frame_position[2, 1] = sign * 0.99 * LARGEST_LATERAL
    assert look(work, state, STEP) == NOTHING
    work.frame_position[2, 1] = sign * 1.01 * LARGEST_LATERAL
    assert look(work, state, STEP) == (Trouble.OFF_TRACK, 2, side)


@pytest.mark.parametrize(
    ("change", "expected"),
    [(3.0 * SMALLEST_ALTERNATION, (Trouble.ALTERNATING, 1, 0)), (0.5 * SMALLEST_ALTERNATION, NOTHING)],
)
def test_alternating_lateral_force(watch, change, expected):
    """To and fro more than forty steps in a row is reported, small changes are not."""
    work, state = watch
    found = []
    for k in range(ALTERNATIONS + 5):
        work.rail_force[1, 0, 0] = 20e3 + 0.5 * change * LOAD * (-1) ** k
        found.append(look(work, state, STEP))
    assert found[:ALTERNATIONS] == [NOTHING] * ALTERNATIONS
    assert max(found) == expected


def test_every_trouble_has_a_reason():
    assert set(REASONS) == set(Trouble) - {Trouble.NONE}
    assert {reason for reason, _ in REASONS.values()} == {"divergence", "derailment"}


def straight(case, damping):
    """20 km/h on 30 m of straight at the default step, with this damping of the contacts [s/m].

    No sleepers pass: at 9 Hz they meet the pitch of a wagon with stuck wedges, 8 Hz, by 1.5 % of a load.
    """
    return case.with_changes(
        speed_km_h=20.0,
        integration={"step_ms": 0.4, "output_interval_ms": 0.4},
        track={
            "sections": [{"kind": "straight", "length_m": 30.0, "gauge_mm": 1445.0}],
            "sleeper_passing": False,
        },
        contact={"damping_s_per_m": damping},
    )


def test_the_largest_contact_damping_allowed_is_stable(demo, runs):
    """150 kN x 3 s/m on a rail of 150 kg is h lambda = 1.2 at 0.4 ms: the wheels carry the weight evenly."""
    contact = table(simulate(straight(demo, 3.0), runs / "damped"), "contact")
    first = contact.patch == 0
    loads = contact.Q[first].sum() / np.unique(contact.time).size
    assert loads == pytest.approx(vehicle("iore_wagon_loaded").mass * GRAVITY, rel=1e-3)
    assert np.ptp(contact.Q[first]) < 1e-3 * loads


def test_a_wheelset_that_flies_is_divergence(watch):
    work, state = watch
    work.frame_velocity[2, 1] = -20.0
    work.frame_position[2, 1] = -0.2
    assert look(work, state, STEP) == (Trouble.RUNAWAY, 2, 0)
