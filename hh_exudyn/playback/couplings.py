"""Logged couplings in a recording: forces and displacements over time, the most varying ones in view.

Entities: ``couplings/force_kN/<name>/{x,y,z}`` and ``couplings/displacement_mm/<name>/{x,y,z}``, in the axes
of the coupling's body A, forces on its body B. All logged couplings are in the recording; the viewer shows
the `SHOWN` whose force varies most, others are added to its views by hand.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pyarrow
import rerun as rr

from hh_exudyn.arrays import FloatArray
from hh_exudyn.playback.layout import COUPLING_KINDS
from hh_exudyn.playback.send import Clock

SHOWN = 3  # couplings in view: three components each are nine curves
_COLOURS = ((229, 57, 53), (67, 160, 71), (30, 136, 229), (251, 192, 45), (171, 71, 188), (0, 172, 193))
_AXES = "xyz"
_LIGHT = {"x": 0.0, "y": 0.4, "z": 0.75}  # share of white in the colour of a component


class CouplingCourse(NamedTuple):
    """A coupling over the output times: by kind, (n, 3) components in the unit of the kind."""

    name: str
    values: dict[str, FloatArray]


def coupling_courses(log: pyarrow.Table, times: FloatArray) -> list[CouplingCourse]:
    """The couplings of a log at output times, in its order.

    Parameters
    ----------
    log : pyarrow.Table
        The log ``couplings``.
    times : (n,) array
        Wanted output times of the run [s].

    Raises
    ------
    ValueError
        A coupling is not in the log at every one of the times.
    """
    names = np.asarray(log["coupling"].to_pylist(), dtype=str)
    wanted = np.isin(log["time"].to_numpy(), times)
    columns = {
        kind: factor * np.column_stack([log[f"{of}_{axis}"].to_numpy() for axis in _AXES])
        for kind, (of, factor) in COUPLING_KINDS.items()
    }
    found = []
    for name in dict.fromkeys(names.tolist()):
        rows = wanted & (names == name)
        if rows.sum() != len(times):
            raise ValueError(
                f"the couplings log has {name} at {rows.sum()} of the {len(times)} times of the motion log"
            )
        found.append(CouplingCourse(name, {kind: values[rows] for kind, values in columns.items()}))
    return found


def most_varying(courses: Sequence[CouplingCourse]) -> list[str]:
    """Names of the `SHOWN` couplings with the largest range of any component of force, in their order."""
    ranges = {one.name: float(np.ptp(one.values["force_kN"], axis=0).max()) for one in courses}
    largest = sorted(ranges, key=lambda name: -ranges[name])[:SHOWN]
    return [one.name for one in courses if one.name in largest]


def send_couplings(stream: rr.RecordingStream, when: Clock, courses: Sequence[CouplingCourse]) -> None:
    """Forces and displacements as curves; those in view have colours of their own.

    Parameters
    ----------
    stream
        The recording.
    when
        Timelines of the n output times.
    courses
        The couplings at these times.
    """
    first = most_varying(courses)
    for number, course in enumerate(sorted(courses, key=lambda one: one.name not in first)):
        base = np.array(_COLOURS[number % len(_COLOURS)])
        for kind, values in course.values.items():
            for i, axis in enumerate(_AXES):
                entity = f"couplings/{kind}/{course.name}/{axis}"
                colour = np.rint(base + _LIGHT[axis] * (255 - base)).astype(int).tolist()
                style = rr.SeriesLines(colors=[colour], names=[f"{course.name} {axis}"], widths=[1.6])
                stream.log(entity, style, static=True)
                stream.send_columns(entity, when, rr.Scalars.columns(scalars=values[:, i]))
