"""Steady rolling of half-spaces: Coulomb's law, limits, mirror image, energy, convergence."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hh_exudyn.contact.halfspace.ellipse import hertz_pressure
from hh_exudyn.contact.halfspace.influence import Grid, Influence
from hh_exudyn.contact.halfspace.rolling import RollingSolution, rigid_slip, rolling_contact
from hh_exudyn.contact.material import STEEL

A, B, N, MU = 6e-3, 4e-3, 1e5, 0.3
CREEPAGE = st.one_of(st.floats(-0.02, 0.02), st.floats(-1e-4, 1e-4), st.just(0.0))


def ellipse(a: float = A, b: float = B, cells: int = 24) -> tuple[Influence, np.ndarray]:
    influence = Influence(Grid(cells, cells, 2.0 * a / cells, 2.0 * b / cells), STEEL)
    return influence, MU * hertz_pressure(influence, a, b, N)


def check_coulomb(influence: Influence, bound: np.ndarray, rigid: np.ndarray, found: RollingSolution) -> None:
    """All conditions, with the slip computed anew; its scale: what the largest bound makes of it."""
    slip = rigid + influence.slip(found.traction)
    traction = np.hypot(*found.traction)
    unit = max(influence.own_slip) * bound.max()
    assert np.all(traction <= bound * (1.0 + 1e-12))
    assert np.all(np.hypot(*slip)[found.stick] <= 1.5e-4 * unit)
    slides = (bound > 0.0) & ~found.stick
    assert np.all(traction[slides] >= bound[slides] - 1.5e-4 * bound.max())
    against = np.sum(found.traction * slip, axis=0)
    # opposite: the traction that slip would turn to, |q x s|/(q t + s) with t = 1/own, is small, and q.s < 0
    cross = np.abs(found.traction[0] * slip[1] - found.traction[1] * slip[0])
    size = np.hypot(*slip)
    turned = cross / np.maximum(bound * max(influence.own_slip) + size, 1e-300)
    assert np.all(turned[slides] <= 1.5e-4 * bound.max())
    felt = slides & (size > 1e-3 * unit)
    assert np.all(against[felt & (bound > 1e-3 * bound.max())] < 0.0)
    assert found.dissipation >= 0.0
    assert found.residual <= 1e-4


@settings(max_examples=60)
@given(st.floats(-3.0, 3.0), CREEPAGE, CREEPAGE, st.floats(-8.0, 8.0), st.integers(8, 26))
def test_coulomb(log_ratio: float, nu_x: float, nu_y: float, phi: float, cells: int) -> None:
    a, b = 5e-3 * math.exp(0.5 * log_ratio), 5e-3 * math.exp(-0.5 * log_ratio)
    influence, bound = ellipse(a, b, cells)
    rigid = rigid_slip(influence, nu_x, nu_y, phi)
    check_coulomb(influence, bound, rigid, rolling_contact(influence, bound, rigid))


@settings(max_examples=20)
@given(st.integers(0, 10**6))
def test_coulomb_with_any_pressure_and_slip(seed: int) -> None:
    """Two patches of any outline, and a rigid slip that varies all over."""
    rng = np.random.default_rng(seed)
    influence = Influence(Grid(30, 20, 3e-4, 4e-4), STEEL)
    x, y = np.meshgrid(influence.grid.x, influence.grid.y)
    bound = sum(
        3e8 * np.sqrt(np.maximum(1.0 - ((x - c) / 2e-3) ** 2 - ((y - d) / 1.5e-3) ** 2, 0.0))
        for c, d in rng.uniform(-2e-3, 2e-3, (2, 2))
    )
    waves = rng.normal(size=(2, 3)) @ np.stack([x / 5e-3, y / 5e-3, np.ones(x.shape)]).reshape(3, -1)
    rigid = 2e-3 * waves.reshape(2, *x.shape)
    check_coulomb(influence, bound, rigid, rolling_contact(influence, bound, rigid))


def test_mirror() -> None:
    influence, bound = ellipse()
    one = rolling_contact(influence, bound, rigid_slip(influence, 1e-3, 8e-4, 0.3), tolerance=1e-7)
    other = rolling_contact(influence, bound, rigid_slip(influence, 1e-3, -8e-4, -0.3), tolerance=1e-7)
    flipped = other.traction[:, ::-1] * np.array([1.0, -1.0])[:, None, None]
    assert flipped == pytest.approx(one.traction, abs=1e-5 * bound.max())
    assert other.force == pytest.approx((one.force[0], -one.force[1]), abs=1e-5 * MU * N)
    assert other.moment == pytest.approx(-one.moment, abs=1e-5 * MU * N * A)


def test_without_creepage_nothing_happens() -> None:
    influence, bound = ellipse()
    found = rolling_contact(influence, bound, np.zeros((2, *bound.shape)))
    assert not found.traction.any()
    assert found.iterations == 0
    assert np.array_equal(found.stick, bound > 0.0)
    nothing = rolling_contact(influence, np.zeros(bound.shape), rigid_slip(influence, 1e-3, 0.0, 0.0))
    assert not nothing.traction.any()
    assert not nothing.slip.any()


def test_large_creepage_is_full_friction() -> None:
    influence, bound = ellipse()
    found = rolling_contact(influence, bound, rigid_slip(influence, 0.3, -0.4, 0.0))
    assert found.force == pytest.approx((-0.6 * MU * N, 0.8 * MU * N), rel=1e-3)
    assert not found.stick.any()
    assert found.dissipation == pytest.approx(MU * N * 0.5, rel=5e-3)


def test_large_spin_turns_about_the_middle() -> None:
    """Slip is the rigid rotation, so q = -mu p (-y, x)/r: M_z = -mu N a 3 pi/16 on a circle."""
    influence, bound = ellipse(5e-3, 5e-3, 41)
    found = rolling_contact(influence, bound, rigid_slip(influence, 0.0, 0.0, 300.0))
    assert found.moment == pytest.approx(-MU * N * 5e-3 * 3.0 * math.pi / 16.0, rel=0.01)
    assert abs(found.force[0]) < 1e-3 * MU * N


@pytest.mark.parametrize("share", [0.3, 0.8])
def test_a_long_patch_is_carters_line_contact(share: float) -> None:
    """Plane strain: Q/(mu P) = 1 - (1 - nu_x/nu_full)^2, nu_full = 4 mu p0 (1 - nu^2)/E (Carter 1926)."""
    a, p0 = 5e-3, 1e9
    found = []
    for cells in (40, 80):
        influence = Influence(Grid(cells, 41, 2.0 * a / cells, 4.0 * a), STEEL)
        bound = np.tile(MU * p0 * np.sqrt(1.0 - (influence.grid.x / a) ** 2), (41, 1))
        full = 4.0 * MU * p0 * (1.0 - STEEL.poisson_ratio**2) / STEEL.young_modulus
        solved = rolling_contact(influence, bound, rigid_slip(influence, share * full, 0.0, 0.0))
        middle = solved.traction[0, 20]
        found.append(-middle.sum() / bound[20].sum())
        stick = solved.stick[20].sum() / cells
    assert 2.0 * found[1] - found[0] == pytest.approx(1.0 - (1.0 - share) ** 2, abs=0.004)
    assert stick == pytest.approx(1.0 - share, abs=0.03)


@pytest.mark.parametrize(
    "creepage", [(1e-3, 5e-4, 0.3), (4e-3, 0.0, 0.0), (0.0, 2e-3, -1.0), (0.0, 0.0, 2.0)]
)
def test_friction_takes_the_power_of_the_creepages(creepage: tuple[float, float, float]) -> None:
    """The elastic part of slip does no net work in steady rolling; here, but for the slip zone's edges."""
    losses = []
    for cells in (20, 40):
        influence, bound = ellipse(cells=cells)
        found = rolling_contact(influence, bound, rigid_slip(influence, *creepage))
        nu_x, nu_y, phi = creepage
        power = -(found.force[0] * nu_x + found.force[1] * nu_y + found.moment * phi)
        losses.append(abs(1.0 - found.dissipation / power))
    assert losses[0] < 0.08
    assert losses[1] < 0.04
    assert losses[1] < losses[0]


def test_a_start_saves_steps_and_changes_nothing() -> None:
    influence, bound = ellipse(cells=36)
    rigid = rigid_slip(influence, 1e-3, 5e-4, 0.3)
    cold = rolling_contact(influence, bound, rigid)
    near = rolling_contact(influence, bound, 1.02 * rigid)
    warm = rolling_contact(influence, bound, rigid, start=near.traction)
    assert warm.iterations < cold.iterations
    assert warm.force == pytest.approx(cold.force, abs=1e-4 * MU * N)
    wild = rolling_contact(influence, bound, rigid, start=np.full(rigid.shape, 1e12))
    assert wild.force == pytest.approx(cold.force, abs=1e-4 * MU * N)


def test_bad_input_is_named() -> None:
    influence, bound = ellipse()
    rigid = rigid_slip(influence, 1e-3, 0.0, 0.0)
    with pytest.raises(ValueError, match="shapes"):
        rolling_contact(influence, bound[1:], rigid)
    with pytest.raises(ValueError, match="bound, the friction times the pressure"):
        rolling_contact(influence, -bound, rigid)
    with pytest.raises(ValueError, match="rigid slip must be finite"):
        rolling_contact(influence, bound, rigid * np.nan)
    with pytest.raises(ValueError, match="start"):
        rolling_contact(influence, bound, rigid, start=np.zeros((2, 3, 3)))
