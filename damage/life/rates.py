"""Constant rates of wear and of crack damage of a group of wheels: of a surface, or measured."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from damage.evolution.profile_wear import ProfileWear, mean_wear
from damage.life.condition import INDICES, on_grid
from damage.surface.lateral_grid import LateralGrid
from damage.surface.wheel_surface import WheelSurface
from hh_exudyn.arrays import FloatArray

_SUMS = {"global": "global_crack_damage", "local": "crack_damage"}


@dataclass(frozen=True, eq=False)
class LifeRates:
    """Constant rates of a group of wheels.

    Attributes
    ----------
    wear
        Depth per kilometre over the profile.
    damage_per_km
        (B,) Miner's sum per kilometre by index, on the bins of the wheels' cracks [1/km].
    """

    wear: ProfileWear
    damage_per_km: Mapping[str, FloatArray]

    def __post_init__(self) -> None:
        object.__setattr__(self, "damage_per_km", MappingProxyType(dict(self.damage_per_km)))

    def scaled(self, wear: float = 1.0, damage: float = 1.0) -> "LifeRates":
        """The rates times factors, for studies.

        Parameters
        ----------
        wear, damage
            Factors >= 0.
        """
        return LifeRates(
            replace(self.wear, depth_per_km=wear * self.wear.depth_per_km),
            {index: damage * values for index, values in self.damage_per_km.items()},
        )

    def damage(self, distance: float) -> dict[str, FloatArray]:
        """(B,) Miner's sum of a distance [m] by index."""
        return {index: values * (1e-3 * distance) for index, values in self.damage_per_km.items()}


def rates_of(surface: WheelSurface, grid: LateralGrid, indices: tuple[str, ...] = INDICES) -> LifeRates:
    """The rates of the wheels of a surface: their mean, tread and flange contact together.

    Parameters
    ----------
    surface
        Sums over a load collective, or a run; of some wheels by `WheelSurface.only`.
    grid
        Bins of the wheels' cracks.
    indices
        Of the layers of cracks.

    Raises
    ------
    ValueError
        A surface without wheels, one that has not rolled, or an index that it has no sum of.
    """
    wear = mean_wear(surface)
    unknown = set(indices) - set(_SUMS)
    if unknown:
        raise ValueError(f"a surface has no crack damage by {sorted(unknown)}; it has {', '.join(_SUMS)}")
    per_km = 1e3 / surface.distance
    damage = {}
    for index in indices:
        of_wheels = getattr(surface, _SUMS[index]).sum(axis=1)
        damage[index] = on_grid(np.mean(of_wheels, axis=0) * per_km, surface.grid, grid)
    return LifeRates(wear, damage)
