"""Limits of a wheel in service: when it must be turned, and when it is at its end."""

from dataclasses import dataclass, fields

from damage.bounds import check_above_zero
from damage.parameters import parameters, table_names
from hh_exudyn.sourced import Parameter

_GENERAL = ("profile", "cracks", "places", "turning")  # the other tables are vehicles
_PER_SI = {"mm": 1e3, "-": 1.0}


@dataclass(frozen=True)
class WheelLimits:
    """Limits of a wheel in service, with their sources in ``damage/data/limits.toml``.

    Attributes
    ----------
    least_diameter
        At the running circle [m]; below it the wheel is at its end.
    new_diameter
        Of the new wheel [m].
    least_flange_thickness, largest_flange_thickness
        Sd of EN 15313 [m].
    largest_flange_height
        Sh [m].
    least_flange_steepness
        qR [m].
    largest_hollow
        Depth of a hollow tread [m].
    largest_crack_depth
        Of the deepest crack, normal to the surface [m].
    largest_crack_length
        Of its mouth [m].
    length_over_depth
        Mouth of a crack over its depth, by which a depth is a length [-].

    Raises
    ------
    ValueError
        A number that is not finite and above zero, or a least value above its largest.
    """

    least_diameter: float
    new_diameter: float
    least_flange_thickness: float
    largest_flange_thickness: float
    largest_flange_height: float
    least_flange_steepness: float
    largest_hollow: float
    largest_crack_depth: float
    largest_crack_length: float
    length_over_depth: float

    def __post_init__(self) -> None:
        for field in fields(self):
            unit = "-" if field.name == "length_over_depth" else "m"
            check_above_zero(field.name, getattr(self, field.name), unit, "a wheel's limits")
        for low, high in (
            ("least_diameter", "new_diameter"),
            ("least_flange_thickness", "largest_flange_thickness"),
        ):
            if not getattr(self, low) < getattr(self, high):
                raise ValueError(
                    f"{low} = {getattr(self, low)} m of a wheel's limits must be below {high} = "
                    f"{getattr(self, high)} m"
                )

    @classmethod
    def of(cls, vehicle: str) -> "WheelLimits":
        """The limits of a vehicle's wheels.

        Parameters
        ----------
        vehicle
            One of `limited_vehicles`.

        Raises
        ------
        ValueError
            There are no diameters of that vehicle (lists those that there are).
        """
        if vehicle not in limited_vehicles():
            raise ValueError(
                f"vehicle {vehicle!r} has no wheel diameters; known: {', '.join(limited_vehicles())}"
            )
        diameters = {name: _si(item) for name, item in parameters("limits", vehicle).items()}
        profile = {name: _si(item) for name, item in parameters("limits", "profile").items()}
        cracks = {name: _si(item) for name, item in parameters("limits", "cracks").items()}
        return cls(
            **diameters,
            **profile,
            largest_crack_depth=cracks["largest_depth"],
            largest_crack_length=cracks["largest_length"],
            length_over_depth=cracks["length_over_depth"],
        )


def limited_vehicles() -> tuple[str, ...]:
    """Vehicles with wheel diameters in the data file."""
    return tuple(name for name in table_names("limits") if name not in _GENERAL)


def limit(table: str, name: str) -> float:
    """A number of ``damage/data/limits.toml`` [m or -].

    Parameters
    ----------
    table, name
        Of the entry: "cracks", "failure_depth".
    """
    return _si(parameters("limits", table)[name])


def _si(item: Parameter) -> float:
    return item.value / _PER_SI[item.unit]
