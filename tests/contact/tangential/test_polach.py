"""Polach's formulas: limits, Coulomb's law, the factors of 2005, and the exact solution."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.tangential.api import creep_force, traction_field
from hh_exudyn.contact.tangential.polach import Contamination, polach_force
from hh_exudyn.contact.tangential.validation import exact_forces, force_error
from hh_exudyn.contact.types import RollingPatch

A, B, N, MU = 6e-3, 5e-3, 1e5, 0.35
PURE = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 200.0), (0.0, 1.0, 200.0), (0.0, 1.0, -500.0)]


@pytest.fixture(scope="module", autouse=True)
def compiled() -> None:
    """Compile before the first property is timed."""
    creep_force("fastrip", A, B, N, 1e-3, 0.0, 0.0, MU)


@pytest.mark.parametrize("direction", PURE)
@pytest.mark.parametrize("ratio", [0.1, 1.0, 8.0])
def test_its_linear_range_is_kalkers(direction: tuple[float, float, float], ratio: float) -> None:
    creepage = [1e-8 * value for value in direction]
    a, b = 5e-3 * math.sqrt(ratio), 5e-3 / math.sqrt(ratio)
    found = creep_force("polach", a, b, N, *creepage, MU)
    exact = creep_force("linear", a, b, N, *creepage, MU)
    assert (found.x, found.y) == pytest.approx((exact.x, exact.y), rel=1e-3)


def test_the_curve_without_spin() -> None:
    """2/pi (e/(1 + e^2) + arctan e), e = 1 where the gradients of traction and bound are equal."""
    unit = 1e-9
    slope = -creep_force("linear", A, B, N, unit, 0.0, 0.0, MU).x / unit
    for scaled in (0.3, 1.0, 5.0):
        nu_x = scaled * MU * N * 4.0 / math.pi / slope
        expected = 2.0 / math.pi * (scaled / (1.0 + scaled**2) + math.atan(scaled))
        assert creep_force("polach", A, B, N, nu_x, 0.0, 0.0, MU).x == pytest.approx(-MU * N * expected)


@pytest.mark.parametrize("ratio", [0.2, 1.0, 5.0])
@pytest.mark.parametrize("creepage", [(1e-3, 0.0), (5e-3, 0.0), (0.0, 3e-3)])
def test_without_spin_it_is_fastsim_with_the_elliptic_bound(
    ratio: float, creepage: tuple[float, float]
) -> None:
    """Both let the traction grow linearly up to friction * Hertz pressure: in closed form, and in cells."""
    a, b = 5e-3 * math.sqrt(ratio), 5e-3 / math.sqrt(ratio)
    formula = creep_force("polach", a, b, N, *creepage, 0.0, MU)
    marched = creep_force("fastsim_elliptic", a, b, N, *creepage, 0.0, MU, cells=(400, 400))
    assert (formula.x, formula.y) == pytest.approx((marched.x, marched.y), abs=1e-4 * MU * N)


CREEPAGE = st.one_of(st.floats(-0.5, 0.5), st.floats(-0.02, 0.02))


@given(st.floats(-3.0, 3.0), CREEPAGE, CREEPAGE, st.one_of(st.floats(-60.0, 60.0), st.floats(-1.0, 1.0)))
def test_coulomb(log_ratio: float, nu_x: float, nu_y: float, phi: float) -> None:
    a, b = 5e-3 * math.exp(0.5 * log_ratio), 5e-3 * math.exp(-0.5 * log_ratio)
    force = creep_force("polach", a, b, N, nu_x, nu_y, phi, MU)
    assert math.hypot(force.x, force.y) <= MU * N * (1.0 + 1e-9)
    assert force.moment == 0.0


def test_the_force_of_spin_vanishes_where_spin_is_large() -> None:
    """The patch turns on the spot; without differences of nearly equal numbers."""
    forces = [creep_force("polach", A, B, N, 0.0, 0.0, phi, MU).y / (MU * N) for phi in (1.0, 30.0, 1e3, 1e6)]
    assert all(force < 0.0 for force in forces)
    assert np.all(np.diff(forces) > 0.0)
    # the scaled spin is proportional to phi, the force falls with its third power
    assert forces[3] / forces[2] == pytest.approx(1e-9, rel=1e-2)


def rolling(nu_x: float, nu_y: float = 0.0, phi: float = 0.0) -> RollingPatch:
    """A patch of steel."""
    return RollingPatch(A, B, N, nu_x, nu_y, phi, MU, STEEL.shear_modulus, STEEL.poisson_ratio)


def test_reduced_stiffness() -> None:
    """The slope at zero is (k_A + k_S)/2 of the clean surface's; full friction stays."""
    clean, wet = Contamination(), Contamination(k_adhesion=0.3, k_slip=0.1)
    slope = polach_force(rolling(1e-8), wet)[0] / polach_force(rolling(1e-8), clean)[0]
    assert slope == pytest.approx(0.2, rel=1e-6)
    assert polach_force(rolling(50.0), wet)[0] == pytest.approx(-MU * N, rel=2e-3)
    same = creep_force("polach", A, B, N, 1e-3, 2e-3, 0.3, MU)
    assert polach_force(rolling(1e-3, 2e-3, 0.3), clean) == pytest.approx((same.x, same.y))


def test_falling_friction_has_an_optimum() -> None:
    creepages = np.linspace(1e-4, 0.3, 600)
    wet = Contamination(k_slip=0.4, friction_ratio=0.4, friction_decrease=0.6)
    forces = [-polach_force(rolling(nu_x), wet, speed=15.0)[0] for nu_x in creepages]
    best = int(np.argmax(forces))
    assert 0 < best < 599
    assert max(forces) < MU * N
    assert forces[-1] < 0.8 * max(forces)
    falling = Contamination(friction_ratio=0.4, friction_decrease=0.6)
    at_rest = polach_force(rolling(5.0), falling, speed=15.0)
    assert at_rest[0] == pytest.approx(-0.4 * MU * N, rel=5e-3)  # friction of infinite slip velocity


def test_against_the_exact_solution() -> None:
    without, with_spin = [], []
    for exact in exact_forces():
        (without if exact.case.phi == 0.0 else with_spin).append(force_error("polach", exact))
    assert (len(without), len(with_spin)) == (90, 95)
    assert np.mean(without) < 0.025  # measured 2.3 %
    assert max(without) < 0.09  # 8.0 %
    # measured 10.3 %: the formulas for spin are a fit, far off for spin against creepage in slender patches
    assert np.mean(with_spin) < 0.11


def test_no_stress_field() -> None:
    with pytest.raises(ValueError, match=r"polach.*no stress field"):
        traction_field("polach", A, B, N, 1e-3, 0.0, 0.0, MU)


@pytest.mark.parametrize(
    ("change", "name"),
    [
        ({"k_slip": 0.0}, "k_slip = 0.0"),
        ({"k_adhesion": 0.2, "k_slip": 0.3}, "k_adhesion = 0.2"),
        ({"friction_ratio": 1.1}, "friction_ratio"),
        ({"friction_decrease": -1.0}, "friction_decrease"),
        ({"speed": math.inf}, "speed"),
        ({"friction": 0.0}, "friction = 0.0"),
        ({"a": 0.0}, "a = 0.0 m"),
        ({"nu_y": math.nan}, "nu_y"),
    ],
)
def test_bad_input_is_named(change: dict[str, float], name: str) -> None:
    patch = {key: value for key, value in change.items() if key in RollingPatch._fields}
    surface = {key: value for key, value in change.items() if key not in {*patch, "speed"}}
    with pytest.raises(ValueError, match=name):
        polach_force(rolling(0.0)._replace(**patch), Contamination(**surface), speed=change.get("speed", 0.0))
