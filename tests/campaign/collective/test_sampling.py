"""Errors of weighted sums: coverage over many repetitions, and the best place of the next sample."""

import math
from itertools import product

import numpy as np
import pytest
from collectives import product_text
from scipy.integrate import quad
from scipy.stats import norm, truncnorm

from hh_exudyn.campaign.collective import Collective, Stratum, plan_of_text
from hh_exudyn.campaign.collective.axes import gauge_deviations
from hh_exudyn.campaign.collective.design import full_product, overlay
from hh_exudyn.campaign.collective.plan import GaugeSpread
from hh_exudyn.campaign.collective.sampling import (
    Estimates,
    by_units,
    halving_error,
    next_samples,
    of_samples,
    samples_to_error,
)

WEIGHT = np.array([0.5, 0.3, 0.15, 0.05])
MEAN = np.array([1.0, 2.0, 5.0, 20.0])  # rare strata wear most, as tight curves do
SPREAD = np.array([0.1, 0.5, 2.0, 15.0])


def sampled(rng: np.random.Generator, count: np.ndarray, skewed: bool = False) -> Estimates:
    draw = (lambda n: rng.gamma(4.0, 0.25, n) * 2.0 - 2.0) if skewed else rng.standard_normal
    samples = [
        (m + s * draw(n))[:, None] for m, s, n in zip(MEAN, SPREAD, count, strict=True)
    ]  # fmt: skip
    return of_samples(WEIGHT, samples)


def covered(count: list[int], skewed: bool = False, many: int = 3000) -> float:
    rng = np.random.default_rng(5)
    exact = WEIGHT @ MEAN
    hits = 0
    for _ in range(many):
        known = sampled(rng, np.array(count), skewed)
        hits += abs(known.total[0] - exact) <= known.half_width()[0]
    return hits / many


@pytest.mark.parametrize("count", [[3, 3, 3, 3], [3, 3, 6, 12], [10, 10, 10, 10]])
def test_the_interval_holds_the_true_sum_as_often_as_stated(count: list[int]) -> None:
    """95 % of 3000 repetitions, within a part of Satterthwaite's approximation at three samples."""
    assert covered(count) == pytest.approx(0.95, abs=0.02)


def test_a_skewed_quantity_is_covered_less_with_few_samples() -> None:
    """Damage is skewed (gamma of skewness 1): what the normal theory loses is stated here."""
    few, many = covered([3, 3, 3, 3], skewed=True), covered([3, 3, 10, 40], skewed=True)
    assert 0.88 < few < 0.95
    assert many == pytest.approx(0.95, abs=0.02)


def test_the_standard_error_is_that_of_many_sums() -> None:
    rng = np.random.default_rng(6)
    found = [sampled(rng, np.array([3, 4, 5, 8])) for _ in range(3000)]
    scatter = np.std([known.total[0] for known in found])
    assert math.sqrt(np.mean([known.standard_error[0] ** 2 for known in found])) == pytest.approx(
        scatter, rel=0.05
    )
    exact = math.sqrt(np.sum(WEIGHT**2 * SPREAD**2 / np.array([3, 4, 5, 8])))
    assert scatter == pytest.approx(exact, rel=0.05)


def known_spread(count: list[int]) -> Estimates:
    return Estimates(WEIGHT, MEAN[:, None], SPREAD[:, None], np.array(count))


def test_one_by_one_is_the_best_of_all_ways_to_place_samples() -> None:
    start = known_spread([3, 3, 3, 3])
    more = next_samples(start, np.ones(1), 6)
    assert more.sum() == 6
    ways = [way for way in product(range(7), repeat=4) if sum(way) == 6]
    best = min(start.with_samples(start.count + np.array(way)).standard_error[0] for way in ways)
    assert start.with_samples(start.count + more).standard_error[0] == pytest.approx(best)


def test_many_samples_are_in_proportion_to_weight_times_spread() -> None:
    start = known_spread([3, 3, 3, 3])
    count = start.count + next_samples(start, np.ones(1), 2000)
    wanted = WEIGHT * SPREAD / np.sum(WEIGHT * SPREAD) * count.sum()  # Neyman
    assert count == pytest.approx(wanted, abs=2.5)


def test_samples_are_added_until_the_error_or_the_budget() -> None:
    start = known_spread([3, 3, 3, 3])
    allowed = np.array([0.05 * start.total[0]])
    more = samples_to_error(start, allowed, 10_000)
    assert start.with_samples(start.count + more).half_width()[0] <= allowed[0]
    assert more.sum() < 3000
    assert samples_to_error(start, allowed, 7).sum() == 7
    assert samples_to_error(start, np.array([1e3]), 7).sum() == 0


def test_what_is_dear_is_bought_less() -> None:
    """Two strata alike but for the price of a sample: the cheap one gets more, and the budget is kept."""
    known = Estimates(np.array([0.5, 0.5]), np.ones((2, 1)), np.ones((2, 1)), np.array([3, 3]))
    cost = np.array([1.0, 4.0])
    more = samples_to_error(known, np.array([1e-6]), 100.0, cost=cost)
    assert more @ cost == pytest.approx(100.0, abs=1.0)
    count = 3 + more
    assert count[0] / count[1] == pytest.approx(2.0, rel=0.1)  # as W s over the root of the cost


def test_the_quantity_furthest_from_its_error_leads() -> None:
    spread = np.array([[1.0, 0.0], [0.0, 1.0]])
    known = Estimates(np.array([0.5, 0.5]), np.ones((2, 2)), spread, np.array([3, 3]))
    assert list(next_samples(known, np.array([1.0, 0.1]), 1)) == [0, 1]
    assert list(next_samples(known, np.array([0.1, 1.0]), 1)) == [1, 0]


def test_without_spread_there_is_no_error() -> None:
    known = Estimates(WEIGHT, MEAN[:, None], np.zeros((4, 1)), np.array([3, 3, 3, 3]))
    assert known.half_width()[0] == 0.0


def test_faulty_estimates_are_refused() -> None:
    with pytest.raises(ValueError, match="allowed 3 samples or more"):
        known_spread([3, 3, 2, 3])
    with pytest.raises(ValueError, match="2 samples of a stratum: allowed 3 or more"):
        of_samples(np.ones(1), [np.ones((2, 1))])
    with pytest.raises(ValueError, match=r"allowed \(4, quantities\)"):
        Estimates(WEIGHT, MEAN[:, None], SPREAD, np.array([3, 3, 3, 3]))
    with pytest.raises(ValueError, match="confidence is 1: allowed above 0 and below 1"):
        known_spread([3, 3, 3, 3]).half_width(1.0)


def test_overlays_are_covered_and_beat_independent_cells_on_what_is_nearly_additive() -> None:
    axes = [[0.2, 0.5, 0.3], [1 / 3] * 3, [0.1, 0.3, 0.4, 0.2], [0.7, 0.3]]
    rng = np.random.default_rng(8)
    effects = [rng.normal(size=len(shares)) for shares in axes]

    def value(levels: tuple[int, ...]) -> float:
        return math.exp(0.3 * sum(effect[level] for effect, level in zip(effects, levels, strict=True)))

    cells = list(full_product(axes))
    exact = math.fsum(share * value(levels) for levels, share in cells)

    def total() -> float:
        return math.fsum(share * value(levels) for levels, share in overlay(axes, rng.random(4)))

    hits, many = 0, 1000
    for _ in range(many):
        whole = of_samples(np.ones(1), [np.array([[total()] for _ in range(5)])])
        hits += abs(whole.total[0] - exact) <= whole.half_width()[0]
    assert hits / many == pytest.approx(0.95, abs=0.03)
    scatter = np.std([total() for _ in range(1000)])
    random = math.sqrt(math.fsum(share * (value(levels) - exact) ** 2 for levels, share in cells) / 12)
    assert scatter < 0.6 * random  # 12 cells drawn at random; an overlay here has at most 12


def test_the_halving_error_bounds_that_of_the_finer_steps() -> None:
    """Smooth: the estimate is the error. With a threshold, as of cracks, the first order is needed."""

    def of_gauge(value: "np.ndarray | float") -> "np.ndarray | float":
        return np.exp(150.0 * value)

    exact = quad(lambda x: of_gauge(4e-3 * x) * truncnorm.pdf(x, -2, 2), -2, 2)[0]

    def result(halvings: int) -> float:
        steps = gauge_deviations(GaugeSpread(4e-3, 2.0, 3), halvings)
        return math.fsum(step.share * of_gauge(step.value) for step in steps)

    for halvings in (1, 2, 3):
        error = abs(result(halvings) - exact)
        stated = halving_error(np.array(result(halvings - 1)), np.array(result(halvings)))
        assert error == pytest.approx(float(stated), rel=0.5)

    limit = 0.9e-3
    above = norm.cdf(2.0) - norm.cdf(limit / 4e-3)
    whole = norm.cdf(2.0) - norm.cdf(-2.0)
    for halvings in (1, 2, 3):
        steps = [gauge_deviations(GaugeSpread(4e-3, 2.0, 3), h) for h in (halvings - 1, halvings)]
        share = [math.fsum(step.share for step in each if step.value > limit) for each in steps]
        assert abs(share[1] - above / whole) <= 1.0 / (3 * 2**halvings)  # one step at most


def test_overlays_of_groups_are_samples_of_units() -> None:
    """A known function of the strata's labels: the stated interval holds the result of the full product."""

    def value(stratum: Stratum) -> float:
        curve = 0.0 if stratum.straight else 300.0 / stratum.radius_m
        return math.exp(3.0 * stratum.friction_tread * curve) * (1.0 + 0.05 * (1445.0 - stratum.gauge_mm))

    full = Collective(plan_of_text(product_text("full", replicates=1)))
    exact = math.fsum(item.weight * value(item.stratum) for item in full.strata)
    found = Collective(plan_of_text(product_text("overlay", replicates=12)))
    units, known = by_units(
        np.array([item.weight for item in found.strata]),
        [found.unit(item.stratum) for item in found.strata],
        np.array([item.stratum.replicate for item in found.strata]),
        np.array([[value(item.stratum)] for item in found.strata]),
    )
    assert len(units) == 10  # five groups, loaded and empty
    assert set(known.count) == {12}
    assert known.weight.sum() == pytest.approx(1.0, abs=1e-12)
    assert known.total[0] == pytest.approx(
        math.fsum(item.weight * value(item.stratum) for item in found.strata), rel=1e-12
    )
    assert abs(known.total[0] - exact) < 2.0 * known.half_width()[0]
    assert known.half_width()[0] < 0.01 * exact
