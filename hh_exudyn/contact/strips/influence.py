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
from hh_exudyn.lanes import LANES, set_multiples

CENTRING = 1.07  # factor of the compliance [-]

_END = 8.0  # of the tables; beyond it f = pi/2 (1/t - 1/(8 t^3)) to 1e-5
_PER_UNIT = 64  # nodes
_HALF_PI = 0.5 * math.pi
_APART = 8 * LANES  # widths at most, in the table of equal strips
_MIDDLE, _LARGEST_RATIO = 5.0, 50.0  # half length over width in the middle and at the end of that table
_NODES = 80
_PER_UNIT_OF_G = (_NODES - 3) / (2.0 * (_LARGEST_RATIO - _MIDDLE) / (_LARGEST_RATIO + _MIDDLE))
_FIRST = -(_LARGEST_RATIO - _MIDDLE) / (_LARGEST_RATIO + _MIDDLE) - 1.0 / _PER_UNIT_OF_G
_LEAST_T, _DEGREE = 0.75, 8  # t from which the polynomials of distant strips hold, and their degree


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
    """(nodes, 2 `_APART` + LANES): F((m + 1/2)/r) - F((m - 1/2)/r), equal strips m widths apart.

    In column m + `_APART`, over even steps of g of `_even_influences`; r = a/w is 0.5 in the second row.
    """
    g = _FIRST + np.arange(_NODES) / _PER_UNIT_OF_G
    half = 0.5 * (1.0 - g) / (_MIDDLE * (1.0 + g))
    points, weights = np.polynomial.legendre.leggauss(24)
    # of a strip on itself, the logarithm is integrated by itself
    t = half[:, None] * 0.5 * (1.0 + points)
    smooth = (influence_density(t) + 2.0 * np.log(t)) @ weights
    own = half * smooth + 4.0 * half * (1.0 - np.log(half))
    apart = np.arange(1, _APART)
    t = half[:, None, None] * (2.0 * apart[None, :, None] + points)
    others = half[:, None] * (influence_density(t) @ weights)
    beyond = np.zeros((_NODES, 1 + LANES))  # read, never used
    return np.column_stack([beyond[:, :1], others[:, ::-1], own, others, beyond[:, 1:]])


def _far_polynomials() -> FloatArray:
    """(degree + 1, 2): of `_far_influences`, from the constant terms on."""
    m = 0.5 / (1.0 + _LEAST_T**2) * (1.0 - np.cos(math.pi * (np.arange(200) + 0.5) / 200))
    density = influence_density(np.sqrt(1.0 / m - 1.0)) / np.sqrt(m)
    spread = m * ellipe(m) / (3.0 * (1.0 - m))
    fits = [np.polynomial.Chebyshev.fit(m, values, _DEGREE) for values in (density, spread)]
    return np.column_stack([fit.convert(kind=np.polynomial.Polynomial).coef for fit in fits])


_EVEN, _FAR = _even_table(), _far_polynomials()


@kernel
def stretches_of(count: int, state: Memory, ends: FloatArray) -> int:
    """Stretches of adjacent strips of one width: their number; `ends` is filled with the strips behind them.

    Parameters
    ----------
    count, state
        See the map of this folder; of `state`, `NUMBER` and `WIDTH` are read.
    ends : FloatArray
        (>= count,) out.
    """
    s = shaped(state, (ROWS, CAPACITY))
    number = 0
    for j in range(1, count + 1):
        if (
            j == count
            or s[Row.NUMBER, j] != s[Row.NUMBER, j - 1] + 1.0
            or s[Row.WIDTH, j] != s[Row.WIDTH, j - 1]
        ):
            ends[number] = j
            number += 1
    return number


@inlined_kernel
def influence_of(
    k: int, stretches: int, ends: FloatArray, modulus: float, state: Memory, row: FloatArray
) -> None:
    """Displacement of all strips under a unit load of strip k [m/N], equation 1 (kernel).

    Parameters
    ----------
    k : int
        The strip.
    stretches, ends
        Of the strips with overlap (`stretches_of`).
    modulus : float
        G/(1 - nu) [Pa].
    state : memory
        (ROWS, CAPACITY): `NUMBER`, `ARC`, `WIDTH`, `HALF_LENGTH` in.
    row : FloatArray
        (>= strips with overlap + LANES,) out; what lies beyond them is written too.
    """
    s = shaped(state, (ROWS, CAPACITY))
    width, number, half_length = s[Row.WIDTH, k], s[Row.NUMBER, k], s[Row.HALF_LENGTH, k]
    factor = CENTRING * 2.0 / (math.pi * math.pi * modulus) / width
    first = 0
    for n in range(stretches):
        end = int(ends[n])
        before = s[Row.NUMBER, first] - number  # widths, from this strip to the first of the stretch
        if (
            s[Row.WIDTH, first] == width
            and half_length < _LARGEST_RATIO * width
            and -_APART < before <= _APART - (end - first)
        ):
            _even_influences(half_length, width, first, end, int(before) + _APART, factor, row)
        else:
            near = min(abs(s[Row.ARC, first] - s[Row.ARC, k]), abs(s[Row.ARC, end - 1] - s[Row.ARC, k]))
            if first <= k < end or near < max(_LEAST_T * half_length, 2.0 * width):
                _uneven_influences(k, first, end, factor, state, row)
            else:
                _far_influences(k, first, end, factor, state, row)
        first = end


@inlined_kernel
def _even_influences(
    half_length: float, width: float, first: int, end: int, column: int, factor: float, row: FloatArray
) -> None:
    """Influence on the strips first .. end - 1, equal and adjacent, the first at a column of the table.

    From Lagrange's cubic over g = (a - c w)/(a + c w), which is a logarithm of r = a/w without being one.
    """
    g = (half_length - _MIDDLE * width) / (half_length + _MIDDLE * width)
    place = (g - _FIRST) * _PER_UNIT_OF_G
    node = np.uint64(min(max(place, 1.0), _NODES - 3.0))  # by rounding, at either end
    q = place - node
    before, behind = q + 1.0, q - 1.0
    one = -factor * q * behind * (q - 2.0) * (1.0 / 6.0)
    two = 0.5 * factor * before * behind * (q - 2.0)
    three = -0.5 * factor * before * q * (q - 2.0)
    four = factor * before * q * behind * (1.0 / 6.0)
    a, b = _EVEN[node - np.uint64(1)], _EVEN[node]
    c, d = _EVEN[node + np.uint64(1)], _EVEN[node + np.uint64(2)]
    for start in range(first, end, LANES):
        set_multiples(row, start, (one, two, three, four), (a, b, c, d), column + start - first)


@kernel
def _far_influences(k: int, first: int, end: int, factor: float, state: Memory, row: FloatArray) -> None:
    """Influence of strip k on the strips first .. end - 1 of any width, all far from it (t >= `_LEAST_T`).

    Equation 2 and its second derivative, f'' = 2 E/(t^2 sqrt(1 + t^2)), by polynomials of m: f is
    sqrt(m) p(m), and its mean over a strip sqrt(m) (p(m) + (w/2a)^2 q(m)).
    """
    s = shaped(state, (ROWS, CAPACITY))
    square, place = s[Row.HALF_LENGTH, k] * s[Row.HALF_LENGTH, k], s[Row.ARC, k]
    half = 0.5 * s[Row.WIDTH, k] / s[Row.HALF_LENGTH, k]
    scale = 2.0 * half * factor
    for i in range(((end - first + LANES - 1) // LANES) * LANES):  # whole vectors
        j = np.uint64(first + i)
        distance = s[Row.ARC, j] - place
        m = square / (square + distance * distance)
        density, spread = _FAR[_DEGREE, 0], _FAR[_DEGREE, 1]
        for power in range(_DEGREE - 1, -1, -1):
            density = density * m + _FAR[power, 0]
            spread = spread * m + _FAR[power, 1]
        row[j] = scale * math.sqrt(m) * (density + half * half * spread)


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
