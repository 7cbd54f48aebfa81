"""FaStrip: strip theory with Kalker's coefficients, FASTSIM giving the direction of slip.

M.Sh. Sichani, R. Enblom, M. Berg, An alternative to FASTSIM for tangential solution of the wheel-rail
contact, Vehicle System Dynamics 54 (2016) 748-764; equations 2.43-2.46 of Hossein-Nia (KTH, 2018),
corrected. In each strip the leading part sticks with the tractions of strip theory (D.J. Haines and
E. Ollerton 1963; with spin J.J. Kalker 1967); behind it |q| = friction * pressure, in the direction that
FASTSIM gives. A strip's equations are scaled with its own half length and pressure, so that the patch may
have any shape; in an ellipse that is the published scaling.

Choices where publications differ, each the better one against 185 exact cases (tests/reference):

* kappa and lambda are made with D, not with d/a (1.06 against 1.24 % of mu N in the mean);
* a strip slips as a whole where strip theory leaves it no stick zone, or one that breaks Coulomb's law
  (possible only for |psi| > 1); these strips use FASTSIM's single flexibility;
* D is written (xi^2 + eta^2)/(root - eta psi): the same as equation 2.44, and finite at |psi| = 1.
"""

import math
from typing import NamedTuple

from hh_exudyn.contact.fastsim import advance, single_stiffness, stiffnesses
from hh_exudyn.contact.kalker import coefficients
from hh_exudyn.contact.strips import (
    BLOCK,
    GROUPS,
    HALF_LENGTH,
    LANES,
    PRESSURE,
    STRIP_COLUMNS,
    WIDTH,
    Y,
    fill_ellipse,
)
from hh_exudyn.contact.types import FloatArray
from hh_exudyn.kernel import kernel, scratch

_TINY = 1e-300  # keeps 0/0 from happening; far below every square that occurs [-]
_MORE_THAN_ONE = 1.0 + 1e-12

# rows of the scratch array: what a strip is (fixed), and what is carried along it
_W_X, _W_Y, _SPIN = 0, 1, 2  # scaled rigid slip per cell; its lateral part is w_y + spin xi
_PART, _KAPPA, _LAMBDA, _PRIME, _FULL = 3, 4, 5, 6, 7  # what `strip` gives
_FIRST = 8  # node from which the strip has to be marched
_Q_X, _Q_Y, _T_X, _T_Y, _SLIPS = 9, 10, 11, 12, 13  # what `advance` carries
_SUM_X, _SUM_Y, _SUM_M = 14, 15, 16  # what slip adds to the force; or the direction in the cell
_ROWS = 17
_STATE_SIZE = _ROWS * BLOCK
_STRIPS_SIZE = BLOCK * STRIP_COLUMNS


class _Rolling(NamedTuple):
    """What the strips of a patch share. Strip theory's creepages become numbers over a strip's pressure p,
    FASTSIM's rigid slip over p^2/l with the strip's half length l."""

    xi: float  # [Pa]
    eta: float  # [Pa]
    psi: float  # [Pa/m]
    three_x: float  # rigid slip over Kalker's three flexibilities [Pa^2/m]
    three_y: float
    three_phi: float  # [Pa^2/m^2]
    one_x: float  # and over the single one
    one_y: float
    one_phi: float
    poisson_ratio: float


@kernel
def _rolling(
    a: float,
    b: float,
    normal_force: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    friction: float,
    shear_modulus: float,
    poisson_ratio: float,
    c11: float,
    c22: float,
    c23: float,
) -> _Rolling:
    """Creepages scaled for strip theory (equation 2.43) and for FASTSIM."""
    half = -0.5 * shear_modulus / friction
    along = half * 4.0 * (1.0 - poisson_ratio) / math.pi**2
    stiff_x, stiff_y, stiff_phi = stiffnesses(a, b, shear_modulus, c11, c22, c23)
    stiff = single_stiffness(stiff_x, stiff_y, stiff_phi, nu_x, nu_y, phi, math.sqrt(a * b))
    # the parabola under which the equivalent ellipse carries the load: 4/3 p^2/p_max in a strip
    mean = 1.5 * normal_force / (math.pi * a * b)
    scale = 0.75 * mean / friction * normal_force / direction_force(a, b, normal_force)
    return _Rolling(
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
    part = square / (divisor * (1.0 - poisson_ratio))
    kappa, lambda_prime = xi * inverse, eta * inverse
    still = (square == 0.0) & (beyond <= 0.0)  # no creepage but spin, in the middle of the patch
    none = (radicand < 0.0) | (divisor <= 0.0) | (part >= 1.0)
    # beyond |psi| = 1: |q| <= mu p in the stick zone is tightest at the leading edge
    primes = kappa * kappa + lambda_prime * lambda_prime
    breaks = primes * (1.0 - math.sqrt(max(1.0 - part, 0.0))) < beyond
    full = (none | breaks) & (not still)
    if full:
        return True, 1.0, 0.0, 0.0, 0.0
    if still:
        return False, 0.0, 0.0, psi, 0.0
    return False, part, kappa, lambda_prime + psi, lambda_prime


@kernel
def direction_force(a: float, b: float, normal_force: float) -> float:
    """Normal force that FASTSIM is run with for the directions [N] (Sichani 2016)."""
    if a < b:
        return normal_force * (1.0 + (1.0 - a / b) ** 4)
    return normal_force


@kernel
def _sticks_until(w_x: float, w_y: float, spin: float) -> float:
    """Where FASTSIM's stick from the leading edge ends, xi + 1 in 0..2; 2 if the edge itself slips.

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


@kernel
def _prepare(
    strips: FloatArray, first: int, count: int, rolling: _Rolling, cells_x: int, s: FloatArray
) -> None:
    """Solve strip theory in a block of strips, and set the march at the node where each strip needs it."""
    step = 2.0 / cells_x
    for g in range((count + LANES - 1) // LANES):
        for lane in range(LANES):
            row = g * LANES + lane
            is_strip = row < count
            row = first + (row if is_strip else 0)
            length, pressure = strips[row, HALF_LENGTH], strips[row, PRESSURE]
            is_strip = is_strip & (length > 0.0) & (pressure > 0.0)
            s[_Q_X, g, lane] = strips[row, Y]
            s[_Q_Y, g, lane] = length if is_strip else 0.0
            s[_T_X, g, lane] = pressure if is_strip else 1.0
        for lane in range(LANES):
            y, length, inverse = s[_Q_X, g, lane], s[_Q_Y, g, lane], 1.0 / s[_T_X, g, lane]
            full, part, kappa, lambda_, lambda_prime = strip(
                (rolling.xi - rolling.psi * y) * inverse,
                rolling.eta * inverse,
                rolling.psi * length * inverse,
                rolling.poisson_ratio,
            )
            factor = length * inverse * inverse
            spin_factor = factor * (rolling.one_phi if full else rolling.three_phi)
            w_x = factor * (rolling.one_x if full else rolling.three_x) - spin_factor * y
            w_y = factor * (rolling.one_y if full else rolling.three_y)
            spin = spin_factor * length
            sticking = math.floor((1.0 - 0.5 * _sticks_until(w_x, w_y, spin)) * cells_x)
            part = part if length > 0.0 else 0.0  # an empty strip
            s[_FIRST, g, lane] = min(sticking, math.floor((1.0 - part) * cells_x))
            s[_W_X, g, lane], s[_W_Y, g, lane], s[_SPIN, g, lane] = w_x, w_y, spin
            s[_PART, g, lane], s[_KAPPA, g, lane] = part, kappa
            s[_LAMBDA, g, lane], s[_PRIME, g, lane] = lambda_, lambda_prime
            s[_FULL, g, lane] = 1.0 if full else 0.0
        node = float(cells_x)
        for lane in range(LANES):
            node = min(node, s[_FIRST, g, lane])
        at = 1.0 - node * step  # the whole group sticks until there
        for lane in range(LANES):
            w_x, w_y, spin = s[_W_X, g, lane], s[_W_Y, g, lane], s[_SPIN, g, lane]
            v_x, v_y = w_x, w_y + 0.5 * spin * (1.0 + at)
            square = v_x * v_x + v_y * v_y
            inverse = -1.0 / math.sqrt(square + _TINY)
            s[_T_X, g, lane], s[_T_Y, g, lane] = v_x * inverse, v_y * inverse
            s[_Q_X, g, lane], s[_Q_Y, g, lane] = (at - 1.0) * v_x, (at - 1.0) * v_y
            s[_SLIPS, g, lane] = 1.0 if (node == 0.0) & (square > 4.0) else 0.0
            s[_W_X, g, lane], s[_W_Y, g, lane], s[_SPIN, g, lane] = w_x * step, w_y * step, spin * step
            s[_SUM_X, g, lane], s[_SUM_Y, g, lane], s[_SUM_M, g, lane] = 0.0, 0.0, 0.0
            s[_FIRST, g, lane] = node


@kernel
def _add_slip(count: int, cells_x: int, s: FloatArray) -> None:
    """March a block of strips; sum over their slip zones sqrt(1 - xi^2) (t - (kappa, lambda))."""
    step = 2.0 / cells_x
    for k in range(cells_x):
        node = 1.0 - (k + 1) * step
        xi = node + 0.5 * step
        bound = max(1.0 - node * node, 0.0)
        ellipse = math.sqrt(1.0 - xi * xi)
        ends = 0.5 * (1.0 + node)
        for g in range((count + LANES - 1) // LANES):
            if k < s[_FIRST, g, 0]:
                continue
            for lane in range(LANES):
                old_x, old_y = s[_T_X, g, lane], s[_T_Y, g, lane]
                q_x, q_y, t_x, t_y, slips = advance(
                    s[_Q_X, g, lane], s[_Q_Y, g, lane], old_x, old_y, s[_SLIPS, g, lane],
                    s[_W_X, g, lane], s[_W_Y, g, lane] + s[_SPIN, g, lane] * xi, bound,
                )  # fmt: skip
                s[_Q_X, g, lane], s[_Q_Y, g, lane] = q_x, q_y
                s[_T_X, g, lane], s[_T_Y, g, lane] = t_x, t_y
                s[_SLIPS, g, lane] = slips
                # the part of the cell that slips, so that forces are continuous in the creepages
                part = ellipse * min(max((s[_PART, g, lane] - ends) * cells_x, 0.0), 1.0)
                lateral = part * (0.5 * (old_y + t_y) - s[_LAMBDA, g, lane])
                s[_SUM_X, g, lane] += part * (0.5 * (old_x + t_x) - s[_KAPPA, g, lane])
                s[_SUM_Y, g, lane] += lateral
                s[_SUM_M, g, lane] += xi * lateral


@kernel
def _block_force(
    strips: FloatArray, first: int, count: int, rolling: _Rolling, cells_x: int, weight: float, s: FloatArray
) -> tuple[float, float, float, float]:
    """F_x, F_y [N], M_z [N m] of a block of strips over pi/2 friction, and its normal force over pi/2.

    Both semi-ellipses of equation 2.45 are integrated exactly, over the whole strip and over its stick zone;
    only the slip zone's difference to them is summed over cells.
    """
    _prepare(strips, first, count, rolling, cells_x, s)
    _add_slip(count, cells_x, s)
    force_x, force_y, moment_z, total = 0.0, 0.0, 0.0, 0.0
    for row in range(count):
        g, lane = row // LANES, row % LANES
        y, length = strips[first + row, Y], strips[first + row, HALF_LENGTH]
        load = strips[first + row, WIDTH] * length * strips[first + row, PRESSURE]
        part, prime = s[_PART, g, lane], s[_PRIME, g, lane]
        slipping = part * (2.0 - part)  # 1 - (1 - part)^2, exact for little slip
        strip_x = s[_KAPPA, g, lane] * slipping + weight * s[_SUM_X, g, lane]
        strip_y = s[_LAMBDA, g, lane] - prime + prime * slipping + weight * s[_SUM_Y, g, lane]
        strip_m = weight * s[_SUM_M, g, lane] - prime * part * (1.0 - slipping)
        force_x += load * strip_x
        force_y += load * strip_y
        moment_z += load * (length * strip_m - y * strip_x)
        total += load
    return force_x, force_y, moment_z, total


@kernel
def _cell_weight(cells_x: int) -> float:
    """One over the sum of sqrt(1 - xi^2): the pressure summed over the cells of a strip is then exact."""
    total = 0.0
    for k in range(cells_x):
        xi = -1.0 + (2 * k + 1) / cells_x
        total += math.sqrt(1.0 - xi * xi)
    return 1.0 / total


@kernel
def force_on_strips(
    strips: FloatArray,
    count: int,
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
) -> tuple[float, float, float]:
    """Creep forces and spin moment of a patch of any shape (kernel: trusts its input, allocates nothing).

    Parameters
    ----------
    strips : ndarray, (n, 4)
        The patch, see `strips`; its pressure is scaled to carry `normal_force`.
    count : int
        Number of rows used.
    a, b : float
        Semi-axes of the equivalent ellipse, of the patch's area, in rolling direction and lateral [m]: for
        Kalker's coefficients, the flexibilities and FASTSIM's parabola only.
    normal_force : float
        [N], > 0.
    nu_x, nu_y : float
        Longitudinal and lateral creepage at the origin of the contact frame [-].
    phi : float
        Spin creepage [1/m].
    friction : float
        Friction coefficient [-], > 0.
    shear_modulus : float
        [Pa].
    poisson_ratio : float
        [-].
    cells_x : int
        Cells along each strip.

    Returns
    -------
    tuple of float
        F_x [N], F_y [N], M_z about the origin [N m], on the wheel.
    """
    c11, c22, c23, _ = coefficients(a / b, poisson_ratio)
    rolling = _rolling(
        a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio, c11, c22, c23
    )
    s = scratch((_ROWS, GROUPS, LANES), _STATE_SIZE)
    weight = _cell_weight(cells_x)
    force_x, force_y, moment_z, total = 0.0, 0.0, 0.0, 0.0
    for first in range(0, count, BLOCK):
        number = min(count - first, BLOCK)
        x, y, m, load = _block_force(strips, first, number, rolling, cells_x, weight, s)
        force_x, force_y, moment_z, total = force_x + x, force_y + y, moment_z + m, total + load
    if total <= 0.0:
        return 0.0, 0.0, 0.0
    scale = friction * normal_force / total
    return force_x * scale, force_y * scale, moment_z * scale


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
    """Creep forces and spin moment on the wheel; arguments as `tangential.force_kernel`."""
    c11, c22, c23, _ = coefficients(a / b, poisson_ratio)
    rolling = _rolling(
        a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio, c11, c22, c23
    )
    s = scratch((_ROWS, GROUPS, LANES), _STATE_SIZE)
    strips = scratch((BLOCK, STRIP_COLUMNS), _STRIPS_SIZE)
    weight = _cell_weight(cells_x)
    max_pressure = 1.5 * normal_force / (math.pi * a * b)
    force_x, force_y, moment_z, total = 0.0, 0.0, 0.0, 0.0
    for first in range(0, cells_y, BLOCK):
        number = min(cells_y - first, BLOCK)
        fill_ellipse(a, b, max_pressure, first, number, cells_y, strips)
        x, y, m, load = _block_force(strips, 0, number, rolling, cells_x, weight, s)
        force_x, force_y, moment_z, total = force_x + x, force_y + y, moment_z + m, total + load
    scale = friction * normal_force / total
    return force_x * scale, force_y * scale, moment_z * scale


@kernel
def _directions(
    first: int, count: int, cells_x: int, s: FloatArray, q_x: FloatArray, q_y: FloatArray
) -> None:
    """March a block of strips; fill q with the direction of traction in the cells from there (no unit vectors)."""
    step = 2.0 / cells_x
    for k in range(cells_x):
        i = cells_x - 1 - k  # from the leading edge
        node = 1.0 - (k + 1) * step
        xi = node + 0.5 * step
        bound = max(1.0 - node * node, 0.0)
        for g in range((count + LANES - 1) // LANES):
            if k < s[_FIRST, g, 0]:
                continue
            for lane in range(LANES):
                old_x, old_y = s[_T_X, g, lane], s[_T_Y, g, lane]
                traction_x, traction_y, t_x, t_y, slips = advance(
                    s[_Q_X, g, lane], s[_Q_Y, g, lane], old_x, old_y, s[_SLIPS, g, lane],
                    s[_W_X, g, lane], s[_W_Y, g, lane] + s[_SPIN, g, lane] * xi, bound,
                )  # fmt: skip
                s[_Q_X, g, lane], s[_Q_Y, g, lane] = traction_x, traction_y
                s[_T_X, g, lane], s[_T_Y, g, lane] = t_x, t_y
                s[_SLIPS, g, lane] = slips
                # where the direction turns right round within the cell, the new one counts
                s[_SUM_X, g, lane] = old_x + _MORE_THAN_ONE * t_x
                s[_SUM_Y, g, lane] = old_y + _MORE_THAN_ONE * t_y
            for lane in range(min(count - g * LANES, LANES)):
                q_x[first + g * LANES + lane, i] = s[_SUM_X, g, lane]
                q_y[first + g * LANES + lane, i] = s[_SUM_Y, g, lane]


@kernel
def _fill_strip(
    j: int,
    y: float,
    length: float,
    peak: float,
    friction: float,
    strain: tuple[float, float],
    creepages: tuple[float, float, float],
    solved: tuple[float, float, float, float, bool],
    pressure: FloatArray,
    q_x: FloatArray,
    q_y: FloatArray,
    slip_x: FloatArray,
    slip_y: FloatArray,
) -> tuple[float, float]:
    """Fill row j; return the work of slip and the power of the creepages, per area of a cell."""
    nu_x, nu_y, phi = creepages
    part, kappa, lambda_, lambda_prime, full = solved
    cells_x = pressure.shape[1]
    bound = friction * peak
    strain_x, strain_y = strain[0] * bound, strain[1] * bound
    strain_slip = math.hypot(strain_x * kappa, strain_y * lambda_prime)
    stick = (1.0 - part) ** 2
    slipping = min(math.floor(part * cells_x + 0.5), cells_x)
    rigid_x = nu_x - phi * y
    work, power = 0.0, 0.0
    for i in range(cells_x):
        xi = -1.0 + (2 * i + 1) / cells_x
        ellipse = math.sqrt(1.0 - xi * xi)
        rigid_y = nu_y + phi * length * xi
        pressure[j, i] = peak * ellipse
        if i < slipping:
            inverse = 1.0 / math.sqrt(q_x[j, i] * q_x[j, i] + q_y[j, i] * q_y[j, i])
            t_x, t_y = q_x[j, i] * inverse, q_y[j, i] * inverse
            traction_x, traction_y = bound * ellipse * t_x, bound * ellipse * t_y
            if full:
                gain = xi * (strain_x * t_x * t_x + strain_y * t_y * t_y)
                speed = min(t_x * rigid_x + t_y * rigid_y + gain, 0.0)
            else:
                speed = -strain_slip * math.sqrt(max((xi - part) ** 2 - stick, 0.0))
            slip_x[j, i], slip_y[j, i] = speed * t_x, speed * t_y
            work += bound * ellipse * speed
        else:
            root = math.sqrt(max(stick - (xi - part) ** 2, 0.0))
            traction_x = bound * kappa * (ellipse - root)
            traction_y = bound * (lambda_ * ellipse - lambda_prime * root)
            slip_x[j, i], slip_y[j, i] = 0.0, 0.0
        q_x[j, i], q_y[j, i] = traction_x, traction_y
        power += traction_x * rigid_x + traction_y * rigid_y
    return work, power


@kernel
def _fill_block(
    strips: FloatArray,
    first: int,
    row: int,
    count: int,
    rolling: _Rolling,
    creepages: tuple[float, float, float],
    friction: float,
    strain: tuple[float, float],
    s: FloatArray,
    pressure: FloatArray,
    q_x: FloatArray,
    q_y: FloatArray,
    slip_x: FloatArray,
    slip_y: FloatArray,
) -> tuple[float, float]:
    """Fill the rows from `row` with the strips from `first`; return work and power as `_fill_strip` [N]."""
    cells_x = pressure.shape[1]
    _prepare(strips, first, count, rolling, cells_x, s)
    _directions(row, count, cells_x, s, q_x, q_y)
    work, power = 0.0, 0.0
    for n in range(count):
        g, lane = n // LANES, n % LANES
        length = strips[first + n, HALF_LENGTH]
        area = strips[first + n, WIDTH] * length
        peak = strips[first + n, PRESSURE] if length > 0.0 else 0.0
        one_work, one_power = _fill_strip(
            row + n, strips[first + n, Y], length, peak, friction, strain, creepages,
            (s[_PART, g, lane], s[_KAPPA, g, lane], s[_LAMBDA, g, lane], s[_PRIME, g, lane],
             s[_FULL, g, lane] > 0.5),
            pressure, q_x, q_y, slip_x, slip_y,
        )  # fmt: skip
        work += area * one_work
        power += area * one_power
    return work, power


@kernel
def _balance(work: float, power: float, slip_x: FloatArray, slip_y: FloatArray) -> None:
    """Scale the slip so that friction dissipates the power of the creepages."""
    if work < 0.0 and power < 0.0:
        factor = power / work
        for j in range(slip_x.shape[0]):
            for i in range(slip_x.shape[1]):
                slip_x[j, i] *= factor
                slip_y[j, i] *= factor


@kernel
def field_on_strips(
    strips: FloatArray,
    count: int,
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
    """Pressure, tractions and slip in the cells of a patch of any shape (kernel, allocates nothing).

    The arguments up to `poisson_ratio` are those of `force_on_strips`, the arrays those of
    `tangential.field_kernel`: (>= count, nx), of which the first `count` rows are filled. Cell (j, i) has its
    centre at x = l_j (-1 + (2 i + 1)/nx) and the area 2 l_j width_j/nx. Empty strips get no pressure.
    """
    c11, c22, c23, _ = coefficients(a / b, poisson_ratio)
    rolling = _rolling(
        a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio, c11, c22, c23
    )
    strain = (0.5 * math.pi**2 / (shear_modulus * c11), 0.5 * math.pi**2 / (shear_modulus * c22))
    s = scratch((_ROWS, GROUPS, LANES), _STATE_SIZE)
    work, power = 0.0, 0.0
    for first in range(0, count, BLOCK):
        number = min(count - first, BLOCK)
        one_work, one_power = _fill_block(
            strips, first, first, number, rolling, (nu_x, nu_y, phi), friction, strain, s,
            pressure, q_x, q_y, slip_x, slip_y,
        )  # fmt: skip
        work, power = work + one_work, power + one_power
    _balance(work, power, slip_x[:count], slip_y[:count])


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
    cells_y = pressure.shape[0]
    c11, c22, c23, _ = coefficients(a / b, poisson_ratio)
    rolling = _rolling(
        a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio, c11, c22, c23
    )
    strain = (0.5 * math.pi**2 / (shear_modulus * c11), 0.5 * math.pi**2 / (shear_modulus * c22))
    s = scratch((_ROWS, GROUPS, LANES), _STATE_SIZE)
    strips = scratch((BLOCK, STRIP_COLUMNS), _STRIPS_SIZE)
    max_pressure = 1.5 * normal_force / (math.pi * a * b)
    work, power = 0.0, 0.0
    for first in range(0, cells_y, BLOCK):
        number = min(cells_y - first, BLOCK)
        fill_ellipse(a, b, max_pressure, first, number, cells_y, strips)
        one_work, one_power = _fill_block(
            strips, 0, first, number, rolling, (nu_x, nu_y, phi), friction, strain, s,
            pressure, q_x, q_y, slip_x, slip_y,
        )  # fmt: skip
        work, power = work + one_work, power + one_power
    _balance(work, power, slip_x, slip_y)
