"""What is assumed in a campaign: numbers with ranges that a study varies, and those that it cannot.

Varied are shares of the load collective, what films take off wear, the dry wear coefficients, cracks, limits
and places of the wheel, and the errors of sampling where the campaign knows them. All else that has a range
(friction, gauge, lengths, irregularity, steel) would need other runs, and is named with the reason.
"""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from damage.parameters import parameters, tables_of
from damage.wear.laws import law_parameters
from hh_exudyn.campaign.life.errors import FILE as ERRORS
from hh_exudyn.campaign.life.plan import CampaignPlan
from hh_exudyn.campaign.uncertainty.case_weights import CaseWeights, sharings
from hh_exudyn.campaign.uncertainty.film_wear import NAMES, FilmWear
from hh_exudyn.sourced import Parameter, made
from track.friction import ZONES

DRY = "wear.dry"
"""Factor on the dry wear coefficients."""
WEAR_ERROR, CRACK_ERROR = "errors.wear", "errors.cracks"
"""Factors on the rates of a group, ``errors.wear[outer]``."""
_RANGES = "hh_exudyn.campaign.uncertainty:data/ranges.toml"
_LIMITS = {
    "profile": None,  # all of it
    "cracks": ("failure_depth", "largest_length", "length_over_depth"),
    "places": ("root_width",),
}
_OTHERWISE = {
    "limits.cracks.largest_depth": "goes with limits.cracks.failure_depth: the depth where Miner's sum is 1",
    "limits.turning.below_crack": "counts from the first turning on",
}
_NEEDS_RUNS = "needs other runs"
NO_RANGE = "has no range"
_FRICTION = (0.2, 0.75)  # over the weather of the line, Hossein-Nia 2018, 1.1.5


@dataclass(frozen=True)
class Assumption:
    """A number that is varied within its range.

    Attributes
    ----------
    parameter
        Value, unit, range and source.
    label
        In words.
    """

    parameter: Parameter
    label: str

    @property
    def name(self) -> str:
        """Of the parameter."""
        return self.parameter.name

    @property
    def ends(self) -> tuple[float, float]:
        """Its range. Raises ValueError where it has none."""
        if self.parameter.range is None:
            raise ValueError(f"{self.name} = {self.parameter.value:g} {self.parameter.unit}: has no range")
        return self.parameter.range

    def at(self, quantile: float) -> float:
        """Its value at a quantile, 0 to 1.

        The value of the file is the median: as likely too small as too large, and on either side of it all
        values to the end of the range are equally likely.
        """
        (low, high), value = self.ends, self.parameter.value
        if quantile < 0.5:
            return low + 2.0 * quantile * (value - low)
        return value + (2.0 * quantile - 1.0) * (high - value)


@dataclass(frozen=True)
class NotVaried:
    """A number with a range that is not varied, or one that is assumed and has no range."""

    parameter: Parameter
    reason: str


@dataclass(frozen=True)
class Assumptions:
    """What is varied, and what is not."""

    varied: tuple[Assumption, ...]
    not_varied: tuple[NotVaried, ...]

    @property
    def nominal(self) -> dict[str, float]:
        """Values by name."""
        return {one.name: one.parameter.value for one in self.varied}


def assumptions_of(
    plan: CampaignPlan, directory: Path, weights: CaseWeights, films: FilmWear, groups: tuple[str, ...]
) -> Assumptions:
    """The assumptions of a campaign.

    Parameters
    ----------
    plan, directory
        Of the campaign.
    weights, films
        Of the cases of its last evaluation: which shares and films they tell.
    groups
        Of wheels.

    Raises
    ------
    ValueError
        The file of errors is broken.
    """
    varied: list[Assumption] = []
    left: list[NotVaried] = []
    labels = _share_labels(plan)
    numbers = (*plan.collective.assumed(), *plan.collective.plan.numbers, *plan.numbers)
    for number in dict.fromkeys(numbers):  # the assumed ones of the file are there twice
        if number.range is not None and number.name in weights.names:
            varied.append(Assumption(number, labels[number.name]))
        elif number.range is not None and number.name in labels:
            left.append(NotVaried(number, "no case of the last evaluation is of that kind, or all are"))
        elif number.range is not None:
            left.append(NotVaried(number, _NEEDS_RUNS))
        elif number.kind == "assumed":
            left.append(NotVaried(number, NO_RANGE))
    others: list[Assumption | NotVaried] = [*_of_runs(plan), *_wear(plan, films), *_limits(plan)]
    for one in (*others, *_errors(directory, groups)):
        if isinstance(one, Assumption):
            varied.append(one)
        else:
            left.append(one)
    return Assumptions(tuple(varied), tuple(left))


def _share_labels(plan: CampaignPlan) -> dict[str, str]:
    """Words for the shares of the collective."""
    found = {name: name for one in sharings(plan.collective.plan) for name in one}
    for i, season in enumerate(plan.collective.plan.seasons):
        found[f"season[{i}].share_percent"] = f"share of season {season.name!r}"
    for i, running in enumerate(plan.collective.plan.running):
        found[f"running[{i}].share_percent"] = f"share of {running.name}"
        for j, haul in enumerate(running.hauls):
            found[f"running[{i}].haul[{j}].share_percent"] = f"share of {haul.name}, {running.name}"
    return found


def _of_runs(plan: CampaignPlan) -> Iterator[NotVaried]:
    """What the runs were made with, and the file names or lists: friction, speeds, steel."""
    of_file = "assumed: of the campaign's file"
    for i, season in enumerate(plan.collective.plan.seasons):
        for zone, value in zip(ZONES, season.friction.coefficients, strict=True):
            name = f"season[{i}].{zone}"
            if all(name != number.name for number in plan.collective.plan.numbers):
                friction = made(name, value=value, unit="-", source=of_file, range=_FRICTION)
                yield NotVaried(friction, _NEEDS_RUNS)
    for i, running in enumerate(plan.collective.plan.running):
        for k, (fraction, _) in enumerate(running.speeds):
            name = f"running[{i}].speed.of_largest_percent[{k}]"
            yield NotVaried(made(name, value=1e2 * fraction, unit="%", source=of_file), _NEEDS_RUNS)
        for k, (_, share) in enumerate(running.speeds if len(running.speeds) > 1 else ()):
            name = f"running[{i}].speed.share_percent[{k}]"
            yield NotVaried(made(name, value=1e2 * share, unit="%", source=of_file), NO_RANGE)
    for item in parameters("materials", plan.damage.material).values():
        if item.range is not None:
            yield NotVaried(replace(item, name=f"materials.{plan.damage.material}.{item.name}"), _NEEDS_RUNS)


def _wear(plan: CampaignPlan, films: FilmWear) -> Iterator[Assumption | NotVaried]:
    """The dry coefficients and the films of the wear law, and other numbers of the law with a range."""
    law = plan.damage.law
    tables = law_parameters(law)
    if law != "archard":
        for table, items in tables.items():
            for item in items.values():
                if item.range is not None:
                    yield NotVaried(replace(item, name=f"wear.{table}.{item.name}"), _NEEDS_RUNS)
        return
    regions = [tables["jendel"][name] for name in ("mild_slow", "severe", "mild_fast", "seizure")]
    low, high = (
        sum(item.range[end] / item.value for item in regions if item.range is not None) / len(regions)
        for end in (0, 1)
    )
    source = (
        "assumed: one factor for all regions of Jendel's map, as wear here is a mix; the mean of their "
        "ranges over their values"
    )
    yield Assumption(
        made(DRY, value=1.0, unit="-", source=source, range=(low, high)), "dry wear coefficients"
    )
    for name, (table, key) in NAMES.items():
        item = parameters("wear", table)[key]
        ranged = item if item.range is not None else tables_of(_RANGES)[table][key]
        found = replace(ranged, name=name)
        if table == "surface" and key in films.films:
            yield Assumption(found, f"wear divided by, {key}")
        elif table == "films" and films.passes:
            yield Assumption(found, f"film passes {key.replace('_', ' ')}")
        else:
            yield NotVaried(found, "no case of the last evaluation has such a film")
    yield NotVaried(replace(tables["jendel"]["hardness"], name="wear.jendel.hardness"), _NEEDS_RUNS)


def _limits(plan: CampaignPlan) -> Iterator[Assumption | NotVaried]:
    """Cracks, limits and places of the wheel."""
    tables = tables_of("damage:data/limits.toml")
    for table in ("profile", "cracks", "places", "turning"):
        for key, item in tables[table].items():
            found = replace(item, name=f"limits.{table}.{key}")
            if item.range is None:
                continue
            wanted = _LIMITS.get(table, ())
            if plan.workshop is None:
                yield NotVaried(found, "no wheel is turned in this campaign")
            elif wanted is None or key in wanted:
                yield Assumption(found, key.replace("_", " "))
            else:
                yield NotVaried(found, _OTHERWISE[found.name])


def _errors(directory: Path, groups: tuple[str, ...]) -> Iterator[Assumption]:
    """The errors of sampling of the rates, one of wear and one of cracks for each group."""
    path = directory / ERRORS
    if not path.is_file():
        return
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        halves = dict(zip(content["quantities"], content["sampling"], strict=True))
        at = float(content["distance_km"])
    except (ValueError, KeyError, TypeError) as error:
        raise ValueError(
            f"{path}: holds no errors of a campaign ({error}); run campaign error anew"
        ) from None
    for group in groups:
        for name, word in ((WEAR_ERROR, "wear at"), (CRACK_ERROR, "crack damage of the tread")):
            own = [half for key, half in halves.items() if key.startswith(f"{group}: ") and word in key]
            if own:
                yield _error_of(
                    f"{name}[{group}]", f"sampling of {word.removesuffix(' at')}, {group}", own, at
                )


def _error_of(name: str, label: str, halves: list[Any], at: float) -> Assumption:
    """A factor within the largest of some half widths."""
    half = min(float(max(halves)), 0.99)
    source = f"derived: largest half width of the interval of 95 % ({ERRORS}, at {at:.0f} km)"
    return Assumption(made(name, value=1.0, unit="-", source=source, range=(1.0 - half, 1.0 + half)), label)


def named_values(assumptions: tuple[Assumption, ...], quantiles: Any) -> Mapping[str, float]:
    """Values by name at quantiles, one for each assumption.

    Parameters
    ----------
    assumptions
        k of them.
    quantiles
        (k,) 0 to 1.
    """
    return {one.name: one.at(float(u)) for one, u in zip(assumptions, quantiles, strict=True)}
