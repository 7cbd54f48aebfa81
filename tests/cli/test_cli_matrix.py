"""``run --set``, ``run --vary`` and ``compare``: refusals, a real matrix with one that fails, compared."""

import re
from pathlib import Path

import pytest
from command_line import call
from malformed import check_refused

CASE = """name = "short"
vehicle = "iore_wagon_loaded"
speed_km_h = 60.0
friction = 0.4

[track]
flexibility = "rigid"

[[track.sections]]
kind = "straight"
length_m = 30.0
gauge_mm = 1445.0
"""


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    (tmp_path / "whole.toml").write_text('bodies = []\n[wedge]\ntype = "Wedge"\n')
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "case.toml").write_text(CASE)
    return path


REFUSED = {
    ("--set", "wedge.frction=0.3"): "did you mean wedge.friction",
    ("--set", "wedge.friction"): "--set wedge.friction: allowed KEY=VALUE",
    ("--set", "=3"): "--set =3: allowed KEY=VALUE",
    ("--set", "friction=0.3", "--set", "friction=0.2"): "friction is given twice",
    ("--set", "wedge.friction=3"): "no plausible friction",
    ("--set", "speed_km_h=1000"): "speed_km_h = 1000 km/h: allowed 5 to 130 km/h",
    ("--set", "wheel_profiles.9L=S1002"): "the vehicle has wheelsets 1 to 4",
    ("--vehicle", "lorry"): "vehicle 'lorry' is not known",
    ("--vehicle", "whole.toml"): "whole.toml: couplings is missing",
    ("--vary", "speed_km_h=40,,60"): "a value is empty",
    ("--vary", "speed_km_h=40,40"): "two variants are named speed_km_h=40",
    ("--vary", "speed_km_h=40,400"): "speed_km_h = 400 km/h: allowed",
    ("--vary", "speed_km_h=40,60", "--workers", "0"): "--workers 0: allowed 1 to 1024",
}


@pytest.mark.parametrize("words", REFUSED)
def test_bad_words_are_one_line_and_nothing_is_written(
    case: Path, words: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(case.parent)
    check_refused(case.parent, ("run", case, "--out", case.parent / "out", *words), REFUSED[words])


def test_a_matrix_is_no_run(case: Path) -> None:
    words = ("run", case, "--out", case.parent / "run", "--vary", "friction=0.3,0.4")
    check_refused(case.parent, words, "is a run or a file")


def test_compare_refuses_what_is_no_run(case: Path) -> None:
    check_refused(case.parent, ("compare", case.parent / "none"), "none")
    (case.parent / "empty").mkdir()
    check_refused(case.parent, ("compare", case.parent / "empty"), "no run in it, nor in the folders in")
    check_refused(case.parent, ("compare", case.parent / "run", "-o", "a.txt"), "allowed are .png, .pdf")


@pytest.mark.slow
def test_a_matrix_goes_on_and_is_compared(case: Path, tmp_path: Path) -> None:
    """One variant fails as its folder holds something else: the others run, and later are not run again."""
    out = tmp_path / "matrix"
    both = [(friction, wedge) for friction in (0.3, 0.4) for wedge in (0.2, 0.35)]
    names = [f"friction={friction},wedge.friction={wedge}" for friction, wedge in both]
    (out / names[1]).mkdir(parents=True)
    (out / names[1] / "notes.txt").write_text("mine")
    words = ("run", case, "--out", out, "--vary", "friction=0.3,0.4", "--vary", "wedge.friction=0.2,0.35")
    first = call(*words, "--workers", "2")
    assert first.exit_code == 3, first.stderr
    assert f"1 of 4 runs did not finish: {names[1]}" in first.stderr
    assert f"{names[1]}: {out / names[1]} holds something other than a run" in first.stdout
    assert "3 of 4 runs finished, 0 of them before" in first.stdout
    assert len(re.findall(r"finished in \d+ s", first.stdout)) == 3
    (out / names[1] / "notes.txt").unlink()
    stamps = {path: path.stat().st_mtime_ns for path in out.rglob("*") if path.is_file()}
    second = call(*words)
    assert second.exit_code == 0, second.stderr
    assert "4 of 4 runs finished, 3 of them before" in second.stdout
    assert stamps == {path: path.stat().st_mtime_ns for path in stamps}

    sheet, table = tmp_path / "sheet.png", tmp_path / "table.csv"
    compared = call("compare", out, "-o", sheet, "--csv", table)
    assert compared.exit_code == 0, compared.stderr
    assert "wedge.friction" in compared.stdout
    assert "…" not in compared.stdout
    assert sheet.stat().st_size > 10_000
    lines = table.read_text().splitlines()
    assert len(lines) == 5
    for quantity in ("Q [kN]", "Y/Q [-]", "wear number [N]", "tread wear [mm/1000 km]"):
        assert quantity in lines[0]
