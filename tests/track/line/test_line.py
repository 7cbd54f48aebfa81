"""A line as weighted track sections: Malmbanan against the thesis, a made-up line, and files with faults."""

import csv
import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.contact.profile import rail_profile
from track.course.alignment import track_frame
from track.irregularity.quality import CLASSES
from track.line.line import TrackSection, load_sections, read_line

REFERENCE = Path(__file__).parents[2] / "reference" / "hossein_nia_2018_line.csv"
QUARRY = Path(__file__).parent / "quarry_line.toml"
LOADED = "iore_wagon_loaded"


def table() -> list[dict[str, str]]:
    lines = [line for line in REFERENCE.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def weight(sections: tuple[TrackSection, ...], **wanted: str) -> float:
    return math.fsum(s.weight for s in sections if all(getattr(s, k) == v for k, v in wanted.items()))


def test_weights_reproduce_the_curve_table() -> None:
    """Weights times length are the lengths of Table 1-3, radii and cants are its means."""
    line = read_line("malmbanan")
    sections = load_sections(line, LOADED)
    assert math.fsum(s.weight for s in sections) == pytest.approx(1.0, abs=1e-12)
    assert all(s.weight > 0.0 for s in sections)
    for row in table():
        length = weight(sections, name=row["class"], hand=row["hand"]) * line.length
        assert length == pytest.approx(float(row["share_percent"]) / 100.0 * 500e3, rel=1e-9)
        mine = [s for s in sections if (s.name, s.hand) == (row["class"], row["hand"])]
        assert {s.radius for s in mine} == {float(row["radius_m"])}
        assert {round(1e3 * s.cant, 9) for s in mine} == {float(row["cant_mm"])}
    curves = math.fsum(s.weight for s in sections if s.hand != "straight")
    assert curves == pytest.approx(0.5, abs=0.005)  # T 1.1.3: around 50 % of curves with radii below 1000 m


def test_weights_reproduce_the_quality_table() -> None:
    """Table 1-6, to the rounding of its per cents (one row sums to 99)."""
    sections = load_sections(read_line("malmbanan"), LOADED)
    for row in table():
        whole = weight(sections, name=row["class"], hand=row["hand"])
        for quality, key in zip(CLASSES, ("qn1", "qn2", "qn3", "worse"), strict=True):
            part = weight(sections, name=row["class"], hand=row["hand"], quality=quality)
            assert 100.0 * part / whole == pytest.approx(float(row[key]), abs=0.5)


def test_countries() -> None:
    """Three quarters of the curves below 450 m lie in Norway (T 1.1.3), which has 42 of 477 km."""
    sections = load_sections(read_line("malmbanan"), LOADED)
    tight = [s for s in sections if s.radius < 450.0]
    in_norway = math.fsum(s.weight for s in tight if s.country == "Norway")
    assert in_norway / math.fsum(s.weight for s in tight) == pytest.approx(0.75)
    assert weight(sections, country="Norway") == pytest.approx(42.0 / 477.0, abs=0.001)


def test_rails_of_table_1_7() -> None:
    sections = load_sections(read_line("malmbanan"), LOADED)
    for s in sections:
        pair = (s.pair.high, s.pair.low)
        if s.country == "Norway":
            assert pair == (("MB1_like" if s.radius < 600.0 else "MB4_like"), "MB4_like")
        elif s.hand != "straight":
            assert pair == ("MB1_like", "60E1")
        else:
            assert pair in {("MB4_like", "MB4_like"), ("60E1", "60E1")}
        outer = {"left": s.rails.right, "right": s.rails.left, "straight": s.pair.high}[s.hand]
        assert outer == s.pair.high
    swedish = next(s for s in sections if s.country == "Sweden" and s.hand == "left")
    expected = rail_profile("60E1", inclination=1.0 / 30.0)  # T figure 1-12
    assert np.array_equal(swedish.rails.left_profile().z, expected.z)


def test_speeds_and_cant_deficiency() -> None:
    """60, 70 and 80 km/h at most; in tight curves no more than the largest cant deficiency allows."""
    line = read_line("malmbanan")
    for vehicle, largest in ((LOADED, 60.0), ("iore_wagon_empty", 70.0), ("iore_locomotive", 80.0)):
        sections = load_sections(line, vehicle)
        assert max(3.6 * s.speed for s in sections) == pytest.approx(largest)
        for s in sections:
            assert s.cant_deficiency <= 0.100 + 1e-9
            if 3.6 * s.speed < largest - 1e-6:  # five km/h more would be too fast
                faster = 11.8 * (3.6 * s.speed + 5.0) ** 2 / s.radius - 1e3 * s.cant  # mm, EN 13803
                assert faster > 100.0
    loaded = load_sections(line, LOADED)
    assert {round(3.6 * s.speed, 9) for s in loaded} == {60.0}
    # 11.8 x 60^2 / 305 - 68 mm, EN 13803
    assert max(s.cant_deficiency for s in loaded) == pytest.approx(0.0713, abs=1e-4)


def test_gauge_is_wide_in_tight_curves() -> None:
    sections = load_sections(read_line("malmbanan"), LOADED, quality="QN1")
    assert {s.gauge for s in sections if s.radius < 450.0} == {1.445}
    by_radius = sorted(sections, key=lambda s: s.radius)
    assert all(a.gauge >= b.gauge for a, b in pairwise(by_radius))


@pytest.mark.parametrize("name", ["malmbanan", str(QUARRY)])
def test_every_section_is_a_track(name: str) -> None:
    """Curvature, cant and gauge of the curve are reached behind the transition, with the right signs."""
    for s in load_sections(read_line(name), LOADED, quality="QN1"):
        alignment = s.alignment(length=120.0, approach=40.0)
        _, y, _, _, roll, curvature, gauge = track_frame(alignment.table, alignment.length - 1.0)
        assert gauge == pytest.approx(s.gauge)
        sign = {"left": 1.0, "right": -1.0, "straight": 0.0}[s.hand]
        assert curvature == pytest.approx(sign / s.radius)
        assert -math.sin(roll) * 1.5 == pytest.approx(sign * s.cant)
        assert math.copysign(1.0, y) == sign or y == 0.0
        start = track_frame(alignment.table, 0.0)
        assert (start[4], start[5]) == (0.0, 0.0)
        assert start[6] == pytest.approx(s.straight_gauge)


def test_returning_and_one_quality() -> None:
    line = read_line("malmbanan")
    there, back = load_sections(line, LOADED), load_sections(line, LOADED, returning=True)
    assert weight(back, hand="left") == pytest.approx(weight(there, hand="right"))
    assert weight(back, hand="straight") == pytest.approx(weight(there, hand="straight"))
    assert (back[0].hand, back[0].rails.left) == ("right", there[0].rails.right)
    fewer = load_sections(line, LOADED, quality="QN3")
    assert {s.quality for s in fewer} == {"QN3"}
    assert math.fsum(s.weight for s in fewer) == pytest.approx(1.0)
    assert len(fewer) < len(there)


def test_guesses_can_be_listed() -> None:
    line = read_line("malmbanan")
    assert set(line.assumed()) > {"gauge", "transition", "curve_speed", "quality.straight"}
    assert not any(place.startswith("curve.") for place in line.assumed())  # Table 1-3 is published
    assert line.line_quality == pytest.approx((0.29, 0.23, 0.43, 0.05))


def test_another_line() -> None:
    """The made-up line; every expected number is worked out from its file by hand."""
    line = read_line(QUARRY)
    sections = load_sections(line, LOADED)
    assert math.fsum(s.weight for s in sections) == pytest.approx(1.0)
    assert weight(sections, name="wide", hand="right") == 0.0
    assert weight(sections, name="tight", hand="left", quality="QN2") * line.length == pytest.approx(360.0)
    tight = next(s for s in sections if (s.name, s.hand) == ("tight", "left"))
    # sqrt((40 + 80) 200 / 11.8) = 45.1 km/h, in steps of 5
    assert 3.6 * tight.speed == pytest.approx(45.0)
    assert tight.transition == pytest.approx(20.0)  # 1 : 500 of 40 mm
    assert next(s for s in sections if s.name == "wide").transition == 15.0  # the shortest
    assert next(s for s in sections if s.name == "wide").gauge == pytest.approx(1.439)  # half the curvature
    assert tight.gauge == pytest.approx(1.442)


def test_measured_worn_rails(tmp_path: Path) -> None:
    """A measured rail is a path relative to the line's file, and a wear state of its own."""
    standard = rail_profile("60E1", inclination=1.0 / 40.0)
    np.savetxt(tmp_path / "worn.txt", 1e3 * np.column_stack([standard.y, standard.z]), fmt="%.9f")
    rows = "".join(
        f'\n[[rails]]\ncountry = "Quarryland"\nradius_m = [{place}]\nhigh = "{high}"\nlow = "60E1"\n'
        'wear = "worn 2020"\nsource = "assumed: made up"\n'
        for place, high in (("0.0, inf", "worn.txt"), ("inf, inf", "60E1"))
    )
    (tmp_path / "line.toml").write_text(QUARRY.read_text() + rows)
    line = read_line(tmp_path / "line.toml")
    assert all("worn.txt" not in s.pair.high for s in load_sections(line, LOADED))
    worn = next(s for s in load_sections(line, LOADED, wear="worn 2020") if s.hand == "left")
    assert worn.rails.right == str(tmp_path / "worn.txt")
    assert worn.rails.right_profile().z.max() == pytest.approx(0.0, abs=1e-9)
    with pytest.raises(ValueError, match="wear state 'old' is not known, there are: new, worn 2020"):
        load_sections(line, LOADED, wear="old")


def test_unknown_names() -> None:
    with pytest.raises(
        ValueError, match="line 'ofoten' is no file, and not one of the known lines: malmbanan"
    ):
        read_line("ofoten")
    line = read_line("malmbanan")
    with pytest.raises(
        ValueError, match="no speed for vehicle 'tram', there are: iore_locomotive, iore_wagon"
    ):
        load_sections(line, "tram")
    with pytest.raises(ValueError, match="quality is 'QN9', allowed are QN1, QN2, QN3, >QN3"):
        load_sections(line, LOADED, quality="QN9")


FAULTS = {
    "too large": ("left = 40.0, right = 30.0", "left = 240.0, right = 30.0",
                  r"curve.tight.cant_mm.left = 240 mm: allowed 0 to 180 mm"),
    "radius outside its class": ("left = 200.0, right = 240.0", "left = 200.0, right = 340.0",
                                 r"curve.tight.radius_m.right = 340 m: allowed 150 to 300 m"),
    "metres for kilometres": ("km = 12.0\nsource", "km = 12000000\nsource",
                              r"length.km = 1.2e\+07 km: allowed 0.1 to 100000 km"),
    "text": ("share_percent = 60.0", 'share_percent = "60"',
             r"straight.share_percent = '60': allowed 0 to 100 %"),
    "nan": ("share_percent = 60.0", "share_percent = nan",
            r"straight.share_percent = nan %: allowed 0 to 100 %"),
    "sum": ("share_percent = 60.0", "share_percent = 50.0", "sum to 90 %: allowed 100 %"),
    "missing": ("cant_ramp = 500.0\n", "", "transition.cant_ramp is missing: allowed 100 to 5000"),
    "misspelt": ("shortest_m", "shortst_m", "transition.shortest_m is missing.*is it transition.shortst_m?"),
    "unknown key": ("km = 12.0\n", "km = 12.0\nkms = 3\n", "unknown key length.kms; did you mean km?"),
    "unknown table": ("[gauge]", "[gouge]\nx = 1\n[gauge]", "unknown key gouge; did you mean gauge?"),
    "overlap": ("interval_m = [300.0, 1000.0]", "interval_m = [250.0, 1000.0]",
                "curve.wide.interval_m starts at 250 m inside that of curve.tight: allowed from 300 m on"),
    "four classes": ("percent = [90.0, 10.0, 0.0, 0.0]", "percent = [90.0, 10.0, 0.0]",
                     "quality.straight.percent = .*: allowed a list of 4 numbers"),
    "quality sum": ("percent = [90.0, 10.0, 0.0, 0.0]", "percent = [90.0, 15.0, 0.0, 0.0]",
                    r"quality.straight.percent sums to 105 %: allowed 100 %"),
    "no source": ('slope = "1:40"\nsource = "assumed: made up"', 'slope = "1:40"\nsource = "somebody said"',
                  "rail_inclination.source = 'somebody said': allowed a text that starts with published"),
    "inclination": ('slope = "1:40"', 'slope = "40"', 'slope = \'40\': allowed "1:15" to "1:100"'),
    "rail": ('high = "60E2"', 'high = "60E9"',
             r"rails\[0\].high: rail '60E9' is no file, .*known rails: 54E1"),
    "rail's country": ('country = "Quarryland"\nradius_m = [inf', 'country = "X"\nradius_m = [inf',
                       r"rails\[1\].country = 'X': allowed Quarryland"),
    "no rails": ("radius_m = [inf, inf]", "radius_m = [0.0, 1.0]",
                 "no new rails are given for straight track"),
    "country": ("{ Quarryland = 100.0 }", "{ Elsewhere = 100.0 }", "names Elsewhere: allowed Quarryland"),
    "country lengths": ("[[country_split]]",
                        '[country.Other]\nlength_km = 6.0\nsource = "assumed: x"\n[[country_split]]',
                        r"country.Quarryland.length_km is 66.7 % .* gives it 100.0 % of the line"),
    "gauge": ("mean_mm = [1436.0, 1442.0]", "mean_mm = [1.436, 1.442]",
              r"gauge.mean_mm\[0\] = 1.436 mm: allowed 1400 to 1500 mm"),
    "gauge radii": ("radius_m = [inf, 300.0]", "radius_m = [300.0, 600.0]",
                    "allowed are inf and falling numbers"),
    "not TOML": ("[length]", "[length", "not valid TOML: .*line 4"),
}  # fmt: skip


@pytest.mark.parametrize("name", FAULTS)
def test_faults_are_named(name: str, tmp_path: Path) -> None:
    """Each fault: one line with file, key, value, unit and what is allowed."""
    old, new, message = FAULTS[name]
    text = QUARRY.read_text()
    assert text.count(old) >= 1
    path = tmp_path / "line.toml"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(ValueError, match=message) as found:
        read_line(path)
    assert str(found.value).startswith(str(path))
    assert "\n" not in str(found.value)
