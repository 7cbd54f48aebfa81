"""A step of wear: the profile moved into the wheel by the wear depth, along its normals.

The wear of the step is smoothed, not the profile: a profile without wear is unchanged to the last digit,
however many steps are made, and a flange does not lose its radii to smoothing. The rule is that of measured
profiles (`hh_exudyn.contact.profiles.smoothing`), applied to the depth over the arc: waves shorter than a
local cut-off of up to 10 mm (about a patch) are removed, as far as the depth changes by no more than a share
of its largest value. The worn area stays the same, and places 5 mm from any wear do not move.

The number of points does not change: each moves by (-dz/ds, dy/ds) times the depth at its place.
"""

import numpy as np
from scipy.interpolate import CubicSpline

from damage.bounds import check_not_below_zero
from damage.evolution.profile_wear import ProfileWear
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.cleaning import arc_length
from hh_exudyn.contact.profiles.smoothing import LONGEST_CUT_OFF, smooth

SMOOTHING = 0.05
"""Share of the largest depth that smoothing may change a depth by (mean over 1 mm): assumed. The bins of a
simulated wear depth scatter by some per cent."""

_SCALE = 0.1e-3  # m, to which the largest depth is scaled for smoothing: so smoothing is proportional
_LARGEST_SMOOTHING = 0.5
_REACH = 0.5 * LONGEST_CUT_OFF  # from the nearest wear; farther away the depth is 0


def worn_profile(
    wheel: Profile, wear: ProfileWear, distance: float, smoothing: float = SMOOTHING, name: str | None = None
) -> tuple[Profile, float]:
    """The profile after a distance, with its running circle at z = 0 again, and the radius lost there.

    Parameters
    ----------
    wheel
        The profile before.
    wear
        Depth per kilometre over it.
    distance
        Rolled in this step [m], >= 0.
    smoothing
        Share of the largest depth that smoothing may change a depth by [-], 0 (none) to 0.5.
    name
        Of the new profile; None keeps the name.

    Returns
    -------
    Profile, float
        The worn profile, and how far its running circle lies above the old one: radius lost [m].

    Raises
    ------
    ValueError
        A rail, a number out of its range, or wear that leaves no valid profile: it folds over (too deep or
        too abrupt), or no longer covers the range of contact.
    """
    depth = step_depth(wheel, wear, distance, smoothing)
    return worn_by(wheel, depth, distance, name)


def worn_by(
    wheel: Profile, depth: FloatArray, distance: float, name: str | None = None
) -> tuple[Profile, float]:
    """The profile worn by a depth along its normals; running circle and result as of `worn_profile`.

    Parameters
    ----------
    wheel
        The profile before.
    depth
        (n,) at its points [m].
    distance
        Rolled for it, for the message [m].
    name
        Of the new profile; None keeps the name.

    Raises
    ------
    ValueError
        The profile folds over, or no longer covers the range of contact.
    """
    s = arc_length(wheel.y, wheel.z)
    along_y, along_z = CubicSpline(s, wheel.y)(s, 1), CubicSpline(s, wheel.z)(s, 1)
    length = np.hypot(along_y, along_z)
    y, z = wheel.y - depth * along_z / length, wheel.z + depth * along_y / length
    back = np.diff(y) <= 0.0
    if back.any():
        at = int(np.argmax(back))
        change, along = 1e3 * np.ptp(depth[at : at + 2]), 1e3 * (s[at + 1] - s[at])
        raise ValueError(
            f"wheel profile {wheel.name!r} folds over at y = {1e3 * wheel.y[at]:.2f} mm when it wears by "
            f"up to {1e3 * depth.max():.4g} mm in a step of {1e-3 * distance:.4g} km: the depth changes by "
            f"{change:.4g} mm over {along:.3g} mm there; smaller steps or smoother wear are needed"
        )
    lost = float(np.interp(0.0, y, z) - np.interp(0.0, wheel.y, wheel.z))
    return Profile(wheel.name if name is None else name, "wheel", y, z - lost), lost


def step_depth(
    wheel: Profile, wear: ProfileWear, distance: float, smoothing: float = SMOOTHING
) -> FloatArray:
    """(n,) wear depth of a step at every point of a profile [m]; parameters as `worn_profile`.

    Raises
    ------
    ValueError
        A rail, or a number out of its range.
    """
    if wheel.kind != "wheel":
        raise ValueError(f"profile {wheel.name!r} is a {wheel.kind}'s; wear needs a wheel's")
    check_not_below_zero("distance", distance, "m", "a step of wear")
    if not 0.0 <= smoothing <= _LARGEST_SMOOTHING:
        raise ValueError(f"smoothing = {smoothing} of a step of wear, allowed 0 .. {_LARGEST_SMOOTHING:g}")
    depth = wear.at(wheel.y) * (1e-3 * distance)
    largest = float(depth.max())
    if largest == 0.0 or smoothing == 0.0:
        return depth
    s = arc_length(wheel.y, wheel.z)
    smoothed = smooth(s, depth * (_SCALE / largest), smoothing * _SCALE)
    result = np.maximum(np.interp(s, smoothed.y, smoothed.z), 0.0) * (largest / _SCALE)
    result *= np.maximum(1.0 - _distance_from(s[depth > 0.0], s) / _REACH, 0.0)
    area, area_smoothed = np.trapezoid(depth, s), np.trapezoid(result, s)
    return np.asarray(result * (area / area_smoothed), dtype=np.float64)


def _distance_from(places: FloatArray, s: FloatArray) -> FloatArray:
    """Distance of each s from the nearest of some places, which are in order [m]."""
    after = np.searchsorted(places, s)
    near = [np.abs(s - places[np.clip(after - back, 0, places.size - 1)]) for back in (0, 1)]
    return np.minimum(near[0], near[1])
