"""Wear over the profiles of the rails: a row for each stretch of track, its left and its right rail.

Rails are drawn as seen forwards along the track: the gauge face of the left rail is on its right.
"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from damage.rails.rail_surface import RailSurface
from damage.rails.report import PlacedRails, RailReport
from hh_exudyn.conventions import LEFT

MOST_PLACES = 4  # of a figure: those that wear most
_HEAD_COLOUR, _GAUGE_COLOUR = "#8c2d04", "#2b5c8a"
_BELOW = 0.8  # room below zero, for the profile, over the room above [-]
_DEPTH = 0.040  # of a rail that is shown [m]


def rail_wear_figure(report: RailReport) -> Figure:
    """Wear depth over the profiles of the rails, mm per 100 MGT.

    Each panel has its own scale: a dry gauge face wears hundreds of times faster than a low rail's top.

    Parameters
    ----------
    report
        The damage of the rails of a run; of many stretches those with the most worn area are drawn.
    """
    worn = [sum(rail.worn_area_per_mgt for rail in one.pair) for one in report.found]
    chosen = sorted(np.argsort(worn)[::-1][:MOST_PLACES].tolist())
    figure = Figure(figsize=(7.0, 0.8 + 2.0 * len(chosen)), layout="constrained")
    axes = figure.subplots(len(chosen), 2, squeeze=False)
    for row, k in zip(axes, chosen, strict=True):
        for panel, rail in zip(row, report.found[k].pair, strict=True):
            _panel(panel, report, report.found[k], rail)
    steel = report.rails.material.name
    figure.supylabel(f"wear depth of rails of {steel} [mm per 100 MGT]", fontsize=9)
    figure.supxlabel("place on the rail profile [mm], seen forwards along the track", fontsize=9)
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper left", ncols=2, frameon=False, fontsize=8)
    return figure


def _panel(axes: Axes, report: RailReport, placed: PlacedRails, rail: RailSurface) -> None:
    """Depth by contact on head and gauge, the rail below."""
    place, forwards = placed.place, -1.0 if rail.side != LEFT else 1.0
    grid, factor = rail.by_wheel.grid, 100.0 * rail.per_mgt * 1e3
    head, gauge = factor * rail.by_wheel.depth_by_part.sum(axis=0)
    y = forwards * grid.lateral * 1e3
    for bottom, depth, colour, name in (
        (0.0 * head, head, _HEAD_COLOUR, "by contact on the head"),
        (head, gauge, _GAUGE_COLOUR, "by contact at gauge corner and face"),
    ):
        axes.fill_between(y, bottom, bottom + depth, step="mid", color=colour, linewidth=0, label=name)
    highest = float((head + gauge).max())
    top = 1.5 * highest if highest > 0.0 else 1.0
    profile = place.profile(rail.side)
    shown = profile.z > profile.z.max() - _DEPTH
    across = forwards * profile.y[shown] * 1e3
    axes.set_xlim(across.min() - 3.0, across.max() + 3.0)
    axes.set_ylim(-_BELOW * top, top)
    axes.axhline(0.0, color="black", linewidth=0.6)
    ticks = MaxNLocator(4).tick_values(0.0, top)
    axes.set_yticks([tick for tick in ticks if 0.0 <= tick <= top])
    axes.tick_params(labelsize=7, direction="in")
    height = profile.z[shown]
    scaled = _BELOW * top * (height - height.max()) / _DEPTH * 0.9 - 0.04 * top
    axes.fill_between(across, scaled, -_BELOW * top, color="0.9", linewidth=0)
    axes.plot(across, scaled, color="0.25", linewidth=1.0)
    axes.set_title(f"{place.title}: {place.rail_name(rail.side)} rail", fontsize=8, loc="left", pad=2)
    text = f"max {highest:.3g}, {100.0 * rail.worn_area_per_mgt * 1e6:.3g} mm² per 100 MGT"
    if report.seized(rail):
        text += "\nseizure: not to be extrapolated"
    axes.text(0.02, 0.96, text, transform=axes.transAxes, ha="left", va="top", fontsize=7, color="0.25")
