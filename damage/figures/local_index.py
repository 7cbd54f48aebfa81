"""Fatigue indices across patches of a wheel: global, local with FaStrip, local with FASTSIM."""

import math

import numpy as np
from matplotlib.figure import Figure

from damage.log_input.contact_states import ContactSource, contact_chunks
from damage.log_input.states import LOAD_COLUMNS
from damage.material import ER7, WheelMaterial
from damage.rcf.local import distributed_index, local_indices
from hh_exudyn.arrays import FloatArray

_COLUMNS = (
    *("time", "vehicle", "wheelset", "side", "y_wheel", "contact_angle", "force_x", "force_y"),
    *LOAD_COLUMNS,
)
_CURVES = (
    ("global", "#7a7a7a", "--"),
    ("local, FaStrip", "#8c2d04", "-"),
    ("local, FASTSIM", "#2b5c8a", "-."),
)
_LOWEST = -0.2  # lower end of the axis: far below shakedown nothing is of interest [-]


def local_index_figure(
    run: ContactSource,
    wheels: tuple[tuple[int, int], ...] = ((1, -1), (1, 1)),
    material: WheelMaterial = ER7,
    vehicle: int = 1,
    time: float | None = None,
    cells: tuple[int, int] = (50, 50),
) -> Figure:
    """Fatigue index over the lateral position on the wheel at one time, a panel per wheel.

    The largest value of every strip, as in figure 3-20 of Hossein-Nia (2018). The global index is distributed
    over the patch like the pressure. Patches side by side are drawn separately.

    Close to saturation the order is global, FaStrip, FASTSIM, as in the thesis: FASTSIM's parabola is the
    highest in the middle of the patch (and fades first at its sides). Far from it FASTSIM, whose traction
    grows from the leading edge in a straight line, stays below FaStrip. In the demo the largest global index
    is below both on all wheels.

    Parameters
    ----------
    run
        A run, its directory, or its contact log as a table.
    wheels
        (wheelset, side) of the panels; side +1 left, -1 right.
    material
        The wheel steel.
    vehicle
        Number of the vehicle.
    time
        [s]; the output time nearest to it is drawn. None: the last.
    cells
        Cells of a patch along and across.

    Raises
    ------
    ValueError
        A wheel without a loaded patch at that time.
    """
    rows = _rows_at(run, time)
    figure = Figure(figsize=(3.6 * len(wheels), 3.4), layout="constrained")
    panels = figure.subplots(1, len(wheels), sharey=True, squeeze=False)[0]
    highest = 0.0
    for axes, (wheelset, side) in zip(panels, wheels, strict=True):
        of_wheel = (rows["vehicle"] == vehicle) & (rows["wheelset"] == wheelset) & (rows["side"] == side)
        mine = {name: values[of_wheel & (rows["normal_force"] > 0.0)] for name, values in rows.items()}
        if mine["time"].size == 0:
            raise ValueError(
                f"vehicle {vehicle}, wheelset {wheelset}, side {side:+d}: "
                f"no loaded patch at time = {rows['time'][0]:g} s"
            )
        indices = _three_indices(mine, material, cells)
        for (name, colour, style), (y, index) in zip(_CURVES, indices, strict=True):
            for patch in range(mine["time"].size):
                axes.plot(
                    y[patch] * 1e3, index[patch], style, color=colour, linewidth=1.4,
                    label=name if patch == 0 else None,
                )  # fmt: skip
            highest = max(highest, float(index.max()))
        heaviest = int(np.argmax(mine["normal_force"]))
        ratio = (
            math.hypot(mine["force_x"][heaviest], mine["force_y"][heaviest]) / mine["normal_force"][heaviest]
        )
        axes.set_title(
            f"wheelset {wheelset}, {'left' if side > 0 else 'right'}: "
            f"$Q/P$ = {ratio:.2f}, $\\mu$ = {mine['friction'][heaviest]:.2f}",
            fontsize=9,
        )
        axes.axhline(0.0, color="black", linewidth=0.6)
        axes.tick_params(labelsize=8, direction="in")
    for axes in panels:
        axes.set_ylim(_LOWEST, 1.15 * max(highest, -_LOWEST))
    panels[0].set_ylabel("largest FI over a strip [-]", fontsize=9)
    panels[0].legend(fontsize=8, frameon=False)
    figure.supxlabel("lateral position on the wheel profile [mm], flange on the right", fontsize=9)
    return figure


def _rows_at(run: ContactSource, time: float | None) -> dict[str, FloatArray]:
    """The rows of the output time nearest to a time, or of the last."""
    chosen: dict[str, FloatArray] = {}
    wanted = math.inf if time is None else time
    for chunk in contact_chunks(run, _COLUMNS):
        times = np.unique(chunk["time"])
        nearest = times[-1] if math.isinf(wanted) else times[np.argmin(np.abs(times - wanted))]
        here = {name: values[chunk["time"] == nearest] for name, values in chunk.items()}
        if not chosen or (time is None and nearest > chosen["time"][0]):
            chosen = here
        elif nearest == chosen["time"][0]:  # an output time cut in two by the chunks
            chosen = {name: np.concatenate([values, here[name]]) for name, values in chosen.items()}
        elif abs(nearest - wanted) < abs(chosen["time"][0] - wanted):
            chosen = here
    if not chosen:
        raise ValueError("the contact log has no rows")
    return chosen


def _three_indices(
    rows: dict[str, FloatArray], material: WheelMaterial, cells: tuple[int, int]
) -> list[tuple[FloatArray, FloatArray]]:
    """Places on the wheel profile [m] and indices [-], (patches, strips), in the order of `_CURVES`."""
    local = [local_indices(rows, material, name, cells) for name in ("fastrip", "fastsim")]
    spread = distributed_index(
        rows["force_x"], rows["force_y"], rows["normal_force"], rows["a"], rows["b"], material.shear_yield,
        strips=cells[1],
    )  # fmt: skip
    place = rows["y_wheel"][:, None] - (rows["side"] * np.cos(rows["contact_angle"]))[:, None] * local[0].y
    return [(place, spread), *((place, of.fatigue_index) for of in local)]
