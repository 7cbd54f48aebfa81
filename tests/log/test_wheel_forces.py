"""Wheel forces over time from a contact log: the right wheel, the filter, the spectrum, refusals."""

import math
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.log.schema import LOGS
from hh_exudyn.log.store import Recorder, Run, open_run
from hh_exudyn.log.wheel_forces import WheelForces, wheel_forces

CONTACT = [column.name for column in LOGS["contact"]]


def log_of(directory: Path, rows: list[dict[str, float]]) -> Run:
    with Recorder(directory, {"case": 'name = "made up"\n'}) as recorder:
        recorder.append_rows("contact", np.array([[row.get(name, 0.0) for name in CONTACT] for row in rows]))
    return open_run(directory)


def wave(frequency: float, amplitude: float, interval: float = 0.004, count: int = 5000) -> WheelForces:
    """One wheelset at 10 m/s; Q of its left wheel is a cosine on 100 kN, Y of its right wheel another."""
    time = interval * np.arange(count)
    Q, Y = np.full((count, 1, 2), 100e3), np.zeros((count, 1, 2))
    cosine = amplitude * np.cos(2.0 * math.pi * frequency * time)
    Q[:, 0, 0] += cosine
    Y[:, 0, 1] += cosine
    return WheelForces(time, 10.0 * time[:, None], Q, Y)


def test_each_wheel_has_its_own_column(tmp_path: Path) -> None:
    """Second patches repeat Q and count once; a wheel in the air has no row and no force."""
    rows = [
        {"time": t, "s": 10.0 * t - w, "vehicle": 1, "wheelset": w, "side": side, "patch": patch,
         "Q": 100 * w + side, "Y": 1000 * w + side}
        for t in (0.0, 1.0, 2.0) for w in (1, 2) for side in (1, -1) for patch in (0, 1)
        if not (t == 1.0 and w == 2)
    ]  # fmt: skip
    rows += [{**rows[0], "vehicle": 2, "Q": 7.0}]
    forces = wheel_forces(log_of(tmp_path / "run", rows))
    assert forces.time.tolist() == [0.0, 1.0, 2.0]
    assert forces.Q.tolist() == [[[101, 99], [201, 199]], [[101, 99], [0, 0]], [[101, 99], [201, 199]]]
    assert forces.Y[0].tolist() == [[1001, 999], [2001, 1999]]
    assert forces.s.tolist() == [[-1.0, -2.0], [9.0, 8.0], [19.0, 18.0]]
    assert forces.between(7.0, 20.0).time.tolist() == [1.0, 2.0]
    with pytest.raises(ValueError, match=r"vehicle 3 is not in the contact log; it has \[1, 2\]"):
        wheel_forces(open_run(tmp_path / "run"), vehicle=3)
    with pytest.raises(ValueError, match=r"never lie between s = 50 and 60 m: .* from -2\.0 to 19\.0 m"):
        forces.between(50.0, 60.0)


def test_one_output_time_is_refused(tmp_path: Path) -> None:
    run = log_of(tmp_path / "run", [{"vehicle": 1, "wheelset": 1, "side": 1, "Q": 1.0}])
    with pytest.raises(ValueError, match="one output time"):
        wheel_forces(run)


@pytest.mark.parametrize(("frequency", "left"), [(5.0, 1.0), (20.0, math.sqrt(0.5)), (60.0, 0.0)])
def test_filtered_forces_have_half_the_power_at_the_cutoff_and_no_shift(
    frequency: float, left: float
) -> None:
    before = wave(frequency, 10e3)
    after = before.filtered(20.0)
    inside = slice(500, -500)
    for force, wheel in (("Q", 0), ("Y", 1)):
        old, new = (getattr(forces, force)[inside, 0, wheel] for forces in (before, after))
        assert new - new.mean() == pytest.approx(left * (old - old.mean()), abs=0.01 * 10e3)
        assert new.mean() == pytest.approx(old.mean(), abs=1.0)
    with pytest.raises(ValueError, match=r"cut-off is 125\.0 Hz, allowed are above 0 to below 124\.92 Hz"):
        before.filtered(125.0)


def test_the_spectrum_integrates_to_the_variance() -> None:
    forces = wave(25.0, 10e3)
    for force, wheel in (("Q", 0), ("Y", 1)):
        frequency, density = forces.spectrum(force)
        assert frequency[1] == pytest.approx(0.25)
        assert frequency[np.argmax(density[:, 0, wheel])] == pytest.approx(25.0)
        assert density[:, 0, wheel].sum() * frequency[1] == pytest.approx(10e3**2 / 2, rel=1e-6)
        assert density[:, 0, 1 - wheel].max() < 1e-9
    with pytest.raises(ValueError, match="force is 'X'"):
        forces.spectrum("X")
    with pytest.raises(ValueError, match=r"segment is 21\.0 s, allowed are 0\.032 to 20 s"):
        forces.spectrum("Q", 21.0)
