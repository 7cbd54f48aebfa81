"""Inputs changed by their names, and matrices of them."""

from importlib.resources import files
from pathlib import Path

import pytest

from hh_exudyn.case import Case, CaseError
from hh_exudyn.case.differences import differing_inputs
from hh_exudyn.case.matrix import matrix
from hh_exudyn.case.overrides import overridden, value_of_text
from vehicles.variants import find_variant
from vehicles.whole.writing import to_toml

DEMO = Case.from_toml(files("hh_exudyn").joinpath("data/demo.toml").read_text(encoding="utf-8"))


def friction(case: Case) -> set[float]:
    return {c.friction for c in case.described_vehicle().couplings if c.name.startswith("wedge")}


def test_keys_of_the_case_and_numbers_of_its_vehicle() -> None:
    changes = {
        "speed_km_h": 40, "track.rail": "54E1", "track.sections[2].radius_m": 600.0, "wedge.friction": 0.35,
        "axle_box_pad.longitudinal_stiffness": "20 MN/m", "contact.cells": [10, 10],
    }  # fmt: skip
    case = overridden(DEMO, changes)
    assert (case.speed_km_h, case.track.rail, case.contact.cells) == (40.0, "54E1", (10, 10))
    assert case.track.sections[2].radius_m == 600.0
    assert case.track.sections[2].cant_mm == DEMO.track.sections[2].cant_mm
    assert friction(case) == {0.35}
    pads = [c for c in case.described_vehicle().couplings if c.name.startswith("axle_box")]
    assert {pad.stiffness[0] for pad in pads} == {20e6}
    assert overridden(DEMO, {}) == DEMO


def test_a_number_goes_with_another_vehicle(tmp_path: Path) -> None:
    """Also with a whole vehicle from a file, by the parts of its file."""
    path = tmp_path / "mine.toml"
    path.write_text(to_toml(find_variant("iore_wagon_loaded").document()))
    case = overridden(DEMO, {"wedge.friction": 0.35, "vehicle": str(path), "wedge.slope": "38 deg"})
    assert friction(case) == {0.35}
    assert friction(overridden(case, {"wedge.friction": 0.2})) == {0.2}
    empty = overridden(case, {"vehicle": "iore_wagon_empty"})
    assert empty.vehicle == "iore_wagon_empty"
    assert friction(overridden(overridden(DEMO, {"wedge.friction": 0.2}), {"wedge.toe": 0.0})) == {0.2}


def test_texts_of_the_command_line() -> None:
    assert value_of_text("track.rail", "60E1") == "60E1"  # not 60 times ten
    assert value_of_text("vehicle", "'worn.toml'") == "worn.toml"
    assert value_of_text("speed_km_h", "60") == 60
    assert value_of_text("contact.cells", "[10, 12]") == [10, 12]
    assert value_of_text("track.sleeper_passing", "false") is False
    assert value_of_text("pad.stiffness", "2 MN/m") == "2 MN/m"
    assert value_of_text("track.inclination", "1:40") == "1:40"


FAULTS = {
    (
        "wedge.frction",
        0.3,
    ): "unknown key wedge.frction: neither of the case nor of vehicle "
    "iore_wagon_loaded; did you mean wedge.friction",
    ("sped_km_h", 3): "did you mean speed_km_h",
    ("wedge.friction", 5.0): "wedge.friction = 5 is no plausible friction: allowed 0 to 1",
    ("wedge.friction", "many"): "wedge.friction = 'many': allowed a number, a text as",
    ("wedge.slope", "2 kg"): "allowed",
    ("speed_km_h", "fast"): 'speed_km_h = "fast": allowed 5 to 130 km/h',
    ("track.sections[7].radius_m", 300): "there are 3 of these, counted from 0",
    ("vehicle", "lorry"): "vehicle 'lorry' is not known",
    ("vehicle", "none.toml"): "cannot be read",
}


@pytest.mark.parametrize("change", FAULTS)
def test_faults_are_one_line(change: tuple[str, object]) -> None:
    with pytest.raises(CaseError) as caught:
        overridden(DEMO, dict([change]))
    assert FAULTS[change] in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_matrix_has_every_combination() -> None:
    cases = matrix(DEMO, {"wedge.friction": [0.2, 0.35], "speed_km_h": [40, 50, 60]})
    assert list(cases)[:2] == ["wedge.friction=0.2,speed_km_h=40", "wedge.friction=0.2,speed_km_h=50"]
    assert [(friction(case), case.speed_km_h) for case in cases.values()] == [
        ({mu}, speed) for mu in (0.2, 0.35) for speed in (40, 50, 60)
    ]
    assert cases["wedge.friction=0.35,speed_km_h=60"].name == "demo, wedge.friction=0.35,speed_km_h=60"
    with pytest.raises(CaseError, match="two variants are named"):
        matrix(DEMO, {"speed_km_h": [40, 40]})
    with pytest.raises(CaseError, match="40000 variants: allowed up to 10000"):
        matrix(DEMO, {"speed_km_h": range(200), "friction": range(200)})


def test_names_fit_a_folder(tmp_path: Path) -> None:
    path = tmp_path / "my wagon.toml"
    path.write_text('base = "iore_wagon_loaded"\n')
    cases = matrix(DEMO, {"vehicle": [str(path), "iore_wagon_empty"]})
    assert list(cases) == ["vehicle=my wagon", "vehicle=iore_wagon_empty"]


def test_what_differs() -> None:
    cases = matrix(DEMO, {"wedge.friction": [0.2, 0.35], "track.sections[2].radius_m": [450.0, 600.0]})
    assert differing_inputs(list(cases.values())) == {
        "track.sections[2].radius_m": [450.0, 600.0, 450.0, 600.0],
        "wedge.friction": [0.2, 0.2, 0.35, 0.35],
    }
    assert differing_inputs([DEMO, DEMO]) == {}
    other = overridden(DEMO, {"vehicle": "manchester_vehicle_1"})
    assert differing_inputs([DEMO, other]) == {"vehicle": ["iore_wagon_loaded", "manchester_vehicle_1"]}
