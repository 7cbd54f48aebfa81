"""The overlap of a wheel and its rail over the arc of the wheel's profile: conformal contact.

Every strip of the wheel, `spacing` wide along the arc of its profile, has its own normal: with the mean g of
the angles of wheel and rail there. Along it the undeformed bodies overlap by d = -gap cos g, gap the vertical
one between silhouette and rail, and ahead of it or behind by h = d - A (x - x0)^2 with A = cos g /
(2 R), R the strip's rolling radius, and x0 where the silhouette lies. Lowering the wheel by delta adds
delta cos g, and nothing else changes: so one overlap serves all heights.

Coordinates: x in rolling direction from below the wheelset's centre, s across along the arc, increasing with
y of the contact frame C (to the left on either wheel).
"""

import math
from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, gap_at, silhouette
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.types import SplineTable
from hh_exudyn.kernel import kernel

(Y_WHEEL, Y_RAIL, OVERLAP, ANGLE, CURVATURE, CREST, POINT_Y, POINT_Z) = range(8)  # columns of a strip
_COLUMNS = 8
_FINE = 4  # steps of the arc's integral to a node of the profile's table


@dataclass(frozen=True)
class ConformalOverlap:
    """Strips of a wheel above its rail.

    `touching` and `field` follow from these numbers alone, without the profiles.

    Attributes
    ----------
    spacing : float
        Width of every strip along the arc [m]; the arrays are (n,).
    y_wheel, y_rail : ndarray
        Places on the profiles, side coordinates [m].
    overlap : ndarray
        Of the undeformed bodies along the strip's normal, at the pair's height [m]; -inf beside the rail.
    angle : ndarray
        Of the normal, the mean of both profiles' slope angles in side coordinates [rad].
    curvature : ndarray
        A, half the curvature along x [1/m].
    crest : ndarray
        x where the overlap is largest [m].
    point_y, point_z : ndarray
        Points of the silhouette from the wheelset's centre, axes of the rail's frame R [m].
    side : float
        +1 left, -1 right.
    """

    spacing: float
    y_wheel: FloatArray
    y_rail: FloatArray
    overlap: FloatArray
    angle: FloatArray
    curvature: FloatArray
    crest: FloatArray
    point_y: FloatArray
    point_z: FloatArray
    side: float

    @property
    def touching(self) -> float:
        """How far the wheel has to be lowered until it touches [m]; negative where it overlaps."""
        return float(np.min(-self.overlap / np.cos(self.angle)))

    def field(self, first: int, count: int, x: FloatArray) -> FloatArray:
        """Overlap of `count` strips from `first` on, at places x (nx,): (count, nx) [m]."""
        strips = slice(first, first + count)
        away = x[None, :] - self.crest[strips, None]
        overlap = self.overlap[strips, None] - self.curvature[strips, None] * away**2
        return np.maximum(np.nan_to_num(overlap, nan=-1.0, neginf=-1.0), -1.0)


@kernel
def _arc(table: SplineTable, steps: int, y: FloatArray, arc: FloatArray) -> None:
    """Arc length of a profile at equal steps of y, from its first node [m]."""
    step, last = table.step / steps, 0.0
    for i in range(y.size):
        y[i] = table.start + i * step
        _, slope, _ = spline_evaluate(table, min(y[i], table.start + (table.z.size - 1) * table.step))
        length = math.sqrt(1.0 + slope * slope)
        arc[i] = 0.0 if i == 0 else arc[i - 1] + 0.5 * step * (length + last)
        last = length


@kernel
def _fill(pair: WheelRailPair, strips: FloatArray) -> None:
    """The columns of every strip from its y on the wheel; beside the rail an overlap of -inf."""
    for i in range(strips.shape[0]):
        y = strips[i, Y_WHEEL]
        z, slope, _ = spline_evaluate(pair.wheel, y)
        x, point_y, point_z, of_wheel = silhouette(pair, y, z, slope)
        gap, _, y_rail, of_rail, _ = gap_at(pair, y)
        angle = 0.5 * (math.atan(of_wheel) + math.atan(of_rail))
        cosine = math.cos(angle)
        found = math.isfinite(gap) and math.isfinite(angle)
        strips[i, Y_RAIL] = y_rail
        strips[i, OVERLAP] = -gap * cosine if found else -math.inf
        strips[i, ANGLE] = angle if found else 0.0
        strips[i, CURVATURE] = 0.5 * cosine / (pair.nominal_radius - z) if found else 1.0
        strips[i, CREST] = x if found else 0.0
        strips[i, POINT_Y], strips[i, POINT_Z] = point_y, point_z


def wheel_arc(wheel: SplineTable) -> tuple[FloatArray, FloatArray]:
    """Places on a wheel's profile, and the arc length to them from its first node [m]."""
    count = (wheel.z.size - 1) * _FINE + 1
    y, arc = np.empty(count), np.empty(count)
    _arc(wheel, _FINE, y, arc)
    return y, arc


def conformal_overlap(
    pair: WheelRailPair, spacing: float, arc: tuple[FloatArray, FloatArray] | None = None
) -> ConformalOverlap:
    """The overlap of a wheel and its rail at the pair's pose, strip by strip over the whole wheel.

    Parameters
    ----------
    pair : WheelRailPair
        Profiles and pose.
    spacing : float
        Width of a strip along the arc [m], > 0.
    arc : tuple of ndarray, optional
        `wheel_arc` of the wheel, where it is kept between calls.
    """
    if not 1e-6 <= spacing <= 5e-3:
        raise ValueError(f"spacing = {spacing} m, allowed 1e-6 .. 5e-3 m")
    y, along = wheel_arc(pair.wheel) if arc is None else arc
    places = np.arange(0.5 * spacing, along[-1], spacing)
    if pair.side > 0.0:  # y of C is to the left, towards the field side of the left wheel
        places = places[::-1]
    strips = np.empty((places.size, _COLUMNS))
    strips[:, Y_WHEEL] = np.interp(places, along, y)
    _fill(pair, strips)
    return ConformalOverlap(
        spacing=spacing,
        y_wheel=strips[:, Y_WHEEL], y_rail=strips[:, Y_RAIL],
        overlap=strips[:, OVERLAP], angle=strips[:, ANGLE],
        curvature=strips[:, CURVATURE], crest=strips[:, CREST],
        point_y=strips[:, POINT_Y], point_z=strips[:, POINT_Z],
        side=pair.side,
    )  # fmt: skip
