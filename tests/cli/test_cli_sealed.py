"""A run folder sent to somebody else: the sources are gone, every command gives the same bytes."""

import hashlib
import shutil
from pathlib import Path

import numpy as np
import pytest
from commands import command, content
from rerun.chunk import RrdReader

from hh_exudyn.contact.profile import wheel_profile

WRITING = {"rerun.controls.RowId", "log_time", "log_tick"}  # columns of a recording
CASE = """
name = "own files"
vehicle = "worn.toml"
speed_km_h = 60.0
friction = 0.4
wheel_profile = "wheel.csv"

[track]
rail = "60E1"
inclination = "1:30"
flexibility = "rigid"
irregularity = "rough.csv"

[[track.sections]]
kind = "straight"
length_m = 175.0
gauge_mm = 1445.0

[contact]
cells = [10, 10]
"""


def own_files(home: Path) -> Path:
    """A case with a vehicle, a wheel and an irregularity of its own."""
    home.mkdir()
    wheel = wheel_profile("S1002")
    rows = (f"{1e3 * y:.6f},{1e3 * z:.6f}\n" for y, z in zip(wheel.y, wheel.z, strict=True))
    (home / "wheel.csv").write_text("".join(rows))
    (home / "worn.toml").write_text('base = "iore_wagon_loaded"\nwedge.friction = 0.3\n')
    s = np.arange(0.0, 250.0, 0.25)
    lines = [f"{x:g},{0.3 * np.sin(x):.4f},{0.4 * np.sin(0.7 * x):.4f},0,0\n" for x in s]
    (home / "rough.csv").write_text(
        "position_m,alignment_mm,level_mm,cross_level_mm,gauge_mm\n" + "".join(lines)
    )
    (home / "case.toml").write_text(CASE)
    return home / "case.toml"


def evaluated(run: Path, out: Path) -> dict[str, bytes]:
    """What damage and assess write about a run."""
    for words in (
        ("damage", run, "--out", out / "damage"),
        ("assess", run, "--section-length-m", "20", "--table", out / "assess.csv"),
    ):
        result = command(*words)
        assert result.returncode == 0, result.stderr
    # the settings name the run by its path, which differs
    return {name: data for name, data in content(out).items() if not name.endswith("settings.json")}


def drawn(recording: Path) -> list[tuple[str, str, str]]:
    """Entity, component and content of everything in a recording but the times and numbers of its writing."""
    found = []
    for chunk in RrdReader(recording).stream().to_chunks():
        batch = chunk.to_record_batch()
        for name in batch.schema.names:
            if name not in WRITING:
                content = hashlib.sha256()
                for buffer in batch[name].buffers():
                    content.update(b"" if buffer is None else buffer.to_pybytes())
                found.append((chunk.entity_path, name, content.hexdigest()))
    return sorted(found)


@pytest.mark.slow
def test_a_folder_sent_elsewhere_gives_the_same_bytes(tmp_path: Path) -> None:
    case = own_files(tmp_path / "home")
    here, there, again = tmp_path / "run", tmp_path / "sent" / "run", tmp_path / "again"
    result = command("run", case, "--out", here)
    assert result.returncode == 0, result.stderr
    before = evaluated(here, tmp_path / "before")
    assert command("playback", here, "--save", tmp_path / "before.rrd").returncode == 0
    shutil.rmtree(tmp_path / "home")
    shutil.move(here, there)
    assert evaluated(there, tmp_path / "after") == before
    assert command("playback", there, "--save", tmp_path / "after.rrd").returncode == 0
    assert drawn(tmp_path / "after.rrd") == drawn(tmp_path / "before.rrd")
    result = command("run", there / "case.toml", "--out", again)
    assert result.returncode == 0, result.stderr
    assert content(again) == content(there)
