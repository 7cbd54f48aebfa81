"""Patches of one wheel near one another: the division of strips, and their interaction (kernels).

Cuts. Where two maxima lie in one region of overlap, each owns its side of a cut, so that nothing is counted
twice (sharing a force by weights, as `search` does for ellipses, would count strips twice). With the
overlaps d1 >= d2 of the maxima, s and y_s of the saddle between them, the prominences p = d - s and
t = 2 p2/(p1 + p2), the shallower patch ends at

    y_s + (s/d2) (1 - t) (y_e - y_s)                                                                     (1)

where y_e is its far edge: separate regions (s = 0) are whole, a maximum that fades out (p2 -> 0) loses its
patch to the other, and two alike (t = 1) meet at the saddle. The deeper patch ends there too if it has grown
over the shallower maximum, and at the saddle where it just reaches that: s/d2 in (1) is replaced by
inside(y_s)/inside(y_2), with `inside` of the deeper patch's own strips there. So edges, and hence the forces,
are continuous functions of the pose.

Interaction. A patch presses down the surface beside it, so its neighbour carries less than it would alone.
The approach of patch i is its rigid overlap d_i less the displacement of two half-spaces under the
forces of the others (Boussinesq; K.L. Johnson, Contact Mechanics, 1985, equation 3.22a), each standing at its
centre of pressure,

    delta_i = d_i - c max(0, sum over j of N_j cos(gamma_j - gamma_i)/r_ij - N'_i/r'_i)     (2)

with c = (1 - nu)/(pi G). Kik and Piotrowski's pressure comes from the displacement under the whole patch; of
a patch that is cut, the part N'_i beyond the cut, at r'_i, is in there already. ANALYN's strips know of no
others, there N' = 0. Two patches of the Manchester benchmark at y = 0, 10 mm apart, are the proof: without
(2) the smaller has the higher pressure, with it the larger, as in the exact solution.
"""

import math

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.search import (
    APPROACH,
    BEYOND,
    CONTACT_ANGLE,
    FORCE,
    LIMIT_HIGH,
    LIMIT_LOW,
    OVERLAP,
    POINT,
    SADDLE,
    SADDLE_Y,
    STIFFNESS,
    Y_WHEEL,
    find_maxima,
    sort_by_approach,
)
from hh_exudyn.contact.geometry.silhouette import WheelRailPair
from hh_exudyn.contact.normal.non_elliptic import edge, minimum, patch_strips, strip_at
from hh_exudyn.contact.normal.registry import pressure_by_strip
from hh_exudyn.contact.types import MAX_PATCHES
from hh_exudyn.kernel import kernel

_LEAST_PART = 1e-9  # of a patch's force that counts as lying beyond a cut
_SWEEPS = 3  # of the interaction; its error then is below 2 % of itself
_RELAXATION = 0.7


@kernel
def find_patches(
    normal: int,
    pair: WheelRailPair,
    contacts: FloatArray,
    shear_modulus: float,
    poisson_ratio: float,
    strips: FloatArray,
) -> int:
    """Find the places of all patches and how far each may reach (kernel: trusts its input).

    Parameters
    ----------
    normal : int
        A value of `NORMAL_THEORIES`, not Hertz.
    pair : WheelRailPair
        Profiles and pose.
    contacts : FloatArray
        (MAX_MAXIMA, CONTACT_COLUMNS) out: rows as of `search.find_maxima` with their limits, largest
        approach first.
    shear_modulus, poisson_ratio : float
        [Pa], [-].
    strips : FloatArray
        (n, STRIP_COLUMNS) working memory.

    Returns
    -------
    int
        Number of patches, at most MAX_PATCHES.
    """
    count = find_maxima(pair, contacts)
    end = _end(pair)
    for k in range(count):
        contacts[k, LIMIT_LOW], contacts[k, LIMIT_HIGH] = pair.wheel.start, end
        contacts[k, STIFFNESS] = 0.0
    _cut(normal, pair, contacts, count, end, shear_modulus, poisson_ratio)
    sort_by_approach(contacts, count)
    count = min(count, MAX_PATCHES)
    if count > 1:
        _press_on_each_other(normal, pair, contacts, count, shear_modulus, poisson_ratio, strips)
    return count


@kernel
def _press_on_each_other(
    normal: int,
    pair: WheelRailPair,
    contacts: FloatArray,
    count: int,
    shear_modulus: float,
    poisson_ratio: float,
    strips: FloatArray,
) -> None:
    """Reduce the approach of each patch by the displacement that the others cause at its place (equation 2).

    Relaxed fixed-point iteration, all patches at once, so that their order plays no part.
    """
    solved = contacts[MAX_PATCHES:]  # rows that are not in use
    compliance = (1.0 - poisson_ratio) / (math.pi * shear_modulus)
    for _ in range(_SWEEPS):
        for k in range(count):
            contacts[k, STIFFNESS], contacts[k, BEYOND] = _solve_whole_and_cut(
                normal,
                pair,
                contacts[k],
                shear_modulus,
                poisson_ratio,
                solved[k],
                solved[MAX_PATCHES],
                strips,
            )
        for k in range(count):
            row = contacts[k]
            pressed = -row[BEYOND]
            for j in range(count):
                if j != k:
                    tilt = math.cos(solved[j, CONTACT_ANGLE] - row[CONTACT_ANGLE])
                    pressed += tilt * solved[j, FORCE] / _distance(solved[j, POINT:], row[POINT:])
            approach = row[OVERLAP] - max(0.0, compliance * pressed)
            row[APPROACH] += _RELAXATION * (approach - row[APPROACH])


@kernel
def _solve_whole_and_cut(
    normal: int,
    pair: WheelRailPair,
    contact: FloatArray,
    shear_modulus: float,
    poisson_ratio: float,
    own: FloatArray,
    whole: FloatArray,
    strips: FloatArray,
) -> tuple[float, float]:
    """Solve a patch without and with its limits; the latter is left in the row `own`, its force in `FORCE`.

    Returns
    -------
    stiffness : float
        Of the whole patch, see `non_elliptic.patch_strips`.
    beyond : float
        Force of the whole patch beyond the limits over its distance [N/m]; both 0 with ANALYN.
    """
    low = minimum(normal, pair, contact, shear_modulus, poisson_ratio)
    for column in range(own.size):
        own[column], whole[column] = contact[column], contact[column]
    if pressure_by_strip(normal):
        own[FORCE], _, _, _, _ = patch_strips(pair, own, low, 0.0, strips)
        return 0.0, 0.0
    whole[LIMIT_LOW], whole[LIMIT_HIGH] = pair.wheel.start, _end(pair)
    force, _, _, _, stiffness = patch_strips(pair, whole, low, 0.0, strips)
    own[FORCE], _, _, _, _ = patch_strips(pair, own, low, stiffness, strips)
    rest = force - own[FORCE]
    if not rest > _LEAST_PART * force:
        return stiffness, 0.0
    for axis in range(POINT, POINT + 3):  # centre of pressure of the rest
        whole[axis] = (force * whole[axis] - own[FORCE] * own[axis]) / rest
    return stiffness, rest / _distance(whole[POINT:], contact[POINT:])


@kernel
def _distance(a: FloatArray, b: FloatArray) -> float:
    """Distance of two points, of which the arrays hold the coordinates first [m]."""
    return math.sqrt((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2)


@kernel
def _end(pair: WheelRailPair) -> float:
    """Last y of the wheel profile [m]."""
    return pair.wheel.start + pair.wheel.step * (pair.wheel.z.size - 1)


@kernel
def _cut(
    normal: int,
    pair: WheelRailPair,
    contacts: FloatArray,
    count: int,
    end: float,
    shear_modulus: float,
    poisson_ratio: float,
) -> None:
    """Part maxima that share a region of overlap (equation 1)."""
    for k in range(1, count):
        saddle, y_saddle = contacts[k, SADDLE], contacts[k, SADDLE_Y]
        if saddle <= 0.0:
            continue
        lower, upper = contacts[k - 1], contacts[k]
        upper_yields = upper[OVERLAP] < lower[OVERLAP]
        deep, shallow = (lower, upper) if upper_yields else (upper, lower)
        prominences = deep[OVERLAP] + shallow[OVERLAP] - 2.0 * saddle
        inequality = 1.0 - 2.0 * (shallow[OVERLAP] - saddle) / prominences if prominences > 0.0 else 0.0
        far = edge(
            pair,
            minimum(normal, pair, shallow, shear_modulus, poisson_ratio),
            end if upper_yields else pair.wheel.start,
        )
        reach = inequality * (far - y_saddle)
        of_shallow = y_saddle + saddle / shallow[OVERLAP] * reach
        low = minimum(normal, pair, deep, shear_modulus, poisson_ratio)
        _, at_saddle, _, _ = strip_at(pair, low, y_saddle)
        _, at_shallow, _, _ = strip_at(pair, low, shallow[Y_WHEEL])
        of_deep = y_saddle
        if at_saddle > 0.0 and at_shallow > 0.0:
            of_deep += min(at_saddle / at_shallow, saddle / shallow[OVERLAP]) * reach
        if upper_yields:
            lower[LIMIT_HIGH], upper[LIMIT_LOW] = of_deep, of_shallow
        else:
            lower[LIMIT_HIGH], upper[LIMIT_LOW] = of_shallow, of_deep
