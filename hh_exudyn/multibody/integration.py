"""The time integration of one run: Exudyn's callbacks, sliders, logging and the reasons to stop."""

import gc
import math
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import Any

import exudyn as exu

from hh_exudyn.arrays import FloatArray
from hh_exudyn.case import Case
from hh_exudyn.kernel import Bundle
from hh_exudyn.multibody.checkpoint import SEGMENT, STORE_INTERVAL, Checkpoint, flat
from hh_exudyn.multibody.control import VehicleControl
from hh_exudyn.multibody.extension import Extension, begin_from, coordinates_of
from hh_exudyn.multibody.exudyn_system import ExudynSystem, explicit_settings, exudyn_system, whole_steps
from hh_exudyn.multibody.interruption import Interruption
from hh_exudyn.multibody.model import SystemModel, Workspace
from hh_exudyn.multibody.recording import LogWriter
from hh_exudyn.multibody.system import evaluate_bundle
from hh_exudyn.multibody.viewer import Viewer
from hh_exudyn.multibody.watch import REASONS, Trouble, look_bundle, watch_state, watched
from vehicles.description import Vehicle

PROGRESS_INTERVAL = 0.2  # s of wall time between two calls of the progress function
_TIMES = ("equilibrium_s", "simulated_s", "wall_s", "kernel_s", "python_s", "exudyn_s")  # of the status

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


class Integration:
    """The time integration of one run.

    It runs in segments (`checkpoint`). Exudyn calls the force function several times a step. The first call
    of a step evaluates the last accepted state: sliders are committed and logs are written then, without an
    evaluation of their own.
    """

    def __init__(
        self,
        case: Case,
        vehicle: Vehicle,
        model: SystemModel,
        work: Workspace,
        control: VehicleControl | None,
        extension: Extension | None = None,
        placed: bool = False,
    ) -> None:
        self._vehicle = vehicle
        self._extension = extension
        self._placed = placed or extension is not None
        self._model = model
        self._work = work
        self._bundle = Bundle(model, work)
        self._log: LogWriter | None = None  # none for a system that its user integrates
        self._control = control
        self._watch = watch_state(model)
        self._watched = Bundle(work, self._watch)
        self._speed = case.speed
        self._step = case.integration.step_ms * 1e-3
        self._steps_per_output = round(case.integration.output_interval_ms / case.integration.step_ms)
        self._sliders: FloatArray = work.new_sliders.copy()
        self._state: dict[str, FloatArray] = {}  # of the system at the border of two segments
        # of the track for the leading wheelset of a vehicle that drives itself; time of the run; position of
        # the leading wheelset in the last state without a fault; potential energy at the start
        self._numbers = {"end": math.inf, "duration": 0.0, "position": 0.0, "potential": math.nan}
        self._accepted = False  # Exudyn calls `_after_step` once before the first step of a segment
        self._steps = 0
        self._error: Exception | None = None
        self._interruption = Interruption()
        self._viewer: Viewer | None = None
        self._shown: ExudynSystem | None = None  # in the viewer: one for all segments
        self._progress: Progress | None = None
        self._next_progress = self._next_store = 0.0
        self.times = dict.fromkeys(_TIMES, 0.0)  # s

    def begin(self, state: dict[str, FloatArray], sliders: FloatArray, track_length: float) -> None:
        """Begin at a state of the system, for the time of the leading coupler head to the end of the track.

        That is at the case's speed. A driven vehicle's run ends earlier if it reaches the end of the track
        before.

        Parameters
        ----------
        state : `extension.begin_from`
        sliders : (couplings, SLIDERS)
        track_length : [m]
        """
        self._state = state
        self._sliders = sliders.copy()
        front = float(self._work.inputs.train_start.max())
        if self._control is not None:
            front = self._control.front
            self._numbers["end"] = track_length - (front - float(self._work.arc_length[0]))
        self._numbers["duration"] = (track_length - front) / self._speed

    def go_on(self, stored: Checkpoint) -> None:
        """Begin at a stored state.

        Parameters
        ----------
        stored : of a run of the same case
        """
        self._state = stored.below("system/")
        self._sliders = stored.arrays["sliders"]
        stored.fill("work/", self._work)
        stored.fill("watch/", self._watch)
        if self._control is not None:
            self._control.put_back(stored.below("control/"))
        self._steps = stored.facts["step"]
        self._numbers.update(stored.facts["numbers"])
        self.times.update(stored.facts["times"])

    def _store(self, log: LogWriter) -> None:
        """Store the state at the end of a segment, with the logs up to there."""
        self._numbers["potential"] = log.potential_at_start
        recorder = log.recorder
        control = {} if self._control is None else self._control.memory()
        checkpoint = Checkpoint(
            {
                "sliders": self._sliders,
                **{f"system/{name}": array for name, array in self._state.items()},
                **dict(flat("work/", self._work)),
                **dict(flat("watch/", self._watch)),
                **{f"control/{name}": array for name, array in control.items()},
            },
            {"step": self._steps, "rows": recorder.totals, "numbers": self._numbers, "times": self.times},
        )
        # copied, as the run goes on while it is written
        recorder.flush(partial(checkpoint.copy().write, recorder.directory))

    def show(self, viewer: Viewer) -> None:
        """Show all that follows in a viewer, whose window opens now.

        Parameters
        ----------
        viewer : of the case

        Raises
        ------
        NoScreen
            It does not open.
        """
        system = self.system(self._steps + 1)
        viewer.dress(system)
        system.mbs.Assemble()
        begin_from(system, self._state, self._state["v"][:3])
        viewer.open(system)
        self._viewer, self._shown = viewer, system

    def run(self, log: LogWriter, progress: Progress | None) -> None:
        """Integrate to the end of the track.

        Parameters
        ----------
        log : of the run
        progress : as for `simulate`
        """
        self._log = log
        log.potential_at_start = self._numbers["potential"]
        self._progress = progress
        steps = whole_steps(self._numbers["duration"], self._step)
        length = round(SEGMENT / self._step)
        # Exudyn prints that user functions allocate memory, which a Python function cannot avoid; failures
        # come as exceptions
        exu.config.printToConsole = False
        try:
            with self._interruption, _collector_paused():
                going = True
                while going and self._steps < steps:
                    last = min((self._steps // length + 1) * length, steps)
                    going = self._run_segment(last, last == steps, log)
        finally:
            exu.config.printToConsole = True
        self._interruption.raise_wanted()
        if self._viewer is not None and self._viewer.closed:
            raise KeyboardInterrupt

    def system(self, last: int) -> ExudynSystem:
        """The system for the steps up to a state, by its number; with the extension, not assembled.

        Parameters
        ----------
        last : number of the state
        """
        settings = explicit_settings(self._steps, last, self._step)
        if self._shown is not None:
            self._system = replace(self._shown, settings=settings)
            return self._system
        state = self._state
        forces, after_step = self._forces, self._after_step
        model, vehicle, placed = self._model, self._vehicle, self._placed
        q, v = state["q"], state["v"]
        system = exudyn_system(model, vehicle, q, v, forces, after_step, settings, placed)
        if self._extension is not None:
            self._extension(system)
        self._system = system
        return system

    def whole_system(self) -> ExudynSystem:
        """The system for all steps, as `system`."""
        return self.system(whole_steps(self._numbers["duration"], self._step))

    def solve(self, system: ExudynSystem) -> None:
        """Assemble a system of `whole_system` and integrate it, without a log.

        Parameters
        ----------
        system : with all that was added to it

        Raises
        ------
        SimulationStopped
            Derailment or divergence.
        """
        system.mbs.Assemble()
        begin_from(system, self._state, self._state["v"][:3])
        try:
            system.mbs.SolveDynamic(system.settings, showHints=False)
        except Exception as error:
            self._error = self._error or error
        if self._error is not None:
            raise self._error

    def _run_segment(self, last: int, at_end: bool, log: LogWriter) -> bool:
        """Integrate up to a state, by its number, and store it; returns whether the run goes on."""
        wall, within = clock.perf_counter(), self.times["kernel_s"] + self.times["python_s"]
        system = self.system(last)
        mbs = system.mbs
        if self._shown is None:
            mbs.Assemble()
        begin_from(system, self._state, self._state["v"][:3])
        try:
            mbs.SolveDynamic(system.settings, showHints=False)
            going = self._goes_on()
            if self._accepted and not self._interruption.wanted and (at_end or not going):
                self._forces(mbs, self._steps * self._step, 0, None, None)  # the last state, to log it too
        except Exception as error:
            # Exudyn reports an exception of a user function as its own failure: the original is raised below
            self._error = self._error or error
        finally:
            wall = clock.perf_counter() - wall
            within = self.times["kernel_s"] + self.times["python_s"] - within
            self.times["simulated_s"] = self._steps * self._step
            self.times["wall_s"] += wall
            self.times["exudyn_s"] += wall - within
        if self._error is not None:
            raise self._error
        if at_end or not going:
            return False
        begin = clock.perf_counter()
        self._state = coordinates_of(system)
        if begin >= self._next_store:
            self._next_store = begin + STORE_INTERVAL
            self._store(log)
        spent = clock.perf_counter() - begin
        for name in ("wall_s", "python_s"):
            self.times[name] += spent
        return True

    def _forces(self, mbs: Any, time: float, item: int, q: Any, q_t: Any) -> list[float]:
        """Exudyn's force function: one kernel call; it never raises, as Exudyn would hide the exception."""
        start = clock.perf_counter()
        # the same numbers as q and q_t, four times faster than these lists
        q = mbs.systemData.GetODE2Coordinates()
        v = mbs.systemData.GetODE2Coordinates_t()
        if self._placed:
            q[: self._system.reference.size] += self._system.reference
        self._work.refine[0] = float(self._accepted and self._steps % self._steps_per_output == 0)
        sliders = self._sliders
        kernel_start = clock.perf_counter()
        status = evaluate_bundle(self._bundle, sliders, q, v, time, False)
        kernel_time = clock.perf_counter() - kernel_start
        if self._accepted:
            self._accepted = False
            try:
                if self._commit(time, v, status):  # the actuators have moved: forces with the new inputs
                    evaluate_bundle(self._bundle, sliders, q, v, time, False)
            except Exception as error:
                self._error = error
        result: list[float] = self._work.generalized_force.tolist()  # read faster than an array
        self.times["kernel_s"] += kernel_time
        self.times["python_s"] += clock.perf_counter() - start - kernel_time
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
            raise SimulationStopped(*REASONS[trouble], wheel, time, self._numbers["position"])
        self._numbers["position"] = float(self._work.arc_length[0])
        if self._steps % self._steps_per_output == 0:
            self._write(time, v)
        if self._control is None or self._steps % self._control.steps_per_sample:
            return False
        self._control.act(time, None if self._log is None else self._log.recorder)
        return True

    def _write(self, time: float, v: FloatArray) -> None:
        """Log the accepted state."""
        if self._log is None:
            return
        self._log.write(time, v)
        for name, number in self._system.sensors.items():
            self._log.write_sensor(time, name, self._system.mbs.GetSensorValues(number))
        self._log.recorder.keep()

    def _after_step(self, mbs: Any, time: float) -> bool:
        """Exudyn's call after an accepted step; False ends the run."""
        self._accepted = True
        self._steps = round(time / self._step)
        if self._progress is not None:
            now = clock.perf_counter()
            if now >= self._next_progress:
                self._next_progress = now + PROGRESS_INTERVAL
                done = min(time / self._numbers["duration"], 1.0)
                try:
                    self._progress(done, f"t = {time:.2f} s, s = {self._work.arc_length[0]:.1f} m")
                except Exception as error:
                    self._error = error
        return self._goes_on()

    def _goes_on(self) -> bool:
        """Whether nothing has happened that ends the run before its time."""
        within = self._numbers["position"] < self._numbers["end"]
        looked_at = self._viewer is None or not self._viewer.closed
        return self._error is None and not self._interruption.wanted and within and looked_at
