"""Estimated maxima of made-up findings, by hand and by scipy's regression."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import linregress
from scipy.stats import t as student

from hh_exudyn.assessment.findings import Finding
from hh_exudyn.assessment.limits import limits
from hh_exudyn.assessment.report import Assessment
from hh_exudyn.assessment.sections import AssessedSection
from hh_exudyn.assessment.statistics import largest, prediction, to_table, zone_estimates
from vehicles.catalogue import vehicle

WAGON = vehicle("iore_wagon_loaded")
LIMITS = limits(WAGON)


def section(number: int, curvature: float = 0.0, cant: float = 0.0) -> AssessedSection:
    kind = "curve, below 400 m" if curvature else "straight"
    return AssessedSection(kind, 100.0 * number, 100.0 * (number + 1), curvature, cant)


def assessment(findings: list[Finding], speed: float = 20.0) -> Assessment:
    sections = tuple(dict.fromkeys(one.section for one in findings))
    return Assessment(WAGON, sections, tuple(findings), {}, 1.0, LIMITS, True, (), "finished", (), speed)


def finding(where: AssessedSection, quantity: str, place: str, value: float) -> Finding:
    return Finding(where, quantity, place, math.nan, math.nan, value, LIMITS.get(quantity))


def test_mean_and_deviation() -> None:
    """1, 2, 3: mean 2, deviation 1; k is 3, 2.2 or 0 by what the quantity concerns."""
    for quantity, factor in (("sum_y", 3.0), ("q", 2.2), ("body_lateral", 2.2), ("y_over_q", 3.0)):
        found = [finding(section(i), quantity, "wheel 1L", float(i)) for i in (1, 2, 3)]
        (one,) = zone_estimates([assessment(found)])
        assert (one.sections, one.mean, one.deviation) == (3, pytest.approx(2.0), pytest.approx(1.0))
        assert one.value == pytest.approx(2.0 + factor)
        assert one.method == f"mean + {factor:g} s"
        assert not one.enough
    curves = [finding(section(i, 1 / 300), "q_quasi_static", "wheel 1L", float(i)) for i in (1, 2, 3)]
    (one,) = zone_estimates([assessment(curves)])
    assert one.value == pytest.approx(2.0)


def test_one_section_has_no_statistics() -> None:
    assert zone_estimates([assessment([finding(section(1), "q", "wheel 1L", 1.0)])]) == []


def test_curves_of_both_hands_are_one_zone_by_outer_and_inner_wheels() -> None:
    found = []
    for i, hand in enumerate((1.0, -1.0)):
        where = section(i, hand / 300)
        outer, inner = ("R", "L") if hand > 0 else ("L", "R")
        found += [finding(where, "y_quasi_static", f"wheel 1{outer}", 40e3 + i)]
        found += [finding(where, "y_quasi_static", f"wheel 1{inner}", 10e3 + i)]
    estimates = {one.place: one for one in zone_estimates([assessment(found)])}
    assert estimates["wheel 1 outer"].value == pytest.approx(40000.5)
    assert estimates["wheel 1 inner"].value == pytest.approx(10000.5)
    limit = estimates["wheel 1 outer"].limit
    assert limit is not None
    assert limit.value == pytest.approx(65e3)  # of the mean radius
    assert [one.place for one in largest(list(estimates.values()))] == ["wheel 1 outer"]


def test_several_runs_and_their_deficiencies() -> None:
    """Values on a line over the deficiency: the estimate is the line at the largest one."""
    runs = []
    for speed in (14.0, 16.0, 18.0, 20.0, 22.0):
        where = section(0, 1 / 300, 0.08)
        plain = assessment([finding(where, "q", "wheel 1R", 0.0)], speed)
        value = 100e3 + 200e3 * plain.deficiency(where)
        runs.append(replace(plain, findings=(finding(where, "q", "wheel 1R", value),)))
    (one,) = zone_estimates(runs)
    assert one.method == "regression"
    assert one.sections == 5
    assert one.value == pytest.approx(100e3 + 200e3 * (1.5 * 22.0**2 / (9.81 * 300) - 0.08), rel=1e-5)
    table = to_table([one]).to_pylist()[0]
    assert (table["unit"], table["method"], table["enough_sections"]) == ("N", "regression", False)


def test_prediction_is_that_of_the_textbook() -> None:
    random = np.random.default_rng(3)
    x = random.uniform(0.0, 0.1, 12)
    values = 3.0 + 20.0 * x + random.normal(0.0, 0.2, 12)
    fit = linregress(x, values)
    squares = ((x - x.mean()) ** 2).sum()
    deviation = fit.stderr * math.sqrt(squares)
    at, width = prediction(x, values, 0.1, 0.95)
    assert at == pytest.approx(fit.intercept + 0.1 * fit.slope)
    factor = student.ppf(0.975, 10)
    expected = factor * deviation * math.sqrt(1 + 1 / 12 + (0.1 - x.mean()) ** 2 / squares)
    assert width == pytest.approx(expected)
    assert prediction(x, values, 0.1, 0.0)[1] == pytest.approx(0.0)


def test_runs_of_two_vehicles_are_refused() -> None:
    one = assessment([finding(section(1), "q", "wheel 1L", 1.0)])
    other = replace(one, vehicle=vehicle("iore_wagon_empty"))
    with pytest.raises(
        ValueError, match=r"2 vehicles: .*120\.0 t; .*21\.6 t|2 vehicles: .*21\.6 t; .*120\.0 t"
    ):
        zone_estimates([one, other])
