"""Measures of a profile: Sh, Sd, qR, flange angle, hollow tread of a wheel; wear of a rail head.

Wheel measures as in EN 15313 and UIC 510-2, from the running circle 70 mm from the flange back (the lengths
of 70, 10 and 2 mm are MiniProf's default too, greenwood.dk/miniprofstandardcalc.php, read 2026):

* Sh, flange height: from the running circle to the flange tip.
* Sd, flange thickness: from the flange back to the flange face, 10 mm below the tread at the running circle.
* qR: horizontal distance between the points of the face 10 mm below the tread and 2 mm above the flange tip.

A new S1002 has Sh = 28 mm and Sd = 32.5 mm (UIC 510-2, EN 13715); its qR of 10.794 mm follows from the
sections of the drawing (no published value is known).
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.profile import Profile
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE, GAUGE_MEASURING_DEPTH

FLANGE_THICKNESS_DEPTH = 0.010  # m below the tread at the running circle, EN 13715
_QR_FROM_TIP = 0.002  # m, EN 15313

_ANGLE_BASE = 1e-3  # m of arc length, base of the flange angle: longer than a scratch
_TREAD_END = 0.025  # m towards the flange: end of the tread for a hollow; beyond it the flange root rises
_CHAMFER = 0.010  # m at the outer end of a wheel profile, where the rim may be rounded or burred
_LEAST_SIDE_DEPTH, _LARGEST_SIDE_DEPTH = 0.005, 0.025  # m
_FIELD_SIDE_START = -0.012  # m from the top's middle: alignment uses the profile outside of it


def flange_height(wheel: Profile) -> float:
    """Sh: height of the flange tip over the tread at the running circle [m] (EN 15313).

    Raises
    ------
    ValueError
        If the profile is a rail's.
    """
    y, z = _wheel(wheel)
    return float(np.interp(0.0, y, z) - z[y > 0.0].min())


def flange_thickness(wheel: Profile) -> float:
    """Sd: thickness of the flange 10 mm below the tread at the running circle [m] (EN 13715).

    Errors as for `flange_height`.
    """
    face = _flange_face(wheel, float(np.interp(0.0, *_wheel(wheel))) - FLANGE_THICKNESS_DEPTH)
    return FLANGE_BACK_TO_RUNNING_CIRCLE - face


def flange_steepness(wheel: Profile) -> float:
    """qR: run of the flange face from 10 mm below the tread to 2 mm above the flange tip [m] (EN 15313).

    The smaller, the steeper; EN 15313 allows 6.5 mm and more.

    Errors as for `flange_height`.
    """
    y, z = _wheel(wheel)
    upper = _flange_face(wheel, float(np.interp(0.0, y, z)) - FLANGE_THICKNESS_DEPTH)
    return _flange_face(wheel, float(z[y > 0.0].min()) + _QR_FROM_TIP) - upper


def flange_angle(wheel: Profile) -> float:
    """Largest angle of the flange face against the axle, over 1 mm of arc length [rad].

    Errors as for `flange_height`.
    """
    y, z = _wheel(wheel)
    face = (y >= 0.0) & (np.arange(len(y)) <= np.argmin(np.where(y > 0.0, z, np.inf)))
    y, z = y[face], z[face]
    s = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))])
    start = np.linspace(0.0, s[-1] - _ANGLE_BASE, 20 * len(s))
    rise = np.interp(start, s, z) - np.interp(start + _ANGLE_BASE, s, z)
    run = np.interp(start + _ANGLE_BASE, s, y) - np.interp(start, s, y)
    return float(np.arctan2(rise, run).max())


def tread_hollow(wheel: Profile) -> float:
    """Depth of a hollow tread: radius of the field side over that of the tread [m]; 0 without a hollow.

    The largest rise of the wheel's radius from any point of the tread (up to 25 mm towards the flange) to a
    point outside of it, the outer 10 mm of the profile (chamfer) left out. After Sawley and Wu 2005 (Wear
    258), who measure it from the end of the false flange.

    Errors as for `flange_height`.
    """
    y, z = _wheel(wheel)
    tread = z[(y >= y[0] + _CHAMFER) & (y <= _TREAD_END)]
    return float((tread - np.minimum.accumulate(tread)).max())


@dataclass(frozen=True)
class RailWear:
    """Wear of a rail head against its reference profile, positive where metal is missing.

    Attributes
    ----------
    vertical : float
        W1: height lost at the middle of the reference's running surface [m].
    side : float
        W2: width lost on the gauge side, `side_depth` below the reference's top [m].
    corner : float
        W3: loss at the gauge corner along the line at 45 degrees through the crossing of the reference's
        top level and its gauge face at `side_depth` [m].
    """

    vertical: float
    side: float
    corner: float


def rail_wear(
    worn: Profile,
    reference: Profile,
    dy: float = 0.0,
    dz: float = 0.0,
    side_depth: float = GAUGE_MEASURING_DEPTH,
) -> RailWear:
    """Head wear W1, W2 and W3 of a worn rail.

    A file is read with the rail's highest point at z = 0, which hides W1: the worn rail must be shifted to
    its place on the reference. `align_rail` finds `dy` and `dz` from the field side, if that is not worn.

    Parameters
    ----------
    worn, reference : Profile
        Rails in side coordinates; the reference with the inclination of the worn rail.
    dy, dz : float
        Added to the worn rail's coordinates [m].
    side_depth : float
        Depth of W2 below the reference's top [m], 5 .. 25 mm; national rules differ.

    Raises
    ------
    ValueError
        If a profile is a wheel's, or the worn rail ends above the line of W2 or W3.
    """
    for rail in (worn, reference):
        if rail.kind != "rail":
            raise ValueError(f"profile {rail.name!r} is a wheel's; wear of a rail head needs rails")
    if not _LEAST_SIDE_DEPTH <= side_depth <= _LARGEST_SIDE_DEPTH:
        raise ValueError(
            f"side_depth = {side_depth} m, allowed {_LEAST_SIDE_DEPTH} .. {_LARGEST_SIDE_DEPTH} m"
        )
    top = float(reference.z.max())
    level = top - side_depth
    face = _crossing(reference, reference.y, reference.z, level)
    middle = face - 0.5 * _head_width(reference, level)
    worn_y, worn_z = worn.y + dy, worn.z + dz
    vertical = float(np.interp(middle, reference.y, reference.z) - np.interp(middle, worn_y, worn_z))
    side = face - _crossing(worn, worn_y, worn_z, level)
    # Along the line at 45 degrees: the height over a line that falls by 45 degrees through that corner.
    along = math.sqrt(0.5) * ((reference.y - face) + (reference.z - top))
    along_worn = math.sqrt(0.5) * ((worn_y - face) + (worn_z - top))
    across = math.sqrt(0.5) * ((reference.z - top) - (reference.y - face))
    across_worn = math.sqrt(0.5) * ((worn_z - top) - (worn_y - face))
    corner = _at_corner(reference, across, along) - _at_corner(worn, across_worn, along_worn)
    return RailWear(vertical, float(side), corner)


def align_rail(worn: Profile, reference: Profile) -> tuple[float, float]:
    """The shift dy, dz that fits the field side of a worn rail to that of its reference [m].

    Least squares of the distances from the reference of the worn rail's points more than 12 mm outside of its
    middle, which wheels without a hollow do not touch. Rotation is not fitted.

    Parameters
    ----------
    worn, reference : Profile
        Rails in side coordinates; the reference with the inclination of the worn rail.

    Raises
    ------
    ValueError
        If a profile is a wheel's or the worn rail has no 20 points there.
    """
    for rail in (worn, reference):
        if rail.kind != "rail":
            raise ValueError(f"profile {rail.name!r} is a wheel's; alignment needs rails")
    centre = [
        _crossing(rail, rail.y, rail.z, rail.z.max() - GAUGE_MEASURING_DEPTH) for rail in (worn, reference)
    ]
    middle = centre[0] - 0.5 * _head_width(reference, float(reference.z.max()) - GAUGE_MEASURING_DEPTH)
    part = worn.y < middle + _FIELD_SIDE_START
    if np.count_nonzero(part) < 20:
        raise ValueError(
            f"rail {worn.name!r}: {np.count_nonzero(part)} points on the field side, "
            "at least 20 needed to align"
        )
    slope = np.gradient(reference.z, reference.y)
    steepness = np.hypot(1.0, slope)

    def distances(shift: FloatArray) -> FloatArray:
        y, z = worn.y[part] + shift[0], worn.z[part] + shift[1]
        height = z - np.interp(y, reference.y, reference.z)
        return np.asarray(height / np.interp(y, reference.y, steepness), dtype=np.float64)

    start = (centre[1] - centre[0], 0.0)
    dy, dz = least_squares(distances, start, x_scale=1e-3, xtol=1e-12, ftol=1e-12).x
    return float(dy), float(dz)


def _wheel(wheel: Profile) -> tuple[FloatArray, FloatArray]:
    if wheel.kind != "wheel":
        raise ValueError(f"profile {wheel.name!r} is a rail's and has no flange")
    return wheel.y, wheel.z


def _flange_face(wheel: Profile, level: float) -> float:
    """Lateral position at which the flange, from the running circle on, first reaches `level` [m]."""
    y, z = wheel.y, wheel.z
    below = int(np.flatnonzero((y > 0.0) & (z < level))[0])  # the flange reaches there: `Profile` checks it
    share = (z[below - 1] - level) / (z[below - 1] - z[below])
    return float(y[below - 1] + (y[below] - y[below - 1]) * share)


def _crossing(rail: Profile, y: FloatArray, z: FloatArray, level: float) -> float:
    """Lateral position at which the gauge side of a rail first reaches `level` [m]."""
    top = int(np.argmax(z))
    below = np.flatnonzero(z[top:] <= level)
    if below.size == 0 or z[top] <= level:
        raise ValueError(
            f"rail {rail.name!r}: gauge side from z = {1e3 * z[top]:.4g} to {1e3 * z[top:].min():.4g} mm, "
            f"needed through {1e3 * level:.4g} mm"
        )
    k = top + int(below[0])
    return float(y[k - 1] + (y[k] - y[k - 1]) * (z[k - 1] - level) / (z[k - 1] - z[k]))


def _head_width(reference: Profile, level: float) -> float:
    """Width of the reference's head at `level` [m]."""
    face = _crossing(reference, reference.y, reference.z, level)
    return face + _crossing(reference, -reference.y[::-1], reference.z[::-1], level)


def _at_corner(rail: Profile, across: FloatArray, along: FloatArray) -> float:
    """`along` where `across` is 0, around the gauge corner [m]."""
    order = np.argsort(across)
    if not across[order[0]] < 0.0 < across[order[-1]]:
        raise ValueError(f"rail {rail.name!r}: does not reach the line of W3 at its gauge corner")
    return float(np.interp(0.0, across[order], along[order]))
