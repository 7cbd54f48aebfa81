"""Kalker's linear theory: creep forces of vanishing creepage, where the whole patch sticks.

J.J. Kalker, On the rolling contact of two elastic bodies in the presence of dry friction, thesis, Delft 1967;
equation 2.22 of Hossein-Nia (KTH, 2018), corrected. It has no friction limit: the forces grow without bound
with the creepages (it is the limit of infinite friction), and there is no stress field within the friction
limit.
"""

import math

from hh_exudyn.contact.tangential.kalker import coefficients
from hh_exudyn.contact.types import RollingPatch
from hh_exudyn.kernel import kernel


@kernel
def force(patch: RollingPatch) -> tuple[float, float, float]:
    """Creep forces and spin moment on the wheel.

    They are linear in the creepages, equation 2.22.

    Parameters
    ----------
    patch : RollingPatch
        Size, load, creepages and material.
    """
    a, b = patch.a, patch.b
    c11, c22, c23, c33 = coefficients(a / b, patch.poisson_ratio)
    size = math.sqrt(a * b)
    stiffness = patch.shear_modulus * a * b
    return (
        -c11 * stiffness * patch.nu_x,
        -c22 * stiffness * patch.nu_y - c23 * stiffness * size * patch.phi,
        c23 * stiffness * size * patch.nu_y - c33 * stiffness * a * b * patch.phi,
    )
