"""Force over deflection of bogies and their friction elements, driven slowly around closed paths.

The area of a loop is the energy that its element dissipates, equal to the sum of the powers in the kernel's
ledger.
"""

import math
from dataclasses import replace
from typing import NamedTuple, TypeVar

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.case import Case
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.couplings.dispatch import coupling_forces
from hh_exudyn.multibody.model import Ledger, workspace
from hh_exudyn.multibody.vectors import rotation_matrix
from vehicles.couplings import AxleBox, CentrePlate, Coupling, SideBearer, SpringNest, Vector, Wedge
from vehicles.description import Vehicle
from vehicles.freight_couplings import DoubleLink, LenoirSuspension
from vehicles.outline import coupling_ends

X, Y, Z, ROLL, PITCH, YAW = range(6)
C = TypeVar("C")
_SPEED = 1e-4  # m/s or rad/s, of the largest motion: forces of dampers are negligible
_POINTS = 1001  # from one end of the path to the other


class Loop(NamedTuple):
    """One closed cycle of a group of couplings between the same two bodies."""

    title: str
    axis: int  # of the motion: X .. YAW
    displacement: FloatArray  # (n,) of body B against A along the axis, from the drawing [m, rad]; for Z it
    # is the compression: down, or up if B is a wheelset
    force: FloatArray  # (n,) external force on B in equilibrium, in the same direction [N] or [N m]
    dissipated: float  # by the kernel's ledger [J]

    @property
    def area(self) -> float:
        """Work done on the element in the cycle [J]."""
        return float(np.trapezoid(self.force, self.displacement))


def bogie_loops(vehicle: Vehicle, case: Case) -> tuple[Loop, ...]:
    """The loops of the leading bogie's left-hand elements under their static load.

    Parameters
    ----------
    vehicle : on three-piece bogies; its static loads determine the friction
    case : any case in which the vehicle can run

    Raises
    ------
    ValueError
        The vehicle does not run on three-piece bogies.
    """
    loads = _static_loads(vehicle)
    box, nest = _first(vehicle, AxleBox), _first(vehicle, SpringNest)
    plate, bearer = _first(vehicle, CentrePlate), _first(vehicle, SideBearer)
    wedges = _wedges_beside(vehicle, nest)
    down, on_pad, on_plate = loads.nest, loads.pad, loads.plate
    motions: tuple[tuple[str, tuple[Coupling, ...], int, float, float, dict[int, float]], ...] = (
        ("springs and wedges of a side", (nest, *wedges), Z, down, 0.3 * abs(down), {}),
        ("wedge, vertical", wedges[:1], Z, down, 0.3 * abs(down), {}),
        ("wedge, lateral", wedges[:1], Y, 0.0, 0.006, {Z: down}),
        ("wedges of a side, warp", wedges, YAW, 0.0, 0.01, {Z: down}),
        ("axle box, longitudinal", (box,), X, 0.0, 1.3 * box.longitudinal_clearance, {Z: on_pad}),
        ("axle box, lateral", (box,), Y, 0.0, 1.3 * box.lateral_clearance, {Z: on_pad}),
        ("centre plate, yaw", (plate,), YAW, 0.0, 0.02, {Z: on_plate}),
        ("centre plate, longitudinal", (plate,), X, 0.0, 1.3 * plate.rim_clearance, {Z: on_plate}),
        ("side bearer, longitudinal", (bearer,), X, 0.0, 0.01, {}),
    )
    return tuple(
        drive(vehicle, case, title, group, axis, _cycle(axis, middle, amplitude, fixed))
        for title, group, axis, middle, amplitude, fixed in motions
    )


def suspension_loops(vehicle: Vehicle, case: Case) -> tuple[Loop, ...]:
    """The loops of the first Lenoir suspension or double link under its static load.

    A Lenoir box stands on its guide, pressed by the plunger.

    Parameters
    ----------
    vehicle : with such suspensions
    case : any case in which the vehicle can run

    Raises
    ------
    ValueError
        The vehicle has neither.
    """
    found = [c for c in vehicle.couplings if isinstance(c, LenoirSuspension | DoubleLink)]
    if not found:
        raise ValueError(f"vehicle {vehicle.name} has no LenoirSuspension and no DoubleLink")
    wheelsets = {wheelset.body for wheelset in vehicle.wheelsets}
    load = sum(body.weight for body in vehicle.bodies if body.name not in wheelsets) / (2 * len(wheelsets))
    c = found[0]
    beyond = load - c.first_stiffness * c.second_from
    up = c.second_from + beyond / c.second_stiffness if beyond > 0.0 else load / c.first_stiffness
    ahead = 0.0
    if isinstance(c, LenoirSuspension):
        ahead = -c.direction * math.tan(c.link_angle) * c.link_share * load / c.guide_stiffness
    motions = (
        ("vertical", Z, up, 0.2 * up, {X: ahead}),
        ("lateral", Y, 0.0, 1.2 * c.lateral_clearance, {X: ahead, Z: up}),
        ("longitudinal", X, 0.0, 1.2 * c.longitudinal_clearance, {Z: up}),
    )
    return tuple(
        drive(vehicle, case, f"{c.name}, {title}", (c,), axis, _cycle(axis, middle, amplitude, fixed))
        for title, axis, middle, amplitude, fixed in motions
    )


def warp_loop(vehicle: Vehicle, case: Case, amplitude: float = 0.01) -> Loop:
    """Moment that warps the leading bogie, over the angle of its side frames to the bolster.

    As on a rig whose tables let the wheelsets go: the bolster and the directions of the wheelsets are held,
    both side frames turn, and each wheelset goes sideways with their ends. All couplings within the bogie
    take part, under the static load of the vehicle.

    Parameters
    ----------
    vehicle, case : as for `bogie_loops`
    amplitude : of the warp [rad]

    Raises
    ------
    ValueError
        As `bogie_loops`.
    """
    loads, nest, leading = _static_loads(vehicle), _first(vehicle, SpringNest), vehicle.wheelsets[0]
    wheelsets = [w.body for w in vehicle.wheelsets if (w.unit, w.bogie) == (leading.unit, leading.bogie)]
    boxes = [c for c in vehicle.couplings if isinstance(c, AxleBox) and c.body_b in wheelsets]
    frames = sorted({box.body_a for box in boxes})
    middle = vehicle.body(nest.body_b).position
    ways = {nest.body_b: _Way(middle, {}, {Z: loads.nest})}
    for name in frames:
        ways[name] = _Way(vehicle.body(name).position, {YAW: 1.0}, {})
    for name in wheelsets:
        place = vehicle.body(name).position
        ways[name] = _Way(place, {Y: place[0] - middle[0]}, {Z: loads.pad})
    group = tuple(c for c in vehicle.couplings if {c.body_a, c.body_b} <= set(ways))
    path = _there_and_back(0.0, amplitude)
    return _driven(replace(vehicle, couplings=group), case, "bogie, warp", YAW, path, ways)


def drive(
    vehicle: Vehicle, case: Case, title: str, group: tuple[Coupling, ...], axis: int, path: FloatArray
) -> Loop:
    """Loop of couplings between the same two bodies: the second of two rounds of a closed path.

    Parameters
    ----------
    vehicle, case : as for `bogie_loops`
    title : of the loop
    group : couplings between the same bodies; B turns about the middle of their points
    axis : of the path, X .. YAW
    path : (n, 6) displacement and small rotation of B relative to A, along the axis; its last point is its
        first [m, rad]
    """
    x, y, z = np.mean([coupling_ends(coupling)[-1] for coupling in group], axis=0)
    held = {other: float(path[0, other]) for other in range(6) if other != axis}
    ways = {group[0].body_b: _Way((x, y, z), {axis: 1.0}, held)}
    return _driven(replace(vehicle, couplings=group), case, title, axis, path[:, axis], ways)


class _Way(NamedTuple):
    """How a body moves along a path: in some axes so much per unit of the path, in others held."""

    point: Vector  # that it turns about, on the drawing [m]
    along: dict[int, float]
    held: dict[int, float]  # [m, rad]

    def mode(self) -> FloatArray:
        """(6,) displacement and rotation per unit of the path."""
        return np.array([self.along.get(axis, 0.0) for axis in range(6)])

    def place(self, value: float) -> FloatArray:
        """(6,) displacement and small rotation [m, rad] at a value of the path."""
        return value * self.mode() + np.array([self.held.get(axis, 0.0) for axis in range(6)])


def _driven(
    vehicle: Vehicle, case: Case, title: str, axis: int, path: FloatArray, ways: dict[str, _Way]
) -> Loop:
    """Second of two rounds of a closed path (n,) on which bodies go their ways, others staying put."""
    model = assemble(vehicle, case)
    work = workspace(model)
    names = [body.name for body in vehicle.bodies]
    drawing = np.array([body.position for body in vehicle.bodies])
    sliders = np.zeros_like(work.new_sliders)
    change = np.diff(path, prepend=path[0])
    steps = np.abs(change) / _SPEED  # s
    work.position[:] = drawing
    work.rotation[:] = np.eye(3)
    forces = np.zeros(len(path))
    lost = 0.0
    for _ in range(2):
        lost = 0.0
        for k, value in enumerate(path):
            for array in (work.force, work.torque, work.ledger):
                array[:] = 0.0
            turned = {}
            for name, way in ways.items():
                b, place, rate = names.index(name), way.place(value), np.sign(change[k]) * _SPEED * way.mode()
                rotation_matrix(place[3], place[4], place[5], work.rotation[b])
                arm = np.array(way.point) - drawing[b]
                turned[b] = work.rotation[b] @ arm
                work.position[b] = drawing[b] + place[:3] + arm - turned[b]
                work.velocity[b] = rate[:3] - np.cross(rate[3:], turned[b])
                work.angular_velocity[b] = rate[3:]
            coupling_forces(model.couplings, sliders, False, work)
            sliders[:] = work.new_sliders
            forces[k] = 0.0
            for (b, arm), way in zip(turned.items(), ways.values(), strict=True):
                moment = work.torque[b] - np.cross(arm, work.force[b])
                forces[k] -= np.concatenate([work.force[b], moment]) @ way.mode()
            lost += (work.ledger[Ledger.FRICTION_POWER] + work.ledger[Ledger.DAMPER_POWER]) * steps[k]
    wheelsets = {wheelset.body for wheelset in vehicle.wheelsets}
    sense = -1.0 if axis == Z and not wheelsets & set(ways) else 1.0
    return Loop(title, axis, sense * path, sense * forces, float(lost))


def _there_and_back(middle: float, amplitude: float) -> FloatArray:
    """(n,) path from the lower end to the upper and back."""
    there = np.linspace(middle - amplitude, middle + amplitude, _POINTS)
    return np.concatenate([there, there[-2::-1]])


def _cycle(axis: int, middle: float, amplitude: float, fixed: dict[int, float]) -> FloatArray:
    """(n, 6) path from the lower end to the upper and back along the axis, others fixed."""
    along = _there_and_back(middle, amplitude)
    path = np.zeros((len(along), 6))
    for other, value in fixed.items():
        path[:, other] = value
    path[:, axis] = along
    return path


class _StaticLoads(NamedTuple):
    """Displacements of B against A under the weight of the vehicle, upwards [m]."""

    nest: float
    pad: float
    plate: float


def _static_loads(vehicle: Vehicle) -> _StaticLoads:
    """Of the leading bogie, without friction. Raises ValueError for a vehicle without three-piece bogies."""
    wheelsets = {wheelset.body for wheelset in vehicle.wheelsets}
    carried = sum(body.mass for body in vehicle.bodies if body.name not in wheelsets)
    on_box = carried * GRAVITY / (2 * len(wheelsets))
    box, nest, plate = _first(vehicle, AxleBox), _first(vehicle, SpringNest), _first(vehicle, CentrePlate)
    frame = vehicle.body(nest.body_a)
    down = _deflection(nest, _wedges_beside(vehicle, nest), 2 * on_box - frame.mass * GRAVITY)
    on_plate = vehicle.body(plate.body_b).mass * GRAVITY / 2
    return _StaticLoads(-down, on_box / box.stiffness[Z], -on_plate / plate.stiffness)


def _wedges_beside(vehicle: Vehicle, nest: SpringNest) -> tuple[Wedge, ...]:
    """The wedges in the side frame of a nest."""
    return tuple(c for c in vehicle.couplings if isinstance(c, Wedge) and c.body_a == nest.body_a)


def _deflection(nest: SpringNest, wedges: tuple[Wedge, ...], load: float) -> float:
    """Compression [m] of a nest and its wedges' springs, without friction, under a load [N]."""
    compression = np.linspace(0.0, 0.2, 2001)
    beyond = np.maximum(compression - nest.second_from, 0.0)
    force = nest.first_stiffness * compression + (nest.second_stiffness - nest.first_stiffness) * beyond
    for wedge in wedges:
        _, (_, _, rise) = wedge.ways  # of the control spring, whose lift by virtual work has it once more
        force += rise * wedge.spring_stiffness * np.maximum(wedge.compression + rise * compression, 0.0)
    return float(np.interp(load, force, compression))


def _first(vehicle: Vehicle, kind: type[C]) -> C:
    """The vehicle's first coupling of a kind. Raises ValueError if it has none: no three-piece bogie."""
    for coupling in vehicle.couplings:
        if isinstance(coupling, kind):
            return coupling
    raise ValueError(f"vehicle {vehicle.name} has no {kind.__name__}: it does not run on three-piece bogies")
