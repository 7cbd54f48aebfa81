"""Figures of track: a track over its length, and a line as shares of its length."""

import math
from collections import defaultdict
from collections.abc import Callable, Hashable, Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from hh_exudyn.figures.style import SMALL
from track.course.alignment import Alignment
from track.irregularity.irregularity import Irregularity
from track.irregularity.quality import CLASSES, TrackQuality
from track.irregularity.spectra import SIGNALS
from track.line.line import TrackSection

CANT_STEP_MM = 10.0  # of the bars of the cants
_COLOURS = dict(zip(CLASSES, ("tab:green", "gold", "tab:orange", "tab:red"), strict=True))
_HANDS = {"straight": "tab:gray", "left": "tab:blue", "right": "tab:orange"}
_LABELS = {"cross_level": "cross-level"}


def track_sheet(
    title: str,
    alignment: Alignment,
    irregularity: Irregularity | None = None,
    quality: TrackQuality | None = None,
    limits: NDArray[np.float64] | None = None,
) -> Figure:
    """Panels over the arc length: curvature, cant, gauge, gradient, irregularities, standard deviations.

    Level track has no panel of the gradient.

    Parameters
    ----------
    title : str
        Above all panels.
    alignment : Alignment
        Shown from s = 0 to its length.
    irregularity : Irregularity or None
        None, the default, for smooth track: its panels are left out.
    quality : TrackQuality or None
        Standard deviations and classes of the sections; None leaves its panels out.
    limits : (2, 3) array or None
        QN1, QN2 and QN3 of level and alignment [m], drawn as lines into the panels of the quality.
    """
    table = alignment.table
    shown = (table.s >= 0.0) & (table.s <= alignment.length)
    courses = {
        "curvature\n[1/km], left +": 1e3 * table.curvature,
        "cant [mm]\nright rail high +": 1e3 * table.cant,
        "gauge\n[mm]": 1e3 * table.gauge,
    }
    if table.gradient.any():
        courses["gradient [\u2030]\nuphill +"] = 1e3 * table.gradient
    panels = len(courses) + (0 if irregularity is None else len(SIGNALS)) + (0 if quality is None else 2)
    with rc_context(SMALL):
        figure = Figure(figsize=(8.0, 1.0 + 1.15 * panels), layout="constrained")
        figure.suptitle(title)
        column = list(np.ravel(figure.subplots(panels, 1, sharex=True)))
        for axes, (label, values) in zip(column, courses.items(), strict=False):
            axes.plot(table.s[shown], values[shown], color="black")
            axes.set_ylabel(label)
            axes.ticklabel_format(useOffset=False)
            axes.grid(alpha=0.3)
        if irregularity is not None:
            _draw_irregularity(column[len(courses) : len(courses) + len(SIGNALS)], irregularity)
        if quality is not None:
            draw_quality(column[-2:], quality, limits)
        column[-1].set_xlim(0.0, alignment.length)
        column[-1].set_xlabel("arc length s [m]")
        figure.align_ylabels()
    return figure


def _draw_irregularity(panels: Sequence[Axes], irregularity: Irregularity) -> None:
    """A panel for each of the four signals; one scale for all, so that they can be compared."""
    largest = 1.1e3 * float(np.max(np.abs(irregularity.values))) or 1.0
    for axes, name in zip(panels, SIGNALS, strict=True):
        axes.plot(irregularity.s, 1e3 * irregularity.signal(name), linewidth=0.7)
        axes.set_ylim(-largest, largest)
        axes.set_ylabel(f"{_LABELS.get(name, name)}\n[mm]" if name != "gauge" else "gauge\ndeviation [mm]")
        axes.grid(alpha=0.3)


def draw_quality(
    panels: Sequence[Axes], quality: TrackQuality, limits: NDArray[np.float64] | None = None
) -> None:
    """Standard deviations of level and alignment as bars in the colour of the section's class.

    Parameters
    ----------
    panels : two Axes
        Level, alignment.
    quality : TrackQuality
        What to draw.
    limits : (2, 3) array or None
        QN1, QN2 and QN3 [m] by signal.
    """
    colours = [_COLOURS[CLASSES[i]] for i in quality.classes]
    for j, (axes, name) in enumerate(zip(panels, ("level", "alignment"), strict=True)):
        axes.bar(
            quality.start,
            1e3 * quality.deviations[:, j],
            width=quality.section_length,
            align="edge",
            color=colours,
            edgecolor="white",
        )
        axes.set_ylabel(f"std of {name}\n3-25 m [mm]")
        axes.grid(alpha=0.3, axis="y")
        for mark, limit, align in zip(
            CLASSES, () if limits is None else limits[j], ("top", "bottom", "center"), strict=False
        ):
            axes.axhline(1e3 * limit, color="black", linestyle="--", linewidth=0.7)
            axes.annotate(
                mark, (1.0, 1e3 * limit), xycoords=("axes fraction", "data"), xytext=(2, 0),
                textcoords="offset points", va=align, fontsize=6,
            )  # fmt: skip
    handles = [Patch(color=_COLOURS[name], label=name) for name in CLASSES]
    panels[0].legend(
        handles=handles, title="section (worse of both)", ncols=4, loc="upper right", title_fontsize=7
    )
    panels[0].set_ylim(top=1.6 * panels[0].get_ylim()[1])  # room for the legend


def line_sheet(title: str, sections: Sequence[TrackSection]) -> Figure:
    """Shares of a line by radius class, cant, speed and quality, stacked by hand.

    Raises ValueError without a section.
    """
    if not sections:
        raise ValueError("sections: none given, at least one is needed")
    with rc_context(SMALL):
        figure = Figure(figsize=(8.0, 6.0), layout="constrained")
        figure.suptitle(title)
        by_class, by_cant, by_speed, by_quality = np.ravel(figure.subplots(2, 2))
        # the tightest curves first, straight track at the end
        names = list(dict.fromkeys(part.name for part in sorted(sections, key=lambda part: part.radius)))
        draw_shares(by_class, sections, lambda part: part.name, names)
        by_class.set_xlabel("radius class [m]")
        by_class.tick_params(axis="x", labelrotation=60)
        draw_shares(by_cant, sections, _cant_bar, _sorted(sections, _cant_bar))
        by_cant.set_xlabel(f"cant [mm], to the nearest {CANT_STEP_MM:g}")
        draw_shares(by_speed, sections, _speed_bar, _sorted(sections, _speed_bar))
        by_speed.set_xlabel("speed [km/h]")
        draw_shares(by_quality, sections, lambda part: part.quality, CLASSES)
        by_quality.set_xlabel("quality class")
        by_class.legend()
    return figure


def draw_shares(
    axes: Axes,
    sections: Sequence[TrackSection],
    group: Callable[[TrackSection], Hashable],
    groups: Sequence[Hashable],
) -> None:
    """Bars of the sections' weights [%] by group, stacked by hand, the sum above each.

    Parameters
    ----------
    axes : Axes
        Where to draw.
    sections : sequence of TrackSection
        Of a line.
    group : callable
        The group of a section.
    groups : sequence
        All groups in the order of the bars.
    """
    shares: dict[tuple[str, Hashable], float] = defaultdict(float)
    for part in sections:
        shares[part.hand, group(part)] += 100.0 * part.weight
    foot = np.zeros(len(groups))
    at = np.arange(len(groups))
    for hand, colour in _HANDS.items():
        heights = np.array([shares[hand, name] for name in groups])
        if heights.any():
            axes.bar(at, heights, bottom=foot, color=colour, label=hand)
        foot += heights
    for x, whole in zip(at.tolist(), foot.tolist(), strict=True):
        axes.annotate(f"{whole:.1f}", (x, whole), (0, 1), textcoords="offset points", ha="center", fontsize=6)
    axes.set_xticks(at, [name if isinstance(name, str) else f"{name:g}" for name in groups])
    axes.set_xlim(-1.0, len(groups))
    axes.set_ylabel("share of the line [%]")
    axes.set_ylim(0.0, 1.1 * float(foot.max()))
    axes.grid(alpha=0.3, axis="y")


def _cant_bar(part: TrackSection) -> float:
    """Middle of the cant's bar [mm]."""
    return CANT_STEP_MM * math.floor(1e3 * part.cant / CANT_STEP_MM + 0.5)


def _speed_bar(part: TrackSection) -> float:
    """Speed [km/h], without the rounding of the conversion to m/s and back."""
    return round(3.6 * part.speed, 1)


def _sorted(sections: Sequence[TrackSection], group: Callable[[TrackSection], float]) -> list[float]:
    return sorted({group(part) for part in sections})
