"""The closed form of a suspended wheelset's critical speed against the eigenvalues of its two equations."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from vehicles.models.suspended_wheelset import critical_speed_closed_form

EXAMPLE = {
    "mass": 1800.0, "yaw_inertia": 1000.0, "lateral_stiffness": 2e6, "yaw_stiffness": 2e6,
    "longitudinal_creep": 1e7, "lateral_creep": 1e7, "half_distance": 0.75, "conicity": 0.1, "radius": 0.46,
}  # fmt: skip
SOFT = {
    "mass": 500.0, "yaw_inertia": 300.0, "lateral_stiffness": 1e4, "yaw_stiffness": 1e4,
    "longitudinal_creep": 1e6, "lateral_creep": 1e6, "half_distance": 0.5, "conicity": 0.25, "radius": 0.5,
}  # fmt: skip


def growth(speed, p):
    """Largest real part of the four eigenvalues over the modulus of the largest."""
    f11, f22 = p["longitudinal_creep"], p["lateral_creep"]
    e, spin = p.get("roll", 0.0), p.get("spin_inertia", 0.0)
    k, g = 1.0 + p["radius"] * e, e * spin * speed / p["radius"]
    mass = np.diag([p["mass"] + p["yaw_inertia"] * e**2, p["yaw_inertia"]])
    stiffness = np.array(
        [
            [p["lateral_stiffness"], -2 * f22 * k],
            [2 * f11 * p["half_distance"] * p["conicity"] / p["radius"], p["yaw_stiffness"]],
        ]
    )
    damping = np.diag([2 * f22 * k**2, 2 * f11 * p["half_distance"] ** 2]) / speed
    damping += np.array([[0.0, -g], [g, 0.0]])
    system = np.block(
        [
            [np.zeros((2, 2)), np.eye(2)],
            [-np.linalg.solve(mass, stiffness), -np.linalg.solve(mass, damping)],
        ]
    )
    values = np.linalg.eigvals(system)
    worst = values[np.argmax(values.real)]
    return worst.real / abs(worst), abs(worst.imag) / (2 * math.pi)


def test_published_example():
    """Example 1 of the project's notes: 73.3928 m/s, 6.2716 Hz; example 2: 50.3523 m/s."""
    speed, frequency = critical_speed_closed_form(**EXAMPLE)
    assert speed == pytest.approx(73.3928, abs=1e-4)
    assert frequency == pytest.approx(6.2716, abs=1e-4)
    second, _ = critical_speed_closed_form(
        1022.0, 678.0, 364600.0, 280304.5, 6.563e6 / 0.54219, 6.563e6 / 0.60252, 0.716, 0.05, 0.4572
    )
    assert second == pytest.approx(50.3523, abs=1e-3)


@given(
    st.fixed_dictionaries(
        {
            "mass": st.floats(500, 4000),
            "yaw_inertia": st.floats(300, 3000),
            "lateral_stiffness": st.floats(1e4, 2e7),
            "yaw_stiffness": st.floats(1e4, 2e7),
            "longitudinal_creep": st.floats(1e6, 5e7),
            "lateral_creep": st.floats(1e6, 5e7),
            "half_distance": st.floats(0.5, 0.9),
            "conicity": st.floats(0.01, 0.4),
            "radius": st.floats(0.3, 0.7),
        },
        optional={"roll": st.floats(0.0, 0.6), "spin_inertia": st.floats(0.0, 300.0)},
    )
)
@example(EXAMPLE | {"roll": 1e-13, "spin_inertia": 1.0})  # roots of V^2 twenty orders of magnitude apart
@example(SOFT | {"roll": 1e-13, "spin_inertia": 1.0})
def test_eigenvalues_cross_at_the_closed_form(p):
    speed, frequency = critical_speed_closed_form(**p)
    if math.isinf(speed):
        assert all(growth(v, p)[0] < 0.0 for v in (1.0, 10.0, 100.0, 1e3, 1e4))
        return
    assume(1.0 < speed < 1e4)
    at, found = growth(speed, p)
    assert abs(at) < 1e-7
    assert found == pytest.approx(frequency, rel=1e-6)
    assert growth(0.98 * speed, p)[0] < 0.0 < growth(1.02 * speed, p)[0]


@pytest.mark.parametrize(("name", "value"), [("mass", 0.0), ("conicity", -0.1), ("lateral_stiffness", -1.0)])
def test_a_number_out_of_range_is_refused(name, value):
    with pytest.raises(ValueError, match="must be >"):
        critical_speed_closed_form(**EXAMPLE | {name: value})


def test_spin_without_roll_changes_nothing_and_with_roll_it_stabilises():
    """By some per cent of the speed for a spin inertia of 100 kg m^2 on cones of 0.1."""
    assert critical_speed_closed_form(**EXAMPLE, spin_inertia=100.0) == critical_speed_closed_form(**EXAMPLE)
    of_cones = {"roll": 0.1 / 0.75 / (1.0 - 0.46 * 0.1 / 0.75)}
    still, _ = critical_speed_closed_form(**EXAMPLE, **of_cones)
    spinning, _ = critical_speed_closed_form(**EXAMPLE, **of_cones, spin_inertia=100.0)
    assert 1.01 < spinning / still < 1.05


@pytest.mark.parametrize("name", ["roll", "spin_inertia"])
def test_roll_and_spin_below_zero_are_refused(name):
    with pytest.raises(ValueError, match="must be >= 0"):
        critical_speed_closed_form(**EXAMPLE, **{name: -1.0})
