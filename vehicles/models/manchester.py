"""Vehicle 1 of the Manchester benchmarks: a passenger coach on two bogies with two-stage suspension.

Masses stand at their published heights when loaded: secondary springs carry their preload on the drawing,
primary springs are drawn unloaded, so the drawing is higher by their static deflection.
"""

from functools import partial

from hh_exudyn.conventions import GRAVITY
from hh_exudyn.sourced import ParameterSet, load_parameters
from vehicles.couplings import AxleBoxPad, BumpStop, Bushing, Coupling
from vehicles.description import Body, Vehicle, Wheelset
from vehicles.models.parts import SIDES, body_of_kind, end_heads, in_directions, train_coupler
from vehicles.record import VehicleRecord

_BUMP_STOP_MM = (25, 30, 35, 40, 45, 50, 55, 60, 65)


def manchester_vehicle_1(name: str, p: ParameterSet) -> Vehicle:
    """The coach, leading bogie first."""
    sunk = _primary_deflection(p)
    body = body_of_kind(p, "car_body", "car_body", (0.0, 0.0, p["car_body.height"] + sunk), sunk)
    bodies = [body]
    couplings: list[Coupling] = []
    wheelsets: list[Wheelset] = []
    for number, middle in ((1, p["car_body.half_bogie_distance"]), (2, -p["car_body.half_bogie_distance"])):
        centre = (middle, 0.0, p["bogie_frame.height"] + sunk)
        frame = body_of_kind(p, "bogie_frame", f"bogie_frame_{number}", centre, sunk)
        bodies.append(frame)
        couplings += _secondary(p, frame, body.name, sunk)
        for end in (1, -1):
            wheelset = _wheelset(p, 2 * number - (end > 0), middle + end * p["bogie_frame.half_wheelbase"])
            bodies.append(wheelset)
            couplings += _primary(p, frame, wheelset)
            wheelsets.append(Wheelset(wheelset.name, number, p["wheelset.radius"]))
    return Vehicle(
        name=name,
        bodies=tuple(bodies),
        couplings=tuple(couplings),
        wheelsets=tuple(wheelsets),
        coupler=train_coupler(p, end_heads(p, p["car_body.length"]), sum(each.mass for each in bodies)),
        dimensions={
            "length": p["car_body.length"],
            "wheelbase": 2 * p["bogie_frame.half_wheelbase"],
            "wheel_radius": p["wheelset.radius"],
            "axle_box_half_spacing": p["primary.half_spacing"],
        },
    )


def _primary_deflection(p: ParameterSet) -> float:
    """Of the axle-box springs under body and frames [m]."""
    sprung = p["car_body.mass"] + 2 * p["bogie_frame.mass"]
    return sprung * GRAVITY / (8 * p["primary.vertical_stiffness"])


def _wheelset(p: ParameterSet, number: int, x: float) -> Body:
    roll, spin = p["wheelset.roll_inertia"], p["wheelset.spin_inertia"]
    centre = (x, 0.0, p["wheelset.radius"])
    return Body(f"wheelset_{number}", "wheelset", p["wheelset.mass"], (roll, spin, roll), centre)


def _primary(p: ParameterSet, frame: Body, wheelset: Body) -> list[Coupling]:
    x, _, z = wheelset.position
    directions = ("longitudinal", "lateral", "vertical")
    stiffness = tuple(p[f"primary.{direction}_stiffness"] for direction in directions)
    damping = tuple(p[f"primary.{direction}_damping"] for direction in directions)
    return [
        AxleBoxPad(
            name=f"primary_{wheelset.name[-1]}{letter}",
            body_a=frame.name,
            body_b=wheelset.name,
            point=(x, side * p["primary.half_spacing"], z),
            stiffness=(stiffness[0], stiffness[1], stiffness[2]),
            damping=(damping[0], damping[1], damping[2]),
            roll_stiffness=0.0,
            yaw_stiffness=0.0,
        )
        for side, letter in SIDES
    ]


def _secondary(p: ParameterSet, frame: Body, car_body: str, sunk: float) -> list[Coupling]:
    """Springs with dampers, anti-roll bar, traction rod and lateral bump stop of one bogie."""
    x = frame.position[0]
    height = 0.5 * (p["secondary.bottom"] + p["secondary.top"]) + sunk
    bending, shear = p["secondary.bending_stiffness"], p["secondary.shear_stiffness"]
    number = frame.name[-1]
    springs = [
        Bushing(
            name=f"secondary_{number}{letter}",
            body_a=frame.name,
            body_b=car_body,
            point=(x, side * p["secondary.half_spacing"], height),
            stiffness=(shear, shear, p["secondary.vertical_stiffness"]),
            damping=in_directions(p, "secondary", "damping"),
            rotational_stiffness=(bending, bending, 0.0),
            preload=(0.0, 0.0, p["car_body.mass"] * GRAVITY / 4),
        )
        for side, letter in SIDES
    ]
    return [
        *springs,
        Bushing(
            name=f"anti_roll_bar_{number}",
            body_a=frame.name,
            body_b=car_body,
            point=(x, 0.0, height),
            stiffness=(0.0, 0.0, 0.0),
            damping=(0.0, 0.0, 0.0),
            rotational_stiffness=(p["anti_roll_bar.stiffness"], 0.0, 0.0),
        ),
        Bushing(
            name=f"traction_rod_{number}",
            body_a=frame.name,
            body_b=car_body,
            point=(x, 0.0, p["traction_rod.height"] + sunk),
            stiffness=(p["traction_rod.stiffness"], 0.0, 0.0),
            damping=(0.0, 0.0, 0.0),
        ),
        BumpStop(
            name=f"bump_stop_{number}",
            body_a=frame.name,
            body_b=car_body,
            point=(x, 0.0, p["bump_stop.height"] + sunk),
            axis=(0.0, 1.0, 0.0),
            table=tuple((mm * 1e-3, p[f"bump_stop.force_at_{mm}_mm"]) for mm in _BUMP_STOP_MM),
            odd=True,
        ),
    ]


RECORD = VehicleRecord(
    "manchester_vehicle_1",
    manchester_vehicle_1,
    partial(load_parameters, "vehicles", "manchester_vehicle_1"),
    "reference: passenger coach of the Manchester benchmarks",
)
