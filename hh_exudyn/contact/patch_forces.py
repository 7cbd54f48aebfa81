"""The forces of one contact patch: normal contact, creepages, creep forces (kernel).

An ellipse (`hertz`, `equivalent_elastic`) or the strips of `non_elliptic` give normal force and patch, the
creepages come from the rigid-body velocity of the wheel's material at the contact point relative to the rail,
`friction` the coefficient for this patch at its slip, `tangential` the creep forces.

The slip speed on which friction falls is that of the patch as a whole (creepages times speed, Polach's w):
neither the spin, of which the slip cancels about the middle, nor adhesion within the patch counts.

The contact point of Hertz's ellipse is the point of deepest interpenetration, that of `equivalent_elastic`
the centroid of the overlap, that of a patch of strips its centre of pressure; the patch is plane. Forces act
at the contact point on the undeformed wheel (half an approach, some 0.05 mm, from where the deformed surfaces
meet: without influence on any moment).
"""

import math

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.contact_frame import axes_of, moved_ahead, turn_of_rail
from hh_exudyn.contact.friction import FrictionTable, friction_at
from hh_exudyn.contact.geometry.rail_tables import surface_slope
from hh_exudyn.contact.geometry.search import (
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
from hh_exudyn.contact.geometry.silhouette import WheelRailPair
from hh_exudyn.contact.normal.equivalent_elastic import hertz_of_ellipse
from hh_exudyn.contact.normal.hertz import CURVATURE_FLOOR, normal_contact
from hh_exudyn.contact.normal.non_elliptic import minimum, patch_strips
from hh_exudyn.contact.normal.registry import EQUIVALENT_ELASTIC, HERTZ, is_elliptic
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.state import Patch, write_patch
from hh_exudyn.contact.tangential.registry import GIVEN, force_kernel, strips_kernel
from hh_exudyn.contact.types import (
    CREEPAGE_SPEED_FLOOR,
    ContactForces,
    ContactFrame,
    NormalContact,
    RailMotion,
    RailTables,
    RollingPatch,
    SlipVelocity,
    Triple,
    WheelRailModel,
    WheelsetMotion,
)
from hh_exudyn.kernel import inlined_kernel


@inlined_kernel
def add_patch(
    model: WheelRailModel,
    pair: WheelRailPair,
    contact: FloatArray,
    strips: FloatArray,
    wheelsets: WheelsetMotion,
    rails: RailMotion,
    friction_table: FrictionTable,
    i: int,
    forces: ContactForces,
    number: int,
) -> bool:
    """Add the forces of patch `number` of a wheel of wheelset i; False where it carries no force.

    Parameters
    ----------
    model : WheelRailModel
        Everything that does not change during a run.
    pair : WheelRailPair
        Profiles of wheel and rail, and the wheelset's pose.
    contact : FloatArray
        (CONTACT_COLUMNS,) the patch as `search` or `neighbours` found it; a patch of strips moves to its
        centre of pressure.
    strips : FloatArray
        (cells_y, STRIP_COLUMNS) working memory.
    wheelsets, rails : WheelsetMotion, RailMotion
        Of all wheelsets and their rails.
    friction_table : FrictionTable
        Friction by place, wheel and slip speed.
    i : int
        Number of the wheelset, from 0.
    forces : ContactForces
        Wrench and rail force are added to, the record of the patch is written.
    number : int
        Place of the record among those of the wheel, from 0.
    """
    floored = _is_floored(model, contact)
    elastic, max_pressure, a, b = _normal_forces(model, pair, contact, strips)
    side = 0 if pair.side > 0.0 else 1
    along = model.rails_left if side == 0 else model.rails_right
    frame = _contact_frame(pair, along, contact, rails, i, side)
    slip = _slip_velocity(model, contact, frame, wheelsets, rails, i, side)
    factor = 1.0 + model.damping * slip.approach
    if not elastic > 0.0 or factor <= 0.0:
        return False
    normal = elastic * factor

    # Creep forces (equations.md 2.12-2.15 are the small-angle form of these creepages)
    speed = max(wheelsets.velocity[i, 0], CREEPAGE_SPEED_FLOOR)
    nu_x, nu_y, phi = slip.along / speed, slip.across / speed, slip.spin / speed
    friction = friction_at(
        friction_table,
        i,
        side,
        rails.arc_length[i],
        contact[CONTACT_ANGLE],
        math.hypot(slip.along, slip.across),
    )
    rolling = RollingPatch(a, b, normal, nu_x, nu_y, phi, friction, model.shear_modulus, model.poisson_ratio)
    if model.theory == GIVEN:
        force_x, force_y, moment_z = -model.given.longitudinal * nu_x, -model.given.lateral * nu_y, 0.0
    elif is_elliptic(model.normal):
        force_x, force_y, moment_z = force_kernel(model.theory, rolling, model.cells_x, model.cells_y)
    else:
        force_x, force_y, moment_z = strips_kernel(model.theory, strips, rolling, model.cells_x)
    _add_wrench(frame, (force_x, force_y, normal), moment_z, forces, i, side)

    write_patch(
        forces.patches[i, side, number],
        contact,
        frame,
        rolling,
        (force_x, force_y, moment_z),
        # the largest pressure is that of the whole normal force on the ellipse
        NormalContact(elastic, max_pressure * factor, floored),
        slip,
    )
    record = forces.patches[i, side, number]
    record[Patch.CENTRE_Y], record[Patch.CENTRE_Z] = pair.centre_y, pair.centre_z
    return True


@inlined_kernel
def _is_floored(model: WheelRailModel, contact: FloatArray) -> bool:
    """Whether the lateral curvature met its floor; an equivalent patch is as wide as the overlap."""
    curvature = 0.5 * (contact[WHEEL_CURVATURE] + contact[RAIL_CURVATURE])
    return curvature < CURVATURE_FLOOR and model.normal != EQUIVALENT_ELASTIC


@inlined_kernel
def _normal_forces(
    model: WheelRailModel, pair: WheelRailPair, contact: FloatArray, strips: FloatArray
) -> tuple[float, float, float, float]:
    """Elastic normal force [N], largest pressure [Pa] and semi-axes [m] of a patch; see `add_patch`."""
    if model.normal == HERTZ:
        # A and B are half the sums of the curvatures in the normal section
        elastic, a, b, max_pressure = normal_contact(
            contact[APPROACH],
            0.5 * math.cos(contact[CONTACT_ANGLE]) / contact[RADIUS],
            max(0.5 * (contact[WHEEL_CURVATURE] + contact[RAIL_CURVATURE]), CURVATURE_FLOOR),
            model.shear_modulus,
            model.poisson_ratio,
        )
    elif model.normal == EQUIVALENT_ELASTIC:
        elastic, a, b, max_pressure = hertz_of_ellipse(contact, model.shear_modulus, model.poisson_ratio)
    else:
        low = minimum(model.normal, pair, contact, model.shear_modulus, model.poisson_ratio)
        elastic, max_pressure, a, b, _ = patch_strips(pair, contact, low, contact[STIFFNESS], strips)
    return elastic, max_pressure, a, b


@inlined_kernel
def _contact_frame(
    pair: WheelRailPair, along: RailTables, contact: FloatArray, rails: RailMotion, i: int, side: int
) -> ContactFrame:
    """The contact frame of a patch, along the rail's surface at the contact point."""
    point = (contact[POINT], contact[POINT + 1], contact[POINT + 2])
    turn = (rails.turn[i, 0], rails.turn[i, 1], rails.turn[i, 2])
    heading, slope = turn_of_rail(pair, point, turn)
    slope += surface_slope(along, rails.arc_length[i], contact[Y_RAIL])
    _, slope_wheel, _ = spline_evaluate(pair.wheel, contact[Y_WHEEL])
    ahead = moved_ahead(pair, contact[Y_WHEEL], slope_wheel, point, heading, slope)
    point = (point[0] + ahead, point[1], point[2])
    cosine = math.cos(contact[CONTACT_ANGLE])
    sine = pair.side * math.sin(contact[CONTACT_ANGLE])
    forward, across, normal = axes_of(cosine, sine, heading, slope)
    rotation = rails.rotation[i, side]
    return ContactFrame(
        _rotated(rotation, point),
        _rotated(rotation, forward),
        _rotated(rotation, across),
        _rotated(rotation, normal),
    )


@inlined_kernel
def _slip_velocity(
    model: WheelRailModel,
    contact: FloatArray,
    frame: ContactFrame,
    wheelsets: WheelsetMotion,
    rails: RailMotion,
    i: int,
    side: int,
) -> SlipVelocity:
    """Rigid-body velocity of the wheel at the contact point less that of the rail's material."""
    px, py, pz = frame.point
    wx, wy, wz = (
        wheelsets.angular_velocity[i, 0],
        wheelsets.angular_velocity[i, 1],
        wheelsets.angular_velocity[i, 2],
    )
    x = wheelsets.velocity[i, 0] + wy * pz - wz * py
    y = wheelsets.velocity[i, 1] + wz * px - wx * pz - rails.velocity[i, side, 0]
    z = wheelsets.velocity[i, 2] + wx * py - wy * px - rails.velocity[i, side, 1]
    along, across, normal = frame.along, frame.across, frame.normal
    slip_x = x * along[0] + y * along[1] + z * along[2] + wheelsets.creep_lag[i, side, 0]
    slip_y = x * across[0] + y * across[1] + z * across[2]
    lag = math.cos(contact[CONTACT_ANGLE]) * wheelsets.creep_lag[i, side, 1]
    if model.theory == GIVEN:  # creep forces follow the creepage at once
        slip_x -= wy * model.given.conicity * contact[Y_WHEEL] + wheelsets.creep_lag[i, side, 0]
        lag = 0.0
    return SlipVelocity(
        slip_x,
        slip_y + lag,
        -(x * normal[0] + y * normal[1] + z * normal[2]),
        wx * normal[0] + wy * normal[1] + wz * normal[2],
    )


@inlined_kernel
def _add_wrench(
    frame: ContactFrame, force: Triple, moment: float, forces: ContactForces, i: int, side: int
) -> None:
    """Add a force in C and a moment about its normal to the wrench of wheelset i and to its rail's load."""
    px, py, pz = frame.point
    along, across, normal = frame.along, frame.across, frame.normal
    x = force[0] * along[0] + force[1] * across[0] + force[2] * normal[0]
    y = force[0] * along[1] + force[1] * across[1] + force[2] * normal[1]
    z = force[0] * along[2] + force[1] * across[2] + force[2] * normal[2]
    wrench = forces.wrench[i]
    wrench[0] += x
    wrench[1] += y
    wrench[2] += z
    wrench[3] += py * z - pz * y + moment * normal[0]
    wrench[4] += pz * x - px * z + moment * normal[1]
    wrench[5] += px * y - py * x + moment * normal[2]
    forces.rail_force[i, side, 0] -= y
    forces.rail_force[i, side, 1] -= z


@inlined_kernel
def _rotated(rotation: FloatArray, vector: Triple) -> Triple:
    """A vector in axes of R, in those of T."""
    x, y, z = vector
    return (
        rotation[0, 0] * x + rotation[0, 1] * y + rotation[0, 2] * z,
        rotation[1, 0] * x + rotation[1, 1] * y + rotation[1, 2] * z,
        rotation[2, 0] * x + rotation[2, 1] * y + rotation[2, 2] * z,
    )
