"""Weights of cases for other shares: what they sum to, and what stays as it was."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from made_up_campaign import campaign_file

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


def sum_of(cases: tuple[WeightedCase, ...], found: np.ndarray, **labels: str) -> float:
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
    """Loaded runs have four seasons: odds of humid change as its share says, others keep theirs."""
    before, after = weights.nominal, weights.at({HUMID: 40.0})
    own = {
        season: tuple(sum_of(cases, found, running="loaded", season=season) for found in (before, after))
        for season in ("humid", "moderate", "dry")
    }
    odds = [own["humid"][i] / own["dry"][i] for i in (0, 1)]
    assert odds[1] / odds[0] == pytest.approx((40.0 / 60.0) / (28.0 / 72.0))
    assert own["moderate"][1] / own["dry"][1] == pytest.approx(own["moderate"][0] / own["dry"][0])
    for running in ("loaded", "empty"):
        assert sum_of(cases, after, running=running) == pytest.approx(sum_of(cases, before, running=running))


def test_a_running_takes_its_share(weights: CaseWeights, cases: tuple[WeightedCase, ...]) -> None:
    found = weights.at({"running[0].share_percent": 30.0})
    assert sum_of(cases, found, running=cases[0].stratum.running) == pytest.approx(0.3)


def test_classes_of_the_line_keep_their_shares_where_all_have_all_seasons(tmp_path: Path) -> None:
    """In a design of all seasons for each class both hold: the new season, and the line as it is."""
    text = campaign_file(tmp_path).read_text().replace("runs = 8", "runs = 120")
    (tmp_path / "campaign.toml").write_text(text)
    plan = read_campaign(tmp_path / "campaign.toml")
    strata = plan.of_steps.strata  # weights need no cases
    cases = [
        WeightedCase(None, one.weight, one.stratum, one.mirrored, one.setting.season.films, ())  # type: ignore[arg-type]
        for one in strata
    ]
    weights = CaseWeights(plan.collective.plan, cases)
    after = weights.at({DRY: 30.0})
    for label in dict.fromkeys((one.stratum.running, one.stratum.curve_class) for one in strata):
        own = np.array([(one.stratum.running, one.stratum.curve_class) == label for one in strata])
        assert after[own].sum() == pytest.approx(weights.nominal[own].sum(), rel=1e-6)
    dry = np.array([one.stratum.season == "dry" for one in strata])
    assert after[dry].sum() > 1.4 * weights.nominal[dry].sum()


def test_shares_that_change_are_as_given_and_the_others_share_the_rest() -> None:
    nominal = {"a": 0.05, "b": 0.35, "c": 0.6}
    found = shared(nominal, {"a": 0.24})
    assert found["a"] == pytest.approx(0.24)
    assert found["b"] / found["c"] == pytest.approx(0.35 / 0.6)
    assert sum(found.values()) == pytest.approx(1.0)
    assert shared(nominal, {"a": 0.5, "b": 0.5, "c": 1.0}) == pytest.approx({"a": 0.25, "b": 0.25, "c": 0.5})
