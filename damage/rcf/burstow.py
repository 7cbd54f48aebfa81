"""Burstow's correction: the share of the counted fatigue that remains where wear removes the cracks.

M.C. Burstow, Whole life rail model application and development for RSSB, AEA Technology 2004 (as in
Hossein-Nia 2018, equations 3.33 and 3.34 with the text around figures 3-27 to 3-29). Energy per distance that
a patch of area A loses at the creepages of 0.1, 0.3 and 1 %, sliding at the mean of yield and tensile
strength in shear, bounds the regimes:

    E_i = nu_i A (yield strength + tensile strength) / (2 sqrt 3)                                       (3.33)

In a cell the energy of equation 3.34 is compared with E_i / A: up to E_1 the count is unchanged, from E_1 to
E_2 it falls linearly to zero, beyond E_2 it is zero. Only cells that slip are corrected, as
cells that stick do not wear. If the patch as a whole loses more than the global E_2, none of its cells count.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

from damage.bounds import check_above_zero
from damage.material import WheelMaterial
from hh_exudyn.kernel import inlined_kernel

CREEPAGES = (0.001, 0.003, 0.01)
"""Creepages of the turning points [-]: Hossein-Nia (2018), with equation 3.33."""

PATCH_AREA = 100e-6
"""Area of a patch for the global threshold [m^2]: assumed; with ER7 the thresholds are 40, 121 and 404 N."""


class BurstowLimits(NamedTuple):
    """Thresholds, for the kernels."""

    high: float  # E_2 / A [Pa = J/m per m^2]
    per_range: float  # 1 / (E_2 - E_1) times A [1/Pa]
    total: float  # global E_2 [N = J/m]


@dataclass(frozen=True)
class Burstow:
    """Thresholds of Burstow's correction for a steel.

    Attributes
    ----------
    yield_strength, tensile_strength
        Of the wheel [Pa].
    creepages
        Of the three turning points, rising [-].
    area
        Area of the patch of the global threshold [m^2].

    Raises
    ------
    ValueError
        A value is not above zero, the strengths are in the wrong order, or the creepages do not rise.
    """

    yield_strength: float
    tensile_strength: float
    creepages: tuple[float, float, float] = CREEPAGES
    area: float = PATCH_AREA

    def __post_init__(self) -> None:
        for name, unit in (("yield_strength", "Pa"), ("tensile_strength", "Pa"), ("area", "m^2")):
            check_above_zero(name, getattr(self, name), unit, "Burstow's limits")
        if self.tensile_strength < self.yield_strength:
            raise ValueError(
                f"tensile_strength = {self.tensile_strength} Pa must be at least the yield strength, "
                f"{self.yield_strength} Pa"
            )
        if not 0.0 < self.creepages[0] < self.creepages[1] < self.creepages[2]:
            raise ValueError(f"creepages = {self.creepages} [-] must rise from above 0")

    @classmethod
    def of(cls, material: WheelMaterial) -> "Burstow":
        """The thresholds of a steel.

        Raises
        ------
        ValueError
            The steel lacks its yield strength or its tensile strength.
        """
        model = "Burstow's correction of the RCF number"
        return cls(material.require("yield_strength", model), material.require("tensile_strength", model))

    @property
    def energies(self) -> tuple[float, float, float]:
        """E_1, E_2, E_3 of the patch [N = J/m]."""
        first, second, third = (value * self.area for value in self.densities)
        return first, second, third

    @property
    def densities(self) -> tuple[float, float, float]:
        """E_1, E_2, E_3 per area [Pa]."""
        strength = (self.yield_strength + self.tensile_strength) / (2.0 * math.sqrt(3.0))
        first, second, third = (creepage * strength for creepage in self.creepages)  # (3.33)
        return first, second, third

    @property
    def values(self) -> BurstowLimits:
        """The thresholds for the kernels."""
        low, high, _ = self.densities
        return BurstowLimits(high, 1.0 / (high - low), self.energies[1])


@inlined_kernel
def remaining(energy: float, limits: BurstowLimits) -> float:
    """Remaining share 0..1 of a count in a cell that slips (kernel).

    Parameters
    ----------
    energy
        Energy lost per distance rolled and area in the cell, equation 3.34 [Pa].
    limits
        The thresholds.
    """
    return min(max((limits.high - energy) * limits.per_range, 0.0), 1.0)
