"""The influence of a strip: against the double integral, its own derivative and a point load far away."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.strips.influence import (
    CENTRING,
    influence_density,
    influence_integral,
    influence_of,
    mean_density,
    stretches_of,
)
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.kernel import kernel, memory, shaped

_STATE = ROWS * CAPACITY


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


@kernel
def influence_row(k: int, count: int, modulus: float, given: FloatArray, row: FloatArray) -> None:
    """`influence_of` for rows in an array."""
    state = memory(_STATE)
    s = shaped(state, (ROWS, CAPACITY))
    for i in range(ROWS):
        for j in range(CAPACITY):
            s[i, j] = given[i, j]
    ends = shaped(memory(CAPACITY), (CAPACITY,))
    influence_of(k, stretches_of(count, state, ends), ends, modulus, state, row)


@pytest.mark.parametrize("half_length", [0.6e-3, 1.1e-3, 4.0e-3, 9.3e-3, 55.0e-3])
@pytest.mark.parametrize("missing", [(), (5, 6)])
@pytest.mark.parametrize("count", [9, 24, 90])
def test_every_pair_has_the_influence_of_the_integral(
    half_length: float, missing: tuple[int, ...], count: int
) -> None:
    """Wide and narrow strips, gaps between, sources anywhere: each pair by its own distance and width."""
    given = np.zeros((ROWS, CAPACITY))
    numbers = np.array([k for k in range(count) if k not in missing])
    width = np.where(np.arange(count) < count // 2, 1.25e-3, 0.75e-3)
    arc = np.cumsum(width) - 0.5 * width
    n = numbers.size
    given[Row.NUMBER, :n], given[Row.ARC, :n], given[Row.WIDTH, :n] = numbers, arc[numbers], width[numbers]
    given[Row.HALF_LENGTH, :n] = np.maximum(half_length, 0.5 * width[numbers])
    row, modulus = np.zeros(CAPACITY), 1.1e11
    for k in range(n):
        influence_row(k, n, modulus, given, row)
        a, w = given[Row.HALF_LENGTH, k], given[Row.WIDTH, k]
        t, half = (given[Row.ARC, :n] - given[Row.ARC, k]) / a, 0.5 * w / a
        exact = np.array([influence_integral(x + half) - influence_integral(x - half) for x in t])
        exact *= CENTRING * 2.0 / (math.pi**2 * modulus * w)
        assert row[:n] == pytest.approx(exact, rel=7e-4)
        alike = given[Row.WIDTH, :n] == w
        assert row[:n][alike] == pytest.approx(exact[alike], rel=7e-4 if a / w > 50.0 or count > 64 else 2e-5)


def test_far_away_it_is_a_point_load() -> None:
    """f = pi/2 / t: then u = P (1 - nu)/(pi G D), Boussinesq."""
    t = np.array([20.0, 100.0])
    assert influence_density(t) * t == pytest.approx(0.5 * math.pi, rel=1e-3)
