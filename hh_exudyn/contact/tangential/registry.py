"""The tangential theories: one record each, and the kernels that call a theory by its number.

A theory is a file of kernels with `force(patch, ...)` and, where it has one, `field(patch, fields)`; here a
number, a record in `TANGENTIAL` and a line in `force_kernel`, `field_kernel` or `strips_kernel`. Case schema,
command line, damage and the table of `validation` follow from the records. A theory that is no kernel
(`Theory.in_kernels`) is known to `api` only: to `creep_force`, `traction_field` and what is made of them.

Errors against the exact solution: `validation`. In every field friction dissipates the power of the
creepages, summed over the cells (to rounding; where the slip zone is shorter than a cell, nothing slips); the
power of `force_kernel`'s own sums differs from it by 0.04 to 0.3 % of itself at 50 x 50 cells.
"""

import math
from typing import NamedTuple

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.tangential import carter, fastrip, fastsim, linear, polach, strip
from hh_exudyn.contact.tangential.strips import scale_slip
from hh_exudyn.contact.types import Fields, RollingPatch, Triple
from hh_exudyn.kernel import inlined_kernel, kernel

FASTSIM = 1
FASTRIP = 2
CARTER = 3
LINEAR = 4
STRIP = 5
POLACH = 6
FASTSIM_SINGLE = 7
FASTSIM_ELLIPTIC = 8
GIVEN = 9
HALFSPACE = 10


class Theory(NamedTuple):
    """A tangential theory."""

    number: int  # in kernels; 0 is no theory
    name: str
    meaning: str  # with its source and omissions
    has_field: bool = True  # whether it gives stress and slip over the patch, or forces only
    has_moment: bool = True  # whether it gives a spin moment
    takes_strips: bool = False  # whether it takes patches of any shape
    in_runs: bool = True  # whether a case may name it
    of_patch: bool = True  # whether its forces follow from the patch, or from the model (`given`)
    in_kernels: bool = True  # whether `force_kernel` knows it: else it is too slow for a run


TANGENTIAL = (
    Theory(
        CARTER,
        "carter",
        "line contact, Carter 1926; no lateral creepage, no spin",
        has_moment=False,
        in_runs=False,
    ),
    Theory(
        LINEAR,
        "linear",
        "Kalker's linear theory, 1967; no friction limit",
        has_field=False,
        in_runs=False,
    ),
    Theory(STRIP, "strip", "strip theory, Haines and Ollerton 1963, Kalker 1967; no b/a, no large spin"),
    Theory(FASTSIM, "fastsim", "FASTSIM, Kalker 1982, three flexibilities", takes_strips=True),
    Theory(
        FASTSIM_SINGLE,
        "fastsim_single",
        "FASTSIM, Kalker 1982, one weighted flexibility",
        takes_strips=True,
    ),
    Theory(
        FASTSIM_ELLIPTIC,
        "fastsim_elliptic",
        "FASTSIM, three flexibilities, Hertz's pressure",
        takes_strips=True,
    ),
    Theory(FASTRIP, "fastrip", "FaStrip, Sichani, Enblom and Berg 2016", takes_strips=True),
    Theory(
        POLACH,
        "polach",
        "Polach 1999, closed formulas; no spin moment",
        has_field=False,
        has_moment=False,
    ),
    Theory(
        HALFSPACE,
        "halfspace",
        "exact half-space theory, Kalker 1979, solved by `halfspace`; not in runs",
        in_runs=False,
        in_kernels=False,
    ),
    Theory(
        GIVEN,
        "given",
        "coefficients and conicity that the vehicle states (`given`)",
        has_field=False,
        has_moment=False,
        of_patch=False,
    ),
)
THEORIES: dict[str, int] = {
    theory.name: theory.number for theory in TANGENTIAL if theory.of_patch and theory.in_kernels
}
FIELD_THEORIES = tuple(theory.name for theory in TANGENTIAL if theory.has_field and theory.in_kernels)
PATCH_THEORIES = tuple(theory.name for theory in TANGENTIAL if theory.of_patch)  # those of `api`
PATCH_FIELD_THEORIES = tuple(theory.name for theory in TANGENTIAL if theory.of_patch and theory.has_field)
STRIP_THEORIES = tuple(theory.name for theory in TANGENTIAL if theory.takes_strips)
RUN_THEORIES = tuple(theory.name for theory in TANGENTIAL if theory.in_runs)
_NO_CREEPAGE = 1e-60  # smaller creepages, which would underflow when squared, count as zero [-]


@inlined_kernel
def _creeping(patch: RollingPatch, nu_x: float, nu_y: float, phi: float, friction: float) -> RollingPatch:
    """The same patch with other creepages and friction."""
    return RollingPatch(
        patch.a,
        patch.b,
        patch.normal_force,
        nu_x,
        nu_y,
        phi,
        friction,
        patch.shear_modulus,
        patch.poisson_ratio,
    )


@inlined_kernel
def _creeps(patch: RollingPatch) -> bool:
    """Whether there is any creepage."""
    return abs(patch.nu_x) + abs(patch.nu_y) + (patch.a + patch.b) * abs(patch.phi) >= _NO_CREEPAGE


@kernel
def solvable(patch: RollingPatch) -> bool:
    """Whether a patch has a creep force: load, friction, area and creepage."""
    loaded = patch.normal_force > 0.0 and patch.friction > 0.0 and patch.a > 0.0 and patch.b > 0.0
    return loaded and _creeps(patch)


@kernel
def force_kernel(theory: int, patch: RollingPatch, cells_x: int, cells_y: int) -> Triple:
    """Creep force and moment on the wheel (kernel: trusts its input, allocates nothing).

    Parameters
    ----------
    theory : int
        A value of `THEORIES`; anything else gives NaN.
    patch : RollingPatch
        Size, load, creepages and material.
    cells_x, cells_y : int
        Cells along each strip, and strips.

    Returns
    -------
    tuple of float
        F_x [N], F_y [N], M_z [N m]; zero without normal force, creepage, friction or area.
    """
    if not solvable(patch):
        return 0.0, 0.0, 0.0
    if theory == FASTRIP:
        return fastrip.force(patch, cells_x, cells_y)
    if theory in (FASTSIM, FASTSIM_SINGLE, FASTSIM_ELLIPTIC):
        return fastsim.force(patch, theory == FASTSIM_SINGLE, theory == FASTSIM_ELLIPTIC, cells_x, cells_y)
    if theory == STRIP:
        return strip.force(patch, cells_y)
    if theory == CARTER:
        return carter.force(patch)
    if theory == LINEAR:
        return linear.force(patch)
    if theory == POLACH:
        return polach.force(patch, 1.0, 1.0)
    return math.nan, math.nan, math.nan


@inlined_kernel
def strips_kernel(theory: int, strips: FloatArray, patch: RollingPatch, cells_x: int) -> Triple:
    """Creep force and moment of a patch of strips (kernel: trusts its input, allocates nothing).

    Parameters
    ----------
    theory : int
        The number of a theory that takes strips; anything else gives NaN.
    strips : FloatArray
        (n, STRIP_COLUMNS), see `strips`.
    patch : RollingPatch
        Load, creepages, material and the equivalent ellipse.
    cells_x : int
        Cells along each strip.

    Returns
    -------
    tuple of float
        F_x [N], F_y [N], M_z [N m]; zero without friction or creepage.
    """
    if not solvable(patch):
        return 0.0, 0.0, 0.0
    if theory == FASTRIP:
        return fastrip.force_on_strips(strips, strips.shape[0], patch, cells_x)
    if theory in (FASTSIM, FASTSIM_SINGLE, FASTSIM_ELLIPTIC):
        return fastsim.force_on_strips(
            strips, patch, theory == FASTSIM_SINGLE, theory == FASTSIM_ELLIPTIC, cells_x
        )
    return math.nan, math.nan, math.nan


@kernel
def _rigid_slip(patch: RollingPatch, fields: Fields) -> None:
    """Fill the rigid slip nu_x - phi y, nu_y + phi x of a field's grid [-]."""
    cells_y, cells_x = fields.slip_x.shape
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        half_length = patch.a * math.sqrt(1.0 - lateral * lateral)
        for i in range(cells_x):
            x = half_length * (-1.0 + (2 * i + 1) / cells_x)
            fields.slip_x[j, i] = patch.nu_x - patch.phi * patch.b * lateral
            fields.slip_y[j, i] = patch.nu_y + patch.phi * x


@kernel
def _balance(patch: RollingPatch, fields: Fields) -> None:
    """Scale the slip so that friction dissipates, summed over the cells, the power of the creepages.

    The elastic part of slip does no net work in steady rolling; sampled in cells, a closed formula
    deviates from that by a few per cent at 50 x 50 cells, and entirely where the slip zone is shorter than a
    cell (then no cell slips and nothing is scaled).
    """
    _, q_x, q_y, slip_x, slip_y = fields
    cells_y, cells_x = slip_x.shape
    work, power = 0.0, 0.0
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        cosine = math.sqrt(1.0 - lateral * lateral)
        for i in range(cells_x):
            x = patch.a * cosine * (-1.0 + (2 * i + 1) / cells_x)
            rigid_x, rigid_y = patch.nu_x - patch.phi * patch.b * lateral, patch.nu_y + patch.phi * x
            work += cosine * (q_x[j, i] * slip_x[j, i] + q_y[j, i] * slip_y[j, i])
            power += cosine * (q_x[j, i] * rigid_x + q_y[j, i] * rigid_y)
    if work < 0.0 and power < 0.0:
        scale_slip(power / work, slip_x, slip_y)


@kernel
def _fill(fields: Fields, value: float) -> None:
    """The same number everywhere."""
    for array in fields:
        array[:] = value


@kernel
def field_kernel(theory: int, patch: RollingPatch, fields: Fields) -> None:
    """Fill pressure, traction on the wheel and slip over V on the module's grid (kernel, allocates nothing).

    Zero everywhere without normal force or area, NaN for a theory without a field.

    Parameters
    ----------
    theory, patch
        As in `force_kernel`.
    fields : Fields
        (ny, nx) arrays, result [Pa], [-].
    """
    if not (patch.normal_force > 0.0 and patch.a > 0.0 and patch.b > 0.0):
        _fill(fields, 0.0)
        return
    rigid, frictionless = patch, not patch.friction > 0.0
    if frictionless:  # the pressure of the patch that does not creep, and the rigid slip
        patch = _creeping(patch, 0.0, 0.0, 0.0, 1.0)
    elif not _creeps(patch):
        patch = _creeping(patch, 0.0, 0.0, 0.0, patch.friction)
    if theory == FASTRIP:
        fastrip.field(patch, fields)
    elif theory in (FASTSIM, FASTSIM_SINGLE, FASTSIM_ELLIPTIC):
        fastsim.field(patch, theory == FASTSIM_SINGLE, theory == FASTSIM_ELLIPTIC, fields)
    elif theory == STRIP:
        strip.field(patch, fields)
        _balance(patch, fields)
    elif theory == CARTER:
        carter.field(patch, fields)
        _balance(_creeping(patch, patch.nu_x, 0.0, 0.0, patch.friction), fields)
    else:
        _fill(fields, math.nan)
    if frictionless:
        _rigid_slip(rigid, fields)
