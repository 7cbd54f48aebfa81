"""Nonlinear critical speed: from a limit cycle at decreasing speed until hunting decays; and its onset.

Below it the vehicle comes to rest from the limit cycle and after the disturbances tried; it may lie far below
the linear critical speed. Where several limit cycles, or a limit cycle and rest, coexist at one speed, the
motion follows the cycle of its initial state: so the train decelerates gently from speed to speed, beginning
with the cycle of the highest speed. The onset of hunting by one disturbance of the vehicle at rest lies
higher.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from hh_exudyn.multibody.linear.hunting import STEP, Derailed, LateralMotion, MotionState, lateral_motion
from hh_exudyn.multibody.linear.modes import LinearVehicle

DISPLACEMENT = 5e-3  # m, initial, of all wheelsets without a cycle; the flange clearance is 5 to 9 mm
SETTLED = 0.5e-3  # m, amplitude of every wheelset below which hunting has decayed
STRETCH = 4.0  # s of motion, with the second half evaluated; hunting has 1 to 6 Hz
LONGEST = 16.0  # s; a motion not steady by then has decayed if its amplitude fell in every stretch
SLOWING = 1.0  # m/s^2, of the train from speed to speed
_STEADY = 0.05  # relative difference of the amplitudes of two stretches of a steady motion

_Tried = Callable[[float, MotionState | None, int], tuple[bool, MotionState | None]]
Progress = Callable[[float, float, float], None]  # speed [m/s], time in that motion, its longest time [s]


@dataclass(frozen=True)
class HuntingRun:
    """Result of the motion at one speed.

    Attributes
    ----------
    speed : [m/s]
    amplitude : largest of all wheelsets at the end [m]; infinite where a wheel left its rail
    frequency : of the first wheelset at the end [Hz]; NaN without oscillation
    duration : of the motion [s]
    from_cycle : whether it began with the limit cycle of a higher speed
    hunts : whether it did not decay: it is steady, or its amplitude did not fall in every stretch
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
    hunting : lowest speed with hunting [m/s]; None for no hunting at any speed
    settled : next lower speed of the search, where hunting decayed [m/s]; None if it decayed at none
    begins : lowest speed found, from `hunting` on, at which the disturbance of the vehicle at rest leads to
        hunting [m/s]; None if at none
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
    """Search for hunting from `high` down to `low` in steps, halved where it decays.

    Parameters
    ----------
    vehicle : the vehicle on its straight track
    low, high, step, resolution : speeds [m/s]; the result has the resolution
    report : called with every finished run and the largest number of further runs
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
    """The lowest speed with hunting, and the next lower one, where it has decayed."""
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
    """Number of halvings of an interval down to the resolution."""
    return max(0, math.ceil(math.log2(width / resolution) - 1e-9))


def _hunted(
    vehicle: LinearVehicle, speed: float, cycle: MotionState | None, progress: Progress | None
) -> tuple[HuntingRun, MotionState | None]:
    """Motion at a speed, until it has decayed or is steady."""
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
