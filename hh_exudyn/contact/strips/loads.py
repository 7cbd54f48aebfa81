"""The loads of a wheel's strips: one linear complementarity problem (kernel).

Every strip presses down the surface under itself and its neighbours (`influence`), so that with the loads
P >= 0 the strips in contact approach by their overlaps d and the others are left behind:

    K P >= d,   P >= 0,   P (K P - d) = 0.                                                               (1)

The half length in the influence of a strip is that of an average ellipse, a^2 = 0.6 d/A, but no shorter than
half its width: then F of equation 1 in `influence` and with it K depend on the pose alone, not on the loads,
and the loads are continuous in the pose. K is not symmetric, as each column has its strip's half length; that
the solution is the only one is not proven, but from any guess the tests find the same. (With a symmetric mean
of half lengths the second solution of `pressure` is 20 % off.) Against the exact half-space, force at a given
pose is 4 % too low to 4 % too high after K is taken 7 % larger (`influence.CENTRING`; a wheel on a rail, with
flange root and flange; measured in tests/contact/strips).

The solution of (1) has its edges at borders of strips, and crosses a strip in steps: `edges` makes up for it.

The second pass is for the pressure alone: its half lengths are those of the first solution. It loses what
makes the force continuous and monotone, so forces never come from it.

The problem is solved by active sets: guess, solve, drop what pulls, add what sinks in, until nothing changes.
Strips within a run (`equations.order_strips`) are eliminated first, as `edges` needs them no more: one
elimination serves the sharp solution and the softened one.
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.strips.edges import soften_edges
from hh_exudyn.contact.strips.elimination import PADDING, reduce_rows, solve_few, substitute_back, subtract
from hh_exudyn.contact.strips.equations import (
    PLACE_ROWS,
    PLACES,
    PLACES_SIZE,
    Place,
    Room,
    Strips,
    order_strips,
    write_row,
)
from hh_exudyn.contact.strips.influence import stretches_of
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Memory
from hh_exudyn.kernel import allocating_kernel, inlined_kernel, kernel, memory, shaped

_LENGTH = 0.6  # A a^2 / d: 0.73 for a/b = 0.4, 0.5 for a circle, 0.38 for a/b = 10
_GUESS = 0.45  # of the largest overlap around; of an ellipse 0.5 to 0.6 is pressed away
_BLOCK_ROUNDS = 10  # in which many strips change at once; then one at a time, which always ends
_MOST_ROUNDS = 400
_FEW = 48  # strips with overlap: the matrices lie on the stack
_ROW = _FEW + PADDING
_LINES = _FEW + 1
_MATRIX = _LINES * _ROW
_ROUNDING = 1e-13  # m, of an overlap


@kernel
def first_half_lengths(count: int, state: Memory) -> None:
    """Fill `Row.HALF_LENGTH` with the half lengths of the influence."""
    s = shaped(state, (ROWS, CAPACITY))
    for j in range(count):
        ellipse = math.sqrt(_LENGTH * s[Row.OVERLAP, j] / s[Row.CURVATURE, j])
        s[Row.HALF_LENGTH, j] = max(ellipse, 0.5 * s[Row.WIDTH, j])


@kernel
def solve_loads(
    count: int, modulus: float, guess: FloatArray, state: Memory, compliance: float = 0.0
) -> bool:
    """Solve equation 1 for the strips of `state` (kernel: trusts its input).

    Parameters
    ----------
    count : int
        Strips with overlap.
    modulus : float
        G/(1 - nu) of both bodies [Pa].
    guess : FloatArray
        (CAPACITY,) by number of the strip, 1 where it is probably in contact, else 0; all 0 for none. On
        return, the strips in contact: the next guess. It saves time and changes no digit of the result,
        which follows from the final set alone.
    state : memory
        (ROWS, CAPACITY): `OVERLAP`, `ARC`, `WIDTH`, `HALF_LENGTH` in, `LOAD` out [N].
    compliance : float
        Of what carries the bodies: all strips give way by it times the sum of all loads [m/N].

    Returns
    -------
    bool
        Whether the sets of strips came to rest.
    """
    if count <= _FEW:
        room = Room(
            memory(PLACES_SIZE),
            shaped(memory(_MATRIX), (_LINES, _ROW)),
            shaped(memory(_MATRIX), (_LINES, _ROW)),
            shaped(memory(_MATRIX), (_LINES, _ROW)),
            shaped(memory(_MATRIX), (_LINES, _ROW)),
        )
        return _solve_loads(Strips(count, modulus, compliance), guess, state, room)
    return _solve_many_loads(count, modulus, guess, state, compliance)


@allocating_kernel
def _solve_many_loads(
    count: int, modulus: float, guess: FloatArray, state: Memory, compliance: float
) -> bool:
    """`solve_loads` with matrices that are too large for the stack."""
    shape = (count + 1, count + PADDING)
    room = Room(memory(PLACES_SIZE), np.empty(shape), np.empty(shape), np.empty(shape), np.empty(shape))
    return _solve_loads(Strips(count, modulus, compliance), guess, state, room)


@inlined_kernel
def _solve_loads(strips: Strips, guess: FloatArray, state: Memory, room: Room) -> bool:
    """`solve_loads` with room for its matrices."""
    s, place = shaped(state, (ROWS, CAPACITY)), shaped(room.places, (PLACE_ROWS, PLACES))
    active, count = place[Place.ACTIVE], strips.number
    stretches = stretches_of(count, state, place[Place.ENDS])
    _start(count, guess, state, active)
    for j in range(count):
        place[Place.SOFT, j] = 0.0
    settled = False
    for rounds in range(_MOST_ROUNDS):
        inner, loaded = order_strips(count, state, room)
        for p in range(loaded):
            write_row(int(place[Place.ORDER, p]), strips, stretches, state, room)
        _sharp_loads(count, inner, loaded, state, room)
        if not settled and _changes(count, rounds >= _BLOCK_ROUNDS, room):
            continue
        settled = True
        if soften_edges(strips, inner, loaded, stretches, state, room):
            guess[:] = 0.0
            for j in range(count):
                guess[np.uint64(s[Row.NUMBER, j])] = active[j]
            return True
    return False


@inlined_kernel
def _changes(count: int, one: bool, room: Room) -> bool:
    """Drop the strips that pull or, where none does, add those that sink in; one only, or all at once.

    Returns whether there was any.
    """
    place = shaped(room.places, (PLACE_ROWS, PLACES))
    active, changed = place[Place.ACTIVE], False
    for j in range(count):
        if active[j] > 0.0 and place[Place.LOAD, j] < 0.0 and not (one and changed):
            active[j] = 0.0
            changed = True
    if changed:
        return True
    for j in range(count):
        if active[j] == 0.0 and place[Place.GAP, j] < -_ROUNDING and not (one and changed):
            active[j] = 1.0
            changed = True
    return changed


@inlined_kernel
def _sharp_loads(count: int, inner: int, loaded: int, state: Memory, room: Room) -> None:
    """Loads of the active strips, and the gaps K P - d of the others.

    The inner strips are eliminated, and what remains is solved for the ends of the runs.
    """
    s, place = shaped(state, (ROWS, CAPACITY)), shaped(room.places, (PLACE_ROWS, PLACES))
    order, gap, load = place[Place.ORDER], place[Place.GAP], place[Place.LOAD]
    values = room.rows[count]
    for j in range(count):
        values[j] = s[Row.OVERLAP, j]
    order[loaded] = count  # the right-hand side is one row more
    reduce_rows(inner, 0, loaded + 1, order, count, room.rows, room.factors)
    ends = loaded - inner
    for c in range(ends):
        row = room.rows[np.uint64(order[inner + c])]
        for r in range(ends):
            room.few[c, r] = row[np.uint64(order[inner + r])]
        room.few[ends, c] = values[np.uint64(order[inner + c])]
    solve_few(ends, room.few, room.few_factors)
    known = room.few_factors[ends]
    for j in range(count):
        gap[j] = -values[j]
        load[j] = room.factors[count, j]
    for c in range(ends):
        k = np.uint64(order[inner + c])
        subtract(-known[c], room.rows[k], count, gap)
        subtract(known[c], room.factors[k], count, load)
    substitute_back(inner, order, room.factors, load)
    for c in range(ends):
        load[np.uint64(order[inner + c])] = known[c]


@kernel
def _start(count: int, guess: FloatArray, state: Memory, active: FloatArray) -> None:
    """Mark the strips of the guess; where it has none, the deeper ones of every stretch of overlap."""
    s = shaped(state, (ROWS, CAPACITY))
    guessed = 0.0
    for j in range(count):
        active[j] = guess[np.uint64(s[Row.NUMBER, j])]
        guessed += active[j]
    if guessed > 0.0:
        return
    first = 0
    while first < count:
        last, deepest = first, s[Row.OVERLAP, first]
        while last + 1 < count and s[Row.NUMBER, last + 1] == s[Row.NUMBER, last] + 1.0:
            last += 1
            deepest = max(deepest, s[Row.OVERLAP, last])
        for j in range(first, last + 1):
            active[j] = 1.0 if s[Row.OVERLAP, j] > _GUESS * deepest else 0.0
        first = last + 1
