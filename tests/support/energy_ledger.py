"""The energy ledger of a run: does what the train gives go where the logs say?"""

from types import SimpleNamespace

import numpy as np
from run_tables import table
from spring_energy import spring_energy

from hh_exudyn.log.store import Run
from vehicles.description import Vehicle


def integral(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """From the start to every row, by trapezoids."""
    parts = 0.5 * (values[1:] + values[:-1]) * np.diff(time)
    return np.concatenate([[0.0], np.cumsum(parts)])


def balance(energy: SimpleNamespace) -> tuple[np.ndarray, np.ndarray]:
    """Work of the coupler less what was lost [J], and what the bodies have gained, at every row."""
    lost = energy.contact_power + energy.friction_power + energy.damper_power
    given = integral(energy.time, energy.coupler_power - lost)
    return given, energy.potential_energy + energy.kinetic_energy - energy.kinetic_energy[0]


def missing_energy(vehicle: Vehicle, run: Run) -> tuple[float, float]:
    """What the ledger does not explain at the end of a run, and the work of its coupler [J].

    The load springs' energy is taken from the motion; that of pads and contacts, tens of joules, is missing.
    """
    energy = table(run, "energy")
    given, gained = balance(energy)
    stored = spring_energy(vehicle, table(run, "motion"))
    work = integral(energy.time, energy.coupler_power)[-1]
    return float(gained[-1] + stored[-1] - stored[0] - given[-1]), float(work)
