"""The equations of FaStrip in one strip: strip theory, and the start of FASTSIM's march.

Equations 2.43 and 2.44 of Hossein-Nia (KTH, 2018), corrected; strip theory of D.J. Haines and E. Ollerton
(1963), with spin J.J. Kalker (1967); Kalker's coefficients in it after M.Sh. Sichani, R. Enblom, M. Berg
(Vehicle System Dynamics 54, 2016, 748-764). A strip's equations are scaled with its own half length and
pressure, so that the patch may have any shape; in an ellipse that is the published scaling.
"""

import math
from typing import NamedTuple

from hh_exudyn.contact.normal.hertz import peak_pressure
from hh_exudyn.contact.tangential.fastsim_march import begin, single_stiffness, stiffnesses
from hh_exudyn.contact.tangential.kalker import coefficients
from hh_exudyn.contact.tangential.strips import (
    FIRST,
    FULL,
    HALF_LENGTH,
    KAPPA,
    LAMBDA,
    LANES,
    PART,
    PRESSURE,
    PRIME,
    SHAPE,
    SPIN,
    W_X,
    W_Y,
    Y,
)
from hh_exudyn.contact.types import Memory, Quadruple, RollingPatch, Triple
from hh_exudyn.kernel import inlined_kernel, kernel, shaped

_TINY = 1e-300  # prevents 0/0; far below every square that occurs [-]
_FADES = 0.5  # utilisation at which the stick zone begins to shrink; at 1 it would break Coulomb's law [-]


class Rolling(NamedTuple):
    """Quantities common to the strips of a patch.

    Divided by a strip's pressure p they give the scaled creepages of strip theory, divided by p^2/l with the
    strip's half length l the scaled rigid slip of FASTSIM.
    """

    xi: float  # [Pa]
    eta: float  # [Pa]
    psi: float  # [Pa/m]
    three_x: float  # rigid slip over Kalker's three flexibilities [Pa^2/m]
    three_y: float
    three_phi: float  # [Pa^2/m^2]
    one_x: float  # rigid slip over the single flexibility [Pa^2/m]
    one_y: float
    one_phi: float
    poisson_ratio: float
    strain_x: float  # amplitude of the surface's strain under a semi-ellipse of traction, over p [1/Pa]
    strain_y: float


@inlined_kernel
def rolling_strips(patch: RollingPatch) -> Rolling:
    """Creepages scaled for strip theory (equation 2.43) and for FASTSIM.

    Parameters
    ----------
    patch : RollingPatch
        Size, load, creepages and material.
    """
    a, b, nu_x, nu_y, phi = patch.a, patch.b, patch.nu_x, patch.nu_y, patch.phi
    friction, shear_modulus, poisson_ratio = patch.friction, patch.shear_modulus, patch.poisson_ratio
    c11, c22, c23, _ = coefficients(a / b, poisson_ratio)
    half = -0.5 * shear_modulus / friction
    along = half * 4.0 * (1.0 - poisson_ratio) / math.pi**2
    strain = 0.5 * math.pi**2 * friction / shear_modulus
    stiff_x, stiff_y, stiff_phi = stiffnesses(a, b, shear_modulus, c11, c22, c23)
    stiff = single_stiffness(
        stiff_x, stiff_y, stiff_phi, patch.nu_x, patch.nu_y, math.sqrt(patch.a * patch.b) * patch.phi
    )
    # the parabola under which the equivalent ellipse carries the load has the height 4/3 p^2/p_max in a strip
    scale = 0.75 * peak_pressure(patch) / friction * patch.normal_force / direction_force(patch)
    return Rolling(
        along * c11 * nu_x,
        along * c22 * nu_y,
        half * 3.0 / math.pi * math.sqrt(b / a) * c23 * phi,
        scale * stiff_x * nu_x,
        scale * stiff_y * nu_y,
        scale * stiff_phi * phi,
        scale * stiff * nu_x,
        scale * stiff * nu_y,
        scale * stiff * phi,
        poisson_ratio,
        strain / c11,
        strain / c22,
    )


@kernel
def strip(xi: float, eta: float, psi: float, poisson_ratio: float) -> tuple[bool, float, float, float, float]:
    """One strip of strip theory (equations 2.43, 2.44), scaled with its own half length and pressure.

    Parameters
    ----------
    xi, eta, psi : float
        Scaled longitudinal (of this strip), lateral and spin creepage [-].
    poisson_ratio : float
        [-].

    Returns
    -------
    tuple
        Whether the whole strip slips, half length of the slip zone d over the strip's, kappa, lambda,
        lambda' [-].
    """
    square = xi * xi + eta * eta
    beyond = psi * psi - 1.0
    radicand = eta * eta - beyond * xi * xi
    divisor = math.sqrt(max(radicand, 0.0)) - eta * psi
    inverse = divisor / (square + _TINY)  # 1/D
    part = square / ((divisor if divisor > 0.0 else 1.0) * (1.0 - poisson_ratio))
    kappa, lambda_prime = xi * inverse, eta * inverse
    still = (square == 0.0) & (beyond <= 0.0)  # no creepage but spin, in the middle of the patch
    none = (radicand < 0.0) | (divisor <= 0.0) | (part >= 1.0)
    # beyond |psi| = 1: |q| <= mu p in the stick zone is tightest at the leading edge; 1 where it breaks there
    primes = kappa * kappa + lambda_prime * lambda_prime
    broken = beyond / (primes * (1.0 - math.sqrt(max(1.0 - part, 0.0))) + _TINY)
    full = (none | (broken >= 1.0)) & (not still)
    # the stick zone shrinks before it would break Coulomb's law, so that forces have no jumps
    part += (1.0 - part) * max((broken - _FADES) / (1.0 - _FADES), 0.0)
    part = 1.0 if full else 0.0 if still else part
    kappa, lambda_prime = 0.0 if full else kappa, 0.0 if full else lambda_prime
    return full, part, kappa, 0.0 if full else lambda_prime + psi, lambda_prime


@inlined_kernel
def direction_force(patch: RollingPatch) -> float:
    """Normal force in FASTSIM for the directions [N] (Sichani 2016).

    Parameters
    ----------
    patch : RollingPatch
        Its semi-axes and normal force.
    """
    if patch.a < patch.b:
        return patch.normal_force * (1.0 + (1.0 - patch.a / patch.b) ** 4)
    return patch.normal_force


@kernel
def _sticks_until(w_x: float, w_y: float, spin: float) -> float:
    """End of FASTSIM's stick zone from the leading edge, xi + 1 in 0..2; 2 if the edge itself slips.

    Until then its traction is (1 - xi) times v = (w_x, w_y + spin (1 + xi)/2), and the bound
    (1 - xi)(1 + xi): the end is the root of |v|^2 = (1 + xi)^2, a quadratic.
    """
    constant = w_x * w_x + w_y * w_y
    edge = w_y + spin
    half = 0.5 * w_y * spin
    square = 0.25 * spin * spin - 1.0
    root = math.sqrt(max(half * half - square * constant, 0.0))
    end = constant / (root - half + _TINY)
    return 2.0 if w_x * w_x + edge * edge > 4.0 else end


@inlined_kernel
def set_strip(
    g: int, lane: int, theory: Triple, three: Quadruple, one: Quadruple, poisson_ratio: float, state: Memory
) -> float:
    """Solve strip theory in one strip of a block and scale its rigid slip for FASTSIM's march.

    Parameters
    ----------
    g, lane : int
        Place of the strip in the block; its half length and pressure are there.
    theory : tuple of float
        xi of this strip, eta and psi of equation 2.43 times the pressure [Pa], [Pa], [Pa/m].
    three, one : tuple of float
        Rigid slip in the strip's middle over three flexibilities and over the single one: longitudinal but
        for spin, lateral, spin over length, and the longitudinal part of spin [Pa^2/m], the third [Pa^2/m^2].
    poisson_ratio : float
        [-].
    state : memory
        Of the block.

    Returns
    -------
    float
        Part of the strip that sticks from the leading edge in both theories [-].
    """
    s = shaped(state, SHAPE)
    length, inverse = s[HALF_LENGTH, g, lane], 1.0 / s[PRESSURE, g, lane]
    full, part, kappa, lambda_, lambda_prime = strip(
        theory[0] * inverse, theory[1] * inverse, theory[2] * length * inverse, poisson_ratio
    )
    exists = length > 0.0
    part = part if exists else 0.0
    factor = length * inverse * inverse
    # one flexibility where the whole strip slips; blended in by the fourth power without a jump
    share = part**4
    w_x = factor * (three[0] + share * (one[0] - three[0]) + three[3] + share * (one[3] - three[3]))
    w_y = factor * (three[1] + share * (one[1] - three[1]))
    spin = factor * (three[2] + share * (one[2] - three[2])) * length
    s[W_X, g, lane], s[W_Y, g, lane], s[SPIN, g, lane] = w_x, w_y, spin
    s[PART, g, lane], s[FULL, g, lane] = part, 1.0 if full & exists else 0.0
    s[KAPPA, g, lane] = kappa if exists else 0.0
    s[LAMBDA, g, lane] = lambda_ if exists else 0.0
    s[PRIME, g, lane] = lambda_prime if exists else 0.0
    return min(1.0 - 0.5 * _sticks_until(w_x, w_y, spin), 1.0 - part)


@kernel
def prepare(groups: int, rolling: Rolling, cells_x: int, state: Memory) -> None:
    """Solve strip theory in a block of strips, and set the first cell of FASTSIM's march for each group
    (kernel).

    Parameters
    ----------
    groups : int
        In use.
    rolling : Rolling
        Of the patch.
    cells_x : int
        Cells along each strip.
    state : memory
        Of the block: strips are read, results and the start of the march are written.
    """
    s = shaped(state, SHAPE)
    for g in range(groups):
        for lane in range(LANES):
            y = s[Y, g, lane]
            sticking = set_strip(
                g,
                lane,
                (rolling.xi - rolling.psi * y, rolling.eta, rolling.psi),
                (rolling.three_x, rolling.three_y, rolling.three_phi, -rolling.three_phi * y),
                (rolling.one_x, rolling.one_y, rolling.one_phi, -rolling.one_phi * y),
                rolling.poisson_ratio,
                state,
            )
            s[FIRST, g, lane] = math.floor(sticking * cells_x)
    begin(groups, cells_x, state)
