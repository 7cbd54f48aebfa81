"""The LKAB iron-ore wagon, one unit of a Fanoo pair: a hopper body on two three-piece bogies."""

import math

from vehicles.couplings import Coupling
from vehicles.description import Body, Coupler, Vehicle, Wheelset
from vehicles.parameters import ParameterSet
from vehicles.three_piece_bogie import SPRING_DEFLECTION, bogie_bodies, bogie_couplings, bogie_wheelsets


def ore_wagon(name: str, p: ParameterSet, payload: float) -> Vehicle:
    """The wagon with a payload of ore [kg] (0 for the empty wagon), leading bogie first.

    Raises ValueError for a payload below zero or above the wagon's 102 t (thesis Table 1-1).
    """
    most = p["wagon.largest_payload"]
    if not 0.0 <= payload <= most:
        raise ValueError(f"payload of {name} is {payload:.0f} kg; allowed: 0..{most:.0f} kg")
    half = p["wagon.centre_plate_distance"] / 2
    body = _car_body(p, payload)
    bodies = [body]
    couplings: list[Coupling] = []
    wheelsets: list[Wheelset] = []
    for number, middle in ((1, half), (2, -half)):
        bodies += bogie_bodies(p, number, middle)
        couplings += bogie_couplings(p, number, middle, body.name)
        wheelsets += bogie_wheelsets(p, number)
    return Vehicle(
        name=name,
        bodies=tuple(bodies),
        couplings=tuple(couplings),
        wheelsets=tuple(wheelsets),
        coupler=_coupler(p, body.name, sum(body.mass for body in bodies)),
        dimensions={
            "length": p["wagon.length"],
            "height": p["wagon.height"],
            "basket_width": p["wagon.basket_width"],
            "basket_length": p["wagon.basket_length"],
            "centre_plate_distance": p["wagon.centre_plate_distance"],
            "centre_plate_height": p["centre_plate.height"],
            "wheelbase": p["wheelset.wheelbase"],
            "wheel_radius": p["wheelset.radius"],
            "axle_box_half_spacing": p["wheelset.axle_box_half_spacing"],
            "coupler_height": p["coupler.height"],
            "ore_depth": p["car_body.ore_depth"] if payload else 0.0,
        },
    )


def _car_body(p: ParameterSet, payload: float) -> Body:
    """Tare body and a block of ore as one rigid body (parallel-axis sum)."""
    tare = p["wagon.tare"] - 2 * p["bogie.mass"]
    mass = tare + payload
    height = (tare * p["car_body.tare_height"] + payload * p["car_body.ore_height"]) / mass
    tare_offset = tare * (p["car_body.tare_height"] - height) ** 2
    ore_offset = payload * (p["car_body.ore_height"] - height) ** 2
    length, width, depth = (p[f"car_body.ore_{axis}"] for axis in ("length", "width", "depth"))
    offset = tare_offset + ore_offset
    return Body(
        "car_body",
        "car_body",
        mass,
        (
            tare * p["car_body.tare_roll_gyration"] ** 2 + payload * (width**2 + depth**2) / 12 + offset,
            tare * p["car_body.tare_pitch_gyration"] ** 2 + payload * (length**2 + depth**2) / 12 + offset,
            tare * p["car_body.tare_yaw_gyration"] ** 2 + payload * (length**2 + width**2) / 12,
        ),
        (0.0, 0.0, height),
        SPRING_DEFLECTION,
    )


def _coupler(p: ParameterSet, body: str, mass: float) -> Coupler:
    """Both coupler heads, tuned so that the wagon follows the train at the given frequency and damping."""
    pulsation = 2 * math.pi * p["coupler.train_frequency"]
    end = p["wagon.length"] / 2
    return Coupler(
        bodies=(body, body),
        points=((end, 0.0, p["coupler.height"]), (-end, 0.0, p["coupler.height"])),
        stiffness=mass * pulsation**2,
        damping=2 * p["coupler.train_damping_ratio"] * mass * pulsation,
    )
