"""What goes wrong in a campaign: workers die, hang or fail, files break, the main process is killed."""

import errno
import json
import os
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from processes import descendants, is_alive, wait_for
from stand_in import CODE, Payload, evaluate, tasks

from hh_exudyn.campaign.engine.cost import CostModel
from hh_exudyn.campaign.engine.mapping import Report, Standing, TooManyFailed, evaluate_all, weighted_sum
from hh_exudyn.campaign.engine.results import SUMS, ResultFolder
from hh_exudyn.campaign.engine.task import Ending, Task
from hh_exudyn.campaign.engine.workers import GivenWorkers, ProcessWorkers

COUNT = 8


def folder(path: Path, campaign: str = "ours", code: dict[str, str] = CODE) -> ResultFolder:
    return ResultFolder(path, campaign, code)


def in_threads(path: Path, work: list[Task], **options: object) -> Report:
    """Evaluated without processes: for what does not kill."""
    with ThreadPoolExecutor(2) as threads, folder(path) as results:
        return evaluate_all(work, evaluate, results, GivenWorkers(threads, 2), **options)  # type: ignore[arg-type]


def contents(path: Path) -> dict[str, bytes]:
    """Everything of a folder but the times."""
    files = (file for file in path.rglob("*") if file.is_file() and file.name != "times.jsonl")
    return {str(file.relative_to(path)): file.read_bytes() for file in files}


@pytest.fixture
def undisturbed(tmp_path: Path) -> dict[str, bytes]:
    """The folder of a run without a fault."""
    in_threads(tmp_path / "undisturbed", tasks([Payload(1.0 + i) for i in range(COUNT)]))
    return contents(tmp_path / "undisturbed")


@pytest.mark.parametrize("fault", ["die", pytest.param("hang", marks=pytest.mark.slow)])
def test_dying_and_hanging_workers_change_no_byte(
    fault: str, tmp_path: Path, undisturbed: dict[str, bytes]
) -> None:
    """The work runs again and gives what it would have given."""
    faults = {2: fault}
    work = tasks([Payload(1.0 + i, 0.0, faults.get(i, ""), tmp_path) for i in range(COUNT)])
    told: list[Standing] = []
    with ProcessWorkers(2) as workers, folder(tmp_path / "out") as results:
        cost = CostModel(least_timeout=20.0)  # a worker begins and loads packages first
        report = evaluate_all(work, evaluate, results, workers, cost=cost, progress=told.append)
    assert report.failures == ()
    assert (report.count, report.reused) == (COUNT, 0)
    assert report.begun_again >= 1
    assert contents(tmp_path / "out") == undisturbed
    assert told[-1].done == COUNT
    assert told[-1].fraction == 1.0
    assert {standing.ended for standing in told if standing.ended} == {task.name for task in work}


def test_who_always_kills_its_worker_fails_alone(tmp_path: Path) -> None:
    """Its neighbours, that died with it, do not."""
    work = tasks([Payload(1.0), Payload(2.0, 0.0, "die", tmp_path, 99), Payload(3.0), Payload(4.0)])
    with ProcessWorkers(2) as workers, folder(tmp_path / "out") as results:
        report = evaluate_all(work, evaluate, results, workers, failing_weight=0.5, attempts=2)
        assert [one.name for one in report.failures] == ["case 2"]
        (failure,) = report.failures
        assert (failure.ending, failure.attempts, failure.weight) == (Ending.LOST, 2, 2.0)
        assert "worker died" in failure.reason
        assert report.failed_weight == pytest.approx(2.0 / 7.0)
        assert set(weighted_sum(work, results)) == {"run"}


def test_failed_cases_are_reported_with_reason_and_weight(tmp_path: Path) -> None:
    work = tasks([Payload(1.0), Payload(2.0, 0.0, "raise", tmp_path, 99), Payload(3.0)])
    with pytest.raises(
        TooManyFailed, match=r"33\.3 % .*allowed 0 %: case 2 \(weight 2\): Unpicklable: wheel 2L has left its"
    ):
        in_threads(tmp_path / "out", work)
    kept = json.loads((tmp_path / "out" / SUMS / "0002.000.failed.json").read_text())
    assert kept["weight"] == 2.0
    report = in_threads(tmp_path / "out", work, failing_weight=0.4)
    assert report.reused == 2
    assert [failure.name for failure in report.failures] == ["case 2"]
    assert (tmp_path / "2").stat().st_size == 1  # an error of its own is not tried again
    (tmp_path / "2").write_text("x" * 99)  # it is mended
    assert in_threads(tmp_path / "out", work, try_failed=True).failures == ()


def test_a_corrupted_result_is_made_again(tmp_path: Path, undisturbed: dict[str, bytes]) -> None:
    work = tasks([Payload(1.0 + i) for i in range(COUNT)])
    in_threads(tmp_path / "out", work)
    paths = sorted((tmp_path / "out" / SUMS).glob("*.npz"))
    whole = paths[3].read_bytes()
    paths[3].write_bytes(whole[: len(whole) // 2])
    paths[5].write_bytes(whole)  # of another case
    middle = bytearray(paths[6].read_bytes())
    middle[len(middle) // 3] ^= 0x55
    paths[6].write_bytes(bytes(middle))
    report = in_threads(tmp_path / "out", work)
    assert (report.count, report.reused) == (COUNT, COUNT - 3)
    assert contents(tmp_path / "out") == undisturbed


def test_a_folder_of_something_else_is_refused(tmp_path: Path) -> None:
    in_threads(tmp_path / "out", tasks([Payload(1.0)]))
    before = contents(tmp_path / "out")
    with (
        pytest.raises(FileExistsError, match="campaign 'ours', wanted 'theirs'"),
        folder(tmp_path / "out", "theirs"),
    ):
        pass
    with (
        pytest.raises(FileExistsError, match=r"other code \(damage\)"),
        folder(tmp_path / "out", code={"damage": "2"}),
    ):
        pass
    (tmp_path / "notes").mkdir()
    (tmp_path / "notes" / "notes.txt").write_text("mine")
    with pytest.raises(FileExistsError, match="holds other files"), folder(tmp_path / "notes"):
        pass
    with (
        folder(tmp_path / "out"),
        pytest.raises(FileExistsError, match="another process"),
        folder(tmp_path / "out"),
    ):
        pass
    assert contents(tmp_path / "out") == before
    assert contents(tmp_path / "notes") == {"notes.txt": b"mine"}


def test_a_full_disk_stops_and_can_be_gone_on_with(tmp_path: Path, undisturbed: dict[str, bytes]) -> None:
    work = tasks([Payload(1.0 + i, 0.0, "disk" if i == 4 else "", tmp_path) for i in range(COUNT)])
    with pytest.raises(OSError, match=r"case 5: .*No space left on device; what is done is kept"):
        in_threads(tmp_path / "out", work)
    assert not list((tmp_path / "out" / SUMS).glob("*.failed.json"))
    in_threads(tmp_path / "out", work)
    assert contents(tmp_path / "out") == undisturbed


def test_a_disk_that_fills_while_a_result_is_written_leaves_no_half(
    tmp_path: Path, undisturbed: dict[str, bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The main process writes results: the sixth file does not come to the disk."""
    work, calls, sync = tasks([Payload(1.0 + i) for i in range(COUNT)]), [0], os.fsync

    def full(number: int) -> None:
        calls[0] += 1
        if calls[0] > 12:
            raise OSError(errno.ENOSPC, "No space left on device")
        sync(number)

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        with pytest.raises(OSError, match="No space left on device"):
            in_threads(tmp_path / "out", work)
    there = {name: text for name, text in contents(tmp_path / "out").items() if name.startswith(SUMS)}
    whole = {name: text for name, text in there.items() if name.endswith(".npz")}
    assert 0 < len(whole) < COUNT
    assert whole.items() <= undisturbed.items()
    report = in_threads(tmp_path / "out", work)
    assert report.reused == len(whole)
    assert contents(tmp_path / "out") == undisturbed


@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="the system does not list processes")
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_the_main_process_is_killed_and_its_folder_gone_on_with(
    number: int, tmp_path: Path, undisturbed: dict[str, bytes]
) -> None:
    """Its workers end with it, and the rest gives the bytes of an undisturbed run."""
    out = tmp_path / "out"
    process = subprocess.Popen(
        [sys.executable, "-c", f"from stand_in_campaign import main; main({str(out)!r}, {COUNT}, 3)"],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        wait_for(lambda: len(list((out / SUMS).glob("*.npz"))) == 3)
        workers = descendants(process.pid)
        assert workers
    finally:
        process.send_signal(number)
        _, said = process.communicate(timeout=120.0)
    assert process.returncode == {signal.SIGTERM: 128 + signal.SIGTERM}.get(number, -number), said
    wait_for(lambda: not any(is_alive(worker) for worker in workers))
    report = in_threads(out, tasks([Payload(1.0 + i) for i in range(COUNT)]))
    assert (report.count, report.reused) == (COUNT, 3)
    assert contents(out) == undisturbed
