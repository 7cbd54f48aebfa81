"""Edges of contact within a strip: loads and gaps softened over the width of a strip (kernel).

In the solution of `loads` a strip carries load or has a gap. The true edge lies within a strip, where the
mean load and the mean gap are both above zero; as an edge crosses the strips, the sharp solution's centre of
load goes ahead and falls behind by some hundredths of a millimetre. That is nothing against the width of the
contact, but over motions of less than a strip the centre moves 10 to 40 % too fast or too slow, and so wrong
are conicity and Klingel's wave there. So load and gap of a strip follow from one number z [N],

    P = S(z),  K P - d = k S(-z),  S(z) = 0, (z + e)^2/(4 e), z  below -e, between, above e              (1)

with k the strip's own influence and e the load of 0.8 times the change of overlap over a strip. From the
sharp solution, z = P or -(K P - d)/k, one Newton step leads to (1): a continuous function of the pose like
the sharp solution. Inner strips bear more than e, so that (1) is linear in their loads: they stay eliminated,
and the step is solved for the ends of the runs and the strips behind them alone.

Of parabolic overlaps with 5 to 17 strips in contact the centre of load then moves at 0.98 to 1.03 of the true
speed (0.74 to 1.12 without; 3 strips: 0.85 to 1.18), and the force is 0.5 to 2 % larger, which
`influence.CENTRING` holds.
"""

import numpy as np

from hh_exudyn.contact.strips.elimination import reduce_rows, solve_few, substitute_back, subtract
from hh_exudyn.contact.strips.equations import PLACE_ROWS, PLACES, Place, Room, Strips, write_row
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Memory
from hh_exudyn.kernel import inlined_kernel, shaped

_SOFTNESS = 0.8  # of the change of overlap over a strip width
_LEAST = 1e-3  # N, where the overlap does not change


@inlined_kernel
def soften_edges(strips: Strips, inner: int, loaded: int, stretches: int, state: Memory, room: Room) -> bool:
    """Replace the loads of the sharp solution by those of equation 1 (kernel: trusts its input).

    Parameters
    ----------
    strips, state, room
        As of `equations`; the room after the sharp solution. `Row.LOAD` out.
    inner, loaded : int
        From `equations.order_strips`.
    stretches : int
        From `influence.stretches_of`.

    Returns
    -------
    bool
        False where inner strips would be softened: they are marked, and the sharp solution is wanted again
        with them among the ends.
    """
    if _some_inner_are_soft(inner, state, room):
        return False
    n = _choose(strips, inner, loaded, stretches, state, room)
    _newton_step(n, room)
    s, place = shaped(state, (ROWS, CAPACITY)), shaped(room.places, (PLACE_ROWS, PLACES))
    order, load, step = place[Place.ORDER], place[Place.LOAD], room.few_factors[n]
    for j in range(strips.number):
        s[Row.LOAD, j] = 0.0
        load[j] = room.factors[strips.number, j]
    for c in range(n):
        k = np.uint64(place[Place.CHOSEN, c])
        sharp = max(place[Place.Z, c], 0.0)
        linear = sharp + place[Place.CHANGE, c] + place[Place.SLOPE, c] * step[c]
        subtract(linear, room.factors[k], strips.number, load)
        s[Row.LOAD, k] = _soft(place[Place.Z, c] + step[c], place[Place.WIDTH, c])
    substitute_back(inner, order, room.factors, load)
    for p in range(inner):
        k = np.uint64(order[p])
        s[Row.LOAD, k] = _soft(load[k], place[Place.SOFTNESS, k])
    return True


@inlined_kernel
def _some_inner_are_soft(inner: int, state: Memory, room: Room) -> bool:
    """Fill `Place.SOFTNESS` of the inner strips, and mark those with less load than that."""
    s, place = shaped(state, (ROWS, CAPACITY)), shaped(room.places, (PLACE_ROWS, PLACES))
    some, one = False, np.uint64(1)
    for p in range(inner):
        j = np.uint64(place[Place.ORDER, p])
        change = abs(s[Row.OVERLAP, j + one] - s[Row.OVERLAP, j - one])
        place[Place.SOFTNESS, j] = max(0.5 * _SOFTNESS * change / place[Place.OWN, j], _LEAST)
        if place[Place.LOAD, j] < place[Place.SOFTNESS, j]:
            place[Place.SOFT, j] = 1.0
            some = True
    return some


@inlined_kernel
def _choose(strips: Strips, inner: int, loaded: int, stretches: int, state: Memory, room: Room) -> int:
    """Choose the strips to be softened: ends of runs, and those whose gap lies in the softened stretch.

    Returns their number; their rows are reduced, and what belongs to `Place.CHOSEN` is filled.
    """
    place = shaped(room.places, (PLACE_ROWS, PLACES))
    order, chosen, count = place[Place.ORDER], place[Place.CHOSEN], strips.number
    n = loaded - inner
    for c in range(n):
        chosen[c] = order[inner + c]
        place[Place.GAP, np.uint64(chosen[c])] = 0.0
    for j in range(count):
        # of a gap beyond the softened stretch, z < -e, there is neither load nor slope
        largest = 0.5 * _SOFTNESS * _steepness(j, count, state)
        if place[Place.ACTIVE, j] == 0.0 and place[Place.GAP, j] < largest:
            write_row(j, strips, stretches, state, room)
            place[Place.LOAD, j] = 0.0
            chosen[n] = j
            order[inner + n] = j
            n += 1
    reduce_rows(inner, loaded, inner + n, order, count, room.rows, room.factors)
    for c in range(n):
        k = int(chosen[c])
        load, own = place[Place.LOAD, k], place[Place.OWN, k]
        width = max(0.5 * _SOFTNESS * _steepness(k, count, state) / own, _LEAST)
        z = load if load > 0.0 else -place[Place.GAP, k] / own
        place[Place.WIDTH, c], place[Place.Z, c] = width, z
        place[Place.SLOPE, c], place[Place.CHANGE, c] = _slope(z, width), _soft(z, width) - load
    return n


@inlined_kernel
def _newton_step(n: int, room: Room) -> None:
    """Step of z of the strips chosen, in row n of `Room.few_factors`."""
    place, few = shaped(room.places, (PLACE_ROWS, PLACES)), room.few
    chosen, error = place[Place.CHOSEN], few[n]
    for r in range(n):
        j = np.uint64(chosen[r])
        width = place[Place.WIDTH, r]
        error[r] = place[Place.OWN, j] * _soft(-place[Place.Z, r], width) - place[Place.GAP, j]
    for c in range(n):
        k = np.uint64(chosen[c])
        row, change, slope = room.rows[k], place[Place.CHANGE, c], place[Place.SLOPE, c]
        for r in range(n):
            influence = row[np.uint64(chosen[r])]
            error[r] -= change * influence
            few[c, r] = slope * influence
        # S'(-z) = 1 - S'(z)
        few[c, c] += place[Place.OWN, k] * (1.0 - slope)
    solve_few(n, few, room.few_factors)


@inlined_kernel
def _steepness(j: int, count: int, state: Memory) -> float:
    """Change of overlap over strip j and both its neighbours [m]."""
    return abs(_overlap(j + 1, j, count, state) - _overlap(j - 1, j, count, state))


@inlined_kernel
def _overlap(j: int, beside: int, count: int, state: Memory) -> float:
    """Overlap of strip j [m] if it lies beside another one; 0 where there is none."""
    s = shaped(state, (ROWS, CAPACITY))
    if 0 <= j < count and abs(s[Row.NUMBER, j] - s[Row.NUMBER, beside]) == 1.0:
        return s[Row.OVERLAP, j]
    return 0.0


@inlined_kernel
def _soft(z: float, width: float) -> float:
    """S of equation 1."""
    if z <= -width:
        return 0.0
    return z if z >= width else (z + width) * (z + width) / (4.0 * width)


@inlined_kernel
def _slope(z: float, width: float) -> float:
    """Derivative of S."""
    if z <= -width:
        return 0.0
    return 1.0 if z >= width else (z + width) / (2.0 * width)
