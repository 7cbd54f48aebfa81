"""Wear and cracks of the wheels of several campaigns at the distance that all have reached, as a table."""

from collections.abc import Mapping

import numpy as np
import pyarrow

from damage.figures.evolution import worn_depth
from damage.life.condition import WheelCondition, between
from damage.life.places import WheelPlaces
from hh_exudyn.campaign.life.campaign import Campaign

_MEASURES = {"flange_height": "Sh", "flange_thickness": "Sd", "flange_steepness": "qR"}


def comparison_table(campaigns: Mapping[str, Campaign]) -> pyarrow.Table:
    """A row for each campaign and group of wheels.

    Columns: campaign, group; distance that all have reached; turnings until then; changes of Sh, Sd and qR
    from new [mm]; worn depth of tread, root and flange, and largest Miner's sum on the tread by each index
    without what wears off, both per 1000 km of the present life. They are null for a life without two states,
    of which there is none to compare (a wheel is stored before it is turned).

    Parameters
    ----------
    campaigns
        By name; each with a step.

    Raises
    ------
    ValueError
        There is none, or one has made no step.
    """
    if not campaigns:
        raise ValueError("no campaign to compare: allowed one or more")
    states = {name: _states(name, one) for name, one in campaigns.items()}
    common = min(next(iter(one[-1].values())).step.distance for one in states.values())
    rows = [
        {"campaign": name, "group": group} | _row([one[group] for one in found], common)
        for name, found in states.items()
        for group in found[0]
    ]
    return pyarrow.Table.from_pylist(rows)


def _states(name: str, campaign: Campaign) -> list[dict[str, WheelCondition]]:
    """The wheels after every step, the start among them."""
    count = campaign.files.count
    if count < 2:
        raise ValueError(f"{name}: the campaign has made no step yet")
    return [campaign.files.conditions(number) for number in range(count)]


def _row(states: list[WheelCondition], distance: float) -> dict[str, object]:
    """Numbers of one group at a distance."""
    new, now = states[0], _at(states, distance)
    life = [one for one in states if one.turned_at == now.turned_at]
    places, begun = WheelPlaces.of(new.step.profile), life[0].step
    way = 1e-6 * (now.step.distance - begun.distance)  # 1000 km
    row: dict[str, object] = {"distance_km": 1e-3 * distance, "turnings": now.turnings}
    for measure, name in _MEASURES.items():
        change = getattr(now.step.measures, measure) - getattr(new.step.measures, measure)
        row[f"{name}_change_mm"] = 1e3 * change
    worn = np.maximum(worn_depth(begun, now.step), 0.0) if way > 0.0 else None
    for place in ("tread", "root", "flange"):
        deepest = None if worn is None else places.largest(worn, begun.profile.y)[place]
        row[f"{place}_um_per_1000_km"] = None if deepest is None else 1e6 * deepest / way
    rolled = 1e-6 * now.since_turning
    for index, layer in now.cracks.items():
        grown = places.largest(layer.damage_without_wear, layer.grid.lateral)["tread"]
        row[f"tread_miner_{index}_per_1000_km"] = grown / rolled if rolled > 0.0 else None
    return row


def _at(states: list[WheelCondition], distance: float) -> WheelCondition:
    """The wheels at a distance; where they were turned in that step, as they were at its start."""
    number = next(i for i, one in enumerate(states) if one.step.distance >= distance * (1.0 - 1e-9))
    before, after = states[max(number - 1, 0)], states[number]
    if before.turnings != after.turnings or before.turned_at != after.turned_at:
        return before if after.step.distance > distance * (1.0 + 1e-9) else after
    if number == 0:
        return after
    return between(before, after, min(distance, after.step.distance))
