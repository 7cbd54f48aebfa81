"""Johnson's circles around the stress trajectories of a line contact: figures 3-9 and 3-12 of Hossein-Nia.

Each curve is the course of the stresses of a point at one depth while the load rolls over it; a load is
within the limit if a circle of radius k/p0 encloses all curves. S. Hossein-Nia, KTH 2018, after K.L. Johnson,
Wear 190, 1995.
"""

from collections.abc import Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from damage.shakedown.stress_circle import stress_circle, trajectory
from hh_exudyn.contact.normal.subsurface import line_contact_stress, stick_half_length

_CENTRES = {  # hardening: name of the centre, colour, line
    "elastic": ("O, elastic", "#4d4d4d", "--"),
    "perfect": ("O', perfectly plastic", "#2b5c8a", "-."),
    "kinematic": ("O'', kinematic hardening", "#8c2d04", "-"),
}
DEPTHS = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Depths over a of the trajectories that are shown."""


def trajectories_figure(friction: float = 0.15, depths: Sequence[float] = DEPTHS) -> Figure:
    """Trajectories of full slip in a few depths, with the circles of the three limits (figure 3-9).

    Parameters
    ----------
    friction
        Friction coefficient mu [-], >= 0.
    depths
        Depths over a [-], >= 0.

    Raises
    ------
    ValueError
        An argument out of range.
    """
    figure = Figure(figsize=(6.2, 4.8), layout="constrained")
    axes = figure.subplots()
    _draw(axes, friction, friction, depths, 1.0)
    axes.set_xlabel("$(\\sigma_x - \\sigma_z)/(2 p_0)$ [-]")
    axes.set_ylabel("$\\tau_{xz}/p_0$ [-]")
    axes.set_title(f"full slip, $\\mu$ = {friction:g}", fontsize=9)
    return figure


def partial_slip_figure(
    friction: float = 0.5, traction_ratio: float = 0.4, depths: Sequence[float] = (0.0, 0.1, 0.25, 0.5)
) -> Figure:
    """Traction on the surface and the trajectories in partial slip, stresses over mu p0 (figure 3-12).

    A, B and C are Johnson's points (3.13): leading edge, border of stick and slip, trailing edge.

    Parameters
    ----------
    friction
        Friction coefficient mu [-], > 0.
    traction_ratio
        Q/P [-], -mu..mu.
    depths
        As in `trajectories_figure`, and so are the errors.
    """
    if not friction > 0.0:
        raise ValueError(f"friction = {friction} [-] must be > 0")
    figure = Figure(figsize=(10.0, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(1.0, 1.25))
    border = 1.0 - 2.0 * stick_half_length(1.0, friction, traction_ratio)
    x = np.unique(np.append(np.linspace(-1.2, 1.2, 961), [-1.0, border, 1.0]))
    sense = float(np.copysign(1.0, traction_ratio))
    bound = line_contact_stress(x, 0.0, 1.0, 1.0, friction, traction_ratio=sense * friction)
    carter = line_contact_stress(x, 0.0, 1.0, 1.0, friction, traction_ratio=traction_ratio)
    left.plot(x, -bound.tau_xz / friction, ":", color="0.4", label="friction bound")
    left.plot(x, -carter.tau_xz / friction, color="#8c2d04", label=f"Carter, $Q/P$ = {traction_ratio:g}")
    left.axhline(0.0, color="0.7", linewidth=0.8, zorder=0)
    left.set_xlabel("$x/a$ [-], rolling direction $\\rightarrow$")
    left.set_ylabel("traction on the surface $q/(\\mu p_0)$ [-]")
    left.set_ylim(sorted((-0.08 * sense, 1.3 * sense)))
    left.legend(loc="upper center" if sense > 0.0 else "lower center", frameon=False, fontsize=8)
    _draw(right, friction, traction_ratio, depths, friction)
    right.set_xlabel("$(\\sigma_x - \\sigma_z)/(2 \\mu p_0)$ [-]")
    right.set_ylabel("$\\tau_{xz}/(\\mu p_0)$ [-]")
    right.set_title(f"$\\mu$ = {friction:g}, $Q/P$ = {traction_ratio:g}", fontsize=9)
    marks = np.array([1.0, border, -1.0])
    stresses = trajectory(marks, np.zeros(3), friction, traction_ratio) / friction
    tractions = -line_contact_stress(marks, 0.0, 1.0, 1.0, friction, traction_ratio=traction_ratio).tau_xz
    for name, place, traction, stress in zip("ABC", marks, tractions / friction, stresses, strict=True):
        for axes, at in ((left, (place, traction)), (right, tuple(stress))):
            axes.plot(*at, "o", color="black", markersize=4.0)
            axes.annotate(name, at, (4.0, 4.0), textcoords="offset points", fontweight="bold")
    return figure


def _draw(axes: Axes, friction: float, ratio: float, depths: Sequence[float], unit: float) -> None:
    """Trajectories and circles, stresses over unit * p0."""
    if not depths:
        raise ValueError("depths is empty: at least one is needed")
    beside = np.geomspace(1.0, 60.0, 200)
    x = np.concatenate([-beside[::-1], np.linspace(-1.0, 1.0, 801), beside])
    shades = colormaps["viridis"](np.linspace(0.0, 0.85, len(depths)))
    for depth, shade in zip(depths, shades, strict=True):
        across, up = trajectory(x, depth, friction, ratio).T / unit
        axes.plot(across, up, color=shade, linewidth=1.2, label=f"$z$ = {depth:g} $a$")
    for hardening, (name, colour, line) in _CENTRES.items():
        circle = stress_circle(friction, ratio, hardening)
        centre = circle.centre[0] / unit, circle.centre[1] / unit
        axes.add_patch(
            Circle(
                centre, circle.radius / unit, fill=False, edgecolor=colour, linestyle=line, linewidth=1.1,
                label=f"{name}: $p_0/k$ = {circle.limit:.3g}",
            )
        )  # fmt: skip
        axes.plot(*centre, "+", color=colour, markersize=8.0)
        touching = trajectory(np.array(circle.x), np.array(circle.depth), friction, ratio) / unit
        axes.plot(*touching.T, "o", color=colour, markersize=3.5)
    axes.axhline(0.0, color="0.8", linewidth=0.6, zorder=0)
    axes.axvline(0.0, color="0.8", linewidth=0.6, zorder=0)
    axes.set_aspect("equal")
    axes.margins(0.06)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=8)
