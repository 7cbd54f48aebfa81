"""From index to crack: cycles to failure, Miner's sum over the wheel profile, length and depth of cracks.

Two relations between an index and the cycles to failure, both a power Nf = coefficient index^exponent:

`KABO`   FI = 1.78 Nf^-0.25 from roller rigs, twin discs and linear rigs (Kabo et al. 2009; Hossein-Nia
         2018, 3.18), so D = 1/Nf = (FI/1.78)^4 = FI^4/10.04 a revolution, which equations 3.19 and 3.20
         round to FI^4/10.
`DIRKS`  Nf = 9.6e5 sigma^-1.06 with sigma in MPa (3.24), here the stress index. Its numbers were fitted to
         cracks of RAILS (five years in a curve of the Dutch railways), and Dirks fitted one of them anew for
         wheels. On wheels it ranks places; for lives it must be fitted (`fitted_relation`). The numbers hold
         for this index; for the energy index (3.34) others are needed.

Damage adds up by Miner's rule, lateral position by lateral position, and is 1 at failure. An index of zero or
below does no damage.
"""

import math
from dataclasses import dataclass

import numpy as np
import pyarrow
from numpy.typing import ArrayLike

from damage.bounds import check_above_zero, check_not_below_zero
from damage.rcf.local import LocalFatigue
from damage.rcf.miner import KABO_FACTOR
from damage.surface.lateral_grid import LateralGrid, spread
from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import kernel

_UNITS = {"fatigue_index": "-", "stress_index": "Pa"}  # of the indices that a relation may take


@dataclass(frozen=True)
class LifeRelation:
    """Relation between a fatigue index and life.

    Cycles to failure Nf = coefficient (index/unit)^exponent.

    Attributes
    ----------
    name
        Name of the relation.
    index
        Its index: "fatigue_index" (FI [-]) or "stress_index" (SI [Pa]), as in `LocalFatigue`.
    unit
        Unit of the index that the coefficient is for: 1 for FI, 1e6 Pa for SI in MPa.
    coefficient
        Cycles at index = unit [-], > 0.
    exponent
        [-], < 0.
    calibrated_for
        Bodies of the measurements.
    source
        Publication of the numbers.

    Raises
    ------
    ValueError
        Another index, or a number out of its range.
    """

    name: str
    index: str
    unit: float
    coefficient: float
    exponent: float
    calibrated_for: str
    source: str

    def __post_init__(self) -> None:
        if self.index not in _UNITS:
            allowed = " and ".join(map(repr, _UNITS))
            raise ValueError(f"index = {self.index!r} of {self.name}; allowed are {allowed}")
        check_above_zero("unit", self.unit, _UNITS[self.index], self.name)
        check_above_zero("coefficient", self.coefficient, "-", self.name)
        if not (math.isfinite(self.exponent) and self.exponent < 0.0):
            raise ValueError(f"exponent = {self.exponent} of {self.name} must be finite and < 0")

    def damage(self, index: ArrayLike) -> FloatArray:
        """Damage per revolution D = 1/Nf [-]; 0 where the index is not above zero, NaN for NaN."""
        value = np.asarray(index, dtype=np.float64)
        positive = np.where(value > 0.0, value / self.unit, 1.0)
        damage = np.where(value > 0.0, positive**-self.exponent / self.coefficient, 0.0)
        return np.where(np.isnan(value), np.nan, damage)

    def cycles(self, index: ArrayLike) -> FloatArray:
        """Cycles to failure Nf [-]; infinite where the index is not above zero."""
        with np.errstate(divide="ignore"):
            cycles: FloatArray = 1.0 / self.damage(index)
        return cycles


KABO = LifeRelation(
    "Kabo",
    "fatigue_index",
    1.0,
    KABO_FACTOR**4,
    -4.0,
    "specimens on roller, twin-disc and linear rigs",
    "Kabo et al. (2009), in Hossein-Nia (2018), equation 3.18",
)
DIRKS = LifeRelation(
    "Dirks",
    "stress_index",
    1e6,
    9.6e5,
    -1.06,
    "rails",
    "Dirks (2015), in Hossein-Nia (2018), equation 3.24",
)


def fitted_relation(
    name: str,
    index: str,
    unit: float,
    measured: ArrayLike,
    cycles: ArrayLike,
    calibrated_for: str,
    source: str,
) -> LifeRelation:
    """A life relation fitted to measurements, by least squares of log Nf over log index.

    Parameters
    ----------
    name, index, unit, calibrated_for, source
        As in `LifeRelation`.
    measured
        (n,) index at the measured places, > 0.
    cycles
        (n,) their cycles to failure, > 0.

    Raises
    ------
    ValueError
        Fewer than two different indices, values not above zero, or lives that grow with the index.
    """
    x, y = np.asarray(measured, np.float64).ravel(), np.asarray(cycles, np.float64).ravel()
    if x.size != y.size or np.unique(x).size < 2:
        raise ValueError(
            f"{x.size} indices and {y.size} lives; needed are as many of both, 2 or more different"
        )
    if not (np.all(x > 0.0) and np.all(y > 0.0) and np.all(np.isfinite(x + y))):
        raise ValueError("indices and cycles must be finite and > 0")
    exponent, level = np.polyfit(np.log(x / unit), np.log(y), 1)
    return LifeRelation(name, index, unit, float(np.exp(level)), float(exponent), calibrated_for, source)


@dataclass(frozen=True)
class MinerSum:
    """Miner's sum over the profile of one wheel; additive over logs.

    Attributes
    ----------
    grid
        The bins.
    damage
        (B,) sum of D over the revolutions, failure at 1 [-].
    revolutions
        Revolutions of the wheel that were summed [-].
    """

    grid: LateralGrid
    damage: FloatArray
    revolutions: float

    def __add__(self, other: "MinerSum") -> "MinerSum":
        """The sum of two pieces of the wheel's life.

        Raises
        ------
        ValueError
            Different grids.
        """
        if self.grid != other.grid:
            raise ValueError("sums on different grids cannot be added")
        return MinerSum(self.grid, self.damage + other.damage, self.revolutions + other.revolutions)

    @property
    def revolutions_to_failure(self) -> FloatArray:
        """(B,) revolutions at which the sum reaches 1 at the same rate of damage [-]."""
        with np.errstate(divide="ignore"):
            life: FloatArray = self.revolutions / self.damage
        return life if self.revolutions > 0.0 else np.full(self.damage.size, np.inf)

    def to_table(self) -> pyarrow.Table:
        """One row per bin: y_m (its middle), damage, revolutions_to_failure."""
        return pyarrow.table(
            {
                "y_m": self.grid.centres,
                "damage": self.damage,
                "revolutions_to_failure": self.revolutions_to_failure,
            }
        )


def miner_sum(
    local: LocalFatigue,
    position: ArrayLike,
    side: ArrayLike,
    stretch: ArrayLike,
    revolutions: ArrayLike,
    wheel_revolutions: float,
    relation: LifeRelation = KABO,
    grid: LateralGrid = LateralGrid(),  # noqa: B008 (frozen)
) -> MinerSum:
    """Miner's sum of contact states over the profile of one wheel, strip by strip (3.20).

    Parameters
    ----------
    local
        Largest indices of the strips of n states of that wheel.
    position
        (n,) or scalar, as those that follow: place of the contact in the grid's coordinate (y_wheel) [m].
    side
        +1 left wheel, -1 right wheel.
    stretch
        Length on the grid over length across the patch: cos(contact angle) in the lateral coordinate [-].
    revolutions
        Revolutions in the interval of each state, V dt / (2 pi r) [-], >= 0.
    wheel_revolutions
        Revolutions of the wheel in all (states of patches side by side share theirs) [-], >= 0.
    relation
        From index to damage.
    grid
        Bins over the profile.

    Raises
    ------
    ValueError
        Values out of their ranges, or strips beyond the grid.
    """
    count = local.width.size
    place, hand, cosine, turns = (
        np.broadcast_to(np.asarray(value, np.float64), count)
        for value in (position, side, stretch, revolutions)
    )
    if not np.all((turns >= 0.0) & np.isfinite(turns)):
        raise ValueError("revolutions must be finite and >= 0")
    check_not_below_zero("wheel_revolutions", wheel_revolutions, "-")
    if not np.all((cosine > 0.0) & (cosine <= 1.0)):
        raise ValueError("stretch must lie in 0..1, zero excluded")
    if not np.all(np.abs(hand) == 1.0):
        raise ValueError("side must be +1 (left) or -1 (right)")
    centres = place[:, None] - (hand * cosine)[:, None] * local.y
    widths = local.width * cosine
    reach = centres - 0.5 * widths[:, None], centres + 0.5 * widths[:, None]
    if reach[0].min(initial=math.inf) < grid.edges[0] or reach[1].max(initial=-math.inf) > grid.edges[-1]:
        raise ValueError(
            f"strips from {reach[0].min() * 1e3:.2f} to {reach[1].max() * 1e3:.2f} mm lie beyond the grid, "
            f"{grid.edges[0] * 1e3:.0f} to {grid.edges[-1] * 1e3:.0f} mm"
        )
    damage = relation.damage(getattr(local, relation.index)) * turns[:, None]
    bins = np.zeros(grid.count)
    _spread_strips(centres, widths, damage, grid.start, grid.step, bins)
    return MinerSum(grid, bins, float(wheel_revolutions))


@kernel
def _spread_strips(
    centres: FloatArray, widths: FloatArray, values: FloatArray, start: float, step: float, bins: FloatArray
) -> None:
    """`spread` for the strips (n, strips) of all states."""
    for row in range(centres.shape[0]):
        for strip in range(centres.shape[1]):
            if values[row, strip] > 0.0:
                spread(centres[row, strip], widths[row], values[row, strip], start, step, bins)


@dataclass(frozen=True)
class CrackShape:
    """Size of a crack over its damage (3.22; Ekberg): proportional to it, of one shape.

    rho = rho_f D/D_f,  L = 2 rho/r,  h = L sin(theta). There are no published numbers for wheels, so there
    are no defaults: take them from cracks of the wheels at hand (`from_crack`).

    Attributes
    ----------
    failure_surface_length
        Mouth rho_f of a crack at failure [m].
    failure_damage
        Damage D_f at failure [-]; 1 by Miner.
    mouth_ratio
        r = 2 rho/L [-].
    angle
        Angle theta between crack and surface [rad], above 0 to pi/2.

    Raises
    ------
    ValueError
        A value out of its range.
    """

    failure_surface_length: float
    failure_damage: float
    mouth_ratio: float
    angle: float

    def __post_init__(self) -> None:
        for name, unit in (("failure_surface_length", "m"), ("failure_damage", "-"), ("mouth_ratio", "-")):
            check_above_zero(name, getattr(self, name), unit, "the crack")
        if not 0.0 < self.angle <= 0.5 * math.pi:
            raise ValueError(f"angle = {self.angle} rad of the crack must lie in 0..pi/2 rad, zero excluded")

    @classmethod
    def from_crack(cls, surface_length: float, length: float, depth: float, damage: float) -> "CrackShape":
        """The shape of a measured crack (mouth, length and depth [m]) at its computed damage [-].

        Parameters
        ----------
        surface_length
            Mouth of the crack [m].
        length, depth
            Along the crack and normal to the surface [m].
        damage
            Miner's sum at the place of the crack [-].

        Raises
        ------
        ValueError
            A value not above zero, or a depth beyond the length.
        """
        if not (length > 0.0 and 0.0 < depth <= length):
            raise ValueError(
                f"length = {length} m, depth = {depth} m of a crack; 0 < depth <= length is needed"
            )
        return cls(surface_length, damage, 2.0 * surface_length / length, math.asin(depth / length))

    def surface_length(self, damage: ArrayLike) -> FloatArray:
        """Mouth rho of the crack [m]."""
        length: FloatArray = (
            self.failure_surface_length * np.asarray(damage, np.float64) / self.failure_damage
        )
        return length

    def length(self, damage: ArrayLike) -> FloatArray:
        """Length L = 2 rho/r along the crack [m]."""
        length: FloatArray = 2.0 * self.surface_length(damage) / self.mouth_ratio
        return length

    def depth(self, damage: ArrayLike) -> FloatArray:
        """Depth h = L sin(theta) [m]."""
        depth: FloatArray = self.length(damage) * math.sin(self.angle)  # (3.22)
        return depth

    def to_table(self, miner: MinerSum) -> pyarrow.Table:
        """Cracks over a wheel profile: y_m, damage, surface_length_m, length_m, depth_m, a row per bin."""
        return pyarrow.table(
            {
                "y_m": miner.grid.centres,
                "damage": miner.damage,
                "surface_length_m": self.surface_length(miner.damage),
                "length_m": self.length(miner.damage),
                "depth_m": self.depth(miner.damage),
            }
        )
