"""Shakedown limits: published tables, closed forms, and exact properties of circles and limits."""

import itertools
import math

import numpy as np
import pyarrow
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize
from shakedown_table import LIMITS

from damage.rcf.surface_index import FLANGE_CONTACT_ANGLE
from damage.shakedown import (
    partial_slip_limit,
    partial_slip_surface_limit,
    point_contact_limit,
    shakedown_limit,
    stress_circle,
    working_point,
    working_points,
)
from damage.shakedown.circle import FIXED, FREE, ON_AXIS, smallest_circle
from hh_exudyn.contact.normal.subsurface import line_contact_stress

HARDENINGS = ("elastic", "perfect", "kinematic")
COLUMNS = {"elastic": "elastic", "perfect": "perfectly_plastic", "kinematic": "kinematic"}
PRINTED = {"elastic": 0.006, "perfect": 0.003, "kinematic": 0.02}  # half a digit, and Table 3-1 within 0.02

coordinates = st.floats(-1.0, 1.0)


@pytest.mark.parametrize("hardening", HARDENINGS)
def test_published_limits(hardening: str) -> None:
    rows = [row for row in LIMITS if row[COLUMNS[hardening]]]
    friction = [float(row["friction"]) for row in rows]
    published = [float(row[COLUMNS[hardening]]) for row in rows]
    np.testing.assert_allclose(
        shakedown_limit(friction, hardening), published, rtol=0.0, atol=PRINTED[hardening]
    )
    assert len(rows) >= 5


def test_table_equals_the_single_limits() -> None:
    """The table behind `shakedown_limit` is finer than 1e-3, and never on the unsafe side."""
    friction = np.array([0.0137, 0.118, 0.2071, 0.2683, 0.3071, 0.3493, 0.3739, 0.3757, 0.4])
    for hardening in HARDENINGS:
        exact = np.array([stress_circle(mu, None, hardening).limit for mu in friction.tolist()])
        error = shakedown_limit(friction, hardening) - exact
        assert error.min() > -3e-4
        assert error.max() < 1e-6


def test_place_of_first_yield() -> None:
    """0.300 p0 at a depth of 0.78 a without friction (Johnson, 1985), at the surface from 0.37 to 0.38 on."""
    first = stress_circle(0.0)
    assert first.radius == pytest.approx(0.300, abs=5e-4)
    assert first.x == pytest.approx((0.0,), abs=2e-3)
    assert first.depth == pytest.approx((0.78,), abs=0.01)
    # thesis, section 3.1.2: some 13 per cent more from mu = 0.1 to 0.3, and nearer to the surface
    assert stress_circle(0.3).radius / stress_circle(0.1).radius == pytest.approx(1.13, abs=0.005)
    depth = [stress_circle(mu).depth[0] for mu in (0.0, 0.1, 0.2, 0.3, 0.37)]
    assert np.all(np.diff(depth) < 0.0)
    assert depth[-1] > 0.1
    assert stress_circle(0.38).depth == (0.0,)
    np.testing.assert_allclose(shakedown_limit([0.38, 0.5, 0.9]), 1.0 / np.array([0.38, 0.5, 0.9]))


def test_tresca_is_that_of_the_plane_of_rolling() -> None:
    """With sigma_y first yield comes earlier under friction, by the numbers that the docstring states."""
    x, z = np.meshgrid(np.linspace(-2.0, 2.0, 401), np.linspace(0.0, 1.5, 151))
    for friction, in_plane, with_axle in ((0.0, 3.33, 3.33), (0.2, 3.13, 3.08), (0.35, 2.75, 2.45)):
        field = line_contact_stress(x, z, 1.0, 1.0, friction, poisson_ratio=0.28)
        assert stress_circle(friction).limit == pytest.approx(in_plane, abs=6e-3)
        assert 1.0 / field.principal_shear.max() == pytest.approx(in_plane, abs=6e-3)
        assert 1.0 / field.max_shear.max() == pytest.approx(with_axle, abs=6e-3)


def test_limits_fall_with_friction_and_rise_with_hardening() -> None:
    friction = np.linspace(0.0, 1.0, 401)
    limits = [shakedown_limit(friction, hardening) for hardening in HARDENINGS]
    for limit in limits:
        assert np.all(np.diff(limit) < 0.0)
    assert np.all(limits[0] <= limits[1] + 1e-4)
    assert np.all(limits[1] <= limits[2] + 1e-4)
    assert np.all(limits[2] <= np.minimum(4.0, 1.0 / np.maximum(friction, 1e-9)) * (1.0 + 1e-6))


@pytest.mark.parametrize("friction", [0.0, 0.1, 0.2, 0.3])
def test_perfectly_plastic_limit_is_the_orthogonal_shear_stress(friction: float) -> None:
    """No residual stress carries tau_xz, so the limit is at most 1/max|tau_xz/p0|, and here it is equal."""
    x, z = np.meshgrid(np.linspace(-2.0, 2.0, 401), np.linspace(0.0, 1.5, 151))
    shear = np.abs(line_contact_stress(x, z, 1.0, 1.0, friction).tau_xz).max()
    assert stress_circle(friction, None, "perfect").limit == pytest.approx(1.0 / shear, rel=2e-4)


@pytest.mark.parametrize(("friction", "ratio"), [(0.15, None), (0.3, None), (0.5, 0.2), (0.5, -0.4)])
def test_all_stresses_lie_in_the_circle_and_its_support_on_it(friction: float, ratio: float | None) -> None:
    generator = np.random.default_rng(5)
    x, z = generator.uniform(-2.5, 2.5, 20000), generator.exponential(0.4, 20000)
    x[:4000], z[:4000] = np.linspace(-1.0, 1.0, 4000), 0.0
    for hardening in HARDENINGS:
        circle = stress_circle(friction, ratio, hardening)

        def distance(x: object, z: object, centre: tuple[float, float] = circle.centre) -> np.ndarray:
            field = line_contact_stress(x, z, 1.0, 1.0, friction, traction_ratio=ratio)
            return np.hypot(0.5 * (field.sigma_x - field.sigma_z) - centre[0], field.tau_xz - centre[1])

        assert distance(x, z).max() <= circle.radius * (1.0 + 1e-5)
        np.testing.assert_allclose(distance(circle.x, circle.depth), circle.radius, rtol=1e-9)


def test_sense_of_the_traction() -> None:
    """A braked wheel is the mirror image of a driving one in full slip, but stick is at the leading edge."""
    driving, braked = stress_circle(0.2), stress_circle(0.2, -0.2)
    assert braked.limit == pytest.approx(driving.limit, rel=1e-6)
    np.testing.assert_allclose((braked.x[0], braked.depth[0]), (-driving.x[0], driving.depth[0]), atol=1e-3)
    for hardening in HARDENINGS:  # where the surface decides the sense is of no importance
        one, other = partial_slip_limit(0.5, [0.45, -0.45], hardening)
        assert one == pytest.approx(other, rel=1e-6)
    one, other = partial_slip_limit(0.4, [0.25, -0.25], "kinematic")
    assert one > other * 1.01


def test_partial_slip_of_johnson() -> None:
    """Friction 0.5, Q/P = 0.4: 2.236 (3.15) and (3.14), from the stresses of the whole body."""
    assert float(partial_slip_limit(0.5, 0.4, "kinematic")) == pytest.approx(2.236, abs=5e-4)
    slip = 1.0 - math.sqrt(0.2)
    by_hand = 1.0 / (0.5 * math.sqrt(slip) * (2.0 - slip))
    assert float(partial_slip_limit(0.5, 0.4, "perfect")) == pytest.approx(by_hand, rel=1e-5)
    for hardening in ("perfect", "kinematic"):
        for ratio in (0.4, 0.45, 0.49):
            surface = partial_slip_surface_limit(0.5, ratio, hardening)
            assert float(partial_slip_limit(0.5, ratio, hardening)) == pytest.approx(float(surface), rel=1e-5)
    # full slip at the same Q/P bears more: 2.5 (figure 3-11)
    assert float(shakedown_limit(0.4, "kinematic")) > float(partial_slip_limit(0.5, 0.4, "kinematic"))


def test_partial_slip_between_rolling_and_full_slip() -> None:
    for hardening in HARDENINGS:
        ends = partial_slip_limit(0.3, [0.0, 0.3], hardening)
        np.testing.assert_allclose(ends, shakedown_limit([0.0, 0.3], hardening), rtol=2e-4)
    ratio = np.array([0.05, 0.15, 0.25])
    elastic, perfect, kinematic = (partial_slip_limit(0.3, ratio, hardening) for hardening in HARDENINGS)
    assert np.all(elastic <= perfect)
    assert np.all(perfect <= kinematic)
    assert np.all(kinematic <= partial_slip_surface_limit(0.3, ratio) * (1.0 + 1e-6))
    assert partial_slip_surface_limit(0.5, 0.0) == np.inf


@given(st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=12))
def test_smallest_circle(points: list[tuple[float, float]]) -> None:
    """It holds all points, and two or three of them hold it: no centre nearby has a smaller radius."""
    array = np.array(points)
    for freedom in (FIXED, ON_AXIS, FREE):
        circle = smallest_circle(array, freedom)
        assert np.all(np.hypot(*(array - circle.centre).T) <= circle.radius + 1e-9)
        assert np.all(circle.centre[freedom:] == 0.0)
        if freedom == FIXED:
            continue

        def radius(centre: np.ndarray, freedom: int = freedom) -> float:
            whole = np.zeros(2)
            whole[:freedom] = centre
            return float(np.hypot(*(array - whole).T).max())

        directions = itertools.product((-1.0, 0.0, 1.0), repeat=freedom)
        for direction in directions:
            for step in (1e-3, 0.1):
                moved = circle.centre[:freedom] + step * np.array(direction)
                assert radius(moved) >= circle.radius - 1e-9


def test_smallest_circle_of_many_points() -> None:
    """Against a search, and by hand: around an obtuse triangle it stands on the longest side."""
    points = np.random.default_rng(8).normal(size=(2000, 2))
    found = minimize(
        lambda c: float(np.hypot(*(points - c).T).max()), np.zeros(2), method="Nelder-Mead",
        options={"xatol": 1e-9, "fatol": 1e-12, "maxiter": 4000},
    )  # fmt: skip
    circle = smallest_circle(points)
    assert circle.radius == pytest.approx(found.fun, rel=1e-7)
    assert circle.radius <= found.fun * (1.0 + 1e-12)
    blunt = smallest_circle(np.array([[0.0, 0.0], [4.0, 0.0], [1.0, 0.5]]))
    np.testing.assert_allclose(blunt.centre, [2.0, 0.0])
    assert blunt.support == (0, 1) or blunt.support == (1, 0)
    right = smallest_circle(np.array([[3.0, 0.0], [0.0, 4.0], [0.0, 0.0]]))
    assert right.radius == pytest.approx(2.5)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: shakedown_limit([0.1, -0.1]), "friction must be >= 0"),
        (lambda: shakedown_limit(math.nan), "friction must be finite"),
        (lambda: shakedown_limit(0.1, "isotropic"), "hardening = 'isotropic'; allowed: elastic, perfect"),
        (lambda: partial_slip_limit(0.3, 0.31), r"traction_ratio = 0.31 \[-\]; it must lie in -0.3..0.3"),
        (lambda: partial_slip_surface_limit(0.3, 0.31), "at most the friction"),
        (lambda: partial_slip_surface_limit(0.3, 0.1, "elastic"), "allowed here: perfect, kinematic"),
        (lambda: smallest_circle(np.zeros((0, 2))), "n at least 1"),
    ],
)
def test_bad_input_is_named(call: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()


def largest_orthogonal_shear(friction: float) -> float:
    """Largest |tau_xz|/p0 below a circular patch in full slip: the point force solutions, integrated anew.

    On a plain square grid of sources, by scanning x and z: another rule than the one behind the table.
    """
    count = 400
    line = (np.arange(count) + 0.5) * 2.0 / count - 1.0
    x_source, y_source = (array.ravel() for array in np.meshgrid(line, line))
    inside = x_source**2 + y_source**2 < 1.0
    x_source, y_source = x_source[inside], y_source[inside]
    load = np.sqrt(1.0 - x_source**2 - y_source**2) * (2.0 / count) ** 2
    largest = 0.0
    for z in np.linspace(0.26, 0.36, 11):
        for x in np.linspace(0.82, 0.87, 6):
            way = x - x_source
            distance = (way * way + y_source**2 + z * z) ** 2.5
            shear = 1.5 / np.pi * np.sum(load * (way * z * z + friction * way * way * z) / distance)
            largest = max(largest, abs(float(shear)))
    return largest


@pytest.mark.parametrize("friction", [0.0, 0.1, 0.2, 0.3])
def test_subsurface_limit_is_the_orthogonal_shear_stress(friction: float) -> None:
    expected = 1.0 / max(largest_orthogonal_shear(friction), friction)
    assert float(point_contact_limit(friction)) == pytest.approx(expected, rel=1e-3)


def test_published_ends_of_the_limit() -> None:
    """4.7 at mu = 0, and 1/mu above about 0.3 (Hossein-Nia 2018, sections 3.1.3 and 3.1.4)."""
    assert round(float(point_contact_limit(0.0)), 1) == 4.7
    friction = np.linspace(0.31, 1.0, 30)
    np.testing.assert_allclose(point_contact_limit(friction), 1.0 / friction)
    whole = point_contact_limit(np.linspace(0.0, 1.0, 1001))
    assert np.all(np.diff(whole) < 0.0)
    with pytest.raises(ValueError, match="friction must be >= 0"):
        point_contact_limit([-0.1, 0.2])


def test_working_points(random_log: pyarrow.Table) -> None:
    points = working_points(random_log, 300e6, FLANGE_CONTACT_ANGLE)
    assert points.utilised_friction.size == random_log.num_rows
    assert points.flange.sum() == np.count_nonzero(random_log["patch"].to_numpy() == 1)
    assert np.all(points.utilised_friction <= 0.4 * (1.0 + 1e-9))  # Coulomb
    utilised, pressure = working_point(3e3, 4e3, np.array([10e3, 0.0]), 900e6, 300e6)
    np.testing.assert_allclose(utilised, [0.5, 0.0])
    assert pressure == pytest.approx(3.0)
