"""FaStrip: strip theory with Kalker's coefficients, FASTSIM giving the direction of slip.

M.Sh. Sichani, R. Enblom, M. Berg, An alternative to FASTSIM for tangential solution of the wheel-rail
contact, Vehicle System Dynamics 54 (2016) 748-764; equations 2.43-2.46 of Hossein-Nia (KTH, 2018),
corrected. In each strip the leading part sticks with the tractions of strip theory (D.J. Haines and
E. Ollerton 1963; with spin J.J. Kalker 1967); behind it |q| = friction * Hertz pressure, in the direction
that FASTSIM gives.

Choices where publications differ, each the better one against 185 exact cases (tests/reference):

* kappa and lambda are made with D, not with d/a (1.06 against 1.24 % of mu N in the mean);
* a strip slips as a whole where strip theory leaves it no stick zone, or one that breaks Coulomb's law
  (possible only for |psi| > 1); these strips use FASTSIM's single flexibility;
* D is written (xi^2 + eta^2)/(root - eta psi): the same as equation 2.44, and finite at |psi| = 1.
"""

import math

from hh_exudyn.contact.fastsim import advance, single_stiffness, start, stiffnesses
from hh_exudyn.contact.kalker import coefficients
from hh_exudyn.contact.types import FloatArray
from hh_exudyn.kernel import kernel


@kernel
def scaled_creepages(
    a: float,
    b: float,
    bound: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    shear_modulus: float,
    poisson_ratio: float,
    c11: float,
    c22: float,
    c23: float,
) -> tuple[float, float, float]:
    """xi0, eta, psi of equation 2.43 [-]; bound = friction * maximum pressure [Pa]."""
    half = 0.5 * shear_modulus / bound
    xi_0 = -half * nu_x * 4.0 * (1.0 - poisson_ratio) * c11 / math.pi**2
    eta = -half * (1.0 - poisson_ratio) * nu_y * 4.0 * c22 / math.pi**2
    psi = -half * a * phi * 3.0 / math.pi * math.sqrt(b / a) * c23
    return xi_0, eta, psi


@kernel
def strip(
    xi: float, eta: float, psi: float, poisson_ratio: float, length: float
) -> tuple[bool, float, float, float, float]:
    """One strip of strip theory (equations 2.43, 2.44).

    Parameters
    ----------
    xi, eta, psi : float
        Scaled longitudinal (of this strip), lateral and spin creepage [-].
    poisson_ratio : float
        [-].
    length : float
        Half length of the strip a(y) over the semi-axis a [-].

    Returns
    -------
    tuple
        Whether the whole strip slips, half length of the slip zone d over a(y), kappa, lambda, lambda' [-].
    """
    square = xi * xi + eta * eta
    if square == 0.0:
        if abs(psi) > 1.0:
            return True, 1.0, 0.0, 0.0, 0.0
        return False, 0.0, 0.0, psi, 0.0
    radicand = eta * eta + (1.0 - psi * psi) * xi * xi
    divisor = math.sqrt(max(radicand, 0.0)) - eta * psi
    if radicand < 0.0 or divisor <= 0.0:
        return True, 1.0, 0.0, 0.0, 0.0
    inverse = divisor / square  # 1/D
    slip_part = 1.0 / (inverse * (1.0 - poisson_ratio) * length)
    if slip_part >= 1.0:
        return True, 1.0, 0.0, 0.0, 0.0
    kappa, lambda_prime = xi * inverse, eta * inverse
    if abs(psi) > 1.0:
        # |q| <= mu p in the stick zone is tightest at the leading edge
        primes = kappa * kappa + lambda_prime * lambda_prime
        if primes * (1.0 - math.sqrt(1.0 - slip_part)) < psi * psi - 1.0:
            return True, 1.0, 0.0, 0.0, 0.0
    return False, slip_part, kappa, lambda_prime + psi, lambda_prime


@kernel
def direction_force(a: float, b: float, normal_force: float) -> float:
    """Normal force that FASTSIM is run with for the directions [N] (Sichani 2016)."""
    if a < b:
        return normal_force * (1.0 + (1.0 - a / b) ** 4)
    return normal_force


@kernel
def _slip_sums(
    upper_x: float, upper_y: float, upper_spin: float,
    upper_start: float, upper_kappa: float, upper_lambda: float,
    lower_x: float, lower_y: float, lower_spin: float,
    lower_start: float, lower_kappa: float, lower_lambda: float,
    cells_x: int,
) -> tuple[float, float, float, float, float, float]:  # fmt: skip
    """What slip adds in two strips: sums over their slip zones of sqrt(1 - xi^2) (t - (kappa, lambda)).

    Two strips at once keep the processor busy, each being one chain of dependent steps. `*_x`, `*_y`,
    `*_spin` are the scaled rigid slip (its lateral part is y + spin xi), `*_start` is where slip begins.

    Returns
    -------
    tuple of float
        For the upper, then for the lower strip: longitudinal, lateral, lateral times xi; per cell length.
    """
    step = 2.0 / cells_x
    per_step = 0.5 * cells_x
    last_start = max(upper_start, lower_start)
    u_x, u_y, u_slips = start(upper_x, upper_y + upper_spin)
    l_x, l_y, l_slips = start(lower_x, lower_y + lower_spin)
    upper_x, upper_y, upper_spin = upper_x * step, upper_y * step, upper_spin * step
    lower_x, lower_y, lower_spin = lower_x * step, lower_y * step, lower_spin * step
    uq_x, uq_y, lq_x, lq_y = 0.0, 0.0, 0.0, 0.0
    usum_x, usum_y, usum_m, lsum_x, lsum_y, lsum_m = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(cells_x):
        node = 1.0 - (k + 1) * step
        xi = node + 0.5 * step
        bound = max(1.0 - node * node, 0.0)
        old_ux, old_uy, old_lx, old_ly = u_x, u_y, l_x, l_y
        uq_x, uq_y, u_x, u_y, u_slips = advance(
            uq_x, uq_y, u_x, u_y, u_slips,
            upper_x, upper_y + upper_spin * xi, bound, node - step < upper_start,
        )  # fmt: skip
        lq_x, lq_y, l_x, l_y, l_slips = advance(
            lq_x, lq_y, l_x, l_y, l_slips,
            lower_x, lower_y + lower_spin * xi, bound, node - step < lower_start,
        )  # fmt: skip
        if node < last_start:
            ellipse = math.sqrt(1.0 - xi * xi)
            # the part of the cell that slips, so that forces are continuous in the creepages
            part = ellipse * min(max((upper_start - node) * per_step, 0.0), 1.0)
            usum_x += part * (0.5 * (old_ux + u_x) - upper_kappa)
            lateral = part * (0.5 * (old_uy + u_y) - upper_lambda)
            usum_y += lateral
            usum_m += xi * lateral
            part = ellipse * min(max((lower_start - node) * per_step, 0.0), 1.0)
            lsum_x += part * (0.5 * (old_lx + l_x) - lower_kappa)
            lateral = part * (0.5 * (old_ly + l_y) - lower_lambda)
            lsum_y += lateral
            lsum_m += xi * lateral
    return usum_x, usum_y, usum_m, lsum_x, lsum_y, lsum_m


@kernel
def _strip_force(
    slip_part: float,
    kappa: float,
    lambda_: float,
    lambda_prime: float,
    sum_x: float,
    sum_y: float,
    sum_m: float,
) -> tuple[float, float, float]:
    """Integral of equation 2.45 over one strip of half length 1: F_x, F_y, M/a(y), over pi/2 mu p."""
    stick = (1.0 - slip_part) ** 2
    slipping = slip_part * (2.0 - slip_part)  # 1 - stick, exact for little slip
    return (
        kappa * slipping + sum_x,
        lambda_ - lambda_prime + lambda_prime * slipping + sum_y,
        -lambda_prime * slip_part * stick + sum_m,
    )


@kernel
def force(
    a: float,
    b: float,
    normal_force: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    friction: float,
    shear_modulus: float,
    poisson_ratio: float,
    cells_x: int,
    cells_y: int,
) -> tuple[float, float, float]:
    """Creep forces and spin moment on the wheel; arguments as `tangential.force_kernel`.

    Both semi-ellipses of equation 2.45 are integrated exactly, over the whole strip and over its stick zone;
    only the slip zone's difference to them is summed over cells.
    """
    c11, c22, c23, _ = coefficients(a / b, poisson_ratio)
    stiff_x, stiff_y, stiff_phi = stiffnesses(a, b, shear_modulus, c11, c22, c23)
    stiff = single_stiffness(stiff_x, stiff_y, stiff_phi, nu_x, nu_y, phi, math.sqrt(a * b))
    bound = friction * 1.5 * normal_force / (math.pi * a * b)
    xi_0, eta, psi = scaled_creepages(
        a, b, bound, nu_x, nu_y, phi, shear_modulus, poisson_ratio, c11, c22, c23
    )
    scale = 0.5 * math.pi * a * a * b / (friction * direction_force(a, b, normal_force))
    three_x, three_y, three_phi = scale * stiff_x * nu_x, scale * stiff_y * nu_y, scale * stiff_phi * phi
    one_x, one_y, one_phi = scale * stiff * nu_x, scale * stiff * nu_y, scale * stiff * phi
    step = 2.0 / cells_x
    semicircle = 0.0
    for k in range(cells_x):
        x = 1.0 - (k + 0.5) * step
        semicircle += math.sqrt(1.0 - x * x)
    weight = 1.0 / semicircle  # the pressure summed over the cells of a strip is then exact
    force_x, force_y, moment_z, total = 0.0, 0.0, 0.0, 0.0
    for j in range((cells_y + 1) // 2):
        lateral = 1.0 - (2 * j + 1) / cells_y
        y = b * lateral
        square = 1.0 - lateral * lateral
        cosine = math.sqrt(square)
        inverse = 1.0 / cosine
        tilt = psi * y / a
        u_full, u_part, u_kappa, u_lambda, u_prime = strip(xi_0 - tilt, eta, psi, poisson_ratio, cosine)
        l_full, l_part, l_kappa, l_lambda, l_prime = strip(xi_0 + tilt, eta, psi, poisson_ratio, cosine)
        u_x, u_y, u_phi = (one_x, one_y, one_phi) if u_full else (three_x, three_y, three_phi)
        l_x, l_y, l_phi = (one_x, one_y, one_phi) if l_full else (three_x, three_y, three_phi)
        usum_x, usum_y, usum_m, lsum_x, lsum_y, lsum_m = _slip_sums(
            (u_x - u_phi * y) * inverse, u_y * inverse, u_phi * a, 2.0 * u_part - 1.0, u_kappa, u_lambda,
            (l_x + l_phi * y) * inverse, l_y * inverse, l_phi * a, 2.0 * l_part - 1.0, l_kappa, l_lambda,
            cells_x,
        )  # fmt: skip
        strip_x, strip_y, strip_m = _strip_force(
            u_part, u_kappa, u_lambda, u_prime, weight * usum_x, weight * usum_y, weight * usum_m
        )
        force_x += square * strip_x
        force_y += square * strip_y
        moment_z += square * (a * cosine * strip_m - y * strip_x)
        total += square
        if 2 * j + 1 < cells_y:  # the middle strip of an odd number has no partner
            strip_x, strip_y, strip_m = _strip_force(
                l_part, l_kappa, l_lambda, l_prime, weight * lsum_x, weight * lsum_y, weight * lsum_m
            )
            force_x += square * strip_x
            force_y += square * strip_y
            moment_z += square * (a * cosine * strip_m + y * strip_x)
            total += square
    scale = friction * normal_force / total
    return force_x * scale, force_y * scale, moment_z * scale


@kernel
def field(
    a: float,
    b: float,
    normal_force: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    friction: float,
    shear_modulus: float,
    poisson_ratio: float,
    pressure: FloatArray,
    q_x: FloatArray,
    q_y: FloatArray,
    slip_x: FloatArray,
    slip_y: FloatArray,
) -> None:
    """Pressure, tractions and slip over the cells; arguments as `tangential.field_kernel`.

    Slip is that of strip theory: rigid slip less the surface's own strain, zero in stick; its direction is
    opposite to the traction. Kalker's coefficients make the two strains differ a little from the rigid slip
    in stick, so the slip of the whole patch is scaled (by 0.86..1.01 in nine of ten of the 185 cases) to
    make friction dissipate the power of the creepages: sum of q.s dA = F_x nu_x + F_y nu_y + M phi.
    """
    cells_y, cells_x = pressure.shape
    c11, c22, c23, _ = coefficients(a / b, poisson_ratio)
    stiff_x, stiff_y, stiff_phi = stiffnesses(a, b, shear_modulus, c11, c22, c23)
    stiff = single_stiffness(stiff_x, stiff_y, stiff_phi, nu_x, nu_y, phi, math.sqrt(a * b))
    max_pressure = 1.5 * normal_force / (math.pi * a * b)
    bound = friction * max_pressure
    xi_0, eta, psi = scaled_creepages(
        a, b, bound, nu_x, nu_y, phi, shear_modulus, poisson_ratio, c11, c22, c23
    )
    scale = 0.5 * math.pi * a * a * b / (friction * direction_force(a, b, normal_force))
    # a semi-ellipse of traction strains the surface of the strip by these, times x/a
    strain_x = 0.5 * math.pi**2 * bound / (shear_modulus * c11)
    strain_y = 0.5 * math.pi**2 * bound / (shear_modulus * c22)
    step = 2.0 / cells_x
    work, power = 0.0, 0.0
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        y = b * lateral
        cosine = math.sqrt(1.0 - lateral * lateral)
        full, part, kappa, lambda_, lambda_prime = strip(xi_0 - psi * y / a, eta, psi, poisson_ratio, cosine)
        s_x, s_y, s_phi = (stiff, stiff, stiff) if full else (stiff_x, stiff_y, stiff_phi)
        w_x = (nu_x * s_x - phi * y * s_phi) * scale / cosine
        w_y = nu_y * s_y * scale / cosine
        spin = phi * s_phi * a * scale
        t_x, t_y, slips = start(w_x, w_y + spin)
        carried_x, carried_y = 0.0, 0.0
        slip_start = 2.0 * part - 1.0
        strain = cosine * math.hypot(strain_x * kappa, strain_y * lambda_prime)
        for k in range(cells_x):
            i = cells_x - 1 - k  # from the leading edge
            xi = 1.0 - (k + 0.5) * step
            node = xi - 0.5 * step
            old_x, old_y = t_x, t_y
            carried_x, carried_y, t_x, t_y, slips = advance(
                carried_x, carried_y, t_x, t_y, slips,
                w_x * step, (w_y + spin * xi) * step, max(1.0 - node * node, 0.0), node - step < slip_start,
            )  # fmt: skip
            ellipse = cosine * math.sqrt(1.0 - xi * xi)
            pressure[j, i] = max_pressure * ellipse
            x = a * cosine * xi
            rigid_x, rigid_y = nu_x - phi * y, nu_y + phi * x
            if full or xi <= slip_start:
                mean_x, mean_y = old_x + t_x, old_y + t_y
                square = mean_x * mean_x + mean_y * mean_y
                if square > 1e-12:
                    inverse = 1.0 / math.sqrt(square)
                    mean_x, mean_y = mean_x * inverse, mean_y * inverse
                else:  # the direction turns right round within the cell
                    mean_x, mean_y = t_x, t_y
                traction_x, traction_y = bound * ellipse * mean_x, bound * ellipse * mean_y
                if full:
                    gain = cosine * xi * (strain_x * mean_x * mean_x + strain_y * mean_y * mean_y)
                    speed = min(mean_x * rigid_x + mean_y * rigid_y + gain, 0.0)
                else:
                    speed = -strain * math.sqrt(max((xi - part) ** 2 - (1.0 - part) ** 2, 0.0))
                slip_x[j, i], slip_y[j, i] = speed * mean_x, speed * mean_y
                work += cosine * bound * ellipse * speed
            else:
                root = cosine * math.sqrt(max((1.0 - part) ** 2 - (xi - part) ** 2, 0.0))
                traction_x = bound * kappa * (ellipse - root)
                traction_y = bound * (lambda_ * ellipse - lambda_prime * root)
                slip_x[j, i], slip_y[j, i] = 0.0, 0.0
            q_x[j, i], q_y[j, i] = traction_x, traction_y
            power += cosine * (traction_x * rigid_x + traction_y * rigid_y)
    if work < 0.0 and power < 0.0:
        factor = power / work
        for j in range(cells_y):
            for i in range(cells_x):
                slip_x[j, i] *= factor
                slip_y[j, i] *= factor
