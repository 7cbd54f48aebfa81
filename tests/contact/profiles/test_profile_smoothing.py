"""Smoothing of measured profiles: what noise is left, what shape is kept, which profiles are let alone."""

from pathlib import Path

import numpy as np
import pytest
from scanned_wheel import SPACING, scanned
from scipy.interpolate import CubicSpline

from hh_exudyn.contact.normal.hertz import hertz_patch
from hh_exudyn.contact.profile import RAIL_PROFILES, Profile, rail_profile, read_profile, wheel_profile
from hh_exudyn.contact.profiles.cleaning import arc_length
from hh_exudyn.contact.profiles.smoothing import (
    DEVIATION_ALLOWED,
    LONGEST_CUT_OFF,
    RIPPLE_ALLOWED,
    curvature_ripple,
    smooth,
)

MM = 1e-3
TREAD_NOISE = 0.5  # 1/m, rms of curvature that may be left of white noise of 5 um; it grows with the noise
S1002 = wheel_profile("S1002")


def curvature(y: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Lateral position and curvature of the cubic spline through points [m, 1/m]."""
    s = arc_length(y, z)
    at = np.linspace(0.0, s[-1], int(s[-1] / (0.1 * MM)))
    along_y, along_z = CubicSpline(s, y), CubicSpline(s, z)
    speed = np.hypot(along_y(at, 1), along_z(at, 1))
    return along_y(at), (along_y(at, 1) * along_z(at, 2) - along_y(at, 2) * along_z(at, 1)) / speed**3


def test_the_bound_of_tread_noise_changes_a_patch_by_less_than_a_tenth() -> None:
    """Why 0.5 1/m: a worn (conical) wheel of 0.46 m on a rail's crown R300, 100 kN."""
    rolling, lateral = 0.5 / 0.46, 0.5 / 0.3
    true = hertz_patch(100e3, rolling, lateral)
    for change in (-TREAD_NOISE, TREAD_NOISE):
        patch = hertz_patch(100e3, rolling, lateral + 0.5 * change)
        for one, other in ((patch.a, true.a), (patch.b, true.b), (patch.max_pressure, true.max_pressure)):
            assert abs(one / other - 1.0) < 0.1


@pytest.mark.parametrize("sigma", [5e-6, 10e-6])
@pytest.mark.parametrize("seed", range(6))
def test_white_noise_on_s1002_is_smoothed_and_the_shape_kept(sigma: float, seed: int) -> None:
    y, z = scanned(S1002, sigma, seed)
    y_true, k_true = curvature(S1002.y, S1002.z)
    y_raw, k_raw = curvature(y, z)
    found = smooth(y, z)
    y_smooth, k_smooth = curvature(found.y, found.z)
    tread = np.abs(y_smooth) < 20 * MM
    error = (k_smooth - np.interp(y_smooth, y_true, k_true))[tread]
    assert np.sqrt(np.mean(error**2)) < TREAD_NOISE * sigma / 5e-6
    assert np.abs(k_raw[np.abs(y_raw) < 20 * MM]).max() > 100.0  # what it was before

    # From the points (means over 1 mm) and from the truth, along the whole profile
    assert found.deviation <= DEVIATION_ALLOWED
    part = (found.y > -55 * MM) & (found.y < 54 * MM)
    away = (found.z - np.interp(found.y, S1002.y, S1002.z)) / np.hypot(1, np.gradient(found.z, found.y))
    assert np.abs(away[part]).max() < DEVIATION_ALLOWED
    assert found.point_rms < 1.2 * sigma

    # The flange root of 13 mm: in the mean within 5 %, nowhere sharper than by 10 %
    root = (y_smooth > 34.5 * MM) & (y_smooth < 37.5 * MM)
    assert -1 / k_smooth[root].mean() == pytest.approx(13 * MM, rel=0.05)
    assert -1 / k_smooth[(y_smooth > 30 * MM) & (y_smooth < 39 * MM)].min() > 0.9 * 13 * MM


def test_arcs_keep_their_radius() -> None:
    """A circle of 13 mm, no noise: within 1 um in radius (its chords stand back by 0.3 um) and 0.1 %."""
    angle = np.linspace(-1.3, 1.3, 200)
    found = smooth(13 * MM * np.sin(angle), 13 * MM * np.cos(angle))
    assert found.cut_off == (LONGEST_CUT_OFF, LONGEST_CUT_OFF)
    middle = np.abs(found.y) < 6 * MM
    assert np.abs(np.hypot(found.y, found.z)[middle] - 13 * MM).max() < 1e-6
    y, k = curvature(found.y, found.z)
    assert -1 / k[np.abs(y) < 6 * MM].mean() == pytest.approx(13 * MM, rel=1e-3)


@pytest.mark.parametrize("share", [0.25, 0.5, 1.0, 2.0])
def test_a_wave_keeps_the_stated_share(share: float) -> None:
    """Gain 1/(1 + (L/l)^6) for waves of 1 um, too low for the cut-off to be shortened."""
    y = np.arange(0.0, 0.2, 0.1 * MM)
    wavelength = share * LONGEST_CUT_OFF
    found = smooth(y, 1e-6 * np.sin(2 * np.pi * y / wavelength))
    middle = (found.y > 0.05) & (found.y < 0.15)
    gain = 1.0 / (1.0 + share**-6)
    assert np.abs(found.z[middle]).max() == pytest.approx(gain * 1e-6, rel=0.02, abs=1e-10)


def test_what_waves_more_than_allowed_stays() -> None:
    """A wave of 4 mm length and 0.05 mm height, far below the cut-off, is followed to 0.02 mm."""
    y = np.arange(0.0, 0.1, SPACING)
    z = 0.05 * MM * np.sin(2 * np.pi * y / (4 * MM)) * (y > 0.05)
    found = smooth(y, z)
    assert found.deviation <= DEVIATION_ALLOWED
    assert found.cut_off[0] < 5 * MM
    assert found.cut_off[1] == LONGEST_CUT_OFF  # the flat half
    assert np.abs(found.z[found.y > 0.06]).max() > 0.028 * MM
    assert smooth(y, z, 0.1 * MM).cut_off[0] == LONGEST_CUT_OFF


@pytest.mark.parametrize(
    "profile",
    [S1002, *(rail_profile(name, slope) for name in RAIL_PROFILES for slope in (0.0, 1 / 30))],
    ids=lambda profile: profile.name,
)
@pytest.mark.parametrize("step", [1, 3])
def test_drawn_profiles_do_not_count_as_noisy(profile: Profile, step: int) -> None:
    y, z = profile.y[::step], profile.z[::step]
    assert curvature_ripple(y, z) < 0.5 * RIPPLE_ALLOWED
    rounded = np.round(y, 7), np.round(z, 7)  # files with four decimals of a millimetre
    assert curvature_ripple(*rounded) < RIPPLE_ALLOWED


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_noise_of_one_micrometre_is_noticed_and_gone_after_smoothing(seed: int) -> None:
    y, z = scanned(S1002, 1e-6, seed)
    assert curvature_ripple(y, z) > RIPPLE_ALLOWED
    found = smooth(y, z)
    assert curvature_ripple(found.y, found.z) < 0.1 * RIPPLE_ALLOWED


def test_the_reader_smooths_what_is_noisy_only(tmp_path: Path) -> None:
    y, z = scanned(S1002, 5e-6, 4)
    path = tmp_path / "noisy.txt"
    np.savetxt(path, 1e3 * np.column_stack([y, z]), fmt="%.6f")
    auto, never = read_profile(path), read_profile(path, smoothing="never")
    assert auto.report.smoothing is not None
    assert never.report.smoothing is None
    assert "smoothed: curvature ripple" in auto.report.notes[0]
    assert auto.report.ripple == never.report.ripple
    assert auto.report.ripple_left < 0.1 * RIPPLE_ALLOWED < RIPPLE_ALLOWED < never.report.ripple_left
    np.savetxt(path, 1e3 * np.column_stack([S1002.y, S1002.z]), fmt="%.6f")
    assert read_profile(path).report.smoothing is None
    forced = read_profile(path, smoothing="always")
    assert forced.report.smoothing is not None
    assert forced.report.smoothing.deviation <= DEVIATION_ALLOWED
