"""The march of FASTSIM along the strips of a patch, all strips of a block in lock step.

J.J. Kalker, A fast algorithm for the simplified theory of rolling contact, Vehicle System Dynamics 11 (1982)
1-13; equations 2.37-2.42 of Hossein-Nia (KTH, 2018). Along a strip everything is scaled: xi = x/a(y) and
tractions by the bound in the strip's middle, so that the bound is the same in every strip, 1 - xi^2 for the
parabola. The nodes are the edges of the cells, the rigid slip is taken in their middle. Kalker's step is of
first order in the slip zone; `advance` is of second order.
"""

import math

from hh_exudyn.contact.tangential.strips import (
    BLOCK,
    BOTH_X,
    BOTH_Y,
    END_X,
    END_Y,
    FIRST,
    LANES,
    Q_X,
    Q_Y,
    ROWS,
    SHAPE,
    SLIPS,
    SPIN,
    SUM_M,
    SUM_X,
    SUM_Y,
    T_X,
    T_Y,
    W_X,
    W_Y,
)
from hh_exudyn.contact.types import Memory
from hh_exudyn.kernel import inlined_kernel, kernel, shaped

_TINY = 1e-300  # prevents 0/0
_MORE_THAN_ONE = 1.0 + 1e-12


@kernel
def stiffnesses(
    a: float, b: float, shear_modulus: float, c11: float, c22: float, c23: float
) -> tuple[float, float, float]:
    """1/L_x, 1/L_y, 1/L_phi of Kalker's three flexibilities [Pa/m], equation 2.40 (kernel).

    Parameters
    ----------
    a, b : float
        Semi-axes [m].
    shear_modulus : float
        [Pa].
    c11, c22, c23 : float
        Kalker's coefficients [-].
    """
    return (
        3.0 * shear_modulus * c11 / (8.0 * a),
        3.0 * shear_modulus * c22 / (8.0 * a),
        4.0 * shear_modulus * c23 / (math.pi * a) * math.sqrt(b / a),
    )


@inlined_kernel
def single_stiffness(
    stiff_x: float, stiff_y: float, stiff_phi: float, nu_x: float, nu_y: float, spin: float
) -> float:
    """1/L of the three flexibilities weighted by the creepages [Pa/m].

    One flexibility for all creepages, as Kalker (1982) weights the three.

    Parameters
    ----------
    stiff_x, stiff_y, stiff_phi : float
        From `stiffnesses` [Pa/m].
    nu_x, nu_y, spin : float
        Creepages, spin times sqrt(a b) [-].
    """
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
    step_x: float,
    step_y: float,
    bound: float,
) -> tuple[float, float, float, float, float]:
    """Advance the traction from one node to the next (equations 2.41, 2.42).

    Parameters
    ----------
    q_x, q_y : float
        Traction at the old node.
    t_x, t_y : float
        Its direction, a unit vector, also where it sticks.
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
    reverses, the slip is along the new direction (Kalker's own step). At the onset of slip s grows from zero,
    so that forces have no jumps in the creepages. There are no branches, so the compiler takes this step
    in several strips at once.
    """
    q_x -= step_x
    q_y -= step_y
    square = q_x * q_x + q_y * q_y
    excess = 0.5 * (square - bound * bound)
    along = bound + q_x * t_x + q_y * t_y
    sticks = excess <= 0.0
    turns = (along > 0.0) & (not sticks)
    inverse = 1.0 / (along * bound + excess if turns else math.sqrt(square + _TINY))
    ahead = along if turns else 1.0
    back = excess if turns else 0.0
    t_x = (ahead * q_x - back * t_x) * inverse
    t_y = (ahead * q_y - back * t_y) * inverse
    q_x = q_x if sticks else bound * t_x
    q_y = q_y if sticks else bound * t_y
    return q_x, q_y, t_x, t_y, 0.0 if sticks else 1.0


@kernel
def begin(groups: int, cells_x: int, state: Memory) -> None:
    """Start each group of strips at the first node that one of them needs (row `FIRST`); up to it all stick.

    Until then the traction is (xi - 1) times v = (w_x, w_y + spin (1 + xi)/2). The rows of w hold the scaled
    rigid slip, and afterwards that of one cell.

    Parameters
    ----------
    groups : int
        In use.
    cells_x : int
        Cells along each strip.
    state : memory
        Of the block, changed.
    """
    s = shaped(state, SHAPE)
    for g in range(groups):
        first = s[FIRST, g, 0]
        for lane in range(LANES):
            first = min(first, s[FIRST, g, lane])
        for lane in range(LANES):
            s[FIRST, g, lane] = first
    flat = shaped(state, (ROWS, BLOCK))
    step = 2.0 / cells_x
    for n in range(groups * LANES):
        xi = 1.0 - flat[FIRST, n] * step
        v_x, v_y = flat[W_X, n], flat[W_Y, n] + 0.5 * flat[SPIN, n] * (1.0 + xi)
        inverse = -1.0 / math.sqrt(v_x * v_x + v_y * v_y + _TINY)
        flat[T_X, n], flat[T_Y, n] = v_x * inverse, v_y * inverse
        flat[Q_X, n], flat[Q_Y, n] = (xi - 1.0) * v_x, (xi - 1.0) * v_y
        flat[W_X, n] *= step
        flat[W_Y, n] *= step
        flat[SPIN, n] *= step
        flat[SUM_X, n], flat[SUM_Y, n], flat[SUM_M, n] = 0.0, 0.0, 0.0


@kernel
def march_cell(cell: int, groups: int, xi: float, bound: float, state: Memory) -> None:
    """Advance all strips of a block by one cell (kernel).

    Parameters
    ----------
    cell : int
        Number of the cell from the leading edge.
    groups : int
        In use.
    xi, bound : float
        Scaled place of the cell's middle, and bound at its trailing node [-].
    state : memory
        At the leading node of the cell; afterwards at the trailing one.
    """
    s = shaped(state, SHAPE)
    for g in range(groups):
        if cell >= s[FIRST, g, 0]:
            for lane in range(LANES):
                old_x, old_y = s[T_X, g, lane], s[T_Y, g, lane]
                q_x, q_y, t_x, t_y, slips = advance(
                    s[Q_X, g, lane], s[Q_Y, g, lane], old_x, old_y,
                    s[W_X, g, lane], s[W_Y, g, lane] + s[SPIN, g, lane] * xi, bound,
                )  # fmt: skip
                s[Q_X, g, lane], s[Q_Y, g, lane] = q_x, q_y
                s[T_X, g, lane], s[T_Y, g, lane] = t_x, t_y
                s[SLIPS, g, lane] = slips
                # where the direction reverses, the new one is used
                s[BOTH_X, g, lane] = old_x + _MORE_THAN_ONE * t_x
                s[BOTH_Y, g, lane] = old_y + _MORE_THAN_ONE * t_y


@kernel
def last_cell(groups: int, xi: float, bound: float, elliptic: bool, state: Memory) -> None:
    """Mean traction in the cell at the trailing edge (rows `END_X`, `END_Y`); the state of the strips is not
    changed.

    The bound falls to zero there, at t = 0..1 along the cell as bound (1 - t) for the parabola and bound
    sqrt(1 - t) for the ellipse. The traction follows q + d t, with the step d of stick, until it meets the
    bound at t = m, and then the bound in the direction that it has there. With f = 1/2 or 2/3 for the bound's
    own mean, the mean is q m + d m^2/2 + f (1 - m) (q + d m): never above the bound's, without jumps in the
    creepages, and f q where the strip slips already. (A straight line from q to zero would lose half a cell
    of stick: 1/cells of the force of small creepages.)

    Parameters
    ----------
    groups : int
        In use.
    xi : float
        Middle of the cell.
    bound : float
        At its leading node.
    elliptic : bool
        The bound's shape.
    state : memory
        At that node.
    """
    s = shaped(state, SHAPE)
    square = bound * bound
    share, fall, curve = (2.0 / 3.0, 0.5 * square, 0.0) if elliptic else (0.5, square, square)
    for g in range(groups):
        for lane in range(LANES):
            q_x, q_y = s[Q_X, g, lane], s[Q_Y, g, lane]
            d_x, d_y = -s[W_X, g, lane], -s[W_Y, g, lane] - s[SPIN, g, lane] * xi
            # |q + d t|^2 = bound(t)^2, that is bend t^2 + 2 along t = room
            room = max(square - q_x * q_x - q_y * q_y, 0.0)
            along = q_x * d_x + q_y * d_y + fall
            bend = d_x * d_x + d_y * d_y - curve
            root = math.sqrt(max(along * along + bend * room, 0.0))
            forward = along > 0.0
            meets = (room if forward else root - along) / ((along + root if forward else bend) + _TINY)
            meets = min(max(meets, 0.0), 1.0)
            follows = share * (1.0 - meets)
            weight_q, weight_d = meets + follows, meets * (0.5 * meets + follows)
            s[END_X, g, lane] = weight_q * q_x + weight_d * d_x
            s[END_Y, g, lane] = weight_q * q_y + weight_d * d_y
