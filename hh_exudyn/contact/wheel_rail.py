"""From pose and velocity of wheelsets and rails to wrenches and contact states, in one kernel.

For each wheel: `search` finds the patches (with `neighbours`, where they are not elliptic), `patch_forces`
gives normal and creep forces of each.

The forces of a patch act at the contact point on the undeformed wheel (half an approach, some 0.05 mm, from
where the deformed surfaces meet: without influence on any moment).

The contact frame C is T rolled about x by side * contact angle: x the rolling direction along the rail, z the
normal from the rail into the wheel.
"""

import math

import numpy as np

from hh_exudyn.contact.friction import FrictionTable
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.neighbours import find_patches
from hh_exudyn.contact.non_elliptic import (
    HERTZ,
    NORMAL_THEORIES,
    check_combination,
)
from hh_exudyn.contact.patch_forces import add_patch
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profile_spline import spline_table
from hh_exudyn.contact.rail_tables import RailCourse, rail_at, rail_tables
from hh_exudyn.contact.search import CONTACT_COLUMNS, MAX_MINIMA, find_contacts
from hh_exudyn.contact.silhouette import wheel_rail_pair
from hh_exudyn.contact.strips import STRIP_COLUMNS
from hh_exudyn.contact.tangential import THEORIES
from hh_exudyn.contact.types import FloatArray, GivenCreep, WheelRailModel
from hh_exudyn.conventions import BACK_TO_BACK, FLANGE_BACK_TO_RUNNING_CIRCLE
from hh_exudyn.kernel import inlined_kernel


def wheel_rail_model(
    wheel_left: Profile,
    wheel_right: Profile,
    rail_left: Profile | RailCourse,
    rail_right: Profile | RailCourse,
    *,
    nominal_radius: float,
    back_to_back: float = BACK_TO_BACK,
    material: Material = STEEL,
    damping: float = 0.0,
    normal: str = "hertz",
    theory: str = "fastrip",
    cells: tuple[int, int] = (32, 16),
    smoothing: float = 0.5e-3,
) -> WheelRailModel:
    """Everything about the contact that does not change during a run.

    Parameters
    ----------
    wheel_left, wheel_right : Profile
        Wheels.
    rail_left, rail_right : Profile or RailCourse
        The rails include their inclination; one profile all along, or what lies where.
    nominal_radius : float
        Wheel radius at the running circle [m], 0.2 .. 1.
    back_to_back : float
        Distance of the flange backs [m], 0.5 .. 2.
    material : Material
        Elastic constants of both bodies.
    damping : float
        d of the normal force N (1 + d * approach rate) [s/m], 0 .. 100.
    normal : str
        One of `non_elliptic.NORMAL_THEORIES`.
    theory : str
        One of `tangential.THEORIES`; ``"fastrip"`` where the patches are not elliptic.
    cells : tuple of int
        Cells of the tangential solve along and across the patch, 3 .. 200 each.
    smoothing : float
        Length over which the profiles' curvature is blurred (see `profile_spline.spline_table`) [m].

    Raises
    ------
    ValueError
        A profile of the wrong kind, an unknown theory, a tangential theory that cannot take the patches of
        the normal one, or a number out of its range.
    """
    for label, profile, kind in (
        ("wheel_left", wheel_left, "wheel"),
        ("wheel_right", wheel_right, "wheel"),
        ("rail_left", rail_left, "rail"),
        ("rail_right", rail_right, "rail"),
    ):
        if isinstance(profile, Profile) and profile.kind != kind:
            raise ValueError(
                f"{label}: profile {profile.name!r} is of kind {profile.kind!r}, needed: {kind!r}"
            )
    if len(cells) != 2 or any(int(count) != count for count in cells if math.isfinite(count)):
        raise ValueError(f"cells = {cells}, allowed two whole numbers, 3 .. 200 each")
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
    if normal not in NORMAL_THEORIES:
        raise ValueError(f"unknown normal theory {normal!r}; known: {', '.join(NORMAL_THEORIES)}")
    check_combination(normal, theory)
    return WheelRailModel(
        wheel_left=spline_table(wheel_left, smoothing=smoothing),
        wheel_right=spline_table(wheel_right, smoothing=smoothing),
        rails_left=rail_tables(_course(rail_left), smoothing),
        rails_right=rail_tables(_course(rail_right), smoothing),
        running_circle_distance=0.5 * back_to_back + FLANGE_BACK_TO_RUNNING_CIRCLE,
        nominal_radius=float(nominal_radius),
        shear_modulus=material.shear_modulus,
        poisson_ratio=material.poisson_ratio,
        damping=float(damping),
        normal=NORMAL_THEORIES[normal],
        theory=int(THEORIES[theory]),
        cells_x=int(cells[0]),
        cells_y=int(cells[1]),
        given=GivenCreep(0.0, 0.0, 0.0),
    )


def _course(rail: Profile | RailCourse) -> RailCourse:
    return rail if isinstance(rail, RailCourse) else RailCourse((rail,))


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
    arc_length: FloatArray,
    friction: FrictionTable,
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
    arc_length : FloatArray
        (n,) where the wheelsets are along the track [m].
    friction : FrictionTable
        From `track.friction.Friction.table` or `friction.constant_friction`, for n wheelsets.
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
    strips = np.empty((0 if model.normal == HERTZ else model.cells_y, STRIP_COLUMNS))
    wrench[:] = 0.0
    rail_force[:] = 0.0
    patches[:] = 0.0
    for i in range(position.shape[0]):
        for s in range(2):
            if s == 0:
                side = 1.0
                wheel = model.wheel_left
                rail, gauge_point_y = rail_at(model.rails_left, arc_length[i])
            else:
                side = -1.0
                wheel = model.wheel_right
                rail, gauge_point_y = rail_at(model.rails_right, arc_length[i])
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
            if model.normal == HERTZ:
                count = find_contacts(pair, contacts)
            else:
                count = find_patches(
                    model.normal, pair, contacts, model.shear_modulus, model.poisson_ratio, strips
                )
            present = 0
            for k in range(count):
                if add_patch(
                    model,
                    pair,
                    contacts[k],
                    strips,
                    velocity[i],
                    angular_velocity[i],
                    rail_velocity[i, s],
                    creep_lag[i, s],
                    friction,
                    i,
                    arc_length[i],
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
