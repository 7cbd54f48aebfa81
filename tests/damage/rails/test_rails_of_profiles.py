"""Rails below strips of the run and below half-space patches: the same balance, at the places of the log."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pyarrow
import pytest

from damage.rails.model import RailModel, RailStretch
from damage.report import assess
from damage.wear.archard import archard
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.contact.types import WheelRailModel
from hh_exudyn.contact.wheel_rail import wheel_rail_model
from hh_exudyn.contact.wheelset import wheel_on_rail
from hh_exudyn.conventions import LEFT, RIGHT

WHEEL, RAIL = wheel_profile("S1002"), rail_profile("60E1", 1.0 / 30.0)
R0 = 0.46
STRETCH = RailStretch.of(-1.0, 1.0, RAIL, RAIL)
COLUMNS = (
    "y_wheel", "y_rail", "contact_angle", "rolling_radius", "normal_force", "a", "b", "p_max", "nu_x", "nu_y",
    "phi", "friction", "speed", "force_x", "force_y", "moment_z", "Q", "Y", "angle_of_attack", "centre_y",
    "centre_z", "roll", "s",
)  # fmt: skip


@pytest.fixture(scope="module")
def contact() -> WheelRailModel:
    return wheel_rail_model(WHEEL, WHEEL, RAIL, RAIL, nominal_radius=R0, normal="coupled_strips")


def log_of(make_log: Callable[..., pyarrow.Table], side: int, **pose: float) -> pyarrow.Table:
    """The patches of one wheel in a pose, mirrored for a right wheel."""
    given: dict[str, Any] = {name: side * value for name, value in pose.items()}
    given |= {"roll": 0.0, "load": 110e3, "radius": R0, "speed": 20.0, "friction": 0.4}
    given |= {"pitch_rate": 20.0 / R0 * 1.001, "normal": "coupled_strips"}
    states = wheel_on_rail(WHEEL, RAIL, side, **given).contacts
    rows = {name: np.array([getattr(state, name) for state in states]) for name in COLUMNS}
    return make_log(side=side, patch=np.arange(len(states)), **rows)


@pytest.mark.parametrize("normal", ["strips", "halfspace"])
def test_wheel_and_rail_lose_the_same(
    normal: str, make_log: Callable[..., pyarrow.Table], contact: WheelRailModel
) -> None:
    """Volume strip by strip; the rail's place is the logged one, on both sides."""
    found = {}
    for side in (LEFT, RIGHT):
        log = log_of(make_log, side, lateral=6.2e-3, yaw=5e-3)  # a left wheel: on its flange root
        report = assess(
            log, profile=WHEEL, contact=contact, normal=normal, law=archard(hardness=2.65e9),
            rails=RailModel((STRETCH,)),
        )  # fmt: skip
        rail = report.rails[0][0 if side == LEFT else 1]
        volume = report.surface.worn_volume[0].sum()
        assert volume > 0.0
        np.testing.assert_allclose(rail.by_wheel.worn_volume, report.surface.worn_volume, rtol=1e-12)
        assert rail.by_wheel.worn_area[0].sum() == pytest.approx(volume, rel=1e-9)
        depth, grid = rail.by_wheel.depth[0], rail.by_wheel.grid
        worn = grid.lateral[depth > 0.0]
        assert worn.min() - 1e-3 <= log["y_rail"].to_numpy().min() <= worn.max() + 1e-3
        assert worn.min() - 1e-3 <= log["y_rail"].to_numpy().max() <= worn.max() + 1e-3
        found[side] = depth
    np.testing.assert_allclose(found[LEFT], found[RIGHT], rtol=1e-6, atol=1e-6 * found[LEFT].max())


def test_flange_root_wears_the_gauge_corner(
    make_log: Callable[..., pyarrow.Table], contact: WheelRailModel
) -> None:
    """A wheel pressed outwards wears the rail at its gauge corner, one inwards on its top."""
    for lateral, low, high in ((6.2e-3, 0.020, 0.036), (-4e-3, -0.02, 0.015)):
        log = log_of(make_log, LEFT, lateral=lateral, yaw=5e-3)
        report = assess(log, profile=WHEEL, contact=contact, rails=RailModel((STRETCH,)))
        depth = report.rails[0][0].by_wheel.depth[0]
        assert low < STRETCH.left.lateral[depth.argmax()] < high
