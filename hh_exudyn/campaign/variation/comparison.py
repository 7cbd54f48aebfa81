"""Wear and cracks of the wheels of several campaigns at the distance that all have reached, as a table."""

from collections.abc import Mapping, Sequence

import numpy as np
import pyarrow

from damage.figures.evolution import worn_depth
from damage.life.condition import WheelCondition, between
from damage.life.places import PLACES
from hh_exudyn.campaign.life.campaign import Campaign
from hh_exudyn.campaign.results.recorded import Recorded

_MEASURES = {"flange_height": "Sh", "flange_thickness": "Sd", "flange_steepness": "qR"}
_ROUNDING = 1e-9  # of a distance


def comparison_table(campaigns: Mapping[str, Campaign]) -> pyarrow.Table:
    """A row for each campaign and group of wheels.

    Columns: campaign, group; distance that all have reached; how often the wheels were turned or replaced
    before; changes of Sh, Sd and qR from new [mm]; worn depth of tread, root and flange, and largest Miner's
    sum on the tread by each index without what wears off, both per 1000 km of the present life, running-in
    included.

    Parameters
    ----------
    campaigns
        By name.

    Raises
    ------
    ValueError
        There is none, or one has made no step.
    """
    if not campaigns:
        raise ValueError("no campaign to compare: allowed one or more")
    recorded = {name: Recorded.of(one) for name, one in campaigns.items()}
    common = min(one.distance for one in recorded.values())
    rows = [
        {"campaign": name, "group": group} | _row(one, group, common)
        for name, one in recorded.items()
        for group in one.groups
    ]
    return pyarrow.Table.from_pylist(rows)


def _row(recorded: Recorded, group: str, distance: float) -> dict[str, object]:
    """Numbers of one group at a distance."""
    lives = recorded.lives[group]
    begun = [life for life in lives if life[0].step.distance < distance * (1.0 - _ROUNDING)]
    new, first, now = lives[0][0], begun[-1][0], _within(begun[-1], distance)
    places, y = recorded.places(group), first.step.profile.y
    way = 1e-6 * (now.step.distance - first.step.distance)  # 1000 km
    row: dict[str, object] = {"distance_km": 1e-3 * distance, "turnings": len(begun) - 1}
    for measure, name in _MEASURES.items():
        change = getattr(now.step.measures, measure) - getattr(new.step.measures, measure)
        row[f"{name}_change_mm"] = 1e3 * change
    deepest = places.largest(np.maximum(worn_depth(first.step, now.step), 0.0), y)
    row |= {f"{place}_um_per_1000_km": 1e6 * deepest[place] / way for place in PLACES}
    for index, layer in now.cracks.items():
        grown = places.largest(layer.damage_without_wear, layer.grid.lateral)["tread"]
        row[f"tread_miner_{index}_per_1000_km"] = grown / way
    return row


def _within(life: Sequence[WheelCondition], distance: float) -> WheelCondition:
    """The wheels of a life at a distance behind its start."""
    least = distance * (1.0 - _ROUNDING)
    number = next(i for i, one in enumerate(life) if one.step.distance >= least)
    return between(life[number - 1], life[number], min(distance, life[number].step.distance))
