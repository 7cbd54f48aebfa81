"""Reasons to stop a run, checked in every accepted state: derailment, divergence, a step too large.

Wheels are judged against their rails: a track that lies beside its design line is no derailment.
"""

import math
from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.state import Patch
from hh_exudyn.contact.types import SplineTable
from hh_exudyn.contact.wheels import wheel_of
from hh_exudyn.kernel import Bundle, allocating_kernel, kernel
from hh_exudyn.multibody.chatter import ChatterState, chatter_state, chattering_wheels, count_chatter
from hh_exudyn.multibody.climb import ClimbState, climb_state, climbing_wheels, see_climb
from hh_exudyn.multibody.model import SystemModel, Workspace

LIFT_OFF_TIME = 0.1  # s without contact of a wheel that counts as a derailment
FLANGE_TIP_MARGIN = 3e-3  # m above the flange tip: a contact so deep means that the flange climbs the rail
FLANGE_FROM = 0.02  # m towards the track centre on the wheel profile; the flange lies beyond
LARGEST_LATERAL = 0.08  # m of a wheelset from the middle of both rails: the wheel is off the rail
LARGEST_SPEED = 10.0  # m/s of a wheelset, lateral or vertical: more than in any derailment, so divergence
SMALLEST_ALTERNATION = 1e-3  # of the vertical force; smaller alternations of the lateral force are ignored
ALTERNATIONS = 40  # sign changes in a row of the lateral force's increment: the integration is unstable


class Trouble(IntEnum):
    """Result of `look`."""

    NONE = 0
    NOT_FINITE = 1
    LIFT_OFF = 2
    CLIMB = 3
    OFF_TRACK = 4
    ALTERNATING = 5
    RUNAWAY = 6


REASONS = {
    Trouble.NOT_FINITE: ("divergence", "the state is no longer finite, or the contact has no solution"),
    Trouble.RUNAWAY: (
        "divergence",
        f"the wheelset moves across at more than {LARGEST_SPEED:g} m/s; a smaller step_ms is needed",
    ),
    Trouble.LIFT_OFF: ("derailment", f"no contact for {LIFT_OFF_TIME} s"),
    Trouble.CLIMB: ("derailment", "the flange climbs over the rail"),
    Trouble.OFF_TRACK: ("derailment", "the wheelset has left the track"),
    Trouble.ALTERNATING: (
        "divergence",
        "the creep forces alternate from step to step; a smaller step_ms is needed",
    ),
}


class WatchState(NamedTuple):
    """History of every wheel, arrays (wheelsets, 2)."""

    airborne: FloatArray  # time without contact [s]
    lateral_force: FloatArray  # on the rail, of the last step [N]
    change: FloatArray  # its last change [N]
    alternations: FloatArray  # changes of opposite sign in a row
    floored: FloatArray  # number of patches so far with lateral curvature at its floor
    chatter: ChatterState
    climb: ClimbState
    states: FloatArray  # (1,) number of accepted states
    flange_limit: FloatArray  # (wheelsets, 2) y beyond which a contact is on the flange tip [m]


def watch_state(model: SystemModel) -> WatchState:
    """Histories at the start of a run of a model.

    Parameters
    ----------
    model : number of wheelsets and wheel profiles are read
    """
    shape = (len(model.wheelsets), 2)
    return WatchState(
        airborne=np.zeros(shape),
        lateral_force=np.zeros(shape),
        change=np.zeros(shape),
        alternations=np.zeros(shape),
        floored=np.zeros(shape),
        chatter=chatter_state(len(model.wheelsets)),
        climb=climb_state(len(model.wheelsets)),
        states=np.zeros(1),
        flange_limit=np.array(
            [[_flange_limit(wheel_of(model.wheel_rail, i, s)) for s in range(2)] for i in range(shape[0])]
        ),
    )


def _flange_limit(table: SplineTable) -> float:
    y = table.start + table.step * np.arange(table.z.size)
    flange = y > FLANGE_FROM
    deep = flange & (table.z < table.z[flange].min() + FLANGE_TIP_MARGIN)
    return float(y[deep][0])


@kernel
def look(work: Workspace, state: WatchState, step: float) -> tuple[Trouble, int, int]:
    """Check an accepted state for derailment and divergence.

    Parameters
    ----------
    work : evaluated in that state
    state : histories, updated
    step : since the last accepted state [s]

    Returns
    -------
    (`Trouble`, wheelset, side 0 or 1); -1 for wheelset and side without a wheel.
    """
    for k in range(work.generalized_force.size):
        if not math.isfinite(work.generalized_force[k]):
            return Trouble.NOT_FINITE, -1, -1
    for w in range(state.airborne.shape[0]):
        if max(abs(work.frame_velocity[w, 1]), abs(work.frame_velocity[w, 2])) > LARGEST_SPEED:
            return Trouble.RUNAWAY, w, 0
        middle = 0.5 * (work.rail_position[w, 0, 0] + work.rail_position[w, 1, 0])
        lateral = work.frame_position[w, 1] - middle
        if abs(lateral) > LARGEST_LATERAL:
            return Trouble.OFF_TRACK, w, 0 if lateral > 0.0 else 1
        for side in range(2):
            if work.patches[w, side, 0, Patch.NORMAL_FORCE] > 0.0:
                state.airborne[w, side] = 0.0
            else:
                state.airborne[w, side] += step
                if state.airborne[w, side] > LIFT_OFF_TIME:
                    return Trouble.LIFT_OFF, w, side
            for patch in range(work.patches.shape[2]):
                state.floored[w, side] += work.patches[w, side, patch, Patch.FLOORED]
                if work.patches[w, side, patch, Patch.NORMAL_FORCE] > 0.0 and (
                    work.patches[w, side, patch, Patch.Y_WHEEL] > state.flange_limit[w, side]
                ):
                    return Trouble.CLIMB, w, side
            change = work.rail_force[w, side, 0] - state.lateral_force[w, side]
            smallest = SMALLEST_ALTERNATION * abs(work.rail_force[w, side, 1])
            if change * state.change[w, side] < 0.0 and abs(change) > smallest:
                state.alternations[w, side] += 1.0
                if state.alternations[w, side] > ALTERNATIONS:
                    return Trouble.ALTERNATING, w, side
            else:
                state.alternations[w, side] = 0.0
            state.lateral_force[w, side] += change
            state.change[w, side] = change
    count_chatter(work, state.chatter, step)
    see_climb(work, state.climb, step)
    state.states[0] += 1.0
    return Trouble.NONE, -1, -1


@allocating_kernel
def look_bundle(bundle: Bundle, step: float) -> tuple[Trouble, int, int]:
    """`look` for a bundle of work space (as its model) and watch.

    Parameters
    ----------
    bundle : the work space in place of the model, and the watch in place of the work space
    step : as for `look`
    """
    return look(bundle.model, bundle.work, step)


def watched(state: WatchState) -> dict[str, Any]:
    """What the watch has seen, for the status of a run: doubtful wheels, and all wheels in `watch`.

    Parameters
    ----------
    state : at the end of the run
    """
    climb, chatter, states = state.climb, state.chatter, max(float(state.states[0]), 1.0)
    return {
        "floored_curvatures": int(state.floored.sum()),
        "chatter": chattering_wheels(chatter),
        "wheel_climb": climbing_wheels(climb),
        "watch": [
            {
                "wheel": f"{w + 1}{'LR'[side]}",
                "lift_mm": round(1e3 * float(climb.lift[w, side]), 3),
                "flange_alone_m": round(float(climb.longest[w, side]), 2),
                "changes_per_s": round(float(chatter.changes[w, side]), 1),
                "floored_share": round(float(state.floored[w, side]) / states, 4),
            }
            for w, side in np.ndindex(state.floored.shape)
        ],
    }
