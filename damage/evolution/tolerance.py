"""Steps of wear sized by their error: tried with Euler and Heun, accepted, or made again shorter.

A step is accepted on three numbers, each over its tolerance: the difference of the depths of Euler and Heun,
the change of the largest contact pressure from the start to Euler's profile, and the change of the equivalent
conicity from the start to Heun's. A profile that folds over halves the step. The first step is so short that
it wears by the tolerance of the profile.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from damage.bounds import check_above_zero
from damage.evolution.history import WearStep
from damage.evolution.measures import ConicityTrack, measure
from damage.evolution.profile_wear import ProfileWear
from damage.evolution.step import (
    diffused,
    euler_increment,
    heun_increment,
    measured_diffusivity,
    not_below_zero,
)
from damage.evolution.worn_profile import worn_by
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.cleaning import arc_length

WearOf = Callable[[Profile], ProfileWear]

_ROUNDS = 25  # tries of one step: halved so often, 1000 km are 30 mm
_SAFETY, _SHORTER, _LONGER = 0.85, 0.2, 3.0  # of the next length: usual for embedded pairs
_DIFFUSIVITY_SAFETY = 2.0  # the measured value is a mean over the profile
_FORGOTTEN = 0.5  # a measured diffusivity falls by no more than this from step to step


@dataclass(frozen=True)
class StepTolerance:
    """What a step of wear may change, and the length by which wear is filtered.

    Attributes
    ----------
    profile
        Largest difference of the depths of Euler and Heun [m], > 0; assumed, range 2 .. 20 um.
    pressure
        Largest change of the contact pressure over itself [-], > 0; assumed, range 0.05 .. 0.3.
    conicity
        Largest change of the equivalent conicity [-], > 0; assumed, range 0.005 .. 0.05.
    max_distance
        Longest step [m], > 0.
    filter_length
        Of a wear rate over the arc [m], > 0: curvature in waves shorter than 2 pi of it is not worn. A third
        of a patch's lateral semi-axis (3 .. 7 mm), twice the bins of 1 mm it has to bridge; assumed,
        range 1 .. 3 mm.

    Raises
    ------
    ValueError
        A number that is not finite and above zero.
    """

    profile: float = 10e-6
    pressure: float = 0.1
    conicity: float = 0.02
    max_distance: float = 5000e3
    filter_length: float = 1.5e-3

    def __post_init__(self) -> None:
        for name, unit in (
            ("profile", "m"), ("pressure", "-"), ("conicity", "-"), ("max_distance", "m"),
            ("filter_length", "m"),
        ):  # fmt: skip
            check_above_zero(name, getattr(self, name), unit, "the tolerance of a step of wear")


def filtered_rate(wheel: Profile, wear: ProfileWear, length: float) -> FloatArray:
    """(n,) wear rate at the points of a profile [m/m], filtered over the arc; its area is kept.

    Twice the filter 1 / (1 + (k length)^2 / 2): the variance of a Gaussian of that length, and no kinks of
    the bins.

    Parameters
    ----------
    wheel, wear
        The profile, and its wear.
    length
        Of the filter [m].
    """
    s, rate = arc_length(wheel.y, wheel.z), 1e-3 * wear.at(wheel.y)
    once = diffused(s, rate, 0.5 * length**2)
    return np.maximum(diffused(s, once, 0.5 * length**2), 0.0)


def tolerated_step(
    now: WearStep, name: str, wear_of: WearOf, distance: float, control: StepTolerance, track: ConicityTrack
) -> WearStep:
    """The wheel one accepted step later.

    Parameters
    ----------
    now
        The wheel before.
    name
        Of the wheel, for the names of its profiles.
    wear_of
        Called at the start and once a try.
    distance
        At which the life ends: no step goes beyond it [m].
    control
        Tolerances.
    track
        For the equivalent conicity.

    Raises
    ------
    ValueError
        No step is short enough.
    """
    wear = wear_of(now.profile)
    rate = filtered_rate(now.profile, wear, control.filter_length)
    s, left = arc_length(now.profile.y, now.profile.z), distance - now.distance
    way = min(_first(now, rate, control), control.max_distance)
    diffusivity = now.diffusivity
    for _ in range(_ROUNDS):
        wanted, way = way, min(way, left)
        end = distance if way == left else now.distance + way
        title = f"{name} after {1e-3 * end:.{0 if end >= 1e6 else 3}f} km"
        try:
            euler = euler_increment(s, rate, way, diffusivity)
            after = worn_by(now.profile, euler, way, title + ", Euler")[0]
            wear_after = wear_of(after)
            rate_after = filtered_rate(after, wear_after, control.filter_length)
            depth = not_below_zero(s, heun_increment(s, euler, rate_after, way, diffusivity))
            profile, lost = worn_by(now.profile, depth, way, title)
            measures = measure(profile, now.radius - lost, track)
        except ValueError as error:
            refused, way = error, 0.5 * way
            continue
        found = measured_diffusivity(s, euler, rate, rate_after, control.filter_length)
        diffusivity = max(_DIFFUSIVITY_SAFETY * found, _FORGOTTEN * diffusivity)
        shares = _shares(
            float(np.abs(depth - euler).max()) / control.profile,
            abs(wear_after.pressure / wear.pressure - 1.0) / control.pressure if wear.pressure else 0.0,
            abs(measures.conicity - now.measures.conicity) / control.conicity,
        )
        factor = _SAFETY * min(shares[0] ** -0.5, 1.0 / shares[1], 1.0 / shares[2])
        ahead = way * min(max(factor, _SHORTER), _LONGER)
        if max(shares) <= 1.0:
            ahead = max(ahead, wanted) if way < wanted else ahead
            return WearStep(
                end,
                profile,
                now.radius - lost,
                float(depth.max()),
                measures,
                wear.pressure,
                ahead,
                diffusivity,
            )
        refused, way = ValueError(f"errors over tolerances {', '.join(f'{x:.3g}' for x in shares)}"), ahead
    raise ValueError(
        f"wheel profile {now.profile.name!r}: no step of wear from {1e-3 * now.distance:.3f} km on is short "
        f"enough, down to {way:.3g} m ({refused})"
    )


def _first(now: WearStep, rate: FloatArray, control: StepTolerance) -> float:
    """The length to try first [m]: that of the step before, or one that wears by the tolerance."""
    if math.isfinite(now.next_distance):
        return now.next_distance
    largest = float(rate.max())
    return control.profile / largest if largest > 0.0 else control.max_distance


def _shares(*errors: float) -> list[float]:
    """Errors over tolerances, above zero; 0 where a quantity is not known."""
    return [max(error, 1e-12) if math.isfinite(error) else 1e-12 for error in errors]
