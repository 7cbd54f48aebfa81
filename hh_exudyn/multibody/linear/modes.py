"""Linear analysis: modes about the equilibrium, root locus over speed, and the linear critical speed.

The motion is linearised by central differences of the force kernel about the static equilibrium of the
rolling vehicle, with the gyroscopic moments of its wheelsets (`inertia`). The coordinates of a wheelset are
those of the frame that follows its axle and does not spin. Friction elements stick everywhere: for a vehicle
with friction elements, such as three-piece bogies, the critical speed is that of infinitesimal motions;
`nonlinear_speed` gives the speed below which large motions decay.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.optimize import linear_sum_assignment

from hh_exudyn.arrays import ComplexArray, FloatArray
from hh_exudyn.case import Case
from hh_exudyn.contact.friction import constant_friction
from hh_exudyn.kernel import Bundle
from hh_exudyn.multibody.assembly import assemble, shortest_transition
from hh_exudyn.multibody.equilibrium import Equilibrium, equilibrium
from hh_exudyn.multibody.linear.inertia import gyroscopic_moments, masses
from hh_exudyn.multibody.model import (
    BODY_COORDINATES,
    SystemModel,
    Workspace,
    first_creep,
    first_track,
    workspace,
)
from hh_exudyn.multibody.system import evaluate_bundle
from vehicles.description import Vehicle

LOWEST_FREQUENCY = 0.05  # Hz; below it lie the train's spring and motions without a restoring force
HIGHEST_FREQUENCY = 50.0  # Hz; above it lie the contact springs, and rails on the lag of the creepage
STRAIGHT_LENGTH = 10e3  # m, of the straight track of this analysis
OVERDAMPED = 0.95  # damping ratio from which a mode counts as no oscillation
_DISPLACEMENT = 1e-7  # m and rad, of the numerical derivatives
_VELOCITY = 1e-6  # m/s and rad/s
_NOT_GROWING = 1e-6  # of |eigenvalue|: smaller growth is round-off of an undamped mode
DIRECTIONS = ("x", "y", "z", "roll", "pitch", "yaw")  # of a body, in the order of its coordinates
_SPEED_TOLERANCE = 1e-3  # m/s, of the critical speed


class Linearisation(NamedTuple):
    """M q'' = -K q - C q' about an equilibrium; the layout of the coordinates is that of `model`."""

    mass: FloatArray  # (n,) of the diagonal matrix M [kg], [kg m^2]; 1 for the creep coordinates
    stiffness: FloatArray  # (n, n)
    damping: FloatArray  # (n, n), creep forces and gyroscopic moments included

    @property
    def system(self) -> FloatArray:
        """The matrix (2n, 2n) of the first-order system in (q, q')."""
        n = self.mass.size
        result = np.zeros((2 * n, 2 * n))
        result[:n, n:] = np.eye(n)
        result[n:, :n] = -self.stiffness / self.mass[:, None]
        result[n:, n:] = -self.damping / self.mass[:, None]
        return result


def linearise(model: SystemModel, work: Workspace, state: Equilibrium) -> Linearisation:
    """Mass, stiffness and damping about an equilibrium.

    Parameters
    ----------
    model, work : constant model; inputs (those of the equilibrium) and work space
    state : the equilibrium
    """
    bundle = Bundle(model, work)
    n = state.q.size

    def force(dq: FloatArray, dv: FloatArray) -> FloatArray:
        evaluate_bundle(bundle, state.sliders, state.q + dq, state.v + dv, 0.0, False)
        return work.generalized_force.copy()

    stiffness, damping = np.empty((n, n)), np.empty((n, n))
    zero = np.zeros(n)
    for j in range(n):
        step = np.zeros(n)
        step[j] = _DISPLACEMENT
        stiffness[:, j] = (force(-step, zero) - force(step, zero)) / (2 * _DISPLACEMENT)
        step[j] = _VELOCITY
        damping[:, j] = (force(zero, -step) - force(zero, step)) / (2 * _VELOCITY)
    return Linearisation(masses(model), stiffness, damping + gyroscopic_moments(model, state.v))


@dataclass(frozen=True)
class Mode:
    """One oscillating mode.

    Attributes
    ----------
    eigenvalue : complex
        With positive imaginary part [1/s].
    shape : (bodies, 6) complex array
        Of every body three displacements in the axes of the track and three small rotations; the largest
        displacement of a body's centre, or rotation times 1 m, is 1.
    """

    eigenvalue: complex
    shape: ComplexArray

    @property
    def frequency(self) -> float:
        """Of the oscillation [Hz]."""
        return self.eigenvalue.imag / (2 * math.pi)

    @property
    def damping_ratio(self) -> float:
        """Of critical damping [-]; negative for a mode that grows."""
        return -self.eigenvalue.real / abs(self.eigenvalue)

    def largest(self, names: Sequence[str]) -> str:
        """Body and direction of the largest motion, e.g. "car_body y" or "bogie_1 pitch".

        Parameters
        ----------
        names : of the bodies
        """
        body, axis = np.unravel_index(int(np.argmax(np.abs(self.shape))), self.shape.shape)
        return f"{names[int(body)]} {DIRECTIONS[int(axis)]}"


class LinearVehicle:
    """A vehicle on smooth level straight track with rails and gauge of a case, to be linearised at any speed.

    Parameters
    ----------
    vehicle, case : description of the vehicle, and its track; the speed of the case is not used

    Raises
    ------
    ValueError
        The vehicle does not fit its track.
    """

    def __init__(self, vehicle: Vehicle, case: Case) -> None:
        self.vehicle = vehicle
        self.names = [body.name for body in vehicle.bodies]
        self._model = assemble(vehicle, _straight(case))

    @property
    def on_friction(self) -> bool:
        """Whether the vehicle has friction elements, which stick in the linear analysis."""
        return any(getattr(coupling, "friction", 0.0) > 0.0 for coupling in self.vehicle.couplings)

    def at(self, speed: float, step: float = 0.0) -> tuple[SystemModel, Workspace, Equilibrium]:
        """Model, work space and equilibrium at a speed [m/s]; with a time step [s], as in a run.

        Raises NoEquilibrium where there is none.

        Parameters
        ----------
        speed : [m/s]
        step : time step of a run, on which the lag of its creepage depends; 0 for the exact motion [s]
        """
        model = self._model._replace(
            train=self._model.train._replace(speed=speed),
            shortest_transition=shortest_transition(speed, step),
        )
        work = workspace(model)
        return model, work, equilibrium(self.vehicle, model, work)

    def modes(self, speed: float, *, undamped: bool = False, step: float = 0.0) -> list[Mode]:
        """Oscillating modes by frequency, from `LOWEST_FREQUENCY` to `HIGHEST_FREQUENCY`.

        Parameters
        ----------
        speed : [m/s], > 0
        undamped : dampers, creep and gyroscopic moments off: the structure on rails without friction
        step : time step of a run, on which the lag of its creepage depends; 0 for the exact motion [s]

        Raises
        ------
        NoEquilibrium
            There is no equilibrium at that speed.
        """
        model, work, state = self.at(speed, step)
        if undamped:
            model = _without_creep(model)
        found = linearise(model, work, state)
        bodies = first_track(model)
        values, vectors = _oscillations(found, first_creep(model) if undamped else None)
        low, high = (2 * math.pi * f for f in (LOWEST_FREQUENCY, HIGHEST_FREQUENCY))
        chosen = [
            Mode(complex(value), _scaled(vector[:bodies].reshape(-1, BODY_COORDINATES)))
            for value, vector in zip(values, vectors.T, strict=True)
            if low <= value.imag <= high and -value.real < OVERDAMPED * abs(value)
        ]
        return sorted(chosen, key=lambda mode: mode.eigenvalue.imag)

    def growth(self, speed: float, step: float = 0.0) -> tuple[float, Mode]:
        """Negative damping ratio of the least damped oscillating mode at a speed [m/s], and that mode.

        Parameters
        ----------
        speed : [m/s]
        step : time step as for `modes` [s]
        """
        mode = min(self.modes(speed, step=step), key=lambda mode: mode.damping_ratio)
        return -mode.damping_ratio, mode


@dataclass(frozen=True)
class CriticalSpeed:
    """Critical speed of a vehicle [m/s] and its unstable mode."""

    speed: float
    mode: Mode


def critical_speed(
    linear: LinearVehicle, low: float = 5.0, high: float = 120.0, step: float = 5.0
) -> CriticalSpeed | None:
    """Lowest speed between `low` and `high` [m/s] at which an oscillating mode begins to grow.

    Search in steps of `step` [m/s], then bisection to 1 mm/s; an unstable range narrower than a step can be
    missed. None where the vehicle is stable up to `high`; `low` where it is already unstable there.

    Parameters
    ----------
    linear : the vehicle on its straight track
    low, high : range of the search [m/s]
    step : of the search [m/s]

    Raises
    ------
    ValueError
        Unless 0 < low < high and step > 0.
    """
    if not (0.0 < low < high and step > 0.0):
        raise ValueError(
            f"speeds from {low} to {high} m/s in steps of {step} m/s: needed 0 < low < high, step > 0"
        )
    stable = low
    growth, mode = linear.growth(low)
    if growth > _NOT_GROWING:
        return CriticalSpeed(low, mode)
    while True:
        if stable >= high:
            return None
        unstable = min(stable + step, high)
        growth, mode = linear.growth(unstable)
        if growth > _NOT_GROWING:
            break
        stable = unstable
    while unstable - stable > _SPEED_TOLERANCE:
        middle = 0.5 * (stable + unstable)
        growth, at_middle = linear.growth(middle)
        if growth > _NOT_GROWING:
            unstable, mode = middle, at_middle
        else:
            stable = middle
    return CriticalSpeed(unstable, mode)


def root_locus(linear: LinearVehicle, speeds: Sequence[float]) -> ComplexArray:
    """Eigenvalues [1/s] of the oscillating modes over speed, one column a mode; NaN at speeds without it.

    Modes at successive speeds are matched by the least sum of distances between eigenvalues; steps of the
    speed must be small enough for the distance between modes.

    Parameters
    ----------
    linear : the vehicle on its straight track
    speeds : [m/s]
    """
    columns: list[list[complex]] = []
    for k, speed in enumerate(speeds):
        values = np.array([mode.eigenvalue for mode in linear.modes(speed)])
        last = np.array([column[-1] for column in columns], dtype=complex)
        alive = np.flatnonzero(~np.isnan(last))
        ways = np.abs(last[alive][:, None] - values[None, :])
        rows, found = linear_sum_assignment(ways) if ways.size else (np.array([], int), np.array([], int))
        for column in columns:
            column.append(complex(math.nan, math.nan))
        for row, j in zip(rows, found, strict=True):
            columns[alive[row]][-1] = complex(values[j])
        for j in sorted(set(range(values.size)) - set(found.tolist())):
            columns.append([complex(math.nan, math.nan)] * k + [complex(values[j])])
    return np.array(columns, dtype=complex).T


def _oscillations(found: Linearisation, springs: int | None) -> tuple[ComplexArray, ComplexArray]:
    """Eigenvalues and eigenvectors (columns, coordinates first).

    With `springs` those of that number of coordinates alone, without dampers; the others are creep
    coordinates.
    """
    if springs is None:
        values, vectors = np.linalg.eig(found.system)
        return values.astype(complex), vectors.astype(complex)
    matrix = found.stiffness[:springs, :springs] / found.mass[:springs, None]
    squares, vectors = np.linalg.eig(matrix)
    return 1j * np.sqrt(np.maximum(squares.real, 0.0)), vectors.astype(complex)


def _straight(case: Case) -> Case:
    """The case on smooth level straight track of the gauge and rails at its start."""
    first = {"kind": "straight", "gauge_mm": 1e3 * float(case.alignment().table.gauge[0])}
    if case.track.sections is not None:
        rails = case.track.sections[0].model_dump(include={"rail", "rail_left", "rail_right"})
        first |= {key: name for key, name in rails.items() if name is not None}
    track = {
        "sections": [{**first, "length_m": STRAIGHT_LENGTH}],
        "grades": (),
        "alignment": None,
        "centre_line": None,
        "alignment_mirrored": False,
        "irregularity": "none",
    }
    return case.with_changes(track=track)


def _without_creep(model: SystemModel) -> SystemModel:
    """The model on rails without friction, given creep coefficients included."""
    frictionless = constant_friction(np.zeros((len(model.wheelsets), 2)))
    contact = model.wheel_rail
    return model._replace(
        friction=frictionless,
        wheel_rail=contact._replace(given=contact.given._replace(longitudinal=0.0, lateral=0.0)),
    )


def _scaled(shape: ComplexArray) -> ComplexArray:
    """The shape with its largest number 1, and real."""
    return shape / shape.flat[int(np.argmax(np.abs(shape)))]
