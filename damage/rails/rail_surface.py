"""Wear and fatigue of one rail: sums over the wheels that pass it, on a grid fixed to its profile.

They are additive like those of the wheels (`damage.surface.wheel_surface`): over pieces of a log, runs, and
weights of a load collective. `RailSurface.passed_once` turns the sums of a run into those of one passing of
the vehicle; from there on the mass that has passed is known, and sums of any vehicles give damage per gross
tonne.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from damage.bounds import check_above_zero, check_not_below_zero
from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.surface.wheel_surface import Wheel, WheelSurface

PASSED_LENGTH = 1.0
"""Length of the piece of rail [m] that the sums are of: where it was rolled on once, it was passed once."""

MGT = 1e9
"""A million gross tonnes [kg]."""


@dataclass(frozen=True)
class RailSurface:
    """Sums of one rail; W wheels that ran on it, B bins across its profile.

    Attributes
    ----------
    side
        +1 left, -1 right.
    by_wheel
        What each wheel did to the rail: the sums of a `WheelSurface` on the bins of the rail, with passings
        in the place of revolutions, and of 1 m of rail. Its parts are the head ("tread": contact angle up to
        the flange angle) and the gauge corner and face ("flange"). Its distance is that of all wheels
        together.
    whole_life
        (W, B) sum over the passings of the whole-life rail model's damage function at the wear number of the
        patch that covers the bin [-]: 1 is a crack of visible length (`damage.rcf.whole_life_rail`).
    rolled
        (W,) distance that each wheel rolled on this rail [m].
    mass
        Gross mass that passed, on both rails [kg]; 0 before `passed_once`.
    """

    side: int
    by_wheel: WheelSurface
    whole_life: NDArray[np.float64]
    rolled: NDArray[np.float64]
    mass: float = 0.0

    __array_ufunc__ = None  # a weight that is a number of numpy leaves the product to `__rmul__`

    @classmethod
    def zero(
        cls, side: int, wheels: tuple[Wheel, ...], grid: LateralGrid, patch_grid: PatchGrid
    ) -> "RailSurface":
        """A rail before any passing.

        Parameters
        ----------
        side
            +1 left, -1 right.
        wheels
            The W wheels, sorted.
        grid, patch_grid
            Bins across the rail and along the patch.
        """
        count = len(wheels)
        empty = WheelSurface.zero(wheels, grid, patch_grid)
        return cls(side, empty, np.zeros((count, grid.count)), np.zeros(count))

    def __add__(self, other: "RailSurface") -> "RailSurface":
        """Both sums together, for the wheels of either.

        Raises
        ------
        ValueError
            The rails are on different sides, or their grids differ.
        """
        if self.side != other.side:
            raise ValueError("sums of a left and a right rail cannot be added")
        total = self.by_wheel + other.by_wheel
        whole_life = np.zeros((len(total.wheels), total.grid.count))
        rolled = np.zeros(len(total.wheels))
        for part in (self, other):
            place = [total.wheels.index(wheel) for wheel in part.by_wheel.wheels]
            whole_life[place] += part.whole_life
            rolled[place] += part.rolled
        return RailSurface(self.side, total, whole_life, rolled, self.mass + other.mass)

    def __radd__(self, other: object) -> "RailSurface":
        """The rail itself, for the 0 that `sum()` begins with."""
        return self if other == 0 else NotImplemented

    def __rmul__(self, weight: float) -> "RailSurface":
        """All sums, distances and the mass times a weight: damage per gross tonne stays.

        Raises
        ------
        ValueError
            The weight is not finite, or below zero.
        """
        check_not_below_zero("weight", weight, "-", "a rail")
        return replace(
            self,
            by_wheel=weight * self.by_wheel,
            whole_life=weight * self.whole_life,
            rolled=weight * self.rolled,
            mass=weight * self.mass,
        )

    def __mul__(self, weight: float) -> "RailSurface":
        """As `weight * rail`."""
        return self.__rmul__(weight)

    def only(self, wanted: Sequence[bool]) -> "RailSurface":
        """The sums of some of the wheels, (W,) whether each is one of them."""
        rows = np.flatnonzero(wanted)
        return replace(
            self,
            by_wheel=self.by_wheel.only(wanted),
            whole_life=self.whole_life[rows],
            rolled=self.rolled[rows],
        )

    def passed_once(self, mass: float) -> "RailSurface":
        """The sums of one passing of the vehicle: those of every wheel over its own distance on the rail.

        So a run that ended before the last wheelset was through gives the passing of a whole vehicle, as long
        as every wheel was on the rail at all.

        Parameters
        ----------
        mass
            Of the vehicle, all that passes once [kg], > 0.

        Raises
        ------
        ValueError
            The mass is not finite and above zero, or a wheel has not rolled on this rail.
        """
        check_above_zero("mass", mass, "kg", "the vehicle")
        if not np.all(self.rolled > 0.0):
            wheel = self.by_wheel.wheels[int(np.argmin(self.rolled))]
            raise ValueError(
                f"wheel {wheel.wheelset} of vehicle {wheel.vehicle} has not rolled on this rail: there is no "
                "passing of the whole vehicle"
            )
        factor = PASSED_LENGTH / self.rolled
        sums: dict[str, Any] = {
            one.name: factor.reshape(-1, *[1] * (values.ndim - 1)) * values
            for one in fields(self.by_wheel)
            if isinstance(values := getattr(self.by_wheel, one.name), np.ndarray)
            and one.name != "pressure_by_part"
        }
        count = len(self.rolled)
        by_wheel = replace(self.by_wheel, distance=count * PASSED_LENGTH, time=self._passing_time(), **sums)
        whole_life = factor[:, None] * self.whole_life
        return replace(self, by_wheel=by_wheel, whole_life=whole_life, rolled=factor * self.rolled, mass=mass)

    def _passing_time(self) -> float:
        """Time in which all wheels together roll 1 m each [s]."""
        whole = float(self.rolled.sum())
        return self.by_wheel.time * len(self.rolled) * PASSED_LENGTH / whole if whole > 0.0 else 0.0

    def mirrored(self) -> "RailSurface":
        """The rail on the other side: the sums of the mirrored case."""
        wheels = tuple(Wheel(*wheel[:3], -wheel.side) for wheel in self.by_wheel.wheels)
        return replace(self, side=-self.side, by_wheel=replace(self.by_wheel, wheels=wheels))

    @property
    def per_mgt(self) -> float:
        """Factor from the sums to a million gross tonnes [1]. Raises ValueError before `passed_once`."""
        if not 0.0 < self.mass < math.inf:
            raise ValueError("the mass that passed this rail is not known: see `passed_once`")
        return MGT / self.mass

    @property
    def depth_per_mgt(self) -> NDArray[np.float64]:
        """(B,) wear depth normal to the surface per million gross tonnes, of all wheels [m]."""
        depth: NDArray[np.float64] = self.per_mgt * self.by_wheel.depth.sum(axis=0)
        return depth

    @property
    def worn_area_per_mgt(self) -> float:
        """Worn area of the rail's cross-section per million gross tonnes [m^2]."""
        return self.per_mgt * float(self.by_wheel.worn_area.sum())

    @property
    def mean_wear_number(self) -> NDArray[np.float64]:
        """(W,) energy lost per distance rolled on this rail, mean of each wheel [N]; 0 without distance."""
        work = self.by_wheel.work
        return np.divide(work, self.rolled, out=np.zeros_like(work), where=self.rolled > 0.0)
