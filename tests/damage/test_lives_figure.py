"""The figure of lives draws the diameters and cuts of the turnings."""

import numpy as np
import pytest

from damage.evolution.profile_wear import ProfileWear
from damage.figures.lives import lives_figure
from damage.life.condition import WheelCondition
from damage.life.forecast import whole_life
from damage.life.limits import WheelLimits
from damage.life.rates import LifeRates
from damage.life.turning import TurningRule
from hh_exudyn.contact.profile import wheel_profile


def test_diameters_and_cuts_are_drawn() -> None:
    wheel, limits = wheel_profile("WP4_like"), WheelLimits.of("iore_wagon")
    wheels = WheelCondition.new("wagon", wheel, 0.4575, 5e-3)
    wear = ProfileWear(np.array([-0.06, -0.03, 0.03, 0.05]), np.array([0.0, 1e-8, 1e-8, 0.0]))
    cracks = np.where(np.abs(wheels.grid.lateral + 0.03) < 0.01, 1.0 / 200e3, 0.0)
    turnings = whole_life(
        wheels, LifeRates(wear, {"global": cracks, "local": cracks}), limits, TurningRule([wheel])
    )
    above, below = lives_figure(turnings, limits).axes
    line = above.lines[0].get_ydata()
    assert line[0] == pytest.approx(915.0)
    assert line[-1] == pytest.approx(1e3 * turnings[-1].diameter)
    heights = [bar.get_height() for bar in below.patches]
    assert sum(heights) == pytest.approx(sum(2e3 * one.cut for one in turnings[:-1]))
    with pytest.raises(ValueError, match="no turnings"):
        lives_figure((), limits)
