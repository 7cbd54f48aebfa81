"""Piecewise linear rates of wear: what the energy laws have in common."""

import math
from collections.abc import Sequence

from damage.wear.values import REGIMES, RateValues
from hh_exudyn.kernel import kernel


def rate_values(limits: Sequence[float], slopes: Sequence[float], offsets: Sequence[float]) -> RateValues:
    """The rate for the kernels, filled up to `REGIMES` regimes with ones that never hold."""
    spare = REGIMES - len(slopes)
    more = (0.0,) * spare
    return RateValues((*limits, *(math.inf,) * spare), (*slopes, *more), (*offsets, *more))


@kernel
def rate_regime(quantity: float, rate: RateValues) -> int:
    """The regime that holds: the number of limits at or below the quantity."""
    regime = 0
    for limit in rate.limits:
        if quantity >= limit:
            regime += 1
    return regime


@kernel
def rate_in_regime(regime: int, energy: float, rate: RateValues) -> float:
    """Slope times energy plus offset."""
    return rate.slopes[regime] * energy + rate.offsets[regime]
