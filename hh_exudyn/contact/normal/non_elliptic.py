"""Non-elliptic contact patches made of strips in rolling direction: from a maximum of the overlap to its
patch.

From the point of largest overlap, the edges are sought outwards on both sides along the profiles;
between them lie strips of equal share of the profile's y. `analyn` or `kik_piotrowski` gives half length and
pressure of each, here they are added up to the normal force.
"""

import math

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.search import (
    APPROACH,
    CONTACT_ANGLE,
    LIMIT_HIGH,
    LIMIT_LOW,
    OVERLAP,
    POINT,
    RADIUS,
    RAIL_CURVATURE,
    WHEEL_CURVATURE,
    Y_RAIL,
    Y_WHEEL,
)
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, silhouette
from hh_exudyn.contact.normal import kik_piotrowski
from hh_exudyn.contact.normal.hertz import CURVATURE_FLOOR, normal_contact
from hh_exudyn.contact.normal.interpenetration import Minimum, gap_curve
from hh_exudyn.contact.normal.registry import pressure_by_strip, strip
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.tangential.strips import HALF_LENGTH, PRESSURE, WIDTH, Y
from hh_exudyn.contact.types import Triple
from hh_exudyn.kernel import inlined_kernel, kernel

_STEP_PER_WIDTH = 0.52  # of the search for the edges, over Hertz's lateral semi-axis
_SMALLEST_STEP, _LARGEST_STEP = 0.02e-3, 1.5e-3  # m
_MAX_STEPS = 100  # outwards and in the bracket together
_TOLERANCE = 1e-9  # m, of an edge
_HALF_PI = 0.5 * math.pi
_SQUARE_ROOT_EDGE = 0.086110  # -zeta(-1/2, 1/2) sqrt(2): excess of midpoints in the area of sqrt(y) at y = 0


@kernel
def minimum(
    normal: int, pair: WheelRailPair, contact: FloatArray, shear_modulus: float, poisson_ratio: float
) -> Minimum:
    """A `Minimum` from a row of `search.find_maxima`."""
    cosine, approach = math.cos(contact[CONTACT_ANGLE]), contact[APPROACH]
    curvature_x = 0.5 * cosine / contact[RADIUS]
    curvature_y = max(0.5 * (contact[WHEEL_CURVATURE] + contact[RAIL_CURVATURE]), CURVATURE_FLOOR)
    _, a, b, pressure = normal_contact(approach, curvature_x, curvature_y, shear_modulus, poisson_ratio)
    z_rail, _, _ = spline_evaluate(pair.rail, contact[Y_RAIL])
    return Minimum(
        normal,
        contact[Y_WHEEL],
        contact[Y_RAIL],
        z_rail,
        cosine,
        math.sin(contact[CONTACT_ANGLE]),
        contact[OVERLAP],
        approach,
        curvature_x,
        curvature_y,
        a,
        b,
        pressure,
        shear_modulus,
        poisson_ratio,
    )


@inlined_kernel
def strip_at(pair: WheelRailPair, low: Minimum, y_wheel: float) -> tuple[float, float, float, float]:
    """Lateral coordinate s [m], `inside` (positive in contact, NaN off the profiles), half length, pressure.

    The pressure of Kik and Piotrowski awaits the factor c: it is the half length here.
    """
    s, gap, curvature_y = gap_curve(pair, low, y_wheel)
    inside, half_length, pressure = strip(low, s, gap, curvature_y)
    return s, inside, half_length, pressure


@kernel
def edge(pair: WheelRailPair, low: Minimum, limit: float) -> float:
    """Where the patch ends on the side of `limit`, at the latest there: y on the wheel profile [m].

    Steps outwards until a strip is not in contact, then the secant method in its bracket (Illinois) over
    the square of the distance, in which an ellipse's `inside` is a straight line.
    """
    direction = 1.0 if limit > low.y_wheel else -1.0
    step = min(max(_STEP_PER_WIDTH * low.b * low.cosine, _SMALLEST_STEP), _LARGEST_STEP)
    furthest = direction * (limit - low.y_wheel)
    inner, before = 0.0, 1.0
    outer, beyond = math.inf, -1.0
    place = 0.0
    moved = 0  # which end of the bracket moved last: -1 the inner, 1 the outer
    for _ in range(_MAX_STEPS):
        if outer == math.inf:
            place = min(inner + step, furthest)
        else:
            place = 0.5 * (inner + outer)
            if beyond < 0.0:  # else it is NaN, off the profile
                part = before / (before - beyond)
                place = math.sqrt(inner * inner + (outer * outer - inner * inner) * part)
            if min(place - inner, outer - place) < _TOLERANCE:
                break
        _, inside, _, _ = strip_at(pair, low, low.y_wheel + direction * place)
        if inside > 0.0:
            if place == furthest:
                break
            inner, before = place, inside
            if moved == -1:
                beyond *= 0.5
            moved = -1 if outer < math.inf else 0
        else:
            outer, beyond = place, inside
            if moved == 1:
                before *= 0.5
            moved = 1
    return low.y_wheel + direction * place


@kernel
def patch_strips(
    pair: WheelRailPair,
    contact: FloatArray,
    low: Minimum,
    stiffness: float,
    strips: FloatArray,
) -> tuple[float, float, float, float, float]:
    """The strips of one patch and their load (kernel: trusts its input).

    Midpoint sums with the end corrections that make them exact for an elliptic gap: of the force (a parabola
    over y) and of the area (a square root at each edge).

    Parameters
    ----------
    pair : WheelRailPair
        Profiles and pose.
    contact : FloatArray
        A row of `neighbours.find_patches`; on return its place is the centre of pressure.
    low : Minimum
        From `minimum`.
    stiffness : float
        c over the approach of Kik and Piotrowski's equations 3 and 4, from the whole patch where a limit cuts
        this one; 0 to find it from this one [Pa/m^2].
    strips : FloatArray
        (n, STRIP_COLUMNS) out, n >= 3: see `strips`.

    Returns
    -------
    force : float
        Normal force [N]; 0 where a limit or a neighbour has taken the whole patch.
    max_pressure : float
        [Pa].
    a, b : float
        Semi-axes of the ellipse of the same area with the aspect of longest half length to half width [m].
    stiffness : float
        As above; 0 with ANALYN, where each strip has its own.
    """
    if not low.approach > 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    y_wheel, limit_low, limit_high = low.y_wheel, contact[LIMIT_LOW], contact[LIMIT_HIGH]
    start = edge(pair, low, limit_low) if limit_low < y_wheel else limit_low
    end = edge(pair, low, limit_high) if limit_high > y_wheel else limit_high
    if not start < end:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    n = strips.shape[0]
    step = (end - start) / n
    at_start, at_end = _place_strips(pair, low, start, end, strips)
    s_start, half_start, pressure_start = at_start
    s_end, half_end, pressure_end = at_end
    longest, largest, load, moment, area = 0.0, 0.0, 0.0, 0.0, 0.0
    if limit_low < y_wheel and y_wheel < limit_high:
        longest, largest = low.a, low.pressure  # exact, where strips may miss the middle
    for i in range(n):
        width, half_length = strips[i, WIDTH], strips[i, HALF_LENGTH]
        area += width * half_length
        share = width * half_length * strips[i, PRESSURE]
        load += share
        moment += share * (i + 0.5)
        longest = max(longest, half_length)
        if pressure_by_strip(low.normal):
            largest = max(largest, strips[i, PRESSURE])
    y_centre = start + step * moment / load
    load -= _end_correction(strips, 0, 1, half_start * pressure_start)
    load -= _end_correction(strips, n - 1, n - 2, half_end * pressure_end)
    area -= _area_correction(strips, 0, half_start) + _area_correction(strips, n - 1, half_end)
    if not pressure_by_strip(low.normal):
        if stiffness == 0.0:
            stiffness = _stiffness(low, strips, s_start, s_end, half_start, half_end)
        factor = low.approach * stiffness
        largest = factor * longest
        load *= factor
        for i in range(n):
            strips[i, PRESSURE] *= factor
    half_width = 0.5 * (s_end - s_start)
    scale = math.sqrt(2.0 * area / (math.pi * longest * half_width))
    _refer_to_centre(pair, contact, low, y_centre, strips)
    return _HALF_PI * load, largest, scale * longest, scale * half_width, stiffness


@inlined_kernel
def _place_strips(
    pair: WheelRailPair, low: Minimum, start: float, end: float, strips: FloatArray
) -> tuple[Triple, Triple]:
    """Fill the strips between two places on the wheel; s, half length and pressure at both edges."""
    n = strips.shape[0]
    step = (end - start) / n
    s_start = half_start = pressure_start = s_end = half_end = pressure_end = 0.0
    for i in range(-1, n + 1):  # both edges too: a cut has a length there
        y = min(max(start + (i + 0.5) * step, start), end)
        s, _, half_length, pressure = strip_at(pair, low, y)
        if i < 0:
            s_start, half_start, pressure_start = s, half_length, pressure
        elif i == n:
            s_end, half_end, pressure_end = s, half_length, pressure
        else:
            strips[i, Y], strips[i, HALF_LENGTH], strips[i, PRESSURE] = s, half_length, pressure
    node = s_start
    for i in range(n):
        after = 0.5 * (strips[i, Y] + strips[i + 1, Y]) if i < n - 1 else s_end
        strips[i, WIDTH] = after - node
        node = after
    return (s_start, half_start, pressure_start), (s_end, half_end, pressure_end)


@kernel
def _refer_to_centre(
    pair: WheelRailPair, contact: FloatArray, low: Minimum, y_wheel: float, strips: FloatArray
) -> None:
    """Take the centre of pressure as the place of a contact, and as the origin of its strips.

    The contact plane there is between wheel and rail: their slopes differ where the patch is not symmetric:
    two equal bodies meet half way.
    """
    centre, _, _ = gap_curve(pair, low, y_wheel)
    for i in range(strips.shape[0]):
        strips[i, Y] = pair.side * (centre - strips[i, Y])  # y of frame C is to the left
    z, slope, _ = spline_evaluate(pair.wheel, y_wheel)
    px, py, pz, slope_wheel = silhouette(pair, y_wheel, z, slope)
    contact[Y_WHEEL] = y_wheel
    contact[Y_RAIL] = -pair.side * (pair.centre_y + py)
    _, slope_rail, _ = spline_evaluate(pair.rail, contact[Y_RAIL])
    contact[CONTACT_ANGLE] = -0.5 * (math.atan(slope_rail) + math.atan(slope_wheel))
    contact[POINT], contact[POINT + 1], contact[POINT + 2] = px, py, pz
    contact[RADIUS] = pair.nominal_radius - z


@kernel
def _end_correction(strips: FloatArray, first: int, second: int, at_edge: float) -> float:
    """Excess of the midpoint sum of half length times pressure at one end.

    (Width^2/24) times the slope there, from the parabola through the values at the edge and in the first two
    strips (Euler-Maclaurin).
    """
    return _correction(
        strips[first, WIDTH],
        at_edge,
        strips[first, HALF_LENGTH] * strips[first, PRESSURE],
        strips[second, HALF_LENGTH] * strips[second, PRESSURE],
    )


@kernel
def _correction(width: float, at_edge: float, first: float, second: float) -> float:
    """Euler-Maclaurin's (width^2/24) times the slope at the edge."""
    return width * (9.0 * first - second - 8.0 * at_edge) / 72.0


@kernel
def _area_correction(strips: FloatArray, i: int, at_edge: float) -> float:
    """Excess of the midpoint sum of half lengths at one end, where they begin with a square root."""
    half_length = strips[i, HALF_LENGTH]
    if not half_length > at_edge:
        return 0.0
    return _SQUARE_ROOT_EDGE * strips[i, WIDTH] * half_length * (1.0 - (at_edge / half_length) ** 2)


@kernel
def _stiffness(
    low: Minimum,
    strips: FloatArray,
    s_start: float,
    s_end: float,
    half_start: float,
    half_end: float,
) -> float:
    """c over the approach from Kik and Piotrowski's equation 4 [Pa/m^2]."""
    n = strips.shape[0]
    total, first, second, but_last, last = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        value = kik_piotrowski.influence(strips[i, Y], strips[i, WIDTH], strips[i, HALF_LENGTH])
        total += value * strips[i, WIDTH]
        if i == 0:
            first = value
        elif i == 1:
            second = value
        but_last, last = last, value
    at_start = kik_piotrowski.influence(s_start, strips[0, WIDTH], half_start) if half_start > 0.0 else 0.0
    at_end = kik_piotrowski.influence(s_end, strips[n - 1, WIDTH], half_end) if half_end > 0.0 else 0.0
    total -= _correction(strips[0, WIDTH], at_start, first, second)
    total -= _correction(strips[n - 1, WIDTH], at_end, last, but_last)
    return math.pi * low.shear_modulus / ((1.0 - low.poisson_ratio) * total)
