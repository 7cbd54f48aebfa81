"""Dampers by a table and in series with a spring, against the differential equation and closed forms."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from vehicles.dampers import damper_force, series_damper_force

LINEAR = np.array([0.0, 0.0, 1.0, 60e3])
BLOW_OFF = np.array([0.0, 0.0, 0.02, 12e3, 1.0, 12e3])
THREE = np.array([0.0, 0.0, 0.05, 5e3, 0.15, 8e3, 0.5, 10e3])


def test_table_is_odd_and_linear_between_its_points():
    assert damper_force(0.01, BLOW_OFF, 3) == pytest.approx(6e3)
    assert damper_force(-0.1, BLOW_OFF, 3) == pytest.approx(-12e3)
    assert damper_force(0.1, THREE, 4) == pytest.approx(6.5e3)
    assert damper_force(0.85, THREE, 4) == pytest.approx(12e3)  # on as between its last points
    assert damper_force(0.0, THREE, 4) == 0.0


def marched(times, way, speed, stiffness, table, points):
    """Forces at the times of a motion, step by step from rest."""
    force, forces = 0.0, [0.0]
    for t0, t1 in pairwise(times):
        force, _ = series_damper_force(force, way(t1) - way(t0), t1 - t0, speed(t1), stiffness, table, points)
        forces.append(force)
    return np.array(forces)


def exact(times, speed, stiffness, table):
    """F' = k (v - table^-1(F)) by a fine integrator."""
    force, own = table[1::2], table[::2]
    force, own = np.concatenate([-force[:0:-1], force]), np.concatenate([-own[:0:-1], own])

    def rate(t, f):
        return stiffness * (speed(t) - np.interp(f, force, own))

    found = solve_ivp(rate, (times[0], times[-1]), [0.0], t_eval=times, rtol=1e-9, atol=1e-6, method="LSODA")
    return found.y[0]


@pytest.mark.parametrize("stiffness", [1e5, 1e7, 1e9])
def test_a_linear_one_is_exact_for_a_speed_linear_in_time(stiffness):
    times = np.linspace(0.0, 0.1, 26)  # 4 ms: 67 time constants of the stiffest
    found = marched(times, lambda t: t**2, lambda t: 2.0 * t, stiffness, LINEAR, 2)
    lag = 60e3 / stiffness
    expected = 60e3 * 2.0 * (times - lag * (1.0 - np.exp(-times / lag)))
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-6)


@pytest.mark.parametrize("stiffness", [1e6, 1e8])
def test_a_table_of_three_stretches_is_that_of_the_differential_equation(stiffness):
    omega, way = 2.0 * math.pi * 3.0, 0.02
    times = np.linspace(0.0, 0.7, 1751)  # 0.4 ms
    speed = lambda t: way * omega * math.cos(omega * t)  # noqa: E731
    found = marched(times, lambda t: way * math.sin(omega * t), speed, stiffness, THREE, 4)
    expected = exact(times, speed, stiffness, THREE)
    assert np.abs(found).max() > 7e3
    assert found == pytest.approx(expected, abs=0.01 * np.abs(expected).max())  # at a corner of the table
    assert np.std(found - expected) < 5e-4 * np.std(expected)


def test_a_rigid_mounting_leaves_the_damper_alone():
    times = np.linspace(0.0, 0.2, 501)
    omega = 2.0 * math.pi * 5.0
    speed = 3e-3 * omega * np.cos(omega * times)
    found = marched(
        times, lambda t: 3e-3 * math.sin(omega * t), lambda t: 3e-3 * omega * math.cos(omega * t), 1e12,
        BLOW_OFF[:4], 2,
    )  # fmt: skip
    alone = np.array([damper_force(v, BLOW_OFF[:4], 2) for v in speed])
    assert found[1:] == pytest.approx(alone[1:], rel=1e-4, abs=2.0)


def test_a_valve_limits_the_force_and_a_cycle_loses_energy():
    times = np.linspace(0.0, 1.0, 2501)
    omega = 2.0 * math.pi * 2.0
    force = marched(
        times, lambda t: 0.02 * math.sin(omega * t), lambda t: 0.02 * omega * math.cos(omega * t), 4e6,
        BLOW_OFF, 3,
    )  # fmt: skip
    assert np.abs(force).max() == pytest.approx(12e3)
    way = 0.02 * np.sin(omega * times)
    cycle = slice(1250, None)
    assert np.trapezoid(force[cycle], way[cycle]) > 0.8 * 4.0 * 12e3 * 0.02


def test_without_a_past_the_damper_acts_alone_and_without_time_nothing_changes():
    assert series_damper_force(0.0, 0.01, -math.inf, 0.1, 1e6, LINEAR, 2) == pytest.approx((6e3, 0.1))
    assert series_damper_force(4e3, 0.0, 0.0, 0.1, 1e6, LINEAR, 2)[0] == 4e3
