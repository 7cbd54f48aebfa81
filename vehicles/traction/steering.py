"""Active steering of wheelsets: actuators in the longitudinal primary suspension of every axle box.

Hossein-Nia (2018), chapter 5: "the control goal is to modify the longitudinal primary suspension
characteristics (using actuators) to change the yaw angle of the wheelset". Two laws, alone or together: a
rest angle of each wheelset in its bogie from the curvature, and softer axle boxes in curves.
"""

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.arrays import FloatArray
from vehicles.traction.control import Actuators, Measurement


class Steering:
    """Yaw reference and stiffness from the curvature under each bogie; a `control.Controller`.

    A wheelset x ahead of the middle of its bogie, whose frame lies along the chord, stands radially at the
    angle x/R to the frame. The actuators follow their reference as a first-order lag.

    Parameters
    ----------
    offsets : (wheelsets,) array
        Of the wheelsets ahead of the middle of their bogies [m].
    bogies : (wheelsets,) array of int
        Bogie of each wheelset.
    gain : float
        Share of the radial angle; 1 is radial, 0 passive.
    softening : float
        Share of the longitudinal stiffness left in curves tighter than `FULL_CURVATURE`; 1 leaves it.
    """

    LAG = 0.3  # s, of the actuators
    FULL_CURVATURE = 1.0 / 800.0  # 1/m
    LARGEST_ANGLE = 10e-3  # rad, stroke of the actuators: +-10 mm at 1 m

    def __init__(self, offsets: FloatArray, bogies: NDArray[np.int64], gain: float, softening: float) -> None:
        self._offsets = offsets
        self._members = [bogies == bogie for bogie in np.unique(bogies)]
        self._gain = gain
        self._softening = softening

    def act(self, measured: Measurement, actuators: Actuators, interval: float) -> None:
        """Move the rest angles and the stiffnesses towards their references."""
        follow = interval / (self.LAG + interval)
        for members in self._members:
            curvature = float(measured.curvatures[members].mean())
            yaw = np.clip(
                self._gain * curvature * self._offsets[members], -self.LARGEST_ANGLE, self.LARGEST_ANGLE
            )
            actuators.yaw[members] += follow * (yaw - actuators.yaw[members])
            tight = min(abs(curvature) / self.FULL_CURVATURE, 1.0)
            soft = 1.0 - (1.0 - self._softening) * tight
            actuators.stiffness[members] += follow * (soft - actuators.stiffness[members])
