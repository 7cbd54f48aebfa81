"""Contact states as a record of arrays: the columns of the contact log that damage needs, by name.

Names and units are those of the log's channel table. Kernels take the record itself, and `patch_of` makes the
patch of a row, for a tangential theory.
"""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np
import pyarrow

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.types import Elastic, RollingPatch
from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.log.channels import CONTACT

UNITS = {column.name: column.unit for column in CONTACT}
"""Units of the columns of a contact log, by name."""


class ContactStates(NamedTuple):
    """Contact states, (n,) each, SI units; `UNITS` and the log's channel table have the meanings."""

    time: FloatArray
    vehicle: FloatArray
    bogie: FloatArray
    wheelset: FloatArray
    side: FloatArray
    y_wheel: FloatArray
    contact_angle: FloatArray
    rolling_radius: FloatArray
    normal_force: FloatArray
    a: FloatArray
    b: FloatArray
    p_max: FloatArray
    nu_x: FloatArray
    nu_y: FloatArray
    phi: FloatArray
    friction: FloatArray
    speed: FloatArray
    force_x: FloatArray
    force_y: FloatArray
    moment_z: FloatArray
    s: FloatArray
    angle_of_attack: FloatArray
    centre_y: FloatArray
    centre_z: FloatArray
    roll: FloatArray
    y_rail: FloatArray
    patch: FloatArray


POSE_COLUMNS = ("s", "angle_of_attack", "centre_y", "centre_z", "roll")
"""Columns of the wheel's pose on its rail: needed where patches are rebuilt from the profiles, else NaN."""

RAIL_COLUMNS = ("s", "y_rail", "patch")
"""Columns of the place on the rails: needed where damage of rails is summed too, else NaN."""

LOAD_COLUMNS = ("a", "b", "normal_force", "nu_x", "nu_y", "phi", "friction")
"""Columns that determine stress and slip of a patch."""

WEAR_COLUMNS = (*LOAD_COLUMNS, "speed", "rolling_radius")
"""Columns that determine its wear."""

_ABOVE_ZERO = ("speed", "rolling_radius")
_NOT_BELOW_ZERO = ("a", "b", "normal_force", "friction")


@inlined_kernel
def patch_of(states: ContactStates, row: int, elastic: Elastic) -> RollingPatch:
    """The patch of a contact state, by its row (kernel).

    Parameters
    ----------
    states
        Contact states, (n,) each.
    row
        Number of the state, from 0.
    elastic
        Elastic constants.
    """
    return RollingPatch(
        states.a[row], states.b[row], states.normal_force[row], states.nu_x[row], states.nu_y[row],
        states.phi[row], states.friction[row], elastic.shear_modulus, elastic.poisson_ratio,
    )  # fmt: skip


def states_of(columns: Mapping[str, FloatArray]) -> ContactStates:
    """Contact states from columns as they are; those that are not given are NaN."""
    unused = np.full(next(iter(columns.values())).size, np.nan)
    return ContactStates._make(columns.get(name, unused) for name in ContactStates._fields)


def contact_states(
    given: Mapping[str, Any] | pyarrow.Table, columns: Iterable[str] = WEAR_COLUMNS
) -> ContactStates:
    """Contact states from numbers, arrays or a contact log's table; columns not requested are NaN.

    Parameters
    ----------
    given
        Numbers or (n,) arrays by the name of the column; further columns are ignored.
    columns
        Names of the columns that are needed.

    Raises
    ------
    ValueError
        A missing column, arrays that do not fit together, or a value out of its range: which, in which row,
        and how many such rows there are.
    """
    wanted = tuple(columns)
    there = set(given.column_names) if isinstance(given, pyarrow.Table) else set(given)
    if missing := [name for name in wanted if name not in there]:
        raise ValueError(f"contact states: {', '.join(missing)} missing")
    arrays = np.broadcast_arrays(*(np.asarray(given[name], dtype=np.float64) for name in wanted))
    if arrays[0].ndim > 1:
        raise ValueError(
            f"contact states: shape {arrays[0].shape}; numbers or arrays of one length are needed"
        )
    found = {name: np.array(array, ndmin=1) for name, array in zip(wanted, arrays, strict=True)}
    for name, values in found.items():
        _check(name, values)
    return states_of(found)


def _check(name: str, values: FloatArray) -> None:
    unit = "[-]" if UNITS[name] == "-" else UNITS[name]
    bad, demand = ~np.isfinite(values), "finite"
    if name in _ABOVE_ZERO:
        bad, demand = bad | (values <= 0.0), f"finite and > 0 {unit}"
    elif name in _NOT_BELOW_ZERO:
        bad, demand = bad | (values < 0.0), f"finite and >= 0 {unit}"
    if bad.any():
        row = int(np.argmax(bad))
        raise ValueError(
            f"contact states: {name} = {values[row]:g} {unit} in row {row} must be {demand} "
            f"({int(bad.sum())} such rows among {bad.size})"
        )
