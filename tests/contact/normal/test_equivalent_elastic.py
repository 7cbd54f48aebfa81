"""The equivalent-elastic patch: closed forms of a parabolic overlap, its centroid, monotony, regions."""

import math

import numpy as np
import pytest
from scipy.special import ellipkm1
from strip_bench import NU, RADIUS, G, hertz_of, parabola, parabolic_pair

from hh_exudyn.contact.geometry.search import (
    APPROACH,
    CONTACT_COLUMNS,
    MAX_MAXIMA,
    SEMI_AXIS_A,
    SEMI_AXIS_B,
    Y_WHEEL,
)
from hh_exudyn.contact.geometry.silhouette import wheel_rail_pair
from hh_exudyn.contact.normal.equivalent_elastic import (
    VIRTUAL_SHARE,
    complete_integral,
    find_regions,
    hertz_of_ellipse,
)
from hh_exudyn.contact.profiles.spline import uniform_table


def regions(pair):
    """The patches of one wheel, most loaded first."""
    contacts = np.zeros((MAX_MAXIMA, CONTACT_COLUMNS))
    return contacts[: find_regions(pair, contacts)]


@pytest.mark.parametrize("ratio", [1.0, 0.5, 0.05, 1e-3])
def test_complete_integral(ratio):
    assert complete_integral(ratio) == pytest.approx(ellipkm1(ratio**2), rel=1e-13)


@pytest.mark.parametrize("depth", [5e-6, 50e-6, 150e-6])
@pytest.mark.parametrize(("wheel", "rail"), [(0.0, 3.3), (-1.2, 3.3), (0.0, 1.0 / RADIUS)])
def test_a_parabolic_overlap_has_its_own_depth_and_width(wheel, rail, depth):
    (patch,) = regions(parabolic_pair(wheel, rail, depth))
    assert patch[APPROACH] == pytest.approx(depth / VIRTUAL_SHARE, rel=2e-3)  # arc over lateral width
    assert patch[SEMI_AXIS_A] == pytest.approx(math.sqrt(2.0 * RADIUS * depth), rel=1e-6)
    assert patch[SEMI_AXIS_B] == pytest.approx(math.sqrt(2.0 * depth / (wheel + rail)), rel=2e-3)
    assert patch[Y_WHEEL] == pytest.approx(0.0, abs=1e-9)


def test_a_round_patch_carries_half_over_the_virtual_share_of_hertz():
    (patch,) = regions(parabolic_pair(0.0, 1.0 / RADIUS, 40e-6))
    force, a, b, pressure = hertz_of_ellipse(patch, G, NU)
    assert a == pytest.approx(b, rel=1e-3)
    of_that_size = 8.0 / 3.0 * G / (1.0 - NU) * a**3 / (2.0 * RADIUS)  # 4/3 E* a^3 / R of two equal bodies
    assert force == pytest.approx(0.5 / VIRTUAL_SHARE * of_that_size, rel=2e-3)
    assert pressure == pytest.approx(1.5 * force / (math.pi * a * b), rel=1e-12)
    exact = hertz_of(0.0, 1.0 / RADIUS, force)
    assert a / exact.a == pytest.approx((VIRTUAL_SHARE / 0.5) ** (1.0 / 3.0), rel=2e-3)


@pytest.mark.parametrize(("wheel", "rail"), [(0.0, 0.8), (0.0, 3.3), (-1.2, 3.3)])
def test_close_to_hertz_for_usual_curvatures(wheel, rail):
    """Size and pressure under one load within 10 % on a tread; slender patches of a flange are too large."""
    (patch,) = regions(parabolic_pair(wheel, rail, 40e-6))
    force, a, b, pressure = hertz_of_ellipse(patch, G, NU)
    exact = hertz_of(wheel, rail, force)
    assert a * b == pytest.approx(exact.a * exact.b, rel=0.1)
    assert pressure == pytest.approx(exact.max_pressure, rel=0.1)


def test_force_grows_with_depth():
    forces = [
        hertz_of_ellipse(regions(parabolic_pair(-1.2, 3.3, depth))[0], G, NU)[0]
        for depth in np.linspace(2e-6, 150e-6, 40)
    ]
    assert np.all(np.diff(forces) > 0.0)
    # depth to the power 3/2, as in Hertz: the lengths of a parabolic overlap go with its root
    assert forces[-1] / forces[0] == pytest.approx(75.0**1.5, rel=0.02)


def test_two_regions_are_two_patches_and_one_after_they_have_joined():
    """A rail with two crowns 20 mm apart and a valley of 20 um, the left crown 5 um lower."""
    y = np.arange(-120, 121) * 0.25e-3
    wave = 2.0 * math.pi / 20e-3
    z = 10e-6 * np.cos(wave * (y - 10e-3)) + 2.5e-6 * y / 10e-3 - 2e-6 * (y / 10e-3) ** 4
    second = -10e-6 * wave**2 * np.cos(wave * (y - 10e-3)) - 24e-6 * y**2 / 10e-3**4
    rail = uniform_table(float(y[0]), 0.25e-3, z, second)

    def pressed(depth):
        centre = np.array([0.0, -0.75, RADIUS + float(z.max()) - depth])
        axle = np.array([0.0, 1.0, 0.0])
        return regions(wheel_rail_pair(parabola(0.0), rail, 1.0, 0.75, RADIUS, centre, axle))

    apart, joined = pressed(12e-6), pressed(40e-6)
    assert len(apart) == 2
    assert apart[0, APPROACH] > apart[1, APPROACH]
    assert apart[0, Y_WHEEL] > 0.0 > apart[1, Y_WHEEL]
    assert len(joined) == 1
    assert abs(joined[0, Y_WHEEL]) < abs(apart[0, Y_WHEEL])
    assert joined[0, SEMI_AXIS_B] > apart[:, SEMI_AXIS_B].sum()
