"""Figures of the damage function and of ratchetting show what they were given."""

from pathlib import Path

import numpy as np
import pyarrow
import pytest

from damage.figures.damage_function import damage_function_figure
from damage.figures.local_index import local_index_figure
from damage.figures.ratchetting_strain import ratchetting_figure
from damage.rcf.ratchetting import RatchettingSteel, ratchet
from damage.rcf.whole_life_rail import BURSTOW_RAIL, rescaled


def test_damage_function_has_its_peak(tmp_path: Path) -> None:
    figure = damage_function_figure({"rail": BURSTOW_RAIL, "ER7": rescaled((40.4, 121.2, 404.1))})
    rail, wheel = figure.axes[0].lines[:2]
    for line, peak in ((rail, 65.0), (wheel, 121.2)):
        highest = int(np.argmax(line.get_ydata()))
        assert line.get_xdata()[highest] == peak
        assert line.get_ydata()[highest] == pytest.approx(10.0)  # 1e-5 in units of 1e-6
    damage_function_figure().savefig(tmp_path / "function.png")


@pytest.mark.parametrize(("wear", "level"), [(0.0, 2.5), (1e-9, 2.5), (0.0, 0.5)])
def test_ratchetting_over_depth(tmp_path: Path, wear: float, level: float) -> None:
    steel, depth = RatchettingSteel(300e6), np.linspace(0.0, 2e-3, 21)
    stress = level * steel.shear_yield * np.exp(-depth / 1e-3)
    found = ratchet(steel, depth, stress, 1e6, wear_per_cycle=wear, noted=[1e3])
    figure = ratchetting_figure(found, steel, stress)
    strain = figure.axes[1].lines[:2]
    np.testing.assert_array_equal(strain[0].get_xdata(), found.strain[0][found.cycles_to_wear_off > 1e3])
    assert strain[1].get_ydata().min() == pytest.approx(wear * 1e6 * 1e3 + (0.1 if wear else 0.0))
    bottom, top = figure.axes[0].get_ylim()
    assert bottom > top  # depth downwards
    figure.savefig(tmp_path / "strain.png")


def test_local_index_figure_takes_the_nearest_time(random_log: pyarrow.Table) -> None:
    figure = local_index_figure(random_log, wheels=((2, 1), (2, -1)), time=0.118, cells=(10, 10))
    rows = random_log.to_pydict()
    y = [
        rows["y_wheel"][row]
        for row in range(random_log.num_rows)
        if (rows["wheelset"][row], rows["side"][row]) == (2, 1) and abs(rows["time"][row] - 0.12) < 1e-9
    ]
    middle = figure.axes[0].lines[0].get_xdata().mean() * 1e-3
    assert middle == pytest.approx(y[0], abs=1e-9)
    with pytest.raises(
        ValueError, match=r"vehicle 1, wheelset 9, side \+1: no loaded patch at time = 0.39 s"
    ):
        local_index_figure(random_log, wheels=((9, 1),))
