"""Figures of a locomotive: drives over time, efforts of a train over speed, bogies in curves."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hh_exudyn.arrays import FloatArray
from hh_exudyn.figures.style import SMALL, wheelset_colour

_DEMAND, _COUPLER, _BRAKE = "black", "tab:red", "tab:green"
_STYLES = ("-", "--", ":")


def control_figure(title: str, control: Mapping[str, FloatArray]) -> Figure:
    """Speed, efforts, torques, slips and adhesion of a driven vehicle over time, from its control log.

    Parameters
    ----------
    title : str
        Above all panels.
    control : mapping of (n,) arrays
        The columns of the control log (`hh_exudyn.log.channels`), rows in order of time, then vehicle
        and wheelset.

    Raises
    ------
    ValueError
        No rows, or not as many of each wheelset.
    """
    wheelsets = set(zip(control["vehicle"].tolist(), control["wheelset"].tolist(), strict=True))
    axles, rows = len(wheelsets), control["time"].size
    if not axles or rows % axles:
        raise ValueError(f"control log has {rows} rows of {axles} wheelsets")
    of = {name: np.asarray(values).reshape(-1, axles) for name, values in control.items()}
    time = of["time"][:, 0]
    with rc_context(SMALL):
        figure = Figure(figsize=(7.0, 8.5), layout="constrained")
        figure.suptitle(title)
        panels = figure.subplots(5, 1, sharex=True)
        panels[0].plot(time, 3.6 * of["speed"].mean(axis=1), color=_DEMAND, label="locomotive")
        panels[0].plot(time, 3.6 * of["train_speed"][:, 0], color=_COUPLER, ls="--", label="train")
        panels[0].set_ylabel("speed [km/h]")
        panels[1].plot(time, 1e-3 * of["demand"][:, 0], color=_DEMAND, label="effort demanded")
        panels[1].plot(time, -1e-3 * of["coupler_force"][:, 0], color=_COUPLER, label="pull on the coupler")
        panels[1].set_ylabel("force [kN]")
        _wheelsets(panels[2], time, 1e-3 * of["torque"], "torque [kN m]")
        slip = 100.0 * (of["wheel_speed"] / of["speed"] - 1.0)
        _wheelsets(panels[3], time, slip, "longitudinal slip [%]")
        _wheelsets(panels[4], time, of["utilisation"], "creep force over\nfriction bound [-]")
        panels[4].set_ylim(0.0, 1.05)
        panels[4].set_xlabel("time [s]")
        panels[0].legend(ncols=2)
        panels[1].legend(ncols=2)
        handles, labels = panels[2].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=min(axles, 12), title="wheelset")
        _gridded(list(panels))
    return figure


def _wheelsets(axes: Axes, time: FloatArray, values: FloatArray, label: str) -> None:
    for number in range(values.shape[1]):
        axes.plot(time, values[:, number], lw=0.9, color=wheelset_colour(number), label=f"{number + 1}")
    axes.set_ylabel(label)


def _gridded(panels: Sequence[Axes]) -> None:
    for axes in panels:
        axes.grid(color="0.9")
        axes.set_axisbelow(True)


def effort_figure(
    title: str,
    largest: Callable[[float], float],
    brake: Callable[[float], float],
    demand: Callable[[float, float], float],
    gradients: Sequence[float],
    top_speed: float,
) -> Figure:
    """Largest traction and braking effort of all units over speed, and the effort for a train on gradients.

    The intersection of limit and demand is the steady speed of the train.

    Parameters
    ----------
    largest, brake : functions of the speed [m/s]
        Limits of all units together [N], both positive.
    demand : function of the speed [m/s] and the gradient [-]
        Effort that keeps the speed [N].
    gradients : sequence of float
        [-], positive uphill.
    top_speed : float
        [m/s]
    """
    speeds = np.linspace(1.0, top_speed, 200)
    with rc_context(SMALL):
        figure = Figure(figsize=(6.0, 4.5), layout="constrained")
        axes = figure.subplots()
        pull = [1e-3 * largest(v) for v in speeds]
        axes.plot(3.6 * speeds, pull, color=_DEMAND, lw=2, label="traction limit")
        axes.plot(3.6 * speeds, [-1e-3 * brake(v) for v in speeds], color=_BRAKE, lw=2, label="brake limit")
        for gradient in gradients:
            needed = [1e-3 * demand(v, gradient) for v in speeds]
            (line,) = axes.plot(3.6 * speeds, needed, lw=0.9, ls="--")
            text = f"{1e3 * gradient:+.3g} ‰" if gradient else "level"
            axes.annotate(
                text, (3.6 * speeds[-1], needed[-1]), xytext=(3, -3), textcoords="offset points",
                color=line.get_color(),
            )  # fmt: skip
        axes.set(title=title, xlabel="speed [km/h]", ylabel="effort of all units [kN]")
        axes.axhline(0.0, color="0.6", lw=0.8)
        axes.legend(loc="upper right")
        _gridded([axes])
    return figure


def bogie_curving_figure(
    title: str, radii: FloatArray, quantities: Mapping[str, Mapping[str, FloatArray]]
) -> Figure:
    """Quantities of the wheelsets of one bogie over the radius of the curve, variants side by side.

    Parameters
    ----------
    title : str
        Above all panels.
    radii : (n,) array
        [m]
    quantities : mapping of mappings of (n, wheelsets) arrays
        By label of the panel with unit ("angle of attack [mrad]"), then by variant.

    Raises
    ------
    ValueError
        No quantity, or an array of another length than `radii`.
    """
    radii = np.asarray(radii, dtype=np.float64)
    shapes = {values.shape[0] for variants in quantities.values() for values in variants.values()}
    if shapes != {radii.size}:
        raise ValueError(f"quantities of {sorted(shapes)} radii, radii are {radii.size}")
    order = np.argsort(radii)
    with rc_context(SMALL):
        rows = (len(quantities) + 1) // 2
        figure = Figure(figsize=(7.5, 0.6 + 2.5 * rows), layout="constrained")
        figure.suptitle(title)
        panels = figure.subplots(rows, 2, sharex=True, squeeze=False).ravel()
        for axes, (label, variants) in zip(panels, quantities.items(), strict=False):
            for style, (variant, values) in zip(_STYLES, variants.items(), strict=False):
                for number in range(values.shape[1]):
                    axes.plot(
                        radii[order], values[order, number], ls=style, marker="o", ms=3, lw=1,
                        color=f"C{number}", label=f"{variant} {number + 1}".strip(),
                    )  # fmt: skip
            axes.set_ylabel(label)
            if any(values.min() < 0.0 < values.max() for values in variants.values()):
                axes.axhline(0.0, color="0.6", lw=0.8)
            axes.set_xlabel("radius [m]")
        panels[0].legend(ncols=2, title="wheelset")
        for axes in panels[len(quantities) :]:
            axes.set_axis_off()
        _gridded(list(panels[: len(quantities)]))
    return figure
