"""Curvature, cant, gauge and gradient along the track: shapes of transitions, and the blending of kinks.

A `Course` is one quantity, piece by piece. Along a clothoid it is linear, so its RATE jumps at both ends. No
track has such a jump, and it would excite vehicle and controllers; so every kink is blended over `blend`
metres to both sides:

    f(s) + D b [1/12 - |t|/2 + 3 t^2/4 - |t|^3/3],  t = (s - s_k) / b,  |t| < 1,  D the jump of the slope

This is f smoothed by the kernel K(t) = 3/2 - 2 |t|, whose zeroth moment is 1 and whose first AND second
moments vanish. So the blending changes neither the heading nor, but for 1e-9 m, the position of the track
behind it: the clothoid ends where Fresnel's integrals say (at its very end, inside the blend, within
D b^3 / 240, that is 3e-7 m for a clothoid of 20 m into R = 100 m). The bracket is cubic on either side of the
kink, so that the cubic pieces of the kernel table represent it exactly. In return the rate overshoots by 6 %
of D.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.arrays import FloatArray
from hh_exudyn.conventions import RAIL_TOP_DISTANCE
from track.course.sections import Grade, Ramp, Section, State, Transition
from track.course.shapes import CLOTHOID, CUBIC, HELMERT, LARGEST_TURN, SHAPES, VIENNESE, roll_bend, share


class Course(NamedTuple):
    """One quantity along the track in n pieces that meet without a jump."""

    at: FloatArray  # (n + 1,) arc lengths of the boundaries [m]
    first: FloatArray  # (n,) value at the beginning of each piece
    last: FloatArray  # (n,) value at its end
    shape: NDArray[np.int64]  # (n,) index into SHAPES
    turn: FloatArray  # (n,) of a cubic parabola [rad], see `shapes.share`; else 0
    bend: FloatArray  # (n,) factor of `shapes.roll_bend` in the curvature of a Viennese bend [1/m]; else 0


class _Piece(NamedTuple):
    """One piece of a course, from the end of the piece before."""

    first: float
    last: float
    end: float  # [m]
    shape: int = CLOTHOID
    turn: float = 0.0
    bend: float = 0.0


class PlanCourses(NamedTuple):
    """Courses of the quantities that the sections define."""

    curvature: Course  # [1/m]
    cant: Course  # height of the right rail over the left [m]
    gauge: Course  # [m]


def plan_courses(
    sections: tuple[Section, ...], lead_in: float, run_out: float, cant_scale: float = 1.0
) -> PlanCourses:
    """Courses of curvature, cant and gauge, with constant pieces before s = 0 and behind the end.

    Raises ValueError where a quantity jumps or the ends of a `Transition` are not defined.

    Parameters
    ----------
    sections : of the alignment, from s = 0 on
    lead_in, run_out : length of track before s = 0 and beyond the end [m]
    cant_scale : factor of the sections' cants
    """
    ends = [_ends(sections, i, cant_scale) for i in range(len(sections))]
    bounds = [0.0]
    for section in sections:
        bounds.append(bounds[-1] + section.length)
    for i in range(1, len(sections)):
        for name, unit, old, new in zip(
            ("curvature", "cant", "gauge"), ("1/m", "m", "m"), ends[i - 1][1], ends[i][0], strict=True
        ):
            if old != new:
                raise ValueError(
                    f"{name} jumps from {old:g} to {new:g} {unit} between section {i} and section {i + 1} "
                    f"at s = {bounds[i]:g} m, allowed is 0: put a Transition between them"
                )
    shapes = [SHAPES.index(part.shape) if isinstance(part, Transition) else CLOTHOID for part in sections]
    turn = [
        _Piece(a[0], b[0], bounds[i + 1], shapes[i], *_of_curvature(i, sections[i], a, b))
        for i, (a, b) in enumerate(ends)
    ]
    straight = [CLOTHOID if shape == CUBIC else shape for shape in shapes]
    lift = [_Piece(a[1], b[1], bounds[i + 1], straight[i]) for i, (a, b) in enumerate(ends)]
    width: list[_Piece] = []
    for i, (section, (a, b)) in enumerate(zip(sections, ends, strict=True)):
        if isinstance(section, Transition) and section.gauge is not None:
            width.append(_Piece(a[2], section.gauge, bounds[i] + 0.5 * section.length))
            width.append(_Piece(section.gauge, b[2], bounds[i + 1]))
        else:
            width.append(_Piece(a[2], b[2], bounds[i + 1], straight[i]))
    return PlanCourses(*(_course(pieces, lead_in, run_out) for pieces in (turn, lift, width)))


def grade_course(grades: tuple[Grade, ...], length: float, lead_in: float, run_out: float) -> Course:
    """Course of the gradient; the last one continues to the end of the track.

    Raises ValueError where gradients jump, or where the grades are longer than the sections (`length`, m).

    Parameters
    ----------
    grades : vertical profile, from s = 0 on
    length : of all sections [m]
    lead_in, run_out : as for `plan_courses` [m]
    """
    pieces: list[_Piece] = []
    end = 0.0
    for i, grade in enumerate(grades):
        end += grade.length
        if pieces and pieces[-1][1] != grade.gradient:
            raise ValueError(
                f"gradient jumps from {pieces[-1][1]:g} to {grade.gradient:g} between grade {i} and grade "
                f"{i + 1} at s = {end - grade.length:g} m, allowed is 0: put a Grade with an end between them"
            )
        pieces.append(_Piece(grade.gradient, grade.gradient if grade.end is None else grade.end, end))
    if end > length + 1e-6:
        raise ValueError(f"length of all grades is {end:g} m, allowed is up to {length:g} m of the sections")
    last = pieces[-1][1] if pieces else 0.0
    if length - end > 1e-6:
        pieces.append(_Piece(last, last, length))
    return _course(pieces, lead_in, run_out)


def _ends(sections: tuple[Section, ...], i: int, cant_scale: float) -> tuple[State, State]:
    """State at the beginning and the end of section i, its cant times `cant_scale`."""
    (k0, c0, g0), (k1, c1, g1) = _own_ends(sections, i)
    return (k0, cant_scale * c0, g0), (k1, cant_scale * c1, g1)


def _own_ends(sections: tuple[Section, ...], i: int) -> tuple[State, State]:
    """State at the beginning and the end of section i."""
    section = sections[i]
    if isinstance(section, Ramp):
        return section.states
    if not isinstance(section, Transition):
        return section.state, section.state
    before = sections[i - 1] if i > 0 else None
    behind = sections[i + 1] if i + 1 < len(sections) else None
    if (
        (before is None and behind is None)
        or isinstance(before, Transition)
        or isinstance(behind, Transition)
    ):
        raise ValueError(
            f"section {i + 1} is a Transition whose ends are not defined: a Straight or Curve must "
            "stand between two Transitions, and one alone joins nothing"
        )
    first = None if before is None else (before.states[1] if isinstance(before, Ramp) else before.state)
    last = None if behind is None else (behind.states[0] if isinstance(behind, Ramp) else behind.state)
    # at the start or the end it joins an assumed straight of the same gauge
    straight = (0.0, 0.0, (first or last or (0.0, 0.0, 0.0))[2])
    return first or straight, last or straight


def _of_curvature(i: int, section: Section, first: State, last: State) -> tuple[float, float]:
    """`turn` and `bend` of a section's curvature; ValueError for a cubic parabola that is none."""
    if not isinstance(section, Transition):
        return 0.0, 0.0
    if section.shape == SHAPES[VIENNESE]:
        roll = (last[1] - first[1]) / RAIL_TOP_DISTANCE
        return 0.0, -section.gravity_height * roll / section.length**2
    if section.shape != SHAPES[CUBIC]:
        return 0.0, 0.0
    if first[0] != 0.0 and last[0] != 0.0:
        raise ValueError(
            f"section {i + 1} is a cubic Transition between two curves, allowed is one to a straight"
        )
    turn = section.length * max(abs(first[0]), abs(last[0]))
    if turn > LARGEST_TURN:
        raise ValueError(
            f"section {i + 1} is a cubic Transition of {section.length:g} m to a radius of "
            f"{section.length / turn:g} m, allowed is up to {LARGEST_TURN:g} times the radius"
        )
    return (-turn if last[0] == 0.0 else turn), 0.0


def _course(pieces: list[_Piece], lead_in: float, run_out: float) -> Course:
    """A course with constant pieces before and behind."""
    all_pieces = [
        _Piece(pieces[0].first, pieces[0].first, 0.0),
        *pieces,
        _Piece(pieces[-1].last, pieces[-1].last, pieces[-1].end + run_out),
    ]
    first, last, end, shape, turn, bend = zip(*all_pieces, strict=True)
    return Course(
        np.array([-lead_in, *end]),
        np.array(first),
        np.array(last),
        np.array(shape, dtype=np.int64),
        np.array(turn),
        np.array(bend),
    )


def marks(course: Course, blend: float) -> FloatArray:
    """Arc lengths [m] between which the blended course is one cubic (or a cosine).

    Parameters
    ----------
    course : one quantity along the track
    blend : half length of a blend [m]
    """
    kink, half, _ = _kinks(course, blend)
    middle = 0.5 * (course.at[:-1] + course.at[1:])[course.shape == HELMERT]
    return np.concatenate([course.at, kink - half, kink + half, middle])


def values(course: Course, s: FloatArray, blend: float) -> tuple[FloatArray, FloatArray]:
    """Value and slope of the blended course at increasing arc lengths s (n,).

    Parameters
    ----------
    course : one quantity along the track
    s : (n,) increasing arc lengths [m]
    blend : half length of a blend [m]
    """
    piece = np.clip(np.searchsorted(course.at, s, side="right") - 1, 0, course.shape.size - 1)
    length = np.diff(course.at)[piece]
    change = (course.last - course.first)[piece]
    t = (s - course.at[piece]) / length
    part, slope = share(course.shape[piece], t, course.turn[piece])
    value = course.first[piece] + change * part
    rate = change / length * slope
    if course.bend.any():
        second, third = roll_bend(t)
        value += course.bend[piece] * second
        rate += course.bend[piece] / length * third
    for kink, half, jump in zip(*_kinks(course, blend), strict=True):
        inside = slice(np.searchsorted(s, kink - half), np.searchsorted(s, kink + half, side="right"))
        place = (s[inside] - kink) / half
        size = np.abs(place)
        size[size > 1.0 - 1e-9] = 1.0  # at the ends of the blend by rounding
        # smoothed kink less the kink itself, the same to both sides: F(t) - max(t, 0); its slope is odd
        # = 1/12 - size/2 + 3 size^2/4 - size^3/3, written with its double zero at size = 1
        value[inside] += jump * half * (1.0 - size) ** 2 * (1.0 - 4.0 * size) / 12.0
        rate[inside] += jump * np.where(place < 0.0, 1.0, -1.0) * (0.5 + size * (-1.5 + size))
    return value, rate


def _kinks(course: Course, blend: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Places of the kinks [m], half lengths of their blends [m] and jumps of the slope."""
    length = np.diff(course.at)
    start = share(course.shape, np.zeros(course.shape.size), course.turn)[1]
    end = share(course.shape, np.ones(course.shape.size), course.turn)[1]
    mean = (course.last - course.first) / length
    jump = (mean * start)[1:] - (mean * end)[:-1]
    half = np.minimum(blend, 0.25 * np.minimum(length[1:], length[:-1]))
    kinked = np.abs(jump) > 1e-12 * np.max(np.abs(mean))
    return course.at[1:-1][kinked], half[kinked], jump[kinked]
