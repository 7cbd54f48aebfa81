"""Tables of what a campaign has recorded: every step, every group of wheels, every place of a wheel."""

import numpy as np
import pyarrow

from damage.evolution.history import WearHistory
from damage.evolution.running_in import RunningIn, running_in
from damage.figures.evolution import worn_depth
from damage.life.places import BANDS, PLACES
from damage.material import wheel_material
from hh_exudyn.campaign.life.rails import rail_table, rails_by_class
from hh_exudyn.campaign.results.recorded import Recorded

_CHANGES = {"Sh_mm": "Sh_change_mm", "Sd_mm": "Sd_change_mm", "qR_mm": "qR_change_mm"}


def measures_table(recorded: Recorded) -> pyarrow.Table:
    """Measures of the wheels over the distance, a row for each group and step.

    Columns: group; life from 1, as turned; those of `damage.evolution.history.WearHistory`; changes of Sh, Sd
    and qR from the start; largest Miner's sum on the tread by each index, without what wore off.
    """
    found = []
    for group, states in recorded.wheels.items():
        table = WearHistory(tuple(one.step for one in states)).to_table()
        count, places = len(states), recorded.places(group)
        table = table.add_column(0, "group", pyarrow.array([group] * count))
        table = table.add_column(1, "life", pyarrow.array(_numbers_of_lives(recorded, group)))
        for name, change in _CHANGES.items():
            values = table[name].to_numpy()
            table = table.append_column(change, pyarrow.array(values - values[0]))
        for index in states[0].cracks:
            tread = [places.largest(one.cracks[index].damage, one.grid.lateral)["tread"] for one in states]
            table = table.append_column(f"tread_miner_{index}", pyarrow.array(tread))
        found.append(table)
    return pyarrow.concat_tables(found)


def running_in_table(recorded: Recorded) -> pyarrow.Table:
    """Distance and depth of running-in of the first life, a row for each group."""
    found = {group: first_running_in(recorded, group) for group in recorded.groups}
    return pyarrow.table(
        {
            "group": list(found),
            "distance_km": [1e-3 * one.distance for one in found.values()],
            "depth_um": [1e6 * one.depth for one in found.values()],
            "finished": [one.finished for one in found.values()],
        }
    )


def first_running_in(recorded: Recorded, group: str) -> RunningIn:
    """Running-in of new wheels: under seizure at 0.8 of the hardness of the campaign's steel.

    Parameters
    ----------
    recorded
        The steps.
    group
        Of wheels.
    """
    hardness = wheel_material(recorded.campaign.plan.damage.material).require("hardness", "running-in")
    first = tuple(one.step for one in recorded.lives[group][0])
    return running_in(WearHistory(first), hardness)


def wear_table(recorded: Recorded) -> pyarrow.Table:
    """Wear of each life by place of the wheel, a row for each group, life and place.

    Columns: from where to where; the largest depth that has worn off between, along the normals of the first
    of the two profiles; its rate. A first life counts from the end of its running-in, and has no depth and
    rate where that is not over; a later one from its turning.
    """
    rows: dict[str, list[object]] = {
        name: [] for name in ("group", "life", "place", "from_km", "to_km", "depth_um", "um_per_1000_km")
    }
    for group, lives in recorded.lives.items():
        places, run_in = recorded.places(group), first_running_in(recorded, group)
        for life, states in enumerate(lives, 1):
            own = [one.step for one in states]
            begun = [step for step in own if life > 1 or step.distance >= run_in.distance]
            first, last = begun[0], own[-1]
            way = last.distance - first.distance
            deepest = places.largest(np.maximum(worn_depth(first, last), 0.0), first.profile.y)
            for place in PLACES:
                depth = 1e6 * deepest[place] if way > 0.0 else None
                rate = None if depth is None else depth / (1e-6 * way)
                values = (group, life, place, 1e-3 * first.distance, 1e-3 * last.distance, depth, rate)
                for name, value in zip(rows, values, strict=True):
                    rows[name].append(value)
    return pyarrow.table(rows)


def cracks_table(recorded: Recorded) -> pyarrow.Table:
    """Cracks of the present life, a row for each group, index, and place or band of the wheel.

    Columns: y from and to of a band of the tread; the largest Miner's sum with and without what wore off; the
    depth of the deepest crack.
    """
    rows = []
    for group, states in recorded.wheels.items():
        places, last = recorded.places(group), states[-1]
        for index, layer in last.cracks.items():
            left = places.largest(layer.damage, last.grid.lateral)
            grown = places.largest(layer.damage_without_wear, last.grid.lateral)
            for place in (*PLACES, *BANDS):
                low, high = BANDS.get(place, (None, None))
                rows.append(
                    {
                        "group": group,
                        "index": index,
                        "place": place,
                        "from_mm": None if low is None else 1e3 * low,
                        "to_mm": None if high is None else 1e3 * high,
                        "miner": left[place],
                        "miner_without_wear": grown[place],
                        "crack_depth_mm": 1e3 * layer.failure_depth * left[place],
                    }
                )
    return pyarrow.Table.from_pylist(rows)


def profile_table(recorded: Recorded) -> pyarrow.Table:
    """Wear and cracks of the present life over the profile, a row for each group and bin.

    Wear is that of the profile, from its beginning on; cracks with and without what wore off.
    """
    found = []
    for group, states in recorded.wheels.items():
        last = states[-1]
        layers, y, first = last.cracks, last.grid.lateral, recorded.history(group).steps[0]
        worn = np.interp(y, first.profile.y, worn_depth(first, last.step), left=0.0, right=0.0)
        columns: dict[str, object] = {
            "group": [group] * last.grid.count,
            "y_mm": 1e3 * y,
            "worn_um": 1e6 * worn,
        }
        for index, layer in layers.items():
            columns[f"miner_{index}"] = layer.damage
            columns[f"miner_without_wear_{index}"] = layer.damage_without_wear
            columns[f"crack_depth_{index}_mm"] = 1e3 * layer.depth
        found.append(pyarrow.table(columns))
    return pyarrow.concat_tables(found)


def rails_table(recorded: Recorded) -> pyarrow.Table | None:
    """Wear and fatigue of the rails by class (`hh_exudyn.campaign.life.rails`), by the last evaluation.

    None where the campaign has not summed them.
    """
    rails = rails_by_class(recorded.sums())
    return rail_table(rails) if rails else None


def steps_table(recorded: Recorded) -> pyarrow.Table:
    """What every step took: distance, evaluations, cases run, not run again, failed; groups turned."""
    ends = recorded.ends
    return pyarrow.table(
        {
            "step": list(range(len(ends))),
            "distance_km": [1e-3 * end.distance for end in ends],
            "evaluations": [end.evaluations for end in ends],
            "cases_run": [end.ran for end in ends],
            "cases_not_run_again": [end.reused for end in ends],
            "cases_failed": [len(end.failed) for end in ends],
            "turned": [", ".join(str(row["group"]) for row in end.turned) for end in ends],
        }
    )


def failures_table(recorded: Recorded) -> pyarrow.Table:
    """Cases that failed and are left out, with their weights and reasons."""
    failed = sorted({one for end in recorded.ends for one in end.failed})
    names, weights, reasons = zip(*failed, strict=True) if failed else ((), (), ())
    return pyarrow.table(
        {
            "case": pyarrow.array(names, pyarrow.string()),
            "weight": pyarrow.array(weights, pyarrow.float64()),
            "reason": pyarrow.array(reasons, pyarrow.string()),
        }
    )


def _numbers_of_lives(recorded: Recorded, group: str) -> list[int]:
    """Number of the life that runs, or ends, at every step, from 1."""
    begins = [one.turned_at for one in recorded.wheels[group]]
    numbers = {begin: number for number, begin in enumerate(dict.fromkeys(begins), 1)}
    return [numbers[begin] for begin in begins]
