"""The driver of a train: speed control within the limits of drives and adhesion, and the train behind."""

from dataclasses import dataclass, field

import numpy as np

from hh_exudyn.conventions import GRAVITY
from vehicles.traction.control import Actuators, Measurement
from vehicles.traction.effort import (
    OverSlip,
    SlipControl,
    SlipLimits,
    SpeedControl,
    SpeedControlGains,
    TractionEquipment,
)
from vehicles.traction.train import TrailingTrain, locomotive_resistance


@dataclass(frozen=True)
class DriverOrders:
    """Orders to the driver."""

    set_speed: float  # [m/s]
    braking_limit: float  # electro-dynamic, all units together [N]
    slip_control: bool = True
    over_slip: float = 0.0  # creepage that the simulated wheelsets are held at, 0 for none
    gains: SpeedControlGains = field(default_factory=SpeedControlGains)
    slip_limits: SlipLimits = field(default_factory=SlipLimits)


@dataclass(frozen=True)
class DrivenUnits:
    """Data of the simulated units of a locomotive that their driver uses."""

    number: int  # of units
    mass: float  # of all [kg]
    axles: int  # of all
    radius: float  # of the wheels [m]
    spin_inertia: float  # of a wheelset with its rotor [kg m^2]
    equipment: TractionEquipment  # of one unit
    coupler_stiffness: float  # between the last unit and the train [N/m]

    def losses(self, speed: float) -> float:
        """Torque that bearings, gear and the air take from each axle at a speed [m/s], against motion [N m].

        The locomotive's running resistance shared by its axles, as if the air pulled at the treads too.
        """
        return locomotive_resistance(speed) * self.mass * 1e-3 * self.radius / self.axles


class Driver:
    """Controls torques and train from sample to sample; a `control.Controller`.

    All units have the same demand of effort. Those behind the simulated ones are part of the train: a mass
    with an effort. The train moves by the symplectic Euler method with the coupler force of the last sample.

    Parameters
    ----------
    driven : the simulated units
    train : the train behind them
    orders : of the driver
    speed : at the start [m/s]
    head : arc length of the train's front coupler at the start [m]
    grade : sine of the slope under the units at the start [-]

    Attributes
    ----------
    demand : effort demanded of each unit, before slip control [N]
    """

    def __init__(
        self,
        driven: DrivenUnits,
        train: TrailingTrain,
        orders: DriverOrders,
        speed: float,
        head: float,
        grade: float,
    ) -> None:
        self._driven = driven
        self._train = train
        self._orders = orders
        self._units = driven.number + train.locomotives
        own = driven.mass * 1e-3 * locomotive_resistance(speed) + driven.mass * GRAVITY * grade
        whole = own + train.resisting_force(head, speed)
        least, most = self._bounds(speed)
        self.demand = min(max(whole / self._units, least), most)
        #: force of the train on the units at the start, which leaves them without acceleration [N]
        self.coupler_force = own - driven.number * self.demand
        self._place = head + self.coupler_force / driven.coupler_stiffness
        self._speed = speed
        mass = driven.mass + train.mass
        self._control = SpeedControl(orders.set_speed, mass, self._units * self.demand, orders.gains)
        self._slip_control = SlipControl(driven.axles, orders.slip_limits)
        self._over_slip = None
        if orders.over_slip > 0.0:
            torques = np.full(driven.axles, self._per_axle(self.demand))
            self._over_slip = OverSlip(orders.over_slip, driven.radius, driven.spin_inertia, torques)

    @property
    def train_place(self) -> float:
        """Arc length of the train's coupler head, coupler unloaded [m]."""
        return self._place

    def _bounds(self, speed: float) -> tuple[float, float]:
        """Least and largest effort of one unit at a speed [N]."""
        equipment = self._driven.equipment
        brake = min(equipment.largest_brake(speed), self._orders.braking_limit / self._units)
        return -brake, equipment.largest_effort(speed)

    def _per_axle(self, effort: float) -> float:
        """Torque of each axle for an effort of one unit [N m]."""
        return effort * self._driven.number * self._driven.radius / self._driven.axles

    def act(self, measured: Measurement, actuators: Actuators, interval: float) -> None:
        """Torques and train for the next interval [s]."""
        orders, units = self._orders, self._units
        least, most = self._bounds(measured.speed)
        whole = self._control.step(
            measured.speed, units * least, units * most, units * orders.gains.rate, interval
        )
        self.demand = whole / units
        per_axle = self._per_axle(self.demand)
        slip_measured = measured.wheel_speeds, measured.speeds
        if self._over_slip is not None:
            torques = self._over_slip.step(*slip_measured, self._per_axle(most), interval)
        elif orders.slip_control:
            torques = per_axle * self._slip_control.step(*slip_measured, self.demand, interval)
        else:
            torques = np.full(self._driven.axles, per_axle)
        actuators.torques[:] = torques - self._driven.losses(measured.speed)
        self._move_train(measured, interval)
        actuators.train_place = self._place
        actuators.train_speed = self._speed
        self._place += self._speed * interval

    def _move_train(self, measured: Measurement, interval: float) -> None:
        """M a = force of the coupler + effort of the other units - resistance - weight along the slope."""
        train = self._train
        if train.mass == 0.0:
            return
        force = -measured.coupler_force + train.locomotives * self.demand
        force -= train.resisting_force(self._place, self._speed)
        self._speed += force / train.mass * interval
