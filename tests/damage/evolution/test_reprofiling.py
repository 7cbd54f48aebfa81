"""Reprofiling: the smallest cut, worked by hand, and what limits it."""

import math
from dataclasses import replace

import numpy as np
import pytest

from damage.evolution.profile_wear import ProfileWear
from damage.evolution.reprofiling import reprofile
from damage.evolution.worn_profile import worn_profile
from hh_exudyn.contact.profile import Profile, rail_profile, wheel_profile
from hh_exudyn.contact.profiles.measures import flange_thickness

WP4 = wheel_profile("WP4_like")
RADIUS = 0.4575


def wear(low: float, high: float, depth: float) -> ProfileWear:
    """Depth between two places, with ramps of 2 mm beside them."""
    y = np.array([low - 2e-3, low, high, high + 2e-3])
    return ProfileWear(y, np.array([0.0, depth, depth, 0.0]))


def test_an_unworn_wheel_needs_no_cut() -> None:
    turned = reprofile(WP4, RADIUS, WP4)
    assert (turned.cut, turned.radius, turned.turned_area) == (0.0, RADIUS, 0.0)
    assert reprofile(WP4, RADIUS, WP4, least_cut=1e-3).diameter_lost == 2e-3


def test_even_tread_wear_needs_no_cut_below_the_hollow() -> None:
    """A hollow of 1 mm at the running circle: the target fits under it, the proud field side is turned.

    The radius at the running circle is the worn one's already, so nothing is lost there; but for 3 um, as
    1 mm normal to the steeper tread beside it is so much more in height.
    """
    worn, lost = worn_profile(WP4, wear(-0.01, 0.01, 1e-3 / 100.0), 100e3, smoothing=0.0)
    turned = reprofile(worn, RADIUS - lost, WP4)
    assert turned.cut < 4e-6
    assert turned.turned_area > 20e-6  # about 1 mm over 30 mm of the field side


def test_a_thin_flange_costs_its_loss_times_the_slope_of_its_face() -> None:
    """A face at 69.2 degrees, 0.5 mm worn normal to it, lies 0.5 / cos 69.2 too high: that is turned off."""
    worn, lost = worn_profile(WP4, wear(0.030, 0.049, 0.5e-3 / 100.0), 100e3, smoothing=0.0)
    assert lost == 0.0
    turned = reprofile(worn, RADIUS, WP4)
    assert turned.cut == pytest.approx(0.5e-3 / math.cos(math.radians(69.2)), rel=5e-3)
    assert 0.038 < turned.limited_at < 0.0475  # on the face
    assert turned.radius == RADIUS - turned.cut
    assert flange_thickness(turned.profile) == flange_thickness(WP4)
    (row,) = turned.to_table().to_pylist()
    assert row["diameter_lost_mm"] == pytest.approx(2e3 * turned.cut)
    assert row["diameter_mm"] == pytest.approx(2e3 * turned.radius)


def test_the_cut_is_the_smallest() -> None:
    """The target lies in the metal after the cut and would not with 1 um less."""
    worn, lost = worn_profile(WP4, wear(0.0, 0.045, 1e-3 / 100.0), 100e3)
    turned = reprofile(worn, RADIUS - lost, WP4)
    inside = (WP4.y >= worn.y[0]) & (WP4.y <= WP4.y[np.argmin(WP4.z)])
    room = (WP4.z + turned.cut - np.interp(WP4.y, worn.y, worn.z))[inside]
    assert room.min() == pytest.approx(0.0, abs=1e-6)


def test_a_thinner_target_is_cheaper_but_must_be_thick_enough() -> None:
    """Targets with the flange face moved by 1 and 2 mm; the worn flange has lost 0.5 mm."""
    worn, lost = worn_profile(WP4, wear(0.030, 0.049, 0.5e-3 / 100.0), 100e3, smoothing=0.0)
    thin = []
    for shift in (1e-3, 2e-3):
        # the tread goes on with its own slope where the root moved away
        y = np.where(WP4.y > 0.015, WP4.y + shift, WP4.y)
        back = y < 0.0699
        thin.append(Profile(f"{1e3 * shift:g} mm thinner", "wheel", y[back], WP4.z[back]))
    cheapest = reprofile(worn, RADIUS - lost, [WP4, *thin])
    assert cheapest.cut < 0.2 * reprofile(worn, RADIUS, WP4).cut
    chosen = reprofile(worn, RADIUS, [WP4, *thin], least_flange_thickness=26.5e-3)
    assert chosen.profile is WP4
    with pytest.raises(
        ValueError, match=r"flange of at least 30\.00 mm; there are: 'WP4_like' 26\.89, '1 mm"
    ):
        reprofile(worn, RADIUS, [WP4, *thin], least_flange_thickness=30e-3)


def test_bad_input() -> None:
    short = Profile("short", "wheel", WP4.y[WP4.y > -0.03], WP4.z[WP4.y > -0.03])
    with pytest.raises(ValueError, match=r"target 'WP4_like' .* is not covered by the worn profile 'short'"):
        reprofile(short, RADIUS, WP4)
    with pytest.raises(ValueError, match="is a rail's"):
        reprofile(rail_profile("60E1"), RADIUS, WP4)
    with pytest.raises(ValueError, match=r"radius = 0\.0 m of the worn wheel must be > 0 m"):
        reprofile(WP4, 0.0, WP4)
    with pytest.raises(ValueError, match=r"least_cut = -0\.001 m must be >= 0 m"):
        reprofile(WP4, RADIUS, WP4, least_cut=-1e-3)
    with pytest.raises(ValueError, match="a cut of 500 mm is more than the wheel's radius of 457"):
        reprofile(replace(WP4, name="worn"), RADIUS, WP4, least_cut=0.5)
