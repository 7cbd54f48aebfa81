"""Axle loads against the lever rule."""

from dataclasses import replace

import pytest

from hh_exudyn.conventions import GRAVITY
from vehicles.catalogue import vehicle
from vehicles.couplings import AxleBoxPad
from vehicles.description import Body, Coupler, Vehicle, Wheelset
from vehicles.statics import axle_loads


def moved(wagon: Vehicle, forward: float) -> Vehicle:
    """The vehicle with its car body's mass further forward [m]."""
    bodies = [
        replace(body, position=(body.position[0] + forward, *body.position[1:]))
        if body.kind == "car_body"
        else body
        for body in wagon.bodies
    ]
    return replace(wagon, bodies=tuple(bodies))


def two_axles() -> Vehicle:
    bodies = [Body("body", "car_body", 15e3, (1e4, 1e5, 1e5), (0.5, 0.0, 1.5))]
    pads = []
    for axle, x in (("front", 3.0), ("rear", -3.0)):
        bodies.append(Body(axle, "wheelset", 1e3, (700.0, 100.0, 700.0), (x, 0.0, 0.46)))
        for y in (1.0, -1.0):
            pads.append(AxleBoxPad(f"{axle}{y:g}", "body", axle, (x, y, 0.46), (1e6,) * 3, (1e4,) * 3, 0, 0))
    return Vehicle(
        "two", tuple(bodies), tuple(pads), (Wheelset("front", 1, 0.46), Wheelset("rear", 2, 0.46)),
        Coupler(("body",), ((5.0, 0.0, 1.0),), 1e5, 1e4), {},
    )  # fmt: skip


def test_wagons_stand_evenly():
    for name in ("iore_wagon_loaded", "iore_wagon_empty"):
        wagon = vehicle(name)
        assert axle_loads(wagon) == pytest.approx([wagon.mass * GRAVITY / 4] * 4, rel=1e-9)


def test_lever_rule_of_two_axles():
    front, rear = axle_loads(two_axles())
    assert front == pytest.approx((1e3 + 15e3 * 3.5 / 6) * GRAVITY, rel=1e-9)
    assert rear == pytest.approx((1e3 + 15e3 * 2.5 / 6) * GRAVITY, rel=1e-9)


def test_lever_rule_of_bogies():
    wagon = moved(vehicle("iore_wagon_loaded"), 0.4)
    shift = wagon.body("car_body").mass * GRAVITY * 0.4 / 6.77 / 2
    even = wagon.mass * GRAVITY / 4
    assert axle_loads(wagon) == pytest.approx([even + shift] * 2 + [even - shift] * 2, rel=1e-9)


def test_a_body_on_nothing_is_refused():
    wagon = two_axles()
    with pytest.raises(ValueError, match="two: its couplings cannot carry"):
        axle_loads(replace(wagon, couplings=()))
