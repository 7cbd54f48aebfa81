"""ANALYN: a non-elliptic patch from Hertz's solution strip by strip (kernel).

M.Sh. Sichani, R. Enblom, M. Berg, A novel method to model wheel-rail normal contact in vehicle dynamics
simulation, Vehicle System Dynamics 52 (2014) 1752-1764.

Each strip takes from Hertz, for the approach delta and the curvatures A, B at its own lateral position, the
ellipse a_h, b_h and the pressure p_h. With alpha = delta/(A a_h^2) and beta = delta/(B b_h^2), which depend
on the ratio A/B alone, the strip is in contact where delta - beta g(y) > 0, and

    x_l(y)^2 = (delta - beta g)/(alpha A) = a_h^2 (1 - u)      u = g/(B b_h^2)                           (1)
    p(x, y)  = p_h sqrt(1 - u) sqrt(1 - (x/x_l)^2)                                                       (2)

where (2) is Hertz's pressure for the local penetration delta - beta g. A gap g = B y^2 gives Hertz's ellipse
and pressure exactly.
"""

import math

from hh_exudyn.contact.normal.hertz import normal_contact
from hh_exudyn.kernel import inlined_kernel


@inlined_kernel
def strip(
    gap: float,
    approach: float,
    curvature_x: float,
    curvature_y: float,
    shear_modulus: float,
    poisson_ratio: float,
) -> tuple[float, float, float]:
    """One strip (kernel: trusts its input).

    Parameters
    ----------
    gap, approach : float
        Gap g of the undeformed profiles at this strip, and the approach delta [m].
    curvature_x, curvature_y : float
        A and the local B: half the sums of the curvatures, > 0 [1/m].
    shear_modulus, poisson_ratio : float
        Of both bodies [Pa], [-].

    Returns
    -------
    tuple of float
        1 - u of equation 1, positive in contact [-]; half length [m] and pressure in the middle [Pa], zero
        outside.
    """
    _, a, b, pressure = normal_contact(approach, curvature_x, curvature_y, shear_modulus, poisson_ratio)
    inside = 1.0 - gap / (curvature_y * b * b)
    if not inside > 0.0:
        return inside, 0.0, 0.0
    root = math.sqrt(inside)
    return inside, a * root, pressure * root
