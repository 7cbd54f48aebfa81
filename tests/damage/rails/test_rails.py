"""Rails: what the wheels lose they lose too, mirrored, cut and weighted as their sums."""

import math
from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pyarrow
import pytest

from damage.figures.rail_wear import MOST_PLACES, rail_wear_figure
from damage.log_input.output_clock import output_clock
from damage.log_input.states import RAIL_COLUMNS
from damage.model import DamageModel
from damage.rails.model import RailModel, RailStretch
from damage.rails.pieces import RailPair
from damage.rails.rail_surface import MGT, RailSurface
from damage.rails.report import RailPlace, RailReport, rail_report
from damage.rails.steel import R260, R350HT, rail_material
from damage.rails.stored import load_rail, save_rail
from damage.rcf.whole_life_rail import BURSTOW_RAIL
from damage.report import DamageReport, assess
from damage.surface.accumulate import accumulate_both
from damage.surface.lateral_grid import LateralGrid, place_of
from damage.surface.stored import BrokenFile
from damage.wear.archard import archard, read_archard
from hh_exudyn.contact.profile import rail_profile, wheel_profile

MakeLog = Callable[..., pyarrow.Table]
CELLS = (10, 10)
RADIUS = 0.46  # of the wheels of the logs [m]
RAIL = rail_profile("60E1")
WHOLE = RailStretch.of(-1.0, 1000.0, RAIL, RAIL)
EQUAL = archard(hardness=2.65e9)  # named by the caller: of both bodies


def on_track(log: pyarrow.Table, way: float = 10.0) -> pyarrow.Table:
    """A log with places on the rail and along the track: tread contact on the head, flange on the corner."""
    columns = {name: log[name].to_numpy() for name in log.column_names}
    columns["s"] = way * columns["time"]
    flange = columns["contact_angle"] > 0.5
    columns["y_rail"] = np.where(flange, 0.031, 0.3 * columns["y_wheel"])
    return pyarrow.table(columns)


@pytest.fixture(scope="module")
def log(random_log: pyarrow.Table) -> pyarrow.Table:
    return on_track(random_log)


def rails_of(source: pyarrow.Table, *stretches: RailStretch, **options: object) -> DamageReport:
    rails = RailModel(stretches or (WHOLE,))
    return assess(source, cells=CELLS, rails=rails, **options)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def report(log: pyarrow.Table) -> DamageReport:
    return rails_of(log, law=EQUAL)


def equal(one: RailSurface, other: RailSurface) -> None:
    """Equal to round-off in every sum."""
    assert (one.side, one.by_wheel.wheels) == (other.side, other.by_wheel.wheels)
    for name in ("whole_life", "rolled", "mass"):
        compare(getattr(one, name), getattr(other, name), name)
    for field in fields(one.by_wheel):
        if field.name not in ("grid", "patch_grid", "wheels"):
            compare(getattr(one.by_wheel, field.name), getattr(other.by_wheel, field.name), field.name)


def compare(one: object, other: object, name: str) -> None:
    a, b = np.asarray(one, dtype=float), np.asarray(other, dtype=float)
    np.testing.assert_allclose(a, b, rtol=1e-11, atol=1e-13 * np.abs(a).max(initial=0.0), err_msg=name)


@pytest.mark.parametrize("grid", ["arc", "lateral"])
def test_wheel_and_rail_lose_the_same_volume_and_energy(log: pyarrow.Table, grid: str) -> None:
    """With one hardness and one coefficient: the wheel over its circumference, the rail over its metre."""
    stretch = WHOLE if grid == "arc" else RailStretch(-1.0, 1000.0)
    report = rails_of(log, stretch, law=EQUAL, profile=wheel_profile("S1002") if grid == "arc" else None)
    turn = 2.0 * math.pi * RADIUS
    for rail in report.rails[0]:
        for row, wheel in enumerate(rail.by_wheel.wheels):
            surface, own = report.surface, report.surface.wheels.index(wheel)
            volume = surface.worn_area[own].sum() * turn
            assert volume > 0.0
            assert rail.by_wheel.worn_area[row].sum() * 1.0 == pytest.approx(volume, rel=1e-12)
            np.testing.assert_array_equal(rail.by_wheel.worn_volume[row], surface.worn_volume[own])
            energy = surface.energy_density[own].sum() * turn
            assert rail.by_wheel.energy_density[row].sum() == pytest.approx(energy, rel=1e-12)
            assert rail.by_wheel.work[row] == pytest.approx(surface.work[own], rel=1e-12)
            assert rail.by_wheel.patch_time[row] == pytest.approx(surface.patch_time[own], rel=1e-12)


def test_wheels_are_as_without_rails(log: pyarrow.Table, report: DamageReport) -> None:
    """The same to the last digit, for every patch is solved once in the same order."""
    alone = assess(log, cells=CELLS, law=EQUAL)
    assert alone.rails == ()
    for field in fields(alone.surface):
        one, other = getattr(alone.surface, field.name), getattr(report.surface, field.name)
        assert np.array_equal(one, other) if isinstance(one, np.ndarray) else one == other, field.name


def test_depth_of_one_passing_is_that_of_one_revolution(make_log: MakeLog) -> None:
    """Whatever the radius: the law's depth is per turn of the wheel, and per passing of the rail."""
    for radius in (0.3, 0.6):
        source = on_track(make_log(time=0.1 * np.arange(3), nu_x=0.004, rolling_radius=radius))
        report = rails_of(source, RailStretch(-1.0, 1000.0), law=EQUAL)
        left, right = report.rails[0]
        assert right.by_wheel.wheels == ()
        turns = report.surface.distance / (2.0 * math.pi * radius)
        depth = left.by_wheel.depth / left.rolled[:, None]
        np.testing.assert_allclose(depth, report.surface.depth / turns, rtol=1e-12, atol=1e-25)
        assert left.rolled[0] == pytest.approx(report.surface.distance)


@pytest.mark.parametrize("cuts", [[93], [1, 2, 3], list(range(1, 186, 20))])
def test_sum_over_any_cut_is_the_whole(log: pyarrow.Table, report: DamageReport, cuts: list[int]) -> None:
    model = replace(report.model, rails=RailModel((WHOLE,), law=EQUAL))
    clock, total = output_clock(log), None
    for first, last in zip([0, *cuts], [*cuts, log.num_rows], strict=True):
        ((left, right),) = accumulate_both(log.slice(first, last - first), model, clock=clock).rails
        total = (left, right) if total is None else (total[0] + left, total[1] + right)
    assert total is not None
    for one, other in zip(report.rails[0], total, strict=True):
        equal(one, other)


def test_stretches_divide_the_track(log: pyarrow.Table, report: DamageReport) -> None:
    """Rows belong to the stretch that their wheelset is on; those on none to no rail."""
    middle = 1.7
    two = rails_of(log, replace(WHOLE, end=middle), replace(WHOLE, start=middle), law=EQUAL).rails
    for side in (0, 1):
        equal(report.rails[0][side], two[0][side] + two[1][side])
    (part,) = rails_of(log, replace(WHOLE, start=1.0, end=middle), law=EQUAL).rails
    time, s = log["time"].to_numpy(), log["s"].to_numpy()
    steps = np.unique(time[(s >= 1.0) & (s < middle)])
    speed = 15.0 + 2.0 * steps  # of the log: 0.02 m/s more at each 0.01 s
    np.testing.assert_allclose(part[0].rolled, np.sum(speed * 0.01), rtol=1e-9)


def test_mirrored_log_gives_mirrored_rails(log: pyarrow.Table, report: DamageReport) -> None:
    columns = {name: log[name].to_numpy() for name in log.column_names}
    for name in ("side", "nu_y", "phi", "force_y", "moment_z"):
        columns[name] = -columns[name]
    left, right = rails_of(pyarrow.table(columns), law=EQUAL).rails[0]
    equal(left, report.rails[0][1].mirrored())
    equal(right, report.rails[0][0].mirrored())
    equal(left.mirrored().mirrored(), left)


def test_weights_and_mass(report: DamageReport) -> None:
    """A weight changes no damage per tonne; two vehicles share theirs by the mass that passes."""
    rail, other = (one.passed_once(mass) for one, mass in zip(report.rails[0], (120e3, 30e3), strict=True))
    np.testing.assert_allclose((7.0 * rail).depth_per_mgt, rail.depth_per_mgt, rtol=1e-13)
    assert rail.depth_per_mgt == pytest.approx(rail.by_wheel.depth.sum(axis=0) * MGT / 120e3)
    other = other.mirrored()
    both = 3.0 * rail + other * np.float64(2.0)
    mean = (360e3 * rail.depth_per_mgt + 60e3 * other.depth_per_mgt) / 420e3
    np.testing.assert_allclose(both.depth_per_mgt, mean, rtol=1e-12, atol=1e-25)
    assert both.mass == pytest.approx(420e3)
    twice = sum([rail, rail])
    equal(twice, replace(2.0 * rail, by_wheel=replace(2.0 * rail.by_wheel, rows=twice.by_wheel.rows)))
    assert rail.rolled == pytest.approx(1.0)
    assert rail.by_wheel.pressure_by_part == pytest.approx(report.rails[0][0].by_wheel.pressure_by_part)


def test_a_wheel_that_came_half_way_has_passed_once(log: pyarrow.Table) -> None:
    """Of a steady state: however far each wheelset came, one passing of the vehicle is the same."""
    columns = {name: log[name].to_numpy() for name in log.column_names}
    first = {name: values[columns["time"] == 0.0] for name, values in columns.items()}
    steps = [first | {"time": np.full(first["time"].size, 0.01 * k)} for k in range(40)]
    steady = {name: np.concatenate([step[name] for step in steps]) for name in first}
    whole = pyarrow.table(steady)
    late = pyarrow.table(
        {n: v[(steady["wheelset"] == 1) | (steady["time"] < 0.195)] for n, v in steady.items()}
    )
    pair = [[rail.passed_once(100e3) for rail in rails_of(one).rails[0]] for one in (whole, late)]
    for one, other in zip(*pair, strict=True):
        for name in ("worn_area", "crack_damage", "work", "rcf_number"):
            compare(getattr(one.by_wheel, name), getattr(other.by_wheel, name), name)
        compare(one.whole_life, other.whole_life, "whole_life")


def test_place_on_the_rail(make_log: MakeLog) -> None:
    """At the arc length of y_rail from the top, towards the gauge; a left and a right wheel alike."""
    source = on_track(make_log(side=np.array([1, -1]), contact_angle=1.1, nu_x=0.01, b=2e-3))
    grid = WHOLE.left
    for rail in rails_of(source).rails[0]:
        middle = np.average(grid.centres, weights=rail.by_wheel.depth[0])
        assert middle == pytest.approx(grid.place([0.031], [1.1])[0][0], abs=1e-5)
    top = RAIL.y[np.argmax(RAIL.z)]
    assert grid.place([top], [0.0])[0][0] == pytest.approx(0.0, abs=1e-12)
    assert grid.place([0.031], [1.1])[0][0] > 0.031 - top  # longer along the corner than across
    for one in (grid, LateralGrid()):
        for y, angle in ((-0.02, 0.1), (0.0, 0.0), (0.031, 1.0), (0.2, 0.3)):
            position, stretch = one.place([y], [angle])
            assert place_of(y, angle, one.table) == pytest.approx((position[0], stretch[0]), abs=1e-15)


def test_harder_rail_wears_less_and_the_wheel_as_before(make_log: MakeLog) -> None:
    """Below seizure by the ratio of hardness; seizure is that of the softer body, the wheel."""
    source = on_track(make_log(time=0.1 * np.arange(3), nu_x=0.002, normal_force=60e3))
    worn = {}
    for steel in (R260, R350HT):
        report = assess(source, cells=CELLS, rails=RailModel((WHOLE,), steel))
        worn[steel.name] = report.rails[0][0].by_wheel.worn_area.sum()
        wheel = report.surface.worn_area.sum() * 2.0 * math.pi * RADIUS
        ratio = read_archard(np.array(report.model.law.numbers)).map.hardness / steel.hardness
        assert worn[steel.name] / wheel == pytest.approx(ratio, rel=1e-12)
        assert report.model.rail_seizure_pressure == pytest.approx(report.model.seizure_pressure)
    assert worn["R260"] / worn["R350HT"] == pytest.approx(370.0 / 280.0)
    assert R260.shear_yield < R350HT.shear_yield
    with pytest.raises(ValueError, match=r"rail material 'R400' is not known; known: R260, R350HT"):
        rail_material("R400")


def test_whole_life_damage_of_a_passing(make_log: MakeLog) -> None:
    """At the wear number of the log: below the first point none, beyond the last one wear prevails."""
    for nu_x in (1e-5, 5e-4, 2e-3, 2e-2):
        source = on_track(make_log(nu_x=nu_x))
        rail = rails_of(source).rails[0][0].passed_once(100e3)
        expected = float(BURSTOW_RAIL.damage(rail.mean_wear_number[0]))
        values = rail.whole_life[0]
        assert values[np.argmax(np.abs(values))] == pytest.approx(expected, rel=1e-12)
        assert values.sum() * 1e-3 == pytest.approx(expected * 0.010, rel=1e-9)  # 2 b wide


def test_a_rail_in_a_file(report: DamageReport, tmp_path: Path) -> None:
    rail = report.rails[0][0].passed_once(120e3)
    save_rail(rail, tmp_path / "rail.npz")
    again = load_rail(tmp_path / "rail.npz")
    equal(again, rail)
    assert again.by_wheel.grid == rail.by_wheel.grid
    content = (tmp_path / "rail.npz").read_bytes()
    (tmp_path / "rail.npz").write_bytes(content[: len(content) // 2])
    with pytest.raises(BrokenFile):
        load_rail(tmp_path / "rail.npz")


def reported(report: DamageReport) -> RailReport:
    places = (RailPlace("curve R 300 m left", -1.0, 4.0, "left", RAIL, RAIL),)
    pair: RailPair = report.rails[0]
    return rail_report([replace(report, rails=(pair,))], places, 120e3)


def test_report_names_rails_and_says_what_is_seized(report: DamageReport) -> None:
    """The wheel with the flange, 1L of the log, wears its rail most: the low one of a left curve."""
    found = reported(report)
    left, right = found.to_table().to_pylist()
    assert (left["rail"], right["rail"]) == ("low", "high")
    rail = found.found[0].pair[0]
    assert left["worn_area_mm2_per_MGT"] == pytest.approx(rail.worn_area_per_mgt * 1e6)
    assert left["wear_mm_per_MGT"] == pytest.approx(rail.depth_per_mgt.max() * 1e3)
    assert left["gauge_wear_mm_per_MGT"] > 0.0 == right["gauge_wear_mm_per_MGT"]
    assert left["worst_wheelset"] == 1
    sums = rail.by_wheel
    assert left["fatigue_share"] == pytest.approx(sums.positive_time.sum() / sums.patch_time.sum())
    assert 0.0 < left["fatigue_area_index"] < left["fatigue_share"] <= 1.0
    assert left["worst_share"] > 0.5
    assert left["wear_note"] == "not to be extrapolated"
    bins = found.profile_table()
    both = bins["head_wear_mm_per_MGT"].to_numpy() + bins["gauge_wear_mm_per_MGT"].to_numpy()
    low = bins["rail"].to_numpy() == "low"
    np.testing.assert_allclose(both[low], rail.depth_per_mgt * 1e3)


def test_figure_has_a_panel_for_each_rail(report: DamageReport) -> None:
    """Of many stretches those that wear most; the gauge face of the left rail is on its right."""
    found = reported(report)
    panels = rail_wear_figure(found).axes
    assert [panel.get_title(loc="left").split(": ")[1] for panel in panels] == ["low rail", "high rail"]
    for panel, rail, forwards in zip(panels, found.found[0].pair, (1.0, -1.0), strict=True):
        highest = 100.0 * rail.depth_per_mgt.max() * 1e3
        assert panel.texts[0].get_text().startswith(f"max {highest:.3g}, ")
        outline = np.asarray(panel.lines[-1].get_xdata())
        assert outline[0] * forwards < 0.0 < outline[-1] * forwards
    many = replace(found, found=found.found * 6)
    assert len(rail_wear_figure(many).axes) == 2 * MOST_PLACES


def test_bad_input(log: pyarrow.Table, report: DamageReport) -> None:
    with pytest.raises(ValueError, match="start = 5 m must lie before end = 5 m"):
        RailStretch(5.0, 5.0)
    with pytest.raises(ValueError, match="stretch of rail from 3 m begins before the one before it ends"):
        RailModel((RailStretch(0.0, 4.0), RailStretch(3.0, 6.0)))
    with pytest.raises(ValueError, match="there is none"):
        RailModel(())
    left, right = report.rails[0]
    with pytest.raises(ValueError, match="a left and a right rail cannot be added"):
        left + right
    with pytest.raises(ValueError, match="the mass that passed this rail is not known"):
        _ = left.depth_per_mgt
    with pytest.raises(ValueError, match=r"mass = 0\.0 kg of the vehicle must be finite and > 0"):
        left.passed_once(0.0)
    with pytest.raises(ValueError, match=r"weight = -1\.0 - of a rail|weight = -1\.0"):
        -1.0 * left
    bare = log.drop_columns(["y_rail"])
    with pytest.raises(ValueError, match="no column y_rail"):
        rails_of(bare)
    assert set(RAIL_COLUMNS) == {"s", "y_rail", "patch"}
    far = log.set_column(log.column_names.index("y_rail"), "y_rail", [np.full(log.num_rows, 0.2)])
    with pytest.raises(ValueError, match=r"y_rail = 200\.00 mm, .* lies beyond the bins of its rail"):
        rails_of(far, RailStretch(-1.0, 1000.0))
    with pytest.raises(ValueError, match="needs damage reports with rails"):
        rail_report([assess(log, cells=CELLS)], (), 1e5)
    place = RailPlace("straight", -1.0, 1000.0, "", RAIL, RAIL)
    with pytest.raises(ValueError, match="no stretch of rail was passed by all wheels"):
        rail_report([report], (place,), 1e5)
    model = DamageModel(rails=RailModel((WHOLE,)))
    assert model.rails is not None
    assert model.rails.wear.name == "archard"
