"""Standard profiles against the drawings' measures and others' files; readers; smoothing."""

from pathlib import Path

import numpy as np
import pytest
from manchester_rail import manchester_rail
from scipy.interpolate import CubicSpline

from hh_exudyn.contact.profile import (
    RAIL_PROFILES,
    Profile,
    gauge_point,
    rail_profile,
    read_rail_profile,
    read_wheel_profile,
    wheel_profile,
)
from hh_exudyn.contact.profiles.spline import spline_evaluate, spline_table
from hh_exudyn.contact.profiles.standard import RAIL_HEADS
from hh_exudyn.contact.profiles.steepness import MAX_SLOPE

MM = 1e-3


def simpack_points(path: Path) -> np.ndarray:
    """The points of a SIMPACK profile file as they stand (the Manchester files comment the first one out)."""
    body = path.read_text().split("point.begin")[1].split("point.end")[0]
    rows = [line.split()[:2] for line in body.splitlines() if line.strip() and not line.startswith(" ")]
    return np.array([[float(word) for word in row] for row in rows if not row[0].startswith("!")])


def distances(profile: Profile, points: np.ndarray) -> np.ndarray:
    """Distance of each point (y, z) from the line of a profile; good to 1 um."""
    chord = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(profile.y), np.diff(profile.z)))])
    dense = np.arange(0.0, chord[-1], 1e-6)
    y, z = (CubicSpline(chord, values)(dense) for values in (profile.y, profile.z))
    found = []
    for y_point, z_point in points:
        near = slice(*np.searchsorted(y, [y_point - 0.3 * MM, y_point + 0.3 * MM]))
        found.append(np.hypot(y[near] - y_point, z[near] - z_point).min())
    return np.array(found)


def test_s1002_equals_the_manchester_file(shared_profiles: Path) -> None:
    points = simpack_points(shared_profiles / "MBench_S1002_v3.prw") * MM  # y to the flange, z down
    assert len(points) > 300
    assert distances(wheel_profile("S1002"), points * [1, -1]).max() < 1e-6


def test_own_manchester_rail_equals_the_file(shared_profiles: Path) -> None:
    """The rail that the tests of the benchmark use, down to 16 mm below its top."""
    points = -simpack_points(shared_profiles / "MBench_UIC60_v3.prr") * MM  # right rail: y outwards, z down
    points = points[points[:, 1] > -16 * MM]
    assert len(points) > 300
    assert distances(manchester_rail(), points).max() < 1e-6  # as near as `distances` can tell


def test_60e1_at_1_40_equals_the_manchester_rail(shared_profiles: Path) -> None:
    points = simpack_points(shared_profiles / "MBench_UIC60_v3.prr") * MM  # right rail: y outwards, z down
    points = -points + [-300 * MM * np.sin(np.arctan(1 / 40)), 0.0]  # that file's y = 0 is the highest point
    head = points[points[:, 1] > -15 * MM]
    assert len(head) > 200
    rail = rail_profile("60E1", 1 / 40)
    assert distances(rail, head).max() < 0.041 * MM  # with equal tops: 0.0403 mm, at the R80-R13 joint
    # The figure of 0.031 mm is for the best height (the file's corner stands higher than the drawing's)
    assert distances(rail, head - [0.0, 0.02 * MM]).max() < 0.031 * MM


def test_60e1_arcs_meet_the_drawing() -> None:
    rail = rail_profile("60E1", 0.0)
    height = CubicSpline(rail.y, rail.z)
    assert height(10.228 * MM) == pytest.approx(-0.1744 * MM, abs=1e-7)
    assert height(26.0265 * MM) == pytest.approx(-2.3025 * MM, abs=1e-7)


@pytest.mark.parametrize(("name", "y", "z"), [("54E1", 35.000, -14.100), ("60E1", 36.000, -14.300)])
def test_gauge_corner_ends_at_the_flank(name: str, y: float, z: float) -> None:
    rail = rail_profile(name, 0.0)
    slopes = np.diff(rail.z) / np.diff(rail.y)
    flank = int(np.argmax(slopes < -19.99))
    assert rail.y[flank] == pytest.approx(y * MM, abs=1e-6)
    assert rail.z[flank] == pytest.approx(z * MM, abs=1e-6)


@pytest.mark.parametrize("name", RAIL_HEADS)
@pytest.mark.parametrize("inclination", [0.0, 1 / 40, 1 / 30, 1 / 20])
def test_inclined_rails_lean_inwards(name: str, inclination: float) -> None:
    rail = rail_profile(name, inclination)
    assert rail.z.max() == 0.0
    if inclination <= 1 / 40:  # the top still lies on the crown's arc, of 200 or 300 mm radius
        radius = (200 if name == "60E2" else 300) * MM
        top = -radius * np.sin(np.arctan(inclination))
        assert rail.y[np.argmax(rail.z)] == pytest.approx(top, abs=0.06 * MM)
    gauge_side = np.interp(20 * MM, rail.y, rail.z)
    field_side = np.interp(-20 * MM, rail.y, rail.z)
    assert gauge_side - field_side == pytest.approx(-40 * MM * inclination, abs=0.03 * MM)
    assert np.interp(gauge_point(rail), rail.y, rail.z) == pytest.approx(-14 * MM, abs=1e-9)
    assert gauge_point(rail) > 30 * MM


@pytest.mark.parametrize(
    "profile", [wheel_profile("S1002"), *(rail_profile(n, 1 / 30) for n in RAIL_PROFILES)]
)
@pytest.mark.parametrize("smoothing", [0.0, 0.5e-3])
def test_table_stays_with_the_profile(profile: Profile, smoothing: float) -> None:
    table = spline_table(profile, smoothing=smoothing)
    exact = CubicSpline(profile.y, profile.z)
    y = np.arange(
        table.start + 0.813 * MM, table.start + (len(table.z) - 1) * table.step - 0.8 * MM, 0.03 * MM
    )
    z, slope, second = np.array([spline_evaluate(table, value) for value in y]).T
    assert np.abs(z - exact(y)).max() < 0.02 * MM
    # The spline's own derivatives, by differences
    h = 1e-6
    ahead, behind = (np.array([spline_evaluate(table, v + d) for v in y]) for d in (h, -h))
    np.testing.assert_allclose((ahead[:, 0] - behind[:, 0]) / (2 * h), slope, atol=1e-5)
    np.testing.assert_allclose((ahead[:, 1] - behind[:, 1]) / (2 * h), second, rtol=1e-5, atol=2.0)
    assert np.abs(slope).max() <= MAX_SLOPE + 0.5
    # and the slopes that it holds at its nodes
    nodes = table.start + table.step * np.arange(table.z.size - 1)
    held = [spline_evaluate(table, float(value))[1] for value in nodes]
    np.testing.assert_allclose(table.slope[:-1], held, rtol=0, atol=1e-10)
    assert table.per_step == pytest.approx(1.0 / table.step, rel=1e-15)
    end = table.start + table.step * (table.z.size - 1)
    assert table.slope[-1] == pytest.approx(spline_evaluate(table, end - 1e-9)[1], abs=1e-5)


def test_smoothing_spreads_the_jump_of_curvature_and_keeps_the_arcs() -> None:
    table = spline_table(rail_profile("60E1", 0.0), smoothing=0.5e-3)

    def curvature(y: float) -> float:
        _, slope, second = spline_evaluate(table, y)
        return -second / (1 + slope**2) ** 1.5

    assert curvature(0.0) == pytest.approx(1 / 0.3, rel=1e-3)
    assert curvature(18 * MM) == pytest.approx(1 / 0.08, rel=1e-3)
    assert curvature(30 * MM) == pytest.approx(1 / 0.013, rel=1e-2)
    jump = [curvature(y) for y in np.arange(9.7, 10.8, 0.05) * MM]
    middle = 0.5 * (1 / 0.3 + 1 / 0.08)
    assert min(abs(value - middle) for value in jump) < 0.4  # no jump: a value near the middle exists


@pytest.mark.parametrize("name", RAIL_PROFILES)
@pytest.mark.parametrize("inclination", [-0.1, -1 / 20, 0.0, 1 / 40, 1 / 30, 1 / 20, 0.1])
def test_standard_rails_cover_the_head_at_any_inclination(name: str, inclination: float) -> None:
    rail = rail_profile(name, inclination)
    assert max(rail.z[0], rail.z[-1]) < -15 * MM
    slope = np.diff(rail.z) / np.diff(rail.y)
    assert min(slope[:300].max(), -slope[-300:].min()) > MAX_SLOPE  # where tables end
    table = spline_table(rail)
    assert table.start + 2 * MM < gauge_point(rail) < table.start + table.step * (len(table.z) - 1)


def test_table_ends() -> None:
    wheel = spline_table(wheel_profile("S1002"))
    end = wheel.start + wheel.step * (len(wheel.z) - 1)
    assert end == pytest.approx(55 * MM, abs=0.25 * MM)  # the flange tip
    assert np.isnan(spline_evaluate(wheel, end + 1e-6)).all()
    assert np.isfinite(spline_evaluate(wheel, end)).all()
    assert np.isnan(spline_evaluate(wheel, wheel.start - 1e-6)).all()


def written(path: Path, profile: Profile, edit: dict[int, str] | None = None) -> Path:
    """A profile as text in mm; `edit` replaces lines, numbered from 1."""
    lines = ["# y z [mm]"] + [
        f"{1e3 * y:.6f} {1e3 * z:.6f}" for y, z in zip(profile.y, profile.z, strict=True)
    ]
    for number, text in (edit or {}).items():
        lines[number - 1] = text
    path.write_text("\n".join(lines))
    return path


def thinned(profile: Profile, step: int = 5) -> Profile:
    keep = slice(None, None, step)
    return Profile(profile.name, profile.kind, profile.y[keep], profile.z[keep])


def test_readers_return_what_was_written(tmp_path: Path) -> None:
    wheel, rail = thinned(wheel_profile("S1002")), thinned(rail_profile("60E1"))
    read = read_wheel_profile(written(tmp_path / "w.txt", wheel))
    np.testing.assert_allclose(read.y, wheel.y, atol=1e-9)
    np.testing.assert_allclose(read.z, wheel.z - np.interp(0, wheel.y, wheel.z), atol=2e-9)
    assert read.kind == "wheel"
    read = read_rail_profile(written(tmp_path / "r.txt", rail))
    np.testing.assert_allclose(read.y, rail.y, atol=1e-9)
    assert read.z.max() == 0.0
    assert gauge_point(read) == pytest.approx(gauge_point(rail), abs=1e-6)


@pytest.mark.parametrize(
    ("line", "text", "message"),
    [
        (10, "nan 1.0", "line 10: not a finite"),
        (11, "-70.0 0.0", "line 11: y = -70 mm, z = 0 mm lies 14.* mm from the point before, allowed 10"),
        (12, "1.0", "line 12: expected two numbers"),
        (13, "one two", "line 13: expected two numbers"),
    ],
)
def test_readers_name_the_line(tmp_path: Path, line: int, text: str, message: str) -> None:
    path = written(tmp_path / "w.txt", thinned(wheel_profile("S1002")), {line: text})
    with pytest.raises(ValueError, match=message):
        read_wheel_profile(path)


def test_readers_refuse(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="file not found"):
        read_wheel_profile(tmp_path / "none.txt")
    few = tmp_path / "few.txt"
    few.write_text("0 0\n1 1\n")
    with pytest.raises(ValueError, match="2 points, at least 20"):
        read_rail_profile(few)
    rail = written(tmp_path / "r.txt", thinned(rail_profile("60E1")))
    with pytest.raises(ValueError, match="is it a rail's"):
        read_wheel_profile(rail)
    wheel, rail_60 = wheel_profile("S1002"), rail_profile("60E1")
    for profile, keep, message in (
        (wheel, wheel.y > -19 * MM, "from -20 mm"),
        (wheel, wheel.y < 43 * MM, "no flange"),
        (rail_60, rail_60.y > -17 * MM, "from its gauge point, needed from 55 mm"),
        (rail_60, rail_60.y < 34 * MM, "below its top on the gauge side"),
    ):
        with pytest.raises(ValueError, match=message):
            Profile("cut", profile.kind, profile.y[keep], profile.z[keep])


def test_profile_in_millimetres_is_refused() -> None:
    for profile in (wheel_profile("S1002"), rail_profile("60E1")):
        with pytest.raises(ValueError, match="are these millimetres"):
            Profile("mm", profile.kind, profile.y / MM, profile.z / MM)


def test_unknown_names_list_the_known() -> None:
    with pytest.raises(ValueError, match="S1002"):
        wheel_profile("S1003")
    with pytest.raises(ValueError, match="54E1, 54E2, 60E1, 60E2"):
        rail_profile("UIC60")
    with pytest.raises(ValueError, match="1:30 is 1/30"):
        rail_profile("60E1", 30.0)
    with pytest.raises(ValueError, match="wheel's"):
        gauge_point(wheel_profile("S1002"))
    with pytest.raises(ValueError, match="step"):
        spline_table(wheel_profile("S1002"), step=1.0)
    with pytest.raises(ValueError, match="smoothing"):
        spline_table(wheel_profile("S1002"), smoothing=-1.0)


def steep_wheel(height: float) -> Profile:
    """S1002 with an upright spot in its flange face, 10 mm below the tread and `height` high."""
    y, z = (wheel_profile("S1002").y, wheel_profile("S1002").z)
    tip = int(np.argmin(z))
    begin = int(np.argmax((z < -10 * MM) & (np.arange(len(z)) < tip)))
    end = int(np.argmax((z < -10 * MM - height) & (np.arange(len(z)) < tip)))
    shifted = y.copy()
    part = y[begin] + (y[begin : end + 1] - y[begin]) * 1e-3
    shifted[begin : end + 1] = part
    shifted[end + 1 :] += part[-1] - y[end]
    return Profile("steep", "wheel", shifted, z)


@pytest.mark.parametrize("height", [0.3, 0.7, 1.1])
def test_a_steep_spot_does_not_end_the_table(height: float) -> None:
    """The table reaches the flange tip; beside the spot it is the profile, at it within height / 5 across."""
    wheel = steep_wheel(height * MM)
    table = spline_table(wheel)
    end = table.start + table.step * (len(table.z) - 1)
    tip = int(np.argmin(wheel.z))
    assert end == pytest.approx(wheel.y[tip], abs=0.3 * MM)
    assert table.z[-1] == pytest.approx(wheel.z[tip], abs=0.05 * MM)
    nodes = table.start + table.step * np.arange(len(table.z))
    face = (wheel.y > 20 * MM) & (np.arange(len(wheel.y)) < tip) & (wheel.z > wheel.z[tip] + 2 * MM)
    across = np.interp(-wheel.z[face], -table.z, nodes) - wheel.y[face]
    assert across.min() > -(height / MAX_SLOPE + 0.02) * MM
    assert across.max() < 0.1 * MM  # the corners of the spot, rounded like all corners
    away = np.abs(wheel.z[face] + (10 + 0.5 * height) * MM) > 0.5 * height * MM + 3 * MM
    assert np.abs(across[away]).max() < 0.06 * MM


def test_a_steep_spot_that_is_too_high_is_refused() -> None:
    with pytest.raises(
        ValueError,
        match=r"'steep' is steeper than 78.7 deg about y = .* and goes on behind.*allowed 0.25 mm",
    ):
        spline_table(steep_wheel(4 * MM))


def test_a_steep_spot_of_a_gauge_face_does_not_end_the_table() -> None:
    """A side-worn rail: upright for 1 mm below the corner, then at 70 degrees, where a flange touches."""
    rail = rail_profile("60E1", 1 / 30)
    top = rail.z > -7 * MM
    y, z = rail.y[top], rail.z[top]
    face_z = np.arange(0.1, 1.0, 0.1) * -MM
    below = np.arange(0.1, 16.0, 0.1) * -MM
    y = np.concatenate([y, y[-1] - 1e-3 * face_z, y[-1] + 1e-6 - below / np.tan(np.radians(70))])
    z = np.concatenate([z, z[-1] + face_z, z[-1] - 1 * MM + below])
    keep = (rail.z <= -7 * MM) & (rail.y < 0)
    worn = Profile("worn", "rail", np.concatenate([rail.y[keep], y]), np.concatenate([rail.z[keep], z]))
    table = spline_table(worn)
    nodes = table.start + table.step * np.arange(len(table.z))
    assert nodes[-1] > worn.y[-1] - 0.3 * MM
    deep = worn.z < -11 * MM
    deep &= worn.y > 0
    gauge_side = nodes > 0.0
    across = np.interp(-worn.z[deep], -table.z[gauge_side], nodes[gauge_side]) - worn.y[deep]
    assert np.abs(across[:-5]).max() < 0.02 * MM


@pytest.mark.parametrize("name", ["steep_flange.txt", "../profiles/Car7422_0001r.whl"])
def test_shared_steep_flanges_reach_their_tips(shared_cases: Path, name: str) -> None:
    wheel = read_wheel_profile(shared_cases / name)
    table = spline_table(wheel)
    tip = int(np.argmin(np.where(wheel.y > 0, wheel.z, 1.0)))
    nodes = table.start + table.step * np.arange(len(table.z))
    assert nodes[-1] == pytest.approx(wheel.y[tip], abs=0.3 * MM)
    face = (wheel.z < -4 * MM) & (wheel.y > 20 * MM) & (np.arange(len(wheel.y)) <= tip)
    face &= wheel.z > wheel.z[tip] + 2 * MM
    flange = nodes > 20 * MM
    across = np.interp(-wheel.z[face], -table.z[flange], nodes[flange]) - wheel.y[face]
    assert -0.25 * MM < across.min() < across.max() < 0.05 * MM
