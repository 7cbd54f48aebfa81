"""Wear ratio over the lateral position on the wheel (figure 3-26 of Hossein-Nia 2018)."""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator
from numpy.typing import ArrayLike

from damage.wear.wear_ratio import WearRatio

_LOGARITHMIC_FROM = 5.0  # largest over smallest ratio [-]
_RATIO_COLOUR, _ENERGY_COLOUR = "#8c2d04", "#c9c9c9"


def wear_ratio_figure(
    y: ArrayLike, ratios: Mapping[str, WearRatio], unit: str = "mm/J", factor: float = 1.0
) -> Figure:
    """One panel per ratio: depth over energy, and in the background the distribution of the energy behind it.

    Parameters
    ----------
    y
        (B,) lateral positions on the wheel profile, positive towards the flange [m].
    ratios
        The ratios by the panels' titles.
    unit
        Of the ratio, times `factor`.
    factor
        Factor from the ratio's own unit to `unit` [-].

    Raises
    ------
    ValueError
        No ratio, or one on other positions.
    """
    positions = np.asarray(y, dtype=np.float64)
    if not ratios:
        raise ValueError("no wear ratio to draw")
    for name, ratio in ratios.items():
        if ratio.depth.shape != positions.shape:
            raise ValueError(f"wear ratio {name!r} has {ratio.depth.size} positions, y has {positions.shape}")
    learnt = np.any([ratio.energy > 0.0 for ratio in ratios.values()], axis=0)
    shown = positions[learnt] * 1e3
    figure = Figure(figsize=(6.4, 2.6 * len(ratios) + 0.4), layout="constrained")
    panels = figure.subplots(len(ratios), 1, sharex=True, squeeze=False)[:, 0]
    for axes, (name, ratio) in zip(panels, ratios.items(), strict=True):
        behind = axes.twinx()
        behind.fill_between(
            positions * 1e3, 100.0 * ratio.energy / ratio.energy.sum(), step="mid", color=_ENERGY_COLOUR,
            linewidth=0.0,
        )  # fmt: skip
        behind.set_ylim(bottom=0.0)
        behind.set_ylabel("share of energy [% per bin]", color="#707070", fontsize=8)
        behind.tick_params(labelsize=8, colors="#707070")
        axes.set_zorder(behind.get_zorder() + 1)
        axes.patch.set_visible(False)
        axes.step(positions * 1e3, ratio.ratio * factor, where="mid", color=_RATIO_COLOUR, linewidth=1.2)
        axes.axhline(ratio.mean * factor, color=_RATIO_COLOUR, linewidth=0.8, linestyle="--")
        axes.annotate(
            f"mean {ratio.mean * factor:.3g}", (0.01, ratio.mean * factor),
            xycoords=("axes fraction", "data"), xytext=(2.0, 3.0), textcoords="offset points",
            fontsize=8, color=_RATIO_COLOUR,
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0},
        )  # fmt: skip
        if np.nanmax(ratio.ratio) > _LOGARITHMIC_FROM * np.nanmin(ratio.ratio) > 0.0:
            axes.set_yscale("log")
            axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.3g}"))
            axes.yaxis.set_minor_locator(NullLocator())
        else:
            axes.set_ylim(bottom=0.0)
        axes.set_title(name, loc="left", fontsize=9)
        axes.set_ylabel(f"wear ratio [{unit}]")
    panels[-1].set_xlim(float(shown.min()) - 2.0, float(shown.max()) + 2.0)
    panels[-1].set_xlabel("lateral position on the wheel [mm], flange on the right")
    return figure
