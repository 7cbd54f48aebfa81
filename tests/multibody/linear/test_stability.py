"""The largest stable step: closed forms, and what happens at it."""

from dataclasses import replace

import numpy as np
import pytest

from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.linear.stability import LARGEST_STEP, MARGIN, eigenvalues, largest_stable_step
from hh_exudyn.multibody.model import workspace
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle
from vehicles.couplings import AxleBox


@pytest.mark.parametrize(("value", "reach"), [(-5000.0, 2.5127), (-10.0 + 5000.0j, 1.7321)])
def test_limits_of_the_runge_kutta_method(value, reach):
    """On the real axis RK33 reaches 2.513, on the imaginary one sqrt 3 (Hairer and Wanner, IV.2)."""
    assert largest_stable_step(np.array([value])) == pytest.approx(reach / 5000.0, rel=0.01)


def test_slow_and_growing_motions_do_not_limit_the_step():
    assert largest_stable_step(np.array([-1.0, 2.0 + 3.0j, 0.0])) == LARGEST_STEP


def values_at(demo, speed_km_h):
    wagon = vehicle(demo.vehicle)
    model = assemble(wagon, demo.with_changes(speed_km_h=speed_km_h))
    work = workspace(model)
    return eigenvalues(model, work, equilibrium(wagon, model, work))


@pytest.mark.parametrize("speed_km_h", [5.0, 10.0, 60.0, 130.0])
def test_the_wagon_bears_the_default_step_of_a_case(demo, speed_km_h):
    """0.4 ms, at any speed: the limit is 0.42 ms at 5 and 10 km/h, 0.46 at 60 and 0.5 at 130."""
    assert MARGIN * largest_stable_step(values_at(demo, speed_km_h)) >= 0.4e-3


def test_the_loaded_wagon_moves_as_ore_wagons_do(demo):
    """Friction stuck: train 0.5 Hz at 70 %, sway near 1 Hz, then nothing below 2 Hz; all damped 4..30 %.

    But for bounce and pitch on wedges that stick, 6 and 8 Hz: the damping of faces, pads and coils is 0.001
    to 0.004 s of their stiffness, their share of the critical so pi f times that; the track adds some.
    """
    values = values_at(demo, 60.0)
    modes = values[values.imag > 0.0]
    frequency, damping = np.abs(modes) / (2 * np.pi), -modes.real / np.abs(modes)
    train = np.argmin(np.abs(frequency - 0.5) + np.abs(damping - 0.7))
    assert frequency[train] == pytest.approx(0.5, abs=0.01)
    assert damping[train] == pytest.approx(0.7, abs=0.01)
    body = (frequency > 0.8) & (frequency < 10.0) & (damping < 0.9)
    sway = frequency[body].min()
    assert 0.9 < sway < 1.5
    assert (frequency[body] > 2.0).sum() == body.sum() - 1
    stuck = body & (frequency > 5.5)
    assert np.sort(frequency[stuck]) == pytest.approx([6.2, 8.1], rel=0.03)
    share = damping[stuck] / (np.pi * frequency[stuck])
    assert ((share > 0.001) & (share < 0.004)).all()
    assert ((damping[body & ~stuck] > 0.04) & (damping[body & ~stuck] < 0.3)).all()


def test_a_step_too_large_is_refused_before_anything_is_written(demo, runs):
    """Pads a hundred times too stiff for the step."""
    wagon = vehicle(demo.vehicle)
    stiff = [
        replace(c, stiffness=(*c.stiffness[:2], 100 * c.stiffness[2])) if isinstance(c, AxleBox) else c
        for c in wagon.couplings
    ]
    with pytest.raises(ValueError, match=r"step_ms = 0\.4 ms: allowed up to 0\.\d+ ms"):
        simulate(demo, runs / "stiff", vehicle=replace(wagon, couplings=tuple(stiff)))
    assert not (runs / "stiff").exists()
