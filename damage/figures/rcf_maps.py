"""The RCF number over wheel profile and contact patch, as coloured surfaces (Hossein-Nia 2018, figures 3-19,
3-28 and 3-29): across, along the rolling direction in the patch; up, over the profile, the flange on top.
"""

from collections.abc import Mapping

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import Colormap, ListedColormap
from matplotlib.figure import Figure
from matplotlib.ticker import EngFormatter
from numpy.typing import NDArray

from damage.report import DamageReport
from damage.surface.wheel_surface import Wheel, WheelSurface

_MARGIN = 3  # bins shown beyond those with anything in them
QUANTITIES = {
    "rcf_number": "RCF number",
    "corrected_rcf_number": "RCF number after wear (Burstow)",
}


def rcf_map_figure(
    cases: Mapping[str, DamageReport],
    wheel: Wheel,
    distance: float,
    quantity: str = "corrected_rcf_number",
    largest: float | None = None,
) -> Figure:
    """RCF number of a wheel after a distance, one panel per case, all in one scale.

    Parameters
    ----------
    cases
        Reports by the titles of their panels; on the same bins.
    wheel
        The wheel.
    distance
        Of running [m].
    quantity
        "rcf_number" or "corrected_rcf_number".
    largest
        End of the colour bar [-]; larger numbers have its last colour. None takes the largest number.

    Raises
    ------
    ValueError
        No cases, an unknown quantity, a wheel that a case does not have, or bins that differ.
    """
    if quantity not in QUANTITIES:
        raise ValueError(f"quantity = {quantity!r}; allowed: {', '.join(QUANTITIES)}")
    if not cases:
        raise ValueError("no cases were given")
    surfaces = {name: report.surface.scaled(distance) for name, report in cases.items()}
    maps = {name: getattr(s, quantity)[_index(s, wheel)].sum(axis=0) for name, s in surfaces.items()}
    first = next(iter(surfaces.values()))
    if any(s.grid != first.grid or s.patch_grid != first.patch_grid for s in surfaces.values()):
        raise ValueError("cases on different bins cannot be shown in one figure")
    shown = _shown(np.sum([*maps.values()], axis=0))
    figure = Figure(figsize=(1.4 + 2.3 * len(maps), 4.6), layout="constrained")
    axes = figure.subplots(1, len(maps), sharey=True, sharex=True, squeeze=False)[0]
    highest = max(float(values.max()) for values in maps.values()) if largest is None else largest
    for place, (name, values) in zip(axes, maps.items(), strict=True):
        mesh = _surface(place, first, values, shown, highest if highest > 0.0 else 1.0)
        place.set_title(f"{name}\nmax {_number(float(values.max()))}", fontsize=8)
    _label(axes, first)
    bar = figure.colorbar(mesh, ax=axes, shrink=0.9, format=EngFormatter())
    bar.set_label(f"{QUANTITIES[quantity]} after {distance * 1e-3:,.0f} km", fontsize=8)
    bar.ax.tick_params(labelsize=7)
    return figure


def energy_map_figure(report: DamageReport, wheel: Wheel, distance: float) -> Figure:
    """Energy over Burstow's first threshold, and the RCF number before and after his correction.

    The energy is the mean over the revolutions in which the profile's bin was in contact; where it is above
    the first threshold a line is drawn around it.

    Parameters
    ----------
    report
        The damage of a run, with Burstow's thresholds.
    wheel
        The wheel.
    distance
        Of running, for the RCF numbers [m].

    Raises
    ------
    ValueError
        The report has no thresholds, or not that wheel.
    """
    burstow = report.model.burstow
    if burstow is None:
        raise ValueError("the report has no thresholds of Burstow's, which the figure needs")
    surface = report.surface.scaled(distance)
    index = _index(surface, wheel)
    turns = surface.contact_revolutions[index].sum(axis=0)[:, None]
    energy = surface.energy[index].sum(axis=0)
    relative = np.divide(energy, turns, out=np.zeros_like(energy), where=turns > 0.0) / burstow.densities[0]
    shown = _shown(relative)
    figure = Figure(figsize=(8.4, 4.6), layout="constrained")
    axes = figure.subplots(1, 3, sharey=True, sharex=True)
    mesh = _surface(axes[0], surface, relative, shown, float(relative.max()) or 1.0, colormaps["viridis"])
    if relative.max() > 1.0:
        along = 0.5e3 * (surface.patch_grid.edges[1:] + surface.patch_grid.edges[:-1])
        axes[0].contour(
            along, surface.grid.centres[shown] * 1e3, relative[shown], [1.0], colors="white", linewidths=0.9
        )
    axes[0].set_title("mean energy over $E_1/A$\n(white line: 1)", fontsize=8)
    figure.colorbar(mesh, ax=axes[0], shrink=0.8).ax.tick_params(labelsize=7)
    both = [surface.rcf_number[index].sum(axis=0), surface.corrected_rcf_number[index].sum(axis=0)]
    highest = float(both[0].max()) or 1.0
    for place, values, name in zip(axes[1:], both, QUANTITIES.values(), strict=True):
        mesh = _surface(place, surface, values, shown, highest)
        place.set_title(f"{name}\nmax {_number(float(values.max()))}", fontsize=8)
    bar = figure.colorbar(mesh, ax=axes[1:], shrink=0.8, format=EngFormatter())
    bar.set_label(f"after {distance * 1e-3:,.0f} km", fontsize=8)
    bar.ax.tick_params(labelsize=7)
    _label(axes, surface)
    return figure


def _index(surface: WheelSurface, wheel: Wheel) -> int:
    """Place of a wheel among those of a surface."""
    if wheel not in surface.wheels:
        raise ValueError(f"{wheel} is not in the report")
    return surface.wheels.index(wheel)


def _shown(values: NDArray[np.float64]) -> slice:
    """The bins across with more than a hundredth of the largest value, and a margin."""
    used = np.flatnonzero((values > 1e-2 * values.max()).any(axis=1))
    if used.size == 0:
        return slice(0, values.shape[0])
    return slice(max(int(used[0]) - _MARGIN, 0), int(used[-1]) + 1 + _MARGIN)


def _white_to_dark() -> Colormap:
    """Colours with white for zero and a visible colour for the smallest number."""
    colours = colormaps["YlOrBr"](np.linspace(0.08, 1.0, 256))
    colours[0] = 1.0
    return ListedColormap(colours)


def _surface(
    axes: Axes,
    surface: WheelSurface,
    values: NDArray[np.float64],
    shown: slice,
    highest: float,
    colours: Colormap | None = None,
) -> QuadMesh:
    """One coloured surface."""
    edges = surface.grid.edges[shown.start : shown.start + len(values[shown]) + 1] * 1e3
    mesh = axes.pcolormesh(
        surface.patch_grid.edges * 1e3,
        edges,
        values[shown],
        cmap=_white_to_dark() if colours is None else colours,
        vmin=0.0,
        vmax=highest,
        rasterized=True,
    )
    axes.set_ylim(edges[0], edges[-1])
    axes.tick_params(labelsize=7, direction="in")
    return mesh


def _label(axes: NDArray[np.object_], surface: WheelSurface) -> None:
    """Quantities along the axes."""
    measure = "lateral position" if surface.grid.profile_arc is None else "arc of the wheel profile"
    axes[0].set_ylabel(f"{measure} from the running circle [mm], flange up", fontsize=8)
    for place in axes:
        place.set_xlabel("in the patch, forward [mm]", fontsize=8)


def _number(value: float) -> str:
    """A count as text, to three digits."""
    return EngFormatter()(float(f"{value:.3g}"))
