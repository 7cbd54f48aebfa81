"""The state of a vehicle that rolls straight ahead at constant speed at one position of its track.

The wheels roll, so the unknowns of a wheelset's pitch and of the creepage are velocities, not coordinates.
The position of the vehicle is given, so the unknown of the front coupler head's body is the position of the
train (`Inputs.train_start`); that of a driven vehicle is the torque of its drives, the same for all
(`Inputs.drive_torque`), while the distance of the train from the coupler head, and so its force, is constant.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import Bundle
from hh_exudyn.multibody.model import (
    BODY_COORDINATES,
    TRACK_COORDINATES,
    SystemModel,
    Workspace,
    coordinates,
    first_creep,
    first_track,
)
from hh_exudyn.multibody.system import evaluate_bundle
from track.course.alignment import inclined_frame, inclined_rotation
from vehicles.description import Vehicle

LENGTH_SCALE = 1e-3  # m and rad, of the displacements from the drawing to the equilibrium
_HEIGHT_RANGE = 5e-3  # m, range of heights to search: profiles and track height differ by less
_FOLLOWING = 0.1  # s, time constant of train and drives for the forces along the track
_DEFLECTION_GUESS = 2e-3  # m, of the track under a loaded wheel


class NoEquilibrium(RuntimeError):
    """No static equilibrium was found; the text names the residual force and its place."""


class Snapshot(NamedTuple):
    """All unknowns of a rolling vehicle."""

    q: FloatArray
    v: FloatArray
    train: FloatArray  # `Inputs.train_start`
    torque: FloatArray  # `Inputs.drive_torque`


def drawn_frame(model: SystemModel) -> tuple[FloatArray, FloatArray]:
    """Place of the drawing's origin in the global frame at the start of a run [m], and its axes as columns.

    Parameters
    ----------
    model : its start is read, on a straight of one gradient
    """
    *origin, _, pitch, _, _, _ = inclined_frame(model.alignment, model.start)
    turn = np.empty((3, 3))
    inclined_rotation(0.0, pitch, 0.0, turn)
    return np.array(origin), turn


class RollingVehicle:
    """The state of a rolling vehicle, initially that of its drawing.

    Parameters
    ----------
    vehicle, model : description, and its model on a track
    work : work space; its inputs are part of the state

    Attributes
    ----------
    q, v : coordinates and velocities (layout: `model`)
    still : (coordinates,) velocities after settling; zero for those that are unknowns
    rates : numbers of the coordinates with an unknown velocity; these coordinates are zero
    place : number of the coordinate of the vehicle's position along the track, which is constant
    along : (3,) direction of the track there

    Raises
    ------
    NoEquilibrium
        The wheels do not meet the rails.
    """

    def __init__(self, vehicle: Vehicle, model: SystemModel, work: Workspace) -> None:
        self.vehicle, self.model, self.work = vehicle, model, work
        self.inputs = work.inputs
        self.bundle = Bundle(model, work)
        self.sliders = np.zeros_like(work.new_sliders)
        self.driven = work.inputs.drive_torque.size > 0
        self.weight = float(model.weight.sum())
        middle = model.start
        for i, wheelset in enumerate(vehicle.wheelsets):
            work.arc_length[i] = middle + vehicle.body(wheelset.body).position[0]
        work.arc_length[len(vehicle.wheelsets) :] = work.inputs.train_start
        self._rear = middle + min(point[0] for point in vehicle.coupler.points)
        self._start = work.inputs.train_start.copy()
        spins = [BODY_COORDINATES * int(i) + 4 for i in model.wheelsets]
        self.rates = np.array([*spins, *range(first_creep(model), coordinates(model))])
        self.place = BODY_COORDINATES * int(model.train.bodies[0])
        self._draw(middle)
        self._stands = float(self.q[self.place])
        self.still = self.v.copy()
        self.still[self.rates] = 0.0

    def forces(self) -> FloatArray:
        """Generalized forces in the present state (the work space's own array)."""
        evaluate_bundle(self.bundle, self.sliders, self.q, self.v, 0.0, True)
        return self.work.generalized_force

    def pull_as_before(self) -> None:
        """Move the train of a driven vehicle to its distance from the coupler head, after `forces`."""
        self.inputs.train_start[:] = self._start + self.work.arc_length[-1] - self._rear

    def follow(self, step: float) -> None:
        """Reduce the force of train or drives by a share of the sum of all forces along the track.

        Parameters
        ----------
        step : of a motion in time [s]
        """
        bodies = self.work.generalized_force[: first_track(self.model)].reshape(-1, BODY_COORDINATES)[:, :3]
        change = float((bodies @ self.along).sum()) * step / _FOLLOWING
        if self.driven:
            radius = self.vehicle.wheelsets[0].radius
            self.inputs.drive_torque[:] -= change * radius / self.inputs.drive_torque.size
            self.pull_as_before()
        else:
            self.inputs.train_start[:] -= change / self.model.train.stiffness

    def settled(self) -> None:
        """Set all velocities but the unknown ones to those at rest, and move the vehicle to its place."""
        rates = self.v[self.rates].copy()
        self.v[:] = self.still
        self.v[self.rates] = rates
        moved = (self.q[self.place] - self._stands) / self.along[0]
        for axis in range(3):
            self.q[axis : first_track(self.model) : BODY_COORDINATES] -= moved * self.along[axis]
        self.inputs.train_start[:] -= moved * self.along[0]

    def snapshot(self) -> Snapshot:
        """A copy of all unknowns."""
        return Snapshot(
            self.q.copy(),
            self.v.copy(),
            self.inputs.train_start.copy(),
            self.inputs.drive_torque.copy(),
        )

    def restore(self, state: Snapshot) -> None:
        """Return to a snapshot.

        Parameters
        ----------
        state : from `snapshot`
        """
        self.q[:], self.v[:] = state.q, state.v
        self.inputs.train_start[:], self.inputs.drive_torque[:] = state.train, state.torque

    def _draw(self, middle: float) -> None:
        """Set the drawing, deflected, lowered until the wheels carry the weight; all at the train's speed.

        On a gradient it is pitched with the track; rotation angles of wheelsets about their axles are zero.
        """
        vehicle, model = self.vehicle, self.model
        self.q, self.v = np.zeros(coordinates(model)), np.zeros(coordinates(model))
        track = _DEFLECTION_GUESS if model.flexible else 0.0
        origin, turn = drawn_frame(model)
        pitch = inclined_frame(model.alignment, middle)[4]
        speed = model.train.speed / math.cos(pitch)  # the train's is in plan
        self.along = turn[:, 0].copy()
        for i, body in enumerate(vehicle.bodies):
            k = BODY_COORDINATES * i
            below = [0.0, 0.0, body.deflection + track]
            self.q[k : k + 3] = origin + turn @ (np.array(body.position) - below)
            self.q[k + 4] = pitch
            self.v[k : k + 3] = speed * self.along
        for wheelset, i in zip(vehicle.wheelsets, model.wheelsets, strict=True):
            self.q[BODY_COORDINATES * int(i) + 4] = 0.0
            self.v[BODY_COORDINATES * int(i) + 4] = speed / wheelset.radius
        if model.flexible:
            for k in range(first_track(model), first_creep(model)):
                vertical = (k - first_track(model)) % TRACK_COORDINATES in (1, 3, 5)
                self.q[k] = -track if vertical else 0.0
        self._lower()
        for unit in vehicle.units[1:]:
            self._hang_on(unit)

    def _lower(self) -> None:
        """Move all bodies down or up until the wheels carry the weight."""
        heights = np.arange(2, first_track(self.model), BODY_COORDINATES)
        drawn = self.q[heights].copy()

        def lack_of_load(height: float) -> float:
            self.q[heights] = drawn + height
            self.forces()
            return self.weight + float(self.work.rail_force[:, :, 1].sum())

        if not lack_of_load(_HEIGHT_RANGE) > 0.0 > lack_of_load(-_HEIGHT_RANGE):
            loads = -self.work.rail_force[:, :, 1]
            wheelset, side = np.unravel_index(int(np.argmin(loads)), loads.shape)
            raise NoEquilibrium(
                f"no equilibrium for {self.vehicle.name}: its wheels do not meet the rails within "
                f"{_HEIGHT_RANGE * 1e3:g} mm of the drawing; so far down wheel {wheelset + 1}{'LR'[side]} "
                f"carries {loads[wheelset, side]:.3g} N, all {loads.sum():.3g} N of {self.weight:.3g} N"
            )
        self.q[heights] = drawn + brentq(lack_of_load, -_HEIGHT_RANGE, _HEIGHT_RANGE, xtol=1e-7)

    def _hang_on(self, unit: int) -> None:
        """Move a unit as a whole along the track to the balance of its drawbar and its coupler.

        Otherwise the first steps of the root search would make friction elements of the unit slide.
        """
        bodies = self.vehicle.bodies
        mine = [i for i, body in enumerate(bodies) if self.vehicle.unit_of(body.name) == unit]
        own = BODY_COORDINATES * np.array(mine)
        drawn = self.q[own].copy()

        def pull(change: float) -> float:
            self.q[own] = drawn + change
            return float(self.forces()[own].sum())

        here = pull(0.0)
        stiffness = (here - pull(LENGTH_SCALE)) / LENGTH_SCALE
        # a unit without drawbar and coupler is not moved
        self.q[own] = drawn + (here / stiffness if stiffness > 0.0 else 0.0)
