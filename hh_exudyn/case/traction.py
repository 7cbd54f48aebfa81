"""The tables ``[traction]`` and ``[steering]`` of a case file: a locomotive's driver, train and steering.

::

    vehicle = "iore_locomotive"
    speed_km_h = 60

    [traction]
    trailing_wagons = 68
    units = 2
"""

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.case.fields import CaseTable, number
from vehicles.traction.driver import DriverOrders
from vehicles.traction.train import TrailingTrain

WAGON_LENGTH = 10.29  # m, of an ore wagon (Hossein-Nia 2018, Table 1-1)

_Course = Callable[[NDArray[np.float64]], NDArray[np.float64]]


class TractionCase(CaseTable):
    """Orders to the driver, and the train on the coupler. Defaults: the ore train of the thesis.

    `units` locomotives share the effort; the first one is simulated, the others are masses of the train with
    an effort of their own. `set_speed_km_h` is the case's speed where it is not given. `braking_limit_kN`
    is that of the electro-dynamic brakes of all units together (Hossein-Nia 2018, 1.1.2). With
    `over_slip_percent` above 0 the drives control the creepage of each driven wheelset to that value, within
    their limits, instead of the effort. `curve_resistance` of the wagons is "roeckl", "simulated" (that
    of this toolkit's wagon on dry rails, 2.7 times less at R 450 m) or "none":
    `vehicles.traction.curve_resistance`.
    """

    trailing_wagons: int = number("-", 0, 200, 68)
    wagon_mass_t: float = number("t", 15, 130, 120.0)
    units: int = number("-", 1, 4, 2)
    set_speed_km_h: float | None = number("km/h", 5, 130, None)
    braking_limit_kN: float = number("kN", 0, 2000, 500.0)
    slip_control: bool = True
    over_slip_percent: float = number("%", 0, 30, 0.0)
    curve_resistance: Literal["roeckl", "simulated", "none"] = "roeckl"

    @property
    def alone(self) -> bool:
        """Whether the simulated unit runs without a train."""
        return self.units == 1 and self.trailing_wagons == 0

    def orders(self, speed: float) -> DriverOrders:
        """Orders to the driver of a vehicle with that initial speed [m/s]."""
        return DriverOrders(
            set_speed=speed if self.set_speed_km_h is None else self.set_speed_km_h / 3.6,
            braking_limit=1e3 * self.braking_limit_kN,
            slip_control=self.slip_control,
            over_slip=1e-2 * self.over_slip_percent,
        )

    def train(self, mass: float, length: float, grade: _Course, curvature: _Course) -> TrailingTrain:
        """The train behind the first unit, a unit having a mass [kg] and a length [m] over couplers.

        Parameters
        ----------
        mass, length : float
            Of a unit [kg], and over its couplers [m].
        grade, curvature : callable
            Sine of the slope [-] and curvature [1/m] at arc lengths [m].
        """
        return TrailingTrain(
            locomotives=self.units - 1,
            locomotive_mass=mass,
            locomotive_length=length,
            wagons=self.trailing_wagons,
            wagon_mass=1e3 * self.wagon_mass_t,
            wagon_length=WAGON_LENGTH,
            grade=grade,
            curvature=curvature,
            curve_resistance=self.curve_resistance,
        )


class SteeringCase(CaseTable):
    """Active steering: `gain` 1 for radial wheelsets, `softening` the remaining share of stiffness in curves.

    Laws and actuators: `vehicles.traction.steering`.
    """

    gain: float = number("-", -2, 2, 1.0)
    softening: float = number("-", 0.05, 1, 1.0)
