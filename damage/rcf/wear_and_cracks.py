"""Wear and rolling contact fatigue together: the cracks that remain where layers wear off.

Two approaches (`APPROACHES`):

``"burstow"``    Wear is part of the count: cells that lose more energy than Burstow's thresholds count less
                 (`damage.rcf.burstow`; `WheelSurface.corrected_rcf_number`).
``"geometric"``  Cracks grow as without wear, and are shortened by the layer that wears off: the
                 depth of the cracks is the depth they would have without wear, less the wear depth (Hossein-
                 Nia 2018, section 3.3, first approach; after Dirks 2015).

In the second, the depth of a crack is proportional to its damage by Miner's sum (equation 3.22): h = h_f D,
h_f its depth at failure, D = 1. So a wear depth of w reduces the damage by w/h_f. Depths are normal to the
surface, as wear depths are. There is no published h_f for wheels: it must be given, for instance from
`damage.rcf.crack` as ``CrackShape.depth(1.0)``.

`CrackLayer` follows both over the distance, step by step. Within a step the rates of growth and of wear are
constant, and a crack that is worn off begins anew at once: exact for constant rates and any division into
steps. Wear at the rate of growth keeps the depth of the cracks constant; faster wear removes them all after

    distance = depth / (rate of wear - rate of growth)
"""

from dataclasses import dataclass

import numpy as np
import pyarrow
from numpy.typing import NDArray

from damage.bounds import check_above_zero
from damage.surface.lateral_grid import LateralGrid
from damage.surface.wheel_surface import WheelSurface
from hh_exudyn.arrays import FloatArray

APPROACHES = ("none", "burstow", "geometric")


@dataclass(frozen=True, eq=False)
class CrackLayer:
    """Cracks over the profile of one wheel, B bins.

    Attributes
    ----------
    grid
        The bins.
    failure_depth
        Depth of a crack at failure, where Miner's sum is 1 [m], > 0.
    damage
        (B,) Miner's sum of the cracks that remain after wear [-].
    damage_without_wear
        (B,) Miner's sum without the effect of wear [-].
    worn
        (B,) wear depth [m].

    Raises
    ------
    ValueError
        A failure depth that is not above zero, or arrays that do not fit the grid.
    """

    grid: LateralGrid
    failure_depth: float
    damage: FloatArray
    damage_without_wear: FloatArray
    worn: FloatArray

    def __post_init__(self) -> None:
        check_above_zero("failure_depth", self.failure_depth, "m", "a crack")
        for name in ("damage", "damage_without_wear", "worn"):
            _check_bins(name, getattr(self, name), self.grid)

    @classmethod
    def new(cls, grid: LateralGrid, failure_depth: float) -> "CrackLayer":
        """A wheel without cracks and without wear.

        Parameters
        ----------
        grid
            The bins.
        failure_depth
            Depth of a crack at failure [m], > 0.
        """
        return cls(grid, failure_depth, *(np.zeros(grid.count) for _ in range(3)))

    def after(self, damage: FloatArray, worn: FloatArray) -> "CrackLayer":
        """The cracks after a step in which they gain damage and the surface wears.

        Parameters
        ----------
        damage
            (B,) Miner's sum of the step, as without wear [-], >= 0.
        worn
            (B,) wear depth of the step, normal to the surface [m], >= 0.

        Raises
        ------
        ValueError
            Arrays that do not fit the grid, or values below zero or not finite.
        """
        _check_bins("damage", damage, self.grid)
        _check_bins("worn", worn, self.grid)
        return CrackLayer(
            self.grid,
            self.failure_depth,
            np.maximum(self.damage + damage - worn / self.failure_depth, 0.0),
            self.damage_without_wear + damage,
            self.worn + worn,
        )

    @property
    def depth(self) -> FloatArray:
        """(B,) depth of the cracks, from the worn surface on [m]."""
        return self.failure_depth * self.damage

    @property
    def depth_without_wear(self) -> FloatArray:
        """(B,) depth of the cracks without wear [m]."""
        return self.failure_depth * self.damage_without_wear

    def to_table(self) -> pyarrow.Table:
        """One row per bin: y_m, damage, damage_without_wear, depth_m, depth_without_wear_m, worn_m."""
        return pyarrow.table(
            {
                "y_m": self.grid.lateral,
                "damage": self.damage,
                "damage_without_wear": self.damage_without_wear,
                "depth_m": self.depth,
                "depth_without_wear_m": self.depth_without_wear,
                "worn_m": self.worn,
            }
        )


def remaining_share(surface: WheelSurface, failure_depth: float) -> NDArray[np.float64]:
    """(W, B) share of the cracks that remains by the geometric approach [-]; 0 where there are none.

    The whole life of the surface is one step: growth and wear at constant rates since it was new. Counts of
    the tread and of the flange lie in the same bin, and wear together.

    Parameters
    ----------
    surface
        Sums over a distance that was scaled to (`WheelSurface.scaled`); the share does not depend on it.
    failure_depth
        Depth of a crack at failure [m], > 0.

    Raises
    ------
    ValueError
        The failure depth is not above zero.
    """
    check_above_zero("failure_depth", failure_depth, "m", "a crack")
    grown = failure_depth * surface.crack_damage.sum(axis=1)
    left = np.maximum(grown - surface.depth, 0.0)
    return np.divide(left, grown, out=np.zeros_like(grown), where=grown > 0.0)


def counts_after_wear(
    surface: WheelSurface, approach: str, failure_depth: float | None = None
) -> NDArray[np.float64]:
    """(W, 2, B, X) RCF number after wear, by one of `APPROACHES` [-].

    By the geometric approach every count of a bin loses the same share: `remaining_share`.

    Parameters
    ----------
    surface
        Sums over a distance.
    approach
        ``"none"``: as counted; ``"burstow"``: corrected cell by cell; ``"geometric"``: layers worn off.
    failure_depth
        Depth of a crack at failure [m], for the geometric approach alone.

    Raises
    ------
    ValueError
        Another approach, or a failure depth that is missing, not above zero, or has no use.
    """
    if approach not in APPROACHES:
        raise ValueError(f"approach = {approach!r}, allowed are {', '.join(map(repr, APPROACHES))}")
    if approach == "geometric":
        if failure_depth is None:
            raise ValueError("approach = 'geometric' needs failure_depth: no value is published for wheels")
        return surface.rcf_number * remaining_share(surface, failure_depth)[:, None, :, None]
    if failure_depth is not None:
        raise ValueError(f"failure_depth = {failure_depth} m has no use with approach = {approach!r}")
    return surface.corrected_rcf_number if approach == "burstow" else surface.rcf_number


def _check_bins(name: str, values: FloatArray, grid: LateralGrid) -> None:
    if values.shape != (grid.count,):
        raise ValueError(f"{name} has shape {values.shape}, needed ({grid.count},): one value per bin")
    if not (np.isfinite(values).all() and (values >= 0.0).all()):
        raise ValueError(f"{name} must be finite and >= 0 in all bins")
