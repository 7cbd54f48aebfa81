"""A wheel on a rail as half-spaces over the curved surface of contact: pressure, force, place.

The overlap is that of `conformal`; influence is that of the half-space over x and the arc s (what CONTACT
does with a conformal reference surface and half-space influence). A coarse solution finds how far the wheel
comes down and where it touches; the fine one is solved there, from the coarse pressure.
"""

from dataclasses import dataclass, replace

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
_STEP = 8  # elements, of a grid's size
_FIRST_LOWERING, _FIRST_LOAD = 0.15e-3, 150e3  # m under N: about what a wheel comes down
_MOST_TRIES = 12
_LEAST_SHARE = 0.05  # of a strip's normal in the direction of the load; strips that face away cannot touch


@dataclass(frozen=True)
class Pressing:
    """A load that presses a wheel on its rail.

    Attributes
    ----------
    load : float
        Component of the force of the pressures in its direction [N], > 0.
    angle : float
        Of that direction against the vertical, like the contact angle positive on the flange [rad], within
        -pi/2 .. pi/2: the wheel moves along it.
    within : tuple of float
        Places on the wheel (side coordinates) between which it may touch [m].
    beside : tuple of ConformalContact
        Other contacts of the same wheel, outside of these places: their forces displace the surface here.
    """

    load: float
    angle: float = 0.0
    within: tuple[float, float] = (-np.inf, np.inf)
    beside: "tuple[ConformalContact, ...]" = ()

    def __post_init__(self) -> None:
        if not 0.0 < self.load < np.inf:
            raise ValueError(f"load = {self.load} N; it must be finite and > 0 N")
        if not abs(self.angle) < 0.5 * np.pi:
            raise ValueError(f"angle = {self.angle} rad; it must lie within -pi/2 .. pi/2 rad")
        if not self.within[0] < self.within[1]:
            raise ValueError(f"within = {self.within} m; the first place must be less than the second")


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
    radius : ndarray, (ny,)
        Rolling radius of the strips [m].
    crest : ndarray, (ny,)
        Where along x the strips touch first [m].
    side : float
        +1 left, -1 right.
    lowering : float
        How far the wheel stands below the height of its pair, in the direction of the load [m].
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
    radius: FloatArray
    crest: FloatArray
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
class _Found:
    """A solution to start from: pressure at places on the wheel and along x."""

    y_wheel: FloatArray
    x: FloatArray
    pressure: FloatArray
    spacing: float


@dataclass(frozen=True)
class _Task:
    """What is asked for: arguments of `conformal_contact` and the overlap."""

    overlap: ConformalOverlap
    spacing: tuple[float, float]
    material: Material
    pressing: Pressing | None
    limit: float
    tolerance: float

    @property
    def load(self) -> float | None:
        """Of the pressing [N]."""
        return None if self.pressing is None else self.pressing.load

    def field(self, window: "_Window") -> FloatArray:
        """Overlap in the elements of a window, less the displacement by other contacts of the wheel [m]."""
        x = window.x(self.spacing[0])
        field = self.overlap.field(window.first, window.count, x)
        for other in () if self.pressing is None else self.pressing.beside:
            field -= self._displacement(other, window, x)
        return field

    def _displacement(self, other: "ConformalContact", window: "_Window", x: FloatArray) -> FloatArray:
        """Of the window's elements by the forces of another contact, a point load for each of its strips [m].

        Boussinesq's (K.L. Johnson, Contact Mechanics, 1985, equation 3.22a), both bodies together.
        """
        order = 1 if self.overlap.side < 0.0 else -1  # of y on the wheel along the arc
        arc = self.overlap.spacing * np.arange(self.overlap.y_wheel.size)
        place = np.interp(other.y_wheel, self.overlap.y_wheel[::order], arc[::order])
        strips = other.pressure.any(axis=1)
        force = other.pressure[strips].sum(axis=1) * other.influence.grid.area
        middle = other.pressure[strips] @ other.x * other.influence.grid.area / force
        away = arc[window.first : window.first + window.count, None, None] - place[strips]
        distance = np.hypot(x[None, :, None] - middle, away)
        flexibility = (1.0 - self.material.poisson_ratio) / (np.pi * self.material.shear_modulus)
        displacement: FloatArray = flexibility * (force / np.maximum(distance, self.spacing[1])).sum(axis=2)
        return displacement

    @property
    def share(self) -> FloatArray:
        """Of every strip's normal in the direction of the load [-]."""
        return _shares(self.overlap, self.pressing)


def _shares(overlap: ConformalOverlap, pressing: Pressing | None) -> FloatArray:
    """Share of every strip's normal in the direction of the load, of vertical without one [-]."""
    angle = 0.0 if pressing is None else pressing.angle
    share: FloatArray = np.maximum(np.cos(overlap.angle + angle), _LEAST_SHARE)
    return share


def _limited(overlap: ConformalOverlap, pressing: Pressing | None) -> ConformalOverlap:
    """The overlap without strips that may not touch."""
    if pressing is None or not np.any(np.isfinite(pressing.within)):
        return overlap
    low, high = pressing.within
    inside = (overlap.y_wheel >= low) & (overlap.y_wheel <= high)
    return replace(overlap, overlap=np.where(inside, overlap.overlap, -np.inf))


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


def _window(first: int, count: int, middle: float, along: int, strips: int) -> _Window:
    """A window of `strips` with at least these numbers of elements, in steps.

    So that few shapes occur and the transforms of one solution serve the next.
    """
    wanted = min(-(-count // _STEP) * _STEP, strips)
    begin = min(max(first - (wanted - count) // 2, 0), strips - wanted)
    return _Window(begin, wanted, middle, -(-along // _STEP) * _STEP)


def _overlapping(
    overlap: ConformalOverlap, share: FloatArray, lowering: float, spacing: float
) -> _Window | None:
    """The window of all strips that overlap after lowering; contact lies inside of it."""
    depth = overlap.overlap + lowering * share
    strips = np.flatnonzero(depth > 0.0)
    if strips.size == 0:
        return None
    first, last = int(strips[0]), int(strips[-1])
    reach = np.sqrt(depth[strips] / overlap.curvature[strips])
    low, high = (overlap.crest[strips] - reach).min(), (overlap.crest[strips] + reach).max()
    along = max(int(np.ceil((high - low) / spacing)), 1)
    return _window(first, last - first + 1, 0.5 * float(low + high), along, overlap.overlap.size)


def _around(found: _Found, overlap: ConformalOverlap, spacing: float) -> _Window:
    """The window around the contact of a solution on another grid."""
    rows, columns = np.flatnonzero(found.pressure.any(axis=1)), np.flatnonzero(found.pressure.any(axis=0))
    spare = abs(found.y_wheel[1] - found.y_wheel[0]) if found.y_wheel.size > 1 else overlap.spacing
    y = found.y_wheel[rows]
    inside = np.flatnonzero(
        (overlap.y_wheel >= y.min() - _MARGIN * spare) & (overlap.y_wheel <= y.max() + _MARGIN * spare)
    )
    low, high = found.x[columns[0]] - found.spacing, found.x[columns[-1]] + found.spacing
    along = int(np.ceil((high - low) / spacing)) + _MARGIN
    return _window(int(inside[0]), inside.size, 0.5 * float(low + high), along, overlap.overlap.size)


def _touches_border(pressure: FloatArray) -> bool:
    """Whether any element at the grid's border is in contact."""
    return bool(pressure[0].any() or pressure[-1].any() or pressure[:, 0].any() or pressure[:, -1].any())


def _carried(
    values: FloatArray, old: tuple[FloatArray, FloatArray], new: tuple[FloatArray, FloatArray]
) -> FloatArray:
    """Values (..., rows, columns) at places (y on the wheel, x): of the nearest other place, or zero."""
    taken = []
    for before, after in zip(old, new, strict=True):
        order = 1 if before.size < 2 or before[-1] > before[0] else -1
        place = np.interp(after, before[::order], np.arange(before.size)[::order], left=-1.0, right=-1.0)
        taken.append(np.rint(place).astype(int))
    rows, columns = taken
    found: FloatArray = values[..., rows[:, None], columns]
    return np.where((rows >= 0)[:, None] & (columns >= 0), found, 0.0)


def carry_over(values: FloatArray, old: ConformalContact, new: ConformalContact) -> FloatArray:
    """Values on the grid of one contact, brought to that of another of the same wheel, to start from.

    Parameters
    ----------
    values : ndarray, (..., ny, nx)
        Pressure or traction of `old`.
    old, new : ConformalContact
        The contacts.
    """
    return _carried(values, (old.y_wheel, old.x), (new.y_wheel, new.x))


def _coarse(task: _Task) -> _Found | None:
    """The solution on a coarse grid; None without contact at the given height."""
    overlap, spacing, material, load, limit = (
        task.overlap, task.spacing[0], task.material, task.load, task.limit,
    )  # fmt: skip
    share = task.share
    touching = float(np.min(-overlap.overlap / share))
    guess = 0.0 if load is None else touching + _FIRST_LOWERING * (load / _FIRST_LOAD) ** (2.0 / 3.0)
    for _ in range(_MOST_TRIES):
        window = _overlapping(overlap, share, guess, spacing)
        if window is None:
            return None
        influence = Influence(Grid(window.along, window.count, spacing, overlap.spacing), material)
        strips = slice(window.first, window.first + window.count)
        field = task.field(window)
        weight = np.repeat(share[strips, None], window.along, axis=1)
        if load is None:
            solved = normal_contact(
                influence, field, approach=0.0, weight=weight, limit=limit, tolerance=_COARSE_TOLERANCE
            )
            return _Found(overlap.y_wheel[strips], window.x(spacing), solved.pressure, spacing)
        if load < limit * influence.grid.area * float(weight.sum()):
            solved = normal_contact(
                influence, field, load=load, weight=weight, limit=limit, tolerance=_COARSE_TOLERANCE
            )
            if solved.approach <= guess:
                return _Found(overlap.y_wheel[strips], window.x(spacing), solved.pressure, spacing)
        guess = touching + 1.5 * (guess - touching)
    raise ArithmeticError(f"load = {load} N: no height carries it; the wheel lies beside its rail")


def conformal_contact(
    pair: WheelRailPair,
    *,
    load: float | Pressing | None = None,
    spacing: tuple[float, float] = SPACING,
    material: Material = STEEL,
    limit: float = np.inf,
    tolerance: float = TOLERANCE,
    start: ConformalContact | None = None,
    arc: tuple[FloatArray, FloatArray] | None = None,
) -> ConformalContact | None:
    """Pressure of a wheel on its rail, at the pair's height or under a given load.

    Parameters
    ----------
    pair : WheelRailPair
        Profiles and pose (`geometry.silhouette.wheel_rail_pair`, `wheel_above_rail`).
    load : float or Pressing, optional
        Vertical force [N], > 0, or one in another direction; then the wheel is moved that way until it
        carries it. Without it the height is that of the pair.
    spacing : tuple of float
        Sides of an element along x and across [m].
    material : Material
        Of both bodies.
    limit : float
        Upper bound of the pressure [Pa].
    tolerance : float
        As of `normal.normal_contact`.
    start : ConformalContact, optional
        Of a similar pose, as of the state before in time, on the same spacing: the solution begins there and
        does not depend on it by more than its tolerance.
    arc : tuple of ndarray, optional
        `conformal.wheel_arc` of the wheel, where it is kept between calls.

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
    pressing = Pressing(load) if isinstance(load, (int, float)) else load
    overlap = _limited(conformal_overlap(pair, spacing[1], arc), pressing)
    task = _Task(overlap, spacing, material, pressing, limit, tolerance)
    if start is not None and pressing is not None:
        return _fine(task, _Found(start.y_wheel, start.x, start.pressure, spacing[0]))
    rough = _limited(conformal_overlap(pair, _COARSE * spacing[1], arc), pressing)
    coarse = _coarse(replace(task, overlap=rough, spacing=(_COARSE * spacing[0], _COARSE * spacing[1])))
    if coarse is None or not coarse.pressure.any():
        return None
    return _fine(task, coarse)


def _fine(task: _Task, start: _Found) -> ConformalContact:
    """The solution from one on another grid, in a window that grows until nothing touches its border."""
    overlap, spacing = task.overlap, task.spacing
    window, share = _around(start, overlap, spacing[0]), task.share
    for _ in range(_MOST_TRIES):
        strips = slice(window.first, window.first + window.count)
        x = window.x(spacing[0])
        influence = Influence(Grid(window.along, window.count, *spacing), task.material)
        weight = np.repeat(share[strips, None], window.along, axis=1)
        solved = normal_contact(
            influence, task.field(window),
            approach=0.0 if task.load is None else None, load=task.load, weight=weight, limit=task.limit,
            start=_carried(start.pressure, (start.y_wheel, start.x), (overlap.y_wheel[strips], x)),
            tolerance=task.tolerance,
        )  # fmt: skip
        if not _touches_border(solved.pressure):
            break
        window = _window(
            window.first - _STEP, window.count + 2 * _STEP, window.middle, window.along + _STEP,
            overlap.overlap.size,
        )  # fmt: skip
    force = solved.pressure.sum(axis=1) * influence.grid.area
    angle = overlap.angle[strips]
    return ConformalContact(
        influence=influence, x=x, y_wheel=overlap.y_wheel[strips], y_rail=overlap.y_rail[strips],
        angle=angle, point_y=overlap.point_y[strips], point_z=overlap.point_z[strips],
        radius=0.5 * np.cos(angle) / overlap.curvature[strips], crest=overlap.crest[strips],
        pressure=solved.pressure, side=overlap.side, lowering=solved.approach,
        vertical=float(force @ np.cos(angle)), outwards=-float(force @ np.sin(angle)),
        residual=solved.residual,
    )  # fmt: skip
