"""Kik and Piotrowski: a non-elliptic patch from the virtual interpenetration, with KPEC's factor (kernels).

W. Kik, J. Piotrowski, A fast, approximate method to calculate normal load at contact between wheel and rail
and creep forces during rolling, 2nd Mini Conference on Contact Mechanics and Wear of Rail/Wheel Systems,
Budapest 1996. B. Liu, S. Bruni, Analysis of wheel-roller contact and comparison with the wheel-rail case,
Vehicle System Dynamics 53 (2015): KPEC, where the factor eps varies across the patch.

The patch is where the profiles, pressed into each other by eps delta, overlap. With the gap g(y) and Hertz's
semi-axes a, b for the curvatures A, B at the point of deepest interpenetration, y_m = 0,

    eps(y) delta = A a^2 - (A a^2 - B b^2) (y/b)^2                                                       (1)
    x_l(y)^2 = (eps(y) delta - g(y))/A                                                                   (2)
    p(x, y) = c sqrt(x_l(y)^2 - x^2)                                                                     (3)

and c makes the displacement of the half-spaces at the deepest point equal to the approach:

    delta = (1 - nu)/(pi G) * integral of p / r                                                          (4)

A gap g = B y^2 gives Hertz's ellipse, pressure and force. Beyond |y| = b, where the profiles are flatter than
at the deepest point, eps has its value at b. The constant eps = 0.55 of 1996 gives an ellipse of other
shape, see the notes of `tests/contact/normal/test_kik_piotrowski.py` for the cost of that.
"""

import math

from hh_exudyn.kernel import inlined_kernel, kernel

# K(m) and E(m) by polynomials of m1 = 1 - m: Abramowitz and Stegun 1964, 17.3.34 and 17.3.36 (errors < 2e-8)
_K0, _K1, _K2, _K3, _K4 = 1.38629436112, 0.09666344259, 0.03590092383, 0.03742563713, 0.01451196212
_L0, _L1, _L2, _L3, _L4 = 0.5, 0.12498593597, 0.06880248576, 0.03328355346, 0.00441787012
_E1, _E2, _E3, _E4 = 0.44325141463, 0.06260601220, 0.04757383546, 0.01736506451
_F1, _F2, _F3, _F4 = 0.24998368310, 0.09200180037, 0.04069697526, 0.00526449639
_NEAR = 1e-4  # of a strip's width: nearer than this to the deepest point, (5) is taken at this distance


@inlined_kernel
def strip(
    gap: float, lateral: float, curvature_x: float, curvature_y: float, a: float, b: float
) -> tuple[float, float]:
    """One strip: equations 1 and 2 (kernel: trusts its input).

    Parameters
    ----------
    gap : float
        Gap g of the undeformed profiles at this strip [m].
    lateral : float
        Its distance y from the deepest point [m].
    curvature_x, curvature_y : float
        A and B at the deepest point [1/m].
    a, b : float
        Hertz's semi-axes there [m].

    Returns
    -------
    tuple of float
        (x_l/a)^2, positive in contact [-]; half length x_l [m], zero outside.
    """
    at_centre, at_edge = curvature_x * a * a, curvature_y * b * b
    virtual = at_centre - (at_centre - at_edge) * min((lateral / b) ** 2, 1.0)
    inside = (virtual - gap) / at_centre
    if not inside > 0.0:
        return inside, 0.0
    return inside, a * math.sqrt(inside)


@kernel
def influence(lateral: float, width: float, half_length: float) -> float:
    """Integral of sqrt(x_l^2 - x^2)/r over a strip, per width, seen from (0, 0).

    Over x it is 2 sqrt(x_l^2 + y^2) (K(m) - E(m)) with m = x_l^2/(x_l^2 + y^2) (5), which is logarithmic at
    y = 0: that part is averaged over the width exactly.

    Parameters
    ----------
    lateral, width, half_length : float
        Of the strip: y of its middle, its width and x_l [m].

    Returns
    -------
    float
        [m].
    """
    y = max(abs(lateral), _NEAR * width)
    square = half_length * half_length + y * y
    m1 = y * y / square
    log = -math.log(m1)
    k = _K0 + m1 * (_K1 + m1 * (_K2 + m1 * (_K3 + m1 * _K4)))
    k += log * (_L0 + m1 * (_L1 + m1 * (_L2 + m1 * (_L3 + m1 * _L4))))
    e = 1.0 + m1 * (_E1 + m1 * (_E2 + m1 * (_E3 + m1 * _E4)))
    e += log * m1 * (_F1 + m1 * (_F2 + m1 * (_F3 + m1 * _F4)))
    far, near = lateral + 0.5 * width, lateral - 0.5 * width
    mean_log = (_log_moment(far) - _log_moment(near)) / width
    return 2.0 * (math.sqrt(square) * (k - e) + half_length * (math.log(y) - mean_log))


@kernel
def _log_moment(y: float) -> float:
    """Integral of ln|y| from 0 to y."""
    return y * math.log(abs(y)) - y if y != 0.0 else 0.0
