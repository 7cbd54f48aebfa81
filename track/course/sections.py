"""Sections of an alignment in plan (`Straight`, `Transition`, `Curve`, `Ramp`) and the `Grade`.

Each checks its own numbers; jumps from one to the next are errors of `track.course.course`.
"""

from dataclasses import dataclass, replace

from hh_exudyn.conventions import LEFT, NOMINAL_GAUGE, RIGHT
from track.course.shapes import SHAPES

HANDS = {"left": LEFT, "right": RIGHT}
LENGTH = (1e-3, 1e6)  # m, allowed ranges
RADIUS = (100.0, 100_000.0)  # m
CURVATURE = (-1.0 / RADIUS[0], 1.0 / RADIUS[0])  # 1/m
CANT = (0.0, 0.180)  # m, EN 13803:2017 allows 180 mm as exceptional limit
GAUGE = (0.9, 1.75)  # m, from narrow to Indian gauge with their limits
GRADIENT = (-0.05, 0.05)  # [-], adhesion lines stay below 40 per mille with few exceptions
GRAVITY_HEIGHT = (0.0, 3.0)  # m over the running plane
VERTICAL_RADIUS = 500.0  # m, exceptional limit of EN 13803:2017

State = tuple[
    float, float, float
]  # curvature [1/m], cant as height of the right rail over the left [m], gauge


def check(name: str, value: float, limits: tuple[float, float], unit: str = "m") -> None:
    """Raise ValueError unless `value` lies within `limits`; NaN does not."""
    if not limits[0] <= value <= limits[1]:
        unit = f" {unit}" if unit else ""
        raise ValueError(f"{name} is {value}{unit}, allowed are {limits[0]:g} to {limits[1]:g}{unit}")


@dataclass(frozen=True)
class Straight:
    """Straight track without cant: its length [m] and its gauge [m]."""

    length: float
    gauge: float = NOMINAL_GAUGE

    def __post_init__(self) -> None:
        check("length of a Straight", self.length, LENGTH)
        check("gauge of a Straight", self.gauge, GAUGE)

    @property
    def state(self) -> State:
        """Curvature, cant and gauge."""
        return 0.0, 0.0, self.gauge


@dataclass(frozen=True)
class Transition:
    """A change of curvature, cant and gauge from the values of one neighbour to those of the other.

    Straight to curve, curve to straight, curve to another curve of the same hand (compound) or of the other
    (reverse). `length` [m]. `gauge` [m] is the gauge at its middle, with linear ramps to both sides; None,
    the default, is one ramp. `shape` is the course of curvature and cant (EN 13803), one of `shapes.SHAPES`:
    see there. `gravity_height` [m] is for a Viennese bend: the height over the running plane that it leads
    smoothly, 1.8 m where the railway says nothing else.
    """

    length: float
    gauge: float | None = None
    shape: str = "clothoid"
    gravity_height: float = 1.8

    def __post_init__(self) -> None:
        check("length of a Transition", self.length, LENGTH)
        if self.gauge is not None:
            check("gauge of a Transition", self.gauge, GAUGE)
        if self.shape not in SHAPES:
            raise ValueError(f"shape of a Transition is {self.shape!r}, allowed are {', '.join(SHAPES)}")
        check("gravity_height of a Transition", self.gravity_height, GRAVITY_HEIGHT)


@dataclass(frozen=True)
class Curve:
    """A circular arc: length, radius of the centre line, hand "left" or "right", cant >= 0, gauge [m].

    The cant always raises the outer rail.
    """

    length: float
    radius: float
    hand: str
    cant: float = 0.0
    gauge: float = NOMINAL_GAUGE

    def __post_init__(self) -> None:
        check("length of a Curve", self.length, LENGTH)
        check("radius of a Curve", self.radius, RADIUS)
        check("cant of a Curve", self.cant, CANT)
        check("gauge of a Curve", self.gauge, GAUGE)
        if self.hand not in HANDS:
            raise ValueError(f'hand of a Curve is {self.hand!r}, allowed are "left" and "right"')

    @property
    def state(self) -> State:
        """Curvature, cant and gauge."""
        sign = HANDS[self.hand]
        return sign / self.radius, sign * self.cant, self.gauge


@dataclass(frozen=True)
class Ramp:
    """Curvature, cant and gauge linear between given ends, for tables and surveyed lines.

    `curvature` [1/m] is positive to the left. `cant` [m] is the height of the RIGHT rail over the left one,
    so that it has the sign of the curvature where the outer rail is raised. On a straight it may have either
    sign: a cant ramp may begin ahead of its transition, or end behind it.
    """

    length: float
    curvature: tuple[float, float]
    cant: tuple[float, float] = (0.0, 0.0)
    gauge: tuple[float, float] = (NOMINAL_GAUGE, NOMINAL_GAUGE)

    def __post_init__(self) -> None:
        check("length of a Ramp", self.length, LENGTH)
        for curvature, cant, gauge in zip(self.curvature, self.cant, self.gauge, strict=True):
            check("curvature of a Ramp", curvature, CURVATURE, "1/m")
            check("cant of a Ramp", cant, (-CANT[1], CANT[1]))
            check("gauge of a Ramp", gauge, GAUGE)
            if cant * curvature < 0.0:
                raise ValueError(
                    f"cant of a Ramp is {cant} m where its curvature is {curvature} 1/m, allowed is a cant "
                    "with the sign of the curvature (outer rail higher)"
                )

    @property
    def states(self) -> tuple[State, State]:
        """Curvature, cant and gauge at beginning and end."""
        first, last = zip(self.curvature, self.cant, self.gauge, strict=True)
        return first, last


@dataclass(frozen=True)
class Grade:
    """A stretch of the vertical profile: gradient dz/ds [-], positive uphill, over `length` [m] in plan.

    With `end` it is a vertical curve (a parabola) in which the gradient changes linearly from `gradient` to
    it.
    """

    length: float
    gradient: float
    end: float | None = None

    def __post_init__(self) -> None:
        check("length of a Grade", self.length, LENGTH)
        check("gradient of a Grade", self.gradient, GRADIENT, "(slope)")
        if self.end is None:
            return
        check("end of a Grade", self.end, GRADIENT, "(slope)")
        change = abs(self.end - self.gradient)
        if change * VERTICAL_RADIUS > self.length * (1.0 + 1e-9):
            raise ValueError(
                f"vertical radius of a Grade is {self.length / change:.4g} m, allowed are "
                f"{VERTICAL_RADIUS:g} m and more: longer than {change * VERTICAL_RADIUS:.4g} m"
            )


Section = Straight | Transition | Curve | Ramp


def mirrored(section: Section) -> Section:
    """The mirror image of a section: left becomes right."""
    if isinstance(section, Curve):
        return replace(section, hand="right" if section.hand == "left" else "left")
    if isinstance(section, Ramp):
        turn, lift = section.curvature, section.cant
        return replace(section, curvature=(-turn[0], -turn[1]), cant=(-lift[0], -lift[1]))
    return section
