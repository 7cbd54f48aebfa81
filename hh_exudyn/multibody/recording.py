"""Rows of the logs, from the work space after an evaluation of an accepted state.

Columns are written by name; those that the channel table (`hh_exudyn.log.channels`) copies from the record of
a patch or from the ledger follow from the table.
"""

import math
from collections.abc import Sequence
from enum import IntEnum

import numpy as np

from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.check_rail.table import BackContact
from hh_exudyn.contact.state import Patch
from hh_exudyn.contact.types import MAX_PATCHES
from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.kernel import Bundle, allocating_kernel, kernel, memory, shaped
from hh_exudyn.log.channels import (
    BACK,
    CHECK_RAIL,
    CONTACT,
    COUPLINGS,
    ENERGY,
    LEDGER,
    MOTION,
    PATCH,
    WHEELS,
    Column,
    ContactColumn,
    CouplingColumn,
    EnergyColumn,
    MotionColumn,
    WheelColumn,
)
from hh_exudyn.log.recorder import Recorder
from hh_exudyn.multibody.model import BODY_COORDINATES, Ledger, SystemModel, Workspace
from hh_exudyn.multibody.system import energies
from hh_exudyn.multibody.vectors import rotate_back, triple
from track.course.alignment import inclined_locate
from vehicles.description import Vehicle


def _copies(columns: tuple[Column, ...], source: str, members: type[IntEnum]) -> IntArray:
    """(n, 2) positions of the columns of a source in their log and in their source."""
    pairs = [(k, members[c.name.upper()]) for k, c in enumerate(columns) if c.source == source]
    return np.array(pairs, dtype=np.int64)


# (n, 2) positions of the wheel's columns in the contact log and in the wheels log
_OF_WHEEL = np.array(
    [(k, WheelColumn[c.name]) for k, c in enumerate(CONTACT) if c.name in WheelColumn.__members__],
    dtype=np.int64,
)
_OF_PATCH = _copies(CONTACT, PATCH, Patch)
# (n, 2) positions of the check-rail log's columns in the wheels log and in the record of a flange back
_OF_WHEEL_BACK = np.array(
    [(k, WheelColumn[c.name]) for k, c in enumerate(CHECK_RAIL) if c.source != BACK], dtype=np.int64
)
_OF_BACK = _copies(CHECK_RAIL, BACK, BackContact)
_OF_LEDGER = _copies(ENERGY, LEDGER, Ledger)


class LogWriter:
    """Writer of log rows from the state of a vehicle.

    Parameters
    ----------
    vehicle, model, work : description, its model and the work space that holds the state
    recorder : of the run
    logged : numbers of the couplings in the couplings log
    """

    def __init__(
        self,
        vehicle: Vehicle,
        model: SystemModel,
        work: Workspace,
        recorder: Recorder,
        logged: Sequence[int] = (),
    ) -> None:
        self._bundle = Bundle(model, work)
        self.recorder = recorder
        self._places = np.array(vehicle.wheelset_places, dtype=np.int64)
        self._contact = np.zeros((len(vehicle.wheelsets) * 2 * MAX_PATCHES, len(CONTACT)))
        self._wheels = np.zeros((2 * len(vehicle.wheelsets), len(WHEELS)))
        self._records = work.coupling_record
        self._backs = work.backs.reshape(-1, len(BackContact))
        self._logged = np.array(logged, dtype=np.int64)
        self._couplings = np.zeros((self._logged.size, len(COUPLINGS)))
        self._couplings[:, CouplingColumn.coupling] = self._logged
        self._motion = np.zeros((len(vehicle.bodies), len(MOTION)))
        self._energy = np.zeros((1, len(ENERGY)))
        self.potential_at_start = math.nan  # of the first row, J

    def write(self, time: float, v: FloatArray) -> None:
        """Append one output time; the work space must hold the evaluation of this state."""
        wheels, contact, motion, energy = self._wheels, self._contact, self._motion, self._energy
        count = _rows(self._bundle, self._places, v, time, wheels, contact, motion, energy[0])
        if math.isnan(self.potential_at_start):
            self.potential_at_start = float(self._energy[0, EnergyColumn.potential_energy])
        self._energy[0, EnergyColumn.potential_energy] -= self.potential_at_start
        # the contact log last, also on disk: playback needs the motion at all of its times
        self.recorder.append_rows("motion", self._motion)
        self.recorder.append_rows("energy", self._energy)
        self.recorder.append_rows("wheels", self._wheels)
        if self._logged.size:
            self._couplings[:, CouplingColumn.time] = time
            self._couplings[:, CouplingColumn.force_x :] = self._records[self._logged]
            self.recorder.append_rows("couplings", self._couplings)
        touching = self._backs[:, BackContact.NORMAL_FORCE] > 0.0
        if touching.any():
            rows = np.empty((int(touching.sum()), len(CHECK_RAIL)))
            rows[:, _OF_WHEEL_BACK[:, 0]] = wheels[touching][:, _OF_WHEEL_BACK[:, 1]]
            rows[:, _OF_BACK[:, 0]] = self._backs[touching][:, _OF_BACK[:, 1]]
            self.recorder.append_rows("check_rail", rows)
        self.recorder.append_rows("contact", self._contact[:count])

    def write_sensor(self, time: float, name: str, value: float | FloatArray) -> None:
        """Append the value of one of Exudyn's sensors.

        Parameters
        ----------
        time : of the output [s]
        name : of the sensor
        value : number, or its components
        """
        values = np.atleast_1d(np.asarray(value, dtype=np.float64)).ravel()
        columns = {
            "time": np.full(values.size, time),
            "sensor": np.full(values.size, name),
            "component": np.arange(values.size),
            "value": values,
        }
        self.recorder.append("sensors", columns)


@allocating_kernel
def _rows(
    bundle: Bundle,
    places: IntArray,
    v: FloatArray,
    time: float,
    wheels: FloatArray,
    contact: FloatArray,
    motion: FloatArray,
    energy: FloatArray,
) -> int:
    """Fill the rows of all four logs; returns the number of those of the contact log."""
    model, work = bundle.model, bundle.work
    _motion_rows(model, work, v, time, motion)
    _energy_row(model, work, v, time, energy)
    _wheel_rows(work, places, time, wheels)
    return _contact_rows(work, wheels, contact)


@kernel
def _energy_row(model: SystemModel, work: Workspace, v: FloatArray, time: float, row: FloatArray) -> None:
    """Fill the row of the energy log, its potential energy from the height of the global frame."""
    kinetic, potential = energies(model, work, v)
    place = work.position[model.train.bodies[0]]
    row[EnergyColumn.time] = time
    row[EnergyColumn.s] = inclined_locate(model.alignment, place[0], place[1], place[2], work.arc_length[-1])
    for k in range(_OF_LEDGER.shape[0]):
        row[_OF_LEDGER[k, 0]] = work.ledger[_OF_LEDGER[k, 1]]
    row[EnergyColumn.kinetic_energy] = kinetic
    row[EnergyColumn.potential_energy] = potential


@kernel
def _wheel_rows(work: Workspace, places: IntArray, time: float, rows: FloatArray) -> None:
    """Fill one row of the wheels log per wheel, 1L, 1R, 2L, ..."""
    for w in range(places.shape[0]):
        axle = triple(work.frame_axle[w])
        yaw = math.atan2(-axle[0], axle[1])
        for index in range(2):
            side = LEFT if index == 0 else RIGHT
            against = rotate_back(work.rail_rotation[w, index], axle)
            row = rows[2 * w + index]
            row[WheelColumn.time] = time
            row[WheelColumn.s] = work.arc_length[w]
            row[WheelColumn.vehicle] = places[w, 0]
            row[WheelColumn.bogie] = places[w, 1]
            row[WheelColumn.wheelset] = places[w, 2]
            row[WheelColumn.side] = side
            row[WheelColumn.speed] = work.frame_velocity[w, 0]
            row[WheelColumn.Q] = -work.rail_force[w, index, 1]
            row[WheelColumn.Y] = work.rail_force[w, index, 0] * side
            row[WheelColumn.angle_of_attack] = math.atan2(-against[0], against[1])
            row[WheelColumn.y_wheelset] = work.frame_position[w, 1]
            row[WheelColumn.roll] = math.asin(against[2])
            row[WheelColumn.yaw] = yaw


@kernel
def _contact_rows(work: Workspace, wheels: FloatArray, rows: FloatArray) -> int:
    """Fill one row of the contact log per patch that carries load; returns their number."""
    count = 0
    for wheel in range(wheels.shape[0]):
        for number in range(work.patches.shape[2]):
            patch = work.patches[wheel // 2, wheel % 2, number]
            if patch[Patch.NORMAL_FORCE] <= 0.0:
                continue
            row = rows[count]
            row[ContactColumn.patch] = number
            for k in range(_OF_WHEEL.shape[0]):
                row[_OF_WHEEL[k, 0]] = wheels[wheel, _OF_WHEEL[k, 1]]
            for k in range(_OF_PATCH.shape[0]):
                row[_OF_PATCH[k, 0]] = patch[_OF_PATCH[k, 1]]
            count += 1
    return count


@kernel
def _motion_rows(model: SystemModel, work: Workspace, v: FloatArray, time: float, rows: FloatArray) -> None:
    """Fill one row per body of the motion log."""
    quaternion = shaped(memory(4), (4,))
    for i in range(model.mass.size):
        row = rows[i]
        place = work.position[i]
        velocity = v[BODY_COORDINATES * i : BODY_COORDINATES * (i + 1)]
        row[MotionColumn.time] = time
        row[MotionColumn.body] = i
        row[MotionColumn.s] = inclined_locate(
            model.alignment, place[0], place[1], place[2], work.arc_length[0]
        )
        row[MotionColumn.x], row[MotionColumn.y], row[MotionColumn.z] = place[0], place[1], place[2]
        _quaternion(work.rotation[i], quaternion)
        row[MotionColumn.qw] = quaternion[0]
        row[MotionColumn.qx] = quaternion[1]
        row[MotionColumn.qy] = quaternion[2]
        row[MotionColumn.qz] = quaternion[3]
        row[MotionColumn.vx], row[MotionColumn.vy], row[MotionColumn.vz] = (
            velocity[0],
            velocity[1],
            velocity[2],
        )
        row[MotionColumn.wx], row[MotionColumn.wy], row[MotionColumn.wz] = (
            velocity[3],
            velocity[4],
            velocity[5],
        )


@kernel
def _quaternion(rotation: FloatArray, result: FloatArray) -> None:
    """Unit quaternion (w, x, y, z) of a rotation matrix, from its largest component (Shepperd 1978)."""
    trace = rotation[0, 0] + rotation[1, 1] + rotation[2, 2]
    best = 0
    largest = trace
    for axis in range(3):
        if rotation[axis, axis] > largest:
            largest = rotation[axis, axis]
            best = axis + 1
    if best == 0:
        root = math.sqrt(1.0 + trace)
        result[0] = 0.5 * root
        for axis in range(3):
            j = (axis + 1) % 3
            k = (axis + 2) % 3
            result[1 + axis] = 0.5 * (rotation[k, j] - rotation[j, k]) / root
    else:
        i = best - 1
        j = (i + 1) % 3
        k = (i + 2) % 3
        root = math.sqrt(1.0 + rotation[i, i] - rotation[j, j] - rotation[k, k])
        result[0] = 0.5 * (rotation[k, j] - rotation[j, k]) / root
        result[1 + i] = 0.5 * root
        result[1 + j] = 0.5 * (rotation[j, i] + rotation[i, j]) / root
        result[1 + k] = 0.5 * (rotation[k, i] + rotation[i, k]) / root
