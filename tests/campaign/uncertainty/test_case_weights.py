"""Weights of cases for other shares: what they sum to, and what stays as it was."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from made_up_campaign import campaign_file

from hh_exudyn.campaign.collective import template_text
from hh_exudyn.campaign.collective.collective import Collective
from hh_exudyn.campaign.collective.plan_file import plan_of_text
from hh_exudyn.campaign.collective.weighted import WeightedCase
from hh_exudyn.campaign.life.plan import CampaignPlan, read_campaign
from hh_exudyn.campaign.uncertainty.case_weights import CaseWeights, shared

HUMID, DRY = "season[1].share_percent", "season[3].share_percent"


@pytest.fixture(scope="module")
def plan(tmp_path_factory: pytest.TempPathFactory) -> CampaignPlan:
    return read_campaign(campaign_file(tmp_path_factory.mktemp("plan")))


@pytest.fixture(scope="module")
def cases(plan: CampaignPlan) -> tuple[WeightedCase, ...]:
    return plan.of_steps.cases()


@pytest.fixture(scope="module")
def weights(plan: CampaignPlan, cases: tuple[WeightedCase, ...]) -> CaseWeights:
    return CaseWeights(plan.collective.plan, cases)


def sum_of(cases: tuple[WeightedCase, ...], found: np.ndarray, **labels: object) -> float:
    own = [all(getattr(case.stratum, name) == value for name, value in labels.items()) for case in cases]
    return float(found[np.array(own)].sum())


def test_shares_of_the_file_give_its_own_weights(
    weights: CaseWeights, cases: tuple[WeightedCase, ...], plan: CampaignPlan
) -> None:
    usual = {n.name: n.value for n in plan.collective.plan.numbers if n.name in weights.names}
    assert HUMID in usual
    own = np.array([case.weight for case in cases])
    for values in ({}, usual):
        assert np.abs(weights.at(values) - own).max() < 1e-14


@pytest.mark.parametrize(
    "values", [{HUMID: 40.0}, {HUMID: 15.0, DRY: 30.0}, {"running[0].share_percent": 30.0}]
)
def test_weights_sum_to_one_and_none_is_negative(weights: CaseWeights, values: Mapping[str, float]) -> None:
    found = weights.at(values)
    assert found.sum() == pytest.approx(1.0, abs=1e-14)
    assert found.min() >= 0.0


def test_a_season_takes_its_share_from_the_others_in_proportion(
    weights: CaseWeights, cases: tuple[WeightedCase, ...]
) -> None:
    """Curves of loaded runs have three seasons: the odds of humid change as its share, others stay."""
    before, after = weights.nominal, weights.at({HUMID: 40.0})
    own = {
        season: tuple(
            sum_of(cases, found, running="loaded", straight=False, season=season) for found in (before, after)
        )
        for season in ("humid", "moderate", "dry")
    }
    odds = [own["humid"][i] / own["dry"][i] for i in (0, 1)]
    assert odds[1] / odds[0] == pytest.approx((40.0 / 60.0) / (28.0 / 72.0))
    assert own["moderate"][1] / own["dry"][1] == pytest.approx(own["moderate"][0] / own["dry"][0])


def test_straight_track_keeps_its_part_of_the_line(
    weights: CaseWeights, cases: tuple[WeightedCase, ...]
) -> None:
    """Grease lies on straight track alone in these few cases, and must not make more of it."""
    before, after = weights.nominal, weights.at({"season[5].share_percent": 30.0, HUMID: 15.0})
    for running in ("loaded", "empty"):
        for straight in (True, False):
            part = {"running": running, "straight": straight}
            assert sum_of(cases, after, **part) == pytest.approx(sum_of(cases, before, **part))


def test_a_running_takes_its_share(weights: CaseWeights, cases: tuple[WeightedCase, ...]) -> None:
    found = weights.at({"running[0].share_percent": 30.0})
    assert sum_of(cases, found, running=cases[0].stratum.running) == pytest.approx(0.3)


def test_groups_of_curves_keep_their_part_where_they_have_runs_enough() -> None:
    """With many runs every group of classes is a cell: the line stays, the season takes its share."""
    text = template_text("malmbanan", "iore_wagon").replace("\nruns = 20", "\nruns = 200")
    plan = replace(plan_of_text(text), replicates=1)
    strata = Collective(plan).strata
    cases = [WeightedCase(Any, s.weight, s.stratum, s.mirrored, s.setting.season.films, ()) for s in strata]
    weights = CaseWeights(plan, cases)
    after = weights.at({DRY: 30.0})
    for label in dict.fromkeys((one.stratum.running, one.stratum.group) for one in strata):
        own = np.array([(one.stratum.running, one.stratum.group) == label for one in strata])
        assert after[own].sum() == pytest.approx(weights.nominal[own].sum(), rel=1e-12)
    dry = np.array([one.stratum.season == "dry" for one in strata])
    assert after[dry].sum() == pytest.approx(0.3, abs=0.02)


def test_hauls_with_shares_of_their_own_in_a_class_keep_them_there() -> None:
    """Gradients of the locomotive have other shares in tight curves, which the general one does not touch."""
    text = template_text("malmbanan", "iore_locomotive").replace("\nruns = 20", "\nruns = 200")
    plan = replace(plan_of_text(text), replicates=1)
    strata = Collective(plan).strata
    cases = [WeightedCase(Any, s.weight, s.stratum, s.mirrored, s.setting.season.films, ()) for s in strata]
    weights = CaseWeights(plan, cases)
    after = weights.at({"running[0].haul[2].share_percent": 50.0})
    loaded = np.array([one.stratum.running == "loaded" for one in strata])
    down = loaded & np.array([one.stratum.haul == "down" for one in strata])
    tight = np.array([one.stratum.curve_class in ("<350", "350:400", "400:450") for one in strata])
    straight = loaded & np.array([one.stratum.straight for one in strata])
    assert after[tight] == pytest.approx(weights.nominal[tight], rel=1e-12)
    before_odds, after_odds = (
        found[straight & down].sum() / found[straight & ~down].sum() for found in (weights.nominal, after)
    )
    assert after_odds / before_odds == pytest.approx((50.0 / 50.0) / (35.0 / 65.0))


def test_seasons_are_told_apart_where_a_cell_has_more_than_one(
    weights: CaseWeights, cases: tuple[WeightedCase, ...]
) -> None:
    """Of the empty runs, one is in curves and one on straight track: their seasons say nothing."""
    assert weights.told == pytest.approx(sum_of(cases, weights.nominal, running="loaded"))


def test_shares_that_change_are_as_given_and_the_others_share_the_rest() -> None:
    nominal = {"a": 0.05, "b": 0.35, "c": 0.6}
    found = shared(nominal, {"a": 0.24})
    assert found["a"] == pytest.approx(0.24)
    assert found["b"] / found["c"] == pytest.approx(0.35 / 0.6)
    assert sum(found.values()) == pytest.approx(1.0)
    assert shared(nominal, {"a": 0.5, "b": 0.5, "c": 1.0}) == pytest.approx({"a": 0.25, "b": 0.25, "c": 0.5})
