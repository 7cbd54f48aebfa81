"""The axes of a scanned wheel or rail: direction upwards, side of the track centre, origin.

The axes of the formats are described in `formats`. Rules of their conversion to side coordinates (y towards
the track centre, z up):

* Up: a protrusion over less than half the width (a wheel's flange, a rail's sides) points down.
* A wheel's y: given by the side of its flange. Its running circle is y = 0: the file's zero where the flange
tip
  lies 40 .. 68 mm from it; 70 mm from the file's zero where the tip lies 2 .. 35 mm from it, since the origin
  of such a file is the flange back (usual for MiniProf; its X = 0 is an upright face in the data). Any other
  file needs the position of its flange back: `flange_back`.
* A rail's y: if only one of its sides reaches 14 mm below the top, that is the gauge side. Else it is the
  usual one of the format (two columns: +y is the gauge side; MiniProf: +X; SIMPACK and VAMPIRE: -y), which
  cannot be checked: `mirrored` is for the opposite. The lateral origin is that of the file.
* Heights: z = 0 at a wheel's running circle or at a rail's highest point.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.points import SIMPACK, VAMPIRE
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE, GAUGE_MEASURING_DEPTH

PROTRUSION = 10e-3  # m below the tread: anything lower is a flange, or a side of a rail
_TIP_FROM_RUNNING_CIRCLE = 40e-3, 68e-3  # m
_TIP_FROM_FLANGE_BACK = 2e-3, 35e-3  # m


@dataclass(frozen=True)
class TurnedPoints:
    """A curve in side coordinates, from the field side on, and its conversion.

    Attributes
    ----------
    y, z : FloatArray
        Points [m]; z has the file's origin.
    mirrored, upside_down : bool
        Whether y, z are opposite to the file's.
    shift_y : float
        Shift of y after that [m].
    """

    y: FloatArray
    z: FloatArray
    mirrored: bool
    upside_down: bool
    shift_y: float


def side_coordinates(
    path: Path,
    kind: str,
    file_format: str,
    y: FloatArray,
    z: FloatArray,
    mirrored: bool,
    flange_back: float | None,
) -> TurnedPoints:
    """Turn the points of a file by the rules of this module.

    Parameters
    ----------
    path : Path
        For messages.
    kind, file_format : str
        Of the profile, as in `points.RawPoints`.
    y, z : FloatArray
        The curve in the file's axes [m].
    mirrored, flange_back
        As `reader.read_profile`.

    Raises
    ------
    ValueError
        `mirrored` for a wheel, or `flange_back` for a rail; a wheel without a flange or of unknown origin.
    """
    if mirrored and kind == "wheel":
        raise ValueError(f"wheel profile {path}: mirrored is for rails; a wheel's flange tells the side")
    if flange_back is not None and kind == "rail":
        raise ValueError(f"rail profile {path}: flange_back = {flange_back} m, allowed for wheels")
    down = protrusion_is_down(y, z)
    z = z if down else -z
    side = _flange_side(y, z) if kind == "wheel" else _gauge_side(path, file_format, mirrored, y, z)
    y = side * y
    shift = _running_circle(path, y, z, side, flange_back) if kind == "wheel" else 0.0
    y = y + shift
    if y[0] > y[-1]:
        y, z = y[::-1], z[::-1]
    return TurnedPoints(y, z, side < 0.0, not down, shift)


def _widths(y: FloatArray) -> FloatArray:
    """Width of the lateral axis assigned to each point."""
    return np.abs(np.gradient(y))


def tread(y: FloatArray, z: FloatArray) -> float:
    """Height of the tread or of a rail's running surface: half the profile's width lies above it [m].

    Parameters
    ----------
    y, z : FloatArray
        (n,) points of the curve, z upwards [m].
    """
    order = np.argsort(z)
    share = np.cumsum(_widths(y)[order])
    return float(z[order][np.searchsorted(share, 0.5 * share[-1])])


def protrusion_is_down(y: FloatArray, z: FloatArray) -> bool:
    """Whether the protrusion of the profile (flange, sides of a rail) has negative z.

    Parameters
    ----------
    y, z : FloatArray
        (n,) points of the curve [m].
    """
    return bool(np.sum((z - tread(y, z)) * _widths(y)) < 0.0)


def _flange_side(y: FloatArray, z: FloatArray) -> float:
    """+1 where the flange (z downwards) lies at the larger y of the file, -1 at the smaller."""
    flange = z - tread(y, z) < -PROTRUSION
    if not flange.any():
        return 1.0  # `check_cover` names the missing part
    return 1.0 if np.average(y[flange]) > 0.5 * (y.min() + y.max()) else -1.0


def _gauge_side(path: Path, file_format: str, mirrored: bool, y: FloatArray, z: FloatArray) -> float:
    """+1 where the gauge side lies at the larger y of the file, -1 at the smaller."""
    top = int(np.argmax(z))
    level = z[top] - GAUGE_MEASURING_DEPTH
    left, right = bool(z[y <= y[top]].min() <= level), bool(z[y >= y[top]].min() <= level)
    if left and right:
        habit = -1.0 if file_format in (SIMPACK, VAMPIRE) else 1.0
        return -habit if mirrored else habit
    if mirrored:
        raise ValueError(
            f"rail profile {path}: mirrored is for rails whose two sides reach 14 mm below the top; here "
            "the gauge side is the one that does"
        )
    return -1.0 if left else 1.0


def _running_circle(
    path: Path, y: FloatArray, z: FloatArray, side: float, flange_back: float | None
) -> float:
    """Shift that brings y = 0 to the running circle; y towards the flange, with the file's zero [m]."""
    if flange_back is not None:
        return FLANGE_BACK_TO_RUNNING_CIRCLE - side * flange_back
    height = tread(y, z) - float(z.min())
    if height < PROTRUSION:
        raise ValueError(
            f"wheel profile {path}: no flange: lowest point {1e3 * height:.4g} mm below the tread, "
            "needed 24 mm"
        )
    tip = float(y[np.argmin(z)])
    if _TIP_FROM_RUNNING_CIRCLE[0] <= tip <= _TIP_FROM_RUNNING_CIRCLE[1]:
        return 0.0
    if _TIP_FROM_FLANGE_BACK[0] <= -tip <= _TIP_FROM_FLANGE_BACK[1]:
        return FLANGE_BACK_TO_RUNNING_CIRCLE
    raise ValueError(
        f"wheel profile {path}: lowest point of the flange {1e3 * tip:.4g} mm from the file's lateral zero "
        "(towards the track centre); allowed 40 .. 68 mm (zero at the running circle) or -35 .. -2 mm (zero "
        "at the flange back); else say where the flange back is: flange_back"
    )
