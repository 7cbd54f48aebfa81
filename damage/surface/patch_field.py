"""Stress and slip over the patch of a contact state: of a tangential theory, or of full slip.

In full slip the whole patch slides in the direction of the creep force: |q| = mu p with the pressure of
Hertz, and the slip is the rigid slip of the creepages. This is the assumption of the shakedown diagram of a
point contact (Hossein-Nia 2018, figure 3-19); the field's force then exceeds the logged one unless that is mu
N.
"""

import math

from damage.cells import cell_middle
from hh_exudyn.contact.normal.hertz import peak_pressure
from hh_exudyn.contact.tangential.registry import FIELD_THEORIES, HALFSPACE, THEORIES, field_kernel
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import kernel

FULL_SLIP = 0  # not a number of `registry.THEORIES`
DAMAGE_THEORIES: dict[str, int] = {name: THEORIES[name] for name in FIELD_THEORIES} | {
    "full_slip": FULL_SLIP,
    "halfspace": HALFSPACE,
}
"""Theories for the stress and slip of a contact state: name to number; the half-space is no kernel
(`damage.surface.halfspace_patch`)."""


def theory_number(theory: str) -> int:
    """Number of a theory for the kernels.

    Raises
    ------
    ValueError
        Unknown theory, or one without a field.
    """
    if theory not in DAMAGE_THEORIES:
        raise ValueError(f"theory = {theory!r}; theories with a slip field: {', '.join(DAMAGE_THEORIES)}")
    return DAMAGE_THEORIES[theory]


@kernel
def _full_slip(patch: RollingPatch, force_x: float, force_y: float, fields: Fields) -> None:
    """Pressure of Hertz, traction along the force at the friction limit, rigid slip."""
    cells_y, cells_x = fields.pressure.shape
    peak = peak_pressure(patch)
    force = math.sqrt(force_x * force_x + force_y * force_y)
    limit_x = patch.friction * force_x / force if force > 0.0 else 0.0
    limit_y = patch.friction * force_y / force if force > 0.0 else 0.0
    for j in range(cells_y):
        lateral = cell_middle(j, cells_y)
        cosine = math.sqrt(1.0 - lateral * lateral)
        for i in range(cells_x):
            xi = cell_middle(i, cells_x)
            pressure = peak * cosine * math.sqrt(1.0 - xi * xi)
            fields.pressure[j, i] = pressure
            fields.q_x[j, i], fields.q_y[j, i] = limit_x * pressure, limit_y * pressure
            fields.slip_x[j, i] = patch.nu_x - patch.phi * patch.b * lateral
            fields.slip_y[j, i] = patch.nu_y + patch.phi * patch.a * cosine * xi


@kernel
def patch_field(theory: int, patch: RollingPatch, force_x: float, force_y: float, fields: Fields) -> None:
    """Fill pressure, traction on the wheel and slip over V (kernel, allocates nothing).

    Parameters
    ----------
    theory
        A value of `DAMAGE_THEORIES`, but not the half-space's.
    patch
        The patch; its normal force is above zero.
    force_x, force_y
        Creep force on the wheel: the direction of full slip [N].
    fields
        (ny, nx) result, on the grid of `hh_exudyn.contact.tangential.api`.
    """
    if theory == FULL_SLIP:
        _full_slip(patch, force_x, force_y, fields)
    else:
        field_kernel(theory, patch, fields)
