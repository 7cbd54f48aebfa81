"""Profile files of any known format as profiles in side coordinates, cleaned, and smooth where they were not.

`read_profile` reads as the steps: points (`profile_formats`), units, kind, order and duplicates
(`profile_cleaning`), axes and origin (below), smoothing (`profile_smoothing`), loops and overhangs, cover.

The axes of the formats are told in `profile_formats`. How they become side coordinates (y towards the track
centre, z up):

* Up: whatever protrudes over less than half the width (a wheel's flange, a rail's sides) points down.
* A wheel's y: its flange tells the side. Its running circle is y = 0: the file's zero where the flange tip
  lies 40 .. 68 mm from it; 70 mm from the file's zero where the tip lies 2 .. 35 mm from it, for such a file
  counts from the flange back (MiniProf's habit; its X = 0 is a face that stands upright in the data). Any
  other file needs the place of its flange back: `flange_back`.
* A rail's y: if only one of its sides reaches 14 mm below the top, that is the gauge side. Else the format's
  habit decides (two columns: +y is the gauge side; MiniProf: +X; SIMPACK: -y), which the file cannot prove:
  `mirrored` turns it over. The lateral origin stays the file's own.
* Heights: z = 0 at a wheel's running circle or at a rail's highest point.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hh_exudyn.contact.profile_cleaning import distinct, file_order, single_valued
from hh_exudyn.contact.profile_formats import SIMPACK, RawPoints, read_points
from hh_exudyn.contact.profile_line import MIN_POINTS, Profile, check_cover, check_points
from hh_exudyn.contact.profile_smoothing import (
    DEVIATION_ALLOWED,
    RIPPLE_ALLOWED,
    Smoothed,
    curvature_ripple,
    smooth,
)
from hh_exudyn.contact.types import FloatArray
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE, GAUGE_MEASURING_DEPTH

SMOOTHING = ("auto", "always", "never")

_MAX_POINTS = 20_000
_LEAST_WIDTH, _LARGEST_WIDTH = 40.0, 300.0  # mm, of half a rail head to a wheel with its rim
_WIDEST_RAIL = 90.0  # mm; heads are up to 80 mm wide, wheels from 100
_FARTHEST = 1000.0  # mm from the file's origin
_WIDEST_GAP = 10.0  # mm between neighbouring points
_OTHER_UNITS = {"metres": 1000.0, "inches": 25.4, "micrometres": 0.001}
_LEAST_DEVIATION, _LARGEST_DEVIATION = 1e-6, 0.5e-3  # m
_BOTH_SIDES_FALL = 10e-3  # m: so do a rail's
_TIP_FROM_RUNNING_CIRCLE = 40e-3, 68e-3  # m
_TIP_FROM_FLANGE_BACK = 2e-3, 35e-3  # m


@dataclass(frozen=True)
class ProfileReport:
    """What reading a file did.

    Attributes
    ----------
    format, kind : str
        As found; see `profile_formats.RawPoints`.
    points_read, points_dropped : int
        In the file, and left out of it (duplicates; loops and overhangs where it was not smoothed).
    mirrored, upside_down : bool
        Whether y, z of the profile run against the file's.
    shift_y, shift_z : float
        Added after that [m].
    ripple, ripple_left : float
        `profile_smoothing.curvature_ripple` before and after [1/m].
    smoothing : Smoothed or None
        Cut-off and deviations where the profile was smoothed.
    header : dict
        What the file says of itself, key to text.
    notes : tuple of str
        What was done and why, in words.
    """

    format: str
    kind: str
    points_read: int
    points_dropped: int
    mirrored: bool
    upside_down: bool
    shift_y: float
    shift_z: float
    ripple: float
    ripple_left: float
    smoothing: Smoothed | None
    header: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class ReadProfile:
    """A profile and how it came out of its file."""

    profile: Profile
    report: ProfileReport


def read_wheel_profile(path: str | Path) -> Profile:
    """Read a wheel profile: MiniProf, SIMPACK prw or two columns in millimetres, found by content.

    Two columns in side coordinates (y = 0 at the running circle, 70 mm from the flange back, positive to the
    flange; z upwards, so the flange lies at negative z) are taken as they are; ``#`` starts a comment. For
    the others see `profile_reader`.

    Raises
    ------
    ValueError
        As `read_profile`.
    """
    return read_profile(path, "wheel").profile


def read_rail_profile(path: str | Path, *, mirrored: bool = False) -> Profile:
    """Read a rail profile: MiniProf, SIMPACK prr or two columns in millimetres, found by content.

    Two columns in side coordinates (y positive towards the track centre, z upwards, inclination included)
    are taken as they are, with any lateral origin; ``#`` starts a comment. For the others, and for
    `mirrored`, see `profile_reader`.

    Raises
    ------
    ValueError
        As `read_profile`.
    """
    return read_profile(path, "rail", mirrored=mirrored).profile


def read_profile(
    path: str | Path,
    kind: str | None = None,
    *,
    mirrored: bool = False,
    flange_back: float | None = None,
    smoothing: str = "auto",
    deviation: float = DEVIATION_ALLOWED,
) -> ReadProfile:
    """Read a profile file of any known format, and report what was done to it.

    Parameters
    ----------
    path : str or Path
        The file; its stem names the profile.
    kind : str or None
        ``"wheel"``, ``"rail"``, or None: what the file says, else by its width (rails up to 90 mm).
    mirrored : bool
        For a rail whose two sides reach 14 mm down: the gauge side is the other than the format's habit.
    flange_back : float or None
        For a wheel: where the file's lateral axis has the flange back [m].
    smoothing : str
        ``"auto"``: where the curvature ripples (`profile_smoothing`); ``"always"``; ``"never"``.
    deviation : float
        How far from the points smoothing may go [m], 1 um .. 0.5 mm. What waves more than that stays: a
        worn or dirty flange may need more.

    Raises
    ------
    ValueError
        A file that is missing, empty, binary, cut off, in another unit than millimetres, of the wrong kind,
        with numbers that are not finite or lines that are no points, with gaps of more than 10 mm, or that
        does not cover what contact needs. The message names file, line, value and what is allowed.
    OSError
        The file may not be read.
    """
    path = Path(path)
    if kind not in (None, "wheel", "rail"):
        raise ValueError(f"kind = {kind!r}, allowed 'wheel', 'rail' or None")
    if smoothing not in SMOOTHING:
        raise ValueError(f"smoothing = {smoothing!r}, allowed {', '.join(SMOOTHING)}")
    if not _LEAST_DEVIATION <= deviation <= _LARGEST_DEVIATION:
        raise ValueError(f"deviation = {deviation} m, allowed {_LEAST_DEVIATION} .. {_LARGEST_DEVIATION} m")
    raw = read_points(path)
    _check_numbers(path, raw)
    notes = list(raw.notes)
    order = file_order(raw.y, raw.z)
    if order[0] != 0 or np.any(np.diff(order) != 1):
        notes.append("points sorted by y: the lines were shuffled")
    y, z, lines = 1e-3 * raw.y[order], 1e-3 * raw.z[order], [raw.lines[i] for i in order]
    _check_gaps(path, y, z, lines)
    kind = _kind(path, raw, kind, y, z)
    if mirrored and kind == "wheel":
        raise ValueError(f"wheel profile {path}: mirrored is for rails; a wheel's flange tells the side")
    if flange_back is not None and kind == "rail":
        raise ValueError(f"rail profile {path}: flange_back = {flange_back} m, allowed for wheels")

    kept = distinct(y, z)
    if dropped := len(y) - len(kept):
        notes.append(f"{dropped} duplicates left out")
    y, z = y[kept], z[kept]
    if len(y) < MIN_POINTS:
        raise ValueError(f"{kind} profile {path}: {len(y)} different points, at least {MIN_POINTS} needed")
    down = _protrusion_is_down(y, z)
    z = z if down else -z
    side = _flange_side(y, z) if kind == "wheel" else _gauge_side(raw.format, mirrored, y, z)
    y = side * y
    shift_y = _running_circle(path, y, z, side, flange_back) if kind == "wheel" else 0.0
    y = y + shift_y
    if y[0] > y[-1]:
        y, z = y[::-1], z[::-1]

    ripple = ripple_left = curvature_ripple(y, z)
    smoothed = None
    if smoothing == "always" or (smoothing == "auto" and ripple > RIPPLE_ALLOWED):
        smoothed = smooth(y, z, deviation)
        y, z = smoothed.y, smoothed.z
        ripple_left = curvature_ripple(y, z)
        notes.append(
            f"smoothed: curvature ripple {ripple:.3g} 1/m, left {ripple_left:.3g} 1/m; "
            f"cut-off {1e3 * smoothed.cut_off[0]:.2g} .. {1e3 * smoothed.cut_off[1]:.2g} mm; points lie "
            f"{1e3 * smoothed.point_rms:.4f} mm (rms), {1e3 * smoothed.point_max:.4f} mm (largest) off"
        )
    anchor = int(np.argmin(np.hypot(y, z - _tread(y, z)))) if kind == "wheel" else int(np.argmax(z))
    kept, loops, overhangs = single_valued(y, z, anchor)
    if loops:
        notes.append(f"{loops} points in loops left out")
    if overhangs:
        notes.append(f"{overhangs} points of overhangs cut off")
    y, z = y[kept], z[kept]
    check_points(f"{kind} profile {path}", "point", list(range(1, len(y) + 1)), y, z)
    shift_z = -float(np.interp(0.0, y, z)) if kind == "wheel" else -float(z.max())
    z = z + shift_z
    check_cover(f"{kind} profile {path}", kind, y, z)
    report = ProfileReport(
        format=raw.format,
        kind=kind,
        points_read=len(raw.y),
        points_dropped=dropped + (0 if smoothed else loops + overhangs),
        mirrored=side < 0.0,
        upside_down=not down,
        shift_y=shift_y,
        shift_z=shift_z,
        ripple=ripple,
        ripple_left=ripple_left,
        smoothing=smoothed,
        header=raw.header,
        notes=tuple(notes),
    )
    return ReadProfile(Profile(path.stem, kind, y, z), report)


def _check_numbers(path: Path, raw: RawPoints) -> None:
    """Enough points, all finite, of a profile's size in millimetres."""
    if not MIN_POINTS <= len(raw.y) <= _MAX_POINTS:
        raise ValueError(
            f"profile {path}: {len(raw.y)} points, at least {MIN_POINTS} needed, at most {_MAX_POINTS}"
        )
    for values in (raw.y, raw.z):
        wrong = ~np.isfinite(values)
        if wrong.any():
            at = int(np.argmax(wrong))
            raise ValueError(
                f"profile {path}, line {raw.lines[at]}: not a finite number "
                f"(y = {raw.y[at]} mm, z = {raw.z[at]} mm)"
            )
    farthest = int(np.argmax(np.maximum(np.abs(raw.y), np.abs(raw.z))))
    if max(abs(raw.y[farthest]), abs(raw.z[farthest])) <= _FARTHEST:
        width = float(np.ptp(raw.y))
        if _LEAST_WIDTH <= width <= _LARGEST_WIDTH:
            return
        found = f"spans {width:.4g} mm laterally, allowed {_LEAST_WIDTH:g} .. {_LARGEST_WIDTH:g} mm"
    else:
        width = float(np.max(np.abs(raw.y)))
        found = (
            f"line {raw.lines[farthest]}: y = {raw.y[farthest]:.4g} mm, z = {raw.z[farthest]:.4g} mm, "
            f"allowed up to {_FARTHEST:g} mm"
        )
    units = [name for name, factor in _OTHER_UNITS.items() if 60.0 <= width * factor <= 160.0]
    raise ValueError(f"profile {path}: {found}" + (f"; are these {units[0]}?" if units else ""))


def _check_gaps(path: Path, y: FloatArray, z: FloatArray, lines: list[int]) -> None:
    """No wild point and no missing stretch."""
    gaps = np.hypot(np.diff(y), np.diff(z))
    if np.any(1e3 * gaps > _WIDEST_GAP):
        at = int(np.argmax(1e3 * gaps > _WIDEST_GAP)) + 1
        raise ValueError(
            f"profile {path}, line {lines[at]}: y = {1e3 * y[at]:.6g} mm, z = {1e3 * z[at]:.6g} mm lies "
            f"{1e3 * gaps[at - 1]:.4g} mm from the point before, allowed {_WIDEST_GAP:g} mm"
        )


def _kind(path: Path, raw: RawPoints, asked: str | None, y: FloatArray, z: FloatArray) -> str:
    """Wheel or rail: as asked, if nothing speaks against it."""
    if asked and raw.kind and asked != raw.kind:
        raise ValueError(f"{asked} profile {path}: the file says that it is a {raw.kind}'s")
    width = 1e3 * float(np.ptp(y))
    kind = asked or raw.kind or ("rail" if width <= _WIDEST_RAIL else "wheel")
    if kind == "rail" and width > _WIDEST_RAIL:
        raise ValueError(
            f"rail profile {path}: spans {width:.4g} mm laterally, allowed up to {_WIDEST_RAIL:g} mm; "
            "is it a wheel's?"
        )
    down = z if _protrusion_is_down(y, z) else -z
    thirds = np.quantile(y, [0.0, 1.0]) @ np.array([[2.0, 1.0], [1.0, 2.0]]) / 3.0
    falls = [_tread(y, down) - down[part].min() for part in (y < thirds[0], y > thirds[1])]
    if kind == "wheel" and min(falls) > _BOTH_SIDES_FALL:
        raise ValueError(
            f"wheel profile {path}: falls by {1e3 * falls[0]:.3g} and {1e3 * falls[1]:.3g} mm at its two "
            f"sides, allowed more than {1e3 * _BOTH_SIDES_FALL:g} mm at one of them; is it a rail's?"
        )
    return kind


def _widths(y: FloatArray) -> FloatArray:
    """The share of the lateral axis that each point stands for."""
    return np.abs(np.gradient(y))


def _tread(y: FloatArray, z: FloatArray) -> float:
    """Height of the tread or of a rail's running surface: half the profile's width lies above it [m]."""
    order = np.argsort(z)
    share = np.cumsum(_widths(y)[order])
    return float(z[order][np.searchsorted(share, 0.5 * share[-1])])


def _protrusion_is_down(y: FloatArray, z: FloatArray) -> bool:
    """Whether what protrudes from the tread (flange, sides of a rail) has negative z."""
    return bool(np.sum((z - _tread(y, z)) * _widths(y)) < 0.0)


def _flange_side(y: FloatArray, z: FloatArray) -> float:
    """+1 where the flange (z downwards) lies at the larger y of the file, -1 at the smaller."""
    flange = z - _tread(y, z) < -_BOTH_SIDES_FALL
    if not flange.any():
        return 1.0  # `check_cover` says what is missing
    return 1.0 if np.average(y[flange]) > 0.5 * (y.min() + y.max()) else -1.0


def _gauge_side(file_format: str, mirrored: bool, y: FloatArray, z: FloatArray) -> float:
    """+1 where the gauge side lies at the larger y of the file, -1 at the smaller."""
    top = int(np.argmax(z))
    right, left = y >= y[top], y <= y[top]
    reaches = [z[part].min() <= z[top] - GAUGE_MEASURING_DEPTH for part in (left, right)]
    if reaches == [True, False]:
        return -1.0
    habit = -1.0 if file_format == SIMPACK and all(reaches) else 1.0
    return -habit if mirrored and all(reaches) else habit


def _running_circle(
    path: Path, y: FloatArray, z: FloatArray, side: float, flange_back: float | None
) -> float:
    """What brings y = 0 to the running circle; y towards the flange, with the file's zero [m]."""
    if flange_back is not None:
        return FLANGE_BACK_TO_RUNNING_CIRCLE - side * flange_back
    tip = float(y[np.argmin(np.where(z - _tread(y, z) < 0.0, z, np.inf))])
    if _TIP_FROM_RUNNING_CIRCLE[0] <= tip <= _TIP_FROM_RUNNING_CIRCLE[1]:
        return 0.0
    if _TIP_FROM_FLANGE_BACK[0] <= -tip <= _TIP_FROM_FLANGE_BACK[1]:
        return FLANGE_BACK_TO_RUNNING_CIRCLE
    raise ValueError(
        f"wheel profile {path}: lowest point of the flange {1e3 * tip:.4g} mm from the file's lateral zero "
        "(towards the track centre); allowed 40 .. 68 mm (zero at the running circle) or -35 .. -2 mm (zero "
        "at the flange back); else say where the flange back is: flange_back"
    )
