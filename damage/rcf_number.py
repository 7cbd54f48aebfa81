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

COUNTED, CORRECTED, ENERGY = 0, 1, 2  # columns of the work spaces
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

    along: FloatArray  # (nx,) middles of the cells along a strip over its half length [-]
    cells: FloatArray  # (3, nx) of a strip
    sums: FloatArray  # (nx + 1, 3) sums of the cells behind each edge between them
    bins: FloatArray  # (ny, 3, X) mean of each strip over the bins along it
    touched: NDArray[np.int64]  # (ny, 2) first bin of each strip, and one beyond the last


def count_work(cells: tuple[int, int], bins_along: int) -> CountWork:
    """Work space for patches of `cells` (along, across) on a number of bins along the patch."""
    nx, ny = cells
    return CountWork(
        (2.0 * np.arange(nx) + 1.0) / nx - 1.0,
        np.zeros((COUNTS, nx)),
        np.zeros((nx + 1, COUNTS)),
        np.zeros((ny, COUNTS, bins_along)),
        np.zeros((ny, 2), dtype=np.int64),
    )


@kernel
def _judge_strip(
    strip: int,
    rigid_x: float,
    rigid_y: float,
    turn: float,
    fields: Fields,
    shear_yield: float,
    limits: BurstowLimits,
    work: CountWork,
) -> None:
    """Count, corrected count and energy of the cells of a strip; the rigid slip is that of its middle."""
    q_x, q_y, slip_x, slip_y = (
        fields.q_x[strip],
        fields.q_y[strip],
        fields.slip_x[strip],
        fields.slip_y[strip],
    )
    counted, corrected, lost = work.cells[COUNTED], work.cells[CORRECTED], work.cells[ENERGY]
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
def _bin_strip(strip: int, half_length: float, bins: Bins, work: CountWork) -> float:
    """Mean of the cells of a strip over each bin along it; returns the sum of their energies."""
    cells, sums, result = work.cells, work.sums, work.bins[strip]
    cells_x = work.along.size
    counted, corrected, energy = 0.0, 0.0, 0.0
    for i in range(cells_x):
        counted += cells[COUNTED, i]
        corrected += cells[CORRECTED, i]
        energy += cells[ENERGY, i]
        sums[i + 1, COUNTED], sums[i + 1, CORRECTED], sums[i + 1, ENERGY] = counted, corrected, energy
    share = 2.0 * half_length / (cells_x * bins.along_step)  # of a bin that a cell covers
    first = max(math.floor((-half_length - bins.along_start) / bins.along_step), 0)
    end = min(math.floor((half_length - bins.along_start) / bins.along_step) + 1, result.shape[1])
    work.touched[strip, 0], work.touched[strip, 1] = first, end
    per_length = 0.5 * cells_x / half_length
    last_counted, last_corrected, last_energy = 0.0, 0.0, 0.0
    for place in range(first, end):
        edge = bins.along_start + (place + 1) * bins.along_step
        reach = min((edge + half_length) * per_length, float(cells_x))
        cell = min(int(reach), cells_x - 1)
        part = reach - cell
        here = sums[cell, COUNTED] + part * cells[COUNTED, cell]
        result[COUNTED, place], last_counted = share * (here - last_counted), here
        here = sums[cell, CORRECTED] + part * cells[CORRECTED, cell]
        result[CORRECTED, place], last_corrected = share * (here - last_corrected), here
        here = sums[cell, ENERGY] + part * cells[ENERGY, cell]
        result[ENERGY, place], last_energy = share * (here - last_energy), here
    return energy


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
    total = 0.0
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        cosine = math.sqrt(1.0 - lateral * lateral)
        half_length = patch.a * cosine
        _judge_strip(
            j, patch.nu_x - patch.phi * patch.b * lateral, patch.nu_y, patch.phi * half_length, fields,
            shear_yield, limits, work,
        )  # fmt: skip
        total += cosine * _bin_strip(j, half_length, bins, work)
    wiped = total * 4.0 * patch.a * patch.b / (cells_x * cells_y) > limits.total
    width = 2.0 * patch.b / cells_y * abs(across)
    for j in range(cells_y):
        middle = position + across * patch.b * (-1.0 + (2 * j + 1) / cells_y)
        low = (middle - 0.5 * width - bins.start) / bins.step
        high = (middle + 0.5 * width - bins.start) / bins.step
        for place in range(max(math.floor(low), 0), min(math.floor(high), counts.energy.shape[0] - 1) + 1):
            weight = revolutions * (min(high, place + 1.0) - max(low, float(place)))
            left = 0.0 if wiped else weight
            for x in range(work.touched[j, 0], work.touched[j, 1]):
                counts.rcf_number[place, x] += weight * work.bins[j, COUNTED, x]
                counts.corrected_rcf_number[place, x] += left * work.bins[j, CORRECTED, x]
                counts.energy[place, x] += weight * work.bins[j, ENERGY, x]
