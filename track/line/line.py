"""A line as a set of representative track sections with weights, for load collectives.

The file of a line (TOML, `read_line`) holds statistics: curve classes with their shares, radii and cants by
hand, countries, rails, gauge, quality, speeds. `load_sections` combines them to `TrackSection` values, each
with its weight, its share of the line:

    >>> for section in load_sections(read_line("malmbanan"), "iore_wagon_loaded"):
    ...     run(section.alignment(), section.rails, section.speed, section.quality, section.weight)

Within a curve class quality, rails and country are taken as independent: their joint distribution is not
known.
"""

import math
from dataclasses import dataclass

from hh_exudyn.conventions import GRAVITY, RAIL_TOP_DISTANCE
from track.course.alignment import Alignment, Curve, Straight, Transition, cant_deficiency
from track.irregularity.quality import CLASSES
from track.line.line_data import Line, SpeedRule, TrackClass
from track.line.line_file import line_names, read_line
from track.rails import NEW, RailPair, Rails, rail_pairs

__all__ = ["Line", "TrackClass", "TrackSection", "line_names", "load_sections", "read_line"]

_MIRRORED = {"left": "right", "right": "left", "straight": "straight"}


@dataclass(frozen=True)
class TrackSection:
    """One kind of track of a line, for one vehicle. SI units."""

    country: str
    name: str  # of the class of radius, "350:400" or "straight"
    hand: str  # "left", "right" or "straight"
    radius: float  # infinity on straight track [m]
    cant: float  # [m]
    transition: float  # length of a transition to straight track, 0 on straight track [m]
    gauge: float  # [m]
    straight_gauge: float  # of straight track beside it [m]
    pair: RailPair
    rail_inclination: float  # slope [-]
    quality: str  # one of `CLASSES`
    speed: float  # [m/s]
    weight: float  # share of the line [-]

    @property
    def rails(self) -> Rails:
        """The rails by side."""
        return self.pair.rails(self.hand, self.rail_inclination)

    @property
    def cant_deficiency(self) -> float:
        """Cant deficiency at `speed` [m], negative for cant excess, 0 on straight track."""
        return 0.0 if math.isinf(self.radius) else cant_deficiency(self.speed, self.radius, self.cant)

    def alignment(self, length: float = 200.0, approach: float = 50.0) -> Alignment:
        """The section as track to run on: straight - transition - curve, or straight alone.

        Parameters
        ----------
        length : of the curve; of straight track including the approach [m]
        approach : straight track in front of the transition [m]

        Raises
        ------
        ValueError
            A length out of range.
        """
        if math.isinf(self.radius):
            return Alignment((Straight(length, self.gauge),))
        return Alignment(
            (
                Straight(approach, self.straight_gauge),
                Transition(self.transition),
                Curve(length, self.radius, self.hand, self.cant, self.gauge),
            )
        )


def load_sections(
    line: Line, vehicle: str, *, quality: str | None = None, wear: str = NEW, returning: bool = False
) -> tuple[TrackSection, ...]:
    """Representative sections of a line; their weights sum to 1.

    Parameters
    ----------
    line : from `read_line`
    vehicle : a name of ``[speed_km_h]`` in the line's file
    quality : one of `CLASSES` for all sections instead of the distributions of the line: fewer sections
    wear : wear state of the rails, "new" for the nominal profiles
    returning : the opposite direction of running, in which left-hand curves are right-hand ones

    Returns
    -------
    tuple of TrackSection
        Country by country within a class; sections without weight are left out. The weights times the
        line's length are the lengths of the classes.

    Raises
    ------
    ValueError
        An unknown vehicle, quality or wear state (lists the known ones); a place without rails of that wear.
    """
    if vehicle not in line.speed.largest:
        known = ", ".join(sorted(line.speed.largest))
        raise ValueError(f"{line.name} has no speed for vehicle {vehicle!r}, there are: {known}")
    if quality is not None and quality not in CLASSES:
        raise ValueError(f"quality is {quality!r}, allowed are {', '.join(CLASSES)}")
    whole = math.fsum(part.share for part in line.classes)  # 1 but for rounding
    found = []
    for part in line.classes:
        qualities = dict(zip(CLASSES, part.quality, strict=True)) if quality is None else {quality: 1.0}
        for country, in_country in part.countries.items():
            if part.share * in_country == 0.0:
                continue
            for of_pair, pair in rail_pairs(line.rails, country, part.radius, wear):
                for of_quality, in_quality in qualities.items():
                    weight = part.share / whole * in_country * of_pair * in_quality
                    if weight > 0.0:
                        hand = _MIRRORED[part.hand] if returning else part.hand
                        found.append(_section(line, part, vehicle, country, hand, pair, of_quality, weight))
    return tuple(found)


def _section(
    line: Line,
    part: TrackClass,
    vehicle: str,
    country: str,
    hand: str,
    pair: RailPair,
    quality: str,
    weight: float,
) -> TrackSection:
    """A section with the geometry and speed that the line's rules give its class."""
    return TrackSection(
        country=country,
        name=part.name,
        hand=hand,
        radius=part.radius,
        cant=part.cant,
        transition=0.0 if math.isinf(part.radius) else line.transition.length(part.cant),
        gauge=line.gauge.at(part.radius),
        straight_gauge=line.gauge.at(math.inf),
        pair=pair,
        rail_inclination=line.rail_inclination,
        quality=quality,
        speed=_speed(line.speed, vehicle, part),
        weight=weight,
    )


def _speed(rule: SpeedRule, vehicle: str, part: TrackClass) -> float:
    """Largest speed of a vehicle in a class of track [m/s]."""
    largest = rule.largest[vehicle]
    # V^2 = (cant + cant deficiency) g R / e, EN 13803:2017; infinite on straight track
    by_cant = math.sqrt(
        (part.cant + rule.largest_cant_deficiency) * GRAVITY * part.radius / RAIL_TOP_DISTANCE
    )
    if by_cant >= largest:
        return largest
    return max(math.floor(by_cant / rule.step), 1) * rule.step
