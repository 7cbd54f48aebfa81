"""A case whose vehicle is a file with all its bodies and couplings."""

from importlib.resources import files
from pathlib import Path

import pytest

from hh_exudyn.case import Case, CaseError, read_case
from hh_exudyn.case.numbers import case_numbers
from hh_exudyn.case.sealed import sealed
from vehicles.catalogue import vehicle
from vehicles.variants import find_variant
from vehicles.whole.writing import to_toml

DEMO = files("hh_exudyn").joinpath("data/demo.toml").read_text(encoding="utf-8")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A case file with a vehicle file beside it."""
    (tmp_path / "mine.toml").write_text(to_toml(find_variant("iore_wagon_loaded").document()))
    (tmp_path / "case.toml").write_text(DEMO.replace('"iore_wagon_loaded"', '"mine.toml"'))
    return tmp_path


def write(folder: Path, sealed_case) -> Path:
    folder.mkdir()
    for name, content in {"case.toml": sealed_case.text.encode(), **sealed_case.files}.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(content)
    return folder / "case.toml"


def test_a_case_takes_it_and_seals_it(folder: Path) -> None:
    """The sealed case has the vehicle and its sources by content; sealing it again gives the same bytes."""
    case = read_case(folder / "case.toml")
    assert case.described_vehicle() == vehicle("iore_wagon_loaded")
    numbers = case_numbers(case)
    assert any(number.name == "wedge.friction" and number.kind == "assumed" for number in numbers)
    once = sealed(case)
    again = read_case(write(folder / "run", once))
    (folder / "mine.toml").unlink()
    assert again.described_vehicle() == vehicle("iore_wagon_loaded")
    assert sealed(again).files == once.files
    assert sealed(again).digest == once.digest
    assert case_numbers(again) == numbers


def test_a_variant_of_it(folder: Path) -> None:
    (folder / "worn.toml").write_text('base = "mine.toml"\n[wedge]\nfriction = 0.35\n')
    (folder / "case.toml").write_text(DEMO.replace('"iore_wagon_loaded"', '"worn.toml"'))
    case = read_case(folder / "case.toml")
    assert {c.friction for c in case.described_vehicle().couplings if c.name.startswith("wedge")} == {0.35}
    assert Case.from_toml(case.to_toml()) == case
    once = sealed(case)
    again = read_case(write(folder / "run", once))
    (folder / "mine.toml").unlink()
    assert sealed(again).digest == once.digest
    assert {number.source for number in case_numbers(again) if number.name == "wedge.friction"} == {
        "variant: worn.toml"
    }


FAULTS = {
    "no body named chassis": ('body_a = "bolster_1"', 'body_a = "chassis"'),
    'did you mean "friction"': ("\nfriction = ", "\nfrictions = "),
    "not valid TOML": ("[wedge]", "[wedge"),
    "jams": ("friction = { value = 0.3,", "friction = { value = 1.3,"),
}


@pytest.mark.parametrize("message", FAULTS)
def test_a_fault_names_the_file_in_one_line(folder: Path, message: str) -> None:
    old, new = FAULTS[message]
    text = (folder / "mine.toml").read_text()
    (folder / "mine.toml").write_text(text.replace(old, new))
    with pytest.raises(CaseError, match=rf"mine\.toml: .*{message}") as caught:
        read_case(folder / "case.toml")
    assert "\n" not in str(caught.value)
