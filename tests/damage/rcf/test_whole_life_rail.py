"""The whole-life rail function at its published points, and rescaled to another steel."""

import math

import numpy as np
import pytest

from damage.rcf.whole_life_rail import BURSTOW_RAIL, TWENTE_RAIL, DamageFunction, rescaled


def test_published_points() -> None:
    """0 to 15 N, 1e-5 at 65 N, 0 at 175 N, as far below zero beyond as the line goes."""
    np.testing.assert_allclose(
        BURSTOW_RAIL.damage([0.0, 15.0, 40.0, 65.0, 120.0, 175.0, 285.0]),
        [0.0, 0.0, 0.5e-5, 1e-5, 0.5e-5, 0.0, -1e-5],
        atol=1e-20,
    )


def test_lines_of_twentes_code() -> None:
    """Published there: 2.22e-7 Tg - 4.44e-6 from 20 to 65 N, -9.09e-8 Tg + 1.59e-5 to 175 N."""
    rising, falling = np.array([25.0, 60.0]), np.array([70.0, 170.0])
    np.testing.assert_allclose(TWENTE_RAIL.damage(rising), 2.22e-7 * rising - 4.44e-6, rtol=5e-3)
    np.testing.assert_allclose(TWENTE_RAIL.damage(falling), -9.09e-8 * falling + 1.59e-5, atol=2e-8)


def test_rescaled_to_er7() -> None:
    """(3.33): nu A (520 + 880) MPa / (2 sqrt 3) on 100 mm^2 = 40.4, 121 and 404 N."""
    energies = [nu * 100e-6 * 1400e6 / (2.0 * math.sqrt(3.0)) for nu in (0.001, 0.003, 0.01)]
    np.testing.assert_allclose(energies, [40.4, 121.2, 404.1], rtol=1e-3)
    wheel = rescaled((energies[0], energies[1], energies[2]))
    np.testing.assert_allclose(wheel.damage(energies), [0.0, 1e-5, 0.0], atol=1e-20)
    assert rescaled((15.0, 65.0, 175.0)) == BURSTOW_RAIL
    assert wheel.to_table(energies).num_rows == 3


def test_bad_input() -> None:
    with pytest.raises(ValueError, match=r"onset = 70 N, peak = 65.0 N, balance = 175.0 N must rise"):
        DamageFunction(onset=70)
    with pytest.raises(ValueError, match="peak_damage = -1"):
        DamageFunction(peak_damage=-1.0)
    assert np.isnan(BURSTOW_RAIL.damage(np.nan))
