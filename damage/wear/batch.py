"""Wear of many contact states by any law: one call.

states = {"a": 6e-3, "b": 5e-3, "normal_force": 1e5, "nu_x": numpy.array([1e-3, 2e-3]), "nu_y": 0.0,
          "phi": 0.0, "friction": 0.4, "speed": 15.0, "rolling_radius": 0.46}
wear_depths(wear_law("usfd"), states)
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow

from damage.cells import cell_middles
from damage.log_input.states import ContactStates, contact_states, patch_of
from damage.patch_strips import PatchStrips, ellipse_strips, strips_space
from damage.wear.energy import strip_energies
from damage.wear.law import REGIMES, LawValues, SolvedPatch, WearLaw, require_known
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.tangential.registry import FIELD_THEORIES, THEORIES, field_kernel
from hh_exudyn.contact.types import Elastic, Fields
from hh_exudyn.kernel import kernel


@dataclass(frozen=True)
class WearDepths:
    """Wear of n contact states on ny strips each.

    Attributes
    ----------
    law
        The law that was used.
    y
        (n, ny) lateral position of the strips in the contact frame, to the left [m].
    width
        (n,) width of a strip [m].
    by_regime
        (n, ny, REGIMES) depth on the wheel per revolution, normal to the surface, by regime of the law [m].
    energy
        (n, ny) energy dissipated in each strip per metre rolled [N].
    """

    law: WearLaw
    y: FloatArray
    width: FloatArray
    by_regime: FloatArray
    energy: FloatArray

    @property
    def depth(self) -> FloatArray:
        """(n, ny) depth per revolution [m]."""
        depth: FloatArray = self.by_regime.sum(axis=2)
        return depth

    @property
    def volume(self) -> FloatArray:
        """(n, REGIMES) worn volume per metre rolled, by regime [m^3/m]."""
        volume: FloatArray = self.by_regime.sum(axis=1) * self.width[:, None]
        return volume

    def to_table(self) -> pyarrow.Table:
        """One row per state: wear number, deepest strip, worn volume in all and by regime."""
        volume = self.volume
        columns = {
            "wear_number_N": self.energy.sum(axis=1),
            "max_depth_nm_per_revolution": self.depth.max(axis=1) * 1e9,
            "volume_mm3_per_km": volume.sum(axis=1) * 1e12,
        }
        for index, regime in enumerate(self.law.regimes):
            columns[f"volume_{regime.replace(', ', '_').replace(' ', '_')}_mm3_per_km"] = (
                volume[:, index] * 1e12
            )
        return pyarrow.table(columns)


def wear_depths(
    law: WearLaw,
    states: Mapping[str, Any] | pyarrow.Table,
    theory: str = "fastrip",
    cells: tuple[int, int] = (50, 50),
    material: Material = STEEL,
) -> WearDepths:
    """Wear depths of contact states by a law.

    The call is the same for every law.

    Parameters
    ----------
    law
        From `damage.wear.laws.wear_law`.
    states
        The columns `damage.log_input.states.WEAR_COLUMNS`, numbers or (n,) arrays, as a mapping or a contact
        log's table; other columns are ignored.
    theory
        Name of a tangential theory with a field.
    cells
        Cells of a patch along and across [-].
    material
        Elastic constants of wheel and rail.

    Raises
    ------
    ValueError
        Unknown theory, fewer than one cell, a missing column, or a value out of its range (with its row).
    """
    require_known("theory", theory, FIELD_THEORIES)
    if min(cells) < 1:
        raise ValueError(f"cells = {cells} must be at least 1 along and across")
    columns = contact_states(states)
    count = columns.a.size
    by_regime = np.zeros((count, cells[1], REGIMES))
    energy = np.zeros((count, cells[1]))
    fields = Fields(*np.zeros((5, cells[1], cells[0])))
    elastic = Elastic(material.shear_modulus, material.poisson_ratio)
    strips = strips_space(cells[1])
    _wear_states(law.values, columns, THEORIES[theory], elastic, strips, fields, by_regime, energy)
    y = columns.b[:, None] * cell_middles(cells[1])[None, :]
    return WearDepths(law, y, 2.0 * columns.b / cells[1], by_regime, energy)


@kernel
def _wear_states(
    law: LawValues,
    states: ContactStates,
    theory: int,
    elastic: Elastic,
    strips: PatchStrips,
    fields: Fields,
    by_regime: FloatArray,
    energy: FloatArray,
) -> None:
    """Fill the depths and energies of all states."""
    for row in range(states.a.size):
        patch = patch_of(states, row, elastic)
        field_kernel(theory, patch, fields)
        area = ellipse_strips(patch, strips)
        solved = SolvedPatch(patch, strips, area, fields, states.speed[row], states.rolling_radius[row])
        law.depths(law.numbers, solved, by_regime[row])
        strip_energies(strips, fields, energy[row])
