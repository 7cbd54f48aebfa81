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
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.strips.edges import soften_edges
from hh_exudyn.contact.strips.elimination import PADDING, eliminate, select
from hh_exudyn.contact.strips.influence import influence_of
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Memory
from hh_exudyn.kernel import allocating_kernel, kernel, memory, shaped

_LENGTH = 0.6  # A a^2 / d: 0.73 for a/b = 0.4, 0.5 for a circle, 0.38 for a/b = 10
_GUESS = 0.45  # of the largest overlap around; of an ellipse 0.5 to 0.6 is pressed away
_BLOCK_ROUNDS = 10  # in which many strips change at once; then one at a time, which always ends
_MOST_ROUNDS = 400
_PLACES = CAPACITY + PADDING
_ALL_PLACES = 6 * _PLACES
_FEW = 48  # strips with overlap: the matrices lie on the stack
_ROW = _FEW + PADDING
_MATRIX = _FEW * _ROW
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
        return _solve_loads(
            count,
            modulus,
            guess,
            state,
            compliance,
            shaped(memory(_MATRIX), (_FEW, _ROW)),
            shaped(memory(_MATRIX), (_FEW, _ROW)),
        )
    return _solve_many_loads(count, modulus, guess, state, compliance)


@allocating_kernel
def _solve_many_loads(
    count: int, modulus: float, guess: FloatArray, state: Memory, compliance: float
) -> bool:
    """`solve_loads` with matrices that are too large for the stack."""
    room = count + PADDING
    return _solve_loads(
        count, modulus, guess, state, compliance, np.empty((count, room)), np.empty((count, room))
    )


@kernel
def _solve_loads(
    count: int,
    modulus: float,
    guess: FloatArray,
    state: Memory,
    compliance: float,
    influences: FloatArray,
    matrix: FloatArray,
) -> bool:
    """`solve_loads` with room for the influences (row k: of strip k on all) and the matrix to be solved."""
    s = shaped(state, (ROWS, CAPACITY))
    places = shaped(memory(_ALL_PLACES), (6, _PLACES))
    active, known, residual, loads, numbers = places[0], places[1], places[2], places[3], places[4]
    overlaps = places[5]
    _start(count, guess, state, active)
    known[:count] = 0.0
    for rounds in range(_MOST_ROUNDS):
        n = 0
        for j in range(count):
            if active[j] > 0.0:
                numbers[n] = j
                n += 1
                if known[j] == 0.0:
                    influence_of(j, count, modulus, state, influences[j])
                    if compliance > 0.0:
                        for r in range(count):
                            influences[j, r] += compliance
                    known[j] = 1.0
        for r in range(n):
            overlaps[r] = s[Row.OVERLAP, np.uint64(numbers[r])]
        for r in range(n, n + PADDING):
            overlaps[r] = 0.0
        select(n, numbers, influences, matrix)
        eliminate(n, matrix, overlaps, loads)
        one = rounds >= _BLOCK_ROUNDS
        changed = False
        for r in range(n):
            if loads[r] < 0.0 and not (one and changed):
                active[np.uint64(numbers[r])] = 0.0
                changed = True
        if changed:
            continue
        for j in range(count):
            residual[j] = -s[Row.OVERLAP, j]
        for r in range(n):
            row, load = influences[np.uint64(numbers[r])], loads[r]
            for j in range(count):
                residual[j] += load * row[j]
        for j in range(count):
            if active[j] == 0.0 and residual[j] < -_ROUNDING and not (one and changed):
                active[j] = 1.0
                changed = True
        if not changed:
            guess[:] = 0.0
            for j in range(count):
                s[Row.LOAD, j] = 0.0
                guess[np.uint64(s[Row.NUMBER, j])] = active[j]
            for r in range(n):
                s[Row.LOAD, np.uint64(numbers[r])] = loads[r]
            soften_edges(count, modulus, influences, known, residual, matrix, state, compliance)
            return True
    return False


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
