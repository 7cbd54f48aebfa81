"""The kernel of damage: every contact state is solved once, its wear and fatigue are summed for its wheel."""

import math
from typing import NamedTuple

import numpy as np

from damage.cells import cell_middle
from damage.log_input.states import ContactStates, Elastic, patch_of
from damage.rcf.burstow import BurstowLimits
from damage.rcf.local import strip_fatigue
from damage.rcf.miner import kabo_damage
from damage.rcf.number import Bins, CountWork, Spot, count_patch, count_work
from damage.surface.lateral_grid import spread
from damage.surface.patch_field import patch_field
from damage.wear.law import REGIMES, LawValues, SolvedPatch
from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.types import Fields
from hh_exudyn.kernel import inlined_kernel, kernel


class Placed(NamedTuple):
    """Place, time and fatigue index of the contact states of one wheel, (n,) each."""

    part: IntArray  # TREAD or FLANGE
    interval: FloatArray  # [s]
    fatigue_index: FloatArray  # FI_surf [-]
    position: FloatArray  # coordinate on the grid [m]
    stretch: FloatArray  # length in that coordinate over length across the patch [-]


class Sums(NamedTuple):
    """Sums of one wheel: arrays of a `WheelSurface` without the axis of the wheels, and the counts."""

    depth: FloatArray  # (B,)
    worn_area: FloatArray  # (B,)
    worn_volume: FloatArray  # (REGIMES,)
    contact_time: FloatArray  # (2, B)
    fatigue_time: FloatArray  # (2, B)
    contact_revolutions: FloatArray  # (2, B)
    fatigue_revolutions: FloatArray  # (2, B)
    ratchet_revolutions: FloatArray  # (2, B)
    crack_damage: FloatArray  # (2, B)
    counts: FloatArray  # (2, B, X, COLUMNS) `WheelSurface`'s rcf_number, corrected_rcf_number and energy


class Solving(NamedTuple):
    """Settings of a damage computation, for the kernel."""

    theory: int  # a value of `patch_field.DAMAGE_THEORIES`
    elastic: Elastic  # of wheel and rail
    shear_yield: float  # k [Pa]
    law: LawValues
    limits: BurstowLimits
    bins: Bins


class Work(NamedTuple):
    """Work space of one thread."""

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
        Fields(*np.zeros((5, ny, nx))),
        np.zeros((ny, REGIMES)),
        np.zeros(ny),
        count_work(cells, bins_along),
    )


@kernel
def add_states(states: ContactStates, placed: Placed, solving: Solving, work: Work, sums: Sums) -> None:
    """Add the states of a wheel to its sums (kernel, allocates nothing).

    Parameters
    ----------
    states, placed
        (n,) contact states of the wheel; every patch lies on the grids.
    solving
        Theory, steel, wear law and bins.
    work
        Work space.
    sums
        Result, added to.
    """
    law = solving.law
    for row in range(placed.part.size):
        if states.normal_force[row] <= 0.0:
            continue  # contact without force: no pressure, no wear, no fatigue
        part, interval, stretch = placed.part[row], placed.interval[row], placed.stretch[row]
        speed, radius = states.speed[row], states.rolling_radius[row]
        rolled = speed * interval
        revolutions = rolled / (2.0 * math.pi * radius)
        spot = Spot(placed.position[row], -states.side[row] * stretch, revolutions, rolled)
        width = 2.0 * states.b[row] * stretch
        _add_time(
            spot, width, interval, solving.bins, sums.contact_time[part], sums.contact_revolutions[part]
        )
        if placed.fatigue_index[row] > 0.0:
            _add_time(
                spot, width, interval, solving.bins, sums.fatigue_time[part], sums.fatigue_revolutions[part]
            )
        if rolled <= 0.0:
            continue
        patch = patch_of(states, row, solving.elastic)
        patch_field(solving.theory, patch, states.force_x[row], states.force_y[row], work.fields)
        law.depths(law.numbers, SolvedPatch(patch, work.fields, speed, radius), work.depth)
        strip_fatigue(work.fields, solving.shear_yield, patch.friction, work.fatigue_index)
        count_patch(
            patch, work.fields, work.fatigue_index, solving.shear_yield, solving.limits, spot, solving.bins,
            work.counting, sums.counts[part],
        )  # fmt: skip
        _add_strips(patch.b, spot, solving.bins, part, work, sums)


@inlined_kernel
def _add_time(
    spot: Spot, width: float, interval: float, bins: Bins, time: FloatArray, revolutions: FloatArray
) -> None:
    """Add the time and the revolutions of a state to the bins that its patch covers."""
    spread(spot.position, width, interval, bins.start, bins.step, time)
    spread(spot.position, width, spot.revolutions, bins.start, bins.step, revolutions)


@kernel
def _add_strips(b: float, spot: Spot, bins: Bins, part: int, work: Work, sums: Sums) -> None:
    """Add the wear of every strip of a patch, and the damage of its largest index."""
    cells_y, stretch = work.depth.shape[0], abs(spot.across)
    width = 2.0 * b / cells_y
    half = 0.5 * width * stretch / bins.step
    v0, v1, v2, v3 = 0.0, 0.0, 0.0, 0.0  # by regime, as one vector
    for strip in range(cells_y):
        d0, d1, d2, d3 = (
            work.depth[strip, 0],
            work.depth[strip, 1],
            work.depth[strip, 2],
            work.depth[strip, 3],
        )
        v0, v1, v2, v3 = v0 + d0, v1 + d1, v2 + d2, v3 + d3
        depth = (d0 + d1) + (d2 + d3)
        depth *= spot.revolutions
        ratchets = spot.revolutions if work.fatigue_index[strip] > 0.0 else 0.0
        damage = kabo_damage(work.fatigue_index[strip]) * spot.revolutions
        middle = (spot.position + spot.across * b * cell_middle(strip, cells_y) - bins.start) / bins.step
        low, high = middle - half, middle + half
        for place in range(max(int(low), 0), min(int(high), sums.depth.size - 1) + 1):
            covered = min(high, place + 1.0) - max(low, float(place))
            sums.depth[place] += depth * covered
            # the depth is normal to the surface, which is wider than its projection on the lateral coordinate
            sums.worn_area[place] += depth * covered * bins.step / stretch
            if ratchets > 0.0:
                sums.ratchet_revolutions[part, place] += ratchets * covered
                sums.crack_damage[part, place] += damage * covered
    volume = width * spot.rolled
    sums.worn_volume[0] += v0 * volume
    sums.worn_volume[1] += v1 * volume
    sums.worn_volume[2] += v2 * volume
    sums.worn_volume[3] += v3 * volume
