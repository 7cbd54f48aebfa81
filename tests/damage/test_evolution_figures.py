"""Figures of a wheel's life: what they draw is what the history says."""

import numpy as np
import pytest

from damage.evolution.history import WearHistory
from damage.evolution.loop import StepControl, evolve
from damage.evolution.profile_wear import ProfileWear
from damage.figures.evolution import measures_figure, profiles_figure, worn_depth
from hh_exudyn.contact.profile import wheel_profile

WP4 = wheel_profile("WP4_like")


@pytest.fixture(scope="module")
def history(tmp_path_factory: pytest.TempPathFactory) -> WearHistory:
    """A millimetre off tread and root in four steps."""
    y = np.linspace(-0.03, 0.045, 76)
    wear = ProfileWear(y, 1e-8 * np.sin(np.pi * (y + 0.03) / 0.075) ** 2)
    control = StepControl(max_depth=1e-3, max_distance=25e6)
    return evolve(WP4, 0.4575, lambda profile: wear, 100e6, tmp_path_factory.mktemp("life"), control)


def test_worn_depth_lies_on_the_axle(history: WearHistory) -> None:
    """What wore off is drawn where it wore, deepest 1 mm; the unworn flange tip shows none of it."""
    depth = worn_depth(history.steps[0], history.last)
    assert depth.max() == pytest.approx(1e-3, rel=0.01)
    np.testing.assert_allclose(depth[WP4.y > 0.052], 0.0, atol=1e-12)


def test_profiles_and_depths_are_drawn(history: WearHistory) -> None:
    above, below, *_ = profiles_figure(history).axes
    assert len(above.lines) == 5
    drawn = [float(np.max(line.get_ydata())) for line in below.lines[:4]]
    assert drawn == pytest.approx([0.25, 0.5, 0.75, 1.0], rel=0.02)


def test_every_measure_is_drawn_over_the_distance(history: WearHistory) -> None:
    panels = measures_figure(history).axes
    assert len(panels) == 6
    (line,) = panels[0].lines
    np.testing.assert_allclose(line.get_xdata(), [0.0, 25e3, 50e3, 75e3, 100e3])
    np.testing.assert_allclose(line.get_ydata(), history.to_table()["Sh_mm"].to_pylist())
