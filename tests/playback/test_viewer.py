"""The viewer in a window: a run is open only where the viewer lives on."""

import os
import signal
import stat
from pathlib import Path

import pytest
from command_line import call

from hh_exudyn.log.store import Run
from hh_exudyn.playback import viewer
from hh_exudyn.playback.picture import PictureError


def program(folder: Path, text: str) -> Path:
    path = folder / "rerun"
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    (tmp_path / "a.rrd").write_bytes(b"RRF2")
    return tmp_path / "a.rrd"


def test_a_viewer_that_ends_at_once_is_an_error_with_its_last_line(
    recording: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    dying = program(
        tmp_path, "echo starting; echo 'Error: neither WAYLAND_DISPLAY nor DISPLAY is set' >&2; exit 1"
    )
    monkeypatch.setattr(viewer, "viewer_program", lambda: dying)
    with pytest.raises(
        PictureError, match=r"ended with status 1, .* not open: Error: neither WAYLAND_DISPLAY"
    ):
        viewer.open_viewer(recording)


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")  # it outlives its Popen
def test_a_viewer_that_lives_on_is_open(
    recording: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(viewer, "viewer_program", lambda: program(tmp_path, "exec sleep 60"))
    monkeypatch.setattr(viewer, "START_TIME", 0.3)
    number = viewer.open_viewer(recording)
    try:
        os.kill(number, 0)
    finally:
        os.kill(number, signal.SIGTERM)
        os.waitpid(number, 0)


def test_the_command_fails_with_the_viewer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, recording: Path
) -> None:
    def dead(path: Path) -> int:
        raise PictureError(f"the rerun viewer ended with status 1, so {path} is not open: no display")

    recording.rename(tmp_path / "playback.rrd")
    monkeypatch.setattr("hh_exudyn.cli.inputs.read_run", lambda *_: Run(tmp_path))
    monkeypatch.setattr(viewer, "open_viewer", dead)
    result = call("playback", tmp_path)
    assert result.exit_code == 1
    assert result.stdout == ""
    assert "the rerun viewer ended with status 1" in result.stderr
    assert result.stderr.count("\n") == 1
