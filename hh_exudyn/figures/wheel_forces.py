"""Figures of the forces of wheels on rails: distributions and spectra."""

from collections.abc import Mapping

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from hh_exudyn.arrays import FloatArray
from hh_exudyn.figures.style import SMALL

BINS = 30  # of each histogram
_COLOURS = ("tab:green", "tab:orange", "tab:purple", "tab:brown")
_STYLES = ("-", "--", "-.", ":")
_LOWEST, _HIGHEST = "tab:blue", "tab:red"
_SIDES = ("left", "right")


def force_histograms(
    title: str, label: str, forces: Mapping[str, FloatArray], measured: FloatArray | None = None
) -> Figure:
    """Distribution of a force at every wheel, a panel each; least and largest values as lines.

    As Figures 1-20 and 1-21 of Hossein-Nia (2018): blue and red lines bound the calculated forces, grey are
    measured forces. All histograms have the area 1.

    Parameters
    ----------
    title : str
        Above all panels.
    label : str
        Of the force, without unit: "Q".
    forces : mapping of (n, wheelsets, 2) arrays
        Forces of the left and right wheels [N], by a name for the legend, such as the load of the wagon.
    measured : (n, wheelsets, 2) array or None
        Measured forces of the same wheels [N]; None, the default, for none.

    Raises
    ------
    ValueError
        No forces, or of another number of wheelsets.
    """
    groups = dict(forces) if measured is None else {**forces, "measured": measured}
    shapes = {values.shape[1:] for values in groups.values()}
    if (
        not forces
        or len(shapes) != 1
        or any(values.ndim != 3 or not values.size for values in groups.values())
    ):
        raise ValueError(f"forces must be one or more arrays (n, wheelsets, 2), they are {sorted(shapes)}")
    wheelsets = shapes.pop()[0]
    with rc_context(SMALL):
        figure, panels = _wheel_panels(title, wheelsets, f"{label} [kN]", "density [1/kN]")
        for (number, side), axes in np.ndenumerate(panels):
            if measured is not None:
                own = 1e-3 * measured[:, number, side]
                axes.hist(own, BINS, density=True, color="lightgray", label="measured")
            for place, (name, values) in enumerate(forces.items()):
                _draw_range(axes, 1e-3 * values[:, number, side], place, name)
            axes.margins(x=0.08)  # room for the numbers at the lines
        figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=5)
    return figure


def _wheel_panels(
    title: str, wheelsets: int, x_label: str, y_label: str
) -> tuple[Figure, NDArray[np.object_]]:
    """A figure with a panel for every wheel: a row a wheelset, left and right wheel."""
    figure = Figure(figsize=(8.0, 1.2 + 1.4 * wheelsets), layout="constrained")
    figure.suptitle(title)
    panels = figure.subplots(wheelsets, 2, sharex=True, sharey=True, squeeze=False)
    for (number, side), axes in np.ndenumerate(panels):
        axes.set_title(f"wheelset {number + 1}, {_SIDES[side]}")
        axes.grid(alpha=0.3)
    for axes in panels[-1]:
        axes.set_xlabel(x_label)
    for axes in panels[:, 0]:
        axes.set_ylabel(y_label)
    return figure, panels


def _draw_range(axes: Axes, values: FloatArray, place: int, name: str) -> None:
    """The histogram of the group at a place, with its least and largest value [kN]."""
    axes.hist(values, BINS, density=True, color=_COLOURS[place % len(_COLOURS)], alpha=0.6, label=name)
    for value, line, align in ((values.min(), _LOWEST, "right"), (values.max(), _HIGHEST, "left")):
        axes.axvline(value, color=line, linewidth=1.0, linestyle=_STYLES[place % len(_STYLES)])
        axes.annotate(
            f"{round(value) + 0.0:.0f}", (value, 0.97 - 0.13 * place), xycoords=("data", "axes fraction"),
            xytext=(-2 if align == "right" else 2, 0), textcoords="offset points", va="top", ha=align,
            color=line, fontsize=7,
        )  # fmt: skip


def force_spectra(
    title: str,
    label: str,
    spectra: Mapping[str, tuple[FloatArray, FloatArray]],
    marks: Mapping[str, float] | None = None,
    highest: float = 60.0,
) -> Figure:
    """Power spectral densities of a force at every wheel, a panel each.

    Parameters
    ----------
    title, label : str
        As for `force_histograms`.
    spectra : mapping of (m,) and (m, wheelsets, 2) arrays
        Frequency [Hz] and density [N^2/Hz], by the name of the run.
    marks : mapping of float or None
        Frequencies [Hz] of vertical lines, by their name for the legend; None, the default, for none.
    highest : float
        End of the frequency axis [Hz].

    Raises
    ------
    ValueError
        No spectra, or of another number of wheelsets.
    """
    shapes = {density.shape[1:] for _, density in spectra.values()}
    if len(shapes) != 1 or any(density.ndim != 3 for _, density in spectra.values()):
        raise ValueError(f"spectra must be one or more arrays (m, wheelsets, 2), they are {sorted(shapes)}")
    wheelsets = shapes.pop()[0]
    with rc_context(SMALL):
        figure, panels = _wheel_panels(title, wheelsets, "frequency [Hz]", f"PSD of {label}\n[kN²/Hz]")
        for (number, side), axes in np.ndenumerate(panels):
            for name, (frequency, density) in spectra.items():
                shown = (frequency > 0.0) & (frequency <= highest)
                axes.semilogy(
                    frequency[shown], 1e-6 * density[shown, number, side], linewidth=0.9, label=name
                )
            for name, mark in (marks or {}).items():
                axes.axvline(mark, color="black", linestyle=":", linewidth=0.9, label=name)
            axes.set_xlim(0.0, highest)
        figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=5)
    return figure
