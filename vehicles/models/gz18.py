"""GZ18, a passenger vehicle whose response in a curve SIMPACK has published, wheel by wheel.

Two bogies with axle-box arms, air springs, yaw dampers, lateral dampers and anti-roll bars. The 17 bodies of
the source are seven here: two are welded to the car body, and the axle-box arms are condensed
(`vehicles.passenger_bogie.AxleBoxArm`), their mass on the wheelset. It is drawn loaded, at the heights of the
source: every spring that carries weight has its preload.
"""

from functools import partial

from hh_exudyn.conventions import GRAVITY
from hh_exudyn.sourced import ParameterSet, load_parameters
from vehicles.couplings import Bushing, Coupling
from vehicles.description import Body, Vehicle, Wheelset
from vehicles.models.parts import SIDES, body_of_kind, end_heads, in_directions, train_coupler
from vehicles.passenger_bogie import AxleBoxArm, Damper, SeriesDamper
from vehicles.record import VehicleRecord

_AHEAD, _ACROSS = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
_NOTHING = (0.0, 0.0, 0.0)
_FASTER = 10.0  # times the speed of blow-off: second point of its stretch, beyond which it goes on alike


def gz18(name: str, p: ParameterSet) -> Vehicle:
    """The vehicle, leading bogie first."""
    body = body_of_kind(p, "car_body", "car_body", (0.0, 0.0, p["car_body.height"]))
    sprung = body.mass + 2 * p["bogie_frame.mass"]
    bodies = [body]
    couplings: list[Coupling] = []
    wheelsets: list[Wheelset] = []
    for number, middle in ((1, p["car_body.half_bogie_distance"]), (2, -p["car_body.half_bogie_distance"])):
        frame = body_of_kind(
            p, "bogie_frame", f"bogie_frame_{number}", (middle, 0.0, p["bogie_frame.height"])
        )
        bodies.append(frame)
        couplings += _secondary(p, frame, body)
        for end in (1, -1):
            place = (middle + end * p["bogie_frame.half_wheelbase"], 0.0, p["wheelset.radius"])
            wheelset = body_of_kind(p, "wheelset", f"wheelset_{2 * number - (end > 0)}", place)
            bodies.append(wheelset)
            couplings += _primary(p, frame, wheelset, end, sprung * GRAVITY / 8)
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
            "axle_box_half_spacing": p["coil.half_spacing"],
        },
    )


def _primary(p: ParameterSet, frame: Body, wheelset: Body, end: int, load: float) -> list[Coupling]:
    """Arms and coils of one wheelset, at the leading (+1) or trailing end of its bogie."""
    x, _, z = wheelset.position
    found: list[Coupling] = []
    for side, letter in SIDES:
        wheel = f"{wheelset.name[-1]}{letter}"
        aside = side * p["bushing.half_spacing"]
        found += [
            AxleBoxArm(
                name=f"arm_{wheel}",
                body_a=frame.name,
                body_b=wheelset.name,
                point=(x, aside, z),
                bushing=(x - end * p["bushing.length"], aside, p["bushing.height"]),
                stiffness=in_directions(p, "bushing", "stiffness"),
            ),
            Bushing(
                name=f"coil_{wheel}",
                body_a=frame.name,
                body_b=wheelset.name,
                point=(x, side * p["coil.half_spacing"], z),
                stiffness=(0.0, 0.0, p["coil.vertical_stiffness"]),
                damping=(0.0, 0.0, p["coil.vertical_damping"]),
                preload=(0.0, 0.0, -load),
            ),
        ]
    return found


def _secondary(p: ParameterSet, frame: Body, body: Body) -> list[Coupling]:
    """Air springs, dampers and anti-roll bar of one bogie."""
    x, number = frame.position[0], frame.name[-1]
    shear = p["air_spring.shear_stiffness"]
    blow_off = p["yaw_damper.blow_off_effort"]
    speed = blow_off / p["yaw_damper.damping"]
    found: list[Coupling] = []
    for side, letter in SIDES:
        found += [
            Bushing(
                name=f"air_spring_{number}{letter}",
                body_a=frame.name,
                body_b=body.name,
                point=(x, side * p["air_spring.half_spacing"], p["air_spring.height"]),
                stiffness=(shear, shear, p["air_spring.vertical_stiffness"]),
                damping=(0.0, 0.0, p["air_spring.vertical_damping"]),
                preload=(0.0, 0.0, body.mass * GRAVITY / 4),
            ),
            Damper(
                name=f"yaw_damper_{number}{letter}",
                body_a=frame.name,
                body_b=body.name,
                point=(x, side * p["yaw_damper.half_spacing"], p["yaw_damper.height"]),
                axis=_AHEAD,
                table=((0.0, 0.0), (speed, blow_off), (_FASTER * speed, blow_off)),
            ),
        ]
    return [
        *found,
        SeriesDamper(
            name=f"lateral_damper_{number}",
            body_a=frame.name,
            body_b=body.name,
            point=(x, 0.0, p["lateral_damper.height"]),
            axis=_ACROSS,
            table=((0.0, 0.0), (1.0, p["lateral_damper.damping"])),
            series_stiffness=p["lateral_damper.series_stiffness"],
        ),
        Bushing(
            name=f"anti_roll_bar_{number}",
            body_a=frame.name,
            body_b=body.name,
            point=(x, 0.0, p["anti_roll_bar.height"]),
            stiffness=_NOTHING,
            damping=_NOTHING,
            rotational_stiffness=(p["anti_roll_bar.stiffness"], 0.0, 0.0),
        ),
    ]


RECORD = VehicleRecord(
    "gz18",
    gz18,
    partial(load_parameters, "vehicles", "gz18"),
    "reference: passenger vehicle with SIMPACK's response",
)
