"""The RCF number: revolutions of the wheel in which a place of patch and profile lay beyond shakedown.

Threshold counting (Hossein-Nia 2018, section 3.3): every contact state adds its revolutions to the cells with
SI = |q| - k > 0 (equation 3.21). The places are bins, across over the wheel profile and
along the rolling direction fixed to the patch; a bin covered in part gets that share of the count, so
the sum over bins times their area is revolutions times the area beyond shakedown. The same is counted with
Burstow's correction (`damage.rcf.burstow`), and the energy lost in each bin is summed,

    e = -(q_x (nu_x - phi y) + q_y (nu_y + phi x))    [J per metre rolled and m^2 = Pa]               (3.34)

with the rigid slip of the creepages: the elastic part of the slip changes the distribution of the energy, not
its sum.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from damage.cells import cell_middle, cell_middles
from damage.rcf.burstow import BurstowLimits, remaining
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import inlined_kernel, kernel

COUNTED, CORRECTED, ENERGY = 0, 1, 2  # columns of the counts and, twice, of the work spaces
COLUMNS = 4  # the last stays zero: four numbers in a row are one vector of the processor
PAIR = 2 * COLUMNS  # of a strip, and again of its mirror image


class Bins(NamedTuple):
    """The bins across the profile and along the patch."""

    start: float  # edge of the first bin across the profile [m]
    step: float  # [m]
    along_start: float  # rear edge of the first bin along the patch [m]
    along_step: float  # [m]


class Spot(NamedTuple):
    """Place of a patch on the bins, and the rolling in the interval of its contact state."""

    position: float  # of its middle in the coordinate of the bins across [m]
    across: float  # of a metre along its y axis, to the left, in that coordinate [-]; < 0 on a left wheel
    revolutions: float  # of the wheel [-]
    rolled: float  # distance [m]


class CountWork(NamedTuple):
    """Work space for one patch.

    Two strips at equal distances left and right of the middle have the same length and are binned together.
    """

    along: FloatArray  # (nx,) middles of the cells along a strip over its half length [-]
    cells: FloatArray  # (2, nx * COLUMNS) of two strips, cell by cell
    sums: FloatArray  # (nx + 1, PAIR) running sums of the cells up to each edge, from the trailing end
    bins: FloatArray  # (pairs, 2, X, COLUMNS) sums of the cells in each bin along, with parts of cells
    touched: NDArray[np.int64]  # (pairs, 2) first bin of each pair, and one beyond the last


def count_work(cells: tuple[int, int], bins_along: int) -> CountWork:
    """Work space for patches of `cells` (along, across) on a number of bins along the patch.

    Parameters
    ----------
    cells, bins_along
        Cells of a patch along and across, and bins along it.
    """
    nx, ny = cells
    pairs = (ny + 1) // 2
    return CountWork(
        cell_middles(nx),
        np.zeros((2, nx * COLUMNS)),
        np.zeros((nx + 1, PAIR)),
        np.zeros((pairs, 2, bins_along, COLUMNS)),
        np.zeros((pairs, 2), dtype=np.int64),
    )


@inlined_kernel
def _judge_strip(
    strip: int,
    image: int,
    counting: bool,
    patch: RollingPatch,
    lateral: float,
    half_length: float,
    fields: Fields,
    shear_yield: float,
    limits: BurstowLimits,
    work: CountWork,
) -> None:
    """Count, corrected count and energy of the cells of a strip at y/b = lateral; image 1 is the mirror's.

    Without `counting` only the energy is computed: no cell is beyond the shear yield.
    """
    against_x, against_y = patch.phi * patch.b * lateral - patch.nu_x, -patch.nu_y  # the rigid slip, reversed
    turn = -patch.phi * half_length
    q_x, q_y, result = fields.q_x[strip], fields.q_y[strip], work.cells[image]
    if not counting:
        for i in range(work.along.size):
            energy = q_x[i] * against_x + q_y[i] * (against_y + turn * work.along[i])  # (3.34)
            n = i * COLUMNS
            result[n], result[n + 1], result[n + 2], result[n + 3] = 0.0, 0.0, energy, 0.0
        return
    slip_x, slip_y = fields.slip_x[strip], fields.slip_y[strip]
    square_of_yield = shear_yield * shear_yield
    for i in range(work.along.size):  # no branch, no sum: the compiler makes vectors of it
        energy = q_x[i] * against_x + q_y[i] * (against_y + turn * work.along[i])  # (3.34)
        count = 1.0 if q_x[i] * q_x[i] + q_y[i] * q_y[i] > square_of_yield else 0.0  # (3.21)
        left = remaining(energy, limits)
        slips = (slip_x[i] != 0.0) | (slip_y[i] != 0.0)
        corrected = count * (left if slips else 1.0)
        n = i * COLUMNS
        result[n], result[n + 1], result[n + 2], result[n + 3] = count, corrected, energy, 0.0


@inlined_kernel
def _bin_pair(pair: int, half_length: float, bins: Bins, work: CountWork) -> None:
    """Sum the cells of two strips of the same length over each bin along them.

    The columns are written out one by one, all read before any is written: only then does the compiler
    use two vectors.
    """
    cells, mirrored, sums, result = work.cells[0], work.cells[1], work.sums, work.bins[pair, 0]
    mirrored_result = work.bins[pair, 1]
    cells_x = work.along.size
    s0, s1, s2, s3, s4, s5, s6, s7 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(cells_x):
        n = i * COLUMNS
        s0 += cells[n]
        s1 += cells[n + 1]
        s2 += cells[n + 2]
        s3 += cells[n + 3]
        s4 += mirrored[n]
        s5 += mirrored[n + 1]
        s6 += mirrored[n + 2]
        s7 += mirrored[n + 3]
        sums[i + 1, 0], sums[i + 1, 1], sums[i + 1, 2], sums[i + 1, 3] = s0, s1, s2, s3
        sums[i + 1, 4], sums[i + 1, 5], sums[i + 1, 6], sums[i + 1, 7] = s4, s5, s6, s7
    first = max(math.floor((-half_length - bins.along_start) / bins.along_step), 0)
    end = min(math.floor((half_length - bins.along_start) / bins.along_step) + 1, result.shape[0])
    work.touched[pair, 0], work.touched[pair, 1] = first, end
    per_length = 0.5 * cells_x / half_length
    s0, s1, s2, s3, s4, s5, s6, s7 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for place in range(first, end):
        edge = bins.along_start + (place + 1) * bins.along_step
        reach = min((edge + half_length) * per_length, float(cells_x))
        low = np.uint64(min(int(reach), cells_x - 1))
        high, part, here = low + np.uint64(1), reach - low, np.uint64(place)
        n0 = sums[low, 0] + part * (sums[high, 0] - sums[low, 0])
        n1 = sums[low, 1] + part * (sums[high, 1] - sums[low, 1])
        n2 = sums[low, 2] + part * (sums[high, 2] - sums[low, 2])
        n3 = sums[low, 3] + part * (sums[high, 3] - sums[low, 3])
        n4 = sums[low, 4] + part * (sums[high, 4] - sums[low, 4])
        n5 = sums[low, 5] + part * (sums[high, 5] - sums[low, 5])
        n6 = sums[low, 6] + part * (sums[high, 6] - sums[low, 6])
        n7 = sums[low, 7] + part * (sums[high, 7] - sums[low, 7])
        result[here, 0], result[here, 1] = n0 - s0, n1 - s1
        result[here, 2], result[here, 3] = n2 - s2, n3 - s3
        mirrored_result[here, 0], mirrored_result[here, 1] = n4 - s4, n5 - s5
        mirrored_result[here, 2], mirrored_result[here, 3] = n6 - s6, n7 - s7
        s0, s1, s2, s3, s4, s5, s6, s7 = n0, n1, n2, n3, n4, n5, n6, n7


@inlined_kernel
def _add_row(
    first: int, end: int, weight: float, corrected: float, binned: FloatArray, row: FloatArray
) -> None:
    """Add the bins of a strip to those of the wheel: a vector at a time, as in `_bin_pair`."""
    for x in range(first, end):
        c0 = row[x, 0] + weight * binned[x, 0]
        c1 = row[x, 1] + corrected * binned[x, 1]
        c2 = row[x, 2] + weight * binned[x, 2]
        c3 = row[x, 3] + weight * binned[x, 3]
        row[x, 0], row[x, 1], row[x, 2], row[x, 3] = c0, c1, c2, c3


@kernel
def count_patch(
    patch: RollingPatch,
    fields: Fields,
    fatigue_index: FloatArray,
    shear_yield: float,
    limits: BurstowLimits,
    spot: Spot,
    bins: Bins,
    work: CountWork,
    counts: FloatArray,
) -> None:
    """Add a solved patch to the counts of its wheel (kernel, allocates nothing).

    Parameters
    ----------
    patch, fields
        The patch and its stresses and slip.
    fatigue_index
        (ny,) largest fatigue index of every strip [-], see `damage.rcf.local`: above zero where cells count.
    shear_yield
        k [Pa].
    limits
        Burstow's thresholds.
    spot
        Place of the patch, and its revolutions.
    bins
        The bins; the patch lies on them.
    work
        Work space.
    counts
        (bins across, bins along, COLUMNS) result, added to: revolutions with SI > 0 [-]; the same after
        Burstow's correction [-]; the sum over the revolutions of e [Pa]; zero.
    """
    cells_y, cells_x = fields.pressure.shape
    total = 0.0
    for pair in range((cells_y + 1) // 2):
        mirror = cells_y - 1 - pair
        lateral = cell_middle(pair, cells_y)
        cosine = math.sqrt(1.0 - lateral * lateral)
        half_length = patch.a * cosine
        counting = fatigue_index[pair] > 0.0
        _judge_strip(pair, 0, counting, patch, lateral, half_length, fields, shear_yield, limits, work)
        counting = fatigue_index[mirror] > 0.0
        _judge_strip(mirror, 1, counting, patch, -lateral, half_length, fields, shear_yield, limits, work)
        _bin_pair(pair, half_length, bins, work)
        total += cosine * work.sums[cells_x, ENERGY]
        if mirror != pair:  # the middle one of an odd number is its own mirror image
            total += cosine * work.sums[cells_x, COLUMNS + ENERGY]
    wiped = total * 4.0 * patch.a * patch.b / (cells_x * cells_y) > limits.total
    remains = 0.0 if wiped else 1.0
    width = 2.0 * patch.b / (cells_y * bins.step) * abs(spot.across)
    for strip in range(cells_y):
        mirrored = strip >= (cells_y + 1) // 2
        pair, image = (cells_y - 1 - strip, 1) if mirrored else (strip, 0)
        lateral = cell_middle(strip, cells_y)
        cell_length = 2.0 * patch.a * math.sqrt(1.0 - lateral * lateral) / cells_x
        middle = (spot.position + spot.across * patch.b * lateral - bins.start) / bins.step
        low, high = middle - 0.5 * width, middle + 0.5 * width
        first, end = work.touched[pair, 0], work.touched[pair, 1]
        binned = work.bins[pair, image]
        for place in range(max(math.floor(low), 0), min(math.floor(high), counts.shape[0] - 1) + 1):
            covered = min(high, place + 1.0) - max(low, float(place))
            weight = spot.revolutions * covered * cell_length / bins.along_step
            _add_row(first, end, weight, weight * remains, binned, counts[place])
