"""The state of one contact patch: the record of the kernels, and a row of the contact log by attributes.

`Patch` names the columns of the kernels' record and `write_patch` fills it: a new quantity is a member of the
one and a line of the other. `ContactState` is a row of the contact log by attributes. Their names are those
of the log's channels (`hh_exudyn.log.channels`, with units and meanings); tests/log checks that they agree.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from enum import IntEnum
from numbers import Real
from typing import Any

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry import search
from hh_exudyn.contact.types import ContactFrame, NormalContact, RollingPatch, SlipVelocity, Triple
from hh_exudyn.kernel import inlined_kernel


class Patch(IntEnum):
    """Columns of one contact state, as the kernels write it. Frame C, forces on the wheel, SI units."""

    Y_WHEEL = 0  # lateral position on the wheel profile, side coordinates [m]
    Y_RAIL = 1  # lateral position on the rail profile, side coordinates [m]
    X_SHIFT = 2  # contact ahead (+) of the wheelset's centre along the track, x of T [m]
    CONTACT_ANGLE = 3  # of the contact plane about the rail's x axis, positive towards the flange [rad]
    ROLLING_RADIUS = 4  # [m]
    NORMAL_FORCE = 5  # [N]
    A = 6  # semi-axis in rolling direction, of the equivalent ellipse if the patch is made of strips [m]
    B = 7  # lateral semi-axis [m]
    P_MAX = 8  # largest pressure [Pa]
    NU_X = 9  # longitudinal creepage [-]
    NU_Y = 10  # lateral creepage [-]
    PHI = 11  # spin creepage [1/m]
    FRICTION = 12  # friction coefficient [-]
    FORCE_X = 13  # [N]
    FORCE_Y = 14  # [N]
    MOMENT_Z = 15  # [N m]
    APPROACH = 16  # elastic approach along the normal [m]
    POWER = 17  # power lost in the contact, creep and contact damping, > 0 is dissipation [W]
    CENTRE_Y = (
        18  # wheelset's centre from the origin of the rail's profile, axes of R: with roll and angle of
    )
    CENTRE_Z = 19  # attack the pose of the wheel on its rail [m]
    FLOORED = 20  # 1 where the lateral curvature met its floor (conformal contact), else 0


PATCH_COLUMNS = len(Patch)


@inlined_kernel
def write_patch(
    record: FloatArray,
    contact: FloatArray,
    frame: ContactFrame,
    rolling: RollingPatch,
    creep: Triple,
    normal: NormalContact,
    slip: SlipVelocity,
) -> None:
    """Fill the record of one patch (kernel).

    Parameters
    ----------
    record : FloatArray
        (PATCH_COLUMNS,) out, by `Patch`.
    contact : FloatArray
        (CONTACT_COLUMNS,) of the contact search.
    frame : ContactFrame
        Point and axes.
    rolling : RollingPatch
        Ellipse, normal force with contact damping, creepages, friction.
    creep : tuple of float
        F_x, F_y [N] and M_z [N m] on the wheel.
    normal : NormalContact
        Of the normal theory.
    slip : SlipVelocity
        At the contact point.
    """
    force_x, force_y, moment_z = creep
    record[Patch.Y_WHEEL] = contact[search.Y_WHEEL]
    record[Patch.Y_RAIL] = contact[search.Y_RAIL]
    record[Patch.X_SHIFT] = frame.point[0]
    record[Patch.CONTACT_ANGLE] = contact[search.CONTACT_ANGLE]
    record[Patch.ROLLING_RADIUS] = contact[search.RADIUS]
    record[Patch.NORMAL_FORCE] = rolling.normal_force
    record[Patch.A] = rolling.a
    record[Patch.B] = rolling.b
    record[Patch.P_MAX] = normal.max_pressure
    record[Patch.NU_X] = rolling.nu_x
    record[Patch.NU_Y] = rolling.nu_y
    record[Patch.PHI] = rolling.phi
    record[Patch.FRICTION] = rolling.friction
    record[Patch.FORCE_X] = force_x
    record[Patch.FORCE_Y] = force_y
    record[Patch.MOMENT_Z] = moment_z
    record[Patch.APPROACH] = contact[search.APPROACH]
    # Lost are the creep power and the damping part of the normal power; the elastic part comes back.
    record[Patch.POWER] = -(force_x * slip.along + force_y * slip.across + moment_z * slip.spin) + (
        (rolling.normal_force - normal.elastic) * slip.approach
    )
    record[Patch.FLOORED] = 1.0 if normal.floored else 0.0


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
    centre_y, centre_z : float
        Centre of the wheelset from the origin of the rail's profile, axes of R [m].
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
    centre_y: float
    centre_z: float
    roll: float
    s: float


def contact_state(record: FloatArray, **wheel: float) -> ContactState:
    """A patch by names, from the kernels' record and the quantities of its wheel.

    Parameters
    ----------
    record : FloatArray
        (PATCH_COLUMNS,) of `write_patch`.
    wheel : int or float
        The attributes of `ContactState` that are not columns of the record: side, speed, Q, Y,
        angle_of_attack, y_wheelset, roll, s.

    Raises
    ------
    TypeError
        One of them is missing or unknown.
    """
    names = {field.name for field in fields(ContactState)}
    columns = {name: float(record[column]) for column in Patch if (name := column.name.lower()) in names}
    return ContactState(**columns, **wheel)  # type: ignore[arg-type]


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
