"""FASTSIM: the simplified theory of rolling contact.

J.J. Kalker, A fast algorithm for the simplified theory of rolling contact, Vehicle System Dynamics 11 (1982)
1-13; equations 2.37-2.42 of Hossein-Nia (KTH, 2018). The surface deflects locally, u = L q, with one
flexibility for each creepage, fitted to Kalker's coefficients; particles are followed through strips of the
ellipse from the leading edge x = +a(y), and the traction is limited to friction times a parabolic pressure.
The march is that of `fastsim_march`.

Two variants can be chosen: one flexibility for all creepages, the mean of the three weighted by the
creepages; and the bound friction times Hertz's elliptic pressure (better stresses in the slip zone, worse
forces: the flexibilities are fitted to the parabola).
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.normal.hertz import peak_pressure
from hh_exudyn.contact.tangential.fastsim_march import (
    begin,
    last_cell,
    march_cell,
    single_stiffness,
    stiffnesses,
)
from hh_exudyn.contact.tangential.kalker import coefficients
from hh_exudyn.contact.tangential.strips import (
    BLOCK,
    END_X,
    END_Y,
    FIRST,
    HALF_LENGTH,
    LANES,
    NO_STRIPS,
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
    W_X,
    W_Y,
    WIDTH,
    Y,
    load_block,
    load_ellipse,
    scale_slip,
)
from hh_exudyn.contact.types import Fields, Memory, RollingPatch
from hh_exudyn.kernel import kernel, memory, shaped

_XI, _SHAPE, _NODE_X, _NODE_Y, _WORK, _POWER = 0, 1, 2, 3, 4, 5  # rows of a table over the cells of a strip
_TABLE_ROWS, _CELLS = 6, 64
_TABLE_WIDTH = _CELLS + 1
_TABLE_SIZE = _TABLE_ROWS * _TABLE_WIDTH


@kernel
def _flexible(patch: RollingPatch, single: bool) -> tuple[float, float, float, float]:
    """Rigid slip over flexibility: w_x = x - spin y, w_y = y + spin x [Pa/m, Pa/m, Pa/m^2]; the mean 1/L."""
    c11, c22, c23, _ = coefficients(patch.a / patch.b, patch.poisson_ratio)
    stiff_x, stiff_y, stiff_phi = stiffnesses(patch.a, patch.b, patch.shear_modulus, c11, c22, c23)
    stiff = single_stiffness(
        stiff_x, stiff_y, stiff_phi, patch.nu_x, patch.nu_y, math.sqrt(patch.a * patch.b) * patch.phi
    )
    if single:
        stiff_x, stiff_y, stiff_phi = stiff, stiff, stiff
    return stiff_x * patch.nu_x, stiff_y * patch.nu_y, stiff_phi * patch.phi, stiff


@kernel
def _prepare(
    patch: RollingPatch,
    groups: int,
    w_x: float,
    w_y: float,
    spin: float,
    elliptic: bool,
    cells_x: int,
    state: Memory,
) -> None:
    """Scale the rigid slip in a block of strips and set them at their leading edge.

    The parabola that carries the load of Hertz's pressure p has the height 4/3 p^2/p_max in a strip.
    """
    s = shaped(state, SHAPE)
    middle = peak_pressure(patch)
    for g in range(groups):
        for lane in range(LANES):
            pressure, length = s[PRESSURE, g, lane], s[HALF_LENGTH, g, lane]
            height = pressure if elliptic else 4.0 / 3.0 * pressure * pressure / middle
            factor = length / (patch.friction * height)
            s[W_X, g, lane] = factor * (w_x - spin * s[Y, g, lane])
            s[W_Y, g, lane] = factor * w_y
            s[SPIN, g, lane] = factor * length * spin
            s[FIRST, g, lane] = 0.0
    begin(groups, cells_x, state)


@kernel
def _bound(node: float, elliptic: bool) -> float:
    """The bound at a node, over that in the strip's middle."""
    square = max(1.0 - node * node, 0.0)
    return math.sqrt(square) if elliptic else square


@kernel
def force_on_strips(
    strips: FloatArray, patch: RollingPatch, single: bool, elliptic: bool, cells_x: int
) -> tuple[float, float, float]:
    """Creep forces and spin moment of a patch of any shape (kernel: trusts its input, allocates nothing).

    Parameters
    ----------
    strips : FloatArray
        (n, 4) the patch, see `strips`; its pressure is scaled to carry the normal force.
    patch : RollingPatch
        Load, creepages and the equivalent ellipse, of which the flexibilities are.
    single, elliptic, cells_x
        As of `force`.
    """
    return _force(patch, strips, False, single, elliptic, strips.shape[0], cells_x)


@kernel
def force(
    patch: RollingPatch, single: bool, elliptic: bool, cells_x: int, cells_y: int
) -> tuple[float, float, float]:
    """Creep forces and spin moment on the wheel.

    Parameters
    ----------
    patch : RollingPatch
        Size, load, creepages and material.
    single : bool
        One flexibility instead of three.
    elliptic : bool
        Elliptic bound instead of the parabola.
    cells_x, cells_y : int
        Cells along each strip, and strips.

    Returns
    -------
    tuple of float
        F_x [N], F_y [N], M_z [N m].
    """
    return _force(patch, NO_STRIPS, True, single, elliptic, cells_y, cells_x)


@kernel
def _force(
    patch: RollingPatch,
    strips: FloatArray,
    even: bool,
    single: bool,
    elliptic: bool,
    cells_y: int,
    cells_x: int,
) -> tuple[float, float, float]:
    """Forces of `cells_y` strips: those given, or even ones of the ellipse."""
    w_x, w_y, spin, _ = _flexible(patch, single)
    state = memory(STATE_SIZE)
    s = shaped(state, SHAPE)
    step = 2.0 / cells_x
    force_x, force_y, moment_z, total, bounds = 0.0, 0.0, 0.0, 0.0, 0.0
    for first in range(0, cells_y, BLOCK):
        count = min(cells_y - first, BLOCK)
        groups = load_block(patch, strips, even, (first, count, cells_y), state)
        _prepare(patch, groups, w_x, w_y, spin, elliptic, cells_x, state)
        bounds = 0.0
        for cell in range(cells_x - 1):
            node = 1.0 - (cell + 1) * step
            bound = _bound(node, elliptic)
            bounds += bound
            march_cell(cell, groups, node + 0.5 * step, bound, state)
            for g in range(groups):
                for lane in range(LANES):
                    s[SUM_X, g, lane] += s[Q_X, g, lane]
                    s[SUM_Y, g, lane] += s[Q_Y, g, lane]
                    s[SUM_M, g, lane] += node * s[Q_Y, g, lane]
        last_bound = _bound(step - 1.0, elliptic)
        last_cell(groups, 0.5 * step - 1.0, last_bound, elliptic, state)
        if elliptic:  # its mean in the last cell, 2/3 of the last node's value instead of half of it
            bounds += last_bound / 6.0
        for g in range(groups):
            for lane in range(LANES):
                # the sums over nodes hold half of the last node's traction for the last cell
                more_x = s[END_X, g, lane] - 0.5 * s[Q_X, g, lane]
                more_y = s[END_Y, g, lane] - 0.5 * s[Q_Y, g, lane]
                s[SUM_X, g, lane] += more_x
                s[SUM_Y, g, lane] += more_y
                s[SUM_M, g, lane] += (0.5 * step - 1.0) * more_y
        for g in range(groups):
            for lane in range(LANES):
                y, length, pressure = s[Y, g, lane], s[HALF_LENGTH, g, lane], s[PRESSURE, g, lane]
                weight = s[WIDTH, g, lane] * length * (pressure if elliptic else pressure * pressure)
                force_x += weight * s[SUM_X, g, lane]
                force_y += weight * s[SUM_Y, g, lane]
                moment_z += weight * (length * s[SUM_M, g, lane] - y * s[SUM_X, g, lane])
                total += weight
    if bounds == 0.0 or total == 0.0:  # a single cell has no node within the patch; strips without load
        return 0.0, 0.0, 0.0
    scale = patch.friction * patch.normal_force / (total * bounds)
    return force_x * scale, force_y * scale, moment_z * scale


@kernel
def _march_field(
    first: int,
    count: int,
    cells_x: int,
    groups: int,
    elliptic: bool,
    state: Memory,
    fields: Fields,
) -> None:
    """March a block of strips; fill q with the scaled traction at the cells' trailing nodes, slip_x with 1
    where these slip, else 0. The last cell, at the trailing edge, is filled by `_fill_rows`."""
    _, q_x, q_y, slip_x, _ = fields
    s = shaped(state, SHAPE)
    step = 2.0 / cells_x
    for cell in range(cells_x - 1):
        i = cells_x - 1 - cell  # from the leading edge
        node = 1.0 - (cell + 1) * step
        march_cell(cell, groups, node + 0.5 * step, _bound(node, elliptic), state)
        for g in range(groups):
            for lane in range(min(LANES, count - g * LANES)):
                j = first + g * LANES + lane
                q_x[j, i], q_y[j, i], slip_x[j, i] = s[Q_X, g, lane], s[Q_Y, g, lane], s[SLIPS, g, lane]
    last_cell(groups, 0.5 * step - 1.0, _bound(step - 1.0, elliptic), elliptic, state)


@kernel
def _trailing_slip(
    mean_x: float, mean_y: float, w_x: float, w_y: float, old_x: float, old_y: float
) -> tuple[float, float, float]:
    """Slip of a cell in which the traction falls from `old` to zero, all scaled to the cell; its work.

    The work of the traction q on the slip w - dq is that of the mean traction on w, minus |old|^2/2. The slip
    returned does this work with the mean traction: in a cell that sticks at first it is less than the total
    slip, most of which occurs where the traction is already small.
    """
    rate_x, rate_y = w_x - old_x, w_y - old_y
    loss = mean_x * w_x + mean_y * w_y - 0.5 * (old_x * old_x + old_y * old_y)
    product = mean_x * rate_x + mean_y * rate_y
    slips = (loss < 0.0) & (product < 0.0)  # a cell in which the traction reverses sticks
    share = loss / (product if slips else 1.0) if slips else 0.0
    return share * rate_x, share * rate_y, loss if slips else 0.0


@kernel
def _fill_rows(
    patch: RollingPatch, first: int, count: int, elliptic: bool, state: Memory, fields: Fields
) -> tuple[float, float]:
    """Fill the rows of a block, slip still over the flexibility; its work and the power of the creepages."""
    pressure, q_x, q_y, slip_x, slip_y = fields
    nu_x, nu_y, phi = patch.nu_x, patch.nu_y, patch.phi
    middle = peak_pressure(patch)
    cells_x = pressure.shape[1]
    step = 2.0 / cells_x
    s = shaped(state, SHAPE)
    table = shaped(memory(_TABLE_SIZE), (_TABLE_ROWS, _TABLE_WIDTH))
    work, power = 0.0, 0.0
    for start in range(0, cells_x, _CELLS):
        number = min(cells_x - start, _CELLS)
        for c in range(number):
            xi = (2 * (start + c) + 1) / cells_x - 1.0
            table[_XI, c], table[_SHAPE, c] = xi, _bound(xi, elliptic)
            table[_WORK, c], table[_POWER, c] = 0.0, 0.0
        for row in range(count):
            j, g, lane = first + row, row // LANES, row % LANES
            length, height = s[HALF_LENGTH, g, lane], s[PRESSURE, g, lane]
            height = height if elliptic else 4.0 / 3.0 * height * height / middle
            peak = patch.friction * height
            unit = peak / (length * step)
            w_x, w_y, spin = s[W_X, g, lane], s[W_Y, g, lane], s[SPIN, g, lane]
            rigid_x, turn = nu_x - phi * s[Y, g, lane], phi * length
            inner = 0
            if start == 0:  # the cell at the trailing edge
                inner = 1
                i = np.uint64(1)
                old_x, old_y = (q_x[j, i], q_y[j, i]) if cells_x > 1 else (0.0, 0.0)
                xi, mean_x, mean_y = table[_XI, 0], s[END_X, g, lane], s[END_Y, g, lane]
                rate_x, rate_y, loss = _trailing_slip(mean_x, mean_y, w_x, w_y + spin * xi, old_x, old_y)
                pressure[j, 0] = height * table[_SHAPE, 0]
                q_x[j, 0], q_y[j, 0] = peak * mean_x, peak * mean_y
                slip_x[j, 0], slip_y[j, 0] = unit * rate_x, unit * rate_y
                work += length * peak * unit * loss
                power += length * peak * (mean_x * rigid_x + mean_y * (nu_y + turn * xi))
            for c in range(inner, number):
                i = np.uint64(start + c)
                table[_NODE_X, c], table[_NODE_Y, c] = q_x[j, i], q_y[j, i]
            ends = start + number == cells_x  # no traction at the leading edge
            table[_NODE_X, number] = 0.0 if ends else q_x[j, start + number]
            table[_NODE_Y, number] = 0.0 if ends else q_y[j, start + number]
            for c in range(inner, number):
                i = np.uint64(start + c)
                xi = table[_XI, c]
                new_x, new_y = table[_NODE_X, c], table[_NODE_Y, c]
                old_x, old_y = table[_NODE_X, c + 1], table[_NODE_Y, c + 1]
                mean_x, mean_y = 0.5 * (old_x + new_x), 0.5 * (old_y + new_y)
                rate_x, rate_y = w_x - (old_x - new_x), w_y + spin * xi - (old_y - new_y)
                loss = mean_x * rate_x + mean_y * rate_y
                # a cell in which the traction reverses sticks
                rate = unit if (slip_x[j, i] > 0.5) & (loss < 0.0) else 0.0
                pressure[j, i] = height * table[_SHAPE, c]
                q_x[j, i], q_y[j, i] = peak * mean_x, peak * mean_y
                slip_x[j, i], slip_y[j, i] = rate * rate_x, rate * rate_y
                table[_WORK, c] += length * peak * rate * loss
                table[_POWER, c] += length * peak * (mean_x * rigid_x + mean_y * (nu_y + turn * xi))
        for c in range(number):
            work, power = work + table[_WORK, c], power + table[_POWER, c]
    return work, power


@kernel
def field(patch: RollingPatch, single: bool, elliptic: bool, fields: Fields) -> None:
    """Pressure, tractions and slip over the cells; arguments as `force`.

    The traction of a cell is the mean of its nodes', at the trailing edge that of `last_cell`. Slip is
    (w - dq/dx) times one flexibility for the whole patch, such that friction dissipates exactly the power of
    the creepages: sum of q.s dA = F_x nu_x + F_y nu_y + M phi. (With Kalker's three flexibilities the slip of
    stick would not vanish under spin; in steady rolling the elastic part does no net work: the sum of q dq
    over a strip's nodes telescopes.)
    """
    cells_y, cells_x = fields.pressure.shape
    w_x, w_y, spin, stiff = _flexible(patch, single)
    state = memory(STATE_SIZE)
    work, power = 0.0, 0.0
    for first in range(0, cells_y, BLOCK):
        count = min(cells_y - first, BLOCK)
        groups = load_ellipse(patch, first, count, cells_y, state)
        _prepare(patch, groups, w_x, w_y, spin, elliptic, cells_x, state)
        _march_field(first, count, cells_x, groups, elliptic, state, fields)
        lost, put_in = _fill_rows(patch, first, count, elliptic, state, fields)
        work, power = work + lost, power + put_in
    flexibility = 1.0 / stiff
    if work < 0.0 and power < 0.0:  # with few cells and large spin the sign of the power may be wrong
        flexibility = power / work
    scale_slip(flexibility, fields.slip_x, fields.slip_y)
