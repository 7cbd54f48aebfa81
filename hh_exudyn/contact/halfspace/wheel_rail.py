"""A wheel on a rail as half-spaces over the curved surface of contact: pressure, force, place.

The overlap is that of `conformal`; influence is that of the half-space over x and the arc s (what CONTACT
does with a conformal reference surface and half-space influence). A coarse solution finds how far the wheel
comes down and where it touches; the fine one is solved there, from the coarse pressure.
"""

from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.silhouette import WheelRailPair
from hh_exudyn.contact.halfspace.conformal import ConformalOverlap, conformal_overlap
from hh_exudyn.contact.halfspace.influence import Grid, Influence
from hh_exudyn.contact.halfspace.normal import TOLERANCE, normal_contact
from hh_exudyn.contact.material import STEEL, Material

SPACING = (0.25e-3, 0.35e-3)  # m, of the elements along x and across
_COARSE = 2  # by which the first grid's elements are larger
_COARSE_TOLERANCE = 1e-3
_MARGIN = 2  # elements left free around the contact
_FIRST_LOWERING, _FIRST_LOAD = 0.15e-3, 150e3  # m under N: about what a wheel comes down
_MOST_TRIES = 12


@dataclass(frozen=True)
class ConformalContact:
    """Pressure between a wheel and a rail, and what follows from it.

    Attributes
    ----------
    influence : Influence
        Of the grid; `rolling.rolling_contact` goes on from it.
    x : ndarray, (nx,)
        In rolling direction from below the wheelset's centre [m].
    y_wheel, y_rail, angle : ndarray, (ny,)
        Places on the profiles [m] and angle of the normal [rad], side coordinates.
    point_y, point_z : ndarray, (ny,)
        Points of the silhouette from the wheelset's centre, axes of the rail's frame R [m].
    pressure : ndarray, (ny, nx)
        [Pa]
    side : float
        +1 left, -1 right.
    lowering : float
        How far the wheel stands below the height of its pair [m].
    vertical, outwards : float
        Force on the rail, downwards and away from the track centre [N].
    residual : float
        As of `normal.NormalSolution`.
    """

    influence: Influence
    x: FloatArray
    y_wheel: FloatArray
    y_rail: FloatArray
    angle: FloatArray
    point_y: FloatArray
    point_z: FloatArray
    pressure: FloatArray
    side: float
    lowering: float
    vertical: float
    outwards: float
    residual: float

    @property
    def max_pressure(self) -> float:
        """Largest pressure [Pa]."""
        return float(self.pressure.max())

    @property
    def normal_force(self) -> float:
        """Resultant of vertical and lateral force [N]."""
        return float(np.hypot(self.vertical, self.outwards))

    @property
    def area(self) -> float:
        """Of contact [m^2]."""
        return float(np.count_nonzero(self.pressure)) * self.influence.grid.area


@dataclass(frozen=True)
class _Window:
    """Part of the overlap that a grid covers: strips and places along x."""

    first: int
    count: int
    middle: float
    along: int

    def x(self, spacing: float) -> FloatArray:
        """Places along x [m]."""
        places = (np.arange(self.along) - 0.5 * (self.along - 1)) * spacing
        return np.asarray(self.middle + places, dtype=np.float64)


def _overlapping(overlap: ConformalOverlap, lowering: float, spacing: float) -> _Window | None:
    """The window of all strips that overlap after lowering; contact lies inside of it."""
    depth = overlap.overlap + lowering * np.cos(overlap.angle)
    strips = np.flatnonzero(depth > 0.0)
    if strips.size == 0:
        return None
    first, last = int(strips[0]), int(strips[-1])
    reach = np.sqrt(depth[strips] / overlap.curvature[strips])
    low, high = (overlap.crest[strips] - reach).min(), (overlap.crest[strips] + reach).max()
    along = max(int(np.ceil((high - low) / spacing)), 1)
    return _Window(first, last - first + 1, 0.5 * float(low + high), along)


def _around(
    pressure: FloatArray, coarse: _Window, coarse_spacing: tuple[float, float], overlap: ConformalOverlap,
    spacing: float,
) -> _Window:  # fmt: skip
    """The fine window around the contact of a coarse solution."""
    rows = np.flatnonzero(pressure.any(axis=1))
    columns = np.flatnonzero(pressure.any(axis=0))
    ratio = coarse_spacing[1] / overlap.spacing
    first = int((coarse.first + rows[0] - 1) * ratio)
    last = int(np.ceil((coarse.first + rows[-1] + 2) * ratio))
    first, last = max(first, 0), min(last, overlap.overlap.size)
    x = coarse.x(coarse_spacing[0])
    low, high = x[columns[0]] - coarse_spacing[0], x[columns[-1]] + coarse_spacing[0]
    along = int(np.ceil((high - low) / spacing)) + _MARGIN
    return _Window(first, last - first, 0.5 * float(low + high), along)


def _touches_border(pressure: FloatArray) -> bool:
    """Whether any element at the grid's border is in contact."""
    return bool(pressure[0].any() or pressure[-1].any() or pressure[:, 0].any() or pressure[:, -1].any())


def _nearest(values: FloatArray, rows: FloatArray, columns: FloatArray) -> FloatArray:
    """Values of a coarse grid at the nearest of its elements, zero outside of it."""
    row, column = np.rint(rows).astype(int), np.rint(columns).astype(int)
    inside = ((row >= 0) & (row < values.shape[0]))[:, None] & ((column >= 0) & (column < values.shape[1]))
    taken = values[np.clip(row, 0, values.shape[0] - 1)[:, None], np.clip(column, 0, values.shape[1] - 1)]
    return np.where(inside, taken, 0.0)


def _coarse(
    overlap: ConformalOverlap, spacing: float, material: Material, load: float | None, limit: float
) -> tuple[FloatArray, _Window, float] | None:
    """Pressure, window and lowering on a coarse grid; None without contact at the given height."""
    guess = 0.0 if load is None else overlap.touching + _FIRST_LOWERING * (load / _FIRST_LOAD) ** (2.0 / 3.0)
    for _ in range(_MOST_TRIES):
        window = _overlapping(overlap, guess, spacing)
        if window is None:
            return None
        influence = Influence(Grid(window.along, window.count, spacing, overlap.spacing), material)
        strips = slice(window.first, window.first + window.count)
        field = overlap.field(window.first, window.count, window.x(spacing))
        weight = np.repeat(np.cos(overlap.angle[strips])[:, None], window.along, axis=1)
        if load is None:
            solved = normal_contact(
                influence, field, approach=0.0, weight=weight, limit=limit, tolerance=_COARSE_TOLERANCE
            )
            return solved.pressure, window, 0.0
        if load < limit * influence.grid.area * float(weight.sum()):
            solved = normal_contact(
                influence, field, load=load, weight=weight, limit=limit, tolerance=_COARSE_TOLERANCE
            )
            if solved.approach <= guess:
                return solved.pressure, window, solved.approach
        guess = overlap.touching + 1.5 * (guess - overlap.touching)
    raise ArithmeticError(f"load = {load} N: no height carries it; the wheel lies beside its rail")


def conformal_contact(
    pair: WheelRailPair,
    *,
    load: float | None = None,
    spacing: tuple[float, float] = SPACING,
    material: Material = STEEL,
    limit: float = np.inf,
    tolerance: float = TOLERANCE,
) -> ConformalContact | None:
    """Pressure of a wheel on its rail, at the pair's height or under a given vertical load.

    Parameters
    ----------
    pair : WheelRailPair
        Profiles and pose (`geometry.silhouette.wheel_rail_pair`, `wheel_above_rail`).
    load : float, optional
        Vertical force [N], > 0; then the wheel is lowered (or lifted) until it carries it. Without it the
        height is that of the pair.
    spacing : tuple of float
        Sides of an element along x and across [m].
    material : Material
        Of both bodies.
    limit : float
        Upper bound of the pressure [Pa].
    tolerance : float
        As of `normal.normal_contact`.

    Returns
    -------
    ConformalContact or None
        None where the wheel does not touch.

    Raises
    ------
    ValueError
        For an argument out of range.
    ArithmeticError
        Where no height carries the load.
    """
    if load is not None and not 0.0 < load < np.inf:
        raise ValueError(f"load = {load} N; it must be finite and > 0 N")
    overlap = conformal_overlap(pair, spacing[1])
    coarse_spacing = (_COARSE * spacing[0], _COARSE * spacing[1])
    rough = conformal_overlap(pair, coarse_spacing[1])
    found = _coarse(rough, coarse_spacing[0], material, load, limit)
    if found is None or not found[0].any():
        return None
    pressure, coarse, _ = found
    window = _around(pressure, coarse, coarse_spacing, overlap, spacing[0])
    for _ in range(_MOST_TRIES):
        strips = slice(window.first, window.first + window.count)
        x = window.x(spacing[0])
        influence = Influence(Grid(window.along, window.count, *spacing), material)
        weight = np.repeat(np.cos(overlap.angle[strips])[:, None], window.along, axis=1)
        rows = (np.arange(window.first, window.first + window.count) + 0.5) / _COARSE - 0.5 - coarse.first
        columns = (x - coarse.x(coarse_spacing[0])[0]) / coarse_spacing[0]
        solved = normal_contact(
            influence, overlap.field(window.first, window.count, x),
            approach=0.0 if load is None else None, load=load, weight=weight, limit=limit,
            start=_nearest(pressure, rows, columns), tolerance=tolerance,
        )  # fmt: skip
        if not _touches_border(solved.pressure):
            break
        first = max(window.first - 4, 0)
        last = min(window.first + window.count + 4, overlap.overlap.size)
        window = _Window(first, last - first, window.middle, window.along + 8)
    force = solved.pressure.sum(axis=1) * influence.grid.area
    angle = overlap.angle[strips]
    return ConformalContact(
        influence=influence, x=x, y_wheel=overlap.y_wheel[strips], y_rail=overlap.y_rail[strips],
        angle=angle, point_y=overlap.point_y[strips], point_z=overlap.point_z[strips],
        pressure=solved.pressure, side=pair.side, lowering=solved.approach,
        vertical=float(force @ np.cos(angle)), outwards=-float(force @ np.sin(angle)),
        residual=solved.residual,
    )  # fmt: skip
