"""Accelerations of the body in the band of the standards, and effective values that show instability.

f0 is the peak frequency of the spectrum of sum Y; in a stable run it is not a frequency of hunting, and the
effective values about it are then small.
"""

from collections.abc import Iterator

import numpy as np
from scipy.signal import welch

from hh_exudyn.assessment.accelerations import PointAccelerations
from hh_exudyn.assessment.findings import Finder, Finding, History
from hh_exudyn.assessment.limits import data
from hh_exudyn.assessment.windows import sliding_rms, window_centres
from hh_exudyn.signals import band_pass, low_pass


def body_histories(felt: PointAccelerations) -> dict[str, History]:
    """Accelerations of the body over its bogies, in the standard's band and below 20 Hz.

    Parameters
    ----------
    felt : PointAccelerations
        As logged.
    """
    how = data()["processing"]
    band = tuple(how["acceleration_band_Hz"])
    slow = low_pass(felt.lateral, felt.interval, how["low_pass_Hz"])
    found = {"body_lateral_slow": History(felt.places, felt.s, slow)}
    for name, values in (("body_lateral", felt.lateral), ("body_vertical", felt.vertical)):
        found[name] = History(felt.places, felt.s, band_pass(values, felt.interval, band))
    return found


def peak_frequency(sum_y: History, interval: float) -> float:
    """f0, the peak frequency of the mean spectrum of sum Y of all wheelsets [Hz].

    Parameters
    ----------
    sum_y : History
        As logged.
    interval : float
        Between values [s].
    """
    low, high = data()["processing"]["instability"]["search_Hz"]
    count = min(len(sum_y.values), round(4.0 / interval))
    frequency, density = welch(sum_y.values, 1.0 / interval, nperseg=count, detrend="linear", axis=0)
    searched = (frequency >= low) & (frequency <= high)
    return float(frequency[searched][np.argmax(density[searched].mean(axis=1))])


def about_the_peak(raw: History, interval: float, f0: float) -> History:
    """A signal about f0, its lower edge not below that of the accelerations.

    Parameters
    ----------
    raw : History
        As logged.
    interval : float
        Between values [s].
    f0 : float
        [Hz].
    """
    how = data()["processing"]
    half = how["instability_half_band_Hz"]
    band = max(f0 - half, how["acceleration_band_Hz"][0]), f0 + half
    return History(raw.places, raw.s, band_pass(raw.values, interval, band))


def behaviour_findings(finder: Finder) -> Iterator[Finding]:
    """All quantities of this file in one section."""
    how = data()["processing"]
    for name in ("body_lateral", "body_vertical"):
        yield from finder.extremes(name, name, how["percentiles"], True)
    for name in ("body_lateral", "body_vertical"):
        for place, values in finder.courses(name):
            yield finder.finding(f"{name}_rms", place, float(np.sqrt(np.mean(values**2))))
    if finder.section.curved:
        for place, values in finder.courses("body_lateral_slow"):
            middle = float(np.percentile(values, how["quasi_static_percentile"]))
            yield finder.finding("body_lateral_quasi_static", place, abs(middle))
    for name in ("sum_y_rms", "bogie_lateral_rms"):
        if name in finder.histories:
            for place, value in _largest_rms(finder.histories[name], finder):
                yield finder.finding(name, place, value)


def _largest_rms(history: History, finder: Finder) -> Iterator[tuple[str, float]]:
    """Largest sliding effective value; a section shorter than the window is one window."""
    how = data()["processing"]["instability"]
    for i, place in enumerate(history.places):
        s = history.s[:, i]
        start, end = max(finder.section.start, float(s[0])), min(finder.section.end, float(s[-1]))
        window = min(float(how["window_m"]), end - start)
        centres = window_centres(start, end, window, how["step_m"])
        yield place, float(sliding_rms(s, history.values[:, i], centres, window).max())
