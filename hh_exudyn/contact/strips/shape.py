"""Half lengths and pressures of the strips from their loads: the ellipse of which each is a part (kernel).

The load per width q of an ellipse is a parabola over the arc, with the variance b^2/5; its longest strip has

    a^2 = 2 q_max f/(pi E A),   f = (g^2/3) R_D(0, 1, g^2),   g = a/b,   E = G/(1 - nu)                  (1)

(Hertz, with Carlson's integral; K.L. Johnson, Contact Mechanics, 1985, chapter 4), and the strip with the
load q has the half length a sqrt(q/q_max) and the pressure 2 q/(pi a_j) in its middle. The loads are those of
neighbours that touch. Regions part and meet without any jump, because every strip weighs its neighbours by

    c_jk = (least q between j and k / lesser of q_j and q_k)^4:                                          (2)

1 where the load between them only rises or only falls, less across a saddle, zero across a gap. Spread, mean
and peak are those of the loads so weighed; in a region with one summit that is just the ellipse.
"""

import math

import numpy as np
from scipy.special import elliprd

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Memory
from hh_exudyn.kernel import inlined_kernel, kernel, memory, shaped

_OF_A_STRIP = 1.0 / 30.0  # variance within a strip over its width squared; an even load's is 1/12
_LINES = 3 * CAPACITY
_FIRST, _LAST, _INTERVALS = -12.0, 16.0, 560  # ln of 2 q_max/(pi E A b^2) in the table


def _table() -> FloatArray:
    """ln g over ln(g^2/f), at even spacing."""
    g = np.exp(np.linspace(-9.0, 7.0, 8001))
    square = g * g
    known = np.log(3.0 / elliprd(0.0, 1.0, square))
    values: FloatArray = np.interp(np.linspace(_FIRST, _LAST, _INTERVALS + 1), known, np.log(g))
    return values


_AXIS_RATIO = _table()


@inlined_kernel
def axis_ratio(square: float) -> float:
    """a/b of an ellipse [-] from g^2/f = 2 q_max/(pi E A b^2) [-]."""
    place = (math.log(square) - _FIRST) * (_INTERVALS / (_LAST - _FIRST))
    place = min(max(place, 0.0), _INTERVALS - 1e-9)
    node = int(place)
    q = place - node
    return math.exp((1.0 - q) * _AXIS_RATIO[node] + q * _AXIS_RATIO[node + 1])


@kernel
def shape_strips(count: int, modulus: float, state: Memory) -> None:
    """Fill `HALF_LENGTH` to `PEAK`, `CENTRE`, `MEAN_X`, `MEAN_Y` and `TURN_X` of the strips that carry load.

    Arguments: see the map of this folder. Of `state`, `LOAD`, `ARC`, `WIDTH`, `CURVATURE`, `NU_X` and `NU_Y`
    are read.
    """
    s = shaped(state, (ROWS, CAPACITY))
    lines = memory(_LINES)
    first = 0
    while first < count:
        if not s[Row.LOAD, first] > 0.0:
            first += 1
            continue
        last = first
        while last + 1 < count and touch(last, state):
            last += 1
        one = _has_one_summit(first, last, state)
        _line_loads(first, last, state, lines)
        for j in range(first, last + 1):
            s[Row.CENTRE, j] = 1.0 if one and j > first else 0.0
            if one and j > first:
                for row in (Row.A, Row.B, Row.PEAK, Row.MEAN_X, Row.MEAN_Y, Row.TURN_X):
                    s[row, j] = s[row, first]
            else:
                _ellipse_around(j, first, last, modulus, state, lines)
            load = s[Row.LOAD, j] / s[Row.WIDTH, j]
            s[Row.HALF_LENGTH, j] = s[Row.A, j] * math.sqrt(load / s[Row.PEAK, j])
            s[Row.PRESSURE, j] = 2.0 * load / (math.pi * s[Row.HALF_LENGTH, j])
        first = last + 1


@inlined_kernel
def touch(j: int, state: Memory) -> bool:
    """Whether strip j + 1 lies beside strip j and carries load as well."""
    s = shaped(state, (ROWS, CAPACITY))
    return s[Row.LOAD, j + 1] > 0.0 and s[Row.NUMBER, j + 1] == s[Row.NUMBER, j] + 1.0


@kernel
def _has_one_summit(first: int, last: int, state: Memory) -> bool:
    """Whether the load per width rises and then falls, over a run of strips."""
    s = shaped(state, (ROWS, CAPACITY))
    falling = False
    for j in range(first, last):
        here, there = s[Row.LOAD, j] * s[Row.WIDTH, j + 1], s[Row.LOAD, j + 1] * s[Row.WIDTH, j]
        if there < here:
            falling = True
        elif falling and there > here:
            return False
    return True


@kernel
def _line_loads(first: int, last: int, state: Memory, lines: Memory) -> None:
    """Load per width of a run of strips [N/m], its inverse and its root: divided once, not for every pair."""
    s, line = shaped(state, (ROWS, CAPACITY)), shaped(lines, (3, CAPACITY))
    for k in range(first, last + 1):
        load = s[Row.LOAD, k] / s[Row.WIDTH, k]
        line[0, k], line[1, k], line[2, k] = load, 1.0 / load, math.sqrt(load)


@kernel
def _ellipse_around(j: int, first: int, last: int, modulus: float, state: Memory, lines: Memory) -> None:
    """Fill the rows of the ellipse of which strip j, of a run of strips, is a part."""
    s, line = shaped(state, (ROWS, CAPACITY)), shaped(lines, (3, CAPACITY))
    here, inverse_here = line[0, j], line[1, j]
    total, moment, second, curvature, peak = 0.0, 0.0, 0.0, 0.0, 0.0
    mean_x, mean_y, lengths, turn_x = 0.0, 0.0, 0.0, 0.0
    origin = s[Row.ARC, j]
    for direction in (1, -1):
        k = j if direction == 1 else j - 1
        least = here
        while first <= k <= last:
            there = line[0, k]
            least = min(least, there)
            share = least * max(inverse_here, line[1, k])  # over the lesser of both
            share *= share
            share *= share
            load = share * s[Row.LOAD, k]
            arc, width = s[Row.ARC, k] - origin, s[Row.WIDTH, k]
            total += load
            moment += load * arc
            second += load * (arc * arc + width * width * _OF_A_STRIP)
            curvature += load * s[Row.CURVATURE, k]
            mean_x += load * s[Row.NU_X, k]
            mean_y += load * s[Row.NU_Y, k]
            length = share * line[2, k] * width  # in proportion
            lengths += length
            turn_x += length * s[Row.NU_X, k]
            peak = max(peak, share * there)
            k += direction
    inverse = 1.0 / total
    centre = moment * inverse
    b = math.sqrt(5.0 * (second * inverse - centre * centre))
    s[Row.A, j] = b * axis_ratio(2.0 * peak / (math.pi * modulus * curvature * inverse * b * b))
    s[Row.B, j], s[Row.PEAK, j] = b, peak
    s[Row.MEAN_X, j], s[Row.MEAN_Y, j], s[Row.TURN_X, j] = (
        mean_x * inverse,
        mean_y * inverse,
        turn_x / lengths,
    )
