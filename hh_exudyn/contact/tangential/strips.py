"""Strips of a contact patch, and blocks of strips for kernels in lock step.

A patch of any shape is an array of strips along the rolling direction, one a row, columns `Y` to
`PRESSURE`: lateral position of the strip's centre in the contact frame (its origin is the reference
point of the creepages) [m], width [m], half length [m], and pressure in the strip's middle [Pa]. Strips lie
symmetric about x = 0 and the pressure is semi-elliptic along each. Rows without length are empty. Hertz's
ellipse is a special case.

The march of FASTSIM along a strip is a chain of dependent steps, but strips are independent of each other: so
each step is taken in all strips of a block before the next one. The state of a block lies in scratch memory
on the stack, shaped (rows, GROUPS, LANES); the innermost loops run over the lanes and have no branches, and
the compiler makes vector instructions of them.
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.normal.hertz import peak_pressure
from hh_exudyn.contact.types import Memory, RollingPatch
from hh_exudyn.kernel import inlined_kernel, kernel, shaped

# columns of a strip, and first rows of a block's state
Y, WIDTH, HALF_LENGTH, PRESSURE = 0, 1, 2, 3
STRIP_COLUMNS = 4
# state of `fastsim_march`: scaled rigid slip per cell (its lateral part is w_y + spin xi),
# traction, direction, whether it slips, sum of the directions at the last cell's two ends, first cell
W_X, W_Y, SPIN, Q_X, Q_Y, T_X, T_Y, SLIPS, BOTH_X, BOTH_Y, FIRST = 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14
SUM_X, SUM_Y, SUM_M = 15, 16, 17  # sums over the cells of a strip
PART, KAPPA, LAMBDA, PRIME, FULL = 18, 19, 20, 21, 22  # results of `fastrip_theory.strip`
END_X, END_Y = 18, 19  # instead of those: mean traction of the last cell in `fastsim`
ROWS = 23

LANES = 8  # strips of one vector: eight doubles fill the widest registers
GROUPS = 8
BLOCK = LANES * GROUPS  # strips of one block
SHAPE = (ROWS, GROUPS, LANES)
NO_STRIPS = np.zeros((0, STRIP_COLUMNS))  # of an ellipse: it is cut into even strips
STATE_SIZE = ROWS * BLOCK


@inlined_kernel
def load_ellipse(patch: RollingPatch, first: int, count: int, total: int, state: Memory) -> int:
    """Write the strips first .. first + count - 1 of an ellipse of `total` strips into a block.

    Lateral positions of mirrored strips are equal to the last bit except for the sign.

    Parameters
    ----------
    patch : RollingPatch
        The ellipse.
    first, count, total : int
        First strip and number of strips wanted, number of strips of the whole ellipse.
    state : memory
        Of the block; lanes beyond the last strip become empty strips.

    Returns
    -------
    int
        Number of groups in use.
    """
    s = shaped(state, SHAPE)
    middle = peak_pressure(patch)
    width, inverse = 2.0 * patch.b / total, 1.0 / total
    groups = (count + LANES - 1) // LANES
    for g in range(groups):
        for lane in range(LANES):
            row = g * LANES + lane
            lateral = (2 * (first + row) + 1 - total) * inverse
            square = 1.0 - lateral * lateral
            exists = (row < count) & (square > 0.0)
            cosine = math.sqrt(square if exists else 1.0)
            s[Y, g, lane] = patch.b * lateral
            s[WIDTH, g, lane] = width if exists else 0.0
            s[HALF_LENGTH, g, lane] = patch.a * cosine if exists else 0.0
            s[PRESSURE, g, lane] = middle * cosine
    return groups


@kernel
def load_strips(strips: FloatArray, first: int, count: int, state: Memory) -> int:
    """Write `count` rows of an array of strips, from row `first`, into a block; returns as `load_ellipse`.

    Parameters
    ----------
    strips : FloatArray
        (n, STRIP_COLUMNS) array of strips.
    first, count : int
        First row, and number of rows.
    state : memory
        Of the block; lanes beyond the last strip become empty strips.
    """
    s = shaped(state, SHAPE)
    groups = (count + LANES - 1) // LANES
    for g in range(groups):
        for lane in range(LANES):
            row = g * LANES + lane
            exists = row < count
            if exists:
                exists = strips[first + row, HALF_LENGTH] > 0.0 and strips[first + row, PRESSURE] > 0.0
            s[Y, g, lane] = strips[first + row, Y] if exists else 0.0
            s[WIDTH, g, lane] = strips[first + row, WIDTH] if exists else 0.0
            s[HALF_LENGTH, g, lane] = strips[first + row, HALF_LENGTH] if exists else 0.0
            s[PRESSURE, g, lane] = strips[first + row, PRESSURE] if exists else 1.0
    return groups


@inlined_kernel
def load_block(
    patch: RollingPatch, strips: FloatArray, even: bool, span: tuple[int, int, int], state: Memory
) -> int:
    """Put the rows (first, how many, of all) into a block: of the strips, or of an ellipse in even ones.

    Parameters
    ----------
    patch : RollingPatch
        The ellipse.
    strips : FloatArray
        (n, STRIP_COLUMNS); not read where they are even.
    even : bool
        Whether the ellipse is cut into even strips.
    span : tuple of int
        First row, number of rows, number of all strips.
    state : memory
        Of the block.
    """
    first, number, count = span
    if even:
        return load_ellipse(patch, first, number, count, state)
    return load_strips(strips, first, number, state)


@kernel
def scale_slip(factor: float, slip_x: FloatArray, slip_y: FloatArray) -> None:
    """Multiply the slip of a field (ny, nx) by a factor, in place.

    Parameters
    ----------
    factor : float
        [-].
    slip_x, slip_y : FloatArray
        (ny, nx) slip over V, changed [-].
    """
    for j in range(slip_x.shape[0]):
        for i in range(slip_x.shape[1]):
            slip_x[j, i] *= factor
            slip_y[j, i] *= factor
