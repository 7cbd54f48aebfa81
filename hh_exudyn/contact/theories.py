"""The tangential theories by number, and the two kernels that call the one asked for.

==================  =========================================  =====  ======  ==============================
theory              what it is                                 field  moment  what it leaves out
==================  =========================================  =====  ======  ==============================
`carter`            line contact, 1926                         yes    no      lateral creepage and spin
`linear`            Kalker's linear theory, 1967               no     yes     friction limit
`strip`             Haines and Ollerton 1963, Kalker 1967      yes    yes     b/a, large spin
`fastsim`           Kalker 1982, three flexibilities           yes    yes
`fastsim_single`    Kalker 1982, one weighted flexibility      yes    yes
`fastsim_elliptic`  three flexibilities, Hertz pressure        yes    yes
`fastrip`           Sichani, Enblom, Berg 2016                 yes    yes
`polach`            Polach 1999, closed formulas               no     no
==================  =========================================  =====  ======  ==============================

How good each is against the exact solution: `validation`. In every field friction dissipates the power of the
creepages, summed over the cells (to rounding; where the slip zone is shorter than a cell, nothing slips); the
power of `force_kernel`'s own sums differs from it by 0.04 to 0.3 % of itself at 50 x 50 cells.
"""

import math

from hh_exudyn.contact import carter, fastrip, fastsim, linear, polach, strip
from hh_exudyn.contact.types import FloatArray
from hh_exudyn.kernel import kernel

FASTSIM = 1
FASTRIP = 2
CARTER = 3
LINEAR = 4
STRIP = 5
POLACH = 6
FASTSIM_SINGLE = 7
FASTSIM_ELLIPTIC = 8
THEORIES: dict[str, int] = {
    "carter": CARTER,
    "linear": LINEAR,
    "strip": STRIP,
    "fastsim": FASTSIM,
    "fastsim_single": FASTSIM_SINGLE,
    "fastsim_elliptic": FASTSIM_ELLIPTIC,
    "fastrip": FASTRIP,
    "polach": POLACH,
}
WITHOUT_FIELD = ("linear", "polach")  # forces only
FIELD_THEORIES = tuple(name for name in THEORIES if name not in WITHOUT_FIELD)
_NO_CREEPAGE = 1e-60  # creepages below it would underflow when squared; they count as none [-]


@kernel
def force_kernel(
    theory: int,
    a: float,
    b: float,
    normal_force: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    friction: float,
    shear_modulus: float,
    poisson_ratio: float,
    cells_x: int,
    cells_y: int,
) -> tuple[float, float, float]:
    """Creep force and moment on the wheel (kernel: trusts its input, allocates nothing).

    Parameters
    ----------
    theory : int
        A value of `THEORIES`; anything else gives NaN.
    a, b : float
        Semi-axes in rolling direction and lateral [m].
    normal_force : float
        [N].
    nu_x, nu_y : float
        Longitudinal and lateral creepage [-].
    phi : float
        Spin creepage [1/m].
    friction : float
        Friction coefficient [-].
    shear_modulus : float
        [Pa].
    poisson_ratio : float
        [-].
    cells_x, cells_y : int
        Cells along each strip, and strips.

    Returns
    -------
    tuple of float
        F_x [N], F_y [N], M_z [N m]; zero without normal force, creepage, friction or area.
    """
    if not (normal_force > 0.0 and friction > 0.0 and a > 0.0 and b > 0.0):
        return 0.0, 0.0, 0.0
    if abs(nu_x) + abs(nu_y) + (a + b) * abs(phi) < _NO_CREEPAGE:
        return 0.0, 0.0, 0.0
    if theory == FASTRIP:
        return fastrip.force(
            a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio, cells_x, cells_y
        )
    if theory in (FASTSIM, FASTSIM_SINGLE, FASTSIM_ELLIPTIC):
        return fastsim.force(
            a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio,
            theory == FASTSIM_SINGLE, theory == FASTSIM_ELLIPTIC, cells_x, cells_y,
        )  # fmt: skip
    if theory == STRIP:
        return strip.force(
            a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio, cells_y
        )
    if theory == CARTER:
        return carter.force(a, b, normal_force, nu_x, friction, shear_modulus, poisson_ratio)
    if theory == LINEAR:
        return linear.force(a, b, nu_x, nu_y, phi, shear_modulus, poisson_ratio)
    if theory == POLACH:
        return polach.force(
            a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio, 1.0, 1.0
        )
    return math.nan, math.nan, math.nan


@kernel
def _rigid_slip(
    a: float, b: float, nu_x: float, nu_y: float, phi: float, slip_x: FloatArray, slip_y: FloatArray
) -> None:
    """Fill the rigid slip nu_x - phi y, nu_y + phi x of a field's grid [-]."""
    cells_y, cells_x = slip_x.shape
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        half_length = a * math.sqrt(1.0 - lateral * lateral)
        for i in range(cells_x):
            slip_x[j, i] = nu_x - phi * b * lateral
            slip_y[j, i] = nu_y + phi * half_length * (-1.0 + (2 * i + 1) / cells_x)


@kernel
def _balance(
    a: float,
    b: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    q_x: FloatArray,
    q_y: FloatArray,
    slip_x: FloatArray,
    slip_y: FloatArray,
) -> None:
    """Scale the slip so that friction dissipates, summed over the cells, the power of the creepages.

    The elastic part of slip does no net work in steady rolling; sampled in cells, a closed formula misses
    that by a few percent at 50 x 50 cells, and by all of it where the slip zone is shorter than a cell (then
    nothing slips and nothing is scaled).
    """
    cells_y, cells_x = slip_x.shape
    work, power = 0.0, 0.0
    for j in range(cells_y):
        lateral = -1.0 + (2 * j + 1) / cells_y
        cosine = math.sqrt(1.0 - lateral * lateral)
        for i in range(cells_x):
            x = a * cosine * (-1.0 + (2 * i + 1) / cells_x)
            rigid_x, rigid_y = nu_x - phi * b * lateral, nu_y + phi * x
            work += cosine * (q_x[j, i] * slip_x[j, i] + q_y[j, i] * slip_y[j, i])
            power += cosine * (q_x[j, i] * rigid_x + q_y[j, i] * rigid_y)
    if work < 0.0 and power < 0.0:
        for j in range(cells_y):
            for i in range(cells_x):
                slip_x[j, i] *= power / work
                slip_y[j, i] *= power / work


@kernel
def field_kernel(
    theory: int,
    a: float,
    b: float,
    normal_force: float,
    nu_x: float,
    nu_y: float,
    phi: float,
    friction: float,
    shear_modulus: float,
    poisson_ratio: float,
    pressure: FloatArray,
    q_x: FloatArray,
    q_y: FloatArray,
    slip_x: FloatArray,
    slip_y: FloatArray,
) -> None:
    """Fill pressure, traction on the wheel and slip over V on the module's grid (kernel, allocates nothing).

    The arguments up to `poisson_ratio` are those of `force_kernel`; the arrays are (ny, nx) and are
    overwritten. Zero everywhere without normal force or area, NaN for a theory without a field.
    """
    if not (normal_force > 0.0 and a > 0.0 and b > 0.0):
        pressure[:], q_x[:], q_y[:], slip_x[:], slip_y[:] = 0.0, 0.0, 0.0, 0.0, 0.0
        return
    if not friction > 0.0:
        # without friction: the pressure of the patch that does not creep, and the rigid slip
        field_kernel(
            theory, a, b, normal_force, 0.0, 0.0, 0.0, 1.0, shear_modulus, poisson_ratio,
            pressure, q_x, q_y, slip_x, slip_y,
        )  # fmt: skip
        _rigid_slip(a, b, nu_x, nu_y, phi, slip_x, slip_y)
        return
    if abs(nu_x) + abs(nu_y) + (a + b) * abs(phi) < _NO_CREEPAGE:
        nu_x, nu_y, phi = 0.0, 0.0, 0.0
    if theory == FASTRIP:
        fastrip.field(
            a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio,
            pressure, q_x, q_y, slip_x, slip_y,
        )  # fmt: skip
    elif theory in (FASTSIM, FASTSIM_SINGLE, FASTSIM_ELLIPTIC):
        fastsim.field(
            a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio,
            theory == FASTSIM_SINGLE, theory == FASTSIM_ELLIPTIC, pressure, q_x, q_y, slip_x, slip_y,
        )  # fmt: skip
    elif theory == STRIP:
        strip.field(
            a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio,
            pressure, q_x, q_y, slip_x, slip_y,
        )  # fmt: skip
        _balance(a, b, nu_x, nu_y, phi, q_x, q_y, slip_x, slip_y)
    elif theory == CARTER:
        carter.field(
            a, b, normal_force, nu_x, friction, shear_modulus, poisson_ratio,
            pressure, q_x, q_y, slip_x, slip_y,
        )  # fmt: skip
        _balance(a, b, nu_x, 0.0, 0.0, q_x, q_y, slip_x, slip_y)
    else:
        pressure[:], q_x[:], q_y[:] = math.nan, math.nan, math.nan
        slip_x[:], slip_y[:] = math.nan, math.nan
