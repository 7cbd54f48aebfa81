"""Wear and fatigue of the wheel surfaces: sums over contact states on a grid fixed to the wheel profile.

All sums are additive: the surface of a log is the sum of the surfaces of its pieces, however it is cut, and
the surface of a set of runs is the sum over the runs. A load collective is a weighted sum, and a distance is
a factor, as all of them count revolutions of the wheel:

    0.3 * curve.scaled(50e6) + 0.7 * straight.scaled(50e6)

`sum()` adds them too. `damage.surface.stored` keeps them in files, `damage.surface.tables` turns them into
tables and arrays with labelled axes, and compares them.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from damage.bounds import check_not_below_zero
from damage.patch_strips import FLANGE
from damage.rcf.subsurface import LEVELS
from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.wear.law import REGIMES

DEFAULT_PATCH_GRID = PatchGrid()


class Wheel(NamedTuple):
    """One wheel of a run."""

    vehicle: int
    bogie: int
    wheelset: int
    side: int  # +1 left, -1 right


@dataclass(frozen=True)
class WheelSurface:
    """Sums over the contact states of a run; W wheels, B bins across the profile, X bins along the patch.

    A bin covered in part gets that share. Dimensions of 2 separate tread and flange.

    Attributes
    ----------
    grid
        The bins across the profile.
    patch_grid
        The bins along the patch.
    wheels
        The W wheels, sorted.
    rows
        Contact states that were summed [-].
    time
        Their time in all [s].
    distance
        Distance rolled in that time [m].
    depth_by_part
        (W, 2, B) wear depth normal to the surface [m], by contact on the tread and on the flange.
    worn_area
        (W, B) worn area of the cross-section [m^2].
    worn_volume
        (W, 4) worn volume by regime of the wear law [m^3].
    contact_time
        (W, 2, B) time that the bin was in contact, on the tread and on the flange [s]; where two patches of
        a wheel overlap, both count.
    fatigue_time
        (W, 2, B) time that the bin lay in a patch with a fatigue index FI_surf above zero [s].
    contact_revolutions
        (W, 2, B) revolutions in which the bin was in contact [-].
    fatigue_revolutions
        (W, 2, B) revolutions in which the bin lay in a patch with FI_surf above zero [-].
    ratchet_revolutions
        (W, 2, B) revolutions in which a cell of the patch in that bin had a stress index SI above zero [-].
    crack_damage
        (W, 2, B) Miner's sum of FI_local^4 / 10.04, failure at 1 (Kabo; `damage.rcf.miner`) [-].
    global_crack_damage
        (W, 2, B) the same of FI_surf, one index for all bins that the patch covers: as Kabo's life was fitted
        (Hossein-Nia 2018, 3.19) [-].
    rcf_number
        (W, 2, B, X) revolutions in which the place had SI above zero [-], see `damage.rcf.number`.
    corrected_rcf_number
        (W, 2, B, X) the same with Burstow's correction [-].
    energy
        (W, 2, B, X) sum over the revolutions of the energy lost per metre rolled and area [Pa].
    patch_time
        (W, 2) sum of the patches' times in contact [s].
    positive_time
        (W, 2) part of it with a fatigue index above zero [s].
    index_area
        (W, 2) time integral of the positive part of the fatigue index [s].
    friction_area
        (W, 2) time integral of the friction coefficient: the largest area that the index could have [s].
    subsurface_revolutions
        (W, 2, `LEVELS`) revolutions of the patches by level of FI_sub, fatigue below the surface
        (`damage.rcf.subsurface`) [-].
    work
        (W,) energy lost in creepage [J].
    pressure_by_part
        (W, 2) largest pressure on the tread and on the flange [Pa].
    """

    grid: LateralGrid
    patch_grid: PatchGrid
    wheels: tuple[Wheel, ...]
    rows: int
    time: float
    distance: float
    depth_by_part: NDArray[np.float64]
    worn_area: NDArray[np.float64]
    worn_volume: NDArray[np.float64]
    contact_time: NDArray[np.float64]
    fatigue_time: NDArray[np.float64]
    contact_revolutions: NDArray[np.float64]
    fatigue_revolutions: NDArray[np.float64]
    ratchet_revolutions: NDArray[np.float64]
    crack_damage: NDArray[np.float64]
    global_crack_damage: NDArray[np.float64]
    rcf_number: NDArray[np.float64]
    corrected_rcf_number: NDArray[np.float64]
    energy: NDArray[np.float64]
    patch_time: NDArray[np.float64]
    positive_time: NDArray[np.float64]
    index_area: NDArray[np.float64]
    friction_area: NDArray[np.float64]
    subsurface_revolutions: NDArray[np.float64]
    work: NDArray[np.float64]
    pressure_by_part: NDArray[np.float64]

    __array_ufunc__ = None  # a weight that is a number of numpy leaves the product to `__rmul__`

    @classmethod
    def zero(
        cls, wheels: tuple[Wheel, ...], grid: LateralGrid, patch_grid: PatchGrid = DEFAULT_PATCH_GRID
    ) -> "WheelSurface":
        """Surfaces before any contact.

        Parameters
        ----------
        wheels
            The W wheels, sorted.
        grid, patch_grid
            Bins across the profile and along the patch.
        """
        count, bins, along = len(wheels), grid.count, patch_grid.count
        return cls(
            grid=grid,
            patch_grid=patch_grid,
            wheels=wheels,
            rows=0,
            time=0.0,
            distance=0.0,
            depth_by_part=np.zeros((count, 2, bins)),
            worn_area=np.zeros((count, bins)),
            worn_volume=np.zeros((count, REGIMES)),
            contact_time=np.zeros((count, 2, bins)),
            fatigue_time=np.zeros((count, 2, bins)),
            contact_revolutions=np.zeros((count, 2, bins)),
            fatigue_revolutions=np.zeros((count, 2, bins)),
            ratchet_revolutions=np.zeros((count, 2, bins)),
            crack_damage=np.zeros((count, 2, bins)),
            global_crack_damage=np.zeros((count, 2, bins)),
            rcf_number=np.zeros((count, 2, bins, along)),
            corrected_rcf_number=np.zeros((count, 2, bins, along)),
            energy=np.zeros((count, 2, bins, along)),
            patch_time=np.zeros((count, 2)),
            positive_time=np.zeros((count, 2)),
            index_area=np.zeros((count, 2)),
            friction_area=np.zeros((count, 2)),
            subsurface_revolutions=np.zeros((count, 2, LEVELS)),
            work=np.zeros(count),
            pressure_by_part=np.zeros((count, 2)),
        )

    def __add__(self, other: "WheelSurface") -> "WheelSurface":
        """Both sums together, for the wheels of either.

        Raises
        ------
        ValueError
            The grids differ.
        """
        if self.grid != other.grid:
            raise ValueError(f"surfaces on different grids cannot be added: {self.grid} and {other.grid}")
        if self.patch_grid != other.patch_grid:
            raise ValueError(
                f"surfaces on different grids cannot be added: {self.patch_grid} and {other.patch_grid}"
            )
        wheels = tuple(sorted(set(self.wheels) | set(other.wheels)))
        total = WheelSurface.zero(wheels, self.grid, self.patch_grid)
        for part in (self, other):
            if not part.wheels:
                continue
            same = part.wheels == wheels  # all in order: no copies
            place = slice(None) if same else [wheels.index(wheel) for wheel in part.wheels]
            for field in fields(self):
                values = getattr(part, field.name)
                if field.name == "pressure_by_part":
                    total.pressure_by_part[place] = np.maximum(total.pressure_by_part[place], values)
                elif isinstance(values, np.ndarray):
                    getattr(total, field.name)[place] += values
        return replace(
            total,
            rows=self.rows + other.rows,
            time=self.time + other.time,
            distance=self.distance + other.distance,
        )

    def __radd__(self, other: object) -> "WheelSurface":
        """The surface itself, for the 0 that `sum()` begins with."""
        return self if other == 0 else NotImplemented

    def only(self, wanted: Sequence[bool]) -> "WheelSurface":
        """The surfaces of some of the wheels.

        Parameters
        ----------
        wanted
            (W,) whether each wheel is one of them.
        """
        rows = np.flatnonzero(wanted)
        chosen = {
            field.name: getattr(self, field.name)[rows]
            for field in fields(self)
            if isinstance(getattr(self, field.name), np.ndarray)
        }
        return replace(self, wheels=tuple(self.wheels[row] for row in rows), **chosen)

    def __rmul__(self, weight: float) -> "WheelSurface":
        """All sums times a weight: its share in a load collective.

        The number of states that were summed and the largest pressure do not change.

        Raises
        ------
        ValueError
            The weight is not finite, or below zero.
        """
        check_not_below_zero("weight", weight, "-", "a surface")
        sums = {
            field.name: weight * getattr(self, field.name)
            for field in fields(self)
            if field.name not in ("grid", "patch_grid", "wheels", "rows", "pressure_by_part")
        }
        return replace(self, **sums)

    def __mul__(self, weight: float) -> "WheelSurface":
        """As `weight * surface`."""
        return self.__rmul__(weight)

    def scaled(self, distance: float) -> "WheelSurface":
        """The surfaces after another distance of the same rolling: all sums by the ratio of revolutions.

        Parameters
        ----------
        distance
            Total distance rolled [m], >= 0.

        Raises
        ------
        ValueError
            The distance is not finite, or below zero, or nothing has rolled yet.
        """
        check_not_below_zero("distance", distance, "m")
        if self.distance <= 0.0:
            raise ValueError("surfaces that have not rolled cannot be scaled to a distance")
        return (distance / self.distance) * self

    @property
    def energy_density(self) -> NDArray[np.float64]:
        """(W, 2, B) energy lost per area of the wheel's surface [J/m^2]."""
        density: NDArray[np.float64] = self.energy.sum(axis=3) * self.patch_grid.step
        return density

    @property
    def depth(self) -> NDArray[np.float64]:
        """(W, B) wear depth normal to the surface, of tread and flange contact together [m]."""
        depth: NDArray[np.float64] = self.depth_by_part.sum(axis=1)
        return depth

    @property
    def max_pressure(self) -> NDArray[np.float64]:
        """(W,) largest pressure [Pa]."""
        pressure: NDArray[np.float64] = self.pressure_by_part.max(axis=1, initial=0.0)
        return pressure

    @property
    def depth_per_km(self) -> NDArray[np.float64]:
        """(W, B) wear depth per kilometre rolled [m/km]."""
        return self.depth / self.distance * 1e3

    @property
    def worn_area_per_km(self) -> NDArray[np.float64]:
        """(W,) worn area of the cross-section per kilometre rolled [m^2/km]."""
        return self.worn_area.sum(axis=1) / self.distance * 1e3

    @property
    def mean_wear_number(self) -> NDArray[np.float64]:
        """(W,) energy lost in creepage per distance rolled, mean over the run [N]."""
        return self.work / self.distance

    @property
    def fatigue_share(self) -> NDArray[np.float64]:
        """(W, 2) share of the working points with an index above zero [-], of tread and of flange."""
        return _ratio(self.positive_time, self.patch_time)

    @property
    def fatigue_area_index(self) -> NDArray[np.float64]:
        """(W, 2) area below the positive index over the largest possible area [-] (figure 3-14)."""
        return _ratio(self.index_area, self.friction_area)

    @property
    def mean_friction(self) -> NDArray[np.float64]:
        """(W, 2) friction coefficient on the tread and on the flange, over the time in contact [-]."""
        return _ratio(self.friction_area, self.patch_time)

    @property
    def flange_share(self) -> NDArray[np.float64]:
        """(W,) share of the working points that lie on the flange [-]."""
        return _ratio(self.patch_time[:, FLANGE], self.patch_time.sum(axis=1))


def _ratio(part: NDArray[np.float64], whole: NDArray[np.float64]) -> NDArray[np.float64]:
    """Part over whole; 0 where the whole is 0 (no contact, hence no share)."""
    return np.divide(part, whole, out=np.zeros_like(part), where=whole > 0.0)
