"""Steady rolling of two half-spaces: tractions and slip, by a Newton method on Coulomb's law.

Find q with |q| <= g, g = friction times pressure, and the slip s = w + C q over V (`influence`) zero where
|q| < g and against q where |q| = g. That is q = P(q - t s) for any t > 0, P the nearest point of the disc of
radius g: the natural map of a variational inequality (Kalker 1990, section 4.2). Because C's symmetric part
is not negative (minus the second difference of a displacement that falls off on both sides) there is one
solution only.

Each Newton step is made for C + tau own I instead of C: as if the traction could only creep from its last
value, tau falling with the residual (pseudo-transient continuation; C.T. Kelley and D.E. Keyes, SIAM J.
Numer. Anal. 35, 1998). Without it active sets cycle. The step is linear in the elements that stick (s = 0)
and along the circle in those that slip; GMRES solves it, preconditioned where they stick by the inverse of a
circulant of the grid's size, antiperiodic along x (periodic ones are singular: a traction that is constant
along x makes no slip), and where they slip by the diagonal.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from scipy import fft

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.halfspace.influence import Influence, lag_integrals
from hh_exudyn.contact.halfspace.krylov import gmres
from hh_exudyn.kernel import allocating_kernel, kernel

TOLERANCE = 1e-4  # of the largest bound
_MOST_STEPS = 200
_MOST_DIRECTIONS = 30  # of one linear step
_LINEAR_TOLERANCE = 0.2  # of a linear step: more exact ones save no steps, but cost
_FIRST_SHIFT, _LARGEST_SHIFT = 6.0, 10.0  # tau over the mean residual at the start; its bound
_TINY = 1e-300  # against 0/0
_SPIN_SHIFT = 1.0 / 6.0  # of an element, at which the rigid slip of spin is taken, after CONTACT


@dataclass(frozen=True)
class RollingSolution:
    """Tractions and slip of a rolling contact.

    Attributes
    ----------
    traction : ndarray, (2, ny, nx)
        On the wheel, along x and across [Pa].
    slip : ndarray, (2, ny, nx)
        Slip velocity of the wheel relative to the rail over V [-] at the elements' centres, against the
        traction; zero in stick and outside.
    stick : ndarray of bool, (ny, nx)
        Elements in contact that do not slip.
    force : tuple of float
        F_x, F_y on the wheel [N].
    moment : float
        About the normal through the grid's middle [N m].
    dissipation : float
        Energy that friction takes per metre of rolling [N], >= 0: at 40 elements along the patch within 4 %
        of the power of the creepages.
    residual : float
        Largest |q - P(q - s/own)| over the largest bound [-]: how far Coulomb's law, stick or the direction
        of slip are from being met anywhere.
    iterations : int
        Newton steps.
    """

    traction: FloatArray
    slip: FloatArray
    stick: Any
    force: tuple[float, float]
    moment: float
    dissipation: float
    residual: float
    iterations: int


@lru_cache(maxsize=128)
def _circulant(nx: int, ny: int, ratio: float, poisson_ratio: float) -> tuple[Any, Any]:
    """Eigenvalues (2, rows, columns) per 1/(pi G) of the preconditioner, and the half turn along x."""
    rows, columns = fft.next_fast_len(ny), fft.next_fast_len(nx)
    half_x, half_y = columns // 2, rows // 2
    lag_x, lag_y = np.arange(-half_x, columns - half_x), np.arange(-half_y, rows - half_y)
    reach = half_y + 1
    found = lag_integrals(-half_x, columns + 1, reach, ratio)
    inverse, of_x, of_y, _ = found[:, reach - 1 + lag_y[0] : reach + lag_y[-1]]
    half_turn = np.exp(1j * np.pi * lag_x / columns)
    placed = np.zeros((2, rows, columns), dtype=complex)
    for place, own in zip(placed, (of_x, of_y), strict=True):
        influence = (1.0 - poisson_ratio) * inverse + poisson_ratio * own
        place[np.ix_(lag_y % rows, lag_x % columns)] = (influence[:, :-1] - influence[:, 1:]) * half_turn
    return fft.fft2(placed), np.exp(1j * np.pi * np.arange(nx) / columns)


@kernel
def _residual(traction: FloatArray, slip: FloatArray, bound: FloatArray, step: float) -> tuple[float, float]:
    """Largest and summed length of q - P(q - step s)."""
    worst, total = 0.0, 0.0
    for i in range(bound.size):
        if bound[i] > 0.0:
            q_x, q_y = traction[0, i], traction[1, i]
            z_x, z_y = q_x - step * slip[0, i], q_y - step * slip[1, i]
            length = np.sqrt(z_x * z_x + z_y * z_y)
            factor = bound[i] / length if length > bound[i] else 1.0
            off = np.sqrt((q_x - factor * z_x) ** 2 + (q_y - factor * z_y) ** 2)
            worst = max(worst, off)
            total += off
    return worst, total


@kernel
def _linearise(
    traction: FloatArray, slip: FloatArray, bound: FloatArray, step: float, shift: float,
    kind: FloatArray, tangent: FloatArray, diagonal: FloatArray, fixed: FloatArray, right: FloatArray,
) -> None:  # fmt: skip
    """The Newton step's parts, ten arguments: its inputs and what it fills.

    `kind` 1 stick, -1 slip, 0 no contact; `tangent` along the circle; `diagonal` shift and, in slip, the
    slip over the bound; `fixed` the change of traction back to the circle; `right` the right side without
    what `fixed` does to the slip.
    """
    for i in range(bound.size):
        kind[i], diagonal[i] = 0.0, shift
        tangent[0, i] = tangent[1, i] = fixed[0, i] = fixed[1, i] = right[0, i] = right[1, i] = 0.0
        g = bound[i]
        if not g > 0.0:
            continue
        q_x, q_y = traction[0, i], traction[1, i]
        z_x, z_y = q_x - step * slip[0, i], q_y - step * slip[1, i]
        length = np.sqrt(z_x * z_x + z_y * z_y)
        if length <= g:
            kind[i] = 1.0
            right[0, i], right[1, i] = -slip[0, i], -slip[1, i]
            continue
        kind[i] = -1.0
        n_x, n_y = z_x / length, z_y / length
        tangent[0, i], tangent[1, i] = -n_y, n_x
        diagonal[i] += (length - g) / (g * step)
        along = g - (q_x * n_x + q_y * n_y)
        fixed[0, i], fixed[1, i] = along * n_x, along * n_y
        across = -(length / (g * step)) * (-q_x * n_y + q_y * n_x)
        right[0, i], right[1, i] = -across * n_y, across * n_x


@allocating_kernel
def _restrict(
    slip: FloatArray, change: FloatArray, kind: FloatArray, tangent: FloatArray, diagonal: FloatArray
) -> FloatArray:
    """slip + diagonal change in stick, its part along the circle in slip, nothing outside."""
    result = np.zeros(change.shape)
    for i in range(kind.size):
        if kind[i] == 0.0:
            continue
        x, y = slip[0, i] + diagonal[i] * change[0, i], slip[1, i] + diagonal[i] * change[1, i]
        if kind[i] < 0.0:
            along = x * tangent[0, i] + y * tangent[1, i]
            x, y = along * tangent[0, i], along * tangent[1, i]
        result[0, i], result[1, i] = x, y
    return result


@kernel
def _advance(traction: FloatArray, first: FloatArray, second: FloatArray, bound: FloatArray) -> None:
    """Add both changes and go to the nearest point of the discs, in place."""
    for i in range(bound.size):
        x, y = traction[0, i] + first[0, i] + second[0, i], traction[1, i] + first[1, i] + second[1, i]
        length = np.sqrt(x * x + y * y)
        factor = bound[i] / length if length > bound[i] else 1.0
        traction[0, i], traction[1, i] = factor * x, factor * y


def rigid_slip(influence: Influence, nu_x: float, nu_y: float, phi: float) -> FloatArray:
    """Rigid slip over V of a plane patch, (2, ny, nx) [-].

    Spin is taken a sixth of an element ahead of its centre, as CONTACT does: at 40 elements along the patch
    this halves the error that the grid makes in the force.

    Parameters
    ----------
    influence : Influence
        The grid.
    nu_x, nu_y : float
        Creepages of the wheel relative to the rail at the grid's middle [-].
    phi : float
        Spin creepage [1/m].
    """
    grid = influence.grid
    slip = np.empty((2, *grid.shape))
    slip[0] = (nu_x - phi * grid.y)[:, None]
    slip[1] = nu_y + phi * (grid.x + _SPIN_SHIFT * grid.dx)
    return slip


class _Preconditioner:
    """Approximate inverse of a Newton step's matrix."""

    def __init__(self, influence: Influence) -> None:
        grid = influence.grid
        eigenvalues, self._turn = _circulant(
            grid.nx, grid.ny, grid.dy / grid.dx, influence.material.poisson_ratio
        )
        self._eigenvalues = eigenvalues * influence.flexibility
        self._back = self._turn.conj()
        self._own, self._grid = influence.own_slip, grid

    def prepare(self, shift: float, kind: FloatArray, tangent: FloatArray, diagonal: FloatArray) -> None:
        """Take the parts of a step."""
        shape = self._grid.shape
        self._inverse = 1.0 / (self._eigenvalues + shift)
        self._stick = (kind > 0.0).astype(np.float64).reshape(shape)
        own = self._own[0] * tangent[0] ** 2 + self._own[1] * tangent[1] ** 2
        self._slip = np.where(kind < 0.0, 1.0 / (own + diagonal), 0.0).reshape(shape)
        self._sticks = bool(self._stick.any())

    def __call__(self, vector: FloatArray) -> FloatArray:
        """Of a vector (2, ny, nx) that lies along the circle in slip."""
        result = vector * self._slip
        if self._sticks:
            rows, columns = self._inverse.shape[1:]
            ny, nx = self._grid.shape
            transform = fft.fft2(vector * (self._stick * self._turn), s=(rows, columns), overwrite_x=True)
            transform *= self._inverse
            back = fft.ifft2(transform, overwrite_x=True)[:, :ny, :nx]
            result += (back * self._back).real * self._stick
        return result


def _check(influence: Influence, bound: FloatArray, slip: FloatArray, start: FloatArray | None) -> None:
    """ValueError for anything out of range."""
    shape = influence.grid.shape
    if bound.shape != shape or slip.shape != (2, *shape):
        raise ValueError(
            f"bound {bound.shape}, rigid slip {slip.shape}: "
            f"arrays of shapes {shape} and {(2, *shape)} are needed"
        )
    if not (np.all(np.isfinite(bound)) and np.all(bound >= 0.0)):
        raise ValueError("bound, the friction times the pressure, must be finite and >= 0 Pa in all elements")
    if not np.all(np.isfinite(slip)):
        raise ValueError("rigid slip must be finite [-] in all elements")
    if start is not None and (start.shape != (2, *shape) or not np.all(np.isfinite(start))):
        raise ValueError(f"start {start.shape}: finite tractions [Pa] of shape {(2, *shape)} are needed")


def rolling_contact(
    influence: Influence,
    bound: FloatArray,
    slip: FloatArray,
    *,
    start: FloatArray | None = None,
    tolerance: float = TOLERANCE,
) -> RollingSolution:
    """Tractions and slip in steady rolling along +x, by the Newton method of the head of this file.

    With the pressure of `normal.normal_contact` in the bound it is Kalker's full theory (1990).

    Parameters
    ----------
    influence, start, tolerance
        As of `normal.normal_contact`; the start is a traction (2, ny, nx), the tolerance is of the largest
        residual (see `RollingSolution`).
    bound : ndarray, (ny, nx)
        Friction coefficient times pressure [Pa], >= 0; zero outside the contact.
    slip : ndarray, (2, ny, nx)
        Rigid slip over V of every element [-], of the wheel relative to the rail: `rigid_slip` in a plane
        patch, and any field where the creepages vary over a curved one.

    Errors are those of `normal.normal_contact`.
    """
    bound = np.ascontiguousarray(bound, dtype=np.float64)
    rigid = np.ascontiguousarray(slip, dtype=np.float64)
    _check(influence, bound, rigid, start)
    traction = np.zeros(rigid.shape) if start is None else np.array(start, dtype=np.float64)
    nothing = np.zeros((2, bound.size))
    limits = bound.ravel()
    _advance(traction.reshape(2, -1), nothing, nothing, limits)
    residual, steps = 0.0, 0
    if limits.any():
        residual, steps = _newton(influence, limits, rigid, traction, tolerance)
    return _solution(influence, limits, rigid, traction, residual, steps)


def _newton(
    influence: Influence, bound: FloatArray, rigid: FloatArray, traction: FloatArray, tolerance: float
) -> tuple[float, int]:
    """The steps of `rolling_contact`, in place: residual and number."""
    shape, count = rigid.shape, bound.size
    q = traction.reshape(2, count)
    own = max(influence.own_slip)
    largest, total = bound.max(), bound.sum()
    kind, diagonal = np.empty(count), np.empty(count)
    tangent, fixed, right = np.empty((3, 2, count))
    precondition = _Preconditioner(influence)

    def operator(change: FloatArray) -> FloatArray:
        effect = influence.slip(change).reshape(2, count)
        return _restrict(effect, change.reshape(2, count), kind, tangent, diagonal).reshape(shape)

    tau, last, worst = 0.0, np.inf, np.inf
    for steps in range(_MOST_STEPS):
        s = (rigid + influence.slip(traction)).reshape(2, count)
        worst, mean = _residual(q, s, bound, 1.0 / own)
        if worst <= tolerance * largest:
            return worst / largest, steps
        mean /= total
        tau = _FIRST_SHIFT * mean if steps == 0 else tau * (mean / last if mean < last else 2.0)
        tau, last = min(tau, _LARGEST_SHIFT), mean
        shift = tau * own
        _linearise(q, s, bound, 1.0 / (own * (1.0 + tau)), shift, kind, tangent, diagonal, fixed, right)
        if fixed.any():
            effect = influence.slip(fixed.reshape(shape)).reshape(2, count)
            right -= _restrict(effect, np.zeros(fixed.shape), kind, tangent, diagonal)
        precondition.prepare(shift, kind, tangent, diagonal)
        change, _ = gmres(operator, precondition, right.reshape(shape), _LINEAR_TOLERANCE, _MOST_DIRECTIONS)
        _advance(q, fixed, change.reshape(2, count), bound)
    raise ArithmeticError(f"rolling contact: residual {worst / largest:.1e} after {_MOST_STEPS} Newton steps")


def _solution(
    influence: Influence,
    bound: FloatArray,
    rigid: FloatArray,
    traction: FloatArray,
    residual: float,
    steps: int,
) -> RollingSolution:
    """What follows from the traction."""
    grid, shape = influence.grid, influence.grid.shape
    g = bound.reshape(shape)
    reach = traction - (rigid + influence.slip(traction)) / max(influence.own_slip)
    stick = (g > 0.0) & (np.hypot(reach[0], reach[1]) <= g)
    direction = traction / np.maximum(np.hypot(traction[0], traction[1]), _TINY)
    against = np.sum(direction * (rigid + influence.slip_at_centres(traction)), axis=0)
    slip = direction * np.where(stick | (g == 0.0), 0.0, np.minimum(against, 0.0))
    force_x, force_y = (float(part.sum()) * grid.area for part in traction)
    moment = float(np.sum(grid.x * traction[1]) - np.sum(grid.y[:, None] * traction[0])) * grid.area
    dissipation = -float(np.sum(traction * slip)) * grid.area
    return RollingSolution(
        traction, slip, stick, (force_x, force_y), moment, dissipation, float(residual), steps
    )
