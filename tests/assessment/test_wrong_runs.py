"""Runs that ended early, and logs that are wrong, are refused or named."""

from pathlib import Path

import numpy as np
import pyarrow.parquet
import pytest
from made_up_run import made_up_run

from hh_exudyn.assessment.report import standard_assessment
from hh_exudyn.log.store import Run, write_status


@pytest.fixture
def run(tmp_path: Path) -> Run:
    return made_up_run(tmp_path / "run", lambda w, side, t: 1e5 + 0 * t, lambda w, side, t: 0 * t)


def rewrite(run: Run, rows: np.ndarray | None = None, **values: float) -> None:
    """Other rows of the contact log, or values in its row 1000."""
    parts = sorted((run.directory / "contact").glob("part-*.parquet"))
    table = pyarrow.concat_tables([pyarrow.parquet.read_table(part) for part in parts])
    table = table.combine_chunks().replace_schema_metadata(pyarrow.parquet.read_schema(parts[0]).metadata)
    for part in parts:
        part.unlink()
    for name, value in values.items():
        column = table[name].to_numpy().copy()
        column[1000] = value
        table = table.set_column(table.column_names.index(name), name, pyarrow.array(column))
    pyarrow.parquet.write_table(table if rows is None else table.take(rows), parts[0])


def test_a_run_that_ended_early_needs_consent_and_is_named_in_every_row(run: Run) -> None:
    reason = "derailment: no contact for 0.1 s (wheel 1L, t = 18.000 s, s = 360.00 m)"
    write_status(run.directory, {"finished": False, "reason": reason})
    with pytest.raises(ValueError, match=r"is not finished: derailment: no contact .*--unfinished takes"):
        standard_assessment(run)
    found = standard_assessment(run, unfinished=True)
    assert found.ending == reason
    assert set(found.to_table()["run"].to_pylist()) == {reason}


@pytest.mark.parametrize(
    ("values", "part"),
    [
        ({"Q": np.nan}, "Q = nan N"),
        ({"Y": 1e9}, r"Y = 1e\+09 N at time = .* allowed -1e\+07 to 1e\+07 N \(1 such rows\)"),
        ({"s": np.inf}, "s = inf m"),
        ({"wheelset": 99}, "wheelset = 99"),
        ({"time": np.nan}, "time = nan s"),
    ],
)
def test_impossible_values(run: Run, values: dict[str, float], part: str) -> None:
    rewrite(run, **values)
    with pytest.raises(ValueError, match=part):
        standard_assessment(run)


def test_rows_twice_and_gaps(run: Run) -> None:
    number = run.contact().num_rows
    rewrite(run, np.r_[:number, 500:510])
    with pytest.raises(ValueError, match="10 rows are there twice"):
        standard_assessment(run)
    time = run.contact()["time"].to_numpy()[:number]
    rewrite(run, np.flatnonzero((time < 3.0) | (time > 4.0)))
    with pytest.raises(ValueError, match="output interval is 4 to 1008 ms, it must be constant"):
        standard_assessment(run)
