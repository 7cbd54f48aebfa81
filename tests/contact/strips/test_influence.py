"""The influence of a strip: against the double integral, its own derivative and a point load far away."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from hh_exudyn.contact.strips.influence import influence_density, influence_integral, mean_density


@pytest.mark.parametrize("t", [0.02, 0.3, 1.0, 4.0, 7.99, 8.01, 30.0])
def test_density_is_the_integral_over_the_strip(t: float) -> None:
    # in x = sin(u), without the root's end slopes
    exact, _ = quad(lambda u: math.cos(u) ** 2 / math.hypot(math.sin(u), t), -0.5 * math.pi, 0.5 * math.pi)
    assert influence_density(t) == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("t", [1e-4, 0.01, 0.2, 1.0, 3.0, 7.999, 8.001, 50.0])
def test_integral(t: float) -> None:
    exact, _ = quad(lambda s: float(influence_density(s)) + 2.0 * math.log(s), 0.0, t, points=[min(t, 1.0)])
    exact += 2.0 * t * (1.0 - math.log(t))
    assert influence_integral(t) == pytest.approx(exact, rel=2e-6)
    assert influence_integral(-t) == -influence_integral(t)


def test_integral_is_smooth_where_the_table_ends() -> None:
    below, above = influence_integral(8.0 - 1e-9), influence_integral(8.0 + 1e-9)
    assert above - below == pytest.approx(2e-9 * float(influence_density(8.0)), rel=0.05)


@pytest.mark.parametrize("half", [0.02, 0.3, 2.0])
@pytest.mark.parametrize("distance", [4.0, 6.0, 40.0])
def test_mean_over_a_strip(half: float, distance: float) -> None:
    t = distance * half
    exact = (influence_integral(t + half) - influence_integral(t - half)) / (2.0 * half)
    assert mean_density(t, half) == pytest.approx(exact, rel=6e-4)


def test_far_away_it_is_a_point_load() -> None:
    """f = pi/2 / t: then u = P (1 - nu)/(pi G D), Boussinesq."""
    t = np.array([20.0, 100.0])
    assert influence_density(t) * t == pytest.approx(0.5 * math.pi, rel=1e-3)
