"""`simulate(case, directory)`: equilibrium, time integration with Exudyn, logs on disk."""

import gc
import math
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from functools import partial
from pathlib import Path
from typing import Any

import exudyn as exu

from hh_exudyn.arrays import FloatArray
from hh_exudyn.case import Case
from hh_exudyn.case.sealed import sealed
from hh_exudyn.kernel import Bundle
from hh_exudyn.log.recorder import Recorder
from hh_exudyn.log.store import (
    CHECKPOINT_FILE,
    Run,
    open_run,
    write_case,
    write_inputs,
    write_status,
)
from hh_exudyn.multibody.assembly import assemble, explicit_settings, exudyn_system, released, whole_steps
from hh_exudyn.multibody.checkpoint import SEGMENT, Checkpoint, flat, read_checkpoint
from hh_exudyn.multibody.control import VehicleControl, vehicle_control
from hh_exudyn.multibody.equilibrium import Equilibrium, equilibrium
from hh_exudyn.multibody.interruption import Interruption, Terminated
from hh_exudyn.multibody.linear.stability import require_stable_step
from hh_exudyn.multibody.model import SystemModel, Workspace, workspace
from hh_exudyn.multibody.provenance import is_begun, provenance, require_same, write_provenance
from hh_exudyn.multibody.recording import LogWriter
from hh_exudyn.multibody.system import evaluate_bundle
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


def simulate(
    case: Case,
    directory: Path | str,
    progress: Progress | None = None,
    *,
    vehicle: Vehicle | None = None,
    resume: bool = False,
) -> Run:
    """Run a case and write its logs into a new or empty directory.

    The directory gets copies of everything that the run is made from: its ``case.toml`` can be run again,
    here or elsewhere, with the same results bit for bit.

    Parameters
    ----------
    case : vehicle, track, speed, contact and integration
    directory : of the run (`hh_exudyn.log.store`); made if it does not exist
    progress : called every `PROGRESS_INTERVAL` with the fraction done (0..1) and a line of text
    vehicle : a description in place of the vehicle of the case
    resume : go on with an interrupted run of the same case in the directory, from its last stored state
        (`checkpoint`); the result is that of a run without a break. A finished run is returned as it is;
        without one there the run is a new one.

    Raises
    ------
    FileExistsError
        The directory is not empty, holds a run of something else, or one that is still going; nothing was
        written.
    ValueError
        The vehicle does not fit its track, or the time step is too large; nothing was written.
    NoEquilibrium
        No static equilibrium at the start; nothing was written.
    SimulationStopped
        Derailment or divergence; the log up to then is complete.
    KeyboardInterrupt, Terminated
        Ctrl-C, or SIGTERM; the log up to then is complete.
    OSError
        The disk is full, or fails; what was written before can be read.
    """
    directory = Path(directory)
    whole = sealed(case, vehicle)
    made = provenance(whole)
    begun = resume and is_begun(directory)
    if begun:
        require_same(directory, made)
        if open_run(directory).complete:
            return open_run(directory)
    stored = read_checkpoint(directory) if begun else None
    runs = vehicle or case.described_vehicle()
    model = assemble(runs, case)
    work = workspace(model)
    control = vehicle_control(case, runs, model, work)
    integration = _Integration(case, released(model, case), work, control)
    status: dict[str, Any] = {"finished": False, "reason": "running"}
    if stored is None:
        if progress is not None:
            progress(0.0, "static equilibrium (the first run also compiles the kernels)")
        start = clock.perf_counter()
        state = equilibrium(runs, model, work)
        require_stable_step(case.integration.step_ms * 1e-3, model, work, state)
        integration.begin(state, case.alignment().length)
        integration.times["equilibrium_s"] = clock.perf_counter() - start
    else:
        integration.go_on(stored)
    if control is not None:
        status["curve_resistance_of_train"] = case.traction_or_default.curve_resistance
    if sealed(case, vehicle) != whole:
        raise ValueError("a file of the case has changed while its run was prepared")
    names = {"body": [body.name for body in runs.bodies]}
    recorder = Recorder(
        directory,
        {"case": whole.text},
        names=names,
        resumed=None if not begun else {} if stored is None else stored.facts["rows"],
    )
    with _ended(directory, status, integration), recorder:
        if stored is None:
            write_provenance(directory, made)
            write_inputs(directory, whole.files)
            write_case(directory, whole.text)
        write_status(directory, status)
        integration.run(LogWriter(runs, model, work, recorder), progress)
    (directory / CHECKPOINT_FILE).unlink(missing_ok=True)
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


@contextmanager
def _ended(directory: Path, status: dict[str, Any], integration: "_Integration") -> Iterator[None]:
    """Write how a run has ended, after its logs are on disk; on a full disk it stays as it was."""
    try:
        yield
        status.update(finished=True, reason="finished")
    except KeyboardInterrupt:
        status["reason"] = "interrupted"
        raise
    except Terminated:
        status["reason"] = "terminated"
        raise
    except Exception as error:
        status["reason"] = str(error)
        raise
    finally:
        status.update(integration.times, **integration.watched)
        with suppress(OSError) if not status["finished"] else nullcontext():
            write_status(directory, status)


class _Integration:
    """The time integration of one run: Exudyn's callbacks, sliders, logging and the reasons to stop.

    It runs in segments (`checkpoint`). Exudyn calls the force function several times a step. The first call
    of a step evaluates the last accepted state: sliders are committed and logs are written then, without an
    evaluation of their own.
    """

    def __init__(
        self, case: Case, model: SystemModel, work: Workspace, control: VehicleControl | None
    ) -> None:
        self._model = model
        self._work = work
        self._bundle = Bundle(model, work)
        self._log: LogWriter
        self._control = control
        self._watch = watch_state(model)
        self._watched = Bundle(work, self._watch)
        self._speed = case.speed
        self._step = case.integration.step_ms * 1e-3
        self._steps_per_output = round(case.integration.output_interval_ms / case.integration.step_ms)
        self._state: dict[str, FloatArray] = {}  # q, v, sliders at the border of two segments
        # of the track for the leading wheelset of a vehicle that drives itself; time of the run; position of
        # the leading wheelset in the last state without a fault; potential energy at the start
        self._numbers = {"end": math.inf, "duration": 0.0, "position": 0.0, "potential": math.nan}
        self._accepted = False  # Exudyn calls `_after_step` once before the first step of a segment
        self._steps = 0
        self._error: Exception | None = None
        self._interruption = Interruption()
        self._progress: Progress | None = None
        self._next_progress = 0.0
        self.times = dict.fromkeys(_TIMES, 0.0)  # s

    def begin(self, state: Equilibrium, track_length: float) -> None:
        """Begin at the equilibrium, for the time of the leading coupler head to the end of the track.

        That is at the case's speed. A driven vehicle's run ends earlier if it reaches the end of the track
        before.

        Parameters
        ----------
        state : at the start
        track_length : [m]
        """
        self._state = {"q": state.q, "v": state.v, "sliders": state.sliders.copy()}
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
        self._state = {name: stored.arrays[name] for name in ("q", "v", "sliders")}
        stored.fill("work/", self._work)
        stored.fill("watch/", self._watch)
        if self._control is not None:
            self._control.put_back(stored.below("control/"))
        self._steps = stored.facts["step"]
        self._numbers.update(stored.facts["numbers"])
        self.times.update(stored.facts["times"])

    def _store(self, q: FloatArray, v: FloatArray) -> None:
        """Take the state at the end of a segment, and store it with the logs up to there."""
        self._state.update(q=q, v=v)
        self._numbers["potential"] = self._log.potential_at_start
        recorder = self._log.recorder
        control = {} if self._control is None else self._control.memory()
        checkpoint = Checkpoint(
            {
                **self._state,
                **dict(flat("work/", self._work)),
                **dict(flat("watch/", self._watch)),
                **{f"control/{name}": array for name, array in control.items()},
            },
            {
                "step": self._steps,
                "rows": recorder.totals,
                "numbers": self._numbers,
                "times": self.times,
            },
        )
        # copied, as the run goes on while it is written
        recorder.flush(partial(checkpoint.copy().write, recorder.directory))

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
                    going = self._run_segment(last, last == steps)
        finally:
            exu.config.printToConsole = True
        self._interruption.raise_wanted()

    def _run_segment(self, last: int, at_end: bool) -> bool:
        """Integrate up to a state, by its number, and store it; returns whether the run goes on."""
        q, v = self._state["q"], self._state["v"]
        wall, within = clock.perf_counter(), self.times["kernel_s"] + self.times["python_s"]
        mbs = exudyn_system(self._model, q, v, self._forces, self._after_step)
        try:
            mbs.SolveDynamic(explicit_settings(self._steps, last, self._step), showHints=False)
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
        self._store(mbs.systemData.GetODE2Coordinates(), mbs.systemData.GetODE2Coordinates_t())
        spent = clock.perf_counter() - begin
        self.times["wall_s"] += spent
        self.times["python_s"] += spent
        return True

    def _forces(self, mbs: Any, time: float, item: int, q: Any, q_t: Any) -> list[float]:
        """Exudyn's force function: one kernel call; it never raises, as Exudyn would hide the exception."""
        start = clock.perf_counter()
        # the same numbers as q and q_t, four times faster than these lists
        q = mbs.systemData.GetODE2Coordinates()
        v = mbs.systemData.GetODE2Coordinates_t()
        self._work.refine[0] = float(self._accepted and self._steps % self._steps_per_output == 0)
        sliders = self._state["sliders"]
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
        self._state["sliders"][:] = self._work.new_sliders
        if status:  # the contact kernel's: 1 + number of the wheel
            trouble, (wheelset, side) = Trouble.NOT_FINITE, divmod(status - 1, 2)
        else:
            trouble, wheelset, side = look_bundle(self._watched, self._step)
        if trouble:
            wheel = f"{wheelset + 1}{'LR'[side]}" if wheelset >= 0 else ""
            raise SimulationStopped(*REASONS[trouble], wheel, time, self._numbers["position"])
        self._numbers["position"] = float(self._work.arc_length[0])
        if self._steps % self._steps_per_output == 0:
            self._log.write(time, v)
            self._log.recorder.keep()
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
                done = min(time / self._numbers["duration"], 1.0)
                try:
                    self._progress(done, f"t = {time:.2f} s, s = {self._work.arc_length[0]:.1f} m")
                except Exception as error:
                    self._error = error
        return self._goes_on()

    def _goes_on(self) -> bool:
        """Whether nothing has happened that ends the run before its time."""
        within = self._numbers["position"] < self._numbers["end"]
        return self._error is None and not self._interruption.wanted and within
