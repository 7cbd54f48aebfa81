"""`simulate_many(cases, directory)`: many cases through a pool of processes, a folder for each.

Every worker is one process of one thread: cases are independent, and threads inside of them would take the
cores from each other. A finished run in its folder is not repeated (`once`), so that a matrix that was
interrupted goes on where it was.

Several vehicles in one Exudyn system with one callback would not pay: Exudyn's time goes with the bodies. A
prototype with 8 loaded ore wagons took from 8 % less to 7 % more an evaluation of each than with one (61 to
65 us, of which Exudyn 12 to 14, the kernel 41 to 43; process time on a busy machine, three repetitions).
"""

import math
import time as clock
from collections.abc import Callable, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass
from multiprocessing.queues import SimpleQueue
from pathlib import Path

from hh_exudyn.case import Case
from hh_exudyn.workers import SPAWN, process_pool, usable_cores

_POLL = 0.2  # s between two looks at the workers


@dataclass(frozen=True)
class Outcome:
    """How the run of a case ended.

    Attributes
    ----------
    name : str
        Of the case in its matrix.
    reason : str
        Why it did not finish; empty for a finished run.
    wall : float
        Time taken [s].
    done_before : bool
        Whether it was there already.
    """

    name: str
    reason: str
    wall: float
    done_before: bool = False

    @property
    def finished(self) -> bool:
        """Whether the run went to its end."""
        return not self.reason


@dataclass(frozen=True)
class Standing:
    """How far all cases are.

    Attributes
    ----------
    fraction : float
        Of the work done, 0 to 1.
    left : float
        Estimated time that is left [s]; infinite before anything is known.
    ended : Outcome or None
        The case that has just ended, if one has.
    """

    fraction: float
    left: float
    ended: Outcome | None


def simulate_many(
    cases: Mapping[str, Case],
    directory: Path | str,
    workers: int | None = None,
    progress: Callable[[Standing], None] | None = None,
) -> list[Outcome]:
    """Run cases in parallel, each in the folder of its name.

    A run that derails, diverges or has no equilibrium does not stop the others.

    Parameters
    ----------
    cases : mapping of str to Case
        By name of their folders.
    directory : Path or str
        Holds the folders; made if it does not exist.
    workers : int or None
        Number of processes; None for one a core that this process may use.
    progress : callable or None
        Called some times a second, and whenever a run ends.

    Raises
    ------
    KeyboardInterrupt
        Ctrl-C; all runs keep what they have.
    """
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    count = max(1, min(workers or usable_cores(), len(cases)))
    reports = SPAWN.SimpleQueue()
    outcomes: dict[str, Outcome] = {}
    begun, done = clock.perf_counter(), dict.fromkeys(cases, 0.0)

    def tell(ended: Outcome | None) -> None:
        if progress is not None:
            new = {name: part for name, part in done.items() if not _was_there(outcomes.get(name))}
            work, spent = sum(new.values()), clock.perf_counter() - begun
            left = spent * (len(new) - work) / work if work else math.inf
            progress(Standing(sum(done.values()) / len(cases), left if new else 0.0, ended))

    with process_pool(count, _begin, (reports,)) as pool:
        waiting: dict[Future[Outcome], str] = {
            pool.submit(_run, name, case, directory / name): name for name, case in cases.items()
        }
        try:
            while waiting:
                ended, _ = wait(waiting, timeout=_POLL, return_when=FIRST_COMPLETED)
                while not reports.empty():
                    name, fraction = reports.get()
                    done[name] = max(done[name], fraction)
                tell(None)
                for future in ended:
                    name = waiting.pop(future)
                    outcomes[name] = future.result()
                    done[name] = 1.0
                    tell(outcomes[name])
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise
    return [outcomes[name] for name in cases]


def _was_there(outcome: Outcome | None) -> bool:
    return outcome is not None and outcome.done_before


_reports: "SimpleQueue[tuple[str, float]] | None" = None  # of a worker


def _begin(reports: "SimpleQueue[tuple[str, float]]") -> None:
    """Begin a worker."""
    global _reports
    _reports = reports


def _run(name: str, case: Case, directory: Path) -> Outcome:
    """The run of one case in a worker."""
    from hh_exudyn.multibody.equilibrium import NoEquilibrium
    from hh_exudyn.multibody.once import simulate_once
    from hh_exudyn.multibody.simulate import SimulationStopped

    begun, worked = clock.perf_counter(), False

    def report(fraction: float, text: str) -> None:
        nonlocal worked
        worked = True
        if _reports is not None:
            _reports.put((name, fraction))

    reason = ""
    try:
        simulate_once(case, directory, report)
    except (SimulationStopped, NoEquilibrium, ValueError, OSError) as error:
        reason = " ".join(str(error).split())
    return Outcome(name, reason, clock.perf_counter() - begun, not worked and not reason)
