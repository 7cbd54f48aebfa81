"""Groups of curve classes that share their cases: common geometry, kinds of track, and shares of the members.

A member is a curve class and hand of the line, as Table 1-3 of Hossein-Nia (2018) counts them. With members
at one mean geometry a case is run once and weighted for each of them; a right-hand member of a case that is
run left-handed gets its result mirrored.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from hh_exudyn.campaign.collective.axes import Step, half_widths, halved
from hh_exudyn.campaign.collective.plan import Haul, Plan, Running
from track.line.line import Line, TrackSection, load_sections
from track.rails import RailPair

STRAIGHT = "straight"
Member = tuple[str, str]
"""Curve class and hand."""


@dataclass(frozen=True)
class TrackKind:
    """What differs within a group but for geometry: rails, quality class, and the largest speed [m/s]."""

    pair: RailPair
    quality: str
    speed: float


@dataclass(frozen=True)
class Geometry:
    """Plan of a curve as it is run, or of straight track (radius infinity). Lengths in m."""

    radius: float
    cant: float
    transition: float
    gauge: float
    straight_gauge: float


@dataclass(frozen=True)
class Group:
    """Classes with common cases, for one vehicle.

    Attributes
    ----------
    name
        Its classes, and its hand where the other hand has cases of its own.
    hand
        In which its cases are run: "left", "right" or "straight".
    share
        Of the line [-].
    geometries
        With their shares of the group.
    kinds
        With the share of the line of every member that has it.
    inclination
        Of the rails, slope [-].
    """

    name: str
    hand: str
    share: float
    geometries: tuple[tuple[Geometry, float], ...]
    kinds: tuple[tuple[TrackKind, dict[Member, float]], ...]
    inclination: float

    @property
    def members(self) -> dict[Member, float]:
        """Share of the line of every member."""
        found: dict[Member, list[float]] = {}
        for _, members in self.kinds:
            for member, share in members.items():
                found.setdefault(member, []).append(share)
        return {member: math.fsum(shares) for member, shares in found.items()}

    def haul_share(self, haul: Haul) -> float:
        """Share of a haul in the group."""
        shares = (share * haul.share_in(name) for (name, _), share in self.members.items())
        return math.fsum(shares) / self.share

    def kind_shares(self) -> list[float]:
        """Share of each kind of track in the group; they sum to 1."""
        return [math.fsum(members.values()) / self.share for _, members in self.kinds]


def groups_of(plan: Plan, line: Line, running: Running) -> tuple[Group, ...]:
    """The groups of a line for a vehicle, in the order of the line's file.

    Parameters
    ----------
    plan : Plan
        Merged classes, hands, wear of the rails, halvings of the radius.
    line : Line
        Its classes.
    running : Running
        Vehicle and direction.

    Raises
    ------
    ValueError
        A class that the line does not have; what `track.line.line.load_sections` refuses.
    """
    sections = _worn(plan, line, running)
    names = list(dict.fromkeys(section.name for section, _ in sections))
    hauls = (name for haul in running.hauls for name, _ in haul.of_class)
    merged = (name for group in plan.merged_classes for name in group)
    for given in (*merged, *filter(None, plan.rail_wear), *hauls):
        if given not in names:
            raise ValueError(f"curve class {given!r} of {line.name}: allowed {', '.join(names)}")
    by_class = {name: group for group in plan.merged_classes for name in group}
    found: dict[tuple[tuple[str, ...], str], list[tuple[TrackSection, float]]] = {}
    for section, weight in sections:
        classes = by_class.get(section.name, (section.name,))
        if len(classes) > 1 and STRAIGHT in classes:
            raise ValueError(f"merged_classes: {classes} has straight track: allowed curve classes")
        hand = section.hand if plan.hands != "merged" or section.hand == STRAIGHT else "both"
        found.setdefault((classes, hand), []).append((section, weight))
    means = {key: _mean(line, members) for key, members in found.items()}
    return tuple(
        Group(
            name="+".join(classes) if hand in (STRAIGHT, "both") else f"{'+'.join(classes)} {hand}",
            hand=_run_hand(plan.hands, hand),
            share=math.fsum(weight for _, weight in members),
            geometries=_geometries(
                line, means[classes, hand], [mean for (_, other), mean in means.items() if other == hand],
                plan.halvings.get("radius", 0),
            ),
            kinds=_kinds(members),
            inclination=line.rail_inclination,
        )
        for (classes, hand), members in found.items()
    )  # fmt: skip


def _run_hand(hands: str, hand: str) -> str:
    """In which a group of the line's `hand` is run."""
    if hand == STRAIGHT:
        return STRAIGHT
    return "right" if (hands, hand) == ("both", "right") else "left"


def _worn(plan: Plan, line: Line, running: Running) -> list[tuple[TrackSection, float]]:
    """Sections of all wear states of the rails, with their shares of the line."""
    found = []
    for state in dict.fromkeys(state for states in plan.rail_wear.values() for state in states):
        for section in load_sections(line, running.line_vehicle, wear=state, returning=running.returning):
            share = plan.rail_wear.get(section.name, plan.rail_wear[""]).get(state, 0.0)
            if share > 0.0:
                found.append((section, share * section.weight))
    return found


def _kinds(
    sections: Iterable[tuple[TrackSection, float]],
) -> tuple[tuple[TrackKind, dict[Member, float]], ...]:
    """The kinds of track of a group; the countries' sections with equal rails are one."""
    found: dict[TrackKind, dict[Member, list[float]]] = {}
    for section, weight in sections:
        kind = TrackKind(section.pair, section.quality, section.speed)
        found.setdefault(kind, {}).setdefault((section.name, section.hand), []).append(weight)
    return tuple(
        (kind, {member: math.fsum(weights) for member, weights in members.items()})
        for kind, members in found.items()
    )


def _mean(line: Line, sections: list[tuple[TrackSection, float]]) -> Geometry:
    """Mean curvature, cant and gauge of sections."""
    whole = math.fsum(weight for _, weight in sections)
    curvature = math.fsum(weight / section.radius for section, weight in sections) / whole
    cant = math.fsum(weight * section.cant for section, weight in sections) / whole
    return Geometry(
        radius=1.0 / curvature if curvature else math.inf,
        cant=cant,
        transition=line.transition.length(cant) if curvature else 0.0,
        gauge=math.fsum(weight * section.gauge for section, weight in sections) / whole,
        straight_gauge=sections[0][0].straight_gauge,
    )


def _geometries(
    line: Line, mean: Geometry, others: list[Geometry], halvings: int
) -> tuple[tuple[Geometry, float], ...]:
    """The mean geometry of a group, or steps of its curvature; cant and gauge follow the curvature.

    The interval of curvature reaches half-way to the nearest group of the same hand, cant has the slope
    between these two.
    """
    if halvings == 0 or math.isinf(mean.radius) or len(others) < 2:
        return ((mean, 1.0),)
    curvature = 1.0 / mean.radius
    width = half_widths([curvature, *(1.0 / other.radius for other in others)])[0]
    near = min((other for other in others if other != mean), key=lambda o: abs(1.0 / o.radius - curvature))
    slope = (near.cant - mean.cant) / (1.0 / near.radius - curvature)
    found = []
    for step in halved((Step(curvature, width, 1.0),), halvings):
        radius = 1.0 / step.value
        cant = max(0.0, mean.cant + slope * (step.value - curvature))
        gauge = mean.gauge + line.gauge.at(radius) - line.gauge.at(mean.radius)
        geometry = Geometry(radius, cant, line.transition.length(cant), gauge, mean.straight_gauge)
        found.append((geometry, step.share))
    return tuple(found)
