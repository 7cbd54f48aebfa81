"""Plausible numbers of vehicles: slips of unit and sign are refused, other units are converted."""

from dataclasses import replace

import pytest

from hh_exudyn.sourced import Parameter
from vehicles.catalogue import parameters, vehicle, vehicle_names
from vehicles.quantities import quantity_of, require_plausible
from vehicles.units import allowed_units, converted
from vehicles.variants import Variant, variant_of_table


def variant(name: str, entry: object, base: str = "iore_wagon_loaded") -> Variant:
    part, quantity = name.split(".")
    return variant_of_table({"name": "mine", "base": base, part: {quantity: entry}}, "test")


@pytest.mark.parametrize("name", vehicle_names())
def test_every_number_of_the_catalogue_is_of_a_quantity_and_in_its_range(name: str) -> None:
    for parameter in parameters(name).parameters:
        assert quantity_of(parameter) is not None, parameter.name
        require_plausible(parameter)


SLIPS = {  # number: what a slip makes of it, and a part of the one line
    "tonnes": ("wagon.payload", 98.4, "wagon.payload = 98.4 kg"),
    "meganewtons": ("axle_box_pad.lateral_stiffness", 8.7563, "allowed 0, or 10000 to 1e+10 N/m"),
    "kilonewtons": ("centre_plate.stick_stiffness", 175130.0, "where the base has 1.7513e+08 N/m"),
    "kN above the range": ("centre_plate.vertical_stiffness", 875634.0, "in another unit?"),
    "wheelbase in mm": (
        "wheelset.wheelbase",
        1778.0,
        "= 1778 m is no plausible length: allowed 0.01 to 60 m",
    ),
    "radius in mm": ("wheelset.radius", 457.5, "= 457.5 m is no plausible radius"),
    "clearance in mm": (
        "axle_box.lateral_clearance",
        7.5,
        "= 7.5 m is no plausible play: allowed 0 to 0.5 m",
    ),
    "negative height": ("bolster.height", -0.67, "bolster.height = -0.67 m is no plausible height"),
    "negative mass": ("side_frame.mass", -558.0, "no plausible mass: allowed 5 to 500000 kg"),
    "plates outside": ("wagon.centre_plate_distance", 11.0, "outside the vehicle: allowed -5.145 to 5.145 m"),
    "absurd stiffness": ("axle_box.stop_stiffness", 1e15, "axle_box.stop_stiffness = 1e+15 N/m"),
    "absurd friction": ("centre_plate.friction", 20.0, "no plausible friction: allowed 0 to 1"),
    "said unit, absurd": ("wheelset.wheelbase", {"value": 1778.0, "unit": "m"}, "allowed 0.01 to 60 m"),
    "foreign unit": ("wheelset.wheelbase", {"value": 1.778, "unit": "kg"}, 'allowed "m", "mm", "cm"'),
    "wheels overlap": ("wheelset.wheelbase", 0.8, "wheels of wheelset_1 and wheelset_2 overlap: 0.8 m apart"),
}


@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_is_refused(slip: str) -> None:
    name, entry, part = SLIPS[slip]
    with pytest.raises(ValueError) as caught:
        variant(name, entry)
    assert part in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "value", "unit", "expected"),
    [
        ("axle_box_pad.longitudinal_stiffness", 13.1345, "MN/m", 13134500.0),
        ("axle_box_pad.longitudinal_stiffness", 13134.5, "kN/m", 13134500.0),
        ("axle_box_pad.longitudinal_stiffness", 13134.5, "N/mm", 13134500.0),
        ("wheelset.wheelbase", 1778, "mm", 1.778),
        ("wagon.payload", 98.4, "t", 98400.0),
        ("wedge.preload", 2.0, "kN", 2000.0),
        ("wedge.toe", 0.017453292519943295, "rad", 1.0),
        ("wedge.friction", 30, "%", 0.3),
    ],
)
def test_other_units_are_converted(name: str, value: float, unit: str, expected: float) -> None:
    entry = {"value": value, "unit": unit, "source": "assumed: test"}
    found = variant(name, entry).parameters().parameter(name)
    assert (found.value, found.unit) == (
        pytest.approx(expected, rel=1e-15),
        parameters("iore_wagon_loaded").parameter(name).unit,
    )
    assert variant_of_table(variant(name, entry).to_table(), "again") == variant(name, entry)


def test_conversion_is_exact_in_decimals() -> None:
    assert converted(13.1345, "MN/m", "N/m") == 13134500.0  # 13.1345 * 1e6 is 13134500.000000002
    assert allowed_units("Hz") == ("Hz",)
    with pytest.raises(ValueError, match='in "kHz": allowed "Hz"'):
        converted(1.0, "kHz", "Hz")


def test_what_may_be_absent_may_be_zero_and_large_changes_may_be_meant() -> None:
    assert variant("side_bearer.stiffness", 0.0).vehicle()
    assert variant("wagon.payload", 50e3, "iore_wagon_empty").vehicle().mass == pytest.approx(71_600.0)
    entry = {"value": 1e10, "unit": "N/m"}
    assert variant("axle_box_pad.lateral_stiffness", entry).vehicle()  # locked, and says so
    with pytest.raises(ValueError, match=r"wagon.payload = 98.4 kg is no plausible payload"):
        variant("wagon.payload", 98.4, "iore_wagon_empty")


def test_numbers_of_other_packages_are_theirs() -> None:
    require_plausible(Parameter("airship.lift", 1e30, "N", "assumed: test"))


def test_vehicles_built_in_python_are_checked_too() -> None:
    """1e15 N/m once took 188 s to be refused."""
    wagon = vehicle("iore_wagon_loaded")
    stiff = [replace(c, stop_stiffness=1e15) if hasattr(c, "stop_stiffness") else c for c in wagon.couplings]
    with pytest.raises(ValueError, match=r"stop_stiffness = 1e\+15 N/m or N m/rad: allowed up to 1e\+11"):
        replace(wagon, couplings=tuple(stiff))
    body = wagon.bodies[0]
    for place, part in (((0.0, 0.0, -1.0), "above the rails"), ((9.0, 0.0, 1.0), "outside the vehicle")):
        with pytest.raises(ValueError, match=f"car_body lies .*{part}"):
            replace(wagon, bodies=(replace(body, position=place), *wagon.bodies[1:]))
