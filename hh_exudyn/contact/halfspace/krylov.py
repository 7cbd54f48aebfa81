"""GMRES for the linear steps of rolling contact (Y. Saad, M.H. Schultz, SIAM J. Sci. Stat. Comput. 7, 1986).

Right-preconditioned, without restart, from zero: a step needs some five to thirty directions, of which
all are kept.
"""

import math
from collections.abc import Callable

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import allocating_kernel, kernel


@kernel
def _rotate(hessenberg: FloatArray, turns: FloatArray, right: FloatArray, k: int) -> float:
    """Turn column k of the Hessenberg matrix upper triangular; the residual then."""
    for j in range(k):
        upper, lower = hessenberg[j, k], hessenberg[j + 1, k]
        hessenberg[j, k] = turns[j, 0] * upper + turns[j, 1] * lower
        hessenberg[j + 1, k] = turns[j, 0] * lower - turns[j, 1] * upper
    length = math.hypot(hessenberg[k, k], hessenberg[k + 1, k])
    if length == 0.0:
        return 0.0
    turns[k, 0], turns[k, 1] = hessenberg[k, k] / length, hessenberg[k + 1, k] / length
    hessenberg[k, k], hessenberg[k + 1, k] = length, 0.0
    right[k + 1] = -turns[k, 1] * right[k]
    right[k] = turns[k, 0] * right[k]
    return abs(right[k + 1])


@allocating_kernel
def _back_substitute(hessenberg: FloatArray, right: FloatArray, count: int) -> FloatArray:
    """Solution of the upper triangular system."""
    result = np.zeros(count)
    for row in range(count - 1, -1, -1):
        total = right[row]
        for j in range(row + 1, count):
            total -= hessenberg[row, j] * result[j]
        result[row] = total / hessenberg[row, row] if hessenberg[row, row] != 0.0 else 0.0
    return result


def gmres(
    operator: Callable[[FloatArray], FloatArray],
    precondition: Callable[[FloatArray], FloatArray],
    right_side: FloatArray,
    tolerance: float,
    most: int,
) -> tuple[FloatArray, int]:
    """Approximate solution of operator(x) = right_side, and the number of directions it took.

    Parameters
    ----------
    operator, precondition : callable
        The matrix, and an approximation of its inverse, both on vectors of the shape of the right side.
    right_side : ndarray
        Of any shape.
    tolerance : float
        Length of the residual over that of the right side at which it ends.
    most : int
        Directions after which it ends anyhow.
    """
    shape, size = right_side.shape, right_side.size
    length = float(np.linalg.norm(right_side))
    if length == 0.0:
        return np.zeros(shape), 0
    basis, directions = np.empty((most + 1, size)), np.empty((most, size))
    hessenberg, turns = np.zeros((most + 1, most)), np.zeros((most, 2))
    right = np.zeros(most + 1)
    right[0] = length
    np.multiply(right_side.ravel(), 1.0 / length, out=basis[0])
    count = most
    for k in range(most):
        direction = precondition(basis[k].reshape(shape))
        directions[k] = direction.ravel()
        vector = operator(direction).ravel()
        known = basis[: k + 1]
        hessenberg[: k + 1, k] = known @ vector
        vector = vector - hessenberg[: k + 1, k] @ known
        rest = math.sqrt(float(vector @ vector))
        hessenberg[k + 1, k] = rest
        residual = _rotate(hessenberg, turns, right, k)
        if residual <= tolerance * length or rest == 0.0:
            count = k + 1
            break
        np.multiply(vector, 1.0 / rest, out=basis[k + 1])
    factors = _back_substitute(hessenberg, right, count)
    return (factors @ directions[:count]).reshape(shape), count
