"""Variants: what a vehicle file changes, chains of bases, and every way to get one wrong."""

import math
from pathlib import Path

import pytest

from hh_exudyn.sourced import ParameterSet, differences, load_parameters, read_parameters
from vehicles import catalogue
from vehicles.catalogue import VEHICLES, vehicle
from vehicles.description import Vehicle
from vehicles.record import VehicleRecord
from vehicles.variants import find_variant, read_variant, variant_of_table

WORN = """base = "iore_wagon_loaded"
description = "wedges worn"

[wedge]
friction = 0.35
preload = { value = 1500.0, unit = "N", source = "assumed: a worn wedge stands higher" }
"""


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_a_file_changes_its_numbers_and_no_others(tmp_path):
    worn = read_variant(write(tmp_path, "worn.toml", WORN))
    base = load_parameters("vehicles", "iore_wagon")
    found = {one.name: (one.before.value, one.after.value, one.after.source) for one in worn.differences()}
    assert found == {
        "wedge.friction": (0.3, 0.35, "variant: worn.toml"),
        "wedge.preload": (7861.0, 1500.0, "assumed: a worn wedge stands higher"),
    }
    for parameter in worn.parameters().parameters:
        if parameter.name not in found:
            assert parameter == base.parameter(parameter.name)
    wedges = {c.friction for c in worn.vehicle().couplings if type(c).__name__ == "Wedge"}
    assert wedges == {0.35}
    assert (worn.name, worn.vehicle().name, worn.description) == ("worn", "worn", "wedges worn")
    assert {p.name for p in worn.parameters().of_kind("variant")} == {"wedge.friction"}


def test_later_files_of_a_chain_win(tmp_path):
    write(tmp_path, "worn.toml", WORN)
    (tmp_path / "more").mkdir()
    path = write(
        tmp_path / "more", "half.toml", 'base = "../worn.toml"\nwagon.payload = 50000\nwedge.friction = 0.4\n'
    )
    half = read_variant(path)
    values = {one.name: one.after.value for one in half.differences()}
    assert values == {"wagon.payload": 50e3, "wedge.friction": 0.4, "wedge.preload": 1500.0}
    assert half.vehicle().mass == pytest.approx(21_600.0 + 50e3)
    assert half.base == "iore_wagon_loaded"


def test_a_number_set_to_what_it_was_is_no_difference(tmp_path):
    path = write(tmp_path, "same.toml", 'base = "iore_wagon_loaded"\nwedge.friction = 0.3\n')
    assert read_variant(path).differences() == ()


def test_a_variant_does_not_follow_its_file(tmp_path):
    path = write(tmp_path, "worn.toml", WORN)
    worn = read_variant(path)
    before = worn.vehicle()
    path.write_text(WORN.replace("0.35", "0.2"), encoding="utf-8")
    assert worn.vehicle() == before
    assert variant_of_table(worn.to_table(), "elsewhere") == worn


def test_loaded_and_empty_differ_by_the_payload_alone():
    found = differences(catalogue.parameters("iore_wagon_loaded"), catalogue.parameters("iore_wagon_empty"))
    assert [(one.name, one.after.value) for one in found] == [("wagon.payload", 0.0)]
    assert find_variant("iore_wagon_empty").vehicle() == vehicle("iore_wagon_empty")


def test_differences_name_what_only_one_has():
    one = ParameterSet("one", load_parameters("vehicles", "iore_wagon").parameters[:2])
    other = ParameterSet("other", load_parameters("vehicles", "iore_wagon").parameters[1:3])
    missing, extra = differences(one, other)
    assert (missing.name, missing.after) == ("wagon.length", None)
    assert (extra.name, extra.before) == ("wagon.height", None)


FAULTS = {  # contents of the file: what the one line says
    'base = "iore_wagon_lodaed"': ["iore_wagon_lodaed", 'did you mean "iore_wagon_loaded"?'],
    "wedge.friction = 0.3": ["base is missing"],
    'base = "iore_wagon_loaded"\nwedge.fricton = 0.3': ["wedge.fricton", "did you mean wedge.friction?"],
    'base = "iore_wagon_loaded"\nwedge.colour = 1': ["unknown parameter wedge.colour", "wedge.slope"],
    'base = "iore_wagon_loaded"\nzzz.qqq = 0.3': ["zzz.qqq", "its parts are wagon, wheelset"],
    'base = "iore_wagon_loaded"\nwedge = 0.3': ["wedge = 0.3", "unknown key"],
    'base = "iore_wagon_loaded"\nwedge.slope = { value = 0.6, unit = "m" }': ['in "m": allowed "deg", "rad"'],
    'base = "iore_wagon_loaded"\nwedge.slope = { unit = "deg" }': ["wedge.slope", "value, unit and source"],
    'base = "iore_wagon_loaded"\nwedge.slope = { value = 36, note = "" }': ["value, unit and source"],
    'base = "iore_wagon_loaded"\nwedge.slope = { value = 36, source = "told" }': ["'told'", "published"],
    'base = "iore_wagon_loaded"\nwedge.friction = "a third"': [
        "wedge.friction = 'a third'",
        'a text as "1.5 kN"',
    ],
    'base = "iore_wagon_loaded"\nwedge.friction = true': ["wedge.friction = True", "finite number"],
    'base = "iore_wagon_loaded"\nwedge.friction = nan': ["wedge.friction = nan", "finite number"],
    'base = "iore_wagon_loaded"\nwedge.friction = 0.9': ["wedge_1L_front jams", "0.9"],
    'base = "iore_wagon_loaded"\nwedge.friction = -0.1': [
        "wedge.friction = -0.1 is no plausible friction: allowed 0 to 1"
    ],
    'base = "iore_wagon_loaded"\naxle_box_pad.lateral_stiffness = -1.0': [
        "axle_box_pad.lateral_stiffness = -1 N/m",
        "10000 to 1e+10 N/m",
    ],
    'base = "iore_wagon_loaded"\nside_frame.mass = 0': [
        "side_frame.mass = 0 kg is no plausible mass: allowed 5 to 500000 kg"
    ],
    'base = "iore_wagon_loaded"\nwagon.payload = 1.5e5': ["payload of bad is 150000 kg", "0..102000 kg"],
    'base = "no.toml"': ["no.toml: cannot be read"],
    'base = "bad.toml"': ["its base leads back to itself: bad.toml -> bad.toml"],
    'base = "other.toml"': ["bad.toml -> other.toml -> bad.toml"],
    "base = 3": ["base = 3: allowed a text"],
    "base = ": ["not valid TOML"],
}


@pytest.mark.parametrize("text", FAULTS)
def test_a_bad_file_is_one_line_that_begins_with_it(tmp_path, text):
    write(tmp_path, "other.toml", 'base = "bad.toml"')
    path = write(tmp_path, "bad.toml", text)
    with pytest.raises(ValueError, match=r"^\S*bad\.toml: ") as caught:
        read_variant(path)
    message = str(caught.value)
    assert "\n" not in message
    for part in FAULTS[text]:
        assert part in message


def test_replace_checks_its_source_and_numbers():
    base = load_parameters("vehicles", "iore_wagon")
    changed = base.replace({"wedge.friction": 0.2}, "published: a paper", "mine")
    assert (changed.name, changed["wedge.friction"], base["wedge.friction"]) == ("mine", 0.2, 0.3)
    assert changed.parameter("wedge.friction").unit == "-"
    with pytest.raises(ValueError, match="starts with 'somebody said so'"):
        base.replace({"wedge.friction": 0.2}, "somebody said so")
    with pytest.raises(ValueError, match=r"wedge\.friction = inf"):
        base.replace({"wedge.friction": math.inf}, "assumed")


class Watched(ParameterSet):
    """Remembers what was asked for."""

    asked: set[str]

    def parameter(self, name: str):
        self.asked.add(name)
        return super().parameter(name)


@pytest.mark.parametrize("name", VEHICLES)
def test_every_number_counts(name):
    """A number that the builder does not read could be changed without any effect."""
    parameters = catalogue.parameters(name)
    watched = Watched(parameters.name, parameters.parameters)
    watched.asked = set()
    VEHICLES[name].build(name, watched)
    assert {p.name for p in parameters.parameters} - watched.asked == set()


def test_a_vehicle_of_ones_own_joins_the_catalogue(monkeypatch):
    tables = {"body": {"mass": {"value": 1000.0, "unit": "kg", "source": "assumed"}}}

    def build(name: str, p: ParameterSet) -> Vehicle:
        wagon = vehicle("iore_wagon_empty")
        body = wagon.bodies[0]
        return Vehicle(
            name, (type(body)(body.name, body.kind, p["body.mass"], body.inertia, body.position),
                   *wagon.bodies[1:]), wagon.couplings, wagon.wheelsets, wagon.coupler, {},
        )  # fmt: skip

    mine = read_parameters(tables, "mine", "mine.toml")
    monkeypatch.setitem(VEHICLES, "mine", VehicleRecord("mine", build, lambda: mine, "one body changed"))
    assert find_variant("mine").vehicle().bodies[0].mass == 1000.0
    heavier = variant_of_table({"name": "heavier", "base": "mine", "body": {"mass": 2e3}}, "test")
    assert heavier.vehicle().bodies[0].mass == 2000.0


def test_own_tables_are_checked_as_those_of_the_toolkit():
    for entry, part in (({"value": 1.0, "unit": "kg"}, "lacks source"), (3.0, "lacks source, unit, value")):
        with pytest.raises(ValueError, match=rf"mine\.toml: body\.mass {part}"):
            read_parameters({"body": {"mass": entry}}, "mine", "mine.toml")
    with pytest.raises(ValueError, match=r"mine\.toml: body is not a table"):
        read_parameters({"body": 3.0}, "mine", "mine.toml")


def test_a_text_with_its_unit_is_a_number(tmp_path):
    """As in files of whole vehicles: "20 MN/m" is { value = 20, unit = "MN/m" }."""
    path = tmp_path / "stiff.toml"
    path.write_text('base = "iore_wagon_loaded"\naxle_box_pad.longitudinal_stiffness = "20 MN/m"')
    assert read_variant(path).parameters()["axle_box_pad.longitudinal_stiffness"] == 20e6
    path.write_text('base = "iore_wagon_loaded"\naxle_box_pad.longitudinal_stiffness = "20 MN"')
    with pytest.raises(ValueError, match=r'axle_box_pad\.longitudinal_stiffness is in "MN": allowed "N/m"'):
        read_variant(path)


def test_half_a_name_brings_all_that_end_so(tmp_path):
    path = tmp_path / "stiff.toml"
    path.write_text('base = "iore_wagon_loaded"\naxle_box_pad.stiffness = 2e7')
    with pytest.raises(
        ValueError, match=r"did you mean one of axle_box_pad\.longitudinal_stiffness, axle_box_"
    ):
        read_variant(path)


def test_kilonewtons_without_their_unit_are_told_how_to_say_it(tmp_path):
    path = tmp_path / "stiff.toml"
    path.write_text('base = "iore_wagon_loaded"\naxle_box_pad.longitudinal_stiffness = 20')
    with pytest.raises(ValueError, match=r'no plausible stiffness: .*; with a unit: "20 kN/m" or MN/m'):
        read_variant(path)
