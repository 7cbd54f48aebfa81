"""Wear ratio: the depth of a detailed law over the dissipated energy, per lateral position of the wheel.

S. Hossein-Nia, paper E, and figure 3-26 of the thesis (KTH 2018): the ratio is learnt from the first wear
steps, which are computed in full (Archard's law after Jendel); in later steps the dissipated energy of the
simulation is multiplied by it, without solving the patches. There the error was 10 to
60 % of the worn volume, most of it on the flange where lubrication changes: `error` compares with a full
step.

Reason: in the cells that slip |q| = mu p, so with elastic slip and within one region of the
wear map the ratio is k/(H mu) exactly, for any load and creepages. It holds for the friction, the
region and the lubrication that it was learnt in: from friction mu_1 to mu_2 the volume is off by
mu_2/mu_1 - 1. Energy over friction in place of the energy removes that part.

Depth and energy lie on the same lateral grid, in any unit that stays the same: metres and joules per bin, or
depth per km and N.
"""

from dataclasses import dataclass

import numpy as np
import pyarrow
from numpy.typing import ArrayLike

from hh_exudyn.arrays import FloatArray


@dataclass(frozen=True)
class RatioError:
    """Error of a depth by the wear ratio against that of a full step.

    Attributes
    ----------
    volume
        Worn volume too much (+) or too little (-), over that of the full step [-].
    misplaced
        Half the sum of the depths' differences after scaling to the same volume, over the full step's [-]:
        the share of the volume that lies in the wrong place.
    unlearnt
        Share of the energy at positions without a learnt ratio [-].
    """

    volume: float
    misplaced: float
    unlearnt: float


@dataclass(frozen=True)
class WearRatio:
    """Depth over energy on a lateral grid of B bins, from the sums over the steps that were learnt.

    The ratio of the sums, not the mean of the ratios: so the learnt steps together keep their volume at every
    position. Ratios of several wheels or parts of a collective add.

    Attributes
    ----------
    depth
        (B,) sum of the depths of the full steps, >= 0.
    energy
        (B,) sum of the energies dissipated in them, >= 0.

    Raises
    ------
    ValueError
        Shapes differ, values are negative or not finite, or no energy at all.
    """

    depth: FloatArray
    energy: FloatArray

    def __post_init__(self) -> None:
        if self.depth.ndim != 1 or self.depth.shape != self.energy.shape:
            raise ValueError(
                f"depth {self.depth.shape} and energy {self.energy.shape} must be (B,) on one lateral grid"
            )
        for name, values in (("depth", self.depth), ("energy", self.energy)):
            if not np.all(np.isfinite(values) & (values >= 0.0)):
                raise ValueError(f"{name} of the wear ratio must be finite and >= 0 at every position")
        if not self.energy.any():
            raise ValueError("nothing to learn a wear ratio from: no energy was dissipated")

    @classmethod
    def learn(cls, depth: ArrayLike, energy: ArrayLike) -> "WearRatio":
        """From full steps: depth and energy (..., B), summed over all but the positions.

        Parameters
        ----------
        depth, energy
            (..., B) depths and dissipated energies of the full steps, >= 0.
        """
        depths, energies = np.asarray(depth, dtype=np.float64), np.asarray(energy, dtype=np.float64)
        if depths.ndim == 0 or depths.shape != energies.shape:
            raise ValueError(f"depth {depths.shape} and energy {energies.shape} must have one shape (..., B)")
        bins = depths.shape[-1]
        return cls(depths.reshape(-1, bins).sum(axis=0), energies.reshape(-1, bins).sum(axis=0))

    def __add__(self, other: "WearRatio") -> "WearRatio":
        """Sums over the steps of both; ValueError on grids of different size."""
        if self.depth.shape != other.depth.shape:
            raise ValueError(
                f"wear ratios on {self.depth.size} and {other.depth.size} positions cannot be added"
            )
        return WearRatio(self.depth + other.depth, self.energy + other.energy)

    @property
    def mean(self) -> float:
        """Depth over energy of all positions together."""
        return float(self.depth.sum() / self.energy.sum())

    @property
    def ratio(self) -> FloatArray:
        """(B,) depth over energy; NaN at positions without energy in the learnt steps."""
        ratio: FloatArray = np.full_like(self.depth, np.nan)
        return np.divide(self.depth, self.energy, out=ratio, where=self.energy > 0.0)

    def apply(self, energy: ArrayLike) -> FloatArray:
        """Depth (..., B) of the energy of a later step; the `mean` ratio at positions without a learnt one.

        Raises
        ------
        ValueError
            Another number of positions, or an energy that is negative or not finite.
        """
        energies = self._checked("energy", energy)
        depth: FloatArray = np.where(self.energy > 0.0, self.ratio, self.mean) * energies
        return depth

    def error(self, energy: ArrayLike, depth: ArrayLike) -> RatioError:
        """Compare with a full step: energy and depth (..., B), any part of the profile set to 0 in both.

        Parameters
        ----------
        energy, depth
            (..., B) of the full step, >= 0.

        Raises
        ------
        ValueError
            As `apply`, or a full step that wears nothing.
        """
        full, energies = self._checked("depth", depth), self._checked("energy", energy)
        worn = float(full.sum())
        if worn <= 0.0 or energies.shape != full.shape:
            raise ValueError(
                f"a full step to compare with needs wear (sum of depths {worn}) and one shape: energy "
                f"{energies.shape}, depth {full.shape}"
            )
        by_ratio = self.apply(energies)
        given = float(by_ratio.sum())
        misplaced = np.abs(by_ratio / given - full / worn).sum() / 2.0 if given > 0.0 else 1.0
        unlearnt = energies[..., self.energy <= 0.0].sum() / energies.sum() if energies.any() else 0.0
        return RatioError(given / worn - 1.0, float(misplaced), float(unlearnt))

    def to_table(self) -> pyarrow.Table:
        """One row per position: depth, energy, ratio."""
        return pyarrow.table({"depth": self.depth, "energy": self.energy, "ratio": self.ratio})

    def _checked(self, name: str, given: ArrayLike) -> FloatArray:
        values = np.asarray(given, dtype=np.float64)
        if values.ndim == 0 or values.shape[-1] != self.depth.size:
            raise ValueError(f"{name} {values.shape} must end in the ratio's {self.depth.size} positions")
        if not np.all(np.isfinite(values) & (values >= 0.0)):
            raise ValueError(f"{name} must be finite and >= 0 at every position")
        return values
