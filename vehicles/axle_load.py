"""A wagon at another axle load: a variant with more or less payload."""

from typing import Any

from vehicles.variants import Variant, variant_of_table

PAYLOAD, _LARGEST = "wagon.payload", "wagon.largest_payload"
_DEPTH, _HEIGHT = "car_body.ore_depth", "car_body.ore_height"


def with_axle_load(variant: Variant, axle_load: float) -> Variant:
    """The same wagon, of the same name, loaded to a mean axle load.

    The load fills the basket from the same floor: its depth goes with its mass, and its centre rises by half
    of what the depth grows. A load above the wagon's largest payload raises that limit, as in trials with
    heavier axles; springs and all else are as before.

    Parameters
    ----------
    variant
        A loaded wagon with a payload of its own.
    axle_load
        Mass on a wheelset, that of the wheelset included [kg].

    Raises
    ------
    ValueError
        A vehicle without payload, or an axle load not above that of the empty wagon.
    """
    numbers, vehicle = variant.parameters(), variant.vehicle()
    if not carries_payload(variant):
        raise ValueError(f"vehicle {variant.name} carries no {PAYLOAD}: allowed a loaded wagon that does")
    axles, units = len(vehicle.wheelsets), len(vehicle.units)
    before = numbers[PAYLOAD]
    payload = before + (axle_load * axles - vehicle.mass) / units
    if not payload > 0.0:
        empty = (vehicle.mass - units * before) / axles
        raise ValueError(
            f"axle load {1e-3 * axle_load:g} t of {variant.name}: allowed above {1e-3 * empty:g} t, empty"
        )
    source = f"derived: {1e-3 * axle_load:g} t axle load"
    changes = {PAYLOAD: payload}
    if payload > numbers[_LARGEST]:
        changes[_LARGEST] = payload
    grown = numbers[_DEPTH] * (payload / before - 1.0)
    changes |= {_DEPTH: numbers[_DEPTH] + grown, _HEIGHT: numbers[_HEIGHT] + 0.5 * grown}
    words = f"{variant.description.split(',')[0]}, {1e-3 * axle_load:g} t axle load"
    table: dict[str, Any] = variant.to_table() | {"description": words}
    for name, value in changes.items():
        part, quantity = name.split(".")
        unit = numbers.parameter(name).unit
        table.setdefault(part, {})[quantity] = {"value": value, "unit": unit, "source": source}
    return variant_of_table(table, source)


def carries_payload(variant: Variant) -> bool:
    """Whether a vehicle has a payload that can be changed, and is loaded with it."""
    numbers = variant.parameters()
    return PAYLOAD in numbers and numbers[PAYLOAD] > 0.0
