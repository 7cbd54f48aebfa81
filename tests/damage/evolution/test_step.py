"""The step of wear in time: decay, stability, order, worn area, against the heat equation."""

import numpy as np
import pytest

from damage.evolution.step import (
    diffused,
    euler_increment,
    heun_increment,
    measured_sensitivity,
    not_below_zero,
    volumes,
)
from hh_exudyn.arrays import FloatArray

D = 2e-9  # m
LENGTH = 0.1  # m, of the arc
WAVE = 2.0 * np.pi / 10e-3  # 1/m, 10 mm long
HEIGHT = 20e-6  # m
S = np.linspace(0.0, LENGTH, 501)
MEAN = 30e-9  # m/m, so that no rate is below zero


def rate_of(surface: FloatArray) -> FloatArray:
    """The law r = r0 - D u'', without flux at the ends."""
    flux = np.concatenate([[0.0], np.diff(surface) / np.diff(S), [0.0]])
    return MEAN - D * np.diff(flux) / volumes(S)


def surface_after(
    distance: float, steps: int, implicit: float, heun: bool = True, start: FloatArray | None = None
) -> FloatArray:
    """The surface without its mean depth, stepped with a diffusivity of `implicit` times the true one."""
    u = HEIGHT * np.cos(WAVE * S) if start is None else start.copy()
    way = distance / steps
    for _ in range(steps):
        depth = euler_increment(S, rate_of(u), way, implicit * D)
        if heun:
            depth = heun_increment(S, depth, rate_of(u - depth), way, implicit * D)
        u -= depth
    return u + MEAN * distance


def amplitude(surface: FloatArray) -> float:
    return float(2.0 * np.trapezoid(surface * np.cos(WAVE * S), S) / LENGTH)


DECAY = 1.0 / (D * WAVE**2)  # m: 1266 m


@pytest.mark.parametrize("implicit", [0.7, 1.0, 2.0])
def test_a_bump_decays_as_the_heat_equation_says(implicit: float) -> None:
    """To exp(-D k^2 t), within 1 %, and twice the steps have a quarter of the error: whatever D was taken."""
    exact = HEIGHT * np.exp(-1.0)
    k = 2.0 * np.sin(0.5 * WAVE * S[1]) / S[1]  # wave number on the points
    exact = HEIGHT * np.exp(-D * k**2 * DECAY)
    errors = [abs(amplitude(surface_after(DECAY, steps, implicit)) - exact) for steps in (20, 40, 80)]
    assert errors[1] < 0.01 * exact
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.25)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.25)
    first = [abs(amplitude(surface_after(DECAY, n, implicit, heun=False)) - exact) for n in (80, 160)]
    assert first[0] / first[1] == pytest.approx(2.0, rel=0.1)


def test_explicit_steps_blow_up_where_these_do_not() -> None:
    """At 1.5 times the explicit limit 2 / (D k^2) of the shortest wave, from noise of a nanometre."""
    limit = 0.5 * S[1] ** 2 / D
    noise = HEIGHT * np.cos(WAVE * S) + 1e-9 * np.random.default_rng(1).standard_normal(S.size)
    for heun in (False, True):
        assert np.abs(surface_after(60 * limit * 1.5, 60, 0.0, heun, noise)).max() > 1e3 * HEIGHT
        assert np.abs(surface_after(60 * limit * 0.9, 60, 0.0, heun, noise)).max() < 1.01 * HEIGHT
        for factor in (1.5, 100.0, 1e4):
            worn = surface_after(60 * limit * factor, 60, 1.0, heun, noise)
            assert np.abs(worn).max() < 1.01 * HEIGHT


def test_a_diffusivity_measured_at_half_its_value_is_stable_for_euler_and_heun() -> None:
    noise = 1e-6 * np.random.default_rng(2).standard_normal(S.size)
    for heun in (False, True):
        assert np.abs(surface_after(1e7, 50, 0.5, heun, noise)).max() < np.abs(noise).max()


@pytest.mark.parametrize("implicit", [0.0, 1.0, 30.0])
def test_the_worn_area_is_kept(implicit: float) -> None:
    rate = np.where(np.abs(S - 0.04) < 5e-3, 1e-7, 0.0)
    area = np.trapezoid(rate, S)
    euler = euler_increment(S, rate, 500.0, implicit * D)
    heun = heun_increment(S, euler, rate, 500.0, implicit * D)
    for depth in (euler, heun, not_below_zero(S, heun)):
        assert np.trapezoid(depth, S) == pytest.approx(500.0 * area, rel=1e-10)
    assert not_below_zero(S, heun).min() >= 0.0
    uneven = np.sort(np.random.default_rng(3).uniform(0.0, LENGTH, 400))
    depth = np.random.default_rng(4).uniform(0.0, 1.0, 400)
    assert np.trapezoid(diffused(uneven, depth, 4e-6), uneven) == pytest.approx(
        np.trapezoid(depth, uneven), rel=1e-10
    )


def test_a_filter_makes_no_maximum_and_no_sharper_curvature() -> None:
    """Depths stay between those of the wear; its waves get smaller, none grows."""
    depth = np.where(np.abs(S - 0.05) < 8e-3, 1e-4, 0.0) + np.where(np.abs(S - 0.03) < 1e-3, 2e-4, 0.0)
    smooth = diffused(S, depth, (1.5e-3) ** 2)
    assert smooth.min() >= 0.0 and smooth.max() <= depth.max()
    wave = np.cos(WAVE * S)
    assert amplitude(diffused(S, wave, (1.5e-3) ** 2)) == pytest.approx(
        1.0 / (1.0 + (1.5e-3 * WAVE) ** 2), rel=1e-3
    )
    bent = [np.abs(np.diff(d, 2) / S[1] ** 2).max() for d in (smooth, depth)]
    assert bent[0] < 0.05 * bent[1]


def test_the_sensitivity_is_measured() -> None:
    """Of a law whose rate changes with curvature by a share, r = r0 (1 + C kappa), on an uneven r0."""
    sensitivity, uneven = 0.4, MEAN * (1.0 + 0.8 * np.sin(np.pi * S / LENGTH))

    def rate(surface: FloatArray) -> FloatArray:
        return uneven * (1.0 - sensitivity * np.gradient(np.gradient(surface, S), S))

    u = np.zeros(S.size)
    worn = 0.1 * HEIGHT * np.cos(WAVE * S)
    before, after = rate(u), rate(u - worn)
    assert measured_sensitivity(S, worn, before, after, 1e-3) == pytest.approx(sensitivity, rel=0.02)
    assert measured_sensitivity(S, worn, before, before, 1e-3) == 0.0


def surface_by_one_evaluation(
    distance: float, steps: int, implicit: float, start: FloatArray | None = None
) -> FloatArray:
    """As `surface_after`, but each step begins with the rate on Euler's surface of the step before."""
    u = HEIGHT * np.cos(WAVE * S) if start is None else start.copy()
    way, rate = distance / steps, rate_of(u)
    for _ in range(steps):
        euler = euler_increment(S, rate, way, implicit * D)
        rate = rate_of(u - euler)
        u -= heun_increment(S, euler, rate, way, implicit * D)
    return u + MEAN * distance


@pytest.mark.parametrize("implicit", [0.7, 1.0, 2.0])
def test_one_evaluation_a_step_is_of_order_2(implicit: float) -> None:
    """Twice the steps have a quarter of the error; it is no larger than with twice the evaluations."""
    k = 2.0 * np.sin(0.5 * WAVE * S[1]) / S[1]
    exact = HEIGHT * np.exp(-D * k**2 * DECAY)
    one = [abs(amplitude(surface_by_one_evaluation(DECAY, n, implicit)) - exact) for n in (40, 80, 160)]
    two = abs(amplitude(surface_after(DECAY, 40, implicit)) - exact)
    assert one[0] / one[1] == pytest.approx(4.0, rel=0.25)
    assert one[1] / one[2] == pytest.approx(4.0, rel=0.25)
    assert one[0] < max(two, 0.01 * exact)


def test_one_evaluation_a_step_is_stable_from_a_third_of_the_diffusivity_on() -> None:
    noise = 1e-6 * np.random.default_rng(5).standard_normal(S.size)
    for implicit in (0.33, 1.0, 3.0):
        for distance in (1e3, 1e7):
            worn = surface_by_one_evaluation(distance, 50, implicit, noise)
            assert np.abs(worn).max() < np.abs(noise).max(), (implicit, distance)
    assert np.abs(surface_by_one_evaluation(1e7, 50, 0.25, noise)).max() > 1.0


def test_what_does_not_wear_is_not_worn_by_its_neighbour() -> None:
    """D over the arc as the rate: beside a worn band nothing moves, where one D for all would spread it."""
    rate = np.where(np.abs(S - 0.04) < 5e-3, 1e-7, 0.0)
    beside = np.abs(S - 0.04) > 5.3e-3
    local, even = (euler_increment(S, rate, 500.0, d) for d in (0.3 * rate, np.full(S.size, 0.3e-7)))
    assert local[beside].max() == 0.0
    assert even[beside].max() > 1e-6
    assert np.trapezoid(local, S) == pytest.approx(500.0 * np.trapezoid(rate, S), rel=1e-10)
