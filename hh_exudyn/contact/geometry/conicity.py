"""Equivalent conicity after EN 15302: from the free kinematic motion of a wheelset.

A wheelset that rolls without slip on straight track follows

    y'' = - dr(y) / (e r0),   dr = r_left - r_right, y positive to the left                          (1)

along the track (EN 15302, E: Klingel 1883 for cones): e is the tape distance, the lateral distance of the
nominal running circles, r0 the mean nominal radius. The equivalent conicity for an amplitude is that of the
cones with waves of the same length L,

    tan gamma_e = 2 e r0 (pi / L)^2                                                                  (2)

Equation 1 has the energy integral v^2 / 2 + S(y) = C, v = dy/dx, S the integral of dr / (e r0). With dr
piecewise linear in y (a table), v^2 is piecewise quadratic and each piece has a closed form: no step size,
and jumps of dr are as good as slopes.
"""

import math

import numpy as np
from scipy.optimize import brentq

from hh_exudyn.arrays import FloatArray

RESOLUTION = 0.1e-6  # m, of dr: below the rounding of profiles; a motion that sees no more has no conicity
_EVEN = 1e-12  # of the table's greatest |dr|: differences of S below it (times the amplitude) are rounding
_SCAN = 400  # orbits that are looked at for a change of sign


def conicity_from_radius_difference(
    lateral: FloatArray,
    delta_r: FloatArray,
    *,
    radius: float,
    tape_distance: float,
    amplitudes: FloatArray,
) -> FloatArray:
    """Equivalent conicity after EN 15302 from a table of the rolling radius difference.

    Parameters
    ----------
    lateral : FloatArray
        (n,) lateral displacement of the wheelset, not decreasing (two equal values make a jump) [m].
    delta_r : FloatArray
        (n,) rolling radius difference, positive where it steers a wheelset at positive `lateral` back; linear
        in between [m].
    radius : float
        Mean nominal wheel radius r0 [m], 0.1 .. 2.
    tape_distance : float
        Lateral distance of the nominal running circles e [m], 0.3 .. 3.
    amplitudes : FloatArray
        (m,) half the peak-to-peak displacement of the motion [m].

    Returns
    -------
    FloatArray
        (m,) tan gamma_e [-]. Zero where the motion meets no radius difference above `RESOLUTION` (a dead
        band wider than the motion). Negative where the difference drives away instead: the conicity of the
        difference with its sign changed. NaN where the motion would leave the table, or where no motion
        of that amplitude passes its middle (dr restoring outside and driving away inside).

    Raises
    ------
    ValueError
        Arrays of different lengths, fewer than two rows, not finite, `lateral` decreasing, a number out of
        its range, an amplitude that is not positive.

    Notes
    -----
    EN 15302:2008, the standard's integration of equation 1; there the solution is by numerical quadrature.
    The motion's middle is where S is even at both ends, so dr need not be odd nor zero at y = 0.
    """
    y = np.asarray(lateral, dtype=np.float64)
    dr = np.asarray(delta_r, dtype=np.float64)
    waves = np.atleast_1d(np.asarray(amplitudes, dtype=np.float64))
    _check_table(y, dr)
    _check_range("radius", radius, 0.1, 2.0)
    _check_range("tape_distance", tape_distance, 0.3, 3.0)
    if waves.ndim != 1 or not (np.isfinite(waves).all() and (waves > 0.0).all()):
        raise ValueError(f"amplitudes = {waves.tolist()} m: (m,) numbers, every amplitude must be positive")
    potential = _potential(y, dr)
    result = np.full(len(waves), math.nan)
    for k, amplitude in enumerate(waves):
        low = _lower_end(y, dr, potential, float(amplitude))
        if math.isnan(low):
            continue
        nodes, forces, energy = _stretch(y, dr, potential, low, low + 2.0 * float(amplitude))
        if np.abs(forces).max() <= RESOLUTION:
            result[k] = 0.0
            continue
        for sign in (1.0, -1.0):
            half_wave = _half_wave(nodes, sign * forces, sign * energy)
            if not math.isnan(half_wave):
                # the half wave is in units of sqrt(e r0): equation 2 with L = 2 half_wave sqrt(e r0)
                result[k] = sign * 0.5 * (math.pi / half_wave) ** 2
                break
    return result


def _check_table(y: FloatArray, dr: FloatArray) -> None:
    if y.ndim != 1 or y.shape != dr.shape or len(y) < 2:
        raise ValueError(f"lateral and delta_r: shapes {y.shape} and {dr.shape}, needed (n,) both, n >= 2")
    if not (np.isfinite(y).all() and np.isfinite(dr).all()):
        raise ValueError("lateral and delta_r must be finite [m]")
    if (np.diff(y) < 0.0).any():
        at = int(np.argmax(np.diff(y) < 0.0)) + 1
        raise ValueError(f"lateral[{at}] = {y[at]} m after {y[at - 1]} m: lateral must not decrease")


def _check_range(name: str, value: float, low: float, high: float) -> None:
    if not low <= value <= high:
        raise ValueError(f"{name} = {value} m, allowed {low} .. {high} m")


def _potential(y: FloatArray, dr: FloatArray) -> FloatArray:
    """e r0 S at the rows of the table: the integral of dr [m^2]."""
    return np.concatenate([[0.0], np.cumsum(0.5 * (dr[1:] + dr[:-1]) * np.diff(y))])


def _value(
    y: FloatArray, dr: FloatArray, potential: FloatArray, at: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """dr and its integral at any positions inside the table."""
    k = np.clip(np.searchsorted(y, at, side="right") - 1, 0, len(y) - 2)
    width = y[k + 1] - y[k]
    part = np.where(width > 0.0, (at - y[k]) / np.where(width > 0.0, width, 1.0), 0.0)
    here = dr[k] + part * (dr[k + 1] - dr[k])
    return here, potential[k] + 0.5 * (dr[k] + here) * (at - y[k])


def _lower_end(y: FloatArray, dr: FloatArray, potential: FloatArray, amplitude: float) -> float:
    """Where a motion of this amplitude turns on the low side; NaN where the table holds none.

    Both ends have the same S. Of several such orbits, the one whose middle is nearest to the table's
    equilibrium (its greatest restoring S) counts; inside a dead band, where all are, the most central one.
    """
    first, last = float(y[0]), float(y[-1]) - 2.0 * amplitude
    if last < first:
        # a table that ends just at the amplitudes holds one orbit, up to rounding
        if last < first - 1e-9 * amplitude:
            return math.nan
        last = first

    def unevenness(low: FloatArray | float) -> FloatArray:
        ends = np.asarray(low, dtype=np.float64)
        _, below = _value(y, dr, potential, ends)
        _, above = _value(y, dr, potential, np.minimum(ends + 2.0 * amplitude, y[-1]))
        return above - below

    even = _EVEN * float(np.abs(dr).max()) * amplitude
    candidates = np.unique(
        np.concatenate([np.linspace(first, last, _SCAN), [_equilibrium(y, dr) - amplitude]])
    )
    candidates = candidates[(candidates >= first) & (candidates <= last)]
    values = unevenness(candidates)
    centre = _equilibrium(y, dr) - amplitude
    found = list(candidates[np.abs(values) <= even])
    for k in np.flatnonzero(np.sign(values[:-1]) * np.sign(values[1:]) < 0.0):
        low, high = float(candidates[k]), float(candidates[k + 1])
        found.append(brentq(lambda at: float(unevenness(at)), low, high, xtol=1e-12))
    if not found:
        return math.nan
    return float(min(found, key=lambda at: abs(at - centre)))


def _equilibrium(y: FloatArray, dr: FloatArray) -> float:
    """The zero of dr nearest to y = 0 (middle of a dead band); 0 where dr has no zero."""
    zeros: list[float] = []
    flat = np.concatenate([[False], dr == 0.0, [False]])
    begins, ends = np.flatnonzero(flat[1:] & ~flat[:-1]), np.flatnonzero(flat[:-1] & ~flat[1:])
    zeros.extend(0.5 * (y[begins] + y[ends - 1]))
    k = np.flatnonzero(dr[:-1] * dr[1:] < 0.0)
    zeros.extend(y[k] - dr[k] * (y[k + 1] - y[k]) / (dr[k + 1] - dr[k]))
    return float(min(zeros, key=abs, default=0.0))


def _stretch(
    y: FloatArray, dr: FloatArray, potential: FloatArray, low: float, high: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Rows of the table between the ends of a motion, ends included: y, dr, and C - e r0 S."""
    apart = 1e-9 * (high - low)  # a row at an end is that end, up to rounding
    inside = (y > low + apart) & (y < high - apart)
    ends = np.array([low, min(high, float(y[-1]))])
    force, at_end = _value(y, dr, potential, ends)
    nodes = np.concatenate([ends[:1], y[inside], ends[1:]])
    forces = np.concatenate([force[:1], dr[inside], force[1:]])
    energy = 0.5 * at_end.sum() - np.concatenate([at_end[:1], potential[inside], at_end[1:]])
    energy[0] = energy[-1] = 0.0
    return nodes, forces, energy


def _half_wave(y: FloatArray, dr: FloatArray, energy: FloatArray) -> float:
    """Length of half a wave over sqrt(e r0) [-]; NaN where the motion cannot pass.

    Over a piece h of y where dr has the slope k, the motion is a harmonic one, and from speed v1 to v2 it
    takes (2 / sqrt k) atan(sqrt k h / (v1 + v2)); with the hyperbolic function for k < 0, 2 h / (v1 + v2)
    for k = 0.
    """
    scale = float(np.abs(dr).max()) * (y[-1] - y[0])
    if energy[1:-1].size and energy[1:-1].min() < -_EVEN * scale:
        return math.nan
    speed = np.sqrt(2.0 * np.maximum(energy, 0.0))
    h = np.diff(y)
    piece = h > 0.0
    h, sums = h[piece], (speed[1:] + speed[:-1])[piece]
    slope = np.diff(dr)[piece] / h
    if (sums <= 0.0).any():  # only within one piece from end to end: linear, its middle is the turning point
        return math.pi / math.sqrt(slope[0]) if len(h) == 1 and slope[0] > 0.0 else math.nan
    root = np.sqrt(np.abs(slope))
    x = root * h / sums
    with np.errstate(invalid="ignore", divide="ignore"):
        taken = np.where(
            slope > 0.0,
            2.0 / root * np.arctan(x),
            np.where(slope < 0.0, 2.0 / root * np.arctanh(x), 0.0),
        )
    straight = root * h < 1e-6 * sums
    taken[straight] = (2.0 * h / sums)[straight]
    return float(taken.sum())
