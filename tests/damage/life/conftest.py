"""Wheels of a locomotive with rates made up for them: a tread that wears and two bands of cracks."""

import numpy as np
import pytest

from damage.evolution.profile_wear import ProfileWear
from damage.life.condition import WheelCondition
from damage.life.limits import WheelLimits
from damage.life.places import WheelPlaces
from damage.life.rates import LifeRates
from hh_exudyn.contact.profile import Profile, wheel_profile

FAILURE_DEPTH = 5e-3


@pytest.fixture(scope="session")
def wp4() -> Profile:
    return wheel_profile("WP4_like")


@pytest.fixture(scope="session")
def limits() -> WheelLimits:
    return WheelLimits.of("iore_locomotive")


@pytest.fixture(scope="session")
def places(wp4: Profile) -> WheelPlaces:
    return WheelPlaces.of(wp4)


@pytest.fixture(scope="session")
def wheels(wp4: Profile, limits: WheelLimits) -> WheelCondition:
    """New."""
    return WheelCondition.new("leading outer", wp4, 0.5 * limits.new_diameter, FAILURE_DEPTH)


@pytest.fixture(scope="session")
def rates(wheels: WheelCondition) -> LifeRates:
    """Wear of Table 1-8 (8.9 um per 1000 km on the tread), cracks of a life of 50,000 km.

    The flange face wears by 6.1 um per 1000 km, so that Sd falls by 0.11 mm while Sh grows by 1.34 mm: see
    `test_wear_of_table_1_8`.

    The wider band of cracks is the field side's, the other has 0.6 of its damage.
    """
    y = np.array([-60.0, -50.0, -35.0, 20.0, 30.0, 36.0, 42.0, 48.0, 52.0]) * 1e-3
    depth = np.array([0.0, 0.3, 1.0, 1.0, 0.6, 0.4, 6.1 / 8.9, 6.1 / 8.9, 0.0]) * 8.9e-9
    at = wheels.grid.lateral
    band = np.interp(at, np.array([-52.0, -45.0, -25.0, -18.0]) * 1e-3, [0.0, 1.0, 1.0, 0.0])
    band += 0.6 * np.interp(at, np.array([-20.0, -15.0, -5.0, 0.0]) * 1e-3, [0.0, 1.0, 1.0, 0.0])
    return LifeRates(ProfileWear(y, depth), {"global": band / 50e3, "local": 0.5 * band / 50e3})
