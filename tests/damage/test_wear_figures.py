"""Figures of wear: what is drawn is what was computed."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from damage.figures.wear_map import wear_map_figure
from damage.figures.wear_ratio import wear_ratio_figure
from damage.wear.laws import wear_law
from damage.wear.wear_ratio import WearRatio

STATES: dict[str, Any] = {
    "a": 6e-3, "b": 5e-3, "normal_force": 100e3, "nu_x": np.array([1e-3, 0.02]), "nu_y": 0.0, "phi": 0.0,
    "friction": 0.4, "speed": 20.0, "rolling_radius": 0.46,
}  # fmt: skip


@pytest.mark.parametrize("slip", ["elastic", "rigid"])
def test_map_has_a_point_per_slipping_cell(slip: str, tmp_path: Path) -> None:
    figure = wear_map_figure(
        STATES, ("partial slip", "full slip"), wear_law("archard", slip=slip), cells=(20, 20)
    )
    (axes,) = figure.axes
    partial, full = axes.get_lines()[:2]
    velocity, pressure = full.get_data()
    assert len(velocity) == 400  # every cell slips
    assert 0 < len(partial.get_xdata()) < 300
    assert np.max(pressure) == pytest.approx(1.59, rel=0.01)  # Hertz, 3 N/(2 pi a b) [GPa]
    spread = np.ptp(velocity) / 0.4
    assert np.mean(velocity) == pytest.approx(0.4, rel=0.01)  # nu V [m/s]
    assert spread < 1e-12 if slip == "rigid" else spread > 0.1
    texts = " ".join(text.get_text() for text in axes.texts)
    assert all(k in texts for k in ("= 5.5·10⁻⁴", "= 35·10⁻⁴", "= 350·10⁻⁴", "0.8 $H$"))
    figure.savefig(tmp_path / "map.png")


def test_map_needs_archard_and_names_that_fit() -> None:
    with pytest.raises(ValueError, match=r"'usfd' has no map; only Archard's has"):
        wear_map_figure(STATES, law=wear_law("usfd"))
    with pytest.raises(ValueError, match="1 names for 2 contact states"):
        wear_map_figure(STATES, ("one",))


def test_ratio_has_a_panel_each(tmp_path: Path) -> None:
    y = np.linspace(-0.03, 0.04, 8)
    energy = np.array([0.0, 1.0, 4.0, 2.0, 0.0, 5.0, 6.0, 0.0])
    loaded, empty = WearRatio.learn(2.0 * energy, energy), WearRatio.learn(energy**2, energy)
    figure = wear_ratio_figure(y, {"loaded": loaded, "empty": empty}, unit="nm per kJ/m²", factor=10.0)
    panels = [axes for axes in figure.axes if axes.get_title(loc="left")]
    assert [axes.get_title(loc="left") for axes in panels] == ["loaded", "empty"]
    for axes, ratio in zip(panels, (loaded, empty), strict=True):
        steps, mean = axes.get_lines()
        np.testing.assert_array_equal(steps.get_ydata(), 10.0 * ratio.ratio)
        np.testing.assert_array_equal(steps.get_xdata(), 1e3 * y)
        assert mean.get_ydata()[0] == pytest.approx(10.0 * ratio.mean)
    figure.savefig(tmp_path / "ratio.png")


def test_ratio_needs_its_positions() -> None:
    with pytest.raises(ValueError, match="no wear ratio"):
        wear_ratio_figure([0.0], {})
    with pytest.raises(ValueError, match=r"'loaded' has 2 positions, y has \(1,\)"):
        wear_ratio_figure([0.0], {"loaded": WearRatio.learn([1.0, 2.0], [1.0, 1.0])})
