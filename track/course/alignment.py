"""The alignment: straights, transitions, curves and grades, and the kernel table of the track frame.

The input is sections in plan (`Straight`, `Transition`, `Curve`, `Ramp`) and, beside them, the vertical
profile (`Grade`); `Alignment` checks them and builds the table that the kernels `inclined_frame` and
`inclined_locate` read. The centre line starts at s = 0 in the origin of the global frame, heading along +X.

Continuous are position, heading, curvature, cant, gauge and gradient, AND the rates of the latter four.
The kinks that sections leave (both ends of a clothoid, of a cant ramp, of a vertical curve) are blended over
`blend` metres to both sides, without displacement of the track behind (`track.course.course` has the
formula). Curvature, cant or gauge that jump from section to section are errors, not blended.

Outside the sections: before s = 0 and beyond the end the track continues with the curvature, cant, gauge and
gradient it has there (`lead_in` and `run_out` metres, since the rear of a vehicle stands at s < 0),
so an alignment of one `Curve` is a full circle. A `Transition` at the start or the end joins a straight
without cant. Beyond lead-in and run-out there is no track: the kernels return NaN.

Arc length s is measured in plan, as chainage is; on a gradient i the track is longer by i^2 / 2 of it
(5e-5 at 10 per mille). Cant turns the running plane about the centre line, where the inner rail falls as much
as the outer one rises, or about the low rail, where the centre line rises by half the cant.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from hh_exudyn.conventions import GRAVITY, RAIL_TOP_DISTANCE
from track.course.course import Course, grade_course, marks, plan_courses, values
from track.course.frame import (
    inclined_frame,
    inclined_locate,
    inclined_rotation,
    rise_in_cell,
    shift_in_cell,
    track_frame,
    turn_in_cell,
)
from track.course.sections import (
    CANT,
    LENGTH,
    RADIUS,
    Curve,
    Grade,
    Ramp,
    Section,
    Straight,
    Transition,
    check,
    mirrored,
)
from track.course.types import AlignmentTable, Node

__all__ = [
    "Alignment",
    "AlignmentTable",
    "Curve",
    "Grade",
    "Ramp",
    "Section",
    "Straight",
    "Transition",
    "cant_deficiency",
    "inclined_frame",
    "inclined_locate",
    "inclined_rotation",
    "track_frame",
]

CANT_ABOUT = ("centre", "low_rail")
LONGEST = 200e3  # m of all sections: the table has a node every `step`, 100 MB for these

_SHORTEST_CELL = 1e-6  # m; marks closer to a section boundary than this are left out
_LEAST_CANT = 1e-6  # m; blended kinks overshoot


@dataclass(frozen=True)
class Alignment:
    """A sequence of sections, checked, with its kernel table.

    Parameters
    ----------
    sections : from s = 0 onwards
    step : largest distance of the table's nodes [m], 0.05 to 2
    lead_in, run_out : length of the track before s = 0 and behind the end [m]
    grades : vertical profile from s = 0 onwards, level track if there are none; the last gradient continues
    blend : length to both sides of a kink over which its rate is made continuous [m], 0.01 to 5; no more
        than a quarter of the shorter of the sections that meet there is used
    cant_about : "centre" or "low_rail", what the running plane turns about; about the low rail, cants have
        one sign
    cant_base : lateral distance across which the sections' cants are heights [m], 0.9 to 2; `table` has those
        across 1.5 m

    Raises
    ------
    ValueError
        No section, a number out of range, or curvature, cant, gauge or gradient that jump: names the section.
    """

    sections: tuple[Section, ...]
    step: float = 0.5
    lead_in: float = 50.0
    run_out: float = 50.0
    grades: tuple[Grade, ...] = ()
    blend: float = 0.5
    cant_about: str = "centre"
    cant_base: float = RAIL_TOP_DISTANCE
    table: AlignmentTable = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if not self.sections:
            raise ValueError("sections is empty, at least one is needed")
        check("step", self.step, (0.05, 2.0))
        check("lead_in", self.lead_in, LENGTH)
        check("run_out", self.run_out, LENGTH)
        check("blend", self.blend, (0.01, 5.0))
        check("cant_base", self.cant_base, (0.9, 2.0))
        if self.cant_about not in CANT_ABOUT:
            raise ValueError(f"cant_about is {self.cant_about!r}, allowed are {', '.join(CANT_ABOUT)}")
        check("length of all sections", self.length, (0.0, LONGEST))
        object.__setattr__(self, "table", _table(self))

    @classmethod
    def from_sections(
        cls, sections: Iterable[Section], step: float = 0.5, grades: Iterable[Grade] = ()
    ) -> Self:
        """The alignment made of `sections`, from s = 0 onwards.

        Parameters
        ----------
        sections : in order
        step : largest distance of the table's nodes [m]
        grades : vertical profile from s = 0 on; level track without
        """
        return cls(tuple(sections), step, grades=tuple(grades))

    @property
    def length(self) -> float:
        """Arc length of all sections, without lead-in and run-out [m]."""
        return math.fsum(section.length for section in self.sections)

    def section_at(self, s: float) -> Section:
        """The section at arc length s [m]; on a boundary the one that begins there.

        Raises ValueError outside 0 to `length` (lead-in and run-out belong to no section).
        """
        check("s", s, (0.0, self.length))
        end = 0.0
        for section in self.sections:
            end += section.length
            if s < end:
                return section
        return self.sections[-1]

    def mirrored(self) -> Self:
        """The mirror image: left-hand curves become right-hand ones and the other way round."""
        return replace(self, sections=tuple(mirrored(section) for section in self.sections))


def _table(alignment: Alignment) -> AlignmentTable:
    """Nodes of an alignment: cubic pieces put end to end, then moved so that s = 0 is the origin."""
    ends = alignment.lead_in, alignment.run_out
    plan = plan_courses(alignment.sections, *ends, cant_scale=RAIL_TOP_DISTANCE / alignment.cant_base)
    grade = grade_course(alignment.grades, alignment.length, *ends)
    courses = (*plan, grade)
    s = _places(courses, plan.curvature.at, alignment.step, alignment.blend)
    h = np.diff(s)
    nodes = np.zeros((s.size, len(Node)))
    nodes[:, Node.S] = s
    for first, course in zip((Node.CURVATURE, Node.CANT, Node.GAUGE, Node.GRADIENT), courses, strict=True):
        value, rate = values(course, s, alignment.blend)
        mean = np.diff(value) / h
        nodes[:, first] = value
        nodes[:, first + 1] = rate
        nodes[:-1, first + 2] = (3.0 * mean - 2.0 * rate[:-1] - rate[1:]) / h  # Hermite's cubic
        nodes[:-1, first + 3] = (rate[:-1] + rate[1:] - 2.0 * mean) / h**2
    if alignment.cant_about == "low_rail":
        _lift_centre(nodes)
    cells = list(zip(nodes[:-1], h.tolist(), strict=True))
    turn = np.array([turn_in_cell(node, u) for node, u in cells])
    ahead, aside = np.array([shift_in_cell(node, u) for node, u in cells]).T
    zero = int(np.searchsorted(s, 0.0))
    heading = _summed(turn, zero)
    c, n = np.cos(heading), np.sin(heading)
    nodes[:, Node.HEADING], nodes[:, Node.FORWARD_X], nodes[:, Node.FORWARD_Y] = heading, c, n
    nodes[:, Node.X] = _summed(c[:-1] * ahead - n[:-1] * aside, zero)
    nodes[:, Node.Y] = _summed(n[:-1] * ahead + c[:-1] * aside, zero)
    nodes[:, Node.Z] = _summed(np.array([rise_in_cell(node, u) for node, u in cells]), zero)
    grid = s[0] + alignment.step * np.arange(math.ceil((s[-1] - s[0]) / alignment.step) + 2)
    cell = np.clip(np.searchsorted(s, grid, side="right") - 1, 0, s.size - 2)
    return AlignmentTable(float(s[0]), float(s[-1]), float(alignment.step), cell.astype(np.int64), nodes)


def _lift_centre(nodes: np.ndarray) -> None:
    """Add half the slope of the cant to the gradient: the low rail keeps its gradient."""
    cant = nodes[:, Node.CANT]
    if cant.min() < -_LEAST_CANT and cant.max() > _LEAST_CANT:
        raise ValueError(
            f"cants of both hands, {1e3 * cant.min():.4g} and {1e3 * cant.max():.4g} mm (right over left "
            "rail): allowed about the low rail are those of one hand"
        )
    half = 0.5 if cant.max() > -cant.min() else -0.5
    for power, coefficient in enumerate((Node.CANT_1, Node.CANT_2, Node.CANT_3)):
        nodes[:, Node.GRADIENT + power] += half * (power + 1) * nodes[:, coefficient]


def _summed(parts: np.ndarray, zero: int) -> np.ndarray:
    """Running sums from node to node, 0 at node `zero`."""
    sums = np.concatenate([[0.0], np.cumsum(parts)])
    result: np.ndarray = sums - sums[zero]
    return result


def _places(courses: tuple[Course, ...], bounds: np.ndarray, step: float, blend: float) -> np.ndarray:
    """Arc lengths of the nodes: section boundaries, ends of blends, and nodes in between."""
    other = np.unique(np.concatenate([marks(course, blend) for course in courses]))
    above = np.clip(np.searchsorted(bounds, other), 1, bounds.size - 1)
    near = np.minimum(np.abs(bounds[above] - other), np.abs(bounds[above - 1] - other)) < _SHORTEST_CELL
    other = other[~near]
    other = other[np.diff(other, prepend=-np.inf) > _SHORTEST_CELL]
    at = np.union1d(bounds, other)
    number = np.maximum(1, np.ceil(np.diff(at) / step - 1e-9)).astype(int)
    pieces = [np.linspace(a, b, n + 1)[:-1] for a, b, n in zip(at[:-1], at[1:], number, strict=True)]
    return np.concatenate([*pieces, at[-1:]])


def cant_deficiency(speed: float, radius: float, cant: float = 0.0) -> float:
    """Cant deficiency in a curve [m], negative for cant excess.

    I = e V^2 / (g R) - cant with e the lateral distance of the rail tops, EN 13803:2017 (its 11.8 V^2 / R in
    mm, km/h and m at e = 1500 mm).

    Parameters
    ----------
    speed : [m/s], 0 to 150
    radius : [m], 100 to 20000
    cant : [m], 0 to 0.180
    """
    check("speed", speed, (0.0, 150.0), "m/s")
    check("radius", radius, RADIUS)
    check("cant", cant, CANT)
    return RAIL_TOP_DISTANCE * speed**2 / (GRAVITY * radius) - cant
