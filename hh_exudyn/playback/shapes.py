"""Shapes of an ore wagon's bodies, each about its own centre of mass, for the playback.

They are drawn from the lengths of `WagonDimensions` to look like what they stand for; no dynamics reads
them. `wagon_shapes` is the way in.
"""

import numpy as np
import trimesh

from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.playback.dimensions import WagonDimensions
from hh_exudyn.playback.hopper import hopper, ore_heap
from hh_exudyn.playback.meshes import (
    Colour,
    FloatArray,
    bar,
    box,
    coil,
    joined,
    loft,
    plate,
    resampled,
    turned,
    turned_ring,
    upright_cylinder,
)

CAST: Colour = (136, 122, 108)
BOLSTER: Colour = (150, 132, 112)
SPRING: Colour = (222, 176, 70)
AXLE: Colour = (120, 116, 112)
WHEEL: Colour = (140, 122, 108)
TREAD: Colour = (196, 200, 205)
MARK: Colour = (240, 236, 220)
BEARING: Colour = (78, 92, 128)

RIM_THICKNESS = 0.062  # of the wheel below the tread [m]
HUB_RADIUS = 0.135
AXLE_RADIUS = 0.095
SPRING_SEAT = 0.235  # height of the spring seat over the rail tops [m]
SPRING_LENGTH = 0.22


def wagon_shapes(size: WagonDimensions, tread: FloatArray, units: int = 1) -> dict[str, trimesh.Trimesh]:
    """Shapes by entity below the vehicle: the names of the motion log's bodies, and ``car_body/ore``.

    One wagon has a ``car_body``, wagons of several units ``car_body_1`` and so on; bogies and wheelsets are
    numbered through.

    Parameters
    ----------
    size
        Lengths of the wagon; without ore depth there is no heap.
    tread
        (n, 2) wheel profile (y, z) in side coordinates, from the field side to the flange back [m].
    units
        Number of car bodies, each with two bogies.
    """
    body = {"": hopper(size)}
    if size.ore_depth > 0.0:
        body["/ore"] = ore_heap(size)
    for shape in body.values():
        shape.apply_translation((0.0, 0.0, -size.car_body_height))
    names = ["car_body"] if units == 1 else [f"car_body_{unit}" for unit in range(1, units + 1)]
    shapes = {f"{name}{part}": shape for name in names for part, shape in body.items()}
    cross_member, axle = bolster(size), wheelset(size, tread)
    frames = {"L": side_frame(size, LEFT), "R": side_frame(size, RIGHT)}
    for bogie in range(1, 2 * units + 1):
        shapes[f"bolster_{bogie}"] = cross_member
        shapes |= {f"side_frame_{bogie}{letter}": frame for letter, frame in frames.items()}
    return shapes | {f"wheelset_{number}": axle for number in range(1, 4 * units + 1)}


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


def wheelset(size: WagonDimensions, tread: FloatArray) -> trimesh.Trimesh:
    """Axle, two wheels turned from the profile, bearings; white marks show that it turns."""
    middle, journal = size.running_circle_distance, size.axle_box_half_spacing
    r = AXLE_RADIUS
    axle = turned(
        np.array(
            [
                [-journal - 0.12, 0.066], [-middle - 0.10, 0.070], [-middle - 0.095, r], [-middle + 0.12, r],
                [-middle + 0.16, r - 0.012], [0.0, r - 0.016], [middle - 0.16, r - 0.012], [middle - 0.12, r],
                [middle + 0.095, r], [middle + 0.10, 0.070], [journal + 0.12, 0.066],
            ]
        ),
        24,
        AXLE,
    )  # fmt: skip
    parts = [axle]
    for side in (LEFT, RIGHT):
        parts.append(_wheel(size, tread, side))
        bearing = np.array([[journal - 0.10, 0.105], [journal + 0.09, 0.105], [journal + 0.13, 0.085]])
        parts.append(turned(bearing * (side, 1.0), 24, BEARING))
        for angle in (0.0, 2.0 * np.pi / 3.0, 4.0 * np.pi / 3.0):  # cap screws, which turn with the axle
            x, z = 0.045 * np.cos(angle), 0.045 * np.sin(angle)
            y = sorted((side * (journal + 0.12), side * (journal + 0.155)))
            parts.append(box((x - 0.016, y[0], z - 0.016), (x + 0.016, y[1], z + 0.016), MARK))
    return joined(parts)


def _wheel(size: WagonDimensions, tread: FloatArray, side: int) -> trimesh.Trimesh:
    """One wheel: tread and flange of the profile, rim, dished web, hub; colours by part and angle."""
    radius = size.wheel_radius
    coarse = resampled(tread, 30)
    rim = radius - RIM_THICKNESS
    field, back = coarse[0, 0], coarse[-1, 0]
    outline = np.concatenate(
        [
            np.column_stack([coarse[:, 0], radius - coarse[:, 1]]),
            [
                [back, rim + 0.005], [back - 0.03, rim - 0.012], [0.020, rim - 0.035], [0.034, 0.27],
                [0.042, HUB_RADIUS + 0.03], [0.085, HUB_RADIUS], [0.085, AXLE_RADIUS],
                [-0.085, AXLE_RADIUS], [-0.085, HUB_RADIUS], [0.014, HUB_RADIUS + 0.03], [0.006, 0.27],
                [-0.010, rim - 0.035], [field + 0.03, rim - 0.012], [field, rim + 0.005],
            ],
        ]
    )  # fmt: skip
    outline[:, 0] = side * (size.running_circle_distance - outline[:, 0])  # side coordinates run inwards
    wheel = turned_ring(outline, 60, WHEEL)
    centre = wheel.triangles_center
    distance = np.hypot(centre[:, 0], centre[:, 2])
    turn = np.mod(np.degrees(np.arctan2(centre[:, 2], centre[:, 0])), 120.0)
    colours = np.array(wheel.visual.face_colors)
    on_profile = (distance > radius - 0.012) & (np.abs(wheel.face_normals[:, 1]) < 0.98)
    colours[on_profile, :3] = TREAD
    marked = (turn < 12.0) & (distance < radius - 0.02) & (distance > HUB_RADIUS + 0.035)
    colours[marked, :3] = MARK
    wheel.visual.face_colors = colours
    return wheel


def _mirrored(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """The mesh mirrored left to right, faces turned so that they still look outwards."""
    return trimesh.Trimesh(
        vertices=mesh.vertices * (1.0, -1.0, 1.0),
        faces=mesh.faces[:, ::-1],
        face_colors=mesh.visual.face_colors,
        process=False,
    )
