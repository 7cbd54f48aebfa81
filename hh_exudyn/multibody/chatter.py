"""Chatter of wheels: contact that jumps between places of the wheel, and vertical forces that shake (kernel).

A wheel that jumps between flange root and flange has forces of the model's making, not of the railway's. In
every accepted state the place of the most loaded patch is compared with that of the state before: more than
2 mm further is a change. Changes and the spread of Q are counted in windows of half a second that move on by
a tenth. On irregular track Q spreads by the track's own waves; a wheel that changes its contact more than ten
times a second is named in the status of the run.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.state import Patch
from hh_exudyn.kernel import kernel
from hh_exudyn.multibody.model import Workspace

WINDOW = 0.5  # s
MOST_CHANGES = 10.0  # per second, assumed: two points in turn on irregular track stay below
_PARTS = 5  # of a window
_JUMP = 2e-3  # m on the wheel profile from one state to the next
_CHANGES, _SUM, _SQUARES, _STATES = range(4)  # of a part


class ChatterState(NamedTuple):
    """Sums of every wheel over the parts of the window, and the worst window so far."""

    parts: FloatArray  # (wheelsets, 2, _PARTS, 4) changes, sum of Q and of its squares, number of states
    place: FloatArray  # (wheelsets, 2) y_wheel of the most loaded patch in the last state, NaN without [m]
    clock: FloatArray  # (3,) time in this part [s], its number, and parts so far
    changes: FloatArray  # (wheelsets, 2) most changes per second in a window [1/s]
    spread: FloatArray  # (wheelsets, 2) standard deviation of Q in that window [N]
    where: FloatArray  # (wheelsets, 2) arc length at its end [m]


def chatter_state(wheelsets: int) -> ChatterState:
    """Nothing counted yet.

    Parameters
    ----------
    wheelsets : number of wheelsets
    """
    shape = (wheelsets, 2)
    return ChatterState(
        parts=np.zeros((*shape, _PARTS, 4)),
        place=np.full(shape, math.nan),
        clock=np.zeros(3),
        changes=np.zeros(shape),
        spread=np.zeros(shape),
        where=np.zeros(shape),
    )


@kernel
def count_chatter(work: Workspace, state: ChatterState, step: float) -> None:
    """Add an accepted state (kernel).

    Parameters
    ----------
    work : evaluated in that state
    state : sums, updated
    step : since the last accepted state [s]
    """
    part = int(state.clock[1])
    for w in range(state.place.shape[0]):
        for side in range(2):
            patch, sums = work.patches[w, side, 0], state.parts[w, side, part]
            place = patch[Patch.Y_WHEEL] if patch[Patch.NORMAL_FORCE] > 0.0 else math.nan
            if abs(place - state.place[w, side]) > _JUMP:
                sums[_CHANGES] += 1.0
            state.place[w, side] = place
            load = -work.rail_force[w, side, 1]
            sums[_SUM] += load
            sums[_SQUARES] += load * load
            sums[_STATES] += 1.0
    state.clock[0] += step
    if state.clock[0] * _PARTS >= WINDOW:
        state.clock[0] = 0.0
        state.clock[1] = (part + 1) % _PARTS
        state.clock[2] += 1.0
        if state.clock[2] >= _PARTS:
            _look_at_window(work, state)
        state.parts[:, :, (part + 1) % _PARTS] = 0.0


@kernel
def _look_at_window(work: Workspace, state: ChatterState) -> None:
    """Compare the window that ends now with the worst one of every wheel."""
    for w in range(state.place.shape[0]):
        for side in range(2):
            changes, total, squares, states = 0.0, 0.0, 0.0, 0.0
            for part in range(_PARTS):
                sums = state.parts[w, side, part]
                changes, total = changes + sums[_CHANGES], total + sums[_SUM]
                squares, states = squares + sums[_SQUARES], states + sums[_STATES]
            if changes / WINDOW > state.changes[w, side]:
                mean = total / states
                state.changes[w, side] = changes / WINDOW
                state.spread[w, side] = math.sqrt(max(squares / states - mean * mean, 0.0))
                state.where[w, side] = work.arc_length[w]


def chattering_wheels(state: ChatterState) -> list[dict[str, Any]]:
    """Wheels with more than `MOST_CHANGES`, for the status of a run: worst window of each.

    Parameters
    ----------
    state : at the end of the run
    """
    return [
        {
            "wheel": f"{w + 1}{'LR'[side]}",
            "changes_per_s": round(float(state.changes[w, side]), 1),
            "spread_of_Q_kN": round(1e-3 * float(state.spread[w, side]), 2),
            "s_m": round(float(state.where[w, side]), 1),
        }
        for w, side in np.argwhere(state.changes > MOST_CHANGES)
    ]
