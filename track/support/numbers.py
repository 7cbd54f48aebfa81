"""Units and ranges of the numbers of a track on its support, by the names of the fields."""

import math
from dataclasses import fields
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from _typeshed import DataclassInstance


def unit_of(name: str) -> str:
    """SI unit of a field, from its name."""
    for part, unit in (
        ("stiffness", "N/m"),
        ("damping", "N s/m"),
        ("roll_inertia", "kg m2"),
        ("mass_per_length", "kg/m"),
        ("mass", "kg"),
        ("modulus", "Pa"),
        ("inertia", "m4"),
        ("area", "m2"),
        ("coefficient", "-"),
    ):
        if part in name:
            return unit
    return "m"


def check_numbers(track: "DataclassInstance", shares: tuple[str, ...] = ()) -> None:
    """Check every number of a record of a track.

    Parameters
    ----------
    track
        A dataclass of numbers alone.
    shares
        Names of its fields that go from 0 to below 1 [-]; the others are positive and finite.

    Raises
    ------
    ValueError
        A number out of its range.
    """
    for item in fields(track):
        value: Any = getattr(track, item.name)
        name = f"{item.name} of {type(track).__name__}"
        if item.name in shares:
            if not 0.0 <= value < 1.0:
                raise ValueError(f"{name} is {value}, it must be from 0 to below 1")
        elif not 0.0 < value < math.inf:
            raise ValueError(f"{name} is {value} {unit_of(item.name)}, it must be positive and finite")
