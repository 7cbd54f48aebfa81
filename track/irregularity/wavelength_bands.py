"""Bands of wavelengths, as recording cars and quality limits use them.

The filter is that of `hh_exudyn.signals`: zero phase, -3 dB (half the variance) at both named wavelengths.
"""

from hh_exudyn import signals
from hh_exudyn.arrays import FloatArray
from track.irregularity.spectra import check_wavelengths

D1 = (3.0, 25.0)  # m, EN 13848-1
D2 = (25.0, 70.0)  # m

LEAST_SAMPLES = 2.5  # per wavelength; with 2 the filter's edge would lie at the Nyquist frequency
_LEAST_LENGTH = 2.0  # least length of the signal over the longest wavelength
_PADDED_LENGTH = 2.0  # length of the continuation of both ends over the longest wavelength


def wavelength_band(values: FloatArray, step: float, wavelengths: tuple[float, float]) -> FloatArray:
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
    if not 0.0 < step <= shortest / LEAST_SAMPLES:
        raise ValueError(
            f"step is {step} m, for wavelengths from {shortest:g} m allowed is up to "
            f"{shortest / LEAST_SAMPLES:g} m"
        )
    length = step * (len(values) - 1)
    if not length >= _LEAST_LENGTH * longest:
        raise ValueError(
            f"length is {length:g} m, for wavelengths up to {longest:g} m allowed is from "
            f"{_LEAST_LENGTH * longest:g} m"
        )
    return signals.band_pass(
        values, step, (1.0 / longest, 1.0 / shortest), padding=min(length, _PADDED_LENGTH * longest)
    )
