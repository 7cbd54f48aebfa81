"""The kernel of damage: wear and fatigue of a solved patch are summed for a wheel, or for a rail."""

import math
from typing import NamedTuple

import numpy as np

from damage.log_input.states import ContactStates
from damage.patch_strips import PatchStrips, strips_space
from damage.rcf.burstow import BurstowLimits
from damage.rcf.local import strip_fatigue
from damage.rcf.miner import kabo_damage
from damage.rcf.number import Bins, CountWork, count_patch, count_work
from damage.surface.lateral_grid import spread
from damage.wear.law import REGIMES, LawValues, SolvedPatch
from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.friction import FrictionTable, friction_at
from hh_exudyn.contact.types import Elastic, Fields, RollingPatch
from hh_exudyn.kernel import inlined_kernel, kernel


class Placed(NamedTuple):
    """Place, time and fatigue index of the contact states of one wheel on it or on its rail, (n,) each."""

    part: IntArray  # TREAD or FLANGE
    interval: FloatArray  # [s]
    fatigue_index: FloatArray  # FI_surf [-]
    position: FloatArray  # coordinate on the grid [m]
    stretch: FloatArray  # length in that coordinate over length across the patch [-]
    lowest: FloatArray  # place on the wheel where another patch of it may begin [m]
    highest: FloatArray
    wheelset: IntArray  # row of its surface in `Solving.wear_factors`


class Sums(NamedTuple):
    """Sums of one wheel: arrays of a `WheelSurface` without the axis of the wheels, and the counts."""

    depth_by_part: FloatArray  # (2, B)
    worn_area: FloatArray  # (B,)
    worn_volume: FloatArray  # (REGIMES,)
    contact_time: FloatArray  # (2, B)
    fatigue_time: FloatArray  # (2, B)
    contact_revolutions: FloatArray  # (2, B)
    fatigue_revolutions: FloatArray  # (2, B)
    ratchet_revolutions: FloatArray  # (2, B)
    crack_damage: FloatArray  # (2, B)
    global_crack_damage: FloatArray  # (2, B)
    pressure_by_part: FloatArray  # (2,)
    counts: FloatArray  # (2, B, X, COLUMNS) `WheelSurface`'s rcf_number, corrected_rcf_number and energy


class Solving(NamedTuple):
    """Settings of a damage computation, for the kernel."""

    theory: int  # a value of `patch_field.DAMAGE_THEORIES`
    elastic: Elastic  # of wheel and rail
    shear_yield: float  # k [Pa]
    law: LawValues
    limits: BurstowLimits
    bins: Bins
    wear_factors: FrictionTable  # wear over that of dry steel, by place, wheel and zone


class Turning(NamedTuple):
    """How long and how far the wheel rolls on a patch."""

    speed: float  # [m/s]
    rolling_radius: float  # [m]
    interval: float  # [s]
    rolled: float  # [m]
    revolutions: float  # [-]
    fatigue_index: float  # FI_surf [-]


class Work(NamedTuple):
    """Work space of one thread."""

    strips: PatchStrips  # (ny,)
    fields: Fields  # (ny, nx)
    depth: FloatArray  # (ny, REGIMES)
    fatigue_index: FloatArray  # (ny,)
    counting: CountWork


def work_space(cells: tuple[int, int], bins_along: int) -> Work:
    """Work space for patches of `cells` (along, across) on `bins_along` bins along the patch.

    Parameters
    ----------
    cells
        Cells of a patch along and across.
    bins_along
        Bins along the patch.
    """
    nx, ny = cells
    return Work(
        strips_space(ny),
        Fields(*np.zeros((5, ny, nx))),
        np.zeros((ny, REGIMES)),
        np.zeros(ny),
        count_work(cells, bins_along),
    )


@inlined_kernel
def wear_factor(states: ContactStates, placed: Placed, row: int, angle: float, solving: Solving) -> float:
    """Wear over that of dry steel on a strip of a row [-] (kernel).

    Parameters
    ----------
    states, placed, row
        Contact states, their places, and the number of one.
    angle
        Contact angle of the strip, positive towards the flange [rad].
    solving
        Has the table of factors.
    """
    side = 0 if states.side[row] > 0.0 else 1
    return friction_at(solving.wear_factors, placed.wheelset[row], side, states.s[row], angle, 0.0)


@kernel
def fill_wear_factors(
    states: ContactStates,
    placed: Placed,
    row: int,
    angles: FloatArray,
    solving: Solving,
    strips: PatchStrips,
) -> None:
    """Fill the wear factors of the strips of a row (kernel).

    Parameters
    ----------
    states, placed, row, solving
        As for `wear_factor`.
    angles
        (n,) contact angles of the strips [rad].
    strips
        (n,) result.
    """
    for strip in range(angles.size):
        strips.wear_factor[strip] = wear_factor(states, placed, row, angles[strip], solving)


@inlined_kernel
def turning_of(states: ContactStates, row: int, interval: float, fatigue_index: float) -> Turning:
    """The `Turning` of a row (kernel).

    Parameters
    ----------
    states, row
        Contact states, and the number of one.
    interval
        Its output interval [s].
    fatigue_index
        FI_surf [-].
    """
    speed, radius = states.speed[row], states.rolling_radius[row]
    rolled = speed * interval
    return Turning(speed, radius, interval, rolled, rolled / (2.0 * math.pi * radius), fatigue_index)


@kernel
def add_patch(
    patch: RollingPatch,
    area: float,
    strips: PatchStrips,
    fields: Fields,
    turning: Turning,
    solving: Solving,
    work: Work,
    sums: Sums,
) -> None:
    """Add the wear and the fatigue of a solved patch to the sums of its wheel (kernel, allocates nothing).

    Parameters
    ----------
    patch
        Loads and friction.
    area
        Of contact [m^2].
    strips, fields
        Its (n,) strips on the wheel and their (n, nx) stress and slip; fields are not read where nothing
        rolls.
    turning
        How long and how far it rolls.
    solving
        Steel, wear law and bins.
    work
        Work space for as many strips, or more.
    sums
        Result, added to.
    """
    _add_times(strips, turning, solving.bins, sums)
    if turning.rolled <= 0.0:
        return
    law, count = solving.law, strips.width.size
    depth, fatigue_index = work.depth[:count], work.fatigue_index[:count]
    solved = SolvedPatch(patch, strips, area, fields, turning.speed, turning.rolling_radius)
    law.depths(law.numbers, solved, depth)
    strip_fatigue(fields, solving.shear_yield, patch.friction, fatigue_index)
    count_patch(
        strips, fields, fatigue_index, solving.shear_yield, solving.limits, turning.revolutions, solving.bins,
        work.counting, sums.counts,
    )  # fmt: skip
    _add_strips(strips, depth, fatigue_index, turning, solving.bins, sums)


@kernel
def _add_times(strips: PatchStrips, turning: Turning, bins: Bins, sums: Sums) -> None:
    """Add time, revolutions and damage by FI_surf of a state to the bins that its strips cover."""
    damage = kabo_damage(turning.fatigue_index) * turning.revolutions
    for strip in range(strips.width.size):
        part, centre, width = strips.part[strip], strips.position[strip], strips.covered[strip]
        time, revolutions = sums.contact_time[part], sums.contact_revolutions[part]
        spread(centre, width, turning.interval, bins.start, bins.step, time)
        spread(centre, width, turning.revolutions, bins.start, bins.step, revolutions)
        if turning.fatigue_index > 0.0:
            time, revolutions = sums.fatigue_time[part], sums.fatigue_revolutions[part]
            spread(centre, width, turning.interval, bins.start, bins.step, time)
            spread(centre, width, turning.revolutions, bins.start, bins.step, revolutions)
            spread(centre, width, damage, bins.start, bins.step, sums.global_crack_damage[part])


@kernel
def _add_strips(
    strips: PatchStrips,
    depths: FloatArray,
    fatigue_index: FloatArray,
    turning: Turning,
    bins: Bins,
    sums: Sums,
) -> None:
    """Add the wear of every strip of a patch, and the damage of its largest index."""
    for strip in range(depths.shape[0]):
        factor = strips.wear_factor[strip]
        d0, d1 = factor * depths[strip, 0], factor * depths[strip, 1]
        d2, d3 = factor * depths[strip, 2], factor * depths[strip, 3]
        volume = strips.width[strip] * turning.rolled
        sums.worn_volume[0] += d0 * volume
        sums.worn_volume[1] += d1 * volume
        sums.worn_volume[2] += d2 * volume
        sums.worn_volume[3] += d3 * volume
        depth = ((d0 + d1) + (d2 + d3)) * turning.revolutions
        part, stretch = strips.part[strip], strips.covered[strip] / strips.width[strip]
        ratchets = turning.revolutions if fatigue_index[strip] > 0.0 else 0.0
        damage = kabo_damage(fatigue_index[strip]) * turning.revolutions
        width = strips.covered[strip] / bins.step
        low = (strips.position[strip] - bins.start) / bins.step - 0.5 * width
        high = low + width
        for place in range(max(int(low), 0), min(int(high), sums.worn_area.size - 1) + 1):
            covered = min(high, place + 1.0) - max(low, float(place))
            sums.depth_by_part[part, place] += depth * covered
            # the depth is normal to the surface, which is wider than its projection on the lateral coordinate
            sums.worn_area[place] += depth * covered * bins.step / stretch
            if ratchets > 0.0:
                sums.ratchet_revolutions[part, place] += ratchets * covered
                sums.crack_damage[part, place] += damage * covered
