"""The figure of creep curves shows the numbers that it was given."""

import numpy as np
import pytest

from hh_exudyn.contact.tangential.curves import CurvePatch, creep_curve
from hh_exudyn.figures.creep_curve import creep_curve_figure

PATCH = CurvePatch(5e-3, 3e-3, 8e4, 0.3, nu_x=5e-4)
THEORIES = ("halfspace", "fastrip")


def test_panels_show_the_curves() -> None:
    curves = [creep_curve(PATCH, name, THEORIES, points=4, cells=8) for name in ("lateral", "spin")]
    figure = creep_curve_figure(PATCH, curves)
    lateral, spin, moment = figure.axes
    for axes, curve, column, scale in (
        (lateral, curves[0], 1, 1e3), (spin, curves[1], 1, 1.0), (moment, curves[1], 2, 1.0),
    ):  # fmt: skip
        lines = {line.get_label(): line for line in axes.lines}
        assert list(lines) == ["fastrip", "halfspace"]
        for name, line in lines.items():
            np.testing.assert_allclose(line.get_xdata(), curve.values * scale)
            np.testing.assert_allclose(line.get_ydata(), -curve.forces[name][:, column])


def test_without_curves_there_is_no_figure() -> None:
    with pytest.raises(ValueError, match="none given"):
        creep_curve_figure(PATCH, [])
