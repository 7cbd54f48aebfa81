"""Wheel and rail profiles as people handle them: standard shapes, files, gauge point.

A `Profile` is a line z(y) in side coordinates (`hh_exudyn.conventions`). The kernels want it smoothed and
as a spline table: `profile_spline.spline_table`.
"""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hh_exudyn.contact.line_profiles import (
    LINE_RAILS,
    LINE_WHEELS,
    line_rail_coordinates,
    line_wheel_coordinates,
)
from hh_exudyn.contact.standard_profiles import RAIL_HEADS, rail_head_coordinates, s1002_coordinates
from hh_exudyn.contact.types import FloatArray
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE, GAUGE_MEASURING_DEPTH

WHEEL_PROFILES = ("S1002", *LINE_WHEELS)
RAIL_PROFILES = (*RAIL_HEADS, *LINE_RAILS)
FLANGE_THICKNESS_DEPTH = 0.010  # m below the tread at the running circle, EN 13715
MAX_INCLINATION = 0.1  # larger values are angles in degrees or slopes upside down (1:20 is 0.05)

_MIN_POINTS = 20
_LEAST_STEP = 1e-9  # m, of y between the points of a standard rail
# What contact needs. A wheel: from the outer tread to the flange tip; a rail: from the outer head to the
# gauge point. The flange tip region begins where the flange is 24 mm high: 4 mm below a new S1002's tip.
_WHEEL_FIELD_SIDE = -0.020  # m
_WHEEL_FLANGE_DEPTH = -0.024  # m
_WHEEL_FIELD_DEPTH = -0.010  # m, what a hollow tread could reach; a rail or a mirrored wheel falls lower
_RAIL_FIELD_SIDE = -0.025  # m


@dataclass(frozen=True)
class Profile:
    """A wheel or rail profile: a line z(y) in side coordinates.

    Attributes
    ----------
    name : str
        What it is called in cases and plots.
    kind : str
        ``"wheel"`` or ``"rail"``.
    y, z : FloatArray
        Lateral position (increasing, towards the track centre) and height (upwards) [m]. A wheel has z = 0
        at its running circle y = 0; a rail has its highest point at z = 0.

    Raises
    ------
    ValueError
        Where a number is not finite, y does not increase, there are fewer than 20 points, or the profile
        does not cover what contact needs (wheel: from y = -20 mm to a flange at least 24 mm high; rail:
        from y = -25 mm to the gauge point 14 mm below its top).
    """

    name: str
    kind: str
    y: FloatArray
    z: FloatArray

    def __post_init__(self) -> None:
        if self.kind not in ("wheel", "rail"):
            raise ValueError(f"kind of profile {self.name!r}: {self.kind!r}, allowed: 'wheel', 'rail'")
        for field in ("y", "z"):
            array = np.array(getattr(self, field), dtype=np.float64)
            array.setflags(write=False)
            object.__setattr__(self, field, array)
        lines = list(range(1, len(self.y) + 1))
        _check_points(f"{self.kind} profile {self.name!r}", "point", lines, self.y, self.z)
        _check_cover(f"{self.kind} profile {self.name!r}", self.kind, self.y, self.z)


def wheel_profile(name: str) -> Profile:
    """A standard wheel profile.

    Parameters
    ----------
    name : str
        ``"S1002"``: UIC 510-2, flange 28 mm high and 32.5 mm thick; or a stand-in of `line_profiles`.

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

    Parameters
    ----------
    name : str
        A rail head of EN 13674-1: ``"54E1"``, ``"54E2"``, ``"60E1"`` or ``"60E2"``; or a stand-in of
        `line_profiles`.
    inclination : float
        Tangent of the angle between the rail's axis of symmetry and the vertical, e.g. 1/30; positive
        leans inwards (the head is rotated towards the track centre) [-]. Range -0.1 .. 0.1.

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
    # A flank that the inclination turns upright or beyond has no z(y): end at the first point that goes back.
    middle = len(y) // 2
    forward = np.diff(leaning_y) > _LEAST_STEP
    first = middle - int(np.argmin(np.append(forward[:middle][::-1], False)))
    last = middle + int(np.argmin(np.append(forward[middle:], False)))
    leaning_y, leaning_z = leaning_y[first : last + 1], leaning_z[first : last + 1]
    return Profile(_inclined_name(name, inclination), "rail", leaning_y, leaning_z - leaning_z.max())


def _inclined_name(name: str, inclination: float) -> str:
    return f"{name} 1:{1 / inclination:.4g}" if inclination else f"{name} upright"


def read_wheel_profile(path: str | Path) -> Profile:
    """Read a measured wheel profile: text, two columns, y and z in millimetres.

    Side coordinates: y = 0 is the running circle (70 mm from the flange back), positive towards the flange
    (the track centre), increasing from line to line; z is positive upwards, so the flange lies at negative
    z and the field side of the tread at slightly positive z. ``#`` starts a comment. The heights are
    shifted so that z(0) = 0.

    Raises
    ------
    ValueError
        File not found or no such text; NaN or y not increasing (the message names the line); fewer than
        20 points; or what contact needs is not covered (see `Profile`).
    """
    y, z = _read_columns(Path(path), "wheel")
    return Profile(Path(path).stem, "wheel", y, z - np.interp(0.0, y, z))


def read_rail_profile(path: str | Path) -> Profile:
    """Read a measured rail profile: text, two columns, y and z in millimetres.

    Side coordinates: y positive towards the track centre (the gauge side), increasing from line to line,
    any origin; z positive upwards, inclination included. ``#`` starts a comment. The heights are shifted so
    that the highest point has z = 0.

    Raises
    ------
    ValueError
        As `read_wheel_profile`.
    """
    y, z = _read_columns(Path(path), "rail")
    return Profile(Path(path).stem, "rail", y, z - z.max())


def flange_thickness(wheel: Profile) -> float:
    """Thickness of the flange 10 mm below the tread at the running circle [m] (EN 13715).

    Raises
    ------
    ValueError
        If the profile has no flange that reaches that deep.
    """
    y, z = np.asarray(wheel.y), np.asarray(wheel.z)
    depth = z - np.interp(0.0, y, z) + FLANGE_THICKNESS_DEPTH
    below = np.flatnonzero((y > 0.0) & (depth < 0.0))
    if below.size == 0 or below[0] == 0:
        raise ValueError(
            f"no flange: lowest point {z.min() * 1000:.3g} mm, "
            f"allowed below {-FLANGE_THICKNESS_DEPTH * 1000:g} mm, on the side of positive y"
        )
    k = below[0]
    face = y[k - 1] + (y[k] - y[k - 1]) * depth[k - 1] / (depth[k - 1] - depth[k])
    return float(FLANGE_BACK_TO_RUNNING_CIRCLE - face)


def gauge_point(rail: Profile) -> float:
    """Lateral position of the gauge point of a rail, 14 mm below its top on the gauge side [m].

    EN 13848-1: the gauge is measured 14 mm below the running plane.

    Raises
    ------
    ValueError
        If the profile is a wheel's.
    """
    if rail.kind != "rail":
        raise ValueError(f"profile {rail.name!r} is a wheel's and has no gauge point")
    top = int(np.argmax(rail.z))
    below = top + int(np.argmax(rail.z[top:] <= -GAUGE_MEASURING_DEPTH))
    y0, y1, z0, z1 = rail.y[below - 1], rail.y[below], rail.z[below - 1], rail.z[below]
    return float(y0 + (y1 - y0) * (-GAUGE_MEASURING_DEPTH - z0) / (z1 - z0))


def _read_columns(path: Path, kind: str) -> tuple[FloatArray, FloatArray]:
    """Two columns of millimetres as metres, checked line by line."""
    if not path.is_file():
        raise ValueError(f"{kind} profile: file not found: {path}")
    lines, ys, zs = [], [], []
    for number, text in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), start=1):
        words = text.split("#", 1)[0].replace(",", " ").split()
        if not words:
            continue
        try:
            y, z = (float(word) for word in words)
        except ValueError:
            raise ValueError(
                f"{kind} profile {path}, line {number}: expected two numbers, y and z in mm, "
                f"got {text.strip()!r}"
            ) from None
        lines.append(number)
        ys.append(y * 1e-3)
        zs.append(z * 1e-3)
    y_array, z_array = np.array(ys), np.array(zs)
    _check_points(f"{kind} profile {path}", "line", lines, y_array, z_array)
    return y_array, z_array


def _check_points(what: str, unit: str, lines: list[int], y: FloatArray, z: FloatArray) -> None:
    """Number of points, finite values, increasing y; `unit` and `lines` say where in the message."""
    if y.ndim != 1 or y.shape != z.shape:
        raise ValueError(
            f"{what}: y and z must be one-dimensional and equally long, got {y.shape}, {z.shape}"
        )
    if len(y) < _MIN_POINTS:
        raise ValueError(f"{what}: {len(y)} points, at least {_MIN_POINTS} needed")
    wrong = ~(np.isfinite(y) & np.isfinite(z))
    if wrong.any():
        at = int(np.argmax(wrong))
        raise ValueError(f"{what}, {unit} {lines[at]}: not a finite number (y = {y[at]}, z = {z[at]})")
    back = np.diff(y) <= 0
    if back.any():
        at = int(np.argmax(back)) + 1
        raise ValueError(
            f"{what}, {unit} {lines[at]}: y = {1e3 * y[at]:.4f} mm after {1e3 * y[at - 1]:.4f} mm; "
            "y must increase (towards the track centre)"
        )


def _check_cover(what: str, kind: str, y: FloatArray, z: FloatArray) -> None:
    """The stretch that contact needs must be there; catches profiles in another frame."""
    if kind == "wheel":
        if y[0] > _WHEEL_FIELD_SIDE:
            raise ValueError(
                f"{what}: begins at y = {1e3 * y[0]:.2f} mm, "
                f"needed from {1e3 * _WHEEL_FIELD_SIDE:.0f} mm (field side)"
            )
        if z[y < 0.0].min() < _WHEEL_FIELD_DEPTH:
            raise ValueError(
                f"{what}: falls to z = {1e3 * z[y < 0.0].min():.2f} mm on the field side, "
                f"allowed {1e3 * _WHEEL_FIELD_DEPTH:.0f} mm (z upwards, flange at positive y)"
            )
        if y[-1] <= 0.0 or z[y > 0.0].min() > _WHEEL_FLANGE_DEPTH:
            raise ValueError(
                f"{what}: no flange at positive y reaching z = {1e3 * _WHEEL_FLANGE_DEPTH:.0f} mm (z upwards)"
            )
        return
    top = int(np.argmax(z))
    if y[0] > _RAIL_FIELD_SIDE:
        raise ValueError(
            f"{what}: begins at y = {1e3 * y[0]:.2f} mm, "
            f"needed from {1e3 * _RAIL_FIELD_SIDE:.0f} mm (field side)"
        )
    if z[top:].min() > z[top] - GAUGE_MEASURING_DEPTH:
        raise ValueError(
            f"{what}: ends {1e3 * (z[top] - z[top:].min()):.2f} mm below its top on the gauge side, "
            f"needed to {1e3 * GAUGE_MEASURING_DEPTH:.0f} mm (the gauge point)"
        )
