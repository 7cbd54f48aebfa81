"""Amplitude of hunting over the speed, from a search for the nonlinear critical speed."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

_SIZE = (6.4, 4.2)  # inches


def hunting_figure(
    title: str,
    speeds: Sequence[float],
    amplitudes: Sequence[float],
    from_cycle: Sequence[bool],
    settled: float,
) -> Figure:
    """Amplitudes of motions begun by the limit cycle of a higher speed (full marks) or by a disturbance
    (open).

    Parameters
    ----------
    title : above the figure
    speeds, amplitudes, from_cycle : of every run [m/s], [m]: `multibody.linear.nonlinear_speed.HuntingRun`
    settled : amplitude below which hunting has decayed [m]
    """
    figure = Figure(figsize=_SIZE, layout="constrained")
    axes = figure.subplots()
    at, size, went_on = 3.6 * np.array(speeds), 1e3 * np.array(amplitudes), np.array(from_cycle, dtype=bool)
    order = np.argsort(at[went_on])
    axes.plot(at[went_on][order], size[went_on][order], "o-", linewidth=0.8, label="from the cycle above")
    axes.plot(at[~went_on], size[~went_on], "o", mfc="none", label="disturbed at rest")
    axes.axhline(1e3 * settled, color="tab:red", linestyle="--", linewidth=1.0, label="died out")
    axes.set_title(title)
    axes.set_xlabel("speed [km/h]")
    axes.set_ylabel("lateral amplitude of a wheelset [mm]")
    axes.set_ylim(bottom=0.0)
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small")
    return figure
