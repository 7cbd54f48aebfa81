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

from damage.burstow import BurstowLimits, remaining
from hh_exudyn.contact.types import Fields, FloatArray, RollingPatch
from hh_exudyn.kernel import inlined_kernel, kernel

COUNTED, CORRECTED, ENERGY = 0, 1, 2  # rows of the work spaces
COUNTS = 3


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
    """Work space for one patch."""

    cells: FloatArray  # (3, nx) of a strip's cells
    bins: FloatArray  # (3, bins along) of a strip


@kernel
def patch_energy(patch: RollingPatch, fields: Fields, columns: FloatArray) -> float:
    """Energy that a patch loses per metre rolled [N = J/m], (3.34) summed over its cells.

    `columns` is work space, (nx,): sums that run side by side, which the compiler makes vectors of.
    """
    cells_y, cells_x = fields.pressure.shape
    q_x, q_y = fields.q_x, fields.q_y
    columns[:] = 0.0
    step = 2.0 / cells_x
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        cosine = math.sqrt(1.0 - lateral * lateral)
        rigid_x, turn = patch.nu_x - patch.phi * patch.b * lateral, patch.phi * patch.a * cosine
        for i in range(cells_x):
            rigid_y = patch.nu_y + turn * ((i + 0.5) * step - 1.0)
            columns[i] -= cosine * (q_x[j, i] * rigid_x + q_y[j, i] * rigid_y)
    total = 0.0
    for i in range(cells_x):
        total += columns[i]
    return total * 4.0 * patch.a * patch.b / (cells_x * cells_y)


@inlined_kernel
def _judge_cells(
    strip: int,
    rigid_x: float,
    rigid_y: float,
    turn: float,
    fields: Fields,
    shear_yield: float,
    limits: BurstowLimits,
    cells: FloatArray,
) -> None:
    """Count, corrected count and energy of the cells of a strip; `rigid_y` is that of its middle."""
    q_x, q_y, slip_x, slip_y = fields.q_x, fields.q_y, fields.slip_x, fields.slip_y
    cells_x = q_x.shape[1]
    step = 2.0 / cells_x
    square_of_yield = shear_yield * shear_yield
    for i in range(cells_x):
        q1, q2, s1, s2 = q_x[strip, i], q_y[strip, i], slip_x[strip, i], slip_y[strip, i]
        energy = -(q1 * rigid_x + q2 * (rigid_y + turn * ((i + 0.5) * step - 1.0)))  # (3.34)
        count = 1.0 if q1 * q1 + q2 * q2 > square_of_yield else 0.0  # (3.21)
        left = remaining(energy, limits) if s1 * s1 + s2 * s2 > 0.0 else 1.0
        cells[COUNTED, i] = count
        cells[CORRECTED, i] = count * left
        cells[ENERGY, i] = energy


@inlined_kernel
def _bin_cells(cells: FloatArray, half_length: float, bins: Bins, result: FloatArray) -> tuple[int, int]:
    """Mean of the strip's cells over each bin along it, zero beyond the strip; first and last bin touched."""
    cells_x = cells.shape[1]
    share = 2.0 * half_length / (cells_x * bins.along_step)  # of a bin that a cell covers
    first = max(math.floor((-half_length - bins.along_start) / bins.along_step), 0)
    last = min(math.floor((half_length - bins.along_start) / bins.along_step), result.shape[1] - 1)
    low, part = 0, 0.0  # the cell with the bin's rear edge, and how much of it lies behind the edge
    for place in range(first, last + 1):
        edge = bins.along_start + (place + 1) * bins.along_step
        reach = min(max((edge / half_length + 1.0) * 0.5 * cells_x, 0.0), float(cells_x))
        high = min(int(reach), cells_x - 1)
        rest = reach - high
        for row in range(COUNTS):
            total = rest * cells[row, high] - part * cells[row, low]
            for i in range(low, high):
                total += cells[row, i]
            result[row, place] = total * share
        low, part = high, rest
    return first, last


@kernel
def count_patch(
    patch: RollingPatch,
    fields: Fields,
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
    wiped = patch_energy(patch, fields, work.cells[0]) > limits.total
    width = 2.0 * patch.b / cells_y * abs(across)
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        half_length = patch.a * math.sqrt(1.0 - lateral * lateral)
        _judge_cells(
            j, patch.nu_x - patch.phi * patch.b * lateral, patch.nu_y, patch.phi * half_length, fields,
            shear_yield, limits, work.cells,
        )  # fmt: skip
        first, last = _bin_cells(work.cells, half_length, bins, work.bins)
        middle = position + across * patch.b * lateral
        low = (middle - 0.5 * width - bins.start) / bins.step
        high = (middle + 0.5 * width - bins.start) / bins.step
        for place in range(max(math.floor(low), 0), min(math.floor(high), counts.energy.shape[0] - 1) + 1):
            weight = revolutions * (min(high, place + 1.0) - max(low, float(place)))
            left = 0.0 if wiped else weight
            for x in range(first, last + 1):
                counts.rcf_number[place, x] += weight * work.bins[COUNTED, x]
                counts.corrected_rcf_number[place, x] += left * work.bins[CORRECTED, x]
                counts.energy[place, x] += weight * work.bins[ENERGY, x]
