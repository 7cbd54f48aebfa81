"""Wear depth per kilometre over a wheel profile, of one wheel or as the mean of several.

A profile evolves by the wear of one wheel, or by the mean of a group of wheels:

``"wheel"``       every wheel separately
``"wheelset"``    the two wheels of a wheelset: as many curves to the left as to the right
``"directions"``  the wheels of one side at equal distances from the leading and from the trailing end: runs
                  in both directions over the same curves, where the last wheelset leads on the way back and
                  the outer wheel remains the outer one
``"both"``        both means: four wheels have the same wear
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np
from numpy.typing import ArrayLike

from damage.surface.wheel_surface import Wheel, WheelSurface
from hh_exudyn.arrays import FloatArray

TOGETHER = ("wheel", "wheelset", "directions", "both")


@dataclass(frozen=True, eq=False)
class ProfileWear:
    """Wear depth over a wheel profile.

    Attributes
    ----------
    y
        (n,) lateral coordinate on the profile that wears, increasing [m].
    depth_per_km
        (n,) depth normal to the surface per kilometre rolled, linear in between, 0 beyond the ends [m/km].
    pressure
        Largest contact pressure of the collective that wears [Pa]; NaN where it is not known.

    Raises
    ------
    ValueError
        Other shapes, fewer than 2 values, a lateral coordinate that does not increase, a depth that is
        not finite or below zero, or a pressure below zero.
    """

    y: FloatArray
    depth_per_km: FloatArray
    pressure: float = math.nan

    def __post_init__(self) -> None:
        y, depth = np.array(self.y, dtype=np.float64), np.array(self.depth_per_km, dtype=np.float64)
        if y.ndim != 1 or y.shape != depth.shape or y.size < 2:
            raise ValueError(
                f"y and depth_per_km have shapes {y.shape} and {depth.shape}, needed (n,), n >= 2"
            )
        if not (np.isfinite(y).all() and (np.diff(y) > 0.0).all()):
            raise ValueError("y [m] of a wear depth must be finite and increase")
        wrong = ~(np.isfinite(depth) & (depth >= 0.0))
        if wrong.any():
            at = int(np.argmax(wrong))
            raise ValueError(f"depth_per_km = {depth[at]} m/km at y = {1e3 * y[at]:.3f} mm must be >= 0 m/km")
        if self.pressure < 0.0:
            raise ValueError(f"pressure = {self.pressure} Pa of a wear depth must be >= 0 Pa")
        for name, array in (("y", y), ("depth_per_km", depth)):
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    def at(self, y: ArrayLike) -> FloatArray:
        """Depth per kilometre at lateral positions [m/km]."""
        return np.interp(np.asarray(y, np.float64), self.y, self.depth_per_km, left=0.0, right=0.0)


def profile_wear(
    surface: WheelSurface, together: str = "wheel", wheels: Sequence[Wheel] | None = None
) -> dict[Wheel, ProfileWear]:
    """Wear over the profile of every wheel of a surface, or the mean of its group.

    Parameters
    ----------
    surface
        Sums over a contact log, or a load collective of such.
    together
        One of `TOGETHER`: see `damage.evolution.profile_wear`.
    wheels
        The wheels of the result; None for all.

    Returns
    -------
    dict
        By wheel; wheels of a group have the same depths.

    Raises
    ------
    ValueError
        Unknown `together`, a surface that has not rolled, a wheel that it does not have, or one
        without the other wheels of its group.
    """
    if together not in TOGETHER:
        raise ValueError(f"together = {together!r}, allowed are {', '.join(map(repr, TOGETHER))}")
    if not surface.distance > 0.0:
        raise ValueError("a surface that has not rolled has no wear per kilometre")
    depth, y = surface.depth_per_km, increasing(surface.grid.lateral)
    ends = _ends(surface.wheels)
    place = {wheel: index for index, wheel in enumerate(surface.wheels)}
    found = {}
    for wheel in surface.wheels if wheels is None else wheels:
        if wheel not in place:
            raise ValueError(f"{wheel} is not a wheel of the surface")
        partners = {(wheel.wheelset, wheel.side)}
        if together in ("directions", "both"):
            partners |= {(ends[wheel.vehicle] - number, side) for number, side in partners}
        if together in ("wheelset", "both"):
            partners |= {(number, -side) for number, side in partners}
        rows = [
            index
            for other, index in place.items()
            if other.vehicle == wheel.vehicle and (other.wheelset, other.side) in partners
        ]
        if len(rows) < len(partners):
            raise ValueError(
                f"{wheel} wears together ({together!r}) with the wheels (wheelset, side) {sorted(partners)}; "
                "the surface lacks some of them"
            )
        pressure = float(surface.max_pressure[rows].max())
        found[wheel] = ProfileWear(y, depth[rows].mean(axis=0), pressure)
    return found


def mean_wear(surface: WheelSurface) -> ProfileWear:
    """Mean over all wheels of a surface: for a vehicle with wheelsets that change places over its life.

    Raises
    ------
    ValueError
        A surface without wheels, or one that has not rolled.
    """
    if not (surface.wheels and surface.distance > 0.0):
        raise ValueError("a surface without wheels, or one that has not rolled, has no wear per kilometre")
    depth, pressure = surface.depth_per_km.mean(axis=0), float(surface.max_pressure.max())
    return ProfileWear(increasing(surface.grid.lateral), depth, pressure)


def _ends(wheels: Sequence[Wheel]) -> dict[int, int]:
    """First plus last number of each vehicle's wheelsets; minus a number: that from the other end."""
    numbers = groupby(sorted((wheel.vehicle, wheel.wheelset) for wheel in wheels), lambda pair: pair[0])
    lists = {vehicle: [number for _, number in pairs] for vehicle, pairs in numbers}
    return {vehicle: found[0] + found[-1] for vehicle, found in lists.items()}


def increasing(lateral: FloatArray) -> FloatArray:
    """Middles of bins, made increasing: beyond the ends of a profile's arc several may coincide.

    Parameters
    ----------
    lateral
        (B,) `damage.surface.lateral_grid.LateralGrid.lateral` [m].
    """
    least = np.arange(lateral.size) * math.ulp(1.0)
    return np.maximum.accumulate(lateral) + least
