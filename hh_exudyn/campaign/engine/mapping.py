"""`evaluate_all`: tasks to results over an executor; `weighted_sum`: the results in a fixed order.

Which worker makes a result, when, and how often it had to be begun changes none of its bytes. What dies or
hangs is begun again: a pool of processes does not say whose work killed it, so that all that ran is begun
again, and work that was there at every death but one gets its last attempt alone.
"""

import math
import time as clock
from collections import Counter, deque
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass, field

from hh_exudyn.campaign.engine.cost import CostModel
from hh_exudyn.campaign.engine.results import Failure, ResultFolder
from hh_exudyn.campaign.engine.sums import PartSums
from hh_exudyn.campaign.engine.task import Ending, Evaluate, Evaluated, Task, evaluated
from hh_exudyn.campaign.engine.workers import Cause, EngineStopped, Workers
from hh_exudyn.multibody.interruption import Interruption

_POLL = 0.2  # s between two looks at the workers
ATTEMPTS = 3


class TooManyFailed(RuntimeError):
    """More of the weight has failed than was allowed; the message names the tasks and reasons."""


@dataclass(frozen=True)
class Standing:
    """How far the tasks are.

    Attributes
    ----------
    done, failed, count
        Numbers of tasks: with a result, without one for good, in all [-].
    fraction
        Of the expected work, 0 to 1 [-].
    left
        Expected time that is left [s]; infinite before anything has run.
    ended
        Name of the task that has just ended, empty for none.
    reason
        Why it failed; empty for a result.
    """

    done: int
    failed: int
    count: int
    fraction: float
    left: float
    ended: str = ""
    reason: str = ""


@dataclass(frozen=True)
class Report:
    """How it went.

    Attributes
    ----------
    count, reused
        Results in all, and those that were there before [-].
    failures
        Tasks without a result, in their order.
    failed_weight
        Their share of the whole weight [-].
    begun_again
        Evaluations begun again after a worker died or hung [-].
    wall, busy
        Time taken, and wall times of all evaluations together [s].
    workers
        Number of evaluations at a time.
    """

    count: int
    reused: int
    failures: tuple[Failure, ...]
    failed_weight: float
    begun_again: int
    wall: float
    busy: float
    workers: int


@dataclass
class _Mapping:
    """The state of the loop."""

    evaluate: Evaluate
    folder: ResultFolder
    workers: Workers
    cost: CostModel
    attempts: int
    waiting: deque[Task]
    running: dict[Future[Evaluated], tuple[Task, float]] = field(default_factory=dict)
    begun: Counter[str] = field(default_factory=Counter)  # by key
    ended: list[tuple[Task, str]] = field(default_factory=list)  # since the last report, with the reason
    arrived: list[tuple[Task, Evaluated]] = field(default_factory=list)  # not kept yet
    again: int = 0
    busy: float = 0.0

    def fill(self) -> None:
        """Give work to the workers, one evaluation each; a last attempt has them for itself."""
        while self.waiting and len(self.running) < self.workers.count:
            alone = self._last_attempt(self.waiting[0].key) or any(
                self._last_attempt(task.key, running=True) for task, _ in self.running.values()
            )
            if alone and self.running and self.attempts > 1:
                return
            task = self.waiting.popleft()
            self.begun[task.key] += 1
            try:
                future = self.workers.submit(evaluated, self.evaluate, task.payload, task.key)
            except Exception as error:
                if self.workers.cause(error) is not Cause.DIED:
                    raise EngineStopped(f"no work can be given out: {error}") from error
                self.begun[task.key] -= 1
                self.waiting.appendleft(task)
                self._renew([], "")
                continue
            self.running[future] = task, clock.monotonic()

    def _last_attempt(self, key: str, running: bool = False) -> bool:
        return self.begun[key] >= self.attempts - (0 if running else 1) and self.begun[key] > 0

    def collect(self) -> None:
        """Take in what has ended, and end what hangs."""
        done, _ = wait(self.running, timeout=_POLL, return_when=FIRST_COMPLETED)
        died = []
        for future in done:
            error = future.exception() if not future.cancelled() else None
            if error is None and not future.cancelled():
                task, _ = self.running.pop(future)
                self.arrived.append((task, future.result()))
                continue
            cause = Cause.GONE if error is None else self.workers.cause(error)
            if cause is Cause.GONE:
                raise EngineStopped(f"{cause.value} ({error}); what is done is kept: run it again")
            if cause is Cause.DIED:
                died.append(future)
            else:
                task, _ = self.running.pop(future)
                self._fail(task, Ending.FAILED, f"{cause.value}: {error}")
        if died:
            self._renew(died, Cause.DIED.value)
            return
        now = clock.monotonic()
        hung = [
            future
            for future, (task, begun) in self.running.items()
            if now - begun > self.cost.timeout(task.size)
        ]
        if hung:
            self._renew(hung, "no end within the time allowed", hang=True)

    def _renew(self, lost: Sequence[Future[Evaluated]], reason: str, hang: bool = False) -> None:
        """Begin workers anew, and lost work again, or give it up; what ended with it is begun again."""
        gone = {*self.workers.renew(list(self.running), list(lost) if hang else []), *lost}
        for future in list(self.running):
            if future not in gone:
                continue
            task, _ = self.running.pop(future)
            self.again += 1
            if future in lost or not hang:  # of a death, all that ended with it are suspected
                limit = f" ({self.cost.timeout(task.size):.3g} s)" if hang else ""
                self._again(task, reason + limit)
            else:  # it only ran beside
                self.begun[task.key] -= 1
                self.waiting.appendleft(task)

    def _again(self, task: Task, reason: str) -> None:
        if self.begun[task.key] < self.attempts:
            self.waiting.append(task)
        else:
            self._fail(task, Ending.LOST, reason)

    def keep(self) -> None:
        """Keep what has arrived, while the workers are busy with the next."""
        while self.arrived:
            self._take(*self.arrived.pop(0))

    def _take(self, task: Task, one: Evaluated) -> None:
        """Keep what a worker gave back."""
        self.busy += one.wall
        if one.ending is Ending.STUCK:
            raise OSError(f"{task.name}: {one.reason}; what is done is kept: make room and run it again")
        if one.ending is Ending.LOST:
            self.again += 1
            self._again(task, one.reason)
        elif one.ending is Ending.FAILED:
            self._fail(task, one.ending, one.reason)
        else:
            self.folder.store(task.key, one.content)
            self.folder.note_time(task, one.wall)
            self.cost.learn(task.size, one.wall)
            self.ended.append((task, ""))

    def _fail(self, task: Task, ending: Ending, reason: str) -> None:
        failure = Failure(task.name, task.weight, reason, ending, self.begun[task.key])
        self.folder.store_failure(task.key, failure)
        self.ended.append((task, reason))


def evaluate_all(
    tasks: Sequence[Task],
    evaluate: Evaluate,
    folder: ResultFolder,
    workers: Workers,
    failing_weight: float = 0.0,
    attempts: int = ATTEMPTS,
    cost: CostModel | None = None,
    progress: Callable[[Standing], None] | None = None,
    try_failed: bool = False,
) -> Report:
    """Evaluate tasks whose results are not in the folder yet.

    Nine arguments: what, how, into what and where; from `failing_weight` on each has a default.

    Parameters
    ----------
    tasks
        With different keys, or equal ones for the same evaluation.
    evaluate
        A pure function of a task's payload, defined in a module.
    folder
        Open.
    workers
        Where they run.
    failing_weight
        Share of the whole weight that may fail [-], 0 to 1.
    attempts
        How often an evaluation is begun whose workers die or hang, >= 1.
    cost
        Expected wall times; None for those of what has run in the folder.
    progress
        Called some times a second, and whenever a task ends.
    try_failed
        Evaluate again what failed by an error of its own in an earlier call; what was lost always is.

    Raises
    ------
    TooManyFailed
        More of the weight failed than was allowed. All else goes on before that.
    EngineStopped
        The scheduler or the executor has gone away.
    OSError
        The disk is full, or fails.
    KeyboardInterrupt, Terminated
        Ctrl-C; SIGTERM.
    ValueError
        A number out of its range.

    After any of these the folder can be gone on with.
    """
    if not 0.0 <= failing_weight <= 1.0:
        raise ValueError(f"failing_weight = {failing_weight}: allowed 0 to 1")
    if attempts < 1:
        raise ValueError(f"attempts = {attempts}: allowed from 1")
    begun = clock.monotonic()
    single = {task.key: task for task in tasks}
    wanted = _missing(single.values(), folder, try_failed)
    cost = cost or CostModel()
    for size, wall in folder.times():
        cost.learn(size, wall)
    loop = _Mapping(evaluate, folder, workers, cost, attempts, deque(wanted))
    with Interruption() as interruption:
        try:
            _run(loop, single, interruption, progress)
            interruption.raise_wanted()
        except BaseException:
            workers.stop()
            raise
    failures = [(task, folder.failure(task.key)) for task in tasks]
    failed = tuple(failure for _, failure in failures if failure is not None)
    whole = sum(task.weight for task in tasks)
    lost = sum(task.weight for task, failure in failures if failure is not None) / whole if whole else 0.0
    if failed and lost > failing_weight * (1.0 + 1e-9):
        named = "; ".join(f"{one.name} (weight {one.weight:.3g}): {one.reason}" for one in failed)
        raise TooManyFailed(
            f"{len(failed)} of {len(tasks)} cases failed, {100.0 * lost:.3g} % of the weight, allowed "
            f"{100.0 * failing_weight:.3g} %: {named}"
        )
    wall = clock.monotonic() - begun
    reused = len(single) - len(wanted) - sum(folder.failure(key) is not None for key in single)
    count = len(single) - sum(folder.failure(key) is not None for key in single)
    return Report(count, max(reused, 0), failed, lost, loop.again, wall, loop.busy, workers.count)


def weighted_sum(tasks: Iterable[Task], folder: ResultFolder) -> PartSums:
    """Sum of the results of tasks by part: per metre rolled, times the weight, in the order of the tasks.

    Failed tasks are left out: whether the others stand for them is the caller's choice
    (`Report.failed_weight`).

    Parameters
    ----------
    tasks
        That were evaluated.
    folder
        Open.

    Raises
    ------
    FileNotFoundError, BrokenFile
        A task has neither a result nor failed; its file is not what was written.
    """
    total: PartSums = {}
    for task in tasks:
        if folder.failure(task.key) is not None:
            continue
        for part, sums in folder.sums(task.key).items():
            weighted = task.weight * sums.per_metre()
            total[part] = total[part] + weighted if part in total else weighted
    return total


def _missing(tasks: Iterable[Task], folder: ResultFolder, try_failed: bool) -> list[Task]:
    """What is to be evaluated, the longest first."""
    missing = []
    for task in tasks:
        failure = folder.failure(task.key)
        if failure is not None and (try_failed or failure.ending is Ending.LOST):
            folder.forget_failure(task.key)
            failure = None
        if failure is None and not folder.is_whole(task.key):
            missing.append(task)
    return sorted(missing, key=lambda task: -task.size)


def _run(
    loop: _Mapping,
    tasks: dict[str, Task],
    interruption: Interruption,
    progress: Callable[[Standing], None] | None,
) -> None:
    """The loop, until nothing waits or runs, or a signal has come."""
    failed = sum(loop.folder.failure(key) is not None for key in tasks)
    done = len(tasks) - len(loop.waiting) - failed
    work = sum(task.size for task in tasks.values())
    while (loop.waiting or loop.running) and not interruption.wanted:
        loop.fill()
        loop.collect()
        loop.fill()
        loop.keep()
        ended, loop.ended = [(task.name, reason) for task, reason in loop.ended], []
        for name, reason in ended or [("", "")]:
            done += bool(name) and not reason
            failed += bool(reason)
            if progress is not None:
                left, rest = _left(loop)
                fraction = 1.0 - rest / work if work else 1.0
                progress(Standing(done, failed, len(tasks), fraction, left, name, reason))


def _left(loop: _Mapping) -> tuple[float, float]:
    """Expected time that is left [s], infinite before anything has run; and size of what has not ended."""
    now = clock.monotonic()
    running = [(task.size, now - begun) for task, begun in loop.running.values()]
    waiting = [task.size for task in loop.waiting]
    rest = sum(waiting) + sum(size for size, _ in running)
    if not loop.cost.ratios and rest:
        return math.inf, rest
    return loop.cost.left(waiting, running, loop.workers.count), rest
