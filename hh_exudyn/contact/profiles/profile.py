"""A wheel or rail profile as a line z(y) in side coordinates, and the conditions on every such line."""

from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.conventions import GAUGE_MEASURING_DEPTH

MIN_POINTS = 20
# Range of contact. A wheel: from the outer tread to the flange tip; a rail: from the gauge point to beyond
# its axis. The flange tip region begins where the flange is 24 mm high: 4 mm below a new S1002's tip.
_WHEEL_FIELD_SIDE = -0.020  # m
_WHEEL_FLANGE_DEPTH = -0.024  # m
_WHEEL_FIELD_DEPTH = -0.010  # m, deeper than any hollow tread; a rail or a mirrored wheel falls lower
_FARTHEST = 2.0  # m from the origin, wherever a rail's file has it
_RAIL_COVER = 0.055  # m from the gauge point to the field side: 19 mm beyond the axis of a 60E1


@dataclass(frozen=True)
class Profile:
    """A wheel or rail profile: a line z(y) in side coordinates.

    Attributes
    ----------
    name : str
        Its name in cases and plots.
    kind : str
        ``"wheel"`` or ``"rail"``.
    y, z : FloatArray
        Lateral position (increasing, towards the track centre) and height (upwards) [m]. A wheel has z = 0
        at its running circle y = 0; a rail has its highest point at z = 0.

    Raises
    ------
    ValueError
        Where a number is not finite or in millimetres, y does not increase, there are fewer than 20 points,
        or the profile does not cover the range of contact (wheel: from y = -20 mm to a flange at least 24 mm
        high; rail: the gauge point 14 mm below its top and 55 mm from there to the field side).
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
        check_points(f"{self.kind} profile {self.name!r}", "point", lines, self.y, self.z)
        check_cover(f"{self.kind} profile {self.name!r}", self.kind, self.y, self.z)


def gauge_point(rail: Profile, depth: float = GAUGE_MEASURING_DEPTH) -> float:
    """Lateral position of the gauge point of a rail: its nearest to the other rail down to `depth` [m].

    EN 13848-1: the gauge is the least distance of the rails in the zone from the running surface to 14 mm
    below it. On a new rail that is 14 mm below the top; on a low rail with plastic flow it may be the lip
    above.

    Parameters
    ----------
    rail : Profile
        The rail.
    depth : float
        Depth of the zone [m]: 14 mm, in North America 5/8 in = 15.875 mm.

    Raises
    ------
    ValueError
        If the profile is a wheel's, or ends above that depth.
    """
    if rail.kind != "rail":
        raise ValueError(f"profile {rail.name!r} is a wheel's and has no gauge point")
    top = int(np.argmax(rail.z))
    reached = float(rail.z[top] - rail.z[top:].min())
    if not 0.0 < depth <= reached:
        raise ValueError(
            f"rail profile {rail.name!r} reaches {1e3 * reached:.2f} mm below its top on the gauge side, "
            f"needed {1e3 * depth:g} mm, where the gauge is measured"
        )
    return _gauge_crossing(rail.y, rail.z, depth)


def _gauge_crossing(y: FloatArray, z: FloatArray, depth: float = GAUGE_MEASURING_DEPTH) -> float:
    """Largest y of the gauge side down to `depth` below the top; the profile must reach that depth.

    As y increases along a profile, that is where it first reaches the depth; below a lip the reader has laid
    an upright face (`cleaning.upright_face`).
    """
    top = int(np.argmax(z))
    height = z - z[top]
    below = top + int(np.argmax(height[top:] <= -depth))
    share = (-depth - height[below - 1]) / (height[below] - height[below - 1])
    return float(y[below - 1] + (y[below] - y[below - 1]) * share)


def check_points(what: str, unit: str, lines: list[int], y: FloatArray, z: FloatArray) -> None:
    """Check number of points, finite values in metres, increasing y; `unit` and `lines` are for messages.

    Parameters
    ----------
    what : str
        Name of the profile in messages.
    unit, lines
        Name of a place, such as "line", and its number for each point.
    y, z : FloatArray
        (n,) points [m].
    """
    if y.ndim != 1 or y.shape != z.shape:
        raise ValueError(
            f"{what}: y and z must be one-dimensional and equally long, got {y.shape}, {z.shape}"
        )
    if len(y) < MIN_POINTS:
        raise ValueError(f"{what}: {len(y)} points, at least {MIN_POINTS} needed")
    wrong = ~(np.isfinite(y) & np.isfinite(z))
    if wrong.any():
        at = int(np.argmax(wrong))
        raise ValueError(f"{what}, {unit} {lines[at]}: not a finite number (y = {y[at]}, z = {z[at]})")
    far = np.maximum(np.abs(y), np.abs(z)) > _FARTHEST
    if far.any():
        at = int(np.argmax(far))
        raise ValueError(
            f"{what}, {unit} {lines[at]}: y = {y[at]:g} m, z = {z[at]:g} m, allowed up to {_FARTHEST:g} m; "
            "are these millimetres?"
        )
    back = np.diff(y) <= 0
    if back.any():
        at = int(np.argmax(back)) + 1
        raise ValueError(
            f"{what}, {unit} {lines[at]}: y = {1e3 * y[at]:.4f} mm after {1e3 * y[at - 1]:.4f} mm; "
            "y must increase (towards the track centre)"
        )


def check_cover(what: str, kind: str, y: FloatArray, z: FloatArray) -> None:
    """Check that the range of contact is covered, which also detects profiles in another frame.

    Parameters
    ----------
    what, kind : str
        Name of the profile in messages, and ``"wheel"`` or ``"rail"``.
    y, z : FloatArray
        (n,) points in side coordinates [m].
    """
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
    if z[top:].min() > z[top] - GAUGE_MEASURING_DEPTH:
        raise ValueError(
            f"{what}: ends {1e3 * (z[top] - z[top:].min()):.2f} mm below its top on the gauge side, "
            f"needed to {1e3 * GAUGE_MEASURING_DEPTH:.0f} mm (the gauge point)"
        )
    covered = _gauge_crossing(y, z) - y[0]
    if covered < _RAIL_COVER:
        raise ValueError(
            f"{what}: begins {1e3 * covered:.2f} mm from its gauge point, "
            f"needed from {1e3 * _RAIL_COVER:.0f} mm (field side)"
        )
