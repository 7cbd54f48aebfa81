"""Steps of wear sized by their error: tried with Euler and Heun, accepted, or made again shorter.

A step is accepted on three numbers, each over its tolerance: the difference of the depths of Euler and Heun,
the change of the largest contact pressure from the start to Euler's profile, and the change of the equivalent
conicity from the start to Heun's. A profile that folds over halves the step. The first step is so short that
it wears by the tolerance of the profile.

A try evaluates the wear once, on Euler's profile; the next step begins with that rate, so a step costs one
evaluation (`damage.evolution.step`).

Wheels that wear over the same distance, each with its own profile, make one common step: the largest of all
their errors decides.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from damage.bounds import check_above_zero
from damage.evolution.history import WearStep
from damage.evolution.measures import ConicityTrack, measure
from damage.evolution.profile_wear import ProfileWear
from damage.evolution.step import (
    diffused,
    euler_increment,
    heun_increment,
    measured_sensitivity,
    not_below_zero,
)
from damage.evolution.worn_profile import worn_by
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.cleaning import arc_length

WearOf = Callable[[Profile], ProfileWear]
JointWearOf = Callable[[tuple[Profile, ...]], tuple[ProfileWear, ...]]

_ROUNDS = 25  # tries of one step: halved so often, 1000 km are 30 mm
_SAFETY, _SHORTER, _LONGER = 0.85, 0.2, 3.0  # of the next length: usual for embedded pairs

SENSITIVITY = 0.3, 1.0
"""Bounds of d ln(rate)/d(curvature) [m]: assumed, range 0.1 .. 2. Where curvature changes most, on an unworn
tread, it measures 0.3 to 0.5; later little is left to measure it by, which is no sign of its fall."""

_IMPLICIT = 0.5  # of the measured diffusivity: stable from 0.3 on, and of the least error near 0.5


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

    Twice the filter 1 / (1 + (k length)^2 / 2): no kinks of the bins, and the variance of a Gaussian of
    sqrt(2) length.

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
    """One wheel one accepted step later: `tolerated_steps` of it alone.

    Parameters
    ----------
    now, name, wear_of, distance, control, track
        As `tolerated_steps`, of one wheel.

    Raises
    ------
    ValueError
        No step is short enough.
    """

    def of_one(profiles: tuple[Profile, ...]) -> tuple[ProfileWear, ...]:
        return (wear_of(profiles[0]),)

    return tolerated_steps((now,), (name,), of_one, distance, control, track)[0]


def tolerated_steps(
    now: tuple[WearStep, ...],
    names: tuple[str, ...],
    wear_of: JointWearOf,
    distance: float,
    control: StepTolerance,
    track: ConicityTrack,
) -> tuple[WearStep, ...]:
    """Wheels one accepted step of common length later.

    Parameters
    ----------
    now
        The wheels before, all at one distance.
    names
        Of the wheels, for the names of their profiles.
    wear_of
        Wear of all wheels, in their order: called once a try, on Euler's profiles, and before the first step
        on the wheels' own. The last call is that of the accepted try. What it raises ends the step.
    distance
        At which the life ends: no step goes beyond it [m].
    control
        Tolerances, which every wheel keeps.
    track
        For the equivalent conicity.

    Raises
    ------
    ValueError
        Wheels at several distances, another number of names or wears than wheels, or no step is short enough.
    """
    _check_together(now, names)
    if any(step.next_rate is None for step in now):
        wears = _asked(wear_of, tuple(step.profile for step in now))
        now = tuple(_begun(step, wear, control) for step, wear in zip(now, wears, strict=True))
    wheels = [_Wheel(*given) for given in zip(now, names, strict=True)]
    reached = now[0].distance
    way, left = min(*(wheel.first(control) for wheel in wheels), control.max_distance), distance - reached
    for _ in range(_ROUNDS):
        wanted, way = way, min(way, left)
        end = distance if way == left else reached + way
        try:
            eulers = [wheel.euler(way, end) for wheel in wheels]
        except ValueError as error:  # a profile folds over
            refused, way = error, 0.5 * way
            continue
        wears = _asked(wear_of, tuple(profile for _, profile in eulers))
        try:
            tried = [
                wheel.heun(*euler, wear, way, end, control, track)
                for wheel, euler, wear in zip(wheels, eulers, wears, strict=True)
            ]
        except ValueError as error:
            refused, way = error, 0.5 * way
            continue
        steps, shares = zip(*tried, strict=True)
        worst = np.max(shares, axis=0)
        factor = _SAFETY * min(worst[0] ** -0.5, 1.0 / worst[1], 1.0 / worst[2])
        ahead = float(way * min(max(factor, _SHORTER), _LONGER))
        if worst.max() <= 1.0:
            ahead = max(ahead, wanted) if way < wanted else ahead
            return tuple(replace(step, next_distance=ahead) for step in steps)
        now = tuple(replace(at, sensitivity=step.sensitivity) for at, step in zip(now, steps, strict=True))
        wheels = [_Wheel(*given) for given in zip(now, names, strict=True)]
        refused, way = ValueError(f"errors over tolerances {', '.join(f'{x:.3g}' for x in worst)}"), ahead
    raise ValueError(
        f"wheel profile{'s' * (len(now) > 1)} {', '.join(repr(step.profile.name) for step in now)}: "
        f"no step of wear from {1e-3 * reached:.3f} km on is short enough, down to {way:.3g} m ({refused})"
    )


def _begun(now: WearStep, wear: ProfileWear, control: StepTolerance) -> WearStep:
    """A wheel with the wear that its next step begins with."""
    rate = filtered_rate(now.profile, wear, control.filter_length)
    return replace(now, next_rate=rate, next_pressure=wear.pressure)


@dataclass(frozen=True, eq=False)
class _Wheel:
    """A wheel at the start of a step, with its wear there."""

    now: WearStep
    name: str

    @cached_property
    def s(self) -> FloatArray:
        return arc_length(self.now.profile.y, self.now.profile.z)

    @property
    def rate(self) -> FloatArray:
        assert self.now.next_rate is not None
        return self.now.next_rate

    @property
    def diffusivity(self) -> FloatArray:
        """(n,) D of the implicit diffusion over the arc [m]."""
        return _IMPLICIT * np.fmax(self.now.sensitivity, SENSITIVITY[0]) * self.rate

    def first(self, control: StepTolerance) -> float:
        """The length to try first [m]: that of the step before, or one that wears by the tolerance."""
        if math.isfinite(self.now.next_distance):
            return self.now.next_distance
        largest = float(self.rate.max())
        return control.profile / largest if largest > 0.0 else control.max_distance

    def title(self, end: float) -> str:
        return f"{self.name} after {1e-3 * end:.{0 if end >= 1e6 else 3}f} km"

    def euler(self, way: float, end: float) -> tuple[FloatArray, Profile]:
        """Depth and profile of Euler's step; ValueError where it folds over."""
        depth = euler_increment(self.s, self.rate, way, self.diffusivity)
        return depth, worn_by(self.now.profile, depth, way, self.title(end) + ", Euler")[0]

    def heun(
        self, euler: FloatArray, after: Profile, wear_after: ProfileWear, way: float, end: float,
        control: StepTolerance, track: ConicityTrack,
    ) -> tuple[WearStep, tuple[float, ...]]:  # fmt: skip
        """Heun's step, and its errors over their tolerances; ValueError where it folds over.

        Seven arguments: the try, from Euler's depth and profile and the wear of it, and what it is judged by.
        """
        rate_after = filtered_rate(after, wear_after, control.filter_length)
        depth = not_below_zero(self.s, heun_increment(self.s, euler, rate_after, way, self.diffusivity))
        profile, lost = worn_by(self.now.profile, depth, way, self.title(end))
        radius = self.now.radius - lost
        measures = measure(profile, radius, track)
        found = measured_sensitivity(self.s, euler, self.rate, rate_after, control.filter_length)
        before, now_after = self.now.next_pressure, wear_after.pressure
        shares = _shares(
            float(np.abs(depth - euler).max()) / control.profile,
            abs(now_after / before - 1.0) / control.pressure if before else 0.0,
            abs(measures.conicity - self.now.measures.conicity) / control.conicity,
        )
        step = WearStep(
            end, profile, radius, float(depth.max()), measures, before,
            sensitivity=min(max(found, SENSITIVITY[0]), SENSITIVITY[1]),
            next_rate=rate_after, next_pressure=now_after,
        )  # fmt: skip
        return step, shares


def _asked(wear_of: JointWearOf, profiles: tuple[Profile, ...]) -> tuple[ProfileWear, ...]:
    """The wear of all wheels; ValueError where there are more or fewer."""
    wears = tuple(wear_of(profiles))
    if len(wears) != len(profiles):
        raise ValueError(f"wear_of gave the wear of {len(wears)} wheels, needed {len(profiles)}")
    return wears


def _check_together(now: tuple[WearStep, ...], names: tuple[str, ...]) -> None:
    """Raise ValueError unless wheels are at one distance and have a name each."""
    if not now or len(names) != len(now):
        raise ValueError(f"{len(now)} wheels and {len(names)} names: each needs one, and one wheel at least")
    distances = sorted({step.distance for step in now})
    if len(distances) > 1:
        given = ", ".join(f"{1e-3 * each:.3f}" for each in distances)
        raise ValueError(f"wheels that wear together have run {given} km, needed the same distance")


def _shares(*errors: float) -> tuple[float, ...]:
    """Errors over tolerances, above zero; 0 where a quantity is not known."""
    return tuple(max(error, 1e-12) if math.isfinite(error) else 1e-12 for error in errors)
