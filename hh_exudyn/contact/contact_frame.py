"""The contact frame C: where the surface of the rail points at a contact (kernels).

x of C lies along the rail's surface, C is R rolled about x by side * contact angle, z is the normal from the
rail into the wheel. R is the frame of the rail at the wheelset's arc length; at a contact ahead of the axle,
or on a twisting or changing rail, the surface runs otherwise by fractions of a milliradian, and C with it:
else a wheel in a curve or on a ramp would seem to sink into its rail or to leave it.
"""

import math

from hh_exudyn.contact.geometry.silhouette import WheelRailPair
from hh_exudyn.contact.types import Triple
from hh_exudyn.kernel import inlined_kernel


@inlined_kernel
def turn_of_rail(pair: WheelRailPair, point: Triple, turn: Triple) -> tuple[float, float]:
    """Heading and slope of the rail's surface at a contact, against its frame R (kernel).

    Parameters
    ----------
    pair : WheelRailPair
        The wheelset's pose.
    point : tuple of float
        The contact from the wheelset's centre, axes of R [m].
    turn : tuple of float
        Rotation of R per metre along the track (`types.RailMotion`) [rad/m].

    Returns
    -------
    tuple of float
        Tangents of both angles [-]; R turns along the track, so they are those of a cross product. Where the
        profile of the rail changes, the slope of its surface (`rail_tables.surface_slope`) comes on top.
    """
    dx, dy, dz = point[0], pair.centre_y + point[1], pair.centre_z + point[2]
    heading = turn[2] * dx - turn[0] * dz
    return heading, turn[0] * dy - turn[1] * dx


@inlined_kernel
def axes_of(cosine: float, sine: float, heading: float, slope: float) -> tuple[Triple, Triple, Triple]:
    """Unit vectors along x, y and z of C, in axes of R, to the third order of the rail's turn.

    Parameters
    ----------
    cosine, sine : float
        Of the contact angle times the side.
    heading, slope : float
        From `turn_of_rail` [-].
    """
    ch, ct = 1.0 - 0.5 * heading * heading, 1.0 - 0.5 * slope * slope
    sh, st = ch * heading, ct * slope
    return (
        (ch * ct, sh * ct, st),
        (-cosine * sh - sine * ch * st, cosine * ch - sine * sh * st, sine * ct),
        (sine * sh - cosine * ch * st, -sine * ch - cosine * sh * st, cosine * ct),
    )


@inlined_kernel
def moved_ahead(
    pair: WheelRailPair, y_wheel: float, slope_wheel: float, point: Triple, heading: float, slope: float
) -> float:
    """How far a circle of the wheel touches ahead of `point` where its rail is turned, along x of R [m].

    With the point of the unturned rail the normal would miss the axle, and turn the wheelset about it.
    Equation 1 of `silhouette` in axes of the turned rail, to the first order of its turn.

    Parameters
    ----------
    pair : WheelRailPair
        Wheel and pose.
    y_wheel, slope_wheel : float
        Place and slope on the wheel profile [m], [-].
    point : tuple of float
        Where it touches an unturned rail, from the wheelset's centre, axes of R [m].
    heading, slope : float
        From `turn_of_rail` [-].
    """
    t = pair.side * (pair.distance - y_wheel)
    radial_y, radial_z = point[1] - t * pair.axle_y, point[2] - t * pair.axle_z
    steepness = pair.side * slope_wheel * math.sqrt(radial_y * radial_y + radial_z * radial_z)
    return heading * (steepness * pair.axle_y - radial_y) + slope * (steepness * pair.axle_z - radial_z)
