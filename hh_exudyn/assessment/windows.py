"""Sliding means and effective values over distance, between unequal places."""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray


def sliding_mean(s: FloatArray, values: FloatArray, centres: FloatArray, window: float) -> FloatArray:
    """Means over `window` metres about the centres of values that are linear between their places s.

    Parameters
    ----------
    s, values : (n,) arrays
        Arc length, increasing [m]; the values.
    centres : (m,) array
        [m]; windows must lie within s.
    window : float
        [m].

    Raises
    ------
    ValueError
        s that does not increase, a window of length 0 or beyond the values.
    """
    if not np.all(np.diff(s) > 0.0):
        raise ValueError("arc length does not increase all along: the vehicle stood still or rolled back")
    first, last = centres - 0.5 * window, centres + 0.5 * window
    if not window > 0.0 or (centres.size and (first.min() < s[0] - 1e-9 or last.max() > s[-1] + 1e-9)):
        raise ValueError(f"a window of {window:g} m reaches beyond {s[0]:.2f} to {s[-1]:.2f} m")
    steps = np.diff(s)
    slope = np.diff(values) / steps
    sums = np.concatenate([[0.0], np.cumsum(0.5 * steps * (values[:-1] + values[1:]))])

    def integral(x: FloatArray) -> FloatArray:
        i = np.clip(np.searchsorted(s, x, side="right") - 1, 0, steps.size - 1)
        u = x - s[i]
        whole: FloatArray = sums[i] + values[i] * u + 0.5 * slope[i] * u**2
        return whole

    result: FloatArray = (integral(last) - integral(first)) / window
    return result


def sliding_rms(s: FloatArray, values: FloatArray, centres: FloatArray, window: float) -> FloatArray:
    """Effective values (root of the mean square) over `window` metres; parameters as `sliding_mean`."""
    result: FloatArray = np.sqrt(np.maximum(sliding_mean(s, values**2, centres, window), 0.0))
    return result


def window_centres(start: float, end: float, window: float, step: float) -> FloatArray:
    """Centres of windows `step` metres apart that lie wholly between two places [m]; at least one.

    Raises ValueError where not one window fits.

    Parameters
    ----------
    start, end : float
        Ends of the range [m].
    window : float
        Length of a window [m].
    step : float
        Distance of the centres [m].
    """
    room = end - start - window
    if room < -1e-9:
        raise ValueError(f"{end - start:g} m are too short for a window of {window:g} m")
    number: FloatArray = np.arange(math.floor(room / step + 1e-9) + 1, dtype=np.float64)
    return start + 0.5 * window + step * number
