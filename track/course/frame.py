"""The track frame at every arc length, and the arc length of a point (kernels).

T is pitched with the gradient: `inclined_frame`, `inclined_rotation` and `inclined_locate` belong together.
`track_frame` gives the same frame without the pitch, for computations in plan.
"""

import math
from typing import NamedTuple

from hh_exudyn.arrays import FloatArray
from hh_exudyn.conventions import RAIL_TOP_DISTANCE
from hh_exudyn.kernel import inlined_kernel, kernel
from track.course.types import AlignmentTable, Node

_NEWTON_STEPS = 20  # of `inclined_locate`; two or three are used from a guess some metres away
_GAUSS_OFFSET = 0.5 * math.sqrt(0.6)  # of the outer points of three, from the middle of 0 to 1
_GAUSS_OUTER = 5.0 / 18.0
_GAUSS_MIDDLE = 8.0 / 18.0


@inlined_kernel
def turn_in_cell(node: FloatArray, u: float) -> float:
    """Heading [rad] at u metres beyond a node, less the node's: the integral of the cubic curvature.

    Parameters
    ----------
    node : (len(Node),) row of the alignment table
    u : distance from the node [m]
    """
    c, d = node[Node.CURVATURE_2] * (1.0 / 3.0), node[Node.CURVATURE_3] * 0.25  # divisions are slow
    return u * (node[Node.CURVATURE] + u * (node[Node.CURVATURE_1] * 0.5 + u * (c + u * d)))


@inlined_kernel
def _cos_sin(turn: float) -> tuple[float, float]:
    """Cosine and sine of a small angle by their series, below 1e-16 for 0.02 rad."""
    square = turn * turn
    return (
        1.0 + square * (-0.5 + square * ((1.0 / 24.0) - square * (1.0 / 720.0))),
        turn * (1.0 + square * ((-1.0 / 6.0) + square * ((1.0 / 120.0) - square * (1.0 / 5040.0)))),
    )


@inlined_kernel
def shift_in_cell(node: FloatArray, u: float) -> tuple[float, float]:
    """Displacement forward and to the left [m], in the node's heading, from a node to u metres beyond it.

    The integrals of cos and sin of the turn by Gauss' three points: exact for terms up to u^5, so that the
    remainder is below 1e-12 m for u <= 2 m (radii of 100 m and more).

    Parameters
    ----------
    node : (len(Node),) row of the alignment table
    u : distance from the node [m]
    """
    c1, s1 = _cos_sin(turn_in_cell(node, u * (0.5 - _GAUSS_OFFSET)))
    c2, s2 = _cos_sin(turn_in_cell(node, u * 0.5))
    c3, s3 = _cos_sin(turn_in_cell(node, u * (0.5 + _GAUSS_OFFSET)))
    ahead = u * (_GAUSS_OUTER * (c1 + c3) + _GAUSS_MIDDLE * c2)
    aside = u * (_GAUSS_OUTER * (s1 + s3) + _GAUSS_MIDDLE * s2)
    return ahead, aside


@inlined_kernel
def rise_in_cell(node: FloatArray, u: float) -> float:
    """Height [m] at u metres beyond a node, less the node's: the integral of the cubic gradient.

    Arguments as in `turn_in_cell`.
    """
    c, d = node[Node.GRADIENT_2] * (1.0 / 3.0), node[Node.GRADIENT_3] * 0.25
    return u * (node[Node.GRADIENT] + u * (node[Node.GRADIENT_1] * 0.5 + u * (c + u * d)))


@inlined_kernel
def _cell(table: AlignmentTable, s: float) -> int:
    """Node at or before s, -1 where s is NaN or outside the table."""
    if not (table.start <= s <= table.end):
        return -1
    i = table.cell[int((s - table.start) / table.step)]
    last = table.nodes.shape[0] - 2
    while i < last and s >= table.nodes[i + 1, Node.S]:
        i += 1
    return i


@inlined_kernel
def _centre(node: FloatArray, u: float) -> tuple[float, float, float, float]:
    """Position x, y [m], turn since the node [rad] and curvature [1/m] of the centre line."""
    ahead, aside = shift_in_cell(node, u)
    x = node[Node.X] + node[Node.FORWARD_X] * ahead - node[Node.FORWARD_Y] * aside
    y = node[Node.Y] + node[Node.FORWARD_Y] * ahead + node[Node.FORWARD_X] * aside
    curvature = node[Node.CURVATURE] + u * (
        node[Node.CURVATURE_1] + u * (node[Node.CURVATURE_2] + u * node[Node.CURVATURE_3])
    )
    return x, y, turn_in_cell(node, u), curvature


@inlined_kernel
def _gradient(node: FloatArray, u: float) -> float:
    """Gradient dz/ds [-] at u metres beyond a node."""
    return node[Node.GRADIENT] + u * (
        node[Node.GRADIENT_1] + u * (node[Node.GRADIENT_2] + u * node[Node.GRADIENT_3])
    )


@kernel
def track_frame(table: AlignmentTable, s: float) -> tuple[float, float, float, float, float, float, float]:
    """The track frame T at arc length s.

    Returns x, y, z [m] of its origin (centre line, running plane; global frame), heading about Z [rad], roll
    about the forward axis [rad] (negative in a canted left-hand curve: the right rail is higher), curvature
    in plan [1/m], gauge [m]. All NaN outside the table. The pitch and the rotation T to global: see
    `inclined_frame`.

    Parameters
    ----------
    table : of the alignment
    s : arc length in plan [m]
    """
    i = _cell(table, s)
    if i < 0:
        return math.nan, math.nan, math.nan, math.nan, math.nan, math.nan, math.nan
    node = table.nodes[i]
    u = s - node[Node.S]
    x, y, turn, curvature = _centre(node, u)
    z = node[Node.Z] + rise_in_cell(node, u)
    cant = node[Node.CANT] + u * (node[Node.CANT_1] + u * (node[Node.CANT_2] + u * node[Node.CANT_3]))
    gauge = node[Node.GAUGE] + u * (node[Node.GAUGE_1] + u * (node[Node.GAUGE_2] + u * node[Node.GAUGE_3]))
    roll = -math.asin(cant / RAIL_TOP_DISTANCE)  # cant is the height difference over 1.5 m, EN 13848-1
    return x, y, z, node[Node.HEADING] + turn, roll, curvature, gauge


@kernel
def inclined_frame(
    table: AlignmentTable, s: float
) -> tuple[float, float, float, float, float, float, float, float]:
    """The track frame T at arc length s, pitched with the gradient.

    Returns x, y, z, heading, pitch, roll, curvature, gauge: as `track_frame`, and the pitch about T's y axis
    [rad], negative uphill. All NaN outside the table. The rotation T to global is
    `inclined_rotation(heading, pitch, roll)`.

    Parameters
    ----------
    table : of the alignment
    s : arc length in plan [m]
    """
    x, y, z, heading, roll, curvature, gauge = track_frame(table, s)
    i = _cell(table, s)
    pitch = math.nan
    if i >= 0:
        pitch = -math.atan(_gradient(table.nodes[i], s - table.nodes[i, Node.S]))
    return x, y, z, heading, pitch, roll, curvature, gauge


class TrackTurn(NamedTuple):
    """Translation and rotation of the track frame T per metre of arc length in plan, in the axes of T."""

    ahead: float  # translation along x [-]
    twist: float  # rotation about x [rad/m]
    pitch: float  # about y [rad/m]
    yaw: float  # about z [rad/m]
    gauge: float  # widening of the gauge [-]


@inlined_kernel
def track_turn(table: AlignmentTable, s: float, pitch: float, roll: float) -> TrackTurn:
    """Rotation of T per metre at arc length s, where `inclined_frame` gives this pitch and roll [rad].

    With T = Rz(heading) Ry(pitch) Rx(roll) its rotation per metre is Rx^T (Ry^T (0, 0, heading') +
    (0, pitch', 0)) + (roll', 0, 0) in its own axes. NaN outside the table.

    Parameters
    ----------
    table : of the alignment
    s : arc length in plan [m]
    pitch, roll : of T there, from `inclined_frame` [rad]
    """
    i = _cell(table, s)
    if i < 0:
        return TrackTurn(math.nan, math.nan, math.nan, math.nan, math.nan)
    node = table.nodes[i]
    u = s - node[Node.S]
    curvature = node[Node.CURVATURE] + u * (
        node[Node.CURVATURE_1] + u * (node[Node.CURVATURE_2] + u * node[Node.CURVATURE_3])
    )
    cant_rate = node[Node.CANT_1] + u * (2.0 * node[Node.CANT_2] + 3.0 * u * node[Node.CANT_3])
    gauge_rate = node[Node.GAUGE_1] + u * (2.0 * node[Node.GAUGE_2] + 3.0 * u * node[Node.GAUGE_3])
    bend = node[Node.GRADIENT_1] + u * (2.0 * node[Node.GRADIENT_2] + 3.0 * u * node[Node.GRADIENT_3])
    cp, sp = math.cos(pitch), math.sin(pitch)
    cr, sr = math.cos(roll), math.sin(roll)
    roll_rate = -cant_rate / (RAIL_TOP_DISTANCE * cr)
    pitch_rate = -bend * cp * cp
    across, up = pitch_rate, cp * curvature
    return TrackTurn(
        1.0 / cp, roll_rate - sp * curvature, cr * across + sr * up, cr * up - sr * across, gauge_rate
    )


@kernel
def inclined_rotation(heading: float, pitch: float, roll: float, out: FloatArray) -> None:
    """Write the rotation matrix T to global, Rz(heading) Ry(pitch) Rx(roll), into `out` (3, 3).

    Parameters
    ----------
    heading, pitch, roll : of T [rad]
    out : (3, 3) result
    """
    ch = math.cos(heading)
    sh = math.sin(heading)
    cp = math.cos(pitch)
    sp = math.sin(pitch)
    cr = math.cos(roll)
    sr = math.sin(roll)
    out[0, 0], out[0, 1], out[0, 2] = ch * cp, ch * sp * sr - sh * cr, ch * sp * cr + sh * sr
    out[1, 0], out[1, 1], out[1, 2] = sh * cp, sh * sp * sr + ch * cr, sh * sp * cr - ch * sr
    out[2, 0], out[2, 1], out[2, 2] = -sp, cp * sr, cp * cr


@kernel
def inclined_locate(table: AlignmentTable, x: float, y: float, z: float, s_guess: float) -> float:
    """Arc length [m] of the frame T, pitched with the gradient, in which the point (x, y, z) has x = 0.

    The foot of the perpendicular on the centre line; without the height a point 2 m above a track with
    10 per mille would be missed by 20 mm. Newton's method from `s_guess`, exact to 1e-10 m. NaN where the
    foot lies outside the table or Newton fails (point near the centre of the curve).

    Parameters
    ----------
    table : of the alignment
    x, y, z : the point, global frame [m]
    s_guess : first guess of the arc length [m]
    """
    s = s_guess
    for _ in range(_NEWTON_STEPS):
        i = _cell(table, s)
        if i < 0:
            return math.nan
        node = table.nodes[i]
        u = s - node[Node.S]
        forward, aside, curvature = _seen_from(node, u, x, y)
        above = z - node[Node.Z] - rise_in_cell(node, u)
        gradient = _gradient(node, u)
        bend = node[Node.GRADIENT_1] + u * (2.0 * node[Node.GRADIENT_2] + 3.0 * u * node[Node.GRADIENT_3])
        # (point - origin) . dr/ds = 0 with dr/ds = (forward, gradient); its derivative by s below
        step = (forward + gradient * above) / (1.0 - curvature * aside + gradient * gradient - bend * above)
        s += step
        if abs(step) < 1e-5:  # converges quadratically: the error left is far below 1e-10 m
            return s if table.start <= s <= table.end else math.nan
    return math.nan


@inlined_kernel
def _seen_from(node: FloatArray, u: float, x: float, y: float) -> tuple[float, float, float]:
    """Coordinates of a point in plan, forward and left of the centre line [m], and curvature there [1/m]."""
    x0, y0, turn, curvature = _centre(node, u)
    ct, st = _cos_sin(turn)
    c = node[Node.FORWARD_X] * ct - node[Node.FORWARD_Y] * st
    n = node[Node.FORWARD_Y] * ct + node[Node.FORWARD_X] * st
    return c * (x - x0) + n * (y - y0), c * (y - y0) - n * (x - x0), curvature
