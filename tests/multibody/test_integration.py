"""Whole short runs: rigid and flexible track agree, the empty wagon, free rolling, interruption."""

import signal

import numpy as np
import pytest
from run_tables import steady, table, wheel_means

from hh_exudyn.conventions import GRAVITY
from hh_exudyn.log.store import open_run
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle
from vehicles.couplings import Wedge

STRAIGHT = [{"kind": "straight", "length_m": 30.0, "gauge_mm": 1445.0}]


def test_rigid_and_flexible_track_carry_the_same_wheel_loads(demo, demo_run, runs):
    """Q in the steady curve is statics, whatever lies under the rails: within 0.5 % but for the twist.

    Weight and overturning moment leave open how the two bogies share that moment. The wedges decide: they
    hold the twist of the entry's cant ramp, more of it on rigid track, where nothing shakes them.
    """
    rigid = simulate(demo.with_changes(track={"flexibility": "rigid"}), runs / "rigid")
    loads = [wheel_means(steady(table(run, "contact")), "Q") for run in (rigid, demo_run)]
    assert loads[0].sum() == pytest.approx(loads[1].sum(), rel=1e-4)
    assert loads[0].sum(axis=0) == pytest.approx(loads[1].sum(axis=0), rel=2e-3)  # of either side
    assert loads[0].sum(axis=1) == pytest.approx(loads[1].sum(axis=1), rel=1e-3)  # of every axle
    twist = np.array([[1, -1], [1, -1], [-1, 1], [-1, 1]])
    held = ((loads[0] - loads[1]) * twist).mean()
    assert loads[0] - held * twist == pytest.approx(loads[1], rel=5e-3)
    assert abs(held) < wedge_friction() / 2  # of a side, whose two wheels share it


def wedge_friction():
    """Least vertical friction [N] of the two wedges of a side under the loaded wagon, going up."""
    wagon = vehicle("iore_wagon_loaded")
    wedge = next(c for c in wagon.couplings if isinstance(c, Wedge))
    spring = wedge.spring_stiffness * (wedge.compression + 0.067)  # at its static deflection
    return 2 * wedge.friction * wedge.normal_force(spring, -1)


def test_the_empty_wagon_runs_into_the_curve(short_case, runs):
    case = short_case.with_changes(vehicle="iore_wagon_empty")
    run = simulate(case, runs / "empty")
    assert run.status["finished"] is True
    contact = table(run, "contact")
    loads = wheel_means(contact, "Q")
    assert loads.sum() == pytest.approx(vehicle(case.vehicle).mass * GRAVITY, rel=0.01)
    assert contact.s.max() > 45.0
    assert np.abs(contact.y_wheelset).max() < 0.02


def rolling(demo, runs, name, **changes):
    """A run straight ahead: the last second's contact and energy logs.

    Without sleepers passing, which would move the rails for ever: only so is rolling steady.
    """
    track = {"sections": STRAIGHT, "sleeper_passing": False}
    run = simulate(demo.with_changes(track=track, **changes), runs / name)
    return steady(table(run, "contact"), 0.3), steady(table(run, "energy"), 0.3)


def test_free_rolling_needs_no_creep_force(demo, runs):
    """Straight ahead in the steady state the wheels roll: no longitudinal force, the train pays for spin."""
    check_free_rolling(*rolling(demo, runs, "rolling"))


@pytest.mark.parametrize(("speed_km_h", "step_ms"), [(10.0, 0.4), (20.0, 0.4), (130.0, 0.4)])
def test_free_rolling_at_any_speed(demo, runs, speed_km_h, step_ms):
    """The damper C/V of steady creep would need ever smaller steps at low speed; the delayed one does not."""
    integration = {"step_ms": step_ms, "output_interval_ms": 10 * step_ms}
    name = f"rolling_{speed_km_h:.0f}"
    check_free_rolling(*rolling(demo, runs, name, speed_km_h=speed_km_h, integration=integration))


def check_free_rolling(contact, energy):
    assert np.abs(contact.force_x).max() < 1e-4 * contact.Q.mean()
    still_taken_up = np.gradient(energy.kinetic_energy, energy.time)  # by the wheels' rotation, up to 6 W
    assert energy.coupler_power == pytest.approx(energy.contact_power + still_taken_up, abs=0.2)  # W


def interrupt_at(fraction):
    """A progress function that presses Ctrl-C once that far."""
    pressed = []

    def progress(done, text):
        if done >= fraction and not pressed:
            pressed.append(done)
            signal.raise_signal(signal.SIGINT)

    return progress, pressed


def test_ctrl_c_keeps_the_log(short_case, runs):
    """KeyboardInterrupt, status "interrupted", a log up to there, and the old handler back in place."""
    handler = signal.getsignal(signal.SIGINT)
    progress, pressed = interrupt_at(0.3)
    with pytest.raises(KeyboardInterrupt):
        simulate(short_case, runs / "interrupted", progress)
    assert signal.getsignal(signal.SIGINT) is handler
    run = open_run(runs / "interrupted")
    assert run.status["finished"] is False
    assert run.status["reason"] == "interrupted"
    end = run.status["simulated_s"]
    assert 0.3 <= pressed[0] < 0.9
    for log in ("contact", "motion", "energy"):
        time = table(run, log).time
        assert time[0] == 0.0
        interval = short_case.integration.output_interval_ms * 1e-3
        assert end - 2 * interval < time.max() <= end
    whole = table(simulate(short_case, runs / "uninterrupted"), "energy")
    cut = table(run, "energy")
    assert cut.kinetic_energy == pytest.approx(whole.kinetic_energy[: cut.time.size], abs=0.0)


def test_ctrl_c_before_the_integration(short_case, runs, request):
    # a shell's background jobs ignore Ctrl-C, and so would a test run among them
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    request.addfinalizer(lambda: signal.signal(signal.SIGINT, before))
    progress, _ = interrupt_at(0.0)
    with pytest.raises(KeyboardInterrupt):
        simulate(short_case, runs / "interrupted_early", progress)
    assert not (runs / "interrupted_early").exists()  # nothing to keep yet


def test_an_error_of_the_progress_function_reaches_the_caller(short_case, runs):
    """Not hidden behind a failure of Exudyn."""

    def progress(done, text):
        if done > 0.2:
            raise OSError("no terminal")

    with pytest.raises(OSError, match="no terminal"):
        simulate(short_case, runs / "bad_progress", progress)
    assert open_run(runs / "bad_progress").status["reason"] == "no terminal"


def test_the_last_state_is_logged(short_case, runs):
    """With an output every step the log ends with the run, and the vehicle stands at the end of the track."""
    every = short_case.with_changes(
        integration={"output_interval_ms": short_case.integration.step_ms},
        track={"sections": STRAIGHT},
    )
    run = simulate(every, runs / "last")
    motion = table(run, "motion")
    assert motion.time.max() == pytest.approx(run.status["simulated_s"], abs=1e-9)
    front = motion.s[motion.body == "car_body"].max() + 10.29 / 2
    assert front == pytest.approx(every.alignment().length, abs=2 * every.speed * 0.4e-3 + 1e-3)
