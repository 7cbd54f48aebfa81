"""Curving over the radius: every wheelset and wheel its curve, for any number of wheelsets."""

import numpy as np
import pytest

from hh_exudyn.figures.curving import curving_figure

RADIUS = np.array([300.0, 700.0, 2000.0])


@pytest.mark.parametrize("wheelsets", [1, 4, 6])
def test_panels(wheelsets: int) -> None:
    attack = np.arange(3.0 * wheelsets).reshape(3, wheelsets)
    Q = 100.0 + np.arange(6.0 * wheelsets).reshape(3, wheelsets, 2)
    figure = curving_figure("a title", RADIUS, {"attack [mrad]": attack, "Q [kN]": Q, "Y [kN]": -Q})
    first, second, third, unused = figure.axes
    assert not unused.get_visible()
    assert [axes.get_ylabel() for axes in (first, second, third)] == ["attack [mrad]", "Q [kN]", "Y [kN]"]
    for number, line in enumerate(first.lines):
        assert line.get_xdata() == pytest.approx(RADIUS)
        assert line.get_ydata() == pytest.approx(attack[:, number])
    assert len(second.lines) == 2 * wheelsets
    assert second.lines[-1].get_ydata() == pytest.approx(Q[:, -1, 1])
    assert second.get_ylim()[0] > 50.0  # no room for a zero far away
    assert len(figure.legends[0].get_texts()) == wheelsets + 2


def test_what_does_not_fit_is_refused() -> None:
    with pytest.raises(ValueError, match=r"arrays \(3, wheelsets\) or \(3, wheelsets, 2\)"):
        curving_figure("", RADIUS, {"Q": np.zeros((2, 4))})
    with pytest.raises(ValueError, match="one number of wheelsets"):
        curving_figure("", RADIUS, {"Q": np.zeros((3, 4, 2)), "attack": np.zeros((3, 6))})
    with pytest.raises(ValueError, match=r"arrays \(3, wheelsets\)"):
        curving_figure("", RADIUS, {})
    with pytest.raises(ValueError, match="radii must increase"):
        curving_figure("", RADIUS[::-1], {"Q": np.zeros((3, 4))})
