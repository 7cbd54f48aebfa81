"""All contact patches of a wheel on its rail, for a full pose of the wheelset (kernel).

`silhouette` gives the line of points where the wheel can touch. The vertical gap between that line and the
rail has its local minima just where the slopes are equal; each minimum with a negative gap is a patch. The
wheel's nodes are swept for changes of sign of the slope difference, which then is made zero.

Sharing. Where two minima lie in one region of interpenetration, with the saddle of depth s between their
depths d1 and d2, both patches are there for the same material. With the prominences p = d - s, patch 1
carries the fraction

    w1 = 1 - (s/d1) p2/(p1 + p2)                                                                     (1)

of the force it would have alone, and its approach is reduced by w1^(2/3), as force goes with approach^1.5.
Separate patches (s = 0) have w = 1. As two minima merge, the shallower fades out (w = p/d) while the deeper
regains all; as they change places in depth nothing jumps. Of more than two, those across the deepest saddle
join first and then count as one, with the depth of the deeper and all members weighted alike. So the force is
a continuous function of the pose (but where three share a region and their two saddles change places).
"""

import math

from hh_exudyn.contact.profile_spline import spline_evaluate
from hh_exudyn.contact.silhouette import WheelRailPair, gap_at, silhouette
from hh_exudyn.contact.types import MAX_PATCHES, FloatArray
from hh_exudyn.kernel import kernel

# Columns of one contact found by `find_contacts`
Y_WHEEL = 0  # lateral position on the wheel profile, side coordinates [m]
Y_RAIL = 1  # on the rail profile [m]
CONTACT_ANGLE = 2  # positive towards the flange [rad]
APPROACH = 3  # elastic approach along the normal, sharing included [m]
POINT = 4  # three columns: the contact point from the wheelset's centre, axes of T [m]
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
CONTACT_COLUMNS = 17

MAX_MINIMA = 12  # minima of one wheel that are kept; standard profiles have up to 4
_RANGE_START, _RANGE_END = -0.035, 0.055  # m, the part of a wheel that can meet the rail head
_TREAD_SPACING = 1.0e-3  # m, of the nodes that are swept; the tread's curvature changes slowly
_FLANGE_START = 0.025  # m, from here on closer
_FLANGE_SPACING = 0.5e-3  # m
# A minimum with a negative gap must have nodes on both sides that are looked at. Their gaps can be as large
# as half the change of slope per length times the spacing squared: 0.05 mm on the tread, where profiles bend
# by up to 0.1/mm, and 0.9 mm on a flange touching a steep gauge corner of 8 mm radius (7/mm).
_MARGIN = 0.2e-3  # m
_MARGIN_PER_SLOPE = 0.7e-3  # m
_TOLERANCE = 1e-10  # m, of a minimum's position
# Where the wheel's profile is bent more sharply than 1/(50 mm) (flange root and flange), its curvature may
# turn twice between two nodes: each interval is looked at in parts.
_SHARP = 20.0  # 1/m, of the second derivative
_SHARP_PARTS = 4
_JOINED = -1.0  # in place of a saddle that has been dealt with
_MAX_ITERATIONS = 60  # bisection alone needs 26
_TURNING_ITERATIONS = 25  # to 1e-11 m: two minima that part in between are found before they matter


@kernel
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
        Their number, at most MAX_MINIMA. The saddles stay in the rows.
    """
    count = _find_minima(pair, contacts)
    _complete(pair, contacts, count)
    return count


@kernel
def _complete(pair: WheelRailPair, contacts: FloatArray, count: int) -> None:
    """Fill the columns of a contact that follow from its place, depth and weight."""
    for k in range(count):
        row = contacts[k]
        z, slope, second = spline_evaluate(pair.wheel, row[Y_WHEEL])
        row[POINT], row[POINT + 1], row[POINT + 2], _ = silhouette(pair, row[Y_WHEEL], z, slope)
        row[RADIUS] = pair.nominal_radius - z
        row[WHEEL_CURVATURE] = second / (1.0 + slope * slope) ** 1.5
        row[APPROACH] = row[DEPTH] * math.cos(row[CONTACT_ANGLE])
        if row[_WEIGHT] < 1.0:
            row[APPROACH] *= row[_WEIGHT] ** (2.0 / 3.0)


@kernel
def _find_minima(pair: WheelRailPair, contacts: FloatArray) -> int:
    """Sweep the wheel's nodes, find where the gap's slope changes sign, refine: rows of `contacts`.

    In the order of y: Y_WHEEL, Y_RAIL, CONTACT_ANGLE, RAIL_CURVATURE, DEPTH, SADDLE, SADDLE_Y, _WEIGHT (1).
    """
    # The loop is most of the cost of a contact: `silhouette` and `spline_evaluate` are written out with
    # their divisions taken out of it, and what a distant node does not need is left for later.
    wheel, rail, side = pair.wheel, pair.rail, pair.side
    lx, ly, lz = pair.axle_x, pair.axle_y, pair.axle_z
    tread_stride = max(1, round(_TREAD_SPACING / wheel.step))
    flange_stride = max(1, round(_FLANGE_SPACING / wheel.step))
    first = max(0, math.ceil((_RANGE_START - wheel.start) / wheel.step))
    last = min(wheel.z.size - 2, math.floor((_RANGE_END - wheel.start) / wheel.step))
    ratio = lx * lx / (1.0 - lx * lx)
    root = 1.0 / math.sqrt(1.0 - lx * lx)
    rail_last = rail.z.size - 1
    per_wheel_step, per_rail_step = 1.0 / wheel.step, 1.0 / rail.step
    wheel_sixth, rail_sixth = wheel.step / 6.0, rail.step / 6.0
    rail_bend = rail.step * rail_sixth
    from_rail = side * (pair.rail_y - pair.centre_y) - rail.start
    flange_from = math.floor((_FLANGE_START - wheel.start) / wheel.step)
    stride = 0
    i = first
    count = 0
    saddle, saddle_y = 0.0, 0.0  # of the saddle since the last minimum; its depth is 0 once the gap opened
    before = rate_before = gap_before = math.nan  # at the previous node; NaN where its gap was large
    while i <= last:
        spacing = stride * wheel.step  # to the node before
        y_wheel = wheel.start + i * wheel.step
        node = i
        stride = tread_stride if i < flange_from else flange_stride
        i += stride
        slope = (wheel.z[node + 1] - wheel.z[node]) * per_wheel_step - wheel_sixth * (
            2.0 * wheel.second[node] + wheel.second[node + 1]
        )
        steepness = side * slope
        down = math.sqrt(1.0 - steepness * steepness * ratio) * root
        ey = down * lz - steepness * ratio * ly
        ez = -down * ly - steepness * ratio * lz
        t = side * (pair.distance - y_wheel)
        radius = pair.nominal_radius - wheel.z[node]
        u = (from_rail - side * (t * ly + radius * ey)) * per_rail_step
        height = pair.centre_z + t * lz + radius * ez - pair.rail_z
        if not (u >= 0.0 and u < rail_last):
            before, saddle = math.nan, 0.0
            continue
        k = int(u)
        p = u - k
        q = 1.0 - p
        if not height - q * rail.z[k] - p * rail.z[k + 1] < _MARGIN + _MARGIN_PER_SLOPE * abs(slope):
            before, saddle = math.nan, 0.0
            continue
        bend = rail_bend * ((q * q * q - q) * rail.second[k] + (p * p * p - p) * rail.second[k + 1])
        gap = height - q * rail.z[k] - p * rail.z[k + 1] - bend
        slope_rail = (rail.z[k + 1] - rail.z[k]) * per_rail_step + rail_sixth * (
            (1.0 - 3.0 * q * q) * rail.second[k] + (3.0 * p * p - 1.0) * rail.second[k + 1]
        )
        now = side * (ey - steepness * ly) / (ez - steepness * lz) - slope_rail
        rate = wheel.second[node] - q * rail.second[k] - p * rail.second[k + 1]
        if not math.isnan(before):
            crosses = (before < 0.0) != (now < 0.0)
            # How far the gap may dip between the nodes; twice what a cubic would, for kinks of the curvature
            dip = 0.25 * spacing * spacing * max(abs(rate), abs(rate_before))
            if crosses:
                dip += spacing * max(abs(now), abs(before))
            if min(gap, gap_before) > dip:
                saddle = 0.0  # the gap is open all the way
            else:
                sharp = abs(wheel.second[node]) > _SHARP
                if sharp or crosses or _turns(before, rate_before, now, rate, spacing):
                    y = y_wheel - spacing
                    count, saddle, saddle_y = _add_roots(
                        pair, y, spacing, before, rate_before, now, rate, sharp, contacts,
                        count, saddle, saddle_y,
                    )  # fmt: skip
        before, rate_before, gap_before = now, rate, gap
    return count


@kernel
def _turns(before: float, rate_before: float, now: float, rate: float, spacing: float) -> bool:
    """Whether the gap's slope turns around between two nodes so near to zero that it may cross it twice."""
    return (
        (before < 0.0) == (now < 0.0)
        and (before < 0.0) == (rate_before >= 0.0)
        and (now < 0.0) == (rate < 0.0)
        and abs(before) < abs(rate_before) * spacing
        and abs(now) < abs(rate) * spacing
    )


@kernel
def _add_roots(
    pair: WheelRailPair,
    start: float,
    spacing: float,
    before: float,
    rate_before: float,
    now: float,
    rate: float,
    sharp: bool,
    contacts: FloatArray,
    count: int,
    saddle: float,
    saddle_y: float,
) -> tuple[int, float, float]:
    """All zeros of the gap's slope between two nodes; see `_add_root`."""
    parts = _SHARP_PARTS if sharp else 1
    width = spacing / parts
    for part in range(parts):
        low, high = start + part * width, start + (part + 1) * width
        there, rate_there = now, rate
        if part < parts - 1:
            _, there, rate_there, _, _, _ = gap_at(pair, high)
        if (before < 0.0) != (there < 0.0):
            count, saddle, saddle_y = _add_root(
                pair, low, high, before, there, contacts, count, saddle, saddle_y
            )
        elif _turns(before, rate_before, there, rate_there, width):
            turn, extreme = _turning_point(pair, low, high, before, rate_before)
            if (extreme < 0.0) != (there < 0.0):
                count, saddle, saddle_y = _add_root(
                    pair, low, turn, before, extreme, contacts, count, saddle, saddle_y
                )
                count, saddle, saddle_y = _add_root(
                    pair, turn, high, extreme, there, contacts, count, saddle, saddle_y
                )
        before, rate_before = there, rate_there
    return count, saddle, saddle_y


@kernel
def _turning_point(
    pair: WheelRailPair, low: float, high: float, before: float, rate_before: float
) -> tuple[float, float]:
    """A point between two nodes where the gap's slope has another sign than at both, and the slope there.

    Bisection for the extremum; it ends early where it finds such a point or that there is none: then the
    slope returned has the sign of `before`.
    """
    y, difference = low, before
    for _ in range(_TURNING_ITERATIONS):
        y = 0.5 * (low + high)
        _, difference, rate, _, _, _ = gap_at(pair, y)
        if (difference < 0.0) != (before < 0.0) or abs(difference) > abs(rate) * (high - low):
            break
        if (rate < 0.0) == (rate_before < 0.0):
            low = y
        else:
            high = y
    return y, difference


@kernel
def _add_root(
    pair: WheelRailPair,
    low: float,
    high: float,
    at_low: float,
    at_high: float,
    contacts: FloatArray,
    count: int,
    saddle: float,
    saddle_y: float,
) -> tuple[int, float, float]:
    """Find where the slope of the gap is zero between `low` and `high` and put it down.

    Newton's method, kept inside the bracket by bisection; `at_low` and `at_high` are the slopes there. A
    minimum (rising slope) with a negative gap becomes a row of `contacts`; a maximum is a saddle.

    Returns
    -------
    count, saddle, saddle_y : float
        Number of rows, and the depth and place of the saddle since the last one.
    """
    rising = at_high >= 0.0
    y = low + (high - low) * at_low / (at_low - at_high)
    gap = y_rail = slope_rail = second_rail = math.nan
    for _ in range(_MAX_ITERATIONS):
        gap, difference, rate, y_rail, slope_rail, second_rail = gap_at(pair, y)
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
    depth = max(0.0, -gap)
    if not rising:
        return (count, depth, y) if depth < saddle else (count, saddle, saddle_y)
    if depth == 0.0 or count == MAX_MINIMA:
        return count, 0.0, y
    row = contacts[count]
    row[Y_WHEEL] = y
    row[Y_RAIL] = y_rail
    row[CONTACT_ANGLE] = -math.atan(slope_rail)
    row[RAIL_CURVATURE] = -second_rail / (1.0 + slope_rail * slope_rail) ** 1.5
    row[DEPTH] = depth
    row[SADDLE] = min(saddle, depth)
    row[SADDLE_Y] = saddle_y
    row[_WEIGHT] = 1.0
    return count + 1, math.inf, y


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
