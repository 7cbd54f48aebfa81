"""From the descriptions of vehicle and track to the model of the force kernel."""

import math

import numpy as np

from hh_exudyn.case import Case
from hh_exudyn.case.check_rail import check_rails
from hh_exudyn.case.irregular import require_possible_track
from hh_exudyn.multibody.couplings.dispatch import FAMILIES
from hh_exudyn.multibody.couplings.family import packed
from hh_exudyn.multibody.model import (
    Brakes,
    Couplings,
    Drives,
    SystemModel,
    Train,
)
from track.course.alignment import Alignment, inclined_frame
from track.irregularity.table import IrregularityTable, smooth_track
from track.support.flexibility import track_flexibility
from vehicles.couplings import Coupling, Rod, Vector
from vehicles.description import Vehicle
from vehicles.start import start_front, start_middle

SHORTEST_TRANSITION = 5e-3  # m; patches of a wheel about to lift off are too short for any time step
LARGEST_LAG_RATE = 1.5  # of the creepage's transition per time step; RK33 is stable up to 2.51


def assemble(vehicle: Vehicle, case: Case) -> SystemModel:
    """The kernel's model of a vehicle on the track of a case.

    Parameters
    ----------
    vehicle : description, in place of the case's own vehicle
    case : track, contact, friction, speed, brakes and time step

    Raises
    ------
    ValueError
        The track does not begin with a straight of one gradient as long as the vehicle, or its wheels differ
        in radius.
    """
    alignment = case.alignment()
    _require_straight_start(vehicle, alignment, case.track.alignment_key, case.start_m)
    numbers = {body.name: i for i, body in enumerate(vehicle.bodies)}
    flexible = case.track.flexible
    # rigid track has an unused parameter set too, so that the kernel has the same types
    flexibility = track_flexibility(case.track.flexibility if flexible else "concrete")
    if not case.track.sleeper_passing:
        flexibility = flexibility.evenly_supported()
    return SystemModel(
        mass=np.array([body.mass for body in vehicle.bodies]),
        weight=np.array([body.weight for body in vehicle.bodies]),
        inertia=np.array([body.inertia for body in vehicle.bodies]),
        couplings=_couplings(vehicle, numbers),
        start=start_middle(vehicle, case.start_m),
        wheelsets=np.array([numbers[wheelset.body] for wheelset in vehicle.wheelsets]),
        wheel_rail=case.contact_model(vehicle),
        check_rail=check_rails(
            case.track.check_rail,
            alignment,
            case.wheels(len(vehicle.wheelsets)),
            case.back_to_back,
            vehicle.wheelsets[0].radius,
        ),
        friction=case.friction_table(len(vehicle.wheelsets)),
        alignment=alignment.table,
        irregularity=_irregularity(vehicle, case, alignment),
        cant_ramp_slope=case.track.cant_ramp_slope,
        flexible=flexible,
        track=flexibility.parameters(),
        shortest_transition=shortest_transition(case.speed, case.integration.step_ms * 1e-3),
        track_mass=flexibility.masses(),
        train=_train(vehicle, case, numbers),
        drives=_drives(vehicle, numbers),
        brakes=_brakes(vehicle, case, numbers),
    )


def shortest_transition(speed: float, step: float) -> float:
    """Lower bound of the creepage's transition length [m], for stability of the explicit integration.

    Parameters
    ----------
    speed : [m/s]
    step : time step [s]
    """
    return max(SHORTEST_TRANSITION, speed * step / LARGEST_LAG_RATE)


def _require_straight_start(vehicle: Vehicle, alignment: Alignment, key: str, place: float | None) -> None:
    """Raise ValueError unless the track under the vehicle at the start is straight and of one gradient."""
    front = start_front(vehicle, place)
    first = f"track.{key}: the first {front:.1f} m"
    _, _, _, heading, _, roll, _, _ = inclined_frame(alignment.table, front)
    if abs(heading) > 1e-6 or abs(roll) > 1e-6:
        raise ValueError(
            f"{first} must be straight, so that vehicle {vehicle.name} can start on them; at "
            f"s = {front:.1f} m the track has turned by {heading * 1e3:.2g} mrad"
        )
    slopes = [1e3 * math.tan(-inclined_frame(alignment.table, s)[4]) for s in np.linspace(0.0, front, 24)]
    if max(slopes) - min(slopes) > 1e-3:
        raise ValueError(
            f"{first} must have one gradient, so that vehicle {vehicle.name} can start on them; it goes from "
            f"{min(slopes):.3g} to {max(slopes):.3g} per mille"
        )


def _irregularity(vehicle: Vehicle, case: Case, alignment: Alignment) -> IrregularityTable:
    """Irregularities ahead of the vehicle's start; the track under it there is smooth."""
    irregular = case.track.irregular(start_front(vehicle, case.start_m), alignment.length)
    if irregular is None:
        return smooth_track()
    irregular.check_spacing(case.speed, case.integration.step_ms * 1e-3)
    require_possible_track(case, alignment, irregular)
    return irregular.table()


def _train(vehicle: Vehicle, case: Case, numbers: dict[str, int]) -> Train:
    """The train: at all coupler heads of a hauled vehicle, at the rear head of a driven one."""
    coupler = vehicle.coupler
    points = dict(zip(coupler.points, coupler.bodies, strict=True))
    if vehicle.drives:
        rear = min(points)
        points = {rear: points[rear]}
    uncoupled = bool(vehicle.drives) and case.traction_or_default.alone(vehicle)
    heads = np.array(list(points))
    draft = 0.0 if case.train is None else 1e3 * case.train.draft_kN
    return Train(
        bodies=np.array([numbers[body] for body in points.values()], dtype=np.int64),
        heads=heads - np.array([vehicle.body(body).position for body in points.values()]),
        start=start_middle(vehicle, case.start_m) + heads[:, 0],
        stiffness=0.0 if uncoupled else coupler.stiffness,
        damping=0.0 if uncoupled else coupler.damping,
        speed=case.speed,
        through=draft * np.sign(heads[:, 0]),
    )


def released(model: SystemModel, case: Case) -> SystemModel:
    """The model of the run, after the equilibrium: without its train where the case rolls freely.

    Parameters
    ----------
    model : as assembled
    case : says whether the vehicle rolls freely
    """
    if not case.free_rolling:
        return model
    return model._replace(train=model.train._replace(stiffness=0.0, damping=0.0))


def _drives(vehicle: Vehicle, numbers: dict[str, int]) -> Drives:
    bodies = [(numbers[drive.wheelset], numbers[drive.motor]) for drive in vehicle.drives]
    return Drives(np.array(bodies, dtype=np.int64).reshape(-1, 2))


def _brakes(vehicle: Vehicle, case: Case, numbers: dict[str, int]) -> Brakes:
    """The shoes applied in a case, with the thrust of its brake order."""
    order = case.brake
    thrusts = [] if order is None else order.thrusts(vehicle)
    shoes = [(shoe, thrust) for shoe, thrust in zip(vehicle.shoes, thrusts, strict=False) if thrust > 0.0]
    bodies = [(numbers[shoe.wheelset], numbers[shoe.carrier]) for shoe, _ in shoes]
    points = [np.array(shoe.point) - vehicle.body(shoe.carrier).position for shoe, _ in shoes]
    given = None if order is None else order.friction
    return Brakes(
        bodies=np.array(bodies, dtype=np.int64).reshape(-1, 2),
        point=np.array(points).reshape(-1, 3),
        thrust=np.array([thrust for _, thrust in shoes]),
        friction=np.array([shoe.friction if given is None else given for shoe, _ in shoes]),
        start=0.0 if order is None else order.start_s,
        build_up=0.0 if order is None else order.build_up_s,
    )


def _couplings(vehicle: Vehicle, numbers: dict[str, int]) -> Couplings:
    positions = {body.name: np.array(body.position) for body in vehicle.bodies}
    couplings = vehicle.couplings
    spinning = {wheelset.body for wheelset in vehicle.wheelsets}
    turned = [c.body_a in spinning and c.body_b not in spinning for c in couplings]
    ends = [_ends(c)[:: -1 if over else 1] for c, over in zip(couplings, turned, strict=True)]
    arms_a = [np.array(point) - positions[body] for (body, point), _ in ends]
    arms_b = [np.array(point) - positions[body] for _, (body, point) in ends]
    kind, records = packed(couplings, FAMILIES)
    return Couplings(
        kind=kind,
        sense=np.where(turned, -1.0, 1.0),
        body_a=np.array([numbers[body] for (body, _), _ in ends], dtype=np.int64),
        body_b=np.array([numbers[body] for _, (body, _) in ends], dtype=np.int64),
        point_a=np.array(arms_a).reshape(-1, 3),  # a vehicle may have no couplings at all
        point_b=np.array(arms_b).reshape(-1, 3),
        on_axle=np.array([body in spinning for _, (body, _) in ends], dtype=np.int64),
        numbers=records,
    )


def _ends(coupling: Coupling) -> tuple[tuple[str, Vector], tuple[str, Vector]]:
    """Bodies A and B of a coupling, with its points on them on the drawing [m]."""
    if isinstance(coupling, Rod):
        return (coupling.body_a, coupling.point_a), (coupling.body_b, coupling.point_b)
    return (coupling.body_a, coupling.point), (coupling.body_b, coupling.point)
