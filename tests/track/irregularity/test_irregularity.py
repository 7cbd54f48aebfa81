"""Random irregularities against their spectra, the same on every machine; filters, splines, signs."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import welch
from scipy.stats import chi2

from track.irregularity.irregularity import Irregularity, random_irregularity, random_phases
from track.irregularity.spectra import SIGNALS, spectrum
from track.irregularity.table import irregularity_at, smooth_track
from track.irregularity.wavelength_bands import D1, D2, wavelength_band

BAND = (3.0, 70.0)


@pytest.fixture(scope="module")
def rough() -> Irregularity:
    return random_irregularity("erri_high", 20_000.0, seed=7)


def sines(wavelength: float, length: float = 1000.0, step: float = 0.25) -> Irregularity:
    """1, 2, 3 and 4 mm of one wavelength."""
    s = step * np.arange(round(length / step) + 1)
    wave = np.sin(2.0 * math.pi / wavelength * s)
    return Irregularity(0.0, step, 1e-3 * wave[:, np.newaxis] * np.array([1.0, 2.0, 3.0, 4.0]))


def test_the_same_seed_gives_the_same_track_on_every_machine() -> None:
    """Numbers stored on Linux, x86-64, numpy 2; nothing but rounding may differ."""
    track = random_irregularity("erri_low", 10_000.0, seed=7)
    stored = {
        0: [1.0455529445844538e-3, 6.548244743766851e-4, 1.0349670298920422e-4, 1.3801510271127882e-3],
        1000: [-5.112776321758595e-4, -6.654764336591436e-4, -1.0499984478995566e-4, -5.928738174117657e-4],
        20001: [7.569484278001938e-4, 1.8742691413913175e-3, 2.374581724549585e-4, 3.532832486303704e-4],
    }
    for row, values in stored.items():
        assert track.values[row] == pytest.approx(values, rel=0.0, abs=1e-13)
    again = random_irregularity("erri_low", 10_000.0, seed=7)
    assert np.array_equal(track.values, again.values)
    other = random_irregularity("erri_low", 10_000.0, seed=8)
    assert abs(np.corrcoef(track.signal("level"), other.signal("level"))[0, 1]) < 0.2


def test_it_is_the_sum_of_cosines() -> None:
    """Term by term instead of by the transform, with numpy's own uniform numbers."""
    length = 300.0
    track = random_irregularity("erri_high", length, seed=3, step=0.1, start=-20.0)
    first, last = math.ceil(length / 70.0), math.floor(length / 3.0)
    for column, signal in enumerate(SIGNALS):
        bits = np.random.PCG64(np.random.SeedSequence(3, spawn_key=(column,)))
        phases = 2.0 * math.pi * np.random.Generator(bits).random(last - first + 1)
        total = np.zeros_like(track.s)
        for k, phase in zip(range(first, last + 1), phases, strict=True):
            omega = 2.0 * math.pi * k / length
            variance = spectrum("erri_high").density(signal, np.array([omega]))[0] * 2.0 * math.pi / length
            total += math.sqrt(2.0 * variance) * np.cos(omega * (track.s + 20.0) + phase)
        assert np.abs(track.signal(signal) - total).max() < 1e-14
    assert np.array_equal(phases, random_phases(3, 3, last - first + 1))


def test_another_sampling_step_samples_the_same_track() -> None:
    coarse = random_irregularity("erri_low", 700.0, seed=5, step=0.5)
    fine = random_irregularity("erri_low", 700.0, seed=5, step=0.125)
    assert np.abs(coarse.values - fine.values[::4]).max() < 1e-15


@pytest.mark.parametrize("name", ["erri_low", "erri_high", "fra_1", "fra_4", "fra_6", "fra_3_fryba"])
def test_standard_deviations_are_those_of_the_spectrum(name: str) -> None:
    track = random_irregularity(name, 20_000.0, seed=1)
    for signal in SIGNALS:
        if signal not in spectrum(name).signals:
            assert not track.signal(signal).any()
            continue
        expected = spectrum(name).standard_deviation(signal, BAND)
        assert track.standard_deviation(signal) == pytest.approx(expected, rel=2e-3)


def test_filtered_standard_deviations_are_those_of_the_bands(rough: Irregularity) -> None:
    """The filter has -3 dB at its edges, so that it passes about the variance of the sharp band."""
    wide = random_irregularity("erri_high", 20_000.0, seed=2, wavelengths=(1.5, 140.0))
    for band in (D1, D2):
        for signal in SIGNALS:
            expected = spectrum("erri_high").standard_deviation(signal, band)
            assert wide.standard_deviation(signal, band) == pytest.approx(expected, rel=0.03)


@pytest.mark.parametrize("signal", SIGNALS)
def test_spectra_lie_in_the_chi_square_band(signal: str) -> None:
    """Welch's estimate from tracks far shorter than the random track's period, with many seeds.

    Segments overlap by half under a Hann window: 36 K^2 / (19 K - 1) degrees of freedom (Percival and Walden
    1993, section 6.17). 95 % of the estimates must lie in the band of 95 %, and fill it.
    """
    per_segment, segments, seeds = 512, 15, 20
    freedom = 36.0 * segments**2 / (19.0 * segments - 1.0)
    ratios = []
    for seed in range(seeds):
        track = random_irregularity("erri_low", 32_000.0, seed=seed, step=0.5)
        part = track.signal(signal)[: per_segment * (segments + 1) // 2]
        wave_number, density = welch(part, 2.0, "hann", per_segment, detrend=False)
        inside = (wave_number > 0.03) & (
            wave_number < 0.3
        )  # clear of the band's edges, which the window blurs
        target = spectrum("erri_low").density(signal, 2.0 * math.pi * wave_number[inside]) * 2.0 * math.pi
        ratios.append(density[inside] / target)
    ratio = np.array(ratios)
    low, high = chi2.ppf([0.025, 0.975], freedom) / freedom
    share = np.mean((ratio > low) & (ratio < high))
    assert 0.93 < share < 0.97
    assert ratio.mean() == pytest.approx(1.0, abs=0.03)
    assert ratio.var() == pytest.approx(2.0 / freedom, rel=0.2)


def test_values_are_gaussian_and_signals_independent(rough: Irregularity) -> None:
    standard = rough.values / rough.values.std(axis=0)
    assert np.abs(np.mean(standard**3, axis=0)).max() < 0.2
    assert np.abs(np.mean(standard**4, axis=0) - 3.0).max() < 0.3
    correlation = np.corrcoef(rough.values.T) - np.eye(4)
    assert np.abs(correlation).max() < 0.15


def test_scaling_gives_the_wanted_standard_deviation(rough: Irregularity) -> None:
    scaled = rough.scaled({"level": 2.3e-3, "gauge": 0.0, "alignment": 1.5e-3}, D1)
    assert scaled.standard_deviation("level", D1) == pytest.approx(2.3e-3, rel=1e-12)
    assert scaled.standard_deviation("alignment", D1) == pytest.approx(1.5e-3, rel=1e-12)
    assert not scaled.signal("gauge").any()
    assert np.array_equal(scaled.signal("cross_level"), rough.signal("cross_level"))
    whole = rough.scaled({"level": 4e-3})
    assert whole.standard_deviation("level") == pytest.approx(4e-3, rel=1e-12)


@pytest.mark.parametrize("band", [D1, D2])
def test_the_filter_has_zero_phase_and_half_the_variance_at_its_edges(band: tuple[float, float]) -> None:
    """Against the gain of two passes of both Butterworth filters, 1 / (1 + (sqrt 2 - 1) r^8) each."""
    middle = slice(1600, 2401)
    centre = math.sqrt(band[0] * band[1])
    for wavelength in (band[0], centre, band[1], 1.5 * band[1], 2.0 * band[1]):
        ratios = (band[0] / wavelength, wavelength / band[1])
        gain = math.prod(1.0 / (1.0 + (math.sqrt(2.0) - 1.0) * ratio**8) for ratio in ratios)
        wave = sines(wavelength)
        error = wave.filtered(band).values[middle] - gain * wave.values[middle]
        assert np.abs(error).max() < 2e-3 * np.abs(wave.values).max() * math.sqrt(gain)
    for factor in (1.5, 2.0):  # towards its Nyquist frequency a digital filter falls faster
        wave = sines(band[0] / factor)
        gain = 1.0 / (1.0 + (math.sqrt(2.0) - 1.0) * factor**8)
        assert np.abs(wave.filtered(band).values[middle]).max() <= gain * 4.0e-3


def test_the_table_is_smooth_from_end_to_end() -> None:
    """Zero outside; value, slope and second derivative continuous; the samples where it is not faded."""
    track = random_irregularity("erri_high", 200.0, seed=4, start=30.0)
    table = track.table(fade=40.0)
    for row in range(0, len(track.values), 7):
        s = float(track.s[row])
        if 70.0 <= s <= 190.0:
            assert irregularity_at(table, s)[:4] == pytest.approx(track.values[row], abs=1e-16)
    for s in (table.start - 1e-9, table.end + 1e-9, -1e6, 1e6):
        assert irregularity_at(table, s) == (0.0,) * 8
    for s in (table.start, 30.0, 230.0, table.end):
        assert np.abs(irregularity_at(table, s)).max() < 1e-8
    assert all(math.isnan(value) for value in irregularity_at(table, math.nan))
    step = 1e-4
    s = np.concatenate(
        [np.arange(21.0, 33.0, 0.11), np.arange(150.0, 160.0, 0.113), np.arange(225.0, 240.0, 0.11)]
    )
    for at in s:  # slopes against differences of values
        before, here, after = (np.array(irregularity_at(table, at + d)) for d in (-step, 0.0, step))
        assert (after[:4] - before[:4]) / (2.0 * step) == pytest.approx(here[4:], abs=1e-10)
    for node in (table.start, table.start + 40 * table.step, 100.0, table.end):  # from both sides of a node
        left, right = (np.array(irregularity_at(table, node + d)) for d in (-1e-7, 1e-7))
        further_left, further_right = (np.array(irregularity_at(table, node + d)) for d in (-2e-3, 2e-3))
        assert left == pytest.approx(right, abs=1e-8)
        curvature_left = (left[4:] - further_left[4:]) / 2e-3
        curvature_right = (further_right[4:] - right[4:]) / 2e-3
        assert curvature_left == pytest.approx(curvature_right, abs=5e-6)  # of 1e-3 on this track
    assert irregularity_at(smooth_track(), 0.5) == (0.0,) * 8


def test_second_derivatives_of_waves_are_right() -> None:
    """Twelve samples a wavelength: the second derivative of a cubic spline is (k h)^2 / 12 small, 2.3 %."""
    wave = sines(3.0, length=60.0)
    table = wave.table(fade=10.0)
    k = 2.0 * math.pi / 3.0
    at = 10.0 * math.pi  # anywhere in the middle
    value, slope = irregularity_at(table, at)[0], irregularity_at(table, at)[4]
    assert value == pytest.approx(1e-3 * math.sin(k * at), abs=1e-6)
    assert slope == pytest.approx(1e-3 * k * math.cos(k * at), abs=5e-6)
    node = 15 * 4 + 3 + 32  # a crest, behind the 32 nodes before the start
    assert table.nodes[node, 4] == pytest.approx(-1e-3 * k * k, rel=0.025)


def test_too_coarse_samples_are_refused() -> None:
    track = random_irregularity("erri_low", 500.0, seed=0)  # 0.25 m, from 3 m
    track.check_spacing(speed=16.7, time_step=5e-4, frequency=5.5)
    with pytest.raises(
        ValueError, match=r"the shortest wavelength is 3 m, which at 16.7 m/s is 5.56667 Hz: 20 Hz"
    ):
        track.check_spacing(16.7, 5e-4, frequency=20.0)
    with pytest.raises(ValueError, match=r"step is 0.25 m, too coarse for 20 Hz at 16.7 m/s.* 0.139"):
        replace(track, shortest=None).check_spacing(16.7, 5e-4, frequency=20.0)
    with pytest.raises(ValueError, match=r"time_step is 0.05 s, at 20 m/s allowed is up to 0.025 s"):
        track.check_spacing(20.0, 0.05)
    with pytest.raises(ValueError, match=r"step is 0.25 m, allowed is up to 0.1\d* m, a sixth"):
        replace(track, shortest=1.0).check_spacing(20.0, 1e-3)
    short = random_irregularity("erri_low", 500.0, seed=0, wavelengths=(0.8, 70.0), step=0.1)
    short.check_spacing(16.0, 5e-4, frequency=20.0)


def test_bad_input_says_what_is_wrong(rough: Irregularity) -> None:
    with pytest.raises(ValueError, match=r"step is 0.6 m, allowed are 0.01 to 0.5 m"):
        random_irregularity("erri_low", 500.0, seed=0, step=0.6)
    with pytest.raises(ValueError, match=r"length is 50.0 m, allowed are 70 to"):
        random_irregularity("erri_low", 50.0, seed=0)
    with pytest.raises(ValueError, match=r"seed is -1, it must be an integer >= 0"):
        random_irregularity("erri_low", 500.0, seed=-1)
    with pytest.raises(ValueError, match=r"none of length / k"):
        random_irregularity("erri_low", 100.0, seed=0, wavelengths=(60.0, 90.0), step=1.0)
    with pytest.raises(
        ValueError, match=r"is 500 m long; faded in and out over 300 m .* must have 600 m or more"
    ):
        random_irregularity("erri_low", 500.0, seed=0).table(fade=300)
    with pytest.raises(ValueError, match=r"'cant' is not known, there are: level, alignment"):
        rough.signal("cant")
    with pytest.raises(ValueError, match=r"standard deviation of level is nan m"):
        rough.scaled({"level": math.nan})
    with pytest.raises(ValueError, match=r"gauge is zero, it cannot be scaled"):
        rough.scaled({"gauge": 0.0}).scaled({"gauge": 1e-3})
    with pytest.raises(ValueError, match=r"cross_level at s = 0.5 m is nan m"):
        values = np.zeros((100, 4))
        values[2, 3] = math.nan
        Irregularity(0.0, 0.25, values)
    with pytest.raises(ValueError, match=r"shape \(100, 3\)"):
        Irregularity(0.0, 0.25, np.zeros((100, 3)))
    with pytest.raises(ValueError, match=r"length is 40 m, for wavelengths up to 25 m allowed is from 50 m"):
        wavelength_band(np.zeros(161), 0.25, D1)
    with pytest.raises(ValueError, match=r"step is 2.0 m, for wavelengths from 3 m"):
        wavelength_band(np.zeros(1000), 2.0, D1)
