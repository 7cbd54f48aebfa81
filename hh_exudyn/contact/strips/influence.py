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
from hh_exudyn.contact.types import Memory
from hh_exudyn.kernel import inlined_kernel, kernel, shaped

CENTRING = 1.07  # factor of the compliance [-]

_END = 8.0  # of the tables; beyond it f = pi/2 (1/t - 1/(8 t^3)) to 1e-5
_PER_UNIT = 64  # nodes
_HALF_PI = 0.5 * math.pi


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


@inlined_kernel
def own_influence(k: int, modulus: float, state: Memory) -> float:
    """Displacement of a strip under its own unit load [m/N].

    Parameters
    ----------
    k : int
        The strip.
    modulus : float
        G/(1 - nu) [Pa].
    state : memory
        As of `influence_of`.
    """
    s = shaped(state, (ROWS, CAPACITY))
    width = s[Row.WIDTH, k]
    factor = CENTRING * 4.0 / (math.pi * math.pi * modulus * width)
    return factor * influence_integral(0.5 * width / s[Row.HALF_LENGTH, k])


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
        (ROWS, CAPACITY): `ARC`, `WIDTH`, `HALF_LENGTH` in.
    row : FloatArray
        (>= count,) out.
    """
    s = shaped(state, (ROWS, CAPACITY))
    inverse = 1.0 / s[Row.HALF_LENGTH, k]
    width, place = s[Row.WIDTH, k], s[Row.ARC, k]
    half = 0.5 * width * inverse
    factor = CENTRING * 2.0 / (math.pi * math.pi * modulus)
    far, near = factor * inverse, factor / width
    for j in range(count):
        t = max(abs(s[Row.ARC, j] - place) * inverse, 2.0 * half)
        row[j] = far * mean_density(t, half)
    row[k] = own_influence(k, modulus, state)
    beside = influence_integral(3.0 * half) - 0.5 * row[k] / near
    for direction in (-1, 1):  # the strips beside it
        j = k + direction
        if 0 <= j < count and abs(s[Row.NUMBER, j] - s[Row.NUMBER, k]) == 1.0:
            row[j] = near * beside
            if s[Row.WIDTH, j] != width:
                t = abs(s[Row.ARC, j] - place) * inverse
                row[j] = near * (influence_integral(t + half) - influence_integral(t - half))
