"""LKAB's IORE locomotive, one unit: a body on two three-axle bogies, each wheelset with its own motor.

Traction goes from the axle boxes to the bogie frame and by a low traction rod to the body. A nose-suspended
motor rides on its axle and hangs from the bogie frame by a link, which takes the reaction of its torque.
"""

from functools import partial

from hh_exudyn.conventions import GRAVITY
from hh_exudyn.sourced import ParameterSet, load_parameters
from vehicles.couplings import AxleBoxPad, BumpStop, Bushing, Coupling, Rod
from vehicles.description import Body, Coupler, Drive, Vehicle, Wheelset
from vehicles.models.parts import SIDES, body_of_kind, in_directions
from vehicles.record import VehicleRecord
from vehicles.traction.effort import TractionEquipment

_PRIMARY_DEFLECTION = 0.04  # m, first guess of the equilibrium


def iore_locomotive(name: str, p: ParameterSet) -> Vehicle:
    """One unit, leading bogie first; motors stand on the sides of their axles that `_motor_side` gives.

    Raises ValueError for a ``motor.side`` other than 1, 0 and -1.
    """
    half = p["locomotive.bogie_distance"] / 2
    equipment = TractionEquipment(
        starting_effort=p["traction.starting_effort"],
        power=p["traction.power"],
        braking_effort=p["traction.braking_effort"],
        braking_power=p["traction.braking_power"],
        gear_ratio=p["traction.gear_ratio"],
        rotor_inertia=p["motor.rotor_inertia"],
    )
    bodies: list[Body] = []
    couplings: list[Coupling] = []
    for bogie, middle in ((1, half), (2, -half)):
        bodies.append(_bogie_frame(p, bogie, middle))
        for axle in (1, 2, 3):
            bodies += [_wheelset(p, bogie, axle, middle, equipment), _motor(p, bogie, axle, middle)]
            couplings += _wheelset_couplings(p, bogie, axle, middle)
    bodies.insert(0, _car_body(p, p["locomotive.mass"] - sum(body.mass for body in bodies)))
    for bogie, middle in ((1, half), (2, -half)):
        couplings += _body_couplings(p, bogie, middle, bodies[0].mass)
    places = [(bogie, axle) for bogie in (1, 2) for axle in (1, 2, 3)]
    end = p["locomotive.length"] / 2
    height = p["coupler.height"]
    return Vehicle(
        name=name,
        bodies=tuple(bodies),
        couplings=tuple(couplings),
        wheelsets=tuple(Wheelset(_named(place), place[0], p["wheelset.radius"]) for place in places),
        coupler=Coupler(
            bodies=("car_body", "car_body"),
            points=((end, 0.0, height), (-end, 0.0, height)),
            stiffness=p["coupler.stiffness"],
            damping=p["coupler.damping"],
        ),
        dimensions={
            "length": p["locomotive.length"],
            "height": p["locomotive.height"],
            "width": p["locomotive.width"],
            "bogie_distance": p["locomotive.bogie_distance"],
            "wheelset_spacing": p["wheelset.spacing"],
            "wheel_radius": p["wheelset.radius"],
            "axle_box_half_spacing": p["wheelset.axle_box_half_spacing"],
            "coupler_height": height,
        },
        drives=tuple(Drive(_named(place), f"motor_{place[0]}_{place[1]}") for place in places),
        traction=equipment,
    )


def _named(place: tuple[int, int]) -> str:
    return f"wheelset_{place[0]}_{place[1]}"


def _axle_place(p: ParameterSet, axle: int, middle: float) -> float:
    """Place of an axle of a bogie along the locomotive [m]."""
    return middle + (2 - axle) * p["wheelset.spacing"]


def _motor_side(p: ParameterSet, bogie: int, axle: int) -> int:
    """Side of the motor: +1 ahead of its axle, -1 behind it.

    The reaction of a motor's torque presses its axle down and its bogie's frame up, or the other way round,
    by its side. With all motors of a bogie on one side (``motor.side`` 1: that of the locomotive's middle,
    -1: that of its ends) these forces are the same on all axles and cancel in their springs; with 0 the
    motors of the outer axles lie within the wheelbase, that of the middle axle towards the locomotive's
    middle, and load and unload. Both bogies are mirror images of each other.
    """
    inwards = -1 if bogie == 1 else 1
    match p["motor.side"]:
        case 1.0 | -1.0 as side:
            return inwards * int(side)
        case 0.0:
            return {1: -1, 2: inwards, 3: 1}[axle]
        case other:
            raise ValueError(
                f"motor.side {other:g} must be 1 (motors towards the locomotive's middle), -1 (towards its "
                "ends) or 0 (those of the outer axles within the wheelbase)"
            )


def _car_body(p: ParameterSet, mass: float) -> Body:
    return Body(
        "car_body",
        "car_body",
        mass,
        (
            mass * p["body.roll_gyration"] ** 2,
            mass * p["body.pitch_gyration"] ** 2,
            mass * p["body.yaw_gyration"] ** 2,
        ),
        (0.0, 0.0, p["body.height"]),
        _PRIMARY_DEFLECTION,
    )


def _bogie_frame(p: ParameterSet, bogie: int, middle: float) -> Body:
    centre = (middle, 0.0, p["bogie_frame.height"])
    return body_of_kind(p, "bogie_frame", f"bogie_frame_{bogie}", centre, _PRIMARY_DEFLECTION)


def _wheelset(p: ParameterSet, bogie: int, axle: int, middle: float, equipment: TractionEquipment) -> Body:
    """Its spin inertia has that of the motor's rotor in it, as the gear reflects it.

    For gyroscopic moments the rotor counts with the opposite sign and 1/ratio of that: these small moments of
    a wheelset that spins and yaws are overestimated.
    """
    return Body(
        _named((bogie, axle)),
        "wheelset",
        p["wheelset.mass"],
        (
            p["wheelset.roll_inertia"],
            p["wheelset.pitch_inertia"] + equipment.reflected_inertia,
            p["wheelset.roll_inertia"],
        ),
        (_axle_place(p, axle, middle), 0.0, p["wheelset.radius"]),
    )


def _motor(p: ParameterSet, bogie: int, axle: int, middle: float) -> Body:
    x = _axle_place(p, axle, middle) + _motor_side(p, bogie, axle) * p["motor.distance"]
    centre = (x, 0.0, p["wheelset.radius"])
    return body_of_kind(p, "motor", f"motor_{bogie}_{axle}", centre, _PRIMARY_DEFLECTION / 2)


def _wheelset_couplings(p: ParameterSet, bogie: int, axle: int, middle: float) -> list[Coupling]:
    """Axle boxes on both sides, the motor's bearings on the axle, and its link."""
    wheelset, frame, motor = _named((bogie, axle)), f"bogie_frame_{bogie}", f"motor_{bogie}_{axle}"
    x, height = _axle_place(p, axle, middle), p["wheelset.radius"]
    lateral = "primary.middle_lateral_stiffness" if axle == 2 else "primary.lateral_stiffness"
    couplings: list[Coupling] = [
        AxleBoxPad(
            name=f"primary_{bogie}_{axle}{letter}",
            body_a=frame,
            body_b=wheelset,
            point=(x, side * p["wheelset.axle_box_half_spacing"], height),
            stiffness=(p["primary.longitudinal_stiffness"], p[lateral], p["primary.vertical_stiffness"]),
            damping=in_directions(p, "primary", "damping"),
            roll_stiffness=0.0,
            yaw_stiffness=0.0,
        )
        for side, letter in SIDES
    ]
    bearing, damping = p["motor.bearing_stiffness"], p["motor.bearing_damping"]
    turning = bearing * p["motor.bearing_half_spacing"] ** 2
    couplings.append(
        AxleBoxPad(
            name=f"motor_bearing_{bogie}_{axle}",
            body_a=motor,
            body_b=wheelset,
            point=(x, 0.0, height),
            stiffness=(bearing, p["motor.lateral_stiffness"], bearing),
            damping=(damping, p["motor.lateral_damping"], damping),
            roll_stiffness=turning,
            yaw_stiffness=turning,
        )
    )
    nose = x + _motor_side(p, bogie, axle) * p["motor.nose_distance"]
    couplings.append(
        Rod(
            name=f"motor_link_{bogie}_{axle}",
            body_a=frame,
            body_b=motor,
            point_a=(nose, 0.0, height + p["motor.link_length"]),
            point_b=(nose, 0.0, height),
            stiffness=p["motor.link_stiffness"],
            damping=p["motor.link_damping"],
        )
    )
    return couplings


def _spring_offset(p: ParameterSet, bogie: int, body_mass: float) -> float:
    """Place of the secondary springs ahead of the middle axle [m], where they balance the motors' noses.

    The bogie's frame carries the share distance / nose_distance of every motor at its nose; with the springs
    there, all axles stand alike.
    """
    reach = p["motor.nose_distance"]
    noses = [_axle_place(p, axle, 0.0) + _motor_side(p, bogie, axle) * reach for axle in (1, 2, 3)]
    carried = p["motor.mass"] * p["motor.distance"] / reach
    return -carried * sum(noses) / (body_mass / 2)


def _body_couplings(p: ParameterSet, bogie: int, middle: float, body_mass: float) -> list[Coupling]:
    """Springs with their dampers on both sides, the lateral stop, and the traction rod to the middle."""
    frame = f"bogie_frame_{bogie}"
    horizontal, height = p["secondary.horizontal_stiffness"], p["secondary.height"]
    roll, offset = p["secondary.roll_stiffness"], _spring_offset(p, bogie, body_mass)
    springs = [
        Bushing(
            name=f"secondary_{bogie}{letter}",
            body_a=frame,
            body_b="car_body",
            point=(middle + offset, side * p["secondary.half_spacing"], height),
            stiffness=(horizontal, horizontal, p["secondary.vertical_stiffness"]),
            damping=in_directions(p, "secondary", "damping"),
            rotational_stiffness=(roll, roll, 0.0),
            preload=(0.0, 0.0, body_mass * GRAVITY / 4),
        )
        for side, letter in SIDES
    ]
    clearance, stop = p["secondary.stop_clearance"], p["secondary.stop_stiffness"]
    lateral_stop = BumpStop(
        name=f"lateral_stop_{bogie}",
        body_a=frame,
        body_b="car_body",
        point=(middle, 0.0, height),
        axis=(0.0, 1.0, 0.0),
        table=((clearance, 0.0), (clearance + 0.05, 0.05 * stop)),
        odd=True,
    )
    inwards = -1 if bogie == 1 else 1
    rod_height = p["traction_rod.height"]
    rod = Rod(
        name=f"traction_rod_{bogie}",
        body_a=frame,
        body_b="car_body",
        point_a=(middle, 0.0, rod_height),
        point_b=(middle + inwards * p["traction_rod.length"], 0.0, rod_height),
        stiffness=p["traction_rod.stiffness"],
        damping=p["traction_rod.damping"],
    )
    return [*springs, lateral_stop, rod]


RECORD = VehicleRecord(
    "iore_locomotive",
    iore_locomotive,
    partial(load_parameters, "vehicles", "iore_locomotive"),
    "IORE Co-Co locomotive, one unit, 180 t",
)
