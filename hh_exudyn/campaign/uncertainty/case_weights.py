"""Weights of cases when shares of a collective are varied: seasons, runnings, hauls. Nothing is run again.

A share that is varied is taken as it is, and the others of its kind keep their proportions to each other.
The cases of a season then carry its new share together, those of a stretch of line what they carried before:
weights are scaled until the sums of all kinds are as wanted (raking: W. E. Deming and F. F. Stephan, Annals
of Mathematical Statistics 11 (1940) 427-444). Where a collective is too small for that, with one season in a
class of curves, the seasons win. With the shares of the file the weights are those of the collective.
"""

import math
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.campaign.collective.axes import halved_seasons
from hh_exudyn.campaign.collective.plan import Plan
from hh_exudyn.campaign.collective.weighted import WeightedCase

_PASSES = 60
_CLOSE = 1e-12


def shared(nominal: Mapping[str, float], values: Mapping[str, float]) -> dict[str, float]:
    """Shares with some of them changed; they sum to 1.

    Parameters
    ----------
    nominal
        By name, with the sum 1.
    values
        Of those that change, by name; where they leave nothing for the others, or there are no others, they
        are scaled to the sum 1.
    """
    changed = math.fsum(values.values())
    others = math.fsum(share for name, share in nominal.items() if name not in values)
    rest = max(1.0 - changed, 0.0) / others if others > 0.0 else 0.0
    found = {name: values.get(name, rest * share) for name, share in nominal.items()}
    whole = math.fsum(found.values())
    return {name: share / whole for name, share in found.items()}


@dataclass(frozen=True, eq=False)
class _Margin:
    """Sums of weights that are wanted: the kind of every case, and the name of the share of every kind."""

    of_case: IntArray
    sums: FloatArray  # as in the collective
    names: tuple[str, ...]  # "" for what keeps its part of the whole
    whole: IntArray  # of every kind: kinds of one whole keep their sum
    running: IntArray  # of every kind

    def wanted(self, ratios: Mapping[str, float], of_running: FloatArray) -> FloatArray:
        """The sum of every kind for ratios of shares by name, new over old."""
        found = self.sums * np.array([ratios.get(name, 1.0) for name in self.names])
        size = int(self.whole.max()) + 1
        new, old = (np.bincount(self.whole, values, size) for values in (found, self.sums))
        scale = np.divide(old, new, out=np.zeros(size), where=new > 0.0)
        return np.asarray(found * scale[self.whole] * of_running[self.running], dtype=np.float64)


class CaseWeights:
    """The weights of the cases of an evaluation for given shares.

    Parameters
    ----------
    plan
        Of the collective.
    cases
        With their weights in the collective; scaled to the sum 1.
    """

    def __init__(self, plan: Plan, cases: Sequence[WeightedCase]) -> None:
        weights = np.array([case.weight for case in cases], dtype=np.float64)
        self.nominal: FloatArray = weights / weights.sum()
        self._sharings = sharings(plan)
        number = {running.name: i for i, running in enumerate(plan.running)}
        seasons = _season_numbers(plan)
        strata = [case.stratum for case in cases]
        of_class = {
            running.name: {name for haul in running.hauls for name, _ in haul.of_class}
            for running in plan.running
        }
        self._running_names = [f"running[{i}].share_percent" for i in range(len(plan.running))]
        track, haul, season = [], [], []
        for s in strata:
            i = number[s.running]
            names = [one.name for one in plan.running[i].hauls]
            fixed = s.curve_class if s.curve_class in of_class[s.running] else ""
            share = "" if fixed else f"running[{i}].haul[{names.index(s.haul)}].share_percent"
            track.append((i, (i,), (i, s.curve_class, s.hand), ""))
            haul.append((i, (i, fixed), (i, fixed, s.haul), share))
            season.append((i, (i,), (i, seasons[s.season]), f"season[{seasons[s.season]}].share_percent"))
        self._margins = [
            self._margin(rows) for rows in (track, haul, season)
        ]  # the last ones are met exactly

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the shares that these cases can tell: those of which they have some, but not all."""
        found = [name for margin in self._margins for name in margin.names if name]
        runnings = {int(i) for i in self._margins[0].running}
        found += [self._running_names[i] for i in sorted(runnings)]
        kinds = {name: [one for one in found if _kind(one) == _kind(name)] for name in found}
        return tuple(dict.fromkeys(name for name in found if len(set(kinds[name])) > 1))

    def at(self, values: Mapping[str, float]) -> FloatArray:
        """(n,) weights, which sum to 1.

        Parameters
        ----------
        values
            Of shares in percent by their names in the file, ``season[0].share_percent``; others are ignored.
        """
        ratios: dict[str, float] = {}
        for nominal in self._sharings:
            own = {name: 1e-2 * values[name] for name in nominal if name in values}
            for name, share in shared(nominal, own).items():
                ratios[name] = share / nominal[name] if nominal[name] > 0.0 else 1.0
        of_running = np.array([ratios[name] for name in self._running_names])
        wanted = [margin.wanted(ratios, of_running) for margin in self._margins]
        weights = self.nominal
        for _ in range(_PASSES):
            before = weights
            for margin, sums in zip(self._margins, wanted, strict=True):
                now = np.bincount(margin.of_case, weights, sums.size)
                scale = np.divide(sums, now, out=np.zeros_like(sums), where=now > 0.0)
                weights = weights * scale[margin.of_case]
            if np.abs(weights - before).max() < _CLOSE:
                break
        return np.asarray(weights / weights.sum(), dtype=np.float64)

    def _margin(self, rows: Sequence[tuple[int, Hashable, Hashable, str]]) -> _Margin:
        """A margin from the running, whole, kind and name of share of every case."""
        kinds = list(dict.fromkeys((running, whole, kind, name) for running, whole, kind, name in rows))
        wholes = list(dict.fromkeys(whole for _, whole, _, _ in kinds))
        of_case = np.array([kinds.index(row) for row in rows], dtype=np.int64)
        return _Margin(
            of_case,
            np.bincount(of_case, self.nominal, len(kinds)).astype(np.float64),
            tuple(name for _, _, _, name in kinds),
            np.array([wholes.index(whole) for _, whole, _, _ in kinds], dtype=np.int64),
            np.array([running for running, _, _, _ in kinds], dtype=np.int64),
        )


def sharings(plan: Plan) -> tuple[dict[str, float], ...]:
    """Shares by their names in the file, those that sum to 1 together."""
    return (
        {f"season[{i}].share_percent": season.share for i, season in enumerate(plan.seasons)},
        {f"running[{i}].share_percent": running.share for i, running in enumerate(plan.running)},
        *(
            {f"running[{i}].haul[{j}].share_percent": haul.share for j, haul in enumerate(running.hauls)}
            for i, running in enumerate(plan.running)
        ),
    )


def _kind(name: str) -> str:
    """What a share is a part of: its name without its own number."""
    return name.rpartition("[")[0]


def _season_numbers(plan: Plan) -> dict[str, int]:
    """Number in the file of every season by its name in a stratum, where steps of friction may be halved."""
    times = plan.halvings.get("friction", 0)
    names = [season.name for season in plan.seasons]
    found = {name: i for i, name in enumerate(names)}
    for season in halved_seasons(plan.seasons, times):
        if season.name not in found:
            found[season.name] = names.index(season.name.rpartition(" ")[0])
    return found
