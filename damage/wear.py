"""Wear by sliding: Archard's law with Jendel's map, and the wear number.

Archard (1953) per strip of the patch, as a depth on the wheel per revolution (Hossein-Nia 2018, 3.27):

    dz(y) = sum over x of (k/H) p |s| dx

with the local pressure p, the local slip over speed s (elastic part included: Enblom), the hardness H and
the coefficient k, which depends on sliding velocity and pressure (T. Jendel, Prediction of wheel profile
wear, Wear 253, 2002).
"""

import math
from dataclasses import dataclass, fields, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hh_exudyn.contact.types import FloatArray
from hh_exudyn.kernel import kernel

REGIMES = ("mild, slow", "severe", "mild, fast", "seizure")
"""Regions of Jendel's map, in the order of the regime columns of `damage.wheel_surface.WheelSurface`."""

MAP_REGIMES = len(REGIMES)


class MapValues(NamedTuple):
    """Jendel's map as the kernels take it; the attributes of `JendelMap` say what is what."""

    mild_slow: float
    severe: float
    mild_fast: float
    seizure: float
    severe_from: float
    severe_to: float
    seizure_pressure: float  # [Pa]
    hardness: float


@dataclass(frozen=True)
class JendelMap:
    """Wear coefficients over sliding velocity and pressure, dry steel on steel.

    All values are from memory of Jendel (2002) [M], not confirmed against the paper. The paper gives ranges;
    the middle of each is taken here.

    Attributes
    ----------
    mild_slow
        Coefficient below `severe_from` [-]; published range 1e-4 to 10e-4 [M].
    severe
        Coefficient from `severe_from` to `severe_to` [-]; published range 30e-4 to 40e-4 [M].
    mild_fast
        Coefficient above `severe_to` [-]; published range 1e-4 to 10e-4 [M].
    seizure
        Coefficient above the seizure pressure [-]; published range 300e-4 to 400e-4 [M].
    severe_from, severe_to
        Sliding velocities that bound the severe region [m/s] [M].
    seizure_ratio
        Seizure pressure over hardness [-] [M].
    hardness
        Hardness H of the softer body [Pa]; about 2.6e9 to 2.7e9 Pa (270 HB) [M].

    Raises
    ------
    ValueError
        A value is not finite or not above zero, or the velocities are in the wrong order.
    """

    mild_slow: float = 5.5e-4
    severe: float = 35e-4
    mild_fast: float = 5.5e-4
    seizure: float = 350e-4
    severe_from: float = 0.2
    severe_to: float = 0.7
    seizure_ratio: float = 0.8
    hardness: float = 2.65e9

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{field.name} = {value} of the wear map must be finite and > 0")
        if self.severe_from >= self.severe_to:
            raise ValueError(
                f"severe_from = {self.severe_from} m/s must lie below severe_to = {self.severe_to} m/s"
            )

    def divided(self, divisor: float) -> "JendelMap":
        """The map with all coefficients divided, for a lubricated contact.

        Natural lubrication divides by about 6 (Jendel; Hossein-Nia 2018, p. 70), grease by about 100 (Zhu;
        ibid.).
        """
        if not (math.isfinite(divisor) and divisor > 0.0):
            raise ValueError(f"divisor = {divisor} [-] must be finite and > 0")
        return replace(
            self,
            mild_slow=self.mild_slow / divisor,
            severe=self.severe / divisor,
            mild_fast=self.mild_fast / divisor,
            seizure=self.seizure / divisor,
        )

    @property
    def values(self) -> MapValues:
        """The map for the kernels."""
        return MapValues(
            self.mild_slow,
            self.severe,
            self.mild_fast,
            self.seizure,
            self.severe_from,
            self.severe_to,
            self.seizure_ratio * self.hardness,
            self.hardness,
        )


@kernel
def wear_regime(pressure: float, sliding_velocity: float, wear_map: MapValues) -> int:
    """Region of the map: index into `REGIMES`. Pressure [Pa], sliding velocity [m/s]."""
    if pressure > wear_map.seizure_pressure:
        return 3
    if sliding_velocity < wear_map.severe_from:
        return 0
    if sliding_velocity <= wear_map.severe_to:
        return 1
    return 2


@kernel
def wear_coefficient(regime: int, wear_map: MapValues) -> float:
    """Coefficient k [-] of a region of the map."""
    if regime == 3:
        return wear_map.seizure
    if regime == 1:
        return wear_map.severe
    if regime == 2:
        return wear_map.mild_fast
    return wear_map.mild_slow


@kernel
def strip_depths(
    pressure: FloatArray,
    slip_x: FloatArray,
    slip_y: FloatArray,
    cell_length: float,
    speed: float,
    wear_map: MapValues,
    depth: FloatArray,
) -> None:
    """Wear depth of one strip of a patch per revolution of the wheel, by region of the map.

    Parameters
    ----------
    pressure
        (nx,) pressure [Pa].
    slip_x, slip_y
        (nx,) local slip over speed [-].
    cell_length
        Length of a cell in rolling direction [m].
    speed
        Forward speed [m/s].
    wear_map
        Jendel's map.
    depth
        (4,) result: the depth that each region of the map took [m].
    """
    depth[:] = 0.0
    for cell in range(pressure.size):
        slip = math.sqrt(slip_x[cell] * slip_x[cell] + slip_y[cell] * slip_y[cell])
        if slip > 0.0:
            regime = wear_regime(pressure[cell], slip * speed, wear_map)
            coefficient = wear_coefficient(regime, wear_map)
            depth[regime] += coefficient / wear_map.hardness * pressure[cell] * slip * cell_length  # (3.27)


def wear_number(
    force_x: ArrayLike,
    force_y: ArrayLike,
    moment_z: ArrayLike,
    nu_x: ArrayLike,
    nu_y: ArrayLike,
    phi: ArrayLike,
) -> NDArray[np.float64]:
    """Energy lost in the creepage per distance rolled [N = J/m], positive for dissipation.

    Hossein-Nia (2018), equation 3.29, with forces on the wheel and creepages of the wheel: hence the minus.

    Parameters
    ----------
    force_x, force_y
        Creep forces on the wheel [N].
    moment_z
        Spin moment on the wheel [N m].
    nu_x, nu_y
        Creepages [-].
    phi
        Spin creepage [1/m].
    """
    terms = [np.asarray(value, dtype=np.float64) for value in (force_x, nu_x, force_y, nu_y, moment_z, phi)]
    loss: NDArray[np.float64] = -(terms[0] * terms[1] + terms[2] * terms[3] + terms[4] * terms[5])  # (3.29)
    return loss
