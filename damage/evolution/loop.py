"""`evolve`: wear of a wheel profile, step by step, over a distance.

The wear comes from the caller: `wear_of(profile)` may run simulations with the profile, or give a synthetic
rate. A step is sized by its error (`StepTolerance`), or ends at a fixed depth or distance, whichever comes
first (`StepControl`; T. Jendel, Prediction of wheel profile wear - comparisons with field measurements, Wear
253 (2002); Hossein-Nia 2018, figure 3-25): 0.1 mm at once makes a notch on a new wheel in dry curves.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from damage.bounds import check_above_zero, check_not_below_zero
from damage.evolution.history import WearHistory, WearStep, read_history, write_step
from damage.evolution.measures import ConicityTrack, measure
from damage.evolution.profile_wear import ProfileWear
from damage.evolution.tolerance import StepTolerance, tolerated_step
from damage.evolution.worn_profile import SMOOTHING, step_depth, worn_profile
from hh_exudyn.contact.profile import Profile

Progress = Callable[[float, str], None]

_LAST = 1e-9  # of the distance: a remainder below it is rounding


@dataclass(frozen=True)
class StepControl:
    """Limits of a step of wear, at which the profile is updated.

    Attributes
    ----------
    max_depth
        Largest depth of a step [m], > 0; 0.1 mm after Jendel (2002), unconfirmed.
    max_distance
        Longest step [m], > 0; 1500 km after Jendel (2002), unconfirmed.
    smoothing
        Share of the largest depth that smoothing may change a depth by [-], 0 to 0.5.

    Raises
    ------
    ValueError
        A number out of its range.
    """

    max_depth: float = 0.1e-3
    max_distance: float = 1500e3
    smoothing: float = SMOOTHING

    def __post_init__(self) -> None:
        for name in ("max_depth", "max_distance"):
            check_above_zero(name, getattr(self, name), "m", "a step of wear")
        if not 0.0 <= self.smoothing <= 0.5:
            raise ValueError(f"smoothing = {self.smoothing} of a step of wear, allowed 0 .. 0.5")


def evolve(
    wheel: Profile,
    radius: float,
    wear_of: Callable[[Profile], ProfileWear],
    distance: float,
    directory: Path | str,
    control: StepControl | StepTolerance | None = None,
    track: ConicityTrack | None = None,
    progress: Progress | None = None,
) -> WearHistory:
    """The life of a wheel up to a distance.

    It continues from the last step in the directory. Where the directory holds more than the distance, its
    steps up to there are taken and the last one is computed again, only as long as it is wanted: the result
    is that of a life that ends there, and the directory stays as it is.

    Parameters
    ----------
    wheel
        The profile at the start.
    radius
        At its running circle [m].
    wear_of
        Wear of a wheel with the given profile: called at the start and once a try, with fixed limits once a
        step.
    distance
        At the end, from the start [m], >= 0.
    directory
        Where the steps are written, one file each. One that holds steps of the same wheel is continued.
    control
        Tolerances of a step's error, or fixed limits of a step; None takes the default tolerances.
    track
        For the equivalent conicity; None takes 60E1 1:30 at nominal gauge.
    progress
        Called after every step with the share of the distance that is done (0..1) and a line of text.

    Raises
    ------
    ValueError
        A number out of its range, a directory with the steps of another wheel, or wear that leaves no valid
        profile (`worn_profile`); the steps so far stay on disk.
    """
    check_not_below_zero("distance", distance, "m")
    check_above_zero("radius", radius, "m")
    directory, control, track = Path(directory), control or StepTolerance(), track or ConicityTrack()
    steps = list(read_history(directory).steps)
    if not steps:
        steps.append(WearStep(0.0, wheel, radius, 0.0, measure(wheel, radius, track)))
        write_step(directory, 0, steps[0])
    _check_same(directory, steps[0], wheel, radius)
    reached = [step for step in steps if step.distance <= distance * (1.0 + _LAST)]
    shorter, steps = len(reached) < len(steps), reached
    while distance - steps[-1].distance > _LAST * distance:
        steps.append(_next(steps[-1], wheel.name, wear_of, distance, control, track))
        if not shorter:
            write_step(directory, len(steps) - 1, steps[-1])
        if progress is not None:
            progress(
                steps[-1].distance / distance,
                f"step {len(steps) - 1}: {1e-3 * steps[-1].distance:.0f} km, "
                f"up to {1e3 * steps[-1].depth:.4f} mm deep",
            )
    return WearHistory(tuple(steps))


def _next(
    now: WearStep,
    name: str,
    wear_of: Callable[[Profile], ProfileWear],
    distance: float,
    control: StepControl | StepTolerance,
    track: ConicityTrack,
) -> WearStep:
    """The wheel one step later."""
    if isinstance(control, StepTolerance):
        return tolerated_step(now, name, wear_of, distance, control, track)
    wear = wear_of(now.profile)
    way = min(control.max_distance, distance - now.distance)
    deepest = float(step_depth(now.profile, wear, way, control.smoothing).max())
    if deepest > control.max_depth:
        way *= control.max_depth / deepest
        deepest = control.max_depth
    end = now.distance + way
    if distance - end <= _LAST * distance:
        end = distance
    profile, lost = worn_profile(
        now.profile, wear, way, control.smoothing, f"{name} after {1e-3 * end:.0f} km"
    )
    radius = now.radius - lost
    return WearStep(end, profile, radius, deepest, measure(profile, radius, track), wear.pressure)


def _check_same(directory: Path, start: WearStep, wheel: Profile, radius: float) -> None:
    """Raise ValueError unless the directory began with this wheel."""
    same = np.array_equal(start.profile.y, wheel.y) and np.array_equal(start.profile.z, wheel.z)
    if not (same and start.radius == radius):
        raise ValueError(
            f"{directory}: holds the steps of wheel profile {start.profile.name!r} with a radius of "
            f"{1e3 * start.radius:g} mm; it cannot be continued with {wheel.name!r} and {1e3 * radius:g} mm"
        )
