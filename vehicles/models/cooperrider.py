"""Cooperrider's bogie: two wheelsets and a frame below a car body that moves straight on."""

from functools import partial

from hh_exudyn.sourced import ParameterSet, load_parameters
from vehicles.couplings import AxleBoxPad, Bushing, Coupling
from vehicles.description import Body, Vehicle, Wheelset
from vehicles.models.parts import SIDES, in_directions, principal_inertia
from vehicles.models.suspended_wheelset import given_contact, held_body, towed
from vehicles.record import VehicleRecord


def cooperrider_bogie(name: str, p: ParameterSet) -> Vehicle:
    """The bogie of the parameter file; the car body has no weight, as in the linear model.

    The frame's weight is added to the wheelsets: a sprung load would add terms to roll and sway that the
    seven equations lack.
    """
    radius = p["wheelset.radius"]
    height = radius + p["primary.drop"]
    half = p["bogie_frame.half_wheelbase"]
    roll, spin = p["wheelset.yaw_inertia"], p["wheelset.spin_inertia"]
    wheelsets = [
        Body(name, "wheelset", p["wheelset.mass"], (roll, spin, roll), (x, 0.0, radius))
        for name, x in (("wheelset_1", half), ("wheelset_2", -half))
    ]
    frame = Body(
        "bogie_frame",
        "bogie_frame",
        p["bogie_frame.mass"],
        principal_inertia(p, "bogie_frame"),
        (0.0, 0.0, height),
        held_weight=0.0,
    )
    top = (0.0, 0.0, height + p["secondary.rise"])
    couplings: list[Coupling] = []
    for wheelset in wheelsets:
        for side, letter in SIDES:
            couplings.append(
                AxleBoxPad(
                    name=f"primary_{wheelset.name[-1]}{letter}",
                    body_a="bogie_frame",
                    body_b=wheelset.name,
                    point=(wheelset.position[0], side * p["primary.half_spacing"], radius),
                    stiffness=in_directions(p, "primary", "stiffness"),
                    damping=(0.0, 0.0, 0.0),
                    roll_stiffness=0.0,
                    yaw_stiffness=0.0,
                )
            )
    for side, letter in SIDES:
        couplings.append(
            Bushing(
                name=f"secondary_{letter}",
                body_a="bogie_frame",
                body_b="car_body",
                point=(top[0], side * p["secondary.half_spacing"], top[2]),
                stiffness=(0.0, p["secondary.lateral_stiffness"], p["secondary.vertical_stiffness"]),
                damping=(0.0, p["secondary.lateral_damping"], p["secondary.vertical_damping"]),
            )
        )
    couplings.append(
        Bushing(
            name="traction_and_yaw",
            body_a="bogie_frame",
            body_b="car_body",
            point=(0.0, 0.0, height),
            stiffness=(p["secondary.longitudinal_stiffness"], 0.0, 0.0),
            damping=(p["secondary.longitudinal_damping"], 0.0, 0.0),
            rotational_stiffness=(0.0, 0.0, p["secondary.yaw_stiffness"]),
        )
    )
    return Vehicle(
        name=name,
        bodies=(*wheelsets, frame, held_body("car_body", "car_body", top, 0.0)),
        couplings=tuple(couplings),
        wheelsets=tuple(Wheelset(body.name, 1, radius) for body in wheelsets),
        coupler=towed("car_body", top),
        dimensions={"wheel_radius": radius, "wheelbase": 2 * half},
        contact=given_contact(p),
    )


RECORD = VehicleRecord(
    "cooperrider_bogie",
    cooperrider_bogie,
    partial(load_parameters, "vehicles", "cooperrider_bogie"),
    "reference: Cooperrider's bogie, contact given",
)
