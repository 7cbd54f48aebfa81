"""kill -9 at random times, of workers and of the main process: the folder ends with the bytes of a quiet run.

Eight kills; by hand more, with what was killed when:
``HH_EXUDYN_KILLS=100 pytest -n 0 -m slow --log-cli-level=INFO tests/campaign/engine/test_engine_kills.py``.
"""

import logging
import os
import random
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

import pytest
from processes import begun_as_worker, descendants, is_alive, wait_for
from stand_in import CODE, Payload, evaluate, tasks

from hh_exudyn.campaign.engine.mapping import evaluate_all
from hh_exudyn.campaign.engine.results import SUMS, ResultFolder
from hh_exudyn.campaign.engine.workers import GivenWorkers

KILLS = int(os.environ.get("HH_EXUDYN_KILLS", "8"))
COUNT = 25 * KILLS  # more than can end between the kills
SECONDS = 0.05

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="the system does not list processes"),
]


def begin(out: Path) -> "subprocess.Popen[str]":
    """The campaign in a process of its own."""
    text = f"from stand_in_campaign import to_be_killed; to_be_killed({str(out)!r}, {COUNT}, {SECONDS})"
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    return subprocess.Popen([sys.executable, "-c", text], env=environment, stderr=subprocess.PIPE, text=True)


def workers_of(process: "subprocess.Popen[str]") -> list[int]:
    return [number for number in descendants(process.pid) if begun_as_worker(number) and is_alive(number)]


def results(path: Path) -> dict[str, bytes]:
    """Files of results; those that are there now, while a process works on them."""
    return {file.name: file.read_bytes() for file in (path / SUMS).iterdir()}


def done(path: Path) -> int:
    """Number of results."""
    return len(list((path / SUMS).glob("*.npz"))) if (path / SUMS).is_dir() else 0


def quiet(path: Path) -> dict[str, bytes]:
    """Evaluated without processes, or gone on with."""
    work = tasks([Payload(1.0 + i) for i in range(COUNT)])
    with ThreadPoolExecutor(2) as threads, ResultFolder(path, "ours", CODE) as folder:
        assert evaluate_all(work, evaluate, folder, GivenWorkers(threads, 2)).failures == ()
    return results(path)


def wait_for_more(out: Path, process: "subprocess.Popen[str]", more: int) -> None:
    """Wait until there are workers, and some results more; or the process has ended by itself."""
    wait_for(lambda: bool(workers_of(process)) or process.poll() is not None)
    enough = done(out) + more
    wait_for(lambda: done(out) >= enough or process.poll() is not None)


def test_kills_at_random_times_change_no_byte(tmp_path: Path) -> None:
    chance, out = random.Random(16), tmp_path / "out"
    killed, standing = {"worker": 0, "main": 0}, []
    process = begin(out)
    try:
        while sum(killed.values()) < KILLS:
            wait_for_more(out, process, chance.choice((0, 0, 1, 2, 3, 5, 8)))
            time.sleep(chance.uniform(0.0, 2.0 * SECONDS))
            workers = workers_of(process)
            if process.poll() is None and workers and chance.random() < 0.6:
                with suppress(ProcessLookupError):
                    os.kill(chance.choice(workers), signal.SIGKILL)
                    killed["worker"] += 1
                    time.sleep(0.1)
                continue
            killed["main"] += process.poll() is None  # else: too many kills of one evaluation, and it said so
            process.kill()
            process.communicate()
            wait_for(lambda gone=workers: not any(is_alive(worker) for worker in gone))
            standing.append(done(out))
            process = begin(out)
    finally:
        process.kill()
        process.communicate()
    standing.append(done(out))
    logging.getLogger(__name__).info(f"killed: {killed}; results each time that the main ended: {standing}")
    assert min(killed.values()) > 0
    assert 0 < standing[-1] < COUNT  # it was killed in its midst
    assert quiet(out) == quiet(tmp_path / "undisturbed")
