"""Whole-life rail model: damage per passage over the wear number, fatigue against wear.

M.C. Burstow, Whole Life Rail Model (RSSB, 2004); Hossein-Nia (2018), figure 3-27. Below a first energy
there is no damage; then cracks grow faster with energy up to a peak; then wear removes more and more of them,
until crack growth and wear balance at a third energy, beyond which the function is negative: wear prevails.

The turning points 15, 65 and 175 N and the peak of 1e-5 are for British rails (R220) and from memory [M]. A
published code of the University of Twente has the same 65 N, 175 N and 1e-5, with the first point at 20 N.
For another steel the points follow from its strengths (3.33): `damage.rcf.whole_life_rail.rescaled`.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
import pyarrow
from numpy.typing import ArrayLike

from damage.bounds import check_above_zero
from hh_exudyn.arrays import FloatArray


@dataclass(frozen=True)
class DamageFunction:
    """The function's turning points; calibrated on rails.

    Attributes
    ----------
    onset
        Energy up to which there is no damage [N = J/m].
    peak
        Energy of the largest damage [N].
    balance
        Energy at which wear and crack growth balance [N]; the line from the peak continues below zero.
    peak_damage
        Damage of a passage at the peak [-].

    Raises
    ------
    ValueError
        The energies do not rise from 0 on, or the peak is not above zero.
    """

    onset: float = 15.0
    peak: float = 65.0
    balance: float = 175.0
    peak_damage: float = 1e-5

    def __post_init__(self) -> None:
        if not (0.0 <= self.onset < self.peak < self.balance < math.inf):
            raise ValueError(
                f"onset = {self.onset} N, peak = {self.peak} N, balance = {self.balance} N "
                "must rise from 0 N on"
            )
        check_above_zero("peak_damage", self.peak_damage, "-")

    def damage(self, wear_number: ArrayLike) -> FloatArray:
        """Damage of a passage [-]: positive for growing cracks, negative for wear.

        Parameters
        ----------
        wear_number
            Energy per distance rolled [N = J/m], `damage.wear.energy.wear_number`; NaN gives NaN.
        """
        energy = np.asarray(wear_number, dtype=np.float64)
        rising = (energy - self.onset) / (self.peak - self.onset)
        falling = (self.balance - energy) / (self.balance - self.peak)
        damage: FloatArray = self.peak_damage * np.minimum(np.maximum(rising, 0.0), falling)
        return damage

    def to_table(self, wear_number: ArrayLike) -> pyarrow.Table:
        """The function at given energies: wear_number_N, damage."""
        energy = np.asarray(wear_number, dtype=np.float64).ravel()
        return pyarrow.table({"wear_number_N": energy, "damage": self.damage(energy)})


BURSTOW_RAIL = DamageFunction()
TWENTE_RAIL = DamageFunction(onset=20.0)


def rescaled(energies: tuple[float, float, float], function: DamageFunction = BURSTOW_RAIL) -> DamageFunction:
    """The damage function with the turning points of another steel.

    Parameters
    ----------
    energies
        E_1, E_2, E_3 of equation 3.33 [N]: nu_i A (yield + tensile strength) / (2 sqrt 3) at creepages of
        0.1, 0.3 and 1 %. ER7 (520, 880 MPa) on A = 100 mm^2 has 40, 121 and 404 N. They are taken as the
        three turning points in order: 1 : 3 : 10, against 1 : 4.3 : 11.7 of the rail's. The text of the
        thesis uses them otherwise when it corrects counts: undiminished up to E_1, none beyond E_2.
    function
        Damage function with the peak damage.

    Raises
    ------
    ValueError
        The energies do not rise.
    """
    onset, peak, balance = energies
    return replace(function, onset=onset, peak=peak, balance=balance)
