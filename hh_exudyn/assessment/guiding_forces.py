"""Forces on the track: sum Y of wheelsets, Q and Y of wheels, their quasi-static values in curves.

The quasi-static guiding force Yqst of outer wheels has a limit that rises in tight curves, and may be reduced
where the inner wheel shows high friction: its (Y/Q) above 0.4 pushes the outer wheel against its rail, which
is the weather's doing, not the vehicle's. Both from memory, see `data/assessment.toml`.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.assessment.findings import Finder, Finding, History
from hh_exudyn.assessment.limits import data, in_a_curve
from hh_exudyn.assessment.windows import sliding_mean, window_centres
from hh_exudyn.log.wheel_forces import WheelForces


def wheel_names(forces: WheelForces) -> tuple[str, ...]:
    """ "wheel 1L", "wheel 1R", ... of all wheelsets."""
    return tuple(f"wheel {number + 1}{side}" for number in range(forces.s.shape[1]) for side in "LR")


def unfiltered_sum_y(forces: WheelForces) -> History:
    """Force of every wheelset on the track as logged, positive to the left."""
    places = tuple(f"wheelset {number + 1}" for number in range(forces.s.shape[1]))
    return History(places, forces.s, forces.Y[:, :, 0] - forces.Y[:, :, 1])


def sliding(history: History, covered: tuple[float, float]) -> History:
    """Means of a history over the window of the standard, at its distance.

    Parameters
    ----------
    history : History
        Along the track.
    covered : (float, float)
        Arc lengths between which every wheelset has run [m].
    """
    how = data()["processing"]
    window = how["window_m"]
    centres = window_centres(*covered, window, how["step_m"])
    count = len(history.places)
    means = [sliding_mean(history.s[:, i], history.values[:, i], centres, window) for i in range(count)]
    places = np.repeat(centres[:, None], count, 1)
    return History(history.places, places, np.column_stack(means), 0.5 * window)


def guiding_histories(forces: WheelForces, covered: tuple[float, float]) -> dict[str, History]:
    """sum Y as a sliding mean, Q and Y of the wheels.

    Parameters
    ----------
    forces : WheelForces
        Below 20 Hz.
    covered : (float, float)
        As of `sliding`.
    """
    s = np.repeat(forces.s, 2, axis=1)
    wheels = wheel_names(forces)
    return {
        "sum_y": sliding(unfiltered_sum_y(forces), covered),
        "q": History(wheels, s, forces.Q.reshape(len(s), -1)),
        "y": History(wheels, s, forces.Y.reshape(len(s), -1)),
    }


def guiding_findings(finder: Finder) -> Iterator[Finding]:
    """All quantities of this file in one section."""
    how = data()["processing"]
    yield from finder.extremes("sum_y", "sum_y", how["percentiles"], True)
    for finding in finder.extremes("q", "q", how["percentiles"], False):
        yield replace(finding, low=float("nan"))  # not a quantity of the standard
    if not finder.section.curved:
        return
    middle = how["quasi_static_percentile"]
    loads = {place: float(np.percentile(values, middle)) for place, values in finder.courses("q")}
    guiding = {place: float(np.percentile(values, middle)) for place, values in finder.courses("y")}
    outer, inner = ("R", "L") if finder.section.hand == "left" else ("L", "R")
    for place, value in guiding.items():
        yield _in_curve(finder, finder.finding("y_quasi_static", place, abs(value)))
    rule = data()["limit"]["y_quasi_static_reduced"]
    for place, value in guiding.items():
        if not place.endswith(outer):
            continue
        partner = place.removesuffix(outer) + inner
        ratio = guiding[partner] / loads[partner] if loads[partner] > 0.0 else 0.0
        reduced = value - 1e3 * rule["slope_kN"] * max(ratio - rule["ratio"], 0.0)
        yield _in_curve(finder, finder.finding("y_quasi_static_reduced", place, max(reduced, 0.0)))
    for place, value in loads.items():
        yield finder.finding("q_quasi_static", place, abs(value))


def _in_curve(finder: Finder, finding: Finding) -> Finding:
    """The finding with the limit of the section's radius."""
    assert finding.limit is not None
    return replace(finding, limit=in_a_curve(finding.limit, finder.section.radius))


def wheel_columns(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The left and the right wheels of an array (n, wheels) of wheels."""
    return values[:, 0::2], values[:, 1::2]
