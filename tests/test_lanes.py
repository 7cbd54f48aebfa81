"""Eight numbers at once, compiled and as plain Python."""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import kernel
from hh_exudyn.lanes import LANES, add_multiples, set_multiples


@kernel
def both(a: FloatArray, b: FloatArray, added: FloatArray, assigned: FloatArray) -> None:
    add_multiples(added, 3, (2.0, -0.5), (a, b), 5)
    set_multiples(assigned, np.uint64(1), (3.0,), (b,), np.uint64(7))


def test_multiples() -> None:
    """At any places, and beside them nothing changes."""
    a, b, before = np.random.default_rng(0).uniform(-1.0, 1.0, (3, 20))
    added, assigned = before.copy(), before.copy()
    both(a, b, added, assigned)
    expected = before.copy()
    expected[3 : 3 + LANES] += 2.0 * a[5 : 5 + LANES] - 0.5 * b[5 : 5 + LANES]
    assert np.allclose(added, expected, rtol=1e-15, atol=1e-15)
    assert np.array_equal(added[3 + LANES :], before[3 + LANES :])
    expected = before.copy()
    expected[1 : 1 + LANES] = 3.0 * b[7 : 7 + LANES]
    assert np.array_equal(assigned, expected)
