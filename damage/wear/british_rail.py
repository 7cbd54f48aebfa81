"""British Rail's law: the area worn off the wheel's cross-section follows from the wear number alone.

British Rail Research (I.J. McEwen and R.F. Harvey, full-scale rig; used by T.G. Pearce and N.D. Sherratt,
Wear 144 (1991)); equation 3.30 of Hossein-Nia (2018): the loss per kilometre rolled, in mm^2, of the wear
number E [N] and the wheel's diameter D [mm] is

    0.25 E/D below 100 N,   25/D from 100 to 200 N,   (1.19 E - 154)/D above.

As printed it jumps from 25/D to 84/D at 200 N; the last line equals 25/D at E = 150.4 N, where the continuous
form begins it. The law does not give the distribution over the profile: each strip has the share of the worn
volume that it has of the energy.
"""

import math

from damage.parameters import parameters
from damage.wear.energy import depths_by_energy, energies_of_strips
from damage.wear.law import SolvedPatch, WearLaw
from damage.wear.rate import Rate, rate_in_regime, rate_numbers, rate_regime, read_rate
from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import kernel

_SI = 1e-12  # m^3/m per mm^3/km: for the loss per kilometre times the diameter


def british_rail(continuous: bool = False) -> WearLaw:
    """British Rail's law (3.30); `continuous` removes its jump at 200 N."""
    number = {name: parameter.value for name, parameter in parameters("wear", "british_rail").items()}
    severe_from = number["severe_from"]
    if continuous:
        severe_from = (number["plateau"] - number["severe_offset"]) / number["severe_slope"]  # 150.4 N
    numbers = rate_numbers(
        limits=(number["mild_to"], severe_from),
        slopes=(number["mild_slope"] * _SI, 0.0, number["severe_slope"] * _SI),
        offsets=(0.0, number["plateau"] * _SI, number["severe_offset"] * _SI),
    )
    regimes = ("mild", "plateau", "severe")
    return WearLaw("british_rail", regimes, british_rail_depths, numbers)


@kernel
def british_rail_volume(energy: float, rolling_radius: float, rate: Rate) -> tuple[int, float]:
    """Regime, and worn volume per metre rolled [m^3/m]: worn area per metre times circumference (kernel).

    The diameter cancels: a smaller wheel loses more of its cross-section, on a shorter circumference.

    Parameters
    ----------
    energy
        Wear number [N].
    rolling_radius
        Radius of the wheel at the contact [m].
    rate
        Loss over the wear number, from `read_rate`.
    """
    diameter = 2.0 * rolling_radius
    regime = rate_regime(energy, rate)
    area = rate_in_regime(regime, energy, rate) / diameter  # (3.30) [m^2/m]
    return regime, area * math.pi * diameter


@kernel
def british_rail_depths(numbers: FloatArray, solved: SolvedPatch, depth: FloatArray) -> None:
    """Wear depth on the wheel per revolution, by strip and regime; arguments: `LawKernel`."""
    energy = energies_of_strips(solved, depth)
    if energy > 0.0:
        regime, volume = british_rail_volume(energy, solved.rolling_radius, read_rate(numbers))
        depths_by_energy(regime, volume, energy, solved.strips, depth)
