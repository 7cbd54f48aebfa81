"""The tables ``[traction]`` and ``[steering]`` of a case file: a locomotive's driver, train and steering.

::

    vehicle = "iore_locomotive"
    speed_km_h = 60

    [traction]
    trailing_wagons = 68
    units = 2

With ``vehicle = "iore_locomotive_pair"`` both units are simulated.
"""

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.case.fields import CaseTable, number
from vehicles.description import Vehicle
from vehicles.traction.driver import DriverOrders
from vehicles.traction.train import TrailingTrain

WAGON_LENGTH = 10.29  # m, of an ore wagon (Hossein-Nia 2018, Table 1-1)

_Course = Callable[[NDArray[np.float64]], NDArray[np.float64]]


class TractionCase(CaseTable):
    """Orders to the driver, and the train on the coupler. Defaults: the ore train of the thesis.

    `units` locomotives share the effort; those of the vehicle are simulated, the others are masses of the
    train with an effort of their own. `set_speed_km_h` is the case's speed where it is not given.
    `braking_limit_kN` is that of the electro-dynamic brakes of all units together (Hossein-Nia 2018, 1.1.2).
    With `over_slip_percent` above 0 the drives control the creepage of each driven wheelset to that value,
    within their limits, instead of the effort. `curve_resistance` of the wagons is "roeckl", "simulated"
    (that of this toolkit's wagon on dry rails, 2.7 times less at R 450 m) or "none":
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

    def alone(self, vehicle: Vehicle) -> bool:
        """Whether the simulated units run without a train."""
        return self.units == len(vehicle.units) and self.trailing_wagons == 0

    def require_units(self, vehicle: Vehicle) -> None:
        """Raises ValueError for a vehicle of more units than the whole train has."""
        simulated = len(vehicle.units)
        if self.units < simulated:
            raise ValueError(
                f"traction.units = {self.units}: vehicle {vehicle.name} has {simulated} units of its own; "
                f"allowed {simulated}..4"
            )

    def orders(self, speed: float) -> DriverOrders:
        """Orders to the driver of a vehicle with that initial speed [m/s]."""
        return DriverOrders(
            set_speed=speed if self.set_speed_km_h is None else self.set_speed_km_h / 3.6,
            braking_limit=1e3 * self.braking_limit_kN,
            slip_control=self.slip_control,
            over_slip=1e-2 * self.over_slip_percent,
        )

    def train(self, vehicle: Vehicle, grade: _Course, curvature: _Course) -> TrailingTrain:
        """The train behind the simulated units.

        Parameters
        ----------
        vehicle : the simulated units, like those of the train
        grade, curvature : sine of the slope [-] and curvature [1/m] at arc lengths [m]

        Raises ValueError as `require_units`.
        """
        self.require_units(vehicle)
        simulated = len(vehicle.units)
        heads = [point[0] for point in vehicle.coupler.points]
        return TrailingTrain(
            locomotives=self.units - simulated,
            locomotive_mass=vehicle.mass / simulated,
            locomotive_length=(max(heads) - min(heads)) / simulated,
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


def require_drives(vehicle: Vehicle, traction: TractionCase | None, steering: SteeringCase | None) -> None:
    """Raises ValueError for a driver or steering of a vehicle without drives, or too few units."""
    for name, given in (("traction", traction), ("steering", steering)):
        if given is not None and not vehicle.drives:
            raise ValueError(f"{name} given: vehicle {vehicle.name} has no drives")
    if traction is not None:
        traction.require_units(vehicle)
