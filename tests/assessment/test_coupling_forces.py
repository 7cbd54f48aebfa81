"""Ranges of logged couplings, whole and by element, of a log written by hand."""

from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest

from hh_exudyn.assessment.coupling_forces import coupling_ranges, has_couplings, to_table
from hh_exudyn.assessment.sections import AssessedSection
from hh_exudyn.log.channels import COUPLINGS, ENERGY
from hh_exudyn.log.store import Run

TIME = 0.1 * np.arange(101)  # s, at 10 m/s: 0 to 100 m
ELEMENTS = [AssessedSection("straight", 0.0, 50.0), AssessedSection("curve", 50.0, 200.0, 1 / 450)]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """A spring whose force and displacement grow along the track, and one at rest."""
    columns = {column.name: np.zeros(202) for column in COUPLINGS if column.kind == "float64"}
    columns["time"] = np.repeat(TIME, 2)
    columns["force_z"][0::2], columns["displacement_z"][0::2] = 1e3 * TIME, -1e-3 * TIME
    table = pyarrow.table({**columns, "coupling": ["spring", "idle"] * 101})
    ledger = pyarrow.table({column.name: TIME if column.name == "time" else 10.0 * TIME for column in ENERGY})
    for log, content in (("couplings", table), ("energy", ledger)):
        (tmp_path / log).mkdir()
        pyarrow.parquet.write_table(content, tmp_path / log / "part-00000.parquet")
    return Run(tmp_path)


def test_whole_run_and_elements(run: Run) -> None:
    assert has_couplings(run)
    found = {(one.coupling, one.element, one.component): one for one in coupling_ranges(run, ELEMENTS)}
    whole = found["spring", "whole run", "force_z"]
    assert (whole.mean, whole.least, whole.largest) == pytest.approx((5e3, 0.0, 10e3))
    assert (whole.start, whole.end, whole.unit) == (0.0, 100.0, "N")
    curve = found["spring", "curve R 450 m left", "displacement_z"]
    assert (curve.mean, curve.least, curve.largest) == pytest.approx((-7.5e-3, -10e-3, -5e-3))
    assert found["idle", "straight", "force_z"].largest == 0.0
    rows = to_table(list(found.values())).to_pylist()
    assert len(rows) == 2 * 3 * 9
    assert rows[0]["coupling"] == "spring"  # as logged


def test_no_log_no_ranges(tmp_path: Path) -> None:
    assert coupling_ranges(Run(tmp_path)) == []
