"""Ride index Wz after Sperling and mean comfort N_MV after EN 12299, of accelerations of the body.

Sperling weights an acceleration by frequency with

    B(f) = k sqrt((1.911 f^2 + (0.25 f^2)^2) / ((1 - 0.277 f^2)^2 + (1.563 f - 0.0368 f^3)^2)),          (1)

k = 0.588 vertically and 0.737 laterally, f in Hz. A sine of amplitude a [cm/s^2] has Wz = (a B)^0.3; any
signal the Wz of the sine of its weighted effective value, (100 sqrt(2) a_w)^0.3 with a_w in m/s^2.

EN 12299 weights with Wd along and across and with Wb vertically (ISO 2631, EN 12299), takes effective values
over 5 s and their 95th percentiles over 5 minutes:

    N_MV = 6 sqrt(ax95^2 + ay95^2 + az95^2)                                                             (2)

Both weightings are applied to the whole spectrum of a run, without a shift in time; numbers and their sources
are in `data/assessment.toml`. A freight wagon has no passengers: its numbers compare vehicles and tracks.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft, rfftfreq
from scipy.signal import freqs

from hh_exudyn.arrays import FloatArray
from hh_exudyn.assessment.accelerations import PointAccelerations
from hh_exudyn.assessment.limits import data

Weighting = Callable[[FloatArray], FloatArray]  # gain over frequency [Hz]

RIDE_SCALE = (  # from Wz on: Table 4 of Urban Rail Transit (2015), doi 10.1007/s40864-015-0007-8, as read
    (0.0, "below notice"),
    (1.0, "just noticeable"),
    (2.0, "clearly noticeable"),
    (2.5, "more pronounced, not unpleasant"),
    (3.0, "strong, irregular, tolerable"),
    (3.25, "very irregular"),
    (3.5, "extremely irregular, unpleasant"),
    (4.0, "extremely unpleasant"),
)
COMFORT_SCALE = (  # from N_MV on: EN 12299 from memory, unconfirmed
    (0.0, "very comfortable"),
    (1.5, "comfortable"),
    (2.5, "medium"),
    (3.5, "uncomfortable"),
    (4.5, "very uncomfortable"),
)
_LOWEST = 0.4  # Hz, of all weightings
_PERIODS = 3.0  # of it: continuation of both ends


@dataclass(frozen=True)
class RideIndex:
    """Ride and comfort of one place of the body over a run.

    Attributes
    ----------
    place : str
        "car_body over bogie 1".
    sperling_lateral, sperling_vertical : float
        Wz [-].
    comfort : float
        N_MV [-]; NaN for a run shorter than one window.
    weighted : (float, float, float)
        95th percentiles of the weighted effective values along, across and vertically [m/s^2].
    windows : int
        Windows of 5 s in the run; the standard takes 60.
    """

    place: str
    sperling_lateral: float
    sperling_vertical: float
    comfort: float
    weighted: tuple[float, float, float]
    windows: int


def ride_indices(felt: PointAccelerations) -> tuple[RideIndex, ...]:
    """Ride and comfort at every place.

    Parameters
    ----------
    felt : PointAccelerations
        At equal intervals of time.
    """
    found = []
    how = data()["comfort"]
    for i, place in enumerate(felt.places):
        values = (felt.longitudinal[:, i], felt.lateral[:, i], felt.vertical[:, i])
        weightings = (comfort_lateral, comfort_lateral, comfort_vertical)
        over_windows = [
            window_values(weighted(own, felt.interval, weighting), felt.interval, how["window_s"])
            for own, weighting in zip(values, weightings, strict=True)
        ]
        count = over_windows[0].size
        largest = [
            float(np.percentile(own, how["percentile"])) if count else math.nan for own in over_windows
        ]
        found.append(
            RideIndex(
                place,
                sperling(values[1], felt.interval, "lateral"),
                sperling(values[2], felt.interval, "vertical"),
                how["factor"] * math.hypot(*largest),
                (largest[0], largest[1], largest[2]),
                count,
            )
        )
    return tuple(found)


def sperling(values: FloatArray, interval: float, direction: str) -> float:
    """Sperling's ride index Wz of an acceleration [-].

    Parameters
    ----------
    values : (n,) array
        Acceleration at equal intervals [m/s^2].
    interval : float
        Between values [s].
    direction : str
        "lateral" or "vertical".
    """
    mean_square = float(np.mean(weighted(values, interval, lambda f: sperling_weighting(f, direction)) ** 2))
    return float((100.0 * math.sqrt(2.0 * mean_square)) ** data()["sperling"]["exponent"])


def sperling_weighting(frequency: FloatArray, direction: str) -> FloatArray:
    """B of equation (1) [-].

    Parameters
    ----------
    frequency : array
        [Hz].
    direction : str
        "lateral" or "vertical".
    """
    row, f = data()["sperling"], np.asarray(frequency)
    above = row["a"] * f**2 + row["b"] * f**4
    below = (1.0 - row["c"] * f**2) ** 2 + (row["d"] * f - row["e"] * f**3) ** 2
    gain: FloatArray = row[direction] * np.sqrt(above / below)
    return gain


def comfort_lateral(frequency: FloatArray) -> FloatArray:
    """Gain of Wd [-] over frequency [Hz]."""
    return _comfort_gain(frequency, data()["comfort"]["lateral"])


def comfort_vertical(frequency: FloatArray) -> FloatArray:
    """Gain of Wb [-] over frequency [Hz]."""
    row = data()["comfort"]["vertical"]
    (w5, w6), (q3, q4) = _angular(row["step_Hz"]), row["step_quality"]
    upper, lower = [1.0 / w5**2, 1.0 / (q3 * w5), 1.0], [1.0 / w6**2, 1.0 / (q4 * w6), 1.0]
    gain: FloatArray = row["gain"] * _gain(frequency, upper, lower) * _comfort_gain(frequency, row)
    return gain


def _comfort_gain(frequency: FloatArray, row: dict[str, Any]) -> FloatArray:
    """Band limits and transition from acceleration to velocity, in all weightings of ISO 2631."""
    (w1, w2), (w3, w4), quality = (
        _angular(row["band_Hz"]), _angular(row["transition_Hz"]), row["transition_quality"],
    )  # fmt: skip
    high = _gain(frequency, [1.0, 0.0, 0.0], [1.0, math.sqrt(2.0) * w1, w1**2])
    low = _gain(frequency, [w2**2], [1.0, math.sqrt(2.0) * w2, w2**2])
    return high * low * _gain(frequency, [w4**2 / w3, w4**2], [1.0, w4 / quality, w4**2])


def _angular(frequencies: tuple[float, float]) -> tuple[float, float]:
    return 2.0 * math.pi * frequencies[0], 2.0 * math.pi * frequencies[1]


def _gain(frequency: FloatArray, numerator: list[float], denominator: list[float]) -> FloatArray:
    """Amplitude of an analogue filter over frequency [Hz]."""
    _, response = freqs(numerator, denominator, worN=2.0 * math.pi * np.asarray(frequency))
    gain: FloatArray = np.abs(response)
    return gain


def weighted(values: FloatArray, interval: float, weighting: Weighting) -> FloatArray:
    """A signal weighted by frequency, without a shift in time.

    Both ends are continued by their point reflection, which fades out over three periods of the lowest
    frequency of the weightings.

    Parameters
    ----------
    values : (n,) array
        At equal intervals; their mean is left out.
    interval : float
        Between values [s].
    weighting : callable
        Gain over frequency [Hz].
    """
    x = values - values.mean()
    padded = min(len(x) - 1, math.ceil(_PERIODS / (_LOWEST * interval)))
    fade = 0.5 - 0.5 * np.cos(np.pi * np.arange(padded) / padded)
    before = fade * (2.0 * x[0] - x[padded:0:-1])
    behind = fade[::-1] * (2.0 * x[-1] - x[-2 : -padded - 2 : -1])
    whole = np.concatenate([before, x, behind])
    count = next_fast_len(2 * len(whole), real=True)
    spectrum = rfft(whole, count) * weighting(rfftfreq(count, interval))
    passed: FloatArray = irfft(spectrum, count)[padded : padded + len(x)]
    return passed


def window_values(values: FloatArray, interval: float, window: float) -> FloatArray:
    """Effective values over windows that follow each other; a remainder at the end is left out.

    Parameters
    ----------
    values : (n,) array
        At equal intervals.
    interval, window : float
        Between values, and length of a window [s].
    """
    length = round(window / interval)
    whole = len(values) // length
    return np.sqrt(np.mean(values[: whole * length].reshape(whole, length) ** 2, axis=1))


def word_of(scale: tuple[tuple[float, str], ...], value: float) -> str:
    """What a scale calls a value; empty for NaN."""
    return next((word for least, word in reversed(scale) if value >= least), "")
