"""The life of a campaign's wheels for other values of what is assumed: from the rates of its last evaluation.

Nothing is run: the rates of every case lie on disk. They are weighted anew, scaled, and carried on from new
wheels at constant rates (`damage.life.forecast`), some 0.1 s for a group of wheels. What that leaves out: the
rates are those of the wheels at the campaign's last step, and a wheel that wears otherwise would have others.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import NamedTuple

import numpy as np

from damage.life.condition import WheelCondition
from damage.life.forecast import LONGEST, life_from_rates
from damage.life.limits import WheelLimits
from damage.life.places import WheelPlaces
from damage.life.rates import LifeRates
from damage.rcf.wear_and_cracks import CrackLayer
from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.life.campaign import Campaign
from hh_exudyn.campaign.life.rates import GroupRates
from hh_exudyn.campaign.life.stored_rows import rows_of_last_evaluation
from hh_exudyn.campaign.uncertainty.assumptions import CRACK_ERROR, DRY, WEAR_ERROR, assumptions_of
from hh_exudyn.campaign.uncertainty.case_weights import CaseWeights
from hh_exudyn.campaign.uncertainty.film_wear import FilmWear
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.cleaning import arc_length

NO_CAUSE = "none"
NO_PROFILE = "no valid profile"
_TREAD = (-5e-3, 5e-3)  # about the running circle [m]
_FACE = 2.5e-3  # on either side of where Sd is measured [m]
_SPACING = 0.2e-3  # m, of the points of a profile: 0.4 um off a radius of 14 mm
_STEP_DEPTH = 0.25e-3  # m of wear a step of a forecast: lives differ by 2e-5 from those with 0.1 mm
_NEVER = WheelLimits(1e-3, 10.0, 1e-6, 1.0, 1.0, 1e-6, 1.0, 1e6, 1e6, 1.0)  # that no wheel reaches
_LENGTHS = {"cracks.largest_length": "largest_crack_length", "cracks.length_over_depth": "length_over_depth"}


@dataclass(frozen=True)
class Outcome:
    """What becomes of a group of wheels.

    Attributes
    ----------
    first_turning
        Distance from new wheels to their first turning [m]; infinite where no limit is reached, or where no
        wheel is turned in the campaign; NaN where wear leaves no valid profile before.
    cause
        Measure that is first at its limit; `NO_CAUSE` or `NO_PROFILE` without one.
    tread, flange
        Wear depth per metre rolled [m/m]: mean over 10 mm about the running circle, and over 5 mm of the
        flange face about the place where Sd is measured.
    flange_height, flange_thickness, flange_steepness
        Sh, Sd, qR after the distance of the campaign, without turning [m]; NaN where that much wear leaves no
        valid profile.
    """

    first_turning: float
    cause: str
    tread: float
    flange: float
    flange_height: float
    flange_thickness: float
    flange_steepness: float


class _Stored(NamedTuple):
    """Rates of a group in all cases; cases without it have zeros and do not count."""

    y: FloatArray
    depth: FloatArray  # (cases, B)
    cracks: Mapping[str, FloatArray]  # (cases, B)
    here: FloatArray  # (cases,) 1 where the group is in the case
    pressure: float


class FastLife:
    """From values of what is assumed to the life of every group of wheels.

    Parameters
    ----------
    campaign
        With a step at least.

    Raises
    ------
    ValueError, FileNotFoundError, BrokenFile
        As `hh_exudyn.campaign.life.stored_rows.rows_of_last_evaluation`.
    """

    def __init__(self, campaign: Campaign) -> None:
        rows = rows_of_last_evaluation(campaign)
        self.plan, self.groups = campaign.plan, campaign.groups
        self.distance = self.plan.collective.plan.distance
        cases = [weighted for weighted, _ in rows]
        by_case = [rates for _, rates in rows]
        self._stored = {group: _stored([rates.get(group) for rates in by_case]) for group in self.groups}
        last = campaign.files.conditions(campaign.files.count - 1)
        profiles = {group: last[group].step.profile for group in self.groups}
        self._weights = CaseWeights(self.plan.collective.plan, cases)
        self._films = FilmWear(self.plan, cases, profiles, {g: one.y for g, one in self._stored.items()})
        self.assumptions = assumptions_of(
            self.plan, campaign.directory, self._weights, self._films, self.groups
        )
        self._start = {group: _coarser(wheels) for group, wheels in campaign.start().items()}
        self._lives: dict[tuple[object, ...], tuple[float, str]] = {}
        self._ends: dict[tuple[object, ...], tuple[float, float, float]] = {}

    @property
    def told(self) -> float:
        """Share of the distance on which shares of seasons act [-]."""
        return self._weights.told

    def weights(self, values: Mapping[str, float]) -> FloatArray:
        """(cases,) weights of the stored cases for values by name; they sum to 1."""
        return self._weights.at(values)

    def rates(self, group: str, values: Mapping[str, float]) -> GroupRates:
        """Rates of a group of wheels.

        Parameters
        ----------
        group
            Of `groups`.
        values
            By name, of `assumptions`; what is not named is as it is.
        """
        one = self._stored[group]
        weights = self._weights.at(values) * one.here
        weights = weights / weights.sum()
        wear = values.get(DRY, 1.0) * values.get(f"{WEAR_ERROR}[{group}]", 1.0)
        growth = values.get(f"{CRACK_ERROR}[{group}]", 1.0)
        depth = wear * (weights @ (one.depth * self._films.factors(group, values)))
        cracks = {index: growth * (weights @ of_cases) for index, of_cases in one.cracks.items()}
        return GroupRates(one.y, depth, cracks, np.ones_like(one.y), one.pressure, float("nan"))

    def __call__(self, values: Mapping[str, float]) -> dict[str, Outcome]:
        """The outcome for every group of wheels. Arguments as `rates`."""
        return {group: self._outcome(group, values) for group in self.groups}

    def _outcome(self, group: str, values: Mapping[str, float]) -> Outcome:
        start, rates = self._start[group], self.rates(group, values)
        y = start.grid.lateral
        growth = {
            index: 1e3 * np.interp(y, rates.y, of_bins, left=0.0, right=0.0)
            for index, of_bins in rates.cracks.items()
        }
        life = LifeRates(rates.wear, growth)
        limits = {name.removeprefix("limits."): v for name, v in values.items() if name.startswith("limits.")}
        width = 1e-3 * limits["places.root_width"] if "places.root_width" in limits else None
        places = WheelPlaces.of(start.step.profile, width)
        first, cause = self._first_turning(group, life, limits, places)
        height, thickness, steepness = self._end(group, life)
        tread = (rates.y >= _TREAD[0]) & (rates.y <= _TREAD[1])
        face = np.abs(rates.y - places.flange) <= _FACE
        return Outcome(
            first, cause, float(rates.depth[tread].mean()), float(rates.depth[face].mean()),
            height, thickness, steepness,
        )  # fmt: skip

    def _first_turning(
        self, group: str, life: LifeRates, limits: Mapping[str, float], places: WheelPlaces
    ) -> tuple[float, str]:
        """Distance and cause of the first turning; of equal rates and limits computed once."""
        workshop = self.plan.workshop
        if workshop is None:
            return np.inf, NO_CAUSE
        key = (group, _digest(life), *sorted(limits.items()))
        if key not in self._lives:
            wheels, own = self._start[group], workshop.limits
            usual = next(iter(wheels.cracks.values())).failure_depth
            depth = 1e-3 * limits.get("cracks.failure_depth", 1e3 * usual)
            changed = _changed(own, limits, depth / usual)
            try:
                found = life_from_rates(
                    _with_cracks(wheels, depth), life, changed, places,
                    workshop.inspection, LONGEST, step_depth=_STEP_DEPTH,
                )  # fmt: skip
            except ValueError:  # so much wear leaves no valid profile
                self._lives[key] = np.nan, NO_PROFILE
            else:
                cause = found.crossings[0].reason.measure if found.crossings else NO_CAUSE
                self._lives[key] = found.distance, cause
        return self._lives[key]

    def _end(self, group: str, life: LifeRates) -> tuple[float, float, float]:
        """Sh, Sd, qR after the distance of the campaign; of equal wear computed once."""
        key = group, life.wear.depth_per_km.tobytes()
        if key not in self._ends:
            wheels = self._start[group]
            try:
                end = life_from_rates(
                    wheels, life.scaled(damage=0.0), _NEVER, WheelPlaces.of(wheels.step.profile),
                    longest=self.distance, step_depth=_STEP_DEPTH,
                ).condition.step.measures  # fmt: skip
                self._ends[key] = end.flange_height, end.flange_thickness, end.flange_steepness
            except ValueError:  # so much wear leaves no valid profile
                self._ends[key] = (np.nan, np.nan, np.nan)
        return self._ends[key]


def _coarser(wheels: WheelCondition) -> WheelCondition:
    """Wheels with points at equal distances: much nearer than bins of wear they soon fold over each other."""
    profile = wheels.step.profile
    arc = arc_length(profile.y, profile.z)
    places = np.linspace(0.0, arc[-1], 1 + int(np.ceil(arc[-1] / _SPACING)))
    y, z = (np.interp(places, arc, values) for values in (profile.y, profile.z))
    return replace(wheels, step=replace(wheels.step, profile=Profile(profile.name, "wheel", y, z)))


def _stored(rates: list[GroupRates | None]) -> _Stored:
    """Rates of all cases in arrays."""
    known = [one for one in rates if one is not None]
    if any(not np.array_equal(one.y, known[0].y) for one in known):
        raise ValueError("rates of one group of wheels lie on the bins of different profiles")
    zero = np.zeros_like(known[0].y)
    return _Stored(
        known[0].y,
        np.array([zero if one is None else one.depth for one in rates]),
        {
            index: np.array([zero if one is None else one.cracks[index] for one in rates])
            for index in known[0].cracks
        },
        np.array([float(one is not None) for one in rates]),
        max(one.pressure for one in known),
    )


def _with_cracks(wheels: WheelCondition, failure_depth: float) -> WheelCondition:
    """New wheels whose cracks fail at another depth [m]."""
    return replace(wheels, cracks=dict.fromkeys(wheels.cracks, CrackLayer.new(wheels.grid, failure_depth)))


def _changed(limits: WheelLimits, values: Mapping[str, float], deeper: float) -> WheelLimits:
    """Limits with changed values [mm or -]; the largest depth of cracks goes with that at failure."""
    names = {field.name for field in fields(WheelLimits)}
    changes = {"largest_crack_depth": limits.largest_crack_depth * deeper}
    for name, value in values.items():
        field = _LENGTHS.get(name, name.partition(".")[2])
        if field in names:
            changes[field] = value if field == "length_over_depth" else 1e-3 * value
    return replace(limits, **changes)


def _digest(life: LifeRates) -> bytes:
    """What tells rates apart."""
    return b"".join([life.wear.depth_per_km.tobytes(), *(v.tobytes() for v in life.damage_per_km.values())])
