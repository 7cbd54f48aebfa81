"""A vehicle to scale, side and top view, from the description of a run.

Wheels have their true radius; couplings are marks at their points, rods lines between their ends; bodies are
the boxes of `vehicles.outline`.
"""

import math
import re
from itertools import cycle, pairwise

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from hh_exudyn.arrays import FloatArray
from hh_exudyn.figures.style import SMALL
from vehicles.description import Body, Vehicle
from vehicles.outline import RUNNING_CIRCLE, WHEEL_WIDTH, attachments, body_box, coupling_ends, vehicle_box

_BELOW = 0.75  # m below the rail, for the dimensions
_COLOURS = {
    "car_body": "tab:blue",
    "bogie_frame": "tab:green",
    "bolster": "tab:olive",
    "side_frame": "tab:green",
    "motor": "tab:brown",
}
_MARKS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "p")
_SIDE, _TOP = (0, 2), (0, 1)  # axes of the two views


def vehicle_sheet(title: str, vehicle: Vehicle) -> Figure:
    """Side view above, top view below, both to the same scale.

    Bodies are drawn as the boxes of their outline, wheelsets and couplings as they stand on the drawing.

    Parameters
    ----------
    title : str
        Above the views.
    vehicle : Vehicle
        Any; the leading end is on the right.
    """
    boxes = [(body, body_box(vehicle, body)) for body in vehicle.bodies if body.kind != "wheelset"]
    low, high = vehicle_box(vehicle)
    span = (low[0] - 0.4, high[0] + 0.4)
    top, half = high[2], max(-low[1], high[1]) + 0.3
    heights = (top + 0.3 + _BELOW, 2 * half)
    width = 9.0
    scale = (width - 1.0) / (span[1] - span[0])  # inches a metre
    with rc_context(SMALL):
        figure = Figure(figsize=(width, scale * sum(heights) + 2.0), layout="constrained")
        figure.suptitle(title)
        side, plan = figure.subplots(2, 1, sharex=True, height_ratios=heights)
        for axes, view in ((side, _SIDE), (plan, _TOP)):
            for body, box in boxes:
                _draw_box(axes, body, box, view)
            _draw_couplings(axes, vehicle, view)
            _draw_heads(axes, vehicle, [box for _, box in boxes], view)
            axes.set_aspect("equal")
            axes.grid(alpha=0.2)
        _draw_side_wheels(side, vehicle)
        _draw_plan_wheels(plan, vehicle)
        side.set_xlim(*span)
        side.set_ylim(-_BELOW, top + 0.3)
        plan.set_ylim(-half, half)
        side.set_ylabel("z [m], springs unloaded")
        plan.set_ylabel("y [m], left +")
        plan.set_xlabel("x [m], forward +")
        handles, labels = side.get_legend_handles_labels()
        known = dict(zip(labels, handles, strict=True))
        figure.legend(known.values(), known.keys(), loc="outside lower center", ncols=6, frameon=False)
    return figure


def _draw_box(axes: Axes, body: Body, box: tuple[FloatArray, FloatArray], view: tuple[int, int]) -> None:
    """A body's box, and its centre of mass as a cross in a circle."""
    i, j = view
    low, high = box
    colour = _COLOURS.get(body.kind, "tab:gray")
    size = (high[i] - low[i], high[j] - low[j])
    axes.add_patch(Rectangle((low[i], low[j]), *size, facecolor=colour, alpha=0.18))
    axes.add_patch(Rectangle((low[i], low[j]), *size, facecolor="none", edgecolor=colour, linewidth=0.9))
    place = (body.position[i], body.position[j])
    axes.plot(*place, marker="o", markersize=7, markerfacecolor="white", color=colour, linestyle="none")
    axes.plot(*place, marker="+", markersize=7, color=colour, linestyle="none")
    axes.plot([], [], color=colour, linewidth=4, alpha=0.5, label=body.kind.replace("_", " "))


def _draw_couplings(axes: Axes, vehicle: Vehicle, view: tuple[int, int]) -> None:
    """A mark for every kind of coupling, a line for rods, which have two points."""
    i, j = view
    kinds = dict.fromkeys(type(coupling).__name__ for coupling in vehicle.couplings)
    for kind, mark in zip(kinds, cycle(_MARKS), strict=False):
        mine = [coupling_ends(coupling) for coupling in vehicle.couplings if type(coupling).__name__ == kind]
        label = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", kind).lower()
        for ends in mine:
            if len(ends) > 1:
                axes.plot([end[i] for end in ends], [end[j] for end in ends], color="black", linewidth=1.2)
        points = [end for ends in mine for end in ends]
        axes.plot(
            [point[i] for point in points],
            [point[j] for point in points],
            marker=mark, markersize=4, markerfacecolor="none", color="black", linestyle="none", label=label,
        )  # fmt: skip


def _draw_heads(
    axes: Axes,
    vehicle: Vehicle,
    boxes: list[tuple[FloatArray, FloatArray]],
    view: tuple[int, int],
) -> None:
    """Coupler heads as squares, with a line to the nearest body."""
    for head in map(np.array, vehicle.coupler.points):
        nearest = [np.clip(head, low, high) for low, high in boxes] or [head]
        foot = min(nearest, key=lambda point: float(np.linalg.norm(point - head)))
        ends = np.array([head, foot])[:, list(view)]
        axes.plot(ends[:, 0], ends[:, 1], color="tab:red", linewidth=1.5)
        axes.plot(*ends[0], marker="s", markersize=6, color="tab:red", linestyle="none", label="coupler head")


def _draw_side_wheels(axes: Axes, vehicle: Vehicle) -> None:
    """Wheels as circles on the rail, and the axle spacings below it."""
    axes.axhline(0.0, color="black", linewidth=1.5)
    places = []
    for wheelset in vehicle.wheelsets:
        x, _, z = vehicle.body(wheelset.body).position
        places.append(x)
        axes.add_patch(Circle((x, z), wheelset.radius, facecolor="lightgray", alpha=0.5))
        axes.add_patch(Circle((x, z), wheelset.radius, facecolor="none", edgecolor="black", linewidth=1.0))
        axes.plot(x, z, marker="+", color="black", markersize=5)
    for behind, ahead in pairwise(sorted(places)):
        _dimension(axes, behind, ahead, -0.22)
    heads = [point[0] for point in vehicle.coupler.points]
    if min(heads) < max(heads):
        _dimension(axes, min(heads), max(heads), -0.52)


def _dimension(axes: Axes, start: float, end: float, height: float) -> None:
    """A length between two places, in millimetres as on drawings."""
    arrow = {"arrowstyle": "<->", "linewidth": 0.7, "shrinkA": 0.0, "shrinkB": 0.0}
    axes.annotate("", (start, height), (end, height), arrowprops=arrow)
    box = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}
    text = f"{1e3 * (end - start):.0f}"
    axes.text((start + end) / 2, height, text, ha="center", va="center", fontsize=6, bbox=box)


def _draw_plan_wheels(axes: Axes, vehicle: Vehicle) -> None:
    """Rails, axles between the wheels, and the wheels from above."""
    for side in (1, -1):
        axes.axhline(side * RUNNING_CIRCLE, color="black", linewidth=0.8, alpha=0.4)
    for wheelset in vehicle.wheelsets:
        x = vehicle.body(wheelset.body).position[0]
        own = [abs(point[1]) for name, point in attachments(vehicle) if name == wheelset.body]
        end = max([RUNNING_CIRCLE, *own])  # the journals, where its outermost couplings are
        axes.plot([x, x], [-end, end], color="black", linewidth=1.5)
        for side in (1, -1):
            foot = (x - wheelset.radius, side * RUNNING_CIRCLE - WHEEL_WIDTH / 2)
            axes.add_patch(
                Rectangle(foot, 2 * wheelset.radius, WHEEL_WIDTH, facecolor="lightgray", edgecolor="black")
            )


def summary(vehicle: Vehicle) -> str:
    """One line for a title: mass, wheelsets, wheel diameters."""
    sizes = sorted({round(2e3 * wheelset.radius) for wheelset in vehicle.wheelsets})
    wheels = ", ".join(f"{size} mm" for size in sizes)
    count = len(vehicle.wheelsets)
    mean = vehicle.mass / count if count else math.nan
    return f"{1e-3 * vehicle.mass:.1f} t on {count} wheelsets of {wheels}, {1e-3 * mean:.1f} t each"
