"""The strips behind a row of the contact log, rebuilt from the pose of the wheel on its rail (kernel).

A row holds the pose (`centre_y`, `centre_z`, `roll`, `angle_of_attack`): overlaps, loads and shapes follow by
the kernels of the run, pressures and half lengths by the second solution (`pressure`). That is two numbers a
row, where a second table of the strips would be three times the log. Loads and half lengths are scaled to the
row's normal force, which holds contact damping.

The rigid slip of every strip follows from the row's mean creepages, for the wheel is a rigid body: it turns
about its axle with (1 - nu_x)/r per metre, r its mean rolling radius, and about the vertical with what its
spin creepage has beyond that; its approach is nought. Left out is how the yaw rate changes the forward speed
from strip to strip: 1e-5 in creepage over 10 mm of tread at R 1000 m.
"""

import math
from typing import NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.rail_tables import RAIL_ROOM, rail_at, rail_in
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, wheel_rail_pair
from hh_exudyn.contact.strips.creep import strip_fields
from hh_exudyn.contact.strips.loads import first_half_lengths, solve_loads
from hh_exudyn.contact.strips.overlap import overlapping_strips
from hh_exudyn.contact.strips.pressure import refine_strips
from hh_exudyn.contact.strips.shape import shape_strips, touch
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Fields, Memory, SplineTable, WheelRailModel, WheelStrips
from hh_exudyn.kernel import inlined_kernel, kernel, memory, shaped

_STATE = ROWS * CAPACITY


class LoggedPatch(NamedTuple):
    """What a row of the contact log says of its patch."""

    y_wheel: float  # [m]
    normal_force: float  # [N]
    nu_x: float
    nu_y: float
    phi: float  # [1/m]
    friction: float


class LoggedPose(NamedTuple):
    """What a row of the contact log says of its wheel's place on the rail."""

    side: float  # 1 left, -1 right
    s: float  # arc length along the track [m]
    centre_y: float  # wheelset's centre from the origin of the rail's profile, axes of R [m]
    centre_z: float
    angle_of_attack: float  # [rad]
    roll: float


def logged_pair(contact: WheelRailModel, pose: LoggedPose) -> WheelRailPair:
    """The wheel on its rail in the pose of a row.

    Parameters
    ----------
    contact : WheelRailModel
        Profiles of the run; the rail is that at the row's place on the track.
    pose : LoggedPose
        Of the row.
    """
    left = pose.side > 0.0
    rail, _ = rail_at(contact.rails_left if left else contact.rails_right, pose.s)
    return _pair(contact, pose, rail, np.zeros((2, 3)))


@inlined_kernel
def _pair(contact: WheelRailModel, pose: LoggedPose, rail: SplineTable, vectors: FloatArray) -> WheelRailPair:
    """`logged_pair` on a given rail, with (2, 3) numbers of work space."""
    yaw, roll = pose.angle_of_attack, pose.roll
    vectors[0, 0], vectors[0, 1], vectors[0, 2] = 0.0, pose.centre_y, pose.centre_z
    vectors[1, 0] = -math.sin(yaw) * math.cos(roll)
    vectors[1, 1], vectors[1, 2] = math.cos(yaw) * math.cos(roll), math.sin(roll)
    return wheel_rail_pair(
        contact.wheel_left if pose.side > 0.0 else contact.wheel_right,
        rail,
        pose.side,
        contact.running_circle_distance,
        contact.nominal_radius,
        vectors[0],
        vectors[1],
    )


@kernel
def rebuilt_rows(
    contact: WheelRailModel,
    pose: LoggedPose,
    patch: LoggedPatch,
    vectors: FloatArray,
    rows: FloatArray,
    fields: Fields,
) -> int:
    """`rebuild_strips` into an array, with the fields of FaStrip (kernel: trusts its input).

    Parameters
    ----------
    contact : WheelRailModel
        Profiles, strips and elastic constants of the run.
    pose, patch : LoggedPose, LoggedPatch
        The row.
    vectors : FloatArray
        (2, 3) work space.
    rows : FloatArray
        (ROWS, CAPACITY) out.
    fields : Fields
        (loaded strips, nx) out, in the order of the profile; with no row none are computed.

    Returns
    -------
    int
        As of `rebuild_strips`.
    """
    state = memory(_STATE)
    s = shaped(state, (ROWS, CAPACITY))
    along = contact.rails_left if pose.side > 0.0 else contact.rails_right
    rail, _ = rail_in(along, pose.s, memory(RAIL_ROOM))
    pair = _pair(contact, pose, rail, vectors)
    strips = contact.strips_left if pose.side > 0.0 else contact.strips_right
    modulus = contact.shear_modulus / (1.0 - contact.poisson_ratio)
    count = rebuild_strips(pair, strips, modulus, patch, state)
    if count > 0 and fields.pressure.shape[0] > 0:
        strip_fields(count, contact.shear_modulus, contact.poisson_ratio, state, fields)
    for row in range(ROWS):
        for j in range(count):
            rows[row, j] = s[row, j]
    return count


@kernel
def rebuild_strips(
    pair: WheelRailPair, strips: WheelStrips, modulus: float, patch: LoggedPatch, state: Memory
) -> int:
    """The strips of one logged patch, with load, shape, slip and friction (kernel: trusts its input).

    Arguments: see the map of this folder; the pose is that of the row `patch`. In `state`, the result, the
    strips of other patches have no load.

    Returns
    -------
    int
        Strips with overlap; 0 where nothing carries load in this pose.
    """
    s = shaped(state, (ROWS, CAPACITY))
    count = overlapping_strips(pair, strips, state)
    if count == 0:
        return 0
    first_half_lengths(count, state)
    guess = shaped(memory(CAPACITY), (CAPACITY,))
    guess[:] = 0.0
    if not solve_loads(count, modulus, guess, state):
        return 0
    low, high = _run_at(patch.y_wheel, count, strips, state)
    if low > high:
        return 0
    for j in range(count):
        s[Row.NU_X, j], s[Row.NU_Y, j], s[Row.PHI, j] = 0.0, 0.0, 0.0
        s[Row.FRICTION, j] = patch.friction
    _slip_of_body(pair, low, high, patch, state)
    shape_strips(count, modulus, state)
    refine_strips(count, modulus, state)
    for j in range(count):
        if j < low or j > high:
            s[Row.LOAD, j] = 0.0
    _scale(low, high, patch.normal_force, state)
    return count


@kernel
def _run_at(y_wheel: float, count: int, strips: WheelStrips, state: Memory) -> tuple[int, int]:
    """First and last strip of the run of loaded strips whose centre of load lies nearest to a place."""
    s = shaped(state, (ROWS, CAPACITY))
    nearest, low, high = math.inf, 0, -1
    first = 0
    while first < count:
        last = first
        if s[Row.LOAD, first] > 0.0:
            while last + 1 < count and touch(last, state):
                last += 1
            total, moment = 0.0, 0.0
            for j in range(first, last + 1):
                total += s[Row.LOAD, j]
                moment += s[Row.LOAD, j] * strips.y[np.uint64(s[Row.NUMBER, j])]
            distance = abs(moment / total - y_wheel)
            if distance < nearest:
                nearest, low, high = distance, first, last
        first = last + 1
    return low, high


@kernel
def _slip_of_body(pair: WheelRailPair, low: int, high: int, patch: LoggedPatch, state: Memory) -> None:
    """Creepages of every strip of a run, from their means weighted by the load."""
    s = shaped(state, (ROWS, CAPACITY))
    total, radius, x, up, along = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(low, high + 1):
        load = s[Row.LOAD, j]
        total += load
        radius += load * s[Row.RADIUS, j]
        x += load * s[Row.X, j]
        up += load * s[Row.COSINE, j]
        along += load * (pair.axle_z * s[Row.COSINE, j] - pair.side * pair.axle_y * s[Row.SINE, j])
    inverse = 1.0 / total
    radius, x, up, along = radius * inverse, x * inverse, up * inverse, along * inverse
    rolling = (1.0 - patch.nu_x) / radius  # rotation about the axle per metre
    turning = (patch.phi - rolling * along) / up  # rotation about the vertical per metre
    lateral, vertical = 0.0, 0.0  # velocity over that forwards where the load has its centre
    for j in range(low, high + 1):
        load = s[Row.LOAD, j] * inverse
        lateral += load * s[Row.COSINE, j]
        vertical += load * s[Row.SINE, j]
    size = patch.nu_y / math.hypot(lateral, vertical)
    angle = math.atan2(vertical, lateral)
    lateral, vertical = size * math.cos(angle), pair.side * size * math.sin(angle)
    for j in range(low, high + 1):
        cosine, sine = s[Row.COSINE, j], pair.side * s[Row.SINE, j]
        ahead = s[Row.X, j] - x
        s[Row.NU_X, j] = patch.nu_x - rolling * (s[Row.RADIUS, j] - radius)
        s[Row.NU_Y, j] = cosine * (lateral + turning * ahead) + sine * (vertical - rolling * ahead)
        s[Row.PHI, j] = rolling * (pair.axle_z * cosine - pair.axle_y * sine) + turning * cosine


@kernel
def _scale(low: int, high: int, normal_force: float, state: Memory) -> None:
    """Scale loads and half lengths of a run so that the loads have that resultant; pressures stay.

    The second solution carries some 5 % less at the same height, as its half lengths are that much too short;
    its pressures are those of the half-space under the row's own force, to 1 to 3 %.
    """
    s = shaped(state, (ROWS, CAPACITY))
    up, inwards = 0.0, 0.0
    for j in range(low, high + 1):
        up += s[Row.LOAD, j] * s[Row.COSINE, j]
        inwards += s[Row.LOAD, j] * s[Row.SINE, j]
    factor = normal_force / math.hypot(up, inwards)
    for j in range(low, high + 1):
        for row in (Row.LOAD, Row.HALF_LENGTH, Row.A, Row.PEAK):
            s[row, j] *= factor
