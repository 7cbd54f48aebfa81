"""Decision on a wheel: which limits it has reached, and where within a step it reached them."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from damage.life.condition import WheelCondition
from damage.life.limits import WheelLimits
from damage.life.places import PLACES, WheelPlaces

WEAR, CRACKS, DIAMETER = "wear", "cracks", "diameter"  # causes


@dataclass(frozen=True)
class Inspection:
    """What an inspection of a wheel looks at for cracks.

    Cracks in the root and on the flange are known and reported; by default the tread alone decides: cracks of
    a flange hold no fluid and do not grow (Hossein-Nia 2018, section 3.3).

    Attributes
    ----------
    index
        Layer of cracks that decides.
    places
        Places of `damage.life.places` whose cracks decide.

    Raises
    ------
    ValueError
        Unknown places, or none.
    """

    index: str = "global"
    places: tuple[str, ...] = ("tread",)

    def __post_init__(self) -> None:
        if not self.places or not set(self.places) <= set(PLACES):
            raise ValueError(f"places = {self.places} of an inspection; allowed are {', '.join(PLACES)}")


class Reason(NamedTuple):
    """A limit that a wheel has reached."""

    measure: str
    value: float
    limit: float
    unit: str
    cause: str  # WEAR, CRACKS or DIAMETER


class Crossing(NamedTuple):
    """A limit that a wheel reaches, and the distance since new at which it does [m]."""

    reason: Reason
    distance: float


class _Criterion(NamedTuple):
    """A measure, its limit, and on which side of it a wheel runs on."""

    measure: str
    cause: str
    largest: bool  # whether the limit is the largest allowed value, else the least
    limit: Callable[[WheelLimits], float]


_CRITERIA = (
    _Criterion("flange_thickness", WEAR, False, lambda limits: limits.least_flange_thickness),
    _Criterion("flange_thickness", WEAR, True, lambda limits: limits.largest_flange_thickness),
    _Criterion("flange_height", WEAR, True, lambda limits: limits.largest_flange_height),
    _Criterion("flange_steepness", WEAR, False, lambda limits: limits.least_flange_steepness),
    _Criterion("hollow", WEAR, True, lambda limits: limits.largest_hollow),
    _Criterion("crack_depth", CRACKS, True, lambda limits: limits.largest_crack_depth),
    _Criterion("crack_length", CRACKS, True, lambda limits: limits.largest_crack_length),
    _Criterion("diameter", DIAMETER, False, lambda limits: limits.least_diameter),
)
MEASURES = tuple(dict.fromkeys(criterion.measure for criterion in _CRITERIA))
"""Measures that decide, all in metres."""

_TREAD_ALONE = Inspection()


def crack_depths(condition: WheelCondition, places: WheelPlaces) -> dict[str, dict[str, float]]:
    """Deepest crack by index, and by place and band of the wheel [m].

    Parameters
    ----------
    condition
        Of the wheels.
    places
        Of their target profile.
    """
    y = condition.grid.lateral
    return {index: places.largest(layer.depth, y) for index, layer in condition.cracks.items()}


def measured(
    condition: WheelCondition,
    limits: WheelLimits,
    places: WheelPlaces,
    inspection: Inspection = _TREAD_ALONE,
) -> dict[str, float]:
    """Values of the `MEASURES` of a wheel [m].

    Parameters
    ----------
    condition
        Of the wheels.
    limits
        For the length of a crack over its depth.
    places
        Of the target profile.
    inspection
        Which cracks decide.

    Raises
    ------
    ValueError
        The wheels have no such layer of cracks.
    """
    depths = crack_depths(condition, places)
    if inspection.index not in depths:
        raise ValueError(
            f"wheels {condition.group!r} have no cracks by {inspection.index!r}; they have "
            f"{', '.join(depths)}"
        )
    depth = max(depths[inspection.index][place] for place in inspection.places)
    wheel = condition.step.measures
    return {
        "flange_thickness": wheel.flange_thickness,
        "flange_height": wheel.flange_height,
        "flange_steepness": wheel.flange_steepness,
        "hollow": wheel.hollow,
        "crack_depth": depth,
        "crack_length": limits.length_over_depth * depth,
        "diameter": 2.0 * condition.step.radius,
    }


def due(
    condition: WheelCondition,
    limits: WheelLimits,
    places: WheelPlaces,
    inspection: Inspection = _TREAD_ALONE,
) -> tuple[Reason, ...]:
    """The limits that a wheel has reached; none: it runs on. Parameters as `measured`."""
    values = measured(condition, limits, places, inspection)
    return tuple(
        _reason(one, values[one.measure], limits)
        for one in _CRITERIA
        if _excess(one, values[one.measure], limits) >= 0.0
    )


def crossings(
    before: WheelCondition,
    after: WheelCondition,
    limits: WheelLimits,
    places: WheelPlaces,
    inspection: Inspection = _TREAD_ALONE,
) -> tuple[Crossing, ...]:
    """Where within a step limits were reached, the first one first.

    Measures are linear over the step. A limit that was reached before it is crossed at its start.

    Parameters
    ----------
    before, after
        The step's ends.
    limits, places, inspection
        As `measured`.
    """
    first, last = (measured(one, limits, places, inspection) for one in (before, after))
    start, end = before.step.distance, after.step.distance
    found = []
    for one in _CRITERIA:
        low, high = (_excess(one, values[one.measure], limits) for values in (first, last))
        if low >= 0.0:
            found.append(Crossing(_reason(one, first[one.measure], limits), start))
        elif high >= 0.0:
            reached = _reason(one, one.limit(limits), limits)
            found.append(Crossing(reached, start + (end - start) * low / (low - high)))
    return tuple(sorted(found, key=lambda crossing: crossing.distance))


def _excess(one: _Criterion, value: float, limits: WheelLimits) -> float:
    """How far a value is beyond its limit [m]; at zero the wheel is due."""
    return value - one.limit(limits) if one.largest else one.limit(limits) - value


def _reason(one: _Criterion, value: float, limits: WheelLimits) -> Reason:
    return Reason(one.measure, value, one.limit(limits), "m", one.cause)
