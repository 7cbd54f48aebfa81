"""A mode's recording swings as its shape says."""

import numpy as np

from hh_exudyn.playback.mode import AMPLITUDE, PERIOD, swing


def test_swing_has_the_shape_and_its_phases() -> None:
    """A body a quarter of a swing ahead of another is at its end while the other passes its middle."""
    shape = np.zeros((2, 6), dtype=complex)
    shape[0, 1], shape[1, 5] = 2.0, 1.0j
    motion = swing(shape, np.array([0.0, 0.25, 0.5, 1.0]) * PERIOD)
    np.testing.assert_allclose(motion[:, 0, 1], np.array([1.0, 0.0, -1.0, 1.0]) * AMPLITUDE, atol=1e-15)
    np.testing.assert_allclose(motion[:, 1, 5], np.array([0.0, -0.5, 0.0, 0.0]) * AMPLITUDE, atol=1e-15)
    assert np.count_nonzero(np.abs(motion).max(axis=0) > 1e-12) == 2
