"""Equivalent-elastic contact: an ellipse from the overlap of the undeformed profiles (kernels).

The patch that SIMPACK users know, as the open program OpenRailVehicleDynamics describes it (facts; its
curves of a vehicle agree with SIMPACK's). Every region of overlap between wheel and rail is one patch. What
overlaps is the VIRTUAL interpenetration: less than the bodies approach, as the surface yields beside a
patch. With the area S of the region between the profiles, its width w along the profile and its depth v,
vertical and largest,

    h = 3 S / (2 w)          height of the (flat) circular segment of equal area on the same chord     (1)
    delta = h / 0.55         elastic approach                                                          (2)
    a = sqrt(2 R v),  b = w / 2      semi-axes: where the wheel's circle leaves the rail, half the width   (3)
    p0 = E* delta / (s K(m)),  N = 2/3 pi a b p0      Hertz's pressure of that ellipse                  (4)

with s the shorter semi-axis, m = 1 - (s/l)^2, E* = G/(1 - nu). The place of contact is the centroid of the
overlap. A round overlap (a = b) has 0.5/0.55 = 91 % of Hertz's force for that patch: 0.5 is the exact share
there. The bodies of a run overlap by the virtual depth, so that they meet (1/0.55)^1.5 = 2.5 times as stiffly
as in Hertz's theory; loads and patches do not depend on that. Where two regions grow together their patches
become one and the force jumps; that belongs to the theory, and `coupled_strips` is the one that does not.
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.normal_overlap import (
    BESIDE,
    MOST_NODES,
    mean_normal,
    node_gaps,
    nodes_above_rail,
)
from hh_exudyn.contact.geometry.search import (
    APPROACH,
    CONTACT_ANGLE,
    MAX_MAXIMA,
    OVERLAP,
    POINT,
    RADIUS,
    RAIL_CURVATURE,
    SEMI_AXIS_A,
    SEMI_AXIS_B,
    WHEEL_CURVATURE,
    Y_RAIL,
    Y_WHEEL,
    sort_by_approach,
)
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, gap_at, silhouette, silhouette_rates
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.types import MAX_PATCHES
from hh_exudyn.kernel import inlined_kernel, kernel, memory, shaped

VIRTUAL_SHARE = 0.55  # of the elastic approach that the undeformed profiles overlap
_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(16)  # across a region
_TOLERANCE = 1e-10  # m, of an edge
_MOST_STEPS = 40
_MOST_MEANS = 12  # of the arithmetic-geometric mean; six reach the last digit at an axis ratio 1e-6


@kernel
def find_regions(pair: WheelRailPair, contacts: FloatArray) -> int:
    """Find the regions of overlap of one wheel and the ellipses in their place (kernel: trusts its input).

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
    gaps = memory(MOST_NODES)
    gap = shaped(gaps, (MOST_NODES,))
    first, end = nodes_above_rail(pair)
    node_gaps(pair, first, end, gaps)
    nodes, rows, k = end - first, 0, 0
    while k < nodes and rows < MAX_MAXIMA:
        if not gap[k] < 0.0:
            k += 1
            continue
        start = k
        while k < nodes and gap[k] < 0.0:
            k += 1
        low = _edge(pair, first, gap[:nodes], start, -1)
        high = _edge(pair, first, gap[:nodes], k - 1, 1)
        _write_region(pair, low, high, _depth(gap[:nodes], start, k), contacts[rows])
        if contacts[rows, APPROACH] > 0.0:
            rows += 1
    sort_by_approach(contacts, rows)
    return min(rows, MAX_PATCHES)


@inlined_kernel
def hertz_of_ellipse(
    contact: FloatArray, shear_modulus: float, poisson_ratio: float
) -> tuple[float, float, float, float]:
    """Equation 4 of a row of `find_regions`: normal force [N], a and b [m], pressure in the middle [Pa].

    Parameters
    ----------
    contact : FloatArray
        (CONTACT_COLUMNS,)
    shear_modulus, poisson_ratio : float
        [Pa], [-].
    """
    a, b = contact[SEMI_AXIS_A], contact[SEMI_AXIS_B]
    shorter = min(a, b)
    pressure = shear_modulus / (1.0 - poisson_ratio) * contact[APPROACH]
    pressure /= shorter * complete_integral(shorter / max(a, b))
    return 2.0 / 3.0 * math.pi * a * b * pressure, a, b, pressure


@inlined_kernel
def complete_integral(axis_ratio: float) -> float:
    """K(m) of an ellipse with shorter over longer axis sqrt(1 - m), by the arithmetic-geometric mean [-]."""
    arithmetic, geometric = 1.0, axis_ratio
    for _ in range(_MOST_MEANS):
        if arithmetic - geometric < 1e-15:
            break
        arithmetic, geometric = 0.5 * (arithmetic + geometric), math.sqrt(arithmetic * geometric)
    return 0.5 * math.pi / arithmetic


@kernel
def _edge(pair: WheelRailPair, first: int, gap: FloatArray, inside: int, direction: int) -> float:
    """Where a region ends beyond its last node `inside` on one side: y on the wheel profile [m].

    The secant method in the bracket (Illinois); at the end of wheel or rail the region ends at its node.
    """
    wheel = pair.wheel
    outside = inside + direction
    low = wheel.start + (first + inside) * wheel.step
    if outside < 0 or outside >= gap.size or gap[outside] == BESIDE:
        return low
    high = wheel.start + (first + outside) * wheel.step
    at_low, at_high = gap[inside], gap[outside]
    moved, before, y = 0, math.inf, low
    for _ in range(_MOST_STEPS):
        y = low - at_low * (high - low) / (at_high - at_low)
        if not abs(y - before) > _TOLERANCE:
            break
        before = y
        here, _, _, _, _ = gap_at(pair, y)
        if here < 0.0:
            low, at_low = y, here
            if moved == -1:
                at_high *= 0.5
            moved = -1
        else:
            high, at_high = y, here
            if moved == 1:
                at_low *= 0.5
            moved = 1
    return y


@inlined_kernel
def _depth(gap: FloatArray, start: int, end: int) -> float:
    """Largest vertical overlap of the nodes start .. end - 1, by the parabola about the deepest [m]."""
    deepest = start
    for k in range(start, end):
        if gap[k] < gap[deepest]:
            deepest = k
    here = gap[deepest]
    if deepest == 0 or deepest + 1 >= gap.size:
        return -here
    before, behind = gap[deepest - 1], gap[deepest + 1]
    if before == BESIDE or behind == BESIDE:
        return -here
    bend = before - 2.0 * here + behind
    return -here + 0.125 * (behind - before) ** 2 / bend if bend > 0.0 else -here


@kernel
def _write_region(pair: WheelRailPair, low: float, high: float, depth: float, row: FloatArray) -> None:
    """The patch of the region between two places of the wheel: equations 1 to 3, its centroid and its place.

    Without overlap the approach is zero.
    """
    row[APPROACH] = 0.0
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    area, moment, width = 0.0, 0.0, 0.0
    for k in range(_PLACES.size):
        y = middle + half * _PLACES[k]
        z, slope, second = spline_evaluate(pair.wheel, y)
        gap, difference, _, rail_slope, _ = gap_at(pair, y)
        lateral, _ = silhouette_rates(pair, z, slope, second)
        cosine, _ = mean_normal(difference + rail_slope, rail_slope)
        share = _WEIGHTS[k] * half * lateral
        width += share / cosine
        overlap = max(0.0, -gap) * share
        area += overlap
        moment += overlap * y
    if not (area > 0.0 and width > 0.0 and depth > 0.0):
        return
    y = moment / area
    z, slope, second = spline_evaluate(pair.wheel, y)
    row[POINT], row[POINT + 1], row[POINT + 2], slope_wheel = silhouette(pair, y, z, slope)
    _, _, y_rail, slope_rail, second_rail = gap_at(pair, y)
    cosine, sine = mean_normal(slope_wheel, slope_rail)
    of_wheel, of_rail = 1.0 + slope * slope, 1.0 + slope_rail * slope_rail
    row[Y_WHEEL], row[Y_RAIL], row[CONTACT_ANGLE] = y, y_rail, math.atan2(sine, cosine)
    row[RADIUS] = pair.nominal_radius - z
    row[WHEEL_CURVATURE] = second / (of_wheel * math.sqrt(of_wheel))
    row[RAIL_CURVATURE] = -second_rail / (of_rail * math.sqrt(of_rail))
    row[OVERLAP] = depth * cosine
    row[SEMI_AXIS_A], row[SEMI_AXIS_B] = math.sqrt(2.0 * row[RADIUS] * depth), 0.5 * width
    row[APPROACH] = 1.5 * area / width / VIRTUAL_SHARE
