"""Largest stable time step of the explicit integration, for the motion linearised about its equilibrium.

Beyond the limit an explicit method does not always diverge: dry friction and saturated creep forces can bound
it in a false state that looks like a run. So the step is checked before the run.
"""

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.multibody.equilibrium import Equilibrium
from hh_exudyn.multibody.linear.modes import linearise
from hh_exudyn.multibody.model import SystemModel, Workspace

LARGEST_STEP = 2e-3  # s, end of the search
MARGIN = 0.8  # of the limit at rest: two-point contact in a curve is stiffer than the tread on a straight


def eigenvalues(model: SystemModel, work: Workspace, state: Equilibrium) -> NDArray[np.complex128]:
    """Eigenvalues [1/s] of the motion about an equilibrium, friction elements sticking (`linear`).

    Parameters
    ----------
    model, work : constant model; inputs (those of the equilibrium) and work space
    state : the equilibrium
    """
    return np.linalg.eigvals(linearise(model, work, state).system).astype(np.complex128)


def largest_stable_step(values: NDArray[np.complex128]) -> float:
    """Largest step [s] at which the Runge-Kutta method of third order amplifies no eigenvector that decays.

    |1 + z + z^2/2 + z^3/6| <= 1 with z = step * eigenvalue (Hairer, Norsett and Wanner 1993, II.1);
    growing eigenvectors are not considered.

    Parameters
    ----------
    values : eigenvalues of the motion [1/s]
    """
    decaying = values[values.real < -1e-3 * np.abs(values)]
    steps = np.linspace(0.0, LARGEST_STEP, 401)[1:]
    z = steps[:, None] * decaying[None, :]
    growth = np.abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0)))
    unstable = np.flatnonzero((growth > 1.0).any(axis=1))
    return float(steps[unstable[0] - 1]) if unstable.size and unstable[0] > 0 else LARGEST_STEP


def require_stable_step(step: float, model: SystemModel, work: Workspace, state: Equilibrium) -> None:
    """Check a time step against the stability limit of the explicit integration.

    Parameters
    ----------
    step : [s]
    model, work : constant model; inputs (those of the equilibrium) and work space
    state : the equilibrium

    Raises
    ------
    ValueError
        The step is above `MARGIN` of the largest stable one.
    """
    largest = MARGIN * largest_stable_step(eigenvalues(model, work, state))
    if step > largest:
        raise ValueError(
            f"integration.step_ms = {step * 1e3:g} ms: allowed up to {largest * 1e3:.2g} ms for this vehicle "
            f"at {model.train.speed * 3.6:g} km/h, where the explicit integration is stable"
        )
