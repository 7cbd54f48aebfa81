"""The friction coefficient of a contact by place on the track, zone of the wheel and slip speed.

The input is `Zones` (a coefficient for tread, gauge corner and flange) for sections of the track, left and
right, and perhaps a `Falling` characteristic; `Friction.table` makes the table that the contact kernels read
for every patch (`hh_exudyn.contact.friction`). Zones and sections pass smoothly into each other, so that
creep forces stay continuous.

    >>> dry = climate("cold_dry").treated("flange_lubrication")
    >>> friction = Friction.everywhere(dry, falling=falling("polach_dry"))
    >>> table = friction.table([()] * 4)  # for a wagon

Treatments on board, such as the flange lubrication of a locomotive, act on the treated wheelsets alone; their
effect on the rail for the wheelsets behind is a treatment of the track.

    >>> table = friction.table([("flange_lubrication",), (), (), (), (), ("flange_lubrication",)])

The numbers of climates, treatments and falling characteristics stand with their sources in
``track/data/friction.toml``.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Self

import numpy as np

from hh_exudyn.contact.friction import FILMS, FrictionTable
from hh_exudyn.sourced import ParameterSet, load_parameters

ZONES = ("tread", "gauge_corner", "flange")
_FRICTION = (0.01, 1.0)  # allowed range


def _check_range(name: str, value: float, unit: str, low: float, high: float) -> None:
    """Raise ValueError unless `value` lies between `low` and `high`; NaN does not."""
    if not (low <= value <= high and math.isfinite(value)):
        raise ValueError(f"{name} is {value} {unit}, allowed are {low:g} to {high:g} {unit}")


@dataclass(frozen=True)
class Zones:
    """Friction coefficients at rest of the zones of a wheel on its rail [-], 0.01 to 1.

    The contact angle separates the zones: tread below 10 degrees, gauge corner from 20 to 35, flange
    above 55 (``friction.toml``). Raises ValueError for a coefficient out of range.
    """

    tread: float
    gauge_corner: float
    flange: float

    def __post_init__(self) -> None:
        for name in ZONES:
            _check_range(f"friction of the {name}", getattr(self, name), "[-]", *_FRICTION)

    @classmethod
    def even(cls, friction: float) -> Self:
        """The same coefficient everywhere on the wheel."""
        return cls(friction, friction, friction)

    @property
    def coefficients(self) -> tuple[float, float, float]:
        """Of tread, gauge corner and flange."""
        return self.tread, self.gauge_corner, self.flange

    def treated(self, *treatments: str) -> "Zones":
        """The zones after lubrication or conditioning: the lower of both frictions in each zone.

        Raises ValueError for an unknown treatment (lists the known ones).
        """
        zones = self
        for name in treatments:
            target = _named("treatment", name)
            lowered = {key: min(value, getattr(zones, key)) for key, value in target.items()}
            zones = replace(zones, **lowered)
        return zones


@dataclass(frozen=True)
class Falling:
    """Friction that falls with slip speed v: mu(v) = mu(0) ((1 - A) exp(-B v) + A), Polach 2005.

    Parameters
    ----------
    ratio : A, friction at infinite slip speed over that at rest [-], 0 to 1; 1 does not fall
    decrease : B [s/m], 0 to 10

    Raises
    ------
    ValueError
        A number out of range.
    """

    ratio: float = 1.0
    decrease: float = 0.0

    def __post_init__(self) -> None:
        _check_range("ratio of Falling", self.ratio, "[-]", 0.0, 1.0)
        _check_range("decrease of Falling", self.decrease, "s/m", 0.0, 10.0)


@dataclass(frozen=True)
class FrictionSection:
    """Friction from `start` [m] to the next section's start."""

    start: float
    left: Zones
    right: Zones

    def __post_init__(self) -> None:
        _check_range("start of a FrictionSection", self.start, "m", -1e6, 1e6)


@dataclass(frozen=True)
class Friction:
    """Friction along a track.

    Parameters
    ----------
    sections : in the order of their starts; the first also holds before its start
    falling : characteristic over the slip speed, the same everywhere
    ramp : length over which one section changes into the next, half before and half behind the start [m],
        0.01 to 100 and no longer than a section

    Raises
    ------
    ValueError
        No section, starts that do not grow by `ramp` at least, a ramp out of range.
    """

    sections: tuple[FrictionSection, ...]
    falling: Falling = Falling()
    ramp: float = 2.0

    def __post_init__(self) -> None:
        if not self.sections:
            raise ValueError("sections of Friction is empty, at least one is needed")
        _check_range("ramp of Friction", self.ramp, "m", 0.01, 100.0)
        for i, (one, other) in enumerate(pairwise(self.sections)):
            if other.start - one.start < self.ramp:
                raise ValueError(
                    f"start of friction section {i + 2} is {other.start:g} m, allowed is from "
                    f"{one.start + self.ramp:g} m on: {self.ramp:g} m (ramp) behind the section before it"
                )

    @classmethod
    def everywhere(cls, zones: Zones, falling: Falling = Falling()) -> Self:
        """The same zones along the whole track, left and right."""
        return cls((FrictionSection(0.0, zones, zones),), falling)

    def table(self, wheelsets: Sequence[tuple[str, ...]]) -> FrictionTable:
        """The table that the contact kernels read, for a vehicle with these wheelsets.

        Parameters
        ----------
        wheelsets : treatments of each wheelset, mostly none: ``()``

        Raises
        ------
        ValueError
            An unknown treatment (lists the known ones).
        """
        surfaces = tuple(dict.fromkeys(wheelsets))
        values = [
            [
                [place.left.treated(*own).coefficients, place.right.treated(*own).coefficients]
                for place in self.sections
            ]
            for own in surfaces
        ]
        return FrictionTable(
            np.array([section.start - 0.5 * self.ramp for section in self.sections]),
            float(self.ramp),
            np.array(values),
            np.array([surfaces.index(own) for own in wheelsets]),
            *_zone_angles(),
            float(self.falling.ratio),
            float(self.falling.decrease),
        )


def films(*treatments: str) -> tuple[str, str, str]:
    """The film that treatments leave on tread, gauge corner and flange: the strongest of `FILMS`.

    Raises ValueError for an unknown treatment (lists the known ones).
    """
    left = load_parameters("track", "friction").texts
    for name in treatments:
        _named("treatment", name)

    def strongest(zone: str) -> str:
        own = [left.get(f"film.{name}.{zone}", FILMS[0]) for name in treatments]
        return max(own, key=FILMS.index, default=FILMS[0])

    return strongest("tread"), strongest("gauge_corner"), strongest("flange")


def climate(name: str) -> Zones:
    """Untreated friction in that weather, the same in all zones.

    Raises ValueError for an unknown name (lists the known ones).
    """
    return Zones.even(_named("climate", name)["friction"])


def falling(name: str) -> Falling:
    """The falling characteristic of that name. Raises ValueError for an unknown one (lists the known)."""
    numbers = _named("falling", name)
    return Falling(numbers["ratio"], numbers["decrease"])


def known(kind: str) -> tuple[str, ...]:
    """Names of a kind: "climate", "treatment" or "falling"."""
    return load_parameters("track", "friction").table(kind).tables


def friction_numbers(kind: str, name: str) -> ParameterSet:
    """The numbers of a climate, a treatment or a falling characteristic with their sources.

    Raises ValueError for an unknown name (lists the known ones).
    """
    if name not in known(kind):
        raise ValueError(f"{kind} {name!r} is not known, there are: {', '.join(known(kind))}")
    return load_parameters("track", "friction").table(kind).table(name)


def _named(kind: str, name: str) -> dict[str, float]:
    """Numbers of one table of the data file, by key."""
    return friction_numbers(kind, name).values()


def _zone_angles() -> tuple[float, float, float, float]:
    """Contact angles at the beginning and end of the passage from zone to zone [rad]."""
    zones = load_parameters("track", "friction").table("zones")
    corner, flange = zones.row("tread_to_gauge_corner"), zones.row("gauge_corner_to_flange")
    return (
        math.radians(corner[0]), math.radians(corner[1]), math.radians(flange[0]), math.radians(flange[1]),
    )  # fmt: skip
