"""Statistics of a line, as `track.line.line_file` reads them. SI units."""

from dataclasses import dataclass

from track.rails import GaugeRule, RailRule


@dataclass(frozen=True)
class TrackClass:
    """All track of a line in one interval of radius and of one hand."""

    name: str  # of the interval, "350:400"; "straight"
    hand: str  # "left", "right" or "straight"
    share: float  # of the line's length [-]
    radius: float  # mean of the class, infinity for straight track [m]
    cant: float  # mean of the class [m]
    countries: dict[str, float]  # share of the class that lies in each country [-]
    quality: tuple[float, float, float, float]  # share in each of `irregularity.quality.CLASSES` [-]


@dataclass(frozen=True)
class SpeedRule:
    """Largest speeds: of each vehicle [m/s], and of all of them in a curve by cant deficiency [m].

    Where the cant deficiency limits the speed, it is rounded down to a multiple of `step` [m/s].
    """

    largest: dict[str, float]
    largest_cant_deficiency: float
    step: float


@dataclass(frozen=True)
class TransitionRule:
    """Length of transitions: cant times `cant_ramp` (a ramp of 1 : cant_ramp), `shortest` at least [m]."""

    cant_ramp: float
    shortest: float

    def length(self, cant: float) -> float:
        """Length of the transition to a curve of that cant [m]."""
        return max(self.cant_ramp * cant, self.shortest)


@dataclass(frozen=True)
class Line:
    """A line's statistics, with the source of every table of its file.

    `line_quality` is the distribution of `track.irregularity.quality.CLASSES` over the whole line by another
    measurement, or None; it does not enter any computation.
    """

    name: str
    length: float  # [m]
    classes: tuple[TrackClass, ...]
    speed: SpeedRule
    transition: TransitionRule
    gauge: GaugeRule
    rail_inclination: float  # slope [-]
    rails: tuple[RailRule, ...]
    country_lengths: dict[str, float]  # [m]
    line_quality: tuple[float, float, float, float] | None
    sources: dict[str, str]  # table of the file: "published: ...", "derived: ..." or "assumed: ..."

    def assumed(self) -> tuple[str, ...]:
        """The tables of the line's file with assumed numbers."""
        return tuple(table for table, source in self.sources.items() if source.startswith("assumed"))
