"""`simulate(case, directory)`: equilibrium, time integration with Exudyn, logs on disk."""

import gc
import math
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import exudyn as exu

from hh_exudyn.arrays import FloatArray
from hh_exudyn.case import Case
from hh_exudyn.kernel import Bundle
from hh_exudyn.log.recorder import Recorder
from hh_exudyn.log.store import Run, open_run, write_case, write_status, write_vehicle
from hh_exudyn.multibody.assembly import assemble, explicit_settings, exudyn_system
from hh_exudyn.multibody.control import VehicleControl, vehicle_control
from hh_exudyn.multibody.equilibrium import Equilibrium, equilibrium
from hh_exudyn.multibody.interruption import Interruption
from hh_exudyn.multibody.linear.stability import require_stable_step
from hh_exudyn.multibody.model import SystemModel, Workspace, workspace
from hh_exudyn.multibody.recording import LogWriter
from hh_exudyn.multibody.system import evaluate_bundle
from hh_exudyn.multibody.watch import REASONS, Trouble, look_bundle, watch_state, watched
from vehicles.description import Vehicle
from vehicles.stored import to_json

PROGRESS_INTERVAL = 0.2  # s of wall time between two calls of the progress function

Progress = Callable[[float, str], None]


class SimulationStopped(RuntimeError):
    """A run stopped before its end; the log up to then is complete.

    Attributes
    ----------
    reason : "derailment" or "divergence"
    wheel : "1L", "2R", ... or "" for the whole vehicle
    time : [s] since the start
    position : arc length of the leading wheelset in the last state without a fault [m]
    """

    def __init__(self, reason: str, detail: str, wheel: str, time: float, position: float) -> None:
        where = f"wheel {wheel}, " if wheel else ""
        super().__init__(f"{reason}: {detail} ({where}t = {time:.3f} s, s = {position:.2f} m)")
        self.reason = reason
        self.wheel = wheel
        self.time = time
        self.position = position


def simulate(
    case: Case,
    directory: Path | str,
    progress: Progress | None = None,
    *,
    vehicle: Vehicle | None = None,
) -> Run:
    """Run a case and write its logs into a new or empty directory.

    Parameters
    ----------
    case : vehicle, track, speed, contact and integration
    directory : for case.toml, vehicle.json, the logs and status.json; made if it does not exist
    progress : called every `PROGRESS_INTERVAL` with the fraction done (0..1) and a line of text
    vehicle : a description in place of the vehicle of the case

    Raises
    ------
    FileExistsError
        The directory is not empty; nothing was written.
    ValueError
        The vehicle does not fit its track, or the time step is too large; nothing was written.
    NoEquilibrium
        No static equilibrium at the start; nothing was written.
    SimulationStopped
        Derailment or divergence; the log up to then is complete.
    KeyboardInterrupt
        Ctrl-C; the log up to then is complete.
    """
    vehicle = vehicle or case.described_vehicle()
    model = assemble(vehicle, case)
    work = workspace(model)
    if progress is not None:
        progress(0.0, "static equilibrium (the first run also compiles the kernels)")
    control = vehicle_control(case, vehicle, model, work)
    start = clock.perf_counter()
    state = equilibrium(vehicle, model, work)
    require_stable_step(case.integration.step_ms * 1e-3, model, work, state)
    status: dict[str, Any] = {"finished": False, "reason": "running"}
    status["equilibrium_s"] = clock.perf_counter() - start
    if control is not None:
        status["curve_resistance_of_train"] = case.traction_or_default.curve_resistance

    names = {"body": [body.name for body in vehicle.bodies]}
    with Recorder(directory, {"case": case.to_toml()}, names=names) as recorder:
        write_case(directory, case.to_toml())
        write_vehicle(directory, to_json(vehicle))
        write_status(directory, status)
        log = LogWriter(vehicle, model, work, recorder)
        integration = _Integration(case, model, work, state, log, control)
        try:
            integration.run(case.alignment().length, progress)
            status.update(finished=True, reason="finished")
        except KeyboardInterrupt:
            status["reason"] = "interrupted"
            raise
        except Exception as error:
            status["reason"] = str(error)
            raise
        finally:
            status.update(integration.times, **integration.watched)
            write_status(directory, status)
    return open_run(directory)


@contextmanager
def _collector_paused() -> Iterator[None]:
    """Without Python's garbage collector: a step makes no cycles, and looking for them takes 4 % of a run."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


class _Integration:
    """The time integration of one run: Exudyn's callbacks, sliders, logging and the reasons to stop.

    Exudyn calls the force function several times a step. The first call of a step evaluates the last accepted
    state: sliders are committed and logs are written then, without an evaluation of their own.
    """

    def __init__(
        self,
        case: Case,
        model: SystemModel,
        work: Workspace,
        state: Equilibrium,
        log: LogWriter,
        control: VehicleControl | None,
    ) -> None:
        self._model = model
        self._work = work
        self._bundle = Bundle(model, work)
        self._state = state
        self._log = log
        self._control = control
        self._sliders = state.sliders.copy()
        self._watch = watch_state(model)
        self._watched = Bundle(work, self._watch)
        self._speed = case.speed
        self._step = case.integration.step_ms * 1e-3
        self._steps_per_output = round(case.integration.output_interval_ms / case.integration.step_ms)
        self._accepted = False  # Exudyn calls `_after_step` once before the first step
        self._steps = 0
        self._error: Exception | None = None
        self._interruption = Interruption()
        self._progress: Progress | None = None
        self._next_progress = 0.0
        self._duration = 0.0
        self._end = math.inf  # of the track, for the leading wheelset of a vehicle that drives itself
        self._position = 0.0  # of the leading wheelset in the last state without a fault
        self._kernel_time = 0.0
        self._callback_time = 0.0
        self.times: dict[str, float] = {}

    def run(self, track_length: float, progress: Progress | None) -> None:
        """Integrate for the time of the leading coupler head to the end of the track at the case's speed.

        The run of a driven vehicle ends earlier if it reaches the end of the track before.

        Parameters
        ----------
        track_length : [m]
        progress : as for `simulate`
        """
        self._progress = progress
        front = float(self._work.inputs.train_start.max())
        if self._control is not None:
            front = self._control.front
            self._end = track_length - (front - float(self._work.arc_length[0]))
        self._duration = (track_length - front) / self._speed
        mbs = exudyn_system(self._model, self._state.q, self._state.v, self._forces, self._after_step)
        settings = explicit_settings(self._duration, self._step)
        start = clock.perf_counter()
        # Exudyn prints that user functions allocate memory, which a Python function cannot avoid; failures
        # come as exceptions
        exu.config.printToConsole = False
        try:
            with self._interruption, _collector_paused():
                mbs.SolveDynamic(settings, showHints=False)
            if self._accepted and not self._interruption.wanted:
                self._forces(mbs, self._steps * self._step, 0, None, None)  # the last state, to log it too
        except Exception as error:
            # Exudyn reports an exception of a user function as its own failure: the original is raised below
            self._error = self._error or error
        finally:
            wall = clock.perf_counter() - start
            exu.config.printToConsole = True
            self.times = {
                "simulated_s": self._steps * self._step,
                "wall_s": wall,
                "kernel_s": self._kernel_time,
                "python_s": self._callback_time - self._kernel_time,
                "exudyn_s": wall - self._callback_time,
            }
        if self._interruption.wanted:
            raise KeyboardInterrupt
        if self._error is not None:
            raise self._error

    def _forces(self, mbs: Any, time: float, item: int, q: Any, q_t: Any) -> list[float]:
        """Exudyn's force function: one kernel call; it never raises, as Exudyn would hide the exception."""
        start = clock.perf_counter()
        # the same numbers as q and q_t, four times faster than these lists
        q = mbs.systemData.GetODE2Coordinates()
        v = mbs.systemData.GetODE2Coordinates_t()
        self._work.refine[0] = float(self._accepted and self._steps % self._steps_per_output == 0)
        kernel_start = clock.perf_counter()
        status = evaluate_bundle(self._bundle, self._sliders, q, v, time, False)
        self._kernel_time += clock.perf_counter() - kernel_start
        if self._accepted:
            self._accepted = False
            try:
                if self._commit(time, v, status):  # the actuators have moved: forces with the new inputs
                    evaluate_bundle(self._bundle, self._sliders, q, v, time, False)
            except Exception as error:
                self._error = error
        result: list[float] = self._work.generalized_force.tolist()  # read faster than an array
        self._callback_time += clock.perf_counter() - start
        return result

    @property
    def watched(self) -> dict[str, Any]:
        """Floored curvatures, chatter and climbing wheels (`watch.watched`)."""
        return watched(self._watch)

    def _commit(self, time: float, v: FloatArray, status: int) -> bool:
        """Commit the sliders of the accepted state, check it, log it, and call the controllers.

        Returns whether a controller has acted. Raises SimulationStopped on derailment or divergence.
        """
        self._sliders[:] = self._work.new_sliders
        if status:  # the contact kernel's: 1 + number of the wheel
            trouble, (wheelset, side) = Trouble.NOT_FINITE, divmod(status - 1, 2)
        else:
            trouble, wheelset, side = look_bundle(self._watched, self._step)
        if trouble:
            wheel = f"{wheelset + 1}{'LR'[side]}" if wheelset >= 0 else ""
            raise SimulationStopped(*REASONS[trouble], wheel, time, self._position)
        self._position = float(self._work.arc_length[0])
        if self._steps % self._steps_per_output == 0:
            self._log.write(time, v)
        if self._control is None or self._steps % self._control.steps_per_sample:
            return False
        self._control.act(time, self._log.recorder)
        return True

    def _after_step(self, mbs: Any, time: float) -> bool:
        """Exudyn's call after an accepted step; False ends the run."""
        self._accepted = True
        self._steps = round(time / self._step)
        if self._progress is not None:
            now = clock.perf_counter()
            if now >= self._next_progress:
                self._next_progress = now + PROGRESS_INTERVAL
                done = min(time / self._duration, 1.0)
                try:
                    self._progress(done, f"t = {time:.2f} s, s = {self._work.arc_length[0]:.1f} m")
                except Exception as error:
                    self._error = error
        return self._error is None and not self._interruption.wanted and self._position < self._end
