"""Edges of contact within a strip: loads and gaps softened over the width of a strip (kernel).

In the solution of `loads` a strip carries load or has a gap. The true edge lies within a strip, where the
mean load and the mean gap are both above zero; as an edge crosses the strips, the sharp solution's centre of
load goes ahead and falls behind by some hundredths of a millimetre. That is nothing against the width of the
contact, but over motions of less than a strip the centre moves 10 to 40 % too fast or too slow, and so wrong
are conicity and Klingel's wave there. So load and gap of a strip follow from one number z [N],

    P = S(z),  K P - d = k S(-z),  S(z) = 0, (z + e)^2/(4 e), z  below -e, between, above e              (1)

with k the strip's own influence and e the load of 0.8 times the change of overlap over a strip. From the
sharp solution, z = P or -(K P - d)/k, one Newton step leads to (1): a continuous function of the pose like
the sharp solution. Of parabolic overlaps with 5 to 17 strips in contact the centre of load then moves at 0.98
to 1.03 of the true speed (0.74 to 1.12 without; 3 strips: 0.85 to 1.18), and the force is 0.5 to 2 % larger,
which `influence.CENTRING` holds.
"""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.strips.elimination import PADDING, eliminate, select
from hh_exudyn.contact.strips.influence import influence_of
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Memory
from hh_exudyn.kernel import inlined_kernel, kernel, memory, shaped

_SOFTNESS = 0.8  # of the change of overlap over a strip width
_LEAST = 1e-3  # N, where the overlap does not change
_PLACES = CAPACITY + PADDING
_ALL_PLACES = 7 * _PLACES


@kernel
def soften_edges(
    count: int,
    modulus: float,
    influences: FloatArray,
    known: FloatArray,
    residual: FloatArray,
    matrix: FloatArray,
    state: Memory,
    compliance: float,
) -> None:
    """Replace the loads of the sharp solution by those of equation 1 (kernel: trusts its input).

    Parameters
    ----------
    count, modulus, state, compliance
        As of `loads.solve_loads`; `LOAD` in and out.
    influences, known : FloatArray
        (>= count, >= count), (>= count,) influences by row, where known; rows are added.
    residual : FloatArray
        (>= count,) K P - d of the sharp solution [m].
    matrix : FloatArray
        (>= count, >= count + PADDING) working memory.
    """
    s = shaped(state, (ROWS, CAPACITY))
    places = shaped(memory(_ALL_PLACES), (7, _PLACES))
    z, width, own, step, numbers = places[0], places[1], places[2], places[3], places[4]
    error, slope = places[5], places[6]
    n = 0
    for j in range(count):
        # of a gap beyond the softened stretch, z < -e, there is neither load nor slope
        change = abs(_overlap(j + 1, j, count, state) - _overlap(j - 1, j, count, state))
        if s[Row.LOAD, j] > 0.0 or residual[j] < 0.5 * _SOFTNESS * change:
            if known[j] == 0.0:
                influence_of(j, count, modulus, state, influences[j])
                if compliance > 0.0:
                    for r in range(count):
                        influences[j, r] += compliance
                known[j] = 1.0
            own[j] = influences[j, j] - compliance
            width[j] = max(0.5 * _SOFTNESS * change / own[j], _LEAST)
            z[j] = s[Row.LOAD, j] if s[Row.LOAD, j] > 0.0 else -residual[j] / own[j]
            slope[n] = _slope(z[j], width[j])
            numbers[n] = j
            n += 1
    # the error of equation 1: what the loads change by, less the gaps
    for r in range(n):
        here = np.uint64(numbers[r])
        residual[here] -= own[here] * _soft(-z[here], width[here])
    for c in range(n):
        k = np.uint64(numbers[c])
        change = _soft(z[k], width[k]) - s[Row.LOAD, k]
        if change != 0.0:
            row = influences[k]
            for r in range(n):
                here = np.uint64(numbers[r])
                residual[here] += change * row[here]
    select(n, numbers, influences, matrix)
    for c in range(n):
        for r in range(n):
            matrix[c, r] *= slope[c]
        # S'(-z) = 1 - S'(z)
        matrix[c, c] += own[np.uint64(numbers[c])] * (1.0 - slope[c])
        error[c] = -residual[np.uint64(numbers[c])]
    for r in range(n, n + PADDING):
        error[r] = 0.0
    eliminate(n, matrix, error, step)
    for j in range(count):
        s[Row.LOAD, j] = 0.0
    for c in range(n):
        k = np.uint64(numbers[c])
        s[Row.LOAD, k] = _soft(z[k] + step[c], width[k])


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
