"""Measured profiles: ripple of their curvature, and smoothing with deviations of up to 0.02 mm.

Hertz's theory needs curvatures, and white noise of 5 um at the 0.3 mm spacing of a MiniProf adds some 100 1/m
to the 3 1/m of a tread. The rule:

* A profile is smoothed only if its curvature has ripple: the median, along the profile, of the part of its
  curvature in waves of 1.5 to 5 mm exceeds `RIPPLE_ALLOWED` = 1.5 1/m, half that of a crown of R300.
  Drawn profiles stay below (arcs and their joints: 0.02 .. 1.3 1/m), white noise of 1 um exceeds it.
* Then position and height along the arc length s each minimise (the ripple is found with the same filter)

      integral (u - x)^2 ds + integral (L/2 pi)^6 (d3u/ds3)^2 ds

  with x the measured and u the smooth curve. A wave of length l has the gain 1/(1 + (L/l)^6): L is the
  wavelength of half gain, and the radius R of an arc changes by its (L/2 pi R)^6-fold, 3e-6 for 13 mm.
* L is, at every place, the longest up to `LONGEST_CUT_OFF` = 10 mm (about a contact patch) for which the
  curve stays within `DEVIATION_ALLOWED` = 0.02 mm of the points, taken as means over 1 mm of arc length
  (four points of a MiniProf): so the scatter of single points is removed, and wider features are preserved.
  (The goal is 0.7 of that, because noise hides part of the deviation from the true shape.)

Measured on S1002 with white noise of 5 um every 0.25 mm (twelve seeds): curvature on the tread off by 0.13 ..
0.34 1/m rms, the curve within 16 um of the true one, the flange root of 13 mm within 4 % in the mean. With
10 um: up to 0.64 1/m, 20 um and 4 %.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.linalg import solveh_banded
from scipy.ndimage import maximum_filter1d, uniform_filter1d

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.cleaning import arc_length

RIPPLE_ALLOWED = 1.5  # 1/m
DEVIATION_ALLOWED = 0.02e-3  # m
LONGEST_CUT_OFF = 10e-3  # m
GRID = 0.1e-3  # m of arc length, spacing of the smooth points

_SHORTEST_CUT_OFF = 0.3e-3  # m, about the spacing of measured points: no smoothing
_AVERAGING = 1e-3  # m
_RIPPLE_BAND = 1.5e-3, 5e-3  # m
_STEEPEST = 5.0  # |dz/dy| up to which curvature matters, as `spline.MAX_SLOPE`
_SHORTENING = 0.9  # of the cut-off in each round
_SHORTENED_WIDTH = 6e-3  # m, around a place of too large deviation; with more, more waves remain beside it
_ROUNDS = 100
_DEVIATION_GOAL = 0.7  # of the allowed deviation: noise hides some of the deviation from the true shape


@dataclass(frozen=True)
class Smoothed:
    """A smooth curve and its deviations from the points.

    Attributes
    ----------
    y, z : FloatArray
        Points every 0.1 mm of arc length [m].
    cut_off : tuple of float
        Least and largest wavelength of half gain L along the curve [m].
    deviation : float
        Largest distance from the points, as means over 1 mm of arc length [m].
    point_rms, point_max : float
        Root mean square and largest of the single points' distances from the curve [m].
    """

    y: FloatArray
    z: FloatArray
    cut_off: tuple[float, float]
    deviation: float
    point_rms: float
    point_max: float


def curvature_ripple(y: FloatArray, z: FloatArray) -> float:
    """Median of the curvature's part between 1.5 and 5 mm of wavelength, where slopes are below 5 [1/m].

    Parameters
    ----------
    y, z : FloatArray
        A curve in order, without duplicates [m].
    """
    s = arc_length(y, z)
    grid = _grid(s)
    fine_y, fine_z = CubicSpline(s, y)(grid), CubicSpline(s, z)(grid)
    short, long = (
        _curvature(*(_penalised(x, np.full(len(grid), cut_off)) for x in (fine_y, fine_z)))
        for cut_off in _RIPPLE_BAND
    )
    flat = np.abs(np.gradient(fine_z)) < _STEEPEST * np.abs(np.gradient(fine_y))
    return float(np.median(np.abs(short - long)[flat])) if flat.any() else 0.0


def smooth(y: FloatArray, z: FloatArray, deviation: float = DEVIATION_ALLOWED) -> Smoothed:
    """The smooth curve through measured points by the rule of this module.

    Parameters
    ----------
    y, z : FloatArray
        A curve in order, without duplicates [m].
    deviation : float
        Largest distance of the curve from the points, as means over 1 mm of arc length [m].
    """
    s = arc_length(y, z)
    grid = _grid(s)
    measured_y, measured_z = np.interp(grid, s, y), np.interp(grid, s, z)
    cut_off = np.full(len(grid), LONGEST_CUT_OFF)
    width = 2 * round(0.5 * _SHORTENED_WIDTH / GRID) + 1
    for _ in range(_ROUNDS):
        smooth_y, smooth_z = _penalised(measured_y, cut_off), _penalised(measured_z, cut_off)
        distance = _distance(smooth_y, smooth_z, measured_y, measured_z)
        mean = uniform_filter1d(distance, round(_AVERAGING / GRID), mode="nearest")
        too_far = np.abs(mean) > _DEVIATION_GOAL * deviation
        if not too_far.any():
            break
        cut_off = _shortened(cut_off, too_far, width)
    at_points = np.interp(s, grid, distance)
    return Smoothed(
        smooth_y,
        smooth_z,
        (float(cut_off.min()), float(cut_off.max())),
        float(np.abs(mean).max()),
        float(np.sqrt(np.mean(at_points**2))),
        float(np.abs(at_points).max()),
    )


def _shortened(cut_off: FloatArray, too_far: NDArray[np.bool_], width: int) -> FloatArray:
    """The cut-off reduced around places of too large deviation, without steps."""
    near = maximum_filter1d(too_far.astype(np.float64), width)
    weight = uniform_filter1d(near, width, mode="nearest") * near
    return np.maximum(cut_off * _SHORTENING**weight, _SHORTEST_CUT_OFF)


def _grid(s: FloatArray) -> FloatArray:
    """Places along the curve, `GRID` apart or a little less."""
    return np.linspace(0.0, s[-1], int(np.ceil(s[-1] / GRID)) + 1)


def _penalised(x: FloatArray, cut_off: FloatArray) -> FloatArray:
    """The u that minimises sum (u - x)^2 + sum (L/(2 pi h))^6 (D3 u)^2, D3 the third difference."""
    n = len(x)
    weight = (0.5 * (cut_off[1:-2] + cut_off[2:-1]) / (2.0 * np.pi * GRID)) ** 6
    difference = (-1.0, 3.0, -3.0, 1.0)
    bands = np.zeros((4, n))  # upper bands of I + D3' W D3
    bands[3] = 1.0
    for i in range(4):
        for j in range(i, 4):
            bands[3 - (j - i), j : n - 3 + j] += weight * difference[i] * difference[j]
    return np.asarray(solveh_banded(bands, x), dtype=np.float64)


def _curvature(y: FloatArray, z: FloatArray) -> FloatArray:
    """Curvature of a curve given at equal arc length [1/m]."""
    angle = np.unwrap(np.arctan2(np.gradient(z), np.gradient(y)))
    return np.gradient(angle) / np.hypot(np.gradient(y), np.gradient(z))


def _distance(y: FloatArray, z: FloatArray, other_y: FloatArray, other_z: FloatArray) -> FloatArray:
    """Distance of the other curve to the left of this one [m]."""
    along_y, along_z = np.gradient(y), np.gradient(z)
    return ((other_z - z) * along_y - (other_y - y) * along_z) / np.hypot(along_y, along_z)
