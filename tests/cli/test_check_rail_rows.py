"""Rows of flange backs are counted, for they are in no contact log and so in no damage."""

from pathlib import Path

import numpy as np
from rolling_run import rolling_run

from hh_exudyn.cli.damage import check_rail_rows
from hh_exudyn.log.channels import CHECK_RAIL
from hh_exudyn.log.store import Recorder, open_run


def test_rows_of_flange_backs_are_counted(tmp_path: Path) -> None:
    without = open_run(rolling_run(tmp_path / "without", "name = 'x'"))
    assert check_rail_rows(without) == 0
    with Recorder(tmp_path / "with", {}) as recorder:
        recorder.append_rows("check_rail", np.ones((7, len(CHECK_RAIL))))
    assert check_rail_rows(open_run(tmp_path / "with")) == 7
