"""What moves along an alignment feels what the formulas say: v^2/R, cant, gradient; loops close."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hh_exudyn.conventions import GRAVITY, RAIL_TOP_DISTANCE
from track.course.alignment import (
    Alignment,
    inclined_frame,
    inclined_locate,
    inclined_rotation,
    track_frame,
)
from track.course.sections import SHAPES, Curve, Grade, Ramp, Section, Straight, Transition

HAND = st.sampled_from(["left", "right"])
CURVE = st.builds(
    Curve,
    st.floats(20.0, 150.0),
    st.floats(150.0, 2000.0),
    HAND,
    st.floats(0.0, 0.15),
    st.floats(1.435, 1.45),
)
STRAIGHT = st.builds(Straight, st.floats(5.0, 100.0), st.floats(1.435, 1.445))


@st.composite
def alignments(draw: st.DrawFn) -> Alignment:
    """Any row of straights and curves, compound and reverse, with transitions of all shapes, on grades."""
    bodies = draw(st.lists(st.one_of(CURVE, STRAIGHT), min_size=2, max_size=4))
    sections: list[Section] = [bodies[0]]
    for body in bodies[1:]:
        length, shape = (
            draw(st.floats(15.0, 120.0)),
            draw(st.sampled_from(SHAPES[:-1])),
        )  # a cubic needs a straight
        sections += [Transition(length, shape=shape), body]
    slopes = draw(st.lists(st.floats(-0.02, 0.02), min_size=1, max_size=3))
    share = math.fsum(section.length for section in sections) / (2 * len(slopes))
    grades = [Grade(share, slopes[0])]
    for wanted in slopes[1:]:
        before = grades[-1].gradient
        end = before + min(max(wanted - before, -share / 600.0), share / 600.0)
        grades += [Grade(share, before, end), Grade(share, end)]
    return Alignment.from_sections(sections, grades=grades)


def origin(alignment: Alignment, s: float) -> np.ndarray:
    return np.array(track_frame(alignment.table, s)[:3])


@settings(max_examples=40, deadline=None)
@given(alignments(), st.floats(0.02, 0.98))
def test_acceleration_at_constant_speed_is_curvature_and_vertical_curvature(
    alignment: Alignment, at: float
) -> None:
    s, v, h = at * alignment.length, 20.0, 0.02
    points = [origin(alignment, s + k * h) for k in range(-2, 3)]
    second = (-points[0] + 16 * points[1] - 30 * points[2] + 16 * points[3] - points[4]) / (12 * h**2)
    _, _, _, heading, pitch, _, curvature, _ = inclined_frame(alignment.table, s)
    near = 0.005
    before, behind = (math.tan(-inclined_frame(alignment.table, s + k)[4]) for k in (-near, near))
    aside = np.array([-math.sin(heading), math.cos(heading), 0.0])
    expected = v**2 * (curvature * aside + np.array([0.0, 0.0, (behind - before) / (2 * near)]))
    # v^2/R is 0.2 to 2.7 m/s^2. Rounding of positions takes 4e-6; in the sharpest blends, where the rate of
    # curvature or gradient rises by 2e-3 1/m^2 over 1 m, the differences themselves take some 3e-5
    assert v**2 * second == pytest.approx(expected, abs=1e-4)
    slope = (origin(alignment, s + near) - origin(alignment, s - near)) / (2 * near)
    assert slope == pytest.approx([math.cos(heading), math.sin(heading), -math.tan(pitch)], abs=1e-7)


@settings(max_examples=25, deadline=None)
@given(alignments())
def test_rates_of_curvature_cant_gauge_and_gradient_are_continuous(alignment: Alignment) -> None:
    tiny, s = 1e-6, alignment.table.s[1:-1]

    def state(at: np.ndarray) -> np.ndarray:
        rows = np.array([inclined_frame(alignment.table, value) for value in at])
        return np.column_stack([rows[:, 6], np.sin(rows[:, 5]), rows[:, 7], np.tan(rows[:, 4])])

    before = (state(s) - state(s - tiny)) / tiny
    behind = (state(s + tiny) - state(s)) / tiny
    # a kink of a clothoid has 1e-5 1/m^2, of a cant or gauge ramp 1e-4; the second derivative inside a blend
    # is 3 D / b, that is 6e-3 1/m * tiny; and 1e-16 of rounding over tiny
    largest = np.abs(before).max(axis=0)
    assert (np.abs(behind - before).max(axis=0) < 1e-4 * largest + 1e-9).all()


@settings(max_examples=25, deadline=None)
@given(alignments())
def test_the_mirror_image_of_any_alignment_is_exact(alignment: Alignment) -> None:
    other = alignment.mirrored().table
    for s in np.linspace(alignment.table.start, alignment.table.end, 57):
        x, y, z, heading, pitch, roll, curvature, gauge = inclined_frame(alignment.table, s)
        assert inclined_frame(other, s) == (x, -y, z, -heading, pitch, -roll, -curvature, gauge)


@settings(max_examples=25, deadline=None)
@given(alignments(), st.floats(0.0, 1.0), st.floats(-2.0, 2.0), st.floats(-0.5, 4.0), st.floats(-3.0, 3.0))
def test_a_point_across_any_track_is_located(
    alignment: Alignment, at: float, y: float, z: float, error: float
) -> None:
    s = at * alignment.length
    *place, heading, pitch, roll, _, _ = inclined_frame(alignment.table, s)
    turn = np.empty((3, 3))
    inclined_rotation(heading, pitch, roll, turn)
    assert turn @ turn.T == pytest.approx(np.eye(3), abs=1e-15)
    point = place + turn @ [0.0, y, z]
    assert abs(inclined_locate(alignment.table, *point, s + error) - s) < 1e-9


@pytest.mark.parametrize("hand", ["left", "right"])
def test_a_point_mass_in_a_canted_curve_feels_the_cant_deficiency(hand: str) -> None:
    radius, cant, v = 450.0, 0.090, 60.0 / 3.6
    sections = [Straight(50.0), Transition(60.0), Curve(200.0, radius, hand, cant)]
    alignment = Alignment.from_sections(sections, grades=[Grade(310.0, 0.004)])
    s, h = 210.0, 0.02
    acceleration = (origin(alignment, s + h) - 2 * origin(alignment, s) + origin(alignment, s - h)) * (
        v / h
    ) ** 2
    *_, heading, pitch, roll, _, _ = inclined_frame(alignment.table, s)
    turn = np.empty((3, 3))
    inclined_rotation(heading, pitch, roll, turn)
    felt = turn.T @ (acceleration + np.array([0.0, 0.0, GRAVITY]))  # what a point mass is pushed with
    sign = 1.0 if hand == "left" else -1.0
    lift = cant / RAIL_TOP_DISTANCE
    level, fall = math.sqrt(1.0 - lift**2), math.atan(0.004)
    assert felt[0] == pytest.approx(GRAVITY * math.sin(fall), abs=1e-6)
    assert felt[1] == pytest.approx(
        sign * (v**2 / radius * level - GRAVITY * lift * math.cos(fall)), abs=1e-6
    )
    assert felt[2] == pytest.approx(v**2 / radius * lift + GRAVITY * level * math.cos(fall), abs=1e-6)


SNAKE = Alignment.from_sections(
    [
        Straight(50.0),
        Transition(60.0),
        Curve(80.0, 500.0, "left", 0.09),  # from 110 m
        Transition(40.0),
        Curve(60.0, 300.0, "left", 0.12),  # from 230 m
        Transition(100.0, shape="bloss"),
        Curve(60.0, 400.0, "right", 0.10),  # from 390 m
        Transition(60.0, shape="cosine"),
        Straight(40.0),
    ],
    grades=[
        Grade(30.0, 0.0),
        Grade(100.0, 0.0, 0.010),  # R = 10000 m
        Grade(170.0, 0.010),
        Grade(120.0, 0.010, -0.014),  # from 300 m, R = -5000 m
        Grade(130.0, -0.014),
    ],
)
AT_A_QUARTER = 3 / 16 - 1 / 32  # 3 t^2 - 2 t^3 of Bloss


@pytest.mark.parametrize(
    ("s", "curvature", "cant", "gradient", "bend"),  # by hand
    [
        (20.0, 0.0, 0.0, 0.0, 0.0),
        (80.0, 1 / 1000, 0.045, 0.005, 1e-4),  # middle of the clothoid, in the sag
        (150.0, 1 / 500, 0.09, 0.010, 0.0),
        (210.0, 0.5 * (1 / 500 + 1 / 300), 0.105, 0.010, 0.0),  # compound
        (260.0, 1 / 300, 0.12, 0.010, 0.0),
        (315.0, 1 / 300 - AT_A_QUARTER * (1 / 300 + 1 / 400), 0.12 - AT_A_QUARTER * 0.22, 0.007, -2e-4),
        (430.0, -1 / 400, -0.10, -0.014, 0.0),
        (480.0, -1 / 800, -0.05, -0.014, 0.0),
        (530.0, 0.0, 0.0, -0.014, 0.0),
    ],
)
def test_a_point_mass_on_any_track_feels_curve_cant_and_vertical_curve_in_t(
    s: float, curvature: float, cant: float, gradient: float, bend: float
) -> None:
    """At constant speed u along T's x axis: u^2 kappa and u^2 kappa_v + g, turned by cant and slope."""
    u, h = 60.0 / 3.6, 0.02

    def axes(at: float) -> np.ndarray:
        *_, heading, pitch, roll, _, _ = inclined_frame(SNAKE.table, at)
        turn = np.empty((3, 3))
        inclined_rotation(heading, pitch, roll, turn)
        return turn

    level = 1.0 / math.hypot(1.0, gradient)  # cosine of the slope: plan over path
    acceleration = u**2 * level * (axes(s + h) - axes(s - h))[:, 0] / (2.0 * h)
    felt = axes(s).T @ (acceleration + np.array([0.0, 0.0, GRAVITY]))
    lift = -cant / RAIL_TOP_DISTANCE  # sine of the roll
    flat = math.sqrt(1.0 - lift**2)
    sideways = (u * level) ** 2 * curvature
    upwards = u**2 * bend * level**3 + GRAVITY * level
    assert felt[0] == pytest.approx(GRAVITY * gradient * level, abs=1e-6)
    assert felt[1] == pytest.approx(sideways * flat + upwards * lift, abs=1e-6)
    assert felt[2] == pytest.approx(upwards * flat - sideways * lift, abs=1e-6)


def test_a_loop_of_ten_kilometres_closes_within_a_millimetre() -> None:
    """Four corners, each of a compound and a reverse curve, that turn by a right angle together."""
    clothoid, sharp, wide, back = 80.0, 400.0, 900.0, 700.0
    turned = (
        0.5 * clothoid / sharp  # in
        + 0.5 * clothoid * (1 / sharp + 1 / wide)
        + 300.0 / wide
        + 0.5 * clothoid * (1 / wide - 1 / back)
        - 150.0 / back
        - 0.5 * clothoid / back
    )
    arc = sharp * (0.5 * math.pi - turned)
    corner: list[Section] = [
        Transition(clothoid),
        Curve(arc, sharp, "left", 0.1),
        Transition(clothoid),
        Curve(300.0, wide, "left", 0.05),
        Transition(clothoid),
        Curve(150.0, back, "right", 0.06),
        Transition(clothoid),
    ]
    rest = 2500.0 - math.fsum(section.length for section in corner)
    alignment = Alignment.from_sections(
        [Straight(rest), *corner] * 4, grades=[Grade(5000, 0.0), Grade(5000, 0.0)]
    )
    assert alignment.length == pytest.approx(10e3, abs=1e-6)
    x, y, z, heading, *_ = track_frame(alignment.table, alignment.length)
    assert math.hypot(x, y) < 1e-6  # asked for: 1e-3
    assert z == 0.0
    assert heading == pytest.approx(2.0 * math.pi, abs=1e-11)


def test_grades_and_vertical_curves_are_parabolas() -> None:
    grades = [Grade(100.0, 0.006), Grade(80.0, 0.006, -0.010), Grade(120.0, -0.010)]
    alignment = Alignment.from_sections([Straight(500.0)], grades=grades)
    for s, z in (
        (60.0, 0.36),
        (140.0, 0.6 + 0.006 * 40 - 0.0001 * 40**2),
        (180.0, 0.6 - 0.002 * 80),
        (480.0, -2.56),
    ):
        assert track_frame(alignment.table, s)[2] == pytest.approx(z, abs=1e-6)
    pitch = inclined_frame(alignment.table, 160.0)[4]
    assert pitch == pytest.approx(
        math.atan(0.006), abs=1e-12
    )  # negative uphill, here it falls by 6 per mille
    assert track_frame(alignment.table, -20.0)[2] == pytest.approx(-0.12, abs=1e-9)


@pytest.mark.parametrize(
    ("shape", "at_quarter"), [("helmert", 0.125), ("bloss", 0.15625), ("cosine", 0.1464466)]
)
def test_smooth_transitions_turn_as_much_as_a_clothoid(shape: str, at_quarter: float) -> None:
    alignment = Alignment.from_sections(
        [Straight(20.0), Transition(100.0, shape=shape), Curve(50.0, 400.0, "left", 0.1)]
    )
    _, _, _, _, roll, curvature, _ = track_frame(alignment.table, 45.0)
    assert curvature * 400.0 == pytest.approx(at_quarter, abs=1e-7)
    assert -math.sin(roll) * RAIL_TOP_DISTANCE == pytest.approx(0.1 * at_quarter, abs=1e-8)
    assert track_frame(alignment.table, 120.0)[3] == pytest.approx(100.0 / 800.0, abs=1e-9)


def test_ramps_are_transitions_with_their_ends_written_out() -> None:
    first, second = Curve(50.0, 500.0, "left", 0.1), Curve(50.0, 300.0, "right", 0.12, 1.445)
    ramp = Ramp(70.0, (1 / 500, -1 / 300), (0.1, -0.12), (1.435, 1.445))
    one = Alignment.from_sections([first, Transition(70.0), second]).table
    other = Alignment.from_sections([first, ramp, second]).table
    assert np.array_equal(one.nodes, other.nodes)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Grade(100.0, 0.06), r"gradient of a Grade is 0.06 \(slope\), allowed are -0.05 to 0.05"),
        (lambda: Grade(4.0, 0.0, 0.01), r"vertical radius of a Grade is 400 m, allowed are 500 m and more"),
        (lambda: Ramp(9.0, (0.0, 0.02)), r"curvature of a Ramp is 0.02 1/m, allowed are -0.01 to 0.01 1/m"),
        (
            lambda: Ramp(9.0, (0.0, -0.002), (0.0, 0.1)),
            r"cant of a Ramp is 0.1 m where its curvature is -0.002",
        ),
        (
            lambda: Transition(50.0, shape="klein"),
            r"shape of a Transition is 'klein', allowed are clothoid, helm",
        ),
        (
            lambda: Alignment((Straight(90.0),), grades=(Grade(50.0, 0.0), Grade(40.0, 0.01))),
            r"gradient jumps from 0 to 0.01 between grade 1 and grade 2 at s = 50 m",
        ),
        (
            lambda: Alignment((Straight(90.0),), grades=(Grade(100.0, 0.0),)),
            r"length of all grades is 100 m, allowed is up to 90 m",
        ),
        (lambda: Alignment((Straight(90.0),), blend=0.0), r"blend is 0.0 m, allowed are 0.01 to 5 m"),
    ],
)
def test_bad_input_says_what_is_wrong(make: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()  # type: ignore[operator]
