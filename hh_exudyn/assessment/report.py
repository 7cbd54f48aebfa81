"""`standard_assessment`: the quantities of UIC 518 / EN 14363 in the test sections of a run, with limits.

===========================  =====================================================  =======================
quantity                     processing                                             assessed value
===========================  =====================================================  =======================
`sum_y`                      20 Hz, mean over 2 m every 0.5 m, per wheelset         larger of 0.15, 99.85 %
`y_over_q`                   the same, per wheel                                    99.85 %
`q`                          20 Hz, per wheel                                       99.85 %
`y_quasi_static`             20 Hz, per wheel, in curves                            50 %
`q_quasi_static`             the same                                               50 %
`body_lateral`, `_vertical`  0.4 to 10 Hz, over every bogie                         larger of 0.15, 99.85 %
`body_lateral_rms`, ...      the same                                               effective value
`body_lateral_quasi_static`  20 Hz, in curves                                       50 %
`sum_y_rms`                  f0 +- 2 Hz, effective over 100 m, per wheelset         the largest
`bogie_lateral_rms`          the same, frames over their wheelsets                  the largest
===========================  =====================================================  =======================

Y is positive outwards: a climbing flange has positive Y/Q, so the lower percentile is listed without a limit.
sum Y is the force of a wheelset on the track, positive to the left. f0 is the peak frequency of the spectrum
of sum Y; in a stable run it is not a frequency of hunting, and the effective values are then small.

A filter continues a run beyond its ends by point reflection: in the last second accelerations are a few per
cent wrong, so a run should end beyond its last test section.

Statistics over many sections (mean plus a multiple of the deviation) are left out: a run has too few.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pyarrow
from scipy.signal import welch

from hh_exudyn.arrays import FloatArray
from hh_exudyn.assessment.accelerations import body_places, bogie_places, point_accelerations
from hh_exudyn.assessment.limits import Limit, beyond_the_standards, data, limits
from hh_exudyn.assessment.sections import AssessedSection, Unassessed, cut_sections
from hh_exudyn.assessment.windows import sliding_mean, sliding_rms, window_centres
from hh_exudyn.case import Case
from hh_exudyn.log.ending import require_finished
from hh_exudyn.log.store import Run
from hh_exudyn.log.wheel_forces import WheelForces, wheel_forces
from hh_exudyn.signals import band_pass, low_pass
from vehicles.description import Vehicle
from vehicles.stored import from_json

LARGEST_INTERVAL = 0.010  # s: five values in a period of 20 Hz
_LEAST_LOAD = 0.01  # of the mean Q: divisor of Y where a wheel is unloaded
_LOWER, _UPPER = 0, 1

UNITS = {
    "sum_y": "N",
    "y_over_q": "-",
    "q": "N",
    "y_quasi_static": "N",
    "q_quasi_static": "N",
    "body_lateral": "m/s2",
    "body_vertical": "m/s2",
    "body_lateral_rms": "m/s2",
    "body_vertical_rms": "m/s2",
    "body_lateral_quasi_static": "m/s2",
    "sum_y_rms": "N",
    "bogie_lateral_rms": "m/s2",
}


@dataclass(frozen=True, eq=False)
class History:
    """A processed quantity along the track.

    Attributes
    ----------
    places : tuple of str
        "wheelset 1", "wheel 1L", "car_body over bogie 1".
    s, values : (n, places) arrays
        Arc length of each place [m], and the quantity.
    margin : float
        Half the window of its sliding mean [m]: values nearer to the end of a section include its neighbour.
    """

    places: tuple[str, ...]
    s: FloatArray
    values: FloatArray
    margin: float = 0.0

    def within(self, section: AssessedSection) -> Iterator[tuple[str, FloatArray]]:
        """Name and values of every place in a section."""
        for i, place in enumerate(self.places):
            s = self.s[:, i]
            inside = (s >= section.start + self.margin - 1e-9) & (s <= section.end - self.margin + 1e-9)
            yield place, self.values[inside, i]


@dataclass(frozen=True)
class Finding:
    """One quantity at one place in one section.

    Attributes
    ----------
    section, quantity, place
        Test section, name of the quantity, wheelset, wheel or point of a body.
    low, high : float
        Percentiles 0.15 and 99.85; NaN where there are none.
    value : float
        The assessed value, positive.
    limit : Limit or None
        Its limit; None where none is known.
    """

    section: AssessedSection
    quantity: str
    place: str
    low: float
    high: float
    value: float
    limit: Limit | None

    @property
    def share(self) -> float:
        """Value over limit; NaN without limit."""
        return self.value / self.limit.value if self.limit else math.nan


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
        Processed quantities along the track, by name: sum_y, y_over_q, q, body_lateral, body_vertical.
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
                "unit": UNITS[finding.quantity],
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
    raw = _sum_y(forces)
    f0 = _peak_frequency(raw, forces.interval)
    histories = _force_histories(forces, covered) | _acceleration_histories(run, described, vehicle, f0)
    histories["sum_y_rms"] = _in_band(raw, forces.interval, f0)
    known = limits(described)
    findings = tuple(finding for section in sections for finding in _findings(section, histories, known))
    beyond = beyond_the_standards(described)
    return Assessment(described, sections, findings, histories, f0, known, beyond, left_out, end)


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


def _sum_y(forces: WheelForces) -> History:
    """Unfiltered force of every wheelset on the track, positive to the left."""
    places = tuple(f"wheelset {number + 1}" for number in range(forces.s.shape[1]))
    return History(places, forces.s, forces.Y[:, :, 0] - forces.Y[:, :, 1])


def _force_histories(forces: WheelForces, covered: tuple[float, float]) -> dict[str, History]:
    """sum Y and Y/Q as sliding means; Q and Y below 20 Hz."""
    how = data()["processing"]
    smooth = forces.filtered(how["low_pass_Hz"])
    wheelsets = forces.s.shape[1]
    wheels = tuple(f"wheel {number + 1}{side}" for number in range(wheelsets) for side in "LR")
    s = np.repeat(forces.s, 2, axis=1)
    Q, Y = (force.reshape(len(force), -1) for force in (smooth.Q, smooth.Y))
    ratio = Y / np.maximum(Q, _LEAST_LOAD * Q.mean(axis=0))
    window = how["window_m"]
    centres = window_centres(*covered, window, how["step_m"])

    def sliding(places: tuple[str, ...], s: FloatArray, values: FloatArray) -> History:
        means = [sliding_mean(s[:, i], values[:, i], centres, window) for i in range(len(places))]
        return History(
            places, np.repeat(centres[:, None], len(places), 1), np.column_stack(means), 0.5 * window
        )

    sum_y = _sum_y(smooth)
    return {
        "sum_y": sliding(sum_y.places, sum_y.s, sum_y.values),
        "y_over_q": sliding(wheels, s, ratio),
        "q": History(wheels, s, Q),
        "y": History(wheels, s, Y),
    }


def _acceleration_histories(run: Run, vehicle: Vehicle, unit: int, f0: float) -> dict[str, History]:
    """Accelerations of the body in the standard's band and below 20 Hz, of the bogies about f0."""
    how = data()["processing"]
    found = {}
    over_bogies, over_wheelsets = body_places(vehicle, unit), bogie_places(vehicle, unit)
    if over_bogies:
        felt = point_accelerations(run, over_bogies)
        interval = float(felt.time[1] - felt.time[0])
        band = tuple(how["acceleration_band_Hz"])
        for name, values in (("body_lateral", felt.lateral), ("body_vertical", felt.vertical)):
            found[name] = History(felt.places, felt.s, band_pass(values, interval, band))
        slow = low_pass(felt.lateral, interval, how["low_pass_Hz"])
        found["body_lateral_slow"] = History(felt.places, felt.s, slow)
    if over_wheelsets:
        felt = point_accelerations(run, over_wheelsets)
        raw = History(felt.places, felt.s, felt.lateral)
        found["bogie_lateral_rms"] = _in_band(raw, float(felt.time[1] - felt.time[0]), f0)
    return found


def _peak_frequency(sum_y: History, interval: float) -> float:
    """f0, the peak frequency of the mean spectrum of sum Y of all wheelsets [Hz]."""
    low, high = data()["processing"]["instability"]["search_Hz"]
    count = min(len(sum_y.values), round(4.0 / interval))
    frequency, density = welch(sum_y.values, 1.0 / interval, nperseg=count, detrend="linear", axis=0)
    searched = (frequency >= low) & (frequency <= high)
    return float(frequency[searched][np.argmax(density[searched].mean(axis=1))])


def _in_band(raw: History, interval: float, f0: float) -> History:
    """A signal about f0, its lower edge not below that of the accelerations."""
    how = data()["processing"]
    half = how["instability_half_band_Hz"]
    band = max(f0 - half, how["acceleration_band_Hz"][0]), f0 + half
    return History(raw.places, raw.s, band_pass(raw.values, interval, band))


def _findings(
    section: AssessedSection, histories: dict[str, History], known: dict[str, Limit]
) -> Iterator[Finding]:
    """All quantities of a section."""
    nan = math.nan
    percentiles = data()["processing"]["percentiles"]
    middle = data()["processing"]["quasi_static_percentile"]

    def finding(name: str, place: str, value: float, low: float = nan, high: float = nan) -> Finding:
        return Finding(section, name, place, low, high, value, known.get(name))

    for name in ("sum_y", "y_over_q", "q", "body_lateral", "body_vertical"):
        for place, values in _present(histories, name, section):
            low, high = (float(p) for p in np.percentile(values, percentiles))
            if name == "q":
                low = nan  # not a quantity of the standard
            two_sided = name not in ("y_over_q", "q")
            yield finding(name, place, max(abs(low), abs(high)) if two_sided else high, low, high)
    for name in ("body_lateral", "body_vertical"):
        for place, values in _present(histories, name, section):
            yield finding(f"{name}_rms", place, float(np.sqrt(np.mean(values**2))))
    if section.curved:
        for name, of in (
            ("y_quasi_static", "y"),
            ("q_quasi_static", "q"),
            ("body_lateral_quasi_static", "body_lateral_slow"),
        ):
            for place, values in _present(histories, of, section):
                yield finding(name, place, abs(float(np.percentile(values, middle))))
    for name in ("sum_y_rms", "bogie_lateral_rms"):
        if name in histories:
            for place, value in _largest_rms(histories[name], section):
                yield finding(name, place, value)


def _present(
    histories: dict[str, History], name: str, section: AssessedSection
) -> Iterator[tuple[str, FloatArray]]:
    """Places and values of a quantity, none for a vehicle without such places."""
    return histories[name].within(section) if name in histories else iter(())


def _largest_rms(history: History, section: AssessedSection) -> Iterator[tuple[str, float]]:
    """Largest sliding effective value; a section shorter than the window is one window."""
    how = data()["processing"]["instability"]
    for i, place in enumerate(history.places):
        s = history.s[:, i]
        start, end = max(section.start, float(s[0])), min(section.end, float(s[-1]))
        window = min(float(how["window_m"]), end - start)
        centres = window_centres(start, end, window, how["step_m"])
        yield place, float(sliding_rms(s, history.values[:, i], centres, window).max())
