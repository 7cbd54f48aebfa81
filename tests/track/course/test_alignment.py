"""The alignment against Fresnel integrals, closed circles and exact properties."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.special import fresnel

from hh_exudyn.conventions import RAIL_TOP_DISTANCE
from track.course.alignment import (
    Alignment,
    Curve,
    Section,
    Straight,
    Transition,
    cant_deficiency,
    inclined_locate,
    inclined_rotation,
    track_frame,
)

LINE: list[Section] = [  # lengths that are no multiples of the step, all four kinds of transition
    Straight(30.3, gauge=1.435),
    Transition(61.7),
    Curve(100.1, radius=450.0, hand="left", cant=0.100, gauge=1.445),
    Transition(40.9),
    Curve(55.5, radius=300.0, hand="left", cant=0.120, gauge=1.450),
    Transition(80.2),
    Curve(77.7, radius=600.0, hand="right", cant=0.045, gauge=1.440),
    Transition(33.3),
    Straight(20.0, gauge=1.437),
]


def frames(alignment: Alignment, s: np.ndarray) -> np.ndarray:
    """(n, 7) track frames."""
    return np.array([track_frame(alignment.table, value) for value in s])


def test_the_end_of_a_clothoid_is_the_fresnel_integral() -> None:
    length, radius = 83.37, 287.0
    alignment = Alignment.from_sections([Transition(length), Curve(10.0, radius, "left")])
    scale = math.sqrt(math.pi * radius * length)
    # the origin lies in the middle of a blended kink, so does the end: D b^3 / 240 each, see track.course
    off = 2.0 * alignment.blend**3 / (240.0 * radius * length) + 1e-9
    assert off < 1e-7
    for s in (10.0, 31.234, length - alignment.blend, length):
        sine, cosine = fresnel(s / scale)
        x, y, _, heading, _, curvature, _ = track_frame(alignment.table, s)
        assert abs(x - scale * cosine) < off
        assert abs(y - scale * sine) < off
        assert abs(heading - s**2 / (2.0 * radius * length)) < 1e-12
        assert s == length or abs(curvature - s / (radius * length)) < 1e-15


@pytest.mark.parametrize(("length", "radius"), [(20.0, 100.0), (80.0, 300.0), (150.0, 1000.0)])
def test_blending_moves_nothing_behind_a_clothoid(length: float, radius: float) -> None:
    alignment = Alignment.from_sections(
        [
            Straight(30.0),
            Transition(length),
            Curve(100.0, radius, "right"),
            Transition(length),
            Straight(50.0),
        ]
    )
    scale = math.sqrt(math.pi * radius * length)
    sine, cosine = fresnel(length / scale)
    end, turned = np.array([30.0 + scale * cosine, -scale * sine]), length / (2.0 * radius)
    x, y, *_ = track_frame(alignment.table, 30.0 + length)
    assert math.hypot(x - end[0], y - end[1]) < 1e-6
    # the arc and the second clothoid, which is the first one's mirror image run backwards
    arc = turned + 100.0 / radius
    end += radius * np.array([math.sin(arc) - math.sin(turned), math.cos(arc) - math.cos(turned)])
    last = arc + turned
    back = scale * np.array([cosine, sine])  # from the end, facing back, the curve to the left
    c, n = math.cos(math.pi - last), math.sin(math.pi - last)
    end -= [c * back[0] - n * back[1], n * back[0] + c * back[1]]
    end += 50.0 * np.array([math.cos(last), -math.sin(last)])
    x, y, _, heading, *_ = track_frame(alignment.table, alignment.length)
    assert heading == pytest.approx(-last, abs=1e-12)
    assert math.hypot(x - end[0], y - end[1]) < 1e-8


@pytest.mark.parametrize("step", [0.5, 2.0])
@pytest.mark.parametrize("hand", ["left", "right"])
def test_a_full_circle_closes(hand: str, step: float) -> None:
    radius = 100.0  # the tightest allowed
    alignment = Alignment.from_sections([Curve(2.0 * math.pi * radius, radius, hand, cant=0.1)], step=step)
    x, y, z, heading, _, _, _ = track_frame(alignment.table, alignment.length)
    sign = 1.0 if hand == "left" else -1.0
    assert math.hypot(x, y) < 1e-8
    assert z == 0.0
    assert abs(heading - sign * 2.0 * math.pi) < 1e-12
    x, y, *_ = track_frame(alignment.table, 0.25 * alignment.length)
    assert math.hypot(x - radius, y - sign * radius) < 1e-8
    # lead-in and run-out lie on the same circle
    for s in (-50.0, alignment.length + 50.0):
        x, y, *_ = track_frame(alignment.table, s)
        assert abs(math.hypot(x, y - sign * radius) - radius) < 1e-8


def test_the_line_starts_in_the_origin_along_x() -> None:
    alignment = Alignment.from_sections(LINE)
    assert track_frame(alignment.table, 0.0)[:5] == (0.0, 0.0, 0.0, 0.0, 0.0)
    assert track_frame(alignment.table, -50.0)[:3] == pytest.approx((-50.0, 0.0, 0.0), abs=1e-12)


def test_frames_are_continuous_across_nodes() -> None:
    alignment = Alignment.from_sections(LINE)
    s = alignment.table.s[1:-1]
    tiny = 1e-10
    before, behind = frames(alignment, s - tiny), frames(alignment, s + tiny)
    change = behind - before
    change[:, 0] -= 2.0 * tiny * np.cos(before[:, 3])
    change[:, 1] -= 2.0 * tiny * np.sin(before[:, 3])
    assert np.abs(change).max() < 1e-11


def test_frames_agree_with_a_numerical_integration_of_the_curvature() -> None:
    alignment = Alignment.from_sections(LINE)
    bounds = np.cumsum([0.0] + [section.length for section in LINE])
    nodes, weights = np.polynomial.legendre.leggauss(6)
    x = y = 0.0
    s = alignment.table.s
    for a, b in pairwise(s[(s >= 0.0) & (s <= bounds[-1])]):  # x and y from the headings, cell by cell
        heading = frames(alignment, 0.5 * (a + b) + 0.5 * (b - a) * nodes)[:, 3]
        x += 0.5 * (b - a) * weights @ np.cos(heading)
        y += 0.5 * (b - a) * weights @ np.sin(heading)
        assert track_frame(alignment.table, b)[:2] == pytest.approx((x, y), abs=1e-10)
    mean = [
        0.0,
        1 / 900,
        1 / 450,
        (1 / 450 + 1 / 300) / 2,
        1 / 300,
        (1 / 300 - 1 / 600) / 2,
        -1 / 600,
        -1 / 1200,
        0,
    ]
    turned = np.cumsum([c * section.length for c, section in zip(mean, LINE, strict=True)])
    assert frames(alignment, bounds[1:])[:, 3] == pytest.approx(turned, abs=1e-12)


def test_the_nodes_lie_on_the_line() -> None:
    alignment = Alignment.from_sections(LINE)
    table = alignment.table
    at_nodes = frames(alignment, table.s)
    for column, values in zip(
        (0, 1, 3, 5, 6), (table.x, table.y, table.heading, table.curvature, table.gauge), strict=True
    ):
        assert at_nodes[:, column] == pytest.approx(values, abs=1e-12)
    assert np.sin(-at_nodes[:, 4]) * RAIL_TOP_DISTANCE == pytest.approx(table.cant, abs=1e-15)
    assert np.diff(table.s).max() <= table.step * (1.0 + 1e-9)
    assert set(np.cumsum([0.0] + [section.length for section in LINE])) <= set(table.s)


def test_curvature_cant_and_gauge_are_linear_in_sections_but_for_the_blended_kinks() -> None:
    alignment = Alignment.from_sections(LINE)
    bounds = np.cumsum([0.0] + [section.length for section in LINE])
    curvature = [0, 0, 1 / 450, 1 / 450, 1 / 300, 1 / 300, -1 / 600, -1 / 600, 0, 0]
    cant = [0, 0, 0.100, 0.100, 0.120, 0.120, -0.045, -0.045, 0, 0]
    gauge = [1.435, 1.435, 1.445, 1.445, 1.450, 1.450, 1.440, 1.440, 1.437, 1.437]
    s = np.linspace(-50.0, alignment.length + 50.0, 4321)
    s = s[np.abs(s[:, None] - bounds).min(axis=1) >= alignment.blend]
    got = frames(alignment, s)
    assert got[:, 5] == pytest.approx(np.interp(s, bounds, curvature), abs=1e-15)
    height = RAIL_TOP_DISTANCE * np.sin(-got[:, 4])  # of the right rail over the left
    assert height == pytest.approx(np.interp(s, bounds, cant), abs=1e-15)
    assert got[:, 6] == pytest.approx(np.interp(s, bounds, gauge), abs=1e-14)


def test_the_gauge_of_a_transition_is_that_at_its_middle() -> None:
    alignment = Alignment.from_sections(
        [Straight(10.0), Transition(20.0, gauge=1.450), Straight(10.0, 1.445)]
    )
    gauge = frames(alignment, np.array([9.5, 15.0, 19.5, 20.5, 25.0, 30.5]))[:, 6]
    assert gauge == pytest.approx([1.435, 1.4425, 1.44925, 1.44975, 1.4475, 1.445], abs=1e-14)
    assert track_frame(alignment.table, 20.0)[6] == pytest.approx(1.450, abs=1e-4)


@pytest.mark.parametrize(("hand", "outer"), [("left", -1.0), ("right", 1.0)])
def test_cant_raises_the_outer_rail(hand: str, outer: float) -> None:
    alignment = Alignment.from_sections([Curve(100.0, 400.0, hand, cant=0.15)])
    _, _, _, heading, roll, curvature, _ = track_frame(alignment.table, 70.0)
    turn = np.empty((3, 3))
    inclined_rotation(heading, 0.0, roll, turn)
    half = 0.5 * RAIL_TOP_DISTANCE
    outer_rail, inner_rail = turn @ [0.0, outer * half, 0.0], turn @ [0.0, -outer * half, 0.0]
    assert outer_rail[2] - inner_rail[2] == pytest.approx(0.15, abs=1e-15)
    assert curvature * outer < 0.0
    assert turn @ turn.T == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(turn) == pytest.approx(1.0, abs=1e-14)
    assert turn[:, 0] == pytest.approx([math.cos(heading), math.sin(heading), 0.0], abs=1e-15)


def test_the_mirror_image_is_exact() -> None:
    alignment = Alignment.from_sections(LINE)
    s = np.linspace(-50.0, alignment.length + 50.0, 999)
    straight, mirror = frames(alignment, s), frames(alignment.mirrored(), s)
    assert np.array_equal(mirror, straight * [1, -1, 1, -1, -1, -1, 1])
    assert alignment.mirrored() != alignment
    assert alignment.mirrored().mirrored() == alignment


def test_locate_finds_the_foot_of_the_perpendicular_also_on_canted_track() -> None:
    alignment = Alignment.from_sections(LINE)
    random = np.random.default_rng(1)
    turn = np.empty((3, 3))
    for s in random.uniform(-45.0, alignment.length + 45.0, 500):
        x, y, z, heading, roll, _, _ = track_frame(alignment.table, s)
        inclined_rotation(heading, 0.0, roll, turn)
        point = np.array([x, y, z]) + turn @ [0.0, random.uniform(-2, 2), random.uniform(0, 3)]
        found = inclined_locate(alignment.table, *point, s + random.uniform(-3.0, 3.0))
        assert abs(found - s) < 1e-10


def test_outside_the_table_there_is_no_track() -> None:
    alignment = Alignment((Straight(10.0),), lead_in=5.0, run_out=7.0)
    assert track_frame(alignment.table, -5.0)[0] == pytest.approx(-5.0)
    assert track_frame(alignment.table, 17.0)[0] == pytest.approx(17.0)
    for s in (-5.001, 17.001, math.nan, math.inf):
        assert all(math.isnan(value) for value in track_frame(alignment.table, s))
        assert math.isnan(inclined_locate(alignment.table, 3.0, 0.0, 0.0, s))
    assert math.isnan(inclined_locate(alignment.table, 17.5, 0.0, 0.0, 16.0))


def test_sections_shorter_than_the_step_are_found() -> None:
    sections = [Straight(0.1), Transition(0.15), Curve(0.12, 500.0, "left"), Transition(0.2), Straight(3.0)]
    alignment = Alignment.from_sections(sections, step=2.0)
    assert track_frame(alignment.table, 0.3)[5] == 1.0 / 500.0
    assert track_frame(alignment.table, 0.175)[5] == pytest.approx(0.5 / 500.0, rel=1e-12)
    assert track_frame(alignment.table, 1.0)[5] == 0.0


def test_section_at() -> None:
    alignment = Alignment.from_sections(LINE)
    assert alignment.section_at(0.0) is LINE[0]
    assert alignment.section_at(30.3) is LINE[1]
    assert alignment.section_at(alignment.length) is LINE[-1]
    with pytest.raises(ValueError, match=r"s is -0.1 m, allowed are 0 to"):
        alignment.section_at(-0.1)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Curve(10.0, 99.0, "left"), r"radius of a Curve is 99.0 m, allowed are 100 to 100000 m"),
        (lambda: Curve(10.0, math.nan, "left"), r"radius of a Curve is nan m"),
        (lambda: Curve(10.0, 500.0, "left", cant=0.2), r"cant of a Curve is 0.2 m, allowed are 0 to 0.18 m"),
        (lambda: Curve(10.0, 500.0, "left", cant=-0.1), r"cant of a Curve is -0.1 m"),
        (lambda: Curve(10.0, 500.0, "up"), r"hand of a Curve is 'up', allowed are \"left\" and \"right\""),
        (lambda: Straight(0.0), r"length of a Straight is 0.0 m"),
        (lambda: Straight(10.0, gauge=1.8), r"gauge of a Straight is 1.8 m, allowed are 0.9 to 1.75 m"),
        (lambda: Transition(-3.0), r"length of a Transition is -3.0 m"),
        (lambda: Transition(3.0, gauge=0.8), r"gauge of a Transition is 0.8 m"),
        (lambda: Alignment.from_sections([]), r"sections is empty"),
        (
            lambda: Alignment.from_sections([Straight(9.0)], step=0.0),
            r"step is 0.0 m, allowed are 0.05 to 2 m",
        ),
        (lambda: Alignment.from_sections([Transition(9.0)]), r"section 1 is a Transition whose ends"),
        (
            lambda: Alignment.from_sections([Straight(9.0), Transition(9.0), Transition(9.0), Straight(9.0)]),
            r"section 2 is a Transition whose ends",
        ),
        (
            lambda: Alignment.from_sections([Straight(9.0), Curve(9.0, 500.0, "right")]),
            r"curvature jumps from 0 to -0.002 1/m between section 1 and section 2 at s = 9 m",
        ),
        (
            lambda: Alignment.from_sections(
                [Curve(9.0, 500.0, "left", 0.1), Curve(9.0, 500.0, "left", 0.05)]
            ),
            r"cant jumps from 0.1 to 0.05 m between section 1 and section 2",
        ),
        (
            lambda: Alignment.from_sections([Straight(5.0), Straight(5.0, gauge=1.44)]),
            r"gauge jumps from 1.435 to 1.44 m between section 1 and section 2",
        ),
        (lambda: cant_deficiency(-1.0, 500.0), r"speed is -1.0 m/s"),
    ],
)
def test_bad_input_says_what_is_wrong(make: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()  # type: ignore[operator]


def test_an_alignment_is_a_value() -> None:
    assert Alignment.from_sections(LINE) == Alignment.from_sections(LINE)
    assert hash(Alignment.from_sections(LINE)) == hash(Alignment.from_sections(LINE))
    assert replace(Alignment.from_sections(LINE), lead_in=80.0).table.start == -80.0


def test_cant_deficiency_is_that_of_en_13803() -> None:
    # EN 13803: 11.8 V^2 / R - cant in mm with V in km/h; 11.8 is rounded from 11.798
    assert cant_deficiency(60.0 / 3.6, 500.0, 0.050) == pytest.approx(
        11.8e-3 * 60.0**2 / 500.0 - 0.050, abs=2e-5
    )
    assert cant_deficiency(0.0, 500.0, 0.050) == -0.050
