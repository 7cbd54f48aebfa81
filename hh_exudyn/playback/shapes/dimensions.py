"""The lengths that the wagon is drawn from."""

from dataclasses import dataclass, fields

from vehicles.description import Vehicle


@dataclass(frozen=True)
class WagonDimensions:
    """Lengths of an ore wagon [m]; heights are over the rail tops, springs unloaded.

    The defaults are LKAB's Fanoo wagon: published ones after the thesis' Table 1-1 (Hossein-Nia 2018), the
    others as `vehicles/data/iore_wagon.toml` assumes them.

    Raises
    ------
    ValueError
        A length is not positive (the ore depth may be 0), or a basket longer than the wagon.
    """

    length: float = 10.29  # over the couplers
    height: float = 3.64
    basket_width: float = 3.49
    basket_length: float = 8.9
    centre_plate_distance: float = 6.77
    centre_plate_height: float = 0.80
    wheelbase: float = 1.778
    wheel_radius: float = 0.4575
    axle_box_half_spacing: float = 1.0
    coupler_height: float = 1.06
    ore_depth: float = 1.8  # 0 for an empty wagon
    running_circle_distance: float = 0.75  # half the distance of the two running circles
    car_body_height: float = 2.04  # centres of mass
    bolster_height: float = 0.67
    side_frame_height: float = 0.48

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not value > 0.0 and not (field.name == "ore_depth" and value == 0.0):
                raise ValueError(f"{field.name} = {value} m must be above 0")
        if not self.basket_length < self.length:
            raise ValueError(f"basket_length {self.basket_length} m must be below length {self.length} m")


_BODIES = {"car_body_height": "car_body", "bolster_height": "bolster", "side_frame_height": "side_frame"}
_OPTIONAL = "running_circle_distance"


def is_ore_wagon(vehicle: Vehicle) -> bool:
    """Whether a description has all lengths of an ore wagon, and its kinds of bodies and no others."""
    return not _missing(vehicle) and {body.kind for body in vehicle.bodies} == {*_BODIES.values(), "wheelset"}


def wagon_dimensions(vehicle: Vehicle) -> WagonDimensions:
    """The lengths of a described wagon; its units are alike.

    Raises
    ------
    ValueError
        The description lacks a length, or has no car body, no bolster or no side frame.
    """
    if missing := _missing(vehicle):
        raise ValueError(
            f"vehicle {vehicle.name} cannot be drawn as an ore wagon: it lacks {', '.join(missing)}"
        )
    given = {field.name for field in fields(WagonDimensions)} & set(vehicle.dimensions)
    height = {body.kind: body.position[2] for body in vehicle.bodies}
    return WagonDimensions(
        **{name: vehicle.dimensions[name] for name in given},
        **{name: height[kind] for name, kind in _BODIES.items()},
    )


def _missing(vehicle: Vehicle) -> list[str]:
    """What a description lacks of an ore wagon's."""
    wanted = {field.name for field in fields(WagonDimensions)} - set(_BODIES) - {_OPTIONAL}
    kinds = {body.kind for body in vehicle.bodies}
    return sorted((set(_BODIES.values()) - kinds) | (wanted - set(vehicle.dimensions)))
