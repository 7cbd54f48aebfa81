"""Runs beside each other: a panel for each quantity, a bar for each run."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from hh_exudyn.figures.style import SMALL

_COLUMNS = 4
_BAR = 0.22  # inches


def comparison_sheet(
    title: str, runs: Sequence[str], quantities: Mapping[str, Sequence[tuple[float, str]]]
) -> Figure:
    """Bars of all runs, the first at the top, with value and wheel.

    Parameters
    ----------
    title : str
        Above the panels.
    runs : sequence of str
        What each run differs in.
    quantities : mapping
        By name with unit: value and wheel of each run.
    """
    rows = -(-len(quantities) // _COLUMNS)
    place = np.arange(len(runs))
    with rc_context(SMALL):
        longest = max(map(len, runs))
        size = (8.0 + 0.07 * longest, rows * (_BAR * len(runs) + 0.8) + 0.6)
        figure = Figure(figsize=size, layout="constrained")
        figure.suptitle(title)
        panels = figure.subplots(rows, _COLUMNS, squeeze=False, sharey=True)
        for axes, (name, values) in zip(panels.flat, quantities.items(), strict=False):
            lengths = np.array([value for value, _ in values])
            axes.barh(place, np.nan_to_num(lengths), height=0.7, color="tab:blue", alpha=0.6)
            for y, (value, wheel) in zip(place, values, strict=True):
                if np.isfinite(value):
                    axes.annotate(
                        f"{value:.4g}  {wheel}",
                        (0.0, y),
                        xytext=(2, 0),
                        textcoords="offset points",
                        va="center",
                    )
            axes.set_title(name)
            axes.set_yticks(place, runs)
            axes.tick_params(labelleft=axes.get_subplotspec().is_first_col())
            axes.set_ylim(len(runs) - 0.5, -0.5)
        for axes in panels.flat[len(quantities) :]:
            axes.set_visible(False)
    return figure
