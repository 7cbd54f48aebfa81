"""Local fatigue indices over a contact patch: stress index and fatigue index, the largest of every strip.

In every cell, with traction q and pressure p of a tangential theory and the yield strength k in shear,

    SI = |q| - k                       Dirks et al.; Hossein-Nia (2018), equation 3.21
    FI_local = |q|/p - k/p = SI/p      ibid., equation 3.17 (printed with Q and P: it is stress by stress)

Both are above zero in the same cells: those in ratchetting. The pressure is the theory's own, so |q|/p never
exceeds the friction: elliptic with FaStrip, parabolic with 4/3 of Hertz's peak with "fastsim", whose larger
stresses in the middle of the patch make its indices larger.

Towards the edge of the patch p tends to 0, |q| <= mu p with it, and FI_local -> -infinity as -k/p. A cell
without pressure has -infinity. The largest value of a strip lies in its interior.

`distributed_index` is the global counterpart (equation 3.16): one ratio Q/P for all cells.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow
from numpy.typing import ArrayLike

from damage.bounds import check_above_zero
from damage.cells import cell_middles
from damage.log_input.states import LOAD_COLUMNS, ContactStates, contact_states, patch_of
from damage.material import WheelMaterial
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.tangential.registry import FIELD_THEORIES, THEORIES, field_kernel
from hh_exudyn.contact.types import Elastic, Fields
from hh_exudyn.kernel import kernel

_ROUNDED_UP = 1.0 + 1e-14  # margin: a cell must not exceed its own value by rounding


@dataclass(frozen=True)
class LocalFatigue:
    """Largest local indices of every strip of a batch of contact states.

    Attributes
    ----------
    y
        (n, strips), like the following two: middle of the strips in the contact frame, to the left of the
        contact's place [m]. On the wheel profile it lies at y_wheel - side y cos(contact_angle).
    stress_index
        Largest SI [Pa], >= -k; -k without traction.
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
        # Neighbouring strips are alike: mostly no other cell has more, as a fast sum of comparisons shows.
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
    """Largest FI_local of every strip, zero where none is above zero (kernel, trusts its input).

    A faster `strip_indices` for the loop over a log: where friction times the largest pressure of a
    strip is below k, no cell has an index above zero.

    Parameters
    ----------
    fields, shear_yield, fatigue_index
        As `strip_indices`.
    friction
        Friction coefficient, bound of |q|/p [-].
    """
    cells_y, cells_x = fields.pressure.shape
    worst = cells_x // 2  # cell with the largest of the strip before
    for strip in range(cells_y):
        pressure, q_x, q_y = fields.pressure[strip], fields.q_x[strip], fields.q_y[strip]
        best = 0.0
        highest = 0.0
        for cell in range(cells_x):
            highest = max(highest, pressure[cell])
        if _ROUNDED_UP * friction * highest > shear_yield:
            # From there towards larger values; root and division of (|q| - k)/p for a better cell only
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
            more = 0  # mostly that is the largest, as a fast sum of comparisons shows
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
    states: ContactStates,
    elastic: Elastic,
    shear_yield: float,
    fields: Fields,
    stress_index: FloatArray,
    fatigue_index: FloatArray,
) -> None:
    """`strip_indices` of every state."""
    for row in range(states.a.size):
        field_kernel(theory, patch_of(states, row, elastic), fields)
        strip_indices(fields, shear_yield, stress_index[row], fatigue_index[row])


def local_indices(
    states: Mapping[str, Any] | pyarrow.Table,
    material: WheelMaterial,
    theory: str = "fastrip",
    cells: tuple[int, int] = (50, 50),
) -> LocalFatigue:
    """Largest local indices per lateral strip for a batch of contact states.

    Parameters
    ----------
    states
        The columns `damage.log_input.states.LOAD_COLUMNS`, numbers or (n,) arrays, as a mapping or a contact
        log's table; other columns are ignored.
    material
        The wheel steel: k and the elastic constants.
    theory
        Name of a tangential theory with a field.
    cells
        Cells of a patch along and across [-].

    Raises
    ------
    ValueError
        Unknown theory, cells below 1, a missing column, or values out of their ranges (with the first row).
    """
    if theory not in FIELD_THEORIES:
        raise ValueError(f"theory = {theory!r}; theories with a stress field: {', '.join(FIELD_THEORIES)}")
    if min(cells) < 1:
        raise ValueError(f"cells = {cells} must be at least 1 along and across")
    columns = contact_states(states, LOAD_COLUMNS)
    nx, ny = int(cells[0]), int(cells[1])
    stress_index, fatigue_index = np.empty((2, columns.a.size, ny))
    elastic = Elastic(material.elastic.shear_modulus, material.elastic.poisson_ratio)
    fields = Fields(*np.zeros((5, ny, nx)))
    _states_indices(
        THEORIES[theory], columns, elastic, material.shear_yield, fields, stress_index, fatigue_index
    )
    y = columns.b[:, None] * cell_middles(ny)
    return LocalFatigue(y, stress_index, fatigue_index, 2.0 * columns.b / ny)


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
    force_x, force_y, normal_force, a, b, shear_yield
        As for `damage.rcf.surface_index.surface_fatigue_index`, scalars or (n,); the normal force and the
        semi-axes > 0.
    strips
        Strips across the patch, as the cells of `local_indices`.

    Raises
    ------
    ValueError
        Values outside these ranges.
    """
    check_above_zero("shear_yield", shear_yield, "Pa")
    if strips < 1:
        raise ValueError(f"strips = {strips} must be at least 1")
    load, along, across = (np.atleast_1d(np.asarray(value, np.float64)) for value in (normal_force, a, b))
    for name, unit, values in (("normal_force", "N", load), ("a", "m", along), ("b", "m", across)):
        if not np.all(values > 0.0):  # also catches NaN
            raise ValueError(f"{name} must be > 0 {unit}; {np.count_nonzero(~(values > 0.0))} values are not")
    ratio = np.hypot(np.asarray(force_x, np.float64), np.asarray(force_y, np.float64)) / load
    highest = 1.5 * load / (np.pi * along * across)  # p0 of Hertz
    fade = np.sqrt(1.0 - cell_middles(strips) ** 2)
    index: FloatArray = ratio[:, None] - shear_yield / (highest[:, None] * fade)
    return index
