"""Hertz: exact identities of the elliptic contact, and the kernel's table against the exact solution."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import ellipe, ellipkm1

from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.normal.hertz import hertz_patch, normal_contact

# E* of two equal bodies: 1/E* = 2 (1 - nu^2)/E
MODULUS = STEEL.shear_modulus / (1.0 - STEEL.poisson_ratio)
CURVATURES = st.floats(0.05, 500.0)
FORCES = st.floats(1.0, 1e6)


def curvatures_of(ratio: float) -> tuple[float, float]:
    """Curvatures A, B [1/m] of an ellipse of ratio a/b, from E and K (Johnson 1985, equations 3.36)."""
    k = min(ratio, 1.0 / ratio)
    m = 1.0 - k * k
    if m == 0.0:
        return 1.0, 1.0
    big_k, big_e = ellipkm1(k * k), ellipe(m)
    along_short, along_long = (big_e / k**2 - big_k) / m, (big_k - big_e) / m
    return (along_long, along_short) if ratio > 1.0 else (along_short, along_long)


@pytest.mark.parametrize("ratio", [0.05, 0.1, 0.3, 0.7, 0.99, 1.0, 1.2, 2.5, 8.0, 20.0])
def test_the_ratio_of_the_axes_solves_the_elliptic_equation(ratio: float) -> None:
    patch = hertz_patch(1e5, *curvatures_of(ratio))
    assert patch.a / patch.b == pytest.approx(ratio, rel=1e-6)


def test_a_sphere_on_a_plane_has_the_closed_solution() -> None:
    radius, force = 0.46, 1e5
    patch = hertz_patch(force, 0.5 / radius, 0.5 / radius)
    a = (0.75 * force * radius / MODULUS) ** (1.0 / 3.0)  # Johnson 1985, equation 4.22
    assert patch.a == pytest.approx(a, rel=1e-9)
    assert patch.b == pytest.approx(a, rel=1e-9)
    assert patch.approach == pytest.approx(a * a / radius, rel=1e-9)


@given(FORCES, CURVATURES, CURVATURES)
def test_pressure_and_force_and_gap_fit_together(force: float, big_a: float, big_b: float) -> None:
    patch = hertz_patch(force, big_a, big_b)
    assert 2.0 / 3.0 * math.pi * patch.a * patch.b * patch.max_pressure == pytest.approx(force, rel=1e-9)
    # displacement of a semi-ellipsoidal pressure on the axes, by quadrature instead of elliptic integrals:
    # approach = (p0 a b / E*) integral dt / sqrt((a^2 + t^2)(b^2 + t^2)), Johnson 1985 equation 3.40
    a, b = patch.a, patch.b
    value, _ = quad(lambda w: 1.0 / math.hypot(b * math.cos(w), a * math.sin(w)), 0.0, 0.5 * math.pi)
    approach = patch.max_pressure * a * b / MODULUS * value
    assert patch.approach == pytest.approx(approach, rel=1e-6)


@given(FORCES, CURVATURES, CURVATURES)
def test_swapping_the_directions_swaps_the_axes(force: float, big_a: float, big_b: float) -> None:
    one, other = hertz_patch(force, big_a, big_b), hertz_patch(force, big_b, big_a)
    assert (one.a, one.b) == pytest.approx((other.b, other.a), rel=1e-12)


@pytest.mark.parametrize("ratio", np.geomspace(0.05, 20.0, 41))
def test_the_kernel_meets_the_exact_solution(ratio: float) -> None:
    big_a, big_b = curvatures_of(ratio)
    patch = hertz_patch(8e4, big_a, big_b)
    found = normal_contact(patch.approach, big_a, big_b, STEEL.shear_modulus, STEEL.poisson_ratio)
    assert found == pytest.approx((8e4, patch.a, patch.b, patch.max_pressure), rel=1e-6)


def test_the_kernel_is_smooth_where_the_axes_change_places() -> None:
    h = 1e-3
    force = [
        normal_contact(1e-4, 1.0 + x, 1.0 - x, STEEL.shear_modulus, STEEL.poisson_ratio)[1]
        for x in (-h, 0.0, h)
    ]
    left, right = force[1] - force[0], force[2] - force[1]
    assert left == pytest.approx(right, rel=5e-3)
    assert left < 0.0


def test_the_kernel_clamps_slender_patches_and_knows_no_contact() -> None:
    _, a, b, _ = normal_contact(1e-5, 1e-9, 10.0, STEEL.shear_modulus, STEEL.poisson_ratio)
    assert a / b == pytest.approx(300.0, rel=0.05)
    assert normal_contact(0.0, 1.0, 1.0, 82e9, 0.28) == (0.0, 0.0, 0.0, 0.0)
    assert normal_contact(-1e-3, 1.0, 1.0, 82e9, 0.28) == (0.0, 0.0, 0.0, 0.0)


def test_no_force_is_no_patch() -> None:
    patch = hertz_patch(0.0, 1.0, 2.0)
    assert (patch.a, patch.b, patch.max_pressure, patch.approach) == (0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ((-1.0, 1.0, 1.0), "normal_force"),
        ((math.nan, 1.0, 1.0), "normal_force"),
        ((1.0, 0.0, 1.0), "curvature_x"),
        ((1.0, 1.0, -2.0), "curvature_y"),
        ((1.0, 1e-9, 1e3), "ratio"),
    ],
)
def test_bad_input_is_named(arguments: tuple[float, float, float], name: str) -> None:
    with pytest.raises(ValueError, match=name):
        hertz_patch(*arguments)


def test_the_material_checks_itself() -> None:
    assert STEEL.young_modulus == pytest.approx(209.92e9)
    with pytest.raises(ValueError, match="shear_modulus"):
        Material(0.0, 0.3)
    with pytest.raises(ValueError, match="poisson_ratio"):
        Material(82e9, 0.51)
