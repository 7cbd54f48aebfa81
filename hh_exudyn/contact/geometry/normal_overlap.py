"""Overlap of wheel and rail along their normal, over the wheel profile (kernels).

Where the silhouette lies below the rail, by the vertical gap g < 0, both overlap along their mean normal by

    D(y) = -g cos(gamma)                                                                                 (1)

with gamma the mean of the angles of silhouette and rail. Contact follows the maxima of D: on a flange the
vertical gap is three times as large and has its extremum millimetres away. With the slopes S of the
silhouette and r' of the rail, r'' the latter's derivative, u' and theta' of `silhouette.silhouette_rates`,

    D' / cos(gamma) = u' (r' - S) - g tan(gamma) (theta' + u' r'' / (1 + r'^2)) / 2                      (2)

which is called the rise of D here: it has the sign of D', and just its zeros.
"""

import math
from typing import NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, above_rail, silhouette, silhouette_rates
from hh_exudyn.contact.profiles.spline import spline_behind_node, spline_evaluate
from hh_exudyn.contact.types import Memory
from hh_exudyn.kernel import inlined_kernel, kernel, shaped

MOST_NODES = 2048  # of a scan: 100 mm at the least spacing of a table
BESIDE = 1.0  # m, gap at a node beside the rail
_TOLERANCE = 1e-10  # m, last step to a zero
_MAX_ITERATIONS = 60


class Overlap(NamedTuple):
    """Wheel and rail at one place of the wheel profile; NaN outside the profiles."""

    overlap: float  # along the normal, negative where a gap is open [m]
    rise: float  # of equation 2 [-]
    y_rail: float  # on the rail profile [m]
    cosine: float  # of the mean contact angle, positive towards the flange
    sine: float
    rail_slope: float
    rail_second: float  # [1/m]


@inlined_kernel
def nodes_above_rail(pair: WheelRailPair) -> tuple[int, int]:
    """First node of the wheel that the rail's table may reach, and the one behind the last."""
    low, high = above_rail(pair)
    wheel = pair.wheel
    first = max(0, math.ceil((low - wheel.start) * wheel.per_step))
    end = min(wheel.z.size, math.floor((high - wheel.start) * wheel.per_step) + 1)
    return first, min(end, first + MOST_NODES)


@inlined_kernel
def node_gaps(pair: WheelRailPair, first: int, end: int, gaps: Memory) -> None:
    """Vertical gap at nodes first .. end - 1 [m], `BESIDE` beside the rail; no branches, for vectors."""
    gap = shaped(gaps, (MOST_NODES,))
    wheel, last = pair.wheel, pair.rail.z.size - 2
    for k in range(end - first):
        i = np.uint64(first + k)
        _, py, pz, _ = silhouette(pair, wheel.start + i * wheel.step, wheel.z[i], wheel.slope[i])
        place = (-pair.side * (pair.centre_y + py) - pair.rail.start) * pair.rail.per_step
        inside = (place >= 0.0) & (place <= last + 1.0)
        node = np.uint64(min(max(0.0, place), last + 0.0))
        z_rail, _, _ = spline_behind_node(pair.rail, node, place - node)
        gap[k] = pair.centre_z + pz - z_rail if inside else BESIDE


@inlined_kernel
def node_rises(pair: WheelRailPair, first: int, gaps: FloatArray, rises: Memory) -> None:
    """Rise of the overlap at nodes from `first` on that have these gaps, all above the rail.

    No branches; slope and second derivative of the rail from its node on (a cubic's height, at which the
    gap was found, would be a pair of neighbours to the compiler, and no loop of vectors).
    """
    rise = shaped(rises, (MOST_NODES,))
    wheel, rail, last = pair.wheel, pair.rail, pair.rail.z.size - 2
    for k in range(gaps.size):
        i = np.uint64(first + k)
        slope = wheel.slope[i]
        _, py, _, slope_wheel = silhouette(pair, wheel.start + i * wheel.step, wheel.z[i], slope)
        place = (-pair.side * (pair.centre_y + py) - rail.start) * rail.per_step
        node = np.uint64(min(max(0.0, place), last + 0.0))
        part, second = place - node, rail.second[node]
        change = part * (rail.second[node + np.uint64(1)] - second)
        slope_rail = rail.slope[node] + part * rail.step * (second + 0.5 * change)
        lateral, turn = silhouette_rates(pair, wheel.z[i], slope, wheel.second[i])
        rise[k] = _rise(gaps[k], lateral, turn, slope_wheel, slope_rail, second + change)


@inlined_kernel
def mean_normal(slope_wheel: float, slope_rail: float) -> tuple[float, float]:
    """Cosine and sine of the mean contact angle of silhouette and rail, positive towards the flange."""
    tangent = -(slope_wheel + slope_rail) / _denominator(slope_wheel, slope_rail)
    cosine = 1.0 / math.sqrt(1.0 + tangent * tangent)
    return cosine, cosine * tangent


@inlined_kernel
def _denominator(slope_wheel: float, slope_rail: float) -> float:
    """Of the tangent of the mean of two angles: (S + r') over this."""
    return (
        1.0
        - slope_wheel * slope_rail
        + math.sqrt((1.0 + slope_wheel * slope_wheel) * (1.0 + slope_rail * slope_rail))
    )


@inlined_kernel
def _rise(
    gap: float, lateral: float, turn: float, slope_wheel: float, slope_rail: float, second_rail: float
) -> float:
    """Equation 2, in one division; `lateral` and `turn` from `silhouette_rates`."""
    square = 1.0 + slope_rail * slope_rail
    turns = 0.5 * (turn * square + lateral * second_rail)
    tilt = gap * (slope_wheel + slope_rail) / (square * _denominator(slope_wheel, slope_rail))
    return lateral * (slope_rail - slope_wheel) + tilt * turns


@inlined_kernel
def overlap_at(pair: WheelRailPair, y_wheel: float) -> Overlap:
    """Overlap of wheel and rail at a place of the wheel profile [m]."""
    z, slope, second = spline_evaluate(pair.wheel, y_wheel)
    _, py, pz, slope_wheel = silhouette(pair, y_wheel, z, slope)
    y_rail = -pair.side * (pair.centre_y + py)
    z_rail, slope_rail, second_rail = spline_evaluate(pair.rail, y_rail)
    gap = pair.centre_z + pz - z_rail
    lateral, turn = silhouette_rates(pair, z, slope, second)
    rise = _rise(gap, lateral, turn, slope_wheel, slope_rail, second_rail)
    cosine, sine = mean_normal(slope_wheel, slope_rail)
    return Overlap(-gap * cosine, rise, y_rail, cosine, sine, slope_rail, second_rail)


@kernel
def rise_zero(pair: WheelRailPair, low: float, high: float, at_low: float, at_high: float) -> float:
    """Where the rise of the overlap is zero between two places, of different sign there [m].

    The secant method in the bracket (Illinois); what is returned is the last place evaluated or better.
    """
    moved = 0  # which end of the bracket moved last: -1 the lower, 1 the upper
    before = math.inf
    y = low
    for _ in range(_MAX_ITERATIONS):
        y = low - at_low * (high - low) / (at_high - at_low)
        if not abs(y - before) > _TOLERANCE:
            break
        before = y
        rise = overlap_at(pair, y).rise
        if (rise > 0.0) == (at_low > 0.0):
            low, at_low = y, rise
            if moved == -1:
                at_high *= 0.5
            moved = -1
        else:
            high, at_high = y, rise
            if moved == 1:
                at_low *= 0.5
            moved = 1
    return y
