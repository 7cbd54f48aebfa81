"""Turning of a wheel: to its target profile and below its cracks, down to the least diameter.

The lathe cuts the smallest radius (`damage.evolution.reprofiling`) by which the target profile lies in the
metal that is left, and by which every crack that must go is gone. A crack of depth h normal to the surface,
at a place of slope g, is gone when the lathe takes (h + below)/cos g of height there:

    cut = max( max over y (z_worn - z_target),  max over y ((h + below)/cos g + z_worn - z_target) )

What remains of other cracks (in places that are not turned out, or of a share of their depth) goes on as a
crack of the depth that is left. Wear and damage are counted anew.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from damage.bounds import check_not_below_zero
from damage.evolution.history import WearStep
from damage.evolution.measures import ConicityTrack, measure
from damage.evolution.reprofiling import Reprofiling, reprofile
from damage.life.condition import WheelCondition
from damage.life.decision import CRACKS, WEAR, Reason
from damage.life.limits import WheelLimits, limit
from damage.life.places import PLACES, WheelPlaces
from damage.rcf.wear_and_cracks import CrackLayer
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.measures import flange_thickness


@dataclass(frozen=True)
class TurningRule:
    """What a turning removes.

    Attributes
    ----------
    targets
        Profiles that may be turned; the one with the smallest cut is.
    index
        Layer of cracks that is turned out.
    places
        Places of `damage.life.places` whose cracks are turned out; those of the others are shortened.
    crack_share
        Share of the depth of a crack that is removed [-], 0 to 1: 1 removes all, less leaves the rest.
    below_crack
        Depth that is cut below a crack, to sound metal [m], where all of it is removed; None takes that of
        ``damage/data/limits.toml`` (assumed).
    least_crack
        Cracks of no more than this depth stay: they are not seen [m].
    least_cut
        Radius that is turned off in any case [m].
    least_flange_thickness
        Targets with a thinner flange are left out [m].

    Raises
    ------
    ValueError
        No targets, unknown places, or a number out of its range.
    """

    targets: Sequence[Profile]
    index: str = "global"
    places: tuple[str, ...] = ("tread", "root")
    crack_share: float = 1.0
    below_crack: float | None = None
    least_crack: float = 0.1e-3
    least_cut: float = 0.0
    least_flange_thickness: float = 0.0

    def __post_init__(self) -> None:
        if not self.targets:
            raise ValueError("a turning needs a target profile at least")
        if not set(self.places) <= set(PLACES):
            raise ValueError(f"places = {self.places} of a turning; allowed are {', '.join(PLACES)}")
        if not 0.0 <= self.crack_share <= 1.0:
            raise ValueError(f"crack_share = {self.crack_share} of a turning, allowed 0 .. 1")
        if self.below_crack is None:
            object.__setattr__(self, "below_crack", limit("turning", "below_crack"))
        for name in ("below_crack", "least_crack", "least_cut", "least_flange_thickness"):
            check_not_below_zero(name, getattr(self, name), "m", "a turning")


@dataclass(frozen=True)
class Turning:
    """A turning, or the end of a wheel.

    Attributes
    ----------
    group
        Name of the wheels.
    life
        Number of the life that ends, from 1.
    distance, since_turning
        Since new, and since the last turning [m].
    reasons
        Limits that were reached.
    cut
        Radius that the turning takes at the running circle [m]; of a wheel at its end, would have taken.
    cut_for_profile
        What of it restores the profile; the rest is for cracks [m].
    worn_diameter
        Diameter before the turning [m].
    diameter
        After it [m]; that before it for a wheel at its end.
    target
        Name of the profile that was turned.
    condition
        The wheels after it; None at their end: the cut would go below the least diameter.
    """

    group: str
    life: int
    distance: float
    since_turning: float
    reasons: tuple[Reason, ...]
    cut: float
    cut_for_profile: float
    worn_diameter: float
    diameter: float
    target: str
    condition: WheelCondition | None

    @property
    def cause(self) -> str:
        """The cause of the first of the reasons; empty without one (turned before it was due)."""
        return self.reasons[0].cause if self.reasons else ""

    @property
    def cut_cause(self) -> str:
        """What the larger part of the cut is for: "wear" or "cracks"."""
        return CRACKS if self.cut - self.cut_for_profile > 0.5 * self.cut else WEAR


def turn(
    condition: WheelCondition,
    limits: WheelLimits,
    rule: TurningRule,
    reasons: tuple[Reason, ...] = (),
    track: ConicityTrack | None = None,
) -> Turning:
    """Turn wheels, or say that they are at their end.

    Parameters
    ----------
    condition
        The wheels before.
    limits
        For the least diameter.
    rule
        What is removed.
    reasons
        Why they are turned: the first of `damage.life.decision.crossings`, or all that are `due`.
    track
        For the equivalent conicity; None takes the default.

    Raises
    ------
    ValueError
        No target with such a flange, one that the worn wheel does not cover, or no such layer of cracks.
    """
    if rule.index not in condition.cracks:
        raise ValueError(
            f"wheels {condition.group!r} have no cracks by {rule.index!r}; they have "
            f"{', '.join(condition.cracks)}"
        )
    worn, radius = condition.step.profile, condition.step.radius
    whole, restored = _smallest(condition, rule)
    worn_diameter, diameter = 2.0 * radius, 2.0 * whole.radius
    next_condition = None
    if diameter >= limits.least_diameter:
        turned = _turned_depth(worn, whole, condition.grid.lateral)
        cracks = {index: _shortened(layer, turned) for index, layer in condition.cracks.items()}
        step = WearStep(
            condition.step.distance,
            whole.profile,
            whole.radius,
            0.0,
            measure(whole.profile, whole.radius, track or ConicityTrack()),
        )
        next_condition = replace(
            condition,
            step=step,
            cracks=cracks,
            turned_at=step.distance,
            turnings=condition.turnings + 1,
        )
    return Turning(
        condition.group,
        condition.turnings + 1,
        condition.step.distance,
        condition.since_turning,
        reasons,
        whole.cut,
        restored.cut,
        worn_diameter,
        worn_diameter if next_condition is None else diameter,
        whole.profile.name,
        next_condition,
    )


def _smallest(condition: WheelCondition, rule: TurningRule) -> tuple[Reprofiling, Reprofiling]:
    """The cut below profile and cracks of the cheapest target, and what its profile alone needs."""
    worn, radius, thick = condition.step.profile, condition.step.radius, rule.least_flange_thickness
    # of no target with such a flange `reprofile` says so
    fit = [one for one in rule.targets if flange_thickness(one) >= thick] or list(rule.targets)
    found = []
    for target in fit:
        restored = reprofile(worn, radius, target, thick, rule.least_cut)
        below = max(_below_cracks(condition, rule, target), rule.least_cut)
        found.append((reprofile(worn, radius, target, thick, below), restored))
    return min(found, key=lambda pair: pair[0].cut)


def _below_cracks(condition: WheelCondition, rule: TurningRule, target: Profile) -> float:
    """Cut at the running circle that removes the cracks of the rule's places [m]."""
    layer, worn = condition.cracks[rule.index], condition.step.profile
    y, places = layer.grid.lateral, WheelPlaces.of(target)
    seen = np.any([places.within(place, y) for place in rule.places], axis=0) if rule.places else False
    must = seen & (layer.depth > rule.least_crack) & (y > worn.y[0]) & (y < _tip(target))
    if not must.any() or rule.crack_share == 0.0:
        return 0.0
    depth = rule.crack_share * layer.depth[must]
    if rule.crack_share == 1.0 and rule.below_crack is not None:
        depth = depth + rule.below_crack
    at = y[must]
    above = np.interp(at, worn.y, worn.z) - np.interp(at, target.y, target.z)  # of two lines with z(0) = 0
    return max(float((depth / _cosine(worn, at) + above).max()), 0.0)


def _turned_depth(worn: Profile, turned: Reprofiling, y: FloatArray) -> FloatArray:
    """(B,) depth that a cut removes, normal to the worn surface [m]."""
    target = turned.profile
    height = np.interp(y, target.y, target.z) + turned.cut - np.interp(y, worn.y, worn.z)
    depth = np.maximum(height, 0.0) * _cosine(worn, y)
    return np.asarray(np.where((y > worn.y[0]) & (y < _tip(target)), depth, 0.0), dtype=np.float64)


def _shortened(layer: CrackLayer, turned: FloatArray) -> CrackLayer:
    """The cracks after a depth was turned off; wear and damage count anew."""
    left = np.maximum(layer.damage - turned / layer.failure_depth, 0.0)
    return replace(layer, damage=left, damage_without_wear=left, worn=np.zeros_like(left))


def _cosine(wheel: Profile, y: FloatArray) -> FloatArray:
    """(n,) cosine of the slope of a profile."""
    slope = np.interp(y, wheel.y, np.gradient(wheel.z, wheel.y))
    return np.asarray(1.0 / np.hypot(1.0, slope), dtype=np.float64)


def _tip(wheel: Profile) -> float:
    """Lateral coordinate of the flange tip [m]: what is beyond it is the flange back."""
    return float(wheel.y[int(np.argmin(wheel.z))])


def turnings_left(radius: float, limits: WheelLimits, cut: float) -> int:
    """How many turnings of one cut the diameter allows.

    Parameters
    ----------
    radius
        At the running circle [m].
    limits
        For the least diameter.
    cut
        Radius of each, wear between them included [m], > 0.
    """
    return max(math.floor((2.0 * radius - limits.least_diameter) / (2.0 * cut) + 1e-9), 0)
