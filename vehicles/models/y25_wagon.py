"""A tank wagon on Y25 bogies: rigid frames on Lenoir suspensions, spherical bowls, sprung side bearers."""

import math
from functools import partial

from hh_exudyn.sourced import ParameterSet, load_parameters
from vehicles.couplings import CentrePlate, Coupling, SideBearer
from vehicles.description import Body, Vehicle, Wheelset
from vehicles.freight_couplings import LenoirSuspension
from vehicles.models.parts import SIDES, body_of_kind, end_heads, filled, train_coupler
from vehicles.record import VehicleRecord

_DEFLECTION = 0.03  # m, between empty and laden: first guess of the equilibrium


def y25_wagon(name: str, p: ParameterSet) -> Vehicle:
    """The wagon with its ``wagon.payload``, leading bogie first.

    Raises ValueError for a payload below zero or above the largest.

    Parameters
    ----------
    name : of the vehicle
    p : its parameters
    """
    payload, most = p["wagon.payload"], p["wagon.largest_payload"]
    if not 0.0 <= payload <= most:
        raise ValueError(f"payload of {name} is {payload:.0f} kg; allowed: 0..{most:.0f} kg")
    bodies: list[Body] = []
    couplings: list[Coupling] = []
    wheelsets: list[Wheelset] = []
    half = p["wagon.bogie_distance"] / 2
    for number, middle in ((1, half), (2, -half)):
        centre = (middle, 0.0, p["bogie_frame.height"])
        frame = body_of_kind(p, "bogie_frame", f"bogie_frame_{number}", centre, _DEFLECTION)
        bodies.append(frame)
        couplings += _on_frame(p, frame.name, middle)
        for end in (1, -1):
            wheelset = _wheelset(p, 2 * number - (end > 0), middle + end * p["wheelset.wheelbase"] / 2)
            bodies.append(wheelset)
            wheelsets.append(Wheelset(wheelset.name, number, p["wheelset.radius"]))
            couplings += _suspensions(p, frame.name, wheelset, end)
    bodies.insert(0, _car_body(p, p["wagon.tare"] - sum(body.mass for body in bodies), payload))
    return Vehicle(
        name=name,
        bodies=tuple(bodies),
        couplings=tuple(couplings),
        wheelsets=tuple(wheelsets),
        coupler=train_coupler(p, end_heads(p, p["wagon.length"]), sum(body.mass for body in bodies)),
        dimensions={
            "length": p["wagon.length"],
            "height": p["wagon.height"],
            "basket_width": p["wagon.basket_width"],
            "basket_length": p["wagon.basket_length"],
            "bogie_distance": p["wagon.bogie_distance"],
            "wheelbase": p["wheelset.wheelbase"],
            "wheel_radius": p["wheelset.radius"],
            "axle_box_half_spacing": p["wheelset.axle_box_half_spacing"],
            "centre_plate_height": p["centre_plate.height"],
            "coupler_height": p["coupler.height"],
        },
    )


def _wheelset(p: ParameterSet, number: int, x: float) -> Body:
    roll, spin = p["wheelset.roll_inertia"], p["wheelset.pitch_inertia"]
    centre = (x, 0.0, p["wheelset.radius"])
    return Body(f"wheelset_{number}", "wheelset", p["wheelset.mass"], (roll, spin, roll), centre)


def _suspensions(p: ParameterSet, frame: str, wheelset: Body, end: int) -> list[Coupling]:
    """Both axle boxes of a wheelset: links and plungers stand towards the middle of the bogie."""
    x, _, z = wheelset.position
    return [
        filled(
            LenoirSuspension,
            p,
            "suspension",
            name=f"suspension_{wheelset.name[-1]}{letter}",
            body_a=frame,
            body_b=wheelset.name,
            point=(x, side * p["wheelset.axle_box_half_spacing"], z),
            direction=-end,
            link_angle=math.radians(p["suspension.link_angle"]),
        )
        for side, letter in SIDES
    ]


def _on_frame(p: ParameterSet, frame: str, middle: float) -> list[Coupling]:
    """Centre bowl and side bearers of a bogie."""
    height, number = p["centre_plate.height"], frame[-1]
    bowl = filled(
        CentrePlate,
        p,
        "centre_plate",
        name=f"centre_plate_{number}",
        body_a=frame,
        body_b="car_body",
        point=(middle, 0.0, height),
        stiffness=p["centre_plate.vertical_stiffness"],
        damping=p["centre_plate.vertical_damping"],
        spherical=p["centre_plate.spherical"] == 1.0,
    )
    bearers = [
        filled(
            SideBearer,
            p,
            "side_bearer",
            name=f"side_bearer_{number}{letter}",
            body_a=frame,
            body_b="car_body",
            point=(middle, side * p["side_bearer.lateral_position"], height),
        )
        for side, letter in SIDES
    ]
    return [bowl, *bearers]


def _car_body(p: ParameterSet, tare: float, payload: float) -> Body:
    """Empty tank and its load, each about the height of their common centre of mass."""
    mass = tare + payload
    low, high = p["car_body.tare_height"], p["car_body.load_height"]
    height = (tare * low + payload * high) / mass
    offset = tare * (low - height) ** 2 + payload * (high - height) ** 2
    roll = tare * p["car_body.tare_roll_gyration"] ** 2 + payload * p["car_body.load_roll_gyration"] ** 2
    inertia = (
        roll + offset,
        mass * p["car_body.pitch_gyration"] ** 2 + offset,
        mass * p["car_body.yaw_gyration"] ** 2,
    )
    return Body("car_body", "car_body", mass, inertia, (0.0, 0.0, height), _DEFLECTION)


def _empty() -> ParameterSet:
    return load_parameters("vehicles", "y25_wagon").replace({"wagon.payload": 0.0}, "derived: empty")


RECORDS = (
    VehicleRecord(
        "y25_wagon_loaded",
        y25_wagon,
        partial(load_parameters, "vehicles", "y25_wagon"),
        "tank wagon on Y25 bogies, 22.5 t axle load",
    ),
    VehicleRecord("y25_wagon_empty", y25_wagon, _empty, "tank wagon on Y25 bogies, empty"),
)
