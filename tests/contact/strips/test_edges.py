"""Softened loads against one Newton step of the whole system in numpy, without any elimination in parts."""

import numpy as np
import pytest
from strip_poses import MODULUS, wheel_and_rail

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.contact.strips.influence import influence_of, stretches_of
from hh_exudyn.contact.strips.loads import first_half_lengths
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.kernel import kernel, memory, shaped

S1002_60E1 = wheel_and_rail(wheel_profile("S1002"), rail_profile("60E1", 1.0 / 30.0))
_STATE = ROWS * CAPACITY


@kernel
def influences(count: int, modulus: float, given: FloatArray, rows: FloatArray) -> None:
    """(count, >= count + LANES) of strips given by (ROWS, >= count), half lengths by `first_half_lengths`."""
    state = memory(_STATE)
    s = shaped(state, (ROWS, CAPACITY))
    for i in range(ROWS):
        for j in range(count):
            s[i, j] = given[i, j]
    first_half_lengths(count, state)
    ends = shaped(memory(CAPACITY), (CAPACITY,))
    stretches = stretches_of(count, state, ends)
    for k in range(count):
        influence_of(k, stretches, ends, modulus, state, rows[k])


def newton_step(rows: np.ndarray) -> np.ndarray:
    """Loads of all strips [N]: active sets, then one step to equation 1 of `edges` in every strip."""
    n = rows.shape[1]
    memory_of_rows = np.zeros((n, n + 8))
    influences(n, MODULUS, rows, memory_of_rows)
    k, d = memory_of_rows[:, :n].T, rows[Row.OVERLAP]
    active = d > 0.45 * d.max()
    for _ in range(100):
        load = np.zeros(n)
        load[active] = np.linalg.solve(k[np.ix_(active, active)], d[active])
        gap = k @ load - d
        pulls, sinks = active & (load < 0.0), ~active & (gap < -1e-13)
        if not pulls.any() and not sinks.any():
            break
        active = active & ~pulls if pulls.any() else active | sinks
    touch = np.concatenate([[False], np.diff(rows[Row.NUMBER]) == 1.0, [False]])
    beside = np.concatenate([[0.0], d, [0.0]])
    change = np.abs(np.where(touch[1:], beside[2:], 0.0) - np.where(touch[:-1], beside[:-2], 0.0))
    own = np.diag(k)
    e = np.maximum(0.4 * change / own, 1e-3)
    z = np.where(active, load, -gap / own)

    def soft(z: np.ndarray) -> np.ndarray:
        return np.where(z <= -e, 0.0, np.where(z >= e, z, (z + e) ** 2 / (4.0 * e)))

    slope = np.clip((z + e) / (2.0 * e), 0.0, 1.0)
    error = k @ soft(z) - d - own * soft(-z)
    return soft(z - np.linalg.solve(k * slope + np.diag(own * (1.0 - slope)), error))


TREAD = [(y, z) for y in (0.0, 0.002, 0.004, 0.0071) for z in (0.3e-3, 0.35e-3, 0.5e-3)]
TO_FLANGE = [(y, z) for y in (0.0098, 0.0102, 0.0106, 0.011, 0.0114) for z in (0.0, 0.05e-3, 0.1e-3, 0.2e-3)]


@pytest.mark.parametrize(("outwards", "lowered"), TREAD + TO_FLANGE)
def test_newton_step_of_all_strips(outwards: float, lowered: float) -> None:
    """Up to 54 strips with overlap, in one run and in two, with softened strips within them and without."""
    rows = S1002_60E1.rows(outwards, lowered, 0.002)
    expected = newton_step(rows)
    assert rows[Row.LOAD] == pytest.approx(expected, rel=1e-8, abs=1e-8 * expected.max())
