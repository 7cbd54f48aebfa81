"""Gauss's elimination of a part of a small system's unknowns, given by columns (kernel).

The rows in memory are the columns A^T of the system A x = b: row k holds what the unknown k does to every
equation. Unknowns k in a list of pivots are eliminated: every later row r, and b as one row more, loses a
multiple of row k, so that it does nothing to equation k any more,

    row r -= f row k,   f = A^T[r, k]/A^T[k, k].                                                         (1)

The multiples are kept: x_k is the f of b in column k, less x_r times that of every later row r. What remains
of the rows is the system of the unknowns that were not eliminated. Two pivots are taken at a time, which
halves what is written.

All inner loops run over whole rows, past the equations that are done and over the end into `PADDING`, eight
adjacent numbers at a time: so the equations stay where they are, and the few of a wheel spend no time in
remainders of loops.
"""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.strips.table import CAPACITY
from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.lanes import LANES, add_multiples

PADDING = LANES  # numbers at the end of every row of memory that take no part
_NATURAL_ORDER = np.arange(CAPACITY + 1.0)


@inlined_kernel
def reduce_rows(
    pivots: int, first: int, end: int, order: FloatArray, count: int, rows: FloatArray, factors: FloatArray
) -> None:
    """Eliminate unknowns from rows, by equation 1 (kernel: trusts its input).

    Parameters
    ----------
    pivots : int
        Number of unknowns eliminated.
    first, end : int
        0 and the number of rows; or, once this has been done, `pivots` or more and an end: these rows are
        reduced as well.
    order : FloatArray
        (>= end,) numbers of rows, the pivots first.
    count : int
        Equations.
    rows, factors : FloatArray
        (> rows, >= count + PADDING) coefficients, in and out; f of equation 1 out, and zero in the row of a
        pivot from its own column to the next `LANES`.
    """
    for p in range(0, pivots, 2):
        k = np.uint64(order[np.uint64(p)])
        pivot = rows[k]
        inverse = 1.0 / pivot[k]
        if first == 0:
            for lane in range(LANES):
                factors[k, k + np.uint64(lane)] = 0.0
        if p + 1 == pivots:
            for q in range(max(first, pivots), end):
                r = np.uint64(order[np.uint64(q)])
                factor = rows[r, k] * inverse
                factors[r, k] = factor
                subtract(factor, pivot, count, rows[r])
            return
        n = np.uint64(order[np.uint64(p + 1)])
        second = rows[n]
        # both divisions at once, as they take long
        inverse_of_second = 1.0 / second[n]
        if first == 0:
            factor = second[k] * inverse
            inverse_of_second = pivot[k] / (pivot[k] * second[n] - second[k] * pivot[n])
            factors[n, k] = factor
            for lane in range(LANES):
                factors[n, n + np.uint64(lane)] = 0.0
            subtract(factor, pivot, count, second)
        for q in range(max(first, p + 2), end):
            r = np.uint64(order[np.uint64(q)])
            row = rows[r]
            one = row[k] * inverse
            other = (row[n] - one * pivot[n]) * inverse_of_second
            factors[r, k], factors[r, n] = one, other
            for start in range(0, count, LANES):
                add_multiples(row, start, (-one, -other), (pivot, second), start)


@inlined_kernel
def substitute_back(pivots: int, order: FloatArray, factors: FloatArray, values: FloatArray) -> None:
    """The eliminated unknowns from the multiples of equation 1 (kernel: trusts its input).

    Parameters
    ----------
    pivots, order, factors
        As of `reduce_rows`; the order of the pivots is that of their numbers.
    values : FloatArray
        f of the right-hand side, less x_r f of the unknowns that were not eliminated, in; the unknowns out.
        In the columns of the others it is of no meaning.
    """
    for p in range(pivots - 1, -1, -1):
        k = np.uint64(order[np.uint64(p)])
        subtract(values[k], factors[k], int(k), values)


@inlined_kernel
def solve_few(n: int, rows: FloatArray, factors: FloatArray) -> None:
    """Solve a system of n equations (kernel: trusts its input).

    Parameters
    ----------
    n : int
        Number of equations, `CAPACITY` at most.
    rows, factors : FloatArray
        (> n, >= n + PADDING) row k the coefficients of unknown k, row n the right-hand side, overwritten;
        the unknowns in row n of the factors out.
    """
    reduce_rows(n, 0, n + 1, _NATURAL_ORDER, n, rows, factors)
    substitute_back(n, _NATURAL_ORDER, factors, factors[n])


@inlined_kernel
def subtract(factor: float, row: FloatArray, count: int, other: FloatArray) -> None:
    """other -= factor * row, over the first numbers and some beyond."""
    for start in range(0, count, LANES):
        add_multiples(other, start, (-factor,), (row,), start)
