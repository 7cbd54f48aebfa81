"""Time of one wheel with each theory of normal contact (run with ``pytest tests/benchmarks``)."""

from typing import Any

import numpy as np
import pytest
from straight_rails import no_forces, straight_rails

from hh_exudyn.contact.friction import constant_friction
from hh_exudyn.contact.normal.registry import NORMAL_THEORIES
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.contact.state import Patch
from hh_exudyn.contact.types import WheelsetMotion
from hh_exudyn.contact.wheel_rail import wheel_rail_forces, wheel_rail_model


@pytest.mark.parametrize("cells", [15, 20])
@pytest.mark.parametrize("normal", NORMAL_THEORIES)
def test_four_wheelsets(benchmark: Any, normal: str, cells: int) -> None:
    """Eight wheels on the tread under some 100 kN each; one patch a wheel."""
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1")
    model = wheel_rail_model(
        wheel, wheel, rail, rail, nominal_radius=0.46, normal=normal, cells=(cells, cells)
    )
    n = 4
    position = np.tile([0.0, 0.0, 0.46 - 310e-6], (n, 1))
    position[:, 1] = [-0.001, -0.0003, 0.0003, 0.001]
    axle = np.tile([0.0, 1.0, 0.0], (n, 1))
    velocity = np.tile([20.0, 0.01, 0.0], (n, 1))
    motion = WheelsetMotion(position, axle, velocity, axle * 20.0 / 0.46, np.zeros((n, 2, 2)))
    rails, found = straight_rails(model, np.full(n, 1.435)), no_forces(n)
    friction = constant_friction(np.full((n, 2), 0.3))
    assert benchmark(wheel_rail_forces, model, motion, rails, friction, found) == 0
    forces = found.patches[..., Patch.NORMAL_FORCE].sum(axis=2)
    assert (forces > 3e4).all()
    assert (forces < 2e5).all()
