"""Mirror, repetition and step size: what must not change the answer does not."""

import numpy as np
import pyarrow.parquet
import pytest
from run_tables import steady, table, wheel_means

from hh_exudyn.case.sealed import sealed
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


def means(run):
    """Q and Y of every wheel in the steady curve, (4, 2) each [N]."""
    contact = steady(table(run, "contact"))
    return wheel_means(contact, "Q"), wheel_means(contact, "Y")


def run_in_steps(case, step_ms, directory):
    return means(simulate(case.with_changes(integration={"step_ms": step_ms}), directory))


@pytest.fixture(scope="module")
def half_step(demo, runs):
    return run_in_steps(demo, demo.integration.step_ms / 2, runs / "half_step")


def check_same(coarse, fine):
    """Q of every wheel within 0.02 %, Y within 0.1 % of the larger Y of its axle."""
    assert coarse[0] == pytest.approx(fine[0], rel=2e-4)
    axle = np.abs(fine[1]).max(axis=1, keepdims=True)
    assert coarse[1] / axle == pytest.approx(fine[1] / axle, abs=1e-3)


def test_half_the_step_does_not_change_wheel_forces(demo_run, half_step):
    """Friction elements that were wound up by their dampers made it 0.4 % of Y, no less with each halving."""
    check_same(means(demo_run), half_step)


@pytest.mark.slow
def test_a_quarter_of_the_step_changes_them_still_less(demo, demo_run, half_step, runs):
    """Wheel forces converge: the second halving changes Y by less than half of what the first did."""
    quarter_step = run_in_steps(demo, demo.integration.step_ms / 4, runs / "quarter_step")
    check_same(means(demo_run), quarter_step)
    first, second = (np.abs(run[1] - quarter_step[1]).max() for run in (means(demo_run), half_step))
    assert second < 0.5 * first


def test_logs_carry_the_case_and_whole_outputs(demo, demo_run):
    part = sorted((demo_run.directory / "contact").glob("*.parquet"))[0]
    assert pyarrow.parquet.read_metadata(part).metadata[b"case"].decode() == sealed(demo).text
    motion = table(demo_run, "motion")
    outputs = np.unique(motion.time)
    assert motion.time.size == outputs.size * 11
    assert np.diff(outputs) == pytest.approx(demo.integration.output_interval_ms * 1e-3)
    assert demo_run.status["finished"] is True
    last = demo_run.status["simulated_s"]  # the last state is logged if an output falls on it
    assert outputs[-1] > last - 1.01e-3 * demo.integration.output_interval_ms
