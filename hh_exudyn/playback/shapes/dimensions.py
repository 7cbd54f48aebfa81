"""The dimensions of an ore wagon for its drawing, all from the vehicle of the run."""

from dataclasses import dataclass, fields
from typing import TypeVar

from vehicles.couplings import CentrePlate, SideBearer, SpringNest, Wedge
from vehicles.description import Vehicle

T = TypeVar("T")


@dataclass(frozen=True)
class WagonDimensions:
    """Lengths of one unit of an ore wagon [m]; heights are over the rail tops, springs unloaded.

    Raises
    ------
    ValueError
        A length is not positive (the ore depth may be 0), or a basket longer than the wagon.
    """

    length: float  # over the couplers
    height: float
    basket_width: float
    basket_length: float
    ore_depth: float  # 0 for an empty wagon
    coupler_height: float
    wheelbase: float  # of a bogie
    wheel_radius: float
    centre_plate_distance: float
    centre_plate_height: float
    centre_plate_radius: float
    side_bearer_half_spacing: float
    spring_nest_half_spacing: float
    spring_nest_height: float  # of the middle of its coils
    wedge_half_spacing: float  # of the columns' faces along the bogie
    wedge_height: float  # of the middle of the columns' faces
    car_body_height: float  # centres of mass
    bolster_height: float
    side_frame_height: float

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not value > 0.0 and not (field.name == "ore_depth" and value == 0.0):
                raise ValueError(f"{field.name} = {value} m must be above 0")
        if not self.basket_length < self.length:
            raise ValueError(f"basket_length {self.basket_length} m must be below length {self.length} m")


_OUTLINE = ("length", "height", "basket_width", "basket_length", "ore_depth")  # in `Vehicle.dimensions`
_BODIES = ("car_body", "bolster", "side_frame")
_COUPLINGS = (CentrePlate, SideBearer, SpringNest, Wedge)


def is_ore_wagon(vehicle: Vehicle) -> bool:
    """Whether a description has the outline, bodies and couplings of an ore wagon, and no other bodies."""
    return not _missing(vehicle) and {body.kind for body in vehicle.bodies} == {*_BODIES, "wheelset"}


def wagon_dimensions(vehicle: Vehicle) -> WagonDimensions:
    """The lengths of a described wagon, by its first unit: its units are alike.

    Positions are those of bodies, wheelsets and couplings; the outline of the car body is from
    `Vehicle.dimensions`.

    Raises
    ------
    ValueError
        The description lacks a length of the outline, a kind of body or a kind of coupling.
    """
    if missing := _missing(vehicle):
        raise ValueError(
            f"vehicle {vehicle.name} cannot be drawn as an ore wagon: it lacks {', '.join(missing)}"
        )
    unit = vehicle.units[0]
    plates = [one for one in vehicle.couplings if isinstance(one, CentrePlate)]
    plates = [one for one in plates if vehicle.unit_of(one.body_b) == unit]
    bearer, nest = _first(vehicle, SideBearer), _first(vehicle, SpringNest)
    wedge = _first(vehicle, Wedge)
    wheelsets = [one for one in vehicle.wheelsets if one.unit == unit]
    axles = [vehicle.body(one.body).position[0] for one in wheelsets if one.bogie == wheelsets[0].bogie]
    bolster = vehicle.body(wedge.body_b)
    height = {body.kind: body.position[2] for body in vehicle.bodies}
    return WagonDimensions(
        **{name: vehicle.dimensions[name] for name in _OUTLINE},
        coupler_height=vehicle.coupler.points[0][2],
        wheelbase=max(axles) - min(axles),
        wheel_radius=wheelsets[0].radius,
        centre_plate_distance=abs(plates[0].point[0] - plates[-1].point[0]),
        centre_plate_height=plates[0].point[2],
        centre_plate_radius=plates[0].radius,
        side_bearer_half_spacing=abs(bearer.point[1]),
        spring_nest_half_spacing=abs(nest.point[1]),
        spring_nest_height=nest.point[2],
        wedge_half_spacing=abs(wedge.point[0] - bolster.position[0]),
        wedge_height=wedge.point[2],
        **{f"{kind}_height": height[kind] for kind in _BODIES},
    )


def _first(vehicle: Vehicle, kind: type[T]) -> T:
    """The first coupling of a kind."""
    return next(one for one in vehicle.couplings if isinstance(one, kind))


def _missing(vehicle: Vehicle) -> list[str]:
    """Bodies, couplings and lengths of an ore wagon that a description lacks."""
    kinds = {body.kind for body in vehicle.bodies}
    couplings = {type(one) for one in vehicle.couplings}
    return [
        *sorted(set(_BODIES) - kinds),
        *(kind.__name__ for kind in _COUPLINGS if kind not in couplings),
        *sorted(set(_OUTLINE) - set(vehicle.dimensions)),
    ]
