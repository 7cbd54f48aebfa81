"""The forces of one contact patch: normal contact, creepages, creep forces (kernel).

Hertz's ellipse or the strips of `non_elliptic` give normal force and patch from the approach, the creepages
come from the rigid-body velocity of the wheel's material at the contact point relative to the rail,
`friction` the coefficient for this patch at its slip, `tangential` the creep forces.

The slip speed on which friction falls is that of the patch as a whole (creepages times speed, Polach's w):
neither the spin, whose slip cancels about the middle, nor what adheres within the patch is seen.

The contact frame C is T rolled about x by side * contact angle: x the rolling direction along the rail, z the
normal from the rail into the wheel. The contact point of an ellipse is the point of deepest interpenetration,
that of a patch of strips its centre of pressure; the patch is plane.
"""

import math

from hh_exudyn.contact.fastrip import force_on_strips
from hh_exudyn.contact.friction import FrictionTable, friction_at
from hh_exudyn.contact.hertz import normal_contact
from hh_exudyn.contact.non_elliptic import CURVATURE_FLOOR, HERTZ, minimum, patch_strips
from hh_exudyn.contact.search import (
    APPROACH,
    CONTACT_ANGLE,
    POINT,
    RADIUS,
    RAIL_CURVATURE,
    STIFFNESS,
    WHEEL_CURVATURE,
    Y_RAIL,
    Y_WHEEL,
)
from hh_exudyn.contact.silhouette import WheelRailPair
from hh_exudyn.contact.tangential import force_kernel
from hh_exudyn.contact.theories import GIVEN
from hh_exudyn.contact.types import FloatArray, Patch, RollingPatch, WheelRailModel
from hh_exudyn.kernel import inlined_kernel

CREEPAGE_SPEED_FLOOR = 0.1  # m/s, the least speed that creepages refer to

_PATCH_Y_WHEEL = int(Patch.Y_WHEEL)
_PATCH_Y_RAIL = int(Patch.Y_RAIL)
_PATCH_X_SHIFT = int(Patch.X_SHIFT)
_PATCH_CONTACT_ANGLE = int(Patch.CONTACT_ANGLE)
_PATCH_ROLLING_RADIUS = int(Patch.ROLLING_RADIUS)
_PATCH_NORMAL_FORCE = int(Patch.NORMAL_FORCE)
_PATCH_A = int(Patch.A)
_PATCH_B = int(Patch.B)
_PATCH_P_MAX = int(Patch.P_MAX)
_PATCH_NU_X = int(Patch.NU_X)
_PATCH_NU_Y = int(Patch.NU_Y)
_PATCH_PHI = int(Patch.PHI)
_PATCH_FRICTION = int(Patch.FRICTION)
_PATCH_FORCE_X = int(Patch.FORCE_X)
_PATCH_FORCE_Y = int(Patch.FORCE_Y)
_PATCH_MOMENT_Z = int(Patch.MOMENT_Z)
_PATCH_APPROACH = int(Patch.APPROACH)
_PATCH_POWER = int(Patch.POWER)
_PATCH_FLOORED = int(Patch.FLOORED)


@inlined_kernel
def add_patch(
    model: WheelRailModel,
    pair: WheelRailPair,
    contact: FloatArray,
    strips: FloatArray,
    velocity: FloatArray,
    angular_velocity: FloatArray,
    rail_velocity: FloatArray,
    creep_lag: FloatArray,
    friction_table: FrictionTable,
    wheelset: int,
    arc_length: float,
    wrench: FloatArray,
    rail_force: FloatArray,
    patch: FloatArray,
) -> bool:
    """Add the forces of one patch to the wrenches and fill its row; False where it carries no force."""
    floored = 0.5 * (contact[WHEEL_CURVATURE] + contact[RAIL_CURVATURE]) < CURVATURE_FLOOR
    if model.normal == HERTZ:
        # A and B are half the sums of the curvatures in the normal section
        elastic, a, b, max_pressure = normal_contact(
            contact[APPROACH],
            0.5 * math.cos(contact[CONTACT_ANGLE]) / contact[RADIUS],
            max(0.5 * (contact[WHEEL_CURVATURE] + contact[RAIL_CURVATURE]), CURVATURE_FLOOR),
            model.shear_modulus,
            model.poisson_ratio,
        )
    else:
        low = minimum(model.normal, pair, contact, model.shear_modulus, model.poisson_ratio)
        elastic, max_pressure, a, b, _ = patch_strips(pair, contact, low, contact[STIFFNESS], strips)

    angle = contact[CONTACT_ANGLE]
    cosine, sine = math.cos(angle), pair.side * math.sin(angle)  # C is T rolled by side * angle

    # Velocity of the wheel's material at the contact point relative to the rail, axes of T then of C
    px, py, pz = contact[POINT], contact[POINT + 1], contact[POINT + 2]
    wx, wy, wz = angular_velocity[0], angular_velocity[1], angular_velocity[2]
    slip_x = velocity[0] + wy * pz - wz * py + creep_lag[0]
    across = velocity[1] + wz * px - wx * pz - rail_velocity[0]
    upward = velocity[2] + wx * py - wy * px - rail_velocity[1]
    slip_y = cosine * (across + creep_lag[1]) + sine * upward
    approach_rate = sine * across - cosine * upward
    spin = -sine * wy + cosine * wz
    if model.theory == GIVEN:
        slip_x -= wy * model.given.conicity * contact[Y_WHEEL] + creep_lag[0]
        slip_y -= cosine * creep_lag[1]

    factor = 1.0 + model.damping * approach_rate
    if not elastic > 0.0 or factor <= 0.0:
        return False
    normal = elastic * factor

    # Creep forces (equations.md 2.12-2.15 are the small-angle form of these creepages)
    speed = max(velocity[0], CREEPAGE_SPEED_FLOOR)
    nu_x, nu_y, phi = slip_x / speed, slip_y / speed, spin / speed
    side = 0 if pair.side > 0.0 else 1
    friction = friction_at(friction_table, wheelset, side, arc_length, angle, math.hypot(slip_x, slip_y))
    rolling = RollingPatch(a, b, normal, nu_x, nu_y, phi, friction, model.shear_modulus, model.poisson_ratio)
    if model.theory == GIVEN:
        force_x, force_y, moment_z = -model.given.longitudinal * nu_x, -model.given.lateral * nu_y, 0.0
    elif model.normal == HERTZ:
        force_x, force_y, moment_z = force_kernel(model.theory, rolling, model.cells_x, model.cells_y)
    elif friction > 0.0:
        force_x, force_y, moment_z = force_on_strips(strips, strips.shape[0], rolling, model.cells_x)
    else:
        force_x, force_y, moment_z = 0.0, 0.0, 0.0

    force_across = cosine * force_y - sine * normal
    force_up = sine * force_y + cosine * normal
    wrench[0] += force_x
    wrench[1] += force_across
    wrench[2] += force_up
    wrench[3] += py * force_up - pz * force_across
    wrench[4] += pz * force_x - px * force_up - sine * moment_z
    wrench[5] += px * force_across - py * force_x + cosine * moment_z
    rail_force[0] -= force_across
    rail_force[1] -= force_up

    patch[_PATCH_Y_WHEEL] = contact[Y_WHEEL]
    patch[_PATCH_Y_RAIL] = contact[Y_RAIL]
    patch[_PATCH_X_SHIFT] = px
    patch[_PATCH_CONTACT_ANGLE] = angle
    patch[_PATCH_ROLLING_RADIUS] = contact[RADIUS]
    patch[_PATCH_NORMAL_FORCE] = normal
    patch[_PATCH_A] = a
    patch[_PATCH_B] = b
    patch[_PATCH_P_MAX] = max_pressure * factor  # of the whole normal force on the ellipse
    patch[_PATCH_NU_X] = nu_x
    patch[_PATCH_NU_Y] = nu_y
    patch[_PATCH_PHI] = phi
    patch[_PATCH_FRICTION] = friction
    patch[_PATCH_FORCE_X] = force_x
    patch[_PATCH_FORCE_Y] = force_y
    patch[_PATCH_MOMENT_Z] = moment_z
    patch[_PATCH_APPROACH] = contact[APPROACH]
    # Lost are the creep power and the damping part of the normal power; the elastic part comes back.
    patch[_PATCH_POWER] = -(force_x * slip_x + force_y * slip_y + moment_z * spin) + (
        (normal - elastic) * approach_rate
    )
    patch[_PATCH_FLOORED] = 1.0 if floored else 0.0
    return True
