"""A case's vehicle: a name, a file, or a table; the case keeps the numbers and not the file."""

from importlib.resources import files
from pathlib import Path

import pytest

from hh_exudyn.case import Case, CaseError, VehicleCase, read_case
from vehicles.variants import find_variant

DEMO = files("hh_exudyn").joinpath("data/demo.toml").read_text(encoding="utf-8")
WORN = 'base = "iore_wagon_loaded"\n\n[wedge]\nfriction = 0.35\n'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A case file with a vehicle file beside it."""
    (tmp_path / "worn.toml").write_text(WORN)
    text = DEMO.replace('vehicle = "iore_wagon_loaded"', 'vehicle = "worn.toml"')
    (tmp_path / "case.toml").write_text(text)
    return tmp_path


def friction_of_wedges(case: Case) -> set[float]:
    couplings = case.described_vehicle().couplings
    return {coupling.friction for coupling in couplings if coupling.name.startswith("wedge")}


def test_a_file_beside_the_case(folder: Path) -> None:
    case = read_case(folder / "case.toml")
    assert friction_of_wedges(case) == {0.35}
    assert isinstance(case.vehicle, VehicleCase)
    assert (case.vehicle.name, case.vehicle.base) == ("worn", "iore_wagon_loaded")
    assert case.vehicle.variant() == find_variant(folder / "worn.toml")
    assert VehicleCase.of(find_variant(folder / "worn.toml")) == case.vehicle


def test_the_stored_case_needs_no_file(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    case = read_case(folder / "case.toml")
    text = case.to_toml()
    (folder / "worn.toml").write_text(WORN.replace("0.35", "0.2"))
    assert friction_of_wedges(case) == {0.35}
    stored = Case.from_toml(text, folder=tmp_path_factory.mktemp("elsewhere"))
    assert stored == case
    assert stored.to_toml() == text
    assert hash(stored) == hash(case)
    assert friction_of_wedges(stored) == {0.35}
    assert "variant: worn.toml" in text  # which file it was
    assert friction_of_wedges(read_case(folder / "case.toml")) == {0.2}


def test_a_table_in_the_case_says_the_same(folder: Path) -> None:
    table = '[vehicle]\nname = "worn"\nbase = "iore_wagon_loaded"\nwedge.friction = 0.35\n\n[track]\n'
    text = DEMO.replace('vehicle = "iore_wagon_loaded"\n', "").replace("[track]\n", table)
    case = Case.from_toml(text)
    assert case.described_vehicle() == read_case(folder / "case.toml").described_vehicle()
    # a base that is a file starts at the case's folder
    other = Case.from_toml(text.replace('"iore_wagon_loaded"', '"worn.toml"'), folder=folder)
    assert friction_of_wedges(other) == {0.35}


def test_a_study_changes_one_number_after_the_other(folder: Path) -> None:
    demo = Case.from_toml(DEMO)
    variant = {"name": "study", "base": "iore_wagon_loaded", "wedge": {"friction": 0.2}}
    case = demo.with_changes(vehicle=variant)
    assert friction_of_wedges(case) == {0.2}
    more = case.with_changes(vehicle={"wedge": {"friction": 0.25}, "wagon": {"payload": 50e3}})
    assert friction_of_wedges(more) == {0.25}
    assert more.described_vehicle().mass == pytest.approx(71_600.0)
    assert more.with_changes(vehicle="iore_wagon_empty").vehicle == "iore_wagon_empty"
    assert friction_of_wedges(demo.with_changes(vehicle=str(folder / "worn.toml"))) == {0.35}
    assert case.mirrored().vehicle == case.vehicle


FAULTS = {
    "name": ("iore_wagon", ['vehicle = "iore_wagon"', "iore_wagon_loaded"]),
    "file": ("no/such.toml", ["no/such.toml", "No such file"]),
    "number": (3, ["vehicle = 3", "a name of the catalogue, a vehicle file, or a table"]),
    "no base": ({"wedge": {"friction": 0.3}}, ["vehicle: base is missing"]),
    "parameter": (
        {"base": "iore_wagon_loaded", "wedge": {"fricton": 0.3}},
        ["vehicle: unknown parameter wedge.fricton", "did you mean wedge.friction?"],
    ),
    "jams": ({"base": "iore_wagon_loaded", "wedge": {"friction": 0.9}}, ["vehicle", "jams"]),
}


@pytest.mark.parametrize("name", FAULTS)
def test_fault_is_one_line(name: str) -> None:
    value, parts = FAULTS[name]
    with pytest.raises(CaseError) as caught:
        Case.from_toml(DEMO).with_changes(vehicle=value)
    text = str(caught.value)
    assert "\n" not in text
    for part in parts:
        assert part in text
