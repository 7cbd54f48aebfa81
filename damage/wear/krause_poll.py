"""Krause and Poll's law: worn volume is a coefficient times the work of friction (equation 3.31, 3.32).

H. Krause, G. Poll, Wear of wheel-rail surfaces, Wear 113 (1986) 103-122: W_V = I_w W_R. The coefficient I_w
depends on the temperature of the contact, hence on the power of friction per contact area, E V / A, in
regimes. Its numbers belong to the steels, the weather and the rig: there are no defaults.

The work is proportional to the distance rolled (E is per metre rolled). Each strip has the share of the worn
volume that it has of the energy.
"""

from collections.abc import Sequence
from itertools import pairwise

from damage.bounds import check_above_zero
from damage.wear.energy import depths_by_energy, energies_of_strips
from damage.wear.law import REGIMES, SolvedPatch, WearLaw
from damage.wear.rate import Rate, rate_in_regime, rate_numbers, rate_regime, read_rate
from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import kernel


def krause_poll(coefficients: Sequence[float], power_densities: Sequence[float]) -> WearLaw:
    """Krause and Poll's law with the user's numbers.

    Parameters
    ----------
    coefficients
        I_w of one to four regimes [m^3/J], > 0, from the lowest power density to the highest.
    power_densities
        Limits between the regimes [W/m^2], rising, > 0; one less than coefficients.

    Raises
    ------
    ValueError
        Wrong numbers of values, or values out of range.
    """
    if not 1 <= len(coefficients) <= REGIMES or len(power_densities) != len(coefficients) - 1:
        raise ValueError(
            f"Krause and Poll's law takes 1 to {REGIMES} coefficients and one power density less; given: "
            f"{len(coefficients)} and {len(power_densities)}"
        )
    for name, unit, values in (
        ("coefficients", "m^3/J", coefficients),
        ("power_densities", "W/m^2", power_densities),
    ):
        for value in values:
            check_above_zero(name, value, unit)
    for low, high in pairwise(power_densities):
        if low >= high:
            raise ValueError(f"power_densities must rise: {low} W/m^2 is followed by {high} W/m^2")
    numbers = rate_numbers(power_densities, coefficients, [0.0] * len(coefficients))
    names = (
        ("mild", "severe")
        if len(coefficients) == 2
        else tuple(f"regime {number + 1}" for number in range(len(coefficients)))
    )
    return WearLaw("krause_poll", names, krause_poll_depths, numbers)


@kernel
def krause_poll_volume(energy: float, area: float, speed: float, rate: Rate) -> tuple[int, float]:
    """Regime, and worn volume per metre rolled [m^3/m] of the wear number [N] at a speed [m/s].

    Parameters
    ----------
    energy
        Wear number [N].
    area
        Of contact [m^2].
    speed
        [m/s].
    rate
        Coefficient over power density, from `read_rate`.
    """
    regime = rate_regime(energy * speed / area, rate)  # (3.32)
    return regime, rate_in_regime(regime, energy, rate)  # (3.31)


@kernel
def krause_poll_depths(numbers: FloatArray, solved: SolvedPatch, depth: FloatArray) -> None:
    """Wear depth on the wheel per revolution, by strip and regime; arguments: `LawKernel`."""
    energy = energies_of_strips(solved, depth)
    if energy > 0.0:
        regime, volume = krause_poll_volume(energy, solved.area, solved.speed, read_rate(numbers))
        depths_by_energy(regime, volume, energy, solved.strips, depth)
