"""Overlap of a flange back with the face of its check rail, slice by slice along the rail (kernels).

Equation 1 of this folder's map, least gap over the height of every slice.
"""

import math
from typing import NamedTuple

from hh_exudyn.contact.check_rail.table import BACK_RADIUS, CROWN_RADIUS, SLICES, CheckRailTable
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Memory, Triple
from hh_exudyn.kernel import inlined_kernel, kernel, shaped

_DEEPEST = 0.06  # m below the upper end of the face: under every flange tip
_STEEPEST = 0.95  # sine of the angle at which arcs go on as straight lines
_ROUNDS, _TOLERANCE = 60, 1e-11  # of a search that takes five; its last step [m]
_BASE = 2e-3  # m, half the height over which a slice's curvature is taken: about that of a contact
_APPROACH = 0.05e-3  # m, of a loaded contact: fixes the slices' lengths, which enter by their logarithm
_LENGTH = 0.6  # A a^2 / d, as in `strips.loads`


class Back(NamedTuple):
    """A flange back beside its check rail, axes of the rail's frame R [m]."""

    side: float  # +1 left, -1 right
    centre_y: float  # wheelset's centre from the origin of the rail profile
    centre_z: float
    axle_x: float  # unit vector of the wheelset's +y axis
    axle_y: float
    axle_z: float
    half_distance: float  # of the flange backs
    edge: float  # radius of the wheel where the plane of its back ends
    upper: float  # z of the upper end of the face
    corner: float  # radius of the arc above it


@kernel
def flangeway_at(check: CheckRailTable, side: float, s: float) -> tuple[float, float]:
    """Flangeway at arc length s [m] and its slope [-]; infinite where there is no check rail.

    Parameters
    ----------
    check : CheckRailTable
        The check rails.
    side : float
        +1 left, -1 right.
    s : float
        Arc length [m].
    """
    width, slope = math.inf, 0.0
    for k in range(check.stretches.shape[0]):
        if check.stretches[k, 0] != side:
            continue
        start, end = check.stretches[k, 1], check.stretches[k, 2]
        beyond = max(start - s, s - end, 0.0)
        if beyond < check.flare_length:
            t = beyond / check.flare_length
            here = check.flangeway + check.flare_opening * t * t
            if here < width:
                width = here
                slope = 2.0 * check.flare_opening * t / check.flare_length
                if s < start:
                    slope = -slope
    return width, slope


@inlined_kernel
def _arc(distance: float, radius: float) -> Triple:
    """Recess of an arc beyond the end of its tangent [m], its slope [-] and the rate of that [1/m].

    Beyond `_STEEPEST` a straight line.
    """
    if distance <= 0.0:
        return 0.0, 0.0, 0.0
    near = min(distance, _STEEPEST * radius)
    root = math.sqrt(radius * radius - near * near)
    slope = near / root
    bend = radius * radius / (root * root * root) if near == distance else 0.0
    return radius - root + slope * (distance - near), slope, bend


@inlined_kernel
def face_at(back: Back, z: float) -> Triple:
    """How far the face stands back at the height z of R [m], its slope over z [-] and the rate of that."""
    rise = z - back.upper
    if rise > 0.0:
        return _arc(rise, back.corner)
    return 0.5 * rise * rise / CROWN_RADIUS, rise / CROWN_RADIUS, 1.0 / CROWN_RADIUS


@inlined_kernel
def gap_at(back: Back, x: float, face: float, z: float) -> Triple:
    """Gap between wheel and check rail along the axle [m], its derivatives over the height [-], [1/m].

    The second one to the first order of the slopes: it steers a search.

    Parameters
    ----------
    back : Back
        The flange back beside its check rail.
    x : float
        Ahead of the wheelset's centre [m].
    face : float
        Lateral place of the face there, side coordinates of the running rail [m].
    z : float
        Height in R [m].
    """
    recess, slope, bend = face_at(back, z)
    y = -back.side * (face + recess) - back.centre_y
    dz = z - back.centre_z
    axial = back.side * (x * back.axle_x + y * back.axle_y + dz * back.axle_z)
    axial_rate = back.side * back.axle_z - slope * back.axle_y
    radius = math.sqrt(x * x + y * y + dz * dz - axial * axial)
    radius_rate = (dz - back.side * slope * y - axial * axial_rate) / radius
    hollow, steepness, turn = _arc(radius - back.edge, BACK_RADIUS)
    bend += turn * radius_rate * radius_rate + steepness * (1.0 - radius_rate * radius_rate) / radius
    return back.half_distance + hollow - axial, steepness * radius_rate - axial_rate, bend


@kernel
def _lowest(back: Back, x: float, face: float, start: float) -> float:
    """Height of the least gap of a slice [m], about `start`: its slope increases with z.

    Newton's method within bounds, which are halved where it would leave them.
    """
    low, high = back.upper - _DEEPEST, back.upper + _STEEPEST * back.corner
    z = min(max(start, low), high)
    for _ in range(_ROUNDS):
        _, rate, bend = gap_at(back, x, face, z)
        if rate < 0.0:
            low = z
        else:
            high = z
        step = -rate / max(bend, 0.5 / CROWN_RADIUS)
        if not low < z + step < high:
            step = 0.5 * (low + high) - z
        z += step
        if abs(step) < _TOLERANCE:
            break
    return z


@kernel
def overlapping_slices(
    check: CheckRailTable, back: Back, s: float, gauge_point: float, bend: float, state: Memory
) -> int:
    """Find the slices of the check rail that lie inside the flange back, and their geometry.

    Parameters
    ----------
    check : CheckRailTable
        The check rails.
    back : Back
        The flange back.
    s : float
        Arc length of the wheelset [m].
    gauge_point : float
        y of the running rail's gauge point, side coordinates [m].
    bend : float
        Rotation of R about z per metre along the track [rad/m].
    state : memory
        Of `strips`: written are `NUMBER` to `WIDTH`, `CURVATURE`, `HALF_LENGTH` and `HEADING`, with the
        slice's place along the rail as `ARC` and its height as `Y_RAIL`.

    Returns
    -------
    int
        Number of slices found.
    """
    rows = shaped(state, (ROWS, CAPACITY))
    width = check.slice_width
    lowest = -back.side * back.axle_z * (back.centre_z - back.upper)
    lean = abs(back.axle_z) * _DEEPEST
    z = back.upper
    count = 0
    for k in range(SLICES):
        x = (k + 0.5 - 0.5 * SLICES) * width
        flangeway, slope = flangeway_at(check, back.side, s + x)
        if flangeway == math.inf:
            continue
        face = gauge_point + flangeway - 0.5 * back.side * bend * x * x
        across = back.side * (x * back.axle_x + (-back.side * face - back.centre_y) * back.axle_y)
        if back.half_distance - across - lowest - lean > 0.0:  # less than its least gap
            continue
        z = _lowest(back, x, face, z)
        gap = gap_at(back, x, face, z)[0]
        if not gap < 0.0:
            continue
        beside = gap_at(back, x, face, z + _BASE)[0] + gap_at(back, x, face, z - _BASE)[0]
        curvature = 0.5 * (beside - 2.0 * gap) / (_BASE * _BASE)
        recess, steepness, _ = face_at(back, z)
        cosine = 1.0 / math.sqrt(1.0 + steepness * steepness)
        rows[Row.NUMBER, count] = k
        rows[Row.OVERLAP, count] = -gap * cosine
        rows[Row.COSINE, count], rows[Row.SINE, count] = cosine, steepness * cosine
        rows[Row.X, count] = x
        rows[Row.Y, count] = -back.side * (face + recess) - back.centre_y
        rows[Row.Z, count] = z - back.centre_z
        rows[Row.Y_RAIL, count] = z
        rows[Row.ARC, count], rows[Row.WIDTH, count] = x, width
        rows[Row.CURVATURE, count] = curvature
        rows[Row.HALF_LENGTH, count] = max(math.sqrt(_LENGTH * _APPROACH / curvature), 0.5 * width)
        rows[Row.HEADING, count] = bend * x - back.side * slope
        count += 1
    return count
