"""A wheel above its rail, from profiles and the pose of the wheelset, on straight rigid track."""

import math

import numpy as np

from hh_exudyn.contact.geometry.silhouette import WheelRailPair, wheel_rail_pair
from hh_exudyn.contact.profile import Profile, gauge_point
from hh_exudyn.contact.profiles.spline import spline_table
from hh_exudyn.conventions import BACK_TO_BACK, FLANGE_BACK_TO_RUNNING_CIRCLE, LEFT, NOMINAL_GAUGE, RIGHT


def wheel_above_rail(
    wheel: Profile,
    rail: Profile,
    side: int,
    *,
    lateral: float,
    height: float,
    radius: float,
    yaw: float = 0.0,
    roll: float = 0.0,
    gauge: float = NOMINAL_GAUGE,
    back_to_back: float = BACK_TO_BACK,
    smoothing: float = 0.25e-3,
) -> WheelRailPair:
    """The pair of a wheel and its rail in the pose of a wheelset.

    Eleven arguments: two profiles, the side, and the numbers of a pose by keyword.

    Parameters
    ----------
    wheel, rail : Profile
        The rail includes its inclination.
    side : int
        `LEFT` or `RIGHT`.
    lateral, height : float
        Of the wheelset's centre, to the left of the track's and above the running plane [m].
    radius : float
        At the running circle [m].
    yaw, roll : float
        Right-hand about z (up) and x (forward) [rad].
    gauge, back_to_back : float
        Of the rails, 14 mm below the running plane, and of the flange backs [m].
    smoothing : float
        Of the profiles' curvature (`profiles.spline.spline_table`) [m].

    Raises
    ------
    ValueError
        For an unknown side, a profile of the wrong kind, or a pose that is not finite.
    """
    if side not in (LEFT, RIGHT):
        raise ValueError(f"side = {side}, allowed {LEFT} (left) or {RIGHT} (right)")
    for profile, kind in ((wheel, "wheel"), (rail, "rail")):
        if profile.kind != kind:
            raise ValueError(f"profile {profile.name!r} is of kind {profile.kind!r}, needed: {kind!r}")
    numbers = {"lateral": lateral, "height": height, "yaw": yaw, "roll": roll, "gauge": gauge}
    for name, value in numbers.items():
        if not math.isfinite(value):
            raise ValueError(f"{name} = {value}; it must be finite")
    axle = np.array([-math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll)])
    origin = side * (0.5 * gauge + gauge_point(rail))
    return wheel_rail_pair(
        spline_table(wheel, smoothing=smoothing),
        spline_table(rail, smoothing=smoothing),
        float(side),
        0.5 * back_to_back + FLANGE_BACK_TO_RUNNING_CIRCLE,
        float(radius),
        np.array([0.0, lateral - origin, height]),
        axle,
    )
