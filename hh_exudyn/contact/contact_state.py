"""One contact patch as people handle it, named as the columns of the contact log."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from numbers import Real
from typing import Any

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.types import Patch


@dataclass(frozen=True)
class ContactState:
    """State of one contact patch.

    Attributes
    ----------
    side : int
        `LEFT` or `RIGHT`.
    y_wheel, y_rail : float
        Lateral position on the profiles, side coordinates [m].
    x_shift : float
        Contact ahead of the wheelset's centre, along the track [m].
    contact_angle : float
        Positive towards the flange [rad].
    rolling_radius : float
        [m].
    normal_force : float
        [N].
    a, b : float
        Semi-axes in rolling direction and lateral, of the equivalent ellipse where the patch is none [m].
    p_max : float
        Largest pressure [Pa].
    nu_x, nu_y, phi : float
        Longitudinal and lateral creepage [-], spin creepage [1/m].
    friction : float
        [-].
    speed : float
        Forward speed, the reference of the creepages [m/s].
    force_x, force_y, moment_z : float
        Creep forces [N] and spin moment [N m] on the wheel, contact frame.
    Q, Y : float
        Vertical and lateral (outwards) force of the whole wheel on the rail [N].
    angle_of_attack : float
        Yaw of the wheelset to this wheel's rail, positive to the left [rad].
    y_wheelset : float
        Lateral position of the wheelset's centre, positive to the left [m].
    approach : float
        Elastic approach along the normal [m].
    roll : float
        Roll of the wheelset to this wheel's rail, right-hand about x [rad].
    s : float
        Arc length of the wheelset along the track, where a rail may have changed [m].
    """

    side: int
    y_wheel: float
    y_rail: float
    x_shift: float
    contact_angle: float
    rolling_radius: float
    normal_force: float
    a: float
    b: float
    p_max: float
    nu_x: float
    nu_y: float
    phi: float
    friction: float
    speed: float
    force_x: float
    force_y: float
    moment_z: float
    Q: float
    Y: float
    angle_of_attack: float
    y_wheelset: float
    approach: float
    roll: float
    s: float


def contact_state(
    row: FloatArray,
    *,
    side: int,
    speed: float,
    vertical: float,
    outwards: float,
    yaw: float,
    roll: float,
    lateral: float,
    arc_length: float = 0.0,
) -> ContactState:
    """A patch as the kernel wrote it (`types.Patch`), with what it does not hold, by names."""
    return ContactState(
        side=side,
        y_wheel=float(row[Patch.Y_WHEEL]),
        y_rail=float(row[Patch.Y_RAIL]),
        x_shift=float(row[Patch.X_SHIFT]),
        contact_angle=float(row[Patch.CONTACT_ANGLE]),
        rolling_radius=float(row[Patch.ROLLING_RADIUS]),
        normal_force=float(row[Patch.NORMAL_FORCE]),
        a=float(row[Patch.A]),
        b=float(row[Patch.B]),
        p_max=float(row[Patch.P_MAX]),
        nu_x=float(row[Patch.NU_X]),
        nu_y=float(row[Patch.NU_Y]),
        phi=float(row[Patch.PHI]),
        friction=float(row[Patch.FRICTION]),
        speed=speed,
        force_x=float(row[Patch.FORCE_X]),
        force_y=float(row[Patch.FORCE_Y]),
        moment_z=float(row[Patch.MOMENT_Z]),
        Q=vertical,
        Y=outwards,
        angle_of_attack=yaw,
        y_wheelset=lateral,
        approach=float(row[Patch.APPROACH]),
        roll=roll,
        s=arc_length,
    )


def from_log_row(row: Mapping[str, Any]) -> ContactState:
    """The patch of one row of a contact log.

    Parameters
    ----------
    row : Mapping
        Column name to value, as `pyarrow.Table.to_pylist` gives it; columns that a patch has not are left
        out.

    Raises
    ------
    ValueError
        A column is missing, or its value is no finite number.
    """
    values: dict[str, Any] = {}
    for field in fields(ContactState):
        if field.name not in row:
            raise ValueError(f"row of a contact log: column {field.name} is missing")
        value = row[field.name]
        if not (isinstance(value, Real) and math.isfinite(value)):
            raise ValueError(f"row of a contact log: {field.name} = {value}, allowed a finite number")
        values[field.name] = round(float(value)) if field.name == "side" else float(value)
    return ContactState(**values)
