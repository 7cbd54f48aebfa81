"""The figures of line contact and shakedown show the numbers of the thesis's."""

from collections.abc import Callable
from io import BytesIO

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from damage.figures.line_stress import (
    partial_slip_shear_figure,
    principal_shear_figure,
    surface_stress_figure,
    yield_place_figure,
)
from damage.figures.shakedown_map import line_contact_map, partial_slip_map, point_contact_map
from damage.figures.stress_trajectories import partial_slip_figure, trajectories_figure


def curve(figure: Figure, label: str, axes: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """The line whose label starts so."""
    (line,) = [line for line in figure.axes[axes].lines if str(line.get_label()).startswith(label)]
    return np.asarray(line.get_xdata(), dtype=float), np.asarray(line.get_ydata(), dtype=float)


def at(figure: Figure, label: str, x: float) -> float:
    return float(np.interp(x, *curve(figure, label)))


@pytest.mark.parametrize(
    "figure",
    [
        principal_shear_figure, surface_stress_figure, yield_place_figure, partial_slip_shear_figure,
        line_contact_map, partial_slip_map, point_contact_map, trajectories_figure, partial_slip_figure,
    ],
)  # fmt: skip
def test_draws(figure: Callable[[], Figure]) -> None:
    buffer = BytesIO()
    figure().savefig(buffer, dpi=40)
    assert len(buffer.getvalue()) > 3000


def test_principal_shear_names_its_maximum() -> None:
    """Figures 3-4 and 3-6: 0.300 p0 at 0.78 a, 13 per cent more from mu = 0.1 to 0.3, surface at 0.5."""
    titles = [axes.get_title() for axes in principal_shear_figure((0.0, 0.1, 0.3, 0.5)).axes]
    assert "0.300 $p_0$ at $x$ = 0.00 $a$, 0.79 $a$ deep" in titles[0]
    assert "0.305" in titles[1]
    assert "0.345" in titles[2]
    assert "0.500 $p_0$ all over the surface" in titles[3]
    with pytest.raises(ValueError, match="friction is empty"):
        principal_shear_figure(())


def test_surface_stresses() -> None:
    """Equation 3.10, corrected: -2 at the leading edge, +2 at the trailing edge, tau_1 = mu p0 between."""
    figure = surface_stress_figure()
    assert at(figure, "$\\sigma_x$", 1.0) == pytest.approx(-2.0)
    assert at(figure, "$\\sigma_x$", -1.0) == pytest.approx(2.0)
    assert at(figure, "$\\tau_{xz}$", 0.0) == pytest.approx(-1.0)
    x, shear = curve(figure, "$\\tau_1$")
    np.testing.assert_allclose(shear[np.abs(x) < 1.0], 1.0)
    assert shear[0] < 0.3


def test_place_of_first_yield_reaches_the_surface() -> None:
    depth, ahead = yield_place_figure().axes[0].lines[:2]
    assert depth.get_ydata()[0] == pytest.approx(0.78, abs=0.01)
    assert 0.365 <= depth.get_xdata()[-1] <= 0.38
    assert ahead.get_ydata()[-1] > 0.95
    with pytest.raises(ValueError, match=r"largest_friction = 0\.2"):
        yield_place_figure(0.2)


def test_partial_slip_exceeds_full_slip() -> None:
    figure = partial_slip_shear_figure()
    assert curve(figure, "partial")[1].max() > 1.1 * curve(figure, "full")[1].max()


def test_maps() -> None:
    full = line_contact_map()
    for label, limits in {
        "elastic": {0.0: 3.33, 0.2: 3.135, 0.5: 2.0},
        "shakedown, elastic-perfectly": {0.0: 4.0, 0.1: 3.564},
        "shakedown, kinematic": {0.1: 3.93, 0.25: 3.56, 0.6: 1.67},
    }.items():
        for friction, limit in limits.items():
            assert at(full, label, friction) == pytest.approx(limit, abs=0.02)
    partial = partial_slip_map(0.5)
    assert at(partial, "partial slip: shakedown, kinematic", 0.4) == pytest.approx(2.236, abs=5e-3)
    assert at(partial, "full slip", 0.4) == pytest.approx(2.5, abs=5e-3)
    assert at(partial, "partial slip: elastic", 0.5) == pytest.approx(2.0)
    point = point_contact_map()
    assert at(point, "point", 0.0) == pytest.approx(4.7, abs=0.05)
    assert np.all(
        curve(point, "point")[1] >= curve(point, "line")[1] - 1e-9
    )  # line contact is on the safe side
    with pytest.raises(ValueError, match=r"friction = 0\.0"):
        partial_slip_map(0.0)


@pytest.mark.parametrize(
    "draw", [trajectories_figure, partial_slip_figure, lambda: partial_slip_figure(0.4, -0.3)]
)
def test_circles_hold_the_trajectories(draw: Callable[[], Figure]) -> None:
    axes = draw().axes[-1]
    circles = [patch for patch in axes.patches if isinstance(patch, Circle)]
    assert len(circles) == 3
    assert circles[0].radius > circles[1].radius > circles[2].radius
    trajectories = [line for line in axes.lines if str(line.get_label()).startswith("$z$")]
    assert len(trajectories) >= 4
    for circle in circles:
        for line in trajectories:
            away = np.hypot(line.get_xdata() - circle.center[0], line.get_ydata() - circle.center[1])
            assert away.max() <= circle.radius * (1.0 + 1e-5)


def test_johnsons_points() -> None:
    """Equation 3.13 for mu = 0.5, Q/P = 0.4, over 2 mu p0; the sense of the traction is turned round."""
    slip = 1.0 - np.sqrt(0.2)
    texts = {text.get_text(): text.xy for text in partial_slip_figure().axes[1].texts}
    np.testing.assert_allclose(texts["A"], (-slip, 0.0), atol=1e-7)
    np.testing.assert_allclose(texts["B"], (-slip, -2.0 * np.sqrt(slip * (1.0 - slip))), atol=1e-7)
    np.testing.assert_allclose(texts["C"], (2.0 * np.sqrt(slip) - slip, 0.0), atol=1e-7)
