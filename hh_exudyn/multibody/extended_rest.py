"""Rest of a rolling vehicle with an extension, before the run: Exudyn settles it in time.

The system moves from the equilibrium without the extension (or from the drawing, where there is none) at a
fixed place of the track, as in `settling`: coordinates are those of the vehicle, velocities those beside the
common one, and after every step all of them but the wheels' rolling decay by a rate. The train follows the
force along the track. Items between the vehicle and the ground would see it stand still: they do not belong
into an extension.
"""

import math
from typing import Any

import exudyn as exu
import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.case import Case
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.extension import Extension, add_to_places, begin_from, coordinates_of
from hh_exudyn.multibody.exudyn_system import ExudynSystem, explicit_settings, exudyn_system
from hh_exudyn.multibody.linear.stability import require_stable_step
from hh_exudyn.multibody.model import BODY_COORDINATES, SystemModel, Workspace, first_track
from hh_exudyn.multibody.rolling import NoEquilibrium, RollingVehicle
from hh_exudyn.multibody.settling import DAMPING_RATE, FARTHEST
from vehicles.description import Vehicle

SPEED_TOLERANCE = 1e-5  # m/s and rad/s, of every coordinate at rest: 4 N left on a car body of 30 t
WHEELSET_DAMPING_RATE = 100.0  # 1/s; so slow, wheelsets settle where they would hunt
LONGEST = 20.0  # s of settling
_CHUNK = 0.25  # s between two looks at the velocities


def start_of_run(
    case: Case, vehicle: Vehicle, model: SystemModel, work: Workspace, extension: Extension | None
) -> tuple[dict[str, FloatArray], FloatArray]:
    """State of the system (`extension.begin_from`) and sliders at the start of a run.

    Parameters
    ----------
    case : its time step is checked
    vehicle, model : description, and its model on a track
    work : its inputs are set to those of the start
    extension : adds its items to the system, or None

    Raises
    ------
    ValueError
        The time step is too large for the vehicle without its extension.
    NoEquilibrium
        The vehicle does not come to rest.
    """
    step = case.integration.step_ms * 1e-3
    inputs = [array.copy() for array in work.inputs]
    start: dict[str, FloatArray] | None = None
    try:
        state = equilibrium(vehicle, model, work)
        require_stable_step(step, model, work, state)
        start = {"q": state.q, "v": state.v}
        if extension is None:
            return start, state.sliders
    except NoEquilibrium:  # it may need the extension to stand
        if extension is None:
            raise
        for array, before in zip(work.inputs, inputs, strict=True):
            array[...] = before
    return extended_rest(vehicle, model, work, start, extension, step), work.new_sliders.copy()


def extended_rest(
    vehicle: Vehicle,
    model: SystemModel,
    work: Workspace,
    start: dict[str, FloatArray] | None,
    extension: Extension,
    step: float,
) -> dict[str, FloatArray]:
    """The state in which a vehicle with an extension rolls without change, for `extension.begin_from`.

    Parameters
    ----------
    vehicle, model : description, and its model on a track
    work : its inputs are set to those of the rest; it then holds the evaluation there
    start : coordinates and velocities of the vehicle's equilibrium, None to begin at the drawing
    extension : adds its items
    step : of the integration [s]

    Raises
    ------
    NoEquilibrium
        The system does not come to rest within `LONGEST`.
    """
    settling = _Settling(vehicle, model, work, start, extension, step)
    exu.config.printToConsole = False
    try:
        while settling.fastest() > SPEED_TOLERANCE:
            if settling.time >= LONGEST or not settling.near():
                raise NoEquilibrium(
                    f"no equilibrium for {vehicle.name} with its extension: after {settling.time:.1f} s of "
                    f"settling {settling.place()} still moves at {settling.fastest():.3g} m/s or rad/s; "
                    f"allowed {SPEED_TOLERANCE:g}"
                )
            settling.go_on()
    finally:
        exu.config.printToConsole = True
    return settling.rest()


class _Settling:
    """The damped motion of the system; one Exudyn system for each chunk of time."""

    def __init__(
        self,
        vehicle: Vehicle,
        model: SystemModel,
        work: Workspace,
        start: dict[str, FloatArray] | None,
        extension: Extension,
        step: float,
    ) -> None:
        self._rolling = rolling = RollingVehicle(vehicle, model, work)
        if start is not None:
            rolling.q[:], rolling.v[:] = start["q"], start["v"]
        self._vehicle, self._model, self._extension = vehicle, model, extension
        self._drawn, self._common = rolling.q.copy(), rolling.v.copy()
        self._state = {"q": rolling.q.copy(), "v": np.zeros_like(rolling.v)}
        self._damped = np.ones(rolling.v.size, dtype=bool)
        self._damped[rolling.rates] = False
        rate = np.full(rolling.v.size, DAMPING_RATE)
        for i in model.wheelsets:
            rate[BODY_COORDINATES * i : BODY_COORDINATES * (i + 1)] = WHEELSET_DAMPING_RATE
        rate[rolling.rates] = 0.0
        self._decay, self._further_decay = np.exp(-rate * step), math.exp(-DAMPING_RATE * step)
        self._step = step
        self._steps = 0
        self._system: ExudynSystem | None = None
        self._before: FloatArray = rolling.q.copy()  # all coordinates at the begin of the last chunk

    @property
    def time(self) -> float:
        """Since the start of the motion [s]."""
        return self._steps * self._step

    def fastest(self) -> float:
        """Largest velocity of a coordinate that comes to rest; infinite before the first chunk."""
        return math.inf if self._system is None else float(self._velocities().max())

    def place(self) -> str:
        """The body of that coordinate, in words."""
        number = int(self._velocities().argmax())
        body = number // BODY_COORDINATES
        if body < len(self._vehicle.bodies):
            return self._vehicle.bodies[body].name
        own = self._damped.size
        return f"coordinate {number - own} of the extension" if number >= own else "the track"

    def _velocities(self) -> FloatArray:
        """Means over the last chunk of all coordinates that come to rest, without sign; zero for the others.

        Light parts of an extension ring for ever with the last digits of the contact forces.
        """
        v: FloatArray = np.abs(self._state["q"] - self._before) / _CHUNK
        v[: self._damped.size][~self._damped] = 0.0
        return v

    def near(self) -> bool:
        """Whether every body is near to its place."""
        moved = self._state["q"][: self._damped.size] - self._drawn
        return bool(np.abs(moved[self._damped]).max() < FARTHEST)

    def go_on(self) -> None:
        """Move on by a chunk of time."""
        last = self._steps + round(_CHUNK / self._step)
        settings = explicit_settings(self._steps, last, self._step)
        state = self._state
        model, vehicle, q, v = self._model, self._vehicle, state["q"], state["v"]
        system = exudyn_system(model, vehicle, q, v, self._forces, self._after_step, settings, placed=True)
        self._system = system
        self._extension(system)
        system.mbs.Assemble()
        begin_from(system, state, np.zeros(3))
        self._before = system.mbs.systemData.GetODE2Coordinates(exu.ConfigurationType.Initial)
        self._before[: system.reference.size] += system.reference
        try:
            system.mbs.SolveDynamic(settings, showHints=False)
        except Exception as error:  # Exudyn's own failure: the coordinates are no longer numbers
            raise NoEquilibrium(
                f"no equilibrium with the extension: {' '.join(str(error).split())}"
            ) from None
        self._state = coordinates_of(system)
        self._steps = last

    def rest(self) -> dict[str, FloatArray]:
        """The state at rest, with everything in it rolling along."""
        rolling, own = self._rolling, self._damped.size
        state = dict(self._state)
        q, v = state["q"], state["v"]
        q[rolling.rates] = self._drawn[rolling.rates]
        moved = (q[rolling.place] - self._drawn[rolling.place]) / rolling.along[0]
        for axis in range(3):
            q[axis : first_track(self._model) : BODY_COORDINATES] -= moved * rolling.along[axis]
        rolling.inputs.train_start[:] -= moved * rolling.along[0]
        v[:own][self._damped] = 0.0
        v[:own] += self._common
        v[own:] = 0.0
        rolling.q[:], rolling.v[:] = q[:own], v[:own]
        rolling.forces()  # for the sliders of friction elements, as they stand now
        assert self._system is not None
        add_to_places(self._system.mbs, own, q, -moved * rolling.along)
        add_to_places(self._system.mbs, own, v, self._common[:3])
        return state

    def _forces(self, mbs: Any, time: float, item: int, _: Any, __: Any) -> list[float]:
        """Exudyn's force function: the vehicle at its place, with the common velocity added."""
        rolling, own = self._rolling, self._damped.size
        assert self._system is not None
        rolling.q[:] = mbs.systemData.GetODE2Coordinates()[:own] + self._system.reference
        rolling.q[rolling.rates] = self._drawn[rolling.rates]
        rolling.v[:] = self._common + mbs.systemData.GetODE2Coordinates_t()[:own]
        result: list[float] = rolling.forces().tolist()
        return result

    def _after_step(self, mbs: Any, time: float) -> bool:
        """Damp every velocity but the wheels' rolling, and let the train follow."""
        v = mbs.systemData.GetODE2Coordinates_t()
        own = self._damped.size
        v[:own] *= self._decay
        v[own:] *= self._further_decay
        mbs.systemData.SetODE2Coordinates_t(v)
        self._rolling.follow(self._step)
        return True
