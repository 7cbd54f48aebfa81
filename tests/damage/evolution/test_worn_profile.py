"""A step of wear on a profile: exact lines it must reach, what it must not touch, and what it refuses."""

import math

import numpy as np
import pytest

from damage.evolution.profile_wear import ProfileWear
from damage.evolution.worn_profile import SMOOTHING, step_depth, worn_profile
from hh_exudyn.contact.profile import Profile, rail_profile, wheel_profile
from hh_exudyn.contact.profiles.cleaning import arc_length
from hh_exudyn.contact.profiles.smoothing import RIPPLE_ALLOWED, curvature_ripple

DISTANCE = 150e6  # m
S1002 = wheel_profile("S1002")


def worn(
    wheel: Profile, wear: ProfileWear, steps: int, distance: float = DISTANCE, smoothing: float = SMOOTHING
) -> tuple[Profile, float]:
    """The profile after a distance in equal steps, and the radius lost."""
    total = 0.0
    for _ in range(steps):
        wheel, lost = worn_profile(wheel, wear, distance / steps, smoothing)
        total += lost
    return wheel, total


@pytest.mark.parametrize("steps", [1, 20])
def test_even_wear_gives_the_offset_curve(steps: int) -> None:
    """8.9 um per 1000 km all over S1002 for 150,000 km: each arc of the drawing has its radius changed by it.

    Centres and radii are those of UIC 510-2: the root R13 grows, the tip R12 shrinks, the cone 1:15 shifts.
    """
    depth = 1.335e-3
    end, lost = worn(S1002, ProfileWear(np.array([-0.08, 0.08]), np.full(2, depth / 150e3)), steps)
    y, z = end.y, end.z + lost
    for centre_y, centre_z, radius, low, high in (
        (26.210665e-3, -16.446e-3, 13e-3 + depth, 35.5e-3, 38.2e-3),
        (55e-3, -16e-3, 12e-3 - depth, 50.2e-3, 62e-3),
    ):
        arc = (y > low) & (y < high)
        assert np.count_nonzero(arc) > 20
        np.testing.assert_allclose(np.hypot(y - centre_y, z - centre_z)[arc], radius, rtol=0.0, atol=0.2e-6)
    cone = y < -0.035
    line = -1.364323640e-3 - 0.066666667 * y + depth * math.hypot(1.0, 0.066666667)
    np.testing.assert_allclose(z[cone], line[cone], rtol=0.0, atol=0.02e-6)
    assert end.z[np.argmin(np.abs(end.y))] == pytest.approx(0.0, abs=5e-6)


def test_uneven_wear_gives_the_analytic_arc_and_converges_with_the_step() -> None:
    """Wear that grows linearly across an arc leaves an arc, as in the hyperbolic half-plane.

    A front that moves along its normals at c eta, eta the distance from a line, keeps equal hyperbolic
    distance: a circle with its centre at h cosh(rho) and the radius h sinh(rho) has rho grown by c t.
    """
    y = np.linspace(-0.04, 0.04, 801)
    face = np.linspace(0.0401, 0.047, 60)
    z = np.sqrt(0.01 - y**2) - 0.1
    wheel = Profile("arc", "wheel", np.append(y, face), np.append(z, z[-1] - 3.0 * (face - 0.04)))
    pole, grown = 0.15, 0.0089  # m from the line where nothing wears; c t: 1.335 mm in the middle
    ends = np.array([-0.08, 0.08])
    wear = ProfileWear(ends, grown / 150e3 * (ends + pole))
    rho = math.atanh(0.1 / pole)
    h = pole / math.cosh(rho)
    centre, radius = h * math.cosh(rho + grown) - pole, h * math.sinh(rho + grown)
    errors = []
    for steps in (10, 20, 40):
        end, lost = worn(wheel, wear, steps, smoothing=0.0)
        middle = np.abs(end.y) < 0.03
        off = np.hypot(end.y - centre, end.z + lost + 0.1)[middle] - radius
        errors.append(float(np.abs(off).max()))
    assert errors[0] < 0.3e-6
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.02)  # of first order in the step
    assert errors[1] / errors[2] == pytest.approx(2.0, rel=0.02)


def test_wear_of_the_tread_leaves_the_flange_alone() -> None:
    """A hundred steps of noisy tread wear: not a point of the flange moves, and no ripple comes up."""
    generator = np.random.default_rng(5)
    y = np.arange(-0.06, 0.0705, 1e-3)
    wheel, total = S1002, 0.0
    for _ in range(100):
        depth = np.exp(-((y / 0.012) ** 2)) * generator.uniform(0.8, 1.2, y.size) * (np.abs(y) < 0.025)
        wheel, lost = worn_profile(wheel, ProfileWear(y, 9e-9 * depth), 1500e3)
        total += lost
    assert total == pytest.approx(100 * 1500 * 9e-9, rel=0.02)
    flange = S1002.y > 0.04
    np.testing.assert_allclose(wheel.y[flange], S1002.y[flange], rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(wheel.z[flange] + total, S1002.z[flange], rtol=0.0, atol=1e-12)
    assert curvature_ripple(wheel.y, wheel.z) < RIPPLE_ALLOWED


def test_smoothing_keeps_the_area_and_stays_near_the_depth() -> None:
    """A jagged depth is smoothed within its share of the largest, and takes off as much as before."""
    y = np.arange(-0.06, 0.0705, 1e-3)
    depth = np.interp(y, [-0.03, 0.0, 0.03, 0.031, 0.036, 0.037], [0.0, 4e-8, 0.0, 0.0, 1.5e-7, 0.0])
    wear = ProfileWear(y, depth * np.where(np.arange(y.size) % 2, 1.05, 0.95))
    raw, smoothed = (step_depth(S1002, wear, 500e3, share) for share in (0.0, SMOOTHING))
    s = arc_length(S1002.y, S1002.z)
    assert np.trapezoid(smoothed, s) == pytest.approx(np.trapezoid(raw, s), rel=1e-12)
    assert smoothed.min() >= 0.0
    assert np.abs(smoothed - raw).max() < 0.15 * raw.max()  # single points are allowed more than their mean
    tread = np.abs(S1002.y) < 0.025  # where the depth is straight but for its jags
    turns = [np.abs(np.diff(one[tread], 2)).max() for one in (raw, smoothed)]
    assert turns[1] < 0.1 * turns[0]
    np.testing.assert_allclose(step_depth(S1002, wear, 50e3), 0.1 * smoothed, rtol=1e-9, atol=1e-18)


def test_no_wear_changes_nothing() -> None:
    end, lost = worn(S1002, ProfileWear(np.array([-0.05, 0.05]), np.zeros(2)), 5)
    assert lost == 0.0
    np.testing.assert_array_equal(end.y, S1002.y)
    np.testing.assert_allclose(end.z, S1002.z, rtol=0.0, atol=1e-15)


def test_a_profile_that_folds_over_is_refused() -> None:
    """2 mm cut off within 0.2 mm of the flange face lie over what is left beside them."""
    y = np.array([0.0350, 0.0392, 0.0394, 0.0396])
    with pytest.raises(ValueError, match=r"folds over at y = 39\.\d+ mm .* up to 2 mm in a step of 100 km"):
        worn_profile(S1002, ProfileWear(y, np.array([2e-5, 2e-5, 0.0, 0.0])), 100e3, smoothing=0.0)


@pytest.mark.parametrize(
    ("wheel", "distance", "smoothing", "message"),
    [
        (rail_profile("60E1"), 1.0, 0.1, "is a rail's; wear needs a wheel's"),
        (S1002, -1.0, 0.1, "distance = -1.0 m of a step of wear must be finite and >= 0 m"),
        (S1002, math.nan, 0.1, "distance = nan m"),
        (S1002, 1.0, 0.6, r"smoothing = 0\.6 of a step of wear, allowed 0 \.\. 0\.5"),
    ],
)
def test_bad_steps(wheel: Profile, distance: float, smoothing: float, message: str) -> None:
    wear = ProfileWear(np.array([-0.05, 0.05]), np.full(2, 1e-8))
    with pytest.raises(ValueError, match=message):
        worn_profile(wheel, wear, distance, smoothing)


@pytest.mark.parametrize(
    ("y", "depth", "message"),
    [
        ([0.0, 1.0, 2.0], [1.0, 1.0], r"shapes \(3,\) and \(2,\), needed \(n,\), n >= 2"),
        ([0.0, 0.0], [1.0, 1.0], "must be finite and increase"),
        ([0.0, 0.01], [1.0, -1e-9], r"depth_per_km = -1e-09 m/km at y = 10\.000 mm must be >= 0 m/km"),
        ([0.0, 0.01], [math.nan, 0.0], r"depth_per_km = nan m/km at y = 0\.000 mm"),
    ],
)
def test_bad_wear(y: list[float], depth: list[float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        ProfileWear(np.array(y), np.array(depth))
