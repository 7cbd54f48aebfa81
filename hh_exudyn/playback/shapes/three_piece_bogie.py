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

SPRING_SEAT = 0.235  # height of the spring seat over the rail tops [m]
SPRING_LENGTH = 0.22


def bolster(size: WagonDimensions) -> trimesh.Trimesh:
    """Bolster: deep box in the middle, tapered ends on the springs, bowl, side bearers, wedges."""
    end, top = size.axle_box_half_spacing, size.centre_plate_height
    spring_top = SPRING_SEAT + SPRING_LENGTH
    stations = (  # (y, lower, upper, half width)
        (-end - 0.17, spring_top + 0.01, spring_top + 0.20, 0.17),
        (-end + 0.20, spring_top, spring_top + 0.22, 0.19),
        (-0.42, top - 0.36, top - 0.07, 0.21),
        (-0.26, top - 0.38, top - 0.03, 0.22),
        (0.26, top - 0.38, top - 0.03, 0.22),
        (0.42, top - 0.36, top - 0.07, 0.21),
        (end - 0.20, spring_top, spring_top + 0.22, 0.19),
        (end + 0.17, spring_top + 0.01, spring_top + 0.20, 0.17),
    )
    rings = np.array(
        [[(-w, y, low), (w, y, low), (w, y, high), (-w, y, high)] for y, low, high, w in stations]
    )
    parts = [loft(rings, BOLSTER), upright_cylinder((0.0, 0.0, top - 0.06), 0.20, 0.06, 28, CAST)]
    for side in (LEFT, RIGHT):
        parts.append(
            box((-0.15, side * 0.635 - 0.07, top - 0.17), (0.15, side * 0.635 + 0.07, top - 0.04), BEARING)
        )
        for end_x in (1, -1):  # wedge between the bolster's pocket and the side frame's column
            upper = np.array([[0.155, spring_top + 0.16], [0.205, spring_top + 0.16]]) * (end_x, 1.0)
            lower = np.array([[0.10, spring_top + 0.01], [0.205, spring_top + 0.01]]) * (end_x, 1.0)
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
    seat = SPRING_SEAT
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
        column = np.array([[0.225, axle + 0.40], [0.34, axle + 0.36]]) * (end, 1.0)
        foot = np.array([[0.225, seat - 0.02], [0.37, seat - 0.02]]) * (end, 1.0)
        parts.append(plate(column, foot, (-0.11, 0.11), CAST))
        parts += _pedestal(end * half, axle, size)
    parts += _springs(seat)
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


def _springs(seat: float) -> list[trimesh.Trimesh]:
    """Coils of the nest as they are seen from both sides, with cores that stand for the inner coils."""
    parts = []
    for x in (-0.143, 0.0, 0.143):
        for y in (-0.10, 0.10):
            parts.append(coil((x, y, seat), 0.056, 0.0125, SPRING_LENGTH + 0.02, SPRING))
            parts.append(upright_cylinder((x, y, seat), 0.034, SPRING_LENGTH, 10, CAST))
    return parts


def _mirrored(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """The mesh mirrored left to right, faces turned so that they still look outwards."""
    return trimesh.Trimesh(
        vertices=mesh.vertices * (1.0, -1.0, 1.0),
        faces=mesh.faces[:, ::-1],
        face_colors=mesh.visual.face_colors,
        process=False,
    )
