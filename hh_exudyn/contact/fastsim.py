"""FASTSIM: the simplified theory of rolling contact.

J.J. Kalker, A fast algorithm for the simplified theory of rolling contact, Vehicle System Dynamics 11 (1982)
1-13; equations 2.37-2.42 of Hossein-Nia (KTH, 2018). The surface yields locally, u = L q, with one
flexibility for each creepage, fitted to Kalker's coefficients; particles are followed through strips of the
ellipse from the leading edge x = +a(y), and the traction is cut at friction times a parabolic pressure.

Along a strip everything is scaled: xi = x/a(y) and tractions by the bound in the strip's middle, so that
the bound is 1 - xi^2 in every strip. The nodes are the edges of the cells, the rigid slip is taken in their
middle. Kalker's step is of first order in the slip zone; `advance` is of second order.

Two variants can be chosen: one flexibility for all creepages, the mean of the three weighted by the
creepages; and the bound friction times Hertz's elliptic pressure (better stresses in the slip zone, worse
forces: the flexibilities are fitted to the parabola).
"""

import math

from hh_exudyn.contact.kalker import coefficients
from hh_exudyn.contact.strips import (
    BLOCK,
    BOTH_X,
    BOTH_Y,
    CELL_P,
    CELL_Q_X,
    CELL_Q_Y,
    CELL_S_X,
    CELL_S_Y,
    FIRST,
    HALF_LENGTH,
    LANES,
    POWER,
    PRESSURE,
    Q_X,
    Q_Y,
    SHAPE,
    SLIPS,
    SPIN,
    STATE_SIZE,
    SUM_M,
    SUM_X,
    SUM_Y,
    T_X,
    T_Y,
    W_X,
    W_Y,
    WORK,
    Y,
    load_ellipse,
    scale_slip,
    store_cell,
)
from hh_exudyn.contact.types import FloatArray, Memory
from hh_exudyn.kernel import kernel, memory, shaped

_TINY = 1e-300  # keeps 0/0 from happening
_MORE_THAN_ONE = 1.0 + 1e-12


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
def begin(g: int, cells_x: int, slope: float, state: Memory) -> None:
    """Set a group of strips at the node where its march begins (row `FIRST`); all of it sticks until there.

    Until then the traction is (xi - 1) times v = (w_x, w_y + spin (1 + xi)/2). The rows of w hold the scaled
    rigid slip, and afterwards that of one cell. `slope` is the bound's at the leading edge, where slip begins
    at once if the rigid slip is steeper.
    """
    s = shaped(state, SHAPE)
    step = 2.0 / cells_x
    first = s[FIRST, g, 0]
    for lane in range(LANES):
        first = min(first, s[FIRST, g, lane])
    xi = 1.0 - first * step
    for lane in range(LANES):
        v_x, v_y = s[W_X, g, lane], s[W_Y, g, lane] + 0.5 * s[SPIN, g, lane] * (1.0 + xi)
        square = v_x * v_x + v_y * v_y
        inverse = -1.0 / math.sqrt(square + _TINY)
        s[T_X, g, lane], s[T_Y, g, lane] = v_x * inverse, v_y * inverse
        s[Q_X, g, lane], s[Q_Y, g, lane] = (xi - 1.0) * v_x, (xi - 1.0) * v_y
        s[SLIPS, g, lane] = 1.0 if (first == 0.0) & (square > slope * slope) else 0.0
        s[W_X, g, lane] *= step
        s[W_Y, g, lane] *= step
        s[SPIN, g, lane] *= step
        s[SUM_X, g, lane], s[SUM_Y, g, lane], s[SUM_M, g, lane] = 0.0, 0.0, 0.0
        s[FIRST, g, lane] = first


@kernel
def march_cell(cell: int, groups: int, xi: float, bound: float, state: Memory) -> None:
    """Carry all strips of a block through one cell; xi in its middle, bound at its trailing node."""
    s = shaped(state, SHAPE)
    for g in range(groups):
        if cell >= s[FIRST, g, 0]:
            for lane in range(LANES):
                old_x, old_y = s[T_X, g, lane], s[T_Y, g, lane]
                q_x, q_y, t_x, t_y, slips = advance(
                    s[Q_X, g, lane], s[Q_Y, g, lane], old_x, old_y, s[SLIPS, g, lane],
                    s[W_X, g, lane], s[W_Y, g, lane] + s[SPIN, g, lane] * xi, bound,
                )  # fmt: skip
                s[Q_X, g, lane], s[Q_Y, g, lane] = q_x, q_y
                s[T_X, g, lane], s[T_Y, g, lane] = t_x, t_y
                s[SLIPS, g, lane] = slips
                # where the direction turns right round, the new one counts
                s[BOTH_X, g, lane] = old_x + _MORE_THAN_ONE * t_x
                s[BOTH_Y, g, lane] = old_y + _MORE_THAN_ONE * t_y


@kernel
def _flexible(
    a: float,
    b: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    shear_modulus: float,
    poisson_ratio: float,
    single: bool,
) -> tuple[float, float, float, float]:
    """Rigid slip over flexibility: w_x = x - spin y, w_y = y + spin x [Pa/m, Pa/m, Pa/m^2]; the mean 1/L."""
    c11, c22, c23, _ = coefficients(a / b, poisson_ratio)
    stiff_x, stiff_y, stiff_phi = stiffnesses(a, b, shear_modulus, c11, c22, c23)
    stiff = single_stiffness(stiff_x, stiff_y, stiff_phi, nu_x, nu_y, phi, math.sqrt(a * b))
    if single:
        stiff_x, stiff_y, stiff_phi = stiff, stiff, stiff
    return stiff_x * nu_x, stiff_y * nu_y, stiff_phi * phi, stiff


@kernel
def _prepare(
    groups: int,
    w_x: float,
    w_y: float,
    spin: float,
    friction: float,
    max_pressure: float,
    elliptic: bool,
    cells_x: int,
    state: Memory,
) -> None:
    """Scale the rigid slip in a block of strips and set them at their leading edge.

    The parabola that carries the load of Hertz's pressure p has the height 4/3 p^2/p_max in a strip;
    """
    s = shaped(state, SHAPE)
    for g in range(groups):
        for lane in range(LANES):
            pressure, length = s[PRESSURE, g, lane], s[HALF_LENGTH, g, lane]
            height = pressure if elliptic else 4.0 / 3.0 * pressure * pressure / max_pressure
            factor = length / (friction * height)
            s[W_X, g, lane] = factor * (w_x - spin * s[Y, g, lane])
            s[W_Y, g, lane] = factor * w_y
            s[SPIN, g, lane] = factor * length * spin
            s[FIRST, g, lane] = 0.0
        begin(g, cells_x, math.inf if elliptic else 2.0, state)


@kernel
def _bound(node: float, elliptic: bool) -> float:
    """The bound at a node, over that in the strip's middle."""
    square = max(1.0 - node * node, 0.0)
    return math.sqrt(square) if elliptic else square


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
    single: bool,
    elliptic: bool,
    cells_x: int,
    cells_y: int,
) -> tuple[float, float, float]:
    """Creep forces and spin moment on the wheel; arguments as `tangential.force_kernel`.

    `single` takes one flexibility instead of three, `elliptic` the elliptic bound instead of the parabola.
    """
    w_x, w_y, spin, _ = _flexible(a, b, nu_x, nu_y, phi, shear_modulus, poisson_ratio, single)
    max_pressure = 1.5 * normal_force / (math.pi * a * b)
    state = memory(STATE_SIZE)
    s = shaped(state, SHAPE)
    step = 2.0 / cells_x
    force_x, force_y, moment_z, total, bounds = 0.0, 0.0, 0.0, 0.0, 0.0
    for first in range(0, cells_y, BLOCK):
        count = min(cells_y - first, BLOCK)
        groups = load_ellipse(a, b, max_pressure, first, count, cells_y, state)
        _prepare(groups, w_x, w_y, spin, friction, max_pressure, elliptic, cells_x, state)
        bounds = 0.0
        for cell in range(cells_x - 1):  # nothing at the trailing edge itself
            node = 1.0 - (cell + 1) * step
            bound = _bound(node, elliptic)
            bounds += bound
            march_cell(cell, groups, node + 0.5 * step, bound, state)
            for g in range(groups):
                for lane in range(LANES):
                    s[SUM_X, g, lane] += s[Q_X, g, lane]
                    s[SUM_Y, g, lane] += s[Q_Y, g, lane]
                    s[SUM_M, g, lane] += node * s[Q_Y, g, lane]
        for g in range(groups):
            for lane in range(LANES):
                y, length, pressure = s[Y, g, lane], s[HALF_LENGTH, g, lane], s[PRESSURE, g, lane]
                weight = length * (pressure if elliptic else pressure * pressure)
                force_x += weight * s[SUM_X, g, lane]
                force_y += weight * s[SUM_Y, g, lane]
                moment_z += weight * (length * s[SUM_M, g, lane] - y * s[SUM_X, g, lane])
                total += weight
    if bounds == 0.0:  # a single cell has no node within the patch
        return 0.0, 0.0, 0.0
    scale = friction * normal_force / (total * bounds)
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
    single: bool,
    elliptic: bool,
    pressure: FloatArray,
    q_x: FloatArray,
    q_y: FloatArray,
    slip_x: FloatArray,
    slip_y: FloatArray,
) -> None:
    """Pressure, tractions and slip over the cells; arguments as `force` and `tangential.field_kernel`.

    The traction of a cell is the mean of its nodes'. Slip is (w - dq/dx) times one flexibility for the whole
    patch, such that friction dissipates exactly the power of the creepages: sum of q.s dA = F_x nu_x +
    F_y nu_y + M phi. (With Kalker's three flexibilities the slip of stick would not vanish under spin; in
    steady rolling the elastic part does no net work: the sum of q dq over a strip's nodes telescopes.)
    """
    cells_y, cells_x = pressure.shape
    w_x, w_y, spin, stiff = _flexible(a, b, nu_x, nu_y, phi, shear_modulus, poisson_ratio, single)
    max_pressure = 1.5 * normal_force / (math.pi * a * b)
    state = memory(STATE_SIZE)
    s = shaped(state, SHAPE)
    step = 2.0 / cells_x
    work, power = 0.0, 0.0
    for first in range(0, cells_y, BLOCK):
        count = min(cells_y - first, BLOCK)
        groups = load_ellipse(a, b, max_pressure, first, count, cells_y, state)
        _prepare(groups, w_x, w_y, spin, friction, max_pressure, elliptic, cells_x, state)
        for cell in range(cells_x):
            i = cells_x - 1 - cell  # from the leading edge
            node = 1.0 - (cell + 1) * step
            xi = node + 0.5 * step
            shape = _bound(xi, elliptic)
            for g in range(groups):
                for lane in range(LANES):
                    s[CELL_Q_X, g, lane], s[CELL_Q_Y, g, lane] = s[Q_X, g, lane], s[Q_Y, g, lane]
            march_cell(cell, groups, xi, _bound(node, elliptic), state)
            for g in range(groups):
                for lane in range(LANES):
                    y, length, height = s[Y, g, lane], s[HALF_LENGTH, g, lane], s[PRESSURE, g, lane]
                    height = height if elliptic else 4.0 / 3.0 * height * height / max_pressure
                    old_x, old_y = s[CELL_Q_X, g, lane], s[CELL_Q_Y, g, lane]
                    mean_x, mean_y = 0.5 * (old_x + s[Q_X, g, lane]), 0.5 * (old_y + s[Q_Y, g, lane])
                    rate_x = s[W_X, g, lane] - (old_x - s[Q_X, g, lane])
                    rate_y = s[W_Y, g, lane] + s[SPIN, g, lane] * xi - (old_y - s[Q_Y, g, lane])
                    loss = mean_x * rate_x + mean_y * rate_y
                    # a cell in which the traction turns round sticks
                    slips = (s[SLIPS, g, lane] > 0.5) & (loss < 0.0)
                    peak = friction * height
                    unit = peak / (length * step) if slips else 0.0
                    s[CELL_P, g, lane] = shape * height
                    s[CELL_Q_X, g, lane], s[CELL_Q_Y, g, lane] = peak * mean_x, peak * mean_y
                    s[CELL_S_X, g, lane], s[CELL_S_Y, g, lane] = unit * rate_x, unit * rate_y
                    rigid = mean_x * (nu_x - phi * y) + mean_y * (nu_y + phi * length * xi)
                    s[WORK, g, lane] += length * peak * unit * loss
                    s[POWER, g, lane] += length * peak * rigid
            store_cell(first, count, i, state, pressure, q_x, q_y, slip_x, slip_y)
        for g in range(groups):
            for lane in range(LANES):
                work, power = work + s[WORK, g, lane], power + s[POWER, g, lane]
    flexibility = 1.0 / stiff
    if work < 0.0 and power < 0.0:  # a few cells under large spin may miss the sign of the power
        flexibility = power / work
    scale_slip(flexibility, slip_x, slip_y)
