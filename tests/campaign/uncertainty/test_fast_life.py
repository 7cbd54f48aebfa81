"""Lives of a made-up campaign from its stored rates, and the command."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import call, refused
from made_up_campaign import campaign_file, run

from damage.parameters import parameters, tables_of
from hh_exudyn.campaign.life.campaign import Campaign
from hh_exudyn.campaign.life.rates import weighted_mean
from hh_exudyn.campaign.life.stored_rows import rows_of_last_evaluation
from hh_exudyn.campaign.uncertainty import fast_life
from hh_exudyn.campaign.uncertainty.assumptions import Assumptions, assumptions_of
from hh_exudyn.campaign.uncertainty.fast_life import FastLife

LUBRICATED = "wear.surface.lubricated"
FAILURE_DEPTH = "limits.cracks.failure_depth"


@pytest.fixture(scope="module")
def campaign(tmp_path_factory: pytest.TempPathFactory) -> Campaign:
    folder = tmp_path_factory.mktemp("bands")
    found = Campaign.begin(campaign_file(folder), folder / "out")
    assert run(found, 500.0)
    return found


@pytest.fixture(scope="module")
def life(campaign: Campaign) -> FastLife:
    return FastLife(campaign)


def test_values_of_the_file_give_the_rates_of_the_campaign(campaign: Campaign, life: FastLife) -> None:
    rows = rows_of_last_evaluation(campaign)
    assert set(life.assumptions.nominal) >= {LUBRICATED, FAILURE_DEPTH, "wear.dry"}
    for group in campaign.groups:
        own = weighted_mean([(weighted.weight, rates[group]) for weighted, rates in rows])
        found = life.rates(group, life.assumptions.nominal)
        assert np.abs(found.depth - own.depth).max() < 1e-14 * own.depth.max()
        for index, growth in own.cracks.items():
            assert np.abs(found.cracks[index] - growth).max() < 1e-14 * growth.max()


def test_nothing_is_opened_or_written(campaign: Campaign) -> None:
    before = {path: path.stat().st_mtime_ns for path in campaign.directory.rglob("*")}
    assert rows_of_last_evaluation(campaign)
    assert before == {path: path.stat().st_mtime_ns for path in campaign.directory.rglob("*")}


def test_wear_goes_with_the_dry_coefficients_and_cracks_do_not(life: FastLife) -> None:
    usual, more = life.rates("outer", {}), life.rates("outer", {"wear.dry": 1.3})
    assert more.depth == pytest.approx(1.3 * usual.depth)
    assert np.array_equal(more.cracks["global"], usual.cracks["global"])


def test_a_film_acts_where_it_lies(campaign: Campaign, life: FastLife) -> None:
    """Twice the divisor halves the wear of humid seasons on the tread, and leaves dry ones alone."""
    rows = rows_of_last_evaluation(campaign)
    found = life.rates("inner", {LUBRICATED: 12.0})
    on_tread = np.abs(found.y) < 5e-3
    wanted = sum(
        weighted.weight * rates["inner"].depth * (0.5 if weighted.stratum.season == "humid" else 1.0)
        for weighted, rates in rows
    )
    assert found.depth[on_tread] == pytest.approx(wanted[on_tread], rel=1e-12)


def test_grease_acts_on_the_flange_alone(life: FastLife) -> None:
    factors = life._films.factors("outer", {"wear.surface.greased": 300.0})
    y = life.rates("outer", {}).y
    assert np.array_equal(factors[:, y < 15e-3], np.ones_like(factors[:, y < 15e-3]))
    assert factors.min() == pytest.approx(1.0 / 3.0)


def test_wear_takes_off_shallow_cracks_sooner(life: FastLife) -> None:
    """With h = h_f D and wear w, cracks grow by D - w/h_f: a deep one fails earlier."""
    lives = [life({FAILURE_DEPTH: depth})["inner"] for depth in (3.0, 5.0, 8.0)]
    assert [one.cause for one in lives] == ["crack_depth"] * 3
    assert lives[0].first_turning > lives[1].first_turning > lives[2].first_turning
    growth, wear = life.rates("inner", {}).cracks["global"], life.rates("inner", {}).depth
    for depth, one in zip((3e-3, 5e-3, 8e-3), lives, strict=True):
        assert one.first_turning == pytest.approx(1.0 / (growth - wear / depth).max(), rel=0.02)


def test_an_earlier_limit_is_reached_earlier(life: FastLife) -> None:
    usual, early = life({}), life({"limits.cracks.largest_length": 15.0})
    for group in life.groups:
        assert early[group].cause == "crack_length"
        assert early[group].first_turning < usual[group].first_turning
        assert early[group].tread == usual[group].tread
        assert early[group].flange_height == usual[group].flange_height


def test_what_has_no_case_or_needs_runs_is_named(life: FastLife) -> None:
    reasons = {one.parameter.name: one.reason for one in life.assumptions.not_varied}
    assert reasons["gauge.deviation_mm"] == "needs other runs"
    assert reasons["season[0].tread"] == "needs other runs"
    assert reasons["season[0].share_percent"].startswith("no case of the last evaluation")
    assert "running[0].speed.of_largest_percent[0]" in reasons
    assert not set(reasons) & set(life.assumptions.nominal)


def test_ranges_are_those_of_the_values_in_the_data() -> None:
    ours = tables_of("hh_exudyn.campaign.uncertainty:data/ranges.toml")
    for table, items in ours.items():
        for name, item in items.items():
            assert item.value == parameters("wear", table)[name].value
            assert parameters("wear", table)[name].range is None


def test_errors_of_sampling_are_a_factor_on_rates(campaign: Campaign, life: FastLife) -> None:
    names = ["outer: wear at y = 0 mm [m/m]", "outer: global crack damage of the tread [1/m]"]
    content = {"distance_km": 500.0, "quantities": names, "sampling": [0.1, 0.3]}
    path = campaign.directory / "errors.json"
    path.write_text(json.dumps(content))
    try:
        with_errors = FastLife(campaign)
    finally:
        path.unlink()
    own = {one.name: one.ends for one in with_errors.assumptions.varied if one.name.startswith("errors")}
    assert own["errors.wear[outer]"] == pytest.approx((0.9, 1.1))
    assert own["errors.cracks[outer]"] == pytest.approx((0.7, 1.3))
    values = {"errors.wear[outer]": 1.1, "errors.cracks[outer]": 0.7}
    assert with_errors.rates("outer", values).depth == pytest.approx(1.1 * life.rates("outer", {}).depth)
    assert np.array_equal(with_errors.rates("inner", values).depth, life.rates("inner", {}).depth)


def test_the_command_prints_bands_and_what_matters_most(
    campaign: Campaign, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With four assumptions alone, for time."""
    pytest.importorskip("SALib")
    few = {"wear.dry", FAILURE_DEPTH, "season[1].share_percent", "limits.profile.largest_hollow"}

    def fewer(*arguments: Any) -> Assumptions:
        found = assumptions_of(*arguments)
        return replace(found, varied=tuple(one for one in found.varied if one.name in few))

    monkeypatch.setattr(fast_life, "assumptions_of", fewer)
    figure, table = tmp_path / "bands.png", tmp_path / "bands.csv"
    result = call(
        "campaign", "uncertainty", campaign.directory, "--samples", "10", "--out", figure, "--csv", table
    )
    assert result.exit_code == 0, result.output
    assert "failure depth" in result.stdout
    assert "Not varied:" in result.stdout
    assert "gauge.deviation_mm = 4 mm (2 to 6): needs other runs" in result.stdout
    assert figure.stat().st_size > 10_000
    assert table.read_text().startswith('"group","quantity","unit","nominal","p5","p50","p95"')
    assert "wear.dry" in (tmp_path / "bands_assumptions.csv").read_text()


def test_a_campaign_without_a_step_is_refused(tmp_path: Path) -> None:
    Campaign.begin(campaign_file(tmp_path), tmp_path / "out")
    message = refused("campaign", "uncertainty", tmp_path / "out")
    assert "no step has been made yet" in message
    assert "allowed morris, sobol" in refused("campaign", "uncertainty", tmp_path / "out", "--method", "x")
    assert "--samples 3: allowed 10 to" in refused("campaign", "uncertainty", tmp_path, "--samples", "3")
