"""Sampling errors of the rates of the last evaluation, from the spread of its replicates.

Every replicate of a collective is a random sample of it with the whole weight, and independent of the others.
So the mean of n of them has the standard error s / sqrt(n), s their standard deviation, and limits of
confidence by Student's t with n - 1 degrees of freedom.
"""

import numpy as np
import pyarrow
from scipy.stats import t as student

from damage.life.places import PLACES
from hh_exudyn.campaign.collective.sampling import LEAST_SAMPLES
from hh_exudyn.campaign.results.recorded import WEAR, Recorded

CONFIDENCE = 0.95


def errors_table(recorded: Recorded) -> pyarrow.Table | None:
    """Rates at the worst bin of a place with half the width of their 95 % interval, from sampling alone.

    A row for each group, kind of damage and place: the rate (um per 1000 km, or Miner's sum per 1000 km), half
    the width in the same unit and as a share of the rate, and the number of replicates. None for an evaluation
    of less than three replicates, of which there is no spread.
    """
    rows = []
    for group in recorded.groups:
        y, places = recorded.wheels[group][-1].grid.lateral, recorded.places(group)
        for kind in recorded.kinds():
            cases, values = recorded.case_rates(group, kind)
            numbers = np.array([case.stratum.replicate for case in cases])
            found = np.unique(numbers)
            count = found.size
            if count < LEAST_SAMPLES:
                return None
            factor = float(student.ppf(0.5 * (1.0 + CONFIDENCE), count - 1)) / np.sqrt(count)
            scale, unit = (1e12, "um/1000 km") if kind == WEAR else (1e6, "1/1000 km")
            for place in PLACES if kind == WEAR else ("tread",):
                total = values.sum(axis=0)
                worst = int(np.argmax(np.where(places.within(place, y), total, -1.0)))
                samples = [count * values[numbers == number, worst].sum() for number in found]
                rate, half = scale * total[worst], scale * factor * float(np.std(samples, ddof=1))
                rows.append(
                    {
                        "group": group,
                        "damage": kind if kind == WEAR else f"cracks {kind}",
                        "place": place,
                        "rate": rate,
                        "half_width": half,
                        "unit": unit,
                        "half_width_share": half / rate if rate > 0.0 else None,
                        "replicates": count,
                    }
                )
    return pyarrow.Table.from_pylist(rows)
