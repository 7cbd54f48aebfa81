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

from damage.cells import cell_middles
from damage.patch_strips import PatchStrips
from damage.rcf.burstow import BurstowLimits, remaining
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.types import Fields
from hh_exudyn.kernel import inlined_kernel, kernel

COUNTED, CORRECTED, ENERGY = 0, 1, 2  # columns of the counts and of the work spaces
COLUMNS = 4  # the last stays zero: four numbers in a row are one vector of the processor


class Bins(NamedTuple):
    """The bins across the profile and along the patch."""

    start: float  # edge of the first bin across the profile [m]
    step: float  # [m]
    along_start: float  # rear edge of the first bin along the patch [m]
    along_step: float  # [m]


class CountWork(NamedTuple):
    """Work space for one patch."""

    along: FloatArray  # (nx,) middles of the cells along a strip over its half length [-]
    cells: FloatArray  # (nx * COLUMNS,) of a strip, cell by cell
    sums: FloatArray  # (nx + 1, COLUMNS) running sums of the cells up to each edge, from the trailing end
    bins: FloatArray  # (strips, X, COLUMNS) sums of the cells in each bin along, with parts of cells
    touched: NDArray[np.int64]  # (strips, 2) first bin of each strip, and one beyond the last


def count_work(cells: tuple[int, int], bins_along: int) -> CountWork:
    """Work space for patches of `cells` (along, across) on a number of bins along the patch.

    Parameters
    ----------
    cells, bins_along
        Cells of a patch along and across, and bins along it.
    """
    nx, ny = cells
    return CountWork(
        cell_middles(nx),
        np.zeros(nx * COLUMNS),
        np.zeros((nx + 1, COLUMNS)),
        np.zeros((ny, bins_along, COLUMNS)),
        np.zeros((ny, 2), dtype=np.int64),
    )


@inlined_kernel
def _judge_strip(
    strip: int,
    counting: bool,
    strips: PatchStrips,
    fields: Fields,
    shear_yield: float,
    limits: BurstowLimits,
    work: CountWork,
) -> None:
    """Count, corrected count and energy of the cells of a strip.

    Without `counting` only the energy is computed: no cell is beyond the shear yield.
    """
    against_x, against_y = -strips.nu_x[strip], -strips.nu_y[strip]  # the rigid slip, reversed
    turn = -strips.phi[strip] * strips.half_length[strip]
    q_x, q_y, result = fields.q_x[strip], fields.q_y[strip], work.cells
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
def _bin_strip(strip: int, half_length: float, bins: Bins, work: CountWork) -> None:
    """Sum the cells of a strip in the bins along, with parts of cells.

    Four numbers of a row are written out, so that the compiler makes one vector of them.
    """
    sums, cells, result = work.sums, work.cells, work.bins[strip]
    cells_x = work.along.size
    s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
    for i in range(cells_x):
        n = i * COLUMNS
        s0 += cells[n]
        s1 += cells[n + 1]
        s2 += cells[n + 2]
        s3 += cells[n + 3]
        sums[i + 1, 0], sums[i + 1, 1], sums[i + 1, 2], sums[i + 1, 3] = s0, s1, s2, s3
    first = max(math.floor((-half_length - bins.along_start) / bins.along_step), 0)
    end = min(math.floor((half_length - bins.along_start) / bins.along_step) + 1, result.shape[0])
    work.touched[strip, 0], work.touched[strip, 1] = first, end
    per_length = 0.5 * cells_x / half_length
    s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
    for place in range(first, end):
        edge = bins.along_start + (place + 1) * bins.along_step
        reach = min((edge + half_length) * per_length, float(cells_x))
        low = np.uint64(min(int(reach), cells_x - 1))
        high, part, here = low + np.uint64(1), reach - low, np.uint64(place)
        n0 = sums[low, 0] + part * (sums[high, 0] - sums[low, 0])
        n1 = sums[low, 1] + part * (sums[high, 1] - sums[low, 1])
        n2 = sums[low, 2] + part * (sums[high, 2] - sums[low, 2])
        n3 = sums[low, 3] + part * (sums[high, 3] - sums[low, 3])
        result[here, 0], result[here, 1] = n0 - s0, n1 - s1
        result[here, 2], result[here, 3] = n2 - s2, n3 - s3
        s0, s1, s2, s3 = n0, n1, n2, n3


@inlined_kernel
def _add_row(
    first: int, end: int, weight: float, corrected: float, binned: FloatArray, row: FloatArray
) -> None:
    """Add the bins of a strip to those of the wheel: a vector at a time, as in `_bin_strip`."""
    for x in range(first, end):
        c0 = row[x, 0] + weight * binned[x, 0]
        c1 = row[x, 1] + corrected * binned[x, 1]
        c2 = row[x, 2] + weight * binned[x, 2]
        c3 = row[x, 3] + weight * binned[x, 3]
        row[x, 0], row[x, 1], row[x, 2], row[x, 3] = c0, c1, c2, c3


@kernel
def count_patch(
    strips: PatchStrips,
    fields: Fields,
    fatigue_index: FloatArray,
    shear_yield: float,
    limits: BurstowLimits,
    revolutions: float,
    bins: Bins,
    work: CountWork,
    counts: FloatArray,
) -> None:
    """Add a solved patch to the counts of its wheel (kernel, allocates nothing).

    Parameters
    ----------
    strips, fields
        The strips of the patch, and its stresses and slip.
    fatigue_index
        (ny,) largest fatigue index of every strip [-], see `damage.rcf.local`: above zero where cells count.
    shear_yield
        k [Pa].
    limits
        Burstow's thresholds.
    revolutions
        Of the wheel, in the interval of the contact state [-].
    bins
        The bins; the patch lies on them.
    work
        Work space.
    counts
        (2, bins across, bins along, COLUMNS) result, added to, by part of the wheel: revolutions with SI > 0
        [-]; the same after Burstow's correction [-]; the sum over the revolutions of e [Pa]; zero.
    """
    cells_y, cells_x = fields.pressure.shape
    total = 0.0
    for strip in range(cells_y):
        _judge_strip(strip, fatigue_index[strip] > 0.0, strips, fields, shear_yield, limits, work)
        _bin_strip(strip, strips.half_length[strip], bins, work)
        area = 2.0 * strips.half_length[strip] * strips.width[strip] / cells_x
        total += area * work.sums[cells_x, ENERGY]
    remains = 0.0 if total > limits.total else 1.0  # everything is worn off
    for strip in range(cells_y):
        cell_length = 2.0 * strips.half_length[strip] / cells_x
        width = strips.covered[strip] / bins.step
        low = (strips.position[strip] - bins.start) / bins.step - 0.5 * width
        high = low + width
        first, end = work.touched[strip, 0], work.touched[strip, 1]
        binned, of_part = work.bins[strip], counts[strips.part[strip]]
        for place in range(max(math.floor(low), 0), min(math.floor(high), of_part.shape[0] - 1) + 1):
            covered = min(high, place + 1.0) - max(low, float(place))
            weight = revolutions * covered * cell_length / bins.along_step
            _add_row(first, end, weight, weight * remains, binned, of_part[place])
