"""`standard_assessment`: the quantities of UIC 518 / EN 14363 in the test sections of a run, with limits.

=============================  =====================================================  =======================
quantity                       processing                                             assessed value
=============================  =====================================================  =======================
`sum_y`                        20 Hz, mean over 2 m every 0.5 m, per wheelset         larger of 0.15, 99.85 %
`y_over_q`, `unloading`, ...   see `derailment`
`q`                            20 Hz, per wheel                                       99.85 %
`y_quasi_static`               20 Hz, per wheel, in curves                            50 %
`y_quasi_static_reduced`       of outer wheels, less what high friction adds          50 %
`q_quasi_static`               20 Hz, per wheel, in curves                            50 %
`body_lateral`, `_vertical`    0.4 to 10 Hz, over every bogie                         larger of 0.15, 99.85 %
`body_lateral_rms`, ...        the same                                               effective value
`body_lateral_quasi_static`    20 Hz, in curves                                       50 %
`sum_y_rms`                    f0 +- 2 Hz, effective over 100 m, per wheelset         the largest
`bogie_lateral_rms`            the same, frames over their wheelsets                  the largest
=============================  =====================================================  =======================

Y is positive outwards: a climbing flange has positive Y/Q, so the lower percentile is listed without a limit.
sum Y is the force of a wheelset on the track, positive to the left.

A filter continues a run beyond its ends by point reflection: in the last second accelerations are a few per
cent wrong, so a run should end beyond its last test section.

Estimated maxima from many sections are in `statistics`, ride and comfort in `ride`.
"""

import math
from dataclasses import dataclass

import numpy as np
import pyarrow

from hh_exudyn.assessment.accelerations import body_places, bogie_places, point_accelerations
from hh_exudyn.assessment.derailment import derailment_findings, derailment_histories, derailment_limits
from hh_exudyn.assessment.findings import QUANTITIES, Finder, Finding, History
from hh_exudyn.assessment.guiding_forces import guiding_findings, guiding_histories, unfiltered_sum_y
from hh_exudyn.assessment.limits import Limit, beyond_the_standards, data, limits, static_wheel_load
from hh_exudyn.assessment.ride import RideIndex, ride_indices
from hh_exudyn.assessment.running_behaviour import (
    about_the_peak,
    behaviour_findings,
    body_histories,
    peak_frequency,
)
from hh_exudyn.assessment.sections import AssessedSection, Unassessed, cut_sections
from hh_exudyn.case import Case
from hh_exudyn.conventions import GRAVITY, RAIL_TOP_DISTANCE
from hh_exudyn.log.ending import require_finished
from hh_exudyn.log.store import Run
from hh_exudyn.log.wheel_forces import WheelForces, wheel_forces
from vehicles.description import Vehicle
from vehicles.stored import from_json

LARGEST_INTERVAL = 0.010  # s: five values in a period of 20 Hz


@dataclass(frozen=True, eq=False)
class Assessment:
    """The assessment of a run.

    Attributes
    ----------
    vehicle : Vehicle
        The vehicle of the run.
    sections : tuple of AssessedSection
        From the start of the track.
    findings : tuple of Finding
        By section, quantity and place.
    histories : dict of History
        Processed quantities along the track, by name: sum_y, y_over_q, axle_sum, q, unloading, body_lateral,
        body_vertical.
    instability_frequency : float
        f0 [Hz].
    limits : dict of Limit
        By quantity.
    beyond : bool
        Whether the axle load is above the range of the standards.
    left_out : tuple of Unassessed
        Stretches of the track in no test section.
    ending : str
        "finished", or why the run ended early.
    ride : tuple of RideIndex
        Of the body over its bogies, over the whole run.
    speed : float
        Mean speed of the run [m/s].
    """

    vehicle: Vehicle
    sections: tuple[AssessedSection, ...]
    findings: tuple[Finding, ...]
    histories: dict[str, History]
    instability_frequency: float
    limits: dict[str, Limit]
    beyond: bool
    left_out: tuple[Unassessed, ...]
    ending: str
    ride: tuple[RideIndex, ...]
    speed: float

    def deficiency(self, section: AssessedSection) -> float:
        """Cant deficiency of a section at the mean speed of the run [m], negative for an excess."""
        return RAIL_TOP_DISTANCE * self.speed**2 * abs(section.curvature) / GRAVITY - section.cant

    def worst(self) -> list[Finding]:
        """The largest value of every quantity in every kind of section, in order of the sections."""
        found: dict[tuple[str, str], Finding] = {}
        for finding in self.findings:
            key = finding.section.kind, finding.quantity
            if key not in found or finding.value > found[key].value:
                found[key] = finding
        return list(found.values())

    def to_table(self) -> pyarrow.Table:
        """All findings, a row each, SI; `share` is value over limit, null without limit."""
        rows = [
            {
                "kind": finding.section.kind,
                "start_m": finding.section.start,
                "end_m": finding.section.end,
                "radius_m": finding.section.radius if finding.section.curved else None,
                "hand": finding.section.hand or None,
                "quantity": finding.quantity,
                "unit": QUANTITIES[finding.quantity].unit,
                "place": finding.place,
                "percentile_low": None if math.isnan(finding.low) else finding.low,
                "percentile_high": None if math.isnan(finding.high) else finding.high,
                "value": finding.value,
                "limit": finding.limit.value if finding.limit else None,
                "share": finding.share if finding.limit else None,
                "limit_confirmed": finding.limit.confirmed if finding.limit else None,
                "limit_source": finding.limit.source if finding.limit else None,
                "run": self.ending,
            }
            for finding in self.findings
        ]
        return pyarrow.Table.from_pylist(rows, schema=_SCHEMA)


_TEXTS = {"kind", "hand", "quantity", "unit", "place", "limit_source", "run"}
_SCHEMA = pyarrow.schema(
    (name, "string" if name in _TEXTS else "bool" if name == "limit_confirmed" else "float64")
    for name in (
        "kind", "start_m", "end_m", "radius_m", "hand", "quantity", "unit", "place", "percentile_low",
        "percentile_high", "value", "limit", "share", "limit_confirmed", "limit_source", "run",
    )
)  # fmt: skip


def standard_assessment(
    run: Run, vehicle: int = 1, section_length: float | None = None, unfinished: bool = False
) -> Assessment:
    """The assessment of a run after UIC 518 / EN 14363.

    Parameters
    ----------
    run : Run
        On disk, with its case.
    vehicle : int
        Number of the vehicle in the run, from 1.
    section_length : float or None
        Of test sections on straights and in curves [m]; None, the default, for the lengths of UIC 518.
    unfinished : bool
        Whether a run that ended early is taken.

    Raises
    ------
    FileNotFoundError
        The run has no case, contact log or motion log.
    ValueError
        An output interval above 10 ms, or one that is not constant; no stretch of track long enough for a
        section; no such vehicle; a vehicle that stood still; a run that ended early; impossible or repeated
        rows of the log.
    """
    end = require_finished(run, unfinished)
    case = Case.from_toml(run.case_text, source=f"{run.directory}/case.toml", folder=run.directory)
    forces = wheel_forces(run, vehicle)
    _check_interval(forces)
    covered = float(forces.s[0].max()), float(forces.s[-1].min())
    sections, left_out = cut_sections(case.alignment(), covered, section_length)
    described = case.described_vehicle() if run.vehicle_text is None else from_json(run.vehicle_text)
    known = limits(described) | derailment_limits(run, case, len(described.wheelsets))
    raw = unfiltered_sum_y(forces)
    f0 = peak_frequency(raw, forces.interval)
    smooth = forces.filtered(data()["processing"]["low_pass_Hz"])
    histories = guiding_histories(smooth, covered)
    histories |= derailment_histories(smooth, covered, static_wheel_load(described))
    ride: tuple[RideIndex, ...] = ()
    if over_bogies := body_places(described, vehicle):
        felt = point_accelerations(run, over_bogies)
        histories |= body_histories(felt)
        ride = ride_indices(felt)
    if over_wheelsets := bogie_places(described, vehicle):
        felt = point_accelerations(run, over_wheelsets)
        lateral = History(felt.places, felt.s, felt.lateral)
        histories["bogie_lateral_rms"] = about_the_peak(lateral, felt.interval, f0)
    histories["sum_y_rms"] = about_the_peak(raw, forces.interval, f0)
    speed = float((forces.s[-1] - forces.s[0]).mean()) / float(forces.time[-1] - forces.time[0])
    findings = tuple(
        finding for section in sections for finding in _in_section(Finder(section, histories, known), speed)
    )
    beyond = beyond_the_standards(described)
    return Assessment(described, sections, findings, histories, f0, known, beyond, left_out, end, ride, speed)


def _in_section(finder: Finder, speed: float) -> list[Finding]:
    """All quantities of a section."""
    return [
        *guiding_findings(finder),
        *derailment_findings(finder, speed),
        *behaviour_findings(finder),
    ]


def _check_interval(forces: WheelForces) -> None:
    steps = np.diff(forces.time)
    if steps.max() - steps.min() > 1e-6:
        raise ValueError(
            f"output interval is {1e3 * steps.min():g} to {1e3 * steps.max():g} ms, it must be constant"
        )
    if forces.interval > LARGEST_INTERVAL * (1.0 + 1e-9):
        raise ValueError(
            f"output interval is {1e3 * forces.interval:g} ms, allowed are up to "
            f"{1e3 * LARGEST_INTERVAL:g} ms: the standard's 20 Hz must be in the log"
        )
