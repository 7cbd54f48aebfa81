"""Mirror, repetition and step size: what must not change the answer does not."""

import numpy as np
import pyarrow.parquet
import pytest
from run_tables import steady, table, wheel_means

from hh_exudyn.multibody.simulate import simulate


def test_two_runs_are_identical(short_case, runs):
    first, second = (simulate(short_case, runs / f"same_{i}") for i in (1, 2))
    for log in ("contact", "motion", "energy"):
        assert first.read(log).equals(second.read(log))


def test_left_curve_is_the_mirror_of_the_right_curve(short_case, runs):
    """Every wheel's state appears on the other side with opposite lateral creepage, spin and lateral force.

    Rounding grows through the wheels' jumps between tread and flange, hence 1e-6 and not 1e-12.
    """
    left = table(simulate(short_case, runs / "left"), "contact")
    right = table(simulate(short_case.mirrored(), runs / "right"), "contact")
    order_left = np.lexsort((left.patch, left.side, left.wheelset, left.time))
    order_right = np.lexsort((right.patch, -right.side, right.wheelset, right.time))
    for name, sign in {
        "Q": 1, "Y": 1, "normal_force": 1, "y_wheel": 1, "contact_angle": 1, "nu_x": 1, "force_x": 1,
        "nu_y": -1, "phi": -1, "force_y": -1, "angle_of_attack": -1, "y_wheelset": -1,
    }.items():  # fmt: skip
        a, b = getattr(left, name)[order_left], sign * getattr(right, name)[order_right]
        assert a == pytest.approx(b, rel=1e-6, abs=1e-6 * np.abs(a).max()), name


def test_half_the_step_changes_wheel_forces_by_less_than_a_percent(demo, demo_run, runs):
    """Q of every wheel within 1 %, Y within 1 % of the largest Y, in the steady curve."""
    finer = demo.with_changes(integration={"step_ms": demo.integration.step_ms / 2})
    fine = steady(table(simulate(finer, runs / "fine"), "contact"))
    coarse = steady(table(demo_run, "contact"))
    assert wheel_means(coarse, "Q") == pytest.approx(wheel_means(fine, "Q"), rel=0.01)
    y_fine = wheel_means(fine, "Y")
    assert wheel_means(coarse, "Y") == pytest.approx(y_fine, abs=0.01 * np.abs(y_fine).max())


def test_logs_carry_the_case_and_whole_outputs(demo, demo_run):
    part = sorted((demo_run.directory / "contact").glob("*.parquet"))[0]
    assert pyarrow.parquet.read_metadata(part).metadata[b"case"].decode() == demo.to_toml()
    motion = table(demo_run, "motion")
    outputs = np.unique(motion.time)
    assert motion.time.size == outputs.size * 11
    assert np.diff(outputs) == pytest.approx(demo.integration.output_interval_ms * 1e-3)
    assert demo_run.status["finished"] is True
    last = demo_run.status["simulated_s"]  # the last state is logged if an output falls on it
    assert outputs[-1] > last - 1.01e-3 * demo.integration.output_interval_ms
