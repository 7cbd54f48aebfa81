"""Rows of the three logs, taken from the work space after an evaluation of an accepted state."""

import math

import numpy as np

from hh_exudyn.contact.types import MAX_PATCHES, FloatArray, Patch
from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.kernel import kernel
from hh_exudyn.log.recorder import Recorder
from hh_exudyn.log.schema import CONTACT, ENERGY, MOTION
from hh_exudyn.multibody.model import BODY_COORDINATES, Ledger, SystemModel, Workspace
from hh_exudyn.multibody.system import energies
from track.alignment import locate
from vehicles.description import Vehicle

_SIDES = (LEFT, RIGHT)

# columns of the contact log that are copied from a contact state
_COPIED = (
    Patch.Y_WHEEL,
    Patch.Y_RAIL,
    Patch.X_SHIFT,
    Patch.CONTACT_ANGLE,
    Patch.ROLLING_RADIUS,
    Patch.NORMAL_FORCE,
    Patch.A,
    Patch.B,
    Patch.P_MAX,
    Patch.NU_X,
    Patch.NU_Y,
    Patch.PHI,
    Patch.FRICTION,
)
_CREEP_FORCES = (Patch.FORCE_X, Patch.FORCE_Y, Patch.MOMENT_Z)


class LogWriter:
    """Turns the state of a vehicle into log rows."""

    def __init__(self, vehicle: Vehicle, model: SystemModel, work: Workspace, recorder: Recorder) -> None:
        self._model = model
        self._work = work
        self._recorder = recorder
        self._bogies = [wheelset.bogie for wheelset in vehicle.wheelsets]
        self._contact = np.zeros((len(vehicle.wheelsets) * 2 * MAX_PATCHES, len(CONTACT)))
        self._motion = np.zeros((len(vehicle.bodies), len(MOTION)))
        self._energy = np.zeros((1, len(ENERGY)))
        self._potential_at_start = math.nan

    def write(self, time: float, v: FloatArray) -> None:
        """Append one output time; the work space must hold the evaluation of this state."""
        self._recorder.append_rows("contact", self._contact_rows(time))
        _motion_rows(self._model, self._work, v, time, self._motion)
        self._recorder.append_rows("motion", self._motion)
        self._energy_row(time, v)
        self._recorder.append_rows("energy", self._energy)

    def _contact_rows(self, time: float) -> FloatArray:
        work = self._work
        rows = self._contact
        count = 0
        for w, bogie in enumerate(self._bogies):
            axle = work.frame_axle[w]
            angle_of_attack = math.atan2(-axle[0], axle[1])
            for index, side in enumerate(_SIDES):
                q = -work.rail_force[w, index, 1]
                y = work.rail_force[w, index, 0] * side
                for number, patch in enumerate(work.patches[w, index]):
                    if patch[Patch.NORMAL_FORCE] <= 0.0:
                        continue
                    row = rows[count]
                    row[:7] = (time, work.arc_length[w], 1, bogie, w + 1, side, number)
                    row[7:20] = patch[list(_COPIED)]
                    row[20] = work.frame_velocity[w, 0]
                    row[21:24] = patch[list(_CREEP_FORCES)]
                    row[24:] = (q, y, angle_of_attack, work.frame_position[w, 1])
                    count += 1
        return rows[:count]

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
