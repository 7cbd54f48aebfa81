"""The elastic material of wheel and rail: equal, isotropic and linear in both bodies."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Material:
    """Elastic constants shared by wheel and rail.

    Equal bodies are quasi-identical: normal and tangential contact do not couple (Kalker, 1990, section 1.4).

    Parameters
    ----------
    shear_modulus : float
        Shear modulus G [Pa], > 0.
    poisson_ratio : float
        Poisson's ratio [-], 0..0.5.

    Raises
    ------
    ValueError
        If a constant lies outside its range or is not finite.
    """

    shear_modulus: float
    poisson_ratio: float

    def __post_init__(self) -> None:
        if not (math.isfinite(self.shear_modulus) and self.shear_modulus > 0.0):
            raise ValueError(f"shear_modulus = {self.shear_modulus} Pa; it must be finite and > 0 Pa")
        if not 0.0 <= self.poisson_ratio <= 0.5:
            raise ValueError(f"poisson_ratio = {self.poisson_ratio} [-]; it must lie in 0..0.5")

    @property
    def young_modulus(self) -> float:
        """Young's modulus E = 2 G (1 + nu) [Pa]."""
        return 2.0 * self.shear_modulus * (1.0 + self.poisson_ratio)


STEEL = Material(shear_modulus=82e9, poisson_ratio=0.28)  # the steel of the Manchester contact benchmark
