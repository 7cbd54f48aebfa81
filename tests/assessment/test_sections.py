"""Test sections: straights, transitions and curves apart, whole sections only."""

import math
from itertools import pairwise

import pytest

from hh_exudyn.assessment.sections import cut_sections
from track.course.alignment import Alignment, Curve, Straight, Transition
from track.course.sections import Ramp

WHOLE = Alignment.from_sections(
    [
        Straight(600.0),
        Transition(60.0),
        Curve(230.0, 300.0, "left", 0.1),
        Transition(40.0),
        Curve(150.0, 900.0, "left", 0.02),
        Transition(30.0),
    ]
)


def test_each_kind_has_its_length_and_the_rest_is_left_out() -> None:
    found, left_out = cut_sections(WHOLE, (15.0, 1100.0))
    assert [(part.kind, part.start, part.end) for part in found] == [
        ("straight", 100.0, 350.0),
        ("straight", 350.0, 600.0),
        ("transition", 600.0, 660.0),
        ("curve, below 400 m", 680.0, 750.0),
        ("curve, below 400 m", 750.0, 820.0),
        ("curve, below 400 m", 820.0, 890.0),
        ("transition", 890.0, 930.0),
        ("curve, 600 m and more", 980.0, 1080.0),
    ]
    assert [str(part) for part in left_out] == ["transition from 1080.0 to 1110.0 m, covered for 20.0 m"]
    assert found[3].radius == pytest.approx(300.0)
    assert (found[3].hand, found[0].hand, found[0].radius) == ("left", "", math.inf)
    assert [part.curved for part in found[:4]] == [False, False, False, True]


def test_a_mirrored_track_has_the_same_sections_of_the_other_hand() -> None:
    for one, other in zip(
        cut_sections(WHOLE, (0.0, 1110.0)).sections,
        cut_sections(WHOLE.mirrored(), (0.0, 1110.0)).sections,
        strict=True,
    ):
        assert (one.kind, one.start, one.curvature) == (other.kind, other.start, -other.curvature)


def test_ramps_of_a_survey_are_one_straight_and_one_curve() -> None:
    k = 1.0 / 500.0
    ends = [0.0, 1e-5, -1e-5, 0.0, k, 1.02 * k, 0.99 * k, k]
    ramps = [Ramp(50.0, pair) for pair in pairwise(ends)]
    found = cut_sections(Alignment.from_sections(ramps), (0.0, 350.0), length=70.0).sections
    assert [(part.kind, part.start) for part in found] == [
        ("straight", pytest.approx(10.0)),
        ("straight", pytest.approx(80.0)),
        ("transition", pytest.approx(150.0)),
        ("curve, 400 to 600 m", pytest.approx(210.0)),
        ("curve, 400 to 600 m", pytest.approx(280.0)),
    ]
    assert found[-1].radius == pytest.approx(500.0, rel=0.02)


def test_what_has_no_section_is_named() -> None:
    """A curve of 500 m with 80 m where 100 are asked for, and one that the run did not reach."""
    track = Alignment.from_sections(
        [
            Straight(260.0),
            Transition(40.0),
            Curve(80.0, 500.0, "left"),
            Transition(40.0),
            Straight(50.0),
            Transition(40.0),
            Curve(150.0, 300.0, "right"),
        ]
    )
    cut = cut_sections(track, (0.0, 450.0))
    assert [section.kind for section in cut.sections] == ["straight", "transition", "transition"]
    assert [str(part) for part in cut.left_out] == [
        "curve R 500 m from 300.0 to 380.0 m, 80.0 of 100 m",
        "straight from 420.0 to 450.0 m, 30.0 of 250 m",
        "transition from 470.0 to 510.0 m, covered for 0.0 m",
        "curve R 300 m from 510.0 to 660.0 m, 0.0 of 70 m",
    ]


def test_too_short_tracks_are_refused() -> None:
    with pytest.raises(
        ValueError,
        match=r"test section: straight from 10\.0 to 210\.0 m, 200\.0 of 250 m; a longer run or a shorter",
    ):
        cut_sections(WHOLE, (10.0, 210.0))
    with pytest.raises(ValueError, match=r"section length is 5 m, allowed are 10 to 1000 m"):
        cut_sections(WHOLE, (0.0, 1000.0), length=5.0)
