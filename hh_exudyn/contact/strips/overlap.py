"""Overlap of a wheel's strips with the rail, along the normal (kernel).

The undeformed surfaces of wheel and rail overlap, where the silhouette lies below the rail, by the vertical
gap g < 0; along the mean normal of both that is

    d = -g cos(gamma)                                                                                    (1)

with gamma the mean of the angles of wheel and rail. On a flange the vertical gap is three times the overlap
and has its largest value elsewhere: contact follows d.
"""

import math
from typing import Any

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, silhouette
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Memory, SplineTable, WheelStrips
from hh_exudyn.kernel import inlined_kernel, memory, shaped

_DEEPEST = 0.05  # m, radius of a flange tip less that of the running circle, at most
_MORE = 1e-3  # m, for the cosine of roll and yaw
_FAR = 1.0  # m, gap of a strip beside the rail


@inlined_kernel
def overlapping_strips(pair: WheelRailPair, strips: WheelStrips, state: Memory) -> int:
    """Find the strips whose undeformed surface lies inside the rail, and their geometry.

    Parameters
    ----------
    pair : WheelRailPair
        Profiles and pose.
    strips : WheelStrips
        Of the wheel.
    state : memory
        (ROWS, CAPACITY) out: rows `NUMBER` to `CURVATURE` of the strips found.

    Returns
    -------
    int
        Their number.
    """
    gaps = memory(CAPACITY)
    first, last = _above_rail(pair, strips)
    _vertical_gaps(pair, strips, first, last, gaps)
    gap = shaped(gaps, (CAPACITY,))
    s = shaped(state, (ROWS, CAPACITY))
    count = 0
    for i in range(first, last):
        if gap[i] < 0.0:
            s[Row.NUMBER, count] = i
            s[Row.OVERLAP, count] = -gap[i]
            count += 1
    _geometry(pair, strips, count, state)
    return count


@inlined_kernel
def _above_rail(pair: WheelRailPair, strips: WheelStrips) -> tuple[int, int]:
    """First strip that may lie above the rail's table, and the one behind the last."""
    middle = -pair.side * pair.centre_y - pair.distance * pair.axle_y
    middle -= pair.side * pair.nominal_radius * pair.root * pair.axle_z  # about y of the running circle
    # of the slopes up to 5, and of the radius, which this estimate has left out
    margin = 5.0 * pair.nominal_radius * pair.ratio + _DEEPEST * abs(pair.axle_z) + _MORE
    low = pair.rail.start - middle - margin
    high = pair.rail.start + pair.rail.step * (pair.rail.z.size - 1) - middle + margin
    return _count_below(strips.y, low), _count_below(strips.y, high)


@inlined_kernel
def _count_below(places: FloatArray, y: float) -> int:
    """How many of the places, which increase, are less than y."""
    low, high = 0, places.size
    while low < high:
        between = (low + high) // 2
        if places[between] < y:
            low = between + 1
        else:
            high = between
    return low


@inlined_kernel
def _geometry(pair: WheelRailPair, strips: WheelStrips, count: int, state: Memory) -> None:
    """Fill the rows of the strips found; no branches, for vector instructions."""
    s = shaped(state, (ROWS, CAPACITY))
    last = pair.rail.z.size - 2
    for j in range(count):
        i = np.uint64(s[Row.NUMBER, j])
        px, py, pz, slope_wheel = silhouette(pair, strips.y[i], strips.z[i], strips.slope[i])
        y_rail = -pair.side * (pair.centre_y + py)
        place = (y_rail - pair.rail.start) * pair.rail.per_step
        node = np.uint64(min(max(place, 0.0), last + 0.0))
        _, slope_rail = _spline_at(pair.rail, node, place - node)
        of_wheel = 1.0 / math.sqrt(1.0 + slope_wheel * slope_wheel)
        of_rail = 1.0 / math.sqrt(1.0 + slope_rail * slope_rail)
        cosine, sine = of_wheel + of_rail, -(slope_wheel * of_wheel + slope_rail * of_rail)
        inverse = 1.0 / math.sqrt(cosine * cosine + sine * sine)
        cosine, sine = cosine * inverse, sine * inverse
        radius = pair.nominal_radius - strips.z[i]
        s[Row.OVERLAP, j] *= cosine
        s[Row.COSINE, j], s[Row.SINE, j] = cosine, sine
        s[Row.X, j], s[Row.Y, j], s[Row.Z, j] = px, py, pz
        s[Row.Y_RAIL, j] = y_rail
        s[Row.ARC, j], s[Row.WIDTH, j] = strips.arc[i], strips.width[i]
        s[Row.RADIUS, j] = radius
        s[Row.CURVATURE, j] = 0.5 * cosine / radius


@inlined_kernel
def _vertical_gaps(pair: WheelRailPair, strips: WheelStrips, first: int, end: int, gaps: Memory) -> None:
    """Vertical gap of the strips first .. end - 1 [m]; no branches, for vector instructions."""
    gap = shaped(gaps, (CAPACITY,))
    last = pair.rail.z.size - 2
    for i in range(first, end):
        _, py, pz, _ = silhouette(pair, strips.y[i], strips.z[i], strips.slope[i])
        place = (-pair.side * (pair.centre_y + py) - pair.rail.start) * pair.rail.per_step
        inside = (place >= 0.0) & (place <= last + 1.0)
        node = np.uint64(min(max(place, 0.0), last + 0.0))
        z_rail, _ = _spline_at(pair.rail, node, place - node)
        gap[i] = pair.centre_z + pz - z_rail if inside else _FAR


@inlined_kernel
def _spline_at(rail: SplineTable, node: Any, q: float) -> tuple[float, float]:
    """Height and slope of a profile, the part q behind a node; `spline.spline_evaluate` without a branch."""
    p = 1.0 - q
    after = node + np.uint64(1)
    z0, z1, m0, m1 = rail.z[node], rail.z[after], rail.second[node], rail.second[after]
    sixth = rail.step * (1.0 / 6.0)
    z = p * z0 + q * z1 + rail.step * sixth * ((p * p * p - p) * m0 + (q * q * q - q) * m1)
    slope = (z1 - z0) * rail.per_step + sixth * ((1.0 - 3.0 * p * p) * m0 + (3.0 * q * q - 1.0) * m1)
    return z, slope
