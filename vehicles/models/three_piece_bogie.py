"""The three-piece bogie: bolster, two side frames, two wheelsets and their couplings.

Members of the family differ by numbers: with ``wedge.constant_damping = 1`` the control springs stand in the
bolster (Ride Control), else on the side frames (Barber); a ``frame_brace.stiffness`` crosses two rods between
the side frames (frame-braced), a ``cross_brace.stiffness`` between the axle boxes (Scheffel's cross-anchors).
"""

import math

from hh_exudyn.sourced import ParameterSet
from vehicles.couplings import AxleBox, CentrePlate, Coupling, Rod, SideBearer, SpringNest, Vector, Wedge
from vehicles.description import Body, BrakeShoe, Wheelset
from vehicles.models.parts import SIDES, body_of_kind, filled, in_directions

SPRING_DEFLECTION = 0.03  # m, between empty and loaded: first guess of the equilibrium
PAD_DEFLECTION = 1e-3


def bogie_bodies(p: ParameterSet, number: int, middle: float) -> tuple[Body, ...]:
    """Bolster, side frames and wheelsets of bogie `number` (1 leading), its middle at x = `middle` [m]."""
    spacing = p["wheelset.axle_box_half_spacing"]
    centre = (middle, 0.0, p["bolster.height"])
    bolster = body_of_kind(p, "bolster", f"bolster_{number}", centre, SPRING_DEFLECTION)
    side_frames = tuple(
        body_of_kind(
            p,
            "side_frame",
            f"side_frame_{number}{letter}",
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
    """Name of a bogie's leading (end +1) or trailing (-1) wheelset; they count from 1 at the front.

    Parameters
    ----------
    bogie : number, 1 leading
    end : +1 leading, -1 trailing wheelset
    """
    return f"wheelset_{2 * bogie - (1 if end > 0 else 0)}"


def bogie_wheelsets(p: ParameterSet, number: int, unit: int, of_unit: int) -> tuple[Wheelset, ...]:
    """The two wheelsets of a bogie, leading first: the bogie `of_unit` of a unit, from 1.

    Parameters
    ----------
    p : parameters of the wagon
    number : of the bogie in the vehicle, 1 leading
    unit : number of the unit
    of_unit : number of the bogie in its unit
    """
    return tuple(Wheelset(wheelset_name(number, end), of_unit, p["wheelset.radius"], unit) for end in (1, -1))


def bogie_shoes(p: ParameterSet, number: int, middle: float) -> tuple[BrakeShoe, ...]:
    """The brake shoes of a bogie, one for each wheel, on the side towards the bogie's middle.

    The brake beams, on which the shoes sit, slide in the side frames and are spread against each other; so a
    side frame takes up the friction of its shoes, and their thrusts balance in it.

    Parameters
    ----------
    p : parameters of the wagon
    number : of the bogie in the vehicle, 1 leading
    middle : x of the bogie's middle on the drawing [m]
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
    """Everything between the wheelsets and the car body at bogie `number`.

    Parameters
    ----------
    p : parameters of the wagon
    number : of the bogie in the vehicle, 1 leading
    middle : x of the bogie's middle on the drawing [m]
    car_body : name of the car body
    """
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
    couplings += _braces(p, number, middle)
    couplings.append(_centre_plate(p, bolster, car_body, (middle, 0.0, p["centre_plate.height"])))
    for side, letter in SIDES:
        point = (middle, side * p["side_bearer.lateral_position"], p["centre_plate.height"])
        couplings.append(_side_bearer(p, f"side_bearer_{number}{letter}", bolster, car_body, point))
    return tuple(couplings)


def _axle_box(p: ParameterSet, side_frame: str, wheelset: str, point: Vector) -> AxleBox:
    return filled(
        AxleBox,
        p,
        "axle_box",
        name=f"axle_box_{wheelset}_{side_frame[-1]}",
        body_a=side_frame,
        body_b=wheelset,
        point=point,
        stiffness=in_directions(p, "axle_box_pad", "stiffness"),
        damping=in_directions(p, "axle_box_pad", "damping"),
        roll_stiffness=p["axle_box_pad.roll_stiffness"],
        yaw_stiffness=p["axle_box_pad.yaw_stiffness"],
    )


def _nest(p: ParameterSet, side_frame: str, bolster: str, point: Vector) -> SpringNest:
    name = f"nest_{side_frame[-2:]}"
    return filled(SpringNest, p, "spring_nest", name=name, body_a=side_frame, body_b=bolster, point=point)


def _braces(p: ParameterSet, number: int, middle: float) -> list[Rod]:
    """Crossed rods between the side frames and between the wheelsets, of those that have a stiffness."""
    frames = (f"side_frame_{number}R", f"side_frame_{number}L")
    axles = (wheelset_name(number, -1), wheelset_name(number, 1))
    frame_end = (p["frame_brace.longitudinal_position"], p["frame_brace.height"])
    axle_end = (p["wheelset.wheelbase"] / 2, p["wheelset.radius"])
    lateral = p["wheelset.axle_box_half_spacing"]
    rods = [
        Rod(
            name=f"{part}_{number}{letter}",  # by the side of its leading end
            body_a=bodies[0],
            body_b=bodies[1],
            point_a=(middle - reach, -side * lateral, height),
            point_b=(middle + reach, side * lateral, height),
            stiffness=p[f"{part}.stiffness"],
            damping=p[f"{part}.damping"],
        )
        for part, (reach, height), both in (
            ("frame_brace", frame_end, (frames, frames[::-1])),
            ("cross_brace", axle_end, (axles, axles)),
        )
        for (side, letter), bodies in zip(SIDES, both, strict=True)
    ]
    return [rod for rod in rods if rod.stiffness > 0.0]


def _wedge(p: ParameterSet, side_frame: str, bolster: str, point: Vector, end: int) -> Wedge:
    if p["wedge.constant_damping"] not in (0.0, 1.0):
        raise ValueError(
            f"wedge.constant_damping {p['wedge.constant_damping']:g} must be 1 (control springs in the "
            "bolster) or 0 (on the side frames)"
        )
    return filled(
        Wedge,
        p,
        "wedge",
        name=f"wedge_{side_frame[-2:]}_{'front' if end > 0 else 'rear'}",
        body_a=side_frame,
        body_b=bolster,
        point=point,
        direction=end,
        slope=math.radians(p["wedge.slope"]),
        toe=math.radians(p["wedge.toe"]),
        constant_damping=p["wedge.constant_damping"] == 1.0,
    )


def _centre_plate(p: ParameterSet, bolster: str, car_body: str, point: Vector) -> CentrePlate:
    return filled(
        CentrePlate,
        p,
        "centre_plate",
        name=f"centre_plate_{bolster[-1]}",
        body_a=bolster,
        body_b=car_body,
        point=point,
        stiffness=p["centre_plate.vertical_stiffness"],
        damping=p["centre_plate.vertical_damping"],
        spherical=p["centre_plate.spherical"] == 1.0,
    )


def _side_bearer(p: ParameterSet, name: str, bolster: str, car_body: str, point: Vector) -> SideBearer:
    return filled(SideBearer, p, "side_bearer", name=name, body_a=bolster, body_b=car_body, point=point)
