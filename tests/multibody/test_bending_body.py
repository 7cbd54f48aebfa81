"""A body of beam elements: its rigid limit, and the resuming of a run with an extension."""

import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from two_axle_wagon import HALF_WHEELBASE, two_axle_wagon

from hh_exudyn.case import Case, CurveCase, IntegrationCase, StraightCase, TrackCase, TransitionCase
from hh_exudyn.log.store import CHECKPOINT_FILE, Run, open_run
from hh_exudyn.multibody.bending_body import BendingBody
from hh_exudyn.multibody.interruption import Terminated
from hh_exudyn.multibody.simulate import simulate
from vehicles.description import Body, Vehicle

LENGTH = 9.0  # m
TRACK = TrackCase(irregularity="erri_high", flexibility="rigid", sections=(StraightCase(length_m=115),))
STEPS = IntegrationCase(step_ms=0.2, output_interval_ms=4.0)


def bending(frequency: float) -> BendingBody:
    body = two_axle_wagon().body("body")
    return BendingBody(body, LENGTH, (-HALF_WHEELBASE, HALF_WHEELBASE), frequency, elements=4)


def case(step_ms: float) -> Case:
    steps = IntegrationCase(step_ms=step_ms, output_interval_ms=4.0)
    return Case(name="bending", speed_km_h=120, friction=0.35, track=TRACK, integration=steps)


def with_rigid(body: Body) -> Vehicle:
    wagon = two_axle_wagon()
    return replace(wagon, bodies=tuple(body if each.name == body.name else each for each in wagon.bodies))


def test_the_rigid_body_has_the_mass_and_inertia_of_the_beam() -> None:
    """Summed over the beam's slices and both light bodies."""
    beam = bending(10.0)
    slices = np.linspace(-LENGTH / 2, LENGTH / 2, 20_001)
    middles = (slices[1:] + slices[:-1]) / 2
    uniform = 0.95 * beam.body.mass * np.mean(middles**2)
    lumped = 0.05 * beam.body.mass * HALF_WHEELBASE**2
    section = beam.body.mass * 0.4**2
    assert beam.rigid.mass == beam.body.mass
    assert beam.rigid.inertia == pytest.approx(
        (beam.body.inertia[0], uniform + lumped + section, uniform + lumped + section), rel=1e-6
    )


def heights(run: Run, *bodies: str) -> np.ndarray:
    """Vertical motion of the middle of some bodies [m], without that of the rest at the start."""
    log = run.motion()
    names = np.array(log["body"].to_pylist())
    z = np.mean([log["z"].to_numpy()[names == body] for body in bodies], axis=0)
    return z - z[0]


def wheel_loads(run: Run) -> np.ndarray:
    log = run.read("wheels")
    return log["Q"].to_numpy().reshape(-1, 4)


@pytest.mark.slow
def test_a_stiff_body_moves_as_a_rigid_one(tmp_path: Path) -> None:
    """Over rough track: what bending adds falls as 1/f^2, towards the rigid body's motion."""
    rigid = simulate(case(0.2), tmp_path / "rigid", vehicle=with_rigid(bending(10.0).rigid))
    moved, loads = heights(rigid, "body"), wheel_loads(rigid)
    apart, uneven = [], []
    for frequency, step in ((8.0, 0.125), (16.0, 0.0625)):
        beam = bending(frequency)
        run = simulate(
            case(step), tmp_path / f"{frequency}", vehicle=beam.in_two(two_axle_wagon()), extend=beam
        )
        size = min(moved.size, heights(run, *beam.names).size)
        apart.append(np.std(heights(run, *beam.names)[:size] - moved[:size]) / np.std(moved))
        uneven.append(np.std(wheel_loads(run)[:size] - loads[:size]) / np.std(loads))
    assert apart[0] > 0.004, apart  # it bends
    assert apart[1] < 0.35 * apart[0], apart
    assert apart[1] < 0.02, apart
    assert uneven[1] < 0.35 * uneven[0], uneven


@pytest.mark.slow
def test_a_run_with_an_extension_is_resumed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Cut off and resumed it is the run without a break, with all coordinates of the beam, bit for bit."""
    monkeypatch.setattr("hh_exudyn.multibody.integration.SEGMENT", 0.1)
    monkeypatch.setattr("hh_exudyn.multibody.integration.STORE_INTERVAL", 0.0)
    monkeypatch.setattr("hh_exudyn.multibody.integration.PROGRESS_INTERVAL", 0.0)
    beam = bending(6.0)
    wagon = beam.in_two(two_axle_wagon())
    curve = CurveCase(length_m=6, radius_m=300, hand="left", cant_mm=80)
    sections = (StraightCase(length_m=14), TransitionCase(length_m=14), curve)
    short = Case(
        name="cut off", speed_km_h=60, friction=0.35, track=TrackCase(sections=sections), integration=STEPS
    )
    whole = simulate(short, tmp_path / "whole", vehicle=wagon, extend=beam)

    sent: list[float] = []

    def cut(done: float, text: str) -> None:
        if done > 0.6 and not sent:
            sent.append(done)
            signal.raise_signal(signal.SIGTERM)

    with pytest.raises(Terminated):
        simulate(short, tmp_path / "cut", cut, vehicle=wagon, extend=beam)
    assert (tmp_path / "cut" / CHECKPOINT_FILE).is_file()
    assert not open_run(tmp_path / "cut").complete
    resumed = simulate(short, tmp_path / "cut", vehicle=wagon, extend=beam, resume=True)
    for log in ("contact", "motion", "energy", "sensors"):
        assert resumed.read(log).equals(whole.read(log)), log
