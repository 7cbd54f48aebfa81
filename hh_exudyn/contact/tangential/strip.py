"""Strip theory: every strip of the ellipse along the rolling direction is a line contact of its own.

D.J. Haines, E. Ollerton, Contact stress distributions on elliptical contact surfaces subjected to radial and
tangential forces, Proc. Inst. Mech. Eng. 177 (1963) 95-114 (longitudinal creepage); J.J. Kalker, A strip
theory for rolling with slip and spin, Proc. Kon. Ned. Akad. Wet. B 70 (1967) 10-62 (lateral creepage and
limited spin); equations 2.24-2.32 of Hossein-Nia (KTH, 2018).

A strip is in plane strain (longitudinal) and antiplane shear (lateral): nothing of it depends on a/b, so the
theory holds for a << b and is far off for a > b. Strips of three kinds:

* a strip with a stick zone, equation 2.24; in its slip zone |q| = friction * pressure in one direction, that
  of the tractions at the zones' border (2.31);
* a strip that slips as a whole, equation 2.32: |q| = friction * pressure, opposite to the rigid slip in the
  strip's middle (the lateral part of spin, phi x, has no mean);
* a strip without rigid slip in its middle (pure spin, the middle of the patch) has no such direction: it
  carries no traction.

The theory is valid for limited spin, |psi| < 1: beyond, its stick tractions would break Coulomb's law. There
every strip slips as a whole, (2.32): |q| <= friction * pressure at any spin, but pure spin then has no
lateral force at all, and with lateral creepage against the spin the force jumps at |psi| = 1. FaStrip avoids
both.
"""

import math

from hh_exudyn.contact.normal.hertz import peak_pressure
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import kernel


@kernel
def scaled_creepages(patch: RollingPatch) -> tuple[float, float, float]:
    """xi in the middle strip, eta, psi of equation 2.30 [-].

    Parameters
    ----------
    patch : RollingPatch
        Size, load, creepages and material; load and friction above zero.
    """
    half = -0.5 * patch.shear_modulus / (patch.friction * peak_pressure(patch))
    return half * patch.nu_x, half * (1.0 - patch.poisson_ratio) * patch.nu_y, half * patch.a * patch.phi


@kernel
def stick_zone(
    xi: float, eta: float, psi: float, poisson_ratio: float, length: float
) -> tuple[bool, float, float, float, float]:
    """The zones of one strip and the factors of its tractions (equations 2.26-2.29).

    Parameters
    ----------
    xi, eta, psi : float
        Of `scaled_creepages`, xi of this strip [-].
    poisson_ratio : float
        [-].
    length : float
        Half length of the strip a(y) over the semi-axis a [-].

    Returns
    -------
    tuple
        Whether the whole strip slips, half length of the slip zone d over a(y), kappa, lambda, lambda' [-].
    """
    if abs(psi) >= 1.0:
        return True, 1.0, 0.0, 0.0, 0.0
    square = xi * xi + eta * eta
    if square == 0.0:  # pure spin, in the middle of the patch: the whole strip sticks
        return False, 0.0, 0.0, psi, 0.0
    # 1/D; equation 2.26 with numerator and denominator times (root - eta psi)
    inverse = (math.sqrt(eta * eta + (1.0 - psi * psi) * xi * xi) - eta * psi) / square
    part = 1.0 / (inverse * (1.0 - poisson_ratio) * length)
    if part >= 1.0:
        return True, 1.0, 0.0, 0.0, 0.0
    return False, part, xi * inverse, eta * inverse + psi, eta * inverse


@kernel
def whole_slip(xi: float, eta: float, poisson_ratio: float) -> tuple[float, float]:
    """Direction of the traction in a strip that slips as a whole, equation 2.32; zero without rigid slip.

    Parameters
    ----------
    xi, eta : float
        Scaled longitudinal (of this strip) and lateral creepage [-].
    poisson_ratio : float
        [-].
    """
    lateral = eta / (1.0 - poisson_ratio)
    size = math.hypot(xi, lateral)
    if size == 0.0:
        return 0.0, 0.0
    return xi / size, lateral / size


@kernel
def force(patch: RollingPatch, cells_y: int) -> tuple[float, float, float]:
    """Creep forces and spin moment on the wheel.

    The semi-ellipses of equation 2.24 are integrated exactly along a strip: only the number of strips
    matters.

    Parameters
    ----------
    patch : RollingPatch
        Size, load, creepages and material.
    cells_y : int
        Strips.
    """
    a, b, poisson_ratio = patch.a, patch.b, patch.poisson_ratio
    xi_0, eta, psi = scaled_creepages(patch)
    force_x, force_y, moment_z, total = 0.0, 0.0, 0.0, 0.0
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        y = b * lateral
        square = 1.0 - lateral * lateral
        cosine = math.sqrt(square)
        xi = xi_0 - psi * y / a
        full, part, kappa, lambda_, lambda_prime = stick_zone(xi, eta, psi, poisson_ratio, cosine)
        if full:
            strip_x, strip_y = whole_slip(xi, eta, poisson_ratio)
            strip_m = 0.0
        else:
            stick = (1.0 - part) ** 2  # area of the smaller semi-ellipse, centred part * a(y) ahead
            strip_x = kappa * (1.0 - stick)
            strip_y = lambda_ - lambda_prime * stick
            strip_m = -lambda_prime * stick * part
        force_x += square * strip_x
        force_y += square * strip_y
        moment_z += square * (a * cosine * strip_m - y * strip_x)
        total += square
    scale = patch.friction * patch.normal_force / total
    return force_x * scale, force_y * scale, moment_z * scale


@kernel
def field(patch: RollingPatch, fields: Fields) -> None:
    """Pressure, tractions and slip over the cells.

    Slip is the rigid slip less the strain of the strip's surface, in closed form. A semi-ellipse of traction
    strains the surface by -2 (1 - nu)/G q_x x/a and -2/G q_y x/a; in the stick zone that is the rigid slip
    exactly. Slip and traction are opposite within a few degrees only (the theory takes one direction for the
    whole slip zone); where slip would be along the traction, it is set to zero.

    Arguments as in `fastrip.field`.
    """
    pressure, q_x, q_y, slip_x, slip_y = fields
    cells_y, cells_x = pressure.shape
    a, b, poisson_ratio = patch.a, patch.b, patch.poisson_ratio
    nu_x, nu_y, phi = patch.nu_x, patch.nu_y, patch.phi
    middle = peak_pressure(patch)
    bound = patch.friction * middle
    xi_0, eta, psi = scaled_creepages(patch)
    strain_y = 2.0 * bound / patch.shear_modulus
    strain_x = strain_y * (1.0 - poisson_ratio)
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        y = b * lateral
        cosine = math.sqrt(1.0 - lateral * lateral)
        xi = xi_0 - psi * y / a
        full, part, kappa, lambda_, lambda_prime = stick_zone(xi, eta, psi, poisson_ratio, cosine)
        if full:
            kappa, lambda_ = whole_slip(xi, eta, poisson_ratio)
        for i in range(cells_x):
            along = -1.0 + (2 * i + 1) / cells_x
            x = a * cosine * along
            ellipse = cosine * math.sqrt(1.0 - along * along)
            gap = (along - part) ** 2 - (1.0 - part) ** 2
            traction_x, traction_y = kappa * ellipse, lambda_ * ellipse  # (2.31, 2.32)
            s_x, s_y = 0.0, 0.0
            if full:
                s_x = nu_x - phi * y + strain_x * kappa * cosine * along
                s_y = nu_y + phi * x + strain_y * lambda_ * cosine * along
            elif along <= 2.0 * part - 1.0:
                root = cosine * math.sqrt(max(gap, 0.0))
                s_x, s_y = -strain_x * kappa * root, -strain_y * lambda_prime * root
            else:
                root = cosine * math.sqrt(max(-gap, 0.0))
                traction_x -= kappa * root  # (2.24)
                traction_y -= lambda_prime * root
            if traction_x * s_x + traction_y * s_y > 0.0:
                s_x, s_y = 0.0, 0.0
            pressure[j, i] = middle * ellipse
            q_x[j, i], q_y[j, i] = bound * traction_x, bound * traction_y
            slip_x[j, i], slip_y[j, i] = s_x, s_y
