"""The Sheffield law, of the patch (USFD) and of its cells (Ward).

R. Lewis and R.S. Dwyer-Joyce, Wear mechanisms and transitions in railway wheel steels, Proc. IMechE J 218
(2004) 467-478, twin discs of R8T wheel on UIC60 900A rail steel: the mass worn off per metre rolled and mm^2
of contact [ug] over the wear number per contact area x = Tg/A [N/mm^2] is

    5.3 x below 10.4,   55 from 10.4 to 77.2,   61.9 x - 4723.7 above.

The last line is 55 + 61.9 (x - 77.2). Some papers and public code print 61.9 x - 4778.7, which omits the 55
of the plateau: the wear would fall from 55 to 0 at 77.2.

`usfd` uses Tg of the whole patch over its area, with even wear over the patch: a strip by its length of
contact. `ward` applies the law cell by cell with the cell's own energy (A. Ward, R. Lewis, R.S. Dwyer-Joyce,
Incorporating a railway wheel wear model into multi-body simulations of wheelset dynamics, 2003): cells in
stick do not wear.
"""

from damage.bounds import check_above_zero
from damage.parameters import parameters
from damage.wear.energy import cell_energy, energies_of_strips
from damage.wear.law import REGIMES, SolvedPatch, WearLaw
from damage.wear.rate import rate_in_regime, rate_numbers, rate_regime, read_rate
from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import kernel

_MASS = 1e-3  # kg/m/m^2 per ug/m/mm^2
_STRESS = 1e6  # Pa per N/mm^2
_DENSITY = parameters("wear", "usfd")["density"].value
USFD_REGIMES = ("mild", "severe", "catastrophic")


def usfd(density: float = _DENSITY) -> WearLaw:
    """The Sheffield law of the whole patch. Density of the steel [kg/m^3], > 0 (ValueError)."""
    return WearLaw("usfd", USFD_REGIMES, usfd_depths, _rate(density))


def ward(density: float = _DENSITY) -> WearLaw:
    """The Sheffield law cell by cell. Density of the steel [kg/m^3], > 0 (ValueError)."""
    return WearLaw("ward", USFD_REGIMES, ward_depths, _rate(density))


def _rate(density: float) -> tuple[float, ...]:
    """Worn volume per metre rolled and contact area [-] over the energy per area [Pa]."""
    check_above_zero("density", density, "kg/m^3")
    number = {name: parameter.value for name, parameter in parameters("wear", "usfd").items()}
    volume = _MASS / density
    per_stress = volume / _STRESS
    last = number["plateau"] - number["catastrophic_slope"] * number["severe_to"]  # -4723.7
    return rate_numbers(
        limits=(number["mild_to"] * _STRESS, number["severe_to"] * _STRESS),
        slopes=(number["mild_slope"] * per_stress, 0.0, number["catastrophic_slope"] * per_stress),
        offsets=(0.0, number["plateau"] * volume, last * volume),
    )


@kernel
def usfd_depths(numbers: FloatArray, solved: SolvedPatch, depth: FloatArray) -> None:
    """Wear depth on the wheel per revolution, by strip and regime; arguments: `LawKernel`."""
    energy = energies_of_strips(solved, depth)
    depth[:] = 0.0
    if not energy > 0.0:
        return  # nothing slips
    cells_y, rate = depth.shape[0], read_rate(numbers)
    density = energy / solved.area
    regime = rate_regime(density, rate)
    worn = rate_in_regime(regime, density, rate)
    for j in range(cells_y):
        depth[j, regime] = worn * solved.strips.contact_length[j]


@kernel
def ward_depths(numbers: FloatArray, solved: SolvedPatch, depth: FloatArray) -> None:
    """Wear depth on the wheel per revolution, by strip and regime, from the cells; arguments: `LawKernel`."""
    fields, rate = solved.fields, read_rate(numbers)
    cells_y, cells_x = fields.pressure.shape
    depth[:] = 0.0
    for j in range(cells_y):
        length = 2.0 * solved.strips.half_length[j] / cells_x
        for i in range(cells_x):
            energy = cell_energy(fields, j, i)
            if energy > 0.0:
                regime = rate_regime(energy, rate)
                depth[j, regime] += rate_in_regime(regime, energy, rate)
        for regime in range(REGIMES):
            depth[j, regime] *= length
