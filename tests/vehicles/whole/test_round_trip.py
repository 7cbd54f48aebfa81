"""A vehicle written as a file comes back equal, with unit and source of every number."""

import tomllib
from dataclasses import dataclass, fields, replace
from typing import get_args

import pytest

from hh_exudyn.sourced import KINDS, kind_of
from vehicles.catalogue import VEHICLES, catalogued, vehicle
from vehicles.couplings import BumpStop, Bushing, Coupling, Rod
from vehicles.description import Vehicle
from vehicles.variants import find_variant
from vehicles.whole.export import document_of
from vehicles.whole.layout import hints, is_number, sections, unit_of
from vehicles.whole.reading import read_tables
from vehicles.whole.writing import to_toml

ShortTable = tuple[tuple[float, float], ...]  # (velocity [m/s], force [N])
DIMENSIONLESS = {"friction", "ratio", "axis", "conicity", "share"}  # last words of numbers without a unit


def again(text: str):
    return read_tables(tomllib.loads(text))


@pytest.mark.parametrize("name", VEHICLES)
def test_there_and_back(name):
    document = find_variant(name).document()
    text = to_toml(document)
    read = again(text)
    assert read.vehicle() == vehicle(name)
    assert read == document
    assert to_toml(read) == text


@pytest.mark.parametrize("name", VEHICLES)
def test_every_number_has_unit_and_source(name):
    numbers = again(to_toml(find_variant(name).document())).parameters().parameters
    assert {kind_of(number.source) for number in numbers} <= set(KINDS)
    for number in numbers:
        word = number.name.rsplit(".", 1)[1]
        if number.unit == "-":
            assert any(known in word.split("_") for known in DIMENSIONLESS), number.name


def test_units_stand_in_the_comments_of_all_fields():
    kinds = {kind for section in sections() for kind in section.kinds}
    assert set(get_args(Coupling)) < kinds
    for kind in kinds:
        for field in fields(kind):
            if is_number(hints(kind)[field.name]) and unit_of(kind, field.name) == "-":
                words = field.name.split("_")
                assert set(words) & DIMENSIONLESS, f"{kind.__name__}.{field.name} states no unit"


def test_sources_are_those_of_the_parameters():
    """A number that is a parameter has its source, one that is computed names what it rests on."""
    known = catalogued("iore_wagon_loaded").parameters()
    numbers = find_variant("iore_wagon_loaded").document().parameters()
    for there, here in {
        "wedge.friction": "wedge.friction",
        "wedge.slope": "wedge.slope",  # in degrees there
        "axle_box.stiffness_x": "axle_box_pad.longitudinal_stiffness",
        "wheel.radius": "wheelset.radius",
    }.items():
        assert numbers.parameter(there).source == known.parameter(here).source
    mass = numbers.parameter("car_body.mass")
    assert mass.source == "derived: from wagon.tare, wagon.payload, bogie.mass"
    place = numbers.parameter("wheelset_1.position_x")
    assert place.source == "derived: from wagon.centre_plate_distance, wheelset.wheelbase, wheelset.radius"
    assert numbers.parameter("car_body.deflection").source.startswith("assumed: fixed in the model")


def test_equal_entries_share_a_part():
    document = find_variant("iore_wagon_loaded").document()
    assert len({entry.part for entry in document.entries["couplings"]}) == 5
    assert len(to_toml(document).splitlines()) < 220


def test_shapes_of_every_kind():
    """Tables, two points, flags and fields with defaults; whatever Python built comes back."""
    wagon = vehicle("iore_wagon_loaded")
    ends = ("bolster_1", "car_body")
    more = (
        Bushing("bushing", *ends, (3.0, 0.5, 0.8), (1e6, 2e6, 3e6), (1e3,) * 3),
        Bushing("other", *ends, (3.0, 0.5, 0.8), (1e6, 2e6, 3e6), (1e3,) * 3, preload=(0.0, 0.0, 1e4)),
        Rod("rod", *ends, (3.0, 0.0, 0.8), (1.0, 0.0, 0.9), 1e6, 0.0),
        BumpStop("stop", *ends, (3.0, 0.0, 0.8), (0.0, 1.0, 0.0), ((0.02, 0.0), (0.03, 1e4)), True),
    )
    bodies = tuple(replace(body, held_weight=1.0 if i else None) for i, body in enumerate(wagon.bodies))
    wagon = replace(wagon, bodies=bodies, couplings=(*wagon.couplings, *more), shoes=(), name='a "b" \\ ä')
    document = document_of(wagon, "assumed: built in Python")
    read = again(to_toml(document, "by hand\nor not"))
    assert read == document
    assert read.vehicle() == wagon
    assert [type(c) for c in read.vehicle().couplings] == [type(c) for c in wagon.couplings]


def test_a_new_coupling_needs_no_change_of_the_grammar():
    @dataclass(frozen=True)
    class TabulatedDamper(Rod):
        """Of a test: its class is found by its fields alone."""

        series: float = 0.0  # stiffness of its mounts [N/m]
        table: tuple[tuple[float, float], ...] = ()  # (velocity [m/s], force [N])
        other: ShortTable = ()

    damper = TabulatedDamper(
        "damper",
        "a",
        "b",
        (0.0, 0.0, 1.0),
        (1.0, 0.0, 1.0),
        1.0,
        2.0,
        series=3e6,
        table=((0.0, 0.0), (0.1, 5e3)),
    )
    assert unit_of(TabulatedDamper, "series") == "N/m"
    assert unit_of(TabulatedDamper, "table") == "m/s, N"
    assert unit_of(TabulatedDamper, "other") == "m/s, N"
    assert unit_of(TabulatedDamper, "stiffness") == "N/m"
    wagon = vehicle("iore_wagon_loaded")
    object.__setattr__(wagon, "couplings", (*wagon.couplings, damper))  # unknown to `Vehicle`, as to a reader
    numbers = {number.name: number for number in document_of(wagon, "assumed").parameters().parameters}
    assert [numbers[f"tabulated_damper.table_2_{i}"].unit for i in (1, 2)] == ["m/s", "N"]
    assert numbers["tabulated_damper.series"].value == 3e6


def test_sections_are_the_fields_of_a_vehicle():
    assert {section.key for section in sections()} == {field.name for field in fields(Vehicle)} - {"name"}
