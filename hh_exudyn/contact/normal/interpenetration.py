"""The gap between undeformed wheel and rail across a contact patch, seen in the contact plane (kernels).

A non-elliptic patch is made of strips in rolling direction. They need the gap curve over the lateral
coordinate s of the contact plane, taken exactly from both profiles instead of from their curvatures at one
point: the overlap of `normal_overlap` less its largest value, so zero there and positive around it.

All is in side coordinates, so left and right wheels give the same numbers.
"""

import math
from typing import NamedTuple

from hh_exudyn.contact.geometry.normal_overlap import mean_normal
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, silhouette
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.kernel import inlined_kernel

_STEEPEST = 0.17  # cosine of 80 degrees to the contact plane: nothing further round is in the same patch


class Minimum(NamedTuple):
    """The point of largest overlap, and the quantities that the strips around it share."""

    normal: int  # a value of `normal.registry.NORMAL_THEORIES`
    y_wheel: float  # side coordinates [m]
    y_rail: float
    z_rail: float
    cosine: float  # of the contact angle
    sine: float
    depth: float  # rigid interpenetration along the normal [m]
    approach: float  # elastic approach [m]: the same less the displacement by neighbours
    curvature_x: float  # A, half the sum of the curvatures in rolling direction [1/m]
    curvature_y: float  # B, lateral
    a: float  # Hertz's patch for them [m]
    b: float
    pressure: float  # [Pa]
    shear_modulus: float  # [Pa]
    poisson_ratio: float


@inlined_kernel
def gap_curve(pair: WheelRailPair, low: Minimum, y_wheel: float) -> tuple[float, float, float]:
    """Gap and curvature at one lateral position of a contact.

    Parameters
    ----------
    pair : WheelRailPair
        Profiles and pose.
    low : Minimum
        The point of largest overlap.
    y_wheel : float
        Lateral position on the wheel profile [m].

    Returns
    -------
    s : float
        Lateral coordinate in the contact plane from that point, towards the track centre [m].
    gap : float
        Overlap along the normal, the largest less that here [m].
    curvature : float
        Half the sum of the lateral curvatures there [1/m].
        All NaN outside the profiles and where they turn away from the contact plane.
    """
    z_wheel, slope, second = spline_evaluate(pair.wheel, y_wheel)
    _, py, pz, slope_wheel = silhouette(pair, y_wheel, z_wheel, slope)
    y_rail = -pair.side * (pair.centre_y + py)
    z_rail, slope_rail, second_rail = spline_evaluate(pair.rail, y_rail)
    cosine, sine = mean_normal(slope_wheel, slope_rail)
    if not cosine * low.cosine + sine * low.sine > _STEEPEST:
        return math.nan, math.nan, math.nan
    wheel_square, rail_square = 1.0 + slope * slope, 1.0 + slope_rail * slope_rail
    return (
        (y_rail - low.y_rail) * low.cosine - (z_rail - low.z_rail) * low.sine,
        low.depth + (pair.centre_z + pz - z_rail) * cosine,
        0.5
        * (
            second / (wheel_square * math.sqrt(wheel_square))
            - second_rail / (rail_square * math.sqrt(rail_square))
        ),
    )
