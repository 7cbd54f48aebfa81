"""All forces of one wheel by coupled strips: overlaps, loads, slip, creep forces, rows of the log (kernel).

`strips` gives the pieces; here is their order. Every strip has its own normal, slip and friction, and its
forces act at its own point of the wheel. A run of strips that touch is a patch of the log: its normal force
and contact angle are those of the resultant of its strips' normal forces, its place and creepages means
weighted by the load, its semi-axes those of the ellipse of which the most loaded strip is a part.

The contact frame of a strip is built as that of an ellipse (`contact_frame`), with the mean of the angles of
wheel and rail at this strip.
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.contact_frame import axes_of, moved_ahead, turn_of_rail
from hh_exudyn.contact.friction import FrictionTable, depends_on_wheel_alone, friction_at
from hh_exudyn.contact.geometry.rail_tables import changes_at, surface_slope
from hh_exudyn.contact.geometry.silhouette import WheelRailPair
from hh_exudyn.contact.state import PATCH_COLUMNS, Patch
from hh_exudyn.contact.strips.creep import strip_creep_forces
from hh_exudyn.contact.strips.loads import first_half_lengths, solve_loads
from hh_exudyn.contact.strips.overlap import overlapping_strips
from hh_exudyn.contact.strips.pressure import refined_pressures
from hh_exudyn.contact.strips.shape import shape_strips, touch
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import (
    CREEPAGE_SPEED_FLOOR,
    MAX_PATCHES,
    ContactForces,
    Memory,
    RailMotion,
    Triple,
    WheelRailModel,
    WheelsetMotion,
)
from hh_exudyn.contact.wheels import strips_in
from hh_exudyn.kernel import inlined_kernel, kernel, memory, shaped

_STATE = ROWS * CAPACITY
_ROOM = MAX_PATCHES + 1  # for records: one more than are given back
_RECORDS = _ROOM * PATCH_COLUMNS


@inlined_kernel
def add_strips(
    model: WheelRailModel,
    pair: WheelRailPair,
    wheelsets: WheelsetMotion,
    rails: RailMotion,
    friction: FrictionTable,
    i: int,
    forces: ContactForces,
) -> bool:
    """Add the forces of one wheel of wheelset i (kernel: trusts its input).

    Parameters
    ----------
    model, pair, wheelsets, rails, friction, i
        As of `patch_forces.add_patch`, `friction` its `friction_table`.
    forces : ContactForces
        Wrench and rail force are added to, the records of the patches and the strips in contact written.

    Returns
    -------
    bool
        Whether the loads were found.
    """
    state = memory(_STATE)
    side = 0 if pair.side > 0.0 else 1
    strips = strips_in(model, i, side)
    count = overlapping_strips(pair, strips, state)
    if count == 0:
        return True
    modulus = model.shear_modulus / (1.0 - model.poisson_ratio)
    first_half_lengths(count, state)
    if not solve_loads(count, modulus, forces.in_contact[i, side], state):
        return False
    _slip(model, pair, wheelsets, rails, i, count, state)
    shape_strips(count, modulus, state)
    _friction(friction, max(wheelsets.velocity[i, 0], CREEPAGE_SPEED_FLOOR), rails, i, side, count, state)
    strip_creep_forces(count, model.shear_modulus, model.poisson_ratio, model.cells_x, state)
    _add_wrench(pair, rails, i, count, state, forces)
    if forces.refine[0] > 0.0:
        refined_pressures(count, modulus, state)
    _write_patches(
        model,
        pair,
        i,
        wheelsets.velocity[i, 0],
        rails.rotation[i, side],
        Row.REFINED if forces.refine[0] > 0.0 else Row.PRESSURE,
        count,
        state,
        forces.patches[i, side],
    )
    return True


@inlined_kernel
def _slip(
    model: WheelRailModel,
    pair: WheelRailPair,
    wheelsets: WheelsetMotion,
    rails: RailMotion,
    i: int,
    count: int,
    state: Memory,
) -> None:
    """Creepages of the strips and the damping of their loads, in axes of R."""
    s = shaped(state, (ROWS, CAPACITY))
    side = 0 if pair.side > 0.0 else 1
    along_rail = model.rails_left if side == 0 else model.rails_right
    strips = strips_in(model, i, side)
    velocity = _into(
        rails.rotation[i, side],
        wheelsets.velocity[i, 0],
        wheelsets.velocity[i, 1] - rails.velocity[i, side, 0],
        wheelsets.velocity[i, 2] - rails.velocity[i, side, 1],
    )
    wx, wy, wz = _into(
        rails.rotation[i, side],
        wheelsets.angular_velocity[i, 0],
        wheelsets.angular_velocity[i, 1],
        wheelsets.angular_velocity[i, 2],
    )
    lag_x, lag_y = wheelsets.creep_lag[i, side, 0], wheelsets.creep_lag[i, side, 1]
    turn = (rails.turn[i, 0], rails.turn[i, 1], rails.turn[i, 2])
    changes = changes_at(along_rail, rails.arc_length[i])
    for j in range(count):
        slope = surface_slope(along_rail, rails.arc_length[i], s[Row.Y_RAIL, j]) if changes else 0.0
        s[Row.SLOPE, j] = slope
    inverse_speed = 1.0 / max(wheelsets.velocity[i, 0], CREEPAGE_SPEED_FLOOR)
    for j in range(count):
        k = np.uint64(s[Row.NUMBER, j])
        px, py, pz = s[Row.X, j], s[Row.Y, j], s[Row.Z, j]
        heading, slope = turn_of_rail(pair, (px, py, pz), turn)
        slope += s[Row.SLOPE, j]
        px += moved_ahead(pair, strips.y[k], strips.slope[k], (px, py, pz), heading, slope)
        s[Row.X, j], s[Row.HEADING, j], s[Row.SLOPE, j] = px, heading, slope
        along, across, normal = axes_of(s[Row.COSINE, j], pair.side * s[Row.SINE, j], heading, slope)
        x = velocity[0] + wy * pz - wz * py
        y = velocity[1] + wz * px - wx * pz
        z = velocity[2] + wx * py - wy * px
        slip_x = x * along[0] + y * along[1] + z * along[2] + lag_x
        slip_y = x * across[0] + y * across[1] + z * across[2] + s[Row.COSINE, j] * lag_y
        rate = -(x * normal[0] + y * normal[1] + z * normal[2])
        s[Row.NU_X, j], s[Row.NU_Y, j] = slip_x * inverse_speed, slip_y * inverse_speed
        s[Row.PHI, j] = (wx * normal[0] + wy * normal[1] + wz * normal[2]) * inverse_speed
        s[Row.APPROACH_RATE, j] = rate
        s[Row.LOAD, j] *= max(1.0 + model.damping * rate, 0.0)


@kernel
def _friction(
    table: FrictionTable, speed: float, rails: RailMotion, i: int, side: int, count: int, state: Memory
) -> None:
    """Friction of the strips that carry load, at the slip in the middle of their ellipses."""
    s = shaped(state, (ROWS, CAPACITY))
    if depends_on_wheel_alone(table, i):
        friction = friction_at(table, i, side, rails.arc_length[i], 0.0, 0.0)
        for j in range(count):
            s[Row.FRICTION, j] = friction
        return
    for j in range(count):
        if s[Row.LOAD, j] > 0.0:
            s[Row.FRICTION, j] = friction_at(
                table,
                i,
                side,
                rails.arc_length[i],
                math.atan2(s[Row.SINE, j], s[Row.COSINE, j]),
                speed * math.hypot(s[Row.MEAN_X, j], s[Row.MEAN_Y, j]),
            )


@kernel
def _add_wrench(
    pair: WheelRailPair, rails: RailMotion, i: int, count: int, state: Memory, forces: ContactForces
) -> None:
    """Add the strips' forces to the wrench of wheelset i, axes of T, and to the load of its rail."""
    s = shaped(state, (ROWS, CAPACITY))
    side = 0 if pair.side > 0.0 else 1
    fx, fy, fz, mx, my, mz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(count):
        if s[Row.LOAD, j] > 0.0:
            along, across, normal = axes_of(
                s[Row.COSINE, j], pair.side * s[Row.SINE, j], s[Row.HEADING, j], s[Row.SLOPE, j]
            )
            force = (s[Row.FORCE_X, j], s[Row.FORCE_Y, j], s[Row.LOAD, j])
            x = force[0] * along[0] + force[1] * across[0] + force[2] * normal[0]
            y = force[0] * along[1] + force[1] * across[1] + force[2] * normal[1]
            z = force[0] * along[2] + force[1] * across[2] + force[2] * normal[2]
            px, py, pz, moment = s[Row.X, j], s[Row.Y, j], s[Row.Z, j], s[Row.MOMENT_Z, j]
            fx, fy, fz = fx + x, fy + y, fz + z
            mx += py * z - pz * y + moment * normal[0]
            my += pz * x - px * z + moment * normal[1]
            mz += px * y - py * x + moment * normal[2]
    rotation, wrench = rails.rotation[i, side], forces.wrench[i]
    for axis in range(3):
        row = rotation[axis]
        force_axis = row[0] * fx + row[1] * fy + row[2] * fz
        wrench[axis] += force_axis
        wrench[3 + axis] += row[0] * mx + row[1] * my + row[2] * mz
        if axis > 0:
            forces.rail_force[i, side, axis - 1] -= force_axis


@kernel
def _write_patches(
    model: WheelRailModel,
    pair: WheelRailPair,
    i: int,
    speed: float,
    rotation: FloatArray,
    pressure: int,
    count: int,
    state: Memory,
    patches: FloatArray,
) -> None:
    """Write a record of every run of touching strips, the most loaded first, as many as there is room for."""
    s = shaped(state, (ROWS, CAPACITY))
    records = shaped(memory(_RECORDS), (_ROOM, PATCH_COLUMNS))
    present, first = 0, 0
    while first < count:
        last = first
        if s[Row.LOAD, first] > 0.0:
            while last + 1 < count and touch(last, state):
                last += 1
            _write_patch(model, pair, i, speed, rotation, pressure, first, last, state, records[present])
            place = present
            while place > 0 and records[place, Patch.NORMAL_FORCE] > records[place - 1, Patch.NORMAL_FORCE]:
                for column in range(PATCH_COLUMNS):
                    records[place, column], records[place - 1, column] = (
                        records[place - 1, column],
                        records[place, column],
                    )
                place -= 1
            present = min(present + 1, MAX_PATCHES)
        first = last + 1
    for row in range(present):
        for column in range(PATCH_COLUMNS):
            patches[row, column] = records[row, column]


@inlined_kernel
def _write_patch(
    model: WheelRailModel,
    pair: WheelRailPair,
    i: int,
    speed: float,
    rotation: FloatArray,
    pressure: int,
    first: int,
    last: int,
    state: Memory,
    record: FloatArray,
) -> None:
    """Fill the record of one run of strips."""
    s = shaped(state, (ROWS, CAPACITY))
    strips = strips_in(model, i, 0 if pair.side > 0.0 else 1)
    for column in range(PATCH_COLUMNS):
        record[column] = 0.0
    total, inward, upward, power, peak = 0.0, 0.0, 0.0, 0.0, -1.0
    px, py, pz = 0.0, 0.0, 0.0
    for j in range(first, last + 1):
        load, rate = s[Row.LOAD, j], s[Row.APPROACH_RATE, j]
        total += load
        upward += load * s[Row.COSINE, j]
        inward += load * s[Row.SINE, j]
        px, py, pz = px + load * s[Row.X, j], py + load * s[Row.Y, j], pz + load * s[Row.Z, j]
        record[Patch.Y_WHEEL] += load * strips.y[int(s[Row.NUMBER, j])]
        record[Patch.Y_RAIL] += load * s[Row.Y_RAIL, j]
        record[Patch.ROLLING_RADIUS] += load * s[Row.RADIUS, j]
        record[Patch.NU_X] += load * s[Row.NU_X, j]
        record[Patch.NU_Y] += load * s[Row.NU_Y, j]
        record[Patch.PHI] += load * s[Row.PHI, j]
        record[Patch.FRICTION] += load * s[Row.FRICTION, j]
        record[Patch.APPROACH] = max(record[Patch.APPROACH], s[Row.OVERLAP, j])
        record[Patch.P_MAX] = max(record[Patch.P_MAX], s[pressure, j])
        if load > peak:
            peak, record[Patch.A], record[Patch.B] = load, s[Row.A, j], s[Row.B, j]
        # lost are the creep power and the damping part of the normal power; the elastic part comes back
        power -= max(speed, CREEPAGE_SPEED_FLOOR) * (
            s[Row.FORCE_X, j] * s[Row.NU_X, j]
            + s[Row.FORCE_Y, j] * s[Row.NU_Y, j]
            + s[Row.MOMENT_Z, j] * s[Row.PHI, j]
        )
        power += load * rate * (1.0 - 1.0 / (1.0 + model.damping * rate))
    inverse = 1.0 / total
    for column in (
        Patch.Y_WHEEL,
        Patch.Y_RAIL,
        Patch.ROLLING_RADIUS,
        Patch.NU_X,
        Patch.NU_Y,
        Patch.PHI,
        Patch.FRICTION,
    ):
        record[column] *= inverse
    px, py, pz = px * inverse, py * inverse, pz * inverse
    normal_force = math.sqrt(upward * upward + inward * inward)
    cosine, sine = upward / normal_force, inward / normal_force
    record[Patch.NORMAL_FORCE] = normal_force
    record[Patch.CONTACT_ANGLE] = math.atan2(inward, upward)
    record[Patch.X_SHIFT] = rotation[0, 0] * px + rotation[0, 1] * py + rotation[0, 2] * pz
    record[Patch.POWER] = power
    record[Patch.CENTRE_Y], record[Patch.CENTRE_Z] = pair.centre_y, pair.centre_z
    for j in range(first, last + 1):
        # tangents and normals of the strips in the plane across the rail, seen from those of the patch
        turn = cosine * s[Row.COSINE, j] + sine * s[Row.SINE, j]
        lateral = s[Row.FORCE_Y, j]
        record[Patch.FORCE_X] += s[Row.FORCE_X, j]
        record[Patch.FORCE_Y] += lateral * turn
        across = (s[Row.Y, j] - py) * cosine + pair.side * (s[Row.Z, j] - pz) * sine
        record[Patch.MOMENT_Z] += (
            s[Row.MOMENT_Z, j] * turn + (s[Row.X, j] - px) * lateral * turn - across * s[Row.FORCE_X, j]
        )


@inlined_kernel
def _into(rotation: FloatArray, x: float, y: float, z: float) -> Triple:
    """A vector of T in axes of R."""
    return (
        rotation[0, 0] * x + rotation[1, 0] * y + rotation[2, 0] * z,
        rotation[0, 1] * x + rotation[1, 1] * y + rotation[2, 1] * z,
        rotation[0, 2] * x + rotation[1, 2] * y + rotation[2, 2] * z,
    )
