"""Worker processes of a pool: one thread each, begun anew (spawn), and no longer there than their parent."""

import multiprocessing
import os
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager, suppress
from multiprocessing.connection import wait
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any

SPAWN = multiprocessing.get_context("spawn")  # a copy of a process with threads may hang
_THREADS = ("OMP_NUM_THREADS", "NUMBA_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


class KnownProcesses(SpawnContext):
    """Begins processes as `SPAWN` does, and knows them: an executor can end none of its own."""

    def __init__(self) -> None:
        super().__init__()
        self._begun: list[SpawnProcess] = []

    def Process(self, *arguments: Any, **options: Any) -> SpawnProcess:  # type: ignore[override]
        """A process that has not started yet."""
        process = SpawnProcess(*arguments, **options)
        self._begun.append(process)
        return process

    def kill(self) -> None:
        """End all of them at once."""
        for process in self._begun:
            with suppress(ValueError):  # closed by its executor
                process.kill()


def usable_cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@contextmanager
def process_pool(
    count: int,
    begin: Callable[..., None] | None = None,
    arguments: tuple[Any, ...] = (),
    context: SpawnContext = SPAWN,
) -> Iterator[ProcessPoolExecutor]:
    """A pool of processes of one thread each; what they run is waited for at the end.

    Parameters
    ----------
    count
        Number of processes.
    begin, arguments
        Called in every process before its first work.
    context
        That begins the processes.
    """
    with (
        one_thread_each(),
        ProcessPoolExecutor(count, context, initializer=_begin, initargs=(begin, arguments)) as pool,
    ):
        yield pool


@contextmanager
def one_thread_each() -> Iterator[None]:
    """Processes that begin meanwhile use one thread each."""
    before = {name: os.environ.get(name) for name in _THREADS}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _begin(begin: Callable[..., None] | None, arguments: tuple[Any, ...]) -> None:
    """Begin a worker."""
    threading.Thread(target=_end_with_parent, daemon=True).start()
    if begin is not None:
        begin(*arguments)


def _end_with_parent() -> None:
    """End this process when its parent does, however that ends: a pool's worker waits for work for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)
