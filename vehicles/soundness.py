"""Checks of a vehicle: numbers finite and of a possible size, all parts above the rails, between its ends.

They hold for vehicles built in Python too. The bounds are far out (assumed): beyond them no vehicle is meant,
and a run would take minutes to find that it has no equilibrium or no stable time step.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import fields
from itertools import pairwise
from typing import Any

LARGEST = {  # by the last word of a field: its largest value and unit; none is ever below zero
    "stiffness": (1e11, "N/m or N m/rad"),
    "damping": (1e10, "N s/m or N m s/rad"),
    "clearance": (1.0, "m"),
    "friction": (2.0, ""),
    "radius": (2.0, "m"),
    "mass": (1e9, "kg"),  # reference vehicles have a body of 1e8 kg in imposed motion
    "inertia": (1e12, "kg m^2"),
}
HIGHEST = 8.0  # m above the rails, of any body or coupling


def require_sound(parts: Iterable[Any]) -> None:
    """Check all numbers of bodies, couplings and wheelsets, which are dataclasses.

    Raises
    ------
    ValueError
        A number is not finite, or a stiffness, damping, clearance, friction, radius, mass or inertia is below
        zero or beyond `LARGEST`.
    """
    for part in parts:
        name = f"{type(part).__name__} {getattr(part, 'name', getattr(part, 'body', ''))}"
        for field in fields(part):
            largest, unit = LARGEST.get(field.name.rsplit("_", 1)[-1], (math.inf, ""))
            behind = f" {unit}" if unit else ""
            for value in _numbers(getattr(part, field.name)):
                if not math.isfinite(value):
                    raise ValueError(f"{name}: {field.name} = {value} must be a finite number")
                if largest < math.inf and value < 0.0:
                    raise ValueError(f"{name}: {field.name} = {value:g}{behind} must be >= 0")
                if value > largest:
                    raise ValueError(
                        f"{name}: {field.name} = {value:g}{behind}: allowed up to {largest:g}{behind}"
                    )


def require_inside(vehicle: Any) -> None:
    """Check the places of bodies and couplings: above the rails, and between the two ends of the vehicle.

    Parameters
    ----------
    vehicle : vehicles.description.Vehicle
        Its ends are the outermost coupler heads; one with a single head has none.

    Raises
    ------
    ValueError
        A body or coupling lies below the rails, more than `HIGHEST` above, or beyond an end; wheels of
        neighbouring wheelsets overlap.
    """
    heads = [point[0] for point in vehicle.coupler.points]
    ends = (min(heads), max(heads)) if max(heads) > min(heads) else (-math.inf, math.inf)
    for name, point in _places(vehicle):
        if not 0.0 <= point[2] <= HIGHEST:
            raise ValueError(
                f"vehicle {vehicle.name}: {name} lies {point[2]:g} m above the rails: allowed 0 to "
                f"{HIGHEST:g} m"
            )
        if not ends[0] <= point[0] <= ends[1]:
            raise ValueError(
                f"vehicle {vehicle.name}: {name} lies at x = {point[0]:g} m, outside the vehicle: allowed "
                f"{ends[0]:g} to {ends[1]:g} m, between its coupler heads"
            )

    for one, other in pairwise(vehicle.wheelsets):
        apart = abs(vehicle.body(one.body).position[0] - vehicle.body(other.body).position[0])
        if apart <= one.radius + other.radius:
            raise ValueError(
                f"vehicle {vehicle.name}: wheels of {one.body} and {other.body} overlap: {apart:g} m apart, "
                f"allowed above {one.radius + other.radius:g} m"
            )


def _places(vehicle: Any) -> Iterator[tuple[str, tuple[float, float, float]]]:
    """Name and place of every body, coupling, end of a rod, and coupler head."""
    for body in vehicle.bodies:
        yield body.name, body.position
    for coupling in vehicle.couplings:
        for key in ("point", "point_a", "point_b"):
            if hasattr(coupling, key):
                yield coupling.name, getattr(coupling, key)
    for point in vehicle.coupler.points:
        yield "coupler", point


def _numbers(value: Any) -> Iterator[float]:
    """All numbers in a value: itself, or those of the tuples in it."""
    if isinstance(value, tuple):
        for item in value:
            yield from _numbers(item)
    elif isinstance(value, int | float):
        yield value
