"""Strips of a contact patch, and how kernels work on many of them in lock step.

A patch of any shape is an array of strips along the rolling direction, one a row, columns `Y` to
`PRESSURE`: lateral position of the strip's centre in the contact frame (its origin is the point whose
creepages are given) [m], width [m], half length [m], and pressure in the strip's middle [Pa]. Strips lie
symmetric about x = 0 and the pressure is semi-elliptic along each. Rows without length are empty. The ellipse
of Hertz is one way of filling them.

The march of FASTSIM along a strip is a chain of dependent steps, but strips know nothing of each other: so
one step is taken in `LANES` strips before the next one. The innermost loop runs over the lanes and has no
branches, and the compiler makes vector instructions of it. The state of up to `BLOCK` strips lies in a scratch
array (rows, GROUPS, LANES) on the stack.
"""

import math

from hh_exudyn.contact.types import FloatArray
from hh_exudyn.kernel import kernel

Y, WIDTH, HALF_LENGTH, PRESSURE = 0, 1, 2, 3  # columns of a strip
STRIP_COLUMNS = 4

LANES = 8  # strips of one vector: eight doubles fill the widest registers
GROUPS = 8
BLOCK = LANES * GROUPS


@kernel
def fill_ellipse(
    a: float, b: float, max_pressure: float, first: int, count: int, total: int, strips: FloatArray
) -> None:
    """Fill `count` rows with the strips first, first + 1 ... of an ellipse cut into `total` strips.

    Parameters
    ----------
    a, b : float
        Semi-axes in rolling direction and lateral [m].
    max_pressure : float
        Hertz pressure [Pa].
    first, count, total : int
        First strip and number of strips wanted, number of strips of the whole ellipse.
    strips : ndarray, (>= count, 4)
        See the module's docstring.
    """
    width = 2.0 * b / total
    for row in range(count):
        lateral = -1.0 + (2 * (first + row) + 1) / total
        cosine = math.sqrt(1.0 - lateral * lateral)
        strips[row, Y] = b * lateral
        strips[row, WIDTH] = width
        strips[row, HALF_LENGTH] = a * cosine
        strips[row, PRESSURE] = max_pressure * cosine
