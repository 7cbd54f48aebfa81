"""Common parts of the builders of vehicles: both sides, couplings filled from parameters by name."""

import math
from collections.abc import Mapping
from dataclasses import MISSING, fields
from typing import Any, TypeVar

from hh_exudyn.sourced import ParameterSet
from vehicles.couplings import Vector
from vehicles.description import Body, Coupler

SIDES = ((1, "L"), (-1, "R"))  # sign of y, letter in names

_Part = TypeVar("_Part")


def principal_inertia(p: ParameterSet, part: str) -> Vector:
    """Moments of inertia about x, y and z [kg m^2]: the part's roll, pitch and yaw inertia.

    Parameters
    ----------
    p : parameters of the vehicle
    part : name of a part in them
    """
    return p[f"{part}.roll_inertia"], p[f"{part}.pitch_inertia"], p[f"{part}.yaw_inertia"]


def body_of_kind(p: ParameterSet, kind: str, name: str, position: Vector, deflection: float = 0.0) -> Body:
    """A body with the mass and the moments of inertia of its kind.

    Parameters
    ----------
    p : parameters of the vehicle
    kind : of the body, and the name of the part in them
    name : of the body
    position : of its centre of mass on the drawing [m]
    deflection : as of `description.Body` [m]
    """
    return Body(name, kind, p[f"{kind}.mass"], principal_inertia(p, kind), position, deflection)


def in_directions(p: ParameterSet, part: str, quantity: str) -> Vector:
    """A part's longitudinal, lateral and vertical stiffness or damping, in the units of the file.

    Parameters
    ----------
    p : parameters of the vehicle
    part : name of a part in them
    quantity : "stiffness" or "damping"
    """
    along, across, down = (p[f"{part}.{axis}_{quantity}"] for axis in ("longitudinal", "lateral", "vertical"))
    return along, across, down


def filled(kind: type[_Part], p: ParameterSet, part: str, **given: Any) -> _Part:
    """A coupling: every field that is not given is the part's parameter of the field's name.

    Raises KeyError for a field that neither has, and that has no default.

    Parameters
    ----------
    kind : class of the coupling
    p : parameters of the vehicle
    part : name of a part in them
    given : values of fields that are not parameters
    """
    missing = [field for field in fields(kind) if field.name not in given]  # type: ignore[arg-type]
    numbers = {
        field.name: p[f"{part}.{field.name}"]
        for field in missing
        if field.default is MISSING or f"{part}.{field.name}" in p
    }
    return kind(**given, **numbers)


def train_coupler(p: ParameterSet, heads: Mapping[Vector, str], mass: float) -> Coupler:
    """All coupler heads, tuned so that a vehicle follows the train at the given frequency and damping.

    Parameters
    ----------
    p : parameters of the vehicle, with the part "coupler"
    heads : body of each head, by its place on the drawing [m]
    mass : of the vehicle [kg]
    """
    pulsation = 2 * math.pi * p["coupler.train_frequency"]
    return Coupler(
        bodies=tuple(heads.values()),
        points=tuple(heads),
        stiffness=mass * pulsation**2,
        damping=2 * p["coupler.train_damping_ratio"] * mass * pulsation,
    )


def end_heads(p: ParameterSet, length: float) -> dict[Vector, str]:
    """Coupler heads at both ends of a car body of that length [m], for `train_coupler`.

    Parameters
    ----------
    p : parameters of the vehicle, with the height of the coupler
    length : of the car body [m]
    """
    height = p["coupler.height"]
    return {(0.5 * length, 0.0, height): "car_body", (-0.5 * length, 0.0, height): "car_body"}
