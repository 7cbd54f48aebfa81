"""The command line: exit codes, one line for every fault, nothing written over, and a short real run."""

import os
import re
import shutil
import subprocess
import sys
from importlib import resources
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from hh_exudyn import __version__
from hh_exudyn.case import Case, read_case
from hh_exudyn.cli.app import app
from hh_exudyn.log.store import Recorder, open_run, write_status

DEMO = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
SHORT = Case.from_toml(DEMO).with_changes(
    name="short",
    track={"flexibility": "rigid", "sections": [{"kind": "straight", "length_m": 30.0, "gauge_mm": 1435.0}]},
    contact={"cells": [10, 10]},
)


def call(*words: str | Path) -> Result:
    return CliRunner().invoke(app, [str(word) for word in words])


def command(*words: str | Path, code: str = "") -> subprocess.CompletedProcess[str]:
    """The command in a process of its own, away from the checkout; `code` runs before it."""
    start = ["-c", f"{code}\nfrom hh_exudyn.__main__ import main\nmain()"] if code else ["-m", "hh_exudyn"]
    return subprocess.run(
        [sys.executable, *start, *(str(word) for word in words)],
        capture_output=True, text=True, cwd="/", env=os.environ | {"COLUMNS": "200"},
    )  # fmt: skip


def one_line(text: str) -> str:
    """The message, which must be one line that names the program."""
    assert text.startswith("hh-exudyn: ")
    assert text.count("\n") == 1
    assert text.endswith("\n")
    return text


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, subprocess.CompletedProcess[str]]:
    """A short real run through the command line."""
    root = tmp_path_factory.mktemp("cli")
    (root / "short.toml").write_text(SHORT.to_toml())
    result = command("run", root / "short.toml", "--out", root / "run")
    assert result.returncode == 0, result.stderr
    return root / "run", result


def test_help_is_quick_to_answer() -> None:
    """Nothing heavy is imported for ``--help`` (the libraries take seconds)."""
    code = (
        "import sys, hh_exudyn.cli.app\n"
        "heavy = {'exudyn', 'numba', 'rerun', 'pyarrow', 'scipy', 'numpy', 'matplotlib'}\n"
        "print(*sorted(heavy & set(sys.modules)))"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd="/", check=True)
    assert result.stdout.strip() == ""
    shown = call("--help").stdout
    for name in ("run", "demo", "damage", "playback", "patch", "validate", "conicity", "--version"):
        assert name in shown


def test_version() -> None:
    result = command("--version")
    assert (result.returncode, result.stdout) == (0, f"hh-exudyn {__version__}\n")


BAD_CASES = {
    "misspelt": (('speed_km_h', 'speed_kmh'), ["unknown key speed_kmh = 60", 'did you mean "speed_km_h"?']),
    "speed": (("speed_km_h = 60.0", "speed_km_h = 600"), ["speed_km_h = 600 km/h: allowed 5 to 130 km/h"]),
    "friction": (("friction = 0.40", "friction = 0"), ["friction = 0: allowed 0.01 to 1"]),
    "gauge": (("gauge_mm = 1445.0", "gauge_mm = 1424.0"), ["gauge_mm = 1424 mm", "allowed above 1425.0"]),
    "syntax": (("name =", "name"), ["not valid TOML", "line 3"]),
    "profile": (('"S1002"', '"none.txt"'), ["wheel_profile", "none.txt", "not found"]),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD_CASES)
def test_bad_case_is_one_line_and_exit_code_2(tmp_path: Path, name: str) -> None:
    change, parts = BAD_CASES[name]
    assert change[0] in DEMO
    (tmp_path / "case.toml").write_text(DEMO.replace(*change))
    result = call("run", tmp_path / "case.toml", "--out", tmp_path / "out")
    assert result.exit_code == 2
    assert result.stdout == ""
    for part in (str(tmp_path / "case.toml"), *parts):
        assert part in one_line(result.stderr)
    assert not (tmp_path / "out").exists()


def test_bad_case_as_a_process(tmp_path: Path) -> None:
    result = command("run", tmp_path / "none.toml", "--out", tmp_path / "out")
    assert result.returncode == 2
    assert (
        one_line(result.stderr)
        == f"hh-exudyn: {tmp_path}/none.toml: cannot be read: No such file or directory\n"
    )
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems always have a screen")
def test_the_viewer_without_a_screen_is_one_line_and_exit_code_1(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    (tmp_path / "short.toml").write_text(SHORT.to_toml())
    words = ("run", tmp_path / "short.toml", "--out", tmp_path / "run", "--exudyn-viewer")
    result = command(*words)
    assert result.returncode == 1
    assert "needs a screen, and DISPLAY is not set" in one_line(result.stderr)
    assert not (tmp_path / "run").exists()
    varied = call(*words, "--vary", "speed_km_h=40,60")
    assert varied.exit_code == 2
    assert "--exudyn-viewer shows one run" in one_line(varied.stderr)


@pytest.mark.parametrize("words", [("run", "CASE"), ("demo",)])
def test_folder_that_holds_anything_is_refused_before_any_work(
    tmp_path: Path, words: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "hh_exudyn.multibody.simulate.simulate", lambda *_, **__: pytest.fail("work was begun")
    )
    (tmp_path / "case.toml").write_text(DEMO)
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "precious").write_text("mine")
    words = tuple(str(tmp_path / "case.toml") if word == "CASE" else word for word in words)
    for target in (tmp_path / "out", tmp_path / "out" / "precious"):
        result = call(*words, "--out", target)
        assert result.exit_code == 2
        assert f"--out {target}" in one_line(result.stderr)
        assert "allowed is a new or an empty folder" in result.stderr
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["precious"]
    assert (tmp_path / "out" / "precious").read_text() == "mine"


def test_folder_that_cannot_be_made_is_bad_input() -> None:
    """/proc takes no folders, not even from root."""
    result = call("demo", "--out", "/proc/hh-exudyn/run")
    assert result.exit_code == 2
    assert "/proc/hh-exudyn" in one_line(result.stderr)


def test_missing_option_is_exit_code_2() -> None:
    result = call("demo")
    assert result.exit_code == 2
    assert "--out" in result.stderr


@pytest.mark.parametrize("words", [("damage",), ("playback",), ("playback", "--save", "new.rrd")])
def test_folder_without_a_run_is_refused(tmp_path: Path, words: tuple[str, ...]) -> None:
    for folder in (tmp_path, tmp_path / "absent"):
        result = call(words[0], folder, *words[1:])
        assert result.exit_code == 2
        assert str(folder) in one_line(result.stderr)
    assert list(tmp_path.iterdir()) == []


def test_log_without_rows_is_refused(tmp_path: Path) -> None:
    with Recorder(tmp_path / "run", {"case": DEMO}):
        pass
    result = call("damage", tmp_path / "run")
    assert result.exit_code == 2
    assert str(tmp_path / "run") in one_line(result.stderr)


def test_run_prints_recording_and_table(done: tuple[Path, subprocess.CompletedProcess[str]]) -> None:
    folder, result = done
    assert f"recording: {folder / 'playback.rrd'}" in result.stdout
    assert (folder / "playback.rrd").stat().st_size > 100_000
    for unit in ("[kN]", "[-]", "[mrad]", "[mm]", "[MPa]", "[N]", "[%]"):
        assert unit in result.stdout
    assert "…" not in result.stdout  # nothing cut off
    assert max(map(len, result.stdout.splitlines()[1:])) <= 80
    means, watch = result.stdout.split("Watch over the whole run")
    rows = re.findall(r"^(?: straight| 0 to 30 m)? +([1-4][LR]) +(\d+\.\d) ", means, flags=re.MULTILINE)
    assert [wheel for wheel, _ in rows] == [f"{w}{side}" for w in "1234" for side in "LR"]
    # 30 t axle load on straight track: 8 wheels carry 4 * 30 t * 9.81 m/s2 = 1177 kN in the mean
    assert sum(float(force) for _, force in rows) == pytest.approx(1177, rel=0.01)
    # smooth straight track: nothing lifts by a millimetre, runs on its flange, jumps, or seizes
    seen = re.findall(r"^ +[1-4][LR] +0\.\d\d +0\.0 +\d +0\.0 +0\.0 *$", watch, flags=re.MULTILINE)
    assert len(seen) == 8
    assert "doubtful" not in watch


def test_case_is_kept_with_the_run(done: tuple[Path, subprocess.CompletedProcess[str]]) -> None:
    """With the vehicle by content, in place of its name."""
    kept = read_case(done[0] / "case.toml")
    assert kept.described_vehicle() == SHORT.described_vehicle()
    assert kept.with_changes(vehicle=SHORT.vehicle) == SHORT


def test_damage_of_a_run(done: tuple[Path, subprocess.CompletedProcess[str]], tmp_path: Path) -> None:
    names = [
        *("damage.csv", "fatigue.png", "rcf_bins.png", "rcf_map.png", "settings.json", "shakedown.png"),
        "wear.png",
    ]
    result = call("damage", done[0], "--out", tmp_path / "damage")
    assert result.exit_code == 0, result.stderr
    assert sorted(path.name for path in (tmp_path / "damage").iterdir()) == names
    assert (tmp_path / "damage" / "wear.png").read_bytes().startswith(b"\x89PNG")
    assert len(re.findall(r"^ +[1-4][LR] ", result.stdout, flags=re.MULTILINE)) == 8
    assert "…" not in result.stdout
    again = call("damage", done[0], "--out", tmp_path / "damage")
    assert again.exit_code == 2
    assert "is not empty" in one_line(again.stderr)


def test_damage_by_other_models(done: tuple[Path, subprocess.CompletedProcess[str]], tmp_path: Path) -> None:
    out = tmp_path / "usfd"
    result = call(
        "damage", done[0], "--out", out, "--model", "usfd", "--theory", "fastsim", "--material", "ER8",
        "--distance-km", "1000",
    )  # fmt: skip
    assert result.exit_code == 0, result.stderr
    assert "Damage after 1,000 km" in result.stdout
    assert "normal contact: ellipse" in result.stdout  # FASTSIM takes no strips
    assert "seizure" not in result.stdout
    lines = (out / "distance.csv").read_text().splitlines()
    assert "wear_depth_mm" in lines[0]
    assert len(lines) == 9
    report = (out / "damage.csv").read_text().splitlines()
    per_1000_km = float(report[1].split(",")[report[0].split(",").index('"wear_depth_mm_per_1000_km"')])
    depth = float(lines[1].split(",")[lines[0].split(",").index('"wear_depth_mm"')])
    assert depth == pytest.approx(per_1000_km)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--model", "archad"), "wear law = 'archad'"),
        (("--model", "usfd", "--surface", "greased"), "wear law 'usfd' has no option 'surface'"),
        (("--theory", "polach"), "theory = 'polach'; theories with a slip field"),
        (("--normal", "analyn"), "normal = 'analyn'; known: strips, ellipse, halfspace"),
        (("--normal", "strips", "--theory", "fastsim"), "goes with theory fastrip, not 'fastsim'"),
        (("--pressure-limit", "2000"), "needs normal = 'halfspace', not 'strips'"),
        (("--pressure-limit", "0"), "--pressure-limit 0 MPa: allowed"),
        (("--material", "ER70"), "wheel material 'ER70' is not known"),
        (("--distance-km", "0"), "--distance-km 0 km: allowed"),
    ],
)
def test_damage_by_no_known_model_is_refused(
    done: tuple[Path, subprocess.CompletedProcess[str]],
    tmp_path: Path,
    words: tuple[str, ...],
    message: str,
) -> None:
    result = call("damage", done[0], "--out", tmp_path / "out", *words)
    assert result.exit_code == 2
    assert message in one_line(result.stderr)
    assert not (tmp_path / "out").exists()


def test_bad_rows_are_refused_or_left_out(
    done: tuple[Path, subprocess.CompletedProcess[str]], tmp_path: Path
) -> None:
    log = open_run(done[0]).contact()
    columns = {name: log[name].to_numpy().copy() for name in log.column_names}
    columns["phi"][[5, 6]] = float("nan")
    columns["force_y"][7] = 1e9
    with Recorder(tmp_path / "bad", {"case": (done[0] / "case.toml").read_text()}) as recorder:
        recorder.append("contact", columns)
    write_status(tmp_path / "bad", {"finished": True})
    shutil.copy(done[0] / "vehicle.json", tmp_path / "bad")
    result = call("damage", tmp_path / "bad", "--out", tmp_path / "out")
    assert result.exit_code == 2
    message = one_line(result.stderr)
    assert f"3 of {log.num_rows} rows are bad, the first at time = " in message
    assert "--skip-bad-rows leaves them out" in message
    assert not (tmp_path / "out").exists()
    result = call("damage", tmp_path / "bad", "--out", tmp_path / "out", "--skip-bad-rows")
    assert result.exit_code == 0, result.stderr
    assert f"left out: 3 of {log.num_rows} rows are bad" in result.stdout
    assert (tmp_path / "out" / "bad_rows.csv").is_file()


def test_playback_saves_a_new_file_only(
    done: tuple[Path, subprocess.CompletedProcess[str]], tmp_path: Path
) -> None:
    result = call("playback", done[0], "--save", tmp_path / "new.rrd")
    assert result.exit_code == 0, result.stderr
    assert (tmp_path / "new.rrd").stat().st_size > 100_000
    (tmp_path / "old.rrd").write_text("mine")
    result = call("playback", done[0], "--save", tmp_path / "old.rrd")
    assert result.exit_code == 2
    assert "old.rrd: exists already" in one_line(result.stderr)
    assert (tmp_path / "old.rrd").read_text() == "mine"


INTERRUPT = """
import contextlib, os, signal
import hh_exudyn.cli.run as cli

@contextlib.contextmanager
def bar(name):  # Ctrl-C when a third of the run is done
    yield lambda fraction, text: os.kill(os.getpid(), signal.SIGINT) if fraction > 0.3 else None

cli._progress_bar = bar
"""


def test_ctrl_c_keeps_the_log_so_far(tmp_path: Path) -> None:
    """A real signal in a real run."""
    (tmp_path / "case.toml").write_text(SHORT.to_toml())
    result = command("run", tmp_path / "case.toml", "--out", tmp_path / "out", code=INTERRUPT)
    assert result.returncode == 130, result.stderr
    assert f"interrupted; the log so far is kept in {tmp_path / 'out'}" in one_line(result.stderr)
    run = open_run(tmp_path / "out")
    times = run.contact()["time"].to_numpy()
    assert 0.0 < times.max() < 30.0 / SHORT.speed
    assert run.status["finished"] is False


def test_derailment_is_exit_code_3_and_keeps_the_log(tmp_path: Path) -> None:
    """130 km/h into a curve of 100 m: 13 m/s2 outwards, far beyond overturning."""
    sections = [
        {"kind": "straight", "length_m": 20.0},
        {"kind": "transition", "length_m": 20.0},
        {"kind": "curve", "length_m": 100.0, "radius_m": 100.0, "hand": "right"},
    ]
    case = SHORT.with_changes(speed_km_h=130, track={"sections": sections})
    (tmp_path / "case.toml").write_text(case.to_toml())
    result = command("run", tmp_path / "case.toml", "--out", tmp_path / "out")
    assert result.returncode == 3, result.stderr
    message = one_line(result.stderr)
    assert re.search(r"derailment: .* \(wheel [1-4][LR], t = \d+\.\d+ s, s = \d+\.\d+ m\)", message)
    assert f"the log so far is kept in {tmp_path / 'out'}" in message
    last = open_run(tmp_path / "out").contact()["time"].to_numpy().max()
    stopped = float(re.findall(r"t = (\d+\.\d+) s", message)[0])
    assert 0.0 <= stopped - last <= 0.12  # to the last output time with a wheel on the rail


def test_fault_of_the_program_is_one_line_and_a_traceback_on_disk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(case: Case, directory: Path, **options: object) -> None:
        directory.mkdir()
        raise ZeroDivisionError("float\ndivision [by] zero")

    monkeypatch.setattr("hh_exudyn.multibody.simulate.simulate", broken)
    result = call("demo", "--out", tmp_path / "out")
    assert result.exit_code == 1
    message = one_line(result.stderr)
    assert "ZeroDivisionError: float division [by] zero" in message
    assert str(tmp_path / "out" / "error.txt") in message
    assert "Traceback" in (tmp_path / "out" / "error.txt").read_text()


def test_case_that_cannot_be_built_is_bad_input(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuses(case: Case, directory: Path, **options: object) -> None:
        raise ValueError("vehicle longer than the track")

    monkeypatch.setattr("hh_exudyn.multibody.simulate.simulate", refuses)
    result = call("demo", "--out", tmp_path / "out")
    assert result.exit_code == 2
    assert "vehicle longer than the track" in one_line(result.stderr)
    assert not (tmp_path / "out").exists()
