"""Kik and Piotrowski with KPEC's factor: Hertz where the gap is Hertz's, the integral behind its pressure.

Notes
-----
The constant factor eps = 0.55 of 1996 was measured on the Manchester benchmark beside KPEC's (equation 1 of
the module): maximum pressure 6 to 8 % too low on the tread (KPEC: within 1 %), 26 % on the flange (2.5 %).
"""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import dblquad
from strip_bench import CURVATURES, NU, G, hertz_of, parabolic_pair, solve_one

from hh_exudyn.contact.normal.hertz import normal_contact
from hh_exudyn.contact.normal.kik_piotrowski import influence, strip
from hh_exudyn.contact.normal.registry import KIK_PIOTROWSKI
from hh_exudyn.contact.tangential.strips import HALF_LENGTH, PRESSURE, Y


@pytest.mark.parametrize("curvature", [0.3, 1.1, 12.0])
@pytest.mark.parametrize("y", [0.0, 0.3, -0.9, 0.999])
def test_strip_of_a_parabolic_gap_is_hertz(curvature: float, y: float) -> None:
    _, a, b, _ = normal_contact(60e-6, 1.08, curvature, G, NU)
    inside, half_length = strip(curvature * (y * b) ** 2, y * b, 1.08, curvature, a, b)
    assert inside == pytest.approx(1.0 - y * y, abs=1e-12)
    assert half_length == pytest.approx(a * math.sqrt(1.0 - y * y), rel=1e-9)


@pytest.mark.parametrize(("lateral", "width"), [(0.0, 1e-3), (1e-3, 1e-3), (4e-3, 0.5e-3), (-0.4e-3, 1e-3)])
def test_influence_is_the_integral_over_the_strip(lateral: float, width: float) -> None:
    half_length = 5e-3
    low, high = lateral - 0.5 * width, lateral + 0.5 * width
    edges = [low, 0.0, high] if low < 0.0 < high else [low, high]
    exact = sum(
        dblquad(
            # x = t^2, so that 1/r is tame near the origin
            lambda t, y: 4.0 * t * math.sqrt(half_length**2 - t**4) / math.hypot(t * t, y),
            start, end, 0.0, math.sqrt(half_length), epsabs=1e-11,
        )[0]
        for start, end in itertools.pairwise(edges)
    )  # fmt: skip
    assert influence(lateral, width, half_length) == pytest.approx(exact / width, rel=3e-3)


@pytest.mark.parametrize(("strips", "tolerance"), [(15, 3e-3), (41, 5e-4)])
@pytest.mark.parametrize(("wheel", "rail"), CURVATURES)
def test_elliptic_gap_gives_hertz(wheel: float, rail: float, strips: int, tolerance: float) -> None:
    (force, p_max, a, b), rows = solve_one(KIK_PIOTROWSKI, parabolic_pair(wheel, rail, 50e-6), strips)
    exact = hertz_of(wheel, rail, force)
    assert exact.approach == pytest.approx(50e-6, rel=tolerance)
    assert p_max == pytest.approx(exact.max_pressure, rel=tolerance)
    assert [a, b] == pytest.approx([exact.a, exact.b], rel=max(1e-3, tolerance))
    # the pressure is proportional to the length of a strip
    np.testing.assert_allclose(rows[:, PRESSURE] / rows[:, HALF_LENGTH], p_max / exact.a, rtol=4 * tolerance)
    assert abs(rows[:, Y]).max() < exact.b
