"""The figures of the RCF number show the numbers of the report."""

from pathlib import Path

import numpy as np
import pytest

from damage.figures.rcf_bins import BAR, rcf_bins_figure, rcf_cases_figure
from damage.figures.rcf_maps import energy_map_figure, rcf_map_figure
from damage.log_input.bad_rows import BadRows
from damage.material import ER7
from damage.model import DamageModel
from damage.patch_strips import FLANGE, TREAD
from damage.rcf.burstow import Burstow
from damage.report import DamageReport
from damage.surface.lateral_grid import LateralGrid
from damage.surface.wheel_surface import Wheel, WheelSurface
from hh_exudyn.contact.profile import wheel_profile

WHEEL = Wheel(1, 1, 1, 1)
PROFILE = wheel_profile("S1002")
KM = 1e3


def made(turns: float) -> DamageReport:
    """A report whose wheel has rolled 1 km: counts on the tread at -20.5 mm, and more on the flange."""
    surface = WheelSurface.zero((Wheel(1, 1, 1, -1), WHEEL), LateralGrid.along(PROFILE))
    y = surface.grid.centres
    tread, flange = int(np.argmin(np.abs(y + 0.0205))), int(np.argmin(np.abs(y - 0.0405)))
    for part, place, count in ((TREAD, tread, turns), (FLANGE, flange, 2.0 * turns)):
        surface.contact_time[1, part, place] = 1.0
        surface.contact_revolutions[1, part, place] = 350.0
        surface.ratchet_revolutions[1, part, place] = count
        surface.fatigue_revolutions[1, part, place] = 0.5 * count
        surface.rcf_number[1, part, place, 15:20] = count
        surface.corrected_rcf_number[1, part, place, 17:20] = 0.5 * count
        surface.energy[1, part, place, 15:25] = 350.0 * 2.0 * Burstow.of(ER7).densities[0]
    model = DamageModel(grid=surface.grid, burstow=Burstow.of(ER7))
    object.__setattr__(surface, "distance", KM)
    return DamageReport(surface, model, BadRows(), 1e-5)


def test_maps_show_the_number_after_the_distance(tmp_path: Path) -> None:
    cases = {"dry": made(100.0), "wet": made(10.0)}
    figure = rcf_map_figure(cases, WHEEL, 50.0 * KM, "rcf_number")
    figure.savefig(tmp_path / "map.png")
    titles = [axes.get_title() for axes in figure.axes[:2]]
    assert titles == ["dry\nmax 10 k", "wet\nmax 1 k"]
    drawn = np.asarray(figure.axes[0].collections[0].get_array())
    assert drawn.max() == pytest.approx(50.0 * 200.0)
    assert drawn.sum() == pytest.approx(50.0 * 5 * 300.0)
    assert figure.axes[0].collections[0].get_clim() == figure.axes[1].collections[0].get_clim()
    assert "after 50 km" in figure.axes[-1].get_ylabel()
    low, high = figure.axes[0].get_ylim()
    assert low < -21.0
    assert high > 41.0
    with pytest.raises(ValueError, match="quantity = 'depth'"):
        rcf_map_figure(cases, WHEEL, KM, "depth")
    with pytest.raises(ValueError, match="is not in the report"):
        rcf_map_figure(cases, Wheel(1, 1, 4, 1), KM)
    with pytest.raises(ValueError, match="no cases"):
        rcf_map_figure({}, WHEEL, KM)


def test_energy_map_is_relative_to_the_first_threshold(tmp_path: Path) -> None:
    report = made(100.0)
    figure = energy_map_figure(report, WHEEL, 50.0 * KM)
    figure.savefig(tmp_path / "energy.png")
    assert np.asarray(figure.axes[0].collections[0].get_array()).max() == pytest.approx(2.0)
    assert [axes.get_title().split("max ")[1] for axes in figure.axes[1:3]] == ["10 k", "5 k"]
    without = DamageReport(report.surface, DamageModel(), BadRows(), 1e-5)
    with pytest.raises(ValueError, match="no thresholds of Burstow's"):
        energy_map_figure(without, WHEEL, KM)


def test_bars_are_means_over_five_millimetres(tmp_path: Path) -> None:
    figure = rcf_bins_figure(made(100.0), 10.0 * KM)
    figure.savefig(tmp_path / "bins.png")
    panel = next(axes for axes in figure.axes if axes.get_title(loc="left") == "wheelset 1, left")
    heights = {bar.get_x(): bar.get_height() for bar in panel.patches if getattr(bar, "get_height", None)}
    width = made(1.0).surface.grid.step / BAR
    assert max(heights.values()) == pytest.approx(10.0 * 200.0 * width)
    assert sum(bar.get_height() for bars in panel.containers for bar in bars) == pytest.approx(
        10.0 * 300.0 * width
    )
    with pytest.raises(ValueError, match="vehicle 9"):
        rcf_bins_figure(made(1.0), KM, vehicle=9)


def test_cases_colour_the_profile_in_one_scale(tmp_path: Path) -> None:
    cases = {"lubricated": made(10.0), "dry": made(100.0)}
    figure = rcf_cases_figure(cases, WHEEL, PROFILE, 35.0 * KM)
    figure.savefig(tmp_path / "cases.png")
    lines = [axes.collections[0] for axes in figure.axes[:2]]
    assert lines[0].get_clim() == lines[1].get_clim() == (0.0, 35.0 * 200.0)
    largest = [float(np.max(line.get_array())) for line in lines]
    assert largest[1] == pytest.approx(10.0 * largest[0])
    assert 0.5 * 35.0 * 200.0 < largest[1] <= 35.0 * 200.0
    assert figure.axes[1].get_title(loc="left") == "dry: max 7,000 revolutions"
    with pytest.raises(ValueError, match="not in the report 'dry'"):
        rcf_cases_figure({"dry": cases["dry"]}, Wheel(1, 1, 4, 1), PROFILE, KM)
