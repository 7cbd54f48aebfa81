"""The standard library of profiles: wheels by name, rails by name and inclination."""

import math

import numpy as np

from hh_exudyn.contact.profiles.malmbanan import (
    LINE_RAILS,
    LINE_WHEELS,
    line_rail_coordinates,
    line_wheel_coordinates,
)
from hh_exudyn.contact.profiles.profile import Profile
from hh_exudyn.contact.profiles.standard import RAIL_HEADS, rail_head_coordinates, s1002_coordinates

WHEEL_PROFILES = ("S1002", *LINE_WHEELS)
RAIL_PROFILES = (*RAIL_HEADS, *LINE_RAILS)
MAX_INCLINATION = 0.1  # larger values are angles in degrees or slopes upside down (1:20 is 0.05)

_LEAST_STEP = 1e-9  # m, of y between the points of a standard rail


def wheel_profile(name: str) -> Profile:
    """A standard wheel profile.

    Parameters
    ----------
    name : str
        ``"S1002"``: UIC 510-2, flange 28 mm high and 32.5 mm thick; from the chamfer (-60 mm) over the
        flange tip (55 mm) to the flange back (70 mm). Or a stand-in of `malmbanan`.

    Raises
    ------
    ValueError
        For an unknown name.
    """
    if name not in WHEEL_PROFILES:
        raise ValueError(f"unknown wheel profile {name!r}; known: {', '.join(WHEEL_PROFILES)}")
    return Profile(
        name, "wheel", *(line_wheel_coordinates(name) if name in LINE_WHEELS else s1002_coordinates())
    )


def rail_profile(name: str, inclination: float = 1 / 30) -> Profile:
    """A standard rail, inclined towards the track centre.

    The whole head, flank to flank: at any allowed inclination both sides reach at least 15 mm below the top,
    beyond the gauge point and the steepest slope of a spline table (a flank of 1:20 inclined by 1:20 is
    upright; with more inclination the profile ends where the flank turns inwards).

    Parameters
    ----------
    name : str
        A rail head of EN 13674-1: ``"54E1"``, ``"54E2"``, ``"60E1"`` or ``"60E2"``; or a stand-in of
        `malmbanan`.
    inclination : float
        Tangent of the angle between the rail's axis of symmetry and the vertical, e.g. 1/30; positive
        inwards (the head is rotated towards the track centre) [-]. Range -0.1 .. 0.1.

    Returns
    -------
    Profile
        Highest point at z = 0; y = 0 is the top of the upright rail's axis.

    Raises
    ------
    ValueError
        For an unknown name or an inclination out of range.
    """
    if name not in RAIL_PROFILES:
        raise ValueError(f"unknown rail profile {name!r}; known: {', '.join(RAIL_PROFILES)}")
    if not abs(inclination) <= MAX_INCLINATION:
        raise ValueError(
            f"inclination = {inclination} (tangent), allowed {-MAX_INCLINATION} .. {MAX_INCLINATION}; "
            "1:30 is 1/30"
        )
    y, z = line_rail_coordinates(name) if name in LINE_RAILS else rail_head_coordinates(name)
    angle = math.atan(inclination)
    leaning_y = y * math.cos(angle) + z * math.sin(angle)
    leaning_z = -y * math.sin(angle) + z * math.cos(angle)
    # A flank turned upright or beyond by the inclination is no function z(y): end at the first step back.
    middle = len(y) // 2
    forward = np.diff(leaning_y) > _LEAST_STEP
    first = middle - int(np.argmin(np.append(forward[:middle][::-1], False)))
    last = middle + int(np.argmin(np.append(forward[middle:], False)))
    leaning_y, leaning_z = leaning_y[first : last + 1], leaning_z[first : last + 1]
    return Profile(_inclined_name(name, inclination), "rail", leaning_y, leaning_z - leaning_z.max())


def _inclined_name(name: str, inclination: float) -> str:
    return f"{name} 1:{1 / inclination:.4g}" if inclination else f"{name} upright"
