"""Figures of a campaign: measures over the distance, damage over the profile, what damage comes from."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pyarrow
from matplotlib import colormaps, rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase

from damage.life.limits import WheelLimits
from damage.life.places import BANDS
from hh_exudyn.campaign.results.recorded import Recorded
from hh_exudyn.campaign.results.tables import measures_table, profile_table

SMALL = {
    "font.size": 8, "legend.fontsize": 7.5, "axes.titlesize": 8, "axes.labelsize": 8, "xtick.labelsize": 7,
    "ytick.labelsize": 7, "xtick.direction": "in", "ytick.direction": "in", "axes.spines.top": False,
    "axes.spines.right": False, "legend.frameon": False,
}  # fmt: skip
WIDTH = 7.0  # inches, of all figures: a page of A4 between margins
_COLOURS = colormaps["tab10"].colors  # type: ignore[attr-defined]
_LINES = ("-", "--", "-.", ":")
_OVER_DISTANCE = (  # column, title, least span of the axis, so that no rounding fills it
    ("Sh_mm", "flange height Sh [mm]", 0.02),
    ("Sd_mm", "flange thickness Sd [mm]", 0.02),
    ("qR_mm", "qR [mm]", 0.02),
    ("hollow_mm", "hollow tread [mm]", 0.02),
    ("equivalent_conicity", "equivalent conicity [-]", 0.01),
    ("diameter_mm", "diameter [mm]", 0.02),
    ("p_max_MPa", "largest contact pressure [MPa]", 20.0),
    ("tread_miner_global", "tread: Miner's sum, global index [-]", 0.01),
    ("tread_miner_local", "tread: Miner's sum, local index [-]", 0.01),
)
_LIMITS = {
    "Sh_mm": ("largest_flange_height",),
    "Sd_mm": ("least_flange_thickness", "largest_flange_thickness"),
    "qR_mm": ("least_flange_steepness",),
    "hollow_mm": ("largest_hollow",),
    "diameter_mm": ("least_diameter",),
}
SHARES = {
    "distance_percent": ("distance", "0.75"),
    "wear_tread_percent": ("wear, tread", "#9ecae1"),
    "wear_root_percent": ("wear, root", "#3182bd"),
    "wear_flange_percent": ("wear, flange", "#08306b"),
    "cracks_global_percent": ("cracks, global index", "#fdae6b"),
    "cracks_local_percent": ("cracks, local index", "#d94801"),
}
_TITLES = {
    "curve_class": "curve class [m]",
    "running": "load",
    "season": "season",
    "quality": "track quality",
}
_TITLES |= {"haul": "train"}


def over_distance_figure(recorded: Recorded) -> Figure:
    """Measures of the wheels over the distance, a line a group; limits dashed where they are near."""
    with rc_context(SMALL):
        figure = Figure(figsize=(WIDTH, 5.8), layout="constrained")
        add_over_distance(figure, {"": measures_table(recorded)}, recorded.groups, _limits(recorded))
    return figure


def add_over_distance(
    figure: FigureBase,
    tables: dict[str, pyarrow.Table],
    groups: Sequence[str],
    limits: WheelLimits | None = None,
) -> None:
    """Draw measures of one campaign or more into a figure, all over the distance.

    Parameters
    ----------
    figure
        Empty.
    tables
        By name of the campaign, as `hh_exudyn.campaign.results.tables.measures_table`; lines differ by it.
    groups
        To be drawn; colours differ by them.
    limits
        To be drawn where the wheels are near them; None for none.
    """
    panels = figure.subplots(3, 3, sharex=True).ravel()
    for axes, (name, title, span) in zip(panels, _OVER_DISTANCE, strict=True):
        for (campaign, table), line in zip(tables.items(), _LINES, strict=False):
            for group in groups:
                own = _of_group(table, group)
                values = own[name].to_numpy().astype(np.float64)
                label = f"{group}, {campaign}" if campaign else group
                axes.plot(
                    own["distance_km"].to_numpy(), values, line, color=colour(groups, group), marker=".",
                    markersize=3.5, linewidth=1.0, label=label,
                )  # fmt: skip
        axes.set_title(title, loc="left", pad=3)
        axes.ticklabel_format(axis="y", useOffset=False)
        if not axes.dataLim.y0 > 0.0:
            axes.set_ylim(bottom=0.0)
        _widen(axes, span)
        for limit in _LIMITS.get(name, ()) if limits is not None else ():
            _add_limit(axes, 1e3 * getattr(limits, limit))
    panels[0].set_xlim(left=0.0)
    for axes in panels[-3:]:
        axes.set_xlabel("distance [km]")
    lines, labels = panels[0].get_legend_handles_labels()
    figure.legend(
        lines, labels, loc="outside lower center", ncols=2 if len(tables) > 1 else min(len(labels), 4)
    )


def over_profile_figure(recorded: Recorded) -> Figure:
    """Depth that has worn off, and Miner's sums, over the profile, a line a group, in the present life.

    Full lines: what is left of the cracks; dotted ones: without what wore off. Grey: root and flange; the
    lines in the tread part the two bands of cracks (`damage.life.places.BANDS`).
    """
    kinds = [kind for kind in recorded.kinds() if kind != "wear"]
    with rc_context(SMALL):
        figure = Figure(figsize=(WIDTH, 1.7 * (1 + len(kinds)) + 0.6), layout="constrained")
        panels = figure.subplots(1 + len(kinds), 1, sharex=True)
        rows = profile_table(recorded)
        deepest = max(rows["worn_um"].to_pylist())
        factor, unit = (1e-3, "mm") if deepest > 100.0 else (1.0, "µm")
        for group in recorded.groups:
            own, paint = _of_group(rows, group), colour(recorded.groups, group)
            y = own["y_mm"].to_numpy()
            panels[0].plot(y, factor * own["worn_um"].to_numpy(), color=paint, linewidth=1.0, label=group)
            for axes, kind in zip(panels[1:], kinds, strict=True):
                axes.plot(y, own[f"miner_{kind}"].to_numpy(), color=paint, linewidth=1.0)
                axes.plot(y, own[f"miner_without_wear_{kind}"].to_numpy(), ":", color=paint, linewidth=0.9)
        panels[0].set_ylabel(f"worn off, normal [{unit}]")
        for axes, kind in zip(panels[1:], kinds, strict=True):
            axes.set_ylabel(f"Miner's sum,\n{kind} index [-]")
        places = recorded.places(recorded.groups[0])
        wheel = recorded.wheels[recorded.groups[0]][0].step.profile
        for axes in panels:
            axes.set_ylim(bottom=0.0)
            axes.axvspan(1e3 * places.root, 1e3 * places.flange, color="0.95", zorder=0)
            axes.axvspan(1e3 * places.flange, 1e3 * wheel.y[-1], color="0.88", zorder=0)
            for edge in sorted({1e3 * edge for band in BANDS.values() for edge in band}):
                axes.axvline(edge, color="0.7", linewidth=0.5, zorder=0)
        panels[0].set_xlim(1e3 * wheel.y[0], 1e3 * wheel.y[-1])
        _name_places(panels[0], places.root, places.flange, wheel.y[-1])
        panels[-1].set_xlabel("lateral position on the wheel profile [mm], flange on the right")
        figure.legend(loc="outside lower center", ncols=4)
    return figure


def shares_figure(table: pyarrow.Table, group: str) -> Figure:
    """Shares of each curve class, load, season and quality in the wear and the cracks of a group.

    Parameters
    ----------
    table
        As `hh_exudyn.campaign.results.shares.shares_table` gives it.
    group
        Of wheels.
    """
    rows = [row for row in table.to_pylist() if row["group"] == group]
    labels = {row["label"]: [one for one in rows if one["label"] == row["label"]] for row in rows}
    labels = {label: own for label, own in labels.items() if len(own) > 1}  # one value alone has all
    columns = [name for name in table.column_names if name in SHARES]
    with rc_context(SMALL):
        heights = [len(own) for own in labels.values()]
        figure = Figure(figsize=(WIDTH, 0.4 * sum(heights) + 0.3 * len(labels) + 0.7), layout="constrained")
        panels = figure.subplots(len(labels), 1, sharex=True, height_ratios=heights, squeeze=False).ravel()
        width = 0.84 / len(columns)
        for axes, (label, own) in zip(panels, labels.items(), strict=True):
            place = np.arange(len(own))
            for number, name in enumerate(columns):
                title, paint = SHARES[name]
                shares = [0.0 if row[name] is None else row[name] for row in own]
                at = place + width * (number - 0.5 * (len(columns) - 1))
                axes.barh(at, shares, 0.92 * width, color=paint, label=title)
            axes.set_yticks(place, [row["value"] for row in own])
            axes.set_ylim(len(own) - 0.5, -0.5)
            axes.set_title(_TITLES[label], loc="left", pad=2)
            axes.grid(axis="x", color="0.9", linewidth=0.5)
            axes.set_axisbelow(True)
        panels[-1].set_xlabel("share [%]")
        lines, names = panels[0].get_legend_handles_labels()
        figure.legend(lines, names, loc="outside lower center", ncols=3)
    return figure


def errors_figure(recorded: Recorded, errors: Mapping[str, Any]) -> Figure:
    """Rates of wear at some places of the profile, with half the width of their interval, a panel a group.

    Parameters
    ----------
    recorded
        The steps.
    errors
        As `hh_exudyn.campaign.results.errors.errors_of` gives them.
    """
    with rc_context(SMALL):
        rows = -(-len(recorded.groups) // 2)
        figure = Figure(figsize=(WIDTH, 1.9 * rows + 0.4), layout="constrained")
        panels = figure.subplots(rows, 2, sharex=True, sharey=True, squeeze=False).ravel()
        for axes, group in zip(panels, recorded.groups, strict=False):
            found = {
                float(name.split("y = ")[1].split(" mm")[0]): (1e12 * total, sampling)
                for name, total, sampling in zip(
                    errors["quantities"], errors["total"], errors["sampling"], strict=True
                )
                if name.startswith(f"{group}: wear at y = ")
            }
            rates = [rate for rate, _ in found.values()]
            half = [share * max(rates, default=0.0) for _, share in found.values()]  # of the deepest place
            axes.errorbar(
                list(found), rates, half, fmt="o", markersize=3, capsize=2.5, linewidth=1.0,
                color=colour(recorded.groups, group),
            )  # fmt: skip
            axes.set_title(f"{group}: wear [µm per 1000 km]", loc="left", pad=3)
            axes.axhline(0.0, color="0.7", linewidth=0.5)
        for axes in panels[len(recorded.groups) :]:
            axes.set_visible(False)
        figure.supxlabel("lateral position on the wheel profile [mm], flange on the right", fontsize=8)
    return figure


def colour(groups: Sequence[str], group: str) -> tuple[float, float, float]:
    """Colour of a group; the eleventh has that of the first.

    Parameters
    ----------
    groups
        All of the campaign.
    group
        One of them.
    """
    found: tuple[float, float, float] = _COLOURS[list(groups).index(group) % len(_COLOURS)]
    return found


def _of_group(table: pyarrow.Table, group: str) -> pyarrow.Table:
    return table.filter(pyarrow.array(np.array(table["group"].to_pylist()) == group))


def _limits(recorded: Recorded) -> WheelLimits | None:
    workshop = recorded.campaign.plan.workshop
    return None if workshop is None else workshop.limits


def _widen(axes: Axes, span: float) -> None:
    """Make an axis at least so wide."""
    low, high = axes.get_ylim()
    if high - low < span:
        middle = 0.5 * (low + high)
        bottom = middle - 0.5 * span
        if middle >= 0.0 > bottom:
            bottom = 0.0  # measures are not below zero
        axes.set_ylim(bottom, bottom + span)


def _add_limit(axes: Axes, value: float) -> None:
    """A dashed line, where the axis need not grow by more than its own height."""
    low, high = axes.get_ylim()
    if low - (high - low) <= value <= high + (high - low):
        axes.axhline(value, color="0.4", linewidth=0.8, linestyle=(0, (4, 3)))


def _name_places(axes: Axes, root: float, flange: float, end: float) -> None:
    """Write the places of a wheel above the panel."""
    for name, low, high in (("root", root, flange), ("flange", flange, end)):
        axes.text(
            0.5e3 * (low + high), 1.01, name, transform=axes.get_xaxis_transform(), ha="center",
            va="bottom", color="0.35",
        )  # fmt: skip
    (field, middle) = (1e3 * np.mean(band) for band in BANDS.values())
    for name, at in (("field band", field), ("middle band", middle)):
        axes.text(
            float(at),
            1.01,
            name,
            transform=axes.get_xaxis_transform(),
            ha="center",
            va="bottom",
            color="0.35",
        )
