"""Cases on other gauges: what follows from the nominal gauge, and what is refused."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hh_exudyn.case import Case, CaseError
from hh_exudyn.contact.profile import gauge_point, rail_profile
from hh_exudyn.conventions import LEFT
from track.irregularity.irregularity import random_irregularity

STRAIGHT: dict[str, Any] = {"kind": "straight", "length_m": 60.0}
CURVE: dict[str, Any] = {
    "kind": "curve",
    "length_m": 50.0,
    "radius_m": 400.0,
    "hand": "left",
    "cant_mm": 80.0,
}
TRANSITION: dict[str, Any] = {"kind": "transition", "length_m": 40.0}


def case(nominal: float = 1435.0, sections: Any = (STRAIGHT,), track: Any = None, **more: Any) -> Case:
    table = {"sections": list(sections), "nominal_gauge_mm": nominal} | (track or {})
    return Case(name="gauge", speed_km_h=40.0, friction=0.3, track=table, **more)


@pytest.mark.parametrize("nominal", [1000.0, 1067.0, 1435.0, 1520.0, 1600.0, 1676.0])
def test_back_to_back_and_tape_distance_follow_the_nominal_gauge(nominal: float) -> None:
    found = case(nominal)
    assert found.back_to_back == pytest.approx(1e-3 * (nominal - 75.0), abs=1e-12)
    model = found.contact_model()
    assert 2e3 * model.running_circle_distance == pytest.approx(nominal - 75.0 + 140.0, abs=1e-9)
    alignment = found.alignment()
    assert float(alignment.table.gauge[0]) == pytest.approx(1e-3 * nominal, abs=1e-12)
    # wheel over rail as on 1435 mm: half the gauge and half the tape distance differ by as much
    offset = 0.5e-3 * nominal - model.running_circle_distance
    assert offset == pytest.approx(0.5 * 1.435 - 0.75, abs=1e-12)
    assert Case.from_toml(found.to_toml()) == found
    assert found.mirrored().mirrored() == found


def test_back_to_back_may_be_given() -> None:
    """1520 mm with the 1440 mm of GOST 4835."""
    found = case(1520.0, back_to_back_mm=1440.0)
    assert found.contact_model().running_circle_distance == pytest.approx(0.79)
    assert found.least_gauge == pytest.approx(1.440 + 0.065, abs=1e-5)
    with pytest.raises(
        CaseError, match=r"back_to_back_mm = 1360 mm: allowed 1420 to 1460 mm for track.nominal"
    ):
        case(1520.0, back_to_back_mm=1360.0)


def test_every_section_without_a_gauge_has_the_nominal_one() -> None:
    ramp = {"kind": "ramp", "length_m": 40.0, "radius_m": [400.0, 300.0], "cant_mm": [80.0, 90.0]}
    wide = CURVE | {"gauge_mm": 1075.0}
    found = case(1067.0, [STRAIGHT, TRANSITION, CURVE, ramp])
    assert set(np.round(1e3 * found.alignment().table.gauge, 6)) == {1067.0}
    widened = case(1067.0, [STRAIGHT, TRANSITION, wide])
    assert float(widened.alignment().table.gauge[-1]) == pytest.approx(1.075)
    with pytest.raises(CaseError, match=r"sections\[0\].gauge_mm = 1435 mm is too wide.* up to 1102 mm"):
        case(1067.0, [STRAIGHT | {"gauge_mm": 1435.0}])
    with pytest.raises(CaseError, match=r"nominal_gauge_mm = 1.067 mm: allowed 900 to 1700 mm"):
        case(1.067)


def test_cant_is_that_across_the_rail_tops_of_the_gauge() -> None:
    for nominal, base in ((1067.0, 1.132), (1435.0, 1.5), (1676.0, 1.741)):
        table = case(nominal, [STRAIGHT, TRANSITION, CURVE]).alignment().table
        assert float(table.cant[-1]) / 1.5 == pytest.approx(0.080 / base, rel=1e-12)
    low = case(sections=[STRAIGHT, TRANSITION, CURVE], track={"cant_about": "low_rail"}).alignment().table
    assert float(low.z[-1]) == pytest.approx(0.040, abs=1e-5)


def test_a_cant_ramp_on_straight_track_needs_the_hand_of_its_curve() -> None:
    ahead: dict[str, Any] = {"kind": "ramp", "length_m": 20.0, "radius_m": [0, 0], "cant_mm": [0, 30]}
    ramp = {"kind": "ramp", "length_m": 40.0, "radius_m": [0, -400.0], "cant_mm": [30.0, 80.0]}
    curve = CURVE | {"hand": "right"}
    found = case(sections=[STRAIGHT, ahead | {"hand": "right"}, ramp, curve])
    assert float(np.interp(80.0, found.alignment().table.s, found.alignment().table.cant)) == pytest.approx(
        -0.030, abs=1e-4
    )
    assert found.mirrored().track.sections[1].hand == "left"  # type: ignore[index, union-attr]
    with pytest.raises(CaseError, match=r"cant_mm on a straight: hand is missing"):
        case(sections=[STRAIGHT, ahead, ramp, curve])
    with pytest.raises(CaseError, match=r'hand = "left": the radii are those of the other hand'):
        case(sections=[STRAIGHT, ramp | {"hand": "left", "cant_mm": [0.0, 80.0]}, curve])


def test_the_gauge_is_measured_at_the_depth_of_the_case() -> None:
    rail = rail_profile("60E1", 1 / 30)
    for depth in (14.0, 15.875):
        course = case(track={"gauge_depth_mm": depth}).track.rail_course(LEFT)
        assert course.gauge_points()[0] == gauge_point(rail, 1e-3 * depth)
    with pytest.raises(CaseError, match=r"gauge_depth_mm = 0.014 mm: allowed 5 to 20 mm"):
        case(track={"gauge_depth_mm": 0.014})


@pytest.mark.parametrize(
    "value", [[1, 30], {"a": 1}, True, None, [["1:30"]], "1:0", "1:-30", "30", 30, 1.0, 1e308]
)
def test_inclinations_of_a_wrong_type_or_value_are_one_line(value: Any) -> None:
    with pytest.raises(CaseError, match=r'track.inclination.*allowed "1:15" to "1:100", or 0') as caught:
        case(track={"inclination": value})
    assert "\n" not in str(caught.value)


def test_samples_too_coarse_for_the_shortest_wave_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "car.csv"
    for step, shortest, fine in ((1.0, 3.0, True), (2.0, 3.0, False), (2.0, 5.0, True)):
        track = random_irregularity("erri_high", 200.0, seed=1, wavelengths=(15.0, 70.0), step=step)
        rows = zip(track.s, 1e3 * track.values, strict=True)
        path.write_text("\n".join(f"{s:.3f},{','.join(f'{v:.4f}' for v in values)}" for s, values in rows))
        keys = {"irregularity": str(path), "irregularity_shortest_m": shortest}
        if fine:
            case(track=keys)
        else:
            with pytest.raises(
                CaseError, match=r"a sample every 2 m, allowed up to 1.2 m for irregularity_shortest_m"
            ):
                case(track=keys)
