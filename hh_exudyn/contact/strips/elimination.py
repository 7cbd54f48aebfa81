"""Gauss's elimination of a small system, given by columns (kernel).

The rows in memory are the columns A^T of the system A x = b. With A^T = L U, L with a unit diagonal, it is
U^T L^T x = b: both triangular solves subtract multiples of rows too, so that all inner loops run over
adjacent numbers, eight at a time and over the end of a row, into `PADDING`: the few equations of a wheel
would otherwise spend their time in remainders of loops.
"""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.tangential.strips import LANES
from hh_exudyn.kernel import inlined_kernel, kernel

_1, _2, _3, _4, _5, _6, _7 = (np.uint64(k) for k in range(1, LANES))  # below, LANES numbers are written out
PADDING = LANES  # numbers at the end of every row of memory that take no part, but must be finite


@kernel
def eliminate(n: int, columns: FloatArray, values: FloatArray, unknowns: FloatArray) -> None:
    """Solve n equations whose diagonal is the largest of every column (kernel: trusts its input).

    Parameters
    ----------
    n : int
        Number of equations.
    columns : FloatArray
        (>= n, >= n + PADDING), row k the coefficients of unknown k; overwritten.
    values : FloatArray
        (>= n + PADDING,) right-hand sides; overwritten.
    unknowns : FloatArray
        (>= n,) out.
    """
    for k in range(n):
        here = np.uint64(k)  # an index that is never counted from the end
        pivot = columns[here]
        inverse = 1.0 / pivot[here]
        for r in range(k + 1, n):
            column = columns[np.uint64(r)]
            factor = column[here] * inverse
            _subtract(factor, pivot, k + 1, n, column)
            column[here] = factor
        values[here] *= inverse
        _subtract(values[here], pivot, k + 1, n, values)
    for k in range(n - 1, -1, -1):
        here = np.uint64(k)
        unknowns[here] = values[here]  # what is beyond k in `values` is of no more use
        _subtract(unknowns[here], columns[here], 0, k, values)


@inlined_kernel
def _subtract(factor: float, row: FloatArray, first: int, end: int, other: FloatArray) -> None:
    """other -= factor * row, from the first place to the end or some places beyond."""
    for start in range(first, end, LANES):
        k = np.uint64(start)
        # all are read before the first is written: so the compiler need not ask whether the rows overlap
        a, b = other[k] - factor * row[k], other[k + _1] - factor * row[k + _1]
        c, d = other[k + _2] - factor * row[k + _2], other[k + _3] - factor * row[k + _3]
        e, f = other[k + _4] - factor * row[k + _4], other[k + _5] - factor * row[k + _5]
        g, h = other[k + _6] - factor * row[k + _6], other[k + _7] - factor * row[k + _7]
        other[k], other[k + _1], other[k + _2], other[k + _3] = a, b, c, d
        other[k + _4], other[k + _5], other[k + _6], other[k + _7] = e, f, g, h


@inlined_kernel
def select(n: int, numbers: FloatArray, all_columns: FloatArray, columns: FloatArray) -> None:
    """The equations of n unknowns out of all, their padding zero.

    Parameters
    ----------
    n : int
        Number of equations.
    numbers : FloatArray
        (>= n,) of the unknowns.
    all_columns : FloatArray
        Coefficients of all, as of `eliminate`.
    columns : FloatArray
        (>= n, >= n + PADDING) out.
    """
    if n == 0:
        return
    first = int(numbers[0])
    adjacent = numbers[n - 1] - numbers[0] == n - 1.0
    for k in range(n):
        column, chosen = all_columns[np.uint64(numbers[k])], columns[np.uint64(k)]
        if adjacent:
            _copy(column, first, n, chosen)
        else:
            for r in range(n):
                chosen[np.uint64(r)] = column[np.uint64(numbers[np.uint64(r)])]
        for r in range(n, n + PADDING):
            chosen[np.uint64(r)] = 0.0


@inlined_kernel
def _copy(row: FloatArray, first: int, n: int, other: FloatArray) -> None:
    """The n numbers of a row from the first place on, and some beyond, into the beginning of another one."""
    for start in range(0, n, LANES):
        k, i = np.uint64(start), np.uint64(first + start)
        a, b, c, d = row[i], row[i + _1], row[i + _2], row[i + _3]
        e, f, g, h = row[i + _4], row[i + _5], row[i + _6], row[i + _7]
        other[k], other[k + _1], other[k + _2], other[k + _3] = a, b, c, d
        other[k + _4], other[k + _5], other[k + _6], other[k + _7] = e, f, g, h
