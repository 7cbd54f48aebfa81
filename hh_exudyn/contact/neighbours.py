"""Patches of one wheel that lie near one another: whose strips are whose, and what they press down (kernels).

Cuts. Where two minima lie in one region of interpenetration, each owns its side of a cut, so that nothing is
counted twice (sharing a force by weights, as `search` does for ellipses, would count strips twice). With the
depths d1 >= d2 of the minima, s and y_s of the saddle between them, the prominences p = d - s and
t = 2 p2/(p1 + p2), the shallower patch ends at

    y_s + (s/d2) (1 - t) (y_e - y_s)                                                                     (1)

where y_e is its far edge: separate regions (s = 0) are whole, a minimum that fades out (p2 -> 0) loses its
patch to the other, and two alike (t = 1) meet at the saddle. The deeper patch ends there too if it has grown
over the shallower minimum, and at the saddle where it just reaches that: s/d2 in (1) is replaced by
inside(y_s)/inside(y_2), with `inside` of the deeper patch's own strips there. So edges, and hence the forces,
are continuous functions of the pose.

Interaction. A patch presses down the surface beside it, so its neighbour carries less than it would alone.
The approach of patch i is its rigid interpenetration less the displacement of two half-spaces under the
forces of the others (Boussinesq; K.L. Johnson, Contact Mechanics, 1985, equation 3.22a),

    delta_i = d_i cos(gamma_i) - sum over j of (1 - nu)/(pi G) N_j cos(gamma_j - gamma_i)/r_ij            (2)

each force standing at its centre of pressure. Two patches of the Manchester benchmark at y = 0, 10 mm apart,
are the proof of it: without (2) the smaller has the higher pressure, with it the larger, as in the exact
solution.
"""

import math

from hh_exudyn.contact.non_elliptic import edge, minimum, patch_strips, strip_at
from hh_exudyn.contact.search import (
    APPROACH,
    CONTACT_ANGLE,
    DEPTH,
    LIMIT_HIGH,
    LIMIT_LOW,
    POINT,
    SADDLE,
    SADDLE_Y,
    Y_WHEEL,
    find_minima,
    sort_by_approach,
)
from hh_exudyn.contact.silhouette import WheelRailPair
from hh_exudyn.contact.types import MAX_PATCHES, FloatArray
from hh_exudyn.kernel import kernel

_FORCE = SADDLE  # column of a solved row that takes its normal force: the saddle is no longer needed there
_SWEEPS = 3  # of the interaction; what is left of it then is below 2 % of itself
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
    """Find the minima of all patches and how far each may reach (kernel: trusts its input).

    Parameters
    ----------
    normal : int
        A value of `NORMAL_THEORIES`, not Hertz.
    pair : WheelRailPair
        Profiles and pose.
    contacts : FloatArray
        (MAX_MINIMA, CONTACT_COLUMNS) out: rows as of `search.find_minima` with their limits, deepest first.
    shear_modulus, poisson_ratio : float
        [Pa], [-].
    strips : FloatArray
        (n, STRIP_COLUMNS) working memory.

    Returns
    -------
    int
        Number of patches, at most MAX_PATCHES.
    """
    count = find_minima(pair, contacts)
    end = pair.wheel.start + pair.wheel.step * (pair.wheel.z.size - 1)
    for k in range(count):
        contacts[k, LIMIT_LOW], contacts[k, LIMIT_HIGH] = pair.wheel.start, end
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
    """Reduce the approach of each patch by what the others press its place down (equation 2).

    Relaxed fixed-point iteration, all patches at once, so that their order plays no part.
    """
    solved = contacts[MAX_PATCHES:]  # rows that are not in use
    compliance = (1.0 - poisson_ratio) / (math.pi * shear_modulus)
    for _ in range(_SWEEPS):
        for k in range(count):
            solved[k] = contacts[k]
            low = minimum(normal, pair, solved[k], shear_modulus, poisson_ratio)
            solved[k, _FORCE], _, _, _ = patch_strips(pair, solved[k], low, strips)
        for k in range(count):
            row = contacts[k]
            approach = row[DEPTH] * math.cos(row[CONTACT_ANGLE])
            for j in range(count):
                if j == k:
                    continue
                other = solved[j]
                distance = math.hypot(
                    other[POINT] - row[POINT],
                    math.hypot(other[POINT + 1] - row[POINT + 1], other[POINT + 2] - row[POINT + 2]),
                )
                tilt = math.cos(other[CONTACT_ANGLE] - row[CONTACT_ANGLE])
                approach -= compliance * tilt * other[_FORCE] / distance
            row[APPROACH] += _RELAXATION * (approach - row[APPROACH])


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
    """Part minima that share a region of interpenetration (equation 1)."""
    for k in range(1, count):
        saddle, y_saddle = contacts[k, SADDLE], contacts[k, SADDLE_Y]
        if saddle <= 0.0:
            continue
        lower, upper = contacts[k - 1], contacts[k]
        depth_lower = lower[APPROACH] / math.cos(lower[CONTACT_ANGLE])
        depth_upper = upper[APPROACH] / math.cos(upper[CONTACT_ANGLE])
        upper_yields = depth_upper < depth_lower
        deep, shallow = (lower, upper) if upper_yields else (upper, lower)
        depth = min(depth_lower, depth_upper)
        prominences = depth_lower + depth_upper - 2.0 * saddle
        inequality = 1.0 - 2.0 * (depth - saddle) / prominences if prominences > 0.0 else 0.0
        far = edge(
            pair,
            shallow,
            minimum(normal, pair, shallow, shear_modulus, poisson_ratio),
            end if upper_yields else pair.wheel.start,
        )
        reach = inequality * (far - y_saddle)
        of_shallow = y_saddle + saddle / depth * reach
        low = minimum(normal, pair, deep, shear_modulus, poisson_ratio)
        _, at_saddle, _, _ = strip_at(pair, deep, low, y_saddle)
        _, at_shallow, _, _ = strip_at(pair, deep, low, shallow[Y_WHEEL])
        of_deep = y_saddle
        if at_saddle > 0.0 and at_shallow > 0.0:
            of_deep += min(at_saddle / at_shallow, saddle / depth) * reach
        if upper_yields:
            lower[LIMIT_HIGH], upper[LIMIT_LOW] = of_deep, of_shallow
        else:
            lower[LIMIT_HIGH], upper[LIMIT_LOW] = of_shallow, of_deep
