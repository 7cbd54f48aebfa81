"""Couplings between two bodies of a vehicle, as frozen values on its drawing (frame: `description`).

A coupling's displacement is that of its point on body B relative to body A in the axes of body A, zero on the
drawing; its force and moment act on B there, and their opposites on A at the same place. The kernels of these
forces are in `hh_exudyn.multibody.couplings`.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

from vehicles.passenger_bogie import AxleBoxArm, Damper, SeriesDamper

Vector = tuple[float, float, float]

LARGEST_TABLE = 10  # most points of a bump stop, the size of the table in the force kernel


@dataclass(frozen=True)
class AxleBoxPad:
    """Linear elastic pad between a side frame (A) and the axle of a wheelset (B), which spins freely."""

    name: str
    body_a: str
    body_b: str
    point: Vector  # on the axle's centre line [m]
    stiffness: Vector  # [N/m]
    damping: Vector  # [N s/m]
    roll_stiffness: float  # [N m/rad]
    yaw_stiffness: float  # [N m/rad]
    preload: Vector = (0.0, 0.0, 0.0)  # force on the wheelset on the drawing [N], e.g. (0, 0, -load)


@dataclass(frozen=True)
class AxleBox:
    """Axle box in a side frame's pedestal: the frame (A) stands on a pad on the box of a wheelset (B).

    The pad shears elastically until the dry friction of its seat, friction times its load, is exceeded; it
    then slides up to the pedestal's clearance, longitudinal or lateral, and from there on the stop acts. It
    cannot bear tension. The wheelset spins freely.
    """

    name: str
    body_a: str
    body_b: str
    point: Vector  # on the axle's centre line [m]
    stiffness: Vector  # shear, shear and compression of the pad [N/m]
    damping: Vector  # [N s/m]
    roll_stiffness: float  # [N m/rad]
    yaw_stiffness: float  # [N m/rad]
    friction: float  # of the pad on its seat
    longitudinal_clearance: float  # to either side [m]
    lateral_clearance: float  # to either side [m]
    stop_stiffness: float  # of the pedestal [N/m]

    def __post_init__(self) -> None:
        if not all(value > 0.0 for value in self.stiffness):
            raise ValueError(f"axle box {self.name}: stiffness {self.stiffness} N/m must be > 0")
        for quantity, value, unit in (
            ("friction", self.friction, ""),
            ("longitudinal_clearance", self.longitudinal_clearance, " m"),
            ("lateral_clearance", self.lateral_clearance, " m"),
            ("stop_stiffness", self.stop_stiffness, " N/m"),
        ):
            if not value >= 0.0:
                raise ValueError(f"axle box {self.name}: {quantity} {value}{unit} must be >= 0")


@dataclass(frozen=True)
class SpringNest:
    """Two-stage load springs between a side frame (A) and a bolster end (B), with lateral stops."""

    name: str
    body_a: str
    body_b: str
    point: Vector
    first_stiffness: float  # vertical, outer coils alone [N/m]
    second_stiffness: float  # vertical, all coils [N/m]
    second_from: float  # compression at which the inner coils touch [m]
    longitudinal_stiffness: float  # shear of the coils [N/m]
    lateral_stiffness: float  # shear of the coils [N/m]
    roll_stiffness: float  # [N m/rad]
    pitch_stiffness: float  # [N m/rad]
    warp_stiffness: float  # yaw of the bolster in the side frame, of the coils alone [N m/rad]
    shear_damping: float  # longitudinal and lateral [N s/m]
    vertical_damping: float  # [N s/m]
    roll_damping: float  # [N m s/rad]
    pitch_damping: float  # [N m s/rad]
    warp_damping: float  # [N m s/rad]
    stop_clearance: float  # lateral [m]
    stop_stiffness: float  # lateral [N/m]


@dataclass(frozen=True)
class Wedge:
    """Friction wedge between a side frame's column (A) and a bolster's slope (B), see `force_laws.wedge`.

    It lies on the column along two lines, `width` apart, and on half its spring at each: when the bolster
    warps in the side frame, one line goes down and the other up (the wedge rolls about the bogie's axis), and
    their friction resists.

    Statics in the vertical plane, with a the slope's angle including its mobilised friction, t the toe, Fs
    the spring force, N2 and T the column's normal force and its friction along the face: from

        N1 cos a = N2 cos t - T sin t,    Fs + N2 sin t + T cos t = N1 sin a

    follows N2 = (Fs cos a / cos(a - t) + T) / tan(a - t): the law of a wedge without toe of the slope a - t
    on a spring that is softer by cos a / cos(a - t).

    Raises ValueError where the wedge would jam: tan(slope + ratio atan(slope_friction) - toe) <= friction.
    """

    name: str
    body_a: str
    body_b: str
    point: Vector
    direction: int  # +1: the column is ahead of the bolster, -1: behind it
    spring_stiffness: float  # control spring [N/m]
    preload: float  # of the control spring on the drawing [N]
    slope: float  # angle of the bolster's face from the vertical [rad]
    toe: float  # angle of the column's face from the vertical, > 0 where the columns close downwards [rad]
    width: float  # between its two lines of contact [m]
    wear: float  # depth on column and wedge together, perpendicular to the column; it raises the wedge [m]
    friction: float  # of the column
    slope_friction: float  # of the slope
    slope_friction_ratio: float  # share of the slope's friction that is mobilised, -1..1
    stick_stiffness: float  # of the sticking contact [N/m]
    stick_damping: float  # [N s/m]

    @property
    def force_slope(self) -> float:
        """Angle of the bolster's force on the wedge [rad]: slope + ratio atan(slope_friction)."""
        return self.slope + self.slope_friction_ratio * math.atan(self.slope_friction)

    @property
    def tan_slope(self) -> float:
        """tan(a - t), slope against column."""
        return math.tan(self.force_slope - self.toe)

    @property
    def spring_share(self) -> float:
        """cos a / cos(a - t), the share of the control spring's force that works along the column."""
        return math.cos(self.force_slope) / math.cos(self.force_slope - self.toe)

    @property
    def compression(self) -> float:
        """Compression of the control spring on the drawing: its preload less the wedge's rise by wear [m]."""
        rise = self.wear / math.cos(self.toe) / (math.tan(self.slope) - math.tan(self.toe))
        return self.preload / self.spring_stiffness - rise

    def __post_init__(self) -> None:
        for quantity, value in (("width", self.width), ("wear", self.wear)):
            if not value >= 0.0:
                raise ValueError(f"wedge {self.name}: {quantity} {value} m must be >= 0")
        if not -1.0 <= self.slope_friction_ratio <= 1.0:
            raise ValueError(
                f"wedge {self.name}: slope_friction_ratio {self.slope_friction_ratio} must be -1..1"
            )
        if self.tan_slope <= self.friction:
            raise ValueError(
                f"wedge {self.name} jams: tan(slope - toe) {self.tan_slope:.3f} (slope "
                f"{math.degrees(self.slope):.1f} deg, toe {math.degrees(self.toe):.1f} deg, slope friction "
                f"{self.slope_friction}) must exceed the column friction {self.friction}"
            )

    def normal_force(self, spring_force: float, motion: int) -> float:
        """Column force N2 [N] in sliding; motion +1 loading, -1 unloading (the equations above).

        Parameters
        ----------
        spring_force : of the control spring Fs [N]
        motion : +1 loading, -1 unloading
        """
        return self.spring_share * spring_force / (self.tan_slope - motion * self.friction)


@dataclass(frozen=True)
class CentrePlate:
    """Flat centre plate: a bolster (A) carries the car body (B) on a ring of one-sided contacts.

    Dry friction holds the plates against shear and yaw (bound of the yaw torque: 2/3 mu N radius); the rim
    limits the shear.
    """

    name: str
    body_a: str
    body_b: str
    point: Vector
    radius: float  # [m]
    stiffness: float  # vertical, whole plate [N/m]
    damping: float  # vertical, whole plate [N s/m]
    friction: float
    stick_stiffness: float  # shear of the sticking plates [N/m]
    stick_damping: float  # [N s/m]
    rim_clearance: float  # [m]
    rim_stiffness: float  # [N/m]


@dataclass(frozen=True)
class SideBearer:
    """Constant-contact side bearer: preloaded spring with a friction face, and a solid stop."""

    name: str
    body_a: str
    body_b: str
    point: Vector
    preload: float  # [N]
    stiffness: float  # [N/m]
    damping: float  # [N s/m]
    stop_clearance: float  # further compression until solid [m]
    stop_stiffness: float  # [N/m]
    friction: float
    stick_stiffness: float  # shear [N/m]
    stick_damping: float  # [N s/m]


@dataclass(frozen=True)
class Bushing:
    """Linear spring and damper in all six directions: rubber element, coil spring, anti-roll bar, damper.

    Rotations are the small ones of B relative to A; of a wheelset as body B they are those of its axle, since
    its bearings let it spin. With a `preload` the drawing shows it loaded: (0, 0, weight) for a car body that
    stands on it.
    """

    name: str
    body_a: str
    body_b: str
    point: Vector
    stiffness: Vector  # [N/m]
    damping: Vector  # [N s/m]
    rotational_stiffness: Vector = (0.0, 0.0, 0.0)  # about x, y, z [N m/rad]
    rotational_damping: Vector = (0.0, 0.0, 0.0)  # [N m s/rad]
    preload: Vector = (0.0, 0.0, 0.0)  # force on body B on the drawing [N]

    def __post_init__(self) -> None:
        for quantity, unit in (
            ("stiffness", "N/m"),
            ("damping", "N s/m"),
            ("rotational_stiffness", "N m/rad"),
            ("rotational_damping", "N m s/rad"),
        ):
            values = getattr(self, quantity)
            if not all(value >= 0.0 for value in values):
                raise ValueError(f"bushing {self.name}: {quantity} {values} {unit} must be >= 0")


@dataclass(frozen=True)
class Rod:
    """Spring and damper along the line between its two points: traction rod, drawbar, motor link, damper.

    It bears tension and compression, and both ends are ball joints. An end on a wheelset must lie on the
    axle's centre line. Without a `preload` it is unloaded on the drawing.
    """

    name: str
    body_a: str
    body_b: str
    point_a: Vector  # end on body A on the drawing [m]
    point_b: Vector  # end on body B
    stiffness: float  # [N/m]
    damping: float  # [N s/m]
    preload: float = 0.0  # pull on the drawing [N]

    def __post_init__(self) -> None:
        if not math.dist(self.point_a, self.point_b) > 0.0:
            raise ValueError(f"rod {self.name}: its ends are both at {self.point_a} m; it needs a length > 0")
        for quantity, value, unit in (
            ("stiffness", self.stiffness, "N/m"),
            ("damping", self.damping, "N s/m"),
        ):
            if not value >= 0.0:
                raise ValueError(f"rod {self.name}: {quantity} {value} {unit} must be >= 0")

    @property
    def length(self) -> float:
        """Length on the drawing [m]."""
        return math.dist(self.point_a, self.point_b)


@dataclass(frozen=True)
class BumpStop:
    """Elastic stop along one axis of body A: a table of restoring force over displacement, linear between.

    Before its first point the force is that of the first point, beyond the last it rises on as between the
    last two. With `odd` the table holds for both directions, F(-d) = -F(d); otherwise only B's displacement
    along +`axis` is stopped, e.g. axis (0, 0, -1) for a body B that comes down on it.
    """

    name: str
    body_a: str
    body_b: str
    point: Vector
    axis: Vector  # unit vector in the axes of body A
    table: tuple[tuple[float, float], ...]  # (displacement [m], force [N]), both rising
    odd: bool

    def __post_init__(self) -> None:
        if abs(math.hypot(*self.axis) - 1.0) > 1e-9:
            raise ValueError(f"bump stop {self.name}: axis {self.axis} must be a unit vector")
        if not 2 <= len(self.table) <= LARGEST_TABLE:
            raise ValueError(
                f"bump stop {self.name}: its table has {len(self.table)} points; allowed: 2..{LARGEST_TABLE}"
            )
        if not all(d0 < d1 and f0 <= f1 for (d0, f0), (d1, f1) in pairwise(self.table)):
            raise ValueError(
                f"bump stop {self.name}: displacements [m] must rise and forces [N] not fall in {self.table}"
            )
        if self.odd and not (self.table[0][0] >= 0.0 and self.table[0][1] == 0.0):
            raise ValueError(
                f"bump stop {self.name}: the table of an odd stop must start at a displacement >= 0 m and "
                f"0 N, not at {self.table[0]}"
            )


Coupling = (
    AxleBoxPad
    | AxleBox
    | SpringNest
    | Wedge
    | CentrePlate
    | SideBearer
    | Bushing
    | Rod
    | BumpStop
    | AxleBoxArm
    | Damper
    | SeriesDamper
)
