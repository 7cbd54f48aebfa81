"""Which rails are summed, and how: stretches of track with their bins, steel, thresholds."""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from damage.material import WheelMaterial
from damage.rails.steel import R260, rail_law
from damage.rcf.whole_life_rail import BURSTOW_RAIL, DamageFunction
from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.wear.law import WearLaw
from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.conventions import LEFT

WHOLE_PATCH = PatchGrid(-0.020, 0.040, 1)
"""One bin along the patch: a place of the rail passes through all of it."""


@dataclass(frozen=True)
class RailStretch:
    """A stretch of track whose rails are summed by themselves.

    Attributes
    ----------
    start, end
        Arc lengths of the track [m]; a wheel counts while its wheelset is between them, the end excluded.
    left, right
        Bins across each rail.
    """

    start: float
    end: float
    left: LateralGrid = field(default_factory=LateralGrid)
    right: LateralGrid = field(default_factory=LateralGrid)

    def __post_init__(self) -> None:
        if not self.start < self.end:
            raise ValueError(
                f"stretch of rail: start = {self.start:g} m must lie before end = {self.end:g} m"
            )

    @classmethod
    def of(cls, start: float, end: float, left: Profile, right: Profile) -> "RailStretch":
        """A stretch with bins along the arcs of its rails' profiles."""
        return cls(start, end, LateralGrid.along(left), LateralGrid.along(right))

    def grid(self, side: int) -> LateralGrid:
        """Bins of a rail, +1 left, -1 right."""
        return self.left if side == LEFT else self.right


@dataclass(frozen=True)
class RailModel:
    """What is summed of the rails.

    Attributes
    ----------
    stretches
        In the order of the track; none overlaps another.
    material
        Steel of the rails.
    law
        Wear law of the rails; None takes that of the wheels on the rails' steel
        (`damage.rails.steel.rail_law`).
    whole_life
        Damage function over the wear number, per passing of a wheel. Burstow's was fitted on R220 in
        Britain; for no other steel are turning points known here. The direction of the traction does not
        count, nor what the vehicle's other wheels do at the same place.

    Raises
    ------
    ValueError
        No stretch, or stretches that overlap or are not in order.
    """

    stretches: tuple[RailStretch, ...]
    material: WheelMaterial = R260
    law: WearLaw | None = None
    whole_life: DamageFunction = BURSTOW_RAIL

    def __post_init__(self) -> None:
        if not self.stretches:
            raise ValueError("stretches of rail: there is none, at least one is needed")
        last = -math.inf
        for stretch in self.stretches:
            if stretch.start < last:
                raise ValueError(
                    f"stretch of rail from {stretch.start:g} m begins before the one before it ends, at "
                    f"{last:g} m"
                )
            last = stretch.end

    def with_law(self, law: WearLaw, wheel: WheelMaterial) -> "RailModel":
        """The model with its own wear law, or that of the wheels (before it has taken their hardness)."""
        if self.law is None:
            return replace(self, law=rail_law(law, wheel, self.material))
        return replace(self, law=self.law.on(self.material.hardness))

    @property
    def wear(self) -> WearLaw:
        """The wear law of the rails. Raises ValueError where that of the wheels was not given yet."""
        if self.law is None:
            raise ValueError("the wear law of the rails follows from that of the wheels: see `with_law`")
        return self.law

    def stretch_of(self, s: FloatArray) -> IntArray:
        """(n,) number of the stretch at arc lengths s [m], -1 where there is none."""
        starts = np.array([stretch.start for stretch in self.stretches])
        ends = np.array([stretch.end for stretch in self.stretches])
        found = np.searchsorted(starts, s, side="right") - 1
        inside = (found >= 0) & (s < ends[found])
        return np.where(inside, found, -1).astype(np.int64)
