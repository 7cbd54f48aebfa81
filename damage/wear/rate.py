"""Piecewise linear rates of wear, common to the energy laws."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from damage.wear.law import REGIMES
from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import kernel


class Rate(NamedTuple):
    """A piecewise linear rate of wear: slope times energy plus offset of the regime.

    The regime is the number of limits at or below the law's quantity (`rate_regime`); SI units of the law.
    """

    limits: tuple[float, ...]  # REGIMES - 1, rising; infinite where there are fewer regimes
    slopes: tuple[float, ...]  # REGIMES
    offsets: tuple[float, ...]  # REGIMES


def rate_numbers(
    limits: Sequence[float], slopes: Sequence[float], offsets: Sequence[float]
) -> tuple[float, ...]:
    """The numbers of a law that is a rate alone, for `read_rate`.

    Parameters
    ----------
    limits
        Limits between the regimes, rising; one less than slopes.
    slopes, offsets
        Of one to `REGIMES` regimes.
    """
    spare = REGIMES - len(slopes)
    more = (0.0,) * spare
    numbers = (*limits, *(math.inf,) * spare, *slopes, *more, *offsets, *more)
    return tuple(float(number) for number in numbers)


@kernel
def read_rate(numbers: FloatArray) -> Rate:
    """The rate in a law's numbers: the inverse of `rate_numbers`, filled up to `REGIMES` regimes.

    Parameters
    ----------
    numbers
        (3 REGIMES - 1,) numbers from `rate_numbers`.
    """
    return Rate(
        (numbers[0], numbers[1], numbers[2]),
        (numbers[3], numbers[4], numbers[5], numbers[6]),
        (numbers[7], numbers[8], numbers[9], numbers[10]),
    )


@kernel
def rate_regime(quantity: float, rate: Rate) -> int:
    """The regime: number of limits at or below the quantity, in the unit of the limits (kernel).

    Parameters
    ----------
    quantity
        In the unit of the limits.
    rate
        The rate.
    """
    regime = 0
    for limit in rate.limits:
        if quantity >= limit:
            regime += 1
    return regime


@kernel
def rate_in_regime(regime: int, energy: float, rate: Rate) -> float:
    """Slope times energy plus offset of a regime, in the units of the law (kernel).

    Parameters
    ----------
    regime
        From `rate_regime`.
    energy
        In the unit of the law.
    rate
        The rate.
    """
    return rate.slopes[regime] * energy + rate.offsets[regime]
