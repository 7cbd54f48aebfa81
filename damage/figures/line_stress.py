"""Stresses below a rolling line contact: figures 3-4 to 3-7 and 3-10 of Hossein-Nia (KTH, 2018).

Frame of `hh_exudyn.contact.normal.subsurface`, lengths over a and stresses over p0: rolling direction to the
right, so that the leading edge is x/a = +1; the body lies below. Friction drives it in rolling direction, as
a driving wheel, which is compressed in front and in tension behind.
"""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from damage.shakedown.stress_circle import stress_circle
from hh_exudyn.contact.normal.subsurface import line_contact_stress

_REACH, _DEPTH = 2.0, 2.0  # shown along and below the surface, over a
_STEP = 0.02  # between contours, over p0
_ONE, _OTHER, _THIRD = "#8c2d04", "#2b5c8a", "#4d4d4d"
_SURFACE_BY = 0.39  # friction with the maximum safely at the surface, where it is from 0.376 on


def principal_shear_figure(friction: Sequence[float] = (0.0,)) -> Figure:
    """Contours of the principal shear stress tau_1/p0 (3.9) below a patch in full slip, a panel per friction.

    Figure 3-4 with (0.0,), figure 3-6 with (0.1, 0.3). The cross marks the maximum.

    Parameters
    ----------
    friction
        Friction coefficients [-], >= 0, one at least.

    Raises
    ------
    ValueError
        No friction, or one out of range.
    """
    if not friction:
        raise ValueError("friction is empty: at least one coefficient is needed")
    figure = Figure(figsize=(4.8 * len(friction), 3.6), layout="constrained")
    x, depth = np.meshgrid(np.linspace(-_REACH, _REACH, 321), np.linspace(0.0, _DEPTH, 161))
    fields = [line_contact_stress(x, depth, 1.0, 1.0, mu).principal_shear for mu in friction]
    levels = np.arange(_STEP, max(float(shear.max()) for shear in fields), _STEP)
    panels = figure.subplots(1, len(friction), squeeze=False)[0]
    for axes, mu, shear in zip(panels, friction, fields, strict=True):
        lines = axes.contour(x, depth, shear, levels, cmap="viridis_r", linewidths=0.9)
        axes.clabel(lines, lines.levels[::2], fontsize=7, fmt="%.2f")
        most = stress_circle(mu)
        text = f"$\\mu$ = {mu:g}: max $\\tau_1$ = {most.radius:.3f} $p_0$"
        if most.depth[0] > 0.0:
            axes.plot(most.x, most.depth, "+", color=_ONE, markersize=10.0, markeredgewidth=1.6)
            text += f" at $x$ = {round(most.x[0], 2) + 0.0:.2f} $a$, {most.depth[0]:.2f} $a$ deep"
        else:
            axes.plot([-1.0, 1.0], [0.0, 0.0], color=_ONE, linewidth=4.0, solid_capstyle="butt")
            text += " all over the surface"
        axes.set_title(text, fontsize=9)
        axes.plot([-1.0, 1.0], [0.0, 0.0], color="black", linewidth=2.0, clip_on=False, zorder=0)
        axes.set_aspect("equal")
        axes.set_ylim(_DEPTH, 0.0)
        axes.set_xlabel("$x/a$ [-], rolling direction $\\rightarrow$")
        axes.set_ylabel("depth $z/a$ [-]")
    return figure


def surface_stress_figure() -> Figure:
    """Stresses of the traction of full slip on the surface, over mu p0 (equation 3.10, figure 3-5).

    Without those of the pressure, which adds equal parts to sigma_x and sigma_z inside the patch and
    nothing to the others.
    """
    x = np.linspace(-2.0, 2.0, 801)
    field = line_contact_stress(x, 0.0, 1.0, 1.0, 1.0)
    figure = Figure(figsize=(5.0, 3.8), layout="constrained")
    axes = figure.subplots()
    axes.plot(x, field.sigma_x - field.sigma_z, color=_OTHER, label="$\\sigma_x$")
    axes.plot(x, field.tau_xz, color=_ONE, label="$\\tau_{xz}$")
    axes.plot(x, field.principal_shear, color=_THIRD, linestyle="--", label="$\\tau_1$")
    axes.text(1.0, -2.05, "leading\nedge", ha="center", va="top", fontsize=8)
    axes.text(-1.0, -2.05, "trailing\nedge", ha="center", va="top", fontsize=8)
    _patch_edges(axes)
    axes.set_ylim(-2.7, 2.4)
    axes.set_ylabel("stress$/(\\mu p_0)$ [-]")
    axes.legend(loc="upper right", frameon=False)
    return figure


def yield_place_figure(largest_friction: float = 0.5) -> Figure:
    """Place of the largest principal shear stress of full slip, over friction (figure 3-7).

    Parameters
    ----------
    largest_friction
        End of the axis [-], > 0.39.

    Raises
    ------
    ValueError
        A smaller one.
    """
    if not (math.isfinite(largest_friction) and largest_friction > _SURFACE_BY):
        raise ValueError(f"largest_friction = {largest_friction} [-] must be > {_SURFACE_BY}")
    circles = [stress_circle(float(mu)) for mu in np.linspace(0.0, _SURFACE_BY, 79)]
    beneath = [circle for circle in circles if circle.depth[0] > 0.0]
    friction = [circle.friction for circle in beneath]
    figure = Figure(figsize=(5.0, 3.8), layout="constrained")
    axes = figure.subplots()
    axes.plot(friction, [circle.depth[0] for circle in beneath], color=_ONE)
    axes.plot(friction, [circle.x[0] for circle in beneath], color=_OTHER)
    axes.text(0.03, 0.82, "depth $z/a$", color=_ONE)
    axes.text(0.055, 0.1, "ahead of the middle $x/a$", color=_OTHER)
    axes.plot([friction[-1], largest_friction], [0.0, 0.0], color=_ONE, linewidth=3.0, clip_on=False)
    axes.text(
        0.5 * (friction[-1] + largest_friction), 0.03, "surface,\nwhole patch:\n$\\tau_1 = \\mu p_0$",
        ha="center", va="bottom", fontsize=8,
    )  # fmt: skip
    axes.axvline(friction[-1], color="0.7", linewidth=0.8, linestyle=":")
    axes.set_xlim(0.0, largest_friction)
    axes.set_ylim(0.0, 1.05)
    axes.set_xlabel("friction coefficient $\\mu$ [-]")
    axes.set_ylabel("place of the largest $\\tau_1$ [-]")
    return figure


def partial_slip_shear_figure(friction: float = 0.5, traction_ratio: float = 0.4) -> Figure:
    """Principal shear stress on the surface: partial slip against full slip of that friction (figure 3-10).

    Parameters
    ----------
    friction
        Friction coefficient mu [-], > 0.
    traction_ratio
        Q/P of the partial slip [-], -mu..mu.

    Raises
    ------
    ValueError
        A load out of range.
    """
    x: NDArray[np.float64] = np.linspace(-1.5, 1.5, 1201)
    partial = line_contact_stress(x, 0.0, 1.0, 1.0, friction, traction_ratio=traction_ratio)
    full = line_contact_stress(x, 0.0, 1.0, 1.0, friction)
    figure = Figure(figsize=(5.0, 3.8), layout="constrained")
    axes = figure.subplots()
    axes.plot(x, partial.principal_shear, color=_ONE, label=f"partial slip, $Q/P$ = {traction_ratio:g}")
    axes.plot(x, full.principal_shear, color=_OTHER, linestyle="--", label=f"full slip, $Q/P$ = {friction:g}")
    _patch_edges(axes)
    axes.set_ylim(0.0, 1.35 * float(max(partial.principal_shear.max(), full.principal_shear.max())))
    axes.set_ylabel("$\\tau_1/p_0$ on the surface [-]")
    axes.set_title(f"$\\mu$ = {friction:g}", fontsize=9)
    axes.legend(loc="upper center", frameon=False, fontsize=9)
    return figure


def _patch_edges(axes: Axes) -> None:
    """Edges of the patch and the axis along it."""
    for edge in (-1.0, 1.0):
        axes.axvline(edge, color="0.7", linewidth=0.8, linestyle=":", zorder=0)
    axes.axhline(0.0, color="0.7", linewidth=0.8, zorder=0)
    axes.set_xlabel("$x/a$ [-], rolling direction $\\rightarrow$")
