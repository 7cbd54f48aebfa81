"""Bands of wavelengths, as recording cars and quality limits use them, and the filter that separates them.

The filter is a Butterworth high-pass and a Butterworth low-pass, each of order 4 and run forwards and
backwards: no phase shift, 48 dB an octave beyond the edges. The edges of the single passes are set so that
both passes together have -3 dB (half the variance) at the wavelengths asked for.
"""

import math

import numpy as np
from scipy.signal import butter, sosfiltfilt

from hh_exudyn.arrays import FloatArray
from track.irregularity.spectra import check_wavelengths

D1 = (3.0, 25.0)  # m, EN 13848-1
D2 = (25.0, 70.0)  # m
ORDER = 4  # of the Butterworth filters

_LEAST_SAMPLES = 2.5  # a wavelength: beyond, the digital filter's edge would lie at the Nyquist frequency
_LEAST_LENGTH = 2.0  # longest wavelengths that the signal must be long
_TWICE = (math.sqrt(2.0) - 1.0) ** (0.5 / ORDER)  # (1 + x^(2 ORDER))^-2 = 1/2: two passes have -3 dB at x


def band_pass(values: FloatArray, step: float, wavelengths: tuple[float, float]) -> FloatArray:
    """The part of samples in a band of wavelengths, with zero phase.

    Parameters
    ----------
    values : (n,) or (n, m) array
        Samples at equal spacing along the first axis.
    step : float
        Spacing [m].
    wavelengths : (float, float)
        Shortest and longest [m], as `D1` and `D2`.

    Raises
    ------
    ValueError
        Wavelengths out of range, fewer than 2.5 samples on the shortest, or less than two of the longest.
    """
    check_wavelengths("wavelengths", wavelengths)
    shortest, longest = wavelengths
    if not 0.0 < step <= shortest / _LEAST_SAMPLES:
        raise ValueError(
            f"step is {step} m, for wavelengths from {shortest:g} m allowed is up to "
            f"{shortest / _LEAST_SAMPLES:g} m"
        )
    length = step * (len(values) - 1)
    if not length >= _LEAST_LENGTH * longest:
        raise ValueError(
            f"length is {length:g} m, for wavelengths up to {longest:g} m allowed is from "
            f"{_LEAST_LENGTH * longest:g} m"
        )
    high = butter(ORDER, _edge(step / longest, _TWICE), btype="highpass", output="sos")
    low = butter(ORDER, _edge(step / shortest, 1.0 / _TWICE), btype="lowpass", output="sos")
    # both ends are continued by their point reflection, over up to two of the longest wavelengths
    beyond = min(len(values) - 1, round(2.0 * longest / step))
    passed: FloatArray = sosfiltfilt(np.vstack([high, low]), values, axis=0, padtype="odd", padlen=beyond)
    return passed


def _edge(cycles: float, ratio: float) -> float:
    """Edge of one pass as part of the Nyquist frequency, from the band's edge in cycles a sample.

    The bilinear transform bends frequencies by the tangent; `ratio` holds before it.
    """
    return 2.0 / math.pi * math.atan(ratio * math.tan(math.pi * cycles))
