"""Checks of all numbers of a vehicle: none is NaN or infinity, no stiffness or clearance is below zero."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import fields
from typing import Any

UNITS = {  # of the fields that end in these words, which are never below zero
    "stiffness": "",
    "damping": "",
    "clearance": " m",
    "friction": "",
    "radius": " m",
}


def require_sound(parts: Iterable[Any]) -> None:
    """Check all numbers of bodies, couplings and wheelsets, which are dataclasses.

    Raises
    ------
    ValueError
        A number is not finite, or a stiffness, damping, clearance, friction or radius is below zero.
    """
    for part in parts:
        name = f"{type(part).__name__} {getattr(part, 'name', getattr(part, 'body', ''))}"
        for field in fields(part):
            for value in _numbers(getattr(part, field.name)):
                if not math.isfinite(value):
                    raise ValueError(f"{name}: {field.name} = {value} must be a finite number")
                word = field.name.rsplit("_", 1)[-1]
                if word in UNITS and value < 0.0:
                    raise ValueError(f"{name}: {field.name} = {value:g}{UNITS[word]} must be >= 0")


def _numbers(value: Any) -> Iterator[float]:
    """All numbers in a value: itself, or those of the tuples in it."""
    if isinstance(value, tuple):
        for item in value:
            yield from _numbers(item)
    elif isinstance(value, int | float):
        yield value
