"""An alignment from surveyed centre-line points: smoothing to curvature.

The second derivative of surveyed points is mostly noise. So the line does not pass through the points: a
chain of clothoids, its curvature linear between knots, is fitted by least squares with a penalty on the rate
of curvature,

    minimise  sum_i w_i r_i^2 + (L / 2 pi)^6 int (d kappa / ds)^2 ds
    subject to the chain having no gap and no corner,

with r_i the distance of point i from the chain across it, w_i the length of track assigned to the point,
and L the `wavelength`: a sinusoidal deviation of that wavelength is reduced to half, one of L / 2 to 1.5 %
(the smoother's response is 1 / (1 + (L f)^6)). Straights and circular curves of any radius cost
nothing and are not biased; the ends of transitions are rounded over some L / 3. Heights are smoothed by the
same rule with the rate of the vertical curvature as penalty.

The chain itself is fitted (Gauss-Newton, all knots at once), so its integral does not drift away from the
points. The deviation of each point is returned; above `largest_deviation` it is an error.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import spsolve

from hh_exudyn.arrays import FloatArray
from hh_exudyn.conventions import GRAVITY, NOMINAL_GAUGE, RAIL_TOP_DISTANCE
from track.course.alignment import Alignment
from track.course.sections import CANT, Grade, Ramp, check

_KNOTS_PER_WAVELENGTH = 20
_STEPS = 30  # most Gauss-Newton steps; four to eight are used
_CONVERGED = 1e-8  # m
_SHARPEST_CORNER = 0.5  # rad between two knots; more means points out of order
_OFFSET = 0.5 * math.sqrt(0.6)
_GAUSS = ((0.5 - _OFFSET, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + _OFFSET, 5.0 / 18.0))


@dataclass(frozen=True)
class CentreLine:
    """A fitted alignment and its place on the map.

    Parameters
    ----------
    alignment : starts at its own origin along +X, as all alignments do
    origin : map coordinates x, y, z of that origin [m] (z = 0 where the points have no height)
    heading : direction of its +X axis on the map, from the map's x axis towards y [rad]
    s : (n,) arc length of the foot of each point [m]
    deviation : (n,) distance of each point from the line, positive to the left of it [m]
    height_deviation : (n,) height of each point over the line [m], zeros where the points have no height
    """

    alignment: Alignment
    origin: tuple[float, float, float]
    heading: float
    s: FloatArray
    deviation: FloatArray
    height_deviation: FloatArray


def fit_centre_line(
    points: FloatArray,
    wavelength: float = 80.0,
    largest_deviation: float = 0.1,
    balance_speed: float = 0.0,
    largest_cant: float = 0.150,
    gauge: float = NOMINAL_GAUGE,
) -> CentreLine:
    """The alignment along surveyed points, smoothed to curvature (see the module for the rule).

    Parameters
    ----------
    points : (n, 2) or (n, 3) x, y and height of the centre line in the order of the track [m]
    wavelength : limit below which variations of the points count as noise [m], 20 to 1000
    largest_deviation : of a point from the line, across and in height [m], 1e-3 to 10
    balance_speed : points give no cant; it is set to that of zero cant deficiency at this speed
        [m/s], 0 to 100, up to `largest_cant` [m], 0 to 0.180
    gauge : of the whole line [m]

    Raises
    ------
    ValueError
        Points that are not finite, too few, too far apart for the wavelength, or out of order; a curvature or
        gradient out of range; points farther from the line than `largest_deviation`.
    """
    check("wavelength", wavelength, (20.0, 1000.0))
    check("largest_deviation", largest_deviation, (1e-3, 10.0))
    check("balance_speed", balance_speed, (0.0, 100.0), "m/s")
    check("largest_cant", largest_cant, CANT)
    chord = _checked_chords(points, wavelength)
    h = wavelength / _KNOTS_PER_WAVELENGTH
    chain, s, deviation = _fit_plan(points[:, :2], chord, h, wavelength)
    z, gradient, height_deviation = _fit_heights(points, s, len(chain), h, wavelength)
    for name, values in (("across", deviation), ("in height", height_deviation)):
        worst = int(np.argmax(np.abs(values)))
        if abs(values[worst]) > largest_deviation:
            raise ValueError(
                f"point {worst + 1} lies {abs(values[worst]):.3g} m {name} from the smoothed line, allowed "
                f"is {largest_deviation:g} m: an outlier, or wavelength {wavelength:g} m is too long"
            )
    # the last cell ends at the last point: it is 0.1 to 1.1 knot distances long
    length = np.diff(np.append(h * np.arange(math.ceil(s[-1] / h - 0.1)), s[-1]))
    n = length.size
    share = length[-1] / h
    curvature, slope = chain[: n + 1, 3].copy(), gradient[: n + 1].copy()
    for values in (curvature, slope):
        values[n] = values[n - 1] + share * (values[n] - values[n - 1])
    balance = RAIL_TOP_DISTANCE * balance_speed**2 / GRAVITY  # no cant deficiency, EN 13803
    cant = np.clip(balance * curvature, -largest_cant, largest_cant)
    try:
        sections = tuple(
            Ramp(d, (a, b), (p, q), (gauge, gauge)) for d, a, b, p, q in _cells(length, curvature, cant)
        )
        grades = tuple(Grade(d, a, b) for d, a, b in _cells(length, slope)) if points.shape[1] == 3 else ()
    except ValueError as error:
        raise ValueError(f"{error}: the points are not of a railway, or wavelength is too short") from None
    x, y, heading = (float(value) for value in chain[0, :3])
    alignment = Alignment(sections, grades=grades)
    return CentreLine(alignment, (x, y, float(z[0])), heading, s, deviation, height_deviation)


def _cells(length: FloatArray, *knots: FloatArray) -> list[tuple[float, ...]]:
    """Per cell: its length, then the values of each quantity in `knots` at its two ends."""
    columns = [end for values in knots for end in (values[:-1].tolist(), values[1:].tolist())]
    return list(zip(length.tolist(), *columns, strict=True))


def _checked_chords(points: FloatArray, wavelength: float) -> FloatArray:
    """Distances between successive points [m]; raises ValueError as `fit_centre_line`."""
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise ValueError(f"points have shape {points.shape}, allowed are (n, 2) and (n, 3)")
    bad = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if bad.size:
        raise ValueError(f"point {bad[0] + 1} is {points[bad[0]].tolist()} m, allowed are numbers")
    chord = np.hypot(*np.diff(points[:, :2], axis=0).T)
    if chord.sum() < wavelength:
        raise ValueError(
            f"length of all points is {chord.sum():g} m, allowed are wavelength = {wavelength:g} m and more"
        )
    for i, distance in enumerate(chord):
        if not 0.01 <= distance <= 0.25 * wavelength:
            raise ValueError(
                f"distance of point {i + 1} and point {i + 2} is {distance:g} m, allowed are 0.01 m to "
                f"{0.25 * wavelength:g} m, a quarter of the wavelength"
            )
    return chord


def _fit_plan(
    points: FloatArray, chord: FloatArray, h: float, wavelength: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Chain (m, 4) of x, y, heading, curvature at knots h apart; feet (n,) and deviations (n,) of the points.

    Gauss-Newton: every step is the linear least squares problem with the chain's continuity as constraints.
    """
    s = np.concatenate([[0.0], np.cumsum(chord)])
    m = math.ceil(s[-1] / h) + 2
    chain = _first_chain(points, s, h, m)
    weight = _weights(s)
    ends, one = np.arange(m - 1), np.ones(m - 1)
    rate = _rows(4, m, (ends + 1, 3, one), (ends, 3, -one)) * math.sqrt(1.0 / h)
    for _ in range(_STEPS):
        j = np.minimum((s / h).astype(int), m - 2)
        u = s - h * j
        ahead, aside, turn = _along(chain, j, u, h)
        c, n = np.cos(chain[j, 2]), np.sin(chain[j, 2])
        offset = points - chain[j, :2] - np.column_stack([c * ahead - n * aside, n * ahead + c * aside])
        c, n = np.cos(chain[j, 2] + turn), np.sin(chain[j, 2] + turn)
        across = c * offset[:, 1] - n * offset[:, 0]
        forward = c * offset[:, 0] + n * offset[:, 1]
        late = u**3 / (6.0 * h)  # lateral displacement of the point per curvature at the next knot
        model = _rows(4, m, (j, 0, -n), (j, 1, c), (j, 2, u), (j, 3, 0.5 * u**2 - late), (j + 1, 3, late))
        joint, closing = _joints(chain, h, points[0])
        step = _constrained(model, weight, across, rate, wavelength, joint, closing, chain)
        chain = chain + step
        s = np.clip(s + forward / (1.0 - chain[j, 3] * across), 0.0, h * (m - 1))
        if max(np.abs(step[:, :2]).max(), np.abs(forward[1:]).max()) < _CONVERGED:
            return chain, s, across
    raise ValueError("no smooth line along the points was found: are they in the order of the track?")


def _joints(chain: FloatArray, h: float, start: FloatArray) -> tuple[sparse.csr_matrix, FloatArray]:
    """Constraints of a step: no gaps, no corners, the first knot abreast of the first point.

    The derivatives by the curvatures are those of a straight cell: that costs a further step, no accuracy.
    """
    m = len(chain)
    first, one = np.arange(m - 1), np.ones(m - 1)
    ahead, aside, turn = _along(chain, first, h * one, h)
    c, n = np.cos(chain[:-1, 2]), np.sin(chain[:-1, 2])
    way = np.column_stack([c * ahead - n * aside, n * ahead + c * aside, turn])
    gap = chain[1:, :3] - chain[:-1, :3] - way
    near, far = h**2 / 3.0, h**2 / 6.0  # lateral displacement of the next knot per curvature at either knot
    half = 0.5 * h * one
    zero = np.zeros(1, dtype=int)
    joint = sparse.vstack([
        _rows(4, m, (first + 1, 0, one), (first, 0, -one), (first, 2, way[:, 1]),
              (first, 3, near * n), (first + 1, 3, far * n)),
        _rows(4, m, (first + 1, 1, one), (first, 1, -one), (first, 2, -way[:, 0]),
              (first, 3, -near * c), (first + 1, 3, -far * c)),
        _rows(4, m, (first + 1, 2, one), (first, 2, -one), (first, 3, -half), (first + 1, 3, -half)),
        _rows(4, m, (zero, 0, c[:1]), (zero, 1, n[:1])),
    ])  # fmt: skip
    offset = c[0] * (start[0] - chain[0, 0]) + n[0] * (start[1] - chain[0, 1])
    return joint, np.append(-gap.T.ravel(), offset)


def _fit_heights(
    points: FloatArray, s: FloatArray, m: int, h: float, wavelength: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Height [m] and gradient at m knots, and the deviations of the points [m]; zeros without heights."""
    state = np.zeros((m, 2))
    if points.shape[1] == 2:
        return state[:, 0], state[:, 1], np.zeros(s.size)
    j = np.minimum((s / h).astype(int), m - 2)
    u = s - h * j
    late = 0.5 * u**2 / h
    model = _rows(2, m, (j, 0, np.ones(s.size)), (j, 1, u - late), (j + 1, 1, late))
    first = np.arange(m - 1)
    one = np.ones(m - 1)
    half = -0.5 * h * one
    joint = _rows(2, m, (first + 1, 0, one), (first, 0, -one), (first, 1, half), (first + 1, 1, half))
    inner = first[1:]
    two = np.ones(m - 2)
    bend = _rows(2, m, (inner - 1, 1, two), (inner, 1, -2.0 * two), (inner + 1, 1, two)) * math.sqrt(h**-3)
    level = points[0, 2]
    over = points[:, 2] - level
    state = _constrained(model, _weights(s), over, bend, wavelength, joint, np.zeros(m - 1), state)
    return state[:, 0] + level, state[:, 1], over - model @ state.ravel()


def _constrained(
    model: sparse.csr_matrix,
    weight: FloatArray,
    target: FloatArray,
    penalty: sparse.csr_matrix,
    wavelength: float,
    joint: sparse.csr_matrix,
    closing: FloatArray,
    now: FloatArray,
) -> FloatArray:
    """The step d that minimises |model d - target|^2 (weighted) + penalty of now + d, with joint d = closing.

    Solved by the Lagrange equations, which are sparse.
    """
    stiff = (wavelength / (2.0 * math.pi)) ** 6 * (penalty.T @ penalty)
    weighted = model.T @ sparse.diags(weight)
    matrix = sparse.bmat([[weighted @ model + stiff, joint.T], [joint, None]], format="csc")
    right = np.concatenate([weighted @ target - stiff @ now.ravel(), closing])
    solution: FloatArray = spsolve(matrix, right)[: now.size].reshape(now.shape)
    return solution


def _rows(width: int, m: int, *entries: tuple[NDArray[np.int64], int, FloatArray]) -> sparse.csr_matrix:
    """Sparse rows with the values of `entries` (knot, component, value) in the columns of m knots."""
    count = entries[0][0].size
    row = np.tile(np.arange(count), len(entries))
    column = np.concatenate([width * knot + component for knot, component, _ in entries])
    value = np.concatenate([values for _, _, values in entries])
    return sparse.csr_matrix((value, (row, column)), shape=(count, width * m))


def _along(
    chain: FloatArray, j: NDArray[np.int64], u: FloatArray, h: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Displacement forward, left [m] and turn [rad] from knots j to u metres beyond (three Gauss points)."""
    curvature = chain[j, 3]
    bend = (chain[j + 1, 3] - curvature) / (2.0 * h)
    ahead, aside = np.zeros(u.size), np.zeros(u.size)
    for place, share in _GAUSS:
        turn = curvature * (place * u) + bend * (place * u) ** 2
        ahead += share * u * np.cos(turn)
        aside += share * u * np.sin(turn)
    return ahead, aside, curvature * u + bend * u**2


def _first_chain(points: FloatArray, s: FloatArray, h: float, m: int) -> FloatArray:
    """Chain with its knots on the chords of the points; beyond the last point it is straight."""
    at = h * np.arange(m)
    x, y = (np.interp(at, s, points[:, k]) for k in range(2))
    inside = int(np.searchsorted(at, s[-1], side="right"))
    heading = np.unwrap(np.arctan2(np.diff(y[:inside]), np.diff(x[:inside])))
    corner = np.abs(np.diff(heading))
    if corner.size and corner.max() > _SHARPEST_CORNER:
        raise ValueError(
            f"the points turn by {corner.max():.2g} rad near s = {h * (corner.argmax() + 1):g} m, allowed is "
            f"{_SHARPEST_CORNER:g} rad over {h:g} m: are they in the order of the track?"
        )
    middle = at[: inside - 1] + 0.5 * h
    heading = np.interp(at, middle, heading)
    behind = at[inside:] - at[inside - 1]
    x[inside:] = x[inside - 1] + behind * math.cos(heading[inside - 1])
    y[inside:] = y[inside - 1] + behind * math.sin(heading[inside - 1])
    return np.column_stack([x, y, heading, np.gradient(heading, h)])


def _weights(s: FloatArray) -> FloatArray:
    """Length of track assigned to each point [m]."""
    chord = np.diff(s)
    return 0.5 * (np.append(chord, chord[-1]) + np.insert(chord, 0, chord[0]))
