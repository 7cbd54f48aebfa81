"""Filters without shift in time, sliding means and effective values over distance.

The table of UIC 518 that was at hand names cut-off frequencies only. So: Butterworth of fourth order, run
forwards and backwards (a run is assessed afterwards, nothing has to be causal), with 1/sqrt(2) of the
amplitude (-3 dB) left at the cut-off after both passes.
"""

import math

import numpy as np
from scipy.signal import butter, sosfiltfilt

from hh_exudyn.arrays import FloatArray

ORDER = 4
_TWO_PASSES = (math.sqrt(2.0) - 1.0) ** (-0.5 / ORDER)  # cut-off of one pass over that of both, low-pass


def single_pass_cutoff(frequency: float, interval: float, high_pass: bool = False) -> float:
    """Cut-off of a single pass [Hz] for -3 dB at `frequency` [Hz] after two, at this sampling interval [s].

    Two passes leave 1 / (1 + w^8) of the amplitude, w the ratio of the frequencies as the bilinear transform
    sees them: tan(pi f interval).

    Raises ValueError unless the frequency is above 0 and both lie below half the sampling rate.
    """
    factor = 1.0 / _TWO_PASSES if high_pass else _TWO_PASSES
    highest = math.atan(1e3 / _TWO_PASSES) / (math.pi * interval)  # just below half the rate
    if not 0.0 < frequency < highest:
        raise ValueError(f"cut-off is {frequency} Hz, allowed are above 0 to below {highest:.4g} Hz")
    return math.atan(factor * math.tan(math.pi * frequency * interval)) / (math.pi * interval)


def low_pass(values: FloatArray, interval: float, frequency: float) -> FloatArray:
    """What is slower than a frequency [Hz], of (n, ...) values at equal intervals [s]."""
    sections = butter(ORDER, single_pass_cutoff(frequency, interval), fs=1.0 / interval, output="sos")
    result: FloatArray = sosfiltfilt(sections, values, axis=0)
    return result


def band_pass(values: FloatArray, interval: float, band: tuple[float, float]) -> FloatArray:
    """What lies between two frequencies [Hz] of (n, ...) values at equal intervals [s].

    Raises
    ------
    ValueError
        A frequency out of range, the lower not below the upper, or fewer values than three periods of the
        lower one.
    """
    low, high = band
    if not low < high:
        raise ValueError(f"band is {low:g} to {high:g} Hz, the first must be below the second")
    needed = math.ceil(3.0 / (low * interval))
    if values.shape[0] <= needed:
        raise ValueError(
            f"the run is {values.shape[0] * interval:.3g} s long, {needed * interval:.3g} s are needed: "
            f"three periods of {low:g} Hz"
        )
    rate = 1.0 / interval
    upper = butter(ORDER, single_pass_cutoff(high, interval), fs=rate, output="sos")
    lower = butter(ORDER, single_pass_cutoff(low, interval, high_pass=True), "high", fs=rate, output="sos")
    result: FloatArray = sosfiltfilt(np.vstack([lower, upper]), values, axis=0, padlen=needed)
    return result


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
        s that does not increase, a window of no length or beyond the values.
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
    """
    room = end - start - window
    if room < -1e-9:
        raise ValueError(f"{end - start:g} m are too short for a window of {window:g} m")
    number: FloatArray = np.arange(math.floor(room / step + 1e-9) + 1, dtype=np.float64)
    return start + 0.5 * window + step * number
