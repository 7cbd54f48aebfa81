"""Overlap of a wheel's strips with the rail, along the normal (kernel).

The undeformed surfaces of wheel and rail overlap, where the silhouette lies below the rail, by the vertical
gap g < 0; along the mean normal of both that is

    d = -g cos(gamma)                                                                                    (1)

with gamma the mean of the angles of wheel and rail. On a flange the vertical gap is three times the overlap
and has its largest value elsewhere: contact follows d.
"""

import math

import numpy as np

from hh_exudyn.contact.geometry.silhouette import WheelRailPair, silhouette
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Memory, WheelStrips
from hh_exudyn.kernel import inlined_kernel, kernel, memory, shaped

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
    _vertical_gaps(pair, strips, gaps)
    gap = shaped(gaps, (CAPACITY,))
    s = shaped(state, (ROWS, CAPACITY))
    count = 0
    for i in range(strips.y.size):
        if gap[i] < 0.0:
            px, py, pz, slope_wheel = silhouette(pair, strips.y[i], strips.z[i], strips.slope[i])
            y_rail = -pair.side * (pair.centre_y + py)
            _, slope_rail, _ = spline_evaluate(pair.rail, y_rail)
            of_wheel = 1.0 / math.sqrt(1.0 + slope_wheel * slope_wheel)
            of_rail = 1.0 / math.sqrt(1.0 + slope_rail * slope_rail)
            cosine, sine = of_wheel + of_rail, -(slope_wheel * of_wheel + slope_rail * of_rail)
            inverse = 1.0 / math.sqrt(cosine * cosine + sine * sine)
            cosine, sine = cosine * inverse, sine * inverse
            radius = pair.nominal_radius - strips.z[i]
            s[Row.NUMBER, count] = i
            s[Row.OVERLAP, count] = -gap[i] * cosine
            s[Row.COSINE, count], s[Row.SINE, count] = cosine, sine
            s[Row.X, count], s[Row.Y, count], s[Row.Z, count] = px, py, pz
            s[Row.Y_RAIL, count] = y_rail
            s[Row.ARC, count], s[Row.WIDTH, count] = strips.arc[i], strips.width[i]
            s[Row.RADIUS, count] = radius
            s[Row.CURVATURE, count] = 0.5 * cosine / radius
            count += 1
    return count


@kernel
def _vertical_gaps(pair: WheelRailPair, strips: WheelStrips, gaps: Memory) -> None:
    """Vertical gap of every strip [m]; no branches, for vector instructions."""
    gap = shaped(gaps, (CAPACITY,))
    rail = pair.rail
    last = rail.z.size - 2
    sixth = rail.step * rail.step * (1.0 / 6.0)
    across, up, ratio, root, side = pair.axle_y, pair.axle_z, pair.ratio, pair.root, pair.side
    distance, nominal, y0, z0 = pair.distance, pair.nominal_radius, pair.centre_y, pair.centre_z
    start, per_step = rail.start, rail.per_step
    for i in range(strips.y.size):
        t = side * (distance - strips.y[i])
        steepness = side * strips.slope[i]
        down = root * math.sqrt(1.0 - steepness * steepness * ratio)
        ey = down * up - steepness * ratio * across
        ez = -down * across - steepness * ratio * up
        radius = nominal - strips.z[i]
        place = (-side * (y0 + t * across + radius * ey) - start) * per_step
        inside = (place >= 0.0) & (place <= last + 1.0)
        node = np.uint64(min(max(place, 0.0), last + 0.0))
        q = place - node
        p = 1.0 - q
        z_rail = (
            p * rail.z[node]
            + q * rail.z[node + np.uint64(1)]
            + sixth
            * ((p * p * p - p) * rail.second[node] + (q * q * q - q) * rail.second[node + np.uint64(1)])
        )
        gap[i] = z0 + t * up + radius * ez - z_rail if inside else _FAR
