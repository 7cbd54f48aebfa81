"""Sliding means and effective values over distance against exact signals."""

import math

import numpy as np
import pytest

from hh_exudyn.assessment.windows import sliding_mean, sliding_rms, window_centres


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


def test_windows_beyond_the_values_are_refused() -> None:
    s = np.arange(10.0)
    with pytest.raises(ValueError, match=r"beyond 0\.00 to 9\.00 m"):
        sliding_mean(s, s, np.array([8.5]), 2.0)
    with pytest.raises(ValueError, match="does not increase"):
        sliding_mean(np.minimum(s, 5.0), s, np.array([3.0]), 2.0)
