"""Impossible rows of a contact log: NaN, values out of range, forces above friction; found and counted."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
import pyarrow
from numpy.typing import NDArray

from damage.log_input.states import UNITS

Chunk = dict[str, NDArray[np.float64]]
Mask = NDArray[np.bool_]

FRICTION_TOLERANCE = 0.01
"""Share by which creep forces may exceed friction times normal force [-]: theories that sum over cells miss
the limit by less than 1 % from 10 x 10 cells on; the demo's log stays below the limit itself."""

_SHOWN_TIMES = 3

# name, least value, whether the least value itself is allowed; of the loaded rows alone
_LOADED_RANGES = (
    ("a", 0.0, False),
    ("b", 0.0, False),
    ("p_max", 0.0, False),
    ("friction", 0.0, False),
)
_RANGES = (
    ("normal_force", 0.0, True),
    ("rolling_radius", 0.0, False),
    ("speed", 0.0, True),
)


@dataclass
class Fault:
    """One kind of fault: number of its rows, and its first case in words."""

    rows: int
    first: str


@dataclass
class BadRows:
    """Count of the bad rows of a log, filled while it is read.

    Attributes
    ----------
    total
        Rows read [-].
    count
        Bad rows among them [-].
    times
        The first times of bad rows [s], at most three; NaN where the time itself is the fault.
    faults
        Faults by kind; a row may have several.
    """

    total: int = 0
    count: int = 0
    times: list[float] = field(default_factory=list)
    faults: dict[str, Fault] = field(default_factory=dict)

    def sift(self, chunk: Chunk) -> Chunk:
        """The good rows of a chunk; the bad ones are counted."""
        size = chunk["time"].size
        bad = np.zeros(size, dtype=np.bool_)
        for kind, first, rows in _faults(chunk):
            bad |= rows
            known = self.faults.setdefault(kind, Fault(0, first))
            known.rows += int(rows.sum())
        self.total += size
        if not bad.any():
            return chunk
        self.count += int(bad.sum())
        for time in np.unique(chunk["time"][bad]):
            if len(self.times) < _SHOWN_TIMES and not any(_same(time, other) for other in self.times):
                self.times.append(float(time))
        return {name: values[~bad] for name, values in chunk.items()}

    def clear(self) -> None:
        """Begin again at the start of the log."""
        self.total, self.count = 0, 0
        self.times.clear()
        self.faults.clear()

    def __str__(self) -> str:
        times = ", ".join(f"{time:.6g}" for time in self.times)
        faults = (self.faults[kind] for kind in sorted(self.faults))
        found = "; ".join(f"{fault.first} ({fault.rows} such rows)" for fault in faults)
        return f"{self.count} of {self.total} rows are bad, the first at time = {times} s: {found}"

    def to_table(self) -> pyarrow.Table:
        """One row per kind of fault: rows, first case."""
        return pyarrow.table(
            {
                "fault": list(self.faults),
                "rows": [fault.rows for fault in self.faults.values()],
                "first": [fault.first for fault in self.faults.values()],
            }
        )


def _same(one: float, other: float) -> bool:
    return one == other or (math.isnan(one) and math.isnan(other))


def _faults(chunk: Chunk) -> Iterator[tuple[str, str, Mask]]:
    """Kind, first case in words, and rows of every fault that a chunk has."""
    for name, values in chunk.items():
        rows = ~np.isfinite(values)
        if rows.any():
            yield f"{name} not finite", f"{name} is NaN or infinite", rows
    loaded = chunk["normal_force"] > 0.0 if "normal_force" in chunk else np.ones(chunk["time"].size, np.bool_)
    for ranges, where in ((_RANGES, np.ones_like(loaded)), (_LOADED_RANGES, loaded)):
        for name, least, allowed in ranges:
            if name in chunk:
                unit = UNITS[name]
                values = chunk[name]
                rows = where & ((values < least) if allowed else (values <= least))
                wanted = f"must be {'>=' if allowed else '>'} {least:g} {unit}"
                yield from _out_of_range(chunk, name, unit, wanted, rows)
    if "contact_angle" in chunk:
        rows = np.abs(chunk["contact_angle"]) >= 0.5 * math.pi
        yield from _out_of_range(chunk, "contact_angle", "rad", "must lie within -pi/2..pi/2 rad", rows)
    if "side" in chunk:
        rows = ~np.isin(chunk["side"], (-1.0, 1.0)) & np.isfinite(chunk["side"])
        yield from _out_of_range(chunk, "side", "-", "must be +1 (left) or -1 (right)", rows)
    if {"force_x", "force_y", "normal_force", "friction"} <= chunk.keys():
        yield from _above_friction(chunk)


def _out_of_range(
    chunk: Chunk, name: str, unit: str, wanted: str, rows: Mask
) -> Iterator[tuple[str, str, Mask]]:
    rows = rows & np.isfinite(chunk[name])  # infinite values are a fault of their own
    if rows.any():
        first = int(np.argmax(rows))
        value, time = chunk[name][first], chunk["time"][first]
        yield (
            f"{name} out of range",
            f"{name} = {value:.6g} {unit} at time = {time:.6g} s {wanted}",
            rows,
        )


def _above_friction(chunk: Chunk) -> Iterator[tuple[str, str, Mask]]:
    """Creep forces that friction cannot transmit."""
    with np.errstate(invalid="ignore", over="ignore"):
        force = np.hypot(chunk["force_x"], chunk["force_y"])
        limit = chunk["friction"] * chunk["normal_force"]
        rows = (force > (1.0 + FRICTION_TOLERANCE) * limit) & np.isfinite(force) & (limit >= 0.0)
    if rows.any():
        first = int(np.argmax(rows))
        yield (
            "force above friction",
            f"creep force = {force[first]:.6g} N at time = {chunk['time'][first]:.6g} s must not exceed "
            f"friction times normal force = {limit[first]:.6g} N",
            rows,
        )
