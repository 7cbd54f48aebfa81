"""Sourced numbers: one schema for all data files, its faults, and the counts of what is assumed."""

from importlib.resources import files

import pytest

from hh_exudyn.case import Case, read_case
from hh_exudyn.case.numbers import assumed_summary, case_numbers
from hh_exudyn.sourced import KINDS, load_parameters, made, read_parameters
from track.line.line_file import LINES
from track.line.line_numbers import line_numbers

GOOD = {"value": 0.3, "unit": "-", "source": "assumed: dry steel"}
DATA_FILES = [
    (package, path.stem)
    for package in ("vehicles", "track", "damage", "hh_exudyn")
    for path in (files(package) / "data").iterdir()
    if path.suffix == ".toml"
    # but cases, a vehicle written by hand (tests/vehicles/whole), lines
    and path.stem not in ("demo", "locomotive", "savast", "tank_wagon", *LINES)
]


@pytest.mark.parametrize(("package", "name"), DATA_FILES)
def test_every_number_of_every_data_file_has_unit_source_and_kind(package: str, name: str) -> None:
    numbers = load_parameters(package, name).parameters
    assert numbers
    for number in numbers:
        assert number.unit, number.name
        assert number.kind in KINDS, number.name
        assert number.kind != "published" or number.source.removeprefix("published:").strip(), number.name


def test_a_line_says_unit_and_source_of_its_numbers() -> None:
    numbers = {number.name: number for number in line_numbers("malmbanan")}
    ramp = numbers["curve.<350.cant_mm.left"]
    assert (ramp.value, ramp.unit, ramp.kind) == (68.0, "mm", "published")
    assert (numbers["speed_km_h.iore_wagon_empty"].unit, numbers["gauge.mean_mm[2]"].kind) == (
        "km/h",
        "assumed",
    )
    assert numbers["rail_inclination.slope"].value == pytest.approx(1 / 30)


FAULTS = {
    "source": ({"source": "somebody said"}, "starts with 'somebody said'; allowed: published, derived"),
    "variant": ({"source": "variant: x"}, "starts with 'variant'; allowed: published, derived, assumed"),
    "text": ({"value": "0.3"}, r"a\.b = '0.3': allowed is a finite number"),
    "truth": ({"value": True}, r"a\.b = True: allowed is a finite number"),
    "infinite": ({"value": float("inf")}, r"a\.b = inf: allowed is a finite number"),
    "range": ({"range": [0.4, 0.5]}, "value 0.3 lies outside its range 0.4 to 0.5"),
    "key": ({"unconfirmed": "x"}, r"a\.b\.unconfirmed = 'x'.*an entry has confirmed, range"),
    "unit": ({"unit": 3}, r"a\.b\.unit = 3"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_one_line_with_file_and_name(name: str) -> None:
    change, message = FAULTS[name]
    with pytest.raises(ValueError, match=message) as caught:
        read_parameters({"a": {"b": GOOD | change}}, "mine", "mine.toml")
    assert str(caught.value).startswith("mine.toml: a.b")
    assert "\n" not in str(caught.value)


def test_lists_texts_and_tables_in_tables() -> None:
    tables = {"a": {"title": "x", "band": GOOD | {"value": [1, 2.5]}, "inner": {"c": GOOD}}}
    found = read_parameters(tables, "mine", "mine.toml")
    assert found.row("a.band") == (1.0, 2.5)
    assert found.nested() == {"a": {"title": "x", "band": (1.0, 2.5), "inner": {"c": 0.3}}}
    assert found.table("a").table("inner")["c"] == 0.3
    with pytest.raises(ValueError, match="mine has no table 'b'; it has: a"):
        found.table("b")


def test_a_range_holds_its_number() -> None:
    assert made("a", **GOOD, range=[0.2, 0.5]).range == (0.2, 0.5)


def test_the_numbers_behind_a_case() -> None:
    """On rigid, smooth track those of the vehicle; every name in the case adds its own."""
    text = (files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
    base = Case.from_toml(text).with_changes(track={"flexibility": "rigid", "irregularity": "none"})
    wagon = load_parameters("vehicles", "iore_wagon").parameters
    assert case_numbers(base) == wagon
    flexible = base.with_changes(track={"flexibility": "wooden_frozen"})
    names = {number.name for number in case_numbers(flexible)} - {number.name for number in wagon}
    assert {
        "concrete.young_modulus",
        "wooden.sleeper_mass",
        "wooden_frozen.factor.pad_stiffness_lateral",
    } < names
    assert "concrete.sleeper_mass" not in names  # the wooden one's own counts
    assert "wooden.factor.subgrade_stiffness_vertical" in names
    check = base.with_changes(track={"check_rail": {"flangeway_mm": 44.0, "below_radius_m": 500.0}})
    assert case_numbers(check)[len(wagon) :] == load_parameters("track", "check_rail").parameters
    rough = base.with_changes(track={"irregularity": "erri_low"})
    assert len(case_numbers(rough)) == len(wagon) + 9
    weather = base.with_changes(friction={"climate": "dry", "treatments": ["top_of_rail"]})
    assert [number.name for number in case_numbers(weather)[len(wagon) :]] == [
        "friction",
        "tread",
        "gauge_corner",
    ]
    assumed = sum(number.kind == "assumed" for number in wagon)
    assert assumed_summary(base).startswith(f"{assumed} of the {len(wagon)} numbers")


def test_the_loco_rests_on_guesses() -> None:
    case = read_case(str(files("hh_exudyn") / "data" / "locomotive.toml"))
    numbers = case_numbers(case)
    assert sum(number.kind == "assumed" for number in numbers) > len(numbers) / 2
