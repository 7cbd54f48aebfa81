"""Nadal, Weinstock, unloading and quasi-static forces of made-up runs, by hand."""

import math
from pathlib import Path

import numpy as np
import pytest
from made_up_run import made_up_run

from hh_exudyn.assessment.derailment import derailment_findings, derailment_histories
from hh_exudyn.assessment.findings import Finder
from hh_exudyn.assessment.limits import Limit, climbing_limits, in_a_curve, limits, nadal, static_wheel_load
from hh_exudyn.assessment.report import Assessment, standard_assessment
from hh_exudyn.log.wheel_forces import wheel_forces
from vehicles.catalogue import vehicle

WAGON = vehicle("iore_wagon_loaded")
LOAD = static_wheel_load(WAGON)
CURVE = """
name = "made up"
vehicle = "iore_wagon_loaded"
speed_km_h = 72.0
friction = 0.4
[track]
flexibility = "rigid"
[[track.sections]]
kind = "straight"
length_m = 40.0
[[track.sections]]
kind = "transition"
length_m = 60.0
[[track.sections]]
kind = "curve"
length_m = 300.0
radius_m = 300.0
hand = "left"
cant_mm = 100.0
"""


def values(found: Assessment, quantity: str) -> dict[str, float]:
    section = found.sections[-1]
    return {
        one.place: one.value for one in found.findings if one.quantity == quantity and one.section is section
    }


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> Assessment:
    """Left wheels carry 0.7 Q0 with Y/Q 0.5, right ones 1.3 Q0 with Y/Q 0.3; nothing changes."""
    run = made_up_run(
        tmp_path_factory.mktemp("made_up") / "run",
        lambda wheelset, side, t: LOAD * (0.7 if side > 0 else 1.3) + 0 * t,
        lambda wheelset, side, t: LOAD * (0.5 * 0.7 if side > 0 else 0.3 * 1.3) + 0 * t,
        case=CURVE,
    )
    return standard_assessment(run)


def test_nadal() -> None:
    """EN 14363 has 1.2 for 70 degrees; without friction it is the tangent; friction lowers it."""
    assert nadal(math.radians(70.0), 0.36) == pytest.approx(1.2, abs=2e-3)
    assert nadal(math.radians(60.0), 0.0) == pytest.approx(math.sqrt(3.0))
    assert nadal(math.radians(70.0), 0.5) == pytest.approx((2.74748 - 0.5) / (1 + 0.5 * 2.74748), rel=1e-5)
    limit = climbing_limits(math.radians(70.0), 0.36)
    assert limit["axle_sum"].value == pytest.approx(limit["y_over_q_nadal"].value + 0.36)
    for angle, friction in ((0.0, 0.3), (1.6, 0.3), (1.2, -0.1), (0.5, 0.6)):
        with pytest.raises(ValueError, match="allowed 0 to"):
            nadal(angle, friction)


def test_sum_of_both_wheels(found: Assessment) -> None:
    """The log has no friction: Nadal's limit is the tangent of S1002's 70 degrees."""
    assert values(found, "axle_sum") == {f"wheelset {n}": pytest.approx(0.8, abs=1e-6) for n in range(1, 5)}
    assert values(found, "y_over_q_nadal")["wheel 2L"] == pytest.approx(0.5, abs=1e-6)
    assert found.limits["y_over_q_nadal"].value == pytest.approx(math.tan(math.radians(70.0)), rel=0.01)
    assert found.limits["y_over_q"].value == 0.8


def test_unloading(found: Assessment) -> None:
    assert values(found, "unloading")["wheel 1L"] == pytest.approx(0.3, abs=1e-6)
    assert values(found, "unloading_quasi_static")["wheel 1R"] == pytest.approx(-0.3, abs=1e-6)
    assert found.limits["unloading"].value == 0.9
    assert found.limits["unloading_quasi_static"].value == 0.6


def test_guiding_force_of_a_tight_curve(found: Assessment) -> None:
    """R 300: 30 + 10500/300 = 65 kN; the inner Y/Q of 0.5 takes 50 kN (0.5 - 0.4) off the outer wheel."""
    outer = 0.39 * LOAD
    assert values(found, "y_quasi_static")["wheel 3R"] == pytest.approx(outer, rel=1e-6)
    reduced = values(found, "y_quasi_static_reduced")
    assert set(reduced) == {f"wheel {n}R" for n in range(1, 5)}
    assert reduced["wheel 3R"] == pytest.approx(outer - 5e3, rel=1e-6)
    held = {one.quantity: one.limit for one in found.findings if one.quantity.startswith("y_quasi")}
    assert [limit.value for limit in held.values() if limit] == pytest.approx([65e3, 65e3])
    assert found.deficiency(found.sections[-1]) == pytest.approx(1.5 * 400 / (9.81 * 300) - 0.1, rel=1e-6)


def test_limit_of_the_guiding_force_by_radius() -> None:
    plain = limits(WAGON)["y_quasi_static"]
    for radius, expected in ((450.0, 60e3), (400.0, 60e3), (350.0, 60e3), (250.0, 72e3), (150.0, 72e3)):
        assert in_a_curve(plain, radius).value == pytest.approx(expected)
    assert isinstance(in_a_curve(plain, 300.0), Limit)


def test_at_crawling_speed_the_largest_unloading_is_quasi_static(tmp_path: Path) -> None:
    """A dip of half a second counts at 10 km/h, not at 72."""

    def dip(wheelset: int, side: int, t: np.ndarray) -> np.ndarray:
        return LOAD * (1.0 - 0.5 * np.exp(-(((t - 8.0) / 0.5) ** 2)))

    run = made_up_run(tmp_path / "run", dip, lambda w, side, t: 0 * t)
    fast = standard_assessment(run)
    forces = wheel_forces(run)
    covered = float(forces.s[0].max()), float(forces.s[-1].min())
    finder = Finder(fast.sections[0], derailment_histories(forces, covered, LOAD), fast.limits)
    for speed, expected in ((20.0, 0.0), (10.0 / 3.6, 0.5)):
        found = [
            one.value
            for one in derailment_findings(finder, speed)
            if one.quantity == "unloading_quasi_static"
        ]
        assert found == pytest.approx(8 * [expected], abs=1e-3)
