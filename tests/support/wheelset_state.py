"""The wheel-rail kernel on S1002 wheels and 60E1 rails, and wheelset states to try it with."""

import math
from typing import Any

import numpy as np
from straight_rails import no_forces, straight_rails

from hh_exudyn.contact.friction import constant_friction
from hh_exudyn.contact.profile import Profile, rail_profile, wheel_profile
from hh_exudyn.contact.state import Patch
from hh_exudyn.contact.types import WheelRailModel, WheelsetMotion
from hh_exudyn.contact.wheel_rail import wheel_rail_forces, wheel_rail_model

R0 = 0.46
GAUGE = 1.435


def model(rail: Profile | None = None, **options: Any) -> WheelRailModel:
    wheel, rail = wheel_profile("S1002"), rail or rail_profile("60E1", 1 / 40)
    return wheel_rail_model(wheel, wheel, rail, rail, nominal_radius=R0, **options)


MODEL = model()


class State:
    """Arrays of n wheelsets as the kernel takes them, at rest, and what it returned."""

    def __init__(self, n: int = 1, height: float = R0 - 250e-6) -> None:
        self.position = np.tile([0.0, 0.0, height], (n, 1))
        self.axle = np.tile([0.0, 1.0, 0.0], (n, 1))
        self.velocity = np.zeros((n, 3))
        self.angular_velocity = np.zeros((n, 3))
        self.rail_displacement = np.zeros((n, 2, 2))
        self.rail_velocity = np.zeros((n, 2, 2))
        self.creep_lag = np.zeros((n, 2, 2))
        self.gauge = np.full(n, GAUGE)
        self.arc_length = np.zeros(n)
        self.friction = np.full((n, 2), 0.3)
        self.forces = no_forces(n)
        self.wrench, self.rail_force, self.patches, *_ = self.forces
        self.status = -1

    def point(self, yaw: float, roll: float = 0.0, i: int = 0) -> None:
        self.axle[i] = (-math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll))

    def roll_on(self, speed: float, yaw_rate: float = 0.0, radius: float = R0, i: int = 0) -> None:
        self.velocity[i, 0] = speed
        self.angular_velocity[i] = self.axle[i] * speed / radius + np.array([0.0, 0.0, yaw_rate])

    def solve(self, contact_model: WheelRailModel = MODEL) -> "State":
        motion = WheelsetMotion(
            self.position, self.axle, self.velocity, self.angular_velocity, self.creep_lag
        )
        rails = straight_rails(
            contact_model, self.gauge, self.arc_length, self.rail_displacement, self.rail_velocity
        )
        friction = constant_friction(self.friction)
        self.status = wheel_rail_forces(contact_model, motion, rails, friction, self.forces)
        return self

    def rows(self, i: int = 0, side: int = 0) -> np.ndarray:
        return self.patches[i, side][self.patches[i, side, :, Patch.NORMAL_FORCE] > 0]
