"""A wheel profile over its life: profiles, wear depth, and measures over the distance."""

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from damage.evolution.history import WearHistory, WearStep
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.cleaning import arc_length

_COLOURS = colormaps["viridis_r"]
_MOST_LINES = 12
_PANELS = (
    ("flange_height", "flange height Sh [mm]", 1e3),
    ("flange_thickness", "flange thickness Sd [mm]", 1e3),
    ("flange_steepness", "qR [mm]", 1e3),
    ("hollow", "hollow tread [mm]", 1e3),
    ("conicity", "equivalent conicity [-]", 1.0),
    ("diameter", "diameter [mm]", 1e3),
)


def profiles_figure(history: WearHistory) -> Figure:
    """Profiles over the distance, and below them the depth that has worn off, over the lateral position.

    The profiles lie as on the axle: the first one's running circle is at z = 0. The depth is that of each
    profile below the first one, measured along the first one's normals.
    """
    figure = Figure(figsize=(7.0, 4.2), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(1, 1))
    shown = _shown(history)
    first = history.steps[0]
    begun = 1e-3 * first.distance
    scale = Normalize(begun, max(1e-3 * history.last.distance, begun + 1.0))
    for step in shown:
        colour = _COLOURS(scale(1e-3 * step.distance))
        y, z = _on_axle(first, step)
        above.plot(1e3 * y, 1e3 * z, color=colour, linewidth=1.0)
        if step is not first:
            below.plot(1e3 * first.profile.y, 1e3 * worn_depth(first, step), color=colour, linewidth=1.0)
    above.set_aspect("equal")
    above.set_ylabel("z [mm]", fontsize=9)
    below.set_ylabel("worn off, normal [mm]", fontsize=9)
    below.set_xlabel("lateral position on the wheel profile [mm], flange on the right", fontsize=9)
    below.set_ylim(bottom=0.0)
    below.axvline(0.0, color="0.85", linewidth=0.6, zorder=0)
    _finish(above)
    _finish(below)
    bar = figure.colorbar(ScalarMappable(scale, _COLOURS), ax=(above, below), shrink=0.9)
    bar.set_label("distance [km]", fontsize=9)
    bar.ax.tick_params(labelsize=7)
    return figure


def measures_figure(history: WearHistory) -> Figure:
    """Flange height and thickness, qR, hollow, equivalent conicity and diameter over the distance."""
    figure = Figure(figsize=(7.0, 4.2), layout="constrained")
    panels = figure.subplots(2, 3, sharex=True).ravel()
    distance = [1e-3 * step.distance for step in history.steps]
    for axes, (name, title, factor) in zip(panels, _PANELS, strict=True):
        values = [factor * getattr(step.measures, name) for step in history.steps]
        axes.plot(distance, values, color="#8c2d04", marker=".", markersize=4, linewidth=1.0)
        axes.set_title(title, fontsize=8, loc="left", pad=3)
        axes.ticklabel_format(axis="y", useOffset=False)
        if np.ptp(values) < 1e-3:  # a measure that does not change: no axis full of rounding
            low = max(float(np.mean(values)) - 0.01, 0.0)
            axes.set_ylim(low, low + 0.02)
        _finish(axes)
    figure.supxlabel("distance [km]", fontsize=9)
    return figure


def worn_depth(first: WearStep, step: WearStep) -> FloatArray:
    """Distance of a later profile inside the first one, along the normals at the first one's points [m].

    The points of a profile keep their order in a step of wear but move along it where normals turn; that
    tangential displacement does not count.

    Parameters
    ----------
    first, step
        The earlier and the later step of the same wheel.
    """
    y, z = _on_axle(first, step)
    s = arc_length(first.profile.y, first.profile.z)
    along_y, along_z = np.gradient(first.profile.y, s), np.gradient(first.profile.z, s)
    length = np.hypot(along_y, along_z)
    return ((z - first.profile.z) * along_y - (y - first.profile.y) * along_z) / length


def _on_axle(first: WearStep, step: WearStep) -> tuple[FloatArray, FloatArray]:
    """A profile's line, its height counted from the first one's running circle."""
    return step.profile.y, step.profile.z + (first.radius - step.radius)


def _shown(history: WearHistory) -> list[WearStep]:
    """The first, the last, and some evenly between them."""
    last = len(history.steps) - 1
    chosen = np.unique(np.round(np.linspace(0, last, min(_MOST_LINES, last + 1))).astype(int))
    return [history.steps[number] for number in chosen]


def _finish(axes: Axes) -> None:
    axes.tick_params(labelsize=7, direction="in")
