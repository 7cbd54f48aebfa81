"""A study of assumptions as a figure: bands of life and wear above, what they come from below."""

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hh_exudyn.campaign.uncertainty.study import ALL, MOST, UNITS, Band, Influence, Study

_LOW, _HIGH, _BAND = "#2c7fb8", "#d95f0e", "0.35"


def uncertainty_figure(found: Study) -> Figure:
    """First turning, tread wear and flange wear, a column each.

    Above, for every group of wheels, the band of 5 to 95 %, the median (line) and the value with everything
    as it is (dot). Below, a tornado: the quantity of all wheels with one assumption alone at the low (blue)
    and at the high end (orange) of its range, the most important assumption first.

    Parameters
    ----------
    found
        The study.
    """
    figure = Figure(figsize=(13.0, 6.2), layout="constrained")
    quantities = list(found.influences)
    groups = list(dict.fromkeys(band.group for band in found.bands))
    axes = figure.subplots(2, len(quantities), squeeze=False, height_ratios=(max(len(groups), 3), MOST))
    for column, quantity in enumerate(quantities):
        above, below = axes[0, column], axes[1, column]
        own = [band for band in found.bands if band.quantity == quantity]
        _draw_bands(above, own)
        _draw_tornado(below, found.influences[quantity][:MOST], found.nominal[quantity])
        above.set_title(quantity, fontsize=10)
        below.set_xlabel(f"{quantity} [{_unit(quantity)}]", fontsize=9)
        for panel in (above, below):
            panel.tick_params(labelsize=8)
            panel.spines[["top", "right"]].set_visible(False)
    axes[1, 0].plot([], [], color=_LOW, linewidth=6, label="low end")
    axes[1, 0].plot([], [], color=_HIGH, linewidth=6, label="high end of the range")
    figure.legend(*axes[1, 0].get_legend_handles_labels(), loc="outside lower center", ncols=2, fontsize=8,
                  frameon=False)  # fmt: skip
    return figure


def _draw_bands(axes: Axes, bands: Sequence[Band]) -> None:
    """A line for each group; what is infinite is left open to the right."""
    farthest = max(
        (v for b in bands for v in (b.nominal, b.low, b.median, b.high) if math.isfinite(v)), default=1.0
    )
    for row, band in enumerate(bands):
        colour = "black" if band.group == ALL else _BAND
        if math.isfinite(band.low):
            end = band.high if math.isfinite(band.high) else 1.1 * farthest
            axes.plot(
                [band.low, end], [row, row], color=colour, linewidth=5, alpha=0.4, solid_capstyle="butt"
            )
            if not math.isfinite(band.high):
                axes.plot(end, row, ">", color=colour, markersize=6)
        if math.isfinite(band.median):
            axes.plot(band.median, row, "|", color=colour, markersize=13, markeredgewidth=1.6)
        if math.isfinite(band.nominal):
            axes.plot(band.nominal, row, "o", color=colour, markersize=4.5)
    axes.set_yticks(range(len(bands)), [band.group for band in bands])
    axes.set_ylim(len(bands) - 0.4, -0.6)
    axes.set_xlim(left=0.0)


def _draw_tornado(axes: Axes, influences: Sequence[Influence], nominal: float) -> None:
    """Bars from the value as it is to those at the ends of the ranges."""
    acting = [one for one in influences if one.at_ends is not None]
    if not acting or not math.isfinite(nominal):
        axes.text(
            0.5, 0.5, "nothing acts on it", ha="center", va="center", transform=axes.transAxes, fontsize=9
        )
        axes.set_yticks([])
        return
    axes.axvline(nominal, color="0.4", linewidth=0.8)
    for row, one in enumerate(acting):
        for end, colour in zip(one.at_ends or (), (_LOW, _HIGH), strict=True):
            if math.isfinite(end):
                axes.barh(row, end - nominal, 0.6, nominal, color=colour)
    labels = []
    for one in acting:
        (low, high), unit = one.assumption.ends, one.assumption.parameter.unit
        labels.append(f"{one.assumption.label}\n{low:.3g} to {high:.3g} {unit.replace('-', '')}".rstrip())
    axes.set_yticks(range(len(acting)), labels)
    axes.set_ylim(len(acting) - 0.4, -0.6)


def _unit(quantity: str) -> str:
    return UNITS[quantity].replace("um", "µm")
