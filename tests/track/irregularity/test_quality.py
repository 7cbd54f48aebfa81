"""Quality classes: the thesis's Table 1-4, and tracks of known standard deviation."""

import math

import numpy as np
import pytest

from track.irregularity.irregularity import Irregularity, random_irregularity
from track.irregularity.quality import (
    CLASSES,
    quality_class,
    quality_limits,
    track_quality,
)
from track.irregularity.wavelength_bands import D1

KM_H = 1.0 / 3.6


@pytest.mark.parametrize(
    ("speed", "level", "alignment"),  # km/h, QN1 and QN2 in mm: Table 1-4
    [
        (1.0, (2.3, 2.6), (1.5, 1.8)),
        (80.0, (2.3, 2.6), (1.5, 1.8)),
        (80.1, (1.8, 2.1), (1.2, 1.5)),
        (120.0, (1.8, 2.1), (1.2, 1.5)),
        (160.0, (1.4, 1.7), (1.0, 1.3)),
        (200.0, (1.2, 1.5), (0.8, 1.1)),
        (300.0, (1.0, 1.3), (0.7, 1.0)),
    ],
)
def test_limits_are_those_of_table_1_4(
    speed: float, level: tuple[float, float], alignment: tuple[float, float]
) -> None:
    limits = quality_limits(speed * KM_H)
    assert limits[:, :2] == pytest.approx(1e-3 * np.array([level, alignment]))
    assert limits[:, 2] == pytest.approx(1.3 * limits[:, 1])


def test_the_worse_signal_decides() -> None:
    deviations = 1e-3 * np.array([[2.3, 1.5], [2.31, 0.1], [0.1, 1.81], [2.0, 2.35], [3.39, 0.0], [0.0, 0.0]])
    names = [CLASSES[i] for i in quality_class(deviations, 80.0 * KM_H)]
    assert names == ["QN1", "QN2", "QN3", ">QN3", ">QN3", "QN1"]
    assert CLASSES[quality_class(deviations[:1], 90.0 * KM_H)[0]] == "QN3"  # 2.3 mm, above QN2 = 2.1 mm there


def test_sections_have_the_standard_deviation_of_their_wave() -> None:
    """A wave of 10 m, its amplitude another in each section of 100 m: amplitude / sqrt(2)."""
    step, amplitudes = 0.25, 1e-3 * np.array([1.0, 3.0, 3.5, 4.0, 5.0, 2.0])
    s = step * np.arange(2401 + 100)  # the last 25 m are no section
    amplitude = amplitudes[np.minimum(s // 100.0, 5).astype(int)]
    values = np.zeros((len(s), 4))
    values[:, 0] = amplitude * np.sin(2.0 * math.pi * s / 10.0)
    quality = track_quality(Irregularity(500.0, step, values), 60.0 * KM_H)
    assert quality.start.tolist() == [500.0, 600.0, 700.0, 800.0, 900.0, 1000.0]
    assert quality.deviations[:, 0] == pytest.approx(amplitudes / math.sqrt(2.0), rel=0.02)
    assert not quality.deviations[:, 1].any()
    assert [CLASSES[i] for i in quality.classes] == ["QN1", "QN1", "QN2", "QN3", ">QN3", "QN1"]
    assert quality.distribution() == pytest.approx({"QN1": 0.5, "QN2": 1 / 6, "QN3": 1 / 6, ">QN3": 1 / 6})
    assert quality.unmet() == ("QN1", "QN3", ">QN3")
    groups = ["straight", "straight", "curve", "curve", "curve", "straight"]
    by = quality.distribution_by(groups)
    assert by["straight"] == {"QN1": 1.0, "QN2": 0.0, "QN3": 0.0, ">QN3": 0.0}
    assert by["curve"] == pytest.approx({"QN1": 0.0, "QN2": 1 / 3, "QN3": 1 / 3, ">QN3": 1 / 3})


def test_waves_outside_the_band_do_not_count() -> None:
    s = 0.25 * np.arange(4001)
    values = np.zeros((len(s), 4))
    values[:, :2] = 0.02 * np.sin(2.0 * math.pi * s / 70.0)[:, np.newaxis]
    quality = track_quality(Irregularity(0.0, 0.25, values), 60.0 * KM_H)
    assert quality.deviations[2:-2].max() < 0.02 * 1e-3


@pytest.mark.parametrize("length", [100.0, 250.0, 500.0])
def test_a_random_track_scatters_about_what_it_was_scaled_to(length: float) -> None:
    track = random_irregularity("erri_high", 20_000.0, seed=1).scaled({"level": 2.0e-3}, D1)
    quality = track_quality(track, 60.0 * KM_H, section_length=length)
    assert len(quality.classes) == round(20_000.0 / length)
    assert math.sqrt((quality.deviations[:, 0] ** 2).mean()) == pytest.approx(2.0e-3, rel=0.01)
    assert sum(quality.distribution().values()) == pytest.approx(1.0)


def test_erri_tracks_are_good_at_60_km_h_and_not_at_200() -> None:
    """ERRI low is a good main line; ERRI high has 1.6 and 1.2 mm in 3 to 25 m."""
    low, high = (random_irregularity(name, 10_000.0, seed=1) for name in ("erri_low", "erri_high"))
    assert track_quality(low, 60.0 * KM_H).distribution()["QN1"] == 1.0
    assert track_quality(low, 60.0 * KM_H).unmet() == ()
    assert track_quality(high, 60.0 * KM_H).distribution()["QN1"] > 0.9
    assert "QN1" in track_quality(high, 200.0 * KM_H).unmet()


def test_bad_input_says_what_is_wrong() -> None:
    track = random_irregularity("erri_low", 120.0, seed=1)
    for speed in (0.0, -1.0, 84.0, math.nan):
        with pytest.raises(ValueError, match=r"speed is .* m/s, allowed are above 0 to 83\.3333 m/s"):
            track_quality(track, speed)
    with pytest.raises(ValueError, match=r"section_length is 10\.0 m, allowed are 25 to 1000 m"):
        track_quality(track, 10.0, section_length=10.0)
    with pytest.raises(ValueError, match=r"the track is 120 m long, a section is 250 m"):
        track_quality(track, 10.0, section_length=250.0)
    with pytest.raises(ValueError, match=r"groups has 2 names, there are 1 sections"):
        track_quality(track, 10.0).distribution_by(["a", "b"])
    with pytest.raises(ValueError, match=r"deviations has nan m"):
        quality_class(np.array([[math.nan, 1e-3]]), 10.0)
    with pytest.raises(ValueError, match=r"shape \(3,\)"):
        quality_class(np.zeros(3), 10.0)
