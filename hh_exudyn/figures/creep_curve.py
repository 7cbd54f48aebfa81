"""Creep force over creepage, all theories beside the half-space: like Fig. 2-4 to 2-7 of Hossein-Nia (2018).

Forces on the wheel over the friction limit, with the sign of the creepage turned: all curves rise.
"""

from collections.abc import Mapping, Sequence

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.tangential.curves import EXACT, CreepCurve, CurvePatch
from hh_exudyn.figures.style import SMALL

_COLUMN = {"longitudinal": 0, "lateral": 1, "spin": 1, "moment": 2}  # of `CreepCurve.forces`
_LABELS = {  # of the creepage, and of the force
    "longitudinal": (r"$\nu_x$ [‰]", r"$-F_x/\mu N$"),
    "lateral": (r"$\nu_y$ [‰]", r"$-F_y/\mu N$"),
    "spin": (r"$\varphi$ [1/m]", r"$-F_y/\mu N$"),
    "moment": (r"$\varphi$ [1/m]", r"$-M_z/\mu N c$, $c = \sqrt{ab}$"),
}
_HIGHEST = 1.15  # shown of theories without a friction limit


def creep_curve_figure(patch: CurvePatch, curves: Sequence[CreepCurve]) -> Figure:
    """A panel for each creepage, and for spin one more with the moment.

    Parameters
    ----------
    patch : CurvePatch
        What the curves are of.
    curves : sequence of CreepCurve
        At least one.

    Raises
    ------
    ValueError
        Without curves.
    """
    if not curves:
        raise ValueError("curves: none given, at least one is needed")
    panels = [(curve, curve.creepage) for curve in curves]
    panels += [(curve, "moment") for curve in curves if curve.creepage == "spin"]
    with matplotlib.rc_context(SMALL):
        figure = Figure(figsize=(3.1 * len(panels) + 0.6, 3.6), layout="constrained")
        figure.suptitle(_title(patch), fontsize=9)
        axes = figure.subplots(1, len(panels), squeeze=False)[0]
        for place, (curve, kind) in zip(axes, panels, strict=True):
            _draw(place, curve, kind)
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=min(len(labels), 8), frameon=False)
    return figure


def _draw(axes: Axes, curve: CreepCurve, kind: str) -> None:
    """One panel: theories as lines, the half-space as dots."""
    creepage, force = _LABELS[kind]
    scale = 1e3 if "‰" in creepage else 1.0
    for name, values in _last(curve.forces).items():
        look = {"marker": "o", "markersize": 3.0, "color": "black", "linestyle": "none", "zorder": 3}
        axes.plot(
            curve.values * scale, -values[:, _COLUMN[kind]], label=name,
            **(look if name == EXACT else {"linewidth": 1.1}),
        )  # fmt: skip
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, -_HIGHEST), min(high, _HIGHEST))
    axes.set_xlim(0.0, float(curve.values[-1]) * scale)
    axes.set_xlabel(creepage)
    axes.set_ylabel(force)
    axes.tick_params(direction="in")


def _last(forces: Mapping[str, FloatArray]) -> Mapping[str, FloatArray]:
    """The half-space behind all others, so that these keep their colours without it."""
    return {name: forces[name] for name in sorted(forces, key=lambda name: name == EXACT)}


def _title(patch: CurvePatch) -> str:
    """The patch, in the units of plots."""
    return (
        f"$a$ = {patch.a * 1e3:.4g} mm, $b$ = {patch.b * 1e3:.4g} mm, "
        f"$N$ = {patch.normal_force * 1e-3:.4g} kN, $\\mu$ = {patch.friction:.3g}; kept: "
        f"$\\nu_x$ = {patch.nu_x * 1e3:.4g} ‰, $\\nu_y$ = {patch.nu_y * 1e3:.4g} ‰, "
        f"$\\varphi$ = {patch.phi:.4g} 1/m"
    )
