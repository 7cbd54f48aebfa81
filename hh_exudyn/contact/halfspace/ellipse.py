"""The half-space solution of a Hertzian ellipse in steady rolling: the theory "halfspace" of `tangential`.

The ellipse lies in a box of 2 a by 2 b with the given numbers of elements; pressure is Hertz's at their
centres, scaled to carry the normal force. The force is extrapolated from this grid and one of half as many
elements, since its error is proportional to their size (`tangential.validation` says how small it gets);
stresses and slip are those of the finer grid.

All is solved for a y > 0 creepage (or spin) in units of the ellipse, so that mirrored and scaled cases have
results that are mirrored and scaled.
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.halfspace.influence import Grid, Influence
from hh_exudyn.contact.halfspace.rolling import RollingSolution, rigid_slip, rolling_contact
from hh_exudyn.contact.material import Material
from hh_exudyn.contact.types import Fields, RollingPatch, Triple

_TOLERANCE = 1e-5  # of the rolling solution
_LEAST_EXTRAPOLATED = 6  # elements along an axis: fewer are no grid to extrapolate from


def hertz_pressure(influence: Influence, a: float, b: float, normal_force: float) -> FloatArray:
    """Hertz's pressure at the centres of a grid's elements, scaled to carry the force, (ny, nx) [Pa]."""
    grid = influence.grid
    inside = 1.0 - (grid.x[None, :] / a) ** 2 - (grid.y[:, None] / b) ** 2
    pressure = np.sqrt(np.maximum(inside, 0.0))
    scaled: FloatArray = pressure * (normal_force / (pressure.sum() * grid.area))
    return scaled


def _influence(patch: RollingPatch, cells: tuple[int, int]) -> Influence:
    """The grid of a patch."""
    grid = Grid(cells[0], cells[1], 2.0 * patch.a / cells[0], 2.0 * patch.b / cells[1])
    return Influence(grid, Material(patch.shear_modulus, patch.poisson_ratio))


def _solve(patch: RollingPatch, cells: tuple[int, int], start: FloatArray | None) -> RollingSolution:
    """The patch (in its own units) on one grid, from tractions over their bound on another."""
    influence = _influence(patch, cells)
    bound = patch.friction * hertz_pressure(influence, patch.a, patch.b, patch.normal_force)
    traction = None
    if start is not None:
        rows = np.arange(cells[1]) * start.shape[1] // cells[1]
        columns = np.arange(cells[0]) * start.shape[2] // cells[0]
        traction = bound * start[:, rows[:, None], columns]
    slip = rigid_slip(influence, patch.nu_x, patch.nu_y, patch.phi)
    return rolling_contact(influence, bound, slip, start=traction, tolerance=_TOLERANCE)


def _share(patch: RollingPatch, solution: RollingSolution) -> FloatArray:
    """Tractions over their bound, zero outside of the ellipse."""
    ny, nx = solution.stick.shape
    bound = patch.friction * hertz_pressure(_influence(patch, (nx, ny)), patch.a, patch.b, patch.normal_force)
    share: FloatArray = np.where(bound > 0.0, solution.traction / np.where(bound > 0.0, bound, 1.0), 0.0)
    return share


def _own_units(patch: RollingPatch) -> tuple[RollingPatch, float, float, bool]:
    """The patch with c = sqrt(a b) = 1 and p0 = 1; c [m], p0 [Pa], and whether it was mirrored."""
    size = math.sqrt(patch.a * patch.b)
    pressure = 1.5 * patch.normal_force / (math.pi * patch.a * patch.b)
    mirrored = patch.nu_y < 0.0 or (patch.nu_y == 0.0 and patch.phi < 0.0)
    sign = -1.0 if mirrored else 1.0
    own = patch._replace(
        a=patch.a / size,
        b=patch.b / size,
        normal_force=math.pi / 1.5,
        nu_y=sign * patch.nu_y,
        phi=sign * patch.phi * size,
        shear_modulus=patch.shear_modulus / pressure,
    )
    return own, size, pressure, mirrored


def solve_ellipse(
    patch: RollingPatch, cells: tuple[int, int]
) -> tuple[RollingSolution, RollingSolution | None]:
    """Solutions on the given grid and on half of it (None for grids too small), in units of the patch."""
    halves = (max((cells[0] + 1) // 2, 1), max((cells[1] + 1) // 2, 1))
    if min(cells) < _LEAST_EXTRAPOLATED:
        return _solve(patch, cells, None), None
    coarse = _solve(patch, halves, None)
    return _solve(patch, cells, _share(patch, coarse)), coarse


def ellipse_force(patch: RollingPatch, cells: tuple[int, int]) -> Triple:
    """Creep force and moment on the wheel, extrapolated to elements of no size: F_x, F_y [N], M_z [N m].

    Parameters
    ----------
    patch : RollingPatch
        With normal force, area, friction and creepage.
    cells : tuple of int
        Elements along x and across y.
    """
    own, size, pressure, mirrored = _own_units(patch)
    fine, coarse = solve_ellipse(own, cells)
    result = np.array([*fine.force, fine.moment])
    if coarse is not None:
        ratio = math.sqrt(math.prod(cells) / math.prod(coarse.stick.shape))
        result = result + (result - np.array([*coarse.force, coarse.moment])) / (ratio - 1.0)
        limit = own.friction * own.normal_force
        length = math.hypot(result[0], result[1])
        if length > limit:
            result[:2] *= limit / length
    if mirrored:
        result[1:] = -result[1:]
    force = pressure * size**2
    return float(result[0]) * force, float(result[1]) * force, float(result[2]) * force * size


def ellipse_field(patch: RollingPatch, fields: Fields, start: FloatArray | None = None) -> FloatArray:
    """Fill pressure, traction and slip on the strips of `tangential.api`.

    Strips are the rows of the grid; along each the traction over its bound is interpolated. Pressure is
    Hertz's. Slip opposes traction, and is none in a cell whose nearest element sticks; all of it is scaled
    (by some per cent) so that friction dissipates the power of the creepages, as in every theory.

    Parameters
    ----------
    patch : RollingPatch
        With normal force, area, friction and creepage.
    fields : Fields
        Arrays (ny, nx), written.
    start : ndarray, (2, any, any), optional
        What this function returned of a similar patch, as of the state before in time: the solution begins
        there, in half the time, and does not depend on it by more than its tolerance.

    Returns
    -------
    ndarray, (2, ny, nx)
        Tractions over their bound in the elements of the box around the ellipse [-].
    """
    ny, nx = fields.pressure.shape
    own, _, pressure, mirrored = _own_units(patch)
    if start is None:
        solution, _ = solve_ellipse(own, (nx, ny))
    else:
        solution = _solve(own, (nx, ny), _mirror(start) if mirrored else start)
    shares, x_grid = _share(own, solution), (np.arange(nx) - 0.5 * (nx - 1)) * (2.0 * own.a / nx)
    slips, sticks = solution.slip, solution.stick
    if mirrored:
        shares, slips, sticks = _mirror(shares), _mirror(slips), sticks[::-1]
    along = -1.0 + (2.0 * np.arange(nx) + 1.0) / nx
    for j in range(ny):
        lateral = -1.0 + (2 * j + 1) / ny
        cosine = math.sqrt(1.0 - lateral * lateral)
        x = own.a * cosine * along
        inside = np.flatnonzero(np.abs(x_grid) < own.a * cosine)
        fields.pressure[j] = pressure * cosine * np.sqrt(1.0 - along**2)
        share = shares[:, j, inside]
        length = np.interp(x, x_grid[inside], np.hypot(share[0], share[1]))
        speed = np.interp(x, x_grid[inside], np.hypot(*slips[:, j, inside]))
        nearest = inside[np.abs(x[:, None] - x_grid[inside]).argmin(axis=1)]
        speed = np.where(sticks[j, nearest], 0.0, speed)
        share = np.stack([np.interp(x, x_grid[inside], part) for part in share])
        direction = share / np.maximum(np.hypot(share[0], share[1]), 1e-300)
        traction = direction * np.minimum(length, 1.0) * patch.friction * fields.pressure[j]
        fields.q_x[j], fields.q_y[j] = traction
        fields.slip_x[j], fields.slip_y[j] = -speed * direction
    _balance(patch, fields)
    return shares


def _mirror(values: FloatArray) -> FloatArray:
    """Vectors (2, ny, nx) seen in a mirror along x."""
    return np.stack([values[0, ::-1], -values[1, ::-1]])


def _balance(patch: RollingPatch, fields: Fields) -> None:
    """Scale the slip so that friction dissipates the power of the creepages, where anything slips."""
    ny, nx = fields.pressure.shape
    lateral = -1.0 + (2.0 * np.arange(ny)[:, None] + 1.0) / ny
    cosine = np.sqrt(1.0 - lateral**2)
    x = patch.a * cosine * (-1.0 + (2.0 * np.arange(nx) + 1.0) / nx)
    work = np.sum(cosine * (fields.q_x * fields.slip_x + fields.q_y * fields.slip_y))
    rigid_x, rigid_y = patch.nu_x - patch.phi * patch.b * lateral, patch.nu_y + patch.phi * x
    power = np.sum(cosine * (fields.q_x * rigid_x + fields.q_y * rigid_y))
    if work < 0.0 and power < 0.0:
        fields.slip_x[:] *= power / work
        fields.slip_y[:] *= power / work
