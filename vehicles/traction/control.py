"""Measurements and actuators of a controller: the interface of control laws and dynamics.

A controller is called at its own sample time with a `Measurement`, and writes `Actuators`, which act
unchanged until the next sample.
"""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

from hh_exudyn.arrays import FloatArray


class Measurement(NamedTuple):
    """The measured state of the vehicle."""

    time: float  # [s]
    speed: float  # of the vehicle along the track, mean of its wheelsets [m/s]
    speeds: FloatArray  # (wheelsets,) forward speed of each wheelset [m/s]
    wheel_speeds: FloatArray  # (wheelsets,) spin about the axle times the nominal radius [m/s]
    places: FloatArray  # (wheelsets,) arc lengths [m]
    curvatures: FloatArray  # (wheelsets,) of the track there, positive to the left [1/m]
    coupler_force: float  # of the train on the vehicle, forwards [N]


@dataclass
class Actuators:
    """The quantities that controllers set, written in place."""

    torques: FloatArray  # (drives,) of a motor on its wheelset, forwards [N m]
    train_place: float  # arc length of the train's coupler head, coupler unloaded [m]
    train_speed: float  # [m/s]
    yaw: FloatArray  # (wheelsets,) rest angle of the wheelset in its bogie, to the left [rad]
    stiffness: FloatArray  # (wheelsets,) longitudinal stiffness of the axle boxes over that of the drawing


class Controller(Protocol):
    """Called at every sample."""

    def act(self, measured: Measurement, actuators: Actuators, interval: float) -> None:
        """Write the actuators for the next interval [s]."""
