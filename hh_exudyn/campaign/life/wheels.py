"""Wheels of a campaign over a step: new ones, cracks that grow and wear off, turning at a limit.

Wear is that of the accepted step; cracks grow, and layers wear off, at the mean of the rates with which the
step begins and those on its first guess of the end.

A limit that is reached within a step is reported at its distance there; the wheels run on to the end of the
step, and are turned then. Wheels at their end are replaced by new ones, and the campaign goes on.
"""

from collections.abc import Mapping

import numpy as np

from damage.evolution.history import WearStep
from damage.life.condition import WheelCondition
from damage.life.decision import crossings
from damage.life.life_table import life_table
from damage.life.limits import limit
from damage.life.places import WheelPlaces
from damage.life.turning import turn
from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.life.plan import Workshop
from hh_exudyn.campaign.life.rates import GroupRates
from hh_exudyn.contact.profile import Profile


def new_wheels(group: str, wheel: Profile, radius: float) -> WheelCondition:
    """New wheels of a group.

    Parameters
    ----------
    group
        Its name.
    wheel, radius
        Profile, and radius at the running circle [m].
    """
    return WheelCondition.new(group, wheel, radius, limit("cracks", "failure_depth"))


def after_step(before: WheelCondition, step: WearStep, first: GroupRates, last: GroupRates) -> WheelCondition:
    """Wheels after a step of wear.

    Parameters
    ----------
    before
        At its start.
    step
        At its end.
    first, last
        Rates at the start, and on the first guess of the end.
    """
    way, y = step.distance - before.step.distance, before.grid.lateral

    def of_step(one: FloatArray, two: FloatArray) -> FloatArray:
        rates = (np.interp(y, r.y, v, left=0.0, right=0.0) for r, v in ((first, one), (last, two)))
        return np.asarray(0.5 * way * sum(rates), dtype=np.float64)

    damage = {index: of_step(first.cracks[index], last.cracks[index]) for index in before.cracks}
    return before.after(step, damage, of_step(first.depth, last.depth))


def turned(
    before: WheelCondition, after: WheelCondition, start: WheelCondition, workshop: Workshop
) -> tuple[WheelCondition, dict[str, object] | None]:
    """The wheels that go on after a step, and the row of their turning; None where they run on.

    Parameters
    ----------
    before, after
        The step's ends.
    start
        The wheels at the start of the campaign: new ones.
    workshop
        Limits and rule.
    """
    places = WheelPlaces.of(start.step.profile)
    reached = crossings(before, after, workshop.limits, places, workshop.inspection)
    if not reached:
        return after, None
    found = turn(after, workshop.limits, workshop.rule, tuple(one.reason for one in reached))
    row = life_table([found]).to_pylist()[0] | {"due_km": 1e-3 * reached[0].distance}
    return found.condition or replaced_by_new(after, start), row


def replaced_by_new(old: WheelCondition, start: WheelCondition) -> WheelCondition:
    """New wheels at the distance of the campaign, in place of old ones.

    Parameters
    ----------
    old, start
        The wheels at their end, and those at the start of the campaign.
    """
    distance = old.step.distance
    step = WearStep(distance, start.step.profile, start.step.radius, 0.0, start.step.measures)
    return WheelCondition(start.group, step, start.cracks, turned_at=distance)


def worst_cracks(condition: WheelCondition, start: WheelCondition) -> Mapping[str, Mapping[str, float]]:
    """Largest Miner's sum by index, and by place and band of the wheel [-].

    Parameters
    ----------
    condition, start
        The wheels, and those at the start of the campaign, whose places count.
    """
    places, y = WheelPlaces.of(start.step.profile), condition.grid.lateral
    return {index: places.largest(layer.damage, y) for index, layer in condition.cracks.items()}
