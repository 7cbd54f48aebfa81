"""`simulate_once(case, directory)`: a finished run is reused, not repeated."""

import warnings
from pathlib import Path

from hh_exudyn.case import Case
from hh_exudyn.case.sealed import INPUTS, sealed
from hh_exudyn.log.channels import LOGS
from hh_exudyn.log.parts import TEMPORARY_SUFFIX
from hh_exudyn.log.store import (
    CASE_FILE,
    CHECKPOINT_FILE,
    PROVENANCE_FILE,
    STATUS_FILE,
    VEHICLE_FILE,
    Run,
    open_run,
)
from hh_exudyn.multibody.provenance import disagreement, provenance, read_provenance
from hh_exudyn.multibody.simulate import Progress, simulate
from vehicles.description import Vehicle

_OF_A_RUN = {*LOGS, INPUTS, CASE_FILE, CHECKPOINT_FILE, PROVENANCE_FILE, STATUS_FILE, VEHICLE_FILE}


def simulate_once(
    case: Case, directory: Path | str, progress: Progress | None = None, *, vehicle: Vehicle | None = None
) -> Run:
    """The run of a case in a directory: the finished one there, or else a new simulation.

    So a study of many cases, one directory each, can be stopped at any time and restarted. Finished is a run
    whose status says so and whose logs are there; that it is the run of this case is judged by content: the
    vehicle, all files, the code of this package and the versions of its packages. Any other run of the case
    is resumed from its last stored state, with a warning where its status is broken or its logs are gone.

    Parameters
    ----------
    case, directory, progress, vehicle : as for `simulate`

    Raises
    ------
    FileExistsError
        The directory holds a run of another case or of other code, or, beside an unfinished run, other files.
        Nothing was changed.
    ValueError, NoEquilibrium, SimulationStopped, KeyboardInterrupt, Terminated, OSError
        As `simulate` does.
    """
    directory = Path(directory)
    if not directory.is_dir() or not any(directory.iterdir()):
        return simulate(case, directory, progress, vehicle=vehicle)
    differs = disagreement(read_provenance(directory), provenance(sealed(case, vehicle)))
    if differs:
        raise FileExistsError(
            f"{directory} holds something other than a run of the case {case.name}: {', '.join(differs)}"
        )
    run = open_run(directory)
    if run.complete:
        return run
    others = [path.name for path in directory.iterdir() if not _of_a_run(path)]
    if others:
        raise FileExistsError(f"{directory} holds other files beside an unfinished run: {', '.join(others)}")
    if run.status["finished"]:
        _say(f"{directory}: the run has lost its logs; it is made again")
    elif "broken" in run.status["reason"] or STATUS_FILE in run.status["reason"]:
        _say(f"{directory}: {run.status['reason']}; the run is made again")
    return simulate(case, directory, progress, vehicle=vehicle, resume=True)


def _of_a_run(path: Path) -> bool:
    return path.name in _OF_A_RUN or path.suffix == TEMPORARY_SUFFIX


def _say(text: str) -> None:
    warnings.warn(text, RuntimeWarning, stacklevel=3)
