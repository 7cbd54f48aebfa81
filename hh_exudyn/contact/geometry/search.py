"""All contact patches of a wheel on its rail, for a full pose of the wheelset (kernel).

`silhouette` gives the line of points where the wheel can touch. The vertical gap between that line and the
rail has its local minima just where the slopes are equal; each minimum with a negative gap is a patch. From
field side to flange, intervals of the wheel's nodes are halved until it is certain (`gap_interval`) that the
gap is open there, or that the slopes' difference has one zero or none; the zeros are then found.

Sharing. Where two minima lie in one region of interpenetration, with the saddle of depth s between their
depths d1 and d2, both patches are there for the same material. With the prominences p = d - s, patch 1
carries the fraction

    w1 = 1 - (s/d1) p2/(p1 + p2)                                                                     (1)

of the force it would have alone, and its approach is reduced by w1^(2/3), as force goes with approach^1.5.
Separate patches (s = 0) have w = 1. As two minima merge, the shallower fades out (w = p/d) while the deeper
regains all; as they change places in depth nothing jumps. Of more than two, those across the deepest saddle
join first and then count as one, with the depth of the deeper and all members weighted alike. So the force is
a continuous function of the pose (but where three share a region and their two saddles change places). It
can still fall very steeply where contact goes from the flange root to the flange: S1002 on 60E1 with 144 kN,
124 kN within 12 um.
"""

import math
from typing import NamedTuple

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.gap_interval import gap_slope_zero, least_gap, never_zero, slope_rate_bounds
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, gap_at, gap_below, silhouette
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.types import MAX_PATCHES
from hh_exudyn.kernel import inlined_kernel, kernel

# Columns of one contact found by `find_contacts`
Y_WHEEL = 0  # lateral position on the wheel profile, side coordinates [m]
Y_RAIL = 1  # on the rail profile [m]
CONTACT_ANGLE = 2  # positive towards the flange [rad]
APPROACH = 3  # elastic approach along the normal, sharing included [m]
POINT = 4  # three columns: the contact point from the wheelset's centre, axes of R [m]
RADIUS = 7  # rolling radius [m]
WHEEL_CURVATURE = 8  # lateral, convex positive [1/m]
RAIL_CURVATURE = 9
DEPTH = 10  # vertical interpenetration [m]
SADDLE = 11  # depth of the saddle towards the previous minimum, 0 where the regions are separate [m]
SADDLE_Y = 12  # where that saddle lies on the wheel profile [m]; no meaning where its depth is 0
_WEIGHT = 13  # of equation 1: working memory of the search
LIMIT_LOW = 14  # how far a patch of strips may reach, y on the wheel profile [m]: see `neighbours`
LIMIT_HIGH = 15
STIFFNESS = 16  # of its pressure where it is cut, else 0: see `non_elliptic.patch_strips`
FORCE = 17  # normal force [N] and that beyond a cut over its distance [N/m]: working memory of `neighbours`
BEYOND = 18
CONTACT_COLUMNS = 19

_MOST_MINIMA = 12  # of one wheel; standard profiles have up to 4
MAX_MINIMA = _MOST_MINIMA + 6  # rows of the working memory: in the last six, intervals wait for their turn
_RANGE_START, _RANGE_END = -0.035, 0.055  # m, the part of a wheel that can meet the rail head
_DEEPEST = 0.05  # m, radius of a flange tip less that of the running circle, at most
_WIDEST = 64  # node spacings, of an interval to begin with: halved six times it is one
_NARROW = 4  # node spacings, at most, of an interval in which a single zero is looked for
# Where nothing is certain between two nodes, the interval is looked at in parts
_PARTS = 2
_JOINED = -1.0  # in place of a saddle that has been dealt with
_TURNING_ITERATIONS = 25  # to 1e-11 m: two minima that part in between are found before they matter


class _GapSlope(NamedTuple):
    """The slope of the gap at one place of the wheel."""

    y: float  # on the wheel profile [m]
    slope: float  # of the gap [-]
    rate: float  # its derivative [1/m]


class _Found(NamedTuple):
    """The state of the search: rows of contacts so far, and the saddle since the last of them."""

    rows: int
    saddle: float  # its depth, 0 after an open gap [m]
    saddle_y: float  # where it lies on the wheel profile [m]


@inlined_kernel
def find_contacts(pair: WheelRailPair, contacts: FloatArray) -> int:
    """Find all contact patches of one wheel (kernel: trusts its input).

    Parameters
    ----------
    pair : WheelRailPair
        Profiles and pose.
    contacts : FloatArray
        (MAX_MINIMA, CONTACT_COLUMNS) working memory and result: the first rows are the patches, deepest
        first.

    Returns
    -------
    int
        Number of patches, at most MAX_PATCHES.
    """
    count = _find_minima(pair, contacts)
    if count > 1:
        _share(contacts, count)
    _complete(pair, contacts, count)
    sort_by_approach(contacts, count)
    return min(count, MAX_PATCHES)


@kernel
def find_minima(pair: WheelRailPair, contacts: FloatArray) -> int:
    """All minima with interpenetration, as `find_contacts` but in the order of y, unshared and not limited.

    Returns
    -------
    int
        Their number. The saddles stay in the rows.
    """
    count = _find_minima(pair, contacts)
    _complete(pair, contacts, count)
    return count


@inlined_kernel
def _complete(pair: WheelRailPair, contacts: FloatArray, count: int) -> None:
    """Fill the columns of a contact that follow from its place, depth and weight."""
    for k in range(count):
        row = contacts[k]
        z, slope, second = spline_evaluate(pair.wheel, row[Y_WHEEL])
        row[POINT], row[POINT + 1], row[POINT + 2], _ = silhouette(pair, row[Y_WHEEL], z, slope)
        row[RADIUS] = pair.nominal_radius - z
        square = 1.0 + slope * slope
        row[WHEEL_CURVATURE] = second / (square * math.sqrt(square))
        row[APPROACH] = row[DEPTH] * math.cos(row[CONTACT_ANGLE])
        if row[_WEIGHT] < 1.0:
            row[APPROACH] *= row[_WEIGHT] ** (2.0 / 3.0)


@inlined_kernel
def _find_minima(pair: WheelRailPair, contacts: FloatArray) -> int:
    """Halve intervals of nodes until their zeros are certain, find these: rows of `contacts`.

    In the order of y: Y_WHEEL, Y_RAIL, CONTACT_ANGLE, RAIL_CURVATURE, DEPTH, SADDLE, SADDLE_Y, _WEIGHT (1).
    """
    wheel = pair.wheel
    waiting = contacts[_MOST_MINIMA:]  # right ends of the intervals that wait, one a row
    stop = min(wheel.z.size - 1, math.floor((_RANGE_END - wheel.start) * wheel.per_step))
    first, last = _nodes_on_rail(pair, max(0, math.ceil((_RANGE_START - wheel.start) * wheel.per_step)), stop)
    found = _Found(0, 0.0, 0.0)
    if first >= last:
        return 0
    i = first
    gap, slope, rate, y_rail = _at_node(pair, i)
    while i < last:
        j = min(i + _WIDEST, last)
        next_gap, next_slope, next_rate, next_y_rail = _at_node(pair, j)
        depth = 0
        while True:
            width = (j - i) * wheel.step
            least, most = slope_rate_bounds(pair, i, j, rate, next_rate, y_rail, next_y_rail)
            crosses = (slope < 0.0) != (next_slope < 0.0)
            certain = crosses and (least >= 0.0 or most <= 0.0)  # one zero
            if min(gap, next_gap) > 0.0 and least_gap(gap, slope, next_gap, next_slope, width, least) > 0.0:
                found = _Found(found.rows, 0.0, found.saddle_y)  # the gap is open all the way
            elif crosses or not never_zero(slope, next_slope, width, least, most):
                if j - i > 1 and not (certain and j - i <= _NARROW):
                    end = waiting[depth]
                    end[0], end[1], end[2] = j, next_gap, next_slope
                    end[3], end[4] = next_rate, next_y_rail
                    depth += 1
                    j = (i + j) // 2
                    next_gap, next_slope, next_rate, next_y_rail = _at_node(pair, j)
                    continue
                y = wheel.start + i * wheel.step
                here, there = _GapSlope(y, slope, rate), _GapSlope(y + width, next_slope, next_rate)
                if certain:
                    found = _add_root(pair, here, there, contacts, found)
                else:
                    found = _add_doubtful_roots(pair, here, there, width, contacts, found)
            i, gap, slope, rate, y_rail = j, next_gap, next_slope, next_rate, next_y_rail
            if depth == 0:
                break
            depth -= 1
            end = waiting[depth]
            j = int(end[0])
            next_gap, next_slope, next_rate, next_y_rail = end[1], end[2], end[3], end[4]
    return found.rows


@inlined_kernel
def _at_node(pair: WheelRailPair, i: int) -> tuple[float, float, float, float]:
    """Gap, its slope, the rate of that and the place on the rail, at a node of the wheel."""
    wheel = pair.wheel
    gap, slope, rate, y_rail, _, _ = gap_below(
        pair, wheel.start + i * wheel.step, wheel.z[i], wheel.slope[i], wheel.second[i]
    )
    return gap, slope, rate, y_rail


@kernel
def _nodes_on_rail(pair: WheelRailPair, first: int, last: int) -> tuple[int, int]:
    """The nodes of the wheel between two that lie above the rail's table (first > last where none does)."""
    wheel, rail = pair.wheel, pair.rail
    y_rail = -pair.side * pair.centre_y - pair.distance * pair.axle_y
    y_rail -= pair.side * pair.nominal_radius * pair.root * pair.axle_z  # about that of the running circle
    # of the slopes up to 5, and of the radius, which this estimate has left out; then exactly
    margin = 5.0 * pair.nominal_radius * pair.ratio + _DEEPEST * abs(pair.axle_z)
    end = rail.start + rail.step * (rail.z.size - 1)
    low = math.ceil((rail.start - y_rail - margin - wheel.start) * wheel.per_step)
    high = math.floor((end - y_rail + margin - wheel.start) * wheel.per_step)
    first, last = max(first, low), min(last, high)
    while first < last and math.isnan(_at_node(pair, first)[0]):
        first += 1
    while first < last and math.isnan(_at_node(pair, last)[0]):
        last -= 1
    return first, last


@kernel
def _turns(low: _GapSlope, high: _GapSlope, spacing: float) -> bool:
    """Whether the gap's slope turns around between two nodes so near to zero that it may cross it twice."""
    before, rate_before, now, rate = low.slope, low.rate, high.slope, high.rate
    return (
        (before < 0.0) == (now < 0.0)
        and (before < 0.0) == (rate_before >= 0.0)
        and (now < 0.0) == (rate < 0.0)
        and abs(before) < abs(rate_before) * spacing
        and abs(now) < abs(rate) * spacing
    )


@kernel
def _add_doubtful_roots(
    pair: WheelRailPair,
    first: _GapSlope,
    last: _GapSlope,
    spacing: float,
    contacts: FloatArray,
    found: _Found,
) -> _Found:
    """All zeros of the gap's slope between two nodes where their number is not certain; see `_add_root`.

    `spacing` is the distance of the nodes [m].
    """
    width = spacing / _PARTS
    before = first
    for part in range(_PARTS):
        low, high = first.y + part * width, first.y + (part + 1) * width
        there, rate_there = last.slope, last.rate
        if part < _PARTS - 1:
            _, there, rate_there, _, _, _ = gap_at(pair, high)
        before = _GapSlope(low, before.slope, before.rate)
        end = _GapSlope(high, there, rate_there)
        between = end
        if _turns(before, end, width):
            between = _turning_point(pair, before, high)
        for _ in range(2):  # up to the middle, and from there
            if (before.slope < 0.0) != (between.slope < 0.0):
                found = _add_root(pair, before, between, contacts, found)
            before = between
            between = end
    return found


@kernel
def _turning_point(pair: WheelRailPair, start: _GapSlope, high: float) -> _GapSlope:
    """A point between `start` and `high` where the gap's slope has another sign than at both.

    Bisection for the extremum; it ends early where it finds such a point or that there is none: then the
    slope returned has the sign of that at `start`.
    """
    low, before, rate_before = start.y, start.slope, start.rate
    y, difference, rate = low, before, rate_before
    for _ in range(_TURNING_ITERATIONS):
        y = 0.5 * (low + high)
        _, difference, rate, _, _, _ = gap_at(pair, y)
        if (difference < 0.0) != (before < 0.0) or abs(difference) > abs(rate) * (high - low):
            break
        if (rate < 0.0) == (rate_before < 0.0):
            low = y
        else:
            high = y
    return _GapSlope(y, difference, rate)


@inlined_kernel
def _add_root(
    pair: WheelRailPair, low: _GapSlope, high: _GapSlope, contacts: FloatArray, found: _Found
) -> _Found:
    """Find where the slope of the gap is zero between two places and write it down.

    A minimum (rising slope) with a negative gap becomes a row of `contacts`; a maximum is a saddle.
    """
    y, gap, y_rail, slope_rail, second_rail = gap_slope_zero(
        pair, low.y, high.y, low.slope, high.slope, low.rate, high.rate
    )
    depth = max(0.0, -gap)
    if high.slope < 0.0:
        return _Found(found.rows, depth, y) if depth < found.saddle else found
    if depth == 0.0 or found.rows == _MOST_MINIMA:
        return _Found(found.rows, 0.0, y)
    row = contacts[found.rows]
    row[Y_WHEEL] = y
    row[Y_RAIL] = y_rail
    row[CONTACT_ANGLE] = -math.atan(slope_rail)
    square = 1.0 + slope_rail * slope_rail
    row[RAIL_CURVATURE] = -second_rail / (square * math.sqrt(square))
    row[DEPTH] = depth
    row[SADDLE] = min(found.saddle, depth)
    row[SADDLE_Y] = found.saddle_y
    row[_WEIGHT] = 1.0
    return _Found(found.rows + 1, math.inf, y)


@kernel
def _share(contacts: FloatArray, count: int) -> None:
    """Weights of minima that share a region of interpenetration (equation 1), deepest saddle first."""
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
        d1 = contacts[first:joint, DEPTH].max()
        d2 = contacts[joint:after, DEPTH].max()
        p1, p2 = d1 - saddle, d2 - saddle
        if p1 + p2 > 0.0:
            contacts[first:joint, _WEIGHT] *= 1.0 - saddle / d1 * p2 / (p1 + p2)
            contacts[joint:after, _WEIGHT] *= 1.0 - saddle / d2 * p1 / (p1 + p2)


@kernel
def sort_by_approach(contacts: FloatArray, count: int) -> None:
    """Order the rows by approach, deepest first (insertion; there are few)."""
    for i in range(1, count):
        j = i
        while j > 0 and contacts[j, APPROACH] > contacts[j - 1, APPROACH]:
            for c in range(CONTACT_COLUMNS):
                contacts[j, c], contacts[j - 1, c] = contacts[j - 1, c], contacts[j, c]
            j -= 1
