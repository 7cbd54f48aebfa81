"""A study of a made-up linear life, of which bands and importance are known in closed form."""

import math
import sys
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from hh_exudyn.campaign.uncertainty.assumptions import Assumption
from hh_exudyn.campaign.uncertainty.fast_life import Outcome
from hh_exudyn.campaign.uncertainty.figure import uncertainty_figure
from hh_exudyn.campaign.uncertainty.importance import importance_of, points_of
from hh_exudyn.campaign.uncertainty.study import ALL, FIRST, FLANGE, TREAD, Study, study
from hh_exudyn.campaign.uncertainty.tables import bands_table, influences_table
from hh_exudyn.sourced import made

SLOPES = {"one": 4.0, "two": -2.0, "none": 0.0}  # of ln(life), and of wear, over the whole range


def assumption(name: str, low: float = -0.5, high: float = 0.5) -> Assumption:
    source = "assumed: for a test"
    return Assumption(made(name, value=0.0, unit="-", source=source, range=(low, high)), name)


ASSUMED = tuple(assumption(name) for name in SLOPES)


def made_up_life(values: Mapping[str, float]) -> dict[str, Outcome]:
    """ln(life) and wear are linear; the second group lives twice as long and wears half as much."""
    sum_ = sum(slope * values[name] for name, slope in SLOPES.items())
    first = Outcome(1e8 * math.exp(0.1 * sum_), "hollow", 1e-12 * (10.0 + sum_), 0.0, 0.03, 0.028, 0.01)
    second = replace(first, first_turning=2.0 * first.first_turning, tread=0.5 * first.tread)
    return {"first": first, "second": second}


@pytest.fixture(scope="module")
def found() -> Study:
    pytest.importorskip("SALib")
    return study(made_up_life, ASSUMED, samples=100, seed=3)


def test_morris_of_a_linear_life_is_its_slopes(found: Study) -> None:
    own = {one.assumption.name: one.importance for one in found.influences[FIRST]}
    assert own == pytest.approx({"one": 0.4, "two": 0.2, "none": 0.0}, abs=1e-12)
    own = {one.assumption.name: one.importance for one in found.influences[TREAD]}
    assert own == pytest.approx({"one": 0.4, "two": 0.2, "none": 0.0}, abs=1e-12)
    assert [one.assumption.name for one in found.influences[TREAD]] == ["one", "two", "none"]


def test_sobol_of_a_linear_life_is_its_shares_of_the_variance() -> None:
    pytest.importorskip("SALib")
    found = study(made_up_life, ASSUMED, samples=1024, method="sobol", seed=3)
    own = {one.assumption.name: one.importance for one in found.influences[TREAD]}
    assert own["one"] == pytest.approx(16.0 / 20.0, abs=0.02)
    assert own["two"] == pytest.approx(4.0 / 20.0, abs=0.02)
    assert own["none"] == 0.0


def test_what_nothing_acts_on_has_no_importance(found: Study) -> None:
    assert all(one.importance == 0.0 and one.at_ends is None for one in found.influences[FLANGE])


def test_ends_are_those_of_one_assumption_alone(found: Study) -> None:
    one = found.influences[TREAD][0]
    assert one.at_ends == pytest.approx((7.5 * 0.8, 7.5 * 1.2))
    assert found.influences[FIRST][0].at_ends == pytest.approx((100 * math.exp(-0.2), 100 * math.exp(0.2)))


def test_bands_are_the_quantiles_of_the_sum(found: Study) -> None:
    """One large and one small uniform variable: a trapezium, of which the quantiles are known."""
    values = np.sort((4.0 * np.linspace(-0.5, 0.5, 401)[:, None] - 2.0 * np.linspace(-0.5, 0.5, 401)).ravel())
    for band in found.bands:
        if (band.group, band.quantity) == (ALL, TREAD):
            wanted = 0.75 * (10.0 + np.quantile(values, (0.05, 0.5, 0.95)))
            assert (band.low, band.median, band.high) == pytest.approx(tuple(wanted), rel=0.03)
    for band in found.bands:
        assert band.low <= band.nominal <= band.high


def test_the_first_turning_of_all_wheels_is_the_earliest(found: Study) -> None:
    of = {band.group: band for band in found.bands if band.quantity == FIRST}
    assert of[ALL].median == of["first"].median == pytest.approx(0.5 * of["second"].median)
    assert found.causes["first"] == {"hollow": 1.0}


def test_the_same_seed_gives_the_same_study(found: Study) -> None:
    again, other = (study(made_up_life, ASSUMED, samples=100, seed=seed) for seed in (3, 4))
    assert again.bands == found.bands
    assert again.influences == found.influences
    assert other.bands != found.bands


def test_the_value_is_the_median_of_its_range() -> None:
    skew = assumption("skew", low=-0.1, high=2.0)
    assert [skew.at(u) for u in (0.0, 0.25, 0.5, 0.75, 1.0)] == pytest.approx([-0.1, -0.05, 0.0, 1.0, 2.0])
    edge = assumption("edge", low=0.0, high=1.0)
    assert edge.at(0.3) == 0.0


def test_trajectories_with_an_unknown_life_are_left_out() -> None:
    pytest.importorskip("SALib")
    points = points_of("morris", 2, 100, 1)
    results = points @ np.array([1.0, 3.0])
    results[4] = math.nan
    assert importance_of("morris", points, results, 1).value == pytest.approx([1.0, 3.0])
    with pytest.raises(ValueError, match="1 of 30 lives are not known"):
        importance_of("sobol", points, results, 1)


def test_a_wheel_without_limits_has_no_importance_of_its_first_turning() -> None:
    pytest.importorskip("SALib")

    def endless(values: Mapping[str, float]) -> dict[str, Outcome]:
        return {"all": replace(made_up_life(values)["first"], first_turning=math.inf, cause="none")}

    found = study(endless, ASSUMED, samples=20)
    assert all(one.importance == 0.0 for one in found.influences[FIRST])
    assert all(math.isinf(band.low) for band in found.bands if band.quantity == FIRST)
    assert len(uncertainty_figure(found).axes) == 6


def test_tables_name_groups_sources_and_ends(found: Study) -> None:
    bands, influences = bands_table(found).to_pylist(), influences_table(found).to_pylist()
    assert {row["group"] for row in bands} == {"first", "second", ALL}
    top = influences[0]
    assert (top["name"], top["rank"], top["source"]) == ("one", 1, "assumed: for a test")
    assert top["at_low"] < top["at_high"]


def test_the_figure_shows_the_top_of_each_tornado(found: Study) -> None:
    figure = uncertainty_figure(found)
    assert [text.get_text().split("\n")[0] for text in figure.axes[3].get_yticklabels()] == ["one", "two"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"assumptions": ()}, "no assumption can be varied"),
        ({"samples": 9}, "samples = 9: allowed 10 or more"),
        ({"method": "fast"}, "method = 'fast': allowed morris, sobol"),
    ],
)
def test_what_cannot_be_studied_is_refused(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        study(made_up_life, **{"assumptions": ASSUMED, "samples": 20, **change})  # type: ignore[arg-type]


def test_without_salib_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("SALib", "SALib.analyze", "SALib.sample"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ValueError, match="needs the extra studies"):
        study(made_up_life, ASSUMED, samples=20)
