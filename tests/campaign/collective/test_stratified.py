"""Points for a budget of runs: exact shares of the line, unbiased, more even than by chance."""

import math
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest
from collectives import product_text
from hypothesis import given, settings
from hypothesis import strategies as st

from hh_exudyn.campaign.collective import Collective, Stratum, plan_of_text, template_text
from hh_exudyn.campaign.collective.allocation import allotted
from hh_exudyn.campaign.collective.design import full_product, uniform
from hh_exudyn.campaign.collective.sampling import by_units
from hh_exudyn.campaign.collective.stratified import Draws, stratified

AXES = [[0.6, 0.4], [0.3, 0.5, 0.2], [0.1, 0.9]]
SEVERITY = [2.0, 1.0, 5.0]


def cells(count: int, number: int, group: int = 0) -> dict[tuple[int, ...], float]:
    draws = Draws.of_group(f"{number}", len(AXES), count + 1, group, 4)
    return dict(stratified(AXES, 1, SEVERITY, count, draws))


@settings(max_examples=50, deadline=None)
@given(st.integers(1, 9), st.integers(0, 10**6))
def test_weights_sum_to_one_over_at_most_so_many_points(count: int, number: int) -> None:
    found = cells(count, number)
    assert math.fsum(found.values()) == pytest.approx(1.0, abs=1e-12)
    assert len(found) <= count


@pytest.mark.parametrize("count", [1, 2, 3])
def test_the_expected_share_of_a_cell_is_the_product(count: int) -> None:
    many = 2000
    wanted = dict(full_product(AXES))
    found = {levels: np.zeros(many) for levels in wanted}
    for number in range(many):
        for levels, share in cells(count, number, group=number % 4).items():
            found[levels][number] = share
    for levels, share in wanted.items():
        error = np.std(found[levels]) / math.sqrt(many)
        assert np.mean(found[levels]) == pytest.approx(share, abs=4.0 * error)


def test_strata_of_the_leading_axis_have_equal_share_times_severity() -> None:
    """Severities 1, 2, 5 with shares 0.5, 0.3, 0.2: 0.5 + 0.6 + 1.0 = 2.1 in three parts of 0.7."""
    widths = {0.5 + 0.2 / 2.0, 0.4 / 2.0 + 0.3 / 5.0, 0.7 / 5.0}
    found = {round(share, 12) for share in cells(3, 1).values()}
    assert found == {round(width, 12) for width in widths}


def test_draws_are_uniform_and_those_of_groups_lie_evenly_between_each_other() -> None:
    one = np.array([Draws.of_group(f"{n}", 2, 3, 1, 5).within[0, 0] for n in range(4000)])
    assert np.mean(one) == pytest.approx(0.5, abs=0.02)
    assert np.var(one) == pytest.approx(1.0 / 12.0, abs=0.004)
    together = np.sort([Draws.of_group("any", 2, 3, group, 5).turn[1] for group in range(5)])
    assert np.diff(together) == pytest.approx([0.2] * 4)
    assert uniform("any", 3) != pytest.approx(uniform("other", 3))


def test_runs_are_allotted_by_claim_with_one_for_each() -> None:
    assert allotted(4, [(1.0, 0.0)] * 4) == [1, 1, 1, 1]
    assert allotted(6, [(1.0, 0.0), (1.0, 9.0), (1.0, 3.0), (1.0, 1.0)]) == [1, 2, 2, 1]
    heavy = allotted(110, [(10.0, 0.0), (1.0, 0.0)])
    assert sum(heavy) == 110
    assert heavy[0] / heavy[1] == pytest.approx(10.0, rel=0.06)
    with pytest.raises(ValueError, match="3 runs for 4 units"):
        allotted(3, [(1.0, 0.0)] * 4)


@pytest.mark.parametrize("vehicle", ["iore_wagon_pair", "iore_locomotive"])
@pytest.mark.parametrize("runs", [10, 20, 33])
def test_a_replicate_has_the_runs_of_the_file_and_the_shares_of_the_line(vehicle: str, runs: int) -> None:
    text = template_text("malmbanan", vehicle).replace("runs = 20", f"runs = {runs}")
    found = Collective(plan_of_text(text))
    for number in (1, 4):
        one = found.replicate(number)
        assert {item.stratum.replicate for item in one} == {number}
        assert len({item.stratum.key for item in one}) == runs
        assert math.fsum(item.weight for item in one) == pytest.approx(1.0, abs=1e-12)
        tight = [s.weight for s in one if (s.stratum.curve_class, s.stratum.hand) == ("<350", "left")]
        assert math.fsum(tight) == pytest.approx(0.5 * 0.023 + 0.5 * 0.022, abs=1e-12)  # Table 1-3, both ways
    assert found.evaluation.startswith(f"one evaluation: {runs} runs (loaded ")
    assert found.table().schema.metadata[b"evaluation"] == found.evaluation.encode()
    assert {s.stratum.key for s in found.replicate(2)} < {s.stratum.key for s in found.strata}


def test_replicates_of_single_units_can_be_chosen() -> None:
    found = Collective(plan_of_text(template_text()))
    mixed = found.replicate(1, {"loaded;<350": 3})
    for item in mixed:
        assert item.stratum.replicate == (3 if found.unit(item.stratum) == "loaded;<350" else 1)
    assert math.fsum(item.weight for item in mixed) == pytest.approx(1.0, abs=1e-12)
    with pytest.raises(ValueError, match="replicate 0: allowed from 1"):
        found.replicate(0)


def test_too_few_runs_name_all_units() -> None:
    text = template_text().replace("runs = 20", "runs = 9")
    with pytest.raises(ValueError, match=r"design.runs = 9: allowed 10 or more, .*: loaded;<350, loaded;350"):
        _ = Collective(plan_of_text(text)).strata
    with pytest.raises(ValueError, match=r"design.runs: overlay has as many as it needs"):
        plan_of_text(template_text().replace('"sampled"', '"overlay"'))


def wear(stratum: Stratum) -> float:
    """Made up: much in dry tight curves under load, little under natural films."""
    curve = 0.1 if stratum.straight else 300.0 / stratum.radius_m
    film = 6.0 if stratum.season in ("wet or snow", "humid") else 1.0
    load = 1.0 if stratum.running == "loaded" else 0.2
    return load * curve * stratum.friction_tread / film * (1.0 + 0.05 * (1445.0 - stratum.gauge_mm))


@pytest.fixture(scope="module")
def many() -> Collective:
    return Collective(plan_of_text(template_text().replace("replicates = 3", "replicates = 60")))


def test_every_share_of_the_file_is_that_of_many_replicates(many: Collective) -> None:
    """Season, haul, quality and gauge, each within four standard errors of what the file says."""
    by: dict[tuple[str, object], np.ndarray] = defaultdict(lambda: np.zeros(60))
    for item in many.strata:
        if item.stratum.running == "loaded":
            for axis in ("season", "haul", "quality"):
                label = (axis, getattr(item.stratum, axis))
                by[label][item.stratum.replicate - 1] += 2.0 * 60.0 * item.weight
    wanted: dict[tuple[str, object], float] = {("haul", "braking"): 0.05}
    wanted |= {("season", season.name): season.share for season in many.plan.seasons}
    for label, share in wanted.items():
        error = np.std(by[label]) / math.sqrt(60)
        assert np.mean(by[label]) == pytest.approx(share, abs=4.0 * error)
    # Table 1-6 weighted with Table 1-3 gives 76 % of QN1 or so: the line's own sum is in `test_shares`
    assert np.mean(by["quality", "QN1"]) == pytest.approx(0.757, abs=0.03)


def test_one_replicate_is_unbiased_with_an_error_that_three_state(many: Collective) -> None:
    """The mean of 60 against the product; the stated interval of three replicates holds it 19 times in 20."""
    weight = np.array([item.weight for item in many.strata])
    values = np.array([[wear(item.stratum)] for item in many.strata])
    units = [many.unit(item.stratum) for item in many.strata]
    replicate = np.array([item.stratum.replicate for item in many.strata])
    names, known = by_units(weight, units, replicate, values)
    assert len(names) == 10
    product = Collective(plan_of_text(product_text("full", quantiles=2, replicates=1))).strata
    exact = math.fsum(item.weight * wear(item.stratum) for item in product)
    assert known.total[0] == pytest.approx(exact, abs=3.0 * known.standard_error[0])
    hits = 0
    for first in range(1, 60, 3):
        mine = (replicate >= first) & (replicate < first + 3)
        few = by_units(weight[mine], [u for u, m in zip(units, mine, strict=True) if m], replicate[mine],
                       values[mine])[1]  # fmt: skip
        total = few.total[0] * 20.0  # of three replicates of 60, each with a 60th of the weight
        hits += abs(total - exact) <= 20.0 * few.half_width()[0]
    assert hits >= 17  # 95 % of 20 is 19


def test_the_template_of_any_line_has_runs_for_all_its_groups() -> None:
    quarry = Path(__file__).parents[2] / "track" / "line" / "quarry_line.toml"
    for vehicle in ("iore_wagon_pair", "iore_wagon_loaded", "iore_locomotive"):
        found = Collective(plan_of_text(template_text(str(quarry), vehicle)))
        assert sum(item.weight for item in found.replicate()) == pytest.approx(1.0, abs=1e-12)
