"""The kernel of damage: every contact state is solved once, and all that follows is summed for its wheel."""

import math
from typing import NamedTuple

import numpy as np

from damage.rcf.burstow import BurstowLimits
from damage.rcf.local import strip_fatigue
from damage.rcf.miner import kabo_damage
from damage.rcf.number import Bins, CountWork, count_patch, count_work
from damage.surface.lateral_grid import spread
from damage.surface.patch_field import patch_field
from damage.wear.strip_wear import strip_wear
from damage.wear.values import REGIMES, LawValues
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import kernel


class States(NamedTuple):
    """Contact states of one wheel, (n,) each, as the loop takes them."""

    part: FloatArray  # TREAD or FLANGE
    interval: FloatArray  # [s]
    fatigue_index: FloatArray  # FI_surf [-]
    position: FloatArray  # coordinate on the grid [m]
    stretch: FloatArray  # what a metre across the patch is on the grid [-]
    side: FloatArray
    rolling_radius: FloatArray
    normal_force: FloatArray
    a: FloatArray
    b: FloatArray
    nu_x: FloatArray
    nu_y: FloatArray
    phi: FloatArray
    friction: FloatArray
    speed: FloatArray
    force_x: FloatArray
    force_y: FloatArray


class Sums(NamedTuple):
    """What the loop adds to: arrays of a `WheelSurface` without the axis of the wheels, and the counts."""

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
    """How states are solved and judged."""

    theory: int  # a value of `patch_field.DAMAGE_THEORIES`
    shear_modulus: float  # of wheel and rail [Pa]
    poisson_ratio: float
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
    """Work space for patches of `cells` (along, across)."""
    nx, ny = cells
    return Work(
        Fields(*np.zeros((5, ny, nx))),
        np.zeros((ny, REGIMES)),
        np.zeros(ny),
        count_work(cells, bins_along),
    )


@kernel
def add_states(states: States, solving: Solving, work: Work, sums: Sums) -> None:
    """Add the states of a wheel to its sums; every patch lies on the grids."""
    start, step = solving.bins.start, solving.bins.step
    for row in range(states.part.size):
        if states.normal_force[row] <= 0.0:
            continue  # bodies that touch without force: no pressure, no wear, no fatigue
        part = int(states.part[row])
        a, b, speed, radius = states.a[row], states.b[row], states.speed[row], states.rolling_radius[row]
        position, stretch, interval = states.position[row], states.stretch[row], states.interval[row]
        rolled = speed * interval
        revolutions = rolled / (2.0 * math.pi * radius)
        spread(position, 2.0 * b * stretch, interval, start, step, sums.contact_time[part])
        spread(position, 2.0 * b * stretch, revolutions, start, step, sums.contact_revolutions[part])
        if states.fatigue_index[row] > 0.0:
            spread(position, 2.0 * b * stretch, interval, start, step, sums.fatigue_time[part])
            spread(position, 2.0 * b * stretch, revolutions, start, step, sums.fatigue_revolutions[part])
        if rolled <= 0.0:
            continue
        patch = RollingPatch(
            a, b, states.normal_force[row], states.nu_x[row], states.nu_y[row], states.phi[row],
            states.friction[row], solving.shear_modulus, solving.poisson_ratio,
        )  # fmt: skip
        patch_field(solving.theory, patch, states.force_x[row], states.force_y[row], work.fields)
        strip_wear(solving.law, patch, work.fields, speed, radius, work.depth)
        strip_fatigue(work.fields, solving.shear_yield, patch.friction, work.fatigue_index)
        across = -states.side[row] * stretch
        count_patch(
            patch, work.fields, work.fatigue_index, solving.shear_yield, solving.limits, position, across,
            revolutions, solving.bins, work.counting, sums.counts[part],
        )  # fmt: skip
        _add_strips(b, stretch, position, across, revolutions, rolled, start, step, part, work, sums)


@kernel
def _add_strips(
    b: float,
    stretch: float,
    position: float,
    across: float,
    revolutions: float,
    rolled: float,
    start: float,
    step: float,
    part: int,
    work: Work,
    sums: Sums,
) -> None:
    """Add what is known of every strip of a patch: its wear and its largest indices."""
    cells_y = work.depth.shape[0]
    width = 2.0 * b / cells_y
    half = 0.5 * width * stretch / step
    v0, v1, v2, v3 = 0.0, 0.0, 0.0, 0.0  # by regime, side by side as one vector
    for strip in range(cells_y):
        d0, d1, d2, d3 = (
            work.depth[strip, 0],
            work.depth[strip, 1],
            work.depth[strip, 2],
            work.depth[strip, 3],
        )
        v0, v1, v2, v3 = v0 + d0, v1 + d1, v2 + d2, v3 + d3
        depth = (d0 + d1) + (d2 + d3)
        depth *= revolutions
        ratchets = revolutions if work.fatigue_index[strip] > 0.0 else 0.0
        damage = kabo_damage(work.fatigue_index[strip]) * revolutions
        middle = (position + across * b * (-1.0 + (2 * strip + 1) / cells_y) - start) / step
        low, high = middle - half, middle + half
        for place in range(max(int(low), 0), min(int(high), sums.depth.size - 1) + 1):
            covered = min(high, place + 1.0) - max(low, float(place))
            sums.depth[place] += depth * covered
            # the depth is normal to the surface, which is wider than its shadow on the lateral coordinate
            sums.worn_area[place] += depth * covered * step / stretch
            if ratchets > 0.0:
                sums.ratchet_revolutions[part, place] += ratchets * covered
                sums.crack_damage[part, place] += damage * covered
    volume = width * rolled
    sums.worn_volume[0] += v0 * volume
    sums.worn_volume[1] += v1 * volume
    sums.worn_volume[2] += v2 * volume
    sums.worn_volume[3] += v3 * volume
