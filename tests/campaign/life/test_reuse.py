"""A case stands as long as no wheel has moved where it touches."""

import numpy as np
import pytest

from hh_exudyn.campaign.life.rates import GroupRates, weighted_mean
from hh_exudyn.campaign.life.reuse import has_moved
from hh_exudyn.contact.profile import Profile, wheel_profile

WHEEL = wheel_profile("S1002")
Y = np.arange(-60e-3, 60e-3, 1e-3)


def worn(depth: float, at: float) -> Profile:
    """A wheel worn by a depth about a place, 5 mm wide."""
    return Profile("worn", "wheel", WHEEL.y, WHEEL.z + depth * np.exp(-(((WHEEL.y - at) / 2e-3) ** 2)))


def touching(low: float, high: float, depth: float = 1e-11, pressure: float = 1e9) -> GroupRates:
    contact = (np.abs(Y - 0.5 * (low + high)) <= 0.5 * (high - low)).astype(np.float64)
    return GroupRates(Y, depth * contact, {"local": contact}, contact, pressure, depth * contact.sum() * 1e-3)


@pytest.mark.parametrize(("at", "moved"), [(30e-3, False), (0.0, True)])
def test_only_what_moves_within_the_contact_counts(at: float, moved: bool) -> None:
    tread = {"outer": touching(-20e-3, 10e-3)}
    assert has_moved({"outer": WHEEL}, {"outer": worn(5e-6, at)}, tread, 1e-6) is moved


def test_less_than_the_tolerance_stands_and_zero_lets_nothing_stand() -> None:
    tread = {"outer": touching(-20e-3, 10e-3)}
    after = {"outer": worn(0.5e-6, 0.0)}
    assert not has_moved({"outer": WHEEL}, after, tread, 1e-6)
    assert has_moved({"outer": WHEEL}, after, tread, 0.0)


def test_a_steep_place_moves_along_its_normal() -> None:
    """At the steepest place of the flange face a lift moves the line by its cosine: a third or so."""
    slope = np.gradient(WHEEL.z, WHEEL.y)
    steepest = int(np.argmin(np.where(WHEEL.y < 50e-3, slope, 0.0)))
    face, cosine = WHEEL.y[steepest], 1.0 / np.hypot(1.0, slope[steepest])
    assert cosine < 0.5
    flange = {"outer": touching(face - 0.5e-3, face + 0.5e-3)}
    lifted = Profile("lifted", "wheel", WHEEL.y, WHEEL.z + 3e-6 * (np.abs(WHEEL.y - face) < 0.3e-3))
    assert has_moved({"outer": WHEEL}, {"outer": lifted}, flange, 0.9 * 3e-6 * cosine)
    assert not has_moved({"outer": WHEEL}, {"outer": lifted}, flange, 1.2 * 3e-6 * cosine)


def test_a_weighted_mean_keeps_weights_and_the_largest_pressure() -> None:
    one, two = touching(-20e-3, 10e-3, 1e-11, 1e9), touching(0.0, 30e-3, 3e-11, 2e9)
    mean = weighted_mean([(0.75, one), (0.25, two)])
    assert mean.depth == pytest.approx(0.75 * one.depth + 0.25 * two.depth)
    assert mean.pressure == 2e9
    assert mean.worn_area == pytest.approx(0.75 * one.worn_area + 0.25 * two.worn_area)
    assert np.array_equal(mean.contact, np.maximum(one.contact, two.contact))
    double = weighted_mean([(1.5, one), (0.5, two)])
    assert double.depth == pytest.approx(mean.depth)


def test_rates_of_different_profiles_have_no_mean() -> None:
    one = touching(-20e-3, 10e-3)
    other = GroupRates(Y + 1e-4, one.depth, one.cracks, one.contact, 1e9, one.worn_area)
    with pytest.raises(ValueError, match="bins of different profiles"):
        weighted_mean([(0.5, one), (0.5, other)])
