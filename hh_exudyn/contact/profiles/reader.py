"""Profile files of any known format as profiles in side coordinates, cleaned, and smoothed where rough.

The steps of `read_profile`: points in the file's axes (`formats`), units and gaps, order, duplicates
(`cleaning`), wild points (`wild_points`), wheel or rail, side coordinates (`axes`), smoothing (`smoothing`),
loops, overhangs and lips (`cleaning`), cover (`profile`).
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.profiles.axes import PROTRUSION, protrusion_is_down, side_coordinates, tread
from hh_exudyn.contact.profiles.cleaning import distinct, file_order, single_valued, upright_face
from hh_exudyn.contact.profiles.formats import read_points
from hh_exudyn.contact.profiles.gaps import check_gaps, filled
from hh_exudyn.contact.profiles.points import RawPoints
from hh_exudyn.contact.profiles.profile import MIN_POINTS, Profile, check_cover, check_points
from hh_exudyn.contact.profiles.smoothing import (
    DEVIATION_ALLOWED,
    RIPPLE_ALLOWED,
    Smoothed,
    curvature_ripple,
    smooth,
)
from hh_exudyn.contact.profiles.wild_points import too_many, wild_points

SMOOTHING = ("auto", "always", "never")

_MAX_POINTS = 20_000
_LEAST_WIDTH, _LARGEST_WIDTH = 40.0, 300.0  # mm, of half a rail head to a wheel with its rim
_WIDEST_RAIL = 90.0  # mm; heads are up to 80 mm wide, wheels from 100
_FARTHEST = 1000.0  # mm from the file's origin
_OTHER_UNITS = {"metres": 1000.0, "inches": 25.4, "micrometres": 0.001}
_LEAST_DEVIATION, _LARGEST_DEVIATION = 1e-6, 0.5e-3  # m


@dataclass(frozen=True)
class ProfileReport:
    """Record of the reading of a file.

    Attributes
    ----------
    format, kind : str
        As found; see `formats.RawPoints`.
    points_read, points_dropped : int
        In the file, and dropped (duplicates; loops and overhangs where it was not smoothed).
    mirrored, upside_down : bool
        Whether y, z of the profile are opposite to the file's.
    shift_y, shift_z : float
        Shift after that [m].
    ripple, ripple_left : float
        `smoothing.curvature_ripple` before and after [1/m].
    smoothing : Smoothed or None
        Cut-off and deviations where the profile was smoothed.
    header : dict
        Header of the file, key to text.
    notes : tuple of str
        Changes and their reasons, in words.
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
    """A profile and the report on its reading."""

    profile: Profile
    report: ProfileReport


def read_wheel_profile(path: str | Path) -> Profile:
    """Read a wheel profile: MiniProf, SIMPACK prw, VAMPIRE whe or two columns, found by content.

    Two columns in side coordinates (y = 0 at the running circle, 70 mm from the flange back, positive to the
    flange; z upwards, so the flange lies at negative z) are taken as they are; ``#`` starts a comment. For
    the others see `formats`.

    Raises
    ------
    ValueError
        As `read_profile`.
    """
    return read_profile(path, "wheel").profile


def read_rail_profile(path: str | Path, *, mirrored: bool = False, side: str | None = None) -> Profile:
    """Read a rail profile: MiniProf, SIMPACK prr, VAMPIRE rai or two columns, found by content.

    Two columns in side coordinates (y positive towards the track centre, z upwards, inclination included)
    are taken as they are, with any lateral origin; ``#`` starts a comment. For the others, and for
    `mirrored`, see `axes`.

    Parameters
    ----------
    path : str or Path
        The file; its stem names the profile.
    mirrored : bool
        For a rail with both sides down to 14 mm: the gauge side is opposite to the format's usual one.
    side : str or None
        As `read_profile`.

    Raises
    ------
    ValueError
        As `read_profile`.
    """
    return read_profile(path, "rail", mirrored=mirrored, side=side).profile


def read_profile(
    path: str | Path,
    kind: str | None = None,
    *,
    mirrored: bool = False,
    flange_back: float | None = None,
    smoothing: str = "auto",
    deviation: float = DEVIATION_ALLOWED,
    side: str | None = None,
) -> ReadProfile:
    """Read a profile file of any known format, with a report of all changes.

    Parameters
    ----------
    path : str or Path
        The file; its stem names the profile.
    kind : str or None
        ``"wheel"``, ``"rail"``, or None: by the header, else by its width (rails up to 90 mm).
    mirrored : bool
        For a rail with both sides down to 14 mm: the gauge side is opposite to the format's usual one.
    flange_back : float or None
        For a wheel: position of the flange back on the file's lateral axis [m].
    smoothing : str
        ``"auto"``: where the curvature ripples (`smoothing`); ``"always"``; ``"never"``.
    deviation : float
        Largest deviation of the smoothed curve from the points [m], 1 um .. 0.5 mm. Larger waves remain: a
        worn or dirty flange may need more.
    side : str or None
        ``"left"`` or ``"right"`` of a VAMPIRE file, which holds both; None where they are the same.

    Raises
    ------
    ValueError
        A file that is missing, empty, binary, truncated, in another unit than millimetres, of the wrong kind,
        with numbers that are not finite or lines of another form, with gaps of more than 10 mm, more wild
        points than a good scan has, two profiles in it, or that does not cover the range of contact. The
        message names file, line, value and range.
    """
    path = Path(path)
    _check_options(kind, smoothing, deviation, side)
    raw = read_points(path, side)
    _check_numbers(path, raw)
    notes = list(raw.notes)
    y, z = _used_points(path, raw, notes)
    left_out = len(raw.y) - len(y)
    y, z = filled(y, z)
    kind = _kind(path, raw, kind, y, z)
    axes = side_coordinates(path, kind, raw.format, y, z, mirrored, flange_back)
    y, z = axes.y, axes.z
    smoothed = None
    ripple = ripple_left = curvature_ripple(y, z)
    if smoothing == "always" or (smoothing == "auto" and ripple > RIPPLE_ALLOWED):
        smoothed = smooth(y, z, deviation)
        y, z = smoothed.y, smoothed.z
        ripple_left = curvature_ripple(y, z)
        notes.append(_in_words(smoothed, ripple, ripple_left))
    y, z, cut = _single_valued(kind, y, z, notes)
    name = f"{kind} profile {path}"
    check_points(name, "point", list(range(1, len(y) + 1)), y, z)
    shift_z = -float(np.interp(0.0, y, z)) if kind == "wheel" else -float(z.max())
    z = z + shift_z
    check_cover(name, kind, y, z)
    report = ProfileReport(
        format=raw.format,
        kind=kind,
        points_read=len(raw.y),
        points_dropped=left_out + (0 if smoothed else cut),
        mirrored=axes.mirrored,
        upside_down=axes.upside_down,
        shift_y=axes.shift_y,
        shift_z=shift_z,
        ripple=ripple,
        ripple_left=ripple_left,
        smoothing=smoothed,
        header=raw.header,
        notes=tuple(notes),
    )
    return ReadProfile(Profile(path.stem, kind, y, z), report)


def _check_options(kind: str | None, smoothing: str, deviation: float, side: str | None) -> None:
    """Check the keywords of `read_profile` that do not depend on the file."""
    if side not in (None, "left", "right"):
        raise ValueError(f"side = {side!r}, allowed 'left', 'right' or None")
    if kind not in (None, "wheel", "rail"):
        raise ValueError(f"kind = {kind!r}, allowed 'wheel', 'rail' or None")
    if smoothing not in SMOOTHING:
        raise ValueError(f"smoothing = {smoothing!r}, allowed {', '.join(SMOOTHING)}")
    if not _LEAST_DEVIATION <= deviation <= _LARGEST_DEVIATION:
        raise ValueError(f"deviation = {deviation} m, allowed {_LEAST_DEVIATION} .. {_LARGEST_DEVIATION} m")


def _used_points(path: Path, raw: RawPoints, notes: list[str]) -> tuple[FloatArray, FloatArray]:
    """The points in metres, in the order of the curve, without duplicates, faces and wild points."""
    order = file_order(raw.y, raw.z)
    if np.any(order != np.arange(len(order))):
        notes.append("points sorted by y: the lines were shuffled")
    y, z, lines = 1e-3 * raw.y[order], 1e-3 * raw.z[order], np.array(raw.lines)[order]
    used = _distinct(path, y, z, notes)
    used = used[check_gaps(path, y[used], z[used], lines[used], notes)]
    used = np.delete(used, _wild(path, y[used], z[used], lines[used], notes))
    return y[used], z[used]


def _single_valued(
    kind: str, y: FloatArray, z: FloatArray, notes: list[str]
) -> tuple[FloatArray, FloatArray, int]:
    """The curve as a line z(y), with an upright face below a rail's lip; and how many points are left out."""
    single, loops, overhangs = single_valued(y, z, _anchor(kind, y, z))
    if loops:
        notes.append(f"{loops} points in loops left out")
    if overhangs:
        notes.append(f"{overhangs} points of overhangs cut off")
    face = upright_face(y, z, int(single[-1])) if kind == "rail" else None
    y, z = y[single], z[single]
    if face:
        notes.append(f"upright face below the lip at y = {1e3 * y[-1]:.2f} mm, z = {1e3 * z[-1]:.2f} mm")
        y, z = np.append(y, face[0]), np.append(z, face[1])
    return y, z, loops + overhangs


def _distinct(path: Path, y: FloatArray, z: FloatArray, notes: list[str]) -> IntArray:
    """Indices of the points that differ from the one before; ValueError where they are too few."""
    different = distinct(y, z)
    if dropped := len(y) - len(different):
        notes.append(f"{dropped} duplicates left out")
    if len(different) < MIN_POINTS:
        raise ValueError(f"profile {path}: {len(different)} different points, at least {MIN_POINTS} needed")
    return different


def _wild(path: Path, y: FloatArray, z: FloatArray, lines: IntArray, notes: list[str]) -> list[int]:
    """Indices of the wild points, noted; ValueError where they are too many."""
    wild = wild_points(y, z)
    if not wild:
        return []
    named = f"line {lines[wild[0]]} (y = {1e3 * y[wild[0]]:.4g} mm, z = {1e3 * z[wild[0]]:.4g} mm)"
    if too_many(len(wild), len(y)):
        raise ValueError(
            f"profile {path}, {named} and {len(wild) - 1} other points lie off the curve of their neighbours "
            "by more than 0.05 mm and five times the noise: allowed are 3 of them, or 1 %"
        )
    others = f", and lines {', '.join(str(lines[i]) for i in wild[1:])}" if wild[1:] else ""
    notes.append(f"wild point left out: {named}{others}")
    return wild


def _anchor(kind: str, y: FloatArray, z: FloatArray) -> int:
    """Index of a point that certainly belongs to the profile: at the running circle, or the top of a rail."""
    return int(np.argmin(np.hypot(y, z - tread(y, z)))) if kind == "wheel" else int(np.argmax(z))


def _in_words(smoothed: Smoothed, ripple: float, ripple_left: float) -> str:
    """Figures of the smoothing, in words."""
    return (
        f"smoothed: curvature ripple {ripple:.3g} 1/m, left {ripple_left:.3g} 1/m; "
        f"cut-off {1e3 * smoothed.cut_off[0]:.2g} .. {1e3 * smoothed.cut_off[1]:.2g} mm; points lie "
        f"{1e3 * smoothed.point_rms:.4f} mm (rms), {1e3 * smoothed.point_max:.4f} mm (largest) off"
    )


def _check_numbers(path: Path, raw: RawPoints) -> None:
    """Check that there are enough points, all finite, of a profile's size in millimetres."""
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


def _kind(path: Path, raw: RawPoints, asked: str | None, y: FloatArray, z: FloatArray) -> str:
    """Wheel or rail: `asked` unless the file contradicts it, else by header or width."""
    if asked and raw.kind and asked != raw.kind:
        raise ValueError(f"{asked} profile {path}: the file says that it is a {raw.kind}'s")
    width = 1e3 * float(np.ptp(y))
    kind = asked or raw.kind or ("rail" if width <= _WIDEST_RAIL else "wheel")
    if kind == "rail" and width > _WIDEST_RAIL:
        raise ValueError(
            f"rail profile {path}: spans {width:.4g} mm laterally, allowed up to {_WIDEST_RAIL:g} mm; "
            "is it a wheel's?"
        )
    down = z if protrusion_is_down(y, z) else -z
    thirds = np.quantile(y, [0.0, 1.0]) @ np.array([[2.0, 1.0], [1.0, 2.0]]) / 3.0
    falls = [tread(y, down) - down[part].min() for part in (y < thirds[0], y > thirds[1])]
    if kind == "wheel" and min(falls) > PROTRUSION:
        raise ValueError(
            f"wheel profile {path}: falls by {1e3 * falls[0]:.3g} and {1e3 * falls[1]:.3g} mm at its two "
            f"sides, allowed more than {1e3 * PROTRUSION:g} mm only at the flange; is it a rail's?"
        )
    return kind
