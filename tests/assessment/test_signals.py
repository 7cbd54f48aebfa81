"""Filters and sliding means of the assessment against exact signals."""

import math

import numpy as np
import pytest

from hh_exudyn.assessment.signals import (
    band_pass,
    low_pass,
    single_pass_cutoff,
    sliding_mean,
    sliding_rms,
    window_centres,
)
from hh_exudyn.log.wheel_forces import WheelForces

INSIDE = slice(1500, -1500)


def sine(frequency: float, interval: float, seconds: float = 30.0) -> tuple[np.ndarray, np.ndarray]:
    time = interval * np.arange(round(seconds / interval))
    return time, np.sin(2.0 * math.pi * frequency * time)


def left_of(frequency: float, cutoff: float, interval: float) -> float:
    """Amplitude after two passes of fourth order, through the bilinear transform."""
    ratio = math.tan(math.pi * frequency * interval) / math.tan(math.pi * cutoff * interval)
    return 1.0 / (1.0 + (math.sqrt(2.0) - 1.0) * ratio**8)


@pytest.mark.parametrize("interval", [0.001, 0.004, 0.01])
@pytest.mark.parametrize("frequency", [2.0, 15.0, 20.0, 30.0])
def test_low_pass_scales_a_sine_and_shifts_nothing(interval: float, frequency: float) -> None:
    time, wave = sine(frequency, interval)
    inside = slice(time.size // 10, -time.size // 10)
    expected = left_of(frequency, 20.0, interval)
    assert low_pass(wave, interval, 20.0)[inside] == pytest.approx(expected * wave[inside], abs=1e-6)
    if frequency == 20.0:
        assert expected == pytest.approx(math.sqrt(0.5))  # -3 dB, at any output interval


def test_wheel_forces_have_the_same_filter() -> None:
    """`WheelForces.filtered` halves at its own cut-off; at this one it leaves -3 dB at 20 Hz."""
    time, wave = sine(20.0, 0.004)
    Q = np.repeat(wave[:, None, None], 2, axis=2)
    forces = WheelForces(time, time[:, None], Q, Q)
    smooth = forces.filtered(single_pass_cutoff(20.0, forces.interval)).Q[INSIDE, 0, 0]
    assert smooth == pytest.approx(math.sqrt(0.5) * wave[INSIDE], abs=1e-6)


@pytest.mark.parametrize(
    ("frequency", "left"), [(0.0, 0.0), (0.1, 0.0), (0.4, 0.7071), (2.0, 1.0), (10.0, 0.7071), (40.0, 0.0)]
)
def test_band_pass(frequency: float, left: float) -> None:
    time, wave = sine(frequency, 0.004, 60.0)
    if frequency == 0.0:
        wave = np.full(time.size, 3.0)
    inside = (time > 15.0) & (time < 45.0)
    assert band_pass(wave, 0.004, (0.4, 10.0))[inside] == pytest.approx(left * wave[inside], abs=2e-3)


def test_sliding_mean_of_a_ramp_is_its_middle_at_any_spacing() -> None:
    s = np.cumsum(np.random.default_rng(1).uniform(0.01, 0.3, 500))
    centres = np.arange(5.0, 50.0, 0.5)
    assert sliding_mean(s, 3.0 * s - 7.0, centres, 2.0) == pytest.approx(3.0 * centres - 7.0)
    assert sliding_rms(s, np.full(s.size, -4.0), centres, 5.0) == pytest.approx(4.0)


def test_sliding_mean_of_a_sine_and_a_step() -> None:
    s = np.arange(0.0, 60.0, 0.01)
    centres = np.arange(5.0, 50.0, 0.5)
    k = 2.0 * math.pi / 7.0
    expected = np.sin(k * centres) * math.sin(k) / k  # sinc of half the window
    assert sliding_mean(s, np.sin(k * s), centres, 2.0) == pytest.approx(expected, abs=1e-5)
    assert sliding_mean(s, np.sin(2.0 * math.pi * s), centres, 2.0) == pytest.approx(0.0, abs=1e-9)
    rms = sliding_rms(s, 5.0 * np.sin(k * s), np.array([30.0]), 14.0)
    assert rms == pytest.approx(5.0 / math.sqrt(2.0), rel=1e-4)


def test_windows_lie_inside() -> None:
    assert window_centres(10.0, 13.0, 2.0, 0.5).tolist() == [11.0, 11.5, 12.0]
    assert window_centres(10.0, 12.0, 2.0, 0.5).tolist() == [11.0]
    with pytest.raises(ValueError, match="1 m are too short for a window of 2 m"):
        window_centres(10.0, 11.0, 2.0, 0.5)


def test_bad_signals_are_refused() -> None:
    s = np.arange(10.0)
    with pytest.raises(ValueError, match=r"beyond 0\.00 to 9\.00 m"):
        sliding_mean(s, s, np.array([8.5]), 2.0)
    with pytest.raises(ValueError, match="does not increase"):
        sliding_mean(np.minimum(s, 5.0), s, np.array([3.0]), 2.0)
    with pytest.raises(ValueError, match=r"cut-off is 60\.0 Hz, allowed are above 0 to below"):
        low_pass(s, 0.01, 60.0)
    with pytest.raises(ValueError, match=r"the run is 0\.1 s long, 7\.5 s are needed"):
        band_pass(s, 0.01, (0.4, 10.0))
    with pytest.raises(ValueError, match="band is 10 to 10 Hz"):
        band_pass(np.zeros(5000), 0.01, (10.0, 10.0))
