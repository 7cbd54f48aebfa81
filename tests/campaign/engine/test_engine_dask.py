"""The engine on a Dask cluster of this machine: the same files, and a worker that dies or hangs."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
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


def test_without_a_scheduler_that_is_said() -> None:
    with pytest.raises(ValueError, match=r"scheduler tcp://127\.0\.0\.1:9: does not answer"):
        DaskWorkers("tcp://127.0.0.1:9")
