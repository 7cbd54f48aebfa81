"""Chatter: counted in windows, named in the status; none with coupled strips where Hertz's ellipses jump."""

import numpy as np
import pytest

from hh_exudyn.contact.state import Patch
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.chatter import (
    MOST_CHANGES,
    WINDOW,
    chatter_state,
    chattering_wheels,
    count_chatter,
)
from hh_exudyn.multibody.model import workspace
from vehicles.catalogue import vehicle

STEP = 1e-3


@pytest.fixture(scope="module")
def work(demo):
    return workspace(assemble(vehicle(demo.vehicle), demo))


def count(work, seconds: float, jumps_per_s: float, load: float = 150e3, shake: float = 0.0):
    state = chatter_state(4)
    for k in range(round(seconds / STEP)):
        work.patches[:, :, 0, Patch.NORMAL_FORCE] = load
        work.patches[:, :, 0, Patch.Y_WHEEL] = 0.030
        work.patches[1, 1, 0, Patch.Y_WHEEL] = 0.030 + 0.005 * (int(k * STEP * jumps_per_s) % 2)
        work.rail_force[:, :, 1] = -load - shake * (-1) ** k
        work.arc_length[:] = 10.0 * k * STEP
        count_chatter(work, state, STEP)
    return state


def test_a_jumping_wheel_is_named(work) -> None:
    state = count(work, 3.0, 100.0, shake=5e3)
    (wheel,) = chattering_wheels(state)
    assert wheel["wheel"] == "2R"
    assert wheel["changes_per_s"] == pytest.approx(100.0, rel=0.05)
    assert wheel["spread_of_Q_kN"] == pytest.approx(5.0, rel=0.01)
    assert 0.0 < wheel["s_m"] <= 30.0


def test_few_changes_are_no_chatter(work) -> None:
    state = count(work, 3.0, 0.5 * MOST_CHANGES)
    assert chattering_wheels(state) == []
    assert state.changes[1, 1] > 0.0
    assert not np.delete(state.changes.ravel(), 3).any()


def test_a_burst_counts_in_its_window(work) -> None:
    """Ten changes within a tenth of a second are twenty a second over the window."""
    state = chatter_state(4)
    work.patches[:, :, 0, Patch.NORMAL_FORCE] = 1e5
    for k in range(2000):
        jumps = 1000 <= k < 1100
        work.patches[0, 0, 0, Patch.Y_WHEEL] = 0.03 + (0.005 * ((k // 10) % 2) if jumps else 0.0)
        count_chatter(work, state, STEP)
    assert state.changes[0, 0] == pytest.approx(10.0 / WINDOW, abs=2.1 / WINDOW)
