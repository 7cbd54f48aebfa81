"""The state of a vehicle that rolls straight ahead at constant speed in one place of its track.

The wheels roll, so the free coordinates of a wheelset's pitch and of the creepage are rates, not places. The
vehicle stands at a given place, so that of the place of the front coupler head's body is the train's, which
is left in `model.train.start`; of a driven vehicle it is the torque of its drives, alike for all, left in
`model.drives.torque`, while the train keeps its distance from the coupler head, and so its force.
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
from vehicles.start import start_middle

LENGTH_SCALE = 1e-3  # m and rad, of the way from the drawing to the equilibrium
_HEIGHT_RANGE = 5e-3  # m, in which the wheels meet the rails: profiles and track height differ by less
_DEFLECTION_GUESS = 2e-3  # m, of the track under a loaded wheel


class NoEquilibrium(RuntimeError):
    """No static equilibrium was found; the text says what force remains, and where."""


class Snapshot(NamedTuple):
    """Everything that is free of a rolling vehicle."""

    q: FloatArray
    v: FloatArray
    train: FloatArray  # `model.train.start`
    torque: FloatArray  # `model.drives.torque`


class RollingVehicle:
    """The state of a rolling vehicle, begun from its drawing.

    Attributes
    ----------
    q, v : coordinates and velocities (layout: `model`)
    still : velocities of all that has settled; those that are free are zero in it
    rates : numbers of the coordinates whose velocity is free and whose place is zero
    place : number of the coordinate that says where the vehicle stands; it keeps its value
    along : (3,) direction of the track there

    Raises
    ------
    NoEquilibrium
        The wheels do not meet the rails.
    """

    def __init__(self, vehicle: Vehicle, model: SystemModel, work: Workspace) -> None:
        self.vehicle, self.model, self.work = vehicle, model, work
        self.bundle = Bundle(model, work)
        self.sliders = np.zeros_like(work.new_sliders)
        self.driven = model.drives.torque.size > 0
        self.weight = float(model.weight.sum())
        middle = start_middle(vehicle)
        for i, wheelset in enumerate(vehicle.wheelsets):
            work.arc_length[i] = middle + vehicle.body(wheelset.body).position[0]
        work.arc_length[len(vehicle.wheelsets) :] = model.train.start
        self._rear = middle + min(point[0] for point in vehicle.coupler.points)
        self._start = model.train.start.copy()
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
        """Let the train of a driven vehicle keep its distance from the coupler head, after `forces`."""
        self.model.train.start[:] = self._start + self.work.arc_length[-1] - self._rear

    def settled(self) -> None:
        """Take off all velocities that a vehicle at rest does not have, and move it back to its place."""
        rates = self.v[self.rates].copy()
        self.v[:] = self.still
        self.v[self.rates] = rates
        moved = (self.q[self.place] - self._stands) / self.along[0]
        for axis in range(3):
            self.q[axis : first_track(self.model) : BODY_COORDINATES] -= moved * self.along[axis]
        self.model.train.start[:] -= moved * self.along[0]

    def snapshot(self) -> Snapshot:
        """A copy of all that is free."""
        return Snapshot(
            self.q.copy(), self.v.copy(), self.model.train.start.copy(), self.model.drives.torque.copy()
        )

    def restore(self, state: Snapshot) -> None:
        """Go back to a snapshot."""
        self.q[:], self.v[:] = state.q, state.v
        self.model.train.start[:], self.model.drives.torque[:] = state.train, state.torque

    def _draw(self, middle: float) -> None:
        """The drawing, deflected, lowered until the wheels carry the weight; all at the train's speed.

        On a gradient it is turned with the track; wheelsets stay at rotation angle zero about their axles.
        """
        vehicle, model = self.vehicle, self.model
        self.q, self.v = np.zeros(coordinates(model)), np.zeros(coordinates(model))
        track = _DEFLECTION_GUESS if model.flexible else 0.0
        *origin, _, pitch, _, _, _ = inclined_frame(model.alignment, middle)
        speed = model.train.speed / math.cos(pitch)  # the train's counts in plan
        turn = np.empty((3, 3))
        inclined_rotation(0.0, pitch, 0.0, turn)
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
        """Move a unit as a whole along the track, to where its drawbar and its coupler hold it.

        The friction between its bodies would give way on the solver's first steps, if that were left to them.
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
        # a unit that nothing holds stays
        self.q[own] = drawn + (here / stiffness if stiffness > 0.0 else 0.0)
