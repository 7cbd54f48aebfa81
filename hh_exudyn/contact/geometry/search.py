"""All contact patches of a wheel on its rail, for a full pose of the wheelset (kernel).

A patch lies where the overlap along the normal (`normal_overlap`) has a local maximum above zero; between
two of one region lies a saddle. The gap is taken at all nodes of the wheel above the rail, from the field
side to the flange, and the rise of the overlap where it is closed; each change of its sign is then refined.
Where the rise turns near to zero, changes between two nodes are looked for in parts.

Sharing. Where two maxima lie in one region of overlap, with the saddle s between their overlaps d1 and d2,
both patches are there for the same material. With the prominences p = d - s, patch 1 carries the fraction

    w1 = 1 - (s/d1) p2/(p1 + p2)                                                                     (1)

of the force it would have alone, and its approach is reduced by w1^(2/3), as force goes with approach^1.5.
Separate patches (s = 0) have w = 1. As two maxima merge, the lower fades out (w = p/d) while the higher
regains all; as they change places in height nothing jumps. Of more than two, those across the deepest
saddle join first and then count as one, with the overlap of the higher and all members weighted alike. So
the force is a continuous function of the pose, but where three share a region and their two saddles change
places, and where two in a flat spot lie nearer to each other than the parts: they count as one, at either's
place. With Hertz it may still be steep: S1002 on 60E1 with 150 kN in the flange root, 5 kN within 1 um.
"""

import math
from typing import NamedTuple

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.normal_overlap import (
    BESIDE,
    MOST_NODES,
    node_gaps,
    node_rises,
    nodes_above_rail,
    overlap_at,
    rise_zero,
)
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, silhouette
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.types import MAX_PATCHES
from hh_exudyn.kernel import inlined_kernel, kernel, memory, shaped

# Columns of one contact found by `find_contacts`
Y_WHEEL = 0  # lateral position on the wheel profile, side coordinates [m]
Y_RAIL = 1  # on the rail profile [m]
CONTACT_ANGLE = 2  # mean of wheel and rail, positive towards the flange [rad]
APPROACH = 3  # elastic approach along the normal, sharing included [m]
POINT = 4  # three columns: the contact point from the wheelset's centre, axes of R [m]
RADIUS = 7  # rolling radius [m]
WHEEL_CURVATURE = 8  # lateral, convex positive [1/m]
RAIL_CURVATURE = 9
OVERLAP = 10  # of the undeformed profiles along the normal [m]
SADDLE = 11  # overlap at the saddle towards the previous maximum, 0 where the regions are separate [m]
SADDLE_Y = 12  # where that saddle lies on the wheel profile [m]; no meaning where it is 0
_WEIGHT = 13  # of equation 1: working memory of the search
LIMIT_LOW = 14  # how far a patch of strips may reach, y on the wheel profile [m]: see `neighbours`
LIMIT_HIGH = 15
STIFFNESS = 16  # of its pressure where it is cut, else 0: see `non_elliptic.patch_strips`
FORCE = 17  # normal force [N] and that beyond a cut over its distance [N/m]: working memory of `neighbours`
BEYOND = 18
SEMI_AXIS_A = 19  # in rolling direction and lateral, where the overlap gives them [m]: `equivalent_elastic`
SEMI_AXIS_B = 20
CONTACT_COLUMNS = 21

MAX_MAXIMA = 12  # of one wheel, in the rows of the working memory; standard profiles have up to 4
_PARTS = 16  # of an interval in which more zeros may lie: a maximum that is missed stands out by 1 nm
_JOINED = -1.0  # in place of a saddle that has been dealt with


class _Found(NamedTuple):
    """The state of the search: rows of contacts so far, and the saddle since the last of them."""

    rows: int
    saddle: float  # the overlap there, 0 after an open gap [m]
    saddle_y: float  # where it lies on the wheel profile [m]


@inlined_kernel
def find_contacts(pair: WheelRailPair, contacts: FloatArray) -> int:
    """Find all contact patches of one wheel (kernel: trusts its input).

    Parameters
    ----------
    pair : WheelRailPair
        Profiles and pose.
    contacts : FloatArray
        (MAX_MAXIMA, CONTACT_COLUMNS) out: the first rows are the patches, largest approach first.

    Returns
    -------
    int
        Number of patches, at most MAX_PATCHES.
    """
    count = find_maxima(pair, contacts)
    if count > 1:
        _share(contacts, count)
        for k in range(count):
            contacts[k, APPROACH] *= contacts[k, _WEIGHT] ** (2.0 / 3.0)
        sort_by_approach(contacts, count)
    return min(count, MAX_PATCHES)


@kernel
def find_maxima(pair: WheelRailPair, contacts: FloatArray) -> int:
    """All maxima of the overlap, as `find_contacts` but in the order of y, unshared and not limited.

    Returns
    -------
    int
        Their number. The saddles stay in the rows.
    """
    gaps, rises = memory(MOST_NODES), memory(MOST_NODES)
    gap, rise = shaped(gaps, (MOST_NODES,)), shaped(rises, (MOST_NODES,))
    first, end = nodes_above_rail(pair)
    node_gaps(pair, first, end, gaps)
    nodes, rows = end - first, 0
    while nodes > 0 and gap[nodes - 1] == BESIDE:
        nodes -= 1
    start = stop = 0
    while start < nodes and gap[start] == BESIDE:
        start += 1
    while True:
        start, stop = _closed_stretch(gap, max(start, stop), nodes)
        if start >= stop:
            return rows
        node_rises(pair, first + start, gap[start:stop], rises)
        rows = _extrema(pair, first + start, stop - start, rise, contacts, rows)


@inlined_kernel
def _closed_stretch(gap: FloatArray, first: int, end: int) -> tuple[int, int]:
    """The next nodes in a row where the gap is closed or may be nearby, two more on either side included."""
    start = stop = end
    for k in range(first + 1, end - 1):
        before, here, behind = gap[k - 1], gap[k], gap[k + 1]
        # the parabola through three nodes dips half as deep as this below the lowest of them
        dip = 0.25 * (before - 2.0 * here + behind) if here <= min(before, behind) else 0.0
        if here < dip:
            if start == end:
                start = max(first, k - 2)
            stop = min(k + 3, end)
        elif start < end and k >= stop:
            break
    return start, stop


@inlined_kernel
def _extrema(
    pair: WheelRailPair, first: int, count: int, rise: FloatArray, contacts: FloatArray, rows: int
) -> int:
    """Find the extrema between nodes in a row with the given rises; the new number of rows."""
    found = _Found(rows, 0.0, 0.0)
    width = pair.wheel.step
    for k in range(count - 1):
        doubtful = 0 < k < count - 2 and _may_turn_at_zero(rise[k - 1 : k + 3])
        if not doubtful and (rise[k] > 0.0) == (rise[k + 1] > 0.0):
            continue
        parts = _PARTS if doubtful else 1
        start = pair.wheel.start + (first + k) * width
        low, at_low = start, rise[k]
        for part in range(1, parts + 1):
            high = start + part * (width / parts)
            at_high = overlap_at(pair, high).rise if part < parts else rise[k + 1]
            if (at_low > 0.0) != (at_high > 0.0):
                y = rise_zero(pair, low, high, at_low, at_high)
                found = _add(pair, y, at_low > 0.0, contacts, found)
            low, at_low = high, at_high
    return found.rows


@inlined_kernel
def _may_turn_at_zero(values: FloatArray) -> bool:
    """Whether a curve through four nodes turns at or between the inner two, and so near to zero.

    There it may cross zero more than once. From a node to the vertex of a parabola it is at most 1/8 of the
    largest step; where profiles bend sharply within a node spacing, on a flange, 1/3 has been seen.
    """
    first, middle, last = values[1] - values[0], values[2] - values[1], values[3] - values[2]
    if (first > 0.0) == (middle > 0.0) and (middle > 0.0) == (last > 0.0):
        return False
    return min(abs(values[1]), abs(values[2])) < 0.5 * max(abs(first), abs(middle), abs(last))


@inlined_kernel
def _add(pair: WheelRailPair, y: float, is_maximum: bool, contacts: FloatArray, found: _Found) -> _Found:
    """Write down an extremum of the overlap: a maximum above zero is a row of `contacts`."""
    here = overlap_at(pair, y)
    overlap = max(0.0, here.overlap)
    if not is_maximum:
        return _Found(found.rows, overlap, y) if overlap < found.saddle else found
    if overlap == 0.0 or found.rows == MAX_MAXIMA:
        return _Found(found.rows, 0.0, y)
    row = contacts[found.rows]
    z, slope, second = spline_evaluate(pair.wheel, y)
    row[Y_WHEEL], row[Y_RAIL], row[CONTACT_ANGLE] = y, here.y_rail, math.atan2(here.sine, here.cosine)
    row[POINT], row[POINT + 1], row[POINT + 2], _ = silhouette(pair, y, z, slope)
    row[RADIUS] = pair.nominal_radius - z
    of_wheel, of_rail = 1.0 + slope * slope, 1.0 + here.rail_slope * here.rail_slope
    row[WHEEL_CURVATURE] = second / (of_wheel * math.sqrt(of_wheel))
    row[RAIL_CURVATURE] = -here.rail_second / (of_rail * math.sqrt(of_rail))
    row[APPROACH] = row[OVERLAP] = overlap
    row[SADDLE], row[SADDLE_Y] = min(found.saddle, overlap), found.saddle_y
    row[_WEIGHT] = 1.0
    return _Found(found.rows + 1, math.inf, y)


@kernel
def _share(contacts: FloatArray, count: int) -> None:
    """Weights of maxima that share a region of overlap (equation 1), deepest saddle first."""
    while True:
        joint = 0  # the group that begins at this row joins the group before it
        for i in range(1, count):
            if contacts[i, SADDLE] > 0.0 and (joint == 0 or contacts[i, SADDLE] > contacts[joint, SADDLE]):
                joint = i
        if joint == 0:
            return
        saddle = contacts[joint, SADDLE]
        contacts[joint, SADDLE] = _JOINED
        first, after = joint - 1, joint + 1
        while first > 0 and contacts[first, SADDLE] == _JOINED:
            first -= 1
        while after < count and contacts[after, SADDLE] == _JOINED:
            after += 1
        d1, d2 = 0.0, 0.0
        for k in range(first, joint):
            d1 = max(d1, contacts[k, OVERLAP])
        for k in range(joint, after):
            d2 = max(d2, contacts[k, OVERLAP])
        p1, p2 = d1 - saddle, d2 - saddle
        if p1 + p2 > 0.0:
            for k in range(first, joint):
                contacts[k, _WEIGHT] *= 1.0 - saddle / d1 * p2 / (p1 + p2)
            for k in range(joint, after):
                contacts[k, _WEIGHT] *= 1.0 - saddle / d2 * p1 / (p1 + p2)


@kernel
def sort_by_approach(contacts: FloatArray, count: int) -> None:
    """Order the rows by approach, largest first (insertion; there are few)."""
    for i in range(1, count):
        j = i
        while j > 0 and contacts[j, APPROACH] > contacts[j - 1, APPROACH]:
            for c in range(CONTACT_COLUMNS):
                contacts[j, c], contacts[j - 1, c] = contacts[j - 1, c], contacts[j, c]
            j -= 1
