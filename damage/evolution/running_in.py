"""Running-in: how far and how deep a wheel wears before its contact pressure is below that of seizure.

An unworn flange root touches at more than 0.8 of the hardness and wears at the rate of seizure, by some 60 to
80 um in 0.15 km, until it fits its rail. This is a wear of its own: steps sized by their error follow it at
its own pace (`damage.evolution.tolerance`), and a rate is extrapolated only from its end on.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from damage.bounds import check_above_zero
from damage.evolution.history import WearHistory
from damage.wear.archard import DRY
from hh_exudyn.contact.profile import Profile


@dataclass(frozen=True)
class RunningIn:
    """The part of a wheel's life under seizure.

    Attributes
    ----------
    distance
        Rolled until the largest pressure stays below that of seizure [m]; 0 where it never was above.
    depth
        Largest depth worn until then, along the normal [m].
    finished
        Whether the pressure fell below it within the history.
    """

    distance: float
    depth: float
    finished: bool


def running_in(history: WearHistory, hardness: float, seizure_ratio: float = DRY.seizure_ratio) -> RunningIn:
    """Distance and depth of running-in, from the pressures of a history.

    Each step holds the pressure at its start, so running-in ends where the last step under seizure ends: its
    distance is known to the length of that step.

    Parameters
    ----------
    history
        Of steps with pressures.
    hardness
        Of the wheel [Pa], > 0.
    seizure_ratio
        Pressure of seizure over hardness [-], > 0; 0.8 in Jendel's map.

    Raises
    ------
    ValueError
        A number out of its range, or a history without a step or without pressures.
    """
    check_above_zero("hardness", hardness, "Pa", "running-in")
    check_above_zero("seizure_ratio", seizure_ratio, "-", "running-in")
    steps = history.steps[1:]
    pressures = [step.pressure for step in steps]
    if not steps or any(math.isnan(pressure) for pressure in pressures):
        raise ValueError("running-in needs steps with contact pressures: wear_of gives them with its depth")
    under = [index for index, pressure in enumerate(pressures) if pressure > seizure_ratio * hardness]
    if not under:
        return RunningIn(0.0, 0.0, True)
    end = steps[under[-1]]
    lost = history.steps[0].radius - end.radius
    depth = _deepest(history.steps[0].profile, end.profile, lost)
    return RunningIn(end.distance, depth, under[-1] + 1 < len(steps))


def _deepest(before: Profile, after: Profile, lost: float) -> float:
    """Largest distance of the worn points, at their place on the old wheel, from the old line [m]."""
    y = np.linspace(before.y[0], before.y[-1], 20 * before.y.size)
    line = cKDTree(np.column_stack([y, np.interp(y, before.y, before.z)]))
    return float(line.query(np.column_stack([after.y, after.z + lost]))[0].max())
