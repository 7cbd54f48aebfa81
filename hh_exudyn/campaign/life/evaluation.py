"""`Evaluation`: rates of all groups of wheels, for given profiles, from the cases of a load collective.

What is run is decided by what has moved (`hh_exudyn.campaign.life.reuse`), so it depends on the evaluations
before. Therefore each leaves a record of the results that it took: the same profiles again take the same
results, and a campaign that was killed goes on as if it had not been.

    DIR/evaluations/7c01d2a94be35f10.json    results by case, under the hash of the profiles of all groups
"""

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from hh_exudyn.campaign.collective.films import wear_films
from hh_exudyn.campaign.collective.weighted import WeightedCase
from hh_exudyn.campaign.engine.case_damage import CaseWork, Part, case_task, evaluate_case
from hh_exudyn.campaign.engine.mapping import Standing, TooManyFailed, evaluate_all
from hh_exudyn.campaign.engine.results import ResultFolder
from hh_exudyn.campaign.engine.sums import PartSums
from hh_exudyn.campaign.engine.task import Evaluate, Task
from hh_exudyn.campaign.engine.workers import Workers
from hh_exudyn.campaign.life.groups import Place
from hh_exudyn.campaign.life.plan import CampaignPlan
from hh_exudyn.campaign.life.profiles import ProfileFiles
from hh_exudyn.campaign.life.rates import GroupRates, on_bins, rates_of_case, weighted_mean
from hh_exudyn.campaign.life.reuse import LastRun, has_moved
from hh_exudyn.contact.profile import Profile
from hh_exudyn.conventions import LEFT
from hh_exudyn.log.parts import write_text
from vehicles.description import Vehicle

EVALUATIONS, PROFILES = "evaluations", "profiles"

GroupProfiles = Mapping[str, Profile]
GroupRatesByCase = tuple[tuple[WeightedCase, Mapping[str, GroupRates]], ...]


@dataclass(frozen=True)
class Evaluated:
    """Rates for the profiles of all groups.

    Attributes
    ----------
    digest
        Of the profiles: name of the record.
    rates
        By group: the weighted mean of the cases.
    cases
        Rates of every weighted case that did not fail, by group.
    ran, reused
        Cases that were run for these profiles, and those of which a former result stands [-].
    failed
        Names, weights and reasons of failed cases.
    """

    digest: str
    rates: Mapping[str, GroupRates]
    cases: GroupRatesByCase
    ran: int
    reused: int
    failed: tuple[tuple[str, float, str], ...]


@dataclass(frozen=True)
class _Slot:
    """A weighted case with the groups of its wheels; slots of one name share a run."""

    weighted: WeightedCase
    vehicle: Vehicle
    groups: Mapping[Place, str]
    name: str


class Evaluation:
    """Rates of wheel groups from a load collective, by an engine, with a memory of what was run last.

    Parameters
    ----------
    plan
        The campaign.
    cases
        Of its collective, or some of them.
    folder
        Of results, open.
    workers
        Where cases run.
    directory
        Of the campaign, for records and profiles.
    progress
        Called as `evaluate_all` does.
    evaluate
        From a `CaseWork` to sums: a pure function, defined in a module.
    """

    def __init__(
        self, plan: CampaignPlan, cases: Sequence[WeightedCase], folder: ResultFolder, workers: Workers,
        directory: Path, progress: Callable[[Standing], None] | None = None,
        evaluate: Evaluate = evaluate_case,
    ) -> None:  # fmt: skip
        self.plan, self._folder, self._workers = plan, folder, workers
        self._records, self._progress = directory / EVALUATIONS, progress
        self.profiles = ProfileFiles(directory / PROFILES)
        self._evaluate = evaluate
        self._slots = [_slot(plan, weighted) for weighted in cases]
        self._last: dict[str, LastRun] = {}
        self._rates: dict[tuple[str, str], Mapping[str, GroupRates]] = {}
        self._made: dict[tuple[object, ...], Task] = {}

    def go_on(self, digest: str) -> Evaluated | None:
        """The evaluation of a record, as if it had just been made; None where there is no such record.

        Parameters
        ----------
        digest
            `Evaluated.digest`.
        """
        content = self._content(digest)
        return None if content is None else self._evaluated(digest, content["profiles"])

    def __call__(self, profiles: GroupProfiles) -> Evaluated:
        """The rates for profiles by group.

        Raises
        ------
        ValueError
            A group without a profile, or a profile that a case refuses.
        TooManyFailed, EngineStopped, OSError, KeyboardInterrupt, Terminated
            As `evaluate_all`; what was run is kept.
        """
        digests = {group: self.profiles.put(profile) for group, profile in sorted(profiles.items())}
        text = json.dumps(digests, sort_keys=True)
        return self._evaluated(hashlib.sha256(text.encode()).hexdigest()[:16], digests)

    def _evaluated(self, digest: str, digests: Mapping[str, str]) -> Evaluated:
        """The evaluation of profiles by group, recorded or new."""
        recorded = self._record(digest)
        found = recorded if recorded is not None else self._planned(digests)
        self._evaluate_missing(found)
        if recorded is None:
            self._write(digest, digests, found)
        self._last = found
        ran = sum(dict(last.profiles) == self._own(name, digests) for name, last in found.items())
        rows = tuple(self._rows(found))
        rates = {
            group: weighted_mean(
                [
                    (weighted.weight, on_bins(by_group[group], rows[0][1][group].y))
                    for weighted, by_group in rows
                ]
            )
            for group in digests
        }
        return Evaluated(digest, rates, rows, ran, len(found) - ran, self._failed(found))

    def rates_of_cases(
        self, cases: Sequence[WeightedCase], profiles: GroupProfiles
    ) -> list[Mapping[str, GroupRates]]:
        """Rates of other cases than those of the steps, for profiles by group.

        Parameters
        ----------
        cases
            Of the campaign's collective, such as further samples.
        profiles
            By group.

        Raises
        ------
        TooManyFailed
            One of them has no result: an error cannot be told without.
        ValueError, EngineStopped, OSError, KeyboardInterrupt, Terminated
            As a call.
        """
        digests = {group: self.profiles.put(profile) for group, profile in sorted(profiles.items())}
        slots = [_slot(self.plan, weighted) for weighted in cases]
        tasks = {}
        for slot in slots:
            own = {group: digests[group] for group in sorted(set(slot.groups.values()))}
            tasks[slot.name] = self._task(slot, own)
        evaluate_all(
            list(tasks.values()), self._evaluate, self._folder, self._workers, progress=self._progress
        )
        return [self._rates_of(slot, tasks[slot.name].key) for slot in slots]

    def _evaluate_missing(self, found: Mapping[str, LastRun]) -> None:
        """Evaluate what has no result yet; raises TooManyFailed for more weight than is allowed."""
        wanted = {}
        for slot in self._slots:
            last = found[slot.name]
            if (last.key, slot.name) not in self._rates:
                wanted[last.key] = self._task(slot, last.profiles)
        evaluate_all(
            list(wanted.values()), self._evaluate, self._folder, self._workers,
            failing_weight=1.0, progress=self._progress,
        )  # fmt: skip
        failed = self._failed(found)
        lost, allowed = sum(weight for _, weight, _ in failed), self.plan.failing_weight
        if lost > allowed * (1.0 + 1e-9):
            named = "; ".join(f"{name} (weight {weight:.3g}): {reason}" for name, weight, reason in failed)
            raise TooManyFailed(
                f"{len(failed)} cases failed, {1e2 * lost:.3g} % of the weight, allowed {1e2 * allowed:.3g} "
                f"%: {named}"
            )

    def _failed(self, found: Mapping[str, LastRun]) -> tuple[tuple[str, float, str], ...]:
        """Name, weight and reason of the weighted cases without a result."""
        failures = [
            (slot.weighted, self._folder.failure(found[slot.name].key))
            for slot in self._slots
            if (found[slot.name].key, slot.name) not in self._rates
        ]
        return tuple((w.case.name, w.weight, one.reason) for w, one in failures if one is not None)

    def _own(self, name: str, digests: Mapping[str, str]) -> dict[str, str]:
        """The profiles of the groups that a slot's wheels belong to."""
        slot = next(slot for slot in self._slots if slot.name == name)
        return {group: digests[group] for group in sorted(set(slot.groups.values()))}

    def _planned(self, digests: Mapping[str, str]) -> dict[str, LastRun]:
        """For every slot the result that counts: of a run to be made, or of the last one where it stands."""
        found: dict[str, LastRun] = {}
        for slot in self._slots:
            if slot.name in found:
                continue
            own = {group: digests[group] for group in sorted(set(slot.groups.values()))}
            last = self._last.get(slot.name)
            if last is not None and self._stands(slot, last, own):
                found[slot.name] = last
            else:
                found[slot.name] = LastRun(self._task(slot, own).key, own)
        return found

    def _stands(self, slot: _Slot, last: LastRun, own: Mapping[str, str]) -> bool:
        """Whether the result of a last run stands for other profiles; of a failed case only for its own."""
        if dict(last.profiles) == dict(own):
            return True
        if self.plan.unmoved == 0.0 or self._folder.failure(last.key) is not None:
            return False
        before = {group: self.profiles.read(digest) for group, digest in last.profiles.items()}
        now = {group: self.profiles.read(digest) for group, digest in own.items()}
        return not has_moved(before, now, self._rates_of(slot, last.key), self.plan.unmoved)

    def _task(self, slot: _Slot, digests: Mapping[str, str]) -> Task:
        """The task of a slot with given profiles of its groups; making one takes some 0.1 s."""
        place = (slot.name, *sorted(digests.items()))
        if place not in self._made:
            self._made[place] = case_task(
                self._work(slot, digests), slot.weighted.case.name, slot.weighted.weight
            )
        return self._made[place]

    def _work(self, slot: _Slot, digests: Mapping[str, str]) -> CaseWork:
        """The run of a slot with given profiles of its groups."""
        weighted = slot.weighted
        wheels = {
            f"{wheelset}{'L' if side == LEFT else 'R'}": str(self.profiles.path(digests[group]))
            for (wheelset, side), group in slot.groups.items()
        }
        case = weighted.case.with_changes(wheel_profiles=wheels)
        parts = tuple(Part(part.name, part.start, part.end) for part in weighted.parts)
        films = wear_films(weighted.case, weighted.films)
        return CaseWork(case, parts, self.plan.damage, films, scratch=self._folder.scratch)

    def _rows(self, found: Mapping[str, LastRun]) -> list[tuple[WeightedCase, Mapping[str, GroupRates]]]:
        """Rates of all weighted cases that have a result."""
        rows = []
        for slot in self._slots:
            key = found[slot.name].key
            if (key, slot.name) in self._rates or self._folder.failure(key) is None:
                rows.append((slot.weighted, self._rates_of(slot, key)))
        return rows

    def _rates_of(self, slot: _Slot, key: str) -> Mapping[str, GroupRates]:
        """Rates of a slot from a result; slots of one name have the same parts and groups."""
        if (key, slot.name) not in self._rates:
            sums = self._folder.sums(key)
            self._rates[key, slot.name] = rates_of_case(sums, slot.weighted, slot.vehicle, slot.groups)
        return self._rates[key, slot.name]

    def _content(self, digest: str) -> dict[str, Any] | None:
        """What the record of an evaluation holds; None where it was not made, or not to its end."""
        return _content_of(self._records / f"{digest}.json")

    def _record(self, digest: str) -> dict[str, LastRun] | None:
        """Results of an evaluation by slot."""
        content = self._content(digest)
        return None if content is None else _last_runs(content)

    def _write(self, digest: str, digests: Mapping[str, str], found: Mapping[str, LastRun]) -> None:
        cases = {name: {"key": last.key, "profiles": dict(last.profiles)} for name, last in found.items()}
        self._records.mkdir(parents=True, exist_ok=True)
        content = {"profiles": dict(digests), "cases": cases}
        write_text(self._records / f"{digest}.json", json.dumps(content, indent=1, sort_keys=True) + "\n")


def recorded_rates(
    plan: CampaignPlan, directory: Path, folder: ResultFolder, digest: str
) -> GroupRatesByCase:
    """Rates of every weighted case of an evaluation that was made; nothing is run, nothing is written.

    Parameters
    ----------
    plan, directory
        Of the campaign.
    folder
        Of its results; need not be open.
    digest
        Name of the evaluation.

    Raises
    ------
    ValueError
        There is no such evaluation, or it had other cases.
    FileNotFoundError, BrokenFile
        A result is gone, or is not what was written.
    """
    rates: dict[str, Mapping[str, GroupRates]] = {}
    rows = []
    for slot, key in _recorded(plan, directory, folder, digest):
        if slot.name not in rates:
            rates[slot.name] = rates_of_case(folder.sums(key), slot.weighted, slot.vehicle, slot.groups)
        rows.append((slot.weighted, rates[slot.name]))
    return tuple(rows)


def recorded_sums(
    plan: CampaignPlan, directory: Path, folder: ResultFolder, digest: str
) -> Iterator[tuple[WeightedCase, PartSums]]:
    """Weighted cases of an evaluation that was made with their sums, of which each is read once.

    Parameters
    ----------
    plan, directory, folder, digest
        As `recorded_rates`, and it raises the same.
    """
    sums = cache(folder.sums)  # several weighted cases share a run
    for slot, key in _recorded(plan, directory, folder, digest):
        yield slot.weighted, sums(key)


def _recorded(
    plan: CampaignPlan, directory: Path, folder: ResultFolder, digest: str
) -> Iterator[tuple[_Slot, str]]:
    """Slots of an evaluation that did not fail, and the keys of their results."""
    content = _content_of(directory / EVALUATIONS / f"{digest}.json")
    found = {} if content is None else _last_runs(content)
    slots = [_slot(plan, weighted) for weighted in plan.of_steps.cases()]
    if any(slot.name not in found for slot in slots):
        raise ValueError(f"{directory}: holds no evaluation {digest!r} of the cases of its file")
    for slot in slots:
        if folder.failure(found[slot.name].key) is None:
            yield slot, found[slot.name].key


def _content_of(path: Path) -> dict[str, Any] | None:
    """What a record holds; None where there is none."""
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    return found


def _last_runs(content: Mapping[str, Any]) -> dict[str, LastRun]:
    """Results of a record by slot."""
    return {name: LastRun(one["key"], one["profiles"]) for name, one in content["cases"].items()}


def _slot(plan: CampaignPlan, weighted: WeightedCase) -> _Slot:
    """A weighted case with the groups of its wheels, and a name: of its case and its groups."""
    vehicle = weighted.case.described_vehicle()
    stratum = weighted.stratum
    returning = {running.name: running.returning for running in plan.collective.plan.running}
    groups = plan.grouping.of_run(vehicle, stratum, returning[stratum.running], weighted.mirrored)
    text = f"{stratum.key};{';'.join(groups[place] for place in sorted(groups))}"
    return _Slot(weighted, vehicle, groups, hashlib.sha256(text.encode()).hexdigest()[:16])
