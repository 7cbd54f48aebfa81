"""Commands that are cut off, by a signal or a full disk; runs that are resumed; evaluations kept apart."""

import json
import shutil
from importlib import resources
from pathlib import Path

import pytest
from commands import command, content

from hh_exudyn.case import Case
from hh_exudyn.log.store import open_run

DEMO = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
SHORT = Case.from_toml(DEMO).with_changes(
    name="short",
    track={"flexibility": "rigid", "sections": [{"kind": "straight", "length_m": 32.0, "gauge_mm": 1435.0}]},
    contact={"cells": [10, 10]},
)
SIGNAL = """
import contextlib, os, signal
import hh_exudyn.cli.run as cli

@contextlib.contextmanager
def bar(name):  # a signal when two thirds of the run are done
    yield lambda fraction, text: os.kill(os.getpid(), signal.{name}) if fraction > 0.66 else None

cli._progress_bar = bar
"""
LIMIT = "import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, ({size}, {size}))\n"


def one_line(text: str) -> str:
    assert text.startswith("hh-exudyn: ")
    assert text.count("\n") == 1
    return text


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("case") / "short.toml"
    path.write_text(SHORT.to_toml())
    return path


@pytest.fixture(scope="module")
def done(case: Path) -> Path:
    result = command("run", case, "--out", case.parent / "run")
    assert result.returncode == 0, result.stderr
    return case.parent / "run"


def test_sigterm_is_143_and_resume_ends_the_run(case: Path, done: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    cut = command("run", case, "--out", out, code=SIGNAL.format(name="SIGTERM"))
    assert cut.returncode == 143, cut.stderr
    assert one_line(cut.stderr) == (
        f"hh-exudyn: terminated; the log so far is kept in {out}, and --resume goes on\n"
    )
    assert open_run(out).status["reason"] == "terminated"
    refused = command("run", case, "--out", out)
    assert refused.returncode == 2
    assert "is not empty" in one_line(refused.stderr)
    again = command("run", case, "--out", out, "--resume")
    assert again.returncode == 0, again.stderr
    assert content(out) == content(done)
    whole = command("run", case, "--out", out, "--resume")  # finished already: its table again
    assert whole.returncode == 0
    assert "Forces by element of the track" in whole.stdout


def test_resume_of_another_case_is_bad_input(done: Path, tmp_path: Path) -> None:
    (tmp_path / "other.toml").write_text(SHORT.with_changes(friction=0.2).to_toml())
    result = command("run", tmp_path / "other.toml", "--out", done, "--resume")
    assert result.returncode == 2
    assert "holds something other than this run: other case, vehicle or files" in one_line(result.stderr)


# the run writes vehicle.json, 17 kB; its contact log, 300 kB, twice that in growing; its recording, 2.5 MB
@pytest.mark.parametrize(
    ("size", "file"),
    [
        pytest.param(400, "provenance.json", marks=pytest.mark.slow),
        pytest.param(10_000, "vehicle.json", marks=pytest.mark.slow),
        pytest.param(60_000, "part-00000.parquet", marks=pytest.mark.slow),
        (250_000, "part-00000.parquet"),
        pytest.param(1_200_000, "playback.rrd", marks=pytest.mark.slow),
    ],
)
def test_full_disk(case: Path, done: Path, tmp_path: Path, size: int, file: str) -> None:
    """Exit code 1 with path and reason; what was written before is whole, and the run can be resumed."""
    out = tmp_path / "out"
    result = command("run", case, "--out", out, code=LIMIT.format(size=size))
    assert result.returncode == 1, result.stderr
    message = one_line(result.stderr)
    assert f"{file}: File too large" in message
    assert not list(out.rglob("*.tmp"))
    assert not (out / "playback.rrd").exists()
    run = open_run(out)
    assert run.status["finished"] is (file == "playback.rrd")
    assert run.broken_parts() == []
    if size >= 250_000:
        rows = run.contact()
        assert rows.equals(open_run(done).contact().slice(0, rows.num_rows))
    if file != "provenance.json":
        again = command("run", case, "--out", out, "--resume")
        assert again.returncode == 0, again.stderr
        assert content(out) == content(done)


def test_full_disk_leaves_no_half_evaluation(done: Path, tmp_path: Path) -> None:
    before = (
        tmp_path / "before"
    )  # compiles the kernels: with the limit, that there is no cache is one line more
    assert command("damage", done, "--out", before).returncode == 0
    result = command("damage", done, "--out", tmp_path / "out", code=LIMIT.format(size=20_000))
    assert result.returncode == 1
    assert "File too large" in one_line(result.stderr)
    assert list(tmp_path.iterdir()) == [before]


def test_evaluations_never_mix(done: Path, tmp_path: Path) -> None:
    run = shutil.copytree(done, tmp_path / "run")
    for _ in range(2):
        assert command("damage", run).returncode == 0
    other = command("damage", run, "--model", "usfd", "--material", "ER8", "--overwrite")
    assert other.returncode == 0, other.stderr
    assert "usfd, ER8" in other.stdout
    first, second = (
        json.loads((run / name / "settings.json").read_text()) for name in ("damage", "damage-2")
    )
    assert (first["law"]["name"], first["steel"]["name"]) == ("usfd", "ER8")
    assert (second["law"]["name"], second["steel"]["name"]) == ("archard", "ER7")
    assert second["run"]["finished"] is True
    table = (run / "damage" / "damage.csv").read_text().splitlines()
    assert '"usfd","ER8"' in table[1]
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("mine")
    refused = command("damage", run, "--out", tmp_path / "mine", "--overwrite")
    assert refused.returncode == 2
    assert (tmp_path / "mine" / "letter.txt").read_text() == "mine"


def test_a_broken_part_is_named_and_left_out(done: Path, tmp_path: Path) -> None:
    run = shutil.copytree(done, tmp_path / "run")
    part = run / "contact" / "part-00000.parquet"
    shutil.copy(part, part.with_name("part-00001.parquet"))
    part.write_bytes(part.read_bytes()[:1000])
    for words in (("damage",), ("assess",), ("playback", "--save", tmp_path / "new.rrd")):
        refused = command(words[0], run, *words[1:])
        assert refused.returncode == 2, words
        assert "part-00000.parquet" in one_line(refused.stderr)
        assert "--skip-broken-parts" in refused.stderr
    result = command("damage", run, "--out", tmp_path / "out", "--skip-broken-parts")
    assert result.returncode == 0, result.stderr
    assert f"left out: {part}" in result.stdout
    made = json.loads((tmp_path / "out" / "settings.json").read_text())
    assert made["broken_parts_left_out"] == ["contact/part-00000.parquet"]


def test_a_copy_gives_the_same_damage(done: Path, tmp_path: Path) -> None:
    sent = shutil.copytree(done, tmp_path / "sent")
    for run, out in ((done, "here"), (sent, "there")):
        assert command("damage", run, "--out", tmp_path / out).returncode == 0
    assert content(tmp_path / "here") == content(tmp_path / "there")
