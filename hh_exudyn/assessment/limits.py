"""Limits of the quantities, from `data/assessment.toml`, each with its source and whether it is confirmed."""

from dataclasses import dataclass
from functools import cache
from typing import Any

from hh_exudyn.conventions import GRAVITY
from hh_exudyn.sourced import load_parameters
from vehicles.description import Vehicle

_KN = 1e3


@dataclass(frozen=True)
class Limit:
    """A limit of one quantity for one vehicle.

    Attributes
    ----------
    value : float
        In the quantity's unit [N, m/s^2, -].
    confirmed : bool
        Whether the number was read in a work that cites the standard; none was read in the standard itself.
    source : str
        Source of the number.
    """

    value: float
    confirmed: bool
    source: str


@cache
def data() -> dict[str, Any]:
    """The numbers of the assessment, in tables as in their file."""
    return load_parameters("hh_exudyn", "assessment").nested()


def static_axle_load(vehicle: Vehicle) -> float:
    """P0, the weight of the vehicle shared by its wheelsets [N]."""
    return vehicle.mass * GRAVITY / len(vehicle.wheelsets)


def beyond_the_standards(vehicle: Vehicle) -> bool:
    """Whether its axle load is above the range of EN 14363 with EN 15687."""
    return static_axle_load(vehicle) > _KN * float(data()["axle_load"]["largest_kN"])


def limits(vehicle: Vehicle) -> dict[str, Limit]:
    """The limits of a vehicle by quantity; quantities without a known limit are missing."""
    rows = data()["limit"]
    load = static_axle_load(vehicle)
    sum_y = rows["sum_y"]
    track_shift = sum_y["factor"] * (_KN * sum_y["constant_kN"] + load / sum_y["divisor"])
    of_wheel = min(_KN * rows["q"]["constant_kN"] + 0.5 * load, _KN * rows["q"]["largest_kN"])
    values = {
        "sum_y": track_shift,
        "y_over_q": rows["y_over_q"]["ratio"],
        "q": of_wheel,
        "y_quasi_static": _KN * rows["y_quasi_static"]["value_kN"],
        "q_quasi_static": _KN * rows["q_quasi_static"]["value_kN"],
        "body_lateral": rows["body_lateral"]["value_m_s2"],
        "body_vertical": rows["body_vertical"]["value_m_s2"],
        "sum_y_rms": rows["sum_y_rms"]["share"] * track_shift,
    }
    sourced = load_parameters("hh_exudyn", "assessment").table("limit")
    first = {name: sourced.table(name).parameters[0] for name in values}  # one source for a limit's numbers
    return {name: Limit(float(v), first[name].confirmed, first[name].source) for name, v in values.items()}
