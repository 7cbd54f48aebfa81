"""One mode of a vehicle as a rerun recording: its bodies oscillate about their places on straight track.

Entities: ``world/track/<piece>/...`` and ``world/vehicle/<body>`` as of a run; timeline: ``sim_time``. One
period takes `PERIOD` for any frequency, and the motion neither grows nor decays, so that slow and fast modes
are equally visible.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from scipy.spatial.transform import Rotation

from hh_exudyn.arrays import ComplexArray, FloatArray
from hh_exudyn.case import Case
from hh_exudyn.playback.frames import Poses
from hh_exudyn.playback.layout import vehicle_view
from hh_exudyn.playback.recording import new_recording
from hh_exudyn.playback.run import Scene, leading_body, scene
from hh_exudyn.playback.send import clock, send_mesh, send_poses, send_track_piece
from hh_exudyn.playback.shapes.track import pieces
from track.course.alignment import Alignment, Straight
from vehicles.description import Vehicle
from vehicles.outline import vehicle_box

PERIOD = 2.0  # s of the playback, of one oscillation
SWINGS = 4
PICTURE_RATE = 30  # pictures a second
AMPLITUDE = 0.12  # of the largest displacement [m] or rotation [rad]
SIGHT = 60.0  # track drawn before and behind the vehicle [m]


def swing(shape: ComplexArray, times: FloatArray) -> FloatArray:
    """Displacements [m] and rotations [rad] of all bodies, (times, bodies, 6), largest `AMPLITUDE`.

    Parameters
    ----------
    shape
        (bodies, 6) three displacements and three small rotations, complex, with their phases.
    times
        (n,) of the playback [s].
    """
    scaled = shape * AMPLITUDE / np.abs(shape).max()
    turning = np.exp(2j * np.pi * times / PERIOD)
    return np.asarray((turning[:, None, None] * scaled[None]).real, dtype=np.float64)


def record_mode(case: Case, vehicle: Vehicle, shape: ComplexArray, path: Path | str, *, name: str) -> Path:
    """Write a mode as a recording (`.rrd`), and return its path.

    Parameters
    ----------
    case
        Wheel profile and rails at the track's start.
    vehicle
        The vehicle of the mode.
    shape
        (bodies, 6) as of `swing`, in the order of the vehicle's bodies.
    path
        File to write.
    name
        Of the recording.

    Raises
    ------
    ValueError
        The shape has not six numbers for each of the vehicle's bodies.
    """
    if shape.shape != (len(vehicle.bodies), 6):
        raise ValueError(f"shape is {shape.shape}, {vehicle.name} needs {(len(vehicle.bodies), 6)}")
    low, high = vehicle_box(vehicle)
    length = float(high[0] - low[0]) + 2 * SIGHT
    straight = Alignment((Straight(length),), lead_in=length)
    shown = replace(scene(case, vehicle), alignment=straight)
    target = Path(path)
    view = rrb.Blueprint(
        vehicle_view(vehicle, leading_body(vehicle)),
        rrb.TimePanel(state="collapsed", timeline="sim_time"),
        rrb.BlueprintPanel(state="hidden"),
        rrb.SelectionPanel(state="hidden"),
    )
    with new_recording(target, name, view) as stream:
        _send(stream, shown, shape, (float(low[0]) - SIGHT, float(high[0]) + SIGHT))
    return target


def _send(stream: rr.RecordingStream, shown: Scene, shape: ComplexArray, reach: tuple[float, float]) -> None:
    """Track, shapes and the oscillating bodies."""
    times = np.arange(round(SWINGS * PERIOD * PICTURE_RATE) + 1) / PICTURE_RATE
    when = clock(times, np.zeros_like(times))[:1]  # the vehicle does not move along the track
    stream.log("world", rr.ViewCoordinates.FLU, static=True)
    for number, piece in enumerate(
        pieces(shown.alignment, shown.rail_left, shown.rail_right, *reach, shown.check_rail)
    ):
        send_track_piece(stream, f"world/track/{number:04d}", piece)
    for entity, mesh in shown.shapes.items():
        send_mesh(stream, f"world/vehicle/{entity}", mesh)
    vehicle = shown.vehicle
    frame = (vehicle.body(leading_body(vehicle)).position[0], 0.0, 0.0)
    stream.log("world/vehicle", rr.Transform3D(translation=frame), static=True)
    motion = swing(shape, times)
    for index, body in enumerate(vehicle.bodies):
        place = np.array(body.position) - frame + motion[:, index, :3]
        turn = Rotation.from_rotvec(motion[:, index, 3:])
        send_poses(stream, f"world/vehicle/{body.name}", when, Poses(place, turn))
