"""`simulate(case, directory)`: equilibrium, time integration with Exudyn, logs on disk."""

import math
import signal
import threading
import time as clock
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

from hh_exudyn.case import Case
from hh_exudyn.contact.types import FloatArray, Patch
from hh_exudyn.log.recorder import Recorder
from hh_exudyn.log.store import Run, open_run, write_case, write_status
from hh_exudyn.multibody.assembly import assemble, explicit_settings, exudyn_system
from hh_exudyn.multibody.equilibrium import Equilibrium, equilibrium
from hh_exudyn.multibody.model import SystemModel, Workspace, workspace
from hh_exudyn.multibody.recording import LogWriter
from hh_exudyn.multibody.system import evaluate
from vehicles.catalogue import vehicle as vehicle_by_name
from vehicles.description import Vehicle

LIFT_OFF_TIME = 0.1  # s without contact of a wheel that counts as a derailment
FLANGE_TIP_MARGIN = 3e-3  # m above the flange tip: a contact so deep means the flange climbs the rail
LARGEST_LATERAL = 0.08  # m of a wheelset from the track centre: wheel and rail have parted
PROGRESS_INTERVAL = 0.2  # s of wall time between two calls of the progress function

Progress = Callable[[float, str], None]


class SimulationStopped(RuntimeError):
    """A run ended before its end; the log so far is kept.

    Attributes
    ----------
    reason : "derailment" or "divergence"
    wheel : "1L", "2R", ... or "" where no wheel is to blame
    time : [s] since the start
    position : arc length of the wheelset or vehicle [m]
    """

    def __init__(self, reason: str, detail: str, wheel: str, time: float, position: float) -> None:
        where = f"wheel {wheel}, " if wheel else ""
        super().__init__(f"{reason}: {detail} ({where}t = {time:.3f} s, s = {position:.2f} m)")
        self.reason = reason
        self.wheel = wheel
        self.time = time
        self.position = position


def simulate(case: Case, directory: Path | str, progress: Progress | None = None) -> Run:
    """Run a case and write its logs into a new or empty directory.

    Parameters
    ----------
    case : what to run
    directory : where case.toml, the logs and status.json go
    progress : called now and then with the fraction done (0..1) and a line of text

    Raises
    ------
    FileExistsError
        The directory is not empty; nothing was written.
    ValueError, NoEquilibrium
        The vehicle does not fit its track, or has no equilibrium at the start.
    SimulationStopped
        Derailment or divergence; the log so far is kept.
    KeyboardInterrupt
        Ctrl-C; the log so far is kept.
    """
    vehicle = vehicle_by_name(case.vehicle)
    model = assemble(vehicle, case)
    work = workspace(model)
    names = {"body": [body.name for body in vehicle.bodies]}
    with Recorder(directory, {"case": case.to_toml()}, names=names) as recorder:
        write_case(directory, case.to_toml())
        status: dict[str, Any] = {"finished": False, "reason": "running"}
        write_status(directory, status)
        start = clock.perf_counter()
        try:
            alignment = case.alignment()
            state = equilibrium(vehicle, alignment, model, work)
            status["equilibrium_s"] = clock.perf_counter() - start
            integration = _Integration(
                case, vehicle, model, work, state, alignment.length, LogWriter(vehicle, model, work, recorder)
            )
            integration.run(progress)
            status.update(finished=True, reason="finished")
        except KeyboardInterrupt:
            status["reason"] = "interrupted"
            raise
        except Exception as error:
            status["reason"] = str(error)
            raise
        finally:
            if "equilibrium_s" in status:
                status.update(integration.times)
            write_status(directory, status)
    return open_run(directory)


class _Integration:
    """The time integration of one run: Exudyn's callbacks, sliders, logging and the reasons to stop.

    Exudyn calls the force function several times a step. The first call of a step evaluates the state that
    was accepted last: sliders are committed and logs are written there, without an evaluation of their own.
    """

    def __init__(
        self,
        case: Case,
        vehicle: Vehicle,
        model: SystemModel,
        work: Workspace,
        state: Equilibrium,
        track_length: float,
        log: LogWriter,
    ) -> None:
        self._model = model
        self._work = work
        self._state = state
        self._log = log
        self._sliders = state.sliders.copy()
        self._step = case.integration.step_ms * 1e-3
        self._steps_per_output = round(case.integration.output_interval_ms / case.integration.step_ms)
        front = float(model.train.start.max())
        self._duration = (track_length - front) / case.speed
        wheels = (model.wheel_rail.wheel_left, model.wheel_rail.wheel_right)
        self._flange_limit = [_flange_limit(table) for table in wheels]
        self._airborne = np.zeros((len(vehicle.wheelsets), 2))
        self._accepted = True
        self._steps = 0
        self._error: BaseException | None = None
        self._interrupted = False
        self._next_progress = 0.0
        self._progress: Progress | None = None
        self.times: dict[str, float] = {}
        self._kernel_time = 0.0
        self._callback_time = 0.0

    def run(self, progress: Progress | None) -> None:
        """Integrate to the end of the track."""
        self._progress = progress
        model = self._model
        mbs = exudyn_system(model, self._state.q, self._state.v, self._forces, self._after_step)
        settings = explicit_settings(self._duration, self._step)
        start = clock.perf_counter()
        previous = None
        if threading.current_thread() is threading.main_thread():
            previous = signal.signal(signal.SIGINT, self._interrupt)
        try:
            mbs.SolveDynamic(settings, showHints=False)
        except Exception as error:
            # Exudyn reports an exception of a user function as its own failure: the kept one tells more
            if self._error is None:
                self._error = error
        finally:
            if previous is not None:
                signal.signal(signal.SIGINT, previous)
            wall = clock.perf_counter() - start
            self.times = {
                "simulated_s": self._steps * self._step,
                "wall_s": wall,
                "kernel_s": self._kernel_time,
                "python_s": self._callback_time - self._kernel_time,
                "exudyn_s": wall - self._callback_time,
            }
        if self._interrupted:
            raise KeyboardInterrupt
        if self._error is not None:
            raise self._error

    def _interrupt(self, number: int, frame: FrameType | None) -> None:
        self._interrupted = True

    def _forces(self, mbs: Any, time: float, item: int, q_list: Any, v_list: Any) -> FloatArray:
        """Exudyn's force function: one kernel call; never raises, since Exudyn would hide the reason."""
        start = clock.perf_counter()
        q = np.array(q_list)
        v = np.array(v_list)
        kernel_start = clock.perf_counter()
        status = evaluate(self._model, self._work, self._sliders, q, v, time, False)
        self._kernel_time += clock.perf_counter() - kernel_start
        if self._accepted:
            self._accepted = False
            self._commit(time, v, status)
        self._callback_time += clock.perf_counter() - start
        return self._work.generalized_force

    def _commit(self, time: float, v: FloatArray, status: int) -> None:
        """The state just evaluated is the accepted one: keep its sliders, log it, and look for trouble."""
        try:
            self._sliders[:] = self._work.new_sliders
            self._check(time, v, status)
            if self._steps % self._steps_per_output == 0:
                self._log.write(time, v)
        except Exception as error:
            self._error = error

    def _check(self, time: float, v: FloatArray, status: int) -> None:
        work = self._work
        if status or not np.isfinite(work.generalized_force).all():
            wheel = _wheel_name((status - 1) // 2, (status - 1) % 2) if status else ""
            position = work.arc_length[(status - 1) // 2] if status else work.arc_length[0]
            raise SimulationStopped(
                "divergence", "the state is no longer finite", wheel, time, float(position)
            )
        loaded = work.patches[:, :, 0, Patch.NORMAL_FORCE] > 0.0
        self._airborne += self._step
        self._airborne[loaded] = 0.0
        if (self._airborne > LIFT_OFF_TIME).any():
            self._derailed("no contact for 0.1 s", np.argwhere(self._airborne > LIFT_OFF_TIME)[0], time)
        for side in range(2):
            deep = work.patches[:, side, :, Patch.Y_WHEEL].max(axis=1) > self._flange_limit[side]
            if deep.any():
                self._derailed("the wheel climbs the rail", (int(np.argmax(deep)), side), time)
        lateral = np.abs(work.frame_position[:, 1])
        if (lateral > LARGEST_LATERAL).any():
            w = int(np.argmax(lateral))
            self._derailed(
                "the wheelset left the track", (w, 0 if work.frame_position[w, 1] > 0 else 1), time
            )

    def _derailed(self, detail: str, wheel: Any, time: float) -> None:
        w, side = int(wheel[0]), int(wheel[1])
        raise SimulationStopped(
            "derailment", detail, _wheel_name(w, side), time, float(self._work.arc_length[w])
        )

    def _after_step(self, mbs: Any, time: float) -> bool:
        """Exudyn's call after an accepted step; False ends the run."""
        self._accepted = True
        self._steps += 1
        now = clock.perf_counter()
        if self._progress is not None and now >= self._next_progress:
            self._next_progress = now + PROGRESS_INTERVAL
            self._progress(
                min(time / self._duration, 1.0), f"t = {time:.2f} s, s = {self._work.arc_length[0]:.1f} m"
            )
        return self._error is None and not self._interrupted


def _wheel_name(wheelset: int, side: int) -> str:
    return f"{wheelset + 1}{'LR'[side]}"


def _flange_limit(table: Any) -> float:
    """y on the wheel profile beyond which a contact means that the flange tip is on the rail [m]."""
    deep = np.flatnonzero(table.z < table.z.min() + FLANGE_TIP_MARGIN)
    y = table.start + table.step * np.arange(table.z.size)
    first = y[deep].min() if deep.size else math.inf
    return float(first)
