"""From pose and velocity of wheelsets and rails to wrenches and contact states, in one kernel.

For each wheel: `search` finds the patches, `hertz` gives normal force and ellipse from the approach, the
creepages come from the rigid-body velocity of the wheel's material at the contact point relative to the
rail, `tangential` gives the creep forces.

The forces of a patch act at the contact point on the undeformed wheel (half an approach, some 0.05 mm, from
where the deformed surfaces meet: without influence on any moment).

The contact frame C is T rolled about x by side * contact angle: x the rolling direction along the rail, z the
normal from the rail into the wheel.
"""

import math

import numpy as np

from hh_exudyn.contact.hertz import normal_contact
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.profile import Profile, gauge_point
from hh_exudyn.contact.profile_spline import spline_table
from hh_exudyn.contact.search import (
    APPROACH,
    CONTACT_ANGLE,
    CONTACT_COLUMNS,
    MAX_MINIMA,
    POINT,
    RADIUS,
    RAIL_CURVATURE,
    WHEEL_CURVATURE,
    Y_RAIL,
    Y_WHEEL,
    find_contacts,
)
from hh_exudyn.contact.silhouette import wheel_rail_pair
from hh_exudyn.contact.tangential import THEORIES, force_kernel
from hh_exudyn.contact.types import FloatArray, Patch, WheelRailModel
from hh_exudyn.conventions import BACK_TO_BACK, FLANGE_BACK_TO_RUNNING_CIRCLE
from hh_exudyn.kernel import inlined_kernel

# Half the sum of the lateral curvatures below which Hertz's ellipse would be wider than the profiles keep
# their curvature (conformal contact): a relative radius of 2 m, an ellipse about 2.5 times wider than long.
CURVATURE_FLOOR = 0.25  # 1/m
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


def wheel_rail_model(
    wheel_left: Profile,
    wheel_right: Profile,
    rail_left: Profile,
    rail_right: Profile,
    *,
    nominal_radius: float,
    back_to_back: float = BACK_TO_BACK,
    material: Material = STEEL,
    damping: float = 0.0,
    theory: str = "fastrip",
    cells: tuple[int, int] = (15, 15),
    smoothing: float = 0.5e-3,
) -> WheelRailModel:
    """Everything about the contact that does not change during a run.

    Parameters
    ----------
    wheel_left, wheel_right, rail_left, rail_right : Profile
        The rails include their inclination.
    nominal_radius : float
        Wheel radius at the running circle [m], 0.2 .. 1.
    back_to_back : float
        Distance of the flange backs [m], 0.5 .. 2.
    material : Material
        Elastic constants of both bodies.
    damping : float
        d of the normal force N (1 + d * approach rate) [s/m], 0 .. 100.
    theory : str
        One of `tangential.THEORIES`.
    cells : tuple of int
        Cells of the tangential solve along and across the patch, 3 .. 200 each.
    smoothing : float
        Length over which the profiles' curvature is blurred (see `profile_spline.spline_table`) [m].

    Raises
    ------
    ValueError
        A profile of the wrong kind, an unknown theory, or a number out of its range.
    """
    for label, profile, kind in (
        ("wheel_left", wheel_left, "wheel"),
        ("wheel_right", wheel_right, "wheel"),
        ("rail_left", rail_left, "rail"),
        ("rail_right", rail_right, "rail"),
    ):
        if profile.kind != kind:
            raise ValueError(
                f"{label}: profile {profile.name!r} is of kind {profile.kind!r}, needed: {kind!r}"
            )
    for label, value, low, high, unit in (
        ("nominal_radius", nominal_radius, 0.2, 1.0, "m"),
        ("back_to_back", back_to_back, 0.5, 2.0, "m"),
        ("damping", damping, 0.0, 100.0, "s/m"),
        ("cells[0]", cells[0], 3, 200, "-"),
        ("cells[1]", cells[1], 3, 200, "-"),
    ):
        if not low <= value <= high:
            raise ValueError(f"{label} = {value} {unit}, allowed {low} .. {high} {unit}")
    if theory not in THEORIES:
        raise ValueError(f"unknown theory {theory!r}; known: {', '.join(THEORIES)}")
    return WheelRailModel(
        wheel_left=spline_table(wheel_left, smoothing=smoothing),
        wheel_right=spline_table(wheel_right, smoothing=smoothing),
        rail_left=spline_table(rail_left, smoothing=smoothing),
        rail_right=spline_table(rail_right, smoothing=smoothing),
        gauge_point_left=gauge_point(rail_left),
        gauge_point_right=gauge_point(rail_right),
        running_circle_distance=0.5 * back_to_back + FLANGE_BACK_TO_RUNNING_CIRCLE,
        nominal_radius=float(nominal_radius),
        shear_modulus=material.shear_modulus,
        poisson_ratio=material.poisson_ratio,
        damping=float(damping),
        theory=int(THEORIES[theory]),
        cells_x=int(cells[0]),
        cells_y=int(cells[1]),
    )


@inlined_kernel
def wheel_rail_forces(
    model: WheelRailModel,
    position: FloatArray,
    axle: FloatArray,
    velocity: FloatArray,
    angular_velocity: FloatArray,
    rail_displacement: FloatArray,
    rail_velocity: FloatArray,
    creep_lag: FloatArray,
    gauge: FloatArray,
    friction: FloatArray,
    wrench: FloatArray,
    rail_force: FloatArray,
    patches: FloatArray,
) -> int:
    """Contact forces of n wheelsets (kernel: trusts its input, writes into the last three arrays).

    Parameters
    ----------
    model : WheelRailModel
        From `wheel_rail_model`.
    position : FloatArray
        (n, 3) wheelset centres, each in its own track frame T [m].
    axle : FloatArray
        (n, 3) unit vector of the wheelset's +y axis in T.
    velocity : FloatArray
        (n, 3) inertial velocity of the centres in T [m/s].
    angular_velocity : FloatArray
        (n, 3) inertial angular velocity, spin included, in T [rad/s].
    rail_displacement : FloatArray
        (n, 2, 2) of the rails below: side index 0 left, 1 right; y, z in T [m].
    rail_velocity : FloatArray
        (n, 2, 2) its rate [m/s].
    creep_lag : FloatArray
        (n, 2, 2) what the longitudinal and lateral creepage add to the velocity of wheel against rail [m/s]:
        zero for steady rolling, else the lag of the creep force behind that velocity. The approach has none.
    gauge : FloatArray
        (n,) track gauge there [m].
    friction : FloatArray
        (n, 2) friction coefficient, left and right [-].
    wrench : FloatArray
        (n, 6) out: force on the wheelset and moment about its centre, axes of T [N], [N m].
    rail_force : FloatArray
        (n, 2, 2) out: y and z force on each rail, axes of T [N].
    patches : FloatArray
        (n, 2, MAX_PATCHES, PATCH_COLUMNS) out: contact states (`types.Patch`), deepest first; rows
        without contact are zero.

    Returns
    -------
    int
        0, or 1 + 2 * wheelset + side index of the first wheel whose state or force is not finite.
    """
    contacts = np.empty((MAX_MINIMA, CONTACT_COLUMNS))
    wrench[:] = 0.0
    rail_force[:] = 0.0
    patches[:] = 0.0
    for i in range(position.shape[0]):
        for s in range(2):
            if s == 0:
                side = 1.0
                wheel, rail, gauge_point_y = model.wheel_left, model.rail_left, model.gauge_point_left
            else:
                side = -1.0
                wheel, rail, gauge_point_y = model.wheel_right, model.rail_right, model.gauge_point_right
            rail_y = side * (0.5 * gauge[i] + gauge_point_y) + rail_displacement[i, s, 0]
            rail_z = rail_displacement[i, s, 1]
            if not _finite(position[i], axle[i], velocity[i], angular_velocity[i], rail_y + rail_z):
                return 1 + 2 * i + s
            pair = wheel_rail_pair(
                wheel,
                rail,
                side,
                model.running_circle_distance,
                model.nominal_radius,
                position[i],
                axle[i],
                rail_y,
                rail_z,
            )
            count = find_contacts(pair, contacts)
            present = 0
            for k in range(count):
                if _patch_forces(
                    model,
                    side,
                    contacts[k],
                    velocity[i],
                    angular_velocity[i],
                    rail_velocity[i, s],
                    creep_lag[i, s],
                    friction[i, s],
                    wrench[i],
                    rail_force[i, s],
                    patches[i, s, present],
                ):
                    present += 1
            if not math.isfinite(wrench[i, 0] + wrench[i, 1] + wrench[i, 2] + wrench[i, 4]):
                return 1 + 2 * i + s
    return 0


@inlined_kernel
def _finite(a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray, e: float) -> bool:
    """Whether every number of four vectors and a scalar is finite."""
    total = e
    for k in range(3):
        total += abs(a[k]) + abs(b[k]) + abs(c[k]) + abs(d[k])
    return math.isfinite(total)


@inlined_kernel
def _patch_forces(
    model: WheelRailModel,
    side: float,
    contact: FloatArray,
    velocity: FloatArray,
    angular_velocity: FloatArray,
    rail_velocity: FloatArray,
    creep_lag: FloatArray,
    friction: float,
    wrench: FloatArray,
    rail_force: FloatArray,
    patch: FloatArray,
) -> bool:
    """Add the forces of one patch to the wrenches and fill its row; False where it carries no force."""
    angle = contact[CONTACT_ANGLE]
    cosine, sine = math.cos(angle), side * math.sin(angle)  # C is T rolled by side * angle

    # Velocity of the wheel's material at the contact point relative to the rail, axes of T then of C
    px, py, pz = contact[POINT], contact[POINT + 1], contact[POINT + 2]
    wx, wy, wz = angular_velocity[0], angular_velocity[1], angular_velocity[2]
    slip_x = velocity[0] + wy * pz - wz * py + creep_lag[0]
    across = velocity[1] + wz * px - wx * pz - rail_velocity[0]
    upward = velocity[2] + wx * py - wy * px - rail_velocity[1]
    slip_y = cosine * (across + creep_lag[1]) + sine * upward
    approach_rate = sine * across - cosine * upward
    spin = -sine * wy + cosine * wz

    # Normal force: A and B are half the sums of the curvatures in the normal section
    curvature_x = 0.5 * cosine / contact[RADIUS]
    curvature_y = 0.5 * (contact[WHEEL_CURVATURE] + contact[RAIL_CURVATURE])
    floored = curvature_y < CURVATURE_FLOOR
    if floored:
        curvature_y = CURVATURE_FLOOR
    elastic, a, b, max_pressure = normal_contact(
        contact[APPROACH], curvature_x, curvature_y, model.shear_modulus, model.poisson_ratio
    )
    factor = 1.0 + model.damping * approach_rate
    if not elastic > 0.0 or factor <= 0.0:
        return False
    normal = elastic * factor

    # Creep forces (equations.md 2.12-2.15 are the small-angle form of these creepages)
    speed = max(velocity[0], CREEPAGE_SPEED_FLOOR)
    nu_x, nu_y, phi = slip_x / speed, slip_y / speed, spin / speed
    force_x, force_y, moment_z = force_kernel(
        model.theory,
        a,
        b,
        normal,
        nu_x,
        nu_y,
        phi,
        friction,
        model.shear_modulus,
        model.poisson_ratio,
        model.cells_x,
        model.cells_y,
    )

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
