"""The recorder and the store: nothing is lost, nothing is overwritten, half-written files are ignored."""

import subprocess
import sys
import textwrap
import time
from pathlib import Path

import numpy as np
import pyarrow
import pytest

from hh_exudyn.log.channels import LOGS
from hh_exudyn.log.store import Recorder, Run, open_run, write_case, write_status

CASE = 'name = "straight"\nspeed_km_h = 60.0\n'
CONTACT = [column.name for column in LOGS["contact"]]


def contact_rows(count: int, first: int = 0) -> np.ndarray:
    """Rows that tell themselves apart: column j of row i holds 100 i + j (whole numbers)."""
    return 100.0 * np.arange(first, first + count)[:, None] + np.arange(len(CONTACT))


def record(directory: Path, count: int, rows_per_part: int, piece: int) -> Run:
    with Recorder(directory, {"case": CASE}, rows_per_part) as recorder:
        for first in range(0, count, piece):
            recorder.append_rows("contact", contact_rows(min(piece, count - first), first))
    return open_run(directory)


@pytest.mark.parametrize(("rows_per_part", "piece"), [(10, 3), (10, 25), (7, 7), (1000, 1)])
def test_rows_come_back_whatever_the_parts(tmp_path: Path, rows_per_part: int, piece: int) -> None:
    run = record(tmp_path / "run", 53, rows_per_part, piece)
    table = run.contact()
    assert table.column_names == CONTACT
    for index, column in enumerate(LOGS["contact"]):
        kind = {"float64": "double"}.get(column.kind, column.kind)
        assert str(table.schema.field(column.name).type) == kind
        np.testing.assert_array_equal(table[column.name].to_numpy(), contact_rows(53)[:, index])
    parts = sorted(path.name for path in (tmp_path / "run" / "contact").iterdir())
    assert parts == [f"part-{number:05d}.parquet" for number in range(-(-53 // rows_per_part))]


def test_batches_are_the_table(tmp_path: Path) -> None:
    run = record(tmp_path / "run", 53, 20, 5)
    batches = list(run.batches("contact", ["Q", "time"], rows=6))
    assert max(batch.num_rows for batch in batches) <= 6
    assert pyarrow.Table.from_batches(batches).equals(run.read("contact", ["Q", "time"]))


def test_case_in_file_and_metadata(tmp_path: Path) -> None:
    run = record(tmp_path / "run", 5, 10, 5)
    assert run.case_text == CASE  # from the metadata of the part
    write_case(run.directory, CASE)
    assert (run.directory / "case.toml").read_text() == CASE
    assert open_run(run.directory).case_text == CASE
    with pytest.raises(FileExistsError, match="another case"):
        write_case(run.directory, "other = 1\n")


def test_status(tmp_path: Path) -> None:
    run = record(tmp_path / "run", 5, 10, 5)
    assert run.status["finished"] is False
    write_status(run.directory, {"finished": True, "reason": "end of track", "wall_time": 1.5})
    assert run.status == {"finished": True, "reason": "end of track", "wall_time": 1.5}


def test_string_column_by_name_and_by_code(tmp_path: Path) -> None:
    names = ["car body", "wheelset 1"]
    numbers = {column.name: np.arange(3.0) for column in LOGS["motion"] if column.name != "body"}
    with Recorder(tmp_path / "run", {}, rows_per_part=2, names={"body": names}) as recorder:
        recorder.append("motion", {**numbers, "body": [1, 0, 1]})
        recorder.append("motion", {**numbers, "body": ["wheelset 1", "bolster", "car body"]})
    column = open_run(tmp_path / "run").motion()["body"]
    assert pyarrow.types.is_dictionary(column.type)
    assert column.to_pylist() == ["wheelset 1", "car body", "wheelset 1", "wheelset 1", "bolster", "car body"]


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt])
def test_exception_leaves_all_rows(tmp_path: Path, error: type[BaseException]) -> None:
    with pytest.raises(error), Recorder(tmp_path / "run", {}, rows_per_part=10) as recorder:
        for first in range(0, 100, 3):
            recorder.append_rows("contact", contact_rows(3, first))
            if first == 24:
                raise error
    np.testing.assert_array_equal(
        open_run(tmp_path / "run").contact()["time"].to_numpy(), 100.0 * np.arange(27)
    )


def test_killed_process_leaves_finished_parts(tmp_path: Path) -> None:
    script = f"""
        import os, signal
        import numpy as np
        from hh_exudyn.log.store import Recorder
        recorder = Recorder({str(tmp_path / "run")!r}, {{"case": "killed"}}, rows_per_part=10)
        rows = 100.0 * np.arange(27)[:, None] + np.arange({len(CONTACT)})
        recorder.append_rows("contact", rows)
        recorder.settle()
        os.kill(os.getpid(), signal.SIGKILL)
    """
    ended = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], check=False)
    assert ended.returncode == -9
    run = open_run(tmp_path / "run")
    np.testing.assert_array_equal(run.contact()["time"].to_numpy(), 100.0 * np.arange(20))
    assert run.case_text == "killed"
    assert run.status["finished"] is False


def test_temporary_file_is_ignored(tmp_path: Path) -> None:
    run = record(tmp_path / "run", 10, 10, 5)
    (run.directory / "contact" / "part-00001.parquet.tmp").write_bytes(b"PAR1 cut off")
    assert run.contact().num_rows == 10


def test_failed_write_leaves_no_file_and_can_be_repeated(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    recorder = Recorder(tmp_path / "run", {})
    recorder.append_rows("contact", contact_rows(4))

    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr("hh_exudyn.log.parts.os.fsync", full)
        with pytest.raises(OSError, match="No space"):
            recorder.flush()
            recorder.settle()
    assert list((tmp_path / "run" / "contact").iterdir()) == []
    recorder.close()
    assert open_run(tmp_path / "run").contact().num_rows == 4


def test_existing_run_is_never_overwritten(tmp_path: Path) -> None:
    directory = tmp_path / "run"
    record(directory, 5, 10, 5)
    before = {path: path.stat().st_mtime_ns for path in directory.rglob("*")}
    with pytest.raises(FileExistsError, match=r"run is not empty.*--out must name a new or an empty folder"):
        Recorder(directory, {})
    assert {path: path.stat().st_mtime_ns for path in directory.rglob("*")} == before
    (tmp_path / "file").write_text("")
    with pytest.raises(FileExistsError, match="is a file"):
        Recorder(tmp_path / "file", {})
    (tmp_path / "empty").mkdir()
    Recorder(tmp_path / "empty", {}).close()


def test_bad_rows_are_named(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "run", {})
    with pytest.raises(ValueError, match=r"shape \(2, 3\)"):
        recorder.append_rows("contact", np.zeros((2, 3)))
    with pytest.raises(ValueError, match="'contacts' is unknown"):
        recorder.append_rows("contacts", np.zeros((2, 3)))
    with pytest.raises(ValueError, match=r"missing \['s', "):
        recorder.append("energy", {"time": [0.0]})
    rows = contact_rows(2)
    rows[1, CONTACT.index("side")] = np.nan
    recorder.append_rows("contact", rows)
    with pytest.raises(ValueError, match="column side holds values that are not whole numbers"):
        recorder.close()


def test_a_closed_recorder_takes_no_rows(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "run", {})
    recorder.close()
    with pytest.raises(ValueError, match="closed"):
        recorder.append_rows("contact", contact_rows(1))


def test_clear_errors_on_reading(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="is not a directory"):
        open_run(tmp_path / "absent")
    with pytest.raises(FileNotFoundError, match="not the directory of a run"):
        open_run(tmp_path)
    run = record(tmp_path / "run", 5, 10, 5)
    with pytest.raises(FileNotFoundError, match="no finished part of the log 'motion'"):
        run.motion()
    with pytest.raises(ValueError, match="has no column width"):
        run.read("contact", ["time", "width"])
    with pytest.raises(ValueError, match="unknown; the logs of a run are contact, motion, energy"):
        run.batches("forces")


def test_append_is_fast(tmp_path: Path) -> None:
    """Called in every output step: under 20 us for eight wheels with three patches (measured about 1 us)."""
    rows = contact_rows(24)
    with Recorder(tmp_path / "run", {}) as recorder:
        recorder.append_rows("contact", rows)
        fastest = np.inf
        for _ in range(5):
            start = time.perf_counter()
            for _ in range(300):
                recorder.append_rows("contact", rows)
            fastest = min(fastest, (time.perf_counter() - start) / 300)
    assert fastest < 20e-6
