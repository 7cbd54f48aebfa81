"""Figure of an assessed run: processed quantities along the track, and their shares of the limits."""

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hh_exudyn.assessment.findings import History
from hh_exudyn.assessment.report import Assessment
from hh_exudyn.assessment.sections import STRAIGHT, TRANSITION
from hh_exudyn.figures.style import SMALL, wheelset_colour

_COURSES = {  # quantity: label, factor, whether the limit holds on both sides
    "sum_y": ("ΣY, 2 m [kN]\nleft +", 1e-3, True),
    "y_over_q": ("Y/Q, 2 m [-]\noutwards +", 1.0, False),
    "q": ("Q [kN]\nbelow 20 Hz", 1e-3, False),
    "unloading": ("ΔQ/Q0 [-]\nbelow 20 Hz", 1.0, False),
    "body_lateral": ("body lateral\n0.4-10 Hz [m/s²]", 1.0, True),
    "body_vertical": ("body vertical\n0.4-10 Hz [m/s²]", 1.0, True),
}
_LABELS = {  # of the quantities that have a limit
    "sum_y": "ΣY",
    "y_over_q": "Y/Q",
    "y_over_q_nadal": "Y/Q, Nadal",
    "axle_sum": "Σ|Y/Q|, Weinstock",
    "unloading": "ΔQ/Q0",
    "unloading_quasi_static": "ΔQ/Q0 quasi-static",
    "q": "Q",
    "y_quasi_static": "Y quasi-static",
    "y_quasi_static_reduced": "Y quasi-static, reduced",
    "q_quasi_static": "Q quasi-static",
    "body_lateral": "body lateral",
    "body_vertical": "body vertical",
    "sum_y_rms": "ΣY, f0 ± 2 Hz, rms",
}
_SHADES = {STRAIGHT: "white", TRANSITION: "gold"}
_CURVE_SHADE = "tab:gray"
_LIMIT = "tab:red"
_ROOM = 3.0  # a limit larger than that many times the values is written, not drawn


def assessment_sheet(title: str, assessment: Assessment) -> Figure:
    """Histories with their limits over the arc length, then the value over limit of each place.

    A limit that is not confirmed is dashed, and its marks are hollow; one far beyond the curves is written.

    Parameters
    ----------
    title : str
        Above all panels.
    assessment : Assessment
        The assessment; quantities that the vehicle lacks, such as accelerations over bogies, have no panel.
    """
    shown = [name for name in _COURSES if name in assessment.histories]
    with rc_context(SMALL):
        heights = [1.0] * len(shown) + [2.4]
        figure = Figure(figsize=(9.0, 1.5 * sum(heights)), layout="constrained")
        figure.suptitle(title)
        panels = figure.subplots(len(heights), 1, squeeze=False, height_ratios=heights)[:, 0]
        for axes, name in zip(panels, shown, strict=False):
            _draw_course(axes, name, assessment)
            axes.sharex(panels[0])
            axes.label_outer(remove_inner_ticks=True)
        panels[len(shown) - 1].tick_params(labelbottom=True, bottom=True)
        panels[len(shown) - 1].set_xlabel("arc length [m]")
        _draw_shares(panels[-1], assessment)
        panels[0].legend(handles=_key(assessment), loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=6)
    return figure


def _draw_course(axes: Axes, name: str, assessment: Assessment) -> None:
    """One quantity over the arc length, in front of the test sections."""
    label, factor, two_sided = _COURSES[name]
    history = assessment.histories[name]
    for section in assessment.sections:
        shade = _SHADES.get(section.kind, _CURVE_SHADE)
        axes.axvspan(section.start, section.end, color=shade, alpha=0.15, linewidth=0)
        axes.axvline(section.start, color="black", linewidth=0.4, alpha=0.4)
        axes.axvline(section.end, color="black", linewidth=0.4, alpha=0.4)
    for i, place in enumerate(history.places):
        colour, style = _line(history, i)
        axes.plot(
            history.s[:, i], factor * history.values[:, i], style, color=colour, linewidth=0.7, label=place
        )
    limit = assessment.limits.get(name)
    if limit is not None:
        _draw_limit(axes, factor * limit.value, limit.confirmed, two_sided)
    axes.set_ylabel(label)
    axes.grid(alpha=0.3)
    axes.margins(x=0.01)


def _draw_limit(axes: Axes, value: float, confirmed: bool, two_sided: bool) -> None:
    """A limit as a line; as a note where its line would need a much larger scale than the curves."""
    low, high = axes.get_ylim()
    if value > _ROOM * max(-low, high):
        sign, mark = "±" if two_sided else "", "" if confirmed else ", unconfirmed"
        axes.annotate(
            f"limit {sign}{value:.3g}{mark}: off this panel", (0.995, 0.95), xycoords="axes fraction",
            ha="right", va="top", color=_LIMIT, fontsize=7,
        )  # fmt: skip
        return
    for own in (value, -value) if two_sided else (value,):
        axes.axhline(own, color=_LIMIT, linewidth=1.0, linestyle="-" if confirmed else "--")


def _line(history: History, i: int) -> tuple[str, str]:
    """Colour and style of a place: wheels of one wheelset share the colour, the right one is dotted."""
    wheel = history.places[i].startswith("wheel ")
    number = i // 2 if wheel else i
    return wheelset_colour(number), ":" if wheel and i % 2 else "-"


def _draw_shares(axes: Axes, assessment: Assessment) -> None:
    """Value over limit of every place and section, a row per quantity."""
    names = [name for name in _LABELS if any(f.quantity == name and f.limit for f in assessment.findings)]
    kinds = list(dict.fromkeys(section.kind for section in assessment.sections))
    for row, name in enumerate(names):
        for number, kind in enumerate(kinds):
            own = [f for f in assessment.findings if f.quantity == name and f.section.kind == kind]
            if not own:
                continue
            confirmed = own[0].limit is not None and own[0].limit.confirmed
            colour = wheelset_colour(number)
            offset = 0.5 * (number + 1) / (len(kinds) + 1) - 0.25
            axes.plot(
                [100.0 * f.share for f in own], np.full(len(own), row + offset), "o", color=colour,
                markersize=4, markerfacecolor=colour if confirmed else "none",
            )  # fmt: skip
    axes.axvline(100.0, color=_LIMIT, linewidth=1.0)
    axes.set_yticks(range(len(names)), [_LABELS[name] for name in names])
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.set_xlim(left=0.0)
    axes.set_xlabel("share of the limit [%]: every place in every section; hollow: limit unconfirmed")
    axes.grid(alpha=0.3)
    marks = [
        Line2D([], [], marker="o", linestyle="", color=wheelset_colour(i), label=kind)
        for i, kind in enumerate(kinds)
    ]
    axes.legend(handles=marks, loc="lower right")


def _key(assessment: Assessment) -> list[Line2D | Patch]:
    """Legend of lines and shades."""
    wheelsets = assessment.histories["sum_y"].places
    return [
        *(Line2D([], [], color=wheelset_colour(i), label=name) for i, name in enumerate(wheelsets)),
        Line2D([], [], color="black", linestyle=":", label="its right wheel"),
        Line2D([], [], color=_LIMIT, label="limit"),
        Line2D([], [], color=_LIMIT, linestyle="--", label="limit, unconfirmed"),
        Patch(color=_SHADES[TRANSITION], alpha=0.3, label="transition"),
        Patch(color=_CURVE_SHADE, alpha=0.3, label="curve"),
    ]
