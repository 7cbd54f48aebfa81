"""Safety against derailment: Y/Q of wheels after EN 14363 and Nadal, of wheelsets after Weinstock, unloading.

========================  ==========================================================  ========================
quantity                  processing                                                  assessed value
========================  ==========================================================  ========================
`y_over_q`                below 20 Hz, mean over 2 m every 0.5 m, per wheel           99.85 %
`y_over_q_nadal`          the same against Nadal's limit, by flange and friction      99.85 %
`axle_sum`                the same, |Y/Q| of both wheels, Weinstock's limit           99.85 %
`unloading`               1 - Q / Q0 below 20 Hz, per wheel                           99.85 %
`unloading_quasi_static`  the same; at crawling speed all unloading is quasi-static   50 %; crawling: 100 %
========================  ==========================================================  ========================

Q0 is the weight of the vehicle shared by its wheels. The limits against climbing go by the flattest flange of
the vehicle's wheels and the highest friction of its contacts, which lower them.
"""

import math
from collections.abc import Iterator

import numpy as np

from hh_exudyn.assessment.findings import Finder, Finding, History
from hh_exudyn.assessment.guiding_forces import sliding, wheel_columns, wheel_names
from hh_exudyn.assessment.limits import Limit, climbing_limits, data
from hh_exudyn.case import Case
from hh_exudyn.contact.profiles.measures import flange_angle
from hh_exudyn.log.store import Run
from hh_exudyn.log.wheel_forces import WheelForces

_LEAST_LOAD = 0.01  # of the mean Q: divisor of Y where a wheel is unloaded
_STEEPEST = math.radians(89.0)
_KM_H = 1.0 / 3.6  # m/s


def derailment_limits(run: Run, case: Case, wheelsets: int) -> dict[str, Limit]:
    """Nadal's and Weinstock's limits of a run; none where a measured flange leans over (89 degrees and more).

    Parameters
    ----------
    run : Run
        With its contact log.
    case : Case
        Of the run.
    wheelsets : int
        Their number in the vehicle.
    """
    profiles = {id(wheel): wheel for pair in case.wheels(wheelsets) for wheel in pair}
    flattest = min(flange_angle(wheel) for wheel in profiles.values())
    friction = max(
        float(np.asarray(batch["friction"]).max()) for batch in run.batches("contact", ["friction"])
    )
    return climbing_limits(flattest, friction) if flattest < _STEEPEST else {}


def derailment_histories(
    forces: WheelForces, covered: tuple[float, float], static_load: float
) -> dict[str, History]:
    """Y/Q, its sum over a wheelset, and the unloading of wheels.

    Parameters
    ----------
    forces : WheelForces
        Below 20 Hz.
    covered : (float, float)
        Arc lengths between which every wheelset has run [m].
    static_load : float
        Q0 [N].
    """
    s = np.repeat(forces.s, 2, axis=1)
    wheels = wheel_names(forces)
    Q, Y = (force.reshape(len(s), -1) for force in (forces.Q, forces.Y))
    ratio = Y / np.maximum(Q, _LEAST_LOAD * Q.mean(axis=0))
    left, right = wheel_columns(np.abs(ratio))
    wheelsets = tuple(f"wheelset {number + 1}" for number in range(forces.s.shape[1]))
    return {
        "y_over_q": sliding(History(wheels, s, ratio), covered),
        "axle_sum": sliding(History(wheelsets, forces.s, left + right), covered),
        "unloading": History(wheels, s, 1.0 - Q / static_load),
    }


def derailment_findings(finder: Finder, speed: float) -> Iterator[Finding]:
    """All quantities of this file in one section.

    Parameters
    ----------
    finder : Finder
        Of the section.
    speed : float
        Mean speed of the run [m/s].
    """
    how = data()["processing"]
    for name, history in (
        ("y_over_q", "y_over_q"),
        ("y_over_q_nadal", "y_over_q"),
        ("axle_sum", "axle_sum"),
        ("unloading", "unloading"),
    ):
        yield from finder.extremes(name, history, how["percentiles"], False)
    crawling = speed <= _KM_H * data()["limit"]["unloading_quasi_static"]["crawling_km_h"]
    share = 100.0 if crawling else how["quasi_static_percentile"]
    for place, values in finder.courses("unloading"):
        yield finder.finding("unloading_quasi_static", place, float(np.percentile(values, share)))
