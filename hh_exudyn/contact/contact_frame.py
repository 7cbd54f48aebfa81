"""The contact frame C: where the surface of the rail points at a contact (kernels).

x of C lies along the rail's surface, C is R rolled about x by side * contact angle, z is the normal from the
rail into the wheel. R is the frame of the rail at the wheelset's arc length; at a contact ahead of the axle, or
on a twisting or changing rail, the surface runs otherwise by fractions of a milliradian, and C with it: else a
wheel in a curve or on a ramp would seem to sink into its rail or to leave it.
"""

import math

from hh_exudyn.contact.geometry.rail_tables import surface_slope
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, silhouette
from hh_exudyn.contact.types import RailMotion, RailTables, Triple
from hh_exudyn.kernel import inlined_kernel


@inlined_kernel
def turn_of_rail(
    pair: WheelRailPair, along: RailTables, point: Triple, y_rail: float, rails: RailMotion, i: int
) -> tuple[float, float]:
    """Heading and slope of the rail's surface at a contact, against its frame R (kernel).

    Parameters
    ----------
    pair : WheelRailPair
        The wheelset's pose.
    along : RailTables
        Of this side.
    point : tuple of float
        The contact from the wheelset's centre, axes of R [m].
    y_rail : float
        Its place on the rail profile [m].
    rails : RailMotion
        Of all wheelsets.
    i : int
        Number of the wheelset.

    Returns
    -------
    tuple of float
        Tangents of both angles [-]; R turns along the track, so they are those of a cross product.
    """
    dx, dy, dz = point[0], pair.centre_y + point[1], pair.centre_z + point[2]
    heading = rails.turn[i, 2] * dx - rails.turn[i, 0] * dz
    slope = rails.turn[i, 0] * dy - rails.turn[i, 1] * dx
    return heading, slope + surface_slope(along, rails.arc_length[i], y_rail)


@inlined_kernel
def axes_of(cosine: float, sine: float, heading: float, slope: float) -> tuple[Triple, Triple, Triple]:
    """Unit vectors along x, y and z of C, in axes of R.

    Parameters
    ----------
    cosine, sine : float
        Of the contact angle times the side.
    heading, slope : float
        From `turn_of_rail` [-].
    """
    if heading == 0.0 and slope == 0.0:
        return (1.0, 0.0, 0.0), (0.0, cosine, sine), (0.0, -sine, cosine)
    ch, ct = 1.0 / math.sqrt(1.0 + heading * heading), 1.0 / math.sqrt(1.0 + slope * slope)
    sh, st = ch * heading, ct * slope
    return (
        (ch * ct, sh * ct, st),
        (-cosine * sh - sine * ch * st, cosine * ch - sine * sh * st, sine * ct),
        (sine * sh - cosine * ch * st, -sine * ch - cosine * sh * st, cosine * ct),
    )


@inlined_kernel
def point_on_turned_rail(
    pair: WheelRailPair, y_wheel: float, z: float, slope_wheel: float, heading: float, slope: float
) -> Triple:
    """Where a circle of the wheel touches a rail turned in heading and slope, in axes of R.

    With the point of the unturned rail the normal would miss the axle, and turn the wheelset about it.

    Parameters
    ----------
    pair : WheelRailPair
        Wheel and pose.
    y_wheel, z, slope_wheel : float
        Place, height and slope on the wheel profile [m], [m], [-].
    heading, slope : float
        From `turn_of_rail` [-].
    """
    ch, ct = 1.0 / math.sqrt(1.0 + heading * heading), 1.0 / math.sqrt(1.0 + slope * slope)
    sh, st = ch * heading, ct * slope
    lx, ly, lz = pair.axle_x, pair.axle_y, pair.axle_z
    level = ch * lx + sh * ly
    across, up = ch * ly - sh * lx, ct * lz - st * level
    ahead = ct * level + st * lz
    inverse = 1.0 / (1.0 - ahead * ahead)
    turned = WheelRailPair(
        pair.wheel,
        pair.rail,
        pair.side,
        pair.distance,
        pair.nominal_radius,
        pair.centre_y,
        pair.centre_z,
        ahead,
        across,
        up,
        ahead * ahead * inverse,
        math.sqrt(inverse),
    )
    x, y, z, _ = silhouette(turned, y_wheel, z, slope_wheel)
    level = ct * x - st * z
    return ch * level - sh * y, sh * level + ch * y, st * x + ct * z
