"""A vehicle: bodies, couplings and wheelsets as frozen values, independent of the solver.

Drawing frame of a vehicle: x forward from its middle, y left, z up from the rail tops, all springs
unloaded. Couplings between the bodies: `couplings`.
"""

from dataclasses import dataclass

from hh_exudyn.conventions import GRAVITY
from vehicles.couplings import Coupling, Vector
from vehicles.joining import require_possible, with_wheelset_last
from vehicles.soundness import require_inside, require_sound
from vehicles.traction.effort import TractionEquipment

BODY_KINDS = ("car_body", "bogie_frame", "bolster", "side_frame", "motor", "wheelset")


@dataclass(frozen=True)
class Body:
    """A rigid body with its centre of mass on the drawing and principal inertias about it."""

    name: str
    kind: str  # one of BODY_KINDS
    mass: float  # [kg]
    inertia: Vector  # about x, y, z through the centre of mass [kg m^2]
    position: Vector  # of the centre of mass on the drawing [m]
    deflection: float = 0.0  # downwards under load, roughly: first guess of the equilibrium [m]
    held_weight: float | None = None  # weight of a body in imposed straight motion, else None [N]

    def __post_init__(self) -> None:
        if self.kind not in BODY_KINDS:
            raise ValueError(f"kind of body {self.name} is {self.kind!r}; allowed: {', '.join(BODY_KINDS)}")
        if not self.mass > 0.0 or not all(value > 0.0 for value in self.inertia):
            raise ValueError(
                f"body {self.name}: mass {self.mass} kg and inertia {self.inertia} kg m^2 must be > 0"
            )

    @property
    def weight(self) -> float:
        """Weight that its couplings or wheels carry [N]."""
        return self.mass * GRAVITY if self.held_weight is None else self.held_weight


@dataclass(frozen=True)
class Coupler:
    """The couplers, where the train pulls along the track and maintains the speed."""

    bodies: tuple[str, ...]  # of each coupler head
    points: tuple[Vector, ...]  # coupler heads on the drawing [m]
    stiffness: float  # of all heads together, towards a train that runs at constant speed [N/m]
    damping: float  # [N s/m]

    def __post_init__(self) -> None:
        if not self.points or len(self.bodies) != len(self.points):
            raise ValueError(
                f"coupler: {len(self.points)} heads on {len(self.bodies)} bodies; each head needs its body"
            )


@dataclass(frozen=True)
class Wheelset:
    """A wheelset's place in the vehicle and its wheels."""

    body: str
    bogie: int  # of the unit, from 1 at the leading end
    radius: float  # wheel radius at the running circle [m]
    unit: int = 1  # of a vehicle of several units, from 1 at the leading end


@dataclass(frozen=True)
class GivenContact:
    """Wheel-rail contact as reference models state it: two creep coefficients and a conicity.

    Raises ValueError for a coefficient <= 0, a distance not in 0.4 .. 1.1 m or a conicity not in 0 .. 0.5.
    """

    longitudinal: float  # F_x = -longitudinal nu_x of one wheel [N]
    lateral: float  # F_y = -lateral nu_y of one wheel [N]
    conicity: float  # [-]
    half_distance: float  # of the two contacts [m]

    def __post_init__(self) -> None:
        for quantity in ("longitudinal", "lateral"):
            if not getattr(self, quantity) > 0.0:
                raise ValueError(f"given contact: {quantity} = {getattr(self, quantity)} N, must be > 0 N")
        for quantity, low, high, unit in (("half_distance", 0.4, 1.1, " m"), ("conicity", 0.0, 0.5, "")):
            value = getattr(self, quantity)
            if not low <= value <= high:
                raise ValueError(f"given contact: {quantity} = {value}{unit}, allowed {low} .. {high}{unit}")


@dataclass(frozen=True)
class Drive:
    """A motor that turns a wheelset; its reaction is on the motor's body."""

    wheelset: str
    motor: str


@dataclass(frozen=True)
class BrakeShoe:
    """A shoe that brakes a wheel on its tread; the run states its force."""

    wheelset: str
    carrier: str  # body that holds the shoe, and takes up its friction
    point: Vector  # where it touches the wheel, on the drawing [m]
    friction: float  # of shoe on tread


@dataclass(frozen=True)
class Vehicle:
    """A vehicle on the drawing. `wheelsets` run from the leading end."""

    name: str
    bodies: tuple[Body, ...]
    couplings: tuple[Coupling, ...]
    wheelsets: tuple[Wheelset, ...]
    coupler: Coupler
    dimensions: dict[str, float]  # for drawings: lengths [m] by name
    contact: GivenContact | None = None  # for cases with the theory "given"
    drives: tuple[Drive, ...] = ()  # from the leading wheelset; without, the train pulls the vehicle
    traction: TractionEquipment | None = None  # of the drives
    shoes: tuple[BrakeShoe, ...] = ()  # of a vehicle braked on its treads

    def __post_init__(self) -> None:
        names = [body.name for body in self.bodies]
        if len(set(names)) != len(names):
            raise ValueError(f"vehicle {self.name}: body names are not unique: {names}")
        wanted = {wheelset.body for wheelset in self.wheelsets} | set(self.coupler.bodies)
        wanted |= {body for drive in self.drives for body in (drive.wheelset, drive.motor)}
        wanted |= {body for shoe in self.shoes for body in (shoe.wheelset, shoe.carrier)}
        if unknown := wanted - set(names):
            raise ValueError(f"vehicle {self.name}: no body named {', '.join(sorted(unknown))}")
        spinning = {wheelset.body for wheelset in self.wheelsets}
        if (self.traction is None) != (not self.drives):
            raise ValueError(f"vehicle {self.name}: drives and their traction equipment go together")
        if self.drives and [drive.wheelset for drive in self.drives] != [w.body for w in self.wheelsets]:
            raise ValueError(f"vehicle {self.name}: its drives must be one for each wheelset, in their order")
        # the value of a frozen description is set here once, in one order for everything that reads it
        object.__setattr__(self, "couplings", with_wheelset_last(self.couplings, spinning))
        try:
            require_possible(self.couplings, {body.name: body.position for body in self.bodies}, spinning)
        except ValueError as error:
            raise ValueError(f"vehicle {self.name}: {error}") from None
        for shoe in self.shoes:
            if shoe.wheelset not in spinning or shoe.carrier in spinning:
                raise ValueError(
                    f"vehicle {self.name}: a brake shoe of {shoe.carrier} on {shoe.wheelset}; it must press "
                    "a wheelset, from a body that is none"
                )
        require_sound((*self.bodies, *self.couplings, *self.wheelsets, *self.shoes, self.coupler))
        require_inside(self)

    def body(self, name: str) -> Body:
        """The body of that name."""
        return next(body for body in self.bodies if body.name == name)

    @property
    def units(self) -> tuple[int, ...]:
        """Numbers of its units, from the leading one; they are the logs' vehicles."""
        return tuple(dict.fromkeys(wheelset.unit for wheelset in self.wheelsets))

    @property
    def wheelset_places(self) -> tuple[tuple[int, int, int], ...]:
        """Of every wheelset its unit, its bogie and its number, both within the unit."""
        units = [wheelset.unit for wheelset in self.wheelsets]
        return tuple(
            (wheelset.unit, wheelset.bogie, 1 + units[:place].count(wheelset.unit))
            for place, wheelset in enumerate(self.wheelsets)
        )

    def unit_of(self, body: str) -> int:
        """The unit of a body: the one whose wheelsets have their middle nearest to it."""
        place = self.body(body).position[0]

        def distance(unit: int) -> float:
            own = [self.body(w.body).position[0] for w in self.wheelsets if w.unit == unit]
            return abs(place - sum(own) / len(own))

        return min(self.units, key=distance)

    @property
    def mass(self) -> float:
        """Mass of all bodies but those in imposed motion [kg]."""
        return sum(body.mass for body in self.bodies if body.held_weight is None)
