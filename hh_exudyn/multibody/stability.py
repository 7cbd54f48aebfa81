"""How large a time step may be: the explicit integration of the motion linearised about its equilibrium.

Beyond the limit an explicit method need not blow up: dry friction and saturated creep forces can hold it in a
false state that looks like a run. So the step is checked before the run, not by its looks.
"""

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.kernel import Bundle
from hh_exudyn.multibody.equilibrium import Equilibrium
from hh_exudyn.multibody.model import BODY_COORDINATES, SystemModel, Workspace, first_creep, first_track
from hh_exudyn.multibody.system import evaluate_bundle

LARGEST_STEP = 2e-3  # s, no step above it is looked for
MARGIN = 0.8  # of the limit at rest: two-point contact in a curve is stiffer than the tread on a straight
_DISPLACEMENT = 1e-7  # m and rad, of the numerical derivatives
_VELOCITY = 1e-6  # m/s and rad/s


def eigenvalues(model: SystemModel, work: Workspace, state: Equilibrium) -> NDArray[np.complex128]:
    """Eigenvalues [1/s] of the motion about an equilibrium, friction elements sticking.

    By central differences of the force kernel. The wheelsets' rotation about their axles is taken at angle
    zero, their gyroscopic moments are left out.
    """
    bundle = Bundle(model, work)
    n = state.q.size
    mass = np.ones(n)
    for i in range(model.mass.size):
        k = BODY_COORDINATES * i
        mass[k : k + 3] = model.mass[i]
        mass[k + 3 : k + 6] = model.inertia[i]
    if model.flexible:
        mass[first_track(model) : first_creep(model)] = np.tile(model.track_mass, len(model.wheelsets))

    def rate(dq: NDArray[np.float64], dv: NDArray[np.float64]) -> NDArray[np.float64]:
        evaluate_bundle(bundle, state.sliders, state.q + dq, state.v + dv, 0.0, False)
        return work.generalized_force / mass

    system = np.zeros((2 * n, 2 * n))
    system[:n, n:] = np.eye(n)
    zero = np.zeros(n)
    for j in range(n):
        step = np.zeros(n)
        step[j] = _DISPLACEMENT
        system[n:, j] = (rate(step, zero) - rate(-step, zero)) / (2 * _DISPLACEMENT)
        step[j] = _VELOCITY
        system[n:, n + j] = (rate(zero, step) - rate(zero, -step)) / (2 * _VELOCITY)
    return np.linalg.eigvals(system).astype(np.complex128)


def largest_stable_step(values: NDArray[np.complex128]) -> float:
    """Largest step [s] at which the classical Runge-Kutta method amplifies no eigenvector that decays.

    |1 + z + z^2/2 + z^3/6 + z^4/24| <= 1 with z = step * eigenvalue (Hairer, Norsett and Wanner 1993, II.1);
    eigenvectors that grow by themselves may grow as they do.
    """
    decaying = values[values.real < -1e-3 * np.abs(values)]
    steps = np.linspace(0.0, LARGEST_STEP, 401)[1:]
    z = steps[:, None] * decaying[None, :]
    growth = np.abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))))
    unstable = np.flatnonzero((growth > 1.0).any(axis=1))
    return float(steps[unstable[0] - 1]) if unstable.size and unstable[0] > 0 else LARGEST_STEP


def require_stable_step(step: float, model: SystemModel, work: Workspace, state: Equilibrium) -> None:
    """Raise ValueError if a time step [s] is above `MARGIN` of the largest stable one."""
    largest = MARGIN * largest_stable_step(eigenvalues(model, work, state))
    if step > largest:
        raise ValueError(
            f"integration.step_ms = {step * 1e3:g} ms: allowed up to {largest * 1e3:.2g} ms for this vehicle "
            f"at {model.train.speed * 3.6:g} km/h, where the explicit integration is stable"
        )
