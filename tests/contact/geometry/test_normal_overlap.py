"""Overlap along the normal and its maxima: against a dense scan by others, mirror image, the flange root."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline
from scipy.signal import find_peaks

from hh_exudyn.contact.geometry import search
from hh_exudyn.contact.geometry.normal_overlap import overlap_at
from hh_exudyn.contact.geometry.search import CONTACT_COLUMNS, MAX_MAXIMA, find_contacts, find_maxima
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, wheel_rail_pair
from hh_exudyn.contact.normal.hertz import CURVATURE_FLOOR, normal_contact
from hh_exudyn.contact.profile import Profile, gauge_point, rail_profile, wheel_profile
from hh_exudyn.contact.profiles.spline import spline_table
from hh_exudyn.contact.types import SplineTable

RADIUS, DISTANCE = 0.4575, 0.75
SAMPLES = 5e-6  # m, of the dense scan


def hollow_wheel(depth: float) -> Profile:
    """S1002 worn hollow, but for a rim of some millimetres on its field side."""
    wheel = wheel_profile("S1002")
    return Profile("hollow", "wheel", wheel.y, wheel.z - depth * np.exp(-((wheel.y / 52e-3) ** 16)))


WHEELS = {name: spline_table(wheel_profile(name)) for name in ("S1002", "WP4_like")}
WHEELS["hollow"] = spline_table(hollow_wheel(2e-3))
RAIL_SHAPES = {"60E1": rail_profile("60E1", 1 / 30), "MB1_like": rail_profile("MB1_like")}
RAILS = {name: spline_table(profile) for name, profile in RAIL_SHAPES.items()}


def pair_at(
    wheel: str, rail: str, y: float, z: float, yaw: float = 0.0, roll: float = 0.0, gauge: float = 1.445
) -> WheelRailPair:
    """The left wheel, `y` towards its rail."""
    axle = np.array([-math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll)])
    centre = np.array([0.0, y - 0.5 * gauge - gauge_point(RAIL_SHAPES[rail]), z])
    return wheel_rail_pair(WHEELS[wheel], RAILS[rail], 1.0, DISTANCE, RADIUS, centre, axle)


poses = st.builds(
    pair_at,
    st.sampled_from(sorted(WHEELS)),
    st.sampled_from(sorted(RAILS)),
    st.floats(-0.05, 0.013),
    st.just(RADIUS),
    st.floats(-0.02, 0.02),
    st.floats(-0.005, 0.005),
)


def spline(table: SplineTable) -> CubicSpline:
    """The same spline, evaluated by others."""
    y = table.start + table.step * np.arange(len(table.z))
    return CubicSpline(y, table.z, bc_type=((2, table.second[0]), (2, table.second[-1])))


def silhouette_points(pair: WheelRailPair, y: np.ndarray) -> np.ndarray:
    """Lateral place on the rail and height of the lowest points of the wheel's circles, (n, 2)."""
    z, slope = spline(pair.wheel)(y), spline(pair.wheel)(y, 1)
    axle = np.array([pair.axle_x, pair.axle_y, pair.axle_z])
    ahead = np.array([1.0, 0.0, 0.0]) - axle[0] * axle
    ahead /= np.linalg.norm(ahead)
    up = np.cross(ahead, axle)
    sine = pair.side * slope * axle[0] / ahead[0]  # equation 1 of `silhouette`
    radius, along = RADIUS - z, pair.side * (DISTANCE - y)
    points = np.multiply.outer(along, axle) + np.multiply.outer(radius * sine, ahead)
    points -= np.multiply.outer(radius * np.sqrt(1.0 - sine**2), up)
    return np.column_stack((-pair.side * (pair.centre_y + points[:, 1]), pair.centre_z + points[:, 2]))


def scan(pair: WheelRailPair) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places on the wheel profile all over the rail, vertical gap and overlap along the normal there."""
    wheel, rail, h = pair.wheel, pair.rail, 1e-7
    y = np.arange(wheel.start + 2 * h, wheel.start + (wheel.z.size - 1) * wheel.step - 2 * h, SAMPLES)
    place, height = silhouette_points(pair, y).T
    run = silhouette_points(pair, y + h) - silhouette_points(pair, y - h)
    over = (place > rail.start) & (place < rail.start + (rail.z.size - 1) * rail.step)
    y, place, height, run = y[over], place[over], height[over], run[over]
    gap = height - spline(rail)(place)
    angle = 0.5 * (np.arctan(run[:, 1] / run[:, 0]) + np.arctan(spline(rail)(place, 1)))
    return y, gap, -gap * np.cos(angle)


def maxima(pair: WheelRailPair) -> np.ndarray:
    rows = np.zeros((MAX_MAXIMA, CONTACT_COLUMNS))
    return rows[: find_maxima(pair, rows)]


def contacts(pair: WheelRailPair) -> np.ndarray:
    rows = np.zeros((MAX_MAXIMA, CONTACT_COLUMNS))
    return rows[: find_contacts(pair, rows)]


@given(pair=poses, sunk=st.floats(1e-6, 6e-4))
def test_maxima_are_those_of_a_dense_scan(pair: WheelRailPair, sunk: float) -> None:
    """All over the wheel, field side and flange: each peak is a row, each row a peak, saddles too."""
    _, gap, _ = scan(pair)
    pair = pair._replace(centre_z=pair.centre_z - gap.min() - sunk)
    y, _, overlap = scan(pair)
    rows = maxima(pair)
    peaks, _ = find_peaks(overlap, height=1e-8, prominence=2e-8)
    assert len(rows) >= len(peaks)
    for peak in peaks:
        row = rows[np.argmin(np.abs(rows[:, search.Y_WHEEL] - y[peak]))]
        assert -1e-11 < row[search.OVERLAP] - overlap[peak] < 2e-8  # between samples, of curvature 1/mm
        flat = np.flatnonzero(overlap > overlap[peak] - 1e-10)
        assert np.abs(y[flat] - row[search.Y_WHEEL]).min() < 2 * SAMPLES
    for row in rows:
        for step in (-2e-9, 2e-9):
            rise = overlap_at(pair, row[search.Y_WHEEL] + step).rise
            assert rise * step < 1e-15  # falls to both sides: the place is within 2 nm
        assert row[search.APPROACH] == row[search.OVERLAP] > 0.0
    for one, other in itertools.pairwise(rows):
        between = (y > one[search.Y_WHEEL]) & (y < other[search.Y_WHEEL])
        if between.any():
            assert other[search.SADDLE] == pytest.approx(max(overlap[between].min(), 0.0), abs=2e-8)


@given(pair=poses, place=st.floats(0.0, 1.0))
def test_rise_is_the_derivative(pair: WheelRailPair, place: float) -> None:
    """Equation 2 against differences of equation 1, over all slopes, with yaw and roll."""
    y, _, _ = scan(pair)
    at, h = float(y[5] + place * (y[-5] - y[5])), 1e-7
    behind, here, ahead = (overlap_at(pair, at + step) for step in (-h, 0.0, h))
    slope = (ahead.overlap - behind.overlap) / (2.0 * h)
    assert here.rise * here.cosine == pytest.approx(slope, rel=1e-5, abs=1e-5)
    assert here.cosine**2 + here.sine**2 == pytest.approx(1.0, abs=1e-12)


@given(pair=poses, sunk=st.floats(1e-5, 5e-4))
def test_mirrored_wheel_gives_the_same_bits(pair: WheelRailPair, sunk: float) -> None:
    _, gap, _ = scan(pair)
    pair = pair._replace(centre_z=pair.centre_z - gap.min() - sunk)
    mirrored = pair._replace(side=-1.0, centre_y=-pair.centre_y, axle_x=-pair.axle_x, axle_z=-pair.axle_z)
    one, other = contacts(pair), contacts(mirrored)
    other[:, search.POINT + 1] *= -1.0
    np.testing.assert_array_equal(one[:, : search.LIMIT_LOW], other[:, : search.LIMIT_LOW])


def test_hollow_wheel_is_found_on_its_field_side() -> None:
    """2 mm hollow, far from its rail: the side of the rim carries, 44 mm outside of the running circle."""
    pair = pair_at("hollow", "60E1", -0.05, RADIUS)
    _, gap, _ = scan(pair)
    rows = contacts(pair._replace(centre_z=pair.centre_z - gap.min() - 1e-4))
    assert rows[0, search.Y_WHEEL] == pytest.approx(-0.044, abs=1e-3)


def hertz_force(pair: WheelRailPair) -> np.ndarray:
    """Lateral and vertical force of all patches [N]."""
    total = np.zeros(2)
    for row in contacts(pair):
        angle = row[search.CONTACT_ANGLE]
        lateral = max(0.5 * (row[search.WHEEL_CURVATURE] + row[search.RAIL_CURVATURE]), CURVATURE_FLOOR)
        along = 0.5 * math.cos(angle) / row[search.RADIUS]
        normal = normal_contact(row[search.APPROACH], along, lateral, 82e9, 0.28)[0]
        total += normal * np.array([math.sin(angle), math.cos(angle)])
    return total


@pytest.mark.parametrize("height", [0.45765, 0.4577])
def test_contact_moves_through_the_flange_root_without_a_jump(height: float) -> None:
    """S1002 on 60E1 1:30 at fixed height, about 150 kN where it begins.

    The smallest vertical gap jumps from 34.06 to 38.34 mm on the wheel between y = 11.57 and 11.58 mm, which
    was the cause of the flange chatter; the overlap along the normal has one maximum there.
    """
    lowest = []
    for y in (11.57e-3, 11.58e-3):
        places, gap, _ = scan(pair_at("S1002", "60E1", y, height))
        lowest.append(places[np.argmin(gap)])
    assert lowest == pytest.approx([34.06e-3, 38.34e-3], abs=1e-5)
    ys = np.arange(11.3e-3, 11.7e-3, 0.5e-6)
    rows = [contacts(pair_at("S1002", "60E1", float(y), height)) for y in ys]
    assert {len(found) for found in rows[200:]} == {1}
    places = np.array([found[0, search.Y_WHEEL] for found in rows])
    assert (np.diff(places) > 0.0).all()
    assert np.diff(places).max() < 5e-6
    forces = np.array([hertz_force(pair_at("S1002", "60E1", float(y), height)) for y in ys])
    assert (np.diff(forces, axis=0) > 0.0).all()
    assert np.diff(forces, axis=0).max() < 1.5e3


@pytest.mark.parametrize("height", [0.4578, 0.458])
def test_force_is_continuous_onto_the_flange(height: float) -> None:
    """Higher, where it goes from root to flange within 0.1 mm: steep, but halving ends at next to nothing.

    Two maxima nearer than 16 um in a flat spot count as one: its place, and so the direction of the force,
    may jump by that (49 N of 160 kN here at the most).
    """
    ys = np.linspace(11.3e-3, 12.1e-3, 800)
    forces = np.array([hertz_force(pair_at("S1002", "60E1", float(y), height)) for y in ys])
    for component in range(2):
        steps = np.abs(np.diff(forces[:, component]))
        for i in np.argsort(steps)[-8:]:
            low, high = float(ys[i]), float(ys[i + 1])
            jump = steps[i]
            for _ in range(36):
                middle = 0.5 * (low + high)
                ends = [
                    hertz_force(pair_at("S1002", "60E1", y, height))[component] for y in (low, middle, high)
                ]
                left, right = abs(ends[1] - ends[0]), abs(ends[2] - ends[1])
                low, high, jump = (low, middle, left) if left > right else (middle, high, right)
            assert jump < 5e-4 * np.hypot(*forces[i])
