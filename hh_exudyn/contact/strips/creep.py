"""Creep forces and tractions of a wheel's strips, each with its own rigid slip (kernels).

FaStrip (`tangential.fastrip`), strip by strip: the coefficients are those of the ellipse of which a strip is
a part (`shape`), the friction is the strip's own, and so is the slip. On a flat patch the longitudinal slip
falls across by the spin, nu_x - phi y; on a curved one it follows the rolling radius of every strip, and the
spin its angle. What a strip's slip differs by from that in the middle of its ellipse takes the place of
-phi y in the equations (2.43 to 2.46 of Hossein-Nia, KTH 2018), so that on a flat patch they are the same.
That difference has no mean over the strips' lengths, by which small creep forces go: so the longitudinal
force is that of the slip at the centre of load, which moves evenly with the pose, unlike the lengths at the
edges.
"""

import math
from typing import NamedTuple

from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.tangential.fastrip import (
    SLIP_COLUMNS,
    SLIPS_SIZE,
    add_cell,
    cell_weight,
    march_directions,
    strip_force,
)
from hh_exudyn.contact.tangential.fastrip_theory import set_strip
from hh_exudyn.contact.tangential.fastsim_march import begin, march_cell, single_stiffness, stiffnesses
from hh_exudyn.contact.tangential.kalker import coefficients
from hh_exudyn.contact.tangential.strips import (
    BLOCK,
    FIRST,
    HALF_LENGTH,
    LANES,
    PRESSURE,
    SHAPE,
    STATE_SIZE,
    W_X,
    WIDTH,
    scale_slip,
)
from hh_exudyn.contact.types import Fields, Memory
from hh_exudyn.kernel import inlined_kernel, kernel, memory, shaped

_XI, _THREE, _ONE = W_X, W_X + 3, W_X + 7  # rows for xi, eta, psi and the slip over three and one flexibility
_SCALED = 11  # rows
_LEAST_FRICTION = 1e-9  # against 0/0; the forces are proportional to friction itself


class _Ellipse(NamedTuple):
    """Quantities common to the strips of one ellipse, without creepage and friction."""

    xi: float  # of equation 2.43, times pressure and friction over the creepage [Pa]
    eta: float
    psi: float
    stiff_x: float  # over Kalker's three flexibilities [Pa/m]
    stiff_y: float
    stiff_phi: float
    scale: float  # of FASTSIM's rigid slip, times friction [Pa]
    size: float  # sqrt(a b) [m]


@kernel
def strip_creep_forces(
    count: int, shear_modulus: float, poisson_ratio: float, cells_x: int, state: Memory
) -> None:
    """Fill `FORCE_X`, `FORCE_Y` and `MOMENT_Z` of the strips that carry load (kernel, allocates nothing).

    Arguments: see the map of this folder; `state` with loads, shapes, creepages and friction.

    Parameters
    ----------
    shear_modulus, poisson_ratio : float
        [Pa], [-].
    cells_x : int
        Cells along each strip.
    """
    s = shaped(state, (ROWS, CAPACITY))
    march = memory(STATE_SIZE)
    weight, step = cell_weight(cells_x), 2.0 / cells_x
    first = 0
    while first < count:
        last, number = _load_block(first, count, shear_modulus, poisson_ratio, state, march)
        groups = _set_strips(number, cells_x, poisson_ratio, march)
        for cell in range(cells_x):
            node = 1.0 - (cell + 1) * step
            march_cell(cell, groups, node + 0.5 * step, max(1.0 - node * node, 0.0), march)
            add_cell(cell, cells_x, groups, march)
        number = 0
        for j in range(first, last):
            if s[Row.LOAD, j] > 0.0:
                bound = s[Row.FRICTION, j] * s[Row.LOAD, j]
                x, y, moment = strip_force(number // LANES, number % LANES, weight, march)
                s[Row.FORCE_X, j], s[Row.FORCE_Y, j] = bound * x, bound * y
                s[Row.MOMENT_Z, j] = bound * s[Row.HALF_LENGTH, j] * moment
                number += 1
        first = last


@kernel
def strip_fields(
    count: int, shear_modulus: float, poisson_ratio: float, state: Memory, fields: Fields
) -> int:
    """Pressure, tractions and slip in the cells of the strips that carry load (kernel, allocates nothing).

    The slip of all strips is scaled together so that friction dissipates the power of the creepages, as in
    `fastrip.field`.

    Parameters
    ----------
    count, shear_modulus, poisson_ratio, state
        As of `strip_creep_forces`.
    fields : Fields
        (>= loaded strips, nx) out: a row for each strip with load, in their order.

    Returns
    -------
    int
        Number of rows filled.
    """
    s = shaped(state, (ROWS, CAPACITY))
    march, slips = memory(STATE_SIZE), memory(SLIPS_SIZE)
    m, slip = shaped(march, SHAPE), shaped(slips, (BLOCK, SLIP_COLUMNS))
    cells_x = fields.pressure.shape[1]
    work, power, first, rows = 0.0, 0.0, 0, 0
    while first < count:
        last, number = _load_block(first, count, shear_modulus, poisson_ratio, state, march)
        groups = _set_strips(number, cells_x, poisson_ratio, march)
        n = 0
        for j in range(first, last):
            if s[Row.LOAD, j] > 0.0:
                c11, c22, _, _ = coefficients(s[Row.A, j] / s[Row.B, j], poisson_ratio)
                strain = 0.5 * math.pi**2 * s[Row.FRICTION, j] / shear_modulus
                slip[n, 0], slip[n, 1], slip[n, 2] = s[Row.NU_X, j], s[Row.NU_Y, j], s[Row.PHI, j]
                slip[n, 3], slip[n, 4], slip[n, 5] = s[Row.FRICTION, j], strain / c11, strain / c22
                m[WIDTH, n // LANES, n % LANES] = s[Row.WIDTH, j]
                n += 1
        lost, put_in = march_directions(rows, number, groups, slips, march, fields)
        work, power = work + lost, power + put_in
        first, rows = last, rows + number
    if work < 0.0 and power < 0.0:
        scale_slip(power / work, fields.slip_x[:rows], fields.slip_y[:rows])
    return rows


@kernel
def _load_block(
    first: int, count: int, shear_modulus: float, poisson_ratio: float, state: Memory, march: Memory
) -> tuple[int, int]:
    """Put the loaded strips from `first` on into a block, as many as it holds.

    Returns the strip behind the last one, and how many there are in the block.
    """
    s, m = shaped(state, (ROWS, CAPACITY)), shaped(march, SHAPE)
    ellipse = _Ellipse(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    number, last = 0, first
    while last < count and number < BLOCK:
        if s[Row.LOAD, last] > 0.0:
            g, lane = number // LANES, number % LANES
            m[HALF_LENGTH, g, lane], m[PRESSURE, g, lane] = s[Row.HALF_LENGTH, last], s[Row.PRESSURE, last]
            if s[Row.CENTRE, last] == 0.0 or number == 0:
                ellipse = _ellipse_of(last, shear_modulus, poisson_ratio, state)
            _scale_slip(last, g, lane, ellipse, state, march)
            number += 1
        last += 1
    return last, number


@inlined_kernel
def _ellipse_of(j: int, shear_modulus: float, poisson_ratio: float, state: Memory) -> _Ellipse:
    """The ellipse of which strip j is a part."""
    s = shaped(state, (ROWS, CAPACITY))
    a, b = s[Row.A, j], s[Row.B, j]
    c11, c22, c23, _ = coefficients(a / b, poisson_ratio)
    stiff_x, stiff_y, stiff_phi = stiffnesses(a, b, shear_modulus, c11, c22, c23)
    along = -2.0 * shear_modulus * (1.0 - poisson_ratio) / math.pi**2
    # the parabola under which the ellipse carries the load, as in `fastrip_theory.rolling_strips`
    scale = 0.75 * 2.0 * s[Row.PEAK, j] / (math.pi * a)
    if a < b:
        scale /= 1.0 + (1.0 - a / b) ** 4
    return _Ellipse(
        along * c11,
        along * c22,
        -1.5 * shear_modulus / math.pi * math.sqrt(b / a) * c23,
        stiff_x,
        stiff_y,
        stiff_phi,
        scale,
        math.sqrt(a * b),
    )


@kernel
def _set_strips(number: int, cells_x: int, poisson_ratio: float, march: Memory) -> int:
    """Solve strip theory in a block and set the march; without branches, for vectors. Groups in use."""
    m = shaped(march, SHAPE)
    groups = (number + LANES - 1) // LANES
    for n in range(number, groups * LANES):  # empty
        g, lane = n // LANES, n % LANES
        m[HALF_LENGTH, g, lane], m[PRESSURE, g, lane] = 0.0, 1.0
        for row in range(_XI, _XI + _SCALED):
            m[row, g, lane] = 0.0
    for g in range(groups):
        for lane in range(LANES):
            sticking = set_strip(
                g,
                lane,
                (m[_XI, g, lane], m[_XI + 1, g, lane], m[_XI + 2, g, lane]),
                (m[_THREE, g, lane], m[_THREE + 1, g, lane], m[_THREE + 2, g, lane], m[_THREE + 3, g, lane]),
                (m[_ONE, g, lane], m[_ONE + 1, g, lane], m[_ONE + 2, g, lane], m[_ONE + 3, g, lane]),
                poisson_ratio,
                march,
            )
            m[FIRST, g, lane] = math.floor(sticking * cells_x)
    begin(groups, cells_x, march)
    return groups


@inlined_kernel
def _scale_slip(j: int, g: int, lane: int, ellipse: _Ellipse, state: Memory, march: Memory) -> None:
    """Write the arguments of `fastrip_theory.set_strip` for strip j into rows not in use yet."""
    s, m = shaped(state, (ROWS, CAPACITY)), shaped(march, SHAPE)
    inverse = 1.0 / max(s[Row.FRICTION, j], _LEAST_FRICTION)
    mean, lateral, phi = s[Row.MEAN_X, j], s[Row.NU_Y, j], s[Row.PHI, j]
    turn = s[Row.NU_X, j] - s[Row.TURN_X, j]
    stiff = single_stiffness(
        ellipse.stiff_x, ellipse.stiff_y, ellipse.stiff_phi, mean, s[Row.MEAN_Y, j], ellipse.size * phi
    )
    m[_XI, g, lane] = inverse * (ellipse.xi * mean + ellipse.psi * turn)
    m[_XI + 1, g, lane], m[_XI + 2, g, lane] = inverse * ellipse.eta * lateral, inverse * ellipse.psi * phi
    scale = inverse * ellipse.scale
    of_phi = scale * ellipse.stiff_phi
    m[_THREE, g, lane] = scale * ellipse.stiff_x * mean
    m[_THREE + 1, g, lane] = scale * ellipse.stiff_y * lateral
    m[_THREE + 2, g, lane], m[_THREE + 3, g, lane] = of_phi * phi, of_phi * turn
    one = scale * stiff
    m[_ONE, g, lane], m[_ONE + 1, g, lane] = one * mean, one * lateral
    m[_ONE + 2, g, lane], m[_ONE + 3, g, lane] = one * phi, one * turn
