"""`DamageSums`: what is kept of a run: the surfaces of its wheels and rails, and its largest forces."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any, TypeVar

import numpy as np

from damage.rails.rail_surface import RailSurface
from damage.rails.stored import rail_of, rail_parts
from damage.surface.stored import Arrays, BrokenFile, pack, parts_of, surface_of, unpack
from damage.surface.wheel_surface import Wheel, WheelSurface


@dataclass(frozen=True)
class DamageSums:
    """Damage of the wheels of a run on a stretch of its track; sums add, take weights, and can be mirrored.

    Attributes
    ----------
    surfaces
        One for the wheels of each profile, in the order of the profiles' first wheels: profiles have grids of
        their own.
    extremes
        Largest values of all wheels by name with unit (`hh_exudyn.campaign.engine.case_damage.EXTREMES`):
        weights do not change them, and of sums they are the larger ones.
    rails
        Left and right rail of a part of the track, passed once by the vehicle; empty where they are not
        wanted. Sums over the cases of one class of curves and one hand give that class's damage per gross
        tonne: every metre of rail belongs to one of them, so classes are not added.
    """

    surfaces: tuple[WheelSurface, ...]
    extremes: Mapping[str, float] = field(default_factory=dict)
    rails: tuple[RailSurface, ...] = ()

    def __add__(self, other: "DamageSums") -> "DamageSums":
        """Both together: surfaces on equal grids are added, all others stand beside each other."""
        surfaces = _together(self.surfaces, other.surfaces, _same_grids)
        rails = _together(self.rails, other.rails, _same_rail)
        largest = dict(self.extremes)
        for name, value in other.extremes.items():
            largest[name] = max(value, largest.get(name, value))
        return DamageSums(surfaces, largest, rails)

    def __radd__(self, other: object) -> "DamageSums":
        """The sums themselves, for the 0 that `sum()` begins with."""
        return self if other == 0 else NotImplemented

    def __rmul__(self, weight: float) -> "DamageSums":
        """All sums times a weight; ValueError for one that is not finite, or below zero."""
        surfaces = tuple(weight * surface for surface in self.surfaces)
        return replace(self, surfaces=surfaces, rails=tuple(weight * rail for rail in self.rails))

    def __mul__(self, weight: float) -> "DamageSums":
        """As `weight * sums`."""
        return self.__rmul__(weight)

    def per_metre(self) -> "DamageSums":
        """The sums of one metre rolled, to be weighted with distances; rails have been passed once."""
        return replace(self, surfaces=tuple(surface.scaled(1.0) for surface in self.surfaces))

    def mirrored(self) -> "DamageSums":
        """Left and right wheels exchanged, and left and right rails: the sums of the mirrored case."""
        surfaces = tuple(_mirrored(surface) for surface in self.surfaces)
        return replace(self, surfaces=surfaces, rails=tuple(rail.mirrored() for rail in self.rails))


PartSums = dict[str, DamageSums]
"""Sums by the name of a part of the track."""


def to_bytes(sums: Mapping[str, DamageSums], key: str) -> bytes:
    """Sums by part as the content of a file (npz with checksum); equal sums give the same bytes.

    Parameters
    ----------
    sums
        By the name of the part.
    key
        Of what they are the sums of: a file under the name of another is found out.
    """
    header: dict[str, Any] = {"key": key, "parts": []}
    arrays: Arrays = {}
    for i, (name, one) in enumerate(sums.items()):
        heads: dict[str, list[dict[str, Any]]] = {"surfaces": [], "rails": []}
        for k, surface in enumerate(one.surfaces):
            head, own = parts_of(surface)
            heads["surfaces"].append(head)
            arrays |= {f"{i}-{k}-{field}": values for field, values in own.items()}
        for k, rail in enumerate(one.rails):
            head, own = rail_parts(rail)
            heads["rails"].append(head)
            arrays |= {f"{i}-rail{k}-{field}": values for field, values in own.items()}
        header["parts"].append({"name": name, **heads, "extremes": dict(one.extremes)})
    return pack(header, arrays)


def from_bytes(content: bytes, key: str, source: str) -> PartSums:
    """Sums by part from the content of a file.

    Parameters
    ----------
    content
        All of the file.
    key
        Of what they are to be the sums of.
    source
        Its name, for messages.

    Raises
    ------
    BrokenFile
        It is not what was written, or of another key.
    """
    header, arrays = unpack(content, source)
    if header.get("key") != key:
        raise BrokenFile(f"{source}: holds the sums of {header.get('key')!r}, not of {key!r}")
    own: dict[str, Arrays] = {}
    for name, values in arrays.items():
        place, _, field_name = name.rpartition("-")
        own.setdefault(place, {})[field_name] = values
    try:
        return {
            part["name"]: DamageSums(
                tuple(
                    surface_of(head, own.get(f"{i}-{k}", {}), source)
                    for k, head in enumerate(part["surfaces"])
                ),
                dict(part["extremes"]),
                tuple(
                    rail_of(head, own.get(f"{i}-rail{k}", {}), source) for k, head in enumerate(part["rails"])
                ),
            )
            for i, part in enumerate(header["parts"])
        }
    except (KeyError, TypeError) as error:
        raise BrokenFile(f"{source}: holds no damage sums: {error!r}") from None


Sum = TypeVar("Sum", WheelSurface, RailSurface)


def _together(
    ours: Iterable[Sum], others: Iterable[Sum], alike: Callable[[Sum, Sum], bool]
) -> tuple[Sum, ...]:
    """Both: those that are alike are added, all others stand beside each other."""
    total = list(ours)
    for new in others:
        place = next((i for i, one in enumerate(total) if alike(one, new)), None)
        if place is None:
            total.append(new)
        else:
            total[place] = total[place] + new
    return tuple(total)


def _same_rail(one: RailSurface, other: RailSurface) -> bool:
    return one.side == other.side and _same_grids(one.by_wheel, other.by_wheel)


def _same_grids(one: WheelSurface, other: WheelSurface) -> bool:
    return one.grid == other.grid and one.patch_grid == other.patch_grid


def _mirrored(surface: WheelSurface) -> WheelSurface:
    """The surface with every wheel on the other side; wheels stay sorted."""
    wheels = [Wheel(*wheel[:3], -wheel.side) for wheel in surface.wheels]
    order = sorted(range(len(wheels)), key=wheels.__getitem__)
    sums = {
        one.name: getattr(surface, one.name)[order]
        for one in fields(surface)
        if isinstance(getattr(surface, one.name), np.ndarray)
    }
    return replace(surface, wheels=tuple(wheels[i] for i in order), **sums)
