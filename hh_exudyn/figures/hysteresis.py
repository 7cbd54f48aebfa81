"""Figure of friction loops: force over deflection, one panel each, with the energy of a cycle."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from hh_exudyn.arrays import FloatArray

_COLUMNS = 3
_SMALL = {"font.size": 8, "axes.titlesize": 9}


class Panel(NamedTuple):
    """One loop: a translation in m and N, or a rotation in rad and N m."""

    title: str
    rotation: bool
    displacement: FloatArray  # (n,)
    force: FloatArray  # (n,) of the drive of the motion
    dissipated: float  # in the whole cycle [J]


def friction_loops(title: str, panels: Sequence[Panel]) -> Figure:
    """Loops of force over deflection; the grey area is the energy of a cycle, arrows go with time.

    Raises
    ------
    ValueError
        No panels.
    """
    if not panels:
        raise ValueError("friction_loops needs one panel or more, it has none")
    rows = -(-len(panels) // _COLUMNS)
    with rc_context(_SMALL):
        figure = Figure(figsize=(9.0, 0.6 + 2.5 * rows), layout="constrained")
        figure.suptitle(title)
        grid = figure.subplots(rows, _COLUMNS, squeeze=False).ravel()
        for axes, panel in zip(grid, panels, strict=False):
            x, y = 1e3 * panel.displacement, 1e-3 * panel.force
            axes.fill(x, y, color="lightgray")
            axes.plot(x, y, color="tab:blue", linewidth=1.0)
            for share in (0.2, 0.3, 0.7, 0.8):
                k = int(share * (len(x) - 1))
                axes.annotate(
                    "", (x[k + 20], y[k + 20]), (x[k], y[k]),
                    arrowprops={"arrowstyle": "-|>", "color": "tab:blue"},
                )  # fmt: skip
            area = np.trapezoid(panel.force, panel.displacement)
            axes.set_title(f"{panel.title}\narea {area:.1f} J, dissipated {panel.dissipated:.1f} J")
            axes.set_xlabel("rotation [mrad]" if panel.rotation else "deflection [mm]")
            axes.set_ylabel("moment [kN m]" if panel.rotation else "force [kN]")
            axes.axhline(0.0, color="black", linewidth=0.5)
            axes.grid(alpha=0.3)
        for axes in grid[len(panels) :]:
            axes.remove()
    return figure
