"""The load collective of a plan: its weighted strata and cases, tables, and what in it is assumed."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple, Self

import pyarrow as pa

from hh_exudyn.campaign.collective.allocation import allotted
from hh_exudyn.campaign.collective.axes import (
    Step,
    gauge_deviations,
    halved_seasons,
    irregularity_scale,
    quality_places,
    spectrum_deviations,
)
from hh_exudyn.campaign.collective.case_of_stratum import Setting, case_of
from hh_exudyn.campaign.collective.design import Cell, full_product, overlay, uniform
from hh_exudyn.campaign.collective.groups import STRAIGHT, Geometry, Group, Member, TrackKind, groups_of
from hh_exudyn.campaign.collective.listing import strata_table
from hh_exudyn.campaign.collective.plan import HALVED, SAMPLED, Haul, Plan, Running, Season
from hh_exudyn.campaign.collective.plan_file import read_plan
from hh_exudyn.campaign.collective.strata import Stratum
from hh_exudyn.campaign.collective.stratified import Draws, stratified
from hh_exudyn.campaign.collective.track import evaluated_parts, track_length
from hh_exudyn.campaign.collective.weighted import WeightedCase, WeightedStratum
from hh_exudyn.case import Case
from hh_exudyn.case.track import TrackCase
from hh_exudyn.sourced import Parameter
from track.line.line import read_line
from track.line.line_file import line_names
from track.line.line_numbers import line_numbers

_SEASONS = 3  # place among the axes: what friction and films do comes before all else within a group
_SHORTEST = TrackCase.model_fields["irregularity_shortest_m"].default  # m


class _Axes(NamedTuple):
    """Levels of the axes within a group, and the shares of each."""

    geometries: tuple[Geometry, ...]
    kinds: tuple[tuple[TrackKind, Step, dict[Member, float]], ...]  # with the place in the quality class
    gauges: tuple[Step, ...]
    seasons: tuple[Season, ...]
    speeds: tuple[tuple[float, float], ...]
    hauls: tuple[Haul, ...]
    shares: list[list[float]]


@dataclass(frozen=True)
class Collective:
    """Weighted strata of a line, from a plan (`hh_exudyn.campaign.collective.plan_file.read_plan`)."""

    plan: Plan

    @classmethod
    def read(cls, path: str | Path) -> Self:
        """The collective of a file. Raises ValueError as `read_plan`."""
        return cls(read_plan(path))

    @cached_property
    def strata(self) -> tuple[WeightedStratum, ...]:
        """All strata with their weights, which sum to 1.

        Raises
        ------
        ValueError
            An unknown line, curve class or wear state, a vehicle without speed on the line.
        """
        return self._sampled({})

    def unit(self, stratum: Stratum) -> str:
        """What is sampled independently of all else: the cell; of other designs the whole group of a running.

        Parameters
        ----------
        stratum : Stratum
            Of this collective.
        """
        return stratum.cell if self.plan.design == "full" else f"{stratum.running};{stratum.group}"

    def cases(self, strata: Sequence[WeightedStratum] | None = None) -> tuple[WeightedCase, ...]:
        """Strata with their cases; strata of equal key share one `Case`. Making one takes some 40 ms.

        Parameters
        ----------
        strata : sequence of WeightedStratum or None
            Some of `strata`; None: all.

        Raises
        ------
        CaseError
            A case is not allowed, such as a gauge without flange clearance; the message names the stratum.
        """
        made: dict[str, Case] = {}
        found = []
        for item in self.strata if strata is None else strata:
            key = item.stratum.key
            if key not in made:
                made[key] = case_of(self.plan, item.stratum, item.setting)
            found.append(
                WeightedCase(
                    made[key], item.weight, item.stratum, item.mirrored, item.setting.season.films,
                    evaluated_parts(item.stratum, self.plan.lengths),
                )
            )  # fmt: skip
        return tuple(found)

    def table(self) -> pa.Table:
        """The strata as a table (`hh_exudyn.campaign.collective.listing.strata_table`).

        Its metadata have under "evaluation" what one evaluation takes, in words (`Collective.evaluation`).
        """
        found = strata_table(self.strata, self.plan.lengths)
        return found.replace_schema_metadata({"evaluation": self.evaluation})

    @property
    def evaluation(self) -> str:
        """What one evaluation takes (one replicate), and all replicates of the file, in words."""
        one = self.replicate()
        runs = {name: runs_of(s for s in one if s.stratum.running == name) for name in self._names}
        return (
            f"one evaluation: {runs_of(one)} runs ({', '.join(f'{name} {n}' for name, n in runs.items())}), "
            f"{1e-3 * self._track(one):.1f} km of track; all {self.plan.replicates} replicates: {self.runs} "
            f"runs, {1e-3 * self.track_to_run:.1f} km"
        )

    @property
    def _names(self) -> list[str]:
        return [running.name for running in self.plan.running]

    @property
    def runs(self) -> int:
        """Number of different cases of all replicates: what is to be run."""
        return runs_of(self.strata)

    @property
    def track_to_run(self) -> float:
        """Length of the tracks of all different cases [m]."""
        return self._track(self.strata)

    def _track(self, strata: Iterable[WeightedStratum]) -> float:
        """Length of the tracks of different cases [m]."""
        tracks = {item.stratum.key: item.stratum for item in strata}
        return math.fsum(track_length(stratum, self.plan.lengths) for stratum in tracks.values())

    def share(self, **labels: Any) -> float:
        """Sum of the weights of strata with given labels, ``share(curve_class="<350", hand="left")``.

        Parameters
        ----------
        labels
            Names and values of attributes of `Stratum`.
        """
        return math.fsum(
            item.weight
            for item in self.strata
            if all(getattr(item.stratum, name) == value for name, value in labels.items())
        )

    def replicate(
        self, number: int = 1, others: Mapping[str, int] | None = None
    ) -> tuple[WeightedStratum, ...]:
        """The strata of one replicate with the whole weight: the cases of one evaluation of a loop.

        Their irregularity and points are the same at every call (common random numbers). Their damage differs
        from that of all replicates by the sampling error of one: a loop that takes another replicate in every
        step averages over these errors, one that takes the same keeps it (`nearest` chooses a good one).

        Parameters
        ----------
        number : int
            From 1; also beyond the replicates of the file.
        others : mapping of str to int or None
            Another number for some units (`unit`).

        Raises
        ------
        ValueError
            A number below 1.
        """
        wanted = dict(others or {})
        numbers = sorted({number, *wanted.values()})
        if numbers[0] < 1:
            raise ValueError(f"replicate {numbers[0]}: allowed from 1")
        return tuple(
            item
            for running, groups in self._groups
            for group in groups
            for one in numbers
            for item in self._of_group(running, group, one)
            if item.weight > 0.0 and one == wanted.get(self.unit(item.stratum), number)
        )

    def resampled(self, counts: Mapping[str, int]) -> tuple[WeightedStratum, ...]:
        """The strata with another number of replicates for some units, each unit with its whole weight.

        Replicates that were there before keep key, seed and case, so that only new ones are to be run.

        Parameters
        ----------
        counts : mapping of str to int
            Replicates by `unit`, 1 or more; other units have those of the file.

        Raises
        ------
        ValueError
            An unknown unit, or a count below 1.
        """
        units = {self.unit(item.stratum) for item in self.strata}
        for unit, count in counts.items():
            if count < 1 or unit not in units:
                raise ValueError(f"{count} replicates of unit {unit!r}: allowed 1 or more of a known unit")
        return self._sampled(counts)

    def refined(self, axis: str) -> "Collective":
        """The collective with the steps of an axis halved, for its discretisation error.

        Parameters
        ----------
        axis : str
            One of `HALVED`.

        Raises
        ------
        ValueError
            No such axis.
        """
        if axis not in HALVED:
            raise ValueError(f"axis is {axis!r}: allowed {', '.join(HALVED)}")
        halvings = self.plan.halvings | {axis: self.plan.halvings.get(axis, 0) + 1}
        return Collective(replace(self.plan, halvings=halvings))

    def assumed(self) -> tuple[Parameter, ...]:
        """The assumed numbers of the file and of its line, with ranges where the file gives them."""
        named = self.plan.line in line_names()
        own = (*self.plan.numbers, *(line_numbers(self.plan.line) if named else ()))
        return tuple(number for number in own if number.kind == "assumed")

    def left_out(self) -> tuple[str, ...]:
        """What the collective leaves out, in words, for the report of a result."""
        found = ["straight track beside curves, as it has cases of its own; turnouts and stations"]
        for running in self.plan.running:
            if all(haul.draft is None and haul.trailing_wagons is None for haul in running.hauls):
                found.append(f"{running.name}: forces of the train")
            if all(haul.shoe_force is None and haul.trailing_wagons is None for haul in running.hauls):
                found.append(f"{running.name}: braking")
        return tuple(found)

    def _sampled(self, counts: Mapping[str, int]) -> tuple[WeightedStratum, ...]:
        """The strata with given numbers of replicates by unit."""
        usual = self.plan.replicates
        found = []
        for running, groups in self._groups:
            for group in groups:
                for replicate in range(1, max((usual, *counts.values())) + 1):
                    for item in self._of_group(running, group, replicate):
                        count = counts.get(self.unit(item.stratum), usual) if counts else usual
                        if replicate <= count and item.weight > 0.0:
                            found.append(replace(item, weight=item.weight / count))
        return tuple(found)

    def _axes(self, running: Running, group: Group) -> _Axes:
        """The axes of a group, and their shares in the order of the fields."""
        plan = self.plan
        gauges = gauge_deviations(plan.gauge, plan.halvings.get("gauge", 0))
        places = quality_places(plan.halvings.get("quality", 0))
        seasons = halved_seasons(plan.seasons, plan.halvings.get("friction", 0))
        shares = [
            [share for _, share in group.geometries],
            [share * place.share for share in group.kind_shares() for place in places],
            [gauge.share for gauge in gauges],
            [season.share for season in seasons],
            [share for _, share in running.speeds],
            [group.haul_share(haul) for haul in running.hauls],
        ]
        geometries = tuple(geometry for geometry, _ in group.geometries)
        kinds = tuple((kind, place, members) for kind, members in group.kinds for place in places)
        return _Axes(geometries, kinds, gauges, seasons, running.speeds, running.hauls, shares)

    def _of_group(self, running: Running, group: Group, replicate: int) -> tuple[WeightedStratum, ...]:
        """The strata of one sample of a group, made once."""
        key = running.name, group.name, replicate
        if key not in self._samples:
            self._samples[key] = tuple(self._sample(running, group, replicate))
        return self._samples[key]

    @cached_property
    def _samples(self) -> dict[tuple[str, str, int], tuple[WeightedStratum, ...]]:
        """By running, group and replicate."""
        return {}

    def _sample(self, running: Running, group: Group, replicate: int) -> Iterator[WeightedStratum]:
        """The strata of one sample of a group."""
        axes = self._axes(running, group)
        for levels, share in self._cells(running, group, axes, replicate):
            # few points do not have every kind of track: then each stands for all members of the group
            members = group.members if self.plan.design == SAMPLED else axes.kinds[levels[1]][2]
            of_kind = math.fsum(members.values())
            for member, of_member in members.items():
                weight = running.share * group.share * share * of_member / of_kind
                stratum, setting = self._stratum(running, group, axes, levels, member, replicate)
                if group.hand == STRAIGHT:  # as likely one way as the other
                    yield WeightedStratum(stratum, 0.5 * weight, False, setting)
                    yield WeightedStratum(stratum, 0.5 * weight, True, setting)
                else:
                    mirrored = (group.hand, member[1]) == ("left", "right")
                    yield WeightedStratum(stratum, weight, mirrored, setting)

    def _cells(self, running: Running, group: Group, axes: _Axes, replicate: int) -> Iterable[Cell]:
        """The cells of one sample of a group, with their shares of it."""
        if self.plan.design == "full":
            return full_product(axes.shares)
        name, count = f"{running.name};{group.name}", len(axes.shares)
        if self.plan.design == "overlay":
            return overlay(axes.shares, uniform(f"{name};{replicate}", count))
        names = [f"{running.name};{other.name}" for other in dict(self._groups)[running]]
        most = max(self._points[other] for other in names)
        text = f"{running.name};{replicate}"
        draws = Draws.of_group(text, count, most, names.index(name), len(names))
        severity = [season.severity for season in axes.seasons]
        return stratified(axes.shares, _SEASONS, severity, self._points[name], draws)

    @cached_property
    def _groups(self) -> tuple[tuple[Running, tuple[Group, ...]], ...]:
        """The groups of every running."""
        line = read_line(self.plan.line)
        return tuple((running, groups_of(self.plan, line, running)) for running in self.plan.running)

    @cached_property
    def _points(self) -> dict[str, int]:
        """Runs of each unit in one replicate of the sampled design; ValueError for too few."""
        units = {
            f"{running.name};{group.name}": (
                running.share * running.described.mass,
                1.0 / group.geometries[0][0].radius,
            )
            for running, groups in self._groups
            for group in groups
        }
        runs = self.plan.runs or 0
        if runs < len(units):
            raise ValueError(
                f"{self.plan.name}: design.runs = {runs}: allowed {len(units)} or more, one for each group "
                f"of curve classes of each running: {', '.join(units)}"
            )
        return dict(zip(units, allotted(runs, list(units.values())), strict=True))

    def _stratum(
        self, running: Running, group: Group, axes: _Axes, levels: tuple[int, ...], member: Member,
        replicate: int,
    ) -> tuple[Stratum, Setting]:  # fmt: skip
        """Labels of a cell for one member of the group, and what its case needs."""
        geometry, (kind, place, _) = axes.geometries[levels[0]], axes.kinds[levels[1]]
        season, haul = axes.seasons[levels[3]], axes.hauls[levels[5]]
        shift = self.plan.gauge.shift
        gauge = shift + axes.gauges[levels[2]].value
        shortest = self.plan.base.get("track", {}).get("irregularity_shortest_m", _SHORTEST)
        scale = irregularity_scale(self.plan.quality, kind.quality, place.value, shortest)
        level, alignment = spectrum_deviations(self.plan.quality.spectrum, shortest)
        stratum = Stratum(
            running=running.name,
            vehicle=running.vehicle,
            group=group.name,
            run_hand=group.hand,
            curve_class=member[0],
            hand=member[1],
            radius_m=round(geometry.radius, 6),
            cant_mm=round(1e3 * geometry.cant, 6),
            transition_m=round(geometry.transition, 6),
            gauge_mm=round(1e3 * (geometry.gauge + gauge), 6),
            straight_gauge_mm=round(1e3 * (geometry.straight_gauge + gauge), 6),
            rail_high=kind.pair.high,
            rail_low=kind.pair.low,
            rail_wear=kind.pair.wear,
            quality=kind.quality,
            level_deviation_mm=1e3 * scale * level,
            alignment_deviation_mm=1e3 * scale * alignment,
            season=season.name,
            friction_tread=season.friction.tread,
            friction_gauge_corner=season.friction.gauge_corner,
            friction_flange=season.friction.flange,
            speed_km_h=round(3.6 * kind.speed * axes.speeds[levels[4]][0], 6),
            haul=haul.name,
            gradient_per_mille=round(1e3 * haul.gradient, 6),
            replicate=replicate,
            gauge_shift_mm=round(1e3 * shift, 6),
        )
        return stratum, Setting(season, haul, scale, group.inclination)


def runs_of(strata: Iterable[WeightedStratum]) -> int:
    """Number of different cases among strata."""
    return len({item.stratum.key for item in strata})
