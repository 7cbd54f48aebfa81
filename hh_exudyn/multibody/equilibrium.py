"""Static equilibrium of a vehicle that rolls straight ahead at constant speed, before the run.

On a gradient the train holds the vehicle: the coupler force is its weight times the sine of the slope. A
driven vehicle holds itself and its train by its drives.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq, least_squares

from hh_exudyn.contact.types import FloatArray
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
from track.alignment import inclined_frame, inclined_rotation
from vehicles.description import Vehicle
from vehicles.start import start_middle

FORCE_TOLERANCE = 5.0  # N or N m, of any body, on weights of 1e4..1e6 N
_LENGTH_SCALE = 1e-3  # of the unknowns, m and rad
_FORCE_SCALE = 1e3  # residuals are in thousandths of the weight
_HEIGHT_RANGE = 5e-3  # m, in which the wheels meet the rails: profiles and track height differ by less
_DEFLECTION_GUESS = 2e-3  # m, of the track under a loaded wheel


class Equilibrium(NamedTuple):
    """State at rest relative to the moving vehicle."""

    q: FloatArray  # coordinates
    v: FloatArray  # velocities
    sliders: FloatArray  # (couplings, SLIDERS) friction elements without vertical wedge friction


class NoEquilibrium(RuntimeError):
    """No static equilibrium was found; the text says what force remains, and where."""


def equilibrium(vehicle: Vehicle, model: SystemModel, work: Workspace) -> Equilibrium:
    """Solve for poses, rolling speeds and the force of the train on straight track of one gradient.

    The wheels roll, so the unknowns of a wheelset's pitch and creep are rates, not places; the vehicle
    stands at a given place, so the unknown of the place of the front coupler head's body is that of the
    train, which is left in `model.train.start`; of a driven vehicle it is the torque of its drives, alike for
    all, left in `model.drives.torque`, while the train keeps its distance from the coupler head, and so its
    force. Wedges carry no vertical friction, as after a long smooth
    ride; all other sliders rest where the drawing has them.

    Raises
    ------
    NoEquilibrium
        A residual force above `FORCE_TOLERANCE` remains.
    """
    middle = start_middle(vehicle)
    for place, wheelset in enumerate(vehicle.wheelsets):
        work.arc_length[place] = middle + vehicle.body(wheelset.body).position[0]
    work.arc_length[len(vehicle.wheelsets) :] = model.train.start
    q, v = _guess(vehicle, model, work, middle)
    sliders = np.zeros_like(work.new_sliders)
    bundle = Bundle(model, work)
    spins = [BODY_COORDINATES * int(i) + 4 for i in model.wheelsets]
    place = BODY_COORDINATES * int(model.train.bodies[0])
    stands = q[place]
    weight = float(model.weight.sum())
    start = model.train.start.copy()
    guess = q.copy()
    guess[spins] = v[spins]
    guess[place] = 0.0
    creep = np.arange(first_creep(model), guess.size)
    driven = model.drives.torque.size > 0
    rear = middle + min(point[0] for point in vehicle.coupler.points)
    torque_scale = weight / max(model.drives.torque.size, 1)

    def forces(change: FloatArray) -> FloatArray:
        unknown = guess + change * _LENGTH_SCALE
        q[:] = unknown
        q[spins] = 0.0
        q[creep] = 0.0
        v[spins] = unknown[spins]
        v[creep] = unknown[creep]
        q[place] = stands
        if driven:
            model.drives.torque[:] = unknown[place] * torque_scale
            evaluate_bundle(bundle, sliders, q, v, 0.0, True)  # where the heads are, to pull as before
            model.train.start[:] = start + work.arc_length[-1] - rear
        else:
            model.train.start[:] = start + unknown[place]
        evaluate_bundle(bundle, sliders, q, v, 0.0, True)
        return work.generalized_force / weight * _FORCE_SCALE

    # from zero change the trust region begins at one length scale: no step loses a one-sided contact
    solution = least_squares(forces, np.zeros_like(guess), method="trf", xtol=1e-13, ftol=1e-13, gtol=1e-13)
    force = np.abs(forces(solution.x)) * weight / _FORCE_SCALE
    worst = int(np.argmax(force))
    body = worst // BODY_COORDINATES
    if not force[worst] <= FORCE_TOLERANCE:
        where = vehicle.bodies[body].name if body < len(vehicle.bodies) else "the track"
        raise NoEquilibrium(
            f"no equilibrium for {vehicle.name}: {force[worst]:.3g} N (or N m) remains at {where}, allowed "
            f"{FORCE_TOLERANCE:g}"
        )
    return Equilibrium(q.copy(), v.copy(), work.new_sliders.copy())


def _guess(
    vehicle: Vehicle, model: SystemModel, work: Workspace, middle: float
) -> tuple[FloatArray, FloatArray]:
    """The drawing, deflected, lowered until the wheels carry the weight; all at the train's speed.

    On a gradient it is turned with the track; wheelsets stay at rotation angle zero about their axles.
    """
    q = np.zeros(coordinates(model))
    v = np.zeros(coordinates(model))
    track = _DEFLECTION_GUESS if model.flexible else 0.0
    *origin, _, pitch, _, _, _ = inclined_frame(model.alignment, middle)
    speed = model.train.speed / math.cos(pitch)  # the train's counts in plan
    turn = np.empty((3, 3))
    inclined_rotation(0.0, pitch, 0.0, turn)
    for i, body in enumerate(vehicle.bodies):
        k = BODY_COORDINATES * i
        q[k : k + 3] = origin + turn @ (np.array(body.position) - [0.0, 0.0, body.deflection + track])
        q[k + 4] = pitch
        v[k : k + 3] = speed * turn[:, 0]
    for wheelset, i in zip(vehicle.wheelsets, model.wheelsets, strict=True):
        v[BODY_COORDINATES * int(i) + 4] = speed / wheelset.radius
    if model.flexible:
        for k in range(first_track(model), first_creep(model)):
            vertical = (k - first_track(model)) % TRACK_COORDINATES in (1, 3, 5)
            q[k] = -track if vertical else 0.0
    bundle = Bundle(model, work)
    heights = np.arange(2, first_track(model), BODY_COORDINATES)
    sliders = np.zeros_like(work.new_sliders)

    def lack_of_load(height: float) -> float:
        moved = q.copy()
        moved[heights] += height
        evaluate_bundle(bundle, sliders, moved, v, 0.0, True)
        return float(model.weight.sum()) + float(work.rail_force[:, :, 1].sum())

    if not lack_of_load(-_HEIGHT_RANGE) < 0.0 < lack_of_load(_HEIGHT_RANGE):
        raise NoEquilibrium(
            f"no equilibrium for {vehicle.name}: its wheels do not meet the rails within "
            f"{_HEIGHT_RANGE * 1e3:g} mm of the drawing"
        )
    q[heights] += brentq(lack_of_load, -_HEIGHT_RANGE, _HEIGHT_RANGE, xtol=1e-7)
    for unit in vehicle.units[1:]:
        _hang_on(vehicle, unit, model, work, q, v)
    return q, v


def _hang_on(
    vehicle: Vehicle, unit: int, model: SystemModel, work: Workspace, q: FloatArray, v: FloatArray
) -> None:
    """Move a unit as a whole along the track, to where its drawbar and its coupler hold it.

    The friction between its bodies would give way on the solver's first steps, if that were left to them.
    """
    mine = [i for i, body in enumerate(vehicle.bodies) if vehicle.unit_of(body.name) == unit]
    own = BODY_COORDINATES * np.array(mine)
    bundle = Bundle(model, work)
    sliders = np.zeros_like(work.new_sliders)

    def pull(change: float) -> float:
        moved = q.copy()
        moved[own] += change
        evaluate_bundle(bundle, sliders, moved, v, 0.0, True)
        return float(work.generalized_force[own].sum())

    here = pull(0.0)
    stiffness = (here - pull(_LENGTH_SCALE)) / _LENGTH_SCALE
    if stiffness > 0.0:  # a unit that nothing holds stays
        q[own] += here / stiffness
