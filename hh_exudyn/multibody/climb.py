"""Wheel climb: how far every wheel rises from its rail, and how far it runs on its flange alone (kernel).

A flange that climbs and slides back is no derailment, but no run to draw wear or forces from unseen. The lift
is the height of the axle above the rail, over its height at the start; a wheel in a flange contact of two
points lifts by fractions of a millimetre. A wheel on its flange alone has no loaded patch below
`FLANGE_ANGLE`.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.state import Patch
from hh_exudyn.kernel import kernel
from hh_exudyn.multibody.model import Workspace

LARGEST_LIFT = 5e-3  # m, above it a wheel is reported
LONGEST_FLANGE = 2.0  # m on the flange alone, above it a wheel is reported
FLANGE_ANGLE = math.radians(50.0)  # contact angle; assumed: flanges stand at 60 to 75 degrees, roots below


class ClimbState(NamedTuple):
    """Lift and flange contact of every wheel, arrays (wheelsets, 2)."""

    rest: FloatArray  # height of the axle above the rail in the first state, NaN before [m]
    lift: FloatArray  # largest so far [m]
    lift_at: FloatArray  # arc length of it [m]
    flange: FloatArray  # distance on the flange alone up to now, 0 off it [m]
    longest: FloatArray  # longest such distance so far [m]
    longest_at: FloatArray  # arc length of its end [m]


def climb_state(wheelsets: int) -> ClimbState:
    """Nothing seen yet.

    Parameters
    ----------
    wheelsets : number of wheelsets
    """
    shape = (wheelsets, 2)
    return ClimbState(np.full(shape, math.nan), *np.zeros((5, *shape)))


@kernel
def see_climb(work: Workspace, state: ClimbState, step: float) -> None:
    """Add an accepted state (kernel).

    Parameters
    ----------
    work : evaluated in that state
    state : updated
    step : since the last accepted state [s]
    """
    for w in range(state.rest.shape[0]):
        axle = work.frame_axle[w]
        slope = axle[2] / axle[1] if axle[1] != 0.0 else 0.0
        for side in range(2):
            rail = work.rail_position[w, side]
            across = rail[0] - work.frame_position[w, 1]
            height = work.frame_position[w, 2] + slope * across - rail[1]
            if math.isnan(state.rest[w, side]):
                state.rest[w, side] = height
            lift = height - state.rest[w, side]
            if lift > state.lift[w, side]:
                state.lift[w, side], state.lift_at[w, side] = lift, work.arc_length[w]
            if _on_flange_alone(work, w, side):
                state.flange[w, side] += work.frame_velocity[w, 0] * step
            else:
                state.flange[w, side] = 0.0
            if state.flange[w, side] > state.longest[w, side]:
                state.longest[w, side] = state.flange[w, side]
                state.longest_at[w, side] = work.arc_length[w]


@kernel
def _on_flange_alone(work: Workspace, wheelset: int, side: int) -> bool:
    """Whether a wheel carries load, all of it on its flange."""
    loaded = False
    for number in range(work.patches.shape[2]):
        patch = work.patches[wheelset, side, number]
        if patch[Patch.NORMAL_FORCE] > 0.0:
            if patch[Patch.CONTACT_ANGLE] < FLANGE_ANGLE:
                return False
            loaded = True
    return loaded


def climbing_wheels(state: ClimbState) -> list[dict[str, Any]]:
    """Wheels beyond `LARGEST_LIFT` or `LONGEST_FLANGE`, for the status of a run.

    Parameters
    ----------
    state : at the end of the run
    """
    beyond = (state.lift > LARGEST_LIFT) | (state.longest > LONGEST_FLANGE)
    return [
        {
            "wheel": f"{w + 1}{'LR'[side]}",
            "lift_mm": round(1e3 * float(state.lift[w, side]), 2),
            "lift_s_m": round(float(state.lift_at[w, side]), 1),
            "flange_alone_m": round(float(state.longest[w, side]), 1),
            "flange_alone_to_s_m": round(float(state.longest_at[w, side]), 1),
        }
        for w, side in np.argwhere(beyond)
    ]
