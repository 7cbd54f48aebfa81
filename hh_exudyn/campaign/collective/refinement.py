"""The discretisation error of an axis: its steps are halved, and what that changes is extrapolated.

Replicates of the finer collective have the same draws as those of the coarser one, so that differences are
taken replicate by replicate: what is left of the sampling error in their mean is stated beside it.
"""

from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.collective.bought import Bought
from hh_exudyn.campaign.collective.collective import Collective
from hh_exudyn.campaign.collective.sampling import LEAST_SAMPLES, halving_error, of_samples


@dataclass(frozen=True, eq=False)
class Refinement:
    """What halving the steps of an axis says.

    Attributes
    ----------
    change
        Of each quantity from the coarse to the fine steps, (quantities,).
    error
        Discretisation error of the coarse steps, (quantities,), >= 0: 4/3 of the change (Richardson, second
        order: means of intervals).
    uncertainty
        Half width at 95 % of that error, (quantities,), from the differences of replicates: an error below
        it is not told from chance.
    """

    change: FloatArray
    error: FloatArray
    uncertainty: FloatArray

    def over(self, reference: FloatArray) -> "Refinement":
        """All relative to `reference`, (quantities,)."""
        return Refinement(self.change / reference, self.error / reference, self.uncertainty / reference)


def refinement(coarse: Collective, fine: Collective, bought: Bought) -> Refinement:
    """Evaluate a refined collective, and compare it with the coarse one.

    Parameters
    ----------
    coarse, fine : Collective
        The second is `Collective.refined` of the first.
    bought : Bought
        Values of the coarse one are known already, or evaluated.
    """
    each = []
    for collective in (coarse, fine):
        first = max(LEAST_SAMPLES, collective.plan.replicates)
        units = {collective.unit(item.stratum) for item in collective.strata}
        rows = collective.resampled(dict.fromkeys(units, first))
        values = bought.values(collective, rows)
        weights = np.array([first * row.weight for row in rows])
        replicate = np.array([row.stratum.replicate for row in rows])
        each.append(np.array([weights[replicate == r] @ values[replicate == r] for r in range(1, first + 1)]))
    difference = of_samples(np.ones(1), [each[1] - each[0]])
    change = difference.total
    order = 4.0 / 3.0  # error of the coarse steps: that of the fine ones, and the change
    found = Refinement(
        change, halving_error(each[0].mean(axis=0), each[1].mean(axis=0)) + np.abs(change),
        order * difference.half_width(),
    )  # fmt: skip
    return found
