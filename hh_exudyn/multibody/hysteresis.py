"""Force over deflection of the friction elements of a three-piece bogie, driven slowly around closed paths.

The area of a loop is the energy that its element dissipates, equal to the sum of the powers in the kernel's
ledger.
"""

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
from vehicles.couplings import AxleBox, CentrePlate, Coupling, SideBearer, SpringNest, Wedge
from vehicles.description import Vehicle

X, Y, Z, ROLL, PITCH, YAW = range(6)
C = TypeVar("C")
_SPEED = 1e-4  # m/s or rad/s, of the largest motion: forces of dampers are negligible
_POINTS = 1001  # from one end of the path to the other


class Loop(NamedTuple):
    """One closed cycle of a group of couplings between the same two bodies."""

    title: str
    axis: int  # of the motion: X .. YAW
    displacement: FloatArray  # (n,) of body B against A along the axis, DOWN for Z, from the drawing [m, rad]
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
    wheelsets = {wheelset.body for wheelset in vehicle.wheelsets}
    carried = sum(body.mass for body in vehicle.bodies if body.name not in wheelsets)
    on_box = carried * GRAVITY / (2 * len(wheelsets))
    box, nest = _first(vehicle, AxleBox), _first(vehicle, SpringNest)
    plate, bearer = _first(vehicle, CentrePlate), _first(vehicle, SideBearer)
    wedges = tuple(c for c in vehicle.couplings if isinstance(c, Wedge) and c.body_a == nest.body_a)
    body = next(body for body in vehicle.bodies if body.name == plate.body_b)
    frame = next(body for body in vehicle.bodies if body.name == nest.body_a)
    down = -_deflection(nest, wedges, 2 * on_box - frame.mass * GRAVITY)
    on_plate = -body.mass * GRAVITY / (2 * plate.stiffness)
    on_pad = on_box / box.stiffness[Z]
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
    path : (n, 6) displacement and small rotation of B relative to A; its last point is its first [m, rad]
    """
    model = assemble(replace(vehicle, couplings=group), case)
    work = workspace(model)
    names = [body.name for body in vehicle.bodies]
    drawing = np.array([body.position for body in vehicle.bodies])
    b = names.index(group[0].body_b)
    arm = model.couplings.point_b.mean(axis=0)
    sliders = np.zeros_like(work.new_sliders)
    rates = np.zeros_like(path)
    rates[1:] = np.diff(path, axis=0)
    steps = np.abs(rates).max(axis=1) / _SPEED  # s
    rates[1:] /= steps[1:, None]
    work.position[:] = drawing
    work.rotation[:] = np.eye(3)
    forces = np.zeros(len(path))
    lost = 0.0
    for _ in range(2):
        lost = 0.0
        for k, (place, rate) in enumerate(zip(path, rates, strict=True)):
            rotation_matrix(place[3], place[4], place[5], work.rotation[b])
            turned = work.rotation[b] @ arm
            work.position[b] = drawing[b] + place[:3] + arm - turned
            work.velocity[b] = rate[:3] - np.cross(rate[3:], turned)
            work.angular_velocity[b] = rate[3:]
            for array in (work.force, work.torque, work.ledger):
                array[:] = 0.0
            coupling_forces(model.couplings, sliders, False, work)
            sliders[:] = work.new_sliders
            moment = work.torque[b] - np.cross(turned, work.force[b])
            forces[k] = -np.concatenate([work.force[b], moment])[axis]
            lost += (work.ledger[Ledger.FRICTION_POWER] + work.ledger[Ledger.DAMPER_POWER]) * steps[k]
    sense = -1.0 if axis == Z else 1.0
    return Loop(title, axis, sense * path[:, axis], sense * forces, float(lost))


def _cycle(axis: int, middle: float, amplitude: float, fixed: dict[int, float]) -> FloatArray:
    """(n, 6) path from the lower end to the upper and back along the axis, others fixed."""
    there = np.linspace(middle - amplitude, middle + amplitude, _POINTS)
    path = np.zeros((2 * _POINTS - 1, 6))
    for other, value in fixed.items():
        path[:, other] = value
    path[:, axis] = np.concatenate([there, there[-2::-1]])
    return path


def _deflection(nest: SpringNest, wedges: tuple[Wedge, ...], load: float) -> float:
    """Compression [m] of a nest and its wedges' springs, without friction, under a load [N]."""
    compression = np.linspace(0.0, 0.2, 2001)
    beyond = np.maximum(compression - nest.second_from, 0.0)
    force = nest.first_stiffness * compression + (nest.second_stiffness - nest.first_stiffness) * beyond
    for wedge in wedges:
        force += wedge.spring_stiffness * np.maximum(wedge.compression + compression, 0.0)
    return float(np.interp(load, force, compression))


def _first(vehicle: Vehicle, kind: type[C]) -> C:
    """The vehicle's first coupling of a kind. Raises ValueError if it has none: no three-piece bogie."""
    for coupling in vehicle.couplings:
        if isinstance(coupling, kind):
            return coupling
    raise ValueError(f"vehicle {vehicle.name} has no {kind.__name__}: it does not run on three-piece bogies")
