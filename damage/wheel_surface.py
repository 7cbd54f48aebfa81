"""What happened to the wheel surfaces: sums over contact states on a grid fixed to the wheel profile.

All sums are additive: the surface of a log is the sum of the surfaces of its pieces, however it is cut, and
the surface of a set of runs is the sum over the runs.
"""

import math
from dataclasses import dataclass, fields, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from damage.wear.values import REGIMES
from hh_exudyn.contact.types import FloatArray
from hh_exudyn.kernel import kernel

TREAD, FLANGE = 0, 1  # columns of the arrays that tell contact on the tread from contact on the flange


class Wheel(NamedTuple):
    """One wheel of a run."""

    vehicle: int
    bogie: int
    wheelset: int
    side: int  # +1 left, -1 right


@dataclass(frozen=True)
class LateralGrid:
    """Bins of equal width over the lateral coordinate of a wheel profile (side coordinates).

    The default spans from the flange back (+70 mm) to 70 mm on the field side in bins of 1 mm.

    Attributes
    ----------
    start
        Edge of the first bin, on the field side [m].
    step
        Width of a bin [m].
    count
        Number of bins.
    """

    start: float = -0.070
    step: float = 0.001
    count: int = 140

    def __post_init__(self) -> None:
        if not (math.isfinite(self.start) and math.isfinite(self.step) and self.step > 0.0):
            raise ValueError(f"grid with start = {self.start} m and step = {self.step} m: step must be > 0 m")
        if self.count < 1:
            raise ValueError(f"count = {self.count} bins must be at least 1")

    @property
    def edges(self) -> NDArray[np.float64]:
        """(count + 1,) edges of the bins [m]."""
        edges: NDArray[np.float64] = self.start + self.step * np.arange(self.count + 1, dtype=np.float64)
        return edges

    @property
    def centres(self) -> NDArray[np.float64]:
        """(count,) middles of the bins [m]."""
        centres: NDArray[np.float64] = self.start + self.step * (
            np.arange(self.count, dtype=np.float64) + 0.5
        )
        return centres


@kernel
def spread(centre: float, width: float, value: float, start: float, step: float, bins: FloatArray) -> None:
    """Distribute a strip over the bins: each gets the value times the share of the bin that is covered.

    The sum of bins times step grows by value times width. The strip must lie on the grid.
    """
    low = (centre - 0.5 * width - start) / step
    high = (centre + 0.5 * width - start) / step
    first = max(math.floor(low), 0)
    last = min(math.floor(high), bins.size - 1)
    for index in range(first, last + 1):
        covered = min(high, index + 1.0) - max(low, float(index))
        if covered > 0.0:
            bins[index] += value * covered


@dataclass(frozen=True)
class WheelSurface:
    """Sums over the contact states of a run; W wheels, B bins of the lateral grid.

    Attributes
    ----------
    grid
        The bins.
    wheels
        The W wheels, sorted.
    rows
        Contact states that were summed [-].
    time
        Time they stand for [s].
    distance
        Distance rolled in that time [m].
    depth
        (W, B) wear depth normal to the surface [m].
    worn_area
        (W, B) worn area of the cross-section [m^2].
    worn_volume
        (W, 4) worn volume by region of Jendel's map, see `damage.wear.jendel.JENDEL_REGIMES` [m^3].
    contact_time
        (W, 2, B) time that the bin was in contact, on the tread and on the flange [s]; where two patches of
        a wheel overlap, both count.
    fatigue_time
        (W, 2, B) time that the bin lay in a patch with a fatigue index above zero [s].
    patch_time
        (W, 2) sum of the patches' times in contact [s].
    positive_time
        (W, 2) part of it with a fatigue index above zero [s].
    index_area
        (W, 2) time integral of the positive part of the fatigue index [s].
    friction_area
        (W, 2) time integral of the friction coefficient: the largest area that the index could have [s].
    work
        (W,) energy lost in creepage [J].
    max_pressure
        (W,) largest Hertz pressure [Pa].
    """

    grid: LateralGrid
    wheels: tuple[Wheel, ...]
    rows: int
    time: float
    distance: float
    depth: NDArray[np.float64]
    worn_area: NDArray[np.float64]
    worn_volume: NDArray[np.float64]
    contact_time: NDArray[np.float64]
    fatigue_time: NDArray[np.float64]
    patch_time: NDArray[np.float64]
    positive_time: NDArray[np.float64]
    index_area: NDArray[np.float64]
    friction_area: NDArray[np.float64]
    work: NDArray[np.float64]
    max_pressure: NDArray[np.float64]

    @classmethod
    def zero(cls, wheels: tuple[Wheel, ...], grid: LateralGrid) -> "WheelSurface":
        """Surfaces that nothing has touched yet."""
        count, bins = len(wheels), grid.count
        return cls(
            grid=grid,
            wheels=wheels,
            rows=0,
            time=0.0,
            distance=0.0,
            depth=np.zeros((count, bins)),
            worn_area=np.zeros((count, bins)),
            worn_volume=np.zeros((count, REGIMES)),
            contact_time=np.zeros((count, 2, bins)),
            fatigue_time=np.zeros((count, 2, bins)),
            patch_time=np.zeros((count, 2)),
            positive_time=np.zeros((count, 2)),
            index_area=np.zeros((count, 2)),
            friction_area=np.zeros((count, 2)),
            work=np.zeros(count),
            max_pressure=np.zeros(count),
        )

    def __add__(self, other: "WheelSurface") -> "WheelSurface":
        """Both sums together; wheels that only one of them has are kept.

        Raises
        ------
        ValueError
            The grids differ.
        """
        if self.grid != other.grid:
            raise ValueError(f"surfaces on different grids cannot be added: {self.grid} and {other.grid}")
        wheels = tuple(sorted(set(self.wheels) | set(other.wheels)))
        total = WheelSurface.zero(wheels, self.grid)
        for part in (self, other):
            place = [wheels.index(wheel) for wheel in part.wheels]
            for field in fields(self):
                values = getattr(part, field.name)
                if field.name == "max_pressure":
                    total.max_pressure[place] = np.maximum(total.max_pressure[place], values)
                elif isinstance(values, np.ndarray):
                    getattr(total, field.name)[place] += values
        return replace(
            total,
            rows=self.rows + other.rows,
            time=self.time + other.time,
            distance=self.distance + other.distance,
        )

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
    def flange_share(self) -> NDArray[np.float64]:
        """(W,) share of the working points that lie on the flange [-]."""
        return _ratio(self.patch_time[:, FLANGE], self.patch_time.sum(axis=1))


def _ratio(part: NDArray[np.float64], whole: NDArray[np.float64]) -> NDArray[np.float64]:
    """Part over whole; 0 where there is no whole (no contact there, hence no share)."""
    return np.divide(part, whole, out=np.zeros_like(part), where=whole > 0.0)
