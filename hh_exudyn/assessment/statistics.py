"""Estimated maxima of test zones from many sections, of one run or of several, after UIC 518 / EN 14363.

The values of a quantity at one place in the N sections of a zone have mean and standard deviation. In one
dimension the estimated maximum is

    mean + k s,   k = 3 for safety, 2.2 for track loading and running behaviour, 0 for quasi-static ones.  (1)

In two dimensions, where sections of curves differ in cant deficiency I, a line v = a + b I is fitted, and the
maximum is the upper bound of its prediction at the largest I of the sections,

    a + b I + t s_e sqrt(1 + 1/N + (I - mean I)^2 / sum (I_i - mean I)^2),                                (2)

with the residual deviation s_e of N - 2 degrees of freedom and Student's t. Wheels are outer and inner ones
in curves, so that curves of both hands are one zone. k, probabilities and the least number of sections are
from memory (`data/assessment.toml`); a table says which of the two was used, and of how many sections.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pyarrow
from scipy.stats import t as student

from hh_exudyn.arrays import FloatArray
from hh_exudyn.assessment.findings import QUANTITIES, Finding
from hh_exudyn.assessment.limits import Limit, data, in_a_curve
from hh_exudyn.assessment.report import Assessment
from hh_exudyn.assessment.sections import AssessedSection

LEAST = 2  # sections without which there is no deviation


@dataclass(frozen=True)
class Estimate:
    """The estimated maximum of one quantity at one place in one kind of section.

    Attributes
    ----------
    kind, quantity, place : str
        Zone, name of the quantity, "wheel 1 outer", "wheelset 1", "car_body over bogie 1".
    sections : int
        N.
    mean, deviation : float
        Of the values of the sections.
    factor : float
        k; NaN in two dimensions.
    value : float
        The estimated maximum.
    limit : Limit or None
        None where none is known.
    """

    kind: str
    quantity: str
    place: str
    sections: int
    mean: float
    deviation: float
    factor: float
    value: float
    limit: Limit | None

    @property
    def share(self) -> float:
        """Value over limit; NaN without limit."""
        return self.value / self.limit.value if self.limit else math.nan

    @property
    def enough(self) -> bool:
        """Whether the zone has as many sections as the standard asks for."""
        return self.sections >= data()["statistics"]["least_sections"]

    @property
    def method(self) -> str:
        """ "mean + 3 s" or "regression"."""
        return "regression" if math.isnan(self.factor) else f"mean + {self.factor:g} s"


def zone_estimates(assessments: Sequence[Assessment]) -> list[Estimate]:
    """Estimated maxima of every kind of section, quantity and place with at least two sections.

    Parameters
    ----------
    assessments : sequence of Assessment
        Of runs of one vehicle.

    Raises
    ------
    ValueError
        The runs are of vehicles of different names or masses.
    """
    vehicles = {f"{one.vehicle.name}, {1e-3 * one.vehicle.mass:.1f} t" for one in assessments}
    if len(vehicles) > 1:
        raise ValueError(
            f"the runs are of {len(vehicles)} vehicles: {'; '.join(sorted(vehicles))}: statistics are of one"
        )
    groups: dict[tuple[str, str, str], list[tuple[Finding, float]]] = {}
    for assessment in assessments:
        for finding in assessment.findings:
            key = finding.section.kind, finding.quantity, _role(finding.place, finding.section)
            groups.setdefault(key, []).append((finding, assessment.deficiency(finding.section)))
    return [_estimate(key, values) for key, values in groups.items() if len(values) >= LEAST]


def largest(estimates: Sequence[Estimate]) -> list[Estimate]:
    """The largest estimate of every quantity in every kind of section."""
    found: dict[tuple[str, str], Estimate] = {}
    for one in estimates:
        key = one.kind, one.quantity
        if key not in found or one.value > found[key].value:
            found[key] = one
    return list(found.values())


def to_table(estimates: Sequence[Estimate]) -> pyarrow.Table:
    """All estimates, a row each, SI."""
    rows = [
        {
            "kind": one.kind, "quantity": one.quantity, "unit": QUANTITIES[one.quantity].unit,
            "place": one.place, "sections": one.sections, "enough_sections": one.enough, "mean": one.mean,
            "deviation": one.deviation, "method": one.method, "estimated_maximum": one.value,
            "limit": one.limit.value if one.limit else None, "share": one.share if one.limit else None,
            "limit_confirmed": one.limit.confirmed if one.limit else None,
        }
        for one in estimates
    ]  # fmt: skip
    names = ("kind", "quantity", "unit", "place", "sections", "enough_sections", "mean", "deviation",
             "method", "estimated_maximum", "limit", "share", "limit_confirmed")  # fmt: skip
    kinds = {"kind": "string", "quantity": "string", "unit": "string", "place": "string", "method": "string",
             "sections": "int32", "enough_sections": "bool", "limit_confirmed": "bool"}  # fmt: skip
    schema = pyarrow.schema((name, kinds.get(name, "float64")) for name in names)
    return pyarrow.Table.from_pylist(rows, schema=schema)


def prediction(x: FloatArray, values: FloatArray, place: float, probability: float) -> tuple[float, float]:
    """Line of regression at a place, and the half width of its prediction there, equation (2).

    Parameters
    ----------
    x, values : (n,) arrays
        At least 3 points, x not all equal.
    place : float
        Where.
    probability : float
        Two-sided, 0 for no width.
    """
    count, mean = x.size, float(x.mean())
    squares = float(((x - mean) ** 2).sum())
    slope = float(((x - mean) * values).sum()) / squares
    level = float(values.mean())
    residual = values - level - slope * (x - mean)
    deviation = math.sqrt(float((residual**2).sum()) / (count - 2))
    factor = float(student.ppf(0.5 * (1.0 + probability), count - 2))
    width = factor * deviation * math.sqrt(1.0 + 1.0 / count + (place - mean) ** 2 / squares)
    return level + slope * (place - mean), width


def _estimate(key: tuple[str, str, str], values: list[tuple[Finding, float]]) -> Estimate:
    """The estimate of one group."""
    kind, quantity, place = key
    how = data()["statistics"]
    concern = QUANTITIES[quantity].concern
    own = np.array([finding.value for finding, _ in values])
    deficiency = np.array([amount for _, amount in values])
    mean, deviation = float(own.mean()), float(own.std(ddof=1))
    first = values[0][0]
    rule = how["regression"]
    spread = 1e-3 * rule["least_spread_mm"]
    if first.section.curved and own.size >= rule["least_sections"] and np.ptp(deficiency) >= spread:
        factor = math.nan
        value = sum(prediction(deficiency, own, float(deficiency.max()), how["probability"][concern]))
    else:
        factor = float(how[concern])
        value = mean + factor * deviation
    limit = first.limit
    if limit is not None and quantity.startswith("y_quasi_static"):
        limit = in_a_curve(limit, float(np.mean([finding.section.radius for finding, _ in values])))
    return Estimate(kind, quantity, place, own.size, mean, deviation, factor, value, limit)


def _role(place: str, section: AssessedSection) -> str:
    """The place by its role in a curve: "wheel 1 outer" for "wheel 1R" in a left-hand one."""
    if not (section.curved and place.startswith("wheel ")):
        return place
    outer = "R" if section.hand == "left" else "L"
    return f"{place[:-1]} {'outer' if place.endswith(outer) else 'inner'}"
