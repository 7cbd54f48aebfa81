"""Kalker's linear theory: creep forces of vanishing creepage, where the whole patch sticks.

J.J. Kalker, On the rolling contact of two elastic bodies in the presence of dry friction, thesis, Delft 1967;
equation 2.22 of Hossein-Nia (KTH, 2018), corrected. It knows no friction limit: the forces grow without bound
with the creepages (it is the limit of infinite friction), and the theory gives no stress field that friction
could carry.
"""

import math

from hh_exudyn.contact.kalker import coefficients
from hh_exudyn.kernel import kernel


@kernel
def force(
    a: float,
    b: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    shear_modulus: float,
    poisson_ratio: float,
) -> tuple[float, float, float]:
    """Creep forces and spin moment on the wheel, equation 2.22; arguments as `tangential.force_kernel`."""
    c11, c22, c23, c33 = coefficients(a / b, poisson_ratio)
    size = math.sqrt(a * b)
    stiffness = shear_modulus * a * b
    return (
        -c11 * stiffness * nu_x,
        -c22 * stiffness * nu_y - c23 * stiffness * size * phi,
        c23 * stiffness * size * nu_y - c33 * stiffness * a * b * phi,
    )
