"""Forecast of lives from constant rates of wear and of crack damage: no new evaluation, some 0.1 s a life.

The rates are those of one condition, per kilometre; profile and cracks go on with them. The life goes by
steps that wear by no more than a small depth, each along the normals of the profile that it begins with. What
a forecast leaves out: worn profiles have other rates, so it is for short distances, for the studies of what
is assumed, and for a maintenance plan from measured rates.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from damage.bounds import check_above_zero
from damage.evolution.history import WearStep
from damage.evolution.measures import ConicityTrack, WheelMeasures
from damage.evolution.worn_profile import worn_profile
from damage.life.condition import WheelCondition, between
from damage.life.decision import Crossing, Inspection, crossings
from damage.life.limits import WheelLimits
from damage.life.places import WheelPlaces
from damage.life.rates import LifeRates
from damage.life.turning import Turning, TurningRule, turn
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.measures import (
    flange_angle,
    flange_height,
    flange_steepness,
    flange_thickness,
    tread_hollow,
)

LONGEST = 3e9  # m, of a forecast: a wheel that is not due by then has infinity
STEP_DEPTH = 0.1e-3  # m of wear a step, as Jendel's (2002) steps
_STEP_LIFE = (
    0.1  # of a life by cracks a step: where the deepest crack changes its place, depths are not linear
)

_TREAD_ALONE = Inspection()


class Forecast(NamedTuple):
    """The limits that wheels reach, the first one first, and the wheels when they reach it.

    Without a crossing the wheels are those at the end of the forecast.
    """

    crossings: tuple[Crossing, ...]
    condition: WheelCondition

    @property
    def distance(self) -> float:
        """Since new, at the first limit [m]; infinite where none is reached."""
        return self.crossings[0].distance if self.crossings else np.inf


def life_from_rates(
    condition: WheelCondition,
    rates: LifeRates,
    limits: WheelLimits,
    places: WheelPlaces,
    inspection: Inspection = _TREAD_ALONE,
    longest: float = LONGEST,
    all_limits: bool = False,
    step_depth: float = STEP_DEPTH,
) -> Forecast:
    """The distances at which wheels reach their limits.

    Parameters
    ----------
    condition
        The wheels now.
    rates
        Of wear and damage.
    limits, places, inspection
        As `damage.life.decision.measured`.
    longest
        Distance from now that is looked ahead [m], > 0.
    all_limits
        Go on beyond the first limit for the distance of every one, to the least diameter or as far as wear
        leaves a valid profile.
    step_depth
        Largest wear of a step [m], > 0.

    Raises
    ------
    ValueError
        A number out of its range, damage that does not fit the cracks, or wear that leaves no valid profile.
    """
    check_above_zero("longest", longest, "m", "a forecast")
    check_above_zero("step_depth", step_depth, "m", "a forecast")
    _check_rates(condition, rates)
    way = _step_way(condition, rates, longest, step_depth, places, inspection)
    found: dict[tuple[str, float], Crossing] = {}
    now, at_first, end = condition, None, condition.step.distance + longest
    while now.step.distance < end:
        try:
            after = _after(now, rates, min(way, end - now.step.distance))
        except ValueError:
            if not found:
                raise
            break
        for crossing in crossings(now, after, limits, places, inspection):
            found.setdefault((crossing.reason.measure, crossing.reason.limit), crossing)
        if found and at_first is None:
            at_first = between(now, after, min(one.distance for one in found.values()))
        now = after
        if (found and not all_limits) or ("diameter", limits.least_diameter) in found:
            break
    ordered = tuple(sorted(found.values(), key=lambda crossing: crossing.distance))
    return Forecast(ordered, now if at_first is None else at_first)


def first_turnings(
    condition: WheelCondition,
    samples: Iterable[LifeRates],
    limits: WheelLimits,
    places: WheelPlaces,
    inspection: Inspection = _TREAD_ALONE,
    longest: float = LONGEST,
) -> FloatArray:
    """(n,) distance since new of the first turning for samples of the rates (seasons, seeds, studies) [m].

    Infinite where no limit is reached; quantiles: `damage.life.life_table.distance_quantiles`.

    Parameters
    ----------
    condition
        The wheels now.
    samples
        n rates.
    limits, places, inspection, longest
        As `life_from_rates`.
    """
    return np.array(
        [life_from_rates(condition, one, limits, places, inspection, longest).distance for one in samples],
        dtype=np.float64,
    )


def whole_life(
    condition: WheelCondition,
    rates: LifeRates,
    limits: WheelLimits,
    rule: TurningRule,
    inspection: Inspection = _TREAD_ALONE,
    track: ConicityTrack | None = None,
) -> tuple[Turning, ...]:
    """Turnings of wheels until their diameter is used up, each life with the same rates.

    Parameters
    ----------
    condition
        The wheels now.
    rates
        Of wear and damage.
    limits
        Of the wheels.
    rule
        What a turning removes.
    inspection
        Which cracks decide.
    track
        For the equivalent conicity of turned wheels.

    Returns
    -------
    tuple
        The last one is the end of the wheels; none where no limit is reached.

    Raises
    ------
    ValueError
        As `life_from_rates` and `damage.life.turning.turn`.
    """
    turnings: list[Turning] = []
    now: WheelCondition | None = condition
    while now is not None:
        places = WheelPlaces.of(now.step.profile)
        forecast = life_from_rates(now, rates, limits, places, inspection)
        if not forecast.crossings:
            break
        reasons = tuple(one.reason for one in forecast.crossings if one.distance <= forecast.distance)
        turnings.append(turn(forecast.condition, limits, rule, reasons, track))
        now = turnings[-1].condition
        if now is not None and forecast.distance <= turnings[-1].distance - turnings[-1].since_turning:
            raise ValueError(
                f"wheels {now.group!r} are due by {reasons[0].measure} as soon as they are turned: "
                f"{1e3 * reasons[0].value:.4g} mm, limit {1e3 * reasons[0].limit:.4g} mm"
            )
    return tuple(turnings)


def _check_rates(condition: WheelCondition, rates: LifeRates) -> None:
    if set(rates.damage_per_km) != set(condition.cracks):
        raise ValueError(
            f"damage_per_km by {sorted(rates.damage_per_km)}; wheels {condition.group!r} have cracks by "
            f"{sorted(condition.cracks)}"
        )
    for index, values in rates.damage_per_km.items():
        if values.shape != (condition.grid.count,):
            raise ValueError(
                f"damage_per_km by {index!r} has shape {values.shape}, needed ({condition.grid.count},): one "
                "value per bin"
            )


def _step_way(
    condition: WheelCondition,
    rates: LifeRates,
    longest: float,
    step_depth: float,
    places: WheelPlaces,
    inspection: Inspection,
) -> float:
    """Length of the steps [m]: by wear, and by damage of no more than a tenth of a life."""
    deepest = float(rates.wear.depth_per_km.max(initial=0.0))
    damage = 0.0
    if inspection.index in rates.damage_per_km:  # else `measured` says so
        largest = places.largest(rates.damage_per_km[inspection.index], condition.grid.lateral)
        damage = max(largest[place] for place in inspection.places)
    ways = [longest]
    if deepest > 0.0:
        ways.append(1e3 * step_depth / deepest)
    if damage > 0.0:
        ways.append(1e3 * _STEP_LIFE / damage)
    return min(ways)


def _after(now: WheelCondition, rates: LifeRates, way: float) -> WheelCondition:
    """The wheels after a step [m] at these rates."""
    step = now.step
    worn, lost = worn_profile(step.profile, rates.wear, way, smoothing=0.0)
    radius = step.radius - lost
    depth = 1e-3 * way * float(rates.wear.depth_per_km.max(initial=0.0))
    after = WearStep(step.distance + way, worn, radius, depth, _measures(worn, radius))
    return now.after(after, rates.damage(way), rates.wear.at(now.grid.lateral) * (1e-3 * way))


def _measures(wheel: Profile, radius: float) -> WheelMeasures:
    """Measures but for the conicity, which takes longest and decides nothing here."""
    return WheelMeasures(
        2.0 * radius,
        flange_height(wheel),
        flange_thickness(wheel),
        flange_steepness(wheel),
        flange_angle(wheel),
        tread_hollow(wheel),
        np.nan,
    )
