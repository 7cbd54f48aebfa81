"""Wear and fatigue of a line's rails by curve class, high and low, per million gross tonnes.

Each metre of rail belongs to one class, so classes are not added: within a class the passings of its cases
count with their weights (loaded and empty, seasons, gauges), and are divided by the mass that passed. Left
and right curves count together, as do both rails of straight track. The wheels are those of the evaluation;
the rails do not change their profile.
"""

from collections.abc import Iterable

import numpy as np
import pyarrow

from damage.rails.rail_surface import RailSurface
from hh_exudyn.campaign.collective.weighted import WeightedCase
from hh_exudyn.campaign.engine.sums import PartSums
from hh_exudyn.campaign.life.stored_rows import results_of_last_evaluation
from hh_exudyn.campaign.results.recorded import Recorded
from hh_exudyn.conventions import LEFT, RIGHT

BODY = "body"  # part of a case: the full curve, or straight track

RailKey = tuple[str, str, str]
"""Curve class; "high", "low" or "straight"; profile of the rail."""


def rails_by_class(results: Iterable[tuple[WeightedCase, PartSums]]) -> dict[RailKey, RailSurface]:
    """Sums of the rails of every class over the weighted passings of its cases.

    Parameters
    ----------
    results
        Weighted cases with their sums; those without rails are left out.
    """
    found: dict[RailKey, RailSurface] = {}
    for weighted, sums in results:
        stratum = weighted.stratum
        for rail in sums[BODY].rails if BODY in sums else ():
            high = rail.side == (LEFT if stratum.run_hand == "right" else RIGHT)
            role = "straight" if stratum.straight else "high" if high else "low"
            key = stratum.curve_class, role, stratum.rail_high if high else stratum.rail_low
            one = weighted.weight * (rail if rail.side == LEFT else rail.mirrored())
            found[key] = found[key] + one if key in found else one
    return found


def rails_table(recorded: Recorded) -> pyarrow.Table | None:
    """`rail_table` of the last evaluation of a campaign; None where its cases were evaluated without rails.

    Parameters
    ----------
    recorded
        The steps of a campaign.
    """
    results = results_of_last_evaluation(recorded.campaign)
    rails = rails_by_class((one.weighted, one.sums) for one in results)
    return rail_table(rails) if rails else None


def rail_table(rails: dict[RailKey, RailSurface]) -> pyarrow.Table:
    """One row a class and rail, per million gross tonnes (MGT), with units in the names of the columns.

    ``wear_mm_per_MGT`` is the largest depth normal to the surface, at ``wear_y_mm`` on the rail's profile
    (positive towards the track centre); ``miner_local_per_MGT`` and ``miner_global_per_MGT`` are Kabo's sums
    at the worst place, whose lives were fitted on wheels; ``rcf_per_MGT`` is that of the whole-life rail
    model at its largest.

    Parameters
    ----------
    rails
        As `rails_by_class`.
    """
    rows = []
    for (curve_class, role, profile), rail in sorted(rails.items()):
        sums, depth = rail.by_wheel, 1e3 * rail.depth_per_mgt
        miner = {
            index: rail.per_mgt * float(values.sum(axis=(0, 1)).max())
            for index, values in (("local", sums.crack_damage), ("global", sums.global_crack_damage))
        }
        rows.append(
            {
                "curve_class": curve_class,
                "rail": role,
                "profile": profile,
                "p_max_MPa": 1e-6 * float(sums.max_pressure.max(initial=0.0)),
                "wear_mm_per_MGT": float(depth.max()),
                "wear_y_mm": 1e3 * float(sums.grid.lateral[int(np.argmax(depth))]),
                "worn_area_mm2_per_MGT": 1e6 * rail.worn_area_per_mgt,
                "miner_local_per_MGT": miner["local"],
                "miner_global_per_MGT": miner["global"],
                "rcf_per_MGT": rail.per_mgt * float(rail.whole_life.sum(axis=0).max()),
            }
        )
    return pyarrow.Table.from_pylist(rows)
