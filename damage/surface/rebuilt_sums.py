"""Contact states by the strips of the run: rebuilt from the pose of each row, with FaStrip, and summed.

Every strip lies where it lies on the wheel's profile, with its own rolling radius, normal and rigid slip
(`hh_exudyn.contact.strips.rebuilt`); a conformal patch in the flange root is worn strip by strip.
"""

import math
from typing import NamedTuple

import numpy as np

from damage.log_input.states import ContactStates, patch_of
from damage.patch_strips import FLANGE, TREAD, PatchStrips, first_strips
from damage.surface.contact_sums import Placed, Solving, Sums, Work, add_patch, turning_of
from damage.surface.lateral_grid import LateralGrid
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.rail_tables import rail_at
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, wheel_rail_pair
from hh_exudyn.contact.strips.rebuilt import Elastic, LoggedPatch, rebuilt_rows
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import WheelRailModel
from hh_exudyn.kernel import inlined_kernel, kernel


class WheelPlaces(NamedTuple):
    """Where the strips of a wheel lie on the grid, (strips,) each."""

    position: FloatArray  # coordinate of the grid [m]
    stretch: FloatArray  # length in that coordinate over length along the profile [-]


class Rebuilding(NamedTuple):
    """What strips are rebuilt from, for the kernel."""

    contact: WheelRailModel  # of the run
    left: WheelPlaces
    right: WheelPlaces
    flange_angle: float  # from which a strip's contact counts as flange contact [rad]


class RebuildWork(NamedTuple):
    """Work space of one thread, beside `Work`."""

    rows: FloatArray  # (ROWS, CAPACITY)
    vectors: FloatArray  # (2, 3) centre and axle of the wheelset


def rebuilding(contact: WheelRailModel, grid: LateralGrid, flange_angle: float) -> Rebuilding:
    """The settings for strips of a run.

    Every strip of both wheels has its bin, by its place and slope.

    Parameters
    ----------
    contact
        Profiles and strips of the run.
    grid
        The bins on the wheel.
    flange_angle
        From which a strip's contact counts as flange contact [rad].
    """
    left, right = (
        WheelPlaces(*grid.place(strips.y, np.arctan(strips.slope)))
        for strips in (contact.strips_left, contact.strips_right)
    )
    return Rebuilding(contact, left, right, flange_angle)


def rebuild_work() -> RebuildWork:
    """Work space for one thread."""
    return RebuildWork(np.zeros((ROWS, CAPACITY)), np.zeros((2, 3)))


@inlined_kernel
def logged_pair(
    contact: WheelRailModel, states: ContactStates, row: int, vectors: FloatArray
) -> WheelRailPair:
    """The wheel on its rail in the pose of a row (kernel).

    The rail is that of the row's place on the track; the axle's direction follows from yaw and roll.

    Parameters
    ----------
    contact
        Profiles of the run.
    states, row
        Contact states with their poses, and the number of one.
    vectors
        (2, 3) work space.
    """
    left = states.side[row] > 0.0
    yaw, roll = states.angle_of_attack[row], states.roll[row]
    vectors[0, 0], vectors[0, 1], vectors[0, 2] = 0.0, states.centre_y[row], states.centre_z[row]
    vectors[1, 0] = -math.sin(yaw) * math.cos(roll)
    vectors[1, 1], vectors[1, 2] = math.cos(yaw) * math.cos(roll), math.sin(roll)
    rail, _ = rail_at(contact.rails_left if left else contact.rails_right, states.s[row])
    wheel = contact.wheel_left if left else contact.wheel_right
    return wheel_rail_pair(
        wheel, rail, states.side[row], contact.running_circle_distance, contact.nominal_radius,
        vectors[0], vectors[1],
    )  # fmt: skip


@kernel
def add_rebuilt(
    states: ContactStates,
    placed: Placed,
    rebuild: Rebuilding,
    solving: Solving,
    rebuild_space: RebuildWork,
    work: Work,
    sums: Sums,
) -> int:
    """Add the states of a wheel, each by its strips, to its sums (kernel, allocates nothing).

    Parameters
    ----------
    states, placed
        (n,) contact states of the wheel, with their poses.
    rebuild
        Profiles of the run, and where its strips lie on the grid.
    solving
        Steel, wear law and bins.
    rebuild_space, work
        Work spaces, for `CAPACITY` strips.
    sums
        Result, added to.

    Returns
    -------
    int
        -1, or the first row in whose pose nothing touches: other profiles were in the run.
    """
    contact, elastic = rebuild.contact, Elastic(solving.elastic.shear_modulus, solving.elastic.poisson_ratio)
    for row in range(placed.part.size):
        if states.normal_force[row] <= 0.0:
            continue
        left = states.side[row] > 0.0
        patch = LoggedPatch(
            states.y_wheel[row], states.normal_force[row], states.nu_x[row], states.nu_y[row],
            states.phi[row], states.friction[row],
        )  # fmt: skip
        pair = logged_pair(contact, states, row, rebuild_space.vectors)
        wheel = contact.strips_left if left else contact.strips_right
        count = rebuilt_rows(pair, wheel, elastic, patch, rebuild_space.rows, work.fields)
        if count == 0:
            return row
        places = rebuild.left if left else rebuild.right
        loaded, area = _fill_strips(count, places, rebuild, rebuild_space.rows, work.strips)
        strips, fields = first_strips(work.strips, work.fields, loaded)
        for strip in range(loaded):
            part = strips.part[strip]
            for cell in range(fields.pressure.shape[1]):
                sums.pressure_by_part[part] = max(sums.pressure_by_part[part], fields.pressure[strip, cell])
        turning = turning_of(states, row, placed.interval[row], placed.fatigue_index[row])
        rolling = patch_of(states, row, solving.elastic)
        add_patch(rolling, area, strips, fields, turning, solving, work, sums)
    return -1


@kernel
def _fill_strips(
    count: int, places: WheelPlaces, rebuild: Rebuilding, rows: FloatArray, strips: PatchStrips
) -> tuple[int, float]:
    """Fill the strips that carry load, in the order of the fields; their number and the area of contact."""
    loaded, area = 0, 0.0
    for j in range(count):
        if not rows[Row.LOAD, j] > 0.0:
            continue
        number = int(rows[Row.NUMBER, j])
        width, half_length = rows[Row.WIDTH, j], rows[Row.HALF_LENGTH, j]
        strips.position[loaded] = places.position[number]
        strips.covered[loaded] = width * places.stretch[number]
        strips.width[loaded], strips.half_length[loaded] = width, half_length
        strips.contact_length[loaded] = 2.0 * half_length
        strips.nu_x[loaded], strips.nu_y[loaded] = rows[Row.NU_X, j], rows[Row.NU_Y, j]
        strips.phi[loaded] = rows[Row.PHI, j]
        angle = math.atan2(rows[Row.SINE, j], rows[Row.COSINE, j])
        strips.part[loaded] = FLANGE if angle > rebuild.flange_angle else TREAD
        area += 2.0 * half_length * width
        loaded += 1
    return loaded, area
