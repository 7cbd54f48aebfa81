"""Motion after a disturbance, and the nonlinear critical speed: down from a limit cycle until it dies out."""

import os
import signal

import numpy as np
import pytest
from scipy.integrate import quad
from track_sections import straight

from hh_exudyn.multibody.linear import nonlinear_speed
from hh_exudyn.multibody.linear.hunting import _course, lateral_motion
from hh_exudyn.multibody.linear.modes import LinearVehicle, critical_speed
from hh_exudyn.multibody.linear.nonlinear_speed import nonlinear_critical_speed
from vehicles.catalogue import vehicle


def test_linear_contact_dies_out_at_the_linear_critical_speed(wheelset):
    """73.39 m/s: nothing in it but its flange is not linear, so nothing is left below; above, it derails.

    Creep forces without bound carry the flanges over the rails.
    """
    seen = []
    found = nonlinear_critical_speed(
        wheelset, 60.0, 80.0, 4.0, 2.0, report=lambda run, more: seen.append((run.speed, more))
    )
    assert (found.hunting, found.settled, found.begins) == (74.0, 72.0, 74.0)
    assert [run.speed for run in found.runs] == [speed for speed, _ in seen]
    assert all(more >= len(seen) - k - 1 for k, (_, more) in enumerate(seen))  # no more than was said
    assert [run.hunts for run in found.runs] == [run.speed > 73.39 for run in found.runs]
    assert found.runs[0].amplitude == np.inf and found.runs[2].amplitude < 0.5e-3
    assert not any(run.from_cycle for run in found.runs)


def test_a_range_without_hunting_is_said(wheelset):
    found = nonlinear_critical_speed(wheelset, 40.0, 50.0, 10.0, 5.0)
    assert (found.hunting, found.settled, found.begins) == (None, None, None)
    assert len(found.runs) == 2


@pytest.mark.slow
def test_hunting_of_the_coach_is_followed_down(given_case):
    """On S1002 and 60E1: a limit cycle well above its linear critical speed, none well below."""
    case = given_case.with_changes(
        contact={"theory": "fastrip"}, wheel_profile="S1002", track={"rail": "60E1", "inclination": "1:40"}
    )
    coach = LinearVehicle(vehicle("manchester_vehicle_1"), case)
    linear = critical_speed(coach, low=45.0, high=75.0, step=10.0).speed
    assert 50.0 < linear < 70.0
    found = nonlinear_critical_speed(coach, 0.5 * linear, 1.3 * linear, 0.2 * linear, 0.1 * linear)
    assert found.runs[0].amplitude > 3e-3
    assert 0.7 * linear < found.settled < found.hunting < 1.15 * linear
    assert found.hunting - found.settled <= 0.1 * linear
    assert found.begins >= found.hunting


def test_a_motion_goes_on_where_it_ended(wheelset):
    """One second in two halves is one second."""
    whole = lateral_motion(wheelset, 80.0, 1.0, 2e-3)
    half = lateral_motion(wheelset, 80.0, 0.5, 2e-3)
    rest = lateral_motion(wheelset, 80.0, 0.5, begun=half.end)
    assert rest.lateral[-1] == pytest.approx(whole.lateral[-1], abs=1e-9)
    assert half.end.q == pytest.approx(half.end.q)
    assert rest.end.speed == 80.0


def test_the_train_slows_down_as_it_is_told():
    """Way and speed of the train: the integral of a speed that falls by 2 m/s^2 from 30 to 20 m/s."""

    def speed(t):
        return _course(30.0, 20.0, 2.0, t)[1]

    assert [speed(t) for t in (0.0, 2.5, 5.0, 9.0)] == pytest.approx([30.0, 25.0, 20.0, 20.0])
    for time in (0.0, 1.0, 4.9, 5.0, 8.0):
        less, now = _course(30.0, 20.0, 2.0, time)
        assert less + now * time == pytest.approx(quad(speed, 0.0, time, points=[5.0])[0], rel=1e-9)
    assert _course(20.0, 20.0, 1.0, 3.0) == (0.0, 20.0)


def test_a_vehicle_follows_its_train_to_another_speed(demo):
    """The wagon, slowed from 20 to 19 m/s: it runs, and its wheels roll, at 19 m/s."""
    wagon = LinearVehicle(vehicle("iore_wagon_loaded"), demo.with_changes(track={"sections": straight(60.0)}))
    begun = lateral_motion(wagon, 20.0, 0.2)
    slower = lateral_motion(wagon, 19.0, 4.0, begun=begun.end, slowing=1.0)
    bodies = slower.end.v[: 6 * len(wagon.names)].reshape(-1, 6)
    assert bodies[:, 0] == pytest.approx(19.0, abs=0.01)
    spins = [i for i, name in enumerate(wagon.names) if name.startswith("wheelset")]
    assert bodies[spins, 4] == pytest.approx(19.0 / 0.4575, rel=2e-3)
    assert slower.amplitude(0.0) < 1e-5


def test_ctrl_c_ends_a_motion(wheelset):
    times = []

    def press(time):
        times.append(time)
        if len(times) == 100:
            os.kill(os.getpid(), signal.SIGINT)

    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        lateral_motion(wheelset, 60.0, 5.0, progress=press)
    assert len(times) < 200
    assert signal.getsignal(signal.SIGINT) is before


def test_a_derailment_counts_as_hunting(wheelset, monkeypatch):
    """And the speed below it begins with a disturbance again."""

    def derails_above(vehicle, speed, *arguments, **named):
        if speed > 79.0:
            raise nonlinear_speed.Derailed("wheel 1L left its rail")
        return lateral_motion(vehicle, speed, *arguments, **named)

    monkeypatch.setattr(nonlinear_speed, "lateral_motion", derails_above)
    found = nonlinear_critical_speed(wheelset, 76.0, 80.0, 4.0, 4.0)
    assert [run.from_cycle for run in found.runs][:2] == [False, False]
    assert np.isinf(found.runs[0].amplitude) and found.runs[0].hunts
    assert found.hunting == 76.0 and found.settled is None


@pytest.mark.parametrize("speeds", [(50.0, 20.0, 5.0, 1.0), (10.0, 20.0, 0.0, 1.0), (10.0, 20.0, 5.0, 0.0)])
def test_speeds_in_disorder_are_refused(wheelset, speeds):
    with pytest.raises(ValueError, match="needed 0 < low < high"):
        nonlinear_critical_speed(wheelset, *speeds)
