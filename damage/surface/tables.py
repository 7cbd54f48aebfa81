"""Surfaces as tables, and as arrays with labelled axes; the largest differences of two surfaces.

One table says for every sum which axes it has and its unit (`SUMS`): of it the others are made.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pyarrow
from numpy.typing import NDArray

from damage.rcf.subsurface import LEVEL_STEP, LEVELS
from damage.surface.wheel_surface import WheelSurface

PARTS = ("tread", "flange")  # axis of 2
UNIT_NAMES = {"m": "m", "m^2": "m2", "m^3": "m3", "s": "s", "-": "", "Pa": "Pa", "J": "J"}


class Sum(NamedTuple):
    """Axes of a sum after that of the wheels, and its unit."""

    axes: tuple[str, ...]
    unit: str


SUMS = {
    "depth_by_part": Sum(("part", "s"), "m"),
    "worn_area": Sum(("s",), "m^2"),
    "worn_volume": Sum(("regime",), "m^3"),
    "contact_time": Sum(("part", "s"), "s"),
    "fatigue_time": Sum(("part", "s"), "s"),
    "contact_revolutions": Sum(("part", "s"), "-"),
    "fatigue_revolutions": Sum(("part", "s"), "-"),
    "ratchet_revolutions": Sum(("part", "s"), "-"),
    "crack_damage": Sum(("part", "s"), "-"),
    "global_crack_damage": Sum(("part", "s"), "-"),
    "rcf_number": Sum(("part", "s", "x"), "-"),
    "corrected_rcf_number": Sum(("part", "s", "x"), "-"),
    "energy": Sum(("part", "s", "x"), "Pa"),
    "patch_time": Sum(("part",), "s"),
    "positive_time": Sum(("part",), "s"),
    "index_area": Sum(("part",), "s"),
    "friction_area": Sum(("part",), "s"),
    "subsurface_revolutions": Sum(("part", "level"), "-"),
    "work": Sum((), "J"),
    "pressure_by_part": Sum(("part",), "Pa"),
}


@dataclass(frozen=True, eq=False)
class Axis:
    """An axis of an array.

    Attributes
    ----------
    name
        ``wheel``; ``part`` (tread, flange); ``regime`` of the wear law; ``s`` along the surface or, on a grid
        without a profile, laterally; ``x`` along the patch; ``level`` of FI_sub, by its lower bound.
    unit
        Of its labels; "-" for names and numbers.
    labels
        One for every place: wheels as "vehicle.wheelset" and side ("1.2L"), middles of bins.
    """

    name: str
    unit: str
    labels: NDArray[np.generic]


@dataclass(frozen=True, eq=False)
class LabelledArray:
    """A sum with its axes.

    Attributes
    ----------
    name, unit
        Of the sum.
    values
        One axis of `axes` each.
    axes
        In the order of the array.
    """

    name: str
    unit: str
    values: NDArray[np.float64]
    axes: tuple[Axis, ...]


class Difference(NamedTuple):
    """How far two surfaces are apart in a sum: the largest difference, and over the largest value."""

    largest: float
    relative: float


def labelled(surface: WheelSurface, name: str) -> LabelledArray:
    """One of the sums with labelled axes.

    Parameters
    ----------
    surface
        Of the wheels.
    name
        One of `SUMS`.

    Raises
    ------
    ValueError
        There is no such sum.
    """
    if name not in SUMS:
        raise ValueError(f"a surface has no sum {name!r}; it has {', '.join(SUMS)}")
    values: NDArray[np.float64] = getattr(surface, name)
    axes = [Axis("wheel", "-", np.array(_wheel_names(surface)))]
    for axis, size in zip(SUMS[name].axes, values.shape[1:], strict=True):
        axes.append(_axis(surface, axis, size))
    return LabelledArray(name, SUMS[name].unit, values, tuple(axes))


def wheel_table(surface: WheelSurface) -> pyarrow.Table:
    """One row per wheel and part of it (tread, flange): the sums that have no place on the profile.

    Sums that are not separated by part (work, worn volume by regime) stand in the row of the tread, with 0 in
    that of the flange: so every column adds up to the sum of the wheel.
    """
    table = _rows(surface, ("part",))
    for name, (axes, unit) in SUMS.items():
        values = getattr(surface, name)
        if axes == ("part",):
            table[_column(name, unit)] = values.ravel()
        elif axes in ((), ("regime",)):
            for number, of_wheel in enumerate(values.reshape(len(surface.wheels), -1).T, 1):
                regime = f"_{number}" if axes else ""
                both = np.column_stack([of_wheel, np.zeros_like(of_wheel)])
                table[_column(name + regime, unit)] = both.ravel()
    return pyarrow.table(table)


def profile_table(surface: WheelSurface) -> pyarrow.Table:
    """One row per wheel and bin across the profile: place ``s_m`` and ``y_m``, and the sums there.

    Sums by part have two columns, ``..._tread_...`` and ``..._flange_...``; those along the patch are in
    `patch_table`.
    """
    table = _rows(surface, ("s",))
    table["y_m"] = np.tile(surface.grid.lateral, len(surface.wheels))
    for name, (axes, unit) in SUMS.items():
        values = getattr(surface, name)
        if axes == ("s",):
            table[_column(name, unit)] = values.ravel()
        elif axes == ("part", "s"):
            for part, label in enumerate(PARTS):
                table[_column(f"{name.removesuffix('_by_part')}_{label}", unit)] = values[:, part].ravel()
    return pyarrow.table(table)


def patch_table(surface: WheelSurface) -> pyarrow.Table:
    """One row per wheel, part, bin across the profile and bin along the patch where a sum is not zero."""
    axes = ("part", "s", "x")
    names = [name for name, one in SUMS.items() if one.axes == axes]
    some = np.any([getattr(surface, name) != 0.0 for name in names], axis=0).ravel()
    table = {name: values[some] for name, values in _rows(surface, axes).items()}
    for name in names:
        table[_column(name, SUMS[name].unit)] = getattr(surface, name).ravel()[some]
    return pyarrow.table(table)


def level_table(surface: WheelSurface) -> pyarrow.Table:
    """One row per wheel, part and level of FI_sub in which it has turned: its lower bound ``level_Pa``."""
    axes, some = ("part", "level"), surface.subsurface_revolutions.ravel() > 0.0
    table = {name: values[some] for name, values in _rows(surface, axes).items()}
    table["subsurface_revolutions"] = surface.subsurface_revolutions.ravel()[some]
    return pyarrow.table(table)


def differences(one: WheelSurface, other: WheelSurface) -> dict[str, Difference]:
    """Largest differences of two surfaces by sum, and relative to the largest value of either.

    Parameters
    ----------
    one, other
        Of the same wheels on the same grids.

    Raises
    ------
    ValueError
        Wheels or grids differ.
    """
    for what in ("grid", "patch_grid", "wheels"):
        if getattr(one, what) != getattr(other, what):
            raise ValueError(f"surfaces of another {what} cannot be compared")
    found = {}
    for name in (*SUMS, "rows", "time", "distance"):
        a, b = np.asarray(getattr(one, name)), np.asarray(getattr(other, name))
        largest = float(np.max(np.abs(a - b), initial=0.0))
        scale = max(float(np.max(np.abs(a), initial=0.0)), float(np.max(np.abs(b), initial=0.0)))
        found[name] = Difference(largest, largest / scale if scale > 0.0 else 0.0)
    return found


def _axis(surface: WheelSurface, name: str, size: int) -> Axis:
    if name == "part":
        return Axis(name, "-", np.array(PARTS))
    if name == "regime":
        return Axis(name, "-", np.arange(1, size + 1))
    if name == "level":
        return Axis(name, "Pa", LEVEL_STEP * np.arange(size))
    if name == "s":
        return Axis(name, "m", surface.grid.centres)
    edges = surface.patch_grid.edges
    return Axis(name, "m", 0.5 * (edges[:-1] + edges[1:]))


def _rows(surface: WheelSurface, axes: Sequence[str]) -> dict[str, NDArray[np.generic]]:
    """The columns that name a row: wheel, and its place on each of the axes."""
    sizes = {"part": 2, "level": LEVELS, "s": surface.grid.count, "x": surface.patch_grid.count}
    shape = (len(surface.wheels), *(sizes[axis] for axis in axes))
    wheels = np.array(surface.wheels, dtype=np.int32).reshape(-1, 4)
    index = np.indices(shape).reshape(len(shape), -1)
    names = ("vehicle", "bogie", "wheelset", "side")
    table: dict[str, NDArray[np.generic]] = {name: wheels[index[0], k] for k, name in enumerate(names)}
    for place, axis in zip(index[1:], axes, strict=True):
        whole = _axis(surface, axis, sizes[axis])
        table[_column(axis, whole.unit)] = whole.labels[place]
    return table


def _column(name: str, unit: str) -> str:
    """Name of a column, with its unit."""
    short = UNIT_NAMES[unit]
    return f"{name}_{short}" if short else name


def _wheel_names(surface: WheelSurface) -> list[str]:
    return [f"{one.vehicle}.{one.wheelset}{'L' if one.side > 0 else 'R'}" for one in surface.wheels]
