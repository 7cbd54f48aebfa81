"""Static equilibrium of a vehicle that rolls straight ahead at constant speed, before the run."""

from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from hh_exudyn.contact.types import FloatArray
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.assembly import start_middle
from hh_exudyn.multibody.model import (
    BODY_COORDINATES,
    TRACK_COORDINATES,
    SystemModel,
    Workspace,
    coordinates,
)
from hh_exudyn.multibody.system import evaluate
from track.alignment import Alignment, track_frame
from vehicles.description import Vehicle

FORCE_TOLERANCE = 5.0  # N or N m, of any body, on weights of 1e4..1e6 N
_LENGTH_SCALE = 1e-3  # of the unknowns, m and rad
_FORCE_SCALE = 1e3  # residuals are in thousandths of the weight
_LOWERED = (0.05, 0.015, 0.08, 0.03, 0.12)  # m, first guesses of the deflection of the load springs
_CONTACT_GUESS = 0.1e-3  # m, approach under some 100 kN
_DEFLECTION_GUESS = 2e-3  # m, of the track under a loaded wheel


class Equilibrium(NamedTuple):
    """State at rest relative to the moving vehicle."""

    q: FloatArray  # coordinates
    v: FloatArray  # velocities
    sliders: FloatArray  # (couplings, SLIDERS) friction elements without vertical wedge friction
    train_lag: float  # m that the vehicle stays behind its train: coupler force over stiffness
    residual: float  # largest generalized force left over [N, N m]
    where: str  # the body it acts on


class NoEquilibrium(RuntimeError):
    """No static equilibrium was found; the text says how far off the best attempt was, and where."""


def equilibrium(vehicle: Vehicle, alignment: Alignment, model: SystemModel, work: Workspace) -> Equilibrium:
    """Solve for poses, rolling speeds and the force of the train on straight track.

    The wheels roll, so the unknown of a wheelset's pitch is its spin rate instead of its angle; the vehicle
    stands at a given place, so the unknown of the car body's place is the train's lag. Wedges carry no
    vertical friction, as after a long smooth ride; all other sliders rest where the drawing has them.

    Raises
    ------
    ValueError
        The track does not begin with a straight as long as the vehicle.
    NoEquilibrium
        A residual force above `FORCE_TOLERANCE` remains.
    """
    middle = start_middle(vehicle)
    front = middle + max(point[0] for point in vehicle.coupler.points)
    # straight so far, if heading and cant at the front are still zero
    _, _, _, heading, roll, _, _ = track_frame(alignment.table, front)
    if abs(heading) > 1e-6 or abs(roll) > 1e-6:
        raise ValueError(
            f"the track must begin with a straight of at least {front:.1f} m for vehicle {vehicle.name}: at "
            f"s = {front:.1f} m it has turned by {heading:.2g} rad and rolled by {roll:.2g} rad"
        )
    for place, wheelset in enumerate(vehicle.wheelsets):
        work.arc_length[place] = middle + vehicle.body(wheelset.body).position[0]
    work.arc_length[len(vehicle.wheelsets) :] = model.train.start
    best = _solve(vehicle, model, work, middle, _LOWERED[0])
    for lowered in _LOWERED[1:]:
        if best.residual <= FORCE_TOLERANCE:
            break
        attempt = _solve(vehicle, model, work, middle, lowered)
        best = attempt if attempt.residual < best.residual else best
    if not best.residual <= FORCE_TOLERANCE:
        raise NoEquilibrium(
            f"no equilibrium for {vehicle.name}: {best.residual:.3g} N (or N m) remains at {best.where}, "
            f"allowed {FORCE_TOLERANCE:g}"
        )
    return best


def _solve(
    vehicle: Vehicle, model: SystemModel, work: Workspace, middle: float, lowered: float
) -> Equilibrium:
    """One attempt from the drawing with the sprung bodies lowered by `lowered` [m]."""
    q, v = _guess(vehicle, model, middle, lowered)
    sliders = np.zeros_like(work.new_sliders)
    spins = [BODY_COORDINATES * int(i) + 4 for i in model.wheelsets]
    place = BODY_COORDINATES * model.train.body
    weight = float(model.mass.sum()) * GRAVITY
    start = model.train.start.copy()

    def forces(scaled: FloatArray) -> FloatArray:
        unknown = scaled * _LENGTH_SCALE
        q[:] = unknown
        q[spins] = 0.0
        v[spins] = unknown[spins]
        q[place] = middle
        model.train.start[:] = start + unknown[place]
        evaluate(model, work, sliders, q, v, 0.0, True)
        return work.generalized_force / weight * _FORCE_SCALE

    unknown = q.copy()
    unknown[spins] = v[spins]
    unknown[place] = 0.0
    solution = least_squares(forces, unknown / _LENGTH_SCALE, method="lm", xtol=1e-14, ftol=1e-14, gtol=1e-14)
    force = np.abs(forces(solution.x)) * weight / _FORCE_SCALE
    model.train.start[:] = start
    worst = int(np.argmax(force))
    body = worst // BODY_COORDINATES
    return Equilibrium(
        q.copy(),
        v.copy(),
        work.new_sliders.copy(),
        float(solution.x[place] * _LENGTH_SCALE),
        float(force[worst]),
        vehicle.bodies[body].name if body < len(vehicle.bodies) else "the track",
    )


def _guess(
    vehicle: Vehicle, model: SystemModel, middle: float, sprung: float
) -> tuple[FloatArray, FloatArray]:
    """Drawing lowered by rough deflections, all at the train's speed."""
    q = np.zeros(coordinates(model))
    v = np.zeros(coordinates(model))
    track = _DEFLECTION_GUESS if model.flexible else 0.0
    lowered = {"wheelset": _CONTACT_GUESS, "side_frame": 1e-3, "bolster": sprung, "car_body": sprung}
    for i, body in enumerate(vehicle.bodies):
        k = BODY_COORDINATES * i
        q[k : k + 3] = body.position
        q[k] += middle
        q[k + 2] -= lowered[body.kind] + track
        v[k] = model.train.speed
    for wheelset, i in zip(vehicle.wheelsets, model.wheelsets, strict=True):
        v[BODY_COORDINATES * int(i) + 4] = model.train.speed / wheelset.radius
    for k in range(BODY_COORDINATES * len(vehicle.bodies), q.size):
        vertical = (k - BODY_COORDINATES * len(vehicle.bodies)) % TRACK_COORDINATES in (1, 3, 5)
        q[k] = -track if vertical else 0.0
    return q, v
