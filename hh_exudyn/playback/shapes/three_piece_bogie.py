"""Bolster and side frames of an ore wagon's three-piece bogie, each about its own centre of mass."""

import numpy as np
import trimesh

from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.playback.shapes.dimensions import WagonDimensions
from hh_exudyn.playback.shapes.meshes import (
    Colour,
    bar,
    box,
    coil,
    joined,
    loft,
    plate,
    upright_cylinder,
)
from hh_exudyn.playback.shapes.wheelset import BEARING

CAST: Colour = (136, 122, 108)
BOLSTER: Colour = (150, 132, 112)
SPRING: Colour = (222, 176, 70)

SPRING_LENGTH = 0.22  # of the load coils, unloaded [m]
BOLSTER_END = 0.15  # depth of a bolster's ends over the springs [m]
WEDGE_FACE = 0.15  # height of a wedge's face on its column [m]
COLUMN_FOOT = 0.225  # half the distance of the columns beside the coils [m]


def bolster(size: WagonDimensions) -> trimesh.Trimesh:
    """Bolster: deep box in the middle, tapered ends on the springs, bowl, side bearers, wedges."""
    end, top = size.spring_nest_half_spacing, size.centre_plate_height
    spring_top = _spring_seat(size) + SPRING_LENGTH
    stations = (  # (y, lower, upper, half width)
        (-end - 0.17, spring_top + 0.01, spring_top + BOLSTER_END - 0.02, 0.14),
        (-end + 0.20, spring_top, spring_top + BOLSTER_END, 0.16),
        (-0.42, top - 0.36, top - 0.07, 0.21),
        (-0.26, top - 0.38, top - 0.03, 0.22),
        (0.26, top - 0.38, top - 0.03, 0.22),
        (0.42, top - 0.36, top - 0.07, 0.21),
        (end - 0.20, spring_top, spring_top + BOLSTER_END, 0.16),
        (end + 0.17, spring_top + 0.01, spring_top + BOLSTER_END - 0.02, 0.14),
    )
    rings = np.array(
        [[(-w, y, low), (w, y, low), (w, y, high), (-w, y, high)] for y, low, high, w in stations]
    )
    bowl = upright_cylinder((0.0, 0.0, top - 0.06), size.centre_plate_radius + 0.01, 0.06, 28, CAST)
    parts = [loft(rings, BOLSTER), bowl]
    face, foot = size.wedge_half_spacing, size.wedge_height - 0.5 * WEDGE_FACE
    for side in (LEFT, RIGHT):
        middle = side * size.side_bearer_half_spacing
        parts.append(box((-0.15, middle - 0.07, top - 0.17), (0.15, middle + 0.07, top - 0.04), BEARING))
        for end_x in (1, -1):  # wedge between the bolster's pocket and the side frame's column
            upper = np.array([[face - 0.05, foot + WEDGE_FACE], [face, foot + WEDGE_FACE]]) * (end_x, 1.0)
            lower = np.array([[face - 0.105, foot], [face, foot]]) * (end_x, 1.0)
            y = (side * end - 0.09, side * end + 0.09)
            parts.append(plate(upper, lower, y, SPRING))
    mesh = joined(parts)
    mesh.apply_translation((0.0, 0.0, -size.bolster_height))
    return mesh


def side_frame(size: WagonDimensions, side: int) -> trimesh.Trimesh:
    """Cast side frame: compression and tension member around windows, pedestals, spring seat and coils."""
    half = 0.5 * size.wheelbase
    axle = size.wheel_radius
    thick = (-0.085, 0.085)
    top = np.array(
        [
            [-half - 0.20, axle + 0.15], [-half - 0.13, axle + 0.24], [-half + 0.05, axle + 0.29],
            [-half + 0.25, axle + 0.35], [-0.42, axle + 0.42], [-0.20, axle + 0.45], [0.20, axle + 0.45],
            [0.42, axle + 0.42], [half - 0.25, axle + 0.35], [half - 0.05, axle + 0.29],
            [half + 0.13, axle + 0.24], [half + 0.20, axle + 0.15],
        ]
    )  # fmt: skip
    under = np.array(
        [
            [-half - 0.20, axle + 0.10], [-half - 0.10, axle + 0.12], [-half + 0.10, axle + 0.13],
            [-half + 0.26, axle + 0.22], [-0.42, axle + 0.31], [-0.20, axle + 0.33], [0.20, axle + 0.33],
            [0.42, axle + 0.31], [half - 0.26, axle + 0.22], [half - 0.10, axle + 0.13],
            [half + 0.10, axle + 0.12], [half + 0.20, axle + 0.10],
        ]
    )  # fmt: skip
    seat = _spring_seat(size)
    tension_top = np.array(
        [
            [-half + 0.13, axle + 0.20], [-half + 0.24, axle + 0.10], [-0.36, seat], [0.36, seat],
            [half - 0.24, axle + 0.10], [half - 0.13, axle + 0.20],
        ]
    )  # fmt: skip
    tension_under = np.array(
        [
            [-half + 0.12, axle + 0.02], [-half + 0.18, axle - 0.06], [-0.37, seat - 0.11],
            [0.37, seat - 0.11], [half - 0.18, axle - 0.06], [half - 0.12, axle + 0.02],
        ]
    )  # fmt: skip
    parts = [plate(top, under, thick, CAST), plate(tension_top, tension_under, thick, CAST)]
    parts.append(box((-0.37, -0.19, seat - 0.10), (0.37, 0.19, seat), CAST))  # spring seat
    for end in (1, -1):
        parts.append(_column(size, axle, seat, end))
        parts += _pedestal(end * half, axle, size)
    parts += _springs(size, seat)
    mesh = joined(parts)
    mesh.apply_translation((0.0, 0.0, -size.side_frame_height))
    return mesh if side == LEFT else _mirrored(mesh)


def _pedestal(x: float, axle: float, size: WagonDimensions) -> list[trimesh.Trimesh]:
    """Jaws and adapter over a bearing."""
    inner = -0.12 if x > 0.0 else 0.12  # towards the bogie's middle
    return [
        box((x - 0.13, -0.10, axle + 0.105), (x + 0.13, 0.10, axle + 0.15), BEARING),
        bar((x + inner * 1.25, 0.0, axle + 0.16), (x + inner * 1.25, 0.0, axle - 0.07), 0.075, CAST),
        bar((x - inner * 1.25, 0.0, axle + 0.16), (x - inner * 1.25, 0.0, axle - 0.05), 0.075, CAST),
    ]


def _column(size: WagonDimensions, axle: float, seat: float, end: int) -> trimesh.Trimesh:
    """A column: its face carries a wedge; its foot stands on the spring seat, clear of the coils."""
    face, below = size.wedge_half_spacing, size.wedge_height - 0.5 * WEDGE_FACE
    foot = max(face, COLUMN_FOOT)
    inner = np.array([[face, axle + 0.40], [face, below - 0.02], [foot, below - 0.08], [foot, seat - 0.02]])
    outer = np.array([[0.34, axle + 0.36], [0.35, below], [0.36, below - 0.08], [0.37, seat - 0.02]])
    return plate(outer * (end, 1.0), inner * (end, 1.0), (-0.11, 0.11), CAST)


def _spring_seat(size: WagonDimensions) -> float:
    """Height of the spring seat over the rail tops [m]."""
    return size.spring_nest_height - 0.5 * SPRING_LENGTH


def _springs(size: WagonDimensions, seat: float) -> list[trimesh.Trimesh]:
    """Outer coils of the nest, with cores in place of the inner coils.

    The foremost and rearmost carry the wedges and end below them.
    """
    parts = []
    below_wedge = size.wedge_height - 0.5 * WEDGE_FACE - seat
    for x in (-0.143, 0.0, 0.143):
        length = SPRING_LENGTH if x == 0.0 else min(SPRING_LENGTH, below_wedge)
        for y in (-0.10, 0.10):
            parts.append(coil((x, y, seat), 0.056, 0.0125, length + 0.02, SPRING))
            parts.append(upright_cylinder((x, y, seat), 0.034, length, 10, CAST))
    return parts


def _mirrored(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """The mesh mirrored left to right, with outward normals."""
    return trimesh.Trimesh(
        vertices=mesh.vertices * (1.0, -1.0, 1.0),
        faces=mesh.faces[:, ::-1],
        face_colors=mesh.visual.face_colors,
        process=False,
    )
