"""Force laws of hydraulic dampers: a table of force over speed, alone or in series with a spring.

Kernels of plain numbers; no bodies, no Exudyn. A series damper has one state, its force F, with

    F' = k (v - v_d),   F = table(v_d)                                                                    (1)

for the relative speed v, of which the damper takes v_d and the spring the rest. On a stretch of the table
F = c (v_d - w), and for v linear over a step of length h, with the mean m, the value v1 at its end,
v0 = 2 m - v1 at its beginning and the slope s = 2 (v1 - m)/h,

    F(h) = c (v1 - w) - c T s + (F(0) - c (v0 - w) + c T s) exp(-h/T),   T = c/k                           (2)

which is exact, for any ratio of h and T: a spring that is stiff against the step does not dictate it.
"""

import math

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.kernel import kernel
from vehicles.force_laws import tabulated_stop


@kernel
def damper_force(speed: float, table: NDArray[np.float64], points: int) -> float:
    """Force [N] of a damper at a speed [m/s], odd in the speed.

    Parameters
    ----------
    speed : [m/s]
    table : (2 points or more,) speed, force, speed, force, ... from 0, 0 on
    points : number of points, 2 or more
    """
    force = tabulated_stop(abs(speed), table, points)
    return force if speed >= 0.0 else -force


@kernel
def series_damper_force(
    before: float,
    moved: float,
    elapsed: float,
    speed: float,
    stiffness: float,
    table: NDArray[np.float64],
    points: int,
) -> tuple[float, float]:
    """Force [N] of a damper in series with a spring, and the damper's share of the speed [m/s].

    Parameters
    ----------
    before : force at the beginning of the step [N]
    moved : change of the relative displacement since [m]
    elapsed : time since [s]; below zero nothing is known of the past, and the spring counts as rigid
    speed : relative speed now [m/s]
    stiffness : of the spring [N/m]
    table, points : as of `damper_force`

    The step is taken on the stretch of the table in which it ends.
    """
    if elapsed < 0.0:
        return damper_force(speed, table, points), speed
    if elapsed == 0.0:
        return before, speed
    mean = moved / elapsed
    slope = table[3] / table[2]
    force = _marched(before, mean, elapsed, speed, stiffness, slope, 0.0)
    if abs(force) <= table[3] or points == 2:
        return force, force / slope
    sign = 1.0 if force > 0.0 else -1.0
    for k in range(1, points - 1):
        low, high = table[2 * k + 1], table[2 * k + 3]
        slope = (high - low) / (table[2 * k + 2] - table[2 * k])
        if slope > 0.0:
            offset = table[2 * k] - low / slope
            force = _marched(sign * before, sign * mean, elapsed, sign * speed, stiffness, slope, offset)
            if force <= high or k == points - 2:
                force = max(force, low)
                return sign * force, sign * (offset + force / slope)
        elif k == points - 2:
            return sign * low, speed
    return math.nan, math.nan


@kernel
def _marched(
    before: float, mean: float, elapsed: float, speed: float, stiffness: float, slope: float, offset: float
) -> float:
    """Equation 2."""
    lag = slope / stiffness
    rise = 2.0 * (speed - mean) / elapsed
    start = 2.0 * mean - speed
    steady_lag = slope * lag * rise
    left = math.exp(-elapsed / lag)
    return slope * (speed - offset) - steady_lag + (before - slope * (start - offset) + steady_lag) * left
