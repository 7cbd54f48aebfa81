"""A run in a handful of numbers: the largest over its wheels of what judges a vehicle, to compare runs by.

Forces, attack and damage drivers are means over elements of the track (`damage.summary`), the largest of all
wheels and elements; tread wear is the deepest of a wheel over the whole run (`damage.report`).
"""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import pyarrow

from damage.summary import WheelsetSummary
from hh_exudyn.conventions import LEFT


class Extreme(NamedTuple):
    """The largest value of a quantity among the wheels of a run, and the elements of its track."""

    quantity: str
    unit: str
    value: float
    wheel: str  # "1L", or the number of the wheelset, and where: "1L@100m" on the element that begins there


_PER_WHEEL: dict[str, tuple[str, float, Callable[[WheelsetSummary], tuple[float, float]]]] = {
    "Q": ("kN", 1e-3, lambda row: row.Q),
    "Y": ("kN", 1e-3, lambda row: row.Y),
    "Y/Q": ("-", 1.0, lambda row: row.y_over_q),
    "wear number": ("N", 1.0, lambda row: row.wear_number),
    "p_max": ("MPa", 1e-6, lambda row: row.p_max),
    "FI>0": ("%", 100.0, lambda row: row.fatigue_share),
}


def extremes(elements: Mapping[float, Sequence[WheelsetSummary]], wear: pyarrow.Table) -> list[Extreme]:
    """Largest Q, Y (outwards), Y/Q, angle of attack (either way), wear number, p_max, FI > 0, tread wear.

    Parameters
    ----------
    elements : mapping
        Of the track of a run: beginning [m], and its summaries by `damage.summary.stretch_summaries`.
    wear : pyarrow.Table
        Of the same run, by `damage.report.DamageReport.to_table`.
    """
    numbers = sorted({(row.vehicle, row.wheelset) for rows in elements.values() for row in rows})

    def place(row: WheelsetSummary, side: str, start: float) -> str:
        return f"{numbers.index((row.vehicle, row.wheelset)) + 1}{side}@{start:.0f}m"

    found = []
    for quantity, (unit, factor, of) in _PER_WHEEL.items():
        values = {
            place(row, side, start): factor * of(row)[s]
            for start, rows in elements.items()
            for row in rows
            for s, side in enumerate("LR")
        }
        found.append(_largest(quantity, unit, values))
    attack = {
        place(row, "", start): 1e3 * abs(row.angle_of_attack)
        for start, rows in elements.items()
        for row in rows
    }
    found.insert(3, _largest("angle of attack", "mrad", attack))
    return [*found, _largest("tread wear", "mm/1000 km", _tread_wear(wear))]


def _tread_wear(table: pyarrow.Table) -> dict[str, float]:
    """Deepest tread wear of every wheel."""
    vehicles, wheelsets, sides, depth = (
        table[name].to_pylist() for name in ("vehicle", "wheelset", "side", "wear_depth_mm_per_1000_km")
    )
    order = sorted(set(zip(vehicles, wheelsets, strict=True)))
    return {
        f"{order.index((vehicle, wheelset)) + 1}{'L' if side == LEFT else 'R'}": float(value)
        for vehicle, wheelset, side, value in zip(vehicles, wheelsets, sides, depth, strict=True)
    }


def _largest(quantity: str, unit: str, values: dict[str, float]) -> Extreme:
    """The largest of the finite values."""
    finite = {wheel: value for wheel, value in values.items() if np.isfinite(value)}
    if not finite:
        return Extreme(quantity, unit, float("nan"), "")
    wheel = max(finite, key=lambda name: finite[name])
    return Extreme(quantity, unit, finite[wheel], wheel)
