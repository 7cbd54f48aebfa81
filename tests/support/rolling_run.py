"""The folder of a run that nobody simulated: one wheelset rolls straight on for two seconds."""

from pathlib import Path

import numpy as np

from hh_exudyn.log.channels import LOGS
from hh_exudyn.log.store import Recorder, write_case, write_status

TIMES = 0.004 * np.arange(500)
GOOD = {
    "bogie": 1.0, "vehicle": 1.0, "wheelset": 1.0, "rolling_radius": 0.4575, "normal_force": 1e5, "a": 7e-3,
    "b": 5e-3, "p_max": 1.2e9, "friction": 0.4, "speed": 15.0, "Q": 1e5, "force_x": 5e3, "nu_x": -1e-3,
}  # fmt: skip


def rolling_run(folder: Path, case: str, **values: float) -> Path:
    """Write the run of a case with two rows at each of 500 times; returns its folder.

    Parameters
    ----------
    folder
        New.
    case
        TOML.
    values
        Of the columns, other than `GOOD`.
    """
    names = [column.name for column in LOGS["contact"]]
    blocks = []
    for side in (1.0, -1.0):
        given = GOOD | {"time": TIMES, "s": 15.0 * TIMES, "side": side} | values
        blocks.append(np.column_stack([np.broadcast_to(given.get(name, 0.0), TIMES.shape) for name in names]))
    with Recorder(folder, {"case": case}) as recorder:
        write_case(folder, case)
        recorder.append_rows("contact", np.concatenate(blocks)[np.argsort(np.tile(TIMES, 2), kind="stable")])
    write_status(folder, {"finished": True, "reason": "finished"})
    return folder
