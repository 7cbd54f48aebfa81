"""Normal contact of two half-spaces: the pressure that keeps them apart, by conjugate gradients with bounds.

Find 0 <= p <= limit so that the gap g = A p - h - delta e is zero where 0 < p < limit, not negative where
p = 0 and not positive where p = limit. A is the influence of the pressure, h the undeformed overlap, delta
the approach, given or following from the load L = sum of p e times the area of an element; e is 1, or the
share of an element's normal in the direction of approach and load.

I.A. Polonsky, L.M. Keer, Wear 231 (1999) 206-219; E.A.H. Vollebregt, J. Tribology 136 (2014) 041401. Ours
are the upper bound, at which an element is held like one at p = 0, and the weights e.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.halfspace.influence import Grid, Influence
from hh_exudyn.kernel import kernel

_MOST_ITERATIONS = 2000  # far more than ever needed; reaching it is an error
TOLERANCE = 1e-5  # of the largest displacement


@dataclass(frozen=True)
class NormalSolution:
    """Pressure between two bodies.

    Attributes
    ----------
    pressure : ndarray, (ny, nx)
        [Pa]
    approach : float
        That the overlap was enlarged by [m].
    load : float
        Sum of pressure, weight and area [N].
    residual : float
        Largest violation of a condition for the gap, over the largest displacement [-].
    iterations : int
        Of the conjugate gradients.
    """

    pressure: FloatArray
    approach: float
    load: float
    residual: float
    iterations: int


@kernel
def _approach_of_free(
    pressure: FloatArray, displacement: FloatArray, overlap: FloatArray, weight: FloatArray, limit: float
) -> float:
    """The approach for which the weighted gap of the elements between the bounds is zero in the sum."""
    above, below = 0.0, 0.0
    for i in range(pressure.size):
        if 0.0 < pressure[i] < limit:
            above += weight[i] * (displacement[i] - overlap[i])
            below += weight[i] * weight[i]
    return above / below if below > 0.0 else np.nan


@kernel
def _find_free(
    pressure: FloatArray,
    displacement: FloatArray,
    overlap: FloatArray,
    weight: FloatArray,
    limit: float,
    approach: float,
    free: FloatArray,
    gap: FloatArray,
) -> tuple[float, float, bool]:
    """Gaps of the elements that may move; largest of them, largest displacement, whether others are free now.

    Gap is zero where the element is held at a bound by the gap's sign.
    """
    worst, largest, changed = 0.0, 0.0, False
    for i in range(pressure.size):
        g = displacement[i] - overlap[i] - approach * weight[i]
        held = (pressure[i] <= 0.0 and g >= 0.0) or (pressure[i] >= limit and g <= 0.0)
        now = 0.0 if held else 1.0
        if now != free[i]:
            changed = True
            free[i] = now
        gap[i] = g * now
        worst = max(worst, abs(gap[i]))
        largest = max(largest, abs(displacement[i]))
    return worst, largest, changed


@kernel
def _direction(gap: FloatArray, last_gap: FloatArray, direction: FloatArray, restart: bool) -> None:
    """The next direction (Polak and Ribiere), in place; the gap becomes the last gap."""
    above, below = 0.0, 0.0
    for i in range(gap.size):
        above += gap[i] * (gap[i] - last_gap[i])
        below += last_gap[i] * last_gap[i]
    factor = 0.0 if restart or below == 0.0 else max(above / below, 0.0)
    for i in range(gap.size):
        direction[i] = gap[i] + factor * direction[i]
        last_gap[i] = gap[i]


@kernel
def _move(
    pressure: FloatArray,
    displacement: FloatArray,
    gap: FloatArray,
    direction: FloatArray,
    effect: FloatArray,
    limit: float,
) -> bool:
    """Go along the direction to the least energy; whether a bound was met (then the displacement is old)."""
    above, below = 0.0, 0.0
    for i in range(pressure.size):
        above += gap[i] * direction[i]
        below += direction[i] * effect[i]
    step = above / below if below > 0.0 else 0.0
    met = False
    for i in range(pressure.size):
        moved = pressure[i] - step * direction[i]
        pressure[i] = min(max(moved, 0.0), limit)
        met |= pressure[i] != moved
        displacement[i] -= step * effect[i]
    return met


@kernel
def _carry(pressure: FloatArray, weight: FloatArray, load_over_area: float) -> bool:
    """Scale the pressures so that they carry the load; whether anything changed."""
    total = 0.0
    for i in range(pressure.size):
        total += weight[i] * pressure[i]
    factor = load_over_area / total
    if abs(factor - 1.0) < 1e-14:
        return False
    for i in range(pressure.size):
        pressure[i] *= factor
    return True


def quadratic_overlap(grid: Grid, curvature_x: float, curvature_y: float) -> FloatArray:
    """Overlap of Hertzian bodies that just touch, -A x^2 - B y^2 [m], (ny, nx).

    Parameters
    ----------
    grid : Grid
        The elements.
    curvature_x, curvature_y : float
        A and B, half the sums of the principal curvatures [1/m].
    """
    overlap: FloatArray = -curvature_x * grid.x[None, :] ** 2 - curvature_y * grid.y[:, None] ** 2
    return overlap


def _first_guess(
    influence: Influence, overlap: FloatArray, weight: FloatArray, approach: float | None
) -> FloatArray:
    """A pressure of about the right shape: the root of the overlap, with half of the grid under a load."""
    if approach is None:
        approach = -float(np.median(overlap / weight))
    total = np.maximum(overlap + approach * weight, 0.0)
    pressure: FloatArray = np.sqrt(total)
    if not pressure.any():  # no contact, or a flat overlap
        return pressure
    return pressure * (0.6 * total.max() / influence.normal(pressure).max())


def _check_arrays(
    influence: Influence, overlap: FloatArray, weight: FloatArray, start: FloatArray | None
) -> None:
    """ValueError for an array of another shape, or with values out of range."""
    if overlap.shape != influence.grid.shape or weight.shape != influence.grid.shape:
        raise ValueError(
            f"overlap {overlap.shape}: an array of the grid's shape {influence.grid.shape} is needed"
        )
    if not (np.all(np.isfinite(overlap)) and np.all(weight > 0.0)):
        raise ValueError("overlap must be finite [m] and weight > 0 in all elements")
    if start is not None and (start.shape != overlap.shape or not np.all(start >= 0.0)):
        raise ValueError(f"start {start.shape}: pressures >= 0 Pa of the grid's shape are needed")


def _check_numbers(approach: float | None, load: float | None, limit: float, most: float) -> None:
    """ValueError for a number out of range; `most` is what the grid carries at the limit [N]."""
    if (approach is None) == (load is None):
        raise ValueError(f"approach = {approach} m, load = {load} N: one of both is needed")
    if approach is not None and not np.isfinite(approach):
        raise ValueError(f"approach = {approach} m; it must be finite")
    if not limit > 0.0:
        raise ValueError(f"limit = {limit} Pa; it must be > 0 Pa")
    if load is not None and not 0.0 < load < most:
        raise ValueError(f"load = {load} N; it must lie in 0..{most} N, what the grid carries at the limit")


def normal_contact(
    influence: Influence,
    overlap: FloatArray,
    *,
    approach: float | None = None,
    load: float | None = None,
    weight: FloatArray | None = None,
    limit: float = np.inf,
    start: FloatArray | None = None,
    tolerance: float = TOLERANCE,
) -> NormalSolution:
    """Pressure between two bodies of any shape, at a given approach or under a given load.

    By the conjugate gradients of Polonsky and Keer (1999) with an upper bound, see the head of this file.

    Parameters
    ----------
    influence : Influence
        Grid and material.
    overlap : ndarray, (ny, nx)
        How far the undeformed bodies overlap at approach 0, negative where they are apart [m].
    approach : float, optional
        By which they come nearer [m]. Either this or the load is given.
    load : float, optional
        Normal force [N], > 0.
    weight : ndarray, (ny, nx), optional
        Share of every element's normal in the direction of approach and load [-], > 0; one without it.
    limit : float
        Upper bound of the pressure [Pa], > 0: hardness, in a plastic contact.
    start : ndarray, (ny, nx), optional
        A pressure to start from [Pa], of a similar contact.
    tolerance : float
        Largest violation of a condition, over the largest displacement [-].

    Returns
    -------
    NormalSolution

    Raises
    ------
    ValueError
        For an argument out of range.
    ArithmeticError
        Without convergence.
    """
    overlap = np.ascontiguousarray(overlap, dtype=np.float64)
    weights = np.ones(overlap.shape) if weight is None else np.ascontiguousarray(weight, dtype=np.float64)
    _check_arrays(influence, overlap, weights, start)
    _check_numbers(approach, load, limit, limit * influence.grid.area * float(weights.sum()))
    if start is not None and start.any():
        pressure = np.array(start, dtype=np.float64)
    else:
        pressure = _first_guess(influence, overlap, weights, approach)
        if load is not None and not pressure.any():
            pressure = np.ones(overlap.shape)
    if load is None:
        pressure = np.minimum(pressure, limit)
        return _solve(influence, overlap, weights, approach, None, limit, pressure, tolerance)
    free = _solve(influence, overlap, weights, None, load, np.inf, pressure, tolerance)
    if free.pressure.max() <= limit:
        return free
    return _under_limit(influence, overlap, weights, load, limit, free, tolerance)


def _under_limit(
    influence: Influence,
    overlap: FloatArray,
    weight: FloatArray,
    load: float,
    limit: float,
    free: NormalSolution,
    tolerance: float,
) -> NormalSolution:
    """The approach at which the bounded pressure carries the load; from the solution without a limit.

    The load grows with the approach, by no more than it does where nothing is at the limit.
    """
    found = replace(free, pressure=np.minimum(free.pressure, limit))

    def excess(approach: float) -> float:
        nonlocal found
        found = _solve(influence, overlap, weight, approach, None, limit, found.pressure.copy(), tolerance)
        return found.load - load

    low, step = free.approach, 0.05 * float(influence.normal(free.pressure).max())
    high = low + step
    while excess(high) < 0.0:
        low, step = high, 2.0 * step
        high = low + step
    brentq(excess, low, high, xtol=1e-6 * step, rtol=1e-12)
    return found


def _solve(
    influence: Influence,
    overlap: FloatArray,
    weight: FloatArray,
    approach: float | None,
    load: float | None,
    limit: float,
    pressure: FloatArray,
    tolerance: float,
) -> NormalSolution:
    """The iterations of `normal_contact`; eight arguments, its own."""
    area = influence.grid.area
    p, h, e = pressure.ravel(), overlap.ravel(), weight.ravel()
    free, gap, last_gap, direction = np.full(p.size, 2.0), *np.zeros((3, p.size))
    shape = influence.grid.shape
    carried = 0.0 if load is None else load / area
    delta = np.nan if approach is None else approach
    fresh = True
    worst, largest = np.inf, 0.0
    for iteration in range(_MOST_ITERATIONS):
        if load is not None:
            fresh |= _carry(p, e, carried)
        if fresh:
            u = influence.normal(p.reshape(shape)).ravel()
        if load is not None:
            delta = _approach_of_free(p, u, h, e, limit)
        worst, largest, changed = _find_free(p, u, h, e, limit, delta, free, gap)
        if worst <= tolerance * largest or (largest == 0.0 and worst == 0.0):
            break
        _direction(gap, last_gap, direction, changed or (fresh and iteration == 0))
        effect = influence.normal(direction.reshape(shape)).ravel()
        fresh = _move(p, u, gap, direction, effect, limit)
    else:
        raise ArithmeticError(f"normal contact: residual {worst / largest:.1e} after {iteration} iterations")
    residual = worst / largest if largest > 0.0 else 0.0
    total = float(np.dot(p, e)) * area
    return NormalSolution(p.reshape(shape), float(delta), total, float(residual), iteration)
