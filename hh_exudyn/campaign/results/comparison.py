"""Two campaigns beside each other, at the farthest distance that both have reached."""

import pyarrow
from matplotlib import rc_context
from matplotlib.figure import Figure

from damage.figures.evolution import worn_depth
from damage.life.condition import WheelCondition, between
from hh_exudyn.campaign.results.figures import SMALL, WIDTH, add_over_distance, colour
from hh_exudyn.campaign.results.recorded import Recorded
from hh_exudyn.campaign.results.tables import measures_table

_MEASURES = {
    "diameter": ("diameter_mm", 1e3),
    "flange_height": ("Sh_mm", 1e3),
    "flange_thickness": ("Sd_mm", 1e3),
    "flange_steepness": ("qR_mm", 1e3),
    "hollow": ("hollow_mm", 1e3),
    "conicity": ("equivalent_conicity", 1.0),
}


def common_groups(first: Recorded, second: Recorded) -> tuple[str, ...]:
    """Groups of wheels that both campaigns have. Raises ValueError where there are none."""
    found = tuple(group for group in first.groups if group in second.groups)
    if not found:
        raise ValueError(
            f"{first.campaign.directory} has wheels {', '.join(first.groups)}, {second.campaign.directory} "
            f"{', '.join(second.groups)}: allowed are campaigns with a group in common"
        )
    return found


def comparison_table(first: Recorded, second: Recorded) -> pyarrow.Table:
    """Measures of both campaigns at their common distance, a row for each group and measure.

    Columns: group, measure with unit, distance, first, second, and second minus first.

    Parameters
    ----------
    first, second
        Campaigns with a group of wheels in common.
    """
    distance = min(first.distance, second.distance)
    rows = []
    for group in common_groups(first, second):
        values = [_values(one, group, distance) for one in (first, second)]
        for name in values[0]:
            one, two = values[0][name], values[1].get(name, float("nan"))
            rows.append(
                {
                    "group": group, "measure": name, "distance_km": 1e-3 * distance, "first": one,
                    "second": two, "difference": two - one,
                }
            )  # fmt: skip
    return pyarrow.Table.from_pylist(rows)


def comparison_figure(first: Recorded, second: Recorded, names: tuple[str, str]) -> Figure:
    """Worn depth over the profile at the common distance, and measures over the distance; dashed: the second.

    Parameters
    ----------
    first, second
        Campaigns with a group of wheels in common.
    names
        Of both.
    """
    groups, distance = common_groups(first, second), min(first.distance, second.distance)
    with rc_context(SMALL):
        figure = Figure(figsize=(WIDTH, 8.2), layout="constrained")
        parts = figure.subfigures(2, 1, height_ratios=(2.4, 5.8), squeeze=False)
        axes = parts[0, 0].subplots()
        lines = []
        for group in groups:
            for recorded, line in ((first, "-"), (second, "--")):
                now = _at(recorded, group, distance)
                start = next(
                    life[0].step for life in recorded.lives[group] if life[0].turned_at == now.turned_at
                )
                worn = worn_depth(start, now.step)
                lines.append((1e3 * start.profile.y, worn, line, colour(groups, group)))
        deepest = max(float(worn.max()) for _, worn, _, _ in lines)
        factor, unit = (1e3, "mm") if deepest > 0.1e-3 else (1e6, "µm")
        for y, worn, line, paint in lines:
            axes.plot(y, factor * worn, line, color=paint, linewidth=1.0)
        axes.set_ylim(bottom=0.0)
        axes.set_title(f"worn off at {1e-3 * distance:.0f} km, normal [{unit}]", loc="left", pad=3)
        axes.set_xlabel("lateral position on the wheel profile [mm], flange on the right")
        both = dict(zip(names, map(measures_table, (first, second)), strict=True))
        add_over_distance(parts[1, 0], both, groups)
    return figure


def _values(recorded: Recorded, group: str, distance: float) -> dict[str, float]:
    """Measures of a group at a distance by name with unit."""
    wheels = _at(recorded, group, distance)
    found = {name: factor * getattr(wheels.step.measures, key) for key, (name, factor) in _MEASURES.items()}
    places, y = recorded.places(group), wheels.grid.lateral
    for index, layer in wheels.cracks.items():
        found[f"tread_miner_{index}"] = places.largest(layer.damage, y)["tread"]
    return found


def _at(recorded: Recorded, group: str, distance: float) -> WheelCondition:
    """The wheels of a group at a distance: between two steps in proportion, unless they were turned there."""
    states = recorded.wheels[group]
    after = next(number for number, one in enumerate(states) if one.step.distance >= distance)
    if after == 0 or states[after].step.distance == distance:
        return states[after]
    before, later = states[after - 1], states[after]
    if before.turned_at != later.turned_at:
        return later
    return between(before, later, distance)
