"""The state of controllers, stored and put back: the same commands follow."""

import numpy as np
import pytest

from hh_exudyn.arrays import FloatArray
from vehicles.traction.effort import OverSlip, SlipControl, SlipLimits, SpeedControl, SpeedControlGains
from vehicles.traction.memory import memory_of, put_back


class Both:
    """A controller that contains others, settings and a value that is not there at first."""

    def __init__(self) -> None:
        self.speed = SpeedControl(15.0, 2e5, 1e4, SpeedControlGains())
        self.slip = SlipControl(2, SlipLimits())
        self.over = OverSlip(0.02, 0.6, 100.0, np.array([1e3, 2e3]))
        self.samples = 0
        self.last: float | None = None
        self.name = "settings are left alone"
        self.wanted = True

    def act(self, speed: float) -> FloatArray:
        self.samples += 1
        self.last = speed
        effort = self.speed.step(speed, -1e5, 1e5, 1e4, 0.01)
        wheels, ways = np.array([1.1 * speed, 1.3 * speed]), np.array([speed, speed])
        share = self.slip.step(wheels, ways, effort, 0.01)
        return np.concatenate([[effort], share, self.over.step(wheels, ways, 1e4, 0.01)])


def test_the_same_commands_follow() -> None:
    one, other = Both(), Both()
    for speed in (14.0, 14.1, 13.9):
        one.act(speed)
    stored = memory_of(one)
    following = [one.act(speed) for speed in (14.2, 14.0)]
    put_back(other, stored)
    assert (other.samples, other.last) == (3, 13.9)
    assert isinstance(other.samples, int)
    np.testing.assert_array_equal([other.act(speed) for speed in (14.2, 14.0)], following)
    assert following[0] != pytest.approx(Both().act(14.2))  # a controller that remembers nothing differs


def test_arrays_are_filled_in_place() -> None:
    """Actuators share theirs with the work space of the kernels."""

    class Holder:
        def __init__(self) -> None:
            self.torques = np.zeros(3)

    holder = Holder()
    shared = holder.torques
    put_back(holder, {"torques": np.array([1.0, 2.0, 3.0])})
    assert holder.torques is shared
    np.testing.assert_array_equal(shared, [1.0, 2.0, 3.0])
