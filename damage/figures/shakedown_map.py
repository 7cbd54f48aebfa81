"""Shakedown maps: limits p0/k over traction, figures 3-8, 3-11 and 3-13 (left) of Hossein-Nia (KTH, 2018).

With the working points of a run on it: `damage.figures.working_points`.
"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from damage.shakedown.line_contact import partial_slip_limit, partial_slip_surface_limit, shakedown_limit
from damage.shakedown.point_contact import point_contact_limit

_STYLES = {  # hardening: name, colour, line
    "elastic": ("elastic limit", "#4d4d4d", "--"),
    "perfect": ("shakedown, elastic-perfectly plastic", "#2b5c8a", "-."),
    "kinematic": ("shakedown, kinematic hardening", "#8c2d04", "-"),
}
_FRICTION = 0.6  # end of the axis in full slip
_PARTIAL_POINTS = 33  # over Q/P, closer at both ends


def line_contact_map() -> Figure:
    """Elastic limit and both shakedown limits of a line contact in full slip (figure 3-8)."""
    figure, axes = _map(_FRICTION, 5.0)
    friction = np.linspace(0.0, _FRICTION, 601)
    for hardening, (name, colour, line) in _STYLES.items():
        axes.plot(friction, shakedown_limit(friction, hardening), line, color=colour, label=name)
    axes.text(0.37, 3.3, "ratchetting or\ncyclic plasticity", fontsize=8, style="italic")
    axes.text(0.2, 3.42, "shakedown", fontsize=8, style="italic", ha="center")
    axes.text(0.18, 1.5, "elastic", fontsize=8, style="italic")
    axes.annotate(
        "$1/\\mu$, surface", (0.47, 1.0 / 0.47), (0.49, 2.7), fontsize=8,
        arrowprops={"arrowstyle": "-", "linewidth": 0.6},
    )  # fmt: skip
    axes.set_xlabel("traction coefficient $Q/P = \\mu$ [-], full slip")
    axes.legend(loc="lower left", frameon=False, fontsize=8)
    return figure


def partial_slip_map(friction: float = 0.5) -> Figure:
    """Limits of a line contact in partial slip over Q/P, and the one of full slip beside them (figure 3-11).

    From the stresses of the whole body; thin lines are the limits of the surface alone (3.14, 3.15).

    Parameters
    ----------
    friction
        Friction coefficient mu [-], > 0.

    Raises
    ------
    ValueError
        It is not.
    """
    if not friction > 0.0:
        raise ValueError(f"friction = {friction} [-] must be > 0")
    figure, axes = _map(friction, 5.0)
    ratio = 0.5 * friction * (1.0 - np.cos(np.linspace(0.0, np.pi, _PARTIAL_POINTS)))
    for hardening, (name, colour, line) in _STYLES.items():
        limit = partial_slip_limit(friction, ratio, hardening)
        axes.plot(ratio, limit, line, color=colour, label=f"partial slip: {name}")
        if hardening != "elastic":
            fine = np.linspace(1e-4, friction, 400)
            axes.plot(
                fine, partial_slip_surface_limit(friction, fine, hardening), color=colour, linewidth=0.5,
                label="the surface alone" if hardening == "kinematic" else None,
            )  # fmt: skip
    full = np.linspace(0.0, friction, 400)
    axes.plot(
        full, shakedown_limit(full, "kinematic"), ":", color="black",
        label="full slip ($\\mu = Q/P$): kinematic hardening",
    )  # fmt: skip
    axes.set_xlabel(f"traction coefficient $Q/P$ [-], $\\mu$ = {friction:g}")
    axes.legend(loc="lower left", frameon=False, fontsize=7.5)
    return figure


def point_contact_map() -> Figure:
    """Shakedown limit of a point contact in full slip, with that of line contact (figure 3-13, left).

    Both are of an elastic-perfectly plastic body. The line contact's is the lower, and so the safer.
    """
    figure, axes = _map(_FRICTION, 6.0)
    friction = np.linspace(0.0, _FRICTION, 601)
    name, colour, line = _STYLES["perfect"]
    axes.plot(
        friction, shakedown_limit(friction, "perfect"), line, color=colour, label=f"line contact: {name}"
    )
    axes.plot(friction, point_contact_limit(friction), color="black", label="point contact: shakedown limit")
    axes.text(0.36, 4.2, "ratchetting", fontsize=8, style="italic")
    axes.text(0.12, 2.2, "shakedown", fontsize=8, style="italic")
    axes.set_xlabel("traction coefficient $Q/P = \\mu$ [-], full slip")
    axes.legend(loc="lower left", frameon=False, fontsize=8)
    return figure


def _map(across: float, up: float) -> tuple[Figure, Axes]:
    """An empty map."""
    figure = Figure(figsize=(5.0, 4.0), layout="constrained")
    axes = figure.subplots()
    axes.set_xlim(0.0, across)
    axes.set_ylim(0.0, up)
    axes.set_ylabel("$p_0/k$ [-]")
    return figure, axes
