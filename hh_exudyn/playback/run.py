"""A run as a rerun recording: the vehicle on its track, forces at the wheels, time series, shakedown diagram.

Entities: ``world/track/<piece>/{rails,bed,sleepers}`` (static), ``world/vehicle`` (the moving frame, on
the centre line below the car body), ``world/vehicle/<body>``, ``world/vehicle/contact/<wheel>/force`` and
``.../patch``, ``plots/<quantity>/<wheel>``, ``shakedown/**``. Wheels are named by wheelset and side, "1L"
the leading left one, with the unit before it for several units, "2.1L". Logged couplings: `couplings`.
Timelines: ``sim_time`` and ``track_mm``, the arc length of the leading car body.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow
import rerun as rr
import trimesh

from damage.material import ER7
from hh_exudyn.arrays import FloatArray
from hh_exudyn.case import Case
from hh_exudyn.contact.check_rail.table import CheckRail
from hh_exudyn.contact.geometry.rail_tables import RailCourse
from hh_exudyn.contact.profile import Profile
from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.log.parts import part_paths
from hh_exudyn.log.store import Run
from hh_exudyn.playback.couplings import CouplingCourse, coupling_courses, most_varying, send_couplings
from hh_exudyn.playback.frames import Poses, moving_frame, relative
from hh_exudyn.playback.layout import blueprint
from hh_exudyn.playback.recording import new_recording
from hh_exudyn.playback.send import (
    body_poses,
    clock,
    send_contact,
    send_diagram,
    send_diagram_points,
    send_mesh,
    send_poses,
    send_series,
    send_track_piece,
)
from hh_exudyn.playback.shapes.track import pieces
from hh_exudyn.playback.shapes.vehicle import vehicle_shapes
from hh_exudyn.playback.wheels import wheel_rows
from track.course.alignment import Alignment
from vehicles.description import Vehicle
from vehicles.stored import from_json

SIGHT = 150.0  # track drawn beyond both ends of the vehicle's path [m]


@dataclass(frozen=True)
class Scene:
    """The surroundings of a log: vehicle, shapes, track and strength.

    They follow from the case; nothing of the log is needed.

    Attributes
    ----------
    vehicle
        The vehicle of the run.
    shapes
        Meshes about the centres of mass, by entity below ``world/vehicle``.
    alignment
        Of the track that was run on.
    rail_left, rail_right
        Rail profiles along the track.
    shear_yield
        Yield strength in pure shear k of the wheel, for fatigue index and shakedown diagram [Pa].
    check_rail
        Check rails; None for a track without.
    """

    vehicle: Vehicle
    shapes: Mapping[str, trimesh.Trimesh]
    alignment: Alignment
    rail_left: RailCourse
    rail_right: RailCourse
    shear_yield: float = ER7.shear_yield
    check_rail: CheckRail | None = None


def scene(case: Case, described: Vehicle | None = None) -> Scene:
    """The scene of a case.

    Parameters
    ----------
    case
        The case of the run.
    described
        The vehicle of the run; None for that of the case.
    """
    vehicle = described or case.described_vehicle()
    own = {}
    if case.wheel_profiles is not None:
        for wheelset, (left, right) in zip(
            vehicle.wheelsets, case.wheels(len(vehicle.wheelsets)), strict=True
        ):
            own[wheelset.body] = (_tread(left), _tread(right))
    rails = (case.track.rail_course(LEFT), case.track.rail_course(RIGHT))
    shapes = vehicle_shapes(vehicle, _tread(case.wheel), own)
    alignment, check = case.alignment(), case.track.check_rail
    beside = None if check is None else check.described(alignment)
    return Scene(vehicle, shapes, alignment, *rails, check_rail=beside)


def _tread(wheel: Profile) -> FloatArray:
    return np.column_stack([wheel.y, wheel.z])


def leading_body(vehicle: Vehicle) -> str:
    """Name of the body that the moving frame follows: the first car body, else that of a coupler head."""
    car_bodies = (body.name for body in vehicle.bodies if body.kind == "car_body")
    return next(car_bodies, vehicle.coupler.bodies[0])


def record(run: Run, path: Path | str, *, every: int = 1, vehicle: int | None = None) -> Path:
    """Write a run as a recording with its blueprint (`.rrd`), and return its path.

    Parameters
    ----------
    run
        The run on disk; the scene is built from its case and its copy of the vehicle.
    path
        File to write.
    every
        Every n-th output time is sent, n from 1.
    vehicle
        Number of the vehicle in the run, to show its wheels alone; None: those of all.

    Raises
    ------
    ValueError
        `every` below 1; a log without rows, of another vehicle, or off the case's track.
    FileNotFoundError
        The run has no case or no logs.
    """
    case = Case.from_toml(run.case_text, folder=run.directory)
    described = None if run.vehicle_text is None else from_json(run.vehicle_text)
    return record_tables(
        run.motion(),
        run.contact(),
        scene(case, described),
        path,
        name=run.directory.name,
        every=every,
        vehicle=vehicle,
        couplings=run.read("couplings") if part_paths(run.directory, "couplings") else None,
    )


def record_tables(
    motion: pyarrow.Table,
    contact: pyarrow.Table,
    scene: Scene,
    path: Path | str,
    *,
    name: str = "run",
    every: int = 1,
    vehicle: int | None = None,
    couplings: pyarrow.Table | None = None,
) -> Path:
    """As `record`, from motion and contact log as tables, and a scene.

    Parameters
    ----------
    motion, contact
        The two logs.
    scene
        Vehicle, shapes and track.
    path
        File to write.
    name
        Of the recording.
    every, vehicle
        As `record`.
    couplings
        The log of couplings; None for a run without.
    """
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    courses = [] if couplings is None else _courses(couplings, motion, scene, every)
    view = blueprint(scene.vehicle, leading_body(scene.vehicle), couplings=most_varying(courses))
    with new_recording(target, name, view) as stream:
        send(stream, motion, contact, scene, every=every, vehicle=vehicle, couplings=courses)
    return target


def send(
    stream: rr.RecordingStream,
    motion: pyarrow.Table,
    contact: pyarrow.Table,
    scene: Scene,
    *,
    every: int = 1,
    vehicle: int | None = None,
    couplings: Sequence[CouplingCourse] = (),
) -> None:
    """Send a run into any recording stream: a file, or a viewer that listens. Errors as `record`.

    Parameters
    ----------
    stream
        The recording.
    motion, contact
        The two logs.
    scene
        Vehicle, shapes and track.
    every, vehicle
        As `record`.
    couplings
        Courses of the logged couplings at the same times.
    """
    bodies, leader = _led_bodies(motion, scene, every)
    times, s = bodies[leader]["time"], bodies[leader]["s"]
    when = clock(times, s)
    frame = moving_frame(scene.alignment, s)

    stream.log("world", rr.ViewCoordinates.FLU, static=True)
    for number, piece in enumerate(
        pieces(
            scene.alignment,
            scene.rail_left,
            scene.rail_right,
            s.min() - SIGHT,
            s.max() + SIGHT,
            scene.check_rail,
        )
    ):
        send_track_piece(stream, f"world/track/{number:04d}", piece)
    for entity, mesh in scene.shapes.items():
        send_mesh(stream, f"world/vehicle/{entity}", mesh)
    send_poses(stream, "world/vehicle", when, frame)
    for body, columns in bodies.items():
        if not np.array_equal(columns["time"], times):
            raise ValueError(f"the motion log has body {body} at other times than {leader}")
        send_poses(stream, f"world/vehicle/{body}", when, relative(body_poses(columns), frame))
    _send_wheels(stream, _thinned(contact, times, every), scene, frame, times, s, vehicle)
    send_couplings(stream, when, couplings)


def _send_wheels(
    stream: rr.RecordingStream,
    contact: pyarrow.Table,
    scene: Scene,
    frame: Poses,
    times: FloatArray,
    s: FloatArray,
    vehicle: int | None,
) -> None:
    """The entities of the contact log: shakedown diagram, forces and patches, time series."""
    when = clock(times, s)
    send_diagram(stream)
    shown = np.unique(contact["vehicle"].to_numpy()).tolist() if vehicle is None else [vehicle]
    for wheel in (wheel for number in shown for wheel in wheel_rows(contact, times, number)):
        rail = scene.rail_left if wheel.side == LEFT else scene.rail_right
        send_contact(stream, when, wheel, scene.alignment, rail, frame)
        send_series(stream, when, wheel, scene.shear_yield)
        send_diagram_points(stream, when, wheel, scene.shear_yield)


def _led_bodies(
    motion: pyarrow.Table, scene: Scene, every: int
) -> tuple[dict[str, dict[str, FloatArray]], str]:
    """Rows of the motion log by body, and the name of the body that the moving frame follows."""
    if every < 1:
        raise ValueError(f"every = {every} must be at least 1")
    bodies = _bodies(motion, every)
    leader = leading_body(scene.vehicle)
    if leader not in bodies:
        raise ValueError(f"the motion log has no body {leader}; it has {', '.join(bodies)}")
    return bodies, leader


def _courses(
    couplings: pyarrow.Table, motion: pyarrow.Table, scene: Scene, every: int
) -> list[CouplingCourse]:
    """The logged couplings at the output times that are sent."""
    bodies, leader = _led_bodies(motion, scene, every)
    return coupling_courses(couplings, bodies[leader]["time"])


def _bodies(motion: pyarrow.Table, every: int) -> dict[str, dict[str, FloatArray]]:
    """Rows of the motion log by body, in order of time."""
    if motion.num_rows == 0:
        raise ValueError("the motion log has no rows")
    names = np.asarray(motion["body"].to_pylist(), dtype=str)
    numbers = {name: motion[name].to_numpy() for name in motion.column_names if name != "body"}
    result = {}
    for body in dict.fromkeys(names.tolist()):
        index = np.flatnonzero(names == body)
        index = index[np.argsort(numbers["time"][index], kind="stable")][::every]
        result[body] = {name: column[index] for name, column in numbers.items()}
    return result


def _thinned(contact: pyarrow.Table, times: FloatArray, every: int) -> pyarrow.Table:
    """The contact log at the given times."""
    if every == 1:
        return contact
    return contact.filter(pyarrow.array(np.isin(contact["time"].to_numpy(), times)))
