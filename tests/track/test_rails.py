"""The two rails: which profile comes from where."""

import math
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.contact.profile import rail_profile, read_rail_profile
from track.rails import (
    GaugeRule,
    RailPair,
    RailRule,
    Rails,
    RailsAlong,
    RailSection,
    known_rail,
    rail_pairs,
)


def test_names_are_standard_profiles_with_the_inclination() -> None:
    rails = Rails("60E1", "60E1", inclination=1.0 / 40.0)
    expected = rail_profile("60E1", inclination=1.0 / 40.0)
    for profile in (rails.left_profile(), rails.right_profile()):
        assert np.array_equal(profile.y, expected.y)
        assert np.array_equal(profile.z, expected.z)
    upright = Rails("60E1", inclination=0.0).left_profile()
    assert not np.array_equal(upright.z, expected.z)


def test_paths_are_read_as_they_lie(tmp_path: Path) -> None:
    """A measured profile keeps the inclination of its file, whatever the rails' own."""
    standard = rail_profile("60E1", inclination=1.0 / 30.0)
    measured = tmp_path / "measured.txt"
    np.savetxt(measured, 1e3 * np.column_stack([standard.y, standard.z]), fmt="%.9f")
    rails = Rails(left=str(measured), right="60E1", inclination=1.0 / 40.0)
    assert np.array_equal(rails.left_profile().z, read_rail_profile(measured).z)
    assert np.array_equal(rails.right_profile().z, rail_profile("60E1", inclination=1.0 / 40.0).z)


def test_bad_input_says_what_is_wrong() -> None:
    with pytest.raises(ValueError, match=r"inclination of Rails is 0.5 \(slope\), allowed are 0 to 0.1"):
        Rails(inclination=0.5)
    with pytest.raises(ValueError, match="no such rail"):
        Rails(left="no such rail").left_profile()


def test_high_rail_is_the_outer_one() -> None:
    pair = RailPair(high="MB1_like", low="60E1")
    left_hand, right_hand = pair.rails("left"), pair.rails("right")
    assert (left_hand.left, left_hand.right) == ("60E1", "MB1_like")
    assert (right_hand.left, right_hand.right) == ("MB1_like", "60E1")
    with pytest.raises(ValueError, match="hand is 'up', allowed are left, right, straight"):
        pair.rails("up")


RULES = (
    RailRule("A", 0.0, 600.0, RailPair("60E2", "60E1")),
    RailRule("A", 600.0, math.inf, RailPair("60E1", "60E1")),
    RailRule("A", math.inf, math.inf, RailPair("54E1", "54E1"), share=0.25),
    RailRule("A", math.inf, math.inf, RailPair("60E1", "60E1"), share=0.75),
    RailRule("A", 0.0, 600.0, RailPair("60E2", "60E1", wear="ground 2015")),
    RailRule("B", 0.0, math.inf, RailPair("54E1", "54E1"), share=0.5),
)


def test_rules_by_country_radius_and_wear() -> None:
    assert rail_pairs(RULES, "A", 599.9) == ((1.0, RailPair("60E2", "60E1")),)
    assert rail_pairs(RULES, "A", 600.0) == ((1.0, RailPair("60E1", "60E1")),)
    straight = rail_pairs(RULES, "A", math.inf)
    assert [(share, pair.high) for share, pair in straight] == [(0.25, "54E1"), (0.75, "60E1")]
    assert rail_pairs(RULES, "A", 300.0, "ground 2015")[0][1].wear == "ground 2015"


@pytest.mark.parametrize(
    ("country", "radius", "wear", "message"),
    [
        ("C", 300.0, "new", "country 'C' has no rails, there are rails for: A, B"),
        ("A", 300.0, "old", "wear state 'old' is not known, there are: ground 2015, new"),
        ("A", 700.0, "ground 2015", "no ground 2015 rails are given for radius 700 m in A"),
        ("B", math.inf, "new", "no new rails are given for straight track in B"),
        ("B", 300.0, "new", "shares of the new rails for radius 300 m in B sum to 50 %, not 100 %"),
    ],
)
def test_rules_say_what_is_missing(country: str, radius: float, wear: str, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        rail_pairs(RULES, country, radius, wear)


def test_gauge_is_linear_in_curvature() -> None:
    rule = GaugeRule((math.inf, 1000.0, 400.0), (1.435, 1.437, 1.445))
    assert rule.at(math.inf) == 1.435
    assert rule.at(2000.0) == pytest.approx(1.436)
    assert rule.at(1000.0 / 1.75) == pytest.approx(1.441)
    assert rule.at(400.0) == rule.at(250.0) == pytest.approx(1.445)
    with pytest.raises(ValueError, match="allowed are inf and falling numbers"):
        GaugeRule((1000.0, 400.0), (1.435, 1.445))
    with pytest.raises(ValueError, match=r"gauge of GaugeRule is 1445.0 m, allowed are 1.4 to 1.5 m"):
        GaugeRule((math.inf,), (1445.0,))
    with pytest.raises(ValueError, match="radius is nan m"):
        rule.at(math.nan)


def test_rails_along_a_track() -> None:
    worn = Rails("54E1", "54E2")
    along = RailsAlong(
        (RailSection(0.0, Rails()), RailSection(100.0, worn, "worn"), RailSection(300.0, Rails()))
    )
    assert [along.at(s).wear for s in (-10.0, 99.9, 100.0, 299.9, 300.0, 1e6)] == [
        "new", "new", "worn", "worn", "new", "new",
    ]  # fmt: skip
    assert along.at(150.0).rails == worn
    with pytest.raises(ValueError, match="start of rail section 2 is 0 m, allowed is behind 0 m"):
        RailsAlong((RailSection(0.0, Rails()), RailSection(0.0, worn)))


def test_a_rail_is_a_known_name_or_a_file(tmp_path: Path) -> None:
    (tmp_path / "high.txt").write_text("0 0\n")
    assert known_rail("MB1_like") == "MB1_like"
    assert known_rail("high.txt", tmp_path) == str((tmp_path / "high.txt").resolve())
    with pytest.raises(
        ValueError, match=r"rail 'MB2' is no file, and not one of the known rails: 54E1, .*MB1_like"
    ):
        known_rail("MB2", tmp_path)
