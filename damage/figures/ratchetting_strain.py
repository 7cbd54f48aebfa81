"""Plastic shear strain over depth after numbers of cycles, and when the layers fail."""

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure

from damage.rcf.ratchetting import Ratchetting, RatchettingSteel
from hh_exudyn.arrays import FloatArray


def ratchetting_figure(found: Ratchetting, steel: RatchettingSteel, stress: FloatArray) -> Figure:
    """Stress, strain and cycles to failure over the depth, depth downwards.

    The strain of layers that were worn off by then is not drawn.

    Parameters
    ----------
    found
        Strains at some numbers of cycles.
    steel
        Its strength and critical strain are drawn.
    stress
        (L,) largest orthogonal shear stress at the depths of the layers [Pa].
    """
    depth = found.depth * 1e3
    figure = Figure(figsize=(8.0, 3.6), layout="constrained")
    left, middle, right = figure.subplots(1, 3, sharey=True)
    left.plot(stress * 1e-6, depth, color="black", linewidth=1.4)
    for factor, name in ((1.0, "$k_0$"), (steel.hardening_limit, "$\\beta k_0$")):
        value = factor * steel.shear_yield * 1e-6
        left.axvline(value, color="0.5", linewidth=0.8, linestyle="--")
        left.text(value, depth[-1] * 0.98, f"{name} ", ha="right", va="bottom", fontsize=8, color="0.3")
    left.set_xlabel("largest $|\\tau_{zx}|$ [MPa]")
    left.set_ylabel("depth below the new surface [mm]")
    shades = colormaps["YlOrBr"](np.linspace(0.35, 1.0, found.cycles.size))
    for cycles, strain, shade in zip(found.cycles, found.strain, shades, strict=True):
        present = found.cycles_to_wear_off > cycles
        middle.plot(strain[present], depth[present], color=shade, linewidth=1.4, label=f"{cycles:.3g}")
    middle.axvline(steel.critical_strain, color="0.5", linewidth=0.8, linestyle="--")
    middle.text(steel.critical_strain, 0.6 * depth[-1], "$\\gamma_c$ ", ha="right", fontsize=8, color="0.3")
    middle.set_xlabel("plastic shear strain $\\gamma$ [-]")
    middle.legend(title="cycles", loc="lower right", fontsize=8, title_fontsize=8, frameon=False)
    failed = found.failed
    if failed.any():
        right.semilogx(
            found.cycles_to_failure[failed], depth[failed], color="#8c2d04", linewidth=1.4, label="failed"
        )
    worn = np.isfinite(found.cycles_to_wear_off) & (found.cycles_to_wear_off > 0.0)
    if worn.any():
        right.semilogx(
            found.cycles_to_wear_off[worn], depth[worn], color="#2b5c8a", linewidth=1.4, label="worn off"
        )
    ends = [
        shown for shown in (found.cycles_to_failure[failed], found.cycles_to_wear_off[worn]) if shown.size
    ]
    if ends:
        right.legend(fontsize=8, frameon=False)
        right.set_xlim(  # whole decades
            10.0 ** np.floor(np.log10(min(shown.min() for shown in ends))),
            10.0 ** np.ceil(np.log10(max(shown.max() for shown in ends))),
        )
    else:
        right.text(0.5, 0.5, "no layer failed", transform=right.transAxes, ha="center", fontsize=8)
    right.set_xlabel("cycles")
    left.set_xlim(left=0.0)
    middle.set_xlim(left=0.0)
    left.set_ylim(depth[-1], 0.0)  # depth downwards, for all three
    for axes in (left, middle, right):
        axes.tick_params(labelsize=8, direction="in")
    return figure
