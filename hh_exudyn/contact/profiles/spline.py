"""Profiles for the kernels: C2 cubic splines on a uniform grid, with smoothed curvature.

Hertz's theory needs curvatures, and the curvature of a drawing jumps where its arcs join. So the curvature is
smoothed over about the length of a contact patch before the spline is made.
"""

import math

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.steepness import MAX_SLOPE, envelope, goes_on
from hh_exudyn.contact.types import SplineTable
from hh_exudyn.kernel import inlined_kernel

_RESAMPLING_STEP = 20e-6  # m, of the dense curve that is smoothed
_RUN_OUT = 0.75e-3  # m, beyond `MAX_SLOPE` on a rail: some nodes
_LAST = 1.0 + 1e-12  # the last node itself, whose place over the spacing may round up
_MIN_STEP, _MAX_STEP = 0.05e-3, 2e-3  # m
_MAX_SMOOTHING = 5e-3  # m


def spline_table(profile: Profile, step: float = 0.25e-3, smoothing: float = 0.5e-3) -> SplineTable:
    """A profile as a C2 cubic spline on a uniform grid of y.

    The rule of smoothing: along the arc length, the direction angle of the profile (its derivative is the
    curvature) is convolved with 2 g - g*g, g a Gaussian of standard deviation `smoothing`; the curve is
    integrated from it again and shifted so that it meets the original at the running circle or the rail top.
    Radii of arcs are unchanged. A Gaussian alone would shift the curve by ``dk smoothing^2 / 2`` beyond a
    jump dk of the curvature (10 um at S1002's flange); 2 g - g*g has no second moment, so the curve keeps
    its place (within 4 um in z), with an overshoot of some per cent of dk in return.

    Parameters
    ----------
    profile : Profile
        Wheel or rail.
    step : float
        Node spacing [m], 0.05 .. 2 mm.
    smoothing : float
        Standard deviation of the blur of curvature [m], 0 (none) .. 5 mm. Measured profiles need a few mm.

    Returns
    -------
    SplineTable
        A wheel ends at its flange tip and at the face of its rim, a rail at its last flanks, where the slope
        reaches `MAX_SLOPE`, and runs out in 0.75 mm of parabola on either side, so that the search finds
        nodes on both sides of any contact. Steep spots before the end are those of `steepness.envelope`.

    Raises
    ------
    ValueError
        Step or smoothing out of range, or steep spots too high for a table.
    """
    if not _MIN_STEP <= step <= _MAX_STEP:
        raise ValueError(f"step = {step} m, allowed {_MIN_STEP} .. {_MAX_STEP} m")
    if not 0.0 <= smoothing <= _MAX_SMOOTHING:
        raise ValueError(f"smoothing = {smoothing} m, allowed 0 .. {_MAX_SMOOTHING} m")
    y, z = _dense_curve(profile)
    if smoothing > 0.0:
        y, z = _blur_curvature(y, z, smoothing, _anchor(profile))
    first, last = _single_valued(profile, y, z)
    if goes_on(profile, y, z, first, last):
        y, z = _even(*envelope(profile, *_dense_curve(profile)))
        if smoothing > 0.0:
            y, z = _blur_curvature(y, z, smoothing, _anchor(profile))
        first, last = 0, len(y) - 1
    y, z = y[first : last + 1], z[first : last + 1]
    dense = CubicSpline(y, z)
    nodes = np.arange(math.ceil(y[0] / step), math.floor(y[-1] / step) + 1) * step
    values = dense(nodes)
    # End conditions: the slopes at both ends, which are known.
    spline = CubicSpline(nodes, values, bc_type=((1, dense(nodes[0], 1)), (1, dense(nodes[-1], 1))))
    second = spline(nodes, 2)
    if profile.kind == "wheel":
        return uniform_table(float(nodes[0]), step, values, second)
    more = math.ceil(_RUN_OUT / step)
    out = step * np.arange(1, more + 1)
    before = values[0] - spline(nodes[0], 1) * out + 0.5 * second[0] * out**2
    beyond = values[-1] + spline(nodes[-1], 1) * out + 0.5 * second[-1] * out**2
    return uniform_table(
        float(nodes[0]) - more * step,
        step,
        np.concatenate([before[::-1], values, beyond]),
        np.concatenate([np.full(more, second[0]), second, np.full(more, second[-1])]),
    )


def uniform_table(start: float, step: float, z: FloatArray, second: FloatArray) -> SplineTable:
    """The table from heights and second derivatives at the nodes, with its derived fields.

    Parameters
    ----------
    start, step : float
        Lateral position of the first node, and node spacing [m].
    z, second : FloatArray
        (n,) heights [m] and second derivatives [1/m].
    """
    slope = np.empty_like(z)
    slope[:-1] = np.diff(z) / step - step / 6.0 * (2.0 * second[:-1] + second[1:])
    slope[-1] = slope[-2] + 0.5 * step * (second[-2] + second[-1])
    return SplineTable(start, step, z, second, 1.0 / step, slope)


@inlined_kernel
def spline_evaluate(table: SplineTable, y: float) -> tuple[float, float, float]:
    """Height, slope and second derivative of a spline table at `y`; NaN outside the grid.

    Parameters
    ----------
    table : SplineTable
        The profile.
    y : float
        Lateral position, side coordinates [m].

    Returns
    -------
    z, slope, second : float
        [m], [-], [1/m].
    """
    u = (y - table.start) * table.per_step
    last = table.z.size - 1
    if not (u >= 0.0 and u <= last * _LAST):
        return math.nan, math.nan, math.nan
    i = np.uint64(min(u, last - 1.0))
    return spline_behind_node(table, i, u - i)


@inlined_kernel
def spline_behind_node(table: SplineTable, node: np.uint64, part: float) -> tuple[float, float, float]:
    """`spline_evaluate` where it is known between which nodes; no branches, for vector instructions.

    Parameters
    ----------
    table : SplineTable
        The profile.
    node : uint64
        Number of a node, not the last; unsigned, as a signed one might count from the end.
    part : float
        Distance behind it over the node spacing, 0 .. 1; beyond, the cubic goes on.
    """
    h, t = table.step, part
    s = 1.0 - t
    after = node + np.uint64(1)
    z0, z1, m0, m1 = table.z[node], table.z[after], table.second[node], table.second[after]
    sixth = h * (1.0 / 6.0)
    z = s * z0 + t * z1 + h * sixth * ((s * s * s - s) * m0 + (t * t * t - t) * m1)
    slope = (z1 - z0) * table.per_step + sixth * ((1.0 - 3.0 * s * s) * m0 + (3.0 * t * t - 1.0) * m1)
    return z, slope, s * m0 + t * m1


def _dense_curve(profile: Profile) -> tuple[FloatArray, FloatArray]:
    """Points of the profile at equal arc length: a cubic spline over the chord length, sampled finely."""
    chord = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(profile.y), np.diff(profile.z)))])
    at = np.linspace(0.0, chord[-1], math.ceil(chord[-1] / _RESAMPLING_STEP) + 1)
    return CubicSpline(chord, profile.y)(at), CubicSpline(chord, profile.z)(at)


def _even(y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points of a line at equal arc length."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))])
    at = np.linspace(0.0, length[-1], math.ceil(length[-1] / _RESAMPLING_STEP) + 1)
    return np.interp(at, length, y), np.interp(at, length, z)


def _blur_curvature(
    y: FloatArray, z: FloatArray, smoothing: float, anchor: float
) -> tuple[FloatArray, FloatArray]:
    """The curve with its direction angle blurred along the arc length, meeting the original at `anchor`."""
    dy, dz = np.diff(y), np.diff(z)
    length = np.hypot(dy, dz)
    sigma = smoothing / float(length.mean())  # in samples, which are equally spaced
    angle = np.unwrap(np.arctan2(dz, dy))
    pad = min(math.ceil(10.0 * sigma), len(angle) - 1)  # constant curvature beyond the ends
    padded = np.pad(angle, pad, mode="reflect", reflect_type="odd")
    once = gaussian_filter1d(padded, sigma, truncate=5.0)
    twice = gaussian_filter1d(once, sigma, truncate=5.0)
    blurred = (2.0 * once - twice)[pad : len(padded) - pad]
    new_y = np.concatenate([[0.0], np.cumsum(length * np.cos(blurred))])
    new_z = np.concatenate([[0.0], np.cumsum(length * np.sin(blurred))])
    here = int(np.argmin(np.abs(y - anchor)))
    return new_y + y[here] - new_y[here], new_z + z[here] - new_z[here]


def _anchor(profile: Profile) -> float:
    """Lateral position at which smoothing does not move the profile: running circle or rail top [m]."""
    return 0.0 if profile.kind == "wheel" else float(profile.y[np.argmax(profile.z)])


def _single_valued(profile: Profile, y: FloatArray, z: FloatArray) -> tuple[int, int]:
    """First and last index of the stretch that is a function z(y) with slopes up to `MAX_SLOPE`."""
    middle = int(np.argmin(np.abs(y - _anchor(profile))))
    steep = np.abs(np.diff(z)) > MAX_SLOPE * np.diff(y)  # also true where y runs backwards
    before = np.flatnonzero(steep[:middle])
    after = np.flatnonzero(steep[middle:])
    first = int(before[-1]) + 1 if before.size else 0
    last = middle + int(after[0]) if after.size else len(y) - 1
    if profile.kind == "wheel":
        last = min(last, middle + int(np.argmin(z[middle:])))
    return first, last
