"""The forms of the assessment: quantities, their courses along the track, and their values in sections."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.assessment.limits import Limit
from hh_exudyn.assessment.sections import AssessedSection

SAFETY, TRACK, RUNNING, QUASI_STATIC = "safety", "track_loading", "running_behaviour", "quasi_static"


class Quantity(NamedTuple):
    """A quantity of the assessment: its unit, and what its statistics go by (`statistics`)."""

    unit: str
    concern: str


QUANTITIES = {
    "sum_y": Quantity("N", SAFETY),
    "y_over_q": Quantity("-", SAFETY),
    "y_over_q_nadal": Quantity("-", SAFETY),
    "axle_sum": Quantity("-", SAFETY),
    "unloading": Quantity("-", SAFETY),
    "unloading_quasi_static": Quantity("-", QUASI_STATIC),
    "q": Quantity("N", TRACK),
    "y_quasi_static": Quantity("N", QUASI_STATIC),
    "y_quasi_static_reduced": Quantity("N", QUASI_STATIC),
    "q_quasi_static": Quantity("N", QUASI_STATIC),
    "body_lateral": Quantity("m/s2", RUNNING),
    "body_vertical": Quantity("m/s2", RUNNING),
    "body_lateral_rms": Quantity("m/s2", RUNNING),
    "body_vertical_rms": Quantity("m/s2", RUNNING),
    "body_lateral_quasi_static": Quantity("m/s2", QUASI_STATIC),
    "sum_y_rms": Quantity("N", SAFETY),
    "bogie_lateral_rms": Quantity("m/s2", SAFETY),
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


class Finder:
    """Findings in one section, from the histories of a run and the limits of its vehicle."""

    def __init__(
        self, section: AssessedSection, histories: dict[str, History], limits: dict[str, Limit]
    ) -> None:
        self.section, self.histories, self.limits = section, histories, limits

    def courses(self, history: str) -> Iterator[tuple[str, FloatArray]]:
        """Places and values of a history in the section; none for a vehicle without such places."""
        return self.histories[history].within(self.section) if history in self.histories else iter(())

    def finding(
        self, quantity: str, place: str, value: float, low: float = math.nan, high: float = math.nan
    ) -> Finding:
        """A finding with the limit of its quantity.

        Parameters
        ----------
        quantity, place, value, low, high
            As of `Finding`.
        """
        return Finding(self.section, quantity, place, low, high, value, self.limits.get(quantity))

    def extremes(
        self, quantity: str, history: str, percentiles: tuple[float, float], two_sided: bool
    ) -> Iterator[Finding]:
        """The outer percentiles of a history at every place; the assessed one is the larger, or the upper.

        Parameters
        ----------
        quantity, history
            Names of the quantity and of its history.
        percentiles
            Lower and upper one [%].
        two_sided
            Whether the larger amount is assessed, else the upper percentile.
        """
        for place, values in self.courses(history):
            low, high = (float(p) for p in np.percentile(values, percentiles))
            yield self.finding(quantity, place, max(abs(low), abs(high)) if two_sided else high, low, high)
