"""The assessment of made-up runs with known values, and of a short real one."""

import math
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from made_up_run import made_up_run

from hh_exudyn.assessment.limits import limits
from hh_exudyn.assessment.report import Assessment, Finding, standard_assessment
from hh_exudyn.case import Case
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.log.store import Run
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle

F0 = 3.0  # Hz


def values(found: Assessment, quantity: str) -> dict[str, Finding]:
    """The findings of the one section by place."""
    return {finding.place: finding for finding in found.findings if finding.quantity == quantity}


def waves(directory: Path, interval: float) -> Run:
    """Y of left wheels sways about 10 kN by 4 kN at 3 Hz, Q by 20 kN at 1 Hz; 30 Hz of 50 kN is on all."""

    def fast(time: np.ndarray) -> np.ndarray:
        return 50e3 * np.sin(2 * math.pi * 30.0 * time)

    return made_up_run(
        directory,
        lambda wheelset, side, t: 1e3 * (100 + wheelset) + 20e3 * np.sin(2 * math.pi * t) + fast(t),
        lambda wheelset, side, t: (
            (1e3 * (10 + 4 * np.sin(2 * math.pi * F0 * t)) if side > 0 else 0 * t) + fast(t)
        ),
        lateral_velocity=lambda t: -0.5 / (2 * math.pi * 2.0) * np.cos(2 * math.pi * 2.0 * t),
        yaw_rate=lambda t: 0.002 * np.ones_like(t),
        interval=interval,
    )


@pytest.fixture(scope="module")
def known(tmp_path_factory: pytest.TempPathFactory) -> Assessment:
    return standard_assessment(waves(tmp_path_factory.mktemp("made_up") / "run", 0.004))


def test_the_one_straight_is_assessed(known: Assessment) -> None:
    (section,) = known.sections
    assert (section.kind, section.length) == ("straight", 250.0)
    assert not values(known, "q_quasi_static")  # in curves only


def test_sum_y_is_a_sliding_mean_below_20_hz(known: Assessment) -> None:
    """What is equal on both wheels is no force on the track; 20 m/s and 3 Hz leave sinc of 0.3."""
    left = 4e3 * math.sin(math.pi * 0.3) / (math.pi * 0.3)
    for finding in values(known, "sum_y").values():
        assert finding.high == pytest.approx(10e3 + left, rel=2e-3)
        assert finding.low == pytest.approx(10e3 - left, rel=2e-3)
        assert finding.value == finding.high
    assert len(values(known, "sum_y")) == 4


def test_q_and_ratio(known: Assessment) -> None:
    """At 250 Hz the filter leaves 6.6 % of 30 Hz, 1.6 % of what the sliding mean leaves is not seen."""
    ratio = math.tan(math.pi * 30 * 0.004) / math.tan(math.pi * 20 * 0.004)
    fast = 50e3 / (1.0 + (math.sqrt(2.0) - 1.0) * ratio**8)
    for number in (1, 4):
        found = values(known, "q")[f"wheel {number}R"].value
        assert 1e3 * (100 + number) + 20e3 < found < 1e3 * (100 + number) + 20e3 + fast
        assert math.isnan(values(known, "q")[f"wheel {number}R"].low)
    right, left = (values(known, "y_over_q")[f"wheel 1{side}"] for side in "RL")
    assert abs(right.value) < 0.003
    assert 10 / 101 < left.value < 14 / 81
    assert left.value == left.high


def test_accelerations_at_their_places(known: Assessment) -> None:
    """0.5 m/s^2 at 2 Hz; yaw alone turns the accelerometer away from what is constant."""
    for name, expected in (("body_lateral", 0.5), ("body_vertical", 0.0)):
        found = values(known, name)
        assert list(found) == ["car_body over bogie 1", "car_body over bogie 2"]
        for finding in found.values():
            assert finding.value == pytest.approx(expected, abs=2e-3)
    for finding in values(known, "body_lateral_rms").values():
        assert finding.value == pytest.approx(0.5 / math.sqrt(2.0), abs=2e-3)


def test_instability_about_the_peak(known: Assessment) -> None:
    assert known.instability_frequency == pytest.approx(F0)
    for finding in values(known, "sum_y_rms").values():
        assert finding.value == pytest.approx(4e3 / math.sqrt(2.0), rel=0.01)
    frames = values(known, "bogie_lateral_rms")
    assert len(frames) == 8
    assert "side_frame_1L over wheelset_1" in frames
    for finding in frames.values():
        assert finding.value == pytest.approx(0.5 / math.sqrt(2.0), rel=0.02)


def test_the_output_interval_does_not_matter(known: Assessment, tmp_path: Path) -> None:
    finer = standard_assessment(waves(tmp_path / "run", 0.002))
    for one, other in zip(known.findings, finer.findings, strict=True):
        assert (one.quantity, one.place) == (other.quantity, other.place)
        # what is left of 30 Hz differs: 2 % of Q and of Y/Q, a sum has that of both wheels, an unloading is a
        # small difference of Q
        shares = {"q": 0.02, "y_over_q": 0.02, "y_over_q_nadal": 0.02, "axle_sum": 0.04}
        least = 0.01 if one.quantity.startswith("unloading") else 2e-3
        assert other.value == pytest.approx(one.value, rel=shares.get(one.quantity, 0.005), abs=least)


def test_limits_and_table(known: Assessment) -> None:
    """P0 = 294.3 kN: 0.85 (10 + 98.1) kN; Q0 + 90 is above the cap; the table says what is unconfirmed."""
    held = limits(vehicle("iore_wagon_loaded"))
    assert held["sum_y"].value == pytest.approx(0.85e3 * (10 + 120 * GRAVITY / 4 / 3), rel=1e-6)
    assert held["q"].value == 200e3
    assert limits(vehicle("iore_wagon_empty"))["q"].value == pytest.approx(1e3 * (90 + 21.6 * GRAVITY / 8))
    assert known.beyond
    rows = known.to_table().to_pylist()
    assert len(rows) == len(known.findings)
    by_quantity = {row["quantity"]: row for row in rows}
    assert by_quantity["y_over_q"]["limit_confirmed"] is True
    assert by_quantity["sum_y"]["limit_confirmed"] is False
    assert "from memory" in by_quantity["sum_y"]["limit_source"]
    assert by_quantity["bogie_lateral_rms"]["limit"] is None
    assert by_quantity["sum_y"]["share"] == pytest.approx(by_quantity["sum_y"]["value"] / held["sum_y"].value)
    worst = {finding.quantity: finding.value for finding in known.worst()}
    assert worst["q"] == max(row["value"] for row in rows if row["quantity"] == "q")


def quiet(directory: Path, **changes: float) -> Run:
    return made_up_run(directory, lambda w, side, t: 1e5 + 0 * t, lambda w, side, t: 0 * t, **changes)


def test_what_cannot_be_assessed_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"output interval is 20 ms, allowed are up to 10 ms"):
        standard_assessment(quiet(tmp_path / "coarse", interval=0.02))
    run = quiet(tmp_path / "short", end=170.0)
    with pytest.raises(ValueError, match=r"straight from 4\.\d to 165\.\d m, 161\.\d of 250 m"):
        standard_assessment(run)
    assert len(standard_assessment(run, section_length=40.0).sections) == 4
    with pytest.raises(ValueError, match="vehicle 2 is not in the contact log"):
        standard_assessment(run, vehicle=2)


def test_a_short_run_in_a_curve(tmp_path: Path) -> None:
    """Forces balance the weight and the cant deficiency; the body feels that, and its own roll."""
    demo = Case.from_toml(files("hh_exudyn").joinpath("data/demo.toml").read_text(encoding="utf-8"))
    radius, cant = 450.0, 0.020
    sections = [
        {"kind": "straight", "length_m": 20.0, "gauge_mm": 1445.0},
        {"kind": "transition", "length_m": 30.0},
        {"kind": "curve", "length_m": 95.0, "radius_m": radius, "hand": "left", "cant_mm": 1e3 * cant,
         "gauge_mm": 1445.0},
    ]  # fmt: skip
    case = demo.with_changes(
        speed_km_h=50.0, track={"sections": sections, "flexibility": "rigid"}, contact={"theory": "polach"}
    )
    found = standard_assessment(simulate(case, tmp_path / "run"), section_length=30.0)
    last = found.sections[-1]
    mine = [finding for finding in found.findings if finding.section is last]
    wagon = vehicle(case.vehicle)
    total = sum(finding.value for finding in mine if finding.quantity == "q_quasi_static")
    assert total == pytest.approx(wagon.mass * GRAVITY, rel=0.01)
    deficiency = case.speed**2 / radius - GRAVITY * cant / 1.5
    felt = [finding.value for finding in mine if finding.quantity == "body_lateral_quasi_static"]
    assert len(felt) == 2
    assert all(deficiency < value < 1.4 * deficiency for value in felt)
    for finding in mine:
        if finding.quantity == "sum_y":
            assert finding.low < 0.0 or finding.high < wagon.mass * deficiency  # outwards is to the right
    assert {finding.quantity for finding in mine} >= {"y_quasi_static", "sum_y_rms", "bogie_lateral_rms"}
