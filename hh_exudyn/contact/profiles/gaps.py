"""Gaps in the points of a file: where the probe saw nothing, or a face in one step.

The rule: neighbouring points lie up to 10 mm apart. A longer step is the rim's face of a wheel, its flange
back or a flank of a rail, drawn with two points, where it stands upright (steeper than 5) and only a face
lies beyond it (3 mm wide or less): what lies beyond is out of the reach of contact and left out. Any other
gap is an error. Steps of more than 2 mm are named in the report.
"""

from pathlib import Path

import numpy as np

from hh_exudyn.arrays import FloatArray, IntArray

WIDEST = 10e-3  # m between neighbouring points

_NOTED = 2e-3  # m
_FILLED = 5e-3  # m: a straight step of a drawing, such as a chamfer
_STEP = 0.5e-3  # m of the points on such a step
_UPRIGHT = 5.0  # |dz/dy|
_FACE_WIDTH = 3e-3  # m


def check_gaps(path: Path, y: FloatArray, z: FloatArray, lines: IntArray, notes: list[str]) -> slice:
    """The points between upright faces; ValueError for any other gap.

    Parameters
    ----------
    path : Path
        For messages.
    y, z : FloatArray
        (n,) points in the order of the curve [m].
    lines : IntArray
        (n,) their line numbers.
    notes : list of str
        Out: what was left out, and which steps are wide.
    """
    step = np.hypot(np.diff(y), np.diff(z))
    begin, end = 0, len(y)
    for k in np.flatnonzero(step > WIDEST):
        upright = abs(z[k + 1] - z[k]) > _UPRIGHT * abs(y[k + 1] - y[k])
        if upright and np.ptp(y[: k + 2]) <= _FACE_WIDTH:
            begin = int(k) + 1
        elif upright and np.ptp(y[k:]) <= _FACE_WIDTH:
            end = min(end, int(k) + 1)
        else:
            raise ValueError(
                f"profile {path}, line {lines[k + 1]}: y = {1e3 * y[k + 1]:.6g} mm, "
                f"z = {1e3 * z[k + 1]:.6g} mm "
                f"lies {1e3 * step[k]:.4g} mm from the point before, allowed {1e3 * WIDEST:g} mm"
            )
    if left := begin + len(y) - end:
        notes.append(f"{left} points beyond an upright face left out")
    wide = [k for k in np.flatnonzero(step > _NOTED) if begin <= k < end - 1]
    if wide:
        longest = max(wide, key=lambda k: step[k])
        notes.append(
            f"{len(wide)} steps of more than {1e3 * _NOTED:g} mm between points, up to "
            f"{1e3 * step[longest]:.3g} mm (line {lines[longest + 1]})"
        )
    return slice(begin, end)


def filled(y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The points with those of straight lines on steps of more than 5 mm, so that no curve swings there.

    Parameters
    ----------
    y, z : FloatArray
        (n,) points in the order of the curve [m].
    """
    step = np.hypot(np.diff(y), np.diff(z))
    places = np.arange(len(y), dtype=np.float64)
    for k in np.flatnonzero(step > _FILLED):
        places = np.union1d(places, np.linspace(k, k + 1, round(step[k] / _STEP) + 1))
    whole = np.arange(len(y))
    return np.interp(places, whole, y), np.interp(places, whole, z)
