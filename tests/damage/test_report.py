"""Damage of a run: however the log is cut, wherever it lies; bad logs are refused; figures show it."""

from collections.abc import Callable
from dataclasses import fields
from pathlib import Path

import numpy as np
import pyarrow
import pytest

from damage.figures.profile_panels import FLANGE_ROOT, fatigue_figure, wear_figure
from damage.figures.working_points import shakedown_figure
from damage.log_input.contact_states import DAMAGE_COLUMNS, contact_chunks
from damage.log_input.output_clock import output_clock
from damage.material import ER7
from damage.model import DamageModel
from damage.rcf.burstow import Burstow
from damage.report import DamageReport, assess
from damage.surface.accumulate import accumulate
from damage.surface.lateral_grid import LateralGrid
from damage.surface.wheel_surface import Wheel, WheelSurface
from hh_exudyn.contact.profile import wheel_profile
from hh_exudyn.log.store import Recorder, open_run, write_status

CELLS = (10, 10)


@pytest.fixture(scope="module")
def report(random_log: pyarrow.Table) -> DamageReport:
    return assess(random_log, cells=CELLS)


def equal(left: WheelSurface, right: WheelSurface) -> None:
    """Equal to round-off in every field."""
    for name in ("grid", "patch_grid", "wheels", "rows"):
        assert getattr(left, name) == getattr(right, name)
    for field in fields(left):
        if field.name not in ("grid", "patch_grid", "wheels", "rows"):
            one, other = np.asarray(getattr(left, field.name)), np.asarray(getattr(right, field.name))
            np.testing.assert_allclose(
                one, other, rtol=1e-11, atol=1e-13 * np.abs(one).max(), err_msg=field.name
            )


@pytest.mark.parametrize("cuts", [[93], [1, 2, 3], [7, 50, 51, 120, 185], list(range(1, 186, 5))])
def test_sum_over_any_cut_is_the_whole(
    report: DamageReport, random_log: pyarrow.Table, cuts: list[int]
) -> None:
    """The cuts fall inside output times and leave pieces that some wheels are missing from."""
    clock = output_clock(random_log)
    total = WheelSurface.zero((), LateralGrid())
    for first, last in zip([0, *cuts], [*cuts, random_log.num_rows], strict=True):
        piece = random_log.slice(first, last - first)
        total = total + accumulate(piece, DamageModel(cells=CELLS, burstow=Burstow.of(ER7)), clock=clock)
    equal(report.surface, total)


@pytest.mark.parametrize("rows", [1, 17])
def test_chunks_do_not_matter(report: DamageReport, random_log: pyarrow.Table, rows: int) -> None:
    model = DamageModel(cells=CELLS, burstow=Burstow.of(ER7))
    surface = accumulate(random_log, model, chunk_rows=rows)
    equal(report.surface, surface)


def test_run_directory_and_table_agree(
    tmp_path: Path, report: DamageReport, random_log: pyarrow.Table
) -> None:
    with Recorder(tmp_path / "run", {"case": ""}, rows_per_part=50) as recorder:
        recorder.append("contact", {name: random_log[name].to_numpy() for name in random_log.column_names})
    with pytest.raises(ValueError, match=r"run is not finished: no status\.json"):
        assess(tmp_path / "run", cells=CELLS)
    write_status(tmp_path / "run", {"finished": True})
    equal(report.surface, assess(open_run(tmp_path / "run"), cells=CELLS).surface)
    equal(report.surface, assess(str(tmp_path / "run"), cells=CELLS).surface)


def test_table_has_one_row_per_wheel(report: DamageReport, random_log: pyarrow.Table) -> None:
    table = report.to_table()
    keys = zip(table["wheelset"].to_pylist(), table["side"].to_pylist(), strict=True)
    assert sorted(keys) == [(1, -1), (1, 1), (2, -1), (2, 1)]
    wheel = report.surface.wheels.index(Wheel(1, 1, 1, 1))
    row = table.slice(wheel, 1).to_pylist()[0]
    chosen = (random_log["wheelset"].to_numpy() == 1) & (random_log["side"].to_numpy() == 1)
    assert row["p_max_MPa"] == pytest.approx(random_log["p_max"].to_numpy()[chosen].max() * 1e-6)
    tread, flange = report.surface.depth_by_part[wheel].max(axis=1) / report.surface.distance * 1e9
    assert row["wear_depth_mm_per_1000_km"] == pytest.approx(tread)
    assert row["flange_wear_depth_mm_per_1000_km"] == pytest.approx(flange)
    assert -30.0 < row["wear_y_mm"] < 30.0  # of the tread
    assert row["normal_contact"] == report.normal_contact == "ellipse"
    patches = random_log["patch"].to_numpy()[chosen]
    assert row["flange_share"] == pytest.approx(patches.mean())
    assert report.seconds_per_state > 0.0


def test_mean_wear_number_is_energy_over_distance(make_log: Callable[..., pyarrow.Table]) -> None:
    """Two patches of one wheel, two speeds: (100 N x 10 m + (100 + 50) N x 20 m) / 30 m in 1 s intervals."""
    log = make_log(
        time=np.array([0.0, 1.0, 1.0]),
        patch=np.array([0, 0, 1]),
        speed=np.array([10.0, 20.0, 20.0]),
        nu_x=np.array([0.01, 0.01, 0.005]),
        force_x=-10e3,
    )
    surface = assess(log, cells=CELLS).surface
    assert surface.distance == pytest.approx(30.0)
    assert surface.time == pytest.approx(2.0)
    assert surface.mean_wear_number[0] == pytest.approx((100.0 * 10.0 + 150.0 * 20.0) / 30.0)


def test_clock(make_log: Callable[..., pyarrow.Table]) -> None:
    clock = output_clock(make_log(time=np.array([1.0, 1.0, 1.5, 2.5]), nu_x=0.0))
    np.testing.assert_array_equal(clock.times, [1.0, 1.5, 2.5])
    np.testing.assert_array_equal(clock.steps, [0.5, 0.5, 1.0])
    np.testing.assert_array_equal(clock.rows, [2, 1, 1])
    with pytest.raises(ValueError, match="times that the clock was not made from"):
        clock.timed({name: np.array([1.2]) for name in DAMAGE_COLUMNS})


@pytest.mark.parametrize("chunk", [3, 1000])
def test_nan_rows_are_counted_and_located(random_log: pyarrow.Table, chunk: int) -> None:
    phi = random_log["phi"].to_numpy().copy()
    b = random_log["b"].to_numpy().copy()
    phi[[50, 51, 130]] = np.nan
    b[[51, 60]] = np.inf
    bad = random_log.set_column(random_log.column_names.index("phi"), "phi", pyarrow.array(phi))
    bad = bad.set_column(bad.column_names.index("b"), "b", pyarrow.array(b))
    time = random_log["time"].to_numpy()[50]
    wanted = rf"4 of 186 rows are bad, the first at time = {time:g}, .*b .*\(2 such.*phi .*\(3 such"
    with pytest.raises(ValueError, match=wanted):
        list(contact_chunks(bad, rows=chunk))
    with pytest.raises(ValueError, match="4 of 186 rows"):
        assess(bad)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"normal_force": -1.0}, r"normal_force = -1 N at time = 0 s must be >= 0 N"),
        ({"b": 0.0}, r"b = 0 m at time = 0 s must be > 0 m"),
        ({"friction": 0.0}, r"friction = 0 - at"),
        ({"side": 0}, r"side = 0 - at .* must be \+1 \(left\) or -1 \(right\)"),
        ({"contact_angle": 1.6}, r"contact_angle = 1.6 rad"),
        ({"y_wheel": 0.069}, r"from 64.00 to 74.00 mm across .* beyond the grid, -70 to 70 mm"),
        ({"a": 0.021}, r"from -21.00 to 21.00 mm along the patch .* beyond the grid, -20 to 20 mm"),
        ({"speed": 0.0}, "does not move"),
    ],
)
def test_impossible_states_are_refused(
    make_log: Callable[..., pyarrow.Table], values: dict[str, float], message: str
) -> None:
    forces = {"force_x": -1e3, "p_max": 1e9}  # given, so that the builder solves nothing
    with pytest.raises(ValueError, match=message):
        assess(make_log(**{**forces, **values}), cells=CELLS)


def test_touching_without_force_does_nothing(make_log: Callable[..., pyarrow.Table]) -> None:
    log = make_log(
        time=np.array([0.0, 1.0]), normal_force=np.array([100e3, 0.0]), p_max=1e9, force_x=[-1e3, 0.0]
    )
    alone = make_log(time=0.0, p_max=1e9, force_x=-1e3)
    both, one = assess(log, cells=CELLS).surface, assess(alone, cells=CELLS).surface
    np.testing.assert_allclose(both.depth, one.depth)
    np.testing.assert_allclose(both.contact_time, one.contact_time)
    assert both.distance == 2.0 * one.distance


def test_unknown_theory_and_missing_column(random_log: pyarrow.Table) -> None:
    with pytest.raises(ValueError, match="theory = 'contact'; theories with a slip field: "):
        assess(random_log, theory="contact")
    with pytest.raises(ValueError, match="no column phi"):
        assess(random_log.drop_columns(["phi"]))
    with pytest.raises(ValueError, match="has no rows"):
        assess(random_log.slice(0, 0))


def test_figures_show_the_report(tmp_path: Path, report: DamageReport, random_log: pyarrow.Table) -> None:
    profile = wheel_profile("S1002")
    for figure, unit in (
        (wear_figure(report, profile, outer_side=1), "wear depth [mm per 1000 km]"),
        (fatigue_figure(report, profile), "share of time [%]"),
    ):
        assert figure.get_supylabel() == unit
        titles = {axes.get_title(loc="left") for axes in figure.axes}
        assert any(title.startswith("wheelset 2, right") for title in titles)
        figure.savefig(tmp_path / "figure.png")
    assert "wheelset 1, left, outer" in {
        axes.get_title(loc="left") for axes in wear_figure(report, None, None, 1).axes
    }
    diagram = shakedown_figure(random_log)
    diagram.savefig(tmp_path / "figure.png")
    assert diagram.axes[0].get_xlabel() == "utilised friction $Q/P$ [-]"
    with pytest.raises(ValueError, match="vehicle 7 is not in the report"):
        wear_figure(report, vehicle=7)


def test_wear_figure_draws_the_depth(report: DamageReport) -> None:
    """Tread to scale; the flange to the scale that its text names, so that both can be seen."""
    root = report.surface.grid.centres >= FLANGE_ROOT
    depth = report.surface.depth_per_km * 1e6
    shrunk = max(1.0, depth[:, root].max() / depth[:, ~root].max())
    panels = {axes.get_title(loc="left"): axes for axes in wear_figure(report).axes}
    for wheel, wheel_depth in zip(report.surface.wheels, depth, strict=True):
        axes = panels[f"wheelset {wheel.wheelset}, {'left' if wheel.side == 1 else 'right'}"]
        for drawn, where, scale in zip(axes.collections[:2], (~root, root), (1.0, shrunk), strict=True):
            top = drawn.get_paths()[0].vertices[:, 1].max()
            assert top == pytest.approx(wheel_depth[where].max() / scale)
        assert axes.get_ylim()[1] > depth[:, ~root].max()


def test_a_report_of_some_wheels_has_their_rows_of_the_whole(
    report: DamageReport, random_log: pyarrow.Table
) -> None:
    """The distance and the output times stay those of the whole log."""
    wanted = [wheel for wheel in report.surface.wheels if wheel.wheelset == 2 or wheel.side == 1]
    assert 0 < len(wanted) < len(report.surface.wheels)
    places = {(wheel.vehicle, wheel.wheelset, wheel.side) for wheel in wanted}
    some = assess(random_log, cells=CELLS, wheels=places)
    assert some.surface.wheels == tuple(wanted)
    assert some.surface.distance == report.surface.distance
    rows = report.to_table().to_pylist()
    wanted_rows = [row for row in rows if (row["vehicle"], row["wheelset"], row["side"]) in places]
    assert some.to_table().to_pylist() == wanted_rows
