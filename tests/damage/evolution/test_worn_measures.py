"""What wear can do to flange measures: a bound for any wear, and Table 1-8 against it."""

import numpy as np
import pytest

from damage.evolution.profile_wear import ProfileWear
from damage.evolution.worn_profile import worn_profile
from hh_exudyn.contact.profile import wheel_profile
from hh_exudyn.contact.profiles.measures import flange_steepness, flange_thickness


@pytest.mark.parametrize("name", ["WP4_like", "S1002"])
@pytest.mark.parametrize("seed", range(4))
def test_qr_falls_by_no_more_than_sd_while_the_tip_does_not_wear(name: str, seed: int) -> None:
    """qR = y(2 mm above the tip) - y(10 mm below the tread); wear moves the first outwards alone.

    So Table 1-8's qR of -1.07 mm with Sd of -0.11 mm is no wear of one wheel: its tip was lower by some
    millimetre too, or it was turned to another flange.
    """
    wheel = wheel_profile(name)
    tip = float(wheel.y[np.argmin(wheel.z)])
    y = np.linspace(-0.05, tip - 4e-3, 12)
    depth = np.random.default_rng(seed).uniform(0.0, 1.0, y.size)
    depth[-1] = 0.0
    worn, _ = worn_profile(wheel, ProfileWear(y, depth * 1e-8), 100e3, smoothing=0.0)
    steepness = flange_steepness(worn) - flange_steepness(wheel)
    assert steepness >= flange_thickness(worn) - flange_thickness(wheel) - 1e-6
