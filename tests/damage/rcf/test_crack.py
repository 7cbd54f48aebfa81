"""Cycles to failure, Miner's sum and crack size, against published numbers and arithmetic written out."""

import math

import numpy as np
import pytest

from damage.material import ER7
from damage.rcf.crack import DIRKS, KABO, CrackShape, LifeRelation, MinerSum, fitted_relation, miner_sum
from damage.rcf.local import LocalFatigue, local_indices
from damage.surface.lateral_grid import LateralGrid

GRID = LateralGrid(-0.02, 1e-3, 40)


def flat(index: float, b: float = 5e-3, strips: int = 10) -> LocalFatigue:
    """One state with the same fatigue index in all its strips, 2 b wide."""
    y = b * (-1.0 + (2.0 * np.arange(strips) + 1.0) / strips)[None, :]
    return LocalFatigue(y, np.full_like(y, 200e6), np.full_like(y, index), np.array([2.0 * b / strips]))


def test_kabo_by_hand() -> None:
    """FI = 1.78 Nf^-0.25: FI .1 -> 17.8^4 = 1.0e5 cycles, .26 -> 6.846^4 = 2.2e3, and D = FI^4/10.04."""
    np.testing.assert_allclose(KABO.cycles([0.1, 0.26]), [1.00388e5, 2.1968e3], rtol=1e-4)
    np.testing.assert_allclose(1.78 * KABO.cycles([0.05, 0.4]) ** -0.25, [0.05, 0.4], rtol=1e-12)
    assert KABO.damage(0.2) == pytest.approx(0.2**4 / 10.04, rel=2e-4)
    assert KABO.damage(0.2) == pytest.approx(0.2**4 / 10.0, rel=5e-3)  # as 3.19 rounds it


def test_dirks_by_hand() -> None:
    """9.6e5 * 100^-1.06 = 9.6e5 / 10^2.12 = 9.6e5 / 131.83 = 7282 cycles at 100 MPa; at 1 MPa 9.6e5."""
    np.testing.assert_allclose(DIRKS.cycles([100e6, 1e6]), [7282.1, 9.6e5], rtol=1e-4)
    assert DIRKS.calibrated_for == "rails"


@pytest.mark.parametrize("relation", [KABO, DIRKS])
def test_below_shakedown_there_is_no_damage(relation: LifeRelation) -> None:
    np.testing.assert_array_equal(relation.damage([-np.inf, -0.3, 0.0]), 0.0)
    np.testing.assert_array_equal(relation.cycles([-np.inf, -0.3, 0.0]), np.inf)
    assert np.isnan(relation.damage(np.nan))


def test_fit_gives_back_the_relation_it_was_measured_on() -> None:
    stress = np.array([20e6, 80e6, 300e6])
    fitted = fitted_relation("mine", "stress_index", 1e6, stress, 4e6 * (stress / 1e6) ** -1.3, "wheels", "x")
    assert (fitted.coefficient, fitted.exponent) == (pytest.approx(4e6), pytest.approx(-1.3))
    with pytest.raises(
        ValueError, match=r"exponent = (1\.0|0\.9999).* of mine must be"
    ):  # lives that grow with the load
        fitted_relation("mine", "fatigue_index", 1.0, [0.1, 0.2], [10.0, 20.0], "wheels", "x")
    with pytest.raises(ValueError, match="2 or more different"):
        fitted_relation("mine", "fatigue_index", 1.0, [0.1, 0.1], [10.0, 20.0], "wheels", "x")


def test_miner_by_hand() -> None:
    """1000 revolutions at FI = .26 on bins fully under the patch: 1000/2196.8 of the life."""
    miner = miner_sum(flat(0.26), 0.0, 1, 1.0, 1000.0, 1000.0, KABO, GRID)
    inside = np.abs(GRID.centres) < 5e-3
    np.testing.assert_allclose(miner.damage[inside], 1000.0 / 2196.8, rtol=1e-4)
    np.testing.assert_array_equal(miner.damage[np.abs(GRID.centres) > 5e-3], 0.0)
    np.testing.assert_allclose(miner.revolutions_to_failure[inside], 2196.8, rtol=1e-4)
    assert np.all(np.isinf(miner.revolutions_to_failure[~inside]))
    assert miner.to_table().column_names == ["y_m", "damage", "revolutions_to_failure"]


def test_miner_is_additive_however_the_log_is_cut() -> None:
    rng = np.random.default_rng(5)
    n = 12
    states = {"a": 7e-3, "b": 4e-3, "normal_force": 120e3, "phi": 0.3, "friction": 0.4}
    states |= {"nu_x": rng.normal(0, 3e-3, n), "nu_y": rng.normal(0, 3e-3, n)}
    local = local_indices(states, ER7, cells=(20, 20))
    place, turns = rng.normal(0, 4e-3, n), rng.uniform(1.0, 5.0, n)

    def part(rows: slice) -> MinerSum:
        piece = LocalFatigue(
            local.y[rows], local.stress_index[rows], local.fatigue_index[rows], local.width[rows]
        )
        return miner_sum(piece, place[rows], -1, 0.98, turns[rows], float(turns[rows].sum()), KABO, GRID)

    whole = part(slice(None))
    cut = part(slice(0, 3)) + part(slice(3, 4)) + part(slice(4, None))
    np.testing.assert_allclose(cut.damage, whole.damage, rtol=1e-12)
    assert cut.revolutions == pytest.approx(whole.revolutions)
    assert whole.damage.max() > 0.0
    # damage times width is kept: every strip puts D times its width on the grid
    strip = 2.0 * 4e-3 / 20 * 0.98
    expected = (KABO.damage(local.fatigue_index) * turns[:, None]).sum() * strip
    assert whole.damage.sum() * GRID.step == pytest.approx(expected, rel=1e-12)


def test_strips_lie_to_the_left_in_the_contact_frame() -> None:
    """y_wheel - side y cos: on the left wheel, whose profile points to the right, the order is turned."""
    local = flat(0.26)
    local.fatigue_index[0, 5:] = -1.0  # only the right half of the patch, y < 0 of frame C, is damaged
    for side, sign in ((1, 1.0), (-1, -1.0)):
        miner = miner_sum(local, 0.0, side, 1.0, 1.0, 1.0, KABO, GRID)
        centre = np.sum(miner.damage * GRID.centres) / miner.damage.sum()
        assert centre == pytest.approx(sign * 2.5e-3, rel=1e-9)


def test_crack_by_hand() -> None:
    """A crack of 6 mm mouth, 4 mm long, 2 mm deep at failure: r = 3, 30 degrees; half of each at D = 0.5."""
    shape = CrackShape.from_crack(6e-3, 4e-3, 2e-3, 1.0)
    assert (shape.mouth_ratio, shape.angle) == (pytest.approx(3.0), pytest.approx(math.pi / 6.0))
    sizes = shape.surface_length(0.5), shape.length(0.5), shape.depth(0.5)
    np.testing.assert_allclose(sizes, [3e-3, 2e-3, 1e-3], rtol=1e-12)
    # (3.22): h = 2 D rho_f / (r D_f) sin theta = 2 * 0.5 * 6 mm / 3 * 0.5
    assert sizes[2] == pytest.approx(2.0 * 0.5 * 6e-3 / (3.0 * 1.0) * 0.5)
    table = shape.to_table(miner_sum(flat(0.26), 0.0, 1, 1.0, 1000.0, 1000.0, KABO, GRID)).to_pydict()
    assert max(table["depth_m"]) == pytest.approx(2e-3 * 1000.0 / 2196.8, rel=1e-4)


def test_bad_input() -> None:
    with pytest.raises(
        ValueError, match=r"strips from 14\.00 to 24\.00 mm lie beyond the grid, -20 to 20 mm"
    ):
        miner_sum(flat(0.1), 0.019, 1, 1.0, 1.0, 1.0, KABO, GRID)
    with pytest.raises(ValueError, match="revolutions must be finite and >= 0"):
        miner_sum(flat(0.1), 0.0, 1, 1.0, -1.0, 1.0, KABO, GRID)
    with pytest.raises(ValueError, match="index = 'energy' of x; allowed are"):
        LifeRelation("x", "energy", 1.0, 1.0, -1.0, "", "")
    with pytest.raises(ValueError, match=r"angle = 2.0 rad of the crack must lie in 0..pi/2 rad"):
        CrackShape(1e-3, 1.0, 1.0, 2.0)
    with pytest.raises(ValueError, match="0 < depth <= length"):
        CrackShape.from_crack(1e-3, 1e-3, 2e-3, 1.0)
