"""Kalker's linear theory, and that every other theory meets it at vanishing creepage."""

import math

import pytest

from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.tangential.api import CreepForce, creep_force, traction_field
from hh_exudyn.contact.tangential.kalker import kalker_coefficients

N, MU = 1e5, 0.3
RATIOS = [0.2, 1.0, 5.0]
SMALL = 1e-8
SATURATING = ["fastsim", "fastsim_single", "fastsim_elliptic", "fastrip", "polach"]


def axes(ratio: float) -> tuple[float, float]:
    return 5e-3 * math.sqrt(ratio), 5e-3 / math.sqrt(ratio)


@pytest.mark.parametrize("ratio", RATIOS)
def test_slopes_are_kalkers_coefficients(ratio: float) -> None:
    a, b = axes(ratio)
    size = math.sqrt(a * b)
    c11, c22, c23, c33 = kalker_coefficients(ratio, STEEL.poisson_ratio)
    unit = STEEL.shear_modulus * a * b
    along = creep_force("linear", a, b, N, 2e-3, 0.0, 0.0, MU)
    assert (along.x, along.y, along.moment) == pytest.approx((-c11 * unit * 2e-3, 0.0, 0.0), rel=1e-12)
    across = creep_force("linear", a, b, N, 0.0, 2e-3, 0.0, MU)
    assert (across.x, across.y) == pytest.approx((0.0, -c22 * unit * 2e-3), rel=1e-12)
    assert across.moment == pytest.approx(c23 * unit * size * 2e-3, rel=1e-12)
    spin = creep_force("linear", a, b, N, 0.0, 0.0, 0.5, MU)
    assert (spin.x, spin.y) == pytest.approx((0.0, -c23 * unit * size * 0.5), rel=1e-12)
    assert spin.moment == pytest.approx(-c33 * unit * size**2 * 0.5, rel=1e-12)


def test_it_superposes_and_knows_no_limit() -> None:
    a, b = axes(2.0)
    whole = creep_force("linear", a, b, N, 0.1, -0.2, 3.0, MU)
    parts = [creep_force("linear", a, b, N, *c, MU) for c in ((0.1, 0, 0), (0, -0.2, 0), (0, 0, 3.0))]
    assert whole.x == pytest.approx(sum(part.x for part in parts))
    assert whole.y == pytest.approx(sum(part.y for part in parts))
    assert whole.moment == pytest.approx(sum(part.moment for part in parts))
    assert math.hypot(whole.x, whole.y) > 10.0 * MU * N


def test_it_has_no_stress_field() -> None:
    with pytest.raises(ValueError, match=r"linear.*no stress field.*carter, strip, fastsim.*fastrip"):
        traction_field("linear", *axes(1.0), N, 1e-3, 0.0, 0.0, MU)


def both(theory: str, ratio: float, creepage: tuple[float, float, float]) -> tuple[CreepForce, CreepForce]:
    a, b = axes(ratio)
    arguments = (a, b, N, *creepage, MU)
    return creep_force(theory, *arguments, cells=(1000, 100)), creep_force("linear", *arguments)


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("theory", SATURATING)
def test_all_theories_start_with_its_slopes(theory: str, ratio: float) -> None:
    # 1000 cells along: FASTSIM sums the ramp of stick tractions to first order (2 % low at 50, 5 % at 20)
    found, exact = both(theory, ratio, (SMALL, 0.0, 0.0))
    assert found.x == pytest.approx(exact.x, rel=2e-3)
    found, exact = both(theory, ratio, (0.0, SMALL, 0.0))
    assert found.y == pytest.approx(exact.y, rel=2e-3)
    found, exact = both(theory, ratio, (0.0, 0.0, SMALL))
    assert found.y == pytest.approx(exact.y, rel=5e-3)


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("theory", ["fastsim", "fastsim_elliptic", "fastrip"])
def test_three_flexibilities_superpose(theory: str, ratio: float) -> None:
    creepage = (SMALL, 0.7 * SMALL, 60.0 * SMALL)
    found, exact = both(theory, ratio, creepage)
    assert found.x == pytest.approx(exact.x, rel=5e-3)
    assert found.y == pytest.approx(exact.y, rel=5e-3)
