"""Gauge measures of wheels against the drawing, simple shapes and MiniProf's own; wear of rail heads."""

import math
from pathlib import Path

import numpy as np
import pytest
from scanned_wheel import hollow_wheel, scan_of_hollow_wheel
from scipy.interpolate import CubicSpline

from hh_exudyn.contact.profile import Profile, gauge_point, rail_profile, read_profile, wheel_profile
from hh_exudyn.contact.profiles.measures import (
    align_rail,
    flange_angle,
    flange_height,
    flange_steepness,
    flange_thickness,
    rail_wear,
    tread_hollow,
)

MM = 1e-3


def test_s1002_has_the_measures_of_uic_510_2() -> None:
    """S1002/h28/e32.5: the names of the drawing. qR by a spline through the drawing's points."""
    wheel = wheel_profile("S1002")
    front = (wheel.y > 30 * MM) & (wheel.y < 54.9 * MM)
    y_of_depth = CubicSpline(-wheel.z[front], wheel.y[front])
    assert flange_height(wheel) == pytest.approx(28.000 * MM, abs=0.5e-6)
    assert flange_thickness(wheel) == pytest.approx(32.500 * MM, abs=2e-6)
    assert 70 * MM - y_of_depth(10 * MM) == pytest.approx(32.500 * MM, abs=1e-6)
    assert flange_steepness(wheel) == pytest.approx(10.794 * MM, abs=2e-6)
    assert y_of_depth(26 * MM) - y_of_depth(10 * MM) == pytest.approx(10.794 * MM, abs=1e-6)
    assert flange_angle(wheel) == pytest.approx(math.atan(2.747477419), abs=1e-6)  # section E, 70 degrees
    assert tread_hollow(wheel) == 0.0
    assert np.interp(0.0, wheel.y, wheel.z) == pytest.approx(0.0, abs=1e-8)
    assert wheel.y[-1] == pytest.approx(70 * MM, abs=1e-9)


def cone(hollow: float = 0.0) -> Profile:
    """A cone of 1:40 with a flange face at 60 degrees from y = 40 mm; a rounded hollow at y = -10 mm."""
    y = np.linspace(-60 * MM, 40 * MM, 1001)
    z = -y / 40 + hollow * np.exp(-(((y + 10 * MM) / (8 * MM)) ** 2))
    z -= np.interp(0.0, y, z)
    face = np.linspace(0.0, 16 * MM, 161)[1:]
    z_face = z[-1] - math.tan(math.pi / 3) * face
    tip = np.linspace(0.0, 8 * MM, 80)[1:]
    return Profile(
        "cone",
        "wheel",
        np.concatenate([y, 40 * MM + face, 56 * MM + tip]),
        np.concatenate([z, z_face, np.full(tip.size, z_face[-1])]),
    )


def test_measures_of_a_cone_with_a_straight_flange() -> None:
    wheel = cone()
    slope = math.tan(math.pi / 3)
    face_at_10 = 40 * MM + (10 * MM - 1 * MM) / slope
    assert flange_height(wheel) == pytest.approx(1 * MM + 16 * MM * slope, abs=1e-9)
    assert flange_thickness(wheel) == pytest.approx(70 * MM - face_at_10, abs=1e-9)
    assert flange_steepness(wheel) == pytest.approx(56 * MM - 2 * MM / slope - face_at_10, abs=1e-9)
    assert flange_angle(wheel) == pytest.approx(math.pi / 3, abs=1e-9)


def test_hollow_is_the_rise_to_the_field_side() -> None:
    """z = -y/40 + h exp(-((y - m)/w)^2): highest point of the hollow over the lowest outside of it."""
    y = np.linspace(-50, 25, 750_001) * MM
    z = -y / 40 + 2 * MM * np.exp(-(((y + 10 * MM) / (8 * MM)) ** 2))
    expected = max(z[i] - z[: i + 1].min() for i in range(0, y.size, 500))
    assert expected > 1 * MM
    assert tread_hollow(cone(2 * MM)) == pytest.approx(expected, abs=1e-6)
    assert tread_hollow(cone()) == 0.0


def test_miniprof_gives_the_same_measures(shared_profiles: Path) -> None:
    """Sd, Sh, qR in a MiniProf file, taping line 70 mm from the flange back: 0.03 mm on the raw points."""
    path = shared_profiles / "left-wheel-v1-pre-dry.whl"
    for smoothing, tolerance in (("never", 0.03 * MM), ("auto", 0.05 * MM)):
        read = read_profile(path, smoothing=smoothing)
        written = {key: float(read.report.header[key]) * MM for key in ("Sd", "Sh", "qR")}
        assert float(read.report.header["WheelDiameterTaperline"]) == 70.0
        assert flange_thickness(read.profile) == pytest.approx(written["Sd"], abs=tolerance)
        assert flange_height(read.profile) == pytest.approx(written["Sh"], abs=tolerance)
        assert flange_steepness(read.profile) == pytest.approx(written["qR"], abs=tolerance)


def test_a_scan_gives_the_measures_of_what_was_scanned(tmp_path: Path) -> None:
    """S1002 worn by 1.5 mm at the running circle and 0.05 mm at the flange tip, under the noise of a scan."""
    scan, drawn = read_profile(scan_of_hollow_wheel(tmp_path / "hollow.whl")).profile, hollow_wheel()
    assert flange_height(scan) == pytest.approx(29.45 * MM, abs=0.02 * MM)
    for measure in (flange_thickness, flange_steepness, tread_hollow):
        assert measure(scan) == pytest.approx(measure(drawn), abs=0.05 * MM)
    assert tread_hollow(drawn) > 0.4 * MM


def test_a_worn_heavy_haul_wheel_is_hollow_and_its_flange_high(shared_profiles: Path) -> None:
    wheel = read_profile(shared_profiles / "worn_high_mileage.prw").profile
    assert 1.0 * MM < tread_hollow(wheel) < 2.0 * MM
    assert 33 * MM < flange_height(wheel) < 38 * MM
    assert 74 < math.degrees(flange_angle(wheel)) < 80


def cut(rail: Profile, height: float, gauge_face: float) -> Profile:
    """A rail planed flat `height` below its top and upright at y = `gauge_face`, its coordinates kept."""
    y = np.unique(np.concatenate([rail.y, np.linspace(gauge_face - MM, gauge_face, 101)]))
    y = y[y <= gauge_face]
    z = np.minimum(np.interp(y, rail.y, rail.z), -height)
    face = np.linspace(0.0, 25 * MM, 251)[1:]
    return Profile(
        "cut",
        "rail",
        np.concatenate([y, gauge_face + 1e-6 * face]),
        np.concatenate([z, z[-1] - face]),
    )


@pytest.mark.parametrize(("height", "side"), [(4 * MM, 3 * MM), (7 * MM, 3 * MM), (2 * MM, 8 * MM)])
def test_wear_of_a_planed_rail_is_what_was_planed(height: float, side: float) -> None:
    """An upright 60E1: W1 and W2 are the cuts; W3 is measured along the diagonal of the corner they leave."""
    rail = rail_profile("60E1", 0.0)
    wear = rail_wear(cut(rail, height, gauge_point(rail) - side), rail)
    assert wear.vertical == pytest.approx(height, abs=1e-6)
    assert wear.side == pytest.approx(side, abs=1e-6)
    # From outside the diagonal meets metal where the last of new rail, planed top and planed face begins.
    along_new = np.interp(0.0, *crossing_of_diagonal(rail))
    assert wear.corner == pytest.approx(max(0.0, math.sqrt(2) * max(height, side) - along_new), abs=1e-6)
    assert rail_wear(rail, rail) == rail_wear(rail, rail, 0.0, 0.0)
    assert rail_wear(rail, rail).corner == 0.0


def crossing_of_diagonal(rail: Profile) -> tuple[np.ndarray, np.ndarray]:
    """Height over the diagonal, and the distance from its start, around the gauge corner, rising."""
    part = rail.y > 15 * MM
    y, z = rail.y[part] - gauge_point(rail), rail.z[part]
    above = z - y  # the diagonal: z = y, both negative
    distance = -(y + z) / math.sqrt(2)
    order = np.argsort(above)
    return above[order], distance[order]


@pytest.mark.parametrize("shift", [(0.0, 0.0), (3 * MM, 2 * MM), (-5 * MM, -4 * MM)])
def test_a_worn_rail_is_laid_on_its_reference_by_the_field_side(shift: tuple[float, float]) -> None:
    """As a file gives it: the top of the worn rail at 0, its lateral origin anywhere."""
    rail = rail_profile("60E1", 1 / 30)
    y = rail.y
    worn_z = rail.z - 2 * MM / (1 + np.exp(-(y + 5 * MM) / (0.8 * MM)))  # no wear on the field side
    worn = Profile("worn", "rail", y + shift[0], worn_z - worn_z.max())
    dy, dz = align_rail(worn, rail)
    assert dy == pytest.approx(-shift[0], abs=5e-6)
    assert dz == pytest.approx(worn_z.max(), abs=5e-6)
    wear = rail_wear(worn, rail, dy, dz)
    assert wear.vertical == pytest.approx(2 * MM, abs=10e-6)


def test_measures_refuse_the_other_kind() -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1")
    for measure in (flange_height, flange_thickness, flange_steepness, flange_angle, tread_hollow):
        with pytest.raises(ValueError, match="rail's"):
            measure(rail)
    with pytest.raises(ValueError, match="wheel's"):
        rail_wear(wheel, rail)
    with pytest.raises(ValueError, match="wheel's"):
        align_rail(rail, wheel)
    with pytest.raises(ValueError, match=r"side_depth = 14 m, allowed 0\.005 \.\. 0\.025 m"):
        rail_wear(rail, rail, side_depth=14)
    with pytest.raises(ValueError, match="needed through"):
        rail_wear(rail, rail, 0.0, 40 * MM)
