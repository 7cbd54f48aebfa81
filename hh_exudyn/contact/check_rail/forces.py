"""Forces of the wheels on their check rails, added to those on the running rails (kernel)."""

import math

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.check_rail.overlap import Back, flangeway_at, overlapping_slices
from hh_exudyn.contact.check_rail.table import BackContact, CheckRailTable
from hh_exudyn.contact.geometry.rail_tables import gauge_point_at
from hh_exudyn.contact.strips.loads import solve_loads
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import (
    CREEPAGE_SPEED_FLOOR,
    ContactForces,
    Memory,
    RailMotion,
    WheelRailModel,
    WheelsetMotion,
)
from hh_exudyn.kernel import kernel, memory, shaped

FULL_SLIP = 2e-3  # creepage about which friction has its full size; a sliding back has ten times more
_STATE = ROWS * CAPACITY


@kernel
def check_rail_forces(
    check: CheckRailTable,
    model: WheelRailModel,
    wheelsets: WheelsetMotion,
    rails: RailMotion,
    forces: ContactForces,
    records: FloatArray,
) -> int:
    """Add the forces of n wheelsets' flange backs on check rails (kernel: trusts its input).

    Parameters
    ----------
    check : CheckRailTable
        From `table.check_rail_table`.
    model, wheelsets, rails : WheelRailModel, WheelsetMotion, RailMotion
        As of `wheel_rail.wheel_rail_forces`, which comes before.
    forces : ContactForces
        Wrench and rail force are added to: the check rail stands on the sleepers of its running rail.
    records : FloatArray
        (n, 2, columns) by `BackContact`, written.

    Returns
    -------
    int
        0, or 1 + 2 * wheelset + side index of the first wheel without a solution for the loads.
    """
    state = memory(_STATE)
    guess = shaped(memory(CAPACITY), (CAPACITY,))
    records[:] = 0.0
    for i in range(wheelsets.position.shape[0]):
        for index in range(2):
            side = 1.0 - 2.0 * index
            s = rails.arc_length[i]
            if flangeway_at(check, side, s)[0] == math.inf:
                continue
            along = model.rails_left if index == 0 else model.rails_right
            back = _back(check, model, wheelsets, rails, i, index)
            count = overlapping_slices(check, back, s, gauge_point_at(along, s), rails.turn[i, 2], state)
            if count == 0:
                continue
            guess[:] = 0.0
            modulus = model.shear_modulus / (1.0 - model.poisson_ratio)
            if not solve_loads(count, modulus, guess, state, check.compliance):
                return 1 + 2 * i + index
            _add(check, model, wheelsets, rails, i, index, count, state, forces, records[i, index])
            if not math.isfinite(records[i, index, BackContact.FORCE_Y]):
                return 1 + 2 * i + index
    return 0


@kernel
def _back(
    check: CheckRailTable,
    model: WheelRailModel,
    wheelsets: WheelsetMotion,
    rails: RailMotion,
    i: int,
    index: int,
) -> Back:
    """The flange back of a wheel beside its check rail."""
    rotation, axle = rails.rotation[i, index], wheelsets.axle[i]
    y = wheelsets.position[i, 1] - rails.position[i, index, 0]
    z = wheelsets.position[i, 2] - rails.position[i, index, 1]
    x = wheelsets.position[i, 0]
    return Back(
        side=1.0 - 2.0 * index,
        centre_y=rotation[0, 1] * x + rotation[1, 1] * y + rotation[2, 1] * z,
        centre_z=rotation[0, 2] * x + rotation[1, 2] * y + rotation[2, 2] * z,
        axle_x=rotation[0, 0] * axle[0] + rotation[1, 0] * axle[1] + rotation[2, 0] * axle[2],
        axle_y=rotation[0, 1] * axle[0] + rotation[1, 1] * axle[1] + rotation[2, 1] * axle[2],
        axle_z=rotation[0, 2] * axle[0] + rotation[1, 2] * axle[1] + rotation[2, 2] * axle[2],
        half_distance=check.half_distance,
        edge=model.nominal_radius + check.back_depths[i, index],
        upper=check.height - check.corner_radius,
        corner=check.corner_radius,
    )


@kernel
def _add(
    check: CheckRailTable,
    model: WheelRailModel,
    wheelsets: WheelsetMotion,
    rails: RailMotion,
    i: int,
    index: int,
    count: int,
    state: Memory,
    forces: ContactForces,
    record: FloatArray,
) -> None:
    """Friction of the loaded slices; their forces into wrench, rail force and record."""
    rows = shaped(state, (ROWS, CAPACITY))
    vectors = shaped(memory(12), (4, 3))
    velocity, spin, force, moment = vectors[0], vectors[1], vectors[2], vectors[3]
    rotation = rails.rotation[i, index]
    moves = rails.velocity[i, index]
    for axis in range(3):
        column = rotation[:, axis]
        velocity[axis] = (
            column[0] * wheelsets.velocity[i, 0]
            + column[1] * (wheelsets.velocity[i, 1] - moves[0])
            + column[2] * (wheelsets.velocity[i, 2] - moves[1])
        )
        spin[axis] = (
            column[0] * wheelsets.angular_velocity[i, 0]
            + column[1] * wheelsets.angular_velocity[i, 1]
            + column[2] * wheelsets.angular_velocity[i, 2]
        )
    force[:] = 0.0
    moment[:] = 0.0
    speed = max(wheelsets.velocity[i, 0], CREEPAGE_SPEED_FLOOR)
    modulus = model.shear_modulus / (1.0 - model.poisson_ratio)
    side = 1.0 - 2.0 * index
    for j in range(count):
        if rows[Row.LOAD, j] > 0.0:
            _add_slice(j, side, speed, check.friction, model.damping, modulus, state, vectors, record)
    if not record[BackContact.NORMAL_FORCE] > 0.0:
        record[:] = 0.0
        return
    for column in (BackContact.X_SHIFT, BackContact.HEIGHT, BackContact.CREEPAGE):
        record[column] /= record[BackContact.NORMAL_FORCE]
    wrench = forces.wrench[i]
    for axis in range(3):
        row = rotation[axis]
        there = row[0] * force[0] + row[1] * force[1] + row[2] * force[2]
        record[BackContact.FORCE_X + axis] = there
        wrench[axis] += there
        wrench[3 + axis] += row[0] * moment[0] + row[1] * moment[1] + row[2] * moment[2]
        if axis > 0:
            forces.rail_force[i, index, axis - 1] -= there


@kernel
def _add_slice(
    j: int,
    side: float,
    speed: float,
    friction: float,
    damping: float,
    modulus: float,
    state: Memory,
    vectors: FloatArray,
    record: FloatArray,
) -> None:
    """Add one slice to `vectors` (velocity, spin, force, moment; the latter two) and to the record."""
    rows = shaped(state, (ROWS, CAPACITY))
    velocity, spin, force, moment = vectors[0], vectors[1], vectors[2], vectors[3]
    px, py, pz = rows[Row.X, j], rows[Row.Y, j], rows[Row.Z, j]
    # the normal from the check rail into the wheel, across the rail's own direction (1, heading, 0)
    nx = -rows[Row.HEADING, j] * side * rows[Row.COSINE, j]
    ny, nz = side * rows[Row.COSINE, j], rows[Row.SINE, j]
    inverse = 1.0 / math.sqrt(nx * nx + ny * ny + nz * nz)
    nx, ny, nz = nx * inverse, ny * inverse, nz * inverse
    vx = velocity[0] + spin[1] * pz - spin[2] * py
    vy = velocity[1] + spin[2] * px - spin[0] * pz
    vz = velocity[2] + spin[0] * py - spin[1] * px
    rate = -(vx * nx + vy * ny + vz * nz)
    elastic = rows[Row.LOAD, j]
    load = elastic * max(1.0 + damping * rate, 0.0)
    vx, vy, vz = vx + rate * nx, vy + rate * ny, vz + rate * nz
    square = vx * vx + vy * vy + vz * vz
    share = friction * load / math.sqrt(square + (FULL_SLIP * speed) ** 2)
    fx, fy, fz = load * nx - share * vx, load * ny - share * vy, load * nz - share * vz
    force[0] += fx
    force[1] += fy
    force[2] += fz
    moment[0] += py * fz - pz * fy
    moment[1] += pz * fx - px * fz
    moment[2] += px * fy - py * fx
    record[BackContact.NORMAL_FORCE] += load
    record[BackContact.X_SHIFT] += load * px
    record[BackContact.HEIGHT] += load * rows[Row.Y_RAIL, j]
    record[BackContact.CREEPAGE] += load * math.sqrt(square) / speed
    record[BackContact.OVERLAP] = max(record[BackContact.OVERLAP], rows[Row.OVERLAP, j])
    # a line contact under the load per length (Johnson, Contact Mechanics, 1985, section 4.2c)
    line = 2.0 * rows[Row.CURVATURE, j] * load / rows[Row.WIDTH, j]
    record[BackContact.P_MAX] = max(record[BackContact.P_MAX], math.sqrt(line * modulus / math.pi))
    record[BackContact.POWER] += share * square + (load - elastic) * rate
