"""The rail below a wheel, for the kernels: a patch that was solved for the wheel is added to its rail too.

Stress and slip are those of the wheel's patch, for both bodies share them. The rail has its own places, bins,
steel and wear law, and passings of 1 m in the place of revolutions (`damage.rails`).
"""

from typing import NamedTuple

import numpy as np

from damage.patch_strips import PatchStrips
from damage.rails.rail_surface import PASSED_LENGTH
from damage.surface.contact_sums import Placed, Solving, Sums, Turning, Work, add_patch
from damage.surface.lateral_grid import PlaceTable, spread
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import inlined_kernel, kernel

_NO_PLACES = PlaceTable(np.empty(0), np.empty(0))


class RailSide(NamedTuple):
    """The rail below the wheel of a block of contact states, (n,)."""

    wanted: bool
    placed: Placed  # of the states on the rail
    damage: FloatArray  # (n,) of a passing by the whole-life rail model [-]
    solving: Solving  # with steel, wear law and bins of the rail
    table: PlaceTable  # of the rail's grid
    strips: PatchStrips  # those of the work space, but for `position` and `covered`
    sums: Sums  # result, added to
    whole_life: FloatArray  # (B,) result, added to


def no_rail(placed: Placed, solving: Solving, work: Work, sums: Sums) -> RailSide:
    """No rail is wanted: nothing of the record is touched; arguments are those of the wheel."""
    return RailSide(False, placed, np.empty(0), solving, _NO_PLACES, work.strips, sums, np.empty(0))


def strips_on_rail(strips: PatchStrips) -> PatchStrips:
    """The same strips with places of their own: all other members are the wheel's."""
    count = strips.width.size
    return strips._replace(position=np.zeros(count), covered=np.zeros(count))


@inlined_kernel
def passing_of(turning: Turning, fatigue_index: float) -> Turning:
    """How far and how often the rail is passed (kernel).

    Parameters
    ----------
    turning
        Of the wheel.
    fatigue_index
        FI_surf of the rail [-].
    """
    return Turning(
        turning.speed, turning.rolling_radius, turning.interval, turning.rolled,
        turning.rolled / PASSED_LENGTH, fatigue_index > 0.0,
    )  # fmt: skip


@kernel
def add_to_rail(
    rail: RailSide,
    row: int,
    patch: RollingPatch,
    area: float,
    strips: PatchStrips,
    fields: Fields,
    turning: Turning,
    work: Work,
) -> None:
    """Add a solved patch to the sums of its rail (kernel, allocates nothing).

    Parameters
    ----------
    rail
        The rail.
    row
        Number of the state.
    patch, area, strips, fields
        As for `add_patch`, the strips placed on the rail.
    turning
        Of the wheel.
    work
        Work space.
    """
    passing = passing_of(turning, rail.placed.fatigue_index[row])
    add_patch(patch, area, strips, fields, passing, rail.solving, work, rail.sums)
    damage = rail.damage[row] * passing.revolutions
    if damage != 0.0:
        bins = rail.solving.bins
        for strip in range(strips.width.size):
            spread(
                strips.position[strip], strips.covered[strip], damage, bins.start, bins.step, rail.whole_life
            )
