"""From pose and velocity of wheelsets and rails to wrenches and contact states, in one kernel.

For each wheel: by coupled strips `strip_forces` gives all forces at once. With the other normal theories
`search` finds the patches (with `neighbours`, where they are not elliptic), and `patch_forces` gives normal
and creep forces of each.

The forces of a patch act at the contact point on the undeformed wheel (half an approach, some 0.05 mm, from
where the deformed surfaces meet: without influence on any moment).

Every wheel is looked at in the frame R of its own rail (`types.RailMotion`), on which the search is that for
a prism along x; velocities are inertial ones along the axes of R, less that of the rail's material. So an
angle of attack, a slip and an approach are those against this rail, on irregularities and ramps too, and a
wheel that rolls onto a slope or a bend of the rail slips no more than one on a straight.
"""

import math

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.friction import FrictionTable
from hh_exudyn.contact.geometry.rail_tables import RAIL_ROOM, RailCourse, rail_in, rail_tables
from hh_exudyn.contact.geometry.search import CONTACT_COLUMNS, MAX_MAXIMA, find_contacts
from hh_exudyn.contact.geometry.silhouette import wheel_rail_pair
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.normal.equivalent_elastic import find_regions
from hh_exudyn.contact.normal.neighbours import find_patches
from hh_exudyn.contact.normal.registry import (
    COUPLED_STRIPS,
    EQUIVALENT_ELASTIC,
    HERTZ,
    NORMAL_THEORIES,
    check_combination,
)
from hh_exudyn.contact.patch_forces import add_patch
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.spline import spline_table
from hh_exudyn.contact.strip_forces import add_strips
from hh_exudyn.contact.strips.table import wheel_strips
from hh_exudyn.contact.tangential.registry import THEORIES
from hh_exudyn.contact.tangential.strips import STRIP_COLUMNS
from hh_exudyn.contact.types import ContactForces, GivenCreep, RailMotion, WheelRailModel, WheelsetMotion
from hh_exudyn.contact.wheels import no_wheels, wheel_in
from hh_exudyn.conventions import BACK_TO_BACK, FLANGE_BACK_TO_RUNNING_CIRCLE
from hh_exudyn.kernel import inlined_kernel, memory, shaped

_MOST_CELLS = 200  # of the tangential solve, along and across
_STRIPS = _MOST_CELLS * STRIP_COLUMNS
_CONTACTS = MAX_MAXIMA * CONTACT_COLUMNS


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

    Twelve arguments: four profiles, and by keyword the independent numbers and names of a case.

    Parameters
    ----------
    wheel_left, wheel_right : Profile
        Wheels.
    rail_left, rail_right : Profile or RailCourse
        The rails include their inclination; one profile all along, or a course of profiles.
    nominal_radius : float
        Wheel radius at the running circle [m], 0.2 .. 1.
    back_to_back : float
        Distance of the flange backs [m], 0.5 .. 2.
    material : Material
        Elastic constants of both bodies.
    damping : float
        d of the normal force N (1 + d * approach rate) [s/m], 0 .. 100.
    normal : str
        One of `normal.registry.NORMAL_THEORIES`.
    theory : str
        One of `tangential.THEORIES`; ``"fastrip"`` where the patches are not elliptic.
    cells : tuple of int
        Cells of the tangential solve along and across the patch, 3 .. 200 each; coupled strips have their own
        number across.
    smoothing : float
        Length over which the profiles' curvature is blurred (see `spline.spline_table`) [m].

    Raises
    ------
    ValueError
        A profile of the wrong kind, an unknown theory, a tangential theory that cannot take the patches of
        the normal one, or a number out of its range.
    """
    _check_profiles(wheel_left, wheel_right, rail_left, rail_right)
    _check_numbers(nominal_radius, back_to_back, damping, cells)
    if theory not in THEORIES:
        raise ValueError(f"unknown theory {theory!r}; known: {', '.join(THEORIES)}")
    if normal not in NORMAL_THEORIES:
        raise ValueError(f"unknown normal theory {normal!r}; known: {', '.join(NORMAL_THEORIES)}")
    check_combination(normal, theory)
    left, right = (spline_table(wheel, smoothing=smoothing) for wheel in (wheel_left, wheel_right))
    return WheelRailModel(
        wheel_left=left,
        wheel_right=right,
        strips_left=wheel_strips(left),
        strips_right=wheel_strips(right),
        rails_left=rail_tables(_course(rail_left), smoothing),
        rails_right=rail_tables(_course(rail_right), smoothing),
        wheels=no_wheels(),
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


def _check_profiles(
    wheel_left: Profile,
    wheel_right: Profile,
    rail_left: Profile | RailCourse,
    rail_right: Profile | RailCourse,
) -> None:
    """ValueError for a profile of the wrong kind."""
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


def _check_numbers(
    nominal_radius: float, back_to_back: float, damping: float, cells: tuple[int, int]
) -> None:
    """ValueError for a number out of its range."""
    if len(cells) != 2 or any(int(count) != count for count in cells if math.isfinite(count)):
        raise ValueError(f"cells = {cells}, allowed two whole numbers, 3 .. {_MOST_CELLS} each")
    for label, value, low, high, unit in (
        ("nominal_radius", nominal_radius, 0.2, 1.0, "m"),
        ("back_to_back", back_to_back, 0.5, 2.0, "m"),
        ("damping", damping, 0.0, 100.0, "s/m"),
        ("cells[0]", cells[0], 3, _MOST_CELLS, "-"),
        ("cells[1]", cells[1], 3, _MOST_CELLS, "-"),
    ):
        if not low <= value <= high:
            raise ValueError(f"{label} = {value} {unit}, allowed {low} .. {high} {unit}")


def _course(rail: Profile | RailCourse) -> RailCourse:
    return rail if isinstance(rail, RailCourse) else RailCourse((rail,))


@inlined_kernel
def wheel_rail_forces(
    model: WheelRailModel,
    wheelsets: WheelsetMotion,
    rails: RailMotion,
    friction: FrictionTable,
    forces: ContactForces,
) -> int:
    """Contact forces of n wheelsets (kernel: trusts its input).

    Parameters
    ----------
    model : WheelRailModel
        From `wheel_rail_model`.
    wheelsets : WheelsetMotion
        Poses and velocities.
    rails : RailMotion
        The rails under them.
    friction : FrictionTable
        From `track.friction.Friction.table` or `friction.constant_friction`, for n wheelsets.
    forces : ContactForces
        Written.

    Returns
    -------
    int
        0, or 1 + 2 * wheelset + side index of the first wheel with a state or force that is not finite, or
        without a solution for the loads of its strips.
    """
    contacts = shaped(memory(_CONTACTS), (MAX_MAXIMA, CONTACT_COLUMNS))
    strips = shaped(memory(_STRIPS), (_MOST_CELLS, STRIP_COLUMNS))[: model.cells_y]
    vectors = shaped(memory(6), (2, 3))
    centre, axle = vectors[0], vectors[1]
    room = memory(RAIL_ROOM)
    forces.wrench[:] = 0.0
    forces.rail_force[:] = 0.0
    forces.patches[:] = 0.0
    for i in range(wheelsets.position.shape[0]):
        for s in range(2):
            side = 1.0 - 2.0 * s
            wheel = wheel_in(model, i, s)
            along = model.rails_left if s == 0 else model.rails_right
            rail, _ = rail_in(along, rails.arc_length[i], room)
            _seen_from_rail(wheelsets, rails, i, s, centre, axle)
            if not _finite(centre, axle, wheelsets.velocity[i], wheelsets.angular_velocity[i]):
                return 1 + 2 * i + s
            pair = wheel_rail_pair(
                wheel, rail, side, model.running_circle_distance, model.nominal_radius, centre, axle
            )
            if model.normal == COUPLED_STRIPS:
                if not add_strips(model, pair, wheelsets, rails, friction, i, forces):
                    return 1 + 2 * i + s
                count = 0
            elif model.normal == HERTZ:
                count = find_contacts(pair, contacts)
            elif model.normal == EQUIVALENT_ELASTIC:
                count = find_regions(pair, contacts)
            else:
                count = find_patches(
                    model.normal, pair, contacts, model.shear_modulus, model.poisson_ratio, strips
                )
            present = 0
            for k in range(count):
                present += add_patch(
                    model, pair, contacts[k], strips, wheelsets, rails, friction, i, forces, present
                )
            wrench = forces.wrench[i]
            if not math.isfinite(wrench[0] + wrench[1] + wrench[2] + wrench[4]):
                return 1 + 2 * i + s
    return 0


@inlined_kernel
def _seen_from_rail(
    wheelsets: WheelsetMotion, rails: RailMotion, i: int, s: int, centre: FloatArray, axle: FloatArray
) -> None:
    """Centre of a wheelset from the origin of a rail's frame R, and direction of its axle, in axes of R."""
    y = wheelsets.position[i, 1] - rails.position[i, s, 0]
    z = wheelsets.position[i, 2] - rails.position[i, s, 1]
    for axis in range(3):
        column = rails.rotation[i, s, :, axis]
        centre[axis] = column[0] * wheelsets.position[i, 0] + column[1] * y + column[2] * z
        axle[axis] = (
            column[0] * wheelsets.axle[i, 0]
            + column[1] * wheelsets.axle[i, 1]
            + column[2] * wheelsets.axle[i, 2]
        )


@inlined_kernel
def _finite(a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray) -> bool:
    """Whether every number of four vectors is finite."""
    total = 0.0
    for k in range(3):
        total += abs(a[k]) + abs(b[k]) + abs(c[k]) + abs(d[k])
    return math.isfinite(total)
