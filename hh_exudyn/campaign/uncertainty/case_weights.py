"""Weights of cases when shares of a collective are varied: seasons, runnings, hauls. Nothing is run again.

A share that is varied is taken as it is, and the others of its kind keep their proportions to each other. The
odds of the cases change as those of their shares, within cells that keep their part of the line: straight
track, and groups of curve classes, of each running. Groups with few runs, and so with few of the seasons, are
joined with their neighbours by radius (as strata are collapsed in surveys: W. G. Cochran, Sampling Techniques
(1977), 5A.12). A season that was met on straight track alone must not stand for less curves: there its share
says nothing. With the shares of the file the weights are those of the collective.
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.campaign.collective.axes import halved_seasons
from hh_exudyn.campaign.collective.plan import Plan
from hh_exudyn.campaign.collective.strata import Stratum
from hh_exudyn.campaign.collective.weighted import WeightedCase

_LEAST_RUNS = 3  # of a cell


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
        strata = [case.stratum for case in cases]
        number = {running.name: i for i, running in enumerate(plan.running)}
        runnings = [number[stratum.running] for stratum in strata]
        seasons = _season_numbers(plan)
        self._shares = [  # of every case: names of the shares that its weight goes with inside its cell
            (f"season[{seasons[stratum.season]}].share_percent", _haul_share(plan, i, stratum))
            for i, stratum in zip(runnings, strata, strict=True)
        ]
        self._runnings = [f"running[{i}].share_percent" for i in runnings]
        self._cell = _cells(strata)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the shares that these cases can tell: those of which they have some, but not all."""
        pairs = zip(self._shares, self._runnings, strict=True)
        found = dict.fromkeys(name for shares, running in pairs for name in (*shares, running) if name)
        kinds = [_kind(name) for name in found]
        return tuple(name for name in found if kinds.count(_kind(name)) > 1)

    @property
    def told(self) -> float:
        """Share of the distance in cells with more than one season: where shares of seasons act [-]."""
        seasons: dict[int, set[str]] = {}
        for cell, (season, _) in zip(self._cell.tolist(), self._shares, strict=True):
            seasons.setdefault(cell, set()).add(season)
        acting = np.array([len(seasons[cell]) > 1 for cell in self._cell.tolist()])
        return float(self.nominal[acting].sum())

    def at(self, values: Mapping[str, float]) -> FloatArray:
        """(n,) weights, which sum to 1.

        Parameters
        ----------
        values
            Of shares in percent by their names in the file, ``season[0].share_percent``; others are ignored.
        """
        ratios = {"": 1.0}
        for nominal in self._sharings:
            own = {name: 1e-2 * values[name] for name in nominal if name in values}
            for name, share in shared(nominal, own).items():
                ratios[name] = share / nominal[name] if own and nominal[name] > 0.0 else 1.0
        within = self.nominal * np.array([ratios[season] * ratios[haul] for season, haul in self._shares])
        size = int(self._cell.max()) + 1
        old, new = (np.bincount(self._cell, of_case, size) for of_case in (self.nominal, within))
        scale = np.divide(old, new, out=np.zeros(size), where=new > 0.0)
        weights = within * scale[self._cell] * np.array([ratios[name] for name in self._runnings])
        return np.asarray(weights / weights.sum(), dtype=np.float64)


def _cells(strata: Sequence[Stratum]) -> IntArray:
    """(n,) cell of every case: straight track of a running, and its groups of curves with some runs each."""
    found = np.zeros(len(strata), dtype=np.int64)
    cell = -1
    for part in dict.fromkeys((stratum.running, stratum.straight) for stratum in strata):
        own = [i for i, stratum in enumerate(strata) if (stratum.running, stratum.straight) == part]
        groups: dict[str, list[int]] = {}
        for i in sorted(own, key=lambda i: strata[i].radius_m):
            groups.setdefault(strata[i].group, []).append(i)
        runs = {group: len({strata[i].key for i in members}) for group, members in groups.items()}
        cell, within, left = cell + 1, 0, sum(runs.values())
        for group, members in groups.items():
            if within >= _LEAST_RUNS and left >= _LEAST_RUNS:
                cell, within = cell + 1, 0
            found[members] = cell
            within, left = within + runs[group], left - runs[group]
    return found


def _haul_share(plan: Plan, running: int, stratum: Stratum) -> str:
    """Name of the share of a case's haul; "" in classes of curves that have shares of their own."""
    hauls = plan.running[running].hauls
    if any(stratum.curve_class == name for haul in hauls for name, _ in haul.of_class):
        return ""
    return f"running[{running}].haul[{[haul.name for haul in hauls].index(stratum.haul)}].share_percent"


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
