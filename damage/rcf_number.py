"""The RCF number: in how many revolutions of the wheel a place of patch and profile lay beyond shakedown.

Threshold counting (Hossein-Nia 2018, section 3.3): every contact state adds one revolution's worth of counts
to the cells with SI = |q| - k > 0 (equation 3.21). The places are bins, across over the wheel profile and
along the rolling direction fixed to the patch; a bin that is covered in part gets that part of the count, so
the sum over bins times their area is revolutions times the area beyond shakedown. The same is counted with
Burstow's correction (`damage.burstow`), and the energy lost in each bin is summed,

    e = -(q_x (nu_x - phi y) + q_y (nu_y + phi x))    [J per metre rolled and m^2 = Pa]               (3.34)

with the rigid slip of the creepages: the slip's elastic part changes where the energy is lost, not how much.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from damage.burstow import BurstowLimits, remaining
from hh_exudyn.contact.types import Fields, FloatArray, RollingPatch
from hh_exudyn.kernel import kernel

COUNTED, CORRECTED, ENERGY = 0, 1, 2  # columns of the work spaces: of a strip, and again of its mirror image
COUNTS = 3
BOTH = 2 * COUNTS


class Bins(NamedTuple):
    """Where the bins lie."""

    start: float  # edge of the first bin across the profile [m]
    step: float  # [m]
    along_start: float  # rear edge of the first bin along the patch [m]
    along_step: float  # [m]


class Counts(NamedTuple):
    """Sums of the RCF number, arrays (bins across, bins along)."""

    rcf_number: FloatArray  # revolutions with SI > 0 [-]
    corrected_rcf_number: FloatArray  # the same after Burstow's correction [-]
    energy: FloatArray  # sum over the revolutions of e [Pa]


class CountWork(NamedTuple):
    """Work space for one patch.

    Two strips as far to the left and to the right of the middle are equally long: they are binned together.
    """

    along: FloatArray  # (nx,) middles of the cells along a strip over its half length [-]
    cells: FloatArray  # (BOTH, nx) of two strips
    sums: FloatArray  # (nx + 1, BOTH) sums of the cells behind each edge between them
    bins: FloatArray  # (pairs, BOTH, X) sums of the cells in each bin along, with parts of cells
    touched: NDArray[np.int64]  # (pairs, 2) first bin of each pair, and one beyond the last


def count_work(cells: tuple[int, int], bins_along: int) -> CountWork:
    """Work space for patches of `cells` (along, across) on a number of bins along the patch."""
    nx, ny = cells
    pairs = (ny + 1) // 2
    return CountWork(
        (2.0 * np.arange(nx) + 1.0) / nx - 1.0,
        np.zeros((BOTH, nx)),
        np.zeros((nx + 1, BOTH)),
        np.zeros((pairs, BOTH, bins_along)),
        np.zeros((pairs, 2), dtype=np.int64),
    )


@kernel
def _judge_strip(
    strip: int,
    column: int,
    patch: RollingPatch,
    lateral: float,
    half_length: float,
    fields: Fields,
    shear_yield: float,
    limits: BurstowLimits,
    work: CountWork,
) -> None:
    """Count, corrected count and energy of the cells of a strip at y/b = lateral, from a column on."""
    rigid_x, rigid_y = patch.nu_x - patch.phi * patch.b * lateral, patch.nu_y
    turn = patch.phi * half_length
    q_x, q_y, slip_x, slip_y = (
        fields.q_x[strip],
        fields.q_y[strip],
        fields.slip_x[strip],
        fields.slip_y[strip],
    )
    counted, corrected = work.cells[column + COUNTED], work.cells[column + CORRECTED]
    lost = work.cells[column + ENERGY]
    square_of_yield = shear_yield * shear_yield
    for i in range(work.along.size):  # no branch, no sum: the compiler makes vectors of it
        energy = -(q_x[i] * rigid_x + q_y[i] * (rigid_y + turn * work.along[i]))  # (3.34)
        count = 1.0 if q_x[i] * q_x[i] + q_y[i] * q_y[i] > square_of_yield else 0.0  # (3.21)
        left = remaining(energy, limits)
        slips = slip_x[i] * slip_x[i] + slip_y[i] * slip_y[i] > 0.0
        counted[i] = count
        corrected[i] = count * (left if slips else 1.0)
        lost[i] = energy


@kernel
def _bin_pair(pair: int, counting: bool, half_length: float, bins: Bins, work: CountWork) -> None:
    """Sum the cells of two strips of the same length over each bin along them.

    `counting`: whether any cell counts; if not, there is nothing but energy to sum.
    """
    cells, sums, result = work.cells, work.sums, work.bins[pair]
    cells_x = work.along.size
    c0, c1, e, m0, m1, me = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(cells_x if counting else 0):  # six sums side by side: each waits for itself only
        c0, c1, e = c0 + cells[0, i], c1 + cells[1, i], e + cells[2, i]
        m0, m1, me = m0 + cells[3, i], m1 + cells[4, i], me + cells[5, i]
        sums[i + 1, 0], sums[i + 1, 1], sums[i + 1, 2] = c0, c1, e
        sums[i + 1, 3], sums[i + 1, 4], sums[i + 1, 5] = m0, m1, me
    for i in range(0 if counting else cells_x):
        e, me = e + cells[2, i], me + cells[5, i]
        sums[i + 1, 2], sums[i + 1, 5] = e, me
    first = max(math.floor((-half_length - bins.along_start) / bins.along_step), 0)
    end = min(math.floor((half_length - bins.along_start) / bins.along_step) + 1, result.shape[1])
    work.touched[pair, 0], work.touched[pair, 1] = first, end
    per_length = 0.5 * cells_x / half_length
    c0, c1, e, m0, m1, me = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for place in range(first, end):
        edge = bins.along_start + (place + 1) * bins.along_step
        reach = min((edge + half_length) * per_length, float(cells_x))
        low = np.uint64(min(int(reach), cells_x - 1))
        high, part, here = low + np.uint64(1), reach - low, np.uint64(place)
        n2 = sums[low, 2] + part * (sums[high, 2] - sums[low, 2])
        n5 = sums[low, 5] + part * (sums[high, 5] - sums[low, 5])
        result[2, here], result[5, here] = n2 - e, n5 - me
        e, me = n2, n5
        if counting:
            n0 = sums[low, 0] + part * (sums[high, 0] - sums[low, 0])
            n1 = sums[low, 1] + part * (sums[high, 1] - sums[low, 1])
            n3 = sums[low, 3] + part * (sums[high, 3] - sums[low, 3])
            n4 = sums[low, 4] + part * (sums[high, 4] - sums[low, 4])
            result[0, here], result[1, here] = n0 - c0, n1 - c1
            result[3, here], result[4, here] = n3 - m0, n4 - m1
            c0, c1, m0, m1 = n0, n1, n3, n4


@kernel
def count_patch(
    patch: RollingPatch,
    fields: Fields,
    stress_index: FloatArray,
    shear_yield: float,
    limits: BurstowLimits,
    position: float,
    across: float,
    revolutions: float,
    bins: Bins,
    work: CountWork,
    counts: Counts,
) -> None:
    """Add a solved patch to the counts of its wheel (kernel, allocates nothing).

    Parameters
    ----------
    patch, fields
        The patch and its stresses and slip.
    stress_index
        (ny,) largest stress index of every strip [Pa], see `damage.rcf_local`.
    shear_yield
        k [Pa].
    limits
        Burstow's thresholds.
    position
        Of the patch's middle in the coordinate of the bins across [m].
    across
        What a metre along the patch's y axis, to the left, is in that coordinate [-]: below zero on a left
        wheel, whose profile has its coordinate to the right.
    revolutions
        Of the wheel that the state stands for [-].
    bins
        The bins; the patch lies on them.
    work
        Work space.
    counts
        Result, added to.
    """
    cells_y, cells_x = fields.pressure.shape
    total = 0.0
    for pair in range((cells_y + 1) // 2):
        mirror = cells_y - 1 - pair
        lateral = -1.0 + (2 * pair + 1) / cells_y
        cosine = math.sqrt(1.0 - lateral * lateral)
        half_length = patch.a * cosine
        _judge_strip(pair, 0, patch, lateral, half_length, fields, shear_yield, limits, work)
        _judge_strip(mirror, COUNTS, patch, -lateral, half_length, fields, shear_yield, limits, work)
        counting = stress_index[pair] > 0.0 or stress_index[mirror] > 0.0
        _bin_pair(pair, counting, half_length, bins, work)
        total += cosine * work.sums[cells_x, ENERGY]
        if mirror != pair:  # the middle one of an odd number is its own mirror image
            total += cosine * work.sums[cells_x, COUNTS + ENERGY]
    wiped = total * 4.0 * patch.a * patch.b / (cells_x * cells_y) > limits.total
    kept = 0.0 if wiped else 1.0
    width = 2.0 * patch.b / (cells_y * bins.step) * abs(across)
    for strip in range(cells_y):
        mirrored = strip >= (cells_y + 1) // 2
        pair, column = (cells_y - 1 - strip, COUNTS) if mirrored else (strip, 0)
        lateral = -1.0 + (2 * strip + 1) / cells_y
        cell_length = 2.0 * patch.a * math.sqrt(1.0 - lateral * lateral) / cells_x
        middle = (position + across * patch.b * lateral - bins.start) / bins.step
        low, high = middle - 0.5 * width, middle + 0.5 * width
        first, end = work.touched[pair, 0], work.touched[pair, 1]
        counted, corrected = work.bins[pair, column + COUNTED], work.bins[pair, column + CORRECTED]
        energy = work.bins[pair, column + ENERGY]
        for place in range(max(math.floor(low), 0), min(math.floor(high), counts.energy.shape[0] - 1) + 1):
            covered = min(high, place + 1.0) - max(low, float(place))
            weight = revolutions * covered * cell_length / bins.along_step
            rcf_number, left = counts.rcf_number[place], counts.corrected_rcf_number[place]
            lost = counts.energy[place]
            for x in range(first, end):
                lost[x] += weight * energy[x]
            if stress_index[strip] > 0.0:
                for x in range(first, end):
                    rcf_number[x] += weight * counted[x]
                    left[x] += weight * kept * corrected[x]
