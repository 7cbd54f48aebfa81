"""Where a wheel can touch a prismatic rail: the exact contact locus of a surface of revolution (kernels).

The wheel is a surface of revolution, the rail a prism along the x axis of its frame R. A point of the wheel
can only touch where its normal has no x component. On the circle of radius R at the axial coordinate t, with
R' = dR/dt, the outward normal is along e - R' l (l axle direction, e radial unit vector), so that

    e.x = R' l.x                                                                                     (1)

which fixes e (its lower branch): a flange touches ahead of the axle when the wheelset has an angle of attack.
Over the lateral coordinate these points are the wheel's silhouette, its slope is dz/dy = -n.y/n.z of the
same normal. The vertical gap between silhouette and rail has its local minima just where their slopes are
equal: there a rigid wheel touches. Where it overlaps the rail, `normal_overlap` says how far.
"""

import math
from typing import NamedTuple

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.types import SplineTable
from hh_exudyn.kernel import inlined_kernel

_DEEPEST = 0.05  # m, radius of a flange tip less that of the running circle, at most
_MORE = 1e-3  # m, for the cosine of roll and yaw


class WheelRailPair(NamedTuple):
    """One wheel above its rail: profiles and pose."""

    wheel: SplineTable
    rail: SplineTable
    side: float  # +1 left, -1 right
    distance: float  # half the lateral distance of the running circles [m]
    nominal_radius: float  # wheel radius at the running circle [m]
    centre_y: float  # wheelset centre from the origin of the rail profile, axes of the rail's frame R [m]
    centre_z: float
    axle_x: float  # unit vector of the wheelset's +y axis in R
    axle_y: float
    axle_z: float
    # of the axle's direction, as equation 1 needs them
    ratio: float  # lx^2 / (1 - lx^2)
    root: float  # 1 / sqrt(1 - lx^2)


@inlined_kernel
def wheel_rail_pair(
    wheel: SplineTable,
    rail: SplineTable,
    side: float,
    distance: float,
    nominal_radius: float,
    centre: FloatArray,
    axle: FloatArray,
) -> WheelRailPair:
    """A `WheelRailPair` from the vectors `centre` and `axle`, (3,) each, in the rail's frame R."""
    inverse = 1.0 / (1.0 - axle[0] * axle[0])
    return WheelRailPair(
        wheel,
        rail,
        side,
        distance,
        nominal_radius,
        centre[1],
        centre[2],
        axle[0],
        axle[1],
        axle[2],
        axle[0] * axle[0] * inverse,
        math.sqrt(inverse),
    )


@inlined_kernel
def silhouette(
    pair: WheelRailPair, y_wheel: float, z: float, slope: float
) -> tuple[float, float, float, float]:
    """The point of a wheel's circle that can touch a prismatic rail (equation 1).

    Parameters
    ----------
    pair : WheelRailPair
        Wheel and pose.
    y_wheel, z, slope : float
        Position, height and slope of the wheel profile [m], [m], [-].

    Returns
    -------
    x, y, z : float
        The point from the wheelset's centre, axes of R [m].
    slope : float
        Slope dz/dy of the silhouette in side coordinates [-]. NaN where no point satisfies equation 1.
    """
    lx, ly, lz = pair.axle_x, pair.axle_y, pair.axle_z
    t = pair.side * (pair.distance - y_wheel)
    steepness = pair.side * slope  # R' = dR/dt, as R = r0 - z and t = side (d - y)
    ratio = pair.ratio
    down = pair.root * math.sqrt(1.0 - steepness * steepness * ratio)
    ex = steepness * lx  # equation 1; e is a unit vector normal to l
    ey = down * lz - steepness * ratio * ly
    ez = -down * ly - steepness * ratio * lz
    radius = pair.nominal_radius - z
    normal_y = ey - steepness * ly
    normal_z = ez - steepness * lz
    return t * lx + radius * ex, t * ly + radius * ey, t * lz + radius * ez, pair.side * normal_y / normal_z


@inlined_kernel
def silhouette_rates(pair: WheelRailPair, z: float, slope: float, second: float) -> tuple[float, float]:
    """How the silhouette runs along the wheel profile.

    Parameters
    ----------
    pair : WheelRailPair
        Wheel and pose.
    z, slope, second : float
        Height and derivatives of the wheel profile [m], [-], [1/m].

    Returns
    -------
    lateral : float
        Derivative of the silhouette's lateral place over that on the profile [-], 1 where the wheelset
        neither yaws nor rolls.
    turn : float
        Derivative of the silhouette's slope angle over the place on the profile [1/m].
    """
    ly, lz = pair.axle_y, pair.axle_z
    steepness = pair.side * slope
    square = 1.0 + slope * slope
    root = math.sqrt(1.0 - steepness * steepness * pair.ratio)
    inverse = 1.0 / (square * root)
    ey = pair.root * root * lz - steepness * pair.ratio * ly
    bend = pair.ratio * second * (ly + lz * pair.root * steepness * square * inverse)
    return ly + steepness * ey + (pair.nominal_radius - z) * bend, second * pair.root * inverse


@inlined_kernel
def above_rail(pair: WheelRailPair) -> tuple[float, float]:
    """Between which places of the wheel profile it may lie above the rail's table, within millimetres [m]."""
    middle = -pair.side * pair.centre_y - pair.distance * pair.axle_y
    middle -= pair.side * pair.nominal_radius * pair.root * pair.axle_z  # about y of the running circle
    # of the slopes up to 5, and of the radius, which this estimate has left out
    margin = 5.0 * pair.nominal_radius * pair.ratio + _DEEPEST * abs(pair.axle_z) + _MORE
    end = pair.rail.start + pair.rail.step * (pair.rail.z.size - 1)
    return pair.rail.start - middle - margin, end - middle + margin


@inlined_kernel
def gap_at(pair: WheelRailPair, y_wheel: float) -> tuple[float, float, float, float, float]:
    """Vertical gap between silhouette and rail at a point of the wheel profile.

    Returns
    -------
    gap : float
        Negative for interpenetration [m]; NaN (like the rest) outside the profiles.
    difference : float
        Slope of the silhouette less slope of the rail: zero where the gap has an extremum [-].
    y_rail, rail_slope, rail_second : float
        Position on the rail profile and its derivatives there.
    """
    z, slope, _ = spline_evaluate(pair.wheel, y_wheel)
    _, py, pz, slope_wheel = silhouette(pair, y_wheel, z, slope)
    y_rail = -pair.side * (pair.centre_y + py)
    z_rail, slope_rail, second_rail = spline_evaluate(pair.rail, y_rail)
    return pair.centre_z + pz - z_rail, slope_wheel - slope_rail, y_rail, slope_rail, second_rail
