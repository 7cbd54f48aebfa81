"""The root locus shows what it is given."""

import numpy as np
import pytest

from hh_exudyn.figures.root_locus import root_locus_figure


def test_modes_and_critical_speed_are_drawn(tmp_path):
    speeds = np.linspace(10.0, 50.0, 9)
    growing = -1.0 + speeds / 30.0 + 2j * np.pi * 0.1 * speeds
    short = np.where(speeds < 30.0, -2.0 + 2j * np.pi * 5.0, complex(np.nan, np.nan))
    figure = root_locus_figure("test", speeds, np.stack([growing, short], axis=1), critical=30.0)
    plane, ratios = figure.axes[:2]
    drawn = np.concatenate([np.asarray(points.get_offsets()) for points in plane.collections])
    assert len(drawn) == 9 + 4  # a mode that has ended has no points
    assert drawn[:9, 1] == pytest.approx(0.1 * speeds)
    assert ratios.lines[-1].get_xdata() == pytest.approx([108.0, 108.0])
    first = ratios.lines[0].get_ydata()
    assert [value < 0.0 for value in first] == [speed > 30.0 for speed in speeds]
    figure.savefig(tmp_path / "locus.png")
