"""The amplitude of hunting over the speed shows the runs that it is given."""

import pytest

from hh_exudyn.figures.hunting import hunting_figure


def test_runs_from_a_cycle_and_from_rest_are_drawn(tmp_path):
    figure = hunting_figure("test", [40.0, 30.0, 20.0], [5e-3, 6e-3, 1e-4], [False, True, True], 5e-4)
    (axes,) = figure.axes
    cycles, rests, settled = axes.lines
    assert cycles.get_xdata() == pytest.approx([72.0, 108.0])
    assert cycles.get_ydata() == pytest.approx([0.1, 6.0])
    assert (rests.get_xdata(), rests.get_ydata()) == (pytest.approx([144.0]), pytest.approx([5.0]))
    assert settled.get_ydata() == pytest.approx([0.5, 0.5])
    figure.savefig(tmp_path / "hunting.png")
