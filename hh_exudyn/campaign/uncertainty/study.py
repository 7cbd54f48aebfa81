"""A study of what is assumed: bands of life and wear, and the assumptions that matter most.

Bands are quantiles over a Latin hypercube of the quantiles of all assumptions
(`hh_exudyn.campaign.uncertainty.assumptions.Assumption.at`); importance is that of
`hh_exudyn.campaign.uncertainty.importance`, for ln of each quantity, so that it is a relative change; where a
quantity can be zero, relative to its value with everything as it is.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import qmc

from damage.life.forecast import LONGEST
from damage.life.life_table import distance_quantiles
from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.uncertainty.assumptions import Assumption, named_values
from hh_exudyn.campaign.uncertainty.fast_life import Outcome
from hh_exudyn.campaign.uncertainty.importance import importance_of, points_of

FIRST, TREAD, FLANGE = "first turning", "tread wear", "flange wear"
MOST = 5
"""How many assumptions of each quantity are named, with the ends of their ranges."""
UNITS = {FIRST: "1000 km", TREAD: "um/1000 km", FLANGE: "um/1000 km", "Sh": "mm", "Sd": "mm", "qR": "mm"}
ALL = "all wheels"
QUANTILES = (0.05, 0.5, 0.95)

_SHORTEST = 1e3  # m, of a first turning in ln: limits that new wheels are beyond
_FIELDS: dict[str, tuple[str, float]] = {  # of an outcome, and the unit shown over SI
    FIRST: ("first_turning", 1e-6),
    TREAD: ("tread", 1e12),
    FLANGE: ("flange", 1e12),
    "Sh": ("flange_height", 1e3),
    "Sd": ("flange_thickness", 1e3),
    "qR": ("flange_steepness", 1e3),
}

Life = Callable[[Mapping[str, float]], Mapping[str, Outcome]]
Progress = Callable[[int, int], None]
"""Called with the evaluations that are done, and all of them."""


@dataclass(frozen=True)
class Band:
    """A quantity of a group of wheels: as it is, and quantiles of 5, 50 and 95 %, in the unit of `UNITS`."""

    group: str
    quantity: str
    nominal: float
    low: float
    median: float
    high: float


@dataclass(frozen=True)
class Influence:
    """How an assumption acts on a quantity.

    Attributes
    ----------
    assumption
        Which.
    importance, half_width
        mu* of ln (a relative change) or S_T, and half its interval of 95 %.
    at_ends
        The quantity with this alone at the low and the high end of its range, in the unit of `UNITS`; None
        for an assumption that is not among the `MOST` important.
    """

    assumption: Assumption
    importance: float
    half_width: float
    at_ends: tuple[float, float] | None = None


@dataclass(frozen=True, eq=False)
class Study:
    """What a study found.

    Attributes
    ----------
    bands
        Of every group and quantity; last the first turning of any wheel and the mean wear of all groups.
    causes
        Share of the samples in which a measure is the first one at its limit, by group.
    influences
        By quantity, the most important assumption first.
    nominal
        The quantities of all wheels as they are.
    method, samples, evaluations
        Of importance; of the bands; lives computed in all.
    invalid
        Samples in which wear over the campaign's distance leaves no valid profile; they have no Sh, Sd, qR.
    """

    bands: tuple[Band, ...]
    causes: Mapping[str, Mapping[str, float]]
    influences: Mapping[str, tuple[Influence, ...]]
    nominal: Mapping[str, float]
    method: str
    samples: int
    evaluations: int
    invalid: int


def study(
    life: Life, assumptions: Sequence[Assumption], samples: int = 100, method: str = "morris",
    seed: int = 1, progress: Progress | None = None,
) -> Study:  # fmt: skip
    """Bands and importance.

    Parameters
    ----------
    life
        From values by name to outcomes by group: `hh_exudyn.campaign.uncertainty.fast_life.FastLife`.
    assumptions
        To be varied, one at least.
    samples
        Of the bands, 10 or more.
    method
        One of `hh_exudyn.campaign.uncertainty.importance.METHODS`.
    seed
        Of the random numbers: the same seed gives the same study.
    progress
        Called after every evaluation.

    Raises
    ------
    ValueError
        Nothing to vary, too few samples, another method, or SALib is not installed.
    """
    own = tuple(assumptions)
    if not own:
        raise ValueError("no assumption can be varied: none has a range that the cases at hand can tell")
    if samples < 10:
        raise ValueError(f"samples = {samples}: allowed 10 or more")
    cube = qmc.LatinHypercube(len(own), rng=np.random.default_rng(seed)).random(samples)
    design = points_of(method, len(own), samples, seed)
    counter = _Counter(life, own, samples + len(design) + 1, progress)
    usual = counter(tuple(one.parameter.value for one in own))
    of_cube = [counter.at(row) for row in cube]
    of_design = [whole(counter.at(row)) for row in design]
    nominal = whole(usual)
    influences = {
        quantity: _influences(quantity, design, of_design, nominal[quantity], own, method, seed, counter)
        for quantity in nominal
    }
    return Study(
        tuple(_bands(usual, of_cube)),
        {group: _shares([outcomes[group].cause for outcomes in of_cube]) for group in usual},
        influences, nominal, method, samples, counter.done,
        sum(any(math.isnan(one.flange_height) for one in outcomes.values()) for outcomes in of_cube),
    )  # fmt: skip


def whole(outcomes: Mapping[str, Outcome]) -> dict[str, float]:
    """First turning of any group, and the mean wear of the groups, in the units of `UNITS`.

    Parameters
    ----------
    outcomes
        By group. Where none of them is ever turned the first turning is infinite.
    """
    return {
        FIRST: float(np.min([_shown(one, FIRST) for one in outcomes.values()])),
        TREAD: math.fsum(_shown(one, TREAD) for one in outcomes.values()) / len(outcomes),
        FLANGE: math.fsum(_shown(one, FLANGE) for one in outcomes.values()) / len(outcomes),
    }


class _Counter:
    """Outcomes at values, with progress."""

    def __init__(
        self, life: Life, assumptions: tuple[Assumption, ...], planned: int, progress: Progress | None
    ) -> None:
        self._life, self._assumptions, self._planned = life, assumptions, planned
        self._progress, self.done = progress, 0

    def __call__(self, values: Sequence[float]) -> Mapping[str, Outcome]:
        """Outcomes for values of all assumptions, in their order."""
        found = self._life({one.name: value for one, value in zip(self._assumptions, values, strict=True)})
        self.done += 1
        if self._progress is not None:
            self._progress(self.done, max(self._planned, self.done))
        return found

    def at(self, quantiles: FloatArray) -> Mapping[str, Outcome]:
        """Outcomes at quantiles of all assumptions."""
        return self(tuple(named_values(self._assumptions, quantiles).values()))


def _influences(
    quantity: str, design: FloatArray, of_design: Sequence[Mapping[str, float]], nominal: float,
    assumptions: tuple[Assumption, ...], method: str, seed: int, counter: _Counter,
) -> tuple[Influence, ...]:  # fmt: skip
    """Assumptions by their importance for a quantity of all wheels."""
    results = np.array([one[quantity] for one in of_design])
    if quantity == FIRST:
        results = np.log(np.clip(1e6 * results, _SHORTEST, LONGEST))
    elif nominal > 0.0:
        results = results / nominal
    value, half = importance_of(method, design, results, seed)
    found = []
    usual = [one.parameter.value for one in assumptions]
    for rank, i in enumerate(np.argsort(-value, kind="stable")):
        at_ends = None
        if rank < MOST and value[i] > 0.0:
            low, high = (
                whole(counter([*usual[:i], end, *usual[i + 1 :]]))[quantity] for end in assumptions[i].ends
            )
            at_ends = low, high
        found.append(Influence(assumptions[i], float(value[i]), float(half[i]), at_ends))
    return tuple(found)


def _bands(usual: Mapping[str, Outcome], samples: Sequence[Mapping[str, Outcome]]) -> list[Band]:
    """Bands of every group, and of all wheels."""
    found = []
    for group, outcome in usual.items():
        for quantity in _FIELDS:
            values = [_shown(outcomes[group], quantity) for outcomes in samples]
            found.append(_band(group, quantity, _shown(outcome, quantity), values))
    of_all = [whole(outcomes) for outcomes in samples]
    for quantity, nominal in whole(usual).items():
        found.append(_band(ALL, quantity, nominal, [one[quantity] for one in of_all]))
    return found


def _band(group: str, quantity: str, nominal: float, values: Sequence[float]) -> Band:
    known = [value for value in values if not math.isnan(value)]
    if not known:
        return Band(group, quantity, nominal, math.nan, math.nan, math.nan)
    low, median, high = distance_quantiles(known, quantiles=QUANTILES).values()
    return Band(group, quantity, nominal, low, median, high)


def _shown(outcome: Outcome, quantity: str) -> float:
    """A quantity of an outcome in the unit of `UNITS`."""
    name, factor = _FIELDS[quantity]
    return factor * float(getattr(outcome, name))


def _shares(causes: Sequence[str]) -> dict[str, float]:
    """Share of every cause, the most frequent one first."""
    found = {cause: causes.count(cause) / len(causes) for cause in dict.fromkeys(causes)}
    return dict(sorted(found.items(), key=lambda item: -item[1]))
