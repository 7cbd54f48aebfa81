"""Ratchetting of layers: closed forms, cycle by cycle, and an independent integration."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from damage.rcf.ratchetting import RatchettingSteel, largest_orthogonal_shear, ratchet

K = 300e6
STEEL = RatchettingSteel(K)
PLAIN = RatchettingSteel(K, hardening_limit=1.0)  # does not harden
DEPTH = np.linspace(0.0, 4e-3, 41)
STRESS = largest_orthogonal_shear(DEPTH, 6e-3, 1600e6, 0.4)  # mu p0 = 640 MPa at the surface


def test_without_hardening_the_strain_is_linear_by_hand() -> None:
    """tau = 1.5 k: dgamma = .00237 * .5 = .001185 a cycle, so 11.5 is reached after 9704.6 cycles."""
    found = ratchet(PLAIN, [0.0, 1e-3], [1.5 * K, 1.2 * K], 1e4, noted=[1e3])
    assert found.strain[0, 0] == pytest.approx(1.185, rel=1e-9)
    assert found.strain[0, 1] == pytest.approx(0.00237 * 0.2 * 1e3, rel=1e-9)
    assert found.cycles_to_failure[0] == pytest.approx(11.5 / 0.001185, rel=1e-9)
    assert found.strain[-1, 0] == 11.5
    assert np.isinf(found.cycles_to_failure[1])
    assert found.failed.tolist() == [True, False]


def test_below_the_strength_nothing_strains() -> None:
    found = ratchet(STEEL, [0.0, 1e-3], [0.999 * K, K], 1e7)
    np.testing.assert_array_equal(found.strain, 0.0)
    assert not found.failed.any()


def test_against_an_independent_integration() -> None:
    """scipy's LSODA, layer strains after 5000 cycles; measured: 1e-5 apart at a tolerance of 1e-6."""

    def rate(_: float, strain: np.ndarray) -> np.ndarray:
        hard = K * np.maximum(1.0, 2.0 * np.sqrt(1.0 - np.exp(-0.5 * strain)))  # (3.26)
        return 0.00237 * np.maximum(STRESS / hard - 1.0, 0.0)  # (3.25)

    exact = solve_ivp(rate, (0.0, 5e3), np.zeros(DEPTH.size), method="LSODA", rtol=1e-10, atol=1e-11)
    found = ratchet(STEEL, DEPTH, STRESS, 5e3, noted=[1e3])
    assert exact.success and not found.failed.any()
    np.testing.assert_allclose(found.strain[-1], exact.y[:, -1], atol=5e-5)
    finer = ratchet(STEEL, DEPTH, STRESS, 5e3, tolerance=1e-8)
    np.testing.assert_allclose(finer.strain[-1], exact.y[:, -1], atol=2e-6)


def test_against_cycle_by_cycle() -> None:
    """The law adds whole cycles; taking it as a rate differs by less than a cycle's strain, .0027."""
    strain = np.zeros(DEPTH.size)
    for _ in range(3000):
        strain += STEEL.strain_per_cycle(STRESS, strain)
    found = ratchet(STEEL, DEPTH, STRESS, 3000.0)
    np.testing.assert_allclose(found.strain[-1], strain, atol=0.00237 * (STRESS.max() / K - 1.0))


def test_failure_is_found_between_blocks() -> None:
    """A layer that hardens: cycles = integral of dgamma / rate, by quadrature."""
    stress = 2.3 * K
    strain = np.linspace(0.0, 11.5, 2_000_001)
    rate = STEEL.strain_per_cycle(stress, strain)
    expected = np.sum(0.5 * (1.0 / rate[1:] + 1.0 / rate[:-1])) * (strain[1] - strain[0])
    found = ratchet(STEEL, 0.0, stress, 1e6)
    assert found.cycles_to_failure[0] == pytest.approx(expected, rel=1e-5)
    assert found.steps < 500  # for some 35,000 cycles to failure, and a million in all


def test_hardening_stops_what_stays_below_the_saturated_strength() -> None:
    """k_eff = tau at gamma = -ln(1 - (tau/(beta k0))^2)/alpha; at 1.2 k0: -ln(1 - .36)/.5 = .8926."""
    found = ratchet(STEEL, [0.0, 1e-3], [1.2 * K, 1.9 * K], 1e8)
    assert STEEL.final_strain(1.2 * K) == pytest.approx(0.8926, abs=1e-4)
    np.testing.assert_allclose(found.strain[-1], STEEL.final_strain([1.2 * K, 1.9 * K]), rtol=1e-4)
    assert not found.failed.any()
    assert found.steps < 20_000
    np.testing.assert_array_equal(STEEL.final_strain([0.5 * K, 2.5 * K]), [0.0, np.inf])


def test_load_cases_by_their_shares() -> None:
    """A tenth of the cycles at 2 k, the rest at .9 k that does nothing, and no hardening."""
    found = ratchet(PLAIN, [0.0], [[2.0 * K], [0.9 * K]], 1000.0, shares=[0.1, 0.9])
    assert found.strain[-1, 0] == pytest.approx(0.1 * 1000.0 * 0.00237, rel=1e-9)


def test_wear_takes_layers_before_they_fail() -> None:
    """Stress 1.5 k throughout, no hardening: failure after 9704.6 cycles. 1e-7 m a cycle takes layers above
    0.97 mm earlier, with the strain they had by then."""
    depth = np.linspace(0.0, 2e-3, 21)
    found = ratchet(PLAIN, depth, np.full(21, 1.5 * K), 2e4, wear_per_cycle=1e-7)
    np.testing.assert_allclose(found.cycles_to_wear_off, depth / 1e-7, rtol=1e-12)
    early = depth / 1e-7 < 11.5 / 0.001185
    np.testing.assert_array_equal(found.failed, ~early)
    np.testing.assert_allclose(found.strain[-1], np.minimum(0.001185 * depth / 1e-7, 11.5), rtol=1e-9)


def test_worn_layers_feel_the_stress_of_where_they_are() -> None:
    """Linear stress, no hardening: gamma = C int (tau(z - w N)/k - 1) dN in closed form while above k."""
    depth = np.linspace(0.0, 1e-3, 11)
    stress = K * (2.0 - depth / 1e-3)  # 2 k at the surface, k at 1 mm
    found = ratchet(PLAIN, depth, stress, 1000.0, wear_per_cycle=2e-7)
    n = np.minimum(1000.0, depth / 2e-7)
    np.testing.assert_allclose(
        found.strain[-1], 0.00237 * ((1.0 - depth / 1e-3) * n + 0.5 * 2e-4 * n * n), rtol=1e-9, atol=1e-12
    )


def test_shear_stress_below_the_surface() -> None:
    """Frictionless: .25 p0 at depth .5 a (Johnson). Full slip: mu p0 at the surface. Partial slip: Carter's
    peak there, mu p0 sqrt(1 - (2 d/a - 1)^2) at the edge of the stick zone, half length d."""
    depth = np.array([0.0, 3e-3])
    frictionless = largest_orthogonal_shear(depth, 6e-3, 1e9, 0.0)
    np.testing.assert_allclose(frictionless, [0.0, 0.25e9], rtol=1e-5)
    assert largest_orthogonal_shear(0.0, 6e-3, 1e9, 0.4)[0] == pytest.approx(0.4e9, rel=1e-12)
    ratio = np.sqrt(1.0 - 0.3 / 0.4)  # d/a = 0.5: the peak is at x = 0, as high as in full slip
    assert ratio == pytest.approx(0.5)
    assert largest_orthogonal_shear(0.0, 6e-3, 1e9, 0.4, 0.3)[0] == pytest.approx(0.4e9, rel=1e-4)
    ratio = np.sqrt(1.0 - 0.2 / 0.4)
    peak = 0.4e9 * np.sqrt(1.0 - (1.0 - 2.0 * ratio) ** 2)
    assert largest_orthogonal_shear(0.0, 6e-3, 1e9, 0.4, 0.2)[0] == pytest.approx(peak, rel=1e-3)


def test_the_table_and_twice_the_same() -> None:
    found, again = (ratchet(STEEL, DEPTH, STRESS, 1e5, noted=[10.0, 1e4]) for _ in range(2))
    np.testing.assert_array_equal(found.strain, again.strain)
    np.testing.assert_array_equal(found.cycles, [10.0, 1e4, 1e5])
    assert np.all(np.diff(found.strain, axis=0) >= 0.0)
    assert found.to_table().num_rows == DEPTH.size


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"depth": [1e-3, 0.0]}, "depth must be finite, >= 0 m and ascending"),
        ({"stress": [1.0]}, r"stress of shape \(1,\) for 2 layers"),
        ({"stress": [[1.0, 2.0], [2.0, 3.0]]}, "2 load cases need their shares"),
        ({"shares": [0.5]}, r"shares = \[0.5\] must be >= 0, one for each load case, and add up to 1"),
        ({"cycles": -1.0}, "cycles = -1.0 - must be finite and >= 0"),
        ({"noted": [5.0]}, r"noted cycles must lie within 0\.\.1"),
        ({"tolerance": 0.0}, r"tolerance = 0.0 \[-\] must lie in 0..1"),
    ],
)
def test_bad_input(change: dict, message: str) -> None:
    given = {"depth": [0.0, 1e-3], "stress": [1.0, 2.0], "cycles": 1.0} | change
    with pytest.raises(ValueError, match=message):
        ratchet(STEEL, **given)
    with pytest.raises(ValueError, match=r"hardening_limit = 0\.5 must be >= 1"):
        RatchettingSteel(K, hardening_limit=0.5)
