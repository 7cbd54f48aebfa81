"""Wear of many contact states by any law: one call.

states = {"a": 6e-3, "b": 5e-3, "normal_force": 1e5, "nu_x": numpy.array([1e-3, 2e-3]), "nu_y": 0.0,
          "phi": 0.0, "friction": 0.4, "speed": 15.0, "rolling_radius": 0.46}
wear_depths(wear_law("usfd"), states)
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pyarrow

from damage.wear.energy import strip_energies
from damage.wear.law import WearLaw, require_known
from damage.wear.strip_wear import strip_wear
from damage.wear.values import REGIMES, LawValues
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.tangential.registry import FIELD_THEORIES, THEORIES, field_kernel
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import kernel


class WearStates(NamedTuple):
    """Contact states, (n,) each: the columns of a contact log that wear depends on, SI units."""

    a: FloatArray
    b: FloatArray
    normal_force: FloatArray
    nu_x: FloatArray
    nu_y: FloatArray
    phi: FloatArray
    friction: FloatArray
    speed: FloatArray
    rolling_radius: FloatArray


_ABOVE_ZERO = {"speed": "m/s", "rolling_radius": "m"}
_NOT_BELOW_ZERO = {"a": "m", "b": "m", "normal_force": "N", "friction": "-"}


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
        """One row a state: wear number, deepest strip, worn volume in all and by regime."""
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
    """Solve contact states and wear them by a law; the signature is the same for every law.

    Parameters
    ----------
    law
        From `damage.wear.laws.wear_law`.
    states
        The columns of `WearStates`, numbers or (n,) arrays, as a mapping or a contact log's table; other
        columns are passed over.
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
    columns = wear_states(states)
    count = columns.a.size
    by_regime = np.zeros((count, cells[1], REGIMES))
    energy = np.zeros((count, cells[1]))
    fields = Fields(*np.zeros((5, cells[1], cells[0])))
    _wear_states(
        law.values, columns, THEORIES[theory], material.shear_modulus, material.poisson_ratio, fields,
        by_regime, energy,
    )  # fmt: skip
    lateral = -1.0 + (2.0 * np.arange(cells[1]) + 1.0) / cells[1]
    return WearDepths(
        law, columns.b[:, None] * lateral[None, :], 2.0 * columns.b / cells[1], by_regime, energy
    )


def wear_states(states: Mapping[str, Any] | pyarrow.Table) -> WearStates:
    """The states as (n,) arrays of their own; arguments and errors as `wear_depths`."""
    given = set(states.column_names) if isinstance(states, pyarrow.Table) else set(states)
    if missing := [name for name in WearStates._fields if name not in given]:
        raise ValueError(f"contact states: {', '.join(missing)} missing")
    arrays = [np.asarray(states[name], dtype=np.float64) for name in WearStates._fields]
    columns = WearStates._make(np.array(array, ndmin=1) for array in np.broadcast_arrays(*arrays))
    if columns.a.ndim != 1:
        raise ValueError(
            f"contact states: shape {columns.a.shape}; numbers or arrays of one length are needed"
        )
    for name, values in columns._asdict().items():
        bad, demand = ~np.isfinite(values), "finite"
        if name in _ABOVE_ZERO:
            bad, demand = bad | (values <= 0.0), f"finite and > 0 {_ABOVE_ZERO[name]}"
        elif name in _NOT_BELOW_ZERO:
            bad, demand = bad | (values < 0.0), f"finite and >= 0 {_NOT_BELOW_ZERO[name]}"
        if bad.any():
            row = int(np.argmax(bad))
            raise ValueError(
                f"contact states: {name} = {values[row]} in row {row} must be {demand} "
                f"({int(bad.sum())} such rows)"
            )
    return columns


@kernel
def _wear_states(
    law: LawValues,
    states: WearStates,
    theory: int,
    shear_modulus: float,
    poisson_ratio: float,
    fields: Fields,
    by_regime: FloatArray,
    energy: FloatArray,
) -> None:
    """Fill the depths and energies of all states."""
    for row in range(states.a.size):
        patch = RollingPatch(
            states.a[row], states.b[row], states.normal_force[row], states.nu_x[row], states.nu_y[row],
            states.phi[row], states.friction[row], shear_modulus, poisson_ratio,
        )  # fmt: skip
        field_kernel(theory, patch, fields)
        strip_wear(law, patch, fields, states.speed[row], states.rolling_radius[row], by_regime[row])
        strip_energies(patch, fields, energy[row])
