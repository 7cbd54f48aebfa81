"""Polach's formulas: creep forces in closed form, without a stress field; common in vehicle dynamics.

O. Polach, A fast wheel-rail forces calculation computer code, Vehicle System Dynamics 33 supplement (1999)
728-739; with reduced stiffness and falling friction: O. Polach, Creep forces in simulations of traction
vehicles running on adhesion limit, Wear 258 (2005) 992-1000.

The traction is assumed to grow linearly from the leading edge (gradient from Kalker's C11 and C22) up to an
ellipsoidal bound; its sum is a closed formula of one scaled creepage. Under longitudinal or lateral creepage
alone that is FASTSIM with the elliptic bound, summed in closed form (they agree to 1e-5). Spin acts through
the creepage at the patch's edge, nu_y + a phi, and through a lateral force of its own with a factor for a/b.
Known properties of the published formulas:

* the slopes at zero creepage are Kalker's for longitudinal creepage alone, lateral creepage with spin, and
  spin alone; longitudinal and lateral creepage together share one mean of C11 and C22, and longitudinal
  creepage weakens the lateral force of spin;
* there is no spin moment: M_z = 0.

The formulas were checked against two public implementations of the paper, which agree with Kalker's linear
theory only with the signs and the condition |nu_y + a phi| > |nu_y| used here (one of the two has the
condition, the other the sign, the wrong way round).
"""

import math
from dataclasses import dataclass

from hh_exudyn.contact.tangential.kalker import coefficients
from hh_exudyn.contact.types import RollingPatch
from hh_exudyn.kernel import kernel


@kernel
def force(patch: RollingPatch, k_adhesion: float, k_slip: float) -> tuple[float, float, float]:
    """Creep forces on the wheel, (F_x, F_y, 0); the factors as in `Contamination`.

    Parameters
    ----------
    patch : RollingPatch
        Size, load, creepages and material; the spin corrects the lateral creepage.
    k_adhesion, k_slip : float
        Reduction factors [-], see `Contamination`.
    """
    a, b, nu_x, nu_y = patch.a, patch.b, patch.nu_x, patch.nu_y
    spin = a * patch.phi
    at_edge = nu_y + spin if abs(nu_y + spin) > abs(nu_y) else nu_y  # lateral creepage corrected for spin
    total = math.hypot(nu_x, at_edge)
    if total == 0.0:
        return 0.0, 0.0, 0.0
    c11, c22, c23, _ = coefficients(a / b, patch.poisson_ratio)
    limit = patch.friction * patch.normal_force
    creepage = math.hypot(nu_x, nu_y)
    along, across = 0.0, 0.0
    if creepage > 0.0:
        stiffness = math.hypot(c11 * nu_x, c22 * nu_y) / creepage
        # gradient of the traction over the gradient of its bound
        scaled = 0.25 * math.pi * patch.shear_modulus * a * b * stiffness * total / limit
        stick = k_adhesion * scaled
        shape = 2.0 / math.pi * (stick / (1.0 + stick * stick) + math.atan(k_slip * scaled))
        along, across = -limit * shape * nu_x / total, -limit * shape * nu_y / total
    widening = 1.0 + 6.3 * (1.0 - math.exp(-a / b))  # of the spin force, for patches of finite length
    scaled = 8.0 / 3.0 * patch.shear_modulus * b * math.sqrt(a * b) * c23 * abs(at_edge) / (limit * widening)
    square = scaled * scaled
    delta = (square - 1.0) / (square + 1.0)
    # (1 - delta^2)^(3/2)/3 - scaled (delta^3/3 - delta^2/2 + 1/6), without the differences of nearly equal
    # numbers: 1 - delta = 2/(square + 1), 1/6 - delta^2/2 + delta^3/3 = (1 - delta)^2 (1 + 2 delta)/6
    gap = 2.0 / (square + 1.0)
    shape = ((scaled * gap) ** 3) / 3.0 - scaled * gap * gap * (1.0 + 2.0 * delta) / 6.0
    across -= 9.0 / 16.0 * limit * shape * widening * spin / total
    return along, across, 0.0


@dataclass(frozen=True)
class Contamination:
    """The parameters of Polach (2005) for a contaminated or strongly slipping contact.

    Attributes
    ----------
    k_adhesion, k_slip : float
        Reduction factors k_A and k_S of the stiffness in the area of adhesion and of slip [-],
        0 < k_slip <= k_adhesion <= 1; 1 is a clean surface.
    friction_ratio : float
        Friction coefficient at infinite slip velocity over that at rest, A of the paper [-], 0..1.
    friction_decrease : float
        Coefficient B of the exponential decrease of friction over the slip velocity [s/m], >= 0.

    Raises
    ------
    ValueError
        A parameter out of its range.
    """

    k_adhesion: float = 1.0
    k_slip: float = 1.0
    friction_ratio: float = 1.0
    friction_decrease: float = 0.0

    def __post_init__(self) -> None:
        if not 0.0 < self.k_slip <= self.k_adhesion <= 1.0:
            raise ValueError(
                f"k_slip = {self.k_slip}, k_adhesion = {self.k_adhesion} [-]; "
                "0 < k_slip <= k_adhesion <= 1 is needed"
            )
        if not 0.0 <= self.friction_ratio <= 1.0:
            raise ValueError(f"friction_ratio = {self.friction_ratio} [-]; it must lie in 0..1")
        _check_not_negative("friction_decrease", self.friction_decrease, "s/m")


def polach_force(patch: RollingPatch, surface: Contamination, speed: float = 0.0) -> tuple[float, float]:
    """Creep forces of a contaminated or strongly slipping contact (Polach 2005).

    Parameters
    ----------
    patch : RollingPatch
        Its `friction` is the coefficient at rest, > 0; semi-axes and normal force > 0.
    surface : Contamination
        Parameters of the surface.
    speed : float
        Speed V [m/s], >= 0; creepage times V is the slip velocity.

    Returns
    -------
    tuple of float
        F_x, F_y on the wheel [N].

    Raises
    ------
    ValueError
        If an argument is out of range.
    """
    for name, unit in (("a", "m"), ("b", "m"), ("normal_force", "N"), ("friction", "-")):
        value = getattr(patch, name)
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f"{name} = {value} {unit}; it must be finite and > 0 {unit}")
    for name, unit in (("nu_x", "[-]"), ("nu_y", "[-]"), ("phi", "1/m")):
        value = getattr(patch, name)
        if not math.isfinite(value):
            raise ValueError(f"{name} = {value} {unit}; it must be finite")
    _check_not_negative("speed", speed, "m/s")
    slip_velocity = math.hypot(patch.nu_x, patch.nu_y) * speed
    ratio = surface.friction_ratio
    falling = (1.0 - ratio) * math.exp(-surface.friction_decrease * slip_velocity) + ratio
    reduced = RollingPatch._make(float(value) for value in patch._replace(friction=patch.friction * falling))
    force_x, force_y, _ = force(reduced, float(surface.k_adhesion), float(surface.k_slip))
    return float(force_x), float(force_y)


def _check_not_negative(name: str, value: float, unit: str) -> None:
    """Raise ValueError for a number that is negative, infinite or NaN."""
    if not (math.isfinite(value) and value >= 0.0):
        raise ValueError(f"{name} = {value} {unit}; it must be finite and >= 0 {unit}")
