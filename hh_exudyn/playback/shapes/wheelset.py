"""A wheelset: axle, two wheels turned from the profile, bearings."""

import numpy as np
import trimesh

from hh_exudyn.arrays import FloatArray
from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.playback.shapes.meshes import Colour, box, joined, resampled, turned, turned_ring
from vehicles.outline import RUNNING_CIRCLE, WHEEL_WIDTH

AXLE: Colour = (120, 116, 112)
WHEEL: Colour = (140, 122, 108)
TREAD: Colour = (196, 200, 205)
MARK: Colour = (240, 236, 220)
BEARING: Colour = (78, 92, 128)

USUAL_RADIUS = 0.4575  # of the wheel with the lengths below, which are proportional to the radius [m]
RIM_THICKNESS = 0.062  # of the wheel below the tread [m]
WEB_RADIUS = 0.27
HUB_RADIUS = 0.135
AXLE_RADIUS = 0.095


def wheelset_shape(
    radius: float,
    journal: float,
    treads: tuple[FloatArray, FloatArray],
    middle: float = RUNNING_CIRCLE,
) -> trimesh.Trimesh:
    """A wheelset about its centre; white marks show that it turns.

    Parameters
    ----------
    radius
        Of the wheels at the running circle [m].
    journal
        Half the distance of the bearings [m]; they are drawn where they are outside of the wheels.
    treads
        (n, 2) profiles (y, z) of the left and the right wheel in side coordinates, from the field side to the
        flange back [m].
    middle
        Half the distance of the running circles [m].
    """
    r = AXLE_RADIUS * min(1.0, radius / USUAL_RADIUS)
    bearings = journal > middle + WHEEL_WIDTH
    end = (journal if bearings else middle) + 0.12
    thin, seat, shaft = 0.7 * r, r - 0.012, r - 0.016
    axle = turned(
        np.array(
            [
                [-end, thin - 0.004], [-middle - 0.10, thin], [-middle - 0.095, r], [-middle + 0.12, r],
                [-middle + 0.16, seat], [0.0, shaft], [middle - 0.16, seat], [middle - 0.12, r],
                [middle + 0.095, r], [middle + 0.10, thin], [end, thin - 0.004],
            ]
        ),
        24,
        AXLE,
    )  # fmt: skip
    parts = [axle]
    for side, tread in zip((LEFT, RIGHT), treads, strict=True):
        parts.append(_wheel(radius, middle, tread, side))
        if bearings:
            bearing = np.array([[journal - 0.10, 0.105], [journal + 0.09, 0.105], [journal + 0.13, 0.085]])
            parts.append(turned(bearing * (side, 1.0), 24, BEARING))
        for angle in (0.0, 2.0 * np.pi / 3.0, 4.0 * np.pi / 3.0):  # cap screws, which turn with the axle
            x, z = 0.45 * r * np.cos(angle), 0.45 * r * np.sin(angle)
            y = sorted((side * end, side * (end + 0.035)))
            parts.append(box((x - 0.016, y[0], z - 0.016), (x + 0.016, y[1], z + 0.016), MARK))
    return joined(parts)


def _wheel(radius: float, middle: float, tread: FloatArray, side: int) -> trimesh.Trimesh:
    """One wheel: tread and flange of the profile, rim, dished web, hub; colours by part and angle."""
    coarse = resampled(tread, 30)
    scale = radius / USUAL_RADIUS
    rim, web, hub = radius - RIM_THICKNESS * scale, WEB_RADIUS * scale, HUB_RADIUS * scale
    bore = AXLE_RADIUS * min(1.0, scale)
    field, back = coarse[0, 0], coarse[-1, 0]
    outline = np.concatenate(
        [
            np.column_stack([coarse[:, 0], radius - coarse[:, 1]]),
            [
                [back, rim + 0.005], [back - 0.03, rim - 0.012], [0.020, rim - 0.035], [0.034, web],
                [0.042, hub + 0.03], [0.085, hub], [0.085, bore],
                [-0.085, bore], [-0.085, hub], [0.014, hub + 0.03], [0.006, web],
                [-0.010, rim - 0.035], [field + 0.03, rim - 0.012], [field, rim + 0.005],
            ],
        ]
    )  # fmt: skip
    outline[:, 0] = side * (middle - outline[:, 0])  # side coordinates run inwards
    wheel = turned_ring(outline, 60, WHEEL)
    centre = wheel.triangles_center
    distance = np.hypot(centre[:, 0], centre[:, 2])
    turn = np.mod(np.degrees(np.arctan2(centre[:, 2], centre[:, 0])), 120.0)
    colours = np.array(wheel.visual.face_colors)
    on_profile = (distance > radius - 0.012) & (np.abs(wheel.face_normals[:, 1]) < 0.98)
    colours[on_profile, :3] = TREAD
    marked = (turn < 12.0) & (distance < radius - 0.02) & (distance > hub + 0.035)
    colours[marked, :3] = MARK
    wheel.visual.face_colors = colours
    return wheel
