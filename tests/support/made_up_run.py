"""A run that nobody simulated: the wagon glides along a track, wheel forces are given functions of time."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from hh_exudyn.case import Case
from hh_exudyn.log.channels import LOGS
from hh_exudyn.log.store import Recorder, Run, open_run, write_case, write_status
from vehicles.catalogue import vehicle

Wave = Callable[[np.ndarray], np.ndarray]
SPEED = 20.0  # m/s
CASE = """
name = "made up"
vehicle = "iore_wagon_loaded"
speed_km_h = 72.0
friction = 0.4
[track]
flexibility = "rigid"
[[track.sections]]
kind = "straight"
length_m = 300.0
[[track.sections]]
kind = "transition"
length_m = 90.0
[[track.sections]]
kind = "curve"
length_m = 10.0
radius_m = 20000.0
hand = "left"
"""


def made_up_run(
    directory: Path,
    Q: Callable[[int, int, np.ndarray], np.ndarray],
    Y: Callable[[int, int, np.ndarray], np.ndarray],
    lateral_velocity: Wave = np.zeros_like,
    yaw_rate: Wave = np.zeros_like,
    interval: float = 0.004,
    end: float = 380.0,
    case: str = CASE,
) -> Run:
    """Q and Y of (wheelset from 1, side) over time [s]; all bodies sway and turn about their own centres."""
    wagon = vehicle("iore_wagon_loaded")
    text = Case.from_toml(case).to_toml()
    time = interval * np.arange(round(end / SPEED / interval))
    middle = SPEED * time
    names = [body.name for body in wagon.bodies]
    with Recorder(directory, {"case": text}, names={"body": names}) as recorder:
        write_case(directory, text)
        columns = {column.name: np.zeros(time.size) for column in LOGS["contact"]}
        blocks = []
        for number, wheelset in enumerate(wagon.wheelsets, 1):
            s = middle + wagon.body(wheelset.body).position[0]
            for side in (1, -1):
                given = {
                    "time": time, "s": s, "vehicle": 1.0, "bogie": wheelset.bogie, "wheelset": number,
                    "side": side, "Q": Q(number, side, time), "Y": Y(number, side, time),
                }  # fmt: skip
                blocks.append(
                    np.column_stack(
                        [np.broadcast_to(given.get(n, v), time.shape) for n, v in columns.items()]
                    )
                )
        recorder.append_rows("contact", np.concatenate(blocks))
        angle = np.concatenate(
            [[0.0], np.cumsum(0.5 * np.diff(time) * (yaw_rate(time)[1:] + yaw_rate(time)[:-1]))]
        )
        turned = Rotation.from_rotvec(angle[:, None] * np.array([0.0, 0.0, 1.0])).as_quat()
        rows = []
        for code, body in enumerate(wagon.bodies):
            given = {
                "time": time, "body": float(code), "s": middle + body.position[0], "vx": SPEED,
                "vy": lateral_velocity(time), "wz": yaw_rate(time), "qz": turned[:, 2], "qw": turned[:, 3],
            }  # fmt: skip
            zeros = [column.name for column in LOGS["motion"]]
            rows.append(np.column_stack([np.broadcast_to(given.get(n, 0.0), time.shape) for n in zeros]))
        recorder.append_rows("motion", np.concatenate(rows))
    write_status(directory, {"finished": True, "reason": "finished"})
    return open_run(directory)
