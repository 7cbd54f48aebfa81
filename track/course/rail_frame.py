"""The frame of one rail at every arc length: its position and direction in the track frame (kernel).

R is the track frame T turned so that its x axis is the tangent of this rail. The rail's line in T is

    r = (0, Y, Z),    Y = alignment + y cos(roll),    Z = level + y sin(roll),                          (1)

with y = +-(half the gauge + distance of the profile's origin from the gauge point), left positive, and the
roll of the sleeper by the cross-level, which both rails share (for a wheelset a cross-level is cant, not a
change of the rails' inclination). T itself turns by the vector w per metre of arc length: the tangent is

    dr/ds = (ahead, 0, 0) + w x (0, Y, Z) + (0, dY/ds, dZ/ds).                                          (2)

In a circular curve of constant cant, gauge and gradient R is parallel to T; on ramps of cant and gauge and on
irregularities it is not. Only the direction follows from (2): the rail's material is at rest.
"""

import math
from typing import NamedTuple

from hh_exudyn.arrays import FloatArray
from hh_exudyn.conventions import RAIL_TOP_DISTANCE
from hh_exudyn.kernel import inlined_kernel
from track.course.frame import TrackTurn
from track.irregularity.table import IrregularityState


class RailShift(NamedTuple):
    """Deflection of a rail below a wheel, and its slopes along the track under the same load."""

    lateral: float  # to the left [m]
    vertical: float  # up [m]
    heading: float  # slope of the deflected rail's material to the left, per metre of track [-]
    slope: float  # the same, up [-]


@inlined_kernel
def rail_frame(
    turn: TrackTurn,
    half_width: float,
    side: float,
    irregular: IrregularityState,
    shift: RailShift,
    position: FloatArray,
    rotation: FloatArray,
) -> float:
    """Write position and direction of a rail; returns its rotation about its own axis per metre [rad/m].

    Parameters
    ----------
    turn : TrackTurn
        Of the track frame there.
    half_width : float
        From the track's middle to the origin of the rail's profile without irregularity [m].
    side : float
        +1 left, -1 right.
    irregular : IrregularityState
        The four irregularities and their slopes.
    shift : RailShift
        Elastic deflection.
    position : (2,) array
        Written: y and z of the origin of R in T [m].
    rotation : (3, 3) array
        Written: R to T.
    """
    sine = -irregular.cross_level / RAIL_TOP_DISTANCE  # of the sleeper's roll: the right rail higher, as cant
    cosine = math.sqrt(1.0 - sine * sine)
    roll_rate = -irregular.cross_level_slope / (RAIL_TOP_DISTANCE * cosine)
    y = side * (half_width + 0.5 * irregular.gauge)
    y_slope = 0.5 * side * (turn.gauge + irregular.gauge_slope)
    lateral = irregular.alignment + y * cosine + shift.lateral
    vertical = irregular.level + y * sine + shift.vertical
    position[0] = lateral
    position[1] = vertical
    ahead = turn.ahead + turn.pitch * vertical - turn.yaw * lateral  # equation 2
    left = irregular.alignment_slope + y_slope * cosine - y * sine * roll_rate + shift.heading
    left -= turn.twist * vertical
    up = irregular.level_slope + y_slope * sine + y * cosine * roll_rate + shift.slope
    up += turn.twist * lateral
    in_plan = math.sqrt(ahead * ahead + left * left)
    length = math.sqrt(in_plan * in_plan + up * up)
    ch, sh = ahead / in_plan, left / in_plan  # of the heading, then of the slope, then of the roll
    cp, sp = in_plan / length, -up / length
    rotation[0, 0], rotation[0, 1] = ch * cp, ch * sp * sine - sh * cosine
    rotation[0, 2] = ch * sp * cosine + sh * sine
    rotation[1, 0], rotation[1, 1] = sh * cp, sh * sp * sine + ch * cosine
    rotation[1, 2] = sh * sp * cosine - ch * sine
    rotation[2, 0], rotation[2, 1], rotation[2, 2] = -sp, cp * sine, cp * cosine
    return turn.twist + roll_rate
