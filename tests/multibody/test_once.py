"""A study that is begun again: finished runs are kept, cut-off ones made anew, others' never touched."""

import pytest

from hh_exudyn.log.store import write_status
from hh_exudyn.multibody.once import simulate_once

STRAIGHT = [{"kind": "straight", "length_m": 30.0, "gauge_mm": 1445.0}]


def test_runs_are_made_once(demo, tmp_path):
    case = demo.with_changes(track={"sections": STRAIGHT})
    calls = []
    directory = tmp_path / "run"
    run = simulate_once(case, directory, lambda done, text: calls.append(done))
    assert calls
    calls.clear()
    stamps = {path: path.stat().st_mtime_ns for path in sorted(directory.rglob("*"))}
    again = simulate_once(case, directory, lambda done, text: calls.append(done))
    assert again == run
    assert not calls
    assert {path: path.stat().st_mtime_ns for path in sorted(directory.rglob("*"))} == stamps

    with pytest.raises(FileExistsError, match="something other than a run of the case"):
        simulate_once(case.with_changes(friction=0.3), directory)
    assert {path: path.stat().st_mtime_ns for path in sorted(directory.rglob("*"))} == stamps

    whole = run.contact()
    (directory / "contact" / "part-00000.parquet").unlink()  # as if it had been cut off before
    write_status(directory, {"finished": False, "reason": "interrupted"})
    assert simulate_once(case, directory).contact() == whole
    assert simulate_once(case, directory).status["finished"] is True

    write_status(directory, {"finished": False, "reason": "interrupted"})
    (directory / "notes.txt").write_text("mine")
    with pytest.raises(FileExistsError):
        simulate_once(case, directory)
    assert (directory / "notes.txt").read_text() == "mine"


def test_a_folder_of_something_else_is_left_alone(demo, tmp_path):
    (tmp_path / "letter.txt").write_text("mine")
    with pytest.raises(FileExistsError):
        simulate_once(demo, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["letter.txt"]
