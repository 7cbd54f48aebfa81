"""Plausible ranges of a vehicle's numbers, one pydantic type for each quantity.

The quantity of a number follows from its unit and the last word of its name: ``pad.lateral_stiffness`` in N/m
is a stiffness. The ranges are wide, an order of magnitude beyond the vehicles at hand (assumed): they
catch other units and slips of the sign, not bad design. What may be absent may also be 0.

A change to more than `MOST_TIMES` of its base or less than its inverse is refused too, unless it says its
unit: so are the kilonewtons and millimetres that the ranges let pass.
"""

from functools import cache
from typing import Annotated, Any, NamedTuple

from pydantic import Field, TypeAdapter, ValidationError

from hh_exudyn.sourced import Parameter
from vehicles.units import allowed_units

MOST_TIMES = 200.0
_AXES = ("x", "y", "z")  # behind the name of a component


def _between(low: float, high: float) -> Any:
    return Annotated[float, Field(ge=low, le=high, allow_inf_nan=False)]


Mass = _between(5.0, 500e3)
Payload = _between(1e3, 200e3)
Inertia = _between(0.5, 50e6)
Stiffness = _between(10e3, 10e9)
AngularStiffness = _between(1e3, 10e9)
Damping = _between(10.0, 1e9)
AngularDamping = _between(1.0, 1e9)
Height = _between(0.05, 6.0)
Radius = _between(0.05, 1.0)
Length = _between(0.01, 60.0)
Play = _between(0.0, 0.5)
Share = _between(0.0, 1.0)
Ratio = _between(0.0, 20.0)
Angle = _between(-90.0, 90.0)
Side = _between(-1.0, 1.0)
Frequency = _between(0.01, 50.0)
Force = _between(0.0, 5e6)
CreepCoefficient = _between(1e4, 1e9)
Power = _between(1e3, 50e6)


class Quantity(NamedTuple):
    """A quantity of vehicles."""

    name: str
    kind: Any  # pydantic type
    or_zero: bool = False


_HEIGHT, _LENGTH = Quantity("height", Height), Quantity("length", Length)
_STIFFNESS, _DAMPING = "stiffness", "damping"
_LENGTHS = (
    "length",
    "width",
    "depth",
    "distance",
    "wheelbase",
    "spacing",
    "position",
    "gyration",
    "drop",
    "rise",
)
QUANTITIES: dict[str, dict[str, Quantity]] = {  # unit: last word of the name
    "kg": {"mass": Quantity("mass", Mass), "tare": Quantity("mass", Mass),
           "payload": Quantity("payload", Payload, or_zero=True)},
    "kg m^2": {"inertia": Quantity("moment of inertia", Inertia)},
    "N/m": {_STIFFNESS: Quantity("stiffness", Stiffness, or_zero=True)},
    "N m/rad": {_STIFFNESS: Quantity("angular stiffness", AngularStiffness, or_zero=True)},
    "N s/m": {_DAMPING: Quantity("damping", Damping, or_zero=True)},
    "N m s/rad": {_DAMPING: Quantity("angular damping", AngularDamping, or_zero=True)},
    "m": {**dict.fromkeys(("height", "top", "bottom"), _HEIGHT), "radius": Quantity("radius", Radius),
          **dict.fromkeys(("clearance", "wear", "from"), Quantity("play", Play)),
          **dict.fromkeys(_LENGTHS, _LENGTH)},
    "-": {"friction": Quantity("friction", Share), "conicity": Quantity("conicity", Share),
          "ratio": Quantity("ratio", Ratio), "share": Quantity("share", Share),
          "side": Quantity("side", Side),
          **dict.fromkeys(("damping", "spherical"), Quantity("yes (1) or no (0)", Share))},
    "rad": {"clearance": Quantity("angular play", Play)},
    "deg": dict.fromkeys(("slope", "toe", "angle"), Quantity("angle", Angle)),
    "Hz": {"frequency": Quantity("frequency", Frequency)},
    "N": {"creep": Quantity("creep coefficient", CreepCoefficient),
          **dict.fromkeys(("preload", "effort", "mm"), Quantity("force", Force))},
    "W": {"power": Quantity("power", Power)},
}  # fmt: skip


def quantity_of(parameter: Parameter) -> Quantity | None:
    """The quantity of a number; None for one of another kind, in a vehicle of another package."""
    words = parameter.name.rsplit(".", 1)[-1].split("_")
    word = words[-2] if len(words) > 1 and words[-1] in _AXES else words[-1]
    return QUANTITIES.get(parameter.unit, {}).get(word)


def require_plausible(parameter: Parameter) -> None:
    """Check a number against the range of its quantity.

    Raises
    ------
    ValueError
        It lies outside; one line with the range.
    """
    quantity = quantity_of(parameter)
    if quantity is None or (quantity.or_zero and parameter.value == 0.0):
        return
    value = parameter.value
    if ".preload" in parameter.name:  # it may point either way
        value = abs(value)
    try:
        _adapter(quantity).validate_python(value)
    except ValidationError:
        low, high = _bounds(quantity)
        unit = "" if parameter.unit == "-" else f" {parameter.unit}"
        also = "0, or " if quantity.or_zero else ""
        raise ValueError(
            f"{parameter.name} = {parameter.value:g}{unit} is no plausible {quantity.name}: allowed {also}"
            f"{low:g} to {high:g}{unit}{_other_units(parameter)}"
        ) from None


def _other_units(parameter: Parameter) -> str:
    """How the number would be written in another unit, where it has some."""
    others = allowed_units(parameter.unit)[1:]
    return (
        f'; with a unit: "{parameter.value:g} {others[0]}" or {", ".join(others[1:])}' if others[1:] else ""
    )


def require_same_unit(parameter: Parameter, base: Parameter) -> None:
    """Check that a number without a unit is in that of its base: it is not many times more or less.

    Raises
    ------
    ValueError
        It is; one line with the base's value.
    """
    if parameter.unit == "-" or 0.0 in (parameter.value, base.value):
        return
    if not 1.0 / MOST_TIMES <= abs(parameter.value / base.value) <= MOST_TIMES:
        raise ValueError(
            f"{parameter.name} = {parameter.value:g} {parameter.unit} where the base has {base.value:g} "
            f"{base.unit}: in another unit? allowed within {MOST_TIMES:g} times of it, or with its unit, "
            f'{{ value = {parameter.value:g}, unit = "{base.unit}" }}'
        )


@cache
def _adapter(quantity: Quantity) -> TypeAdapter[float]:
    return TypeAdapter(quantity.kind)


def _bounds(quantity: Quantity) -> tuple[float, float]:
    schema = _adapter(quantity).json_schema()
    return float(schema["minimum"]), float(schema["maximum"])
