"""Controllers in the loop: their measurements, the inputs that they set, and the log of both.

Called at accepted states, once per sample; between samples the actuators are constant, and the train moves at
constant speed. The kernels read `Inputs` only.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.case import Case
from hh_exudyn.contact.state import Patch
from hh_exudyn.kernel import kernel
from hh_exudyn.log.channels import CONTROL, ControlColumn
from hh_exudyn.log.recorder import Recorder
from hh_exudyn.multibody.model import Ledger, SystemModel, Workspace
from track.course.alignment import inclined_frame
from track.course.types import AlignmentTable
from vehicles.couplings import AxleBoxPad
from vehicles.description import Vehicle
from vehicles.start import start_front
from vehicles.traction.control import Actuators, Controller, Measurement
from vehicles.traction.driver import DrivenUnits, Driver
from vehicles.traction.memory import memory_of, put_back
from vehicles.traction.steering import Steering

AlongTrack = Callable[[FloatArray], FloatArray]

SAMPLE = 10e-3  # s between two calls of the controllers


class VehicleControl:
    """The controllers of a driven vehicle, between its work space and its log.

    Attributes
    ----------
    steps_per_sample : time steps between two calls of the controllers
    front : arc length of the leading coupler head at the start [m]
    """

    def __init__(
        self,
        case: Case,
        vehicle: Vehicle,
        model: SystemModel,
        work: Workspace,
        driver: Driver,
        controllers: Sequence[Controller],
    ) -> None:
        self._model = model
        self._work = work
        self._driver = driver
        self._controllers = controllers
        self._radius = np.array([wheelset.radius for wheelset in vehicle.wheelsets])
        self._places = np.array(vehicle.wheelset_places)
        self._rows = np.zeros((self._radius.size, len(CONTROL)))
        self.steps_per_sample = max(1, round(SAMPLE / (case.integration.step_ms * 1e-3)))
        self._interval = self.steps_per_sample * case.integration.step_ms * 1e-3
        self._actuators = Actuators(
            torques=work.inputs.drive_torque,
            train_place=0.0,
            train_speed=case.speed,
            yaw=np.zeros(self._radius.size),
            stiffness=np.ones(self._radius.size),
        )
        self.front = start_front(vehicle, case.start_m)
        self._origin = driver.train_place
        self._boxes = _axle_boxes(vehicle)

    def act(self, time: float, recorder: Recorder | None) -> None:
        """Log the state just evaluated, call every controller on it, and set the inputs.

        Parameters
        ----------
        time : of the state [s]
        recorder : of the control log, None without one
        """
        measured = self._measure(time)
        if recorder is not None:
            self._log(measured)
            recorder.append_rows("control", self._rows)
        for controller in self._controllers:
            controller.act(measured, self._actuators, self._interval)
        self._move(time)

    def memory(self) -> dict[str, FloatArray]:
        """State of actuators and controllers, by name."""
        return {
            f"{part}/{name}": array
            for part, owner in self._owners().items()
            for name, array in memory_of(owner).items()
        }

    def put_back(self, memory: Mapping[str, FloatArray]) -> None:
        """Set the state of actuators and controllers to one from `memory`.

        Parameters
        ----------
        memory : arrays by name
        """
        for part, owner in self._owners().items():
            start = f"{part}/"
            put_back(
                owner,
                {name.removeprefix(start): a for name, a in memory.items() if name.startswith(start)},
            )

    def _owners(self) -> dict[str, Any]:
        controllers = {str(number): owner for number, owner in enumerate(self._controllers)}
        return {"actuators": self._actuators, **controllers}

    def _measure(self, time: float) -> Measurement:
        work, model = self._work, self._model
        count = self._radius.size
        spins = (work.frame_angular_velocity * work.frame_axle).sum(axis=1)
        places = work.arc_length[:count].copy()
        speeds = work.frame_velocity[:, 0].copy()
        return Measurement(
            time=time,
            speed=float(speeds.mean()),
            speeds=speeds,
            wheel_speeds=spins * self._radius,
            places=places,
            curvatures=_curvatures(model.alignment, places, np.empty(count)),
            coupler_force=float(work.ledger[Ledger.COUPLER_FORCE]),
        )

    def _move(self, time: float) -> None:
        inputs, actuators = self._work.inputs, self._actuators
        speed = actuators.train_speed
        inputs.train_course[0] = actuators.train_place - self._origin - speed * time
        inputs.train_course[1] = speed
        for coupling, wheelset, lateral in self._boxes:
            inputs.coupling_shift[coupling] = -actuators.yaw[wheelset] * lateral
            inputs.coupling_stiffness[coupling] = actuators.stiffness[wheelset]

    def _log(self, measured: Measurement) -> None:
        work, rows = self._work, self._rows
        patches = work.patches
        normal = patches[..., Patch.NORMAL_FORCE]
        creep = np.hypot(patches[..., Patch.FORCE_X], patches[..., Patch.FORCE_Y]) * (normal > 0.0)
        bound = patches[..., Patch.FRICTION] * np.maximum(normal, 0.0)
        vertical = np.maximum(-work.rail_force[:, :, 1].sum(axis=1), 1.0)
        columns = {
            "time": measured.time,
            "s": measured.places,
            "vehicle": self._places[:, 0],
            "wheelset": self._places[:, 2],
            "speed": measured.speeds,
            "wheel_speed": measured.wheel_speeds,
            "torque": work.inputs.drive_torque,
            "adhesion": work.wrench[:, 0] / vertical,
            "utilisation": creep.sum(axis=(1, 2)) / np.maximum(bound.sum(axis=(1, 2)), 1.0),
            "demand": self._driver.demand,
            "coupler_force": measured.coupler_force,
            "train_speed": self._actuators.train_speed,
            "yaw_rest": self._actuators.yaw,
            "stiffness": self._actuators.stiffness,
        }
        for name, column in columns.items():
            rows[:, ControlColumn[name]] = column


@kernel
def _curvatures(table: AlignmentTable, places: FloatArray, curvatures: FloatArray) -> FloatArray:
    """Curvatures of the track at arc lengths, in one call from Python."""
    for i in range(places.size):
        curvatures[i] = inclined_frame(table, places[i])[6]
    return curvatures


def vehicle_control(
    case: Case, vehicle: Vehicle, model: SystemModel, work: Workspace
) -> VehicleControl | None:
    """The controllers of a vehicle with drives; None for any other.

    Sets the force of the train at the start (`Inputs.train_start`), which the equilibrium does not change.

    Parameters
    ----------
    case : speed, traction and steering are read
    vehicle, model : description, and its model on the track of the case
    work : its inputs are set, here and by the controllers
    """
    if vehicle.traction is None:
        return None
    traction = case.traction_or_default
    train = traction.train(vehicle, *_along(model.alignment))
    driven = DrivenUnits(
        number=len(vehicle.units),
        mass=vehicle.mass,
        axles=len(vehicle.wheelsets),
        radius=vehicle.wheelsets[0].radius,
        spin_inertia=vehicle.body(vehicle.wheelsets[0].body).inertia[1],
        equipment=vehicle.traction,
        coupler_stiffness=vehicle.coupler.stiffness,
    )
    head = float(work.inputs.train_start[0])
    grade = math.sin(-inclined_frame(model.alignment, model.start)[4])
    driver = Driver(driven, train, traction.orders(case.speed), case.speed, head, grade)
    work.inputs.train_start[0] = driver.train_place
    controllers: list[Controller] = [driver]
    if case.steering is not None:
        own = [(wheelset.unit, wheelset.bogie) for wheelset in vehicle.wheelsets]
        bogies = np.array([own.index(bogie) for bogie in own])  # a number for each, through all units
        places = np.array([vehicle.body(wheelset.body).position[0] for wheelset in vehicle.wheelsets])
        middles = np.array([places[bogies == bogie].mean() for bogie in bogies])
        steering = case.steering
        controllers.append(Steering(places - middles, bogies, steering.gain, steering.softening))
    return VehicleControl(case, vehicle, model, work, driver, controllers)


def _along(table: AlignmentTable) -> tuple[AlongTrack, AlongTrack]:
    """Sine of the slope and curvature over arc length; beyond the ends as at the ends."""
    s, slope, curvature = table.s, table.gradient / np.hypot(1.0, table.gradient), table.curvature

    def grade(places: FloatArray) -> FloatArray:
        return np.interp(places, s, slope)

    def curving(places: FloatArray) -> FloatArray:
        return np.interp(places, s, curvature)

    return grade, curving


def _axle_boxes(vehicle: Vehicle) -> list[tuple[int, int, float]]:
    """Coupling, wheelset and lateral position [m] of every axle box between wheelset and bogie frame."""
    numbers = {wheelset.body: w for w, wheelset in enumerate(vehicle.wheelsets)}
    kinds = {body.name: body.kind for body in vehicle.bodies}
    return [
        (i, numbers[coupling.body_b], coupling.point[1])
        for i, coupling in enumerate(vehicle.couplings)
        if isinstance(coupling, AxleBoxPad)
        and coupling.body_b in numbers
        and kinds[coupling.body_a] == "bogie_frame"
    ]
