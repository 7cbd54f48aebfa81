"""Impossible rows of a contact log: NaN, values out of range, forces above friction, rows twice; counted."""

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

# name, least value, whether the least value itself is allowed, largest value. Beyond the largest
# it is no contact of wheel and rail, however bad (assumed: a spinning wheel has creepages of some units, a
# flange a spin of some 1/m, a heavy wheel 200 kN, a sharp edge some 10 GPa). Of the loaded rows alone:
_LOADED_RANGES = (
    ("a", 0.0, False, 0.2),
    ("b", 0.0, False, 0.2),
    ("p_max", 0.0, False, 100e9),
    ("friction", 0.0, False, 2.0),
)
_RANGES = (
    ("normal_force", 0.0, True, 10e6),
    ("rolling_radius", 0.05, True, 2.0),
    ("speed", 0.0, True, 200.0),
)
_SIZES = (
    ("nu_x", 20.0),
    ("nu_y", 5.0),
    ("phi", 20.0),
    ("y_wheel", 0.5),
    ("moment_z", 1e6),
)  # of either sign
_NUMBERED = (("vehicle", 1000), ("bogie", 64), ("wheelset", 64))  # whole numbers from 1 to these
_ROW = ("time", "vehicle", "wheelset", "side", "patch")  # of which a log has one row


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
    ordered
        Whether the log is in order of time: the rows of its last time alone are remembered, else all.
    """

    total: int = 0
    count: int = 0
    times: list[float] = field(default_factory=list)
    faults: dict[str, Fault] = field(default_factory=dict)
    ordered: bool = True
    _read: set[tuple[float, ...]] = field(
        default_factory=set, repr=False
    )  # rows of times that may come again

    def sift(self, chunk: Chunk) -> Chunk:
        """The good rows of a chunk; the bad ones are counted."""
        size = chunk["time"].size
        bad = np.zeros(size, dtype=np.bool_)
        for kind, first, rows in (*_faults(chunk), *self._twice(chunk)):
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

    def _twice(self, chunk: Chunk) -> Iterator[tuple[str, str, Mask]]:
        """Rows of a wheel, patch and time that was there before; only where the patch is read."""
        if not chunk.keys() >= set(_ROW) or chunk["time"].size == 0:
            return
        keys = np.column_stack([chunk[name] for name in _ROW])
        before = max((key[0] for key in self._read), default=-math.inf)
        if self.ordered and np.any(keys[:, 0] < np.concatenate([[before], keys[:-1, 0]])):
            return  # not in order of time: such a log is read once more, with all rows in mind
        _, first, place = np.unique(keys, axis=0, return_index=True, return_inverse=True)
        rows = first[place.ravel()] != np.arange(len(keys))
        again = keys[:, 0] == before if self.ordered else np.ones(len(keys), np.bool_)
        for row in np.flatnonzero(again):
            rows[row] |= tuple(keys[row]) in self._read
        if self.ordered:
            last = {tuple(key) for key in keys[keys[:, 0] == keys[-1, 0]]}
            self._read = last | self._read if before == keys[-1, 0] else last
        else:
            self._read.update(map(tuple, keys))
        if rows.any():
            time, vehicle, wheelset, side, patch = keys[np.argmax(rows)]
            yield (
                "row twice",
                f"vehicle {vehicle:g}, wheelset {wheelset:g}, side {side:+g}, patch {patch:g} has another row"
                f" at time = {time:.6g} s",
                rows,
            )

    def clear(self, ordered: bool = True) -> None:
        """Begin again at the start of the log; `ordered` as above."""
        self.total, self.count, self.ordered = 0, 0, ordered
        self._read.clear()
        self.times.clear()
        self.faults.clear()

    def __str__(self) -> str:
        times = ", ".join(f"{time:.6g}" for time in self.times)
        faults = (self.faults[kind] for kind in sorted(self.faults))
        found = "; ".join(f"{fault.first} ({fault.rows} such rows)" for fault in faults)
        first = f", the first at time = {times} s" if times else ""
        return f"{self.count} of {self.total} rows are bad{first}: {found}"

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
        for name, least, allowed, largest in ranges:
            if name in chunk:
                unit = UNITS[name]
                values = chunk[name]
                low = where & ((values < least) if allowed else (values <= least))
                wanted = f"must be {'>=' if allowed else '>'} {least:g} {unit}"
                yield from _out_of_range(chunk, name, unit, wanted, low)
                wanted = f"must be <= {largest:g} {unit}"
                yield from _out_of_range(chunk, name, unit, wanted, where & (values > largest))
    for name, size in _SIZES:
        if name in chunk:
            wanted = f"must lie within -{size:g}..{size:g} {UNITS[name]}"
            yield from _out_of_range(chunk, name, UNITS[name], wanted, np.abs(chunk[name]) > size)
    for name, most in _NUMBERED:
        if name in chunk:
            values = chunk[name]
            rows = (values < 1.0) | (values > most) | (values != np.rint(values))
            yield from _out_of_range(chunk, name, "-", f"must be a whole number from 1 to {most}", rows)
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
