"""Does a disturbed vehicle settle or hunt? Motion in time on straight smooth track at one speed."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import exudyn as exu
import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import Bundle
from hh_exudyn.multibody.assembly import explicit_settings, exudyn_system
from hh_exudyn.multibody.linear.modes import LinearVehicle
from hh_exudyn.multibody.linear.stability import require_stable_step
from hh_exudyn.multibody.model import BODY_COORDINATES
from hh_exudyn.multibody.system import evaluate_bundle


@dataclass(frozen=True)
class LateralMotion:
    """Lateral motion of the wheelsets after a disturbance.

    Attributes
    ----------
    time : (n,) array
        Of every step [s].
    lateral : (n, wheelsets) array
        Displacement to the left [m].
    """

    time: FloatArray
    lateral: FloatArray

    def amplitude(self, after: float) -> float:
        """Half the largest range of any wheelset's motion from the time `after` [s] on [m]."""
        late = self.lateral[self.time >= after]
        return float(0.5 * (late.max(axis=0) - late.min(axis=0)).max())

    def growth_rate(self, after: float) -> float:
        """Slope of the logarithm of the first wheelset's extremes over time [1/s], from the time `after` [s].

        Raises
        ------
        ValueError
            There are fewer than three extremes.
        """
        y = self.lateral[:, 0]
        turns = np.flatnonzero((np.diff(y)[:-1] * np.diff(y)[1:] < 0.0) & (self.time[1:-1] >= after)) + 1
        if turns.size < 3:
            raise ValueError(f"growth rate: {turns.size} extremes after {after:g} s, at least 3 needed")
        swings = np.abs(np.diff(y[turns]))  # from extreme to extreme: an offset does not count
        middles = 0.5 * (self.time[turns][1:] + self.time[turns][:-1])
        return float(np.polyfit(middles, np.log(swings), 1)[0])

    def frequency(self, after: float) -> float:
        """Of the first wheelset's swings from the time `after` [s], by upward crossings of the mean [Hz].

        Raises
        ------
        ValueError
            There are fewer than two crossings.
        """
        late = self.time >= after
        time, y = self.time[late], self.lateral[late, 0] - self.lateral[late, 0].mean()
        up = np.flatnonzero((y[:-1] < 0.0) & (y[1:] >= 0.0))
        if up.size < 2:
            raise ValueError(f"frequency: {up.size} crossings after {after:g} s, at least 2 needed")
        crossings = time[up] - y[up] * (time[up + 1] - time[up]) / (y[up + 1] - y[up])
        return float((up.size - 1) / (crossings[-1] - crossings[0]))


def lateral_motion(
    vehicle: LinearVehicle, speed: float, duration: float, displacement: float, step: float = 4e-4
) -> LateralMotion:
    """Integrate the full nonlinear motion with Exudyn from the equilibrium, all wheelsets moved sideways.

    Parameters
    ----------
    vehicle : the vehicle on its straight track
    speed : [m/s]
    duration : [s]
    displacement : of every wheelset at the start, to the left [m]
    step : of the explicit integration [s]

    Raises
    ------
    ValueError
        The step is too large for the explicit integration.
    NoEquilibrium
        There is no equilibrium at that speed.
    RuntimeError
        The motion is not finite any more: a derailment.
    """
    model, work, state = vehicle.at(speed, step)
    require_stable_step(step, model, work, state)
    bundle = Bundle(model, work)
    sliders = state.sliders.copy()
    sideways = BODY_COORDINATES * model.wheelsets + 1
    q = state.q.copy()
    q[sideways] += displacement
    rows: list[FloatArray] = []
    failed: list[int] = []
    accepted = False  # a state; its sliders and status come with the first evaluation of the next step

    def forces(mbs: Any, time: float, item: int, _: Any, __: Any) -> list[float]:
        nonlocal accepted
        now, rate = mbs.systemData.GetODE2Coordinates(), mbs.systemData.GetODE2Coordinates_t()
        status = evaluate_bundle(bundle, sliders, now, rate, time, False)
        if accepted:
            accepted = False
            sliders[:] = work.new_sliders
            failed.extend([status] if status else [])
        result: list[float] = work.generalized_force.tolist()
        return result

    def after_step(mbs: Any, time: float) -> bool:
        nonlocal accepted
        accepted = True
        rows.append(np.array([time, *mbs.systemData.GetODE2Coordinates()[sideways]]))
        return not failed and bool(np.isfinite(rows[-1]).all())

    mbs = exudyn_system(model, q, state.v, forces, after_step)
    exu.config.printToConsole = False  # as in `simulate`
    try:
        mbs.SolveDynamic(explicit_settings(duration, step), showHints=False)
    finally:
        exu.config.printToConsole = True
    if failed:
        wheelset, side = divmod(failed[0] - 1, 2)
        raise RuntimeError(f"wheel {wheelset + 1}{'LR'[side]} left its rail at t = {rows[-1][0]:.3f} s")
    table = np.array(rows)
    return LateralMotion(table[:, 0], table[:, 1:])


def nonlinear_critical_speed(
    vehicle: LinearVehicle,
    speeds: Sequence[float],
    displacement: float = 5e-3,
    duration: float = 5.0,
    settled: float = 0.5e-3,
    step: float = 4e-4,
) -> list[tuple[float, float]]:
    """Amplitude of hunting that is left of a large disturbance, speed by speed downwards until it settles.

    The lowest speed at which a limit cycle is left is the nonlinear critical speed, to the distance of the
    speeds. Below it every disturbance of that kind dies away; it may lie far below the linear one. Each
    speed is a run of its own, begun with all wheelsets moved sideways: an unstable cycle that lies outside
    of that disturbance is not seen.

    Parameters
    ----------
    vehicle : the vehicle on its straight track
    speeds : [m/s], falling
    displacement : of the wheelsets at the start of each run [m]
    duration : of each run [s]; the last fifth is looked at
    settled : amplitude below which the vehicle has settled [m]
    step : of the explicit integration [s]

    Returns
    -------
    (speed [m/s], amplitude [m]) of every run; the last has settled unless `speeds` ended before.

    Raises
    ------
    ValueError, NoEquilibrium, RuntimeError
        As `lateral_motion`; ValueError also for speeds that do not fall.
    """
    if any(later >= earlier for earlier, later in pairwise(speeds)):
        raise ValueError(f"speeds {list(speeds)} m/s must fall")
    found: list[tuple[float, float]] = []
    for speed in speeds:
        left = lateral_motion(vehicle, speed, duration, displacement, step).amplitude(0.8 * duration)
        found.append((speed, left))
        if left < settled:
            break
    return found
