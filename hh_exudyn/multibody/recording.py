"""Rows of the three logs, taken from the work space after an evaluation of an accepted state."""

import math

import numpy as np

from hh_exudyn.contact.types import MAX_PATCHES, FloatArray, Patch
from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.kernel import kernel
from hh_exudyn.log.recorder import Recorder
from hh_exudyn.log.schema import CONTACT, ENERGY, MOTION
from hh_exudyn.multibody.model import BODY_COORDINATES, IntArray, Ledger, SystemModel, Workspace
from hh_exudyn.multibody.system import energies
from track.alignment import locate
from vehicles.description import Vehicle

_FIRST_COPIED = int(Patch.Y_WHEEL)  # columns of a contact state that the log takes over in one piece,
_LAST_COPIED = int(Patch.FRICTION)  # up to this one, followed by the speed and the creep forces
_NORMAL_FORCE = int(Patch.NORMAL_FORCE)
_FORCE_X = int(Patch.FORCE_X)
_APPROACH = int(Patch.APPROACH)


class LogWriter:
    """Turns the state of a vehicle into log rows."""

    def __init__(self, vehicle: Vehicle, model: SystemModel, work: Workspace, recorder: Recorder) -> None:
        self._model = model
        self._work = work
        self._recorder = recorder
        self._bogies = np.array([wheelset.bogie for wheelset in vehicle.wheelsets])
        self._contact = np.zeros((len(vehicle.wheelsets) * 2 * MAX_PATCHES, len(CONTACT)))
        self._motion = np.zeros((len(vehicle.bodies), len(MOTION)))
        self._energy = np.zeros((1, len(ENERGY)))
        self._potential_at_start = math.nan

    def write(self, time: float, v: FloatArray) -> None:
        """Append one output time; the work space must hold the evaluation of this state."""
        count = _contact_rows(self._work, self._bogies, time, self._contact)
        self._recorder.append_rows("contact", self._contact[:count])
        _motion_rows(self._model, self._work, v, time, self._motion)
        self._recorder.append_rows("motion", self._motion)
        self._energy_row(time, v)
        self._recorder.append_rows("energy", self._energy)

    def _energy_row(self, time: float, v: FloatArray) -> None:
        work = self._work
        kinetic, potential = energies(self._model, work, v)
        if math.isnan(self._potential_at_start):
            self._potential_at_start = potential
        train = self._model.train.body
        s = locate(
            self._model.alignment, work.position[train, 0], work.position[train, 1], work.arc_length[-1]
        )
        self._energy[0] = (
            time,
            s,
            work.ledger[Ledger.COUPLER_FORCE],
            work.ledger[Ledger.COUPLER_POWER],
            work.ledger[Ledger.CONTACT_POWER],
            work.ledger[Ledger.FRICTION_POWER],
            work.ledger[Ledger.DAMPER_POWER],
            kinetic,
            potential - self._potential_at_start,
        )


@kernel
def _contact_rows(work: Workspace, bogies: IntArray, time: float, rows: FloatArray) -> int:
    """Fill one row of the contact log per patch that carries load; returns their number."""
    count = 0
    for w in range(bogies.size):
        angle_of_attack = math.atan2(-work.frame_axle[w, 0], work.frame_axle[w, 1])
        roll = math.asin(work.frame_axle[w, 2])
        for index in range(2):
            side = LEFT if index == 0 else RIGHT
            for number in range(work.patches.shape[2]):
                patch = work.patches[w, index, number]
                if patch[_NORMAL_FORCE] <= 0.0:
                    continue
                row = rows[count]
                row[0] = time
                row[1] = work.arc_length[w]
                row[2] = 1
                row[3] = bogies[w]
                row[4] = w + 1
                row[5] = side
                row[6] = number
                k = 7
                for column in range(_FIRST_COPIED, _LAST_COPIED + 1):
                    row[k] = patch[column]
                    k += 1
                row[k] = work.frame_velocity[w, 0]
                for column in range(3):
                    row[k + 1 + column] = patch[_FORCE_X + column]
                row[k + 4] = -work.rail_force[w, index, 1]
                row[k + 5] = work.rail_force[w, index, 0] * side
                row[k + 6] = angle_of_attack
                row[k + 7] = work.frame_position[w, 1]
                row[k + 8] = patch[_APPROACH]
                row[k + 9] = roll
                count += 1
    return count


@kernel
def _motion_rows(model: SystemModel, work: Workspace, v: FloatArray, time: float, rows: FloatArray) -> None:
    """Fill one row per body of the motion log."""
    for i in range(model.mass.size):
        row = rows[i]
        row[0] = time
        row[1] = i
        row[2] = locate(model.alignment, work.position[i, 0], work.position[i, 1], work.arc_length[0])
        for axis in range(3):
            row[3 + axis] = work.position[i, axis]
            row[10 + axis] = v[BODY_COORDINATES * i + axis]
            row[13 + axis] = v[BODY_COORDINATES * i + 3 + axis]
        _quaternion(work.rotation[i], row[6:10])


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
