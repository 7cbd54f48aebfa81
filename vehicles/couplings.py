"""Couplings between two bodies of a vehicle, as frozen values on its drawing (frame: `description`).

A coupling's displacement is that of its point on body B relative to body A, zero on the drawing; its force
and moment act on B there, and their opposites on A at the same place. Its axes are those of body A, or of
body B where A is a wheelset, whose own axes spin. Every coupling has a `preload`, its force on the drawing,
zero by default. Which bodies it may join, and in which order: `joining`. The kernels of the forces are in
`hh_exudyn.multibody.couplings`.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

from vehicles.freight_couplings import DoubleLink, LenoirSuspension
from vehicles.passenger_bogie import AxleBoxArm, Damper, SeriesDamper
from vehicles.preloads import require_preload, two_stage_compression

Vector = tuple[float, float, float]

LARGEST_TABLE = 10  # most points of a bump stop, the size of the table in the force kernel


@dataclass(frozen=True)
class AxleBoxPad:
    """Linear elastic pad between a frame (A) and the axle of a wheelset (B), which spins freely."""

    name: str
    body_a: str
    body_b: str
    point: Vector  # on the axle's centre line [m]
    stiffness: Vector  # [N/m]
    damping: Vector  # [N s/m]
    roll_stiffness: float  # [N m/rad]
    yaw_stiffness: float  # [N m/rad]
    preload: Vector = (0.0, 0.0, 0.0)  # force on body B on the drawing [N], e.g. (0, 0, -load)


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
    preload: float = 0.0  # load on the pad on the drawing [N]

    @property
    def compression(self) -> float:
        """Compression of the pad on the drawing [m]."""
        return self.preload / self.stiffness[2]

    def __post_init__(self) -> None:
        if not all(value > 0.0 for value in self.stiffness):
            raise ValueError(f"axle box {self.name}: stiffness {self.stiffness} N/m must be > 0")
        require_preload(f"axle box {self.name}", self.preload)
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
    """Two-stage load springs on a side frame (A) that carry a bolster end (B), with lateral stops (gibs) and
    rotation stops (lugs), which limit the warp of the bolster in the side frame.
    """

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
    rotation_clearance: float  # yaw of the bolster in the side frame up to the rotation stops [rad]
    rotation_stop_stiffness: float  # [N m/rad]
    preload: float = 0.0  # load that B stands with on A on the drawing [N]

    @property
    def compression(self) -> float:
        """Compression of the springs on the drawing [m]."""
        return two_stage_compression(
            self.preload, self.first_stiffness, self.second_stiffness, self.second_from
        )

    def __post_init__(self) -> None:
        require_preload(f"spring nest {self.name}", self.preload)


@dataclass(frozen=True)
class Wedge:
    """Friction wedge between a side frame's column (A) and a bolster's slope (B), see `force_laws.wedge`.

    It lies on the column along two lines, `width` apart, and on half its spring at each. When the bolster
    goes down, the wedge slides on the column alone. When the bolster warps in the side frame, one line is
    squeezed down and the other let up (the wedge rolls about the bogie's axis): both then slide on column and
    slope, whose frictions press each other's face, and that holds the bogie square.

    Its control spring stands on the side frame, and its force rises as the bolster goes down; with
    `constant_damping` it stands in the bolster's pocket, and keeps its preload (Ride Control).

    Raises ValueError where one face alone would jam the wedge: tan(slope - toe) <= friction of that face.
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
    stick_stiffness: float  # of either sticking face [N/m]
    stick_damping: float  # [N s/m]
    constant_damping: bool = False  # control spring in the bolster's pocket, not on the side frame

    @property
    def compression(self) -> float:
        """Compression of the control spring on the drawing: its preload less the wedge's rise by wear [m]."""
        rise = self.wear / math.cos(self.toe) / (math.tan(self.slope) - math.tan(self.toe))
        return self.preload / self.spring_stiffness - rise

    @property
    def ways(self) -> tuple[Vector, Vector]:
        """Ways of the wedge per way of the bolster towards the column, and down [m/m].

        Each: of the wedge down the column, of the bolster on the slope, of the control spring. From
        u = w (-sin t, cos t) + s (sin a, -cos a) for a bolster that moves by u = (towards, down), a wedge
        that goes down its column by w and a slip s on its slope.
        """
        tan_slope, tan_toe = math.tan(self.slope), math.tan(self.toe)
        rise = 1.0 / (tan_slope - tan_toe)
        down = rise * (tan_toe if self.constant_damping else tan_slope)
        cos_slope, cos_toe = math.cos(self.slope), math.cos(self.toe)
        return (
            (rise / cos_toe, rise / cos_slope, rise),
            (rise * tan_slope / cos_toe, rise * tan_toe / cos_slope, down),
        )

    def __post_init__(self) -> None:
        for quantity, value in (("width", self.width), ("wear", self.wear)):
            if not value >= 0.0:
                raise ValueError(f"wedge {self.name}: {quantity} {value} m must be >= 0")
        for face, friction in (("column", self.friction), ("slope", self.slope_friction)):
            if not 0.0 <= friction < math.tan(self.slope - self.toe):
                raise ValueError(
                    f"wedge {self.name} jams: its {face} friction {friction} must be >= 0 and below "
                    f"tan(slope - toe) {math.tan(self.slope - self.toe):.3f} (slope "
                    f"{math.degrees(self.slope):.1f} deg, toe {math.degrees(self.toe):.1f} deg)"
                )

    def normal_force(self, spring_force: float, down: float, slip: float = 0.0) -> float:
        """Column force N2 [N] in sliding, from the equilibrium of `force_laws.wedge`.

        Parameters
        ----------
        spring_force : of the control spring Fs [N]
        down : +1 if the wedge slides down the column, -1 up; a part of it where it slides across as well
        slip : +1 if the bolster slips on the slope towards the column, -1 away, 0 if it does not slip
        """
        angle = self.slope - self.toe
        column = math.sin(angle) - down * self.friction * math.cos(angle)
        slope = math.sin(angle) - slip * self.slope_friction * math.cos(angle)
        given = slope * math.cos(self.slope) + slip * self.slope_friction * math.cos(self.toe)
        both = column * slope - down * slip * self.friction * self.slope_friction
        return spring_force * given / both


@dataclass(frozen=True)
class CentrePlate:
    """Flat centre plate: a bolster (A) carries the car body (B) on two rings of one-sided contacts.

    The rings stand for uniform pressure: at the places of two-point Gauss integration over the radius, each
    with half the contacts' stiffness. The plate tips over its outer ring, and its friction has the arm of
    the loads that stand on the rings. One bound of dry friction holds it against shear and yaw together;
    the rim limits the shear. A spherical bowl has the same friction and tilts without a moment.
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
    yaw_stiffness: float  # of the sticking plates, with the structures that carry them [N m/rad]
    yaw_damping: float  # [N m s/rad]
    rim_clearance: float  # [m]
    rim_stiffness: float  # [N/m]
    spherical: bool = False  # a bowl, which tilts freely
    preload: float = 0.0  # load that B stands with on A on the drawing [N]

    @property
    def compression(self) -> float:
        """Compression of the plate on the drawing [m]."""
        return self.preload / self.stiffness if self.preload else 0.0

    def __post_init__(self) -> None:
        require_preload(f"centre plate {self.name}", self.preload)


@dataclass(frozen=True)
class SideBearer:
    """Constant-contact side bearer on A under B: preloaded spring with a friction face, and a solid stop."""

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
    preload: float = 0.0  # force on body B along the axis on the drawing, beside the table's [N]

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
    | LenoirSuspension
    | DoubleLink
)
