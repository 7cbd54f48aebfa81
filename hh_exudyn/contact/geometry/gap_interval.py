"""Bounds of the gap between two nodes of the wheel profile (kernels).

The gap's slope is S(y) - r'(u(y)): the slope of the silhouette less that of the rail, where the silhouette's
point y lies above the rail's point u. Its derivative is f w'' - u' r'', with the second derivatives w'' and
r'' of wheel and rail. With the axle's direction (lx, ly, lz), ratio = lx^2 / (1 - lx^2) and the roll angle
rho, tan(rho) = lz/ly, equation 1 of `silhouette` gives

    S = tan(theta - rho),   tan(theta) = w' sqrt(1 + ratio) / sqrt(1 - w'^2 ratio)                   (1)

so that f and u' are 1 for a wheelset that neither yaws nor rolls. For slopes up to 5 and angles up to 0.03
rad they differ from that by

    |f - 1| < 40 ratio + 11 |rho|,   |u' - 1| < 30 ratio + 6 |rho| + R ratio |w''|                   (2)

The tables know between which bounds w'' and r'' lie, hence there are bounds of the derivative. Where they
have one sign, the gap's slope is zero once or never.
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, gap_at
from hh_exudyn.kernel import inlined_kernel

_PER_RATIO, _PER_ROLL = 40.0, 11.0  # of equation 2
_TOLERANCE = 3e-10  # m, of a zero
_MAX_ITERATIONS = 60  # bisection alone needs 25 from 8 mm


@inlined_kernel
def _bounds(bounds: FloatArray, first: int, last: int) -> tuple[float, float]:
    """Least and largest second derivative of a spline table between two nodes, first < last."""
    level = (np.float64(last - first).view(np.int64) >> 52) - 1023  # exponent: 2^level <= last - first
    one, other = bounds[level, first], bounds[level, last - (1 << level)]
    return min(one[0], other[0]), max(one[1], other[1])


@inlined_kernel
def slope_rate_bounds(
    pair: WheelRailPair,
    first: int,
    last: int,
    rate_first: float,
    rate_last: float,
    y_rail_first: float,
    y_rail_last: float,
) -> tuple[float, float]:
    """Bounds of the derivative of the gap's slope between two nodes of the wheel.

    Parameters
    ----------
    pair : WheelRailPair
        Wheel, rail and pose.
    first, last : int
        The nodes, first < last.
    rate_first, rate_last : float
        w'' - r'' there [1/m].
    y_rail_first, y_rail_last : float
        Where they lie on the rail profile [m].

    Returns
    -------
    tuple of float
        Lower and upper bound [1/m].
    """
    wheel, rail = pair.wheel, pair.rail
    low = (min(y_rail_first, y_rail_last) - rail.start) * rail.per_step
    high = (max(y_rail_first, y_rail_last) - rail.start) * rail.per_step
    rail_last = min(int(high) + 1, rail.z.size - 1)
    wheel_least, wheel_most = _bounds(wheel.bounds, first, last)
    rail_least, rail_most = _bounds(rail.bounds, min(int(low), rail_last - 1), rail_last)
    wheel_size = max(abs(wheel_least), abs(wheel_most))
    share = (  # equation 2, of f and u' together
        _PER_RATIO * pair.ratio + _PER_ROLL * abs(pair.axle_z) + pair.nominal_radius * pair.ratio * wheel_size
    )
    if last - first > 1 or y_rail_first >= y_rail_last:
        least = wheel_least - rail_most - share * (abs(wheel_least) + abs(rail_most))
        most = wheel_most - rail_least + share * (abs(wheel_most) + abs(rail_least))
        return least, most
    # In a single interval w'' is linear and r'' linear between the rail's nodes: the extrema are there.
    least, most = min(rate_first, rate_last), max(rate_first, rate_last)
    per = (wheel.second[last] - wheel.second[first]) / (high - low)
    for k in range(int(low) + 1, rail_last):
        rate = wheel.second[first] + per * (k - low) - rail.second[k]
        least, most = min(least, rate), max(most, rate)
    doubt = share * (wheel_size + max(abs(rail_least), abs(rail_most)))
    return least - doubt, most + doubt


@inlined_kernel
def never_zero(slope: float, next_slope: float, width: float, least: float, most: float) -> bool:
    """Whether the gap's slope, of the same sign at both ends of an interval, has it in between too.

    `least` and `most` bound its rate: from either end it can reach zero only at a distance.
    """
    if least >= 0.0 or most <= 0.0:
        return True
    if slope < 0.0:
        slope, next_slope, least, most = -slope, -next_slope, -most, -least
    return -least * most * width < slope * most - next_slope * least


@inlined_kernel
def least_gap(
    gap: float, slope: float, next_gap: float, next_slope: float, width: float, least_rate: float
) -> float:
    """A lower bound of the gap in an interval from gap and slope at its ends: above both tangents.

    Less least_rate width^2 / 2 where the gap is not certain to be convex (least_rate < 0).
    """
    if slope >= 0.0:
        bound = gap if next_slope >= 0.0 else min(gap, next_gap)
    elif next_slope <= 0.0:
        bound = next_gap
    else:
        bound = gap + slope * (gap - next_gap + next_slope * width) / (next_slope - slope)
    return bound + 0.5 * width * width * min(least_rate, 0.0)


@inlined_kernel
def gap_slope_zero(
    pair: WheelRailPair,
    low: float,
    high: float,
    at_low: float,
    at_high: float,
    rate_low: float,
    rate_high: float,
) -> tuple[float, float, float, float, float]:
    """Where the gap's slope is zero between `low` and `high`, from slopes and their rates there.

    Newton's method, inside the bracket by bisection. It starts where the cubic through the ends, y as a
    function of the slope, is at zero: within a table's interval that is good to a micrometre.

    Returns
    -------
    y_wheel, gap, y_rail, rail_slope, rail_second : float
        The place and the results of `silhouette.gap_at` there.
    """
    rising = at_high >= 0.0
    change = at_high - at_low
    p = -at_low / change
    q = 1.0 - p
    y = low + p * (p * (3.0 - 2.0 * p) * (high - low) + q * change * (q / rate_low - p / rate_high))
    if not (y > low and y < high):
        y = low + p * (high - low)
    gap = y_rail = rail_slope = rail_second = math.nan
    for _ in range(_MAX_ITERATIONS):
        gap, difference, rate, y_rail, rail_slope, rail_second = gap_at(pair, y)
        if (difference >= 0.0) == rising:
            high = y
        else:
            low = y
        new = y - difference / rate
        if not (new > low and new < high):
            new = 0.5 * (low + high)
        if abs(new - y) < _TOLERANCE:
            break
        y = new
    return y, gap, y_rail, rail_slope, rail_second
