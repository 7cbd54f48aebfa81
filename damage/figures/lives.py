"""Lives of wheels: how their diameter is used up, and what every turning was for."""

from collections.abc import Sequence

from matplotlib import colormaps
from matplotlib.figure import Figure

from damage.life.decision import CRACKS, DIAMETER, WEAR
from damage.life.limits import WheelLimits
from damage.life.turning import Turning

_CAUSES = {WEAR: "#2c7fb8", CRACKS: "#8c2d04", DIAMETER: "0.4"}
_GROUPS = colormaps["tab10"].colors  # type: ignore[attr-defined]


def lives_figure(turnings: Sequence[Turning], limits: WheelLimits) -> Figure:
    """Diameter over the distance, a line a group, and below it the diameter that each turning took.

    Marks have the colour of the cause. A bar is split: its full part is what the profile needed, the light
    one on it what the cracks took more. A cross is the end of a wheel.

    Parameters
    ----------
    turnings
        Of one group or several, in the order of each life.
    limits
        For the new and the least diameter.

    Raises
    ------
    ValueError
        There are no turnings.
    """
    if not turnings:
        raise ValueError("no turnings: there are no lives to draw")
    figure = Figure(figsize=(7.0, 4.6), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    groups = list(dict.fromkeys(one.group for one in turnings))
    farthest = 1e-3 * max(one.distance for one in turnings)
    for number, group in enumerate(groups):
        own = [one for one in turnings if one.group == group]
        distance, diameter = [0.0], [1e3 * limits.new_diameter]
        for one in own:
            distance += [1e-3 * one.distance, 1e-3 * one.distance]
            diameter += [1e3 * one.worn_diameter, 1e3 * one.diameter]
        above.plot(distance, diameter, color=_GROUPS[number % len(_GROUPS)], linewidth=1.2, label=group)
        width, shift = 0.012 * farthest, 0.012 * farthest * (number - 0.5 * (len(groups) - 1))
        for one in own:
            colour, at = _CAUSES.get(one.cause, "0.7"), 1e-3 * one.distance
            marker = "x" if one.condition is None else "o"
            above.plot(at, 1e3 * one.worn_diameter, marker, color=colour, markersize=5)
            if one.condition is not None:  # else there was no metal for its cut
                profile = 2e3 * one.cut_for_profile
                below.bar(at + shift, profile, width, color=colour)
                below.bar(at + shift, 2e3 * one.cut - profile, width, profile, color=colour, alpha=0.4)
    above.axhline(1e3 * limits.least_diameter, color="0.4", linewidth=0.8, linestyle="--")
    above.set_ylabel("diameter [mm]", fontsize=9)
    below.set_ylabel("diameter turned off [mm]", fontsize=9)
    below.set_xlabel("distance since new [km]", fontsize=9)
    causes = [cause for cause in _CAUSES if any(one.cause == cause for one in turnings)]
    for cause in causes:
        above.plot([], [], "o", color=_CAUSES[cause], markersize=5, label=f"due by {cause}")
    above.legend(fontsize=8, frameon=False)
    for axes in (above, below):
        axes.tick_params(labelsize=8)
        axes.spines[["top", "right"]].set_visible(False)
    below.set_xlim(0.0, 1.03 * farthest)
    below.set_ylim(bottom=0.0)
    return figure
