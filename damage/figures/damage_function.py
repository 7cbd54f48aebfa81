"""The whole-life rail function: damage per passage over the wear number."""

import numpy as np
from matplotlib.figure import Figure

from damage.rcf.whole_life_rail import BURSTOW_RAIL, DamageFunction

_COLOURS = ("black", "#8c2d04", "#2b5c8a", "#4d7c4d")


def damage_function_figure(functions: dict[str, DamageFunction] | None = None) -> Figure:
    """Damage functions over the wear number, as figure 3-27 of Hossein-Nia (2018).

    Parameters
    ----------
    functions
        By name, at most four; None for Burstow's of rails.
    """
    shown = functions or {"rail (Burstow)": BURSTOW_RAIL}
    highest = max(function.balance for function in shown.values()) * 1.3
    energy = np.unique(  # with the turning points, so that no peak is cut
        np.concatenate(
            [np.linspace(0.0, highest, 300), *([f.onset, f.peak, f.balance] for f in shown.values())]
        )
    )
    peak = max(function.peak_damage for function in shown.values())
    figure = Figure(figsize=(5.0, 3.4), layout="constrained")
    axes = figure.subplots()
    for (name, function), colour in zip(shown.items(), _COLOURS, strict=False):
        axes.plot(energy, function.damage(energy) * 1e6, color=colour, linewidth=1.4, label=name)
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.set_xlim(0.0, highest)
    axes.set_ylim(-0.6e6 * peak, 1.2e6 * peak)
    axes.text(0.02 * highest, 1.1e6 * peak, "cracks grow", fontsize=8, style="italic")
    axes.text(0.02 * highest, -0.15e6 * peak, "wear prevails", fontsize=8, style="italic")
    axes.set_xlabel("wear number $\\bar{E}$ [N]")
    axes.set_ylabel("damage per passage [10$^{-6}$]")
    axes.legend(fontsize=8, frameon=False)
    return figure
