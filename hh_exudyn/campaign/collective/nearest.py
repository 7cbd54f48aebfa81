"""Which replicates a loop evaluates: those that together are nearest to the mean of all.

A loop pays for one replicate of every unit. Any has the sampling error of one; but once several are known, a
combination of them can be chosen whose weighted sums are those of all, in the state in which they were
evaluated. As wheels wear, the choice is a control that goes out of date slowly.
"""

from collections.abc import Sequence

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.collective.collective import Collective
from hh_exudyn.campaign.collective.weighted import WeightedStratum


def nearest_replicates(
    collective: Collective, rows: Sequence[WeightedStratum], values: FloatArray, reference: FloatArray
) -> tuple[dict[str, int], float]:
    """A replicate of every unit, and the largest relative difference of their sums from the mean of all.

    Units are changed one by one to the replicate that brings the sums nearest, until none does.

    Parameters
    ----------
    collective : Collective
        Of the strata.
    rows : sequence of WeightedStratum
        All replicates.
    values : (rows, quantities) array
        Of the strata.
    reference : (quantities,) array
        What differences are relative to; infinity for what does not count.
    """
    units = [collective.unit(row.stratum) for row in rows]
    replicates = np.array([row.stratum.replicate for row in rows])
    parts = np.array([row.weight for row in rows])[:, None] * values / reference
    names = tuple(dict.fromkeys(units))
    of_unit = np.array([names.index(unit) for unit in units])
    off = []  # of every replicate of a unit from the unit's mean
    for u in range(len(names)):
        mine = of_unit == u
        count = replicates[mine].max()
        sums = np.array([parts[mine & (replicates == r)].sum(axis=0) for r in range(1, count + 1)])
        off.append(count * sums - sums.sum(axis=0))
    chosen = [int(np.argmin((each**2).sum(axis=1))) for each in off]
    total = np.sum([each[r] for each, r in zip(off, chosen, strict=True)], axis=0)
    changed = True
    while changed:
        changed = False
        for u, each in enumerate(off):
            others = total - each[chosen[u]]
            best = int(np.argmin(((others + each) ** 2).sum(axis=1)))
            if ((others + each[best]) ** 2).sum() < (total**2).sum() * (1.0 - 1e-9):
                chosen[u], total, changed = best, others + each[best], True
    numbers = {name: r + 1 for name, r in zip(names, chosen, strict=True)}
    return numbers, float(np.max(np.abs(total), initial=0.0))
