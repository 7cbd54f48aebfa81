"""Wheel climb: lift and running on the flange alone are seen; derailment is judged against the rails."""

import math

import numpy as np
import pytest

from hh_exudyn.contact.state import Patch
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.climb import (
    FLANGE_ANGLE,
    LARGEST_LIFT,
    LONGEST_FLANGE,
    climb_state,
    climbing_wheels,
    see_climb,
)
from hh_exudyn.multibody.model import Workspace, workspace
from hh_exudyn.multibody.simulate import simulate
from hh_exudyn.multibody.watch import Trouble, look, watch_state, watched
from vehicles.catalogue import vehicle

STEP = 0.5e-3
SPEED = 20.0


@pytest.fixture
def work(demo) -> Workspace:
    """Eight wheels on their treads, axles level and 0.4575 m above the rails."""
    work = workspace(assemble(vehicle(demo.vehicle), demo))
    work.patches[:, :, 0, Patch.NORMAL_FORCE] = 100e3
    work.rail_force[:, :, 1] = -100e3
    work.frame_axle[:] = (0.0, 1.0, 0.0)
    work.frame_position[:, 2] = 0.4575
    work.frame_velocity[:, 0] = SPEED
    work.rail_position[:, 0] = (0.75, 0.0)
    work.rail_position[:, 1] = (-0.75, 0.0)
    return work


def run(work: Workspace, seconds: float, state, **of_time):
    for k in range(round(seconds / STEP)):
        work.arc_length[:] = 100.0 + SPEED * k * STEP
        for change in of_time.values():
            change(k * STEP)
        see_climb(work, state, STEP)
    return state


def test_a_lifted_wheel_is_named_with_its_height_and_place(work) -> None:
    """The left wheel of the second wheelset rises to 18 mm, the right one stays: 12 mrad of roll."""

    def rise(t: float) -> None:
        lift = 0.018 * math.sin(math.pi * t) ** 2
        roll = lift / 1.5
        work.frame_axle[1] = (0.0, math.cos(roll), math.sin(roll))
        work.frame_position[1, 2] = 0.4575 + 0.5 * lift

    state = run(work, 1.0, climb_state(4), rise=rise)
    assert state.lift[1, 0] == pytest.approx(0.018, rel=1e-3)
    assert state.lift_at[1, 0] == pytest.approx(110.0, abs=0.1)
    assert state.lift[1, 1] == pytest.approx(0.0, abs=1e-5)
    (wheel,) = climbing_wheels(state)
    assert (wheel["wheel"], wheel["lift_mm"]) == ("2L", pytest.approx(18.0, abs=0.02))


def test_a_wheel_that_moves_with_its_rail_does_not_lift(work) -> None:
    """Level and alignment of both rails are 95 mm off: so are the wheels."""

    def sway(t: float) -> None:
        work.rail_position[:, 0] = (0.75 + 0.095 * t, 0.05 * t)
        work.rail_position[:, 1] = (-0.75 + 0.095 * t, 0.05 * t)
        work.frame_position[:, 1], work.frame_position[:, 2] = 0.095 * t, 0.4575 + 0.05 * t

    state = run(work, 1.0, climb_state(4), sway=sway)
    assert np.abs(state.lift).max() < 1e-9
    assert climbing_wheels(state) == []


@pytest.mark.parametrize(("metres", "named"), [(27.0, True), (1.9, False)])
def test_running_on_the_flange_alone(work, metres: float, named: bool) -> None:
    """Over 2 m it is reported; a second patch on the tread makes it an ordinary flange contact."""
    state = climb_state(4)
    work.patches[0, 0, 0, Patch.CONTACT_ANGLE] = FLANGE_ANGLE + 0.1
    work.patches[3, 1, 0, Patch.CONTACT_ANGLE] = FLANGE_ANGLE + 0.1
    work.patches[3, 1, 1, Patch.NORMAL_FORCE] = 1e3
    run(work, metres / SPEED, state)
    assert state.longest[0, 0] == pytest.approx(metres, abs=0.02)
    assert state.longest[3, 1] == 0.0
    assert [wheel["wheel"] for wheel in climbing_wheels(state)] == (["1L"] if named else [])
    work.patches[0, 0, 0, Patch.CONTACT_ANGLE] = 0.1
    run(work, 1.0, state)
    assert state.flange[0, 0] == 0.0
    assert state.longest[0, 0] == pytest.approx(metres, abs=0.02)
    assert LONGEST_FLANGE == 2.0


def test_a_wheel_in_the_air_is_not_on_its_flange(work) -> None:
    work.patches[0, 0, 0, Patch.NORMAL_FORCE] = 0.0
    work.patches[0, 0, 0, Patch.CONTACT_ANGLE] = 1.2
    assert run(work, 1.0, climb_state(4)).longest[0, 0] == 0.0


def test_derailment_is_judged_against_the_rails(work, demo) -> None:
    """95 mm beside the design line with both rails: on the track; 81 mm beside the rails' middle: off it."""
    state = watch_state(assemble(vehicle(demo.vehicle), demo))
    work.rail_position[:, 0, 0], work.rail_position[:, 1, 0] = 0.845, -0.655
    work.frame_position[:, 1] = 0.095
    assert look(work, state, STEP) == (Trouble.NONE, -1, -1)
    work.frame_position[2, 1] = 0.014 - 1e-3
    assert look(work, state, STEP) == (Trouble.OFF_TRACK, 2, 1)


def test_the_status_has_every_wheel(work, demo) -> None:
    state = watch_state(assemble(vehicle(demo.vehicle), demo))
    look(work, state, STEP)
    work.frame_position[0, 2] += LARGEST_LIFT + 1e-3
    work.patches[1, 0, 0, Patch.FLOORED] = 1.0
    look(work, state, STEP)
    status = watched(state)
    assert [wheel["wheel"] for wheel in status["watch"]] == [f"{w}{side}" for w in "1234" for side in "LR"]
    assert status["watch"][0]["lift_mm"] == pytest.approx(6.0)
    assert [wheel["wheel"] for wheel in status["wheel_climb"]] == ["1L", "1R"]
    assert status["watch"][2]["floored_share"] == 0.5
    assert (status["floored_curvatures"], status["chatter"]) == (1, [])


def test_a_run_that_ends_with_a_lifted_wheel_says_so(demo, tmp_path) -> None:
    """An empty wagon goes into a curve of 100 m at a friction of 1: the outer leading wheel climbs. The track
    ends before it is over the rail, so the run ends like any other."""
    sections = [
        {"kind": "straight", "length_m": 20.0},
        {"kind": "transition", "length_m": 10.0},
        {"kind": "curve", "length_m": 3.3, "radius_m": 100.0, "hand": "left"},
    ]
    case = demo.with_changes(
        vehicle="iore_wagon_empty",
        speed_km_h=35.0,
        friction=1.0,
        track={"flexibility": "rigid", "sections": sections},
        contact={"theory": "polach", "normal": "hertz"},
    )
    status = simulate(case, tmp_path / "run").status
    assert status["finished"] is True
    (wheel,) = status["wheel_climb"]
    assert wheel["wheel"] == "1R"
    assert 5.0 < wheel["lift_mm"] < 20.0
    assert wheel["lift_s_m"] == pytest.approx(32.0, abs=0.6)
