"""Sizing by error on made-up functions of which the truth is known."""

import math
from collections.abc import Callable, Sequence
from itertools import product

import numpy as np
import pytest
from collectives import product_text
from scipy.stats import truncnorm

from hh_exudyn.campaign.collective import Collective, Stratum, WeightedStratum, plan_of_text, template_text
from hh_exudyn.campaign.collective.bought import Bought, ValuesOf, through_cases
from hh_exudyn.campaign.collective.nearest import nearest_replicates
from hh_exudyn.campaign.collective.sizing import Quantity, Sizing, size
from hh_exudyn.campaign.collective.weighted import WeightedCase

WEAR = (Quantity("tread wear [um per 1000 km]"), Quantity("flange wear [um per 1000 km]"))


def made_up(stratum: Stratum) -> tuple[float, float]:
    """Work on tread and flange, with the noise of a seed: a tenth on the tread, a third on the flange."""
    curve = 0.0 if stratum.straight else 300.0 / stratum.radius_m
    load = 1.0 if stratum.running.startswith("loaded") else 0.2
    noise = np.random.default_rng(stratum.seed).standard_normal(2)
    tread = (0.1 + curve) * stratum.friction_tread * (1.0 + 0.1 * noise[0])
    return load * tread, load * max(0.0, curve - 0.5) * stratum.friction_flange * (1.0 + 0.33 * noise[1])


def values_of(function: Callable[[Stratum], Sequence[float]] = made_up) -> ValuesOf:
    return lambda collective, rows: np.array([function(row.stratum) for row in rows])


def exact() -> np.ndarray:
    """The full product without the noise, which has no mean."""
    cells = Collective(plan_of_text(product_text("full", quantiles=1, replicates=1))).strata
    shown = []
    for row in cells:
        s, curve = row.stratum, 0.0 if row.stratum.straight else 300.0 / row.stratum.radius_m
        load = 1.0 if s.running == "loaded" else 0.2
        flange = load * max(0.0, curve - 0.5) * s.friction_flange
        shown.append((load * (0.1 + curve) * s.friction_tread, flange))
    return np.array([row.weight for row in cells]) @ np.array(shown)


def collective(name: str = "", halvings: str = "quality = 1") -> Collective:
    """The template; another name has other draws and seeds."""
    text = template_text().replace("radius = 1, quality = 1", halvings)
    for running in ("loaded", "empty"):
        text = text.replace(f'name = "{running}"', f'name = "{running}{name}"')
    return Collective(plan_of_text(text))


@pytest.fixture(scope="module")
def reached() -> Sizing:
    return size(collective(), values_of(), WEAR, budget=2000, error=0.05, axes=())


def test_replicates_are_bought_to_the_stated_error(reached: Sizing) -> None:
    assert reached.reached
    assert np.all(reached.sampling <= 0.05)
    assert 60 < reached.runs < 2000
    assert np.all(np.abs(reached.total - exact()) <= 1.5 * 0.05 * exact())
    assert "the stated error of 5.0% is reached" in reached.words()
    assert f"{reached.runs} runs were bought" in reached.words()


def test_they_go_where_weight_times_spread_is_largest(reached: Sizing) -> None:
    counts = reached.counts
    assert min(counts.values()) >= 3
    loaded, empty = ({c for u, c in counts.items() if u.startswith(name)} for name in ("loaded", "empty"))
    assert max(loaded) > max(empty)
    assert counts["loaded;<350"] > counts["loaded;straight"]  # where no flange touches


def test_a_budget_ends_it_and_says_so() -> None:
    found = size(collective(), values_of(), WEAR, budget=90, error=0.01, axes=())
    assert not found.reached
    assert 80 < found.runs <= 90
    assert "the budget of 90 runs ended it before the stated error of 1.0%" in found.words()
    with pytest.raises(ValueError, match="budget = 59 runs: allowed 60 or more, for 3 replicates"):
        size(collective(), values_of(), WEAR, budget=59)
    with pytest.raises(ValueError, match="error = 0: allowed above 0"):
        size(collective(), values_of(), WEAR, budget=90, error=0.0)


@pytest.mark.slow
def test_the_stated_interval_holds_the_truth_and_shrinks_with_the_root_of_the_runs() -> None:
    """Of 24 sizings at each budget; sequential stops and three samples cost some of the 95 %."""
    truth = exact()
    widths = []
    for budget in (70, 280):
        found = [size(collective(f" {n}"), values_of(), WEAR, budget, 1e-3, axes=()) for n in range(24)]
        hits = np.mean([np.abs(f.total - truth) <= f.sampling * f.reference for f in found], axis=0)
        assert np.all(hits >= 0.85)
        widths.append(np.median([f.sampling for f in found], axis=0))
        errors = np.sqrt(np.mean([((f.total - truth) / truth) ** 2 for f in found], axis=0))
        assert np.all(errors < widths[-1])
    assert np.all(widths[1] < 0.6 * widths[0])


def test_the_discretisation_error_of_a_quadratic_in_gauge_is_found() -> None:
    """Its steps' means lose the variance within the steps; an overlay has no sampling error in sums."""
    plan = plan_of_text(product_text("overlay", quantiles=2))

    def straight_only(stratum: Stratum) -> tuple[float]:
        return ((stratum.gauge_mm - 1437.0) ** 2 if stratum.straight else 0.0,)

    found = size(
        Collective(plan), values_of(straight_only), (Quantity("spread [mm2]"),), 5000, axes=("gauge",)
    )
    true = 0.502 * (4.0 * truncnorm(-2.0, 2.0).std()) ** 2
    error = found.discretisation["gauge"].error[0] * found.reference[0]
    assert error == pytest.approx(true - found.total[0], rel=0.25)
    assert found.discretisation["gauge"].uncertainty[0] < 1e-9
    assert found.discretisation["gauge"].change[0] > 0.0
    assert "Steps of gauge: " in found.words()


def test_an_axis_that_is_too_dear_is_named() -> None:
    found = size(collective(), values_of(), WEAR, budget=130, error=1e-3, axes=("gauge", "friction"))
    assert set(found.discretisation) == {"gauge"}
    assert found.left_out == ("friction",)
    assert "Steps of friction: not measured, too much for the budget" in found.words()


def test_errors_of_a_family_are_relative_to_its_largest() -> None:
    def places(stratum: Stratum) -> tuple[float, float, float]:
        tread, flange = made_up(stratum)
        return tread, 1e-6 * flange, 0.0

    family = tuple(Quantity(f"wear at {y} mm", "wheel 1") for y in (0, -40, 60))
    found = size(collective(), values_of(places), family, budget=400, error=0.08, axes=())
    assert found.reached
    assert found.sampling[1] < 1e-4
    assert found.sampling[2] == 0.0


def test_a_stopped_sizing_goes_on_with_what_is_there() -> None:
    """Nothing is evaluated twice, and the result is that of an undisturbed one."""
    kept: dict[str, tuple[float, float]] = {}
    asked: list[str] = []

    def filed(limit: int) -> ValuesOf:
        def values(collective: Collective, rows: Sequence[WeightedStratum]) -> np.ndarray:
            asked.extend({row.stratum.key for row in rows} - kept.keys())
            for row in rows:
                if row.stratum.key not in kept and len(kept) >= limit:
                    raise KeyboardInterrupt
                kept.setdefault(row.stratum.key, made_up(row.stratum))
            return np.array([kept[row.stratum.key] for row in rows])

        return values

    with pytest.raises(KeyboardInterrupt):
        size(collective(), filed(65), WEAR, 100, 0.01, axes=())
    found = size(collective(), filed(10**6), WEAR, 100, 0.01, axes=())
    whole = size(collective(), values_of(), WEAR, 100, 0.01, axes=())
    assert found.words() == whole.words()
    assert np.array_equal(found.total, whole.total)
    assert len(kept) == whole.runs


def test_the_nearest_replicates_have_the_sums_of_all_and_are_the_best_of_all_ways() -> None:
    small = Collective(plan_of_text(template_text("malmbanan", "iore_wagon_loaded").replace("= 20", "= 5")))
    rows = small.strata
    values = np.array([made_up(row.stratum) for row in rows])
    weight = np.array([row.weight for row in rows])
    mean = weight @ values
    numbers, off = nearest_replicates(small, rows, values, mean)
    units = list(numbers)
    of = {(unit, r): np.zeros(2) for unit in units for r in (1, 2, 3)}
    for number in (1, 2, 3):
        for row in small.replicate(number):
            of[small.unit(row.stratum), number] += row.weight * np.array(made_up(row.stratum))
    errors = {}
    for way in product((1, 2, 3), repeat=len(units)):
        sums = sum(of[unit, number] for unit, number in zip(units, way, strict=True))
        errors[way] = float(np.sum((sums / mean - 1.0) ** 2))
    mine = errors[tuple(numbers.values())]
    assert off <= math.sqrt(mine) * (1.0 + 1e-9)
    assert mine <= np.quantile(list(errors.values()), 0.05)
    assert mine < 0.1 * np.median(list(errors.values()))


def test_values_come_from_cases_once_each() -> None:
    seen: list[WeightedCase] = []

    def of_cases(cases: Sequence[WeightedCase]) -> np.ndarray:
        seen.extend(cases)
        return np.array([[case.case.friction.tread] for case in cases])

    found = collective()
    rows = found.replicate()[:4]
    bought = Bought(through_cases(of_cases), 1)
    first = bought.values(found, rows[:3])
    again = bought.values(found, rows)
    assert np.array_equal(first, again[:3])
    assert len(seen) == 4
    assert bought.runs == len({row.stratum.key for row in rows})
    assert first[:, 0] == pytest.approx([row.stratum.friction_tread for row in rows[:3]])


def test_values_of_another_shape_are_refused() -> None:
    with pytest.raises(
        ValueError, match=r"values have shape \(\d+, 2\), 0 of them not finite: allowed \(\d+, 1\)"
    ):
        size(collective(), values_of(), WEAR[:1], budget=90)
    nothing = values_of(lambda stratum: (math.nan,))
    with pytest.raises(ValueError, match="of them not finite"):
        size(collective(), nothing, WEAR[:1], budget=90)
