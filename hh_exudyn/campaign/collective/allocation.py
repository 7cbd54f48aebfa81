"""How many of a budget of runs each group of classes of each running gets, before anything is known.

All get one; beyond that runnings get runs in proportion to share x mass, as work and pressure grow with the
load, and the groups of a running alike: tight curves are few and wear the flange, wide ones are many and wear
the tread. Ties go to the tighter curve. What is found by running improves on it
(`hh_exudyn.campaign.collective.sampling.next_samples`).
"""

import math
from collections.abc import Sequence


def allotted(runs: int, units: Sequence[tuple[float, float]]) -> list[int]:
    """Runs of each unit, in the order given; they sum to `runs`.

    Parameters
    ----------
    runs : int
        In all, at least the number of units.
    units : sequence of (float, float)
        Of each: its claim, of which only ratios count, and its rank among equal claims, larger ones first.

    Raises
    ------
    ValueError
        Fewer runs than units.
    """
    if runs < len(units):
        raise ValueError(f"{runs} runs for {len(units)} units: allowed one or more for each")
    counts = [1] * len(units)
    for _ in range(runs - len(units)):
        best = max(range(len(units)), key=lambda i: (_urgency(units[i][0], counts[i]), units[i][1]))
        counts[best] += 1
    return counts


def _urgency(claim: float, count: int) -> float:
    """Of one more run, as `sampling.next_samples` has it; to ten digits, so that equal claims are equal."""
    return float(f"{claim / math.sqrt(count * (count + 1.0)):.10g}")
