"""The Exudyn system of a vehicle: rigid bodies, track masses, and one object with all forces.

It is open: before it is assembled, anybody's own Exudyn items can be added, between the vehicle's nodes and
markers or beside them (`extension`).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    MarkerBodyRigid,
    NodeGenericODE2,
    NodeRigidBodyRotVecLG,
    ObjectGenericODE2,
    ObjectRigidBody,
)

from hh_exudyn.arrays import FloatArray
from hh_exudyn.multibody.model import BODY_COORDINATES, SystemModel, coordinates, first_track
from hh_exudyn.multibody.rolling import drawn_frame
from vehicles.couplings import Vector
from vehicles.description import Body, Vehicle

Forces = Callable[[Any, float, int, Any, Any], list[float]]
AfterStep = Callable[[Any, float], bool]


@dataclass(frozen=True)
class ExudynSystem:
    """An Exudyn system before `Assemble()`.

    Coordinates of the vehicle come first (layout: `model`), those of further nodes behind them. With
    reference coordinates its nodes stand at their places on the drawing (`place`), as elements between nodes
    need them; without, all are in the origin, which saves an addition. The post-step user function is taken;
    all others are free.

    Attributes
    ----------
    container : Exudyn's ``SystemContainer``
    mbs : its ``MainSystem``
    model, vehicle : of the kernel, and the description that it was made from
    settings : ``SimulationSettings`` of the run
    forces : number of the object with all forces of vehicle and track
    reference : (coordinates,) of the vehicle's own
    nodes, objects, markers : numbers by body name: ``NodeRigidBodyRotVecLG``, ``ObjectRigidBody``, and a
        ``MarkerBodyRigid`` at the centre of mass
    sensors : fill it with numbers of sensors by names, and their values are in the run's log ``sensors``
    """

    container: Any
    mbs: Any
    model: SystemModel
    vehicle: Vehicle
    settings: Any
    forces: int
    reference: FloatArray
    nodes: dict[str, int]
    objects: dict[str, int]
    markers: dict[str, int]
    sensors: dict[str, int] = field(default_factory=dict)

    def marker(self, body: str, point: Vector) -> int:
        """Number of a new marker on a body.

        Parameters
        ----------
        body : name
        point : on the drawing [m]

        Raises
        ------
        ValueError
            The vehicle has no such body.
        """
        drawn = self._body(body).position
        arm = [there - centre for there, centre in zip(point, drawn, strict=True)]
        number: int = self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=self.objects[body], localPosition=arm))
        return number

    def place(self, point: Vector) -> FloatArray:
        """Global place of a point of the drawing at the start of the run, nothing deflected [m].

        It is the same at every border of the run, as reference coordinates of nodes must be.

        Parameters
        ----------
        point : on the drawing [m]
        """
        return _place(self.model, point)

    def make_light(self, body: str, share: float, inertia: Vector | None = None) -> None:
        """Leave a body a share of its mass and inertia, where Exudyn's items on its node have the rest.

        Its weight stays as it is.

        Parameters
        ----------
        body : name
        share : > 0 and at most 1
        inertia : that stays, where it is not that share [kg m^2]

        Raises
        ------
        ValueError
            The vehicle has no such body, or the share is not in that range.
        """
        if not 0.0 < share <= 1.0:
            raise ValueError(f"share = {share} of the mass of {body}: allowed above 0 up to 1")
        drawn, number = self._body(body), self.objects[body]
        left = inertia or tuple(share * about for about in drawn.inertia)
        self.mbs.SetObjectParameter(number, "mass", share * drawn.mass)
        self.mbs.SetObjectParameter(number, "inertia", [*left, 0.0, 0.0, 0.0])

    def _body(self, name: str) -> Body:
        if name not in self.nodes:
            raise ValueError(f"body {name!r}: the vehicle has {', '.join(self.nodes)}")
        return self.vehicle.body(name)


def _place(model: SystemModel, point: Vector) -> FloatArray:
    origin, axes = drawn_frame(model)
    result: FloatArray = origin + axes @ np.array(point)
    return result


def exudyn_system(
    model: SystemModel,
    vehicle: Vehicle,
    q: FloatArray,
    v: FloatArray,
    forces: Forces,
    after_step: AfterStep,
    settings: Any,
    placed: bool = False,
) -> ExudynSystem:
    """The Exudyn system of a model, not yet assembled.

    Parameters
    ----------
    model : masses and inertias are read
    vehicle : that the model was made from
    q, v : (coordinates,) initial coordinates and velocities (layout: `model`); more are not read
    forces : user function of the force object, (mbs, t, item, q, q_t) -> generalized forces
    after_step : (mbs, t) -> whether to continue, called after every accepted step
    settings : of the run (`explicit_settings`)
    placed : with reference coordinates
    """
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    nodes, objects, markers = {}, {}, {}
    reference = np.zeros(coordinates(model))
    for i, body in enumerate(vehicle.bodies):
        k = slice(BODY_COORDINATES * i, BODY_COORDINATES * (i + 1))
        if placed:
            reference[k][:3] = _place(model, body.position)
        node = mbs.AddNode(
            NodeRigidBodyRotVecLG(
                referenceCoordinates=list(reference[k]),
                initialCoordinates=list(q[k] - reference[k]),
                initialVelocities=list(v[k]),
            )
        )
        nodes[body.name] = node
        inertia = [*model.inertia[i], 0.0, 0.0, 0.0]
        objects[body.name] = mbs.AddObject(
            ObjectRigidBody(mass=model.mass[i], inertia=inertia, nodeNumber=node)
        )
        markers[body.name] = mbs.AddMarker(MarkerBodyRigid(bodyNumber=objects[body.name]))
    first = first_track(model)
    # track masses, then the creep coordinates: with unit masses their forces are the rates of velocity
    others = np.ones(coordinates(model) - first)
    if model.flexible:
        masses = np.tile(model.track_mass, len(model.wheelsets))
        others[: masses.size] = masses
    last = first + others.size
    rest = mbs.AddNode(
        NodeGenericODE2(
            referenceCoordinates=[0.0] * others.size,
            initialCoordinates=list(q[first:last]),
            initialCoordinates_t=list(v[first:last]),
            numberOfODE2Coordinates=others.size,
        )
    )
    mass_matrix = np.diag(np.concatenate([np.zeros(first), others]))
    number = mbs.AddObject(
        ObjectGenericODE2(
            name="forces",
            nodeNumbers=[*nodes.values(), rest],
            massMatrix=mass_matrix,
            forceUserFunction=forces,
        )
    )
    mbs.SetPostStepUserFunction(after_step)
    return ExudynSystem(container, mbs, model, vehicle, settings, number, reference, nodes, objects, markers)


def whole_steps(duration: float, step: float) -> int:
    """Number of whole steps within a duration, at least one.

    Parameters
    ----------
    duration, step : [s]
    """
    return max(1, math.floor(duration / step + 1e-9))


def explicit_settings(first: int, last: int, step: float) -> Any:
    """Exudyn's settings for the explicit Runge-Kutta method of third order at a constant step.

    Three evaluations a step instead of the fourth order's four, for a stability limit 10 % lower: at 0.4 ms
    the error of both lies below that of friction's steps and of the contact's strips.

    Parameters
    ----------
    first, last : numbers of the states at begin and end, counted in steps
    step : [s]
    """
    settings = exu.SimulationSettings()
    settings.timeIntegration.startTime = first * step
    settings.timeIntegration.endTime = last * step
    settings.timeIntegration.numberOfSteps = last - first
    settings.timeIntegration.solverType = exu.DynamicSolverType.RK33
    # three evaluations a step instead of four; nothing here reads accelerations
    settings.timeIntegration.explicit.computeEndOfStepAccelerations = False
    # the mass matrix is block diagonal: the sparse solve saves a third of Exudyn's time
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.active = False
    return settings
