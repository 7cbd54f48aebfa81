"""Runs that are cut off keep what was simulated, and resumed ones are those without a break, bit for bit."""

import hashlib
import json
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from track_sections import into_left_curve

from hh_exudyn.case import Case
from hh_exudyn.log.store import CHECKPOINT_FILE, Run, open_run
from hh_exudyn.multibody.checkpoint import SEGMENT, read_checkpoint
from hh_exudyn.multibody.interruption import Terminated
from hh_exudyn.multibody.simulate import simulate

LOGS = ("contact", "motion", "energy", "control")


def files(run: Run) -> dict[str, str]:
    """Hash of every file but the status, whose wall times differ."""
    return {
        path.relative_to(run.directory).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(run.directory.rglob("*"))
        if path.is_file() and path.name != "status.json"
    }


def without_times(run: Run) -> dict[str, object]:
    walls = ("equilibrium_s", "wall_s", "kernel_s", "python_s", "exudyn_s")
    return {key: value for key, value in run.status.items() if key not in walls}


def signal_at(fraction: float, number: int = signal.SIGTERM) -> Callable[[float, str], None]:
    """A progress function that sends this process a signal once that far."""
    sent = []

    def progress(done: float, text: str) -> None:
        if done >= fraction and not sent:
            sent.append(done)
            signal.raise_signal(number)

    return progress


@pytest.fixture(scope="module")
def case(demo: Case) -> Case:
    """Two borders of segments within 1.3 s; rigid track and a coarse grid save time."""
    track = {"flexibility": "rigid", "sections": into_left_curve((12.0, 10.0, 12.0), 450.0, 1445.0)}
    return demo.with_changes(track=track, contact={"cells": [16, 8]})


@pytest.fixture(scope="module")
def whole(case: Case, runs: Path) -> Run:
    return simulate(case, runs / "without_a_break")


def test_sigterm_keeps_the_log_and_the_run_is_resumed(
    case: Case, whole: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # on any machine the signal comes between two borders, and the disk is free at the first
    monkeypatch.setattr("hh_exudyn.multibody.integration.PROGRESS_INTERVAL", 0.0)
    monkeypatch.setattr("hh_exudyn.log.recorder.KEEP_INTERVAL", 1e6)
    before = signal.getsignal(signal.SIGTERM)
    with pytest.raises(Terminated) as ended:
        simulate(case, tmp_path / "run", signal_at(0.55))
    assert ended.value.code == 143
    assert signal.getsignal(signal.SIGTERM) is before
    cut = open_run(tmp_path / "run")
    assert (cut.status["finished"], cut.status["reason"]) == (False, "terminated")
    there = cut.contact()
    assert there.equals(whole.contact().slice(0, there.num_rows))
    assert there["time"].to_numpy().max() > cut.status["simulated_s"] - 0.01
    stored = read_checkpoint(cut.directory)
    assert stored is not None
    assert stored.facts["step"] * 0.4e-3 == pytest.approx(SEGMENT)
    # a second break, before the next border
    with pytest.raises(KeyboardInterrupt):
        simulate(case, tmp_path / "run", signal_at(0.5, signal.SIGINT), resume=True)
    resumed = simulate(case, tmp_path / "run", resume=True)
    assert files(resumed) == files(whole)
    assert without_times(resumed) == without_times(whole)
    assert simulate(case, tmp_path / "run", resume=True) == resumed  # finished: nothing to do


def test_controllers_are_resumed(demo: Case, tmp_path: Path) -> None:
    """Driver, train, slip control on wet rails, and steering."""
    sections = into_left_curve((27.0, 8.0, 17.0), 450.0, 1440.0)
    wet = {"start_m": 30.0, "tread": 0.1, "gauge_corner": 0.1, "flange": 0.1}
    case = demo.with_changes(
        vehicle="iore_locomotive",
        friction={"tread": 0.4, "gauge_corner": 0.4, "flange": 0.4, "sections": [wet]},
        track={"flexibility": "rigid", "sections": sections},
        contact={"cells": [16, 8]},
        steering={"gain": 0.5, "softening": 0.5},
    )
    whole = simulate(case, tmp_path / "whole")
    with pytest.raises(Terminated):
        simulate(case, tmp_path / "cut", signal_at(0.6))
    assert files(simulate(case, tmp_path / "cut", resume=True)) == files(whole)
    log = whole.read("control")
    assert log["torque"].to_numpy().std() > 10.0  # N m: they did something
    assert log["yaw_rest"].to_numpy().std() > 1e-5  # rad


def test_another_run_is_not_resumed(case: Case, tmp_path: Path) -> None:
    with pytest.raises(Terminated):
        simulate(case, tmp_path / "run", signal_at(0.2))
    stamps = files(open_run(tmp_path / "run"))
    with pytest.raises(FileExistsError, match="other case, vehicle or files"):
        simulate(case.with_changes(friction=0.3), tmp_path / "run", resume=True)
    made = json.loads((tmp_path / "run" / "provenance.json").read_text())
    (tmp_path / "run" / "provenance.json").write_text(json.dumps({**made, "code": "older"}))
    with pytest.raises(FileExistsError, match="other code of hh-exudyn"):
        simulate(case, tmp_path / "run", resume=True)
    (tmp_path / "run" / "provenance.json").write_text(json.dumps(made, indent=2) + "\n")
    assert files(open_run(tmp_path / "run")) == stamps


def test_a_broken_checkpoint_is_named(case: Case, tmp_path: Path) -> None:
    with pytest.raises(Terminated):
        simulate(case, tmp_path / "run", signal_at(0.6))
    path = tmp_path / "run" / CHECKPOINT_FILE
    path.write_bytes(path.read_bytes()[:5000])
    with pytest.raises(ValueError, match=r"checkpoint\.npz: is broken .*delete it"):
        simulate(case, tmp_path / "run", resume=True)


def test_a_sealed_run_is_made_again_elsewhere(case: Case, whole: Run, tmp_path: Path) -> None:
    """From its own folder, moved: the same bytes."""
    import shutil

    from hh_exudyn.case import read_case

    sent = shutil.copytree(whole.directory, tmp_path / "sent")
    again = simulate(read_case(sent / "case.toml"), tmp_path / "again")
    assert files(again) == files(whole)


KILLED = """
import sys
from pathlib import Path
from hh_exudyn.case import read_case
from hh_exudyn.multibody.simulate import simulate
simulate(read_case(sys.argv[1]), Path(sys.argv[2]), resume=sys.argv[3] == "resume")
"""


@pytest.mark.slow
def test_random_kills(case: Case, whole: Run, tmp_path: Path) -> None:
    """12 times at a random moment: all but the last second is there, and the resumed run is the whole one."""
    source = str(whole.directory / "case.toml")
    last = whole.contact()["time"].to_numpy().max()
    rng = random.Random(14)

    def started(folder: Path, how: str) -> subprocess.Popen[bytes]:
        words = [sys.executable, "-c", KILLED, source, str(folder), how]
        return subprocess.Popen(words, stderr=subprocess.DEVNULL)

    for number in range(12):
        folder = tmp_path / f"run{number}"
        process = started(folder, "new")
        while not (folder / "status.json").is_file() and process.poll() is None:
            time.sleep(0.01)
        begun = time.monotonic()
        time.sleep(rng.uniform(0.0, 3.0))
        kind = rng.choice([signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
        process.send_signal(kind)
        lasted = time.monotonic() - begun
        process.wait()
        run = open_run(folder)
        if not run.status["finished"]:
            assert process.returncode in (-kind, 143, 1), kind
            if lasted > 1.5:
                rows = run.contact()
                assert rows.equals(whole.contact().slice(0, rows.num_rows))
                assert 0.0 < rows["time"].to_numpy().max() <= last
        assert started(folder, "resume").wait() == 0
        assert files(open_run(folder)) == files(whole), (number, kind)
        assert np.array_equal(open_run(folder).energy()["time"], whole.energy()["time"])
