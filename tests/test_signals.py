"""Filters of zero phase: gain at the named frequency, no shift, padding at the ends, refusals."""

import math

import numpy as np
import pytest

from hh_exudyn.log.wheel_forces import WheelForces
from hh_exudyn.signals import band_pass, low_pass
from track.irregularity.wavelength_bands import wavelength_band

HALF_POWER = math.sqrt(0.5)


def sine(frequency: float, interval: float, length: float = 60.0) -> tuple[np.ndarray, np.ndarray]:
    """Places and values; the filters' ends are the outer quarters."""
    place = interval * np.arange(round(length / interval))
    return place, np.sin(2.0 * math.pi * frequency * place + 0.4)


def gain(before: np.ndarray, after: np.ndarray) -> float:
    """Of the inner half, by least squares; asserts that nothing but the amplitude has changed."""
    inside = slice(len(before) // 4, -len(before) // 4)
    found = float(before[inside] @ after[inside] / (before[inside] @ before[inside]))
    assert after[inside] == pytest.approx(found * before[inside], abs=2e-3)  # zero phase
    return found


def expected(frequency: float, cutoff: float, interval: float) -> float:
    """Amplitude after two passes of fourth order, through the bilinear transform."""
    ratio = math.tan(math.pi * frequency * interval) / math.tan(math.pi * cutoff * interval)
    return 1.0 / (1.0 + (math.sqrt(2.0) - 1.0) * ratio**8)


@pytest.mark.parametrize("interval", [0.001, 0.004, 0.01])
@pytest.mark.parametrize("frequency", [2.0, 15.0, 20.0, 30.0])
def test_low_pass_scales_a_sine_and_shifts_nothing(interval: float, frequency: float) -> None:
    _, wave = sine(frequency, interval)
    found = gain(wave, low_pass(wave, interval, 20.0))
    assert found == pytest.approx(expected(frequency, 20.0, interval), abs=1e-6)
    if frequency == 20.0:
        assert found == pytest.approx(HALF_POWER, rel=0.01)


@pytest.mark.parametrize("frequency", [0.4, 10.0])
def test_band_pass_has_half_the_power_at_both_edges(frequency: float) -> None:
    _, wave = sine(frequency, 0.004)
    assert gain(wave, band_pass(wave, 0.004, (0.4, 10.0))) == pytest.approx(HALF_POWER, rel=0.01)


@pytest.mark.parametrize(("frequency", "left"), [(0.0, 0.0), (0.1, 0.0), (2.0, 1.0), (40.0, 0.0)])
def test_band_pass_keeps_its_band_alone(frequency: float, left: float) -> None:
    _, wave = sine(frequency, 0.004)
    assert gain(wave, band_pass(wave, 0.004, (0.4, 10.0))) == pytest.approx(left, abs=2e-3)


def test_forces_and_track_have_the_same_filter() -> None:
    """The cut-off of wheel forces and both wavelengths of a track band leave half the power, too."""
    time, wave = sine(20.0, 0.004)
    Q = np.repeat(wave[:, None, None], 2, axis=2)
    smooth = WheelForces(time, time[:, None], Q, Q).filtered(20.0)
    assert gain(wave, smooth.Q[:, 0, 1]) == pytest.approx(HALF_POWER, rel=0.01)
    for wavelength in (3.0, 25.0):
        _, wave = sine(1.0 / wavelength, 0.25, 1000.0)
        assert gain(wave, wavelength_band(wave, 0.25, (3.0, 25.0))) == pytest.approx(HALF_POWER, rel=0.01)


@pytest.mark.parametrize("interval", [0.0005, 0.004, 0.01])
def test_ends_are_continued_by_their_point_reflection(interval: float) -> None:
    """A constant and a slope pass whole up to the first and last sample; so does a signal of two samples.

    Of the change in one period of the cut-off (0.1) the edge of the padding leaves less than 1e-3.
    """
    time = interval * np.arange(round(2.0 / interval))
    for values in (np.full(time.size, 3.0), 5.0 - 2.0 * time):
        assert low_pass(values, interval, 20.0) == pytest.approx(values, abs=1e-4)
    two = np.array([3.0, 3.0])
    assert low_pass(two, interval, 20.0) == pytest.approx(two)


def test_a_slow_sine_is_kept_at_the_ends() -> None:
    """Within one per cent of its amplitude, at the first sample as in the middle."""
    time = 0.004 * np.arange(1000)
    wave = np.sin(2.0 * math.pi * time)
    assert low_pass(wave, 0.004, 20.0) == pytest.approx(wave, abs=0.01)


def test_columns_are_filtered_each_by_itself() -> None:
    rng = np.random.default_rng(3)
    values = rng.normal(size=(400, 2, 3))
    together = low_pass(values, 0.004, 20.0)
    assert together[:, 1, 2] == pytest.approx(low_pass(values[:, 1, 2], 0.004, 20.0))


def test_bad_signals_are_refused() -> None:
    values = np.arange(10.0)
    for cutoff in (60.0, 50.0, 0.0, -1.0, math.nan):
        with pytest.raises(
            ValueError, match=rf"cut-off is {cutoff} Hz, allowed are above 0 to below 49\.968 Hz"
        ):
            low_pass(values, 0.01, cutoff)
    with pytest.raises(ValueError, match=r"the signal is 0\.1 s long, above 7\.5 s are needed: 3 periods of"):
        band_pass(values, 0.01, (0.4, 10.0))
    with pytest.raises(ValueError, match="band is 10 to 10 Hz"):
        band_pass(np.zeros(5000), 0.01, (10.0, 10.0))
