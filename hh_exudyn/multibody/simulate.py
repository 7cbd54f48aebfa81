"""`simulate(case, directory)`: equilibrium, time integration with Exudyn, logs on disk."""

import fnmatch
import time as clock
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path
from typing import Any

from hh_exudyn.case import Case
from hh_exudyn.case.sealed import sealed
from hh_exudyn.log.recorder import Recorder
from hh_exudyn.log.store import (
    CHECKPOINT_FILE,
    Run,
    open_run,
    write_case,
    write_inputs,
    write_status,
)
from hh_exudyn.multibody.assembly import assemble, released
from hh_exudyn.multibody.checkpoint import read_checkpoint
from hh_exudyn.multibody.control import vehicle_control
from hh_exudyn.multibody.extended_rest import start_of_run
from hh_exudyn.multibody.extension import Extension, label
from hh_exudyn.multibody.integration import Integration, Progress, SimulationStopped
from hh_exudyn.multibody.interruption import Terminated
from hh_exudyn.multibody.model import workspace
from hh_exudyn.multibody.provenance import is_begun, provenance, require_same, write_provenance
from hh_exudyn.multibody.recording import LogWriter
from hh_exudyn.multibody.viewer import Viewer
from vehicles.description import Vehicle

__all__ = ["Progress", "SimulationStopped", "simulate"]


def simulate(
    case: Case,
    directory: Path | str,
    progress: Progress | None = None,
    *,
    vehicle: Vehicle | None = None,
    resume: bool = False,
    extend: Extension | None = None,
    viewer: Viewer | None = None,
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
    extend : adds Exudyn items to the vehicle's system (`extension`). The folder has its name and the hash of
        its source, not the function: such a run cannot be repeated from its folder alone.
    viewer : Exudyn's own window on the run; it changes no result, and closing it ends the run as Ctrl-C does

    Raises
    ------
    FileExistsError
        The directory is not empty, holds a run of something else, or one that is still going; nothing was
        written.
    ValueError
        The vehicle does not fit its track, the time step is too large, or the case is of a run with an
        extension and has none, or names couplings that the vehicle has not; nothing was written.
    NoEquilibrium
        No static equilibrium at the start; nothing was written.
    NoScreen
        The viewer's window does not open; nothing was written.
    SimulationStopped
        Derailment or divergence; the log up to then is complete.
    KeyboardInterrupt, Terminated
        Ctrl-C, or SIGTERM; the log up to then is complete.
    OSError
        The disk is full, or fails; what was written before can be read.
    """
    directory = Path(directory)
    if extend is not None:
        case = case.with_changes(extension=label(extend))
    elif case.extension is not None:
        raise ValueError(
            f"the case is of a run with Exudyn items added by {case.extension}: it runs from Python only, by "
            "simulate(case, directory, extend=...) with that function"
        )
    whole = sealed(case, vehicle)
    made = provenance(whole)
    begun = resume and is_begun(directory)
    if begun:
        require_same(directory, made)
        if open_run(directory).complete:
            return open_run(directory)
    stored = read_checkpoint(directory) if begun else None
    runs = vehicle or case.described_vehicle()
    logged = _logged(runs, case.integration.logged_couplings)
    model = assemble(runs, case)
    work = workspace(model)
    control = vehicle_control(case, runs, model, work)
    integration = Integration(case, runs, released(model, case), work, control, extend)
    status: dict[str, Any] = {"finished": False, "reason": "running"}
    if stored is None:
        if progress is not None:
            progress(0.0, "static equilibrium (the first run also compiles the kernels)")
        start = clock.perf_counter()
        integration.begin(*start_of_run(case, runs, model, work, extend), case.alignment().length)
        integration.times["equilibrium_s"] = clock.perf_counter() - start
    else:
        integration.go_on(stored)
    if viewer is not None:
        integration.show(viewer)
    if control is not None:
        status["curve_resistance_of_train"] = case.traction_or_default.curve_resistance
    if sealed(case, vehicle) != whole:
        raise ValueError("a file of the case has changed while its run was prepared")
    names = {
        "body": [body.name for body in runs.bodies],
        "coupling": [coupling.name for coupling in runs.couplings],
    }
    recorder = Recorder(
        directory,
        {"case": whole.text},
        names=names,
        resumed=None if not begun else {} if stored is None else stored.facts["rows"],
    )
    with _ended(directory, status, integration), recorder, viewer or nullcontext():
        if stored is None:
            write_provenance(directory, made)
            write_inputs(directory, whole.files)
            write_case(directory, whole.text)
        write_status(directory, status)
        integration.run(LogWriter(runs, model, work, recorder, logged), progress)
    (directory / CHECKPOINT_FILE).unlink(missing_ok=True)
    return open_run(directory)


def _logged(vehicle: Vehicle, patterns: tuple[str, ...]) -> list[int]:
    """Numbers of the couplings that patterns name; ValueError for one that names none."""
    names = [coupling.name for coupling in vehicle.couplings]
    for pattern in patterns:
        if not fnmatch.filter(names, pattern):
            raise ValueError(
                f"integration.logged_couplings: {pattern!r} names no coupling of {vehicle.name}; it has "
                f"{', '.join(names) or 'none'}"
            )
    return [i for i, name in enumerate(names) if any(fnmatch.fnmatchcase(name, each) for each in patterns)]


@contextmanager
def _ended(directory: Path, status: dict[str, Any], integration: Integration) -> Iterator[None]:
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
