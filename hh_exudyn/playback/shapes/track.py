"""The track as meshes: rails swept along the alignment, sleepers, ballast, in pieces with an origin each."""

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import trimesh
from scipy.spatial.transform import Rotation

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.check_rail.table import CheckRail
from hh_exudyn.contact.geometry.rail_tables import RailCourse
from hh_exudyn.contact.profile import Profile
from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.playback.frames import Poses, TrackFrames, relative, single, track_frames, upright
from hh_exudyn.playback.shapes.check_rail import outlines, places
from hh_exudyn.playback.shapes.meshes import Colour, box, joined, loft, resampled
from track.course.alignment import Alignment

RAIL: Colour = (122, 92, 76)
RUNNING_BAND: Colour = (206, 210, 214)
CONCRETE: Colour = (168, 165, 158)
FASTENING: Colour = (70, 68, 66)
BALLAST: Colour = (128, 122, 116)
GROUND: Colour = (132, 140, 112)

PIECE = 50.0  # length of one piece of track [m]
SLEEPER_SPACING = 0.6  # [m]
CHANGE_STATIONS = 9  # cross-sections of the drawn change from rail to rail
SAGITTA = 0.5e-3  # largest deviation of a swept rail from the curve [m]
RAIL_HEIGHT = 0.172  # 60E1, EN 13674-1 [m]
FOOT_HALF_WIDTH = 0.075
WEB_HALF_WIDTH = 0.009
GROUND_HALF_WIDTH = 80.0  # less than the smallest radius of an alignment [m]


class Piece(NamedTuple):
    """A piece of track; meshes and sleepers are relative to `origin`, in global axes."""

    origin: FloatArray  # (3,) global, exact in single precision [m]
    rails: trimesh.Trimesh
    bed: trimesh.Trimesh
    sleepers: Poses


def pieces(
    alignment: Alignment,
    rail_left: RailCourse,
    rail_right: RailCourse,
    first: float,
    last: float,
    check: CheckRail | None = None,
) -> Iterator[Piece]:
    """The track between two arc lengths [m], cut to where there is track, piece by piece.

    Parameters
    ----------
    alignment
        The alignment.
    rail_left, rail_right
        Rails of both sides along the track.
    first, last
        Arc lengths [m].
    check
        Check rails; None for a track without.

    Raises
    ------
    ValueError
        `first` is not below `last`, or there is no track between them.
    """
    start, end = max(first, alignment.table.start), min(last, alignment.table.end)
    if not start < end:
        raise ValueError(
            f"no track from s = {first} to {last} m; there is from {alignment.table.start:g} m "
            f"to {alignment.table.end:g} m"
        )
    rails = {LEFT: rail_left, RIGHT: rail_right}
    ends = np.append(np.arange(start, end, PIECE), end)
    for low, high in pairwise(ends):
        yield _piece(alignment, rails, float(low), float(high), check)


def rail_section(head: Profile) -> FloatArray:
    """The closed outline (m, 2) of a rail in side coordinates [m]: its head as given, a plain foot."""
    top = resampled(np.column_stack([head.y, head.z]), 24)
    middle = 0.5 * (head.y[0] + head.y[-1])
    low = min(head.z[0], head.z[-1], -0.03) - 0.012
    half = [
        (0.5 * (head.y[-1] - head.y[0]), low),
        (WEB_HALF_WIDTH, low - 0.016),
        (WEB_HALF_WIDTH, 0.030 - RAIL_HEIGHT),
        (FOOT_HALF_WIDTH, 0.012 - RAIL_HEIGHT),
        (FOOT_HALF_WIDTH, -RAIL_HEIGHT),
    ]
    gauge_side = [(middle + y, z) for y, z in half]
    field_side = [(middle - y, z) for y, z in reversed(half)]
    return np.concatenate([top, gauge_side, field_side])


def sleeper() -> trimesh.Trimesh:
    """A concrete sleeper with its fastenings, in the track frame, below two rails at nominal gauge."""
    top = -RAIL_HEIGHT - 0.008
    stations = ((-1.30, 0.0), (-0.55, 0.0), (-0.35, -0.035), (0.35, -0.035), (0.55, 0.0), (1.30, 0.0))
    rings = np.array(
        [
            [(-0.15, y, top - 0.21), (0.15, y, top - 0.21), (0.11, y, top + z), (-0.11, y, top + z)]
            for y, z in stations
        ]
    )
    parts = [loft(rings, CONCRETE)]
    for rail in (0.753, -0.753):
        for offset in (-0.115, 0.115):
            y = rail + offset
            parts.append(box((-0.06, y - 0.045, top), (0.06, y + 0.045, top + 0.035), FASTENING))
    return joined(parts)


def _piece(
    alignment: Alignment, rails: dict[int, RailCourse], low: float, high: float, check: CheckRail | None
) -> Piece:
    """One piece of track from s = low to high."""
    s = _stations(alignment, rails, low, high)
    frames = track_frames(alignment, s)
    origin = single(frames.origin[len(frames.gauge) // 2])
    swept = [
        _swept(frames, origin, _placed(rails[side], s, side, frames.gauge), RAIL, RUNNING_BAND)
        for side in (LEFT, RIGHT)
    ]
    if check is not None:
        for stretch in check.stretches:
            along = places(check, stretch, s)
            if along.size > 1:
                beside = track_frames(alignment, along)
                swept.append(_swept(beside, origin, outlines(check, stretch, along, beside.gauge), RAIL))
    number = np.arange(math.ceil(low / SLEEPER_SPACING), math.ceil(high / SLEEPER_SPACING))
    seats = SLEEPER_SPACING * number.astype(np.float64)
    under = track_frames(alignment, seats)
    sleepers = relative(
        Poses(under.origin, under.rotation),
        Poses(np.broadcast_to(origin, under.origin.shape), Rotation.identity(len(seats))),
    )
    return Piece(origin, joined(swept), _bed(frames, origin), sleepers)


def _stations(alignment: Alignment, rails: dict[int, RailCourse], low: float, high: float) -> FloatArray:
    """Arc lengths along a piece, close enough for the curve and the changes of its rails."""
    changes = [
        change + rail.change_length * np.linspace(-0.5, 0.5, CHANGE_STATIONS)
        for rail in rails.values()
        for change in rail.changes
    ]
    at_changes = np.concatenate([np.empty(0), *changes])
    at_changes = at_changes[(at_changes > low) & (at_changes < high)]
    count = 5
    while True:
        s = np.linspace(low, high, 2 * count + 1)
        frames = track_frames(alignment, s)
        middle = 0.5 * (frames.origin[0:-2:2] + frames.origin[2::2])
        if np.linalg.norm(middle - frames.origin[1::2], axis=1).max() < SAGITTA or count >= 320:
            return np.union1d(s[::2], at_changes)
        count *= 2


def _placed(rail: RailCourse, s: FloatArray, side: int, gauge: FloatArray) -> FloatArray:
    """(n, m, 3) the rail's outline in n track frames, its gauge point at half the gauge."""
    sections = np.stack([rail_section(profile) for profile in rail.profiles])
    sections[:, :, 0] -= rail.gauge_points()[:, None]
    section = np.einsum("nk,kmi->nmi", rail.weights(s), sections)
    outline = np.zeros((len(s), sections.shape[1], 3))
    outline[:, :, 1] = side * (0.5 * gauge[:, None] - section[:, :, 0])
    outline[:, :, 2] = section[:, :, 1]
    return outline


def _swept(
    frames: TrackFrames, origin: FloatArray, outline: FloatArray, colour: Colour, upper: Colour | None = None
) -> trimesh.Trimesh:
    """Outlines in track frames lofted into one solid; faces that look up above the web in colour `upper`."""
    matrix = frames.rotation.as_matrix()
    near = frames.origin - origin
    mesh = loft(np.einsum("nij,nmj->nmi", matrix, outline) + near[:, None, :], colour)
    if upper is not None:
        count, corners = outline.shape[:2]
        height = np.concatenate([outline[:, :, 2].ravel(), np.full(2, -1.0)])
        on_top = (height[mesh.faces].min(axis=1) > -0.008) & (mesh.faces.max(axis=1) < count * corners)
        colours = np.array(mesh.visual.face_colors)
        colours[on_top, :3] = upper
        mesh.visual.face_colors = colours
    return mesh


def _bed(frames: TrackFrames, origin: FloatArray) -> trimesh.Trimesh:
    """Ballast with the cant of the track, and a level strip of ground."""
    top, foot = -RAIL_HEIGHT - 0.055, -0.75
    ballast = np.array(
        [[1.75, top], [0.6, top], [-0.6, top], [-1.75, top], [-2.9, foot], [-2.9, foot - 0.4],
         [2.9, foot - 0.4], [2.9, foot]]
    )  # fmt: skip
    ground = np.array(
        [
            [side * GROUND_HALF_WIDTH, z]
            for side, z in ((1, foot), (-1, foot), (-1, foot - 0.3), (1, foot - 0.3))
        ]
    )
    level = frames._replace(rotation=upright(frames.rotation))
    parts = []
    for section, colour, stations in ((ballast, BALLAST, frames), (ground, GROUND, level)):
        outline = np.zeros((len(frames.gauge), len(section), 3))
        outline[:, :, 1:] = section
        parts.append(_swept(stations, origin, outline, colour))
    return joined(parts)
