"""Carter's line contact: his closed curve, and that his tractions solve the half-plane."""

import math

import numpy as np
import pytest

from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.tangential.api import cell_areas, creep_force, traction_field

A, B, N, MU = 4e-3, 9e-3, 1e5, 0.3
P_MAX = 1.5 * N / (math.pi * A * B)
SATURATION = 4.0 * MU * P_MAX * (1.0 - STEEL.poisson_ratio**2) / STEEL.young_modulus  # of equation 2.19


@pytest.mark.parametrize("share", [-1.3, -0.7, -1e-3, 0.02, 0.5, 0.999, 1.0, 4.0])
def test_the_closed_curve(share: float) -> None:
    nu_x = share * SATURATION
    stick = max(A - abs(nu_x) * STEEL.young_modulus * A / (4.0 * MU * P_MAX * (1.0 - 0.28**2)), 0.0)  # (2.19)
    force = creep_force("carter", A, B, N, nu_x, 0.0, 0.0, MU)
    assert force.x == pytest.approx(
        -math.copysign(MU * N * (1.0 - (stick / A) ** 2), nu_x), rel=1e-12
    )  # (2.20)
    assert force.y == force.moment == 0.0


def test_full_friction_is_reached_without_a_kink() -> None:
    just_below = creep_force("carter", A, B, N, SATURATION * (1.0 - 1e-4), 0.0, 0.0, MU)
    assert creep_force("carter", A, B, N, SATURATION, 0.0, 0.0, MU).x == pytest.approx(-MU * N, rel=1e-12)
    assert just_below.x == pytest.approx(-MU * N, rel=2e-8)


def test_slope_against_kalker() -> None:
    """2 pi/3/(1 - nu) instead of pi^2/4/(1 - nu): the line carries the peak pressure over 4/3 b."""
    small = 1e-9
    slope = -creep_force("carter", A, B, N, small, 0.0, 0.0, MU).x / small / (STEEL.shear_modulus * A * B)
    assert slope == pytest.approx(2.0 * math.pi / 3.0 / (1.0 - STEEL.poisson_ratio), rel=1e-6)


def test_lateral_creepage_and_spin_are_ignored() -> None:
    alone = creep_force("carter", A, B, N, 1e-3, 0.0, 0.0, MU)
    assert creep_force("carter", A, B, N, 1e-3, 5e-3, 2.0, MU) == alone
    nothing = creep_force("carter", A, B, N, 0.0, 5e-3, 2.0, MU)
    assert (abs(nothing.x), nothing.y, nothing.moment) == (0.0, 0.0, 0.0)


def strain(values: np.ndarray, x: np.ndarray, compliance: float) -> np.ndarray:
    """du/dx between the cells of a strip from its tractions: -compliance/pi PV integral of q/(x - s) ds."""
    step = x[1] - x[0]
    between = 0.5 * (x[1:] + x[:-1])
    return -compliance / math.pi * np.sum(values[None, :] * step / (between[:, None] - x[None, :]), axis=1)


@pytest.mark.parametrize("share", [0.3, -0.8, 1.5])
def test_slip_is_creepage_less_strain(share: float) -> None:
    """The tractions of the middle strip, put on two half-planes, give the slip: zero where it sticks."""
    nu_x = share * SATURATION
    field = traction_field("carter", A, B, N, nu_x, 0.0, 0.0, MU, cells=(2000, 3))
    x, q, slip = field.x[1], field.q_x[1], field.slip_x[1]
    compliance = 2.0 * (1.0 - STEEL.poisson_ratio) / STEEL.shear_modulus  # of both bodies, plane strain
    expected = nu_x - strain(q, x, compliance)
    inner = slice(20, -20)
    found = 0.5 * (slip[1:] + slip[:-1])
    assert found[inner] == pytest.approx(expected[inner], abs=0.01 * SATURATION)


def test_stress_stays_under_the_hertz_pressure_and_adds_up() -> None:
    field = traction_field("carter", A, B, N, 0.4 * SATURATION, 0.0, 0.0, MU, cells=(100, 100))
    areas = cell_areas(A, B, 100, 100)
    assert np.all(np.abs(field.q_x) <= MU * field.pressure * (1.0 + 1e-12))
    assert field.pressure.max() == pytest.approx(P_MAX, rel=1e-3)
    assert np.sum(field.q_x * areas) == pytest.approx(-MU * N * (1.0 - 0.6**2), rel=2e-3)
    dissipated = np.sum(field.q_x * field.slip_x * areas)
    assert dissipated == pytest.approx(-MU * N * (1.0 - 0.6**2) * 0.4 * SATURATION, rel=2e-3)
