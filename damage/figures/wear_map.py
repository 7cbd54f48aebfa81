"""The wear map with contacts in it: one point per cell that slips (figure 3-23 of Hossein-Nia 2018)."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pyarrow
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from damage.log_input.states import LOAD_COLUMNS, ContactStates, contact_states
from damage.wear.archard import ArchardValues, archard, archard_depths, read_archard
from damage.wear.jendel import MapValues
from damage.wear.law import WearLaw
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.tangential.api import traction_field

_ARCHARD = archard()
_SLOWEST = 1e-3  # left edge of the map, unless a contact slides slower on the whole [m/s]
_REGION_COLOURS = ("#eef3e6", "#f6d9b8", "#eef3e6", "#e9b3a5")  # mild, severe, mild, seizure
_POINT_COLOURS = ("#1b4f72", "#8c2d04", "#4a235a", "#0b5345", "#7d6608")


def wear_map_figure(
    states: Mapping[str, Any] | pyarrow.Table,
    names: Sequence[str] = (),
    law: WearLaw = _ARCHARD,
    theory: str = "fastrip",
    cells: tuple[int, int] = (50, 50),
    material: Material = STEEL,
) -> Figure:
    """The slipping cells of contact states in the map of sliding velocity and pressure.

    Parameters
    ----------
    states
        A few contact states, as `damage.wear.batch.wear_depths` takes them.
    names
        Names in the legend; numbers if none are given.
    law
        Archard's law, with its map and slip (elastic or rigid).
    theory, cells, material
        Settings of the tangential theory, see `hh_exudyn.contact.tangential.api.traction_field`.

    Raises
    ------
    ValueError
        Not Archard's law, another number of names than states, or bad states.
    """
    if law.depths is not archard_depths:
        raise ValueError(f"the wear law {law.name!r} has no map; only Archard's has")
    columns, values = contact_states(states), read_archard(law.values.numbers)
    count = columns.a.size
    if names and len(names) != count:
        raise ValueError(f"{len(names)} names for {count} contact states")
    figure = Figure(figsize=(6.4, 4.2), layout="constrained")
    axes = figure.subplots()
    slowest, fastest, highest = _SLOWEST, 2.0, values.map.seizure_pressure * 1.25
    for row in range(count):
        velocity, pressure = _slipping_cells(columns, row, values, theory, cells, material)
        if velocity.size:
            slowest = min(slowest, 0.5 * float(np.quantile(velocity, 0.05)))
            fastest = max(fastest, 2.0 * float(velocity.max()))
            highest = max(highest, 1.1 * float(pressure.max()))
        label = names[row] if names else f"state {row + 1}"
        colour = _POINT_COLOURS[row % len(_POINT_COLOURS)]
        axes.plot(
            velocity, pressure * 1e-9, ".", markersize=2.2, color=colour, markeredgewidth=0.0, label=label
        )
    _draw_regions(axes, values.map, slowest, fastest, highest)
    axes.set_xscale("log")
    axes.set_xlim(slowest, fastest)
    axes.set_ylim(0.0, highest * 1e-9)
    axes.set_xlabel(f"sliding velocity ({'rigid' if values.rigid else 'elastic'} slip) [m/s]")
    axes.set_ylabel("contact pressure [GPa]")
    figure.legend(loc="outside upper center", ncols=min(count, 3), fontsize=8, frameon=False, markerscale=4.0)
    return figure


def _slipping_cells(
    states: ContactStates,
    row: int,
    law: ArchardValues,
    theory: str,
    cells: tuple[int, int],
    material: Material,
) -> tuple[FloatArray, FloatArray]:
    """Sliding velocity [m/s] and pressure [Pa] of the cells that slip."""
    a, b, force, nu_x, nu_y, phi, friction = (float(getattr(states, name)[row]) for name in LOAD_COLUMNS)
    field = traction_field(theory, a, b, force, nu_x, nu_y, phi, friction, material, cells)
    slip = np.hypot(field.slip_x, field.slip_y)
    slips = slip > 0.0
    if law.rigid:
        slip = np.hypot(nu_x - phi * field.y, nu_y + phi * field.x)
    return slip[slips] * float(states.speed[row]), field.pressure[slips]


def _draw_regions(axes: Axes, wear_map: MapValues, slowest: float, fastest: float, highest: float) -> None:
    """The map's four regions with their coefficients."""
    limit = wear_map.seizure_pressure
    regions = (
        ("mild", wear_map.mild_slow, slowest, wear_map.severe_from, 0.0, limit),
        ("severe", wear_map.severe, wear_map.severe_from, wear_map.severe_to, 0.0, limit),
        ("mild", wear_map.mild_fast, wear_map.severe_to, fastest, 0.0, limit),
        ("seizure", wear_map.seizure, slowest, fastest, limit, highest),
    )
    for (name, coefficient, left, right, low, high), colour in zip(regions, _REGION_COLOURS, strict=True):
        corner = (left, low * 1e-9)
        axes.add_patch(
            Rectangle(corner, right - left, (high - low) * 1e-9, color=colour, linewidth=0.0, zorder=0)
        )
        text = f"{name}\n$k$ = {coefficient * 1e4:.3g}·10⁻⁴"
        middle = np.sqrt(left * right)
        axes.text(
            middle, (high - 0.04 * highest) * 1e-9, text, ha="center", va="top", fontsize=7, style="italic"
        )
    for velocity in (wear_map.severe_from, wear_map.severe_to):
        axes.plot([velocity] * 2, [0.0, limit * 1e-9], color="black", linewidth=0.6)
    axes.axhline(limit * 1e-9, color="black", linewidth=0.6)
    axes.annotate(
        f"$p$ = {limit / wear_map.hardness:.2g} $H$", (0.01, limit * 1e-9),
        xycoords=("axes fraction", "data"), xytext=(4.0, 3.0), textcoords="offset points", fontsize=7,
    )  # fmt: skip
