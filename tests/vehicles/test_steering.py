"""Active steering: the reference is the radial position, reached with the lag of the actuators."""

import numpy as np
import pytest

from vehicles.traction.control import Actuators, Measurement
from vehicles.traction.steering import Steering

OFFSETS = np.array([1.92, 0.0, -1.92, 1.92, 0.0, -1.92])
BOGIES = np.array([1, 1, 1, 2, 2, 2])


def steered(curvatures, gain, softening, duration=10.0):
    steering = Steering(OFFSETS, BOGIES, gain, softening)
    actuators = Actuators(np.zeros(6), 0.0, 0.0, np.zeros(6), np.ones(6))
    empty = np.zeros(6)
    measured = Measurement(0.0, 16.0, empty, empty, empty, np.asarray(curvatures), 0.0)
    for _ in range(round(duration / 0.01)):
        steering.act(measured, actuators, 0.01)
    return actuators


@pytest.mark.parametrize("curvature", [1 / 500.0, -1 / 900.0])
def test_wheelsets_point_to_the_centre_of_the_curve(curvature):
    actuators = steered([curvature] * 6, 1.0, 1.0)
    assert actuators.yaw == pytest.approx(curvature * OFFSETS, abs=1e-12)
    assert actuators.stiffness == pytest.approx(np.ones(6))


def test_each_bogie_follows_its_own_curve():
    actuators = steered([1 / 400.0] * 3 + [0.0] * 3, 0.5, 0.2)
    assert actuators.yaw[:3] == pytest.approx(0.5 / 400.0 * OFFSETS[:3])
    assert actuators.yaw[3:] == pytest.approx(np.zeros(3))
    assert actuators.stiffness == pytest.approx([0.2] * 3 + [1.0] * 3)


def test_actuators_lag_and_have_a_stroke():
    assert steered([1 / 400.0] * 6, 1.0, 1.0, Steering.LAG).yaw[0] == pytest.approx(
        (1 - np.exp(-1)) * 1.92 / 400.0, rel=0.02
    )
    assert steered([1 / 50.0] * 6, 1.0, 1.0).yaw[0] == pytest.approx(Steering.LARGEST_ANGLE)
