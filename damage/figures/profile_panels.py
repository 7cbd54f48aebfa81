"""Wear and fatigue over the wheel profile, one panel per wheel.

Every panel shows the wheel profile in side coordinates: the flange is on the right in all of them.
"""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from damage.patch_strips import FLANGE, TREAD
from damage.report import NOT_EXTRAPOLATED, DamageReport
from damage.surface.wheel_surface import Wheel
from hh_exudyn.contact.profile import Profile
from hh_exudyn.conventions import LEFT

FLANGE_ROOT = 0.027  # lateral position of the flange root without a profile: 15 degrees on S1002 [m]
_SHOWN = (-0.065, 0.060)  # lateral range of the panels [m]
_BELOW = 0.75  # room below zero, for the profile, over the room above [-]
_TREAD_COLOUR, _FLANGE_COLOUR, _CONTACT_COLOUR = "#8c2d04", "#2b5c8a", "#c9c9c9"


def wear_figure(
    report: DamageReport,
    profile: Profile | None = None,
    vehicle: int | None = None,
    outer_side: int | None = None,
) -> Figure:
    """Wear depth over the wheel profile, one panel per wheel.

    Flange wear much larger than that of the tread is drawn reduced; the panel gives the factor and the
    largest depth of both, and says where flange wear under seizure is not to be extrapolated.

    Parameters
    ----------
    report
        The damage of a run.
    profile
        Wheel profile to draw below the depth; None for none.
    vehicle
        Number of the vehicle; None for the first.
    outer_side
        Side of the outer wheels of the curve (+1 left, -1 right), for their names; None for no such names.
    """
    figure, panels = _panels(report, vehicle, outer_side, "wear depth [mm per 1000 km]")
    y = report.surface.grid.lateral
    depths = {index: report.surface.depth_per_km[index] * 1e6 for index in panels}  # mm per 1000 km
    root = _flange_root(profile, report.model.flange_angle)
    tread, flange = y < root, y >= root
    highest = {
        place: max(float(depth[where].max()) for depth in depths.values())
        for place, where in (("tread", tread), ("flange", flange))
    }
    # the same room for both: a dry flange root wears hundreds of times faster than the tread
    shrunk = max(1.0, highest["flange"] / highest["tread"]) if highest["tread"] > 0.0 else 1.0
    lines = 2 if any(report.seized[index] for index in panels) else 1
    _finish(panels, profile, root, max(highest["tread"], highest["flange"] / shrunk), lines)
    for index, axes in panels.items():
        for place, where, across, colour, scale in (
            ("tread", tread, 0.02, _TREAD_COLOUR, 1.0),
            ("flange", flange, 0.985, _FLANGE_COLOUR, shrunk),
        ):
            depth = np.where(where, depths[index], 0.0)
            axes.fill_between(y * 1e3, depth / scale, step="mid", color=colour, linewidth=0)
            largest = float(depth.max())
            text = f"{place}: max {largest:.3g}" if largest > 0.0 else place
            if largest > 0.0 and scale > 1.0:
                text += f", drawn 1:{scale:.0f}"
            if place == "flange" and report.seized[index]:
                text += f"\nseizure: {NOT_EXTRAPOLATED}"
            _corner_text(axes, text, across)
    return figure


def fatigue_figure(
    report: DamageReport,
    profile: Profile | None = None,
    vehicle: int | None = None,
    outer_side: int | None = None,
) -> Figure:
    """Share of the time that each place of the profile lay in a patch beyond shakedown, per wheel.

    The share in contact is drawn behind it. Parameters are those of `wear_figure`.
    """
    figure, panels = _panels(report, vehicle, outer_side, "share of time [%]")
    surface = report.surface
    y = surface.grid.lateral * 1e3
    # where two patches of a wheel overlap, both have counted there; the wheel was in contact once
    contact = {
        index: np.minimum(100.0 * surface.contact_time[index].sum(axis=0) / surface.time, 100.0)
        for index in panels
    }
    root = _flange_root(profile, report.model.flange_angle)
    _finish(panels, profile, root, max(float(share.max()) for share in contact.values()))
    for index, axes in panels.items():
        axes.fill_between(
            y, contact[index], step="mid", color=_CONTACT_COLOUR, linewidth=0, label="in contact"
        )
        for part, name, colour in (
            (TREAD, "FI$_{surf}$ > 0, tread", _TREAD_COLOUR),
            (FLANGE, "FI$_{surf}$ > 0, flange", _FLANGE_COLOUR),
        ):
            share = np.minimum(100.0 * surface.fatigue_time[index, part] / surface.time, 100.0)
            axes.fill_between(y, share, step="mid", color=colour, linewidth=0, label=name)
        _corner_text(axes, "flange", 0.985)
    handles, labels = next(iter(panels.values())).get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3, frameon=False, fontsize=8)
    return figure


def _panels(
    report: DamageReport, vehicle: int | None, outer_side: int | None, quantity: str
) -> tuple[Figure, dict[int, Axes]]:
    """One panel per wheel of a vehicle: a row per wheelset, left wheels on the left.

    Returns the figure and the panels by the wheel's index in the report.
    """
    wheels = report.surface.wheels
    number = wheels[0].vehicle if vehicle is None else vehicle
    shown = {wheel: index for index, wheel in enumerate(wheels) if wheel.vehicle == number}
    if not shown:
        raise ValueError(f"vehicle {number} is not in the report")
    wheelsets = sorted({wheel.wheelset for wheel in shown})
    figure = Figure(figsize=(7.0, 0.8 + 1.6 * len(wheelsets)), layout="constrained")
    axes = figure.subplots(len(wheelsets), 2, sharex=True, sharey=True, squeeze=False)
    panels = {}
    for wheel, index in shown.items():
        place = axes[wheelsets.index(wheel.wheelset), 0 if wheel.side == LEFT else 1]
        place.set_title(_wheel_name(wheel, outer_side), fontsize=8, loc="left", pad=2)
        panels[index] = place
    figure.supylabel(quantity, fontsize=9)
    figure.supxlabel("lateral position on the wheel profile [mm], flange on the right", fontsize=9)
    return figure, panels


def _wheel_name(wheel: Wheel, outer_side: int | None) -> str:
    """Name of a wheel in a panel."""
    curve = "" if outer_side is None else (", outer" if wheel.side == outer_side else ", inner")
    return f"wheelset {wheel.wheelset}, {'left' if wheel.side == LEFT else 'right'}{curve}"


def _corner_text(axes: Axes, text: str, across: float) -> None:
    """Small text at the top of a panel; `across` from 0 (left) to 1 (right)."""
    axes.text(
        across,
        0.95,
        text,
        transform=axes.transAxes,
        ha="left" if across < 0.5 else "right",
        va="top",
        fontsize=7,
        color="0.25",
    )


def _flange_root(profile: Profile | None, flange_angle: float) -> float:
    """Lateral place, outwards from the running circle, at which the flange angle is first exceeded [m]."""
    if profile is None:
        return FLANGE_ROOT
    middles = 0.5 * (profile.y[1:] + profile.y[:-1])
    steep = (middles > 0.0) & (-np.diff(profile.z) / np.diff(profile.y) > math.tan(flange_angle))
    return float(middles[np.argmax(steep)]) if steep.any() else float(profile.y[-1])


def _finish(
    panels: dict[int, Axes], profile: Profile | None, root: float, highest: float, lines: int = 1
) -> None:
    """One scale for all panels with room for lines of text; flange side marked, outline below zero."""
    top = (1.0 + 0.3 * lines) * highest if highest > 0.0 else 1.0
    for axes in panels.values():
        axes.set_xlim(_SHOWN[0] * 1e3, _SHOWN[1] * 1e3)
        axes.set_ylim(0.0 if profile is None else -_BELOW * top, top)
        axes.axvspan(root * 1e3, _SHOWN[1] * 1e3, color="#eef3f8", zorder=0)
        axes.axvline(0.0, color="0.85", linewidth=0.6, zorder=0)
        axes.tick_params(labelsize=7, direction="in")
        axes.set_yticks(
            [tick for tick in MaxNLocator(4).tick_values(0.0, top) if 0.0 <= tick <= 1.1 * highest]
        )
        if profile is not None:
            axes.axhline(0.0, color="black", linewidth=0.6)
            _draw_outline(axes, profile)


def _draw_outline(axes: Axes, profile: Profile) -> None:
    """The wheel profile in the lower part of a panel, with the wheel's body shaded."""
    inside = (profile.y >= _SHOWN[0]) & (profile.y <= _SHOWN[1])
    y, height = profile.y[inside] * 1e3, profile.z[inside] * 1e3
    outline = axes.twinx()
    span = float(height.max() - height.min())
    bottom = float(height.min()) - 0.15 * span
    above_zero = span * 1.4 / _BELOW  # the profile with its margins fills the part below zero
    outline.set_ylim(bottom, bottom + 1.4 * span + above_zero)
    outline.fill_between(y, height, height.max() + 0.1 * span, color="0.9", linewidth=0)
    outline.plot(y, height, color="0.25", linewidth=1.0)
    outline.set_yticks([])
