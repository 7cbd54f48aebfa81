"""Nonlinear critical speed: from a limit cycle downwards, until hunting dies out; and where it begins.

Below it a vehicle comes to rest after every disturbance that is tried; it may lie far below the speed at
which its smallest motions begin to grow. Where a vehicle has several cycles, or a cycle and rest, at one
speed, it keeps the cycle that it comes with: so the train slows down gently from speed to speed, and the
cycle is that of the highest speed. The speed at which one disturbance of the resting vehicle begins hunting
lies above.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from hh_exudyn.multibody.linear.hunting import STEP, Derailed, LateralMotion, MotionState, lateral_motion
from hh_exudyn.multibody.linear.modes import LinearVehicle

DISPLACEMENT = 5e-3  # m, of all wheelsets where there is no cycle to begin with; the flange is 5 to 9 mm away
SETTLED = 0.5e-3  # m, amplitude of every wheelset below which hunting has died out
STRETCH = 4.0  # s of motion, whose second half is looked at; hunting has 1 to 6 Hz
LONGEST = 16.0  # s, after which a motion that still changes counts by whether it has fallen all the time
SLOWING = 1.0  # m/s^2, of the train from speed to speed
_STEADY = 0.05  # of the amplitude, by which it may differ from that of the stretch before

_Tried = Callable[[float, MotionState | None, int], tuple[bool, MotionState | None]]
Progress = Callable[[float, float, float], None]  # speed [m/s], time in that motion, its longest time [s]


@dataclass(frozen=True)
class HuntingRun:
    """What was left of a motion at one speed.

    Attributes
    ----------
    speed : [m/s]
    amplitude : of the wheelset that moves most, at the end [m]; infinite where a wheel left its rail
    frequency : of the first wheelset at the end [Hz]; NaN where there is none
    duration : of the motion [s]
    from_cycle : whether it went on from the cycle of a higher speed
    hunts : whether it did not die out: it is steady, or it did not fall in every stretch of the longest time
    """

    speed: float
    amplitude: float
    frequency: float
    duration: float
    from_cycle: bool
    hunts: bool


@dataclass(frozen=True)
class NonlinearCriticalSpeed:
    """All runs of a search in their order, and its result.

    Attributes
    ----------
    runs : tuple of HuntingRun
    hunting : the lowest speed at which hunting went on [m/s]; None where there was none at any speed
    settled : the speed below it at which hunting died out [m/s]; None where it did at none
    begins : the lowest speed, from `hunting` on, at which the disturbance of the resting vehicle was found to
        begin hunting [m/s]; None where it did at none
    """

    runs: tuple[HuntingRun, ...]
    hunting: float | None
    settled: float | None
    begins: float | None


def nonlinear_critical_speed(
    vehicle: LinearVehicle,
    low: float,
    high: float,
    step: float,
    resolution: float,
    *,
    report: Callable[[HuntingRun, int], None] | None = None,
    progress: Progress | None = None,
) -> NonlinearCriticalSpeed:
    """Look for hunting from `high` down to `low` in steps, and halve the step where it dies out.

    Parameters
    ----------
    vehicle : what runs, and on which straight track
    low, high, step, resolution : speeds [m/s]; the result is known to the resolution
    report : called with every run that is done and the number that may follow at most
    progress : called after every time step

    Raises
    ------
    ValueError
        Unless 0 < low < high, step > 0 and resolution > 0; or the time step is too large.
    NoEquilibrium
        There is no equilibrium at one of the speeds.
    KeyboardInterrupt
        Ctrl-C.
    """
    if not (0.0 < low < high and step > 0.0 and resolution > 0.0):
        raise ValueError(
            f"speeds from {low} to {high} m/s in steps of {step} m/s to {resolution} m/s: needed "
            "0 < low < high, step > 0, resolution > 0"
        )
    runs: list[HuntingRun] = []

    def tried(speed: float, cycle: MotionState | None, more: int) -> tuple[bool, MotionState | None]:
        run, end = _hunted(vehicle, speed, cycle, progress)
        runs.append(run)
        if report is not None:
            report(run, more)
        return run.hunts, end

    hunting, settled = _falling(tried, low, high, step, resolution)
    begins = None
    if hunting is not None:
        begins = _rising(tried, hunting, high, step, resolution)
    return NonlinearCriticalSpeed(tuple(runs), hunting, settled, begins)


def _falling(
    tried: _Tried, low: float, high: float, step: float, resolution: float
) -> tuple[float | None, float | None]:
    """The lowest speed that hunts, and the next one below, where it has died out."""
    halvings = _halvings(step, resolution)
    again = math.ceil((high - low) / step) + halvings  # of `_rising`, at most
    speed, cycle, hunting = high, None, None
    while True:
        hunts, end = tried(speed, cycle, math.ceil((speed - low) / step) + halvings + again)
        if hunts:
            hunting, cycle = speed, end
        elif hunting is not None:
            break
        if speed <= low:
            return hunting, None
        speed = max(speed - step, low)
    settled = speed
    while hunting - settled > resolution:
        middle = 0.5 * (hunting + settled)
        hunts, end = tried(middle, cycle, _halvings(hunting - settled, resolution) - 1 + again)
        if hunts:
            hunting, cycle = middle, end
        else:
            settled = middle
    return hunting, settled


def _rising(tried: _Tried, low: float, high: float, step: float, resolution: float) -> float | None:
    """The lowest speed from `low` on at which the disturbance of the resting vehicle begins hunting."""
    halvings = _halvings(step, resolution)
    rests, speed = low, low
    while not tried(speed, None, math.ceil((high - speed) / step) + halvings)[0]:
        if speed >= high:
            return None
        rests, speed = speed, min(speed + step, high)
    while speed - rests > resolution:
        middle = 0.5 * (rests + speed)
        if tried(middle, None, _halvings(speed - rests, resolution) - 1)[0]:
            speed = middle
        else:
            rests = middle
    return speed


def _halvings(width: float, resolution: float) -> int:
    """Of an interval, until it is as narrow as the resolution."""
    return max(0, math.ceil(math.log2(width / resolution) - 1e-9))


def _hunted(
    vehicle: LinearVehicle, speed: float, cycle: MotionState | None, progress: Progress | None
) -> tuple[HuntingRun, MotionState | None]:
    """Motion at a speed, until it has died out or is steady."""
    begun = cycle is not None
    displacement = 0.0 if begun else DISPLACEMENT
    ramp = abs(cycle.speed - speed) / SLOWING if cycle is not None else 0.0
    stretch, duration, state = STRETCH + ramp, 0.0, cycle
    amplitudes: list[float] = []
    while True:
        done = duration

        def step_done(time: float, done: float = done) -> None:
            if progress is not None:
                progress(speed, done + time, ramp + LONGEST)

        try:
            motion = lateral_motion(
                vehicle, speed, stretch, displacement, STEP, begun=state, slowing=SLOWING, progress=step_done
            )
        except Derailed:
            return HuntingRun(speed, math.inf, math.nan, duration, begun, hunts=True), None
        duration += stretch
        stretch, displacement, state = STRETCH, 0.0, motion.end
        late = motion.time[-1] - 0.5 * STRETCH
        amplitudes.append(motion.amplitude(late))
        falls = [b < (1.0 - _STEADY) * a for a, b in pairwise(amplitudes)]
        steady = len(amplitudes) > 1 and abs(amplitudes[-1] - amplitudes[-2]) <= _STEADY * amplitudes[-2]
        settled = amplitudes[-1] < SETTLED
        if settled or steady or duration >= ramp + LONGEST:
            hunts = not (settled or all(falls))
            return (
                HuntingRun(speed, amplitudes[-1], _frequency(motion, late), duration, begun, hunts),
                motion.end,
            )


def _frequency(motion: LateralMotion, after: float) -> float:
    try:
        return motion.frequency(after)
    except ValueError:
        return math.nan
