"""Figure of curving: quantities of every wheelset or wheel in full curves, over their radius."""

from collections.abc import Mapping

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator, ScalarFormatter

from hh_exudyn.arrays import FloatArray
from hh_exudyn.figures.style import SMALL, wheelset_colour


def curving_figure(title: str, radius: FloatArray, quantities: Mapping[str, FloatArray]) -> Figure:
    """Any quantities of any vehicle over the radius, a panel each.

    Parameters
    ----------
    title : str
        Above all panels.
    radius : (n,) array
        Of the curves [m], increasing.
    quantities : mapping of (n, wheelsets) or (n, wheelsets, 2) arrays
        By label with unit; of wheelsets, or of their left and right wheels.

    Raises
    ------
    ValueError
        No quantities, radii that do not increase, or arrays that do not fit them or each other.
    """
    shapes = {values.shape for values in quantities.values()}
    fitting = {shape for shape in shapes if len(shape) in (2, 3) and shape[0] == radius.size}
    if not shapes or shapes != fitting or len({shape[1] for shape in shapes}) != 1:
        raise ValueError(
            f"quantities must be arrays ({radius.size}, wheelsets) or ({radius.size}, wheelsets, 2) with one "
            f"number of wheelsets, they are {sorted(shapes)}"
        )
    if not np.all(np.diff(radius) > 0.0):
        raise ValueError(f"radii must increase, they are {radius.tolist()} m")
    wheelsets = shapes.pop()[1]
    rows = (len(quantities) + 1) // 2
    with rc_context(SMALL):
        figure = Figure(figsize=(9.0, 0.8 + 2.2 * rows), layout="constrained")
        figure.suptitle(title)
        panels = figure.subplots(rows, 2, sharex=True, squeeze=False).ravel()
        for axes, (label, values) in zip(panels, quantities.items(), strict=False):
            _draw(axes, radius, values)
            axes.set_ylabel(label)
        for axes in panels[len(quantities) :]:
            axes.set_visible(False)
        for axes in panels[max(len(quantities) - 2, 0) : len(quantities)]:
            axes.set_xlabel("radius [m]")
            axes.tick_params(labelbottom=True)
        marks = [
            Line2D([], [], color=wheelset_colour(i), label=f"wheelset {i + 1}") for i in range(wheelsets)
        ]
        if any(values.ndim == 3 for values in quantities.values()):
            marks += [
                Line2D([], [], color="black", marker="o", markersize=3, label="left wheel"),
                Line2D([], [], color="black", marker="s", markersize=3, linestyle=":", label="right wheel"),
            ]
        figure.legend(handles=marks, loc="outside lower center", ncols=8)
    return figure


def _draw(axes: Axes, radius: FloatArray, values: FloatArray) -> None:
    """One quantity; right wheels dotted."""
    of_wheels = values.ndim == 3
    for number in range(values.shape[1]):
        for side, style in enumerate(("-o", ":s") if of_wheels else ("-o",)):
            own = values[:, number, side] if of_wheels else values[:, number]
            axes.plot(radius, own, style, color=wheelset_colour(number), markersize=3, linewidth=1.0)
    axes.set_xscale("log")
    axes.set_xticks(radius)
    axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.xaxis.set_minor_locator(NullLocator())
    if values.min() < 0.0:
        axes.axhline(0.0, color="black", linewidth=0.5)
    axes.grid(alpha=0.3)
