"""Forces and displacements of couplings from their log: mean, least and largest, by element of the track.

The log has the couplings that the case names (``integration.logged_couplings``); forces act on body B in the
axes of body A (`hh_exudyn.log.channels`). An element counts while the car body's centre is on it.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import pyarrow

from hh_exudyn.arrays import FloatArray
from hh_exudyn.assessment.sections import AssessedSection
from hh_exudyn.log.channels import COUPLINGS
from hh_exudyn.log.parts import part_paths
from hh_exudyn.log.store import Run

COMPONENTS = {column.name: column.unit for column in COUPLINGS if column.name not in ("time", "coupling")}
WHOLE_RUN = "whole run"


@dataclass(frozen=True)
class CouplingRange:
    """One component of one coupling over the run or an element of the track.

    Attributes
    ----------
    coupling : str
        Its name.
    element : str
        "whole run", or title of the element, "curve R 450 m left".
    start, end : float
        Arc lengths of the car body's centre [m].
    component, unit : str
        "force_z", "N"; "moment_x", "N m"; "displacement_y", "m".
    mean, least, largest : float
        In that unit.
    """

    coupling: str
    element: str
    start: float
    end: float
    component: str
    unit: str
    mean: float
    least: float
    largest: float


def has_couplings(run: Run) -> bool:
    """Whether the run has logged couplings."""
    return bool(part_paths(run.directory, "couplings"))


def coupling_ranges(run: Run, elements: Sequence[AssessedSection] = ()) -> list[CouplingRange]:
    """Ranges of all logged couplings over the whole run, then over each element; none without their log.

    Parameters
    ----------
    run : Run
        On disk.
    elements : sequence of AssessedSection
        Of its track.
    """
    if not has_couplings(run):
        return []
    table = run.read("couplings")
    times = table["time"].to_numpy()
    names = np.asarray(table["coupling"].to_pylist(), dtype=str)
    values = {name: table[name].to_numpy() for name in COMPONENTS}
    ledger = run.read("energy", ["time", "s"])
    s = np.interp(times, ledger["time"].to_numpy(), ledger["s"].to_numpy())
    order, numbers = np.unique(names, return_index=True)
    order = order[np.argsort(numbers)]  # as logged
    places = {name: np.flatnonzero(names == name) for name in order.tolist()}
    whole = (WHOLE_RUN, float(s.min()), float(s.max()))
    stretches = [whole, *((element.title, element.start, element.end) for element in elements)]
    return [
        found
        for stretch in stretches
        for name, rows in places.items()
        for found in _ranges(name, {key: own[rows] for key, own in values.items()}, s[rows], stretch)
    ]


def _ranges(
    name: str, values: dict[str, FloatArray], s: FloatArray, stretch: tuple[str, float, float]
) -> Iterator[CouplingRange]:
    """All components of a coupling on a stretch, none where the run never was."""
    title, start, end = stretch
    there = (s >= start) & (s <= end)
    if not there.any():
        return
    for component, unit in COMPONENTS.items():
        own = values[component][there]
        mean, least, most = float(own.mean()), float(own.min()), float(own.max())
        yield CouplingRange(name, title, start, end, component, unit, mean, least, most)


def to_table(ranges: Sequence[CouplingRange]) -> pyarrow.Table:
    """All ranges, a row each, SI."""
    texts = ("coupling", "element", "component", "unit")
    names = ("coupling", "element", "start_m", "end_m", "component", "unit", "mean", "min", "max")
    rows = [
        {
            "coupling": one.coupling, "element": one.element, "start_m": one.start, "end_m": one.end,
            "component": one.component, "unit": one.unit, "mean": one.mean, "min": one.least,
            "max": one.largest,
        }
        for one in ranges
    ]  # fmt: skip
    schema = pyarrow.schema((name, "string" if name in texts else "float64") for name in names)
    return pyarrow.Table.from_pylist(rows, schema=schema)
