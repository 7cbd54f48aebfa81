"""Gauss's elimination of a small system (kernel)."""

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import kernel


@kernel
def eliminate(n: int, matrix: FloatArray, values: FloatArray) -> None:
    """Solve n equations whose diagonal is the largest of every column (kernel: trusts its input).

    Parameters
    ----------
    n : int
        Number of equations.
    matrix : FloatArray
        (>= n, >= n) coefficients; overwritten.
    values : FloatArray
        (>= n,) right-hand sides in, unknowns out.
    """
    for k in range(n):
        inverse = 1.0 / matrix[k, k]
        for r in range(k + 1, n):
            factor = matrix[r, k] * inverse
            for c in range(k + 1, n):
                matrix[r, c] -= factor * matrix[k, c]
            values[r] -= factor * values[k]
    for k in range(n - 1, -1, -1):
        value = values[k]
        for c in range(k + 1, n):
            value -= matrix[k, c] * values[c]
        values[k] = value / matrix[k, k]
