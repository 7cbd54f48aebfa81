"""FASTSIM: the simplified theory of rolling contact.

J.J. Kalker, A fast algorithm for the simplified theory of rolling contact, Vehicle System Dynamics 11 (1982)
1-13; equations 2.37-2.42 of Hossein-Nia (KTH, 2018). The surface yields locally, u = L q, with one
flexibility for each creepage, fitted to Kalker's coefficients; particles are followed through strips of the
ellipse from the leading edge x = +a(y), and the traction is cut at friction times a parabolic pressure.

Along a strip everything is scaled: xi = x/a(y) and tractions by the bound in the strip's middle, so that
the bound is 1 - xi^2 in every strip. The nodes are the edges of the cells, the rigid slip is taken in their
middle. Kalker's step is of first order in the slip zone; `advance` is of second order.
"""

import math

from hh_exudyn.contact.kalker import coefficients
from hh_exudyn.contact.types import FloatArray
from hh_exudyn.kernel import kernel

_TINY = 1e-300  # keeps 0/0 from happening


@kernel
def stiffnesses(
    a: float, b: float, shear_modulus: float, c11: float, c22: float, c23: float
) -> tuple[float, float, float]:
    """1/L_x, 1/L_y, 1/L_phi of Kalker's three flexibilities [Pa/m], equation 2.40."""
    return (
        3.0 * shear_modulus * c11 / (8.0 * a),
        3.0 * shear_modulus * c22 / (8.0 * a),
        4.0 * shear_modulus * c23 / (math.pi * a) * math.sqrt(b / a),
    )


@kernel
def single_stiffness(
    stiff_x: float, stiff_y: float, stiff_phi: float, nu_x: float, nu_y: float, phi: float, size: float
) -> float:
    """1/L of the three flexibilities weighted by the creepages, size = sqrt(a b) [Pa/m]."""
    spin = size * phi
    weighted = abs(nu_x) / stiff_x + abs(nu_y) / stiff_y + abs(spin) / stiff_phi
    if weighted == 0.0:
        return stiff_x
    return math.sqrt(nu_x * nu_x + nu_y * nu_y + spin * spin) / weighted


@kernel
def start(w_x: float, w_y: float) -> tuple[float, float, float]:
    """Direction of the traction at the leading edge, and whether it slips there.

    w is the scaled rigid slip there; the bound rises with slope 2 from the leading edge.
    """
    square = w_x * w_x + w_y * w_y
    if square == 0.0:
        return 0.0, 0.0, 0.0
    factor = -1.0 / math.sqrt(square)
    return w_x * factor, w_y * factor, 1.0 if square > 4.0 else 0.0


@kernel
def advance(
    q_x: float,
    q_y: float,
    t_x: float,
    t_y: float,
    slips: float,
    step_x: float,
    step_y: float,
    bound: float,
) -> tuple[float, float, float, float, float]:
    """Carry the traction from one node to the next (equations 2.41, 2.42).

    Parameters
    ----------
    q_x, q_y : float
        Traction at the old node.
    t_x, t_y : float
        Its direction, a unit vector.
    slips : float
        1 where the old node slips, else 0.
    step_x, step_y : float
        Rigid slip over flexibility in the middle of the cell, times the cell's length.
    bound : float
        Traction bound at the new node.

    Returns
    -------
    tuple
        Traction, its direction, and whether the new node slips (1 or 0).

    Notes
    -----
    q_new = q_trial - s (t_old + t_new)/2 with |q_new| = bound: slip along the mean direction. The length
    follows without a root, s = (|q_trial|^2 - bound^2)/(bound + q_trial . t_old). Where the trial traction
    turns right round, or slip begins, the slip is along the new direction (Kalker's own step). No branches:
    the compiler takes this step in several strips at once.
    """
    q_x -= step_x
    q_y -= step_y
    square = q_x * q_x + q_y * q_y
    excess = 0.5 * (square - bound * bound)
    along = bound + q_x * t_x + q_y * t_y
    sticks = excess <= 0.0
    turns = (slips > 0.5) & (along > 0.0) & (not sticks)
    inverse = 1.0 / (along * bound + excess if turns else math.sqrt(square + _TINY))
    ahead = along if turns else 1.0
    back = excess if turns else 0.0
    t_x = (ahead * q_x - back * t_x) * inverse
    t_y = (ahead * q_y - back * t_y) * inverse
    q_x = q_x if sticks else bound * t_x
    q_y = q_y if sticks else bound * t_y
    return q_x, q_y, t_x, t_y, 0.0 if sticks else 1.0


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
    stiff_x, stiff_y, stiff_phi = stiffnesses(a, b, shear_modulus, c11, c22, c23)
    step = 2.0 / cells_x
    scale = 0.5 * math.pi * a * a * b / (friction * normal_force) * step
    force_x, force_y, moment_z, total = 0.0, 0.0, 0.0, 0.0
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        y = b * lateral
        cosine = math.sqrt(1.0 - lateral * lateral)
        step_x = scale / cosine * (nu_x * stiff_x - phi * y * stiff_phi)
        step_y = scale / cosine * nu_y * stiff_y
        spin = scale * a * phi * stiff_phi
        t_x, t_y, slips = start(step_x / step, (step_y + spin) / step)
        q_x, q_y, sum_x, sum_y, sum_moment = 0.0, 0.0, 0.0, 0.0, 0.0
        for k in range(1, cells_x):
            node = 1.0 - k * step
            q_x, q_y, t_x, t_y, slips = advance(
                q_x, q_y, t_x, t_y, slips,
                step_x, step_y + spin * (node + 0.5 * step), 1.0 - node * node,
            )  # fmt: skip
            sum_x += q_x
            sum_y += q_y
            sum_moment += node * q_y
        weight = cosine**3  # length of the strip times its bound
        force_x += weight * sum_x
        force_y += weight * sum_y
        moment_z += weight * (a * cosine * sum_moment - y * sum_x)
        total += weight
    # the sum of the bound over all nodes is friction * normal force
    scale = friction * normal_force / (total * 2.0 / 3.0 * (cells_x - 1.0 / cells_x))
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

    The traction of a cell is the mean of its nodes'. Slip is (w - dq/dx) times one flexibility for the whole
    patch, such that friction dissipates exactly the power of the creepages: sum of q.s dA = F_x nu_x +
    F_y nu_y + M phi. (With Kalker's three flexibilities the slip of stick would not vanish under spin; in
    steady rolling the elastic part does no net work: the sum of q dq over a strip's nodes telescopes.)
    """
    cells_y, cells_x = pressure.shape
    c11, c22, c23, _ = coefficients(a / b, poisson_ratio)
    stiff_x, stiff_y, stiff_phi = stiffnesses(a, b, shear_modulus, c11, c22, c23)
    peak = 2.0 * normal_force / (math.pi * a * b)
    work, power = 0.0, 0.0
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        y = b * lateral
        strip_peak = peak * (1.0 - lateral * lateral)
        half_length = a * math.sqrt(1.0 - lateral * lateral)
        step = 2.0 * half_length / cells_x
        w_x = nu_x * stiff_x - phi * y * stiff_phi
        w_y = nu_y * stiff_y
        edge = half_length / (friction * strip_peak)
        t_x, t_y, slips = start(w_x * edge, (w_y + phi * half_length * stiff_phi) * edge)
        old_x, old_y = 0.0, 0.0
        for k in range(cells_x):
            i = cells_x - 1 - k  # from the leading edge
            xi = 1.0 - (2 * k + 1) / cells_x
            node = 1.0 - 2.0 * (k + 1) / cells_x
            x = half_length * xi
            w_y = nu_y * stiff_y + phi * x * stiff_phi
            new_x, new_y, t_x, t_y, slips = advance(
                old_x, old_y, t_x, t_y, slips,
                w_x * step, w_y * step, friction * strip_peak * max(1.0 - node * node, 0.0),
            )  # fmt: skip
            mean_x, mean_y = 0.5 * (old_x + new_x), 0.5 * (old_y + new_y)
            rate_x, rate_y = 0.0, 0.0
            if slips > 0.5:
                rate_x = w_x - (old_x - new_x) / step
                rate_y = w_y - (old_y - new_y) / step
                if mean_x * rate_x + mean_y * rate_y > 0.0:  # a cell in which the traction turns round sticks
                    rate_x, rate_y = 0.0, 0.0
            pressure[j, i] = strip_peak * (1.0 - xi * xi)
            q_x[j, i], q_y[j, i] = mean_x, mean_y
            slip_x[j, i], slip_y[j, i] = rate_x, rate_y
            work += step * (mean_x * rate_x + mean_y * rate_y)
            power += step * (mean_x * (nu_x - phi * y) + mean_y * (nu_y + phi * x))
            old_x, old_y = new_x, new_y
    flexibility = 1.0 / single_stiffness(stiff_x, stiff_y, stiff_phi, nu_x, nu_y, phi, math.sqrt(a * b))
    if work < 0.0 and power < 0.0:  # a few cells under large spin may miss the sign of the power
        flexibility = power / work
    for j in range(cells_y):
        for i in range(cells_x):
            slip_x[j, i] *= flexibility
            slip_y[j, i] *= flexibility
