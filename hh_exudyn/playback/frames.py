"""Poses relative to frames that are exact in single precision.

Rerun keeps positions in single precision, which is 1 mm wide at 10 km. So every position is sent relative
to a near frame, and the pose of that frame is ROUNDED to single precision first: the relative pose includes
the rounding error, and both together give the position of the log to better than 1 um.
"""

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from hh_exudyn.arrays import FloatArray
from track.course.alignment import Alignment, inclined_frame, inclined_rotation


class TrackFrames(NamedTuple):
    """Track frames T at n arc lengths."""

    origin: FloatArray  # (n, 3) global [m]
    rotation: Rotation  # n rotations, T to global
    gauge: FloatArray  # (n,) [m]


class Poses(NamedTuple):
    """n poses of bodies or frames."""

    position: FloatArray  # (n, 3) [m]
    rotation: Rotation  # n rotations, body to parent frame


def track_frames(alignment: Alignment, s: FloatArray) -> TrackFrames:
    """The track frames at arc lengths s (n,) [m].

    Parameters
    ----------
    alignment
        The alignment.
    s
        (n,) arc lengths [m].

    Raises
    ------
    ValueError
        An arc length is NaN or off the track, lead-in and run-out included.
    """
    arc, inverse = np.unique(s, return_inverse=True)
    origin, matrix, gauge = np.empty((len(arc), 3)), np.empty((len(arc), 3, 3)), np.empty(len(arc))
    table = alignment.table
    for i, value in enumerate(arc):
        x, y, z, heading, pitch, roll, _, gauge[i] = inclined_frame(table, value)
        origin[i] = (x, y, z)
        inclined_rotation(heading, pitch, roll, matrix[i])
    off = np.isnan(gauge)
    if off.any():
        raise ValueError(
            f"s = {arc[off][0]} m is off the track, which lies from {table.start:g} to {table.end:g} m"
        )
    return TrackFrames(origin[inverse], Rotation.from_matrix(matrix[inverse]), gauge[inverse])


def single(position: FloatArray) -> FloatArray:
    """Positions rounded to single precision, as float64."""
    return position.astype(np.float32).astype(np.float64)


def moving_frame(alignment: Alignment, s: FloatArray) -> Poses:
    """The frame that follows a vehicle at arc lengths s (n,) [m]: on the centre line, x ahead, z upright.

    It turns with the track's heading alone, so that cant and gradient are visible in the picture. Its poses
    are exact in single precision. Errors as `track_frames`.

    Parameters
    ----------
    alignment
        The alignment.
    s
        (n,) arc lengths of the vehicle [m].
    """
    frames = track_frames(alignment, s)
    turn = upright(frames.rotation)
    return Poses(single(frames.origin), Rotation.from_quat(single(turn.as_quat())))


def upright(turn: Rotation) -> Rotation:
    """Rotations about the vertical with the same direction of the x axis in plan."""
    ahead = turn.apply((1.0, 0.0, 0.0))
    heading = np.arctan2(ahead[:, 1], ahead[:, 0])
    return Rotation.from_rotvec(np.outer(heading, (0.0, 0.0, 1.0)))


def relative(poses: Poses, frame: Poses) -> Poses:
    """Global poses relative to frames, row by row.

    Parameters
    ----------
    poses
        N global poses.
    frame
        N global poses of the frames.
    """
    turn = frame.rotation.inv()
    return Poses(turn.apply(poses.position - frame.position), turn * poses.rotation)
