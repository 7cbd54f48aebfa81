"""What the file of a load collective says, as frozen values. SI units, shares as numbers that sum to 1."""

import math
from dataclasses import dataclass, field
from typing import Any

from hh_exudyn.contact.friction import FILMS
from hh_exudyn.sourced import Parameter
from track.friction import ZONES, Falling, Zones
from vehicles.catalogue import vehicle
from vehicles.description import Vehicle
from vehicles.variants import Variant

SAMPLED = "sampled"
DESIGNS = ("full", "overlay", SAMPLED)
HANDS = ("merged", "mirrored", "both")
HALVED = ("radius", "quality", "gauge", "friction")
"""Axes of which the steps can be halved."""


@dataclass(frozen=True)
class Films:
    """Film of lubricant on tread, gauge corner and flange, each one of `hh_exudyn.contact.friction.FILMS`."""

    tread: str = FILMS[0]
    gauge_corner: str = FILMS[0]
    flange: str = FILMS[0]

    @property
    def names(self) -> tuple[str, str, str]:
        """Of tread, gauge corner and flange."""
        return self.tread, self.gauge_corner, self.flange


@dataclass(frozen=True)
class Season:
    """Weather and lubrication for a share of the distance.

    `friction` holds on both rails before `treatments` (of the track) and those of `lubricated_wheelsets`;
    `films` is the natural film, of water, oxide or leaves, beside which the treatments leave their own.
    """

    name: str
    share: float
    friction: Zones
    films: Films = Films()
    treatments: tuple[str, ...] = ()
    lubricated_wheelsets: tuple[int, ...] = ()
    falling: Falling | None = None
    flexibility: str | None = None  # of the track in that season; None: that of the base case

    @property
    def severity(self) -> float:
        """Mean friction of the zones, treated [-]: roughly in the order of damage, for sampling alone."""
        return math.fsum(self.friction.treated(*self.treatments).coefficients) / len(ZONES)


@dataclass(frozen=True)
class Haul:
    """Forces along the track, for a share of a vehicle's distance.

    A vehicle with drives has `gradient` and a train; a hauled one `draft` at its couplers and `shoe_force`.
    Gradients go with curves: `of_class` has the share in single curve classes, in place of `share`.
    """

    name: str
    share: float
    gradient: float = 0.0  # slope, positive uphill [-]
    trailing_wagons: int | None = None
    wagon_mass: float | None = None  # [kg]
    draft: float | None = None  # [N]
    shoe_force: float | None = None  # [N]
    of_class: tuple[tuple[str, float], ...] = ()

    def share_in(self, curve_class: str) -> float:
        """Share of the vehicle's distance in a curve class of the line [-]."""
        return dict(self.of_class).get(curve_class, self.share)


@dataclass(frozen=True)
class Running:
    """A vehicle with its load, in one direction, for a share of the distance.

    `line_vehicle` is the name under which the line's file has its largest speed. `returning`: it runs against
    the direction in which the line's file counts left and right. `speeds` are fractions of the largest speed
    with their shares. `variant` is the vehicle where it is not one of the catalogue; `vehicle` is its name.
    """

    name: str
    share: float
    vehicle: str
    line_vehicle: str
    returning: bool
    speeds: tuple[tuple[float, float], ...]
    hauls: tuple[Haul, ...]
    variant: Variant | None = None

    @property
    def described(self) -> Vehicle:
        """The vehicle itself."""
        return vehicle(self.vehicle) if self.variant is None else self.variant.vehicle()

    @property
    def vehicle_of_case(self) -> str | dict[str, Any]:
        """The vehicle as a case has it: a name of the catalogue, or the table of a variant."""
        return self.vehicle if self.variant is None else self.variant.to_table()


@dataclass(frozen=True)
class TrackLengths:
    """Lengths of a case's track [m]: straight ahead, full curve (or straight track), straight behind.

    `whole_curve` is the mean length of a curve of the line including both transitions: with the length of the
    transitions it gives their share of a class.
    """

    whole_curve: float
    approach: float
    body: float
    run_out: float


@dataclass(frozen=True)
class GaugeSpread:
    """Gauge about the mean of a radius: normal with `deviation` [m], cut at `truncation` deviations.

    `shift` [m] is added to the means of the line's file, on all radii alike.
    """

    deviation: float
    truncation: float
    quantiles: int
    shift: float = 0.0


@dataclass(frozen=True)
class QualityRule:
    """Irregularity of a quality class: a spectrum, scaled.

    The worse of level and alignment has a standard deviation within the limits of its class
    (`track.irregularity.quality`), at `speed` [m/s]. The lower limit of QN1 is `lowest` of its upper one, the
    upper limit of what is worse than QN3 `highest` of its lower one.
    """

    spectrum: str
    speed: float
    lowest: float
    highest: float


@dataclass(frozen=True)
class Plan:
    """The file of a load collective.

    `base` holds tables of a case file for what all cases have in common. `merged_classes` are groups of curve
    classes that share cases; `hands` says how left and right do: "merged" (one case at the mean geometry of
    both), "mirrored" (a case each, the right-hand one run as its mirror image) or "both" (as they lie).
    `halvings` says how often the steps of an axis are halved. `runs` is the number of cases of one replicate
    of the design "sampled", None for the others.
    """

    name: str
    line: str
    distance: float  # [m]
    design: str
    hands: str
    replicates: int
    base: dict[str, Any]
    merged_classes: tuple[tuple[str, ...], ...]
    running: tuple[Running, ...]
    lengths: TrackLengths
    gauge: GaugeSpread
    quality: QualityRule
    seasons: tuple[Season, ...]
    rail_wear: dict[str, dict[str, float]]  # by curve class, "" for all others: shares by wear state
    numbers: tuple[Parameter, ...]  # all of the file with their sources
    halvings: dict[str, int] = field(default_factory=dict)
    runs: int | None = None
