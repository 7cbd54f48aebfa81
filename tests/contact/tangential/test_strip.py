"""Strip theory: that its tractions solve the half-plane, its slender limit, and where it fails."""

import math

import numpy as np
import pytest

from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.tangential.api import creep_force, traction_field
from hh_exudyn.contact.tangential.validation import exact_forces, force_error

A, B, N, MU = 2e-3, 1e-2, 1e5, 0.3
P_MAX = 1.5 * N / (math.pi * A * B)
LIMIT = 2.0 * MU * P_MAX / STEEL.shear_modulus  # lateral creepage of full slip in the middle strip
SPIN_LIMIT = LIMIT / A  # spin of |psi| = 1


def strain(values: np.ndarray, x: np.ndarray, compliance: float) -> np.ndarray:
    """du/dx between the cells of a strip from its tractions: -compliance/pi PV integral of q/(x - s) ds."""
    step = x[1] - x[0]
    between = 0.5 * (x[1:] + x[:-1])
    return -compliance / math.pi * np.sum(values[None, :] * step / (between[:, None] - x[None, :]), axis=1)


@pytest.mark.parametrize(
    "scaled",
    [(0.3, 0.0, 0.0), (0.0, 0.4, 0.0), (0.2, -0.2, 0.0), (0.1, 0.2, 0.3), (0.1, -0.3, 0.6), (0.0, 0.0, 0.5)],
)
def test_the_tractions_solve_the_half_plane(scaled: tuple[float, float, float]) -> None:
    """Strip by strip: rigid slip less the strain of two half-planes under q is the slip, zero in stick.

    Longitudinal tractions strain in plane strain, lateral ones in antiplane shear.
    """
    nu_x, nu_y, phi = scaled[0] * LIMIT, scaled[1] * LIMIT, scaled[2] * SPIN_LIMIT
    field = traction_field("strip", A, B, N, nu_x, nu_y, phi, MU, cells=(2000, 7))
    slipping = 0
    for j in range(7):
        x = field.x[j]
        between = 0.5 * (x[1:] + x[:-1])
        plane = 2.0 * (1.0 - STEEL.poisson_ratio) / STEEL.shear_modulus
        expected_x = nu_x - phi * field.y[j, 0] - strain(field.q_x[j], x, plane)
        expected_y = nu_y + phi * between - strain(field.q_y[j], x, 2.0 / STEEL.shear_modulus)
        found_x = 0.5 * (field.slip_x[j, 1:] + field.slip_x[j, :-1])
        found_y = 0.5 * (field.slip_y[j, 1:] + field.slip_y[j, :-1])
        slip, traction = np.hypot(field.slip_x[j], field.slip_y[j]), np.hypot(field.q_x[j], field.q_y[j])
        # slip that would run along the traction counts as none: only in strips without a stick zone
        cut = (slip == 0.0) & (traction > MU * field.pressure[j] * (1.0 - 1e-9))
        assert not cut.any() or np.all(traction > MU * field.pressure[j] * (1.0 - 1e-9))
        inner = ~(cut[1:] | cut[:-1])
        inner[:25] = inner[-25:] = False
        assert found_x[inner] == pytest.approx(expected_x[inner], abs=0.012 * LIMIT)
        assert found_y[inner] == pytest.approx(expected_y[inner], abs=0.012 * LIMIT)
        slipping += int(np.sum(slip > 0.0))
    assert 0 < slipping < 7 * 2000


def test_slopes_are_those_of_a_slender_patch() -> None:
    """C11 = pi^2/4/(1 - nu), C22 = pi^2/4, and C23 = pi/3 sqrt(a/b): Kalker's limits (C23: at nu = 0)."""
    small, cells = 1e-9, (10, 400)
    for poisson_ratio in (0.0, 0.28, 0.5):
        material = Material(STEEL.shear_modulus, poisson_ratio)
        unit = material.shear_modulus * A * B
        along = creep_force("strip", A, B, N, small, 0.0, 0.0, MU, material, cells)
        across = creep_force("strip", A, B, N, 0.0, small, 0.0, MU, material, cells)
        spin = creep_force("strip", A, B, N, 0.0, 0.0, small / A, MU, material, cells)
        assert along.x == pytest.approx(-(math.pi**2) / 4.0 / (1.0 - poisson_ratio) * unit * small, rel=1e-3)
        assert across.y == pytest.approx(-(math.pi**2) / 4.0 * unit * small, rel=1e-3)
        assert spin.y == pytest.approx(-math.pi / 3.0 * unit * small, rel=1e-3)


@pytest.mark.parametrize(
    ("scaled", "poisson_ratio"),
    [((0.3, 0.0), 0.28), ((0.0, 0.5), 0.28), ((3.0, 0.0), 0.28), ((0.2, -0.3), 0.0)],
)
def test_it_is_fastrip_where_the_adjustment_factors_are_one(
    scaled: tuple[float, float], poisson_ratio: float
) -> None:
    """In a patch 10 000 times wider than long; under two creepages their directions agree for nu = 0."""
    a, b = 5e-5, 0.5
    material = Material(STEEL.shear_modulus, poisson_ratio)
    limit = 2.0 * MU * 1.5 * N / (math.pi * a * b) / STEEL.shear_modulus
    creepage = (scaled[0] * limit, scaled[1] * limit, 0.0)
    one = creep_force("strip", a, b, N, *creepage, MU, material, cells=(200, 100))
    other = creep_force("fastrip", a, b, N, *creepage, MU, material, cells=(200, 100))
    assert (one.x, one.y) == pytest.approx((other.x, other.y), abs=1.5e-3 * MU * N)
    assert max(abs(one.x), abs(one.y)) > 0.2 * MU * N


def errors(ratio: float, *, spin: bool) -> list[float]:
    return [
        force_error("strip", exact)
        for exact in exact_forces()
        if abs(exact.case.a / exact.case.b - ratio) < 0.01 and (exact.case.phi != 0.0) == spin
    ]


def test_it_is_for_slender_patches() -> None:
    """Kalker (1967): close for a narrow ellipse, up to 25 % off for a circle without spin."""
    trend = [np.mean(errors(ratio, spin=False)) for ratio in (0.2, 0.5, 1.0, 2.0, 5.0)]
    # measured 1.2, 3.2, 6.9, 12.9, 24.2 % of mu N
    assert np.all(np.diff(trend) > 0.0)
    assert trend[0] < 0.015
    assert 0.05 < trend[2] < 0.10
    assert trend[4] > 0.2
    longitudinal = [
        force_error("strip", exact)
        for exact in exact_forces()
        if abs(exact.case.a / exact.case.b - 0.2) < 0.01 and exact.case.nu_y == exact.case.phi == 0.0
    ]
    assert max(longitudinal) < 0.007  # measured 0.64 %


def test_spin_beyond_its_limit_slips_as_a_whole() -> None:
    field = traction_field("strip", A, B, N, 0.0, 0.0, 1.01 * SPIN_LIMIT, MU, cells=(40, 41))
    traction = np.hypot(field.q_x, field.q_y)
    rest = [j for j in range(41) if j != 20]
    assert traction[rest] == pytest.approx(MU * field.pressure[rest], rel=1e-9)
    assert not traction[20].any()  # the middle strip turns about its own middle
    force = creep_force("strip", A, B, N, 0.0, 0.0, 1.01 * SPIN_LIMIT, MU)
    assert abs(force.y) < 1e-9 * MU * N
    assert force.moment < 0.0
