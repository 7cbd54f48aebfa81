"""The energy that friction dissipates in the contact, per distance rolled: of the patch and of its cells.

Tractions and forces act on the wheel and slip is the wheel's relative to the rail, so the loss is
-(q . s) per area [J/m per m^2 = Pa], never below zero. The elastic part of slip does no net work in steady
rolling: the density's sum over the patch is the wear number of the creepages (equation 3.29).
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from damage.patch_strips import PatchStrips
from damage.wear.law import SolvedPatch
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.tangential.api import TractionField
from hh_exudyn.contact.types import Fields
from hh_exudyn.kernel import inlined_kernel, kernel


def wear_number(
    force_x: ArrayLike,
    force_y: ArrayLike,
    moment_z: ArrayLike,
    nu_x: ArrayLike,
    nu_y: ArrayLike,
    phi: ArrayLike,
) -> NDArray[np.float64]:
    """Energy lost in the creepage per distance rolled [N = J/m], positive for dissipation.

    Hossein-Nia (2018), equation 3.29, with forces on the wheel and creepages of the wheel: hence the minus.

    Parameters
    ----------
    force_x, force_y
        Creep forces on the wheel [N].
    moment_z
        Spin moment on the wheel [N m].
    nu_x, nu_y
        Creepages [-].
    phi
        Spin creepage [1/m].
    """
    terms = [np.asarray(value, dtype=np.float64) for value in (force_x, nu_x, force_y, nu_y, moment_z, phi)]
    loss: NDArray[np.float64] = -(terms[0] * terms[1] + terms[2] * terms[3] + terms[4] * terms[5])  # (3.29)
    return loss


@inlined_kernel
def cell_energy(fields: Fields, j: int, i: int) -> float:
    """Energy dissipated in cell (j, i) per area and distance rolled [Pa] (kernel).

    It follows from the slip of the cell; where it sticks it is 0.

    Parameters
    ----------
    fields
        Arrays (ny, nx) of tractions and slip.
    j, i
        Strip and cell, from 0.
    """
    return -(fields.q_x[j, i] * fields.slip_x[j, i] + fields.q_y[j, i] * fields.slip_y[j, i])


def energy_density(field: TractionField) -> NDArray[np.float64]:
    """Energy dissipated per area and distance rolled in the cells of a field (ny, nx) [Pa]; 0 in stick."""
    density: NDArray[np.float64] = -(field.q_x * field.slip_x + field.q_y * field.slip_y)
    return density


def rigid_energy_density(field: TractionField, nu_x: float, nu_y: float, phi: float) -> NDArray[np.float64]:
    """Energy of the tractions on the rigid slip per area and distance rolled (ny, nx) [Pa], equation 3.34.

    Creepages [-], [-], [1/m]. Its sum over the patch is that of `energy_density`, but in stick it is not zero
    and may be negative: there it is not lost but stored and given back.

    Parameters
    ----------
    field
        Tractions [Pa] and grid [m] of the patch.
    nu_x, nu_y, phi
        Creepages [-], [-], [1/m].
    """
    density: NDArray[np.float64] = -(field.q_x * (nu_x - phi * field.y) + field.q_y * (nu_y + phi * field.x))
    return density


@kernel
def strip_energies(strips: PatchStrips, fields: Fields, energies: FloatArray) -> float:
    """Write the energy dissipated per distance rolled in each strip [N]; returns their sum [N] (kernel).

    Parameters
    ----------
    strips, fields
        The strips (ny,) of a patch, and its tractions and slip (ny, nx).
    energies
        (ny,) result [N].
    """
    cells_y, cells_x = fields.pressure.shape
    q_x, q_y, slip_x, slip_y = fields.q_x, fields.q_y, fields.slip_x, fields.slip_y
    total = 0.0
    for j in range(cells_y):
        density = 0.0
        for i in range(cells_x):
            density -= q_x[j, i] * slip_x[j, i] + q_y[j, i] * slip_y[j, i]
        energies[j] = density * 2.0 * strips.half_length[j] * strips.width[j] / cells_x
        total += energies[j]
    return total


@kernel
def energies_of_strips(solved: SolvedPatch, depth: FloatArray) -> float:
    """Energy that a patch dissipates per distance rolled [N], above zero; 0 where nothing slips.

    Parameters
    ----------
    solved
        The patch.
    depth
        (ny, REGIMES) result: the energies of the strips [N] in the first column, the others zero.
    """
    depth[:] = 0.0
    energy = strip_energies(solved.strips, solved.fields, depth[:, 0])
    if energy > 0.0:
        return energy
    depth[:] = 0.0
    return 0.0


@kernel
def depths_by_energy(
    regime: int, volume: float, energy: float, strips: PatchStrips, depth: FloatArray
) -> None:
    """Distribute a worn volume over the strips of a patch in proportion to their energies (kernel).

    Parameters
    ----------
    regime
        Column of `depth` for the result.
    volume
        Worn off per metre rolled [m^3/m].
    energy
        Dissipated by the whole patch per metre rolled [N], > 0.
    strips
        (ny,) strips of the patch.
    depth
        (ny, REGIMES); its first column holds the energies of the strips [N], the others are zero; result:
        wear depth per revolution [m].
    """
    volume_per_energy = volume / energy
    for j in range(depth.shape[0]):
        dissipated = depth[j, 0]
        depth[j, 0] = 0.0
        depth[j, regime] = dissipated * volume_per_energy / strips.width[j]
