"""A run that never was: a wagon that follows a track exactly, with made-up contact states."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pyarrow
import pytest
from scipy.spatial.transform import Rotation

from hh_exudyn.case import Case
from hh_exudyn.contact.geometry.rail_tables import RailCourse
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.log.channels import CONTACT, MOTION
from hh_exudyn.playback.frames import track_frames
from hh_exudyn.playback.run import Scene
from hh_exudyn.playback.shapes.dimensions import wagon_dimensions
from hh_exudyn.playback.shapes.vehicle import vehicle_shapes
from track.course.alignment import Alignment, Curve, Straight, Transition
from vehicles.catalogue import vehicle

SPEED = 16.0  # m/s


@dataclass(frozen=True)
class SyntheticRun:
    """Logs as tables, the scene, and what they were made from."""

    motion: pyarrow.Table
    contact: pyarrow.Table
    scene: Scene
    times: np.ndarray
    s: np.ndarray  # of the car body


def _motion(alignment: Alignment, times: np.ndarray, s: np.ndarray) -> pyarrow.Table:
    rows: dict[str, list[np.ndarray]] = {column.name: [] for column in MOTION}
    for body in vehicle("iore_wagon_loaded").bodies:
        x, y, z = body.position
        frames = track_frames(alignment, s + x)
        spin = -s / z if body.kind == "wheelset" else np.zeros_like(s)
        turn = frames.rotation * Rotation.from_rotvec(np.outer(-spin, (0.0, 1.0, 0.0)))
        position = frames.origin + frames.rotation.apply((0.0, y, z))
        quaternion = turn.as_quat()
        values = {"time": times, "body": np.full(len(times), body.name), "s": s + x}
        values |= dict(zip("xyz", position.T, strict=True))
        values |= dict(zip(("qx", "qy", "qz", "qw"), quaternion.T, strict=True))
        for name, column in rows.items():
            column.append(values.get(name, np.zeros(len(times))))
    return pyarrow.table({name: np.concatenate(column) for name, column in rows.items()})


def _contact(alignment: Alignment, times: np.ndarray, s: np.ndarray) -> pyarrow.Table:
    """One patch a wheel; in the second half the leading left wheel has two, its right one none."""
    size = wagon_dimensions(vehicle("iore_wagon_loaded"))
    rows: dict[str, list[np.ndarray]] = {column.name: [] for column in CONTACT}
    for wheelset in range(4):
        x = (1 if wheelset < 2 else -1) * 0.5 * size.centre_plate_distance
        x += (1 if wheelset % 2 == 0 else -1) * 0.5 * size.wheelbase
        for side in (1, -1):
            for patch in (0, 1):
                late = times > 0.5 * times[-1]
                leading = wheelset == 0
                here = ~(late & leading & (side == -1)) if patch == 0 else late & leading & (side == 1)
                normal = 147e3 + 20e3 * np.sin(3.0 * times + wheelset) * side
                values = {
                    "time": times, "s": s + x, "vehicle": 1, "bogie": 1 + wheelset // 2,
                    "wheelset": wheelset + 1, "side": side, "patch": patch, "y_rail": 0.004 + 0.02 * patch,
                    "y_wheel": 0.002 + 0.02 * patch, "contact_angle": 0.05 + 0.6 * patch,
                    "rolling_radius": 0.4575, "normal_force": normal,
                    "a": 0.0075, "b": 0.0029 + 0.001 * np.sin(times), "p_max": 1.5 * normal / (np.pi * 3e-5),
                    "nu_x": 1e-3 * np.sin(times), "nu_y": 2e-3 * np.cos(times), "friction": 0.4,
                    "speed": SPEED, "force_x": 0.15 * normal * np.sin(times + wheelset),
                    "force_y": -0.25 * side * normal, "Q": normal, "Y": 0.2 * normal,
                }  # fmt: skip
                for name, column in rows.items():
                    column.append(np.broadcast_to(values.get(name, 0.0), times.shape)[here])
    columns = {c.name: np.concatenate(rows[c.name]).astype(c.kind) for c in CONTACT}
    table = pyarrow.table(columns)
    return table.sort_by([("time", "ascending"), ("wheelset", "ascending"), ("side", "descending")])


@pytest.fixture(scope="session")
def synthetic_run() -> Callable[..., SyntheticRun]:
    """A builder: seconds and rate [1/s] of the run, s of the car body at its start [m], a case's track."""

    def build(
        seconds: float = 2.0, rate: float = 50.0, start: float = 60.0, case: Case | None = None
    ) -> SyntheticRun:
        sections = [Straight(start), Transition(60.0), Curve(200.0, 300.0, "left", 0.06), Transition(60.0)]
        alignment = Alignment((*sections, Straight(50.0)), step=2.0, run_out=150.0, lead_in=150.0)
        if case is not None:
            alignment = case.alignment()
        times = np.round(np.arange(int(seconds * rate) + 1) / rate, 9)
        s = start + SPEED * times
        wheel = wheel_profile("S1002")
        wagon = vehicle("iore_wagon_loaded")
        shapes = vehicle_shapes(wagon, np.column_stack([wheel.y, wheel.z]))
        rail = RailCourse((rail_profile("60E1"),))
        scene = Scene(wagon, shapes, alignment, rail, rail)
        return SyntheticRun(_motion(alignment, times, s), _contact(alignment, times, s), scene, times, s)

    return build
