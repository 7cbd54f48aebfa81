"""Place and direction of a rail against the line that the frames of an alignment draw in space."""

import numpy as np
import pytest

from track.course.alignment import (
    Alignment,
    Curve,
    Grade,
    Straight,
    Transition,
    inclined_frame,
    inclined_rotation,
)
from track.course.frame import track_turn
from track.course.rail_frame import RailShift, rail_frame
from track.irregularity.irregularity import Irregularity, random_irregularity
from track.irregularity.table import irregularity_at, smooth_track

STEP = 1e-4
POINT = 0.0364  # m, of a rail's gauge point from its profile's origin
UNDEFLECTED = RailShift(0.0, 0.0, 0.0, 0.0)
SNAKE = Alignment(
    (
        Straight(20.0, gauge=1.435),
        Transition(40.0),
        Curve(40.0, radius=300.0, hand="left", cant=0.1, gauge=1.445),
        Transition(60.0),
        Curve(30.0, radius=500.0, hand="right", cant=0.06, gauge=1.440),
    ),
    grades=(Grade(30.0, -0.005), Grade(80.0, -0.005, 0.012), Grade(80.0, 0.012)),
)


def rail(s, side, irregular=None, shift=UNDEFLECTED):
    """Origin and rotation of R in the global frame, its place in T, and its twist."""
    x, y, z, heading, pitch, roll, _, gauge = inclined_frame(SNAKE.table, s)
    track = np.empty((3, 3))
    inclined_rotation(heading, pitch, roll, track)
    position, rotation = np.empty(2), np.empty((3, 3))
    state = irregularity_at(smooth_track() if irregular is None else irregular, s)
    turn = track_turn(SNAKE.table, s, pitch, roll)
    twist = rail_frame(turn, 0.5 * gauge + POINT, side, state, shift, position, rotation)
    return np.array([x, y, z]) + track @ [0.0, *position], track @ rotation, position, twist


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("rough", [False, True])
def test_a_rail_runs_along_the_line_it_draws(side: float, rough: bool) -> None:
    """x of R is the tangent, on every ramp, transition, vertical curve and irregularity."""
    track = random_irregularity("erri_high", 300.0, seed=3, start=-50.0) if rough else None
    table = None if track is None else track.table()
    steepest = 0.0
    for s in np.arange(2.0, 185.0, 1.37):
        before, after = (rail(s + d, side, table)[0] for d in (-STEP, STEP))
        tangent = (after - before) / np.linalg.norm(after - before)
        _, rotation, _, _ = rail(s, side, table)
        assert rotation[:, 0] == pytest.approx(tangent, abs=1e-7)
        assert rotation.T @ rotation == pytest.approx(np.eye(3), abs=1e-15)
        assert np.linalg.det(rotation) == pytest.approx(1.0)
        *_, heading, pitch, roll, _, _ = inclined_frame(SNAKE.table, s)
        own = np.empty((3, 3))
        inclined_rotation(heading, pitch, roll, own)
        steepest = max(steepest, np.abs(own.T @ tangent)[1:].max())
    assert steepest > 1e-3  # against the track's own direction


def test_the_turn_of_the_track_frame_is_the_derivative_of_its_rotation() -> None:
    for s in np.arange(1.0, 185.0, 2.3):
        matrices = []
        for place in (s - STEP, s, s + STEP):
            *_, heading, pitch, roll, _, gauge = inclined_frame(SNAKE.table, place)
            matrices.append((np.empty((3, 3)), gauge, pitch, roll))
            inclined_rotation(heading, pitch, roll, matrices[-1][0])
        (before, gauge_before, *_), (here, _, pitch, roll), (after, gauge_after, *_) = matrices
        spin = here.T @ (after - before) / (2 * STEP)
        turn = track_turn(SNAKE.table, s, pitch, roll)
        assert [turn.twist, turn.pitch, turn.yaw] == pytest.approx(
            [spin[2, 1], spin[0, 2], spin[1, 0]], abs=1e-8
        )
        assert turn.gauge == pytest.approx((gauge_after - gauge_before) / (2 * STEP), abs=1e-8)


def test_rails_move_as_the_signals_say() -> None:
    """Left is +y, up is +z, wide is apart, a positive cross-level lifts the right rail, as cant does."""
    values = np.tile([0.005, 0.002, 0.010, 0.004], (400, 1))
    table = Irregularity(-100.0, 0.5, values).table(fade=10.0)
    (_, left), (_, right) = (
        (rail(5.0, side)[2], rail(5.0, side, table)[2] - rail(5.0, side)[2]) for side in (1.0, -1.0)
    )
    assert 0.5 * (left + right) == pytest.approx([0.002, 0.005], abs=1e-9)
    assert left[0] - right[0] == pytest.approx(0.010, abs=1e-5)  # the rails roll about the track's middle
    assert right[1] - left[1] == pytest.approx(0.004, rel=0.02)  # at 0.76 m instead of 0.75 m
    assert rail(5.0, 1.0, table)[1][2, 1] == pytest.approx(-0.004 / 1.5, rel=1e-3)


def test_a_cross_level_is_a_cant() -> None:
    """The same height difference as irregularity and as cant: the same rail in space."""
    canted = Alignment((Curve(100.0, radius=20000.0, hand="left", cant=0.05, gauge=1.435),))
    level = Alignment((Curve(100.0, radius=20000.0, hand="left", cant=0.0, gauge=1.435),))
    values = np.zeros((800, 4))
    values[:, 3] = 0.05
    table = Irregularity(-100.0, 0.5, values).table(fade=10.0)
    for side in (1.0, -1.0):
        found = []
        for alignment, rough in ((canted, smooth_track()), (level, table)):
            x, y, z, heading, pitch, roll, _, gauge = inclined_frame(alignment.table, 40.0)
            own, position, rotation = np.empty((3, 3)), np.empty(2), np.empty((3, 3))
            inclined_rotation(heading, pitch, roll, own)
            turn = track_turn(alignment.table, 40.0, pitch, roll)
            state = irregularity_at(rough, 40.0)
            rail_frame(turn, 0.5 * gauge + POINT, side, state, UNDEFLECTED, position, rotation)
            found.append((np.array([x, y, z]) + own @ [0.0, *position], own @ rotation))
        assert found[0][0] == pytest.approx(found[1][0], abs=1e-9)
        assert found[0][1] == pytest.approx(found[1][1], abs=2e-6)  # curvature times cant


def test_deflection_displaces_and_turns() -> None:
    shift = RailShift(1e-3, -2e-3, 3e-4, -4e-4)
    _, own, place, _ = rail(5.0, 1.0)
    _, turned, moved, _ = rail(5.0, 1.0, shift=shift)
    assert moved - place == pytest.approx([1e-3, -2e-3], abs=1e-12)
    assert own.T @ turned[:, 0] == pytest.approx([1.0, 3e-4, -4e-4], abs=1e-6)
