"""Hollow wheels and wide gauge: the wheel touches anywhere on its tread, and stands."""

from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.contact.profile import Profile, rail_profile, read_wheel_profile, wheel_profile
from hh_exudyn.contact.profiles.spline import spline_evaluate, spline_table
from hh_exudyn.contact.wheelset import wheel_on_rail, wheelset_equilibrium
from hh_exudyn.conventions import RIGHT

MM = 1e-3
RAIL = rail_profile("60E1", 1 / 30)
ROLLING = {"yaw": 0.0, "radius": 0.46, "speed": 16.0, "pitch_rate": 16.0 / 0.46}


def hollow(depth: float) -> Profile:
    """S1002 worn in a band of 90 mm about the running circle, `depth` deep."""
    wheel = wheel_profile("S1002")
    y = np.arange(wheel.y[0], 70.0 * MM, 0.2 * MM)
    z = np.interp(y, wheel.y, wheel.z)
    worn = z + depth * np.where(np.abs(y) < 45 * MM, np.cos(np.pi * y / (90 * MM)) ** 2, 0.0)
    return Profile("hollow", "wheel", y, worn - np.interp(0.0, y, worn))


@pytest.mark.parametrize("normal", ["hertz", "coupled_strips"])
@pytest.mark.parametrize(("gauge", "least"), [(1.445, 30.0), (1.450, 34.0), (1.455, 36.0)])
def test_the_outer_tread_is_found_on_wide_gauge(normal: str, gauge: float, least: float) -> None:
    wheel = wheel_on_rail(
        hollow(4 * MM), RAIL, RIGHT, lateral=12 * MM, roll=0.0, load=150e3, gauge=gauge, friction=0.0,
        normal=normal, **ROLLING,
    )  # fmt: skip
    assert min(contact.y_wheel for contact in wheel.contacts) < -least * MM
    assert sum(contact.normal_force for contact in wheel.contacts) > 140e3


@pytest.mark.parametrize("normal", ["hertz", "coupled_strips"])
@pytest.mark.parametrize("lateral", [0.0, 3.0, 6.0])
def test_a_wheelset_of_hollow_wheels_finds_its_equilibrium(normal: str, lateral: float) -> None:
    wheel = hollow(2 * MM)
    stands = wheelset_equilibrium(
        wheel, RAIL, wheel, RAIL, lateral=lateral * MM, load=300e3, gauge=1.438, friction=0.3, normal=normal,
        **ROLLING,
    )  # fmt: skip
    for side in (stands.left, stands.right):
        assert side.height == pytest.approx(stands.height, abs=1e-9)
        assert side.contacts
    if lateral == 0.0:
        assert stands.roll == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("normal", ["hertz", "coupled_strips"])
@pytest.mark.parametrize(("gauge", "place"), [(1.445, -36.5), (1.450, -38.3)])
def test_the_shared_hollow_wheel_touches_where_it_should(
    shared_cases: Path, normal: str, gauge: float, place: float
) -> None:
    wheel = wheel_on_rail(
        read_wheel_profile(shared_cases / "hollow_wheel_4mm.txt"), RAIL, RIGHT, lateral=12 * MM, roll=0.0,
        load=150e3 if normal == "coupled_strips" else 1e3, gauge=gauge, friction=0.0, normal=normal,
        **ROLLING,
    )  # fmt: skip
    assert [1e3 * contact.y_wheel for contact in wheel.contacts] == [pytest.approx(place, abs=0.1)]


@pytest.mark.parametrize("first", np.arange(-66, -55, 0.25))
def test_a_table_holds_its_last_node(first: float) -> None:
    """Whatever rounding makes of its place: a wheel that ended there had no strips."""
    wheel = hollow(2 * MM)
    y = np.concatenate([[first * MM], wheel.y[wheel.y > -54 * MM]])
    z = np.interp(y, wheel.y, wheel.z)
    table = spline_table(Profile("cut", "wheel", y, z))
    end = table.start + table.step * (len(table.z) - 1)
    assert spline_evaluate(table, end)[0] == pytest.approx(table.z[-1], abs=1e-12)
    assert np.isnan(spline_evaluate(table, end + 1e-9)[0])
