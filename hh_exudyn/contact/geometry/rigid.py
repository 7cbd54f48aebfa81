"""Rigid contact of wheels on rails: where a wheel touches that neither sinks in nor lifts off (kernels).

A wheel carried by its rail touches where the vertical gap is smallest. `lowest_gap` sweeps all nodes of the
wheel's table and refines every local minimum that could be the smallest one: nothing but a resolution of a
tenth of a millimetre is asked of the profiles. `rolled_wheelset` adds the roll at which both wheels touch.
"""

import math
from typing import NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, gap_at, silhouette
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.types import SplineTable
from hh_exudyn.kernel import allocating_kernel, kernel

# Columns of one wheel's rigid contact
Y_WHEEL = 0  # lateral position on the wheel profile, side coordinates [m]
Y_RAIL = 1  # on the rail profile [m]
RADIUS = 2  # rolling radius [m]
CONTACT_ANGLE = 3  # positive towards the flange [rad]
LIFT = 4  # height of the wheelset's centre over the rail top, less the wheel's nominal radius [m]
WHEEL_CURVATURE = 5  # lateral, convex positive [1/m]
RAIL_CURVATURE = 6
COLUMNS = 7

_NODE_TOLERANCE = 30e-6  # m: between two nodes the gap dips no deeper (0.1 mm apart, flange curvatures)
_BISECTIONS = 40
_FIRST_BRACKET = 0.5e-3  # rad
_MAX_BRACKET = 0.1  # rad
_ROLL_TOLERANCE = 1e-11  # rad, 0.01 nm at the wheels
_ROLL_ITERATIONS = 80


class StandingWheel(NamedTuple):
    """A wheel of a wheelset, and the rail that it stands on."""

    wheel: SplineTable
    rail: SplineTable
    side: float  # +1 left, -1 right
    distance: float  # half the distance of the running circles [m]
    radius: float  # of the wheel at the running circle [m]
    rail_y: float  # origin of the rail's profile, y of the track frame [m]


@kernel
def posed_pair(standing: StandingWheel, lateral: float, roll: float) -> WheelRailPair:
    """A wheel, its centre one nominal radius over the rail top, rolled about the wheelset's centre."""
    return WheelRailPair(
        standing.wheel,
        standing.rail,
        standing.side,
        standing.distance,
        standing.radius,
        lateral - standing.rail_y,
        standing.radius,
        0.0,
        math.cos(roll),
        math.sin(roll),
        ratio=0.0,  # the axle lies across the track
        root=1.0,
    )


@allocating_kernel
def lowest_gap(pair: WheelRailPair) -> tuple[float, float]:
    """Smallest vertical gap between a wheel and its rail, and where it lies on the wheel profile.

    Returns
    -------
    gap, y_wheel : float
        [m]; NaN where the wheel does not stand over the rail, or the gap falls to the end of a profile.
    """
    n = pair.wheel.z.size
    gaps = np.empty(n)
    smallest = math.inf
    for i in range(n):
        gaps[i], _, _, _, _ = gap_at(pair, pair.wheel.start + i * pair.wheel.step)
        if gaps[i] < smallest:
            smallest = gaps[i]
    best, best_y = math.inf, math.nan
    for i in range(n):
        if not gaps[i] < smallest + _NODE_TOLERANCE:
            continue
        if i == 0 or i == n - 1 or math.isnan(gaps[i - 1]) or math.isnan(gaps[i + 1]):
            if gaps[i] == smallest:
                return math.nan, math.nan
            continue
        if gaps[i] > gaps[i - 1] or gaps[i] > gaps[i + 1]:
            continue
        low = pair.wheel.start + (i - 1) * pair.wheel.step
        high = low + 2.0 * pair.wheel.step
        for _ in range(_BISECTIONS):
            middle = 0.5 * (low + high)
            if gap_at(pair, middle)[1] < 0.0:
                low = middle
            else:
                high = middle
        y = 0.5 * (low + high)
        gap = gap_at(pair, y)[0]
        if gap > gaps[i]:  # two minima between the nodes, the bisection found the higher one
            y, gap = pair.wheel.start + i * pair.wheel.step, gaps[i]
        if gap < best:
            best, best_y = gap, y
    if best == math.inf:
        return math.nan, math.nan
    return best, best_y


@kernel
def _gap_and_rate(pair: WheelRailPair) -> tuple[float, float]:
    """Smallest gap of a wheel and its derivative with the roll [m/rad].

    The contact point may move along the profiles while the wheel rolls, but the gap is stationary there: so
    only the motion of the material point counts.
    """
    gap, y_wheel = lowest_gap(pair)
    if math.isnan(gap):
        return math.nan, math.nan
    z, slope, _ = spline_evaluate(pair.wheel, y_wheel)
    _, py, pz, slope_wheel = silhouette(pair, y_wheel, z, slope)
    return gap, py - pair.side * slope_wheel * pz


@kernel
def rolled_wheelset(left: StandingWheel, right: StandingWheel, lateral: float, start: float) -> float:
    """Roll at which both wheels touch their rails [rad]; NaN where there is none.

    The difference of the centre heights that the two wheels ask for grows with the roll: bracketed around
    `start`, then Newton's method inside the bracket.
    """
    low = high = start
    difference, rate = 0.0, 1.0
    width = _FIRST_BRACKET
    bracketed_low = bracketed_high = False
    roll = start
    for _ in range(_ROLL_ITERATIONS):
        gap_left, rate_left = _gap_and_rate(posed_pair(left, lateral, roll))
        gap_right, rate_right = _gap_and_rate(posed_pair(right, lateral, roll))
        # both centres stand one radius over the rails: the difference of the radii belongs to the gap
        difference = (gap_left - left.radius) - (gap_right - right.radius)
        rate = rate_left - rate_right
        if math.isnan(difference) or abs(roll) > _MAX_BRACKET:
            return math.nan
        if difference < 0.0:
            low, bracketed_low = roll, True
        else:
            high, bracketed_high = roll, True
        new = roll - difference / rate
        if bracketed_low and bracketed_high:
            if not (new > low and new < high):
                new = 0.5 * (low + high)
        elif bracketed_low:
            new = min(new, low + width) if new > low else low + width
            width *= 2.0
        else:
            new = max(new, high - width) if new < high else high - width
            width *= 2.0
        if abs(new - roll) < _ROLL_TOLERANCE:
            return new
        roll = new
    return roll


@kernel
def wheel_contact(standing: StandingWheel, lateral: float, roll: float, row: FloatArray) -> None:
    """Fill a row of `COLUMNS` for one wheel; NaN where it has no contact."""
    pair = posed_pair(standing, lateral, roll)
    gap, y_wheel = lowest_gap(pair)
    z, slope, second = spline_evaluate(pair.wheel, y_wheel)
    _, _, y_rail, slope_rail, second_rail = gap_at(pair, y_wheel)
    row[Y_WHEEL] = y_wheel
    row[Y_RAIL] = y_rail
    row[RADIUS] = standing.radius - z
    row[CONTACT_ANGLE] = -math.atan(slope_rail)
    row[LIFT] = -gap
    row[WHEEL_CURVATURE] = second / (1.0 + slope * slope) ** 1.5
    row[RAIL_CURVATURE] = -second_rail / (1.0 + slope_rail * slope_rail) ** 1.5


@kernel
def wheel_contacts(standing: StandingWheel, lateral: FloatArray, roll: FloatArray, rows: FloatArray) -> None:
    """`wheel_contact` for every lateral displacement and its roll; fills `rows`, (n, COLUMNS)."""
    for i in range(lateral.size):
        wheel_contact(standing, lateral[i], roll[i], rows[i])


@kernel
def wheelset_rolls(left: StandingWheel, right: StandingWheel, lateral: FloatArray, rolls: FloatArray) -> None:
    """`rolled_wheelset` for every lateral displacement; fills `rolls`, NaN where there is none."""
    start = 0.0
    for i in range(lateral.size):
        rolls[i] = rolled_wheelset(left, right, lateral[i], start)
        start = 0.0 if math.isnan(rolls[i]) else rolls[i]
