"""Static equilibrium of a vehicle that rolls straight ahead at constant speed, before the run.

On a gradient the coupler force of the train balances the vehicle's weight times the sine of the slope; a
driven vehicle balances its own weight and its train's force by its drives. Unknowns and fixed quantities:
`rolling`.

A root search finds it in some hundredths of a second, unless it alternates between two places of contact on
a wheel's profile. Then the vehicle settles in time (`settling`), and the root search starts again from there,
within one branch of the force.
"""

import time
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import PLAIN_PYTHON_FACTOR
from hh_exudyn.multibody.model import SystemModel, Workspace
from hh_exudyn.multibody.remaining import remaining_force
from hh_exudyn.multibody.rolling import LENGTH_SCALE, NoEquilibrium, RollingVehicle
from hh_exudyn.multibody.settling import Settling
from vehicles.description import Vehicle

FORCE_TOLERANCE = 5.0  # N or N m, of any body, on weights of 1e4..1e6 N
# s of processor time without compilation: limit of all searches; share of it for the first root search
TIME_LIMIT = 6.0 * PLAIN_PYTHON_FACTOR
_SEARCH_LIMIT = 2.0 * PLAIN_PYTHON_FACTOR
_FIRST_SEARCH, _LAST_SEARCH = 50, 25  # steps of the root search; where it succeeds it takes 13 to 23
_SETTLING = (1.2, 2.0, 3.0, 4.0, 5.0)  # s of motion, after each of which the root search tries again
_NEAR = 0.01  # of the weight: residual below which a root search begins from a settled state
_FORCE_SCALE = 1e3  # residuals are in thousandths of the weight


class Equilibrium(NamedTuple):
    """Static equilibrium of the rolling vehicle."""

    q: FloatArray  # coordinates
    v: FloatArray  # velocities
    sliders: FloatArray  # (couplings, SLIDERS) friction elements without vertical wedge friction


class _OutOfTime(Exception):
    """Raised inside a root search at the end of its time."""


def equilibrium(vehicle: Vehicle, model: SystemModel, work: Workspace) -> Equilibrium:
    """Solve for poses, rolling speeds and the force of the train on straight track of one gradient.

    The force of the train is written as `Inputs.train_start`, the torques of a driven vehicle as
    `Inputs.drive_torque` of the work space. Wedges have no vertical friction, as after a long smooth ride;
    all other sliders are in their positions on the drawing.

    Parameters
    ----------
    vehicle, model : description, and its model on a track
    work : work space; its inputs are the start of the search, and then those of the equilibrium

    Raises
    ------
    NoEquilibrium
        A residual force above `FORCE_TOLERANCE` remains after `TIME_LIMIT`, or the wheels miss the rails.
    """
    rolling = RollingVehicle(vehicle, model, work)
    begun = time.thread_time()
    drawn = rolling.snapshot()
    if _balance(rolling, _FIRST_SEARCH, begun + _SEARCH_LIMIT):
        return _found(rolling)
    tried = [(_largest(rolling), rolling.snapshot())]
    rolling.restore(drawn)
    settling = Settling(rolling)
    for end in _SETTLING:
        whole = settling.run(end, begun + TIME_LIMIT)
        settled = rolling.snapshot()
        left = _largest(rolling)
        near = left < _NEAR * rolling.weight
        if near and _balance(rolling, _LAST_SEARCH, begun + TIME_LIMIT):
            return _found(rolling)
        rolling.restore(settled)
        tried.append((_largest(rolling), settled))
        if left <= FORCE_TOLERANCE:  # at rest in a state that the root search cannot reach
            return _found(rolling)
        if not whole:
            break
    rolling.restore(min(tried, key=lambda each: each[0])[1])
    speed = f"{model.train.speed * 3.6:g} km/h"
    raise NoEquilibrium(
        f"no equilibrium for {vehicle.name} at {speed}, not after {settling.time:.1f} s of "
        f"settling either: {remaining_force(rolling)}; allowed {FORCE_TOLERANCE:g}"
    )


def _largest(rolling: RollingVehicle) -> float:
    """The largest residual force; infinite where one is NaN."""
    force = float(np.abs(rolling.forces()).max())
    return force if np.isfinite(force) else np.inf


def _found(rolling: RollingVehicle) -> Equilibrium:
    return Equilibrium(rolling.q.copy(), rolling.v.copy(), rolling.work.new_sliders.copy())


def _balance(rolling: RollingVehicle, steps: int, deadline: float) -> bool:
    """Whether a root search from the present state finds the equilibrium; the state is then set to it."""
    rates, place, weight = rolling.rates, rolling.place, rolling.weight
    begun = rolling.snapshot()
    torque_scale = weight / max(rolling.inputs.drive_torque.size, 1)
    guess = rolling.q.copy()
    guess[rates] = rolling.v[rates]
    guess[place] = float(begun.torque[0]) / torque_scale if rolling.driven else 0.0

    def forces(change: FloatArray) -> FloatArray:
        if time.thread_time() > deadline:
            raise _OutOfTime
        unknown = guess + change * LENGTH_SCALE
        rolling.q[:] = unknown
        rolling.q[rates] = 0.0
        rolling.q[place] = begun.q[place]
        rolling.v[rates] = unknown[rates]
        if rolling.driven:
            rolling.inputs.drive_torque[:] = unknown[place] * torque_scale
            rolling.forces()  # for the position of the coupler head
            rolling.pull_as_before()
        else:
            rolling.inputs.train_start[:] = begun.train + unknown[place]
        return rolling.forces() / weight * _FORCE_SCALE

    # from zero change the trust region begins at one length scale: no step loses a one-sided contact
    try:
        found = least_squares(
            forces, np.zeros_like(guess), xtol=1e-13, ftol=1e-13, gtol=1e-13, max_nfev=steps
        )
        forces(found.x)
    except (_OutOfTime, ValueError):  # ValueError: a residual is not finite
        return False
    return _largest(rolling) <= FORCE_TOLERANCE
