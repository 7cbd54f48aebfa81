"""Limits of the quantities, from `data/assessment.toml`, each with its source and whether it is confirmed."""

import math
from dataclasses import dataclass, replace
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


def static_wheel_load(vehicle: Vehicle) -> float:
    """Q0, half of P0 [N]."""
    return 0.5 * static_axle_load(vehicle)


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
        "unloading": rows["unloading"]["share"],
        "unloading_quasi_static": rows["unloading_quasi_static"]["share"],
        "q": of_wheel,
        "y_quasi_static": _KN * rows["y_quasi_static"]["value_kN"],
        "q_quasi_static": _KN * rows["q_quasi_static"]["value_kN"],
        "body_lateral": rows["body_lateral"]["value_m_s2"],
        "body_vertical": rows["body_vertical"]["value_m_s2"],
        "sum_y_rms": rows["sum_y_rms"]["share"] * track_shift,
    }
    sourced = load_parameters("hh_exudyn", "assessment").table("limit")
    first = {name: sourced.table(name).parameters[0] for name in values}  # one source for a limit's numbers
    found = {name: Limit(float(v), first[name].confirmed, first[name].source) for name, v in values.items()}
    rule = sourced.parameter("y_quasi_static_reduced.slope_kN")
    reduced = replace(found["y_quasi_static"], source=f"as Y quasi-static; {rule.source}")
    return found | {"y_quasi_static_reduced": reduced}


def in_a_curve(limit: Limit, radius: float) -> Limit:
    """The limit of the quasi-static guiding force Yqst in curves of a radius: higher where they are tight.

    Parameters
    ----------
    limit : Limit
        That of wide curves.
    radius : float
        Of the curve [m].
    """
    rows = data()["limit"]["y_quasi_static"]
    if radius >= rows["tight_below_m"]:
        return limit
    divisor = max(radius, rows["least_radius_m"])
    return replace(limit, value=_KN * (rows["constant_kN"] + rows["over_radius_kN_m"] / divisor))


def nadal(flange_angle: float, friction: float) -> float:
    """Nadal's limit of Y/Q: (tan g - mu) / (1 + mu tan g) (Nadal 1908; Marquis and Greif, JRC2011-56064).

    Parameters
    ----------
    flange_angle : float
        Largest angle g of the flange against the axle [rad].
    friction : float
        Coefficient mu of wheel and rail there [-].

    Raises
    ------
    ValueError
        An angle not above 0 and below 90 degrees, or a friction not of 0 to the tangent of the angle.
    """
    if not 0.0 < flange_angle < 0.5 * math.pi:
        raise ValueError(f"flange angle is {math.degrees(flange_angle):g} degrees, allowed 0 to 90 degrees")
    steepness = math.tan(flange_angle)
    if not 0.0 <= friction <= steepness:
        raise ValueError(f"friction is {friction:g}, allowed 0 to {steepness:g}, the flange's tangent")
    return (steepness - friction) / (1.0 + friction * steepness)


def climbing_limits(flange_angle: float, friction: float) -> dict[str, Limit]:
    """Limits against climbing of a flange: Nadal's of a wheel, Weinstock's of a wheelset.

    Weinstock (1984): the sum of |Y/Q| of both wheels stays below Nadal's limit plus the friction of the wheel
    that does not climb, which pushes the other one outwards with at most that.

    Parameters
    ----------
    flange_angle, friction : float
        As for `nadal`.
    """
    of_wheel = nadal(flange_angle, friction)
    given = f"flange of {math.degrees(flange_angle):.1f} degrees, friction {friction:.3g}"
    return {
        "y_over_q_nadal": Limit(of_wheel, True, f"published: Nadal (1908): {given}"),
        "axle_sum": Limit(
            of_wheel + friction,
            False,
            f"published: Weinstock (1984) from memory: Nadal's limit + mu, {given}",
        ),
    }
