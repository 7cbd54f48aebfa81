"""Bodies of any vehicle, by their boxes and couplings.

Built in the drawing frame (x forward from the vehicle's middle, y left, z up from the rail tops).
"""

from itertools import pairwise

import numpy as np
import trimesh

from hh_exudyn.arrays import FloatArray
from hh_exudyn.playback.shapes.meshes import Colour, bar, box, coil, joined, loft, turned
from vehicles.description import Body, Vehicle
from vehicles.outline import FLOOR_GAP, body_box, coupling_ends

COLOURS: dict[str, Colour] = {
    "car_body": (122, 134, 150),
    "bogie_frame": (92, 104, 96),
    "bolster": (150, 132, 112),
    "side_frame": (136, 122, 108),
    "motor": (70, 84, 110),
    "wheelset": (140, 122, 108),
}
POWERED: Colour = (158, 62, 50)  # car body of a vehicle with drives
ROOF: Colour = (150, 155, 160)
SILL: Colour = (58, 61, 66)
GLASS: Colour = (38, 48, 60)
SPRING: Colour = (222, 176, 70)
COUPLER: Colour = (104, 88, 76)

BEAM = 0.20  # width of a frame's beams [m]
BEAM_DEPTH = 0.14  # half their height
SMALLEST_FRAME = 0.8  # least length and width of a frame with an opening [m]
CAB_RAKE = 0.55  # of a locomotive's front, from foot to roof [m]
SILL_DEPTH = 0.14  # below the walls of a car body [m]
BOX_TOP = 0.17  # of an axle box over its axle [m]
INNERMOST = 0.4  # least lateral distance from the middle of couplings drawn as springs [m]
KNEE = 0.42  # share of the height from which a front leans back
SMALLEST_HEIGHT = 1.2  # of a body with roof and windows [m]


def plain_box(vehicle: Vehicle, body: Body) -> trimesh.Trimesh:
    """The box of a body."""
    low, high = body_box(vehicle, body)
    return box(low.tolist(), high.tolist(), COLOURS[body.kind])


def car_body(vehicle: Vehicle, body: Body) -> trimesh.Trimesh:
    """Sill, walls and a vaulted roof in the body's box above the wheels, with its coupler heads.

    A vehicle with drives has raked fronts with windows. A body lower than `SMALLEST_HEIGHT` is a box.
    """
    low, high = body_box(vehicle, body)
    foot = _foot(vehicle, low)
    if high[2] - foot < SMALLEST_HEIGHT:
        return joined([plain_box(vehicle, body), *_couplers(vehicle, body, low, high)])
    rake = CAB_RAKE if vehicle.drives else 0.06
    paint = POWERED if vehicle.drives else COLOURS["car_body"]
    half = (high[1] - low[1]) / 2
    outline = np.array(  # (y, z) of a cross-section, as shares of half the width and of the height
        [
            [-1.0, 0.0], [1.0, 0.0], [1.0, KNEE], [1.0, 0.80], [0.93, 0.91], [0.70, 0.975], [0.30, 1.0],
            [-0.30, 1.0], [-0.70, 0.975], [-0.93, 0.91], [-1.0, 0.80], [-1.0, KNEE],
        ]
    )  # fmt: skip
    middle = (low[1] + high[1]) / 2
    height = high[2] - foot
    section = np.column_stack([middle + half * outline[:, 0], foot + height * outline[:, 1]])
    back = (
        rake * np.maximum(0.0, outline[:, 1] - KNEE) / (1.0 - KNEE)
    )  # the front leans back above its window sill
    rings = [
        np.column_stack([low[0] + back, section]),
        np.column_stack([np.full(len(back), low[0] + 1.2 * CAB_RAKE), section]),
        np.column_stack([np.full(len(back), high[0] - 1.2 * CAB_RAKE), section]),
        np.column_stack([high[0] - back, section]),
    ]
    shell = loft(np.array(rings), paint)
    colours = np.array(shell.visual.face_colors)
    colours[shell.face_normals[:, 2] > 0.35, :3] = ROOF
    shell.visual.face_colors = colours
    sill = box(
        (low[0] + 0.15, middle - 0.97 * half, foot - SILL_DEPTH),
        (high[0] - 0.15, middle + 0.97 * half, foot),
        SILL,
    )
    parts = [shell, sill, *_couplers(vehicle, body, low, high)]
    if vehicle.drives:
        for end, way in ((high[0], 1), (low[0], -1)):
            parts.append(_front_window(end, way, middle, half, foot, height, rake))
            parts += [_cab_window(end, way, middle + side * half, side, foot, height) for side in (1, -1)]
    return joined(parts)


def _front_window(
    end: float, way: int, middle: float, half: float, foot: float, height: float, rake: float
) -> trimesh.Trimesh:
    """A pane on a raked front."""
    rings = []
    for share, width in ((0.50, 0.86), (0.76, 0.80)):
        x = end - way * rake * (share - KNEE) / (1.0 - KNEE)
        z = foot + height * share
        rings.append(
            [
                (x + way * dx, middle + dy * width * half, z)
                for dx, dy in ((0.02, -1), (0.02, 1), (-0.02, 1), (-0.02, -1))
            ]
        )
    return loft(np.array(rings), GLASS)


def _cab_window(end: float, way: int, wall: float, side: int, foot: float, height: float) -> trimesh.Trimesh:
    """A pane in a side wall."""
    x = sorted((end - way * 0.75, end - way * 1.6))
    y = sorted((wall - side * 0.02, wall + side * 0.012))
    return box((x[0], y[0], foot + 0.50 * height), (x[1], y[1], foot + 0.74 * height), GLASS)


def _couplers(vehicle: Vehicle, body: Body, low: FloatArray, high: FloatArray) -> list[trimesh.Trimesh]:
    """The coupler heads before a body, with their shanks."""
    parts = []
    for name, point in zip(vehicle.coupler.bodies, vehicle.coupler.points, strict=True):
        if name != body.name or low[0] - 0.05 <= point[0] <= high[0] + 0.05:
            continue
        x, y, z = point
        end, way = (high[0], 1) if x > high[0] else (low[0], -1)
        if z < low[2]:
            parts.append(box((end - 0.3, y - 0.25, z - 0.2), (end + 0.3, y + 0.25, low[2]), SILL))
        parts.append(bar((end, y, z), (x - way * 0.25, y, z), 0.16, COUPLER))
        ends = sorted((x - way * 0.27, x))
        parts.append(box((ends[0], y - 0.19, z - 0.15), (ends[1], y + 0.19, z + 0.15), COUPLER))
    return parts


def bogie_frame(vehicle: Vehicle, body: Body) -> trimesh.Trimesh:
    """Two side beams and cross beams at the height of the centre of mass, with springs at the couplings.

    The beams lie over the axle boxes. A frame below `SMALLEST_FRAME` is a box.
    """
    low, high = body_box(vehicle, body)
    length, width = high[0] - low[0], high[1] - low[1]
    if min(length, width) < SMALLEST_FRAME:
        return plain_box(vehicle, body)
    axles = {wheelset.body for wheelset in vehicle.wheelsets}
    own = [coupling for coupling in vehicle.couplings if body.name in (coupling.body_a, coupling.body_b)]
    boxes = [coupling_ends(coupling)[-1] for coupling in own if coupling.body_b in axles]
    z = max([body.position[2], *(point[2] + BOX_TOP + 0.1 + BEAM_DEPTH for point in boxes)])
    paint = COLOURS["bogie_frame"]
    parts = []
    for y in (low[1], high[1]):
        foot = (low[0] - 0.25, y - BEAM / 2, z - BEAM_DEPTH)
        parts.append(box(foot, (high[0] + 0.25, y + BEAM / 2, z + BEAM_DEPTH), paint))
    places = sorted({point[0] for point in boxes})
    for x in [(behind + ahead) / 2 for behind, ahead in pairwise(places)] or [body.position[0]]:
        parts.append(box((x - 0.13, low[1], z - 0.1), (x + 0.13, high[1], z + 0.1), paint))
    for x, y, height in boxes:
        if abs(y) > INNERMOST:
            seat = height + BOX_TOP
            parts.append(box((x - 0.16, y - 0.11, seat - 0.07), (x + 0.16, y + 0.11, seat), SILL))
            rise = z - BEAM_DEPTH - seat
            parts += [coil((x + way, y, seat), 0.05, 0.012, rise, SPRING) for way in (-0.09, 0.09)]
    parts += _secondary_springs(vehicle, body, z + BEAM_DEPTH)
    return joined(parts)


def _secondary_springs(vehicle: Vehicle, frame: Body, seat: float) -> list[trimesh.Trimesh]:
    """Coils between a frame and the car body over it, at the places of their couplings."""
    above = {body.name: body for body in vehicle.bodies if body.kind == "car_body"}
    parts = []
    places = set()
    for coupling in vehicle.couplings:
        others = {coupling.body_a, coupling.body_b} - {frame.name}
        if len(others) == 1 and others <= set(above) and len(ends := coupling_ends(coupling)) == 1:
            places.add((ends[0][0], ends[0][1], others.pop()))
    for x, y, name in sorted(places):
        top = _foot(vehicle, body_box(vehicle, above[name])[0]) - SILL_DEPTH
        if abs(y) > INNERMOST and top - seat > 0.08:
            parts.append(coil((x, y, seat), 0.12, 0.022, top - seat, SPRING))
    return parts


def _foot(vehicle: Vehicle, low: FloatArray) -> float:
    """Lowest height of a car body, clear of the wheels [m]."""
    wheels = max((wheelset.radius for wheelset in vehicle.wheelsets), default=0.0)
    return max(float(low[2]), 2 * wheels + FLOOR_GAP)


def motor(vehicle: Vehicle, body: Body) -> trimesh.Trimesh:
    """A drum across the track, of the box's size."""
    low, high = body_box(vehicle, body)
    centre, half = (low + high) / 2, (high - low) / 2
    radius = (half[0] + half[2]) / 2
    stations = np.array(
        [
            [-half[1], 0.6 * radius], [-0.85 * half[1], 0.92 * radius], [-0.8 * half[1], radius],
            [0.8 * half[1], radius], [0.85 * half[1], 0.92 * radius], [half[1], 0.6 * radius],
        ]
    )  # fmt: skip
    mesh = turned(stations, 24, COLOURS["motor"])
    mesh.apply_translation(centre)
    return mesh
