"""One contact patch after all theories: figures like 2-6 and 2-8 of Hossein-Nia (KTH, 2018).

A column per theory with a stress field. From above: the traction on the wheel with the border of stick and
slip; the traction along the strip in the patch's middle, under its bound friction * pressure; the slip
velocity. At the bottom the forces of all theories, those without a stress field included.

The patch is seen from above, in the contact frame: rolling direction to the right, left of the track up.
"""

import math
from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure, SubFigure
from matplotlib.patches import Ellipse

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.tangential.api import CreepForce, PatchLoad, TractionField

_TRACTION_COLOURS, _SLIP_COLOURS = "viridis", "YlOrRd"
_X_COLOUR, _Y_COLOUR, _MOMENT_COLOUR = "#2b5c8a", "#c2571a", "#7a7a7a"
_ARROWS = 9  # arrows along and across the patch
_LONGEST_ARROW, _LONGEST_MAP, _STRIP_HEIGHT = 0.3, 2.2, 1.7  # inch
_SHOWN_SLIP = 98.0  # percentile of the slip velocity at the end of the colours: it peaks at the trailing edge
_LONGEST_BAR = 1.25  # friction * normal force; the linear theory has no limit
_MARGIN = 1.12


def patch_figure(
    load: PatchLoad, forces: Mapping[str, CreepForce], fields: Mapping[str, TractionField]
) -> Figure:
    """All theories side by side.

    Parameters
    ----------
    load : PatchLoad
        The patch.
    forces : mapping
        Creep forces by the theory's name.
    fields : mapping
        Stress fields by the theory's name, for those theories that have one; empty for forces alone.

    Returns
    -------
    Figure

    Raises
    ------
    ValueError
        Without forces.
    """
    if not forces:
        raise ValueError("forces: no theory given, at least one is needed")
    width, height = _map_size(load)
    bar_height = 0.9 + 0.36 * len(forces)
    rows_height = 2.0 * height + _STRIP_HEIGHT + 1.2 if fields else 0.0
    figure = Figure(
        figsize=(max(6.0, 1.6 + (width + 0.15) * len(fields)), 0.35 + rows_height + bar_height),
        layout="constrained",
    )
    figure.suptitle(_title(load), fontsize=9)
    heights = (rows_height, bar_height) if fields else (bar_height,)
    grid = figure.add_gridspec(len(heights), 1, height_ratios=heights)
    if fields:
        _draw_fields(figure.add_subfigure(grid[0]), load, fields)
    _draw_forces(figure.add_subfigure(grid[-1]), load, forces)
    return figure


def _map_size(load: PatchLoad) -> tuple[float, float]:
    """Width and height of a map of the patch [inch]."""
    if load.a >= load.b:
        return _LONGEST_MAP, max(_LONGEST_MAP * load.b / load.a, 1.4)
    return max(_LONGEST_MAP * load.a / load.b, 1.3), _LONGEST_MAP


def _title(load: PatchLoad) -> str:
    """The load, in the units of plots."""
    return (
        f"$a$ = {load.a * 1e3:.4g} mm, $b$ = {load.b * 1e3:.4g} mm, $N$ = {load.normal_force * 1e-3:.4g} kN, "
        f"$\\mu$ = {load.friction:.3g};  "
        f"$\\nu_x$ = {load.nu_x * 1e3:.4g} ‰, $\\nu_y$ = {load.nu_y * 1e3:.4g} ‰, "
        f"$\\varphi$ = {load.phi:.4g} 1/m"
    )


def _draw_fields(figure: SubFigure, load: PatchLoad, fields: Mapping[str, TractionField]) -> None:
    """Traction, middle strip and slip velocity: a column per theory, one scale in every row."""
    height = _map_size(load)[1]
    axes = figure.subplots(
        3,
        len(fields),
        sharex=True,
        sharey="row",
        squeeze=False,
        height_ratios=(height, _STRIP_HEIGHT, height),
    )
    tractions = {name: np.hypot(field.q_x, field.q_y) * 1e-6 for name, field in fields.items()}
    slips = {name: np.hypot(field.slip_x, field.slip_y) * 1e3 for name, field in fields.items()}
    traction_scale = Normalize(0.0, max(float(q.max()) for q in tractions.values()) or 1.0)
    sliding = np.concatenate([slip[slip > 0.0] for slip in slips.values()])
    slip_scale = Normalize(0.0, float(np.percentile(sliding, _SHOWN_SLIP)) if sliding.size else 1.0)
    for column, (name, field) in enumerate(fields.items()):
        top, middle, bottom = axes[:, column]
        top.set_title(name, fontsize=9)
        _draw_map(top, load, tractions[name], traction_scale, _TRACTION_COLOURS)
        _draw_border(top, field, slips[name], "white")
        _draw_arrows(top, field, traction_scale.vmax or 1.0)
        _draw_strip(middle, load, field)
        _draw_map(bottom, load, np.where(slips[name] > 0.0, slips[name], np.nan), slip_scale, _SLIP_COLOURS)
        bottom.set_xlabel("$x$ [mm], rolling →", fontsize=8)
        for place in (top, middle, bottom):
            place.tick_params(labelsize=7, direction="in")
    axes[0, 0].set_ylabel("$y$ [mm]", fontsize=8)
    axes[1, 0].set_ylabel("traction on the wheel [MPa]", fontsize=8)
    axes[2, 0].set_ylabel("$y$ [mm]", fontsize=8)
    axes[1, 0].legend(fontsize=6.5, frameon=False, loc="best", handlelength=1.4)
    for row, scale, colours, label in (
        (0, traction_scale, _TRACTION_COLOURS, "$|q|$ [MPa]; line: stick | slip"),
        (2, slip_scale, _SLIP_COLOURS, "slip / $V$ [‰]; white: stick"),
    ):
        bar = figure.colorbar(
            ScalarMappable(scale, colours), ax=axes[row, :], extend="max" if row else "neither", aspect=18
        )
        bar.set_label(label, fontsize=7.5)
        bar.ax.tick_params(labelsize=7)


def _draw_map(axes: Axes, load: PatchLoad, values: FloatArray, scale: Normalize, colours: str) -> None:
    """Cells in colour. Their corners: strips of equal width, divided into equal cells from edge to edge."""
    strips, cells = values.shape
    lateral = np.linspace(-1.0, 1.0, strips + 1)
    half_length = load.a * np.sqrt(np.maximum(1.0 - lateral**2, 0.0))
    x = half_length[:, None] * np.linspace(-1.0, 1.0, cells + 1)[None, :]
    y = np.repeat(load.b * lateral[:, None], cells + 1, axis=1)
    axes.pcolormesh(x * 1e3, y * 1e3, values, norm=scale, cmap=colours, shading="flat", rasterized=True)
    axes.add_patch(Ellipse((0.0, 0.0), 2e3 * load.a, 2e3 * load.b, fill=False, linewidth=0.8))
    axes.set_aspect("equal")
    axes.set_xlim(-_MARGIN * load.a * 1e3, _MARGIN * load.a * 1e3)
    axes.set_ylim(-_MARGIN * load.b * 1e3, _MARGIN * load.b * 1e3)


def _draw_border(axes: Axes, field: TractionField, slip: FloatArray, colour: str) -> None:
    """The border of stick (towards the leading edge) and slip, where there are both."""
    slides = (slip > 0.0).astype(np.float64)
    if min(slides.shape) >= 2 and 0.0 < slides.mean() < 1.0:
        axes.contour(field.x * 1e3, field.y * 1e3, slides, levels=[0.5], colors=colour, linewidths=1.0)


def _draw_arrows(axes: Axes, field: TractionField, longest: float) -> None:
    """Traction on the wheel as arrows, with lengths proportional to it."""
    strips, cells = field.q_x.shape
    across = np.linspace(0, strips - 1, min(strips, _ARROWS) + 2).round().astype(int)[1:-1]
    along = np.linspace(0, cells - 1, min(cells, _ARROWS) + 2).round().astype(int)[1:-1]
    chosen = np.ix_(across, along)
    axes.quiver(
        field.x[chosen] * 1e3, field.y[chosen] * 1e3, field.q_x[chosen] * 1e-6, field.q_y[chosen] * 1e-6,
        scale=longest / _LONGEST_ARROW, scale_units="inches", units="inches", width=0.018,
        color="white", edgecolor="black", linewidth=0.25, pivot="middle",
    )  # fmt: skip


def _draw_strip(axes: Axes, load: PatchLoad, field: TractionField) -> None:
    """Both tractions along the middle strip under the bound."""
    middle = field.x.shape[0] // 2
    x = field.x[middle] * 1e3
    half_length = load.a * math.sqrt(1.0 - (field.y[middle, 0] / load.b) ** 2) * 1e3
    bound = np.pad(load.friction * field.pressure[middle] * 1e-6, 1)  # nothing at both ends
    axes.fill_between(
        np.concatenate([[-half_length], x, [half_length]]), -bound, bound,
        color="0.92", linewidth=0, label=r"$\pm\mu p$",
    )  # fmt: skip
    axes.plot(x, np.hypot(field.q_x[middle], field.q_y[middle]) * 1e-6, "k:", linewidth=1.0, label="$|q|$")
    axes.plot(x, field.q_x[middle] * 1e-6, color=_X_COLOUR, linewidth=1.3, label="$q_x$")
    axes.plot(x, field.q_y[middle] * 1e-6, color=_Y_COLOUR, linewidth=1.3, label="$q_y$")
    axes.axhline(0.0, color="0.6", linewidth=0.5)


def _draw_forces(figure: SubFigure, load: PatchLoad, forces: Mapping[str, CreepForce]) -> None:
    """Forces over friction * normal force, moment over that times sqrt(a b): three bars a theory."""
    limit = load.friction * load.normal_force
    size = math.sqrt(load.a * load.b)
    axes = figure.subplots()
    places = np.arange(len(forces))
    kinds = (
        ("$F_x/\\mu N$", [force.x / limit for force in forces.values()], _X_COLOUR),
        ("$F_y/\\mu N$", [force.y / limit for force in forces.values()], _Y_COLOUR),
        (
            "$M_z/\\mu N c$, $c = \\sqrt{ab}$",
            [force.moment / (limit * size) for force in forces.values()],
            _MOMENT_COLOUR,
        ),
    )
    every = [value for _, values, _ in kinds for value in values]
    low, high = max(min(every), -_LONGEST_BAR), min(max(every), _LONGEST_BAR)
    room = 0.12 * max(high, -low, 0.1)  # for the numbers at the bars' ends
    low, high = min(low, 0.0) - room, max(high, 0.0) + room
    for k, (label, values, colour) in enumerate(kinds):
        bars = places + 0.27 * (k - 1)
        axes.barh(bars, np.clip(values, -_LONGEST_BAR, _LONGEST_BAR), 0.24, color=colour, label=label)
        for place, value in zip(bars, values, strict=True):
            _write_value(axes, place, value)
    axes.axvline(0.0, color="black", linewidth=0.6)
    axes.set_yticks(places, list(forces), fontsize=8)
    axes.invert_yaxis()
    axes.set_xlim(low, high)
    axes.set_xlabel("force on the wheel over the friction limit [-]", fontsize=8)
    axes.tick_params(axis="x", labelsize=7, direction="in")
    axes.legend(fontsize=7, frameon=False, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3)


def _write_value(axes: Axes, place: float, value: float) -> None:
    """A number beyond the end of its bar; inside the end of a shortened bar."""
    value = round(value, 3) + 0.0  # no minus sign before a zero
    cut = abs(value) > _LONGEST_BAR
    to_the_right = (value >= 0.0) != cut
    axes.annotate(
        f"{value:.3f}",
        (min(max(value, -_LONGEST_BAR), _LONGEST_BAR), place),
        xytext=(2 if to_the_right else -2, 0),
        textcoords="offset points",
        va="center",
        ha="left" if to_the_right else "right",
        fontsize=6,
        color="white" if cut else "0.3",
    )
