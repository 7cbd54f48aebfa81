"""A study that is begun again: finished runs are kept, cut-off ones made anew, others' never touched."""

import json
import shutil

import pytest

from hh_exudyn.contact.profile import wheel_profile
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


def test_only_a_complete_run_of_the_same_content_is_reused(demo, tmp_path):
    """Not one without its status, with a broken one, without its logs, or of another wheel or code."""
    wheel = tmp_path / "wheel.txt"
    profile = wheel_profile("S1002")

    def write(lift):
        rows = zip(profile.y, profile.z, strict=True)
        wheel.write_text("".join(f"{1e3 * y:.6f} {1e3 * z + lift * abs(y):.6f}\n" for y, z in rows))

    write(0.0)
    case = demo.with_changes(wheel_profile=str(wheel), track={"sections": STRAIGHT})
    directory = tmp_path / "run"
    whole = simulate_once(case, directory)
    contact = whole.contact()
    for status in (None, "", "{", '{"finished": 1}', "[]"):
        path = directory / "status.json"
        path.unlink() if status is None else path.write_text(status)
        with pytest.warns(RuntimeWarning, match=r"status\.json.*the run is made again"):
            assert simulate_once(case, directory).contact() == contact
        assert whole.status["finished"] is True
    shutil.rmtree(directory / "motion")
    with pytest.warns(RuntimeWarning, match="has lost its logs; it is made again"):
        assert simulate_once(case, directory).motion().num_rows > 0
    made = json.loads((directory / "provenance.json").read_text())
    (directory / "provenance.json").write_text(json.dumps({**made, "code": "older"}))
    with pytest.raises(FileExistsError, match="other code of hh-exudyn"):
        simulate_once(case, directory)
    (directory / "provenance.json").write_text(json.dumps(made))
    assert simulate_once(case, directory) == whole
    write(0.01)
    with pytest.raises(FileExistsError, match="other case, vehicle or files"):
        simulate_once(case, directory)


def test_a_folder_of_something_else_is_left_alone(demo, tmp_path):
    (tmp_path / "letter.txt").write_text("mine")
    with pytest.raises(FileExistsError):
        simulate_once(demo, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["letter.txt"]
