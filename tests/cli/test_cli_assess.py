"""``hh-exudyn assess``: values, limits with their marks, files, refusals."""

import re
from functools import partial
from pathlib import Path

import command_line
import numpy as np
import pyarrow.csv
import pytest
from made_up_run import made_up_run

from hh_exudyn.assessment.report import standard_assessment
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
    assert "the axle load is above the 25 t" in text
    assert pyarrow.csv.read_csv(tmp_path / "all.csv").num_rows == len(standard_assessment(run).findings)
    assert (tmp_path / "sheet.png").stat().st_size > 10_000


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
    ):
        result = call(*words)
        assert result.exit_code == 2
        assert reason in result.stderr
        assert result.stderr.count("\n") == 1
        assert result.stdout == ""
