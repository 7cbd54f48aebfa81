"""Gauge, quality and seasons as steps; halving keeps means and shares."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from collectives import product_text
from scipy.stats import truncnorm

from hh_exudyn.campaign.collective import HALVED, Collective, plan_of_text, template_text
from hh_exudyn.campaign.collective.axes import (
    Step,
    gauge_deviations,
    halved,
    halved_seasons,
    irregularity_scale,
    target_deviations,
)
from hh_exudyn.campaign.collective.plan import GaugeSpread, QualityRule
from track.irregularity.irregularity import random_irregularity
from track.irregularity.quality import CLASSES, quality_class, quality_limits, track_quality
from track.irregularity.wavelength_bands import D1

SPREAD = GaugeSpread(deviation=4e-3, truncation=2.0, quantiles=3)
RULE = QualityRule("erri_high", 80.0 / 3.6, 0.5, 1.2)


def moment(steps: tuple[Step, ...], power: int) -> float:
    return math.fsum(step.share * step.value**power for step in steps)


def test_gauge_steps_have_the_mean_and_approach_the_deviation_of_the_cut_normal() -> None:
    exact = 4e-3 * truncnorm(-2.0, 2.0).std()
    errors = []
    for halvings in range(5):
        steps = gauge_deviations(SPREAD, halvings)
        assert len(steps) == 3 * 2**halvings
        assert math.fsum(step.share for step in steps) == pytest.approx(1.0, abs=1e-12)
        assert moment(steps, 1) == pytest.approx(0.0, abs=1e-18)
        errors.append(exact - math.sqrt(moment(steps, 2)))
    assert all(one > 2.5 * other > 0.0 for one, other in pairwise(errors))
    assert errors[0] < 0.15 * exact  # three steps have most of the scatter


def test_one_step_or_no_scatter_is_the_mean() -> None:
    assert gauge_deviations(replace(SPREAD, quantiles=1)) == (Step(0.0, 0.0, 1.0),)
    assert gauge_deviations(replace(SPREAD, deviation=0.0)) == (Step(0.0, 0.0, 1.0),)


def test_halving_keeps_share_and_mean_and_widens_the_scatter() -> None:
    steps = (Step(1.0, 0.4, 0.25), Step(2.0, 0.0, 0.75))
    once = halved(steps, 1)
    assert once == (Step(0.8, 0.2, 0.125), Step(1.2, 0.2, 0.125), Step(2.0, 0.0, 0.75))
    assert moment(halved(steps, 3), 1) == pytest.approx(moment(steps, 1), abs=1e-15)
    # variance within the split interval tends to that of a uniform one, width^2 / 12
    added = moment(halved(steps, 8), 2) - moment(steps, 2)
    assert added == pytest.approx(0.25 * 0.8**2 / 12.0, rel=1e-3)


def test_halved_seasons_keep_the_mean_friction() -> None:
    seasons = plan_of_text(template_text()).seasons
    for times in (1, 2):
        found = halved_seasons(seasons, times)
        assert len({season.name for season in found}) == len(found) == len(seasons) * 2**times
        for zone in range(3):
            mean = [math.fsum(s.share * s.friction.coefficients[zone] for s in x) for x in (seasons, found)]
            assert mean[1] == pytest.approx(mean[0], rel=1e-12)
    assert halved_seasons(seasons, 0) == tuple(seasons)


@pytest.mark.parametrize("quality", CLASSES)
def test_the_scaled_spectrum_has_the_class(quality: str) -> None:
    """Table 1-4: the worse of level and alignment at the middle of the class, the other not worse."""
    scale = irregularity_scale(RULE, quality, 0.5, 3.0)
    track = random_irregularity("erri_high", 20_000.0, 7)  # another seed and length
    found = scale * np.array([[track.standard_deviation(name, D1) for name in ("level", "alignment")]])
    wanted = target_deviations(RULE, quality, 0.5)
    assert np.max(found / wanted) == pytest.approx(1.0, abs=0.03)
    assert CLASSES[int(quality_class(found, RULE.speed)[0])] == quality


def test_targets_lie_between_the_limits_of_the_table() -> None:
    limits = quality_limits(RULE.speed)  # 2.3, 2.6, 1.3 x 2.6 mm; 1.5, 1.8, 1.3 x 1.8 mm
    assert target_deviations(RULE, "QN2", 0.5) * 1e3 == pytest.approx([2.45, 1.65])
    assert target_deviations(RULE, "QN1", 1.0) == pytest.approx(limits[:, 0])
    assert target_deviations(RULE, "QN1", 0.0) == pytest.approx(0.5 * limits[:, 0])
    assert target_deviations(RULE, ">QN3", 1.0) == pytest.approx(1.2 * limits[:, 2])


def test_sections_of_100_m_scatter_about_their_class() -> None:
    """A class is narrow against the scatter of 100 m: most sections of QN1 are in it, some are worse."""
    track = random_irregularity("erri_high", 20_000.0, 7)
    scaled = replace(track, values=track.values * irregularity_scale(RULE, "QN1", 0.5, 3.0))
    shares = track_quality(scaled, RULE.speed).distribution()
    assert 0.75 < shares["QN1"] < 1.0


@pytest.mark.parametrize("axis", HALVED)
def test_a_refined_collective_has_more_cells_and_the_same_means(axis: str) -> None:
    coarse = Collective(plan_of_text(product_text()))
    fine = coarse.refined(axis)
    assert fine.plan.halvings == {axis: 1}
    assert fine.runs > coarse.runs
    assert fine.share() == pytest.approx(1.0, abs=1e-12)
    assert fine.share(curve_class="<350") == pytest.approx(0.045, abs=1e-12)

    def mean(found: Collective, label: str) -> float:
        return math.fsum(s.weight * getattr(s.stratum, label) for s in found.strata)

    for label in ("gauge_mm", "friction_tread", "level_deviation_mm"):
        assert mean(fine, label) == pytest.approx(mean(coarse, label), rel=1e-6)
    curvature = [math.fsum(s.weight / s.stratum.radius_m for s in x.strata) for x in (coarse, fine)]
    assert curvature[1] == pytest.approx(curvature[0], rel=1e-8)


def test_an_unknown_axis_is_refused() -> None:
    with pytest.raises(ValueError, match="axis is 'rail': allowed radius, quality, gauge, friction"):
        Collective(plan_of_text(template_text())).refined("rail")
