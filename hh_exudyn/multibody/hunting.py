"""Does a disturbed vehicle settle or hunt? Motion in time on straight smooth track at one speed."""

from dataclasses import dataclass
from typing import Any

import exudyn as exu
import numpy as np

from hh_exudyn.contact.types import FloatArray
from hh_exudyn.kernel import Bundle
from hh_exudyn.multibody.assembly import explicit_settings, exudyn_system
from hh_exudyn.multibody.linear import LinearVehicle
from hh_exudyn.multibody.model import BODY_COORDINATES
from hh_exudyn.multibody.stability import require_stable_step
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
        """Of the first wheelset's swings from the time `after` [s], by its upward crossings of their mean [Hz].

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
    vehicle : what runs, and on which straight track
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
    model, work, state = vehicle.at(speed)
    require_stable_step(step, model, work, state)
    bundle = Bundle(model, work)
    sliders = state.sliders.copy()
    sideways = BODY_COORDINATES * model.wheelsets + 1
    q = state.q.copy()
    q[sideways] += displacement
    rows: list[FloatArray] = []
    failed: list[int] = []

    def forces(mbs: Any, time: float, item: int, _: Any, __: Any) -> list[float]:
        now, rate = mbs.systemData.GetODE2Coordinates(), mbs.systemData.GetODE2Coordinates_t()
        evaluate_bundle(bundle, sliders, now, rate, time, False)
        result: list[float] = work.generalized_force.tolist()
        return result

    def after_step(mbs: Any, time: float) -> bool:
        now, rate = mbs.systemData.GetODE2Coordinates(), mbs.systemData.GetODE2Coordinates_t()
        status = evaluate_bundle(bundle, sliders, now, rate, time, False)
        sliders[:] = work.new_sliders
        rows.append(np.array([time, *now[sideways]]))
        failed.extend([status] if status else [])
        return not failed

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
