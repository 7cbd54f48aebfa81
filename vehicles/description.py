"""What a vehicle is made of: bodies, couplings, wheelsets, as frozen values that know nothing of a solver.

Drawing frame of a vehicle: x forward from its middle, y left, z up from the rail tops, all springs
unloaded. Couplings are placed by the point of the drawing where they act; displacement is that of body B
relative to body A in the axes of body A, zero on the drawing.
"""

import math
from dataclasses import dataclass

from vehicles.soundness import require_sound

Vector = tuple[float, float, float]

BODY_KINDS = ("car_body", "bolster", "side_frame", "wheelset")


@dataclass(frozen=True)
class Body:
    """A rigid body with its centre of mass on the drawing and principal inertias about it."""

    name: str
    kind: str  # one of BODY_KINDS
    mass: float  # [kg]
    inertia: Vector  # about x, y, z through the centre of mass [kg m^2]
    position: Vector  # of the centre of mass on the drawing [m]

    def __post_init__(self) -> None:
        if self.kind not in BODY_KINDS:
            raise ValueError(f"kind of body {self.name} is {self.kind!r}; allowed: {', '.join(BODY_KINDS)}")
        if not self.mass > 0.0 or not all(value > 0.0 for value in self.inertia):
            raise ValueError(
                f"body {self.name}: mass {self.mass} kg and inertia {self.inertia} kg m^2 must be > 0"
            )


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
    longitudinal_stiffness: float  # shear of the coils and guidance by the columns [N/m]
    lateral_stiffness: float  # shear of the coils [N/m]
    roll_stiffness: float  # [N m/rad]
    pitch_stiffness: float  # [N m/rad]
    warp_stiffness: float  # yaw of the bolster in the side frame [N m/rad]
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

    Raises ValueError where the wedge would jam: tan(slope + ratio atan(slope_friction)) <= friction.
    """

    name: str
    body_a: str
    body_b: str
    point: Vector
    direction: int  # +1: the column is ahead of the bolster, -1: behind it
    spring_stiffness: float  # control spring [N/m]
    preload: float  # of the control spring on the drawing [N]
    slope: float  # angle of the bolster's face from the vertical [rad]
    friction: float  # of the column
    slope_friction: float  # of the slope
    slope_friction_ratio: float  # share of the slope's friction that is mobilised, -1..1
    stick_stiffness: float  # of the sticking contact [N/m]
    stick_damping: float  # [N s/m]

    @property
    def tan_slope(self) -> float:
        """tan(a + r atan(mu1)), the ratio of the wedge's vertical to its column force."""
        return math.tan(self.slope + self.slope_friction_ratio * math.atan(self.slope_friction))

    def __post_init__(self) -> None:
        if not -1.0 <= self.slope_friction_ratio <= 1.0:
            raise ValueError(
                f"wedge {self.name}: slope_friction_ratio {self.slope_friction_ratio} must be -1..1"
            )
        if self.tan_slope <= self.friction:
            raise ValueError(
                f"wedge {self.name} jams: tan(slope) {self.tan_slope:.3f} (slope "
                f"{math.degrees(self.slope):.1f} deg, slope friction {self.slope_friction}) must exceed the "
                f"column friction {self.friction}"
            )

    def normal_force(self, spring_force: float, motion: int) -> float:
        """Column force N2 [N] in sliding; motion +1 loading, -1 unloading (sources: vehicles.md 1.3)."""
        return spring_force / (self.tan_slope - motion * self.friction)


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


Coupling = AxleBoxPad | SpringNest | Wedge | CentrePlate | SideBearer


@dataclass(frozen=True)
class Coupler:
    """The train: it pulls at both coupler heads of the car body along the track, and keeps the speed."""

    body: str
    points: tuple[Vector, ...]  # coupler heads on the drawing [m]
    stiffness: float  # towards a train that runs at constant speed [N/m]
    damping: float  # [N s/m]


@dataclass(frozen=True)
class Wheelset:
    """A wheelset's place in the vehicle and its wheels."""

    body: str
    bogie: int  # from 1 at the leading end
    radius: float  # wheel radius at the running circle [m]


@dataclass(frozen=True)
class Vehicle:
    """A vehicle on the drawing. `wheelsets` run from the leading end."""

    name: str
    bodies: tuple[Body, ...]
    couplings: tuple[Coupling, ...]
    wheelsets: tuple[Wheelset, ...]
    coupler: Coupler
    dimensions: dict[str, float]  # for drawings: lengths [m] by name

    def __post_init__(self) -> None:
        names = [body.name for body in self.bodies]
        if len(set(names)) != len(names):
            raise ValueError(f"vehicle {self.name}: body names are not unique: {names}")
        wanted = {name for coupling in self.couplings for name in (coupling.body_a, coupling.body_b)}
        wanted |= {wheelset.body for wheelset in self.wheelsets} | {self.coupler.body}
        if unknown := wanted - set(names):
            raise ValueError(f"vehicle {self.name}: no body named {', '.join(sorted(unknown))}")
        require_sound((*self.bodies, *self.couplings, *self.wheelsets, self.coupler))

    def body(self, name: str) -> Body:
        """The body of that name."""
        return next(body for body in self.bodies if body.name == name)

    @property
    def mass(self) -> float:
        """Mass of all bodies [kg]."""
        return sum(body.mass for body in self.bodies)
