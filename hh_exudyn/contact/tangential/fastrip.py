"""FaStrip: strip theory with Kalker's coefficients, and directions of slip from FASTSIM.

M.Sh. Sichani, R. Enblom, M. Berg, An alternative to FASTSIM for tangential solution of the wheel-rail
contact, Vehicle System Dynamics 54 (2016) 748-764; equations 2.43-2.46 of Hossein-Nia (KTH, 2018),
corrected. In each strip the leading part sticks with the tractions of strip theory; behind it |q| =
friction * pressure, in the direction that FASTSIM gives. A patch may have any shape (`strips`).

Notes
-----
Publications differ in two points. Measured here over 185 exact cases and five exact stress fields
(hh_exudyn/data/validation; forces on 20 x 20 cells, error of the force vector in % of mu N; L1 error of |q|
on 50 x 50 cells in %, mean of the fields):

    kappa, lambda   a strip slips as a whole if it        force error            |q|
    made with       has no stick zone, or             mean   95 %   largest      L1
    D               |psi| >= 1                        1.18    3.5     24.3       4.4
    D               its leading cell breaks Coulomb   1.01    3.1      5.5       4.4
    D               its stick zone breaks Coulomb     1.01    3.1      5.5       4.4   (used here)
    D               (no further rule)                 1.03    3.1      5.5       4.4   (|q| up to 1.09 mu p)
    d/a             |psi| >= 1                        2.85    6.9     24.3       8.8
    d/a             its stick zone breaks Coulomb     2.73    6.8      9.5       8.8

Coulomb's law in the stick zone, tightest at the leading edge, can fail for |psi| > 1 only; its limit there
needs no cell. Three choices of our own: D is written (xi^2 + eta^2)/(root - eta psi), the same as equation
2.44 and finite at |psi| = 1; FASTSIM's single flexibility, for strips in full slip, is blended in with the
fourth power of the share of the strip that slips (1.01 against 1.06 % in the mean with a switch); and for
|psi| > 1 the stick zone is reduced before it would break Coulomb's law (no change in the figures above). With
the last two the forces have no jumps in the creepages; switches cause jumps of 2.5 % of mu N on 15 x 15
cells.
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.tangential.fastrip_theory import Rolling, prepare, rolling_strips
from hh_exudyn.contact.tangential.fastsim_march import march_cell
from hh_exudyn.contact.tangential.strips import (
    BLOCK,
    BOTH_X,
    BOTH_Y,
    FIRST,
    FULL,
    HALF_LENGTH,
    KAPPA,
    LAMBDA,
    LANES,
    NO_STRIPS,
    PART,
    PRESSURE,
    PRIME,
    SHAPE,
    STATE_SIZE,
    SUM_M,
    SUM_X,
    SUM_Y,
    WIDTH,
    Y,
    load_block,
    scale_slip,
)
from hh_exudyn.contact.types import Fields, Memory, RollingPatch, Triple
from hh_exudyn.kernel import inlined_kernel, kernel, memory, shaped

_TINY = 1e-300  # prevents 0/0; far below every square that occurs [-]
_XI, _ELLIPSE, _WORK, _POWER = 0, 1, 2, 3  # rows of a table over the cells of a strip
_TABLE_ROWS, _CELLS = 4, 64
_TABLE_SIZE = _TABLE_ROWS * _CELLS
SLIP_COLUMNS = 6  # of a strip's slip and material, see `march_directions`
SLIPS_SIZE = BLOCK * SLIP_COLUMNS


@kernel
def add_cell(cell: int, cells_x: int, groups: int, state: Memory) -> None:
    """Add a cell to the strips' sums of sqrt(1 - xi^2) (t - (kappa, lambda)) over their slip zones."""
    s = shaped(state, SHAPE)
    xi = 1.0 - (2 * cell + 1) / cells_x
    ellipse = math.sqrt(1.0 - xi * xi)
    ends = cells_x - (cell + 1.0)
    for g in range(groups):
        if cell >= s[FIRST, g, 0]:
            for lane in range(LANES):
                # the part of the cell that slips, so that forces are continuous in the creepages
                part = ellipse * min(max(s[PART, g, lane] * cells_x - ends, 0.0), 1.0)
                lateral = part * (0.5 * s[BOTH_Y, g, lane] - s[LAMBDA, g, lane])
                s[SUM_X, g, lane] += part * (0.5 * s[BOTH_X, g, lane] - s[KAPPA, g, lane])
                s[SUM_Y, g, lane] += lateral
                s[SUM_M, g, lane] += xi * lateral


@inlined_kernel
def strip_force(g: int, lane: int, weight: float, state: Memory) -> Triple:
    """Forces of one strip over mu N, and its spin moment over that times the half length, after the march."""
    s = shaped(state, SHAPE)
    part, prime = s[PART, g, lane], s[PRIME, g, lane]
    slipping = part * (2.0 - part)  # 1 - (1 - part)^2, exact for little slip
    return (
        s[KAPPA, g, lane] * slipping + weight * s[SUM_X, g, lane],
        s[LAMBDA, g, lane] - prime + prime * slipping + weight * s[SUM_Y, g, lane],
        weight * s[SUM_M, g, lane] - prime * part * (1.0 - slipping),
    )


@kernel
def _block_force(
    groups: int, rolling: Rolling, cells_x: int, weight: float, state: Memory
) -> tuple[float, float, float, float]:
    """F_x, F_y [N], M_z [N m] of a block of strips over pi/2 friction, and its normal force over pi/2.

    Both semi-ellipses of equation 2.45 are integrated exactly, over the whole strip and over its stick zone;
    only the slip zone's difference to them is summed over cells.
    """
    prepare(groups, rolling, cells_x, state)
    step = 2.0 / cells_x
    for cell in range(cells_x):
        node = 1.0 - (cell + 1) * step
        march_cell(cell, groups, node + 0.5 * step, max(1.0 - node * node, 0.0), state)
        add_cell(cell, cells_x, groups, state)
    s = shaped(state, SHAPE)
    force_x, force_y, moment_z, total = 0.0, 0.0, 0.0, 0.0
    for g in range(groups):
        for lane in range(LANES):
            length = s[HALF_LENGTH, g, lane]
            load = s[WIDTH, g, lane] * length * s[PRESSURE, g, lane]
            strip_x, strip_y, strip_m = strip_force(g, lane, weight, state)
            force_x += load * strip_x
            force_y += load * strip_y
            moment_z += load * (length * strip_m - s[Y, g, lane] * strip_x)
            total += load
    return force_x, force_y, moment_z, total


@kernel
def cell_weight(cells_x: int) -> float:
    """1 / sum of sqrt(1 - xi^2), which makes the pressure summed over the cells of a strip exact."""
    inverse = 1.0 / cells_x
    total = 0.0
    for cell in range(cells_x // 2):
        xi = 1.0 - (2 * cell + 1) * inverse
        total += math.sqrt(1.0 - xi * xi)
    return 1.0 / (2.0 * total + cells_x % 2)  # the middle cell of an odd number


@kernel
def _force(
    patch: RollingPatch, strips: FloatArray, elliptic: bool, count: int, cells_x: int
) -> tuple[float, float, float]:
    """Creep forces and spin moment of `count` strips; zero where no strip carries load."""
    rolling = rolling_strips(patch)
    state = memory(STATE_SIZE)
    weight = cell_weight(cells_x)
    force_x, force_y, moment_z, total = 0.0, 0.0, 0.0, 0.0
    for first in range(0, count, BLOCK):
        number = min(count - first, BLOCK)
        groups = load_block(patch, strips, elliptic, (first, number, count), state)
        x, y, m, load = _block_force(groups, rolling, cells_x, weight, state)
        force_x, force_y, moment_z, total = force_x + x, force_y + y, moment_z + m, total + load
    if total <= 0.0:
        return 0.0, 0.0, 0.0
    scale = patch.friction * patch.normal_force / total
    return force_x * scale, force_y * scale, moment_z * scale


@kernel
def force_on_strips(
    strips: FloatArray, count: int, patch: RollingPatch, cells_x: int
) -> tuple[float, float, float]:
    """Creep forces and spin moment of a patch of any shape (kernel: trusts its input, allocates nothing).

    Parameters
    ----------
    strips : ndarray, (n, 4)
        The patch, see `strips`; its pressure is scaled to carry the normal force.
    count : int
        Number of rows used.
    patch : RollingPatch
        Load, creepages and the equivalent ellipse.
    cells_x : int
        Cells along each strip.

    Returns
    -------
    tuple of float
        F_x [N], F_y [N], M_z about the origin [N m], on the wheel.
    """
    return _force(patch, strips, False, count, cells_x)


@kernel
def force(patch: RollingPatch, cells_x: int, cells_y: int) -> tuple[float, float, float]:
    """Creep forces and spin moment on the wheel.

    Parameters
    ----------
    patch : RollingPatch
        Size, load, creepages and material.
    cells_x, cells_y : int
        Cells along each strip, and strips.
    """
    return _force(patch, NO_STRIPS, True, cells_y, cells_x)


@kernel
def _directions(first: int, count: int, cells_x: int, groups: int, state: Memory, fields: Fields) -> None:
    """March a block of strips; where they slip, fill q with directions of traction (of any length)."""
    q_x, q_y = fields.q_x, fields.q_y
    s = shaped(state, SHAPE)
    step = 2.0 / cells_x
    for cell in range(cells_x):
        i = cells_x - 1 - cell  # from the leading edge
        node = 1.0 - (cell + 1) * step
        march_cell(cell, groups, node + 0.5 * step, max(1.0 - node * node, 0.0), state)
        for g in range(groups):
            if cell >= s[FIRST, g, 0]:
                row = first + g * LANES
                for lane in range(min(LANES, count - g * LANES)):
                    q_x[row + lane, i], q_y[row + lane, i] = s[BOTH_X, g, lane], s[BOTH_Y, g, lane]


@kernel
def march_directions(
    first: int, count: int, groups: int, slips: Memory, state: Memory, fields: Fields
) -> tuple[float, float]:
    """Fill the rows of a block of strips that is prepared for the march (kernel, allocates nothing).

    The caller scales the slip of all blocks together, by their power over their work.

    Parameters
    ----------
    first, count, groups : int
        Row of the first strip, strips and groups of the block.
    slips : memory
        (BLOCK, SLIP_COLUMNS): of every strip the longitudinal and lateral rigid slip in its middle [-], spin
        [1/m], friction [-], and the strains of its surface over the pressure, along and across [1/Pa].
    state : memory
        Of the block.
    fields : Fields
        (>= first + count, nx) out.

    Returns
    -------
    tuple of float
        Work of the slip and power of the creepages, per distance rolled [N].
    """
    cells_x = fields.pressure.shape[1]
    _directions(first, count, cells_x, groups, state, fields)
    return _fill_rows(first, count, slips, state, fields)


@kernel
def _fill_rows(first: int, count: int, slips: Memory, state: Memory, fields: Fields) -> tuple[float, float]:
    """Fill the rows of a block, several cells at once; work of slip and power of the creepages [N]."""
    pressure, q_x, q_y, slip_x, slip_y = fields
    slip = shaped(slips, (BLOCK, SLIP_COLUMNS))
    cells_x = pressure.shape[1]
    s = shaped(state, SHAPE)
    table = shaped(memory(_TABLE_SIZE), (_TABLE_ROWS, _CELLS))
    work, power = 0.0, 0.0
    for start in range(0, cells_x, _CELLS):
        number = min(cells_x - start, _CELLS)
        for c in range(number):
            xi = (2 * (start + c) + 1) / cells_x - 1.0
            table[_XI, c], table[_ELLIPSE, c] = xi, math.sqrt(1.0 - xi * xi)
            table[_WORK, c], table[_POWER, c] = 0.0, 0.0
        for row in range(count):
            j, g, lane = first + row, row // LANES, row % LANES
            length, part = s[HALF_LENGTH, g, lane], s[PART, g, lane]
            peak = s[PRESSURE, g, lane] if length > 0.0 else 0.0
            area = s[WIDTH, g, lane] * length
            rigid_x, nu_y, turn = slip[row, 0], slip[row, 1], slip[row, 2] * length
            bound = slip[row, 3] * peak
            kappa, lambda_, prime = s[KAPPA, g, lane], s[LAMBDA, g, lane], s[PRIME, g, lane]
            strain_x, strain_y = slip[row, 4] * peak, slip[row, 5] * peak
            strain = math.sqrt((strain_x * kappa) ** 2 + (strain_y * prime) ** 2)
            stick = (1.0 - part) ** 2
            full = s[FULL, g, lane] > 0.5
            slipping = min(max(math.floor(part * cells_x + 0.5) - start, 0), number)
            for c in range(slipping):
                i = np.uint64(start + c)
                xi, ellipse = table[_XI, c], table[_ELLIPSE, c]
                t_x, t_y = q_x[j, i], q_y[j, i]
                inverse = 1.0 / math.sqrt(t_x * t_x + t_y * t_y + _TINY)
                t_x, t_y = t_x * inverse, t_y * inverse
                rigid = t_x * rigid_x + t_y * (nu_y + turn * xi)
                if full:
                    speed = min(rigid + xi * (strain_x * t_x * t_x + strain_y * t_y * t_y), 0.0)
                else:
                    speed = -strain * math.sqrt(max((xi - part) ** 2 - stick, 0.0))
                traction = bound * ellipse
                pressure[j, i] = peak * ellipse
                q_x[j, i], q_y[j, i] = traction * t_x, traction * t_y
                slip_x[j, i], slip_y[j, i] = speed * t_x, speed * t_y
                table[_WORK, c] += area * traction * speed
                table[_POWER, c] += area * traction * rigid
            for n in range(number - slipping):
                c = slipping + n
                i = np.uint64(start + c)
                xi, ellipse = table[_XI, np.uint64(c)], table[_ELLIPSE, np.uint64(c)]
                root = math.sqrt(max(stick - (xi - part) ** 2, 0.0))
                traction_x = bound * kappa * (ellipse - root)
                traction_y = bound * (lambda_ * ellipse - prime * root)
                pressure[j, i] = peak * ellipse
                q_x[j, i], q_y[j, i] = traction_x, traction_y
                slip_x[j, i], slip_y[j, i] = 0.0, 0.0
                rigid = traction_x * rigid_x + traction_y * (nu_y + turn * xi)
                table[_POWER, np.uint64(c)] += area * rigid
        for c in range(number):
            work, power = work + table[_WORK, c], power + table[_POWER, c]
    return work, power


@kernel
def _fields(patch: RollingPatch, strips: FloatArray, elliptic: bool, count: int, fields: Fields) -> None:
    """Fill the first `count` rows, and scale the slip of them all (see `field`)."""
    cells_x = fields.pressure.shape[1]
    rolling = rolling_strips(patch)
    state, slips = memory(STATE_SIZE), memory(SLIPS_SIZE)
    work, power = 0.0, 0.0
    for first in range(0, count, BLOCK):
        number = min(count - first, BLOCK)
        groups = load_block(patch, strips, elliptic, (first, number, count), state)
        prepare(groups, rolling, cells_x, state)
        s, slip = shaped(state, SHAPE), shaped(slips, (BLOCK, SLIP_COLUMNS))
        for row in range(number):
            slip[row, 0] = patch.nu_x - patch.phi * s[Y, row // LANES, row % LANES]
            slip[row, 1], slip[row, 2], slip[row, 3] = patch.nu_y, patch.phi, patch.friction
            slip[row, 4], slip[row, 5] = rolling.strain_x, rolling.strain_y
        lost, put_in = march_directions(first, number, groups, slips, state, fields)
        work, power = work + lost, power + put_in
    if work < 0.0 and power < 0.0:
        scale_slip(power / work, fields.slip_x[:count], fields.slip_y[:count])


@kernel
def field_on_strips(strips: FloatArray, count: int, patch: RollingPatch, fields: Fields) -> None:
    """Pressure, tractions and slip in the cells of a patch of any shape (kernel, allocates nothing).

    Arguments as `force_on_strips`; of the arrays (>= count, nx) the first `count` rows are filled. Cell
    (j, i) has its centre at x = l_j (-1 + (2 i + 1)/nx) and the area 2 l_j width_j/nx. Empty strips have no
    pressure.
    """
    _fields(patch, strips, False, count, fields)


@kernel
def field(patch: RollingPatch, fields: Fields) -> None:
    """Pressure, tractions and slip over the cells.

    Slip is that of strip theory: rigid slip less the surface's own strain, zero in stick; its direction is
    opposite to the traction. Kalker's coefficients make the two strains differ a little from the rigid slip
    in stick, so the slip of the whole patch is scaled (by 0.93..1.0 in the five exact fields) to make
    friction dissipate the power of the creepages: sum of q.s dA = F_x nu_x + F_y nu_y + M phi. L1 error
    of |s| in the five exact fields, in %, with and without the scale, and that of FASTSIM: one creepage
    9.2, 9.2, 48; tread 25, 25, 65; spin 21, 26, 48; lateral creepage and spin 21, 22, 28; flange 14, 14, 23.

    Parameters
    ----------
    patch : RollingPatch
        Size, load, creepages and material.
    fields : Fields
        Arrays (ny, nx) of the grid of `tangential.api`: pressure and tractions [Pa], slip over V [-];
        result.
    """
    _fields(patch, NO_STRIPS, True, fields.pressure.shape[0], fields)
