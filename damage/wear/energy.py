"""The energy that friction dissipates in the contact, per distance rolled: of the patch and of its cells.

Tractions and forces act on the wheel and slip is the wheel's relative to the rail, so what is lost is
-(q . s) per area [J/m per m^2 = Pa], never below zero. The elastic part of slip does no net work in steady
rolling: the density's sum over the patch is the wear number of the creepages (equation 3.29).
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hh_exudyn.contact.types import Fields, FloatArray
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
    """Energy dissipated in a cell per area and distance rolled [Pa], of the field's own slip."""
    return -(fields.q_x[j, i] * fields.slip_x[j, i] + fields.q_y[j, i] * fields.slip_y[j, i])


@kernel
def energy_density(fields: Fields, energy: FloatArray) -> None:
    """`cell_energy` of every cell into `energy` (ny, nx) [Pa]; 0 in stick."""
    for j in range(energy.shape[0]):
        for i in range(energy.shape[1]):
            energy[j, i] = cell_energy(fields, j, i)
