"""Local fatigue indices over a contact patch: stress index and fatigue index, the largest of every strip.

In every cell, with traction q and pressure p of a tangential theory and the yield strength k in shear,

    SI = |q| - k                       Dirks et al.; Hossein-Nia (2018), equation 3.21
    FI_local = |q|/p - k/p = SI/p      ibid., equation 3.17 (printed with Q and P: it is stress by stress)

Both are above zero in the same cells: those that ratchet. The pressure is the theory's own, so |q|/p never
exceeds the friction: elliptic with FaStrip, parabolic with 4/3 of Hertz's peak with "fastsim", whose larger
stresses in the middle of the patch make its indices larger.

Where p fades at the edge of the patch, |q| <= mu p fades too, and FI_local -> -infinity as -k/p. A cell
without pressure counts as -infinity. The largest value of a strip comes from its inside all the same.

`distributed_index` is the global counterpart (equation 3.16): one ratio Q/P for all cells.
"""

import math
from dataclasses import dataclass

import numpy as np
import pyarrow
from numpy.typing import ArrayLike

from damage.material import WheelMaterial
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.tangential.registry import FIELD_THEORIES, THEORIES, field_kernel
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import kernel

_ROUNDED_UP = 1.0 + 1e-14  # so that a cell does not exceed itself by rounding


@dataclass(frozen=True)
class LocalFatigue:
    """Largest local indices of every strip of a batch of contact states.

    Attributes
    ----------
    y
        (n, strips), as what follows: middle of the strips, lateral from the contact's place in the contact
        frame, to the left [m]. On the wheel profile it lies at y_wheel - side y cos(contact_angle).
    stress_index
        Largest SI [Pa], >= -k; -k where nothing is transmitted.
    fatigue_index
        Largest FI_local [-]; -infinity where there is no pressure.
    width
        (n,) width of the strips of each state [m].
    """

    y: FloatArray
    stress_index: FloatArray
    fatigue_index: FloatArray
    width: FloatArray

    def to_table(self) -> pyarrow.Table:
        """One row per state and strip: state, strip (from 0), y_m, stress_index_Pa, fatigue_index."""
        states, strips = self.y.shape
        return pyarrow.table(
            {
                "state": np.repeat(np.arange(states), strips),
                "strip": np.tile(np.arange(strips), states),
                "y_m": self.y.ravel(),
                "stress_index_Pa": self.stress_index.ravel(),
                "fatigue_index": self.fatigue_index.ravel(),
            }
        )


@kernel
def strip_indices(
    fields: Fields, shear_yield: float, stress_index: FloatArray, fatigue_index: FloatArray
) -> None:
    """Largest SI and FI_local of every strip of a solved patch (kernel, trusts its input).

    Parameters
    ----------
    fields
        Pressure and tractions (ny, nx), from `field_kernel`.
    shear_yield
        k [Pa], > 0.
    stress_index, fatigue_index
        (ny,) results [Pa], [-].
    """
    cells_y, cells_x = fields.pressure.shape
    stressed, worst = cells_x // 2, cells_x // 2  # cells with the largest of the strip before
    for strip in range(cells_y):
        pressure, q_x, q_y = fields.pressure[strip], fields.q_x[strip], fields.q_y[strip]
        most, best = 0.0, -math.inf
        for cell in range(max(stressed - 1, 0), min(stressed + 2, cells_x)):
            square = q_x[cell] * q_x[cell] + q_y[cell] * q_y[cell]
            if square > most:
                most, stressed = square, cell
        for cell in range(max(worst - 1, 0), min(worst + 2, cells_x)):
            square = q_x[cell] * q_x[cell] + q_y[cell] * q_y[cell]
            index = (math.sqrt(square) - shear_yield) / pressure[cell]  # (3.17)
            if index > best and pressure[cell] > 0.0:
                best, worst = index, cell
        # Neighbouring strips are alike: mostly no other cell has more, which a sum of comparisons tells fast.
        # (|q| - k)/p > best without root and division: needed may be below zero, then every |q| is more
        more = 0
        for cell in range(cells_x):
            square = q_x[cell] * q_x[cell] + q_y[cell] * q_y[cell]
            needed = shear_yield + best * pressure[cell]
            more += 1 if square > most else 0
            more += 1 if square > _ROUNDED_UP * needed * abs(needed) else 0
        if more > 0:
            for cell in range(cells_x):
                square = q_x[cell] * q_x[cell] + q_y[cell] * q_y[cell]
                if square > most:
                    most, stressed = square, cell
                needed = shear_yield + best * pressure[cell]
                if pressure[cell] > 0.0 and square > needed * abs(needed):
                    best, worst = (math.sqrt(square) - shear_yield) / pressure[cell], cell  # (3.17)
        stress_index[strip] = math.sqrt(most) - shear_yield  # (3.21)
        fatigue_index[strip] = best


@kernel
def strip_fatigue(fields: Fields, shear_yield: float, friction: float, fatigue_index: FloatArray) -> None:
    """Largest FI_local of every strip as far as it is above zero, else zero (kernel, trusts its input).

    What the loop over a log needs of `strip_indices`, sooner: where friction times the pressure in a strip's
    middle, its largest, is below k, no cell can have any.

    Parameters
    ----------
    fields
        Pressure and tractions (ny, nx), from `field_kernel`.
    shear_yield
        k [Pa], > 0.
    friction
        No |q|/p is above it [-].
    fatigue_index
        (ny,) results [-].
    """
    cells_y, cells_x = fields.pressure.shape
    worst = cells_x // 2  # cell with the largest of the strip before
    for strip in range(cells_y):
        pressure, q_x, q_y = fields.pressure[strip], fields.q_x[strip], fields.q_y[strip]
        best = 0.0
        if _ROUNDED_UP * friction * pressure[cells_x // 2] > shear_yield:
            # Uphill from there: (|q| - k)/p > best without root and division, which only a better cell takes
            for direction in (0, -1, 1):
                cell = worst + direction
                while 0 <= cell < cells_x:
                    square = q_x[cell] * q_x[cell] + q_y[cell] * q_y[cell]
                    needed = shear_yield + best * pressure[cell]
                    if not square > _ROUNDED_UP * needed * needed:
                        break
                    best, worst = (math.sqrt(square) - shear_yield) / pressure[cell], cell  # (3.17)
                    if direction == 0:
                        break
                    cell += direction
            more = 0  # mostly that is the top, which a sum of comparisons tells fast
            for cell in range(cells_x):
                square = q_x[cell] * q_x[cell] + q_y[cell] * q_y[cell]
                needed = shear_yield + best * pressure[cell]
                more += 1 if square > _ROUNDED_UP * needed * needed else 0
            for cell in range(cells_x if more > 0 else 0):
                square = q_x[cell] * q_x[cell] + q_y[cell] * q_y[cell]
                needed = shear_yield + best * pressure[cell]
                if square > needed * needed:
                    best, worst = (math.sqrt(square) - shear_yield) / pressure[cell], cell  # (3.17)
        fatigue_index[strip] = best


@kernel
def _states_indices(
    theory: int,
    states: FloatArray,
    shear_modulus: float,
    poisson_ratio: float,
    shear_yield: float,
    fields: Fields,
    stress_index: FloatArray,
    fatigue_index: FloatArray,
) -> None:
    """`strip_indices` of every row (a, b, normal force, nu_x, nu_y, phi, friction) of the states."""
    for row in range(states.shape[0]):
        a, b, normal_force, nu_x, nu_y, phi, friction = states[row]
        patch = RollingPatch(a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio)
        field_kernel(theory, patch, fields)
        strip_indices(fields, shear_yield, stress_index[row], fatigue_index[row])


def local_indices(
    a: ArrayLike,
    b: ArrayLike,
    normal_force: ArrayLike,
    nu_x: ArrayLike,
    nu_y: ArrayLike,
    phi: ArrayLike,
    friction: ArrayLike,
    material: WheelMaterial,
    theory: str = "fastrip",
    cells: tuple[int, int] = (50, 50),
) -> LocalFatigue:
    """Largest local indices per lateral strip for a batch of contact states.

    Parameters
    ----------
    a, b
        Semi-axes of the patches [m], scalars or (n,) as all that follow.
    normal_force
        [N], >= 0.
    nu_x, nu_y
        Creepages [-].
    phi
        Spin creepage [1/m].
    friction
        [-], >= 0.
    material
        The wheel steel: k and the elastic constants.
    theory
        Name of a tangential theory with a field.
    cells
        Cells of a patch along and across [-].

    Raises
    ------
    ValueError
        Unknown theory, cells below 1, or values outside these ranges: how many, and the first row.
    """
    if theory not in FIELD_THEORIES:
        raise ValueError(f"theory = {theory!r}; theories with a stress field: {', '.join(FIELD_THEORIES)}")
    if min(cells) < 1:
        raise ValueError(f"cells = {cells} must be at least 1 along and across")
    given = {
        "a": (a, "m", True), "b": (b, "m", True), "normal_force": (normal_force, "N", True),
        "nu_x": (nu_x, "[-]", False), "nu_y": (nu_y, "[-]", False), "phi": (phi, "1/m", False),
        "friction": (friction, "[-]", True),
    }  # fmt: skip
    columns = np.broadcast_arrays(*(np.atleast_1d(np.asarray(v, np.float64)) for v, _, _ in given.values()))
    for column, (name, (_, unit, at_least_zero)) in zip(columns, given.items(), strict=True):
        bad = ~np.isfinite(column) | (at_least_zero & (column < 0.0))
        if bad.any():
            row = int(np.argmax(bad))
            wanted = "finite and >= 0" if at_least_zero else "finite"
            raise ValueError(
                f"{name} = {column[row]:g} {unit} in row {row} must be {wanted} "
                f"({int(bad.sum())} such rows among {bad.size})"
            )
    states = np.column_stack(columns)
    nx, ny = int(cells[0]), int(cells[1])
    stress_index, fatigue_index = np.empty((2, states.shape[0], ny))
    _states_indices(
        THEORIES[theory], states, material.elastic.shear_modulus, material.elastic.poisson_ratio,
        material.shear_yield, Fields(*np.zeros((5, ny, nx))), stress_index, fatigue_index,
    )  # fmt: skip
    b_of = states[:, 1]
    return LocalFatigue(b_of[:, None] * _strip_middles(ny), stress_index, fatigue_index, 2.0 * b_of / ny)


def distributed_index(
    force_x: ArrayLike,
    force_y: ArrayLike,
    normal_force: ArrayLike,
    a: ArrayLike,
    b: ArrayLike,
    shear_yield: float,
    strips: int = 50,
) -> FloatArray:
    """Global fatigue index spread over the patch as its pressure is: the largest of every strip, (n, strips).

    The traction is taken as (Q/P) p in every cell ("FI global ... distributed elliptically over the patch",
    Hossein-Nia 2018, p. 64, after Dirks and Enblom), so a strip has Q/P - k/(p0 sqrt(1 - (y/b)^2)). At y = 0
    it is FI_surf (3.16).

    Parameters
    ----------
    force_x, force_y
        Creep forces [N], scalars or (n,).
    normal_force
        [N], > 0.
    a, b
        Semi-axes [m], > 0.
    shear_yield
        k [Pa], > 0.
    strips
        Strips across the patch, as the cells of `local_indices`.

    Raises
    ------
    ValueError
        Values outside these ranges.
    """
    if not (math.isfinite(shear_yield) and shear_yield > 0.0):
        raise ValueError(f"shear_yield = {shear_yield} Pa must be finite and > 0 Pa")
    if strips < 1:
        raise ValueError(f"strips = {strips} must be at least 1")
    load, along, across = (np.atleast_1d(np.asarray(value, np.float64)) for value in (normal_force, a, b))
    for name, unit, values in (("normal_force", "N", load), ("a", "m", along), ("b", "m", across)):
        if not np.all(values > 0.0):  # also catches NaN
            raise ValueError(f"{name} must be > 0 {unit}; {np.count_nonzero(~(values > 0.0))} values are not")
    ratio = np.hypot(np.asarray(force_x, np.float64), np.asarray(force_y, np.float64)) / load
    highest = 1.5 * load / (np.pi * along * across)  # p0 of Hertz
    fade = np.sqrt(1.0 - _strip_middles(strips) ** 2)
    index: FloatArray = ratio[:, None] - shear_yield / (highest[:, None] * fade)
    return index


def _strip_middles(strips: int) -> FloatArray:
    """(strips,) middles of the strips over b [-]."""
    middles: FloatArray = -1.0 + (2.0 * np.arange(strips) + 1.0) / strips
    return middles
