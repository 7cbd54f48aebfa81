"""Inputs and results of the contact kernels, as NamedTuples; the record of a patch is in `state`.

They are NamedTuples because dataclasses cannot enter numba kernels, and they are defined here because kernels
of a NamedTuple defined in a script are not cached.
"""

from typing import Any, NamedTuple

from hh_exudyn.arrays import FloatArray, IntArray

Triple = tuple[float, float, float]
Quadruple = tuple[float, float, float, float]
Memory = Any  # of `kernel.memory`


class SplineTable(NamedTuple):
    """A profile z(y) as a cubic spline on a uniform grid, in side coordinates.

    Value, slope and second derivative are continuous. Outside the grid there is no profile. The last two
    fields follow from the others: the contact search would otherwise compute them again and again.
    """

    start: float  # y of the first node [m]
    step: float  # node spacing [m]
    z: FloatArray  # (n,) heights at the nodes [m]
    second: FloatArray  # (n,) second derivatives d2z/dy2 at the nodes [1/m]
    per_step: float  # 1 / step [1/m]
    slope: FloatArray  # (n,) slopes at the nodes [-]


class WheelStrips(NamedTuple):
    """Strips fixed on a wheel profile (`strips.table`), arrays (n,) in the order of y."""

    y: FloatArray  # of the middle of a strip, side coordinates [m]
    z: FloatArray  # height of the profile there [m]
    slope: FloatArray  # [-]
    arc: FloatArray  # place along the arc [m]
    width: FloatArray  # along the arc [m]


class WheelTables(NamedTuple):
    """The different wheel profiles of a vehicle in rows, and which wheel has which (`wheels`); else empty."""

    starts: FloatArray  # (profiles,) y of the first node [m]; the node spacing is that of all wheels
    nodes: FloatArray  # (profiles, 3, n) z, second, slope as of `SplineTable`
    strips: FloatArray  # (profiles, 5, strips) as of `WheelStrips`
    counts: IntArray  # (profiles, 2) nodes and strips in use
    which: IntArray  # (wheelsets, 2) profile of the left and the right wheel


class RailTables(NamedTuple):
    """The rails of one side along the track (`rail_tables`): profiles in rows, and which lies where.

    Node j of one profile lies, within half a step, as far from its gauge point as node j of another.
    """

    step: float  # node spacing [m]
    per_step: float  # 1 / step [1/m]
    change_length: float  # of every change from profile to profile [m]
    # few arrays: the whole model is copied where a kernel is called that is not inlined
    nodes: FloatArray  # (profiles, 3, n) z, second, slope as of `SplineTable`
    sections: FloatArray  # (sections, 4) columns of `rail_tables`: profile, its first node, gauge point; end


class Elastic(NamedTuple):
    """Elastic constants of wheel and rail, for the kernels."""

    shear_modulus: float  # [Pa]
    poisson_ratio: float


class GivenCreep(NamedTuple):
    """Creep coefficients and conicity that are given instead of following from the patch (`given`)."""

    longitudinal: float  # F_x = -longitudinal nu_x of one wheel [N]
    lateral: float  # F_y = -lateral nu_y [N]
    conicity: float  # of a wheel that is a cylinder but for its rolling radius [-]


class WheelRailModel(NamedTuple):
    """Everything about the contact that does not change during a run.

    The profiles of the left and right side may differ (a measured wheel, a worn high rail), the wheels from
    wheelset to wheelset too, and the rails along the track: `rail_tables.rail_at` gives the one at an arc
    length.
    """

    wheel_left: SplineTable
    wheel_right: SplineTable
    strips_left: WheelStrips
    strips_right: WheelStrips
    rails_left: RailTables
    rails_right: RailTables
    wheels: WheelTables  # of wheelsets that differ; empty where all have the wheels above
    running_circle_distance: float  # half the lateral distance of the two running circles [m]
    nominal_radius: float  # wheel radius at the running circle [m]
    shear_modulus: float  # of both bodies [Pa]
    poisson_ratio: float
    damping: float  # Hunt-Crossley damping d of the normal force N (1 + d * approach rate) [s/m]
    normal: int  # a value of `normal.registry.NORMAL_THEORIES`
    theory: int  # a value of `tangential.THEORIES`
    cells_x: int  # cells of the tangential solve along and across the patch
    cells_y: int
    given: GivenCreep  # for the theory `registry.GIVEN` only


class WheelsetMotion(NamedTuple):
    """Pose and velocity of n wheelsets, each in its own track frame T."""

    position: FloatArray  # (n, 3) centres; x is 0 where T is the frame at the wheelset's arc length [m]
    axle: FloatArray  # (n, 3) unit vector of the wheelset's +y axis
    velocity: FloatArray  # (n, 3) inertial velocity of the centres [m/s]
    angular_velocity: FloatArray  # (n, 3) inertial angular velocity, spin included [rad/s]
    creep_lag: FloatArray  # (n, 2, 2) of each wheel (left, right): what the longitudinal and lateral creepage
    # add to the velocity of wheel against rail, 0 in steady rolling [m/s]; the approach has none


class RailMotion(NamedTuple):
    """Place, direction and motion of the rails under n wheelsets; second index 0 left, 1 right.

    A rail is a prism along the x axis of its frame R, with the origin of the rail's profile. R is T
    turned by all that makes this rail run otherwise than the track at this place: irregularity, ramps of
    cant and gauge, deflection. Its material rests but for its own elastic motion.
    """

    arc_length: FloatArray  # (n,) of the wheelsets along the track [m]
    position: FloatArray  # (n, 2, 2) y and z of the origin of R, in T [m]
    rotation: FloatArray  # (n, 2, 3, 3) R to T
    turn: FloatArray  # (n, 3) rotation of R per metre along the track, about its own axes [rad/m]
    velocity: FloatArray  # (n, 2, 2) of the rail's material, y and z in T [m/s]


class ContactForces(NamedTuple):
    """Forces of n wheelsets on their rails, written by the contact kernel."""

    wrench: FloatArray  # (n, 6) force on the wheelset and moment about its centre, axes of T [N], [N m]
    rail_force: FloatArray  # (n, 2, 2) y and z force on each rail, axes of T [N]
    patches: FloatArray  # (n, 2, MAX_PATCHES, PATCH_COLUMNS) states, most loaded first; without contact zero
    in_contact: FloatArray  # (n, 2, strips.table.CAPACITY) strips in contact, also the next guess
    refine: FloatArray  # (1,) 1 where the records are wanted with the pressures of `strips.pressure`, else 0


class RollingPatch(NamedTuple):
    """An elliptic patch in steady rolling: the argument of every tangential theory.

    Of a patch that is no ellipse, the equivalent one (of its area): for Kalker's coefficients only.
    """

    a: float  # semi-axis in rolling direction [m], > 0
    b: float  # lateral semi-axis [m], > 0
    normal_force: float  # [N], > 0
    nu_x: float  # longitudinal creepage of the wheel relative to the rail, at the frame's origin [-]
    nu_y: float  # lateral creepage [-]
    phi: float  # spin creepage [1/m]
    friction: float  # friction coefficient [-], > 0
    shear_modulus: float  # of both bodies [Pa]
    poisson_ratio: float  # [-]


class Fields(NamedTuple):
    """Stress and slip over a patch, arrays (ny, nx) on the grid of `tangential`; kernels overwrite them."""

    pressure: FloatArray  # the theory's own [Pa]
    q_x: FloatArray  # traction on the wheel [Pa]
    q_y: FloatArray
    slip_x: FloatArray  # slip velocity of the wheel relative to the rail over the speed [-]
    slip_y: FloatArray


class ContactFrame(NamedTuple):
    """Contact point and contact frame C of a patch, in axes of T."""

    point: Triple  # from the wheelset's centre [m]
    along: Triple  # unit vectors: x of C
    across: Triple  # y of C
    normal: Triple  # z of C, from the rail into the wheel


class SlipVelocity(NamedTuple):
    """Velocity of the wheel's material at the contact point relative to the rail's, in C."""

    along: float  # with the lag of the creepage [m/s]
    across: float  # likewise [m/s]
    approach: float  # of the wheel to the rail along the normal [m/s]
    spin: float  # angular velocity about the normal [rad/s]


class NormalContact(NamedTuple):
    """Normal force of a patch and further results of the normal theory."""

    elastic: float  # normal force without contact damping [N]
    max_pressure: float  # under the whole normal force [Pa]
    floored: bool  # whether the lateral curvature met its floor (conformal contact)


MAX_PATCHES = 3  # patches of one wheel at once
CREEPAGE_SPEED_FLOOR = 0.1  # m/s, the least speed that creepages refer to
