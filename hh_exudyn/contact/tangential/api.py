"""Creep forces and surface stresses of an elliptic patch in steady rolling: one call for every theory.

Sign convention: creepages of the wheel relative to the rail, over the speed V; forces and tractions on the
wheel; x in rolling direction, leading edge at x = +a.

The grid, the same in every theory: strips of equal width 2 b / ny across the patch, each divided into nx
cells of equal length from its own trailing to its own leading edge, so that no cell crosses the edge. Cell
(j, i) has its centre at y_j = b (-1 + (2 j + 1)/ny), x_ji = a(y_j) (-1 + (2 i + 1)/nx), with a(y) =
a sqrt(1 - (y/b)^2), and the area of `cell_areas`. Forces use the same cells, but the pressure's integral
is exact in them; the sum of q times area meets the force within about 1 % at 20 x 20 cells.

List of the theories: `registry`. Their errors against the exact solution: `validation`.
"""

import math
from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.halfspace.ellipse import ellipse_field, ellipse_force
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.tangential.registry import (
    FASTRIP,
    PATCH_FIELD_THEORIES,
    PATCH_THEORIES,
    THEORIES,
    field_kernel,
    force_kernel,
    solvable,
)
from hh_exudyn.contact.types import Fields, RollingPatch

_MOST_CELLS = 2000  # in either direction: more than any stress field needs, and about a second


@dataclass(frozen=True)
class PatchLoad:
    """Size, load, creepages and friction of a patch.

    Attributes
    ----------
    a, b : float
        Semi-axes in rolling direction and lateral [m], > 0.
    normal_force : float
        [N], > 0.
    nu_x, nu_y : float
        Longitudinal and lateral creepage [-].
    phi : float
        Spin creepage [1/m].
    friction : float
        Friction coefficient [-], > 0.
    """

    a: float
    b: float
    normal_force: float
    nu_x: float
    nu_y: float
    phi: float
    friction: float

    @property
    def arguments(self) -> tuple[float, float, float, float, float, float, float]:
        """Arguments of `creep_force` and `traction_field` after the theory."""
        return self.a, self.b, self.normal_force, self.nu_x, self.nu_y, self.phi, self.friction


@dataclass(frozen=True)
class CreepForce:
    """Creep force on the wheel.

    Attributes
    ----------
    x, y : float
        Longitudinal and lateral force [N].
    moment : float
        Spin moment about the normal [N m].
    """

    x: float
    y: float
    moment: float


@dataclass(frozen=True)
class TractionField:
    """Stresses and slip over the patch.

    Arrays (ny, nx); the grid is that of the module's docstring.

    Attributes
    ----------
    x, y : ndarray
        Cell centres [m].
    pressure : ndarray
        The theory's own pressure [Pa]: elliptic (Hertz), but parabolic with 4/3 of Hertz's peak for "fastsim"
        and "fastsim_single".
    q_x, q_y : ndarray
        Traction on the wheel [Pa].
    slip_x, slip_y : ndarray
        Slip velocity of the wheel relative to the rail over V [-], zero in stick.
    """

    x: FloatArray
    y: FloatArray
    pressure: FloatArray
    q_x: FloatArray
    q_y: FloatArray
    slip_x: FloatArray
    slip_y: FloatArray


def cell_areas(a: float, b: float, ny: int, nx: int) -> FloatArray:
    """Areas of the grid's cells [m^2], (ny, nx): (2 b/ny) (2 a(y_j)/nx), so sum(q * area) is the force.

    Parameters
    ----------
    a, b : float
        Semi-axes in rolling direction and lateral [m].
    ny, nx : int
        Strips, and cells along each.
    """
    lateral = -1.0 + (2.0 * np.arange(ny) + 1.0) / ny
    areas = 4.0 * a * b / (nx * ny) * np.sqrt(1.0 - lateral**2)
    return np.repeat(areas[:, None], nx, axis=1)


def _rolling_patch(
    a: float,
    b: float,
    normal_force: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    friction: float,
    material: Material,
) -> RollingPatch:
    """The patch for the kernels, with all numbers converted to float."""
    numbers = (a, b, normal_force, nu_x, nu_y, phi, friction, material.shear_modulus, material.poisson_ratio)
    return RollingPatch._make(float(number) for number in numbers)


def _check(theory: str, patch: RollingPatch, cells: tuple[int, int]) -> None:
    """ValueError for anything out of range."""
    if theory not in PATCH_THEORIES:
        raise ValueError(f"theory = {theory!r}; known theories: {', '.join(PATCH_THEORIES)}")
    for name, unit in (("a", "m"), ("b", "m"), ("normal_force", "N"), ("friction", "-")):
        value = getattr(patch, name)
        if not (math.isfinite(value) and value >= 0.0):
            raise ValueError(f"{name} = {value} {unit}; it must be finite and >= 0 {unit}")
    if patch.normal_force > 0.0 and min(patch.a, patch.b) == 0.0:
        raise ValueError(
            f"a = {patch.a} m, b = {patch.b} m; both must be > 0 m under a normal force of "
            f"{patch.normal_force} N"
        )
    for name, unit in (("nu_x", "[-]"), ("nu_y", "[-]"), ("phi", "1/m")):
        value = getattr(patch, name)
        if not math.isfinite(value):
            raise ValueError(f"{name} = {value} {unit}; it must be finite")
    if len(cells) != 2 or any(not 1 <= n <= _MOST_CELLS or int(n) != n for n in cells):
        raise ValueError(
            f"cells = {cells}; two whole numbers from 1 to {_MOST_CELLS} are needed, along x and across y"
        )


def creep_force(
    theory: str,
    a: float,
    b: float,
    normal_force: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    friction: float,
    material: Material = STEEL,
    cells: tuple[int, int] = (20, 20),
) -> CreepForce:
    """Creep force and spin moment on the wheel.

    Ten arguments: the seven numbers that define a rolling ellipse stand in the order of the literature.

    Parameters
    ----------
    theory : str
        One of `registry.PATCH_THEORIES`. "carter" ignores `nu_y` and `phi`, "linear" the friction limit.
    a, b : float
        Semi-axes in rolling direction and lateral [m], > 0 (0 only without normal force).
    normal_force : float
        [N], >= 0.
    nu_x, nu_y : float
        Longitudinal and lateral creepage of the wheel relative to the rail [-].
    phi : float
        Spin creepage [1/m].
    friction : float
        Friction coefficient [-], >= 0.
    material : Material
        Of wheel and rail.
    cells : tuple of int
        Cells along x and strips across y; "strip" needs the strips only, closed formulas neither.

    Returns
    -------
    CreepForce
        All zero without normal force, creepage or friction.

    Raises
    ------
    ValueError
        For an unknown theory or an argument out of range.
    """
    patch = _rolling_patch(a, b, normal_force, nu_x, nu_y, phi, friction, material)
    _check(theory, patch, cells)
    nx, ny = int(cells[0]), int(cells[1])
    if theory in THEORIES:
        x, y, moment = force_kernel(THEORIES[theory], patch, nx, ny)
    elif solvable(patch):
        x, y, moment = ellipse_force(patch, (nx, ny))
    else:
        x, y, moment = 0.0, 0.0, 0.0
    return CreepForce(float(x), float(y), float(moment))


def traction_field(
    theory: str,
    a: float,
    b: float,
    normal_force: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    friction: float,
    material: Material = STEEL,
    cells: tuple[int, int] = (50, 50),
) -> TractionField:
    """Pressure, traction on the wheel and slip over the patch.

    Ten arguments: those of `creep_force`, and so are the errors; the grid has cells[0] cells along x,
    cells[1] strips.

    Returns
    -------
    TractionField

    Raises
    ------
    ValueError
        For a theory without a stress field (not one of `registry.PATCH_FIELD_THEORIES`), or an argument out
        of range.
    """
    if theory in PATCH_THEORIES and theory not in PATCH_FIELD_THEORIES:
        raise ValueError(
            f"theory = {theory!r} gives forces only, no stress field; theories with one: "
            f"{', '.join(PATCH_FIELD_THEORIES)}"
        )
    patch = _rolling_patch(a, b, normal_force, nu_x, nu_y, phi, friction, material)
    _check(theory, patch, cells)
    nx, ny = int(cells[0]), int(cells[1])
    lateral = -1.0 + (2.0 * np.arange(ny) + 1.0) / ny
    along = -1.0 + (2.0 * np.arange(nx) + 1.0) / nx
    x = patch.a * np.sqrt(1.0 - lateral**2)[:, None] * along[None, :]
    y = np.repeat(patch.b * lateral[:, None], nx, axis=1)
    fields = Fields(*np.zeros((5, ny, nx)))
    if theory in THEORIES:
        field_kernel(THEORIES[theory], patch, fields)
    elif solvable(patch):
        ellipse_field(patch, fields)
    else:  # the pressure, and the rigid slip where there is no friction
        field_kernel(FASTRIP, patch, fields)
    return TractionField(x, y, *fields)
