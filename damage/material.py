"""Wheel steels: the strength that damage is measured against, and the elastic constants.

EN 13262 demands a least yield strength of 520 MPa (ER7), 540 MPa (ER8) and 580 MPa (ER9); the numbers are
from memory of the standard [M] and agree with Hossein-Nia (2018), p. 72. Tensile strengths are the middles of
its ranges 820 to 940, 860 to 980 and 900 to 1050 MPa [M].
"""

import math
from dataclasses import dataclass

from hh_exudyn.contact.material import STEEL, Material


@dataclass(frozen=True)
class WheelMaterial:
    """A wheel steel.

    Attributes
    ----------
    name
        Name of the grade.
    yield_strength
        Tensile yield strength [Pa], > 0.
    elastic
        Elastic constants of wheel and rail.
    tensile_strength
        Ultimate tensile strength [Pa], at least the yield strength; None where it is not known: Burstow's
        correction of the RCF number needs it.
    """

    name: str
    yield_strength: float
    elastic: Material = STEEL
    tensile_strength: float | None = None

    def __post_init__(self) -> None:
        if not (math.isfinite(self.yield_strength) and self.yield_strength > 0.0):
            raise ValueError(f"yield_strength = {self.yield_strength} Pa must be finite and > 0 Pa")

    @property
    def shear_yield(self) -> float:
        """Yield strength in pure shear k = yield strength / sqrt 3 [Pa], by von Mises.

        ER7 has 300 MPa: the value that reproduces Table 3-2 of Hossein-Nia (2018). Tresca's criterion
        (equation 3.1 there) would give 260 MPa, see `shear_yield_tresca`.
        """
        return self.yield_strength / math.sqrt(3.0)

    @property
    def shear_yield_tresca(self) -> float:
        """Yield strength in pure shear k = yield strength / 2 [Pa], by Tresca."""
        return 0.5 * self.yield_strength


ER7 = WheelMaterial("ER7", 520e6, tensile_strength=880e6)
ER8 = WheelMaterial("ER8", 540e6, tensile_strength=920e6)
ER9 = WheelMaterial("ER9", 580e6, tensile_strength=975e6)
