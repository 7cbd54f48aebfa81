"""What a campaign has recorded, read once: wheels after every step, rates of the last evaluation."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from damage.evolution.history import WearHistory
from damage.evolution.profile_wear import ProfileWear
from damage.life.condition import WheelCondition
from damage.life.places import WheelPlaces
from damage.life.rates import LifeRates
from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.collective.weighted import WeightedCase
from hh_exudyn.campaign.life.campaign import Campaign
from hh_exudyn.campaign.life.evaluation import GroupRatesByCase
from hh_exudyn.campaign.life.rates import GroupRates
from hh_exudyn.campaign.life.steps import StepEnd
from hh_exudyn.campaign.life.stored_rows import rows_of_last_evaluation
from hh_exudyn.campaign.life.wheels import turned

WEAR = "wear"
"""Beside the names of the fatigue indices, the kind of damage that is a depth."""


@dataclass(frozen=True, eq=False)
class Recorded:
    """The steps of a campaign.

    Attributes
    ----------
    campaign
        Its folder.
    ends
        What was written at the end of every step; the first is the start.
    wheels
        By group, the wheels after every step, as they were before they were turned.

    Raises
    ------
    ValueError
        By `of`: a campaign without a step yet, or a file that is not what was written.
    """

    campaign: Campaign
    ends: tuple[StepEnd, ...]
    wheels: Mapping[str, tuple[WheelCondition, ...]]

    @classmethod
    def of(cls, campaign: Campaign) -> "Recorded":
        """All steps of a campaign.

        Parameters
        ----------
        campaign
            That has made one step at least.
        """
        ends = campaign.files.ends()
        if len(ends) < 2:
            raise ValueError(f"{campaign.directory}: the campaign has made no step yet; run it first")
        states = [campaign.files.conditions(number) for number in range(len(ends))]
        wheels = {group: tuple(state[group] for state in states) for group in campaign.groups}
        return cls(campaign, tuple(ends), wheels)

    @property
    def groups(self) -> tuple[str, ...]:
        """Names of the groups of wheels."""
        return tuple(self.wheels)

    @property
    def distance(self) -> float:
        """Rolled since the start [m]."""
        return self.ends[-1].distance

    def places(self, group: str) -> WheelPlaces:
        """Tread, root and flange of the wheels of a group, by their first profile."""
        return WheelPlaces.of(self.wheels[group][0].step.profile)

    @cached_property
    def lives(self) -> Mapping[str, tuple[tuple[WheelCondition, ...], ...]]:
        """By group, the wheels of every life: new or turned ones first, then after every step."""
        found = {}
        for group, states in self.wheels.items():
            lives = [[states[0]]]
            for number, state in enumerate(states[1:], 1):
                lives[-1].append(state)
                if number < len(states) - 1 and self._is_turned(group, number):
                    lives.append([self._after_turning(group, number)])
            found[group] = tuple(map(tuple, lives))
        return found

    def history(self, group: str) -> WearHistory:
        """The profiles of the last life: the one that goes on, or that has just ended."""
        return WearHistory(tuple(one.step for one in self.lives[group][-1]))

    def going_on(self, group: str) -> WheelCondition:
        """The wheels of a group that would run the next step: after their turning, where they were due."""
        number = len(self.ends) - 1
        turns = self._is_turned(group, number)
        return self._after_turning(group, number) if turns else self.wheels[group][number]

    def _is_turned(self, group: str, number: int) -> bool:
        return any(row["group"] == group for row in self.ends[number].turned)

    def _after_turning(self, group: str, number: int) -> WheelCondition:
        """Wheels after the turning at the end of a step; the step holds them as they were before it."""
        workshop, states = self.campaign.plan.workshop, self.wheels[group]
        if workshop is None:
            raise ValueError(f"{self.campaign.directory}: wheels were turned, and its file has no limits")
        return turned(states[number], states[number], states[0], workshop)[0]

    @cached_property
    def rows(self) -> GroupRatesByCase:
        """Rates of the weighted cases of the last evaluation.

        Raises ValueError, FileNotFoundError or BrokenFile where its record or a result is gone.
        """
        return rows_of_last_evaluation(self.campaign)

    def kinds(self) -> tuple[str, ...]:
        """Kinds of damage: `WEAR`, and the fatigue indices."""
        return (WEAR, *self.wheels[self.groups[0]][-1].cracks)

    def case_rates(self, group: str, kind: str) -> tuple[list[WeightedCase], FloatArray]:
        """Cases of the last evaluation, and what each adds to the rate of a kind of damage.

        Parameters
        ----------
        group
            Of wheels.
        kind
            One of `kinds`.

        Returns
        -------
        list of WeightedCase
            n cases that did not fail.
        (n, B) array
            On the bins of the wheels' cracks, weight times rate [m/m], or Miner's sum [1/m]; the sum over all
            cases is the rate of the collective, of which failed cases do not count.
        """
        y = self.wheels[group][-1].grid.lateral
        cases, whole = [case for case, _ in self.rows], sum(case.weight for case, _ in self.rows)
        values = [
            case.weight / whole * np.interp(y, rates[group].y, _of(rates[group], kind), left=0.0, right=0.0)
            for case, rates in self.rows
        ]
        return cases, np.array(values)

    def pressure(self, group: str) -> float:
        """Largest contact pressure of a group in the cases of the last evaluation [Pa]."""
        return max(rates[group].pressure for _, rates in self.rows)

    def life_rates(self, group: str) -> LifeRates:
        """Rates of the last evaluation, for a forecast that takes them as constant."""
        y = self.wheels[group][-1].grid.lateral
        rates = {kind: 1e3 * self.case_rates(group, kind)[1].sum(axis=0) for kind in self.kinds()}
        return LifeRates(ProfileWear(y, rates.pop(WEAR)), rates)


def _of(rates: GroupRates, kind: str) -> FloatArray:
    return rates.depth if kind == WEAR else rates.cracks[kind]
