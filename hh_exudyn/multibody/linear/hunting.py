"""Hunting or decay after a disturbance: motion in time on straight smooth track at one speed."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import exudyn as exu
import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import Bundle
from hh_exudyn.multibody.exudyn_system import (
    ExudynSystem,
    explicit_settings,
    exudyn_system,
    whole_steps,
)
from hh_exudyn.multibody.interruption import Interruption
from hh_exudyn.multibody.linear.modes import LinearVehicle
from hh_exudyn.multibody.linear.stability import require_stable_step
from hh_exudyn.multibody.model import BODY_COORDINATES, SystemModel, first_creep, first_track
from hh_exudyn.multibody.system import evaluate_bundle
from hh_exudyn.multibody.watch import REASONS, Trouble, look_bundle, watch_state

STEP = 4e-4  # s, of the explicit integration


class MotionState(NamedTuple):
    """State at the end of a motion, from which another can continue."""

    speed: float  # [m/s]
    q: FloatArray
    v: FloatArray
    sliders: FloatArray


@dataclass(frozen=True)
class LateralMotion:
    """Lateral motion of the wheelsets after a disturbance.

    Every step of the integration is one sample.

    Attributes
    ----------
    time : (n,) array
        Of every step [s].
    lateral : (n, wheelsets) array
        Displacement to the left [m].
    end : MotionState
    """

    time: FloatArray
    lateral: FloatArray
    end: MotionState

    def amplitude(self, after: float) -> float:
        """Half the largest peak-to-peak displacement of any wheelset [m], from the time `after` [s]."""
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
        swings = np.abs(np.diff(y[turns]))  # from extreme to extreme: without an offset
        middles = 0.5 * (self.time[turns][1:] + self.time[turns][:-1])
        return float(np.polyfit(middles, np.log(swings), 1)[0])

    def frequency(self, after: float) -> float:
        """Frequency of the first wheelset's oscillation [Hz], by upward crossings of its mean after `after`
        [s].

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


class Derailed(RuntimeError):
    """A wheel has left its rail, or the motion is no longer finite."""


def lateral_motion(
    vehicle: LinearVehicle,
    speed: float,
    duration: float,
    displacement: float = 0.0,
    step: float = STEP,
    *,
    begun: MotionState | None = None,
    slowing: float = math.inf,
    progress: Callable[[float], None] | None = None,
) -> LateralMotion:
    """Integrate the full nonlinear motion with Exudyn, sliding of friction elements included.

    Parameters
    ----------
    vehicle : the vehicle on its straight track
    speed : [m/s]
    duration : [s]
    displacement : of every wheelset at the start, to the left [m]
    step : of the explicit integration [s]
    begun : end of another motion of this vehicle as initial state; None for the equilibrium
    slowing : deceleration of the train from the speed of `begun` to this one [m/s^2]; infinite for a jump
    progress : called after every step with the time [s]

    Raises
    ------
    ValueError
        The step is too large for the explicit integration, at the start or in the motion.
    NoEquilibrium, Derailed, KeyboardInterrupt
        No equilibrium at that speed; a derailment by the criteria of `simulate`; Ctrl-C.
    """
    first = speed if begun is None or math.isinf(slowing) else begun.speed
    model, work, state = vehicle.at(max(first, speed), step)
    require_stable_step(step, model, work, state)
    start = MotionState(speed, state.q.copy(), state.v, state.sliders.copy())
    if begun is not None:
        start = _at_speed(begun, first, model, state.q)
    sideways = BODY_COORDINATES * model.wheelsets + 1
    start.q[sideways] += displacement
    bundle, sliders = Bundle(model, work), start.sliders
    rows: list[FloatArray] = []
    end: list[FloatArray] = []
    troubles: list[tuple[int, int, int]] = []
    watched = Bundle(work, watch_state(model))
    accepted = False  # whether the next evaluation is of an accepted state: its sliders and checks are due

    def forces(mbs: Any, time: float, item: int, _: Any, __: Any) -> list[float]:
        nonlocal accepted
        now, rate = mbs.systemData.GetODE2Coordinates(), mbs.systemData.GetODE2Coordinates_t()
        status = evaluate_bundle(bundle, sliders, now, rate, time, False)
        if accepted:
            accepted = False
            sliders[:] = work.new_sliders
            found = look_bundle(watched, step)
            if status:  # the contact kernel's: 1 + number of the wheel
                found = (Trouble.NOT_FINITE, *divmod(status - 1, 2))
            troubles.extend([found] if found[0] else [])
        result: list[float] = work.generalized_force.tolist()
        return result

    def after_step(mbs: Any, time: float) -> bool:
        nonlocal accepted
        accepted = True
        now = mbs.systemData.GetODE2Coordinates()
        rows.append(np.array([time, *now[sideways]]))
        end[:] = now, mbs.systemData.GetODE2Coordinates_t()
        work.inputs.train_course[:] = _course(first, speed, slowing, time)
        if progress is not None:
            progress(time)
        return not (troubles or interruption.wanted)

    with Interruption() as interruption:
        settings = explicit_settings(0, whole_steps(duration, step), step)
        _solve(exudyn_system(model, vehicle.vehicle, start.q, start.v, forces, after_step, settings))
    if interruption.wanted:
        raise KeyboardInterrupt
    if troubles:
        raise _error(*troubles[0], speed, rows[-1][0])
    table = np.array(rows)
    return LateralMotion(table[:, 0], table[:, 1:], MotionState(speed, end[0], end[1], sliders.copy()))


def _solve(system: ExudynSystem) -> None:
    """Integrate without Exudyn's own messages, as `simulate` does."""
    exu.config.printToConsole = False
    try:
        system.mbs.Assemble()
        system.mbs.SolveDynamic(system.settings, showHints=False)
    finally:
        exu.config.printToConsole = True


def _error(trouble: int, wheelset: int, side: int, speed: float, time: float) -> Exception:
    """The error at the end of a motion: derailment, or too large a step."""
    kind, detail = REASONS[Trouble(trouble)]
    where = f"wheel {wheelset + 1}{'LR'[side]}, " if wheelset >= 0 else ""
    error = ValueError if trouble == Trouble.ALTERNATING else Derailed
    return error(f"{kind}: {detail} ({where}{speed * 3.6:.1f} km/h, t = {time:.3f} s)")


def _course(first: float, last: float, slowing: float, time: float) -> tuple[float, float]:
    """Distance run by a decelerating train minus its speed times the time [m], and its speed [m/s]."""
    if first == last:
        return 0.0, last
    change = math.copysign(slowing, last - first)
    ramp = (last - first) / change
    if time < ramp:
        return -0.5 * change * time**2, first + change * time
    return -0.5 * change * ramp**2, last


def _at_speed(begun: MotionState, speed: float, model: SystemModel, rest: FloatArray) -> MotionState:
    """A state at another speed, moved along the track to the position of the equilibrium `rest`."""
    q, v = begun.q.copy(), begun.v.copy()
    along = np.arange(0, first_track(model), BODY_COORDINATES)
    place = BODY_COORDINATES * int(model.train.bodies[0])
    q[along] += rest[place] - q[place]
    v[along] += speed - begun.speed
    rolling = [*(BODY_COORDINATES * model.wheelsets + 4), *range(first_creep(model), v.size)]
    v[rolling] *= speed / begun.speed
    return MotionState(speed, q, v, begun.sliders.copy())
