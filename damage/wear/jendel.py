"""Jendel's map: the wear coefficient of Archard's law over sliding velocity and pressure.

T. Jendel, Prediction of wheel profile wear - comparisons with field measurements, Wear 253 (2002) 89-99.
Figure 3-23 of Hossein-Nia (2018).
"""

from dataclasses import dataclass, fields, replace
from typing import NamedTuple

from damage.bounds import check_above_zero
from damage.parameters import parameters
from hh_exudyn.kernel import kernel

JENDEL_REGIMES = ("mild, slow", "severe", "mild, fast", "seizure")
"""Regions of the map, in the order of the regime columns."""

_UNITS = {name: parameter.unit for name, parameter in parameters("wear", "jendel").items()}
_DATA = {name: parameter.value for name, parameter in parameters("wear", "jendel").items()}


class MapValues(NamedTuple):
    """The map, for the kernels; meanings as in `JendelMap`."""

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

    The defaults are those of ``damage/data/wear.toml``: from memory of Jendel (2002) [M], not confirmed
    against the paper. The paper gives ranges; the middle of each is taken here.

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
        Hardness H of the softer body [Pa]; None takes that of the wheel steel, and where no steel is named
        the 2.65 GPa (270 HB) of ``wear.toml``, at which the map is usually drawn [M].

    Raises
    ------
    ValueError
        A value is not finite or not above zero, or the velocities are in the wrong order.
    """

    mild_slow: float = _DATA["mild_slow"]
    severe: float = _DATA["severe"]
    mild_fast: float = _DATA["mild_fast"]
    seizure: float = _DATA["seizure"]
    severe_from: float = _DATA["severe_from"]
    severe_to: float = _DATA["severe_to"]
    seizure_ratio: float = _DATA["seizure_ratio"]
    hardness: float | None = None

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if value is not None:
                check_above_zero(field.name, value, _UNITS[field.name], "the wear map")
        if self.severe_from >= self.severe_to:
            raise ValueError(
                f"severe_from = {self.severe_from} m/s must lie below severe_to = {self.severe_to} m/s"
            )

    def divided(self, divisor: float) -> "JendelMap":
        """The map with all coefficients divided, for a lubricated contact.

        Natural lubrication divides by about 6 (Jendel; Hossein-Nia 2018, p. 70), grease by about 100 (Zhu;
        ibid.).
        """
        check_above_zero("divisor", divisor, "-")
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
        hardness = _DATA["hardness"] if self.hardness is None else self.hardness
        return MapValues(
            self.mild_slow,
            self.severe,
            self.mild_fast,
            self.seizure,
            self.severe_from,
            self.severe_to,
            self.seizure_ratio * hardness,
            hardness,
        )


@kernel
def wear_regime(pressure: float, sliding_velocity: float, wear_map: MapValues) -> int:
    """Region of the map: index into `JENDEL_REGIMES`. Pressure [Pa], sliding velocity [m/s].

    Parameters
    ----------
    pressure
        [Pa].
    sliding_velocity
        [m/s].
    wear_map
        The map.
    """
    if pressure > wear_map.seizure_pressure:
        return 3
    if sliding_velocity < wear_map.severe_from:
        return 0
    if sliding_velocity <= wear_map.severe_to:
        return 1
    return 2


@kernel
def wear_coefficient(regime: int, wear_map: MapValues) -> float:
    """Coefficient k [-] of a region of the map.

    Parameters
    ----------
    regime
        Index into `JENDEL_REGIMES`.
    wear_map
        The map.
    """
    if regime == 3:
        return wear_map.seizure
    if regime == 1:
        return wear_map.severe
    if regime == 2:
        return wear_map.mild_fast
    return wear_map.mild_slow
