"""The train on the coupler behind a locomotive: running resistance, grades, curves, and inertia.

The train is one mass on a line: its wagons run at one speed, but each stands on its own grade and curve.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.conventions import GRAVITY
from vehicles.traction.curve_resistance import curve_resistance

LOADED_FROM = 6.0  # t per axle, above it the resistance of a loaded wagon holds
_KGF_PER_TONNE = GRAVITY  # N per tonne for one kgf/t


def wagon_resistance(speed: float, axle_load: float) -> float:
    """Running resistance of four-axle wagons on level straight track, over their mass [N/t].

    The PTR formula (rules for train traction calculations of the Russian railways, roller bearings, jointed
    rail), as coded in maisvendoo/train, MainResForces: w = 0.7 + (3 + 0.1 V + 0.0025 V^2)/q [kgf/t] above
    6 t per axle, else w = 1.0 + 0.044 V + 0.00024 V^2, V in km/h, q in t.

    Parameters
    ----------
    speed : float
        [m/s]; a train that stands has the resistance of the limit towards standstill.
    axle_load : float
        [t]
    """
    v = 3.6 * abs(speed)
    if axle_load > LOADED_FROM:
        return (0.7 + (3.0 + 0.1 * v + 0.0025 * v**2) / axle_load) * _KGF_PER_TONNE
    return (1.0 + 0.044 * v + 0.00024 * v**2) * _KGF_PER_TONNE


def locomotive_resistance(speed: float) -> float:
    """Running resistance of a locomotive under power over its mass [N/t], V in km/h.

    PTR: 1.9 + 0.008 V + 0.00025 V^2 [kgf/t].
    """
    v = 3.6 * abs(speed)
    return (1.9 + 0.008 * v + 0.00025 * v**2) * _KGF_PER_TONNE


@dataclass(frozen=True)
class TrailingTrain:
    """Further locomotives and wagons behind the vehicle that is simulated.

    `grade` and `curvature` give the sine of the slope and the curvature [1/m] at arc lengths [m]. The
    locomotives' curve resistance is Roeckl's whatever the wagons have, or none where the wagons have none.
    """

    locomotives: int  # behind the simulated ones
    locomotive_mass: float  # [kg] each
    locomotive_length: float  # [m]
    wagons: int
    wagon_mass: float  # [kg] each
    wagon_length: float  # [m]
    grade: Callable[[FloatArray], FloatArray]
    curvature: Callable[[FloatArray], FloatArray]
    curve_resistance: str = "roeckl"  # of the wagons, one of `curve_resistance.CURVE_RESISTANCES`

    @property
    def mass(self) -> float:
        """Mass of the train [kg]."""
        return self.locomotives * self.locomotive_mass + self.wagons * self.wagon_mass

    @property
    def length(self) -> float:
        """Length of the train [m]."""
        return self.locomotives * self.locomotive_length + self.wagons * self.wagon_length

    def places(self, head: float) -> FloatArray:
        """Arc lengths of the vehicles' middles [m] when the front coupler of the train is at `head` [m]."""
        rears, halves = self._lengths
        return np.asarray(head - rears + halves)

    @cached_property
    def _lengths(self) -> tuple[FloatArray, FloatArray]:
        """Of the train up to every vehicle's rear, and half of every vehicle [m]."""
        lengths = np.repeat(
            [self.locomotive_length, self.wagon_length], [self.locomotives, self.wagons]
        ).astype(float)
        return np.cumsum(lengths), 0.5 * lengths

    @cached_property
    def _weights(self) -> FloatArray:
        """Of the vehicles [N]."""
        masses = np.repeat([self.locomotive_mass, self.wagon_mass], [self.locomotives, self.wagons])
        return np.asarray(masses * GRAVITY)

    def resisting_force(self, head: float, speed: float) -> float:
        """Resistance of rolling and of curves, and the downhill force: against forward motion [N].

        Parameters
        ----------
        head : arc length of the train's front coupler [m]
        speed : of the train [m/s]
        """
        places = self.places(head)
        axle_load = self.wagon_mass / 4e3
        bent = self.curvature(places)
        curving = curve_resistance(self.curve_resistance, bent, axle_load)
        if self.curve_resistance == "simulated":
            curving[: self.locomotives] = curve_resistance("roeckl", bent[: self.locomotives], axle_load)
        rolling = self.locomotives * self.locomotive_mass * locomotive_resistance(speed)
        rolling += self.wagons * self.wagon_mass * wagon_resistance(speed, axle_load)
        curves = self._weights * curving
        slope = self._weights * self.grade(places)
        return float(rolling * 1e-3 + curves.sum() + slope.sum())
