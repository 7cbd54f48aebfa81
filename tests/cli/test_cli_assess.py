"""``hh-exudyn assess``: values, limits with their marks, files, refusals."""

import math
import re
from functools import partial
from pathlib import Path

import command_line
import numpy as np
import pyarrow
import pyarrow.csv
import pyarrow.parquet
import pytest
from made_up_run import made_up_run

from hh_exudyn.assessment.report import standard_assessment
from hh_exudyn.log.channels import COUPLINGS, ENERGY
from hh_exudyn.log.store import Run, write_status

call = partial(command_line.call, "assess")


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    return made_up_run(
        tmp_path_factory.mktemp("cli") / "run",
        lambda wheelset, side, t: 1e3 * (150 + wheelset) + 0 * t,
        lambda wheelset, side, t: 10e3 * side * np.sin(6.0 * t),
    )


def test_tables_and_files(run: Run, tmp_path: Path) -> None:
    result = call(run.directory, "--out", tmp_path / "sheet.png", "--table", tmp_path / "all.csv")
    assert result.exit_code == 0, result.stderr
    text = result.stdout
    assert re.search(r"50\.0 +300\.0 +straight", text)
    assert re.search(r" Q \[kN\] +154\.0 +200\.0 \? +77 +50 +wheel 4[LR]", text)
    assert re.search(r"Y/Q, 2 m \[-\] +0\.06\d +0\.800 +8 ", text)  # no question mark
    assert "Q [kN]: published: UIC 518 from memory: min(90 + Q0, 200) kN" in text
    assert re.search(r"dQ/Q0 \[-\] +-0\.0\d+ +0\.900 \? ", text)
    assert "Ride index (Sperling) and comfort (EN 12299) of run, whole run" in text
    assert "no statistics: no kind of section has two sections" in text
    assert "Couplings" not in text  # none are logged
    assert "the axle load is above the 25 t" in text
    assert pyarrow.csv.read_csv(tmp_path / "all.csv").num_rows == len(standard_assessment(run).findings)
    assert (tmp_path / "sheet.png").stat().st_size > 10_000


def test_two_runs_together(run: Run, tmp_path: Path) -> None:
    """Their sections are one sample; every table of every run is written."""
    other = made_up_run(
        tmp_path / "other",
        lambda wheelset, side, t: 1e3 * (152 + wheelset) + 0 * t,
        lambda wheelset, side, t: 10e3 * side * np.sin(6.0 * t),
    )
    log_coupling(other)
    result = call(run.directory, other.directory, "--tables", tmp_path / "tables")
    assert result.exit_code == 0, result.stderr
    assert result.stdout.count("Test sections of ") == 2
    mean, deviation = 155.0, math.sqrt(2.0)  # of 154 and 156 kN, wheelset 4
    assert re.search(
        rf" Q \[kN\] +2\* +{mean:.1f} +{deviation:.1f} +2\.2 +{mean + 2.2 * deviation:.1f} ", result.stdout
    )
    assert re.search(r"spring +z +0\.99 +0\.00 +2\.00 +0\.00 +0\.00 +0\.00", result.stdout)
    names = {path.name for path in (tmp_path / "tables").iterdir()}
    assert names == {"sections.csv", "statistics.csv", "ride.csv", "elements.csv", "couplings.csv"}
    for name in names - {"statistics.csv", "couplings.csv"}:
        folders = pyarrow.csv.read_csv(tmp_path / "tables" / name)["folder"].to_pylist()
        assert set(folders) == {"run", "other"}
    elements = pyarrow.csv.read_csv(tmp_path / "tables" / "elements.csv").to_pylist()
    first = next(row for row in elements if row["folder"] == "run" and row["wheelset"] == 4)
    assert first["element"] == "straight"
    assert first["q_mean_N"] == pytest.approx(154e3)


def log_coupling(run: Run) -> None:
    """A log of one coupling whose vertical force swings between 0 and 2 kN, and a ledger with its places."""
    time = np.linspace(0.0, 10.0, 101)
    columns = {column.name: np.zeros(101) for column in COUPLINGS if column.kind == "float64"}
    columns |= {"time": time, "force_z": 1e3 * (1.0 - np.cos(0.2 * np.pi * 10 * time))}
    columns["force_z"][-1] = 0.0
    ledger = {column.name: 20.0 * time if column.name == "s" else time for column in ENERGY}
    for log, table in (("couplings", {**columns, "coupling": ["spring"] * 101}), ("energy", ledger)):
        (run.directory / log).mkdir(exist_ok=True)
        pyarrow.parquet.write_table(pyarrow.table(table), run.directory / log / "part-00000.parquet")


def test_a_run_that_ended_early_is_named_over_every_table(tmp_path: Path) -> None:
    run = made_up_run(tmp_path / "run", lambda w, side, t: 1e5 + 0 * t, lambda w, side, t: 0 * t)
    write_status(run.directory, {"finished": False, "reason": "interrupted"})
    refused = call(run.directory)
    assert refused.exit_code == 2
    assert "the run is not finished: interrupted; --unfinished takes its log so far" in refused.stderr
    shown = call(run.directory, "--unfinished")
    assert shown.exit_code == 0, shown.stderr
    assert shown.stdout.count("(unfinished run: interrupted)") == 2
    assert "not assessed: transition from 300.0 to 390.0 m, covered for " in shown.stdout


def test_refusals(run: Run, tmp_path: Path) -> None:
    (tmp_path / "there.csv").write_text("")
    for words, reason in (
        ((tmp_path / "nowhere",), "is not a directory"),
        ((run.directory, "--section-length-m", "5"), "--section-length-m 5 m: allowed 10 to 1000 m"),
        ((run.directory, "--section-length-m", "600"), "no straight or curve is long enough"),
        ((run.directory, "--table", tmp_path / "there.csv"), "exists already"),
        ((run.directory, "--table", tmp_path / "all.txt"), "allowed is .csv"),
        ((run.directory, "--table", tmp_path / "no" / "all.csv"), "there is no folder"),
        ((run.directory, "--out", tmp_path / "sheet.txt"), "allowed are .png"),
        ((run.directory, "--tables", tmp_path), f"--tables {tmp_path}: is not empty"),
        ((run.directory, run.directory), "two runs have the same name"),
        ((run.directory, run.directory, "--out", tmp_path / "sheet.png"), "a figure is of one run, 2 are"),
    ):
        result = call(*words)
        assert result.exit_code == 2
        assert reason in result.stderr
        assert result.stderr.count("\n") == 1
        assert result.stdout == ""
