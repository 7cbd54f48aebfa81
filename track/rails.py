"""Rail profiles on the left and the right of the track, their wear, and the gauge.

On the iron-ore line the high and the low rail of a curve differ, by country and radius (Hossein-Nia 2018,
table 1-7). So a curve has a `RailPair` by high and low; `Rails` are the two sides that a wheelset meets;
`RailsAlong` puts them, nominal or measured, along a track. `GaugeRule` is the gauge over the radius.
"""

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from hh_exudyn.contact.profile import RAIL_PROFILES, Profile, rail_profile, read_rail_profile

RAIL_HANDS = ("left", "right", "straight")
NEW = "new"  # the wear state of nominal profiles


def slope(text: str) -> float:
    """``"1:30"`` as a number [-].

    Raises ValueError for another form, and outside of 1:15 to 1:100, the inclinations of rails.
    """
    match = re.fullmatch(r"1:(\d+(?:\.\d+)?)", text.replace(" ", ""))
    if match is None or not 15.0 <= float(match[1]) <= 100.0:
        raise ValueError('allowed "1:15" to "1:100"')
    return 1.0 / float(match[1])


@dataclass(frozen=True)
class Rails:
    """The two rails, each by the name of a standard profile or by the path of a measured one.

    Parameters
    ----------
    left, right : a name for `rail_profile` ("60E1"), or the path of an existing profile file
    inclination : of standard profiles towards the track centre, as a slope [-], 0 (upright) to 1/10.
        A measured profile has the inclination of its file.
    """

    left: str = "60E1"
    right: str = "60E1"
    inclination: float = 1.0 / 30.0  # Hossein-Nia 2018, figure 1-12

    def __post_init__(self) -> None:
        if not 0.0 <= self.inclination <= 0.1:
            raise ValueError(f"inclination of Rails is {self.inclination} (slope), allowed are 0 to 0.1")

    def left_profile(self) -> Profile:
        """Profile of the left rail in side coordinates. Raises what the profile's reader raises."""
        return self._profile(self.left, "left")

    def right_profile(self) -> Profile:
        """Profile of the right rail in side coordinates. Raises what the profile's reader raises."""
        return self._profile(self.right, "right")

    def _profile(self, name: str, side: str) -> Profile:
        if name not in RAIL_PROFILES and (set(name) & set("/\\.") or Path(name).exists()):
            return read_rail_profile(name, side=side)
        return rail_profile(name, inclination=self.inclination)


@dataclass(frozen=True)
class RailPair:
    """The two rails of a curve by height, and their wear state.

    Parameters
    ----------
    high, low : name or path as in `Rails`; on straight track `high` lies left and `low` right
    wear : name of the wear state in the measurement; "new" for nominal profiles
    """

    high: str
    low: str
    wear: str = NEW

    def rails(self, hand: str, inclination: float = 1.0 / 30.0) -> Rails:
        """The rails by side: the high rail of a left-hand curve is the right one.

        Raises ValueError for a `hand` that is none of `RAIL_HANDS`.

        Parameters
        ----------
        hand : of the curve, one of `RAIL_HANDS`
        inclination : of standard profiles, slope [-]
        """
        if hand not in RAIL_HANDS:
            raise ValueError(f"hand is {hand!r}, allowed are {', '.join(RAIL_HANDS)}")
        if hand == "left":
            return Rails(left=self.low, right=self.high, inclination=inclination)
        return Rails(left=self.high, right=self.low, inclination=inclination)


@dataclass(frozen=True)
class RailRule:
    """Where a pair of rails lies: country and radius, from `radius_from` to below `radius_to` [m].

    Straight track has the radius infinity, which only a rule with ``radius_from = inf`` covers.
    `share` is for several pairs in the same places [-]; the shares of one place and wear sum to 1.
    """

    country: str
    radius_from: float
    radius_to: float
    pair: RailPair
    share: float = 1.0

    def holds(self, country: str, radius: float, wear: str) -> bool:
        """Whether the rule is for that place and wear state.

        Parameters
        ----------
        country : as in the rules of the line
        radius : of the curve, infinity on straight track [m]
        wear : wear state
        """
        inside = self.radius_from <= radius < self.radius_to or radius == self.radius_from == math.inf
        return inside and self.country == country and self.pair.wear == wear


def rail_pairs(
    rules: Iterable[RailRule], country: str, radius: float, wear: str = NEW
) -> tuple[tuple[float, RailPair], ...]:
    """The pairs of a place, each with its share of the place [-].

    Parameters
    ----------
    rules : of a line
    country : as the rules name it
    radius : of the curve [m], infinity on straight track
    wear : wear state

    Raises
    ------
    ValueError
        A country or wear state without a rule (lists the known ones), a place without rule, or shares
        of a place that do not sum to 1.
    """
    rules = tuple(rules)
    countries = sorted({rule.country for rule in rules})
    if country not in countries:
        raise ValueError(f"country {country!r} has no rails, there are rails for: {', '.join(countries)}")
    states = sorted({rule.pair.wear for rule in rules})
    if wear not in states:
        raise ValueError(f"wear state {wear!r} is not known, there are: {', '.join(states)}")
    found = tuple((rule.share, rule.pair) for rule in rules if rule.holds(country, radius, wear))
    place = "straight track" if math.isinf(radius) else f"radius {radius:g} m"
    if not found:
        raise ValueError(f"no {wear} rails are given for {place} in {country}")
    if abs(math.fsum(share for share, _ in found) - 1.0) > 1e-6:
        total = 100.0 * math.fsum(share for share, _ in found)
        raise ValueError(f"shares of the {wear} rails for {place} in {country} sum to {total:g} %, not 100 %")
    return found


@dataclass(frozen=True)
class GaugeRule:
    """Mean gauge over the radius: linear in curvature between the points, constant beyond the tightest.

    Parameters
    ----------
    radius : falling, the first infinity, that is straight track [m]
    gauge : at each radius [m], 1.40 to 1.50

    Raises
    ------
    ValueError
        Radii that do not start at infinity and fall, not as many gauges, or a gauge out of range.
    """

    radius: tuple[float, ...]
    gauge: tuple[float, ...]

    def __post_init__(self) -> None:
        falls = all(a > b > 0.0 for a, b in pairwise(self.radius))
        if not self.radius or self.radius[0] != math.inf or not falls:
            raise ValueError(
                f"radius of GaugeRule is {self.radius} m, allowed are inf and falling numbers > 0 m"
            )
        if len(self.gauge) != len(self.radius):
            raise ValueError(f"GaugeRule has {len(self.gauge)} gauges for {len(self.radius)} radii")
        for value in self.gauge:
            if not 1.40 <= value <= 1.50:
                raise ValueError(f"gauge of GaugeRule is {value} m, allowed are 1.4 to 1.5 m")

    def at(self, radius: float) -> float:
        """Gauge [m] in a curve of that radius [m], on straight track for infinity."""
        if not radius > 0.0:
            raise ValueError(f"radius is {radius} m, allowed are numbers > 0 m and inf")
        return float(np.interp(1.0 / radius, [1.0 / r for r in self.radius], self.gauge))


def known_rail(name: str, folder: Path | None = None) -> str:
    """The name of a standard rail as it is, or the full path of a measured one.

    Parameters
    ----------
    name : one of `RAIL_PROFILES`, or a path to a profile file, from `folder` if relative
    folder : the working folder if None

    Raises
    ------
    ValueError
        Neither a known name nor an existing file: lists the known names.
    """
    if name in RAIL_PROFILES:
        return name
    path = (folder or Path()) / name
    if path.is_file():
        return str(path.resolve())
    raise ValueError(f"rail {name!r} is no file, and not one of the known rails: {', '.join(RAIL_PROFILES)}")


@dataclass(frozen=True)
class RailSection:
    """Rails from `start` [m] to the next section's start, and their wear state."""

    start: float
    rails: Rails
    wear: str = NEW


@dataclass(frozen=True)
class RailsAlong:
    """Rails along a track, in the order of their starts; the first also holds before its start.

    Raises ValueError without sections or where a start is not behind the one before it.
    """

    sections: tuple[RailSection, ...]

    def __post_init__(self) -> None:
        if not self.sections:
            raise ValueError("sections of RailsAlong is empty, at least one is needed")
        if not all(math.isfinite(section.start) for section in self.sections):
            raise ValueError("starts of RailsAlong must be finite [m]")
        for i, (one, other) in enumerate(pairwise(self.sections)):
            if not other.start > one.start:
                raise ValueError(
                    f"start of rail section {i + 2} is {other.start:g} m, allowed is behind {one.start:g} m, "
                    "where the section before it starts"
                )

    @classmethod
    def of_stretches(cls, stretches: Iterable[tuple[float, Rails | None]]) -> "RailsAlong":
        """Rails of stretches of track in their order from s = 0, each by its length [m] and its rails.

        A stretch without rails of its own (None: a transition) has those of its neighbours, with the change
        at its middle. Neighbours with the same rails become one section. Raises ValueError where no stretch
        has rails.
        """
        found: list[RailSection] = []
        start, without = 0.0, 0.0
        for length, rails in stretches:
            if rails is None:
                without += length
            else:
                if not found:
                    found.append(RailSection(0.0, rails))
                elif rails != found[-1].rails:
                    found.append(RailSection(start - 0.5 * without, rails))
                without = 0.0
            start += length
        return cls(tuple(found))

    def at(self, s: float) -> RailSection:
        """The section at arc length s [m]; on a boundary the one that begins there."""
        found = self.sections[0]
        for section in self.sections[1:]:
            if s >= section.start:
                found = section
        return found
