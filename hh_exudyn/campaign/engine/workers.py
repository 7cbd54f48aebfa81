"""Where evaluations run: processes of this machine, a Dask cluster, or any executor of the caller.

All are executors of ``concurrent.futures``; beside `submit` they say what the error of a future means, and
begin anew after a worker has died or hung.
"""

import os
import signal
from collections.abc import Callable, Collection
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future
from contextlib import ExitStack
from enum import Enum
from typing import Any, Protocol, Self

from hh_exudyn.workers import KnownProcesses, process_pool, usable_cores


class Cause(Enum):
    """What the error of a future means."""

    DIED = "a worker died"  # one of those of this pool, perhaps with other work
    GONE = "the scheduler has gone away"
    RAISED = "the work could not be sent or given back"


class EngineStopped(RuntimeError):
    """The scheduler or the executor has gone away; what was done before is kept."""


class Workers(Protocol):
    """What `hh_exudyn.campaign.engine.mapping.evaluate_all` needs of an executor."""

    @property
    def count(self) -> int:
        """Number of evaluations at a time."""

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Begin some work."""

    def cause(self, error: BaseException) -> Cause:
        """What the error of a future means."""

    def renew(
        self, running: Collection[Future[Any]], hung: Collection[Future[Any]]
    ) -> Collection[Future[Any]]:
        """End what hangs, and begin workers anew; the futures among `running` that ended by it."""

    def stop(self) -> None:
        """End all work at once."""


class ProcessWorkers:
    """A pool of processes of this machine, one thread each.

    Parameters
    ----------
    count
        Number of processes; None for one a core that this process may use.

    Raises
    ------
    ValueError
        A count below 1.
    """

    def __init__(self, count: int | None = None) -> None:
        if count is not None and count < 1:
            raise ValueError(f"workers = {count}: allowed from 1")
        self.count = count or usable_cores()
        self._start()

    def _start(self) -> None:
        self._open, self._processes = ExitStack(), KnownProcesses()
        self._pool = self._open.enter_context(process_pool(self.count, _begin, (), self._processes))

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Begin some work in a process."""
        return self._pool.submit(function, *arguments)

    def cause(self, error: BaseException) -> Cause:
        """A pool is broken by the death of any of its processes, and all futures with it."""
        return Cause.DIED if isinstance(error, BrokenExecutor) else Cause.RAISED

    def renew(
        self, running: Collection[Future[Any]], hung: Collection[Future[Any]]
    ) -> Collection[Future[Any]]:
        """End all processes, and begin a new pool: an executor cannot end one."""
        self._end()
        self._start()
        return running

    def stop(self) -> None:
        """End all processes at once."""
        self._end()

    def _end(self) -> None:
        self._processes.kill()
        self._pool.shutdown(cancel_futures=True)
        self._open.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self._end()


class DaskWorkers:
    """The workers of a Dask cluster, each with one thread; the extra ``cluster`` has the package.

    Dask gives the work of a worker that died to others; a worker that hangs is begun anew by its nanny.

    Parameters
    ----------
    scheduler
        Address, as ``tcp://host:8786``.

    Raises
    ------
    ValueError
        Dask is not installed, the scheduler does not answer, or has no workers.
    """

    def __init__(self, scheduler: str) -> None:
        try:
            import distributed
        except ImportError:
            raise ValueError(
                "a scheduler needs Dask, which is not installed: pip install 'hh-exudyn[cluster]'"
            ) from None
        try:
            self._client = distributed.Client(scheduler, timeout="10s", set_as_default=False)
        except (OSError, ValueError) as error:
            raise ValueError(f"scheduler {scheduler}: does not answer ({error})") from None
        self._died: type[BaseException] = distributed.KilledWorker
        self._address = scheduler
        self._executor = self._client.get_executor(pure=False, retries=0)
        self._keys: dict[Future[Any], str] = {}
        if not self._client.ncores():
            self._client.close()
            raise ValueError(f"scheduler {scheduler}: has no workers; begin some: dask worker {scheduler}")

    @property
    def count(self) -> int:
        """Threads of the workers that are there now."""
        return max(1, sum(self._asked(self._client.ncores).values()))

    def _asked(self, question: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
        """What the scheduler answers; EngineStopped where it does not."""
        try:
            return question(*arguments, **options)
        except (OSError, RuntimeError) as error:
            raise EngineStopped(
                f"scheduler {self._address} has gone away ({error}); what is done is kept: run it again"
            ) from error

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Begin some work on the cluster."""
        key = f"hh-exudyn-{os.getpid()}-{os.urandom(8).hex()}"
        future: Future[Any] = self._executor.submit(function, *arguments, key=key)
        self._keys[future] = key
        return future

    def cause(self, error: BaseException) -> Cause:
        """Dask names the work whose workers died again and again; cancelled work had no scheduler."""
        if isinstance(error, self._died):
            return Cause.DIED
        gone = isinstance(error, CancelledError | OSError) or "Cancelled" in type(error).__name__
        return Cause.GONE if gone else Cause.RAISED

    def renew(
        self, running: Collection[Future[Any]], hung: Collection[Future[Any]]
    ) -> Collection[Future[Any]]:
        """Begin those workers anew that have the hung work."""
        wanted = {self._keys[future] for future in hung}
        for future in hung:
            future.cancel()
        processing = self._asked(self._client.processing)
        held = [worker for worker, keys in processing.items() if wanted & set(map(str, keys))]
        if held:
            self._asked(self._client.restart_workers, held, raise_for_error=False)
        return hung

    def stop(self) -> None:
        """Give up all work; what runs on the cluster ends by itself, and is forgotten."""
        for future in self._keys:
            future.cancel()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.stop()
        self._client.close()


class GivenWorkers:
    """An executor of the caller, who ends it: threads, MPI, a queue.

    Its work cannot be ended from outside: what hangs is left hanging, and runs again beside it.

    Parameters
    ----------
    executor
        Of ``concurrent.futures``.
    count
        Number of evaluations at a time.
    """

    def __init__(self, executor: Executor, count: int) -> None:
        self.count, self._executor = count, executor

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Begin some work."""
        return self._executor.submit(function, *arguments)

    def cause(self, error: BaseException) -> Cause:
        """A broken executor stays broken: only its owner can begin a new one."""
        return Cause.GONE if isinstance(error, BrokenExecutor | CancelledError) else Cause.RAISED

    def renew(
        self, running: Collection[Future[Any]], hung: Collection[Future[Any]]
    ) -> Collection[Future[Any]]:
        """Nothing ends."""
        return hung

    def stop(self) -> None:
        """Nothing can be ended."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        pass


def _begin() -> None:
    """Begin a worker: Ctrl-C is for the main process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
