"""The steps of a wheel's life: on disk, one file a step, and as a table.

    directory/step-00000.npz    the wheel before the first step
    directory/step-00001.npz    after it: profile (y, z), radius, distance, measures

A file is renamed into place when it is complete and on disk, so a killed loop leaves all finished steps.
"""

import io
import math
import zipfile
import zlib
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow

from damage.evolution.measures import WheelMeasures
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.log.parts import write_whole

_OF_ERROR = "pressure", "next_distance", "sensitivity", "next_pressure"  # of steps sized by their error
_PATTERN = "step-{:05d}.npz"


@dataclass(frozen=True)
class WearStep:
    """A wheel after a step of wear.

    Attributes
    ----------
    distance
        Rolled since the start [m].
    profile
        Running circle at z = 0.
    radius
        At the running circle [m].
    depth
        Largest wear depth of this step [m]; 0 at the start.
    measures
        Of the profile.
    pressure
        Largest contact pressure of the wear that begins this step [Pa]; NaN where it is not known.
    next_distance
        Length of the step that the error allows next [m]; NaN where steps are not sized by their error.
    sensitivity
        Change of the wear rate over itself with convex curvature, measured in this step [m]
        (`damage.evolution.step`); NaN where it is not known.
    next_rate, next_pressure
        (n,) wear per distance at the profile's points [m/m], and largest contact pressure [Pa], as evaluated
        last in this step, close to its end: the next step begins with them. None and NaN where it evaluates.
    """

    distance: float
    profile: Profile
    radius: float
    depth: float
    measures: WheelMeasures
    pressure: float = math.nan
    next_distance: float = math.nan
    sensitivity: float = math.nan
    next_rate: FloatArray | None = field(default=None, compare=False)
    next_pressure: float = math.nan


@dataclass(frozen=True)
class WearHistory:
    """The steps of a wheel's life, the first before any wear."""

    steps: tuple[WearStep, ...]

    @property
    def last(self) -> WearStep:
        """The latest step."""
        return self.steps[-1]

    def to_table(self) -> pyarrow.Table:
        """One row per step, with units in the names of the columns."""
        columns: dict[str, list[float]] = {
            "distance_km": [1e-3 * step.distance for step in self.steps],
            "step_depth_mm": [1e3 * step.depth for step in self.steps],
        }
        for name, column, factor in (
            ("diameter", "diameter_mm", 1e3),
            ("flange_height", "Sh_mm", 1e3),
            ("flange_thickness", "Sd_mm", 1e3),
            ("flange_steepness", "qR_mm", 1e3),
            ("flange_angle", "flange_angle_deg", 180.0 / np.pi),
            ("hollow", "hollow_mm", 1e3),
            ("conicity", "equivalent_conicity", 1.0),
        ):
            columns[column] = [factor * getattr(step.measures, name) for step in self.steps]
        pressures = np.array([1e-6 * step.pressure for step in self.steps])
        return pyarrow.table(columns).append_column(
            "p_max_MPa",
            pyarrow.array(pressures, from_pandas=True),  # NaN as null
        )


def write_step(directory: Path, number: int, step: WearStep) -> None:
    """Write a step, complete or not at all; `number` from 0 for the wheel before the first step.

    Parameters
    ----------
    directory
        Made if it does not exist.
    number
        Of the step, from 0.
    step
        The wheel after it.
    """
    directory.mkdir(parents=True, exist_ok=True)
    path = directory / _PATTERN.format(number)
    numbers = {"distance": step.distance, "radius": step.radius, "depth": step.depth}
    numbers |= {name: getattr(step, name) for name in _OF_ERROR}
    numbers |= asdict(step.measures)
    arrays: dict[str, Any] = {key: np.array(value) for key, value in numbers.items()}
    arrays |= {"name": np.array(step.profile.name), "y": step.profile.y, "z": step.profile.z}
    if step.next_rate is not None:
        arrays["next_rate"] = step.next_rate
    write_whole(path, lambda stream: np.savez(stream, **arrays))


def read_history(directory: Path | str) -> WearHistory:
    """All steps in a directory, in order; an empty history for an empty directory.

    Raises
    ------
    ValueError
        A file is not one of a step or is broken, a step is missing between others, or distances that do not
        increase from 0 on.
    """
    directory = Path(directory)
    paths = sorted(directory.glob("step-*.npz"))
    wanted = [_PATTERN.format(number) for number in range(len(paths))]
    if [path.name for path in paths] != wanted:
        raise ValueError(
            f"{directory}: {len(paths)} steps up to {paths[-1].name}, some are missing before it"
        )
    steps = tuple(_read_step(path) for path in paths)
    before = -math.inf
    for path, step in zip(paths, steps, strict=True):
        if not (math.isfinite(step.distance) and step.distance > before):
            raise ValueError(
                f"{path}: distance = {step.distance:g} m must be finite and above {max(before, 0.0):g} m, "
                "that of the step before it"
            )
        before = step.distance
    return WearHistory(steps)


def _read_step(path: Path) -> WearStep:
    try:
        with np.load(io.BytesIO(path.read_bytes())) as data:
            values = {name: data[name] for name in data.files}
        measures = WheelMeasures(**{name: float(values[name]) for name in WheelMeasures.__annotations__})
        return WearStep(
            distance=float(values["distance"]),
            profile=Profile(str(values["name"]), "wheel", values["y"], values["z"]),
            radius=float(values["radius"]),
            depth=float(values["depth"]),
            measures=measures,
            next_rate=values.get("next_rate"),
            **{name: float(values[name]) for name in _OF_ERROR if name in values},
        )
    except (KeyError, ValueError, OSError, EOFError, zipfile.BadZipFile, zlib.error) as error:
        raise ValueError(
            f"{path}: not a step of a wheel's life, or a broken one ({error}); delete it and all later "
            "steps, and the evolution goes on from the step before"
        ) from None
