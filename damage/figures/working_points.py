"""Working points of a run in the shakedown diagram of a point contact."""

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import LinearSegmentedColormap, LogNorm
from matplotlib.figure import Figure

from damage.log_input.contact_states import ContactSource
from damage.material import ER7, WheelMaterial
from damage.rcf.surface_index import FLANGE_CONTACT_ANGLE
from damage.shakedown import point_contact_limit, working_points

# begins dark enough for a cell with one working point to be visible on white
_DENSITY = LinearSegmentedColormap.from_list("density", colormaps["YlOrBr"](np.linspace(0.35, 1.0, 256)))
_FLANGE_COLOUR = "#2b5c8a"


def shakedown_figure(
    run: ContactSource,
    material: WheelMaterial = ER7,
    flange_angle: float = FLANGE_CONTACT_ANGLE,
    skip_bad_rows: bool = False,
) -> Figure:
    """Working points of a contact log in the shakedown diagram of a point contact in full slip.

    Parameters
    ----------
    run, flange_angle, skip_bad_rows
        As for `damage.shakedown.working_points.working_points`.
    material
        The wheel steel.
    """
    points = working_points(run, material.shear_yield, flange_angle, skip_bad_rows)
    tread = ~points.flange
    figure = Figure(figsize=(5.0, 4.0), layout="constrained")
    axes = figure.subplots()
    largest = max(0.6, 1.1 * float(points.utilised_friction.max(initial=0.0)))
    height = max(6.0, 1.05 * float(points.relative_pressure.max(initial=0.0)))
    if tread.any():
        density = axes.hexbin(
            points.utilised_friction[tread],
            points.relative_pressure[tread],
            gridsize=60,
            extent=(0.0, largest, 0.0, height),
            mincnt=1,
            norm=LogNorm(),
            cmap=_DENSITY,
            linewidths=0.0,
        )
        counts = np.asarray(density.get_array(), dtype=np.float64)
        density.set_clim(1.0, max(10.0, float(counts.max())))
        figure.colorbar(density, ax=axes, label="working points per cell, tread")
    if points.flange.any():
        axes.plot(
            points.utilised_friction[points.flange],
            points.relative_pressure[points.flange],
            ".",
            markersize=2.0,
            color=_FLANGE_COLOUR,
            label="flange",
        )
    friction = np.linspace(0.0, largest, 400)
    axes.plot(friction, point_contact_limit(friction), color="black", linewidth=1.2, label="shakedown limit")
    axes.text(0.97 * largest, 0.96 * height, "ratchetting", ha="right", va="top", fontsize=8, style="italic")
    axes.text(0.97 * largest, 0.03 * height, "shakedown", ha="right", va="bottom", fontsize=8, style="italic")
    axes.set_xlim(0.0, largest)
    axes.set_ylim(0.0, height)
    axes.set_xlabel("utilised friction $Q/P$ [-]")
    axes.set_ylabel(f"$p_0/k$ [-], $k$ = {material.shear_yield * 1e-6:.0f} MPa ({material.name})")
    axes.legend(loc="lower left", fontsize=8, frameon=False)
    return figure
