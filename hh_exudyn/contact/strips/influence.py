"""Displacement of a strip under the load of another one, both semi-elliptic along x (tables and kernel).

A strip of width w and half length a carries the load P: per width a semi-ellipse over x. In the middle of a
strip at the distance D across, the surfaces of two half-spaces of one material approach by (Boussinesq; K.L.
Johnson, Contact Mechanics, 1985, equation 3.22a, integrated)

    u = P (1 - nu)/(pi G) 2/(pi w) (F((D + w/2)/a) - F((D - w/2)/a)),   F' = f,                          (1)
    f(t) = integral over -1..1 of sqrt((1 - x^2)/(x^2 + t^2)) = 2 sqrt(1 + t^2) (K(m) - E(m)),           (2)

with the complete elliptic integrals at m = 1/(1 + t^2). Far off u = P (1 - nu)/(pi G D).
"""

import math
from itertools import pairwise

import numpy as np
from scipy.special import ellipe, ellipkm1

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.tangential.strips import LANES
from hh_exudyn.contact.types import Memory
from hh_exudyn.kernel import inlined_kernel, kernel, memory, shaped

CENTRING = 1.07  # factor of the compliance [-]

_END = 8.0  # of the tables; beyond it f = pi/2 (1/t - 1/(8 t^3)) to 1e-5
_PER_UNIT = 64  # nodes
_HALF_PI = 0.5 * math.pi
_FIRST, _PER_LOGARITHM, _NODES = -0.8, 16, 80  # ln of half length over width in the table of equal strips
_LARGEST_RATIO = 50.0  # in that table; no strip is shorter than its width
_APART = 8 * LANES  # widths at most, in that table


def influence_density(t: FloatArray) -> FloatArray:
    """f of equation 2; infinite at t = 0."""
    square = np.square(np.asarray(t, dtype=np.float64))
    m = 1.0 / (1.0 + square)
    values: FloatArray = 2.0 * np.sqrt(1.0 + square) * (ellipkm1(square * m) - ellipe(m))
    return values


def _integral_table() -> FloatArray:
    """(n, 2): F(t) - 2 t ln(1/t) and its derivative times the spacing, both smooth at t = 0."""
    nodes = np.arange(round(_END * _PER_UNIT) + 2) / _PER_UNIT
    points, weights = np.polynomial.legendre.leggauss(12)
    total, values = 0.0, [0.0]
    for low, high in pairwise(nodes):
        t = 0.5 * (low + high) + 0.5 * (high - low) * points
        # F' less the derivative of 2 t ln(1/t), which is 2 ln(1/t) - 2
        total += 0.5 * (high - low) * float(np.sum(weights * (influence_density(t) + 2.0 * np.log(t) + 2.0)))
        values.append(total)
    rates = np.empty(nodes.size)
    rates[1:] = influence_density(nodes[1:]) + 2.0 * np.log(nodes[1:]) + 2.0
    rates[0] = 2.0 * math.log(4.0)
    return np.column_stack((values, rates / _PER_UNIT))


def _density_table() -> FloatArray:
    """(n, 3): f, its derivative times the spacing, and t^2 f''/6; not used below the second node."""
    t = np.maximum(np.arange(round(_END * _PER_UNIT) + 2), 1) / _PER_UNIT
    square = 1.0 + t * t
    m, rest = 1.0 / square, t * t / square
    k, e = ellipkm1(rest), ellipe(m)
    root = np.sqrt(square)
    # with dK/dm = (E - (1 - m) K)/(2 m (1 - m)) and dE/dm = (E - K)/(2 m)
    first = 2.0 * t / root * (k - e) - 2.0 * e / (t * root)
    return np.column_stack((influence_density(t), first / _PER_UNIT, e / (3.0 * root)))


_INTEGRAL, _DENSITY = _integral_table(), _density_table()
_F_END = float(_INTEGRAL[-2, 0] - 2.0 * _END * math.log(_END))


@inlined_kernel
def influence_integral(t: float) -> float:
    """F of equation 1, odd in t."""
    size = abs(t)
    if size < _END:
        place = size * _PER_UNIT
        node = int(place)
        q = place - node
        low, high = _INTEGRAL[node], _INTEGRAL[node + 1]
        square = q * q
        cube = square * q
        value = (
            (2.0 * cube - 3.0 * square + 1.0) * low[0]
            + (cube - 2.0 * square + q) * low[1]
            + (3.0 * square - 2.0 * cube) * high[0]
            + (cube - square) * high[1]
        )
        if size > 0.0:
            value -= 2.0 * size * math.log(size)
    else:
        inverse = 1.0 / size
        value = _F_END + _HALF_PI * (math.log(size / _END) + (inverse * inverse - 1.0 / (_END * _END)) / 16.0)
    return value if t >= 0.0 else -value


@inlined_kernel
def mean_density(t: float, half: float) -> float:
    """Mean of f over t - half .. t + half, for t >= 4 half: of two strips with one or more between them.

    From f and f'' alone, with f'' = 2 E/(t^2 sqrt(1 + t^2)): good to 6e-4 of f at t = 4 half. Without
    branches, for vector instructions.
    """
    spread = half / t
    inverse = 1.0 / t
    far = _HALF_PI * inverse * (1.0 - 0.125 * inverse * inverse + spread * spread * (1.0 / 3.0))
    place = min(t, _END) * _PER_UNIT
    node = np.uint64(place)
    q = place - node
    square = q * q
    cube = square * q
    steep = 3.0 * square - 2.0 * cube
    after = node + np.uint64(1)
    near = (
        (1.0 - steep) * _DENSITY[node, 0]
        + (cube - 2.0 * square + q) * _DENSITY[node, 1]
        + steep * _DENSITY[after, 0]
        + (cube - square) * _DENSITY[after, 1]
        + ((1.0 - q) * _DENSITY[node, 2] + q * _DENSITY[after, 2]) * spread * spread
    )
    return near if t < _END else far


def _even_table() -> FloatArray:
    """(nodes, `_APART`): F((m + 1/2)/r) - F((m - 1/2)/r), equal strips m widths apart, over ln r, r = a/w."""
    half = 0.5 / np.exp(_FIRST + np.arange(_NODES) / _PER_LOGARITHM)
    points, weights = np.polynomial.legendre.leggauss(24)
    # of a strip on itself, the logarithm is integrated by itself
    t = half[:, None] * 0.5 * (1.0 + points)
    smooth = (influence_density(t) + 2.0 * np.log(t)) @ weights
    own = half * smooth + 4.0 * half * (1.0 - np.log(half))
    apart = np.arange(1, _APART)
    t = half[:, None, None] * (2.0 * apart[None, :, None] + points)
    others = half[:, None] * (influence_density(t) @ weights)
    return np.column_stack([own, others])


_EVEN = _even_table()


@inlined_kernel
def _even_influences(ratio: float, last: int, factor: float, values: Memory) -> None:
    """Influence of a strip on equal ones 0 .. last widths apart, from Lagrange's cubic between nodes."""
    place = (math.log(ratio) - _FIRST) * _PER_LOGARITHM
    node = min(max(int(place), 1), _NODES - 3)
    q = place - node
    before, behind = q + 1.0, q - 1.0
    first = -factor * q * behind * (q - 2.0) / 6.0
    second = factor * before * behind * (q - 2.0) / 2.0
    third = -factor * before * q * (q - 2.0) / 2.0
    fourth = factor * before * q * behind / 6.0
    one, two, three, four = _EVEN[node - 1], _EVEN[node], _EVEN[node + 1], _EVEN[node + 2]
    value = shaped(values, (_APART,))
    for start in range(0, last + 1, LANES):
        for m in range(start, start + LANES):
            value[m] = first * one[m] + second * two[m] + third * three[m] + fourth * four[m]


@kernel
def influence_of(k: int, count: int, modulus: float, state: Memory, row: FloatArray) -> None:
    """Displacement of all strips under a unit load of strip k [m/N], equation 1 (kernel).

    Parameters
    ----------
    k, count : int
        The strip, and the number of strips with overlap.
    modulus : float
        G/(1 - nu) [Pa].
    state : memory
        (ROWS, CAPACITY): `NUMBER`, `ARC`, `WIDTH`, `HALF_LENGTH` in.
    row : FloatArray
        (>= count,) out.
    """
    s = shaped(state, (ROWS, CAPACITY))
    width, number, ratio = s[Row.WIDTH, k], s[Row.NUMBER, k], s[Row.HALF_LENGTH, k] / s[Row.WIDTH, k]
    factor = CENTRING * 2.0 / (math.pi * math.pi * modulus * width)
    first, end = 0, count  # the strips as wide as this one: tread and flange have different ones
    while s[Row.WIDTH, first] != width:
        first += 1
    while s[Row.WIDTH, end - 1] != width:
        end -= 1
    last = int(max(number - s[Row.NUMBER, first], s[Row.NUMBER, end - 1] - number))
    if last < _APART and ratio < _LARGEST_RATIO:
        values = memory(_APART)
        _even_influences(ratio, last, factor, values)
        value = shaped(values, (_APART,))
        for j in range(first, end):
            row[j] = value[np.uint64(abs(s[Row.NUMBER, j] - number))]
    else:
        first, end = 0, 0
    if first > 0 or end < count:
        _uneven_influences(k, 0, first, factor, state, row)
        _uneven_influences(k, end, count, factor, state, row)


@kernel
def _uneven_influences(k: int, first: int, end: int, factor: float, state: Memory, row: FloatArray) -> None:
    """Influence of strip k on the strips first .. end - 1, of whatever width."""
    s = shaped(state, (ROWS, CAPACITY))
    inverse, place = 1.0 / s[Row.HALF_LENGTH, k], s[Row.ARC, k]
    half = 0.5 * s[Row.WIDTH, k] * inverse
    near, scale = 4.0 * half, 2.0 * half * factor
    for j in range(first, end):
        row[j] = scale * mean_density(max(abs(s[Row.ARC, j] - place) * inverse, near), half)
    for j in range(first, end):
        t = abs(s[Row.ARC, j] - place) * inverse
        if t < near:
            row[j] = factor * (influence_integral(t + half) - influence_integral(t - half))
