"""Kalker's coefficients: no jumps, limits, bad input. Numbers: tests/contact/test_validation.py."""

import numpy as np
import pytest

from hh_exudyn.contact.tangential.kalker import kalker_coefficients


@pytest.mark.parametrize("poisson_ratio", [0.0, 0.28, 0.5])
@pytest.mark.parametrize("at", [0.07, 0.1, 0.2, 1.0, 5.0, 10.0, 1.0 / 0.07])
def test_no_jump(at: float, poisson_ratio: float) -> None:
    below = kalker_coefficients(at * (1.0 - 1e-9), poisson_ratio)
    above = kalker_coefficients(at * (1.0 + 1e-9), poisson_ratio)
    assert below == pytest.approx(above, rel=1e-7)


def test_very_slender_ellipses_stay_finite() -> None:
    for ratio in (1e-12, 1e12):
        assert np.all(np.isfinite(kalker_coefficients(ratio, 0.28)))


@pytest.mark.parametrize(("ratio", "poisson_ratio"), [(0.0, 0.3), (-1.0, 0.3), (1.0, -0.1), (1.0, 0.6)])
def test_bad_input_is_named(ratio: float, poisson_ratio: float) -> None:
    with pytest.raises(ValueError, match=r"a_over_b|poisson_ratio"):
        kalker_coefficients(ratio, poisson_ratio)
