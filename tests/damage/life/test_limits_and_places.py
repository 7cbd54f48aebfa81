"""Limits have sources and bounds; places lie where the profile has its root and its flange."""

from dataclasses import replace

import numpy as np
import pytest

from damage.life.limits import WheelLimits, limit, limited_vehicles
from damage.life.places import BANDS, PLACES, WheelPlaces
from damage.parameters import parameters, table_names
from hh_exudyn.contact.profile import Profile, rail_profile, wheel_profile
from hh_exudyn.contact.profiles.measures import flange_height, flange_steepness, flange_thickness


def test_limits_in_metres() -> None:
    wagon, locomotive = WheelLimits.of("iore_wagon"), WheelLimits.of("iore_locomotive")
    assert (wagon.new_diameter, wagon.least_diameter) == (0.915, 0.857)
    assert (locomotive.new_diameter, locomotive.least_diameter) == (1.25, 1.15)
    assert wagon.least_flange_steepness == 6.5e-3
    assert limit("cracks", "failure_depth") == 5e-3
    assert limit("cracks", "length_over_depth") == 4.0
    assert limited_vehicles() == ("iore_locomotive", "iore_wagon")


def test_what_is_assumed_has_a_range() -> None:
    for table in table_names("limits"):
        for name, item in parameters("limits", table).items():
            if item.kind == "assumed" or not item.confirmed:
                assert item.range is not None, f"{table}.{name}"


@pytest.mark.parametrize("name", ["WP4_like", "S1002"])
def test_new_wheels_are_within_limits(name: str) -> None:
    wheel, limits = wheel_profile(name), WheelLimits.of("iore_wagon")
    assert limits.least_flange_thickness < flange_thickness(wheel) < limits.largest_flange_thickness
    assert flange_height(wheel) < limits.largest_flange_height
    assert flange_steepness(wheel) > limits.least_flange_steepness


def test_bad_limits() -> None:
    with pytest.raises(ValueError, match="'tram' has no wheel diameters; known: iore_locomotive, iore_wagon"):
        WheelLimits.of("tram")
    limits = WheelLimits.of("iore_wagon")
    with pytest.raises(
        ValueError, match=r"largest_hollow = nan m of a wheel's limits must be finite and > 0"
    ):
        replace(limits, largest_hollow=float("nan"))
    with pytest.raises(
        ValueError, match=r"least_diameter = 0\.95 m .* must be below new_diameter = 0\.915 m"
    ):
        replace(limits, least_diameter=0.95)


def test_places_of_two_profiles(wp4: Profile) -> None:
    """The flange begins where Sd is measured: 70 mm less 32.5 mm of S1002, less 26.89 mm of WP4."""
    places = WheelPlaces.of(wheel_profile("S1002"))
    assert (places.root, places.flange) == (
        pytest.approx(17.5e-3, abs=1e-5),
        pytest.approx(37.5e-3, abs=1e-5),
    )
    assert WheelPlaces.of(wp4).flange == pytest.approx(70e-3 - 26.89e-3, abs=1e-5)
    assert WheelPlaces.of(wp4, root_width=15e-3).root == pytest.approx(28.11e-3, abs=1e-5)


@pytest.mark.parametrize("name", ["WP4_like", "S1002"])
def test_roots_of_11_to_13_degrees_are_roots(name: str) -> None:
    """Below the angle of 15 degrees that counts as flange, they would drown the tread."""
    wheel = wheel_profile(name)
    angle = np.degrees(np.arctan(-np.gradient(wheel.z, wheel.y)))
    steep = wheel.y[(angle > 11.0) & (angle < 13.0) & (wheel.y > 0.0) & (wheel.y < 0.045)]
    assert steep.size > 5
    assert WheelPlaces.of(wheel).within("root", steep).all()


def test_every_point_has_one_place(places: WheelPlaces) -> None:
    y = np.linspace(-0.07, 0.07, 1401)
    assert np.array_equal(np.sum([places.within(place, y) for place in PLACES], axis=0), np.ones(y.size))
    for band in BANDS:
        assert not np.any(places.within(band, y) & ~places.within("tread", y))
    assert places.largest(np.abs(y), y)["middle_band"] == pytest.approx(0.02, abs=1.5e-4)
    assert places.largest(np.zeros(0), np.zeros(0)) == dict.fromkeys((*PLACES, *BANDS), 0.0)


def test_bad_places(wp4: Profile, places: WheelPlaces) -> None:
    with pytest.raises(ValueError, match="place 'hub' of a wheel; there are tread, root, flange, field_band"):
        places.within("hub", 0.0)
    with pytest.raises(ValueError, match="allowed is 0 < root < flange"):
        WheelPlaces.of(wp4, root_width=0.05)
    with pytest.raises(ValueError, match=r"root_width = 0\.0 m of a wheel must be finite and > 0 m"):
        WheelPlaces.of(wp4, root_width=0.0)
    with pytest.raises(ValueError, match="is a rail's"):
        WheelPlaces.of(rail_profile("60E1"))
