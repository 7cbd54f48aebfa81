"""Root locus: the eigenvalues of a vehicle over its speed."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from hh_exudyn.arrays import ComplexArray, FloatArray

_SIZE = (9.0, 4.6)  # inches
_DAMPINGS = (0.05, 0.1, 0.2, 0.4)  # damping ratios that are drawn as lines
_STRONG = 0.5  # damping ratio above which modes are not drawn on the right


def root_locus_figure(
    title: str,
    speeds: FloatArray,
    locus: ComplexArray,
    critical: float | None = None,
    highest: float = 15.0,
) -> Figure:
    """Frequency over growth with the speed as colour, and damping ratios over speed.

    A motion with growth above zero and a damping ratio below zero is unstable.

    Parameters
    ----------
    title : str
        Above both panels.
    speeds : (n,) array
        [m/s].
    locus : (n, modes) array
        Eigenvalues of `hh_exudyn.multibody.linear.modes.root_locus` [1/s]; NaN where a mode does not exist.
    critical : float or None
        Critical speed [m/s]; None, the default, for none.
    highest : float
        Upper end of the frequencies shown [Hz].
    """
    figure = Figure(figsize=_SIZE, layout="constrained")
    figure.suptitle(title)
    plane, ratios = figure.subplots(1, 2)
    at = speeds * 3.6
    frequency, growth = locus.imag / (2 * np.pi), locus.real / (2 * np.pi)
    with np.errstate(invalid="ignore"):  # NaN has no damping ratio
        damping = -locus.real / np.abs(locus)
        shown = frequency <= highest
    marks: Any = None
    for k in range(locus.shape[1]):
        here = shown[:, k]
        plane.plot(growth[here, k], frequency[here, k], color="0.75", linewidth=0.8, zorder=1)
        marks = plane.scatter(
            growth[here, k], frequency[here, k], c=at[here], s=9, cmap="viridis",
            vmin=at.min(), vmax=at.max(), zorder=2,
        )  # fmt: skip
        weak = here & (damping[:, k] < _STRONG)
        if weak.any():
            ratios.plot(at, np.where(weak, damping[:, k] * 100.0, np.nan), linewidth=1.2)
    low = min(-0.5, float(np.nanmin(np.where(shown, growth, np.nan))) * 1.05)
    for ratio in _DAMPINGS:
        plane.plot(
            [0.0, -highest * ratio / np.sqrt(1 - ratio**2)], [0.0, highest], ":", color="0.6", linewidth=0.7
        )
    plane.axvline(0.0, color="tab:red", linewidth=1.0)
    plane.set_xlim(max(low, -0.7 * highest), max(0.1 * highest, float(np.nanmax(growth)) * 1.1))
    plane.set_ylim(0.0, highest)
    plane.set_xlabel(r"growth Re $\lambda$ / 2$\pi$ [1/s]")
    plane.set_ylabel("frequency [Hz]")
    plane.set_title("dotted: damping ratio 5, 10, 20, 40 %", fontsize="small")
    if marks is not None:
        figure.colorbar(marks, ax=plane, label="speed [km/h]")
    ratios.axhline(0.0, color="tab:red", linewidth=1.0)
    if critical is not None:
        ratios.axvline(critical * 3.6, color="tab:red", linestyle="--", linewidth=1.0)
        ratios.set_title(f"dashed: critical speed {critical * 3.6:.1f} km/h", fontsize="small")
    ratios.set_xlabel("speed [km/h]")
    ratios.set_ylabel("damping ratio [%]")
    ratios.set_xlim(float(at.min()), float(at.max()))
    for axes in (plane, ratios):
        axes.grid(alpha=0.3)
    return figure
