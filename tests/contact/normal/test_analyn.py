"""ANALYN: Hertz's ellipse where the gap is Hertz's, and what makes it differ elsewhere."""

import math

import numpy as np
import pytest
from strip_bench import CURVATURES, NU, G, hertz_of, parabolic_pair, solve_one

from hh_exudyn.contact.normal.analyn import strip
from hh_exudyn.contact.normal.hertz import normal_contact
from hh_exudyn.contact.normal.registry import ANALYN
from hh_exudyn.contact.tangential.strips import HALF_LENGTH, PRESSURE, WIDTH, Y


@pytest.mark.parametrize("curvature", [0.3, 1.1, 12.0, 90.0])
@pytest.mark.parametrize("y", [0.0, 0.3, -0.9, 0.999, 1.2])
def test_strip_of_a_parabolic_gap_is_hertz(curvature: float, y: float) -> None:
    approach, along = 60e-6, 1.08
    _, a, b, p_max = normal_contact(approach, along, curvature, G, NU)
    inside, half_length, pressure = strip(curvature * (y * b) ** 2, approach, along, curvature, G, NU)
    root = math.sqrt(max(1.0 - y * y, 0.0))
    assert inside == pytest.approx(1.0 - y * y, abs=1e-12)
    assert [half_length, pressure] == pytest.approx([a * root, p_max * root], rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("strips", [15, 40])
@pytest.mark.parametrize(("wheel", "rail"), CURVATURES)
def test_elliptic_gap_gives_hertz(wheel: float, rail: float, strips: int) -> None:
    (force, p_max, a, b), rows = solve_one(ANALYN, parabolic_pair(wheel, rail, 50e-6), strips)
    exact = hertz_of(wheel, rail, force)
    # the curvature of a parabola falls by 1.5 slope^2, at most 1e-3 here
    assert exact.approach == pytest.approx(50e-6, rel=3e-4)
    assert p_max == pytest.approx(exact.max_pressure, rel=3e-4)
    assert [a, b] == pytest.approx([exact.a, exact.b], rel=1e-3)
    lengths = exact.a * np.sqrt(1 - (rows[:, Y] / exact.b) ** 2)
    np.testing.assert_allclose(rows[:, HALF_LENGTH], lengths, atol=2e-3 * exact.a)
    assert rows[:, WIDTH].sum() == pytest.approx(2 * exact.b, rel=1e-3)
    carried = 0.5 * math.pi * (rows[:, WIDTH] * rows[:, HALF_LENGTH] * rows[:, PRESSURE]).sum()
    assert carried == pytest.approx(force, rel=1.0 / strips**2)  # midpoints: 1/(2 n^2) too much


def test_flatter_beyond_the_middle_is_wider() -> None:
    """A strip with the same gap but less curvature lies nearer to the middle of a wider ellipse."""
    approach, gap = 60e-6, 10e-6
    flat, _, _ = strip(gap, approach, 1.08, 0.5, G, NU)
    curved, _, _ = strip(gap, approach, 1.08, 5.0, G, NU)
    assert flat > curved > 0.0
