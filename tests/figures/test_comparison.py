"""The sheet of compared runs: every run and quantity has its bar, value and wheel."""

import math

from hh_exudyn.figures.comparison import comparison_sheet


def test_every_value_is_drawn_and_named() -> None:
    quantities = {f"quantity {i} [kN]": [(1.0 + i, "1L"), (2.5 + i, "3R"), (math.nan, "")] for i in range(5)}
    figure = comparison_sheet("three runs", ["soft", "stiff", "none"], quantities)
    panels = [axes for axes in figure.axes if axes.get_visible()]
    assert [axes.get_title() for axes in panels] == list(quantities)
    for axes, values in zip(panels, quantities.values(), strict=True):
        assert [patch.get_width() for patch in axes.patches] == [values[0][0], values[1][0], 0.0]
        assert [text.get_text() for text in axes.texts] == [f"{v:.4g}  {w}" for v, w in values[:2]]
    assert [label.get_text() for label in panels[0].get_yticklabels()] == ["soft", "stiff", "none"]
