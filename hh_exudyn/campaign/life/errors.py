"""Errors of the rates of a campaign's wheels: of sampling, and of the steps of the axes, at one state.

Cases are bought for the profiles of a step (`hh_exudyn.campaign.collective.sizing`), and stay in the folder
of results. The quantities are those that a life depends on: for every group of wheels wear at some places of
the profile, relative to the deepest place of the group, and Miner's sum by every index at the worst place of
tread and root, of which the relative error is that of ln(life).
"""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from damage.life.places import WheelPlaces
from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.collective.bought import through_cases
from hh_exudyn.campaign.collective.sizing import Quantity, Sizing, size
from hh_exudyn.campaign.collective.weighted import WeightedCase
from hh_exudyn.campaign.life.evaluation import Evaluation, GroupProfiles
from hh_exudyn.campaign.life.rates import GroupRates
from hh_exudyn.log.parts import write_text

FILE = "errors.json"
WEAR_PLACES = (-30e-3, -10e-3, 0.0, 10e-3, 20e-3, 30e-3, 37e-3)
"""Lateral places on the profile at which the error of wear is stated [m]."""
_CRACK_PLACES = ("tread", "root")


def sized(
    evaluation: Evaluation, profiles: GroupProfiles, places: Mapping[str, WheelPlaces], budget: int,
    error: float = 0.05,
) -> Sizing:  # fmt: skip
    """Buy cases for profiles until the rates of all groups are known to an error, or a budget is spent.

    Parameters
    ----------
    evaluation
        Of the campaign.
    profiles, places
        By group: as they are, and tread and root on them.
    budget
        Most cases, those that were bought before included [-].
    error
        Relative half width of the interval of 95 % [-].

    Raises
    ------
    ValueError
        A budget too small for three samples.
    TooManyFailed, EngineStopped, OSError, KeyboardInterrupt, Terminated
        As the engine's; what was run is kept.
    """
    worst = _worst_places(evaluation, profiles, places)
    quantities = tuple(_quantities(worst))

    def values_of(cases: Sequence[WeightedCase]) -> FloatArray:
        by_case = evaluation.rates_of_cases(cases, profiles)
        return np.array([list(_values(rates, worst)) for rates in by_case])

    return size(evaluation.plan.collective, through_cases(values_of), quantities, budget, error)


def write_errors(directory: Path, found: Sizing, distance: float) -> None:
    """Write the errors into the folder of a campaign.

    Parameters
    ----------
    directory
        Of the campaign.
    found
        What was bought.
    distance
        At which the wheels were when they were evaluated [m].
    """
    content = {
        "distance_km": 1e-3 * distance,
        "runs": found.runs,
        "reached": found.reached,
        "words": found.words(),
        "quantities": [quantity.name for quantity in found.quantities],
        "total": found.total.tolist(),
        "sampling": found.sampling.tolist(),
        "discretisation": {axis: one.error.tolist() for axis, one in found.discretisation.items()},
    }
    write_text(directory / FILE, json.dumps(content, indent=1) + "\n")


_Worst = Mapping[str, Mapping[tuple[str, str], float]]  # lateral place [m] by group, and index and place


def _worst_places(
    evaluation: Evaluation, profiles: GroupProfiles, places: Mapping[str, WheelPlaces]
) -> _Worst:
    """Where the cracks of every group grow fastest, on the tread and in the root, by the last evaluation."""
    found: dict[str, dict[tuple[str, str], float]] = {}
    for group, rates in evaluation(profiles).rates.items():
        for index, growth in rates.cracks.items():
            for place in _CRACK_PLACES:
                there = places[group].within(place, rates.y)
                worst = int(np.argmax(np.where(there, growth, -1.0)))
                found.setdefault(group, {})[index, place] = float(rates.y[worst])
    return found


def _quantities(worst: _Worst) -> list[Quantity]:
    """Names of the values of `_values`, in their order."""
    found = []
    for group, places in worst.items():
        for y in WEAR_PLACES:
            found.append(Quantity(f"{group}: wear at y = {1e3 * y:.0f} mm [m/m]", f"wear of {group}"))
        for index, place in places:
            found.append(Quantity(f"{group}: {index} crack damage of the {place} [1/m]"))
    return found


def _values(rates: Mapping[str, GroupRates], worst: _Worst) -> list[float]:
    """Wear and growth of cracks of one case, at the places of all groups."""
    found: list[float] = []
    for group, places in worst.items():
        one = rates[group]
        found += np.interp(WEAR_PLACES, one.y, one.depth, left=0.0, right=0.0).tolist()
        found += [float(np.interp(y, one.y, one.cracks[index])) for (index, _), y in places.items()]
    return found
