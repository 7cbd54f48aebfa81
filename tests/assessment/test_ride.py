"""Ride index and comfort of sines by their closed forms; weightings against published tables."""

import math

import numpy as np
import pytest

from hh_exudyn.assessment.accelerations import PointAccelerations
from hh_exudyn.assessment.ride import (
    COMFORT_SCALE,
    RIDE_SCALE,
    comfort_lateral,
    comfort_vertical,
    ride_indices,
    sperling,
    sperling_weighting,
    word_of,
)

INTERVAL = 0.004  # s
TIME = INTERVAL * np.arange(15000)  # 60 s
WD = {  # Hz: ISO 2631-1:1997, table 3, in thousandths; from memory
    0.5: 853, 0.8: 992, 1.0: 1011, 1.25: 1008, 1.6: 968, 2.0: 890, 2.5: 776, 3.15: 642, 4.0: 512, 5.0: 409,
    6.3: 323, 8.0: 253, 16.0: 125,
}  # fmt: skip


def felt(longitudinal: np.ndarray, lateral: np.ndarray, vertical: np.ndarray) -> PointAccelerations:
    columns = [values[:, None] for values in (longitudinal, lateral, vertical)]
    time = INTERVAL * np.arange(len(lateral))
    return PointAccelerations(("floor",), time, 20.0 * time[:, None], *columns)


@pytest.mark.parametrize("direction", ["lateral", "vertical"])
@pytest.mark.parametrize("frequency", [0.7, 1.0, 2.3, 5.4, 10.0])
def test_ride_index_of_a_sine(direction: str, frequency: float) -> None:
    """(100 a B)^0.3 for an amplitude of a m/s^2."""
    wave = 0.4 * np.sin(2 * math.pi * frequency * TIME + 0.7)
    (gain,) = sperling_weighting(np.array([frequency]), direction)
    assert sperling(wave, INTERVAL, direction) == pytest.approx((40.0 * gain) ** 0.3, rel=1e-3)


def test_amplitude_of_ten_times_is_twice_the_index() -> None:
    wave = np.sin(2 * math.pi * 3.0 * TIME)
    one, ten = (sperling(a * wave, INTERVAL, "vertical") for a in (0.1, 1.0))
    assert ten / one == pytest.approx(10.0**0.3, rel=1e-9)
    assert sperling(np.full(1000, 3.0), INTERVAL, "vertical") == 0.0  # cant is no ride


def test_lateral_weighting_is_that_of_iso_2631() -> None:
    frequencies = np.array(list(WD))
    assert comfort_lateral(frequencies) == pytest.approx(1e-3 * np.array(list(WD.values())), abs=6e-4)


def test_vertical_weighting_beside_iso_8041() -> None:
    """Other qualities there (0.55, 0.9, 0.95; Larson Davis HVM200, table 3.1): 15 % at most in between."""
    f = np.array([0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 31.5, 63.0])
    s = 2j * math.pi * f
    w1, w2, w4, w5, w6 = (2 * math.pi * own for own in (0.4, 100.0, 16.0, 2.5, 4.0))
    band = s**2 / (s**2 + math.sqrt(2) * w1 * s + w1**2) * w2**2 / (s**2 + math.sqrt(2) * w2 * s + w2**2)
    velocity = (1 + s / w4) / (1 + s / (0.55 * w4) + (s / w4) ** 2)
    step = (1 + s / (0.9 * w5) + (s / w5) ** 2) / (1 + s / (0.95 * w6) + (s / w6) ** 2)
    other = np.abs(1.024 * (w5 / w6) ** 2 * band * velocity * step)
    assert comfort_vertical(f) == pytest.approx(other, rel=0.15)
    assert comfort_vertical(f)[:2] == pytest.approx(other[:2], rel=0.03)


def test_comfort_of_sines() -> None:
    """6 sqrt(sum of (W a)^2 / 2)."""
    lateral = 0.3 * np.sin(2 * math.pi * 1.0 * TIME)
    vertical = 0.5 * np.sin(2 * math.pi * 5.0 * TIME)
    (found,) = ride_indices(felt(0.0 * TIME, lateral, vertical))
    weighted = [0.3 * comfort_lateral(np.array([1.0]))[0], 0.5 * comfort_vertical(np.array([5.0]))[0]]
    assert found.windows == 12
    assert found.comfort == pytest.approx(6.0 * math.hypot(*weighted) / math.sqrt(2.0), rel=5e-3)
    assert found.weighted[0] == pytest.approx(0.0, abs=1e-12)
    assert found.sperling_lateral < found.sperling_vertical


def test_a_short_run_has_no_comfort() -> None:
    short = np.sin(2 * math.pi * 2.0 * TIME[:1000])
    (found,) = ride_indices(felt(short, short, short))
    assert found.windows == 0
    assert math.isnan(found.comfort)
    assert found.sperling_lateral > 1.0


def test_scales() -> None:
    assert word_of(RIDE_SCALE, 2.6) == "more pronounced, not unpleasant"
    assert word_of(COMFORT_SCALE, 1.5) == "comfortable"
    assert word_of(COMFORT_SCALE, math.nan) == ""
