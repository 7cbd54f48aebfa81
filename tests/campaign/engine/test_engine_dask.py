"""The engine on a Dask cluster of this machine: the same files, and a worker that dies or hangs."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from processes import wait_for
from stand_in import CODE, Payload, evaluate, tasks

from hh_exudyn.campaign.engine.cost import CostModel
from hh_exudyn.campaign.engine.mapping import evaluate_all
from hh_exudyn.campaign.engine.results import SUMS, ResultFolder
from hh_exudyn.campaign.engine.workers import DaskWorkers, EngineStopped, ProcessWorkers

distributed = pytest.importorskip(
    "distributed", reason="dask[distributed] (the extra cluster) is not installed"
)
pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore")]
COUNT = 6


@pytest.fixture
def cluster() -> Iterator[Any]:
    options = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster:
        yield cluster


def files(path: Path) -> dict[str, bytes]:
    return {file.name: file.read_bytes() for file in (path / SUMS).iterdir()}


def test_processes_and_dask_give_identical_files_whatever_dies(cluster: Any, tmp_path: Path) -> None:
    with ProcessWorkers(2) as workers, ResultFolder(tmp_path / "processes", "ours", CODE) as folder:
        evaluate_all(tasks([Payload(1.0 + i) for i in range(COUNT)]), evaluate, folder, workers)
    faults = {1: "die", 3: "hang"}
    work = tasks([Payload(1.0 + i, 0.0, faults.get(i, ""), tmp_path) for i in range(COUNT)])
    cost = CostModel(least_timeout=25.0)  # a worker begins and loads packages first
    with (
        DaskWorkers(cluster.scheduler_address) as workers,
        ResultFolder(tmp_path / "dask", "ours", CODE) as folder,
    ):
        assert workers.count == 2
        report = evaluate_all(work, evaluate, folder, workers, cost=cost)
    assert report.failures == ()
    assert files(tmp_path / "dask") == files(tmp_path / "processes")


def test_a_scheduler_that_goes_away_stops_with_a_folder_to_go_on_with(cluster: Any, tmp_path: Path) -> None:
    work = tasks([Payload(1.0 + i, 0.5) for i in range(COUNT)])
    done: list[str] = []

    def close(standing: Any) -> None:
        done.extend(filter(None, [standing.ended]))
        if len(done) == 1:
            cluster.close()

    with (
        DaskWorkers(cluster.scheduler_address) as workers,
        ResultFolder(tmp_path / "out", "ours", CODE) as folder,
        pytest.raises(EngineStopped, match="run it again"),
    ):
        evaluate_all(work, evaluate, folder, workers, progress=close)
    with ProcessWorkers(2) as workers, ResultFolder(tmp_path / "out", "ours", CODE) as folder:
        report = evaluate_all(work, evaluate, folder, workers)
    assert report.count == COUNT
    assert report.reused >= 1


@pytest.fixture
def begun(tmp_path: Path) -> "Iterator[tuple[str, subprocess.Popen[bytes]]]":
    """A scheduler and a worker in processes of their own: its address, and its process."""
    known = tmp_path / "scheduler.json"
    words = [sys.executable, "-m", "dask"]
    own = [*words, "scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", str(known)]
    of_worker = [*words, "worker", "--nthreads", "1", "--no-dashboard", "--scheduler-file", str(known)]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    quiet = {"env": environment, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    scheduler = subprocess.Popen(own, **quiet)
    worker = subprocess.Popen([*of_worker, "--local-directory", str(tmp_path)], **quiet)
    try:
        wait_for(known.is_file)
        address = json.loads(known.read_text())["address"]
        with distributed.Client(address, set_as_default=False) as client:
            client.wait_for_workers(1, timeout=120)
        yield address, scheduler
    finally:
        for process in (worker, scheduler):
            process.kill()
            process.wait()


def test_a_scheduler_that_is_killed_leaves_a_folder_to_go_on_with(
    begun: "tuple[str, subprocess.Popen[bytes]]", tmp_path: Path
) -> None:
    """kill -9 after the first result; processes of this machine make the rest, with the same bytes."""
    address, scheduler = begun
    work = tasks([Payload(1.0 + i, 0.5) for i in range(COUNT)])
    done: list[str] = []

    def kill(standing: Any) -> None:
        done.extend(filter(None, [standing.ended]))
        if len(done) == 1:
            scheduler.kill()

    with (
        DaskWorkers(address) as workers,
        ResultFolder(tmp_path / "out", "ours", CODE) as folder,
        pytest.raises(EngineStopped, match="run it again"),
    ):
        evaluate_all(work, evaluate, folder, workers, progress=kill)
    with ProcessWorkers(2) as workers, ResultFolder(tmp_path / "out", "ours", CODE) as folder:
        report = evaluate_all(work, evaluate, folder, workers)
    assert (report.count, report.failures) == (COUNT, ())
    assert report.reused >= 1
    with ProcessWorkers(2) as workers, ResultFolder(tmp_path / "quiet", "ours", CODE) as folder:
        evaluate_all(work, evaluate, folder, workers)
    assert files(tmp_path / "out") == files(tmp_path / "quiet")


def test_without_a_scheduler_that_is_said() -> None:
    with pytest.raises(ValueError, match=r"scheduler tcp://127\.0\.0\.1:9: does not answer"):
        DaskWorkers("tcp://127.0.0.1:9")
