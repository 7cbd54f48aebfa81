"""`simulate_once(case, directory)`: a finished run is reused, not repeated."""

from pathlib import Path

from hh_exudyn.case import Case
from hh_exudyn.log.store import Run, open_run, remove_logs
from hh_exudyn.multibody.simulate import Progress, simulate


def simulate_once(case: Case, directory: Path | str, progress: Progress | None = None) -> Run:
    """The run of a case in a directory: the finished one there, or else a new simulation.

    So a study of many cases, one directory each, can be stopped at any time and restarted. The logs of an
    unfinished run are removed; two processes must therefore not work on the same directory. A case does not
    record the version of the toolkit: after an update begin with an empty folder.

    Parameters
    ----------
    case, directory, progress : as for `simulate`

    Raises
    ------
    FileExistsError
        The directory holds a run of another case, or other files. Nothing was changed.
    ValueError, NoEquilibrium, SimulationStopped, KeyboardInterrupt
        As `simulate` does.
    """
    directory = Path(directory)
    if directory.is_dir() and any(directory.iterdir()):
        try:
            run = open_run(directory)
            same = run.case_text == case.to_toml()
        except FileNotFoundError:
            same = False
        if not same:
            raise FileExistsError(f"{directory} holds something other than a run of the case {case.name}")
        if run.status["finished"]:
            return run
        remove_logs(run)
    return simulate(case, directory, progress)
