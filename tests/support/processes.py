"""Processes of a test: who began whom, who is alive."""

import time
from collections.abc import Callable
from pathlib import Path


def wait_for(condition: Callable[[], bool], seconds: float = 120.0) -> None:
    """Wait until something is so; a loaded machine is slow."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it does not come"
        time.sleep(0.02)


def descendants(number: int) -> list[int]:
    """Processes that a process began, and those that they began."""
    try:
        files = list(Path(f"/proc/{number}/task").glob("*/children"))
        own = [int(one) for file in files for one in file.read_text().split()]
    except (FileNotFoundError, ProcessLookupError):
        return []
    return [*own, *(far for one in own for far in descendants(one))]


def is_alive(number: int) -> bool:
    """Whether a process is there, and has not ended unattended."""
    try:
        return Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def begun_as_worker(number: int) -> bool:
    """Whether a process was begun by `multiprocessing` for some work."""
    try:
        return b"spawn_main" in Path(f"/proc/{number}/cmdline").read_bytes()
    except (FileNotFoundError, ProcessLookupError):
        return False
