"""The entities of a recording: columns and static meshes for rerun, a function each."""

from collections.abc import Mapping, Sequence

import numpy as np
import rerun as rr
import trimesh
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from damage.shakedown import point_contact_limit
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.rail_tables import RailCourse
from hh_exudyn.playback.frames import Poses, relative
from hh_exudyn.playback.layout import FRICTION_SCALE, LARGEST_FRICTION, LARGEST_PRESSURE
from hh_exudyn.playback.shapes.meshes import shaded
from hh_exudyn.playback.shapes.track import Piece, sleeper
from hh_exudyn.playback.wheels import WheelRows, contact_frames, diagram_points, series
from track.course.alignment import Alignment

Clock = Sequence[rr.TimeColumn]

FORCE_SCALE = 0.6e-5  # length of a normal force's arrow [m/N]: 100 kN are 0.6 m
CREEP_FORCE_SCALE = 3.0e-5  # creep forces are drawn five times longer
ARROW_OFFSET = 0.48  # of forces, outwards from their contacts, where no wheel hides them [m]
PATCH_SCALE = 25.0  # enlargement of the patches
PATCH_THICKNESS = 0.006  # [m]
NORMAL_COLOUR = (60, 190, 255)
CREEP_COLOUR = (255, 170, 30)
WHEEL_COLOURS: Mapping[str, tuple[int, int, int]] = {
    "1L": (229, 57, 53), "1R": (255, 158, 158), "2L": (67, 160, 71), "2R": (165, 214, 167),
    "3L": (30, 136, 229), "3R": (144, 202, 249), "4L": (251, 192, 45), "4R": (255, 241, 118),
    "5L": (171, 71, 188), "5R": (225, 190, 231), "6L": (0, 172, 193), "6R": (128, 222, 234),
}  # fmt: skip
OTHER_COLOUR = (200, 200, 200)


def clock(times: FloatArray, s: FloatArray) -> Clock:
    """The timelines: `sim_time` in whole nanoseconds and `track_mm`, the vehicle's arc length [mm].

    Parameters
    ----------
    times
        (n,) output times [s].
    s
        (n,) arc lengths of the vehicle [m].
    """
    nanoseconds = np.round(times * 1e9).astype(np.int64)
    return (
        rr.TimeColumn("sim_time", duration=nanoseconds.astype("timedelta64[ns]")),
        rr.TimeColumn("track_mm", sequence=np.round(s * 1e3).astype(np.int64)),
    )


def send_mesh(stream: rr.RecordingStream, entity: str, mesh: trimesh.Trimesh) -> None:
    """A mesh, static."""
    shape = shaded(mesh)
    stream.log(
        entity,
        rr.Mesh3D(
            vertex_positions=shape.positions,
            triangle_indices=shape.triangles,
            vertex_normals=shape.normals,
            vertex_colors=shape.colours,
        ),
        static=True,
    )


def send_track_piece(stream: rr.RecordingStream, entity: str, piece: Piece) -> None:
    """A piece of track about its own origin; one mesh of a sleeper for all of them."""
    stream.log(entity, rr.Transform3D(translation=piece.origin), static=True)
    send_mesh(stream, f"{entity}/rails", piece.rails)
    send_mesh(stream, f"{entity}/bed", piece.bed)
    if len(piece.sleepers.position):
        send_mesh(stream, f"{entity}/sleepers", sleeper())
        poses = rr.InstancePoses3D(
            translations=piece.sleepers.position, quaternions=piece.sleepers.rotation.as_quat()
        )
        stream.log(f"{entity}/sleepers", poses, static=True)


def send_poses(stream: rr.RecordingStream, entity: str, when: Clock, poses: Poses) -> None:
    """A moving frame or body, one pose at each time."""
    columns = rr.Transform3D.columns(translation=poses.position, quaternion=poses.rotation.as_quat())
    stream.send_columns(entity, when, columns)


def send_contact(
    stream: rr.RecordingStream,
    when: Clock,
    wheel: WheelRows,
    alignment: Alignment,
    rail: RailCourse,
    frame: Poses,
) -> None:
    """Forces on a wheel as arrows and its patches as discs, in the moving frame (n poses).

    Parameters
    ----------
    stream
        The recording.
    when
        Timelines of the n output times.
    wheel
        Rows of the contact log of a wheel.
    alignment, rail
        Track, and rails of that side.
    frame
        N poses of the moving frame.
    """
    row = np.repeat(np.arange(len(wheel.patches)), wheel.patches)
    seen_from = Poses(frame.position[row], frame.rotation[row])
    place = relative(contact_frames(wheel, alignment, rail), seen_from)
    rows = wheel.columns
    zero = np.zeros(len(row))
    normal = np.column_stack([zero, zero, FORCE_SCALE * rows["normal_force"]])
    creep = CREEP_FORCE_SCALE * np.column_stack([rows["force_x"], rows["force_y"], zero])
    vectors = np.stack([place.rotation.apply(normal), place.rotation.apply(creep)], axis=1).reshape(-1, 3)
    origins = np.repeat(place.position, 2, axis=0)
    entity = f"world/vehicle/contact/{wheel.name}"
    colours = np.tile(np.array([NORMAL_COLOUR, CREEP_COLOUR], dtype=np.uint8), (len(row), 1))
    stream.log(
        f"{entity}/force", rr.Transform3D(translation=(0.0, wheel.side * ARROW_OFFSET, 0.0)), static=True
    )
    stream.send_columns(
        f"{entity}/force",
        when,
        [
            *rr.Arrows3D.columns(vectors=vectors, origins=origins, colors=colours).partition(
                2 * wheel.patches
            ),
            *rr.Arrows3D.columns(radii=np.full(len(wheel.patches), 0.022)),
        ],
    )
    thin = np.full(len(row), PATCH_THICKNESS)
    half_sizes = np.column_stack([PATCH_SCALE * rows["a"], PATCH_SCALE * rows["b"], thin])
    used = np.hypot(rows["force_x"], rows["force_y"]) / np.maximum(
        rows["friction"] * rows["normal_force"], 1e-9
    )
    stream.log(f"{entity}/patch", rr.Ellipsoids3D.from_fields(fill_mode="solid"), static=True)
    stream.send_columns(
        f"{entity}/patch",
        when,
        rr.Ellipsoids3D.columns(
            half_sizes=half_sizes,
            centers=place.position,
            quaternions=place.rotation.as_quat(),
            colors=_heat(np.clip(used, 0.0, 1.0)),
        ).partition(wheel.patches),
    )


def _heat(share: FloatArray) -> NDArray[np.uint8]:
    """Colours from blue (no friction used) over yellow to red (all of it)."""
    stops = np.array([[40, 90, 255], [250, 220, 50], [230, 30, 30]], dtype=np.float64)
    return np.stack([np.interp(share, (0.0, 0.5, 1.0), stops[:, i]) for i in range(3)], axis=1).astype(
        np.uint8
    )


def _colour(wheel: str) -> tuple[int, ...]:
    """Colour of a wheel by its name; darker from the second unit on."""
    unit, _, name = wheel.rpartition(".")
    colour = WHEEL_COLOURS.get(name, OTHER_COLOUR)
    return colour if unit in ("", "1") else tuple(2 * part // 3 for part in colour)


def send_series(stream: rr.RecordingStream, when: Clock, wheel: WheelRows, shear_yield: float) -> None:
    """The plotted quantities of a wheel.

    Parameters
    ----------
    stream, when, wheel
        As in `send_contact`.
    shear_yield
        Yield strength in pure shear k [Pa].
    """
    colour = _colour(wheel.name)
    for key, values in series(wheel, shear_yield).items():
        entity = f"plots/{key}/{wheel.name}"
        stream.log(entity, rr.SeriesLines(colors=[colour], names=[wheel.name], widths=[1.6]), static=True)
        stream.send_columns(entity, when, rr.Scalars.columns(scalars=values))


def send_diagram_points(
    stream: rr.RecordingStream, when: Clock, wheel: WheelRows, shear_yield: float
) -> None:
    """The working points of a wheel's patches in the shakedown diagram (which is y-down).

    Arguments as in `send_series`.
    """
    friction, pressure = diagram_points(wheel, shear_yield)
    entity = f"shakedown/points/{wheel.name}"
    colour = _colour(wheel.name)
    stream.log(entity, rr.Points2D.from_fields(colors=[colour], radii=[0.24], draw_order=10.0), static=True)
    stream.send_columns(
        entity,
        when,
        [
            *rr.Points2D.columns(positions=np.column_stack([FRICTION_SCALE * friction, -pressure])).partition(
                wheel.patches
            ),
            *rr.Points2D.columns(labels=[wheel.name] * int(wheel.patches.sum())).partition(wheel.patches),
        ],
    )


def send_diagram(stream: rr.RecordingStream) -> None:
    """Axes, grid and limit curve of the shakedown diagram."""
    friction = np.linspace(0.0, LARGEST_FRICTION, 200)
    limit = np.column_stack([FRICTION_SCALE * friction, -point_contact_limit(friction)])
    stream.log(
        "shakedown/limit",
        rr.LineStrips2D([limit], colors=[(255, 255, 255)], radii=[0.05], draw_order=5.0),
        static=True,
    )
    right, top = FRICTION_SCALE * LARGEST_FRICTION, -LARGEST_PRESSURE
    across = np.arange(0.0, LARGEST_FRICTION + 0.01, 0.1) * FRICTION_SCALE
    up = np.arange(0.0, LARGEST_PRESSURE + 0.1, 2.0)
    grid = [[(x, 0.0), (x, top)] for x in across] + [[(0.0, -y), (right, -y)] for y in up]
    stream.log(
        "shakedown/grid",
        rr.LineStrips2D(grid, colors=[(80, 84, 92)], radii=[0.015], draw_order=1.0),
        static=True,
    )
    ticks = [(x, 0.55) for x in across] + [(-0.5, -y) for y in up]
    names = [f"{x / FRICTION_SCALE:.1f}" for x in across] + [f"{y:.0f}" for y in up]
    titles = [(0.5 * right, 1.35), (0.8, top + 0.5)]
    stream.log(
        "shakedown/ticks",
        rr.Points2D(
            [*ticks, *titles],
            labels=[*names, "utilised friction T/N", "p0 / k"],
            radii=[0.01],
            colors=[(190, 194, 200)],
            show_labels=True,
        ),
        static=True,
    )


def body_poses(columns: Mapping[str, FloatArray]) -> Poses:
    """Global poses of a body from its rows of the motion log."""
    position = np.column_stack([columns[name] for name in ("x", "y", "z")])
    return Poses(position, Rotation.from_quat(np.column_stack([columns[f"q{name}"] for name in "xyzw"])))
