"""The three-piece bogie: bolster, two side frames, two wheelsets and what couples them."""

import math

from hh_exudyn.sourced import ParameterSet
from vehicles.couplings import AxleBox, CentrePlate, Coupling, SideBearer, SpringNest, Vector, Wedge
from vehicles.description import Body, BrakeShoe, Wheelset

SIDES = ((1, "L"), (-1, "R"))
SPRING_DEFLECTION = 0.03  # m, between empty and loaded: where the equilibrium is looked for
PAD_DEFLECTION = 1e-3


def bogie_bodies(p: ParameterSet, number: int, middle: float) -> tuple[Body, ...]:
    """Bolster, side frames and wheelsets of bogie `number` (1 leading), its middle at x = `middle` [m]."""
    spacing = p["wheelset.axle_box_half_spacing"]
    bolster = Body(
        f"bolster_{number}",
        "bolster",
        p["bolster.mass"],
        (p["bolster.roll_inertia"], p["bolster.pitch_inertia"], p["bolster.yaw_inertia"]),
        (middle, 0.0, p["bolster.height"]),
        SPRING_DEFLECTION,
    )
    side_frames = tuple(
        Body(
            f"side_frame_{number}{letter}",
            "side_frame",
            p["side_frame.mass"],
            (p["side_frame.roll_inertia"], p["side_frame.pitch_inertia"], p["side_frame.yaw_inertia"]),
            (middle, side * spacing, p["side_frame.height"]),
            PAD_DEFLECTION,
        )
        for side, letter in SIDES
    )
    wheelsets = tuple(
        Body(
            wheelset_name(number, end),
            "wheelset",
            p["wheelset.mass"],
            (p["wheelset.roll_inertia"], p["wheelset.pitch_inertia"], p["wheelset.roll_inertia"]),
            (middle + end * p["wheelset.wheelbase"] / 2, 0.0, p["wheelset.radius"]),
        )
        for end in (1, -1)
    )
    return (bolster, *side_frames, *wheelsets)


def wheelset_name(bogie: int, end: int) -> str:
    """Name of a bogie's leading (end +1) or trailing (-1) wheelset; they count from 1 at the front."""
    return f"wheelset_{2 * bogie - (1 if end > 0 else 0)}"


def bogie_wheelsets(p: ParameterSet, number: int, unit: int, of_unit: int) -> tuple[Wheelset, ...]:
    """The two wheelsets of a bogie, leading first: the bogie `of_unit` of a unit, from 1."""
    return tuple(Wheelset(wheelset_name(number, end), of_unit, p["wheelset.radius"], unit) for end in (1, -1))


def bogie_shoes(p: ParameterSet, number: int, middle: float) -> tuple[BrakeShoe, ...]:
    """The brake shoes of a bogie, one for each wheel, on the side towards the bogie's middle.

    The brake beams, on which the shoes sit, slide in the side frames and are spread against each other; so a
    side frame takes up the friction of its shoes, and their thrusts balance in it.
    """
    shoes = []
    for end in (1, -1):
        x = middle + end * (p["wheelset.wheelbase"] / 2 - p["wheelset.radius"])
        for side, letter in SIDES:
            point = (x, side * p["brake_shoe.lateral_position"], p["wheelset.radius"])
            wheelset, side_frame = wheelset_name(number, end), f"side_frame_{number}{letter}"
            shoes.append(BrakeShoe(wheelset, side_frame, point, p["brake_shoe.friction"]))
    return tuple(shoes)


def bogie_couplings(p: ParameterSet, number: int, middle: float, car_body: str) -> tuple[Coupling, ...]:
    """Everything between the wheelsets and the car body at bogie `number`."""
    couplings: list[Coupling] = []
    bolster = f"bolster_{number}"
    for side, letter in SIDES:
        side_frame = f"side_frame_{number}{letter}"
        lateral = side * p["wheelset.axle_box_half_spacing"]
        for end in (1, -1):
            x = middle + end * p["wheelset.wheelbase"] / 2
            couplings.append(
                _axle_box(p, side_frame, wheelset_name(number, end), (x, lateral, p["wheelset.radius"]))
            )
        couplings.append(_nest(p, side_frame, bolster, (middle, lateral, p["spring_nest.height"])))
        for end in (1, -1):
            x = middle + end * p["wedge.longitudinal_position"]
            couplings.append(_wedge(p, side_frame, bolster, (x, lateral, p["wedge.height"]), end))
    couplings.append(_centre_plate(p, bolster, car_body, (middle, 0.0, p["centre_plate.height"])))
    for side, letter in SIDES:
        point = (middle, side * p["side_bearer.lateral_position"], p["centre_plate.height"])
        couplings.append(_side_bearer(p, f"side_bearer_{number}{letter}", bolster, car_body, point))
    return tuple(couplings)


def _axle_box(p: ParameterSet, side_frame: str, wheelset: str, point: Vector) -> AxleBox:
    return AxleBox(
        name=f"axle_box_{wheelset}_{side_frame[-1]}",
        body_a=side_frame,
        body_b=wheelset,
        point=point,
        stiffness=(
            p["axle_box_pad.longitudinal_stiffness"],
            p["axle_box_pad.lateral_stiffness"],
            p["axle_box_pad.vertical_stiffness"],
        ),
        damping=(
            p["axle_box_pad.longitudinal_damping"],
            p["axle_box_pad.lateral_damping"],
            p["axle_box_pad.vertical_damping"],
        ),
        roll_stiffness=p["axle_box_pad.roll_stiffness"],
        yaw_stiffness=p["axle_box_pad.yaw_stiffness"],
        friction=p["axle_box.friction"],
        longitudinal_clearance=p["axle_box.longitudinal_clearance"],
        lateral_clearance=p["axle_box.lateral_clearance"],
        stop_stiffness=p["axle_box.stop_stiffness"],
    )


def _nest(p: ParameterSet, side_frame: str, bolster: str, point: Vector) -> SpringNest:
    return SpringNest(
        name=f"nest_{side_frame[-2:]}",
        body_a=side_frame,
        body_b=bolster,
        point=point,
        first_stiffness=p["spring_nest.first_stiffness"],
        second_stiffness=p["spring_nest.second_stiffness"],
        second_from=p["spring_nest.second_from"],
        longitudinal_stiffness=p["spring_nest.longitudinal_stiffness"],
        lateral_stiffness=p["spring_nest.lateral_stiffness"],
        roll_stiffness=p["spring_nest.roll_stiffness"],
        pitch_stiffness=p["spring_nest.pitch_stiffness"],
        warp_stiffness=p["spring_nest.warp_stiffness"],
        shear_damping=p["spring_nest.shear_damping"],
        vertical_damping=p["spring_nest.vertical_damping"],
        roll_damping=p["spring_nest.roll_damping"],
        pitch_damping=p["spring_nest.pitch_damping"],
        warp_damping=p["spring_nest.warp_damping"],
        stop_clearance=p["spring_nest.stop_clearance"],
        stop_stiffness=p["spring_nest.stop_stiffness"],
    )


def _wedge(p: ParameterSet, side_frame: str, bolster: str, point: Vector, end: int) -> Wedge:
    return Wedge(
        name=f"wedge_{side_frame[-2:]}_{'front' if end > 0 else 'rear'}",
        body_a=side_frame,
        body_b=bolster,
        point=point,
        direction=end,
        spring_stiffness=p["wedge.spring_stiffness"],
        preload=p["wedge.preload"],
        slope=math.radians(p["wedge.slope"]),
        toe=math.radians(p["wedge.toe"]),
        width=p["wedge.width"],
        wear=p["wedge.wear"],
        friction=p["wedge.friction"],
        slope_friction=p["wedge.slope_friction"],
        slope_friction_ratio=p["wedge.slope_friction_ratio"],
        stick_stiffness=p["wedge.stick_stiffness"],
        stick_damping=p["wedge.stick_damping"],
    )


def _centre_plate(p: ParameterSet, bolster: str, car_body: str, point: Vector) -> CentrePlate:
    return CentrePlate(
        name=f"centre_plate_{bolster[-1]}",
        body_a=bolster,
        body_b=car_body,
        point=point,
        radius=p["centre_plate.radius"],
        stiffness=p["centre_plate.vertical_stiffness"],
        damping=p["centre_plate.vertical_damping"],
        friction=p["centre_plate.friction"],
        stick_stiffness=p["centre_plate.stick_stiffness"],
        stick_damping=p["centre_plate.stick_damping"],
        rim_clearance=p["centre_plate.rim_clearance"],
        rim_stiffness=p["centre_plate.rim_stiffness"],
    )


def _side_bearer(p: ParameterSet, name: str, bolster: str, car_body: str, point: Vector) -> SideBearer:
    return SideBearer(
        name=name,
        body_a=bolster,
        body_b=car_body,
        point=point,
        preload=p["side_bearer.preload"],
        stiffness=p["side_bearer.stiffness"],
        damping=p["side_bearer.damping"],
        stop_clearance=p["side_bearer.stop_clearance"],
        stop_stiffness=p["side_bearer.stop_stiffness"],
        friction=p["side_bearer.friction"],
        stick_stiffness=p["side_bearer.stick_stiffness"],
        stick_damping=p["side_bearer.stick_damping"],
    )
