"""Fatigue over the profile: bars of 5 mm, one panel per wheel (Hossein-Nia 2018, figure 3-17 b),
and the profile shaded by it, for cases side by side (figure 3-18).
"""

from collections.abc import Mapping

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import EngFormatter
from numpy.typing import NDArray

from damage.patch_strips import FLANGE, TREAD
from damage.report import DamageReport
from damage.surface.wheel_surface import Wheel, WheelSurface
from hh_exudyn.contact.profile import Profile
from hh_exudyn.conventions import LEFT

BAR = 0.005  # width of a bar [m]
_TREAD_COLOUR, _FLANGE_COLOUR = "#8c2d04", "#2b5c8a"
_DARK = LinearSegmentedColormap.from_list(  # from light grey: the profile is visible without fatigue
    "dark", [(0.0, "0.92"), *((x, colormaps["YlOrBr"](0.1 + 0.9 * x)) for x in np.linspace(0.02, 1.0, 50))]
)


def rcf_bins_figure(report: DamageReport, distance: float, vehicle: int | None = None) -> Figure:
    """Revolutions with fatigue in bars of 5 mm across the profile, one panel per wheel.

    A bar is the mean over its width of the revolutions in which the place was beyond shakedown anywhere along
    the patch (local stress index SI > 0); the outline is that by the global index, FI_surf > 0 of the patch.
    In partial slip cells may be beyond shakedown while the patch as a whole is not: bars without an outline.
    A patch with FI_surf > 0 counts over its whole width: outlines above the bars.

    Parameters
    ----------
    report
        The damage of a run.
    distance
        Of running [m].
    vehicle
        Number of the vehicle; None for the first.

    Raises
    ------
    ValueError
        The vehicle is not in the report.
    """
    surface = report.surface.scaled(distance)
    number = surface.wheels[0].vehicle if vehicle is None else vehicle
    shown = {wheel: index for index, wheel in enumerate(surface.wheels) if wheel.vehicle == number}
    if not shown:
        raise ValueError(f"vehicle {number} is not in the report")
    wheelsets = sorted({wheel.wheelset for wheel in shown})
    figure = Figure(figsize=(7.0, 0.9 + 1.5 * len(wheelsets)), layout="constrained")
    axes = figure.subplots(len(wheelsets), 2, sharex=True, sharey=True, squeeze=False)
    edges = _bar_edges(surface)
    highest = 0.0
    for wheel, index in shown.items():
        place = axes[wheelsets.index(wheel.wheelset), 0 if wheel.side == LEFT else 1]
        bottom = np.zeros(edges.size - 1)
        for part, colour, name in ((TREAD, _TREAD_COLOUR, "tread"), (FLANGE, _FLANGE_COLOUR, "flange")):
            bars = _bars(surface, surface.ratchet_revolutions[index, part], edges)
            place.bar(
                edges[:-1] * 1e3, bars, BAR * 1e3, bottom, align="edge", color=colour,
                label=f"SI > 0, {name}", edgecolor="white", linewidth=0.4,
            )  # fmt: skip
            bottom = bottom + bars
        overall = _bars(surface, surface.fatigue_revolutions[index].sum(axis=0), edges)
        place.stairs(overall, edges * 1e3, color="0.2", linewidth=0.9, label="FI$_{surf}$ > 0")
        highest = max(highest, float(bottom.max()), float(overall.max()))
        side = "left" if wheel.side == LEFT else "right"
        place.set_title(f"wheelset {wheel.wheelset}, {side}", fontsize=8, loc="left", pad=2)
        place.tick_params(labelsize=7, direction="in")
        place.yaxis.set_major_formatter(EngFormatter())
    axes[0, 0].set_ylim(0.0, 1.06 * highest if highest > 0.0 else 1.0)
    figure.supxlabel(f"{_measure(surface)} [mm], flange on the right", fontsize=9)
    figure.supylabel(f"revolutions after {distance * 1e-3:,.0f} km", fontsize=9)
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3, frameon=False, fontsize=8)
    return figure


def rcf_cases_figure(
    cases: Mapping[str, DamageReport], wheel: Wheel, profile: Profile, distance: float
) -> Figure:
    """The wheel profile coloured by the revolutions with fatigue, one below the other for every case.

    Parameters
    ----------
    cases
        Reports by name.
    wheel
        The wheel.
    profile
        Its profile.
    distance
        Of running [m].

    Raises
    ------
    ValueError
        No cases, or a wheel that a case does not have.
    """
    if not cases:
        raise ValueError("no cases were given")
    values = {}
    for name, report in cases.items():
        surface = report.surface.scaled(distance)
        if wheel not in surface.wheels:
            raise ValueError(f"{wheel} is not in the report {name!r}")
        revolutions = surface.ratchet_revolutions[surface.wheels.index(wheel)].sum(axis=0)
        values[name] = surface.grid.lateral, revolutions
    norm = Normalize(0.0, max(float(revolutions.max()) for _, revolutions in values.values()) or 1.0)
    figure = Figure(figsize=(6.5, 0.8 + 1.7 * len(values)), layout="constrained")
    axes = figure.subplots(len(values), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    points = np.column_stack([profile.y, profile.z]) * 1e3
    pieces = np.stack([points[:-1], points[1:]], axis=1)
    middles = 0.5 * (profile.y[1:] + profile.y[:-1])
    for place, (name, (lateral, revolutions)) in zip(axes, values.items(), strict=True):
        lines = LineCollection(list(pieces), cmap=_DARK, norm=norm, linewidths=7.0, capstyle="butt")
        lines.set_array(np.interp(middles, lateral, revolutions))
        place.add_collection(lines)
        place.plot(*points.T, color="0.3", linewidth=0.6)
        place.set_title(f"{name}: max {float(revolutions.max()):,.0f} revolutions", fontsize=8, loc="left")
        place.set_aspect("equal")
        place.set_xlim(float(points[0, 0]), float(points[-1, 0]))
        place.margins(y=0.2)
        place.set_ylabel("z [mm]", fontsize=8)
        place.tick_params(labelsize=7, direction="in")
    axes[-1].set_xlabel("lateral position on the wheel profile [mm]", fontsize=8)
    bar = figure.colorbar(ScalarMappable(norm, _DARK), ax=axes, shrink=0.9, format=EngFormatter())
    bar.set_label(f"revolutions with SI > 0 after {distance * 1e-3:,.0f} km", fontsize=8)
    bar.ax.tick_params(labelsize=7)
    return figure


def _measure(surface: WheelSurface) -> str:
    """Coordinate of the bins."""
    arc = surface.grid.profile_arc is not None
    return "arc of the wheel profile from the running circle" if arc else "lateral position on the profile"


def _bar_edges(surface: WheelSurface) -> NDArray[np.float64]:
    """Edges of the bars over the bins that were in contact [m]."""
    used = surface.grid.centres[surface.contact_time.any(axis=(0, 1))]
    low, high = (used[0], used[-1]) if used.size else (surface.grid.edges[0], surface.grid.edges[-1])
    return BAR * np.arange(np.floor(low / BAR), np.ceil(high / BAR) + 1)


def _bars(
    surface: WheelSurface, values: NDArray[np.float64], edges: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Mean of the bins' values over each bar."""
    area = np.concatenate([[0.0], np.cumsum(values) * surface.grid.step])
    mean: NDArray[np.float64] = np.diff(np.interp(edges, surface.grid.edges, area)) / BAR
    return mean
