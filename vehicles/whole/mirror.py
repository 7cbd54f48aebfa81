"""The right-hand copy of an entry of the left: ``mirror = true`` in a vehicle file.

Its names change side, ``spring_1L`` to ``spring_1R``, ``left_frame`` to ``right_frame``, those of its bodies
too; y of its places, of an axis and of a preload changes sign.
"""

import re
from typing import Any

from vehicles.whole.layout import hints, is_place, is_vector

_SIDE = re.compile(r"(?:(?<=[_\d])|^)(L|R|left|right)(?=_|\d|$)")
_OTHER = {"L": "R", "R": "L", "left": "right", "right": "left"}
_TURNED = ("axis", "preload")  # vectors other than places that point to a side


def other_side(name: str) -> str:
    """A name of the other side; one that names no side is unchanged."""
    return _SIDE.sub(lambda found: _OTHER[found[1]], name)


def mirrored(kind: type, values: dict[str, Any]) -> dict[str, Any]:
    """Fields of a dataclass, mirrored in the middle plane of the vehicle.

    Raises
    ------
    ValueError
        Its name names no side.
    """
    found: dict[str, Any] = {}
    for key, value in values.items():
        hint = hints(kind)[key]
        if isinstance(value, str):
            found[key] = other_side(value)
        elif is_vector(hint) and (is_place(kind, key) or key in _TURNED):
            x, y, z = value
            found[key] = (x, -y, z)
        else:
            found[key] = value
    name = values.get("name", "")
    if name and found["name"] == name:
        raise ValueError(f'{name} has mirror = true: allowed a name with a side, such as "{name}_L"')
    return found
