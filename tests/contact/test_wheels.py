"""Wheelsets with wheels of their own: each as if all had its wheels, exactly."""

import numpy as np
import pytest
from wheelset_state import R0, State

from hh_exudyn.contact.profile import Profile, rail_profile, wheel_profile
from hh_exudyn.contact.types import WheelRailModel
from hh_exudyn.contact.wheel_rail import wheel_rail_model
from hh_exudyn.contact.wheels import alike, no_wheels, with_wheels

S1002, WORN = wheel_profile("S1002"), wheel_profile("WP4_like")
RAIL = rail_profile("60E1", 1 / 40)
WHEELS = [(S1002, S1002), (WORN, S1002), (S1002, WORN)]


def model(left: Profile, right: Profile, normal: str) -> WheelRailModel:
    return wheel_rail_model(left, right, RAIL, RAIL, nominal_radius=R0, normal=normal, cells=(15, 15))


def solved(contact: WheelRailModel, count: int) -> State:
    """Wheelsets in one pose, a little aside and askew."""
    state = State(count, height=R0 - 150e-6)
    for i in range(count):
        state.position[i, 1] = 2e-3
        state.point(yaw=3e-3, i=i)
        state.roll_on(15.0, i=i)
    state.solve(contact)
    assert state.status == 0
    return state


@pytest.mark.parametrize("normal", ["hertz", "coupled_strips"])
def test_every_wheelset_is_as_if_alone(normal: str) -> None:
    together = solved(with_wheels(model(S1002, S1002, normal), WHEELS), len(WHEELS))
    for i, (left, right) in enumerate(WHEELS):
        alone = solved(model(left, right, normal), 1)
        np.testing.assert_array_equal(together.wrench[i], alone.wrench[0])
        np.testing.assert_array_equal(together.patches[i], alone.patches[0])
    assert not np.array_equal(together.wrench[0], together.wrench[1])


def test_the_model_of_one_wheel() -> None:
    plain = model(S1002, S1002, "hertz")
    contact = with_wheels(plain, WHEELS)
    for (i, s), profile in {(1, 0): WORN, (1, 1): S1002, (2, 1): WORN}.items():
        one, wanted = alike(contact, i, s), model(profile, profile, "hertz")
        for name in ("wheel_left", "wheel_right", "strips_left", "strips_right"):
            for found, expected in zip(getattr(one, name), getattr(wanted, name), strict=True):
                np.testing.assert_array_equal(found, expected)
        assert one.wheels.which.size == 0
    assert len(contact.wheels.starts) == 2  # equal profiles have one table
    assert no_wheels().which.shape == (0, 2)


def test_a_rail_is_no_wheel() -> None:
    with pytest.raises(ValueError, match=r"wheel 2R: profile '60E1.*' is a rail's"):
        with_wheels(model(S1002, S1002, "hertz"), [(S1002, S1002), (S1002, RAIL)])
