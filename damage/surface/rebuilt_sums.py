"""Contact states by the strips of the run: rebuilt from the pose of each row, with FaStrip, and summed.

Every strip lies where it lies on the wheel's profile, with its own rolling radius, normal and rigid slip
(`hh_exudyn.contact.strips.rebuilt`); a conformal patch in the flange root is worn strip by strip.
"""

import math
from typing import NamedTuple

import numpy as np

from damage.log_input.states import ContactStates, patch_of
from damage.patch_strips import FLANGE, TREAD, PatchStrips, first_strips
from damage.rails.side import RailSide, add_to_rail
from damage.surface.contact_sums import Placed, Solving, Sums, Work, add_patch, turning_of, wear_factor
from damage.surface.lateral_grid import LateralGrid, place_of
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.strips.rebuilt import LoggedPatch, LoggedPose, rebuilt_rows
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
def pose_of(states: ContactStates, row: int) -> LoggedPose:
    """The pose of a contact state, by its row (kernel).

    Parameters
    ----------
    states, row
        Contact states with their poses, and the number of one.
    """
    return LoggedPose(
        states.side[row], states.s[row], states.centre_y[row], states.centre_z[row],
        states.angle_of_attack[row], states.roll[row],
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
    rail: RailSide,
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
    rail
        The rail below the wheel, added to where it is wanted.

    Returns
    -------
    int
        -1, or the first row in whose pose nothing touches: other profiles were in the run.
    """
    for row in range(placed.part.size):
        if states.normal_force[row] <= 0.0:
            continue
        patch = LoggedPatch(
            states.y_wheel[row], states.normal_force[row], states.nu_x[row], states.nu_y[row],
            states.phi[row], states.friction[row],
        )  # fmt: skip
        count = rebuilt_rows(
            rebuild.contact, pose_of(states, row), patch, rebuild_space.vectors, rebuild_space.rows,
            work.fields,
        )  # fmt: skip
        if count == 0:
            return row
        places = rebuild.left if states.side[row] > 0.0 else rebuild.right
        loaded, area = _fill_strips(
            count, places, rebuild, rebuild_space.rows, states, placed, row, solving, work.strips, rail
        )
        strips, fields = first_strips(work.strips, work.fields, loaded)
        for strip in range(loaded):
            part = strips.part[strip]
            for cell in range(fields.pressure.shape[1]):
                sums.pressure_by_part[part] = max(sums.pressure_by_part[part], fields.pressure[strip, cell])
        turning = turning_of(states, row, placed.interval[row], placed.fatigue_index[row])
        rolling = patch_of(states, row, solving.elastic)
        add_patch(rolling, area, strips, fields, turning, solving, work, sums)
        if rail.wanted:
            on_rail, _ = first_strips(rail.strips, work.fields, loaded)
            add_to_rail(rail, row, rolling, area, on_rail, fields, turning, work)
    return -1


@kernel
def _fill_strips(
    count: int,
    places: WheelPlaces,
    rebuild: Rebuilding,
    rows: FloatArray,
    states: ContactStates,
    placed: Placed,
    row: int,
    solving: Solving,
    strips: PatchStrips,
    rail: RailSide,
) -> tuple[int, float]:
    """Fill the strips that carry load, in the order of the fields; their number and the area of contact.

    On the rail a strip lies at its place on the rail's profile, and is as wide as on the wheel.
    """
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
        strips.wear_factor[loaded] = wear_factor(states, placed, row, angle, solving)
        strips.part[loaded] = FLANGE if angle > rebuild.flange_angle else TREAD
        if rail.wanted:
            position, stretch = place_of(rows[Row.Y_RAIL, j], angle, rail.table)
            rail.strips.position[loaded], rail.strips.covered[loaded] = position, width * stretch
        area += 2.0 * half_length * width
        loaded += 1
    return loaded, area
