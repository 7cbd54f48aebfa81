"""Filters of zero phase: low pass and band pass.

Butterworth filters of fourth order, run forwards and backwards: no shift along the signal, 48 dB an octave
beyond the cut-off. -3 dB, which is 1 / sqrt(2) of the amplitude or half the power, holds at the named
frequency after BOTH passes, at any sampling interval; 0.5 of the amplitude, as after two plain passes, would
not be the filter of the standards. The gain of both passes is

    1 / (1 + (sqrt(2) - 1) w^8),    w = tan(pi f dt) / tan(pi f_c dt)

(the tangents are the bilinear transform's). Along the track, intervals are in m and frequencies in 1/m.
"""

import math

import numpy as np
from scipy.signal import butter, sosfiltfilt

from hh_exudyn.arrays import FloatArray

ORDER = 4  # of each pass
PERIODS = 3.0  # of the lowest cut-off frequency: length of the continuation of both ends

_TWO_PASSES = (math.sqrt(2.0) - 1.0) ** (-0.5 / ORDER)  # cut-off of one low-pass over that of both passes
_HIGHEST_TANGENT = 1e3  # of the cut-off frequencies: half the sampling rate has an infinite one


def low_pass(values: FloatArray, interval: float, cutoff: float) -> FloatArray:
    """The part of a signal below a cut-off frequency.

    Both ends are continued by their point reflection over `PERIODS` periods of the cut-off, as far as the
    signal reaches: constants and slopes pass unchanged, up to the ends.

    Parameters
    ----------
    values : (n, ...) array
        Samples at equal intervals along the first axis.
    interval : float
        Between samples [s].
    cutoff : float
        Frequency with the gain 1 / sqrt(2) [Hz].

    Raises
    ------
    ValueError
        A cut-off not above 0 and below half the sampling rate.
    """
    padding = min(len(values) - 1, _periods(cutoff, interval))
    passed: FloatArray = sosfiltfilt(_pass(cutoff, interval, "low"), values, axis=0, padlen=padding)
    return passed


def band_pass(
    values: FloatArray, interval: float, band: tuple[float, float], padding: float | None = None
) -> FloatArray:
    """The part of a signal between two frequencies.

    Parameters
    ----------
    values, interval
        As for `low_pass`.
    band : (float, float)
        Lower and upper frequency, each with the gain 1 / sqrt(2) [Hz].
    padding : float or None
        Length over which both ends are continued by their point reflection [s]; None, the default, for
        `PERIODS` periods of the lower frequency.

    Raises
    ------
    ValueError
        A frequency not above 0 and below half the sampling rate, the lower not below the upper, or a signal
        that is no longer than the padding.
    """
    low, high = band
    if not low < high:
        raise ValueError(f"band is {low:g} to {high:g} Hz, the first must be below the second")
    sections = np.vstack([_pass(low, interval, "high"), _pass(high, interval, "low")])
    padded = _periods(low, interval) if padding is None else round(padding / interval)
    if len(values) <= padded:
        raise ValueError(
            f"the signal is {len(values) * interval:.3g} s long, above {padded * interval:.3g} s are needed: "
            f"{padded * interval * low:.3g} periods of {low:g} Hz"
        )
    passed: FloatArray = sosfiltfilt(sections, values, axis=0, padlen=padded)
    return passed


def _pass(cutoff: float, interval: float, kind: str) -> FloatArray:
    """Second-order sections of one pass ("low" or "high"), two of which have -3 dB at the cut-off [Hz]."""
    rate = 1.0 / interval
    highest = math.atan(_HIGHEST_TANGENT) / math.pi * rate
    if not 0.0 < cutoff < highest:
        raise ValueError(f"cut-off is {cutoff} Hz, allowed are above 0 to below {highest:.5g} Hz")
    ratio = _TWO_PASSES if kind == "low" else 1.0 / _TWO_PASSES
    single = math.atan(ratio * math.tan(math.pi * cutoff * interval)) / math.pi * rate
    sections: FloatArray = butter(ORDER, single, kind, fs=rate, output="sos")
    return sections


def _periods(frequency: float, interval: float) -> int:
    """Samples in `PERIODS` periods of a frequency [Hz]."""
    return math.ceil(PERIODS / (frequency * interval) - 1e-9) if frequency > 0.0 else 0
