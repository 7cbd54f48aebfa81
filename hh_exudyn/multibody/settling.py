"""Settling in time: a vehicle rolls at a fixed position of the track until its motion is damped out.

A root search can alternate between the branches of a force that rises and falls steeply (contact that moves
from the tread to the flange root); motion in time ends in a stable state. The bodies move by their masses
under all forces of the kernel and an additional one, -DAMPING_RATE M (v - v0), against every velocity but the
common one; the wheels roll. The force of the train (or of the drives) that maintains the speed follows the
sum of the forces along the track.
"""

import math
import time

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.multibody.linear.inertia import masses
from hh_exudyn.multibody.model import first_track
from hh_exudyn.multibody.rolling import RollingVehicle

DAMPING_RATE = 12.0  # 1/s, of the added damping: half of critical for bounce at 2 Hz
# s, of a step; the shortest is stable, and is used at a jump of the force, where none meets the tolerance
_SHORTEST_STEP, _FIRST_STEP, _LONGEST_STEP = 5e-5, 2e-4, 5e-3
FARTHEST = 0.5  # m or rad from the drawing: beyond it a body is not going to come to rest
_RELATIVE, _PLACE, _RATE = 1e-4, 1e-8, 1e-6  # tolerances of a step: relative, m and rad, m/s and rad/s


class Settling:
    """The damped motion of a vehicle from its present state on.

    Parameters
    ----------
    rolling : the vehicle; its state is moved

    Attributes
    ----------
    time : since the start of the motion [s]
    """

    def __init__(self, rolling: RollingVehicle) -> None:
        self._rolling = rolling
        model = rolling.model
        size = rolling.q.size
        self._mass = masses(model)
        self._moves = np.ones(size)  # 0 for the coordinates of `rates`, which are constant
        self._moves[rolling.rates] = 0.0
        self._damping = DAMPING_RATE * self._moves
        self._damping[first_track(model) :] = 0.0
        self._drawn = rolling.q.copy()
        self.time = 0.0
        self._tolerance = np.repeat([_PLACE, _RATE], size)
        self._step = _FIRST_STEP
        self._y = np.concatenate([np.zeros(size), rolling.v - rolling.still])

    def run(self, end: float, deadline: float) -> bool:
        """Continue to a time of the motion and set the vehicle to the state there, with velocities at rest.

        Parameters
        ----------
        end : of the motion [s]
        deadline : `time.thread_time()` at which the motion is aborted [s]

        Returns
        -------
        Whether the end was reached: before the deadline, with no body far from its place.
        """
        while self.time < end and time.thread_time() < deadline:
            with np.errstate(over="ignore", invalid="ignore"):
                y, step = self._stepped()
            if not (np.abs(y[: self._drawn.size]).max() < FARTHEST and np.isfinite(y).all()):
                break
            self._y = y
            self.time += step
            self._rolling.follow(step)
        self._put(self._y)
        self._rolling.settled()
        return self.time >= end

    def _stepped(self) -> tuple[FloatArray, float]:
        """State after the next step, and its length [s]; Bogacki and Shampine's pair of orders 3 and 2.

        Third order, a stable reach of 2.5 on the real axis for three evaluations (Bogacki and Shampine 1989).
        """
        y = self._y
        first = self._rates(y)
        while True:
            h = self._step
            second = self._rates(y + 0.5 * h * first)
            third = self._rates(y + 0.75 * h * second)
            new = y + h * (2.0 / 9.0 * first + 1.0 / 3.0 * second + 4.0 / 9.0 * third)
            fourth = self._rates(new)
            error = h * (-5.0 / 72.0 * first + third / 9.0 + second / 12.0 - fourth / 8.0)
            scale = self._tolerance + _RELATIVE * np.maximum(np.abs(y), np.abs(new))
            size = float(np.sqrt(np.mean((error / scale) ** 2)))
            factor = 0.9 * max(size, 1e-3) ** (-1.0 / 3.0) if math.isfinite(size) else 0.2
            self._step = min(max(h * max(factor, 0.2), _SHORTEST_STEP), _LONGEST_STEP)
            if size <= 1.0 or h <= _SHORTEST_STEP:
                return new, h

    def _put(self, y: FloatArray) -> None:
        size = self._drawn.size
        self._rolling.q[:] = self._drawn + y[:size]
        self._rolling.v[:] = self._rolling.still + y[size:]

    def _rates(self, y: FloatArray) -> FloatArray:
        self._put(y)
        moving = y[self._drawn.size :]
        acceleration = self._rolling.forces() / self._mass - self._damping * moving
        return np.concatenate([self._moves * moving, acceleration])
