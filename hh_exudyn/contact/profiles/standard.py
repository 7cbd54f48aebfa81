"""Coordinates of the profiles that standards define: S1002 wheel, 54E1/54E2/60E1/60E2 rail heads.

Arcs and polynomials are those of the drawings, in millimetres; the functions return metres in side
coordinates (`hh_exudyn.conventions`). `library.wheel_profile` and `library.rail_profile` make the profiles.
"""

import math
from typing import NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray

_STEP_MM = 0.1  # point spacing; the arcs deviate from their chords by R13: 0.1 um

# S1002 (UIC 510-2, EN 13715): sections of the drawing, z up at the flange, y positive to the field side [mm].
_SECTION_B = (
    0.0,
    -3.358537058e-2,
    1.565681624e-3,
    -2.810427944e-5,
    5.844240864e-8,
    -1.562379023e-8,
    5.309217349e-15,
    -5.957839843e-12,
    2.646656573e-13,
)
_SECTION_C = (
    -4320.221063,
    -1038.384026,
    -106.5501873,
    -6.051367875,
    -0.2054332446,
    -4.169739389e-3,
    -4.687195829e-5,
    -2.252755540e-7,
)


def s1002_coordinates() -> tuple[FloatArray, FloatArray]:
    """S1002 wheel tread and flange, from the field side to the flange back.

    Returns
    -------
    y, z : FloatArray
        Side coordinates [m], y increasing from -60 to +70 mm; spacing about 0.1 mm.

    Notes
    -----
    Coefficients as listed by DLR (Netter) for UIC 510-2. The sections join with jumps below 0.12 um.
    """
    field = np.linspace(-62.764705882, 60.0, 1229)
    # The flange back is a quarter circle that ends upright: equal steps of angle, not of y.
    angle = np.linspace(math.asin(13.264705882 / 20.5), math.pi / 2, 200)[1:]
    back = -49.5 - 20.5 * np.sin(angle)
    drawing = np.concatenate([back[::-1], field])
    height = np.array([_s1002_height(y) for y in drawing])
    return -drawing[::-1] * 1e-3, -height[::-1] * 1e-3


def _s1002_height(y: float) -> float:
    """Height of the S1002 drawing at y (field side positive), flange upwards [mm]."""
    if y > 32.15796:
        return 1.364323640 - 0.066666667 * y
    if y >= -26.0:
        return float(np.polynomial.polynomial.polyval(y, _SECTION_B))
    if y >= -35.0:
        return float(np.polynomial.polynomial.polyval(y, _SECTION_C))
    if y >= -38.426669071:
        return 16.446 - math.sqrt(13.0**2 - (y + 26.210665) ** 2)
    if y >= -39.764473993:
        return -93.576667419 - 2.747477419 * y
    if y >= -49.662510381:
        return 8.834924130 + math.sqrt(20.0**2 - (y + 58.558326413) ** 2)
    if y >= -62.764705882:
        return 16.0 + math.sqrt(12.0**2 - (y + 55.0) ** 2)
    return 9.519259302 + math.sqrt(max(20.5**2 - (y + 49.5) ** 2, 0.0))


class RailHead(NamedTuple):
    """Arcs of half a rail head from the crown outwards; the last runs to the 1:20 flank [mm]."""

    radii: tuple[float, ...]  # crown first
    ends: tuple[float, ...]  # lateral position where each arc but the last ends


# EN 13674-1, drawings of the rail heads
_HEADS = {
    "54E1": RailHead((300.0, 80.0, 13.0), (10.012, 24.8635)),
    "54E2": RailHead((300.0, 80.0, 13.0), (9.473, 23.155)),
    "60E1": RailHead((300.0, 80.0, 13.0), (10.228, 26.0265)),
    "60E2": RailHead((200.0, 70.0, 16.0, 8.0), (11.889, 24.4565, 35.387)),
}
RAIL_HEADS = tuple(sorted(_HEADS))

_FLANK = 20.0  # steepness of the flank, 1:20 in all four drawings
_FLANK_LENGTH_MM = 12.0


def rail_head(name: str) -> RailHead:
    """The drawing of a standard rail head, one of `RAIL_HEADS`."""
    return _HEADS[name]


def rail_head_coordinates(name: str) -> tuple[FloatArray, FloatArray]:
    """An upright standard rail head, one of `RAIL_HEADS`: `head_coordinates` of its drawing."""
    return head_coordinates(_HEADS[name])


def head_coordinates(head: RailHead) -> tuple[FloatArray, FloatArray]:
    """An upright rail head with both flanks of 1:20, symmetric, crown at the origin.

    Parameters
    ----------
    head : RailHead
        Its arcs from the crown outwards [mm].

    Returns
    -------
    y, z : FloatArray
        [m], y increasing; spacing about 0.1 mm along the head.
    """
    ys = [np.zeros(1)]
    zs = [np.zeros(1)]
    angle = 0.0  # of the normal to the vertical; arcs join with a common tangent
    for radius, end in zip(head.radii, (*head.ends, math.inf), strict=True):
        y0, z0 = float(ys[-1][-1]), float(zs[-1][-1])
        centre_y = y0 - radius * math.sin(angle)
        centre_z = z0 - radius * math.cos(angle)
        last = math.atan(_FLANK) if math.isinf(end) else math.asin((end - centre_y) / radius)
        steps = max(2, math.ceil((last - angle) * radius / _STEP_MM))
        along = np.linspace(angle, last, steps + 1)[1:]
        ys.append(centre_y + radius * np.sin(along))
        zs.append(centre_z + radius * np.cos(along))
        angle = last
    down = np.linspace(0.0, _FLANK_LENGTH_MM, 25)[1:]
    ys.append(ys[-1][-1] + down / _FLANK)
    zs.append(zs[-1][-1] - down)
    y, z = np.concatenate(ys), np.concatenate(zs)
    return np.concatenate([-y[:0:-1], y]) * 1e-3, np.concatenate([z[:0:-1], z]) * 1e-3
