"""LKAB's IORE locomotive: a body on two three-axle bogies, each wheelset with its own motor; or two of them.

Traction goes from the axle boxes to the bogie frame and by a low traction rod to the body. A nose-suspended
motor rides on its axle and hangs from the bogie frame by a link, which takes the reaction of its torque.
"""

from dataclasses import dataclass
from functools import partial

from hh_exudyn.conventions import GRAVITY
from hh_exudyn.sourced import ParameterSet, load_parameters
from vehicles.couplings import AxleBoxPad, BumpStop, Bushing, Coupling, Rod
from vehicles.description import Body, Coupler, Drive, Vehicle, Wheelset
from vehicles.models.parts import SIDES, body_of_kind, in_directions
from vehicles.record import VehicleRecord
from vehicles.traction.effort import TractionEquipment

_PRIMARY_DEFLECTION = 0.04  # m, first guess of the equilibrium


@dataclass(frozen=True)
class _Bogie:
    """Place of a bogie in the vehicle."""

    number: int  # from 1 at the leading end, through all units
    of_unit: int  # 1 or 2
    middle: float  # along the vehicle [m]
    car_body: str

    @property
    def inwards(self) -> int:
        """Direction along x to the middle of its unit: +1 forward."""
        return -1 if self.of_unit == 1 else 1

    def wheelset(self, axle: int) -> str:
        """Name of its wheelset of that number."""
        return f"wheelset_{self.number}_{axle}"


@dataclass(frozen=True)
class _Unit:
    """A car body with its two bogies."""

    bodies: tuple[Body, ...]  # the car body first
    couplings: tuple[Coupling, ...]
    wheelsets: tuple[Wheelset, ...]
    drives: tuple[Drive, ...]


def iore_locomotive(name: str, p: ParameterSet) -> Vehicle:
    """One unit, leading bogie first; motors stand on the sides of their axles that `_motor_side` gives.

    Raises ValueError for a ``motor.side`` other than 1, 0 and -1.
    """
    return _vehicle(name, p, (_unit(p, "car_body", 1, 0.0),), ())


def iore_locomotive_pair(name: str, p: ParameterSet) -> Vehicle:
    """Two units, mirror images of each other, with the coupler between them.

    Bogies and wheelsets of a unit count from its leading end, in `Wheelset` and in the logs; the bodies are
    numbered through, ``bogie_frame_1`` to ``bogie_frame_4``.

    Raises ValueError as `iore_locomotive`.
    """
    half = p["locomotive.length"] / 2
    units = tuple(_unit(p, f"car_body_{number}", number, x) for number, x in ((1, half), (2, -half)))
    end, height = p["unit_coupler.length"] / 2, p["coupler.height"]
    between = Rod(
        name="unit_coupler",
        body_a=units[1].bodies[0].name,
        body_b=units[0].bodies[0].name,
        point_a=(-end, 0.0, height),
        point_b=(end, 0.0, height),
        stiffness=p["unit_coupler.stiffness"],
        damping=p["unit_coupler.damping"],
    )
    return _vehicle(name, p, units, (between,))


def _unit(p: ParameterSet, car_body: str, number: int, middle: float) -> _Unit:
    """Unit `number` from 1, its middle at x = `middle` [m] of the drawing."""
    half = p["locomotive.bogie_distance"] / 2
    bogies = [
        _Bogie(2 * (number - 1) + of_unit, of_unit, x, car_body)
        for of_unit, x in ((1, middle + half), (2, middle - half))
    ]
    places = [(bogie, axle) for bogie in bogies for axle in (1, 2, 3)]
    bodies: list[Body] = []
    couplings: list[Coupling] = []
    for bogie in bogies:
        bodies.append(_bogie_frame(p, bogie))
        for axle in (1, 2, 3):
            bodies += [_wheelset(p, bogie, axle), _motor(p, bogie, axle)]
            couplings += _wheelset_couplings(p, bogie, axle)
    bodies.insert(0, _car_body(p, car_body, middle, p["locomotive.mass"] - sum(body.mass for body in bodies)))
    for bogie in bogies:
        couplings += _body_couplings(p, bogie, bodies[0].mass)
    return _Unit(
        tuple(bodies),
        tuple(couplings),
        tuple(
            Wheelset(bogie.wheelset(axle), bogie.of_unit, p["wheelset.radius"], number)
            for bogie, axle in places
        ),
        tuple(Drive(bogie.wheelset(axle), _motor_name(bogie, axle)) for bogie, axle in places),
    )


def _vehicle(name: str, p: ParameterSet, units: tuple[_Unit, ...], between: tuple[Coupling, ...]) -> Vehicle:
    """The units in a row; `dimensions` are those of one unit."""
    end, height = len(units) * p["locomotive.length"] / 2, p["coupler.height"]
    return Vehicle(
        name=name,
        bodies=tuple(body for unit in units for body in unit.bodies),
        couplings=(*(coupling for unit in units for coupling in unit.couplings), *between),
        wheelsets=tuple(wheelset for unit in units for wheelset in unit.wheelsets),
        coupler=Coupler(
            bodies=(units[0].bodies[0].name, units[-1].bodies[0].name),
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
        drives=tuple(drive for unit in units for drive in unit.drives),
        traction=_equipment(p),
    )


def _equipment(p: ParameterSet) -> TractionEquipment:
    """The drives of one unit."""
    return TractionEquipment(
        starting_effort=p["traction.starting_effort"],
        power=p["traction.power"],
        braking_effort=p["traction.braking_effort"],
        braking_power=p["traction.braking_power"],
        gear_ratio=p["traction.gear_ratio"],
        rotor_inertia=p["motor.rotor_inertia"],
    )


def _motor_name(bogie: _Bogie, axle: int) -> str:
    return f"motor_{bogie.number}_{axle}"


def _axle_offset(p: ParameterSet, axle: int) -> float:
    """Place of an axle ahead of the middle of its bogie [m]."""
    return (2 - axle) * p["wheelset.spacing"]


def _motor_side(p: ParameterSet, bogie: _Bogie, axle: int) -> int:
    """Side of the motor: +1 ahead of its axle, -1 behind it.

    The reaction of a motor's torque presses its axle down and its bogie's frame up, or the other way round,
    by its side. With all motors of a bogie on one side (``motor.side`` 1: that of the locomotive's middle,
    -1: that of its ends) these forces are the same on all axles and cancel in their springs; with 0 the
    motors of the outer axles lie within the wheelbase, that of the middle axle towards the locomotive's
    middle, and load and unload. Both bogies are mirror images of each other.
    """
    match p["motor.side"]:
        case 1.0 | -1.0 as side:
            return bogie.inwards * int(side)
        case 0.0:
            return {1: -1, 2: bogie.inwards, 3: 1}[axle]
        case other:
            raise ValueError(
                f"motor.side {other:g} must be 1 (motors towards the locomotive's middle), -1 (towards its "
                "ends) or 0 (those of the outer axles within the wheelbase)"
            )


def _car_body(p: ParameterSet, name: str, middle: float, mass: float) -> Body:
    return Body(
        name,
        "car_body",
        mass,
        (
            mass * p["body.roll_gyration"] ** 2,
            mass * p["body.pitch_gyration"] ** 2,
            mass * p["body.yaw_gyration"] ** 2,
        ),
        (middle, 0.0, p["body.height"]),
        _PRIMARY_DEFLECTION,
    )


def _bogie_frame(p: ParameterSet, bogie: _Bogie) -> Body:
    centre = (bogie.middle, 0.0, p["bogie_frame.height"])
    return body_of_kind(p, "bogie_frame", f"bogie_frame_{bogie.number}", centre, _PRIMARY_DEFLECTION)


def _wheelset(p: ParameterSet, bogie: _Bogie, axle: int) -> Body:
    """Its spin inertia has that of the motor's rotor in it, as the gear reflects it.

    For gyroscopic moments the rotor counts with the opposite sign and 1/ratio of that: these small moments of
    a wheelset that spins and yaws are overestimated.
    """
    return Body(
        bogie.wheelset(axle),
        "wheelset",
        p["wheelset.mass"],
        (
            p["wheelset.roll_inertia"],
            p["wheelset.pitch_inertia"] + _equipment(p).reflected_inertia,
            p["wheelset.roll_inertia"],
        ),
        (bogie.middle + _axle_offset(p, axle), 0.0, p["wheelset.radius"]),
    )


def _motor(p: ParameterSet, bogie: _Bogie, axle: int) -> Body:
    x = bogie.middle + _axle_offset(p, axle) + _motor_side(p, bogie, axle) * p["motor.distance"]
    centre = (x, 0.0, p["wheelset.radius"])
    return body_of_kind(p, "motor", _motor_name(bogie, axle), centre, _PRIMARY_DEFLECTION / 2)


def _wheelset_couplings(p: ParameterSet, bogie: _Bogie, axle: int) -> list[Coupling]:
    """Axle boxes on both sides, the motor's bearings on the axle, and its link."""
    place = f"{bogie.number}_{axle}"
    wheelset, frame, motor = bogie.wheelset(axle), f"bogie_frame_{bogie.number}", _motor_name(bogie, axle)
    x, height = bogie.middle + _axle_offset(p, axle), p["wheelset.radius"]
    lateral = "primary.middle_lateral_stiffness" if axle == 2 else "primary.lateral_stiffness"
    couplings: list[Coupling] = [
        AxleBoxPad(
            name=f"primary_{place}{letter}",
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
            name=f"motor_bearing_{place}",
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
            name=f"motor_link_{place}",
            body_a=frame,
            body_b=motor,
            point_a=(nose, 0.0, height + p["motor.link_length"]),
            point_b=(nose, 0.0, height),
            stiffness=p["motor.link_stiffness"],
            damping=p["motor.link_damping"],
        )
    )
    return couplings


def _spring_offset(p: ParameterSet, bogie: _Bogie, body_mass: float) -> float:
    """Place of the secondary springs ahead of the middle axle [m], where they balance the motors' noses.

    The bogie's frame carries the share distance / nose_distance of every motor at its nose; with the springs
    there, all axles stand alike.
    """
    reach = p["motor.nose_distance"]
    noses = [_axle_offset(p, axle) + _motor_side(p, bogie, axle) * reach for axle in (1, 2, 3)]
    carried = p["motor.mass"] * p["motor.distance"] / reach
    return -carried * sum(noses) / (body_mass / 2)


def _body_couplings(p: ParameterSet, bogie: _Bogie, body_mass: float) -> list[Coupling]:
    """Springs with their dampers on both sides, the lateral stop, and the traction rod to the middle."""
    frame, middle = f"bogie_frame_{bogie.number}", bogie.middle
    horizontal, height = p["secondary.horizontal_stiffness"], p["secondary.height"]
    roll, offset = p["secondary.roll_stiffness"], _spring_offset(p, bogie, body_mass)
    springs = [
        Bushing(
            name=f"secondary_{bogie.number}{letter}",
            body_a=frame,
            body_b=bogie.car_body,
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
        name=f"lateral_stop_{bogie.number}",
        body_a=frame,
        body_b=bogie.car_body,
        point=(middle, 0.0, height),
        axis=(0.0, 1.0, 0.0),
        table=((clearance, 0.0), (clearance + 0.05, 0.05 * stop)),
        odd=True,
    )
    rod_height = p["traction_rod.height"]
    rod = Rod(
        name=f"traction_rod_{bogie.number}",
        body_a=frame,
        body_b=bogie.car_body,
        point_a=(middle, 0.0, rod_height),
        point_b=(middle + bogie.inwards * p["traction_rod.length"], 0.0, rod_height),
        stiffness=p["traction_rod.stiffness"],
        damping=p["traction_rod.damping"],
    )
    return [*springs, lateral_stop, rod]


def _pair_parameters() -> ParameterSet:
    """The numbers of a unit, and those of the coupler between two."""
    unit = load_parameters("vehicles", "iore_locomotive")
    between = load_parameters("vehicles", "iore_unit_coupler")
    return ParameterSet("iore_locomotive_pair", unit.parameters + between.parameters)


RECORDS = (
    VehicleRecord(
        "iore_locomotive",
        iore_locomotive,
        partial(load_parameters, "vehicles", "iore_locomotive"),
        "IORE Co-Co locomotive, one unit, 180 t",
    ),
    VehicleRecord(
        "iore_locomotive_pair",
        iore_locomotive_pair,
        _pair_parameters,
        "IORE Co-Co locomotive, both units, 360 t",
    ),
)
