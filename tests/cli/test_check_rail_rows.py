"""Rows of flange backs are counted, for they are in no contact log and so in no damage."""

from pathlib import Path

import numpy as np
from rolling_run import rolling_run

from hh_exudyn.cli.check_rails import check_rail_rows, largest_forces
from hh_exudyn.log.channels import CHECK_RAIL, CheckRailColumn
from hh_exudyn.log.store import Recorder, open_run


def test_rows_of_flange_backs_are_counted(tmp_path: Path) -> None:
    without = open_run(rolling_run(tmp_path / "without", "name = 'x'"))
    assert check_rail_rows(without) == 0
    assert largest_forces(without) == ""
    rows = np.ones((7, len(CHECK_RAIL)))
    rows[:, CheckRailColumn.normal_force] = 1e3 * np.arange(7.0)
    rows[5:, CheckRailColumn.side] = -1
    with Recorder(tmp_path / "with", {}) as recorder:
        recorder.append_rows("check_rail", rows)
    run = open_run(tmp_path / "with")
    assert check_rail_rows(run) == 7
    assert "[kN]: 1L 4.0, 1R 6.0; it is in Q and Y" in largest_forces(run)
