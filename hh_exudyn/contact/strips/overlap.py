"""Overlap of a wheel's strips with the rail, along the normal (kernel).

Every strip's own overlap d = -g cos(gamma) of equation 1 in `normal_overlap`, at its middle.
"""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.normal_overlap import mean_normal
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, above_rail, silhouette
from hh_exudyn.contact.profiles.spline import spline_behind_node
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Memory, WheelStrips
from hh_exudyn.kernel import inlined_kernel, memory, shaped

_FAR = 1.0  # m, gap of a strip beside the rail


@inlined_kernel
def overlapping_strips(pair: WheelRailPair, strips: WheelStrips, state: Memory) -> int:
    """Find the strips whose undeformed surface lies inside the rail, and their geometry.

    Arguments: see the map of this folder. Written are the rows `NUMBER` to `CURVATURE` of `state`.

    Returns
    -------
    int
        Number of strips found.
    """
    gaps = memory(CAPACITY)
    low, high = above_rail(pair)
    first, last = _count_below(strips.y, low), _count_below(strips.y, high)
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
        node = np.uint64(min(max(0.0, place), last + 0.0))
        _, slope_rail, _ = spline_behind_node(pair.rail, node, place - node)
        cosine, sine = mean_normal(slope_wheel, slope_rail)
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
        node = np.uint64(min(max(0.0, place), last + 0.0))
        z_rail, _, _ = spline_behind_node(pair.rail, node, place - node)
        gap[i] = pair.centre_z + pz - z_rail if inside else _FAR
