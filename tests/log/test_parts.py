"""Parts of a log that are broken in any way: named with a remedy, and the rest can be read."""

import os
import threading
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.log.channels import LOGS
from hh_exudyn.log.parts import BrokenPart
from hh_exudyn.log.recorder import Recorder
from hh_exudyn.log.store import Run, open_run

COLUMNS = len(LOGS["contact"])


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Three parts of ten rows, the time of row i is i."""
    with Recorder(tmp_path / "run", {"case": 'name = "x"'}, rows_per_part=10) as recorder:
        recorder.append_rows("contact", np.arange(30.0)[:, None] * np.ones(COLUMNS))
        recorder.append_rows("energy", np.ones((3, len(LOGS["energy"]))))
    return open_run(tmp_path / "run")


def _cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def _empty(path: Path) -> None:
    path.write_bytes(b"")


def _zeros(path: Path) -> None:
    path.write_bytes(bytes(path.stat().st_size))


def _words(path: Path) -> None:
    path.write_text("not Parquet, but words\n" * 50)


def _flipped(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[60] ^= 0xFF  # in the data of the column of the time
    path.write_bytes(content)


def _of_another_log(path: Path) -> None:
    path.write_bytes((path.parents[1] / "energy" / "part-00000.parquet").read_bytes())


@pytest.mark.parametrize("breaking", [_cut, _empty, _zeros, _words, _flipped, _of_another_log, Path.unlink])
def test_a_broken_part_is_named_and_the_rest_is_read(run: Run, breaking: Callable[[Path], None]) -> None:
    part = run.directory / "contact" / "part-00001.parquet"
    breaking(part)
    with pytest.raises(BrokenPart, match=r"part-00001\.parquet: .*--skip-broken-parts") as caught:
        run.contact()
    assert "\n" not in str(caught.value)
    with pytest.raises(BrokenPart):
        list(run.batches("contact"))
    rest = open_run(run.directory, skip_broken_parts=True)
    wanted = [*range(10), *range(20, 30)]
    assert rest.contact()["time"].to_pylist() == wanted
    assert [
        time for batch in rest.batches("contact", ["time"]) for time in batch["time"].to_pylist()
    ] == wanted
    assert [broken.path for broken in rest.broken_parts()] == [part]


def test_nothing_is_broken(run: Run) -> None:
    assert run.broken_parts() == []


def test_rows_on_disk_grow_with_the_clock(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """`keep` writes after the interval; the part grows in place."""
    now = [0.0]
    monkeypatch.setattr("hh_exudyn.log.recorder.time.monotonic", lambda: now[0])
    with Recorder(tmp_path / "run", {}) as recorder:
        for second in range(4):
            recorder.append_rows("contact", np.full((5, COLUMNS), float(second)))
            now[0] += 0.5
            recorder.keep()
            recorder.settle()
            there = list((tmp_path / "run" / "contact").glob("*"))
            assert len(there) == (0 if second == 0 else 1)
        assert open_run(tmp_path / "run").contact().num_rows == 20


@pytest.mark.parametrize("kept", [0, 7, 10, 23])
def test_a_log_is_taken_up_behind_its_first_rows(tmp_path: Path, kept: int) -> None:
    """Whatever was written later is gone, and the files are those of a log without a break."""

    def record(name: str, first: int, count: int, resumed: dict[str, int] | None = None) -> Path:
        with Recorder(tmp_path / name, {}, rows_per_part=10, resumed=resumed) as recorder:
            recorder.append_rows("contact", np.arange(first, first + count)[:, None] * np.ones(COLUMNS))
        return tmp_path / name / "contact"

    whole = record("whole", 0, 34)
    record("broken", 0, 29)
    (tmp_path / "broken" / "contact" / "part-00003.parquet.tmp").write_bytes(b"PAR1")
    taken_up = record("broken", kept, 34 - kept, {"contact": kept})
    assert [path.name for path in sorted(taken_up.iterdir())] == [
        path.name for path in sorted(whole.iterdir())
    ]
    for path in whole.iterdir():
        assert (taken_up / path.name).read_bytes() == path.read_bytes()


def test_one_writer_at_a_time(tmp_path: Path) -> None:
    pytest.importorskip("fcntl")
    with (
        Recorder(tmp_path / "run", {}),
        pytest.raises(FileExistsError, match="another process writes a run into it"),
    ):
        Recorder(tmp_path / "run", {}, resumed={})
    Recorder(tmp_path / "run", {}, resumed={}).close()


def test_what_is_behind_waits_for_a_slow_disk_and_comes_never_behind_a_fault(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A second writing queues behind the first, a third is left to the next call; a fault ends all behind."""
    gate, calls = threading.Event(), []
    sync = os.fsync

    def slow(descriptor: int) -> None:
        assert gate.wait(10.0)
        sync(descriptor)

    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    with Recorder(tmp_path / "run", {}) as recorder:
        with monkeypatch.context() as patch:
            patch.setattr("hh_exudyn.log.parts.os.fsync", slow)
            for name in ("first", "second", "third"):
                recorder.append_rows("contact", np.zeros((1, COLUMNS)))
                recorder.flush(partial(calls.append, name))
            assert calls == []
            gate.set()
            recorder.settle()
        assert calls == ["first", "second"]
        with monkeypatch.context() as patch:
            gate.clear()
            patch.setattr("hh_exudyn.log.parts.os.fsync", full)
            recorder.append_rows("contact", np.zeros((1, COLUMNS)))
            with pytest.raises(OSError, match="No space"):
                for _ in range(2):
                    recorder.flush(partial(calls.append, "behind a fault"))
                recorder.settle()
        assert calls == ["first", "second"]
    assert open_run(tmp_path / "run").contact().num_rows == 4
