"""Figure 3-20 of the thesis from a run: local fatigue indices against the global one, R = 450 m, mu 0.4."""

from pathlib import Path

import numpy as np
from run_tables import steady, table

from damage.figures.local_index import local_index_figure
from damage.material import ER7
from damage.rcf.local import distributed_index, local_indices
from hh_exudyn.log.store import Run

STATE = ("a", "b", "normal_force", "nu_x", "nu_y", "phi", "friction")


def largest(run: Run, wheelset: int, side: int) -> tuple[float, float, float]:
    """Means over the last 2 s of the largest index of the wheel's first patch: global, FaStrip, FASTSIM."""
    log = steady(table(run, "contact"))
    rows = (log.wheelset == wheelset) & (log.side == side) & (log.patch == 0)
    states = {name: getattr(log, name)[rows][::10] for name in STATE}
    assert np.allclose(states["friction"], 0.4, rtol=1e-12)
    force = (log.force_x[rows][::10], log.force_y[rows][::10], states["normal_force"])
    spread = distributed_index(*force, states["a"], states["b"], ER7.shear_yield)
    local = [local_indices(states, ER7, theory).fatigue_index for theory in ("fastrip", "fastsim")]
    found = [float(index.max(axis=1).mean()) for index in (spread, *local)]
    return found[0], found[1], found[2]


def test_the_order_of_figure_3_20_on_the_leading_outer_wheel(demo_run: Run) -> None:
    """Near saturation, Q/P = .38: global < FaStrip < FASTSIM; measured .286, .305, .329."""
    spread, fastrip, fastsim = largest(demo_run, 1, -1)
    assert 0.2 < spread < fastrip < fastsim < 0.4
    assert fastrip - spread > 0.01
    assert fastsim - fastrip > 0.01


def test_far_from_saturation_fastsim_is_not_the_highest(demo_run: Run) -> None:
    """Inner wheel of the third wheelset, Q/P = .19: the global index sees next to nothing (.02), FaStrip .20;
    FASTSIM, whose traction rises in a straight line from the leading edge, .16."""
    spread, fastrip, fastsim = largest(demo_run, 3, 1)
    assert spread < 0.05
    assert 0.1 < fastsim < fastrip


def test_figure_of_the_run(demo_run: Run, tmp_path: Path) -> None:
    figure = local_index_figure(demo_run)
    outer, inner = figure.axes
    curves = {line.get_label(): float(np.max(line.get_ydata())) for line in outer.lines}
    assert curves["global"] < curves["local, FaStrip"] < curves["local, FASTSIM"]
    assert outer.get_title().startswith("wheelset 1, right")
    assert inner.lines[0].get_xdata().max() < 0.0  # the inner wheel runs on the field side of its tread
    figure.savefig(tmp_path / "local.png")
