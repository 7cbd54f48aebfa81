"""Irregularities for the kernels: cubic splines of the four signals on one uniform grid.

Values, slopes and second derivatives are continuous along the whole track, also where the irregularities
begin and end: outside they are zero, and inside they are faded in and out (`irregularity_table`).
"""

from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import inlined_kernel

_SIGNALS = 4
_MARGIN = 32  # zero nodes at either end: a spline's disturbance fades by 0.27 a node, to 1e-18


class IrregularityState(NamedTuple):
    """The four irregularities at one arc length, and their slopes; signs as in `irregularity`."""

    level: float  # [m]
    alignment: float  # [m]
    gauge: float  # [m]
    cross_level: float  # [m]
    level_slope: float  # [-]
    alignment_slope: float  # [-]
    gauge_slope: float  # [-]
    cross_level_slope: float  # [-]


class IrregularityTable(NamedTuple):
    """Level, alignment, gauge and cross-level at the nodes of a uniform grid. Outside it they are zero.

    One array for all: two neighbouring rows suffice, and few arrays make calls from Python fast.
    """

    start: float  # s of the first node [m]
    step: float  # node spacing [m]
    per_step: float  # 1 / step [1/m]
    nodes: FloatArray  # (n, 8) the four values [m], then their second derivatives along s [1/m]

    @property
    def end(self) -> float:
        """Arc length of the last node [m]."""
        return self.start + self.step * (len(self.nodes) - 1)


def fade_window(count: int, step: float, fade: float) -> FloatArray:
    """Weights of `count` samples that rise from 0 to 1 over `fade` metres and fall again at the end.

    Slope and second derivative are zero at both ends of a flank: w = 10 t^3 - 15 t^4 + 6 t^5.

    Parameters
    ----------
    count : int
        Number of samples.
    step : float
        Spacing [m].
    fade : float
        Length of a flank [m].
    """
    at = step * np.arange(count)
    t = np.clip(np.minimum(at, at[-1] - at) / fade, 0.0, 1.0)
    weights: FloatArray = t**3 * (10.0 - 15.0 * t + 6.0 * t * t)
    return weights


def irregularity_table(start: float, step: float, values: FloatArray, fade: float) -> IrregularityTable:
    """The table of samples (n, 4) [m] from arc length `start` at spacing `step`, faded over `fade` [m].

    Parameters
    ----------
    start : float
        Arc length of the first sample [m].
    step : float
        Spacing [m].
    values : (n, 4) array
        Level, alignment, gauge and cross-level [m].
    fade : float
        Length of fading at either end [m].
    """
    faded = values * fade_window(len(values), step, fade)[:, np.newaxis]
    padded = np.pad(faded, ((_MARGIN, _MARGIN), (0, 0)))
    first = start - _MARGIN * step
    spline = CubicSpline(step * np.arange(len(padded)), padded, bc_type="natural")
    second = spline(spline.x, 2)
    second[[0, -1]] = 0.0  # the end condition, without rounding
    return IrregularityTable(first, step, 1.0 / step, np.ascontiguousarray(np.hstack([padded, second])))


def smooth_track() -> IrregularityTable:
    """The table of a track without irregularities."""
    return IrregularityTable(0.0, 1.0, 1.0, np.zeros((2, 2 * _SIGNALS)))


@inlined_kernel
def irregularity_at(table: IrregularityTable, s: float) -> IrregularityState:
    """The four irregularities and their slopes at arc length s; zero outside the table.

    All NaN where s is NaN.

    Parameters
    ----------
    table : IrregularityTable
        Of the track.
    s : float
        Arc length [m].
    """
    u = (s - table.start) * table.per_step
    last = table.nodes.shape[0] - 1
    if u < 0.0 or u > last:
        return IrregularityState(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if not u >= 0.0:  # NaN
        return IrregularityState(u, u, u, u, u, u, u, u)
    i = min(int(u), last - 1)
    here = table.nodes[i]
    ahead = table.nodes[i + 1]
    t = u - i
    r = 1.0 - t
    # the cubic with given values and second derivatives at both nodes
    sixth = table.step * (1.0 / 6.0)
    a = table.step * sixth * (r * r * r - r)
    b = table.step * sixth * (t * t * t - t)
    c = sixth * (1.0 - 3.0 * r * r)
    d = sixth * (3.0 * t * t - 1.0)
    p = table.per_step
    return IrregularityState(
        r * here[0] + t * ahead[0] + a * here[4] + b * ahead[4],
        r * here[1] + t * ahead[1] + a * here[5] + b * ahead[5],
        r * here[2] + t * ahead[2] + a * here[6] + b * ahead[6],
        r * here[3] + t * ahead[3] + a * here[7] + b * ahead[7],
        p * (ahead[0] - here[0]) + c * here[4] + d * ahead[4],
        p * (ahead[1] - here[1]) + c * here[5] + d * ahead[5],
        p * (ahead[2] - here[2]) + c * here[6] + d * ahead[6],
        p * (ahead[3] - here[3]) + c * here[7] + d * ahead[7],
    )
