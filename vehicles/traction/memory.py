"""The changing state of controllers as numbers by name, to store it and to put it back.

What changes are the numbers and arrays among the attributes of a controller, and those of the controllers
that it contains; frozen dataclasses (gains, limits, orders) and functions are settings.
"""

from collections.abc import Iterator, Mapping
from dataclasses import is_dataclass
from typing import Any

import numpy as np

from hh_exudyn.arrays import FloatArray


def memory_of(owner: Any) -> dict[str, FloatArray]:
    """Copies of all numbers and arrays of a controller, by the path of their attributes.

    Parameters
    ----------
    owner : object
        A `control.Controller`, or `control.Actuators`.
    """
    return {
        path: np.array(getattr(holder, name), dtype=np.float64)
        for path, holder, name in _places(owner, "")
        if getattr(holder, name) is not None
    }


def put_back(owner: Any, memory: Mapping[str, FloatArray]) -> None:
    """Give a controller, made as it was, the state of another of its kind; arrays are filled in place.

    Parameters
    ----------
    owner : object
        The controller.
    memory : mapping
        From `memory_of`.
    """
    for path, holder, name in list(_places(owner, "")):
        if path not in memory:  # it had no value yet
            continue
        now, value = getattr(holder, name), memory[path]
        if isinstance(now, np.ndarray):
            now[...] = value
        elif value.ndim:
            setattr(holder, name, value.copy())
        else:
            setattr(holder, name, int(value) if isinstance(now, int) else float(value))


def _places(owner: Any, prefix: str) -> Iterator[tuple[str, Any, str]]:
    """(path, object, attribute) of every number, array of numbers, and missing value."""
    for name, value in vars(owner).items():
        path = f"{prefix}{name}"
        if isinstance(value, np.ndarray):
            if value.dtype == np.float64:
                yield path, owner, name
        elif value is None or isinstance(value, int | float):
            if not isinstance(value, bool):
                yield path, owner, name
        elif hasattr(value, "__dict__") and not is_dataclass(value) and not callable(value):
            yield from _places(value, f"{path}.")
