"""Pressures by a second solution, with the half lengths of the first (kernel).

The loads of `loads` follow from average half lengths. With those that the loads have (`shape`), solved once
more, the largest pressure was 5 % below that of Hertz for every ellipse with a/b from 0.2 to 10: `CENTRING`
makes up for it. Under Hertz's load it is then 3.3 % too low to 0.2 % too high (a/b 0.33 to 7.5, strips of
0.5 mm). Against the exact half-space, 90th percentile of the error over 81 poses of S1002 on 60E1: 6.5 % on
tread and flange root, 15 % where contact changes to the flange and on it. Where the contact is one or two
strips wide it is up to 24 % too low. The second solution loses what makes the force continuous and monotone:
no force comes from it.
"""

from hh_exudyn.contact.strips.loads import solve_loads
from hh_exudyn.contact.strips.shape import shape_strips
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Memory
from hh_exudyn.kernel import kernel, memory, shaped

CENTRING = 1.05  # factor of the pressure, and of one over the half length [-]
_STATE = ROWS * CAPACITY


@kernel
def refine_strips(count: int, modulus: float, state: Memory) -> bool:
    """Replace load, half length, pressure and ellipse of the strips by those of the second solution.

    Arguments: see the map of this folder; `state` is that of the first solution, after `shape.shape_strips`,
    and its loads may hold damping.

    Returns
    -------
    bool
        Whether the second solution was found; the first stays where it was not.
    """
    s = shaped(state, (ROWS, CAPACITY))
    second = memory(_STATE)
    t = shaped(second, (ROWS, CAPACITY))
    guess = shaped(memory(CAPACITY), (CAPACITY,))
    guess[:] = 0.0
    for j in range(count):
        for row in range(ROWS):
            t[row, j] = s[row, j]
        if s[Row.LOAD, j] > 0.0:
            guess[int(s[Row.NUMBER, j])] = 1.0
        t[Row.HALF_LENGTH, j] = max(s[Row.HALF_LENGTH, j], 0.5 * s[Row.WIDTH, j])
    if not solve_loads(count, modulus, guess, second):
        return False
    shape_strips(count, modulus, second)
    for j in range(count):
        for row in (Row.LOAD, Row.B, Row.PEAK, Row.CENTRE, Row.MEAN_X, Row.MEAN_Y, Row.TURN_X):
            s[row, j] = t[row, j]
        s[Row.A, j], s[Row.HALF_LENGTH, j] = t[Row.A, j] / CENTRING, t[Row.HALF_LENGTH, j] / CENTRING
        s[Row.PRESSURE, j] = t[Row.PRESSURE, j] * CENTRING if t[Row.LOAD, j] > 0.0 else 0.0
    return True


@kernel
def refined_pressures(count: int, modulus: float, state: Memory) -> None:
    """Fill `REFINED` with the pressures of `refine_strips`; all else stays. Arguments as there."""
    s = shaped(state, (ROWS, CAPACITY))
    other = memory(_STATE)
    t = shaped(other, (ROWS, CAPACITY))
    for row in range(ROWS):
        for j in range(count):
            t[row, j] = s[row, j]
    refine_strips(count, modulus, other)
    for j in range(count):
        s[Row.REFINED, j] = t[Row.PRESSURE, j]
