"""Bins fixed to a wheel or rail profile: over its lateral coordinate, or over its arc where that is known.

On the flange the lateral coordinate is a poor measure: a bin of 1 mm covers 2 mm of a surface at 60 degrees.
So where the profile is given, the bins lie along its arc: of a wheel from 0 at the running circle, positive
towards the flange; of a rail from 0 at its highest point, positive towards the gauge face. Depth is normal to
the surface in all cases.
"""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from damage.bounds import check_above_zero
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.cleaning import arc_length
from hh_exudyn.kernel import kernel

_MARGIN = 0.010  # of bins beyond the ends of a profile: an equivalent ellipse may overlap them [m]


class PlaceTable(NamedTuple):
    """Coordinate of a grid over the lateral one, for kernels; empty where they are the same."""

    y: FloatArray  # (n,) increasing [m]
    coordinate: FloatArray  # (n,) [m]


@kernel
def place_of(y: float, contact_angle: float, table: PlaceTable) -> tuple[float, float]:
    """`LateralGrid.place` of one contact (kernel).

    Parameters
    ----------
    y, contact_angle
        Lateral position [m] and angle [rad].
    table
        Of the grid.
    """
    size = table.y.size
    if size == 0:
        return y, math.cos(contact_angle)
    k = min(max(int(np.searchsorted(table.y, y)), 1), size - 1)
    share = (y - table.y[k - 1]) / (table.y[k] - table.y[k - 1])
    step = table.coordinate[k] - table.coordinate[k - 1]
    return table.coordinate[k - 1] + min(max(share, 0.0), 1.0) * step, 1.0


@dataclass(frozen=True, eq=False)
class ProfileArc:
    """Arc length over the lateral coordinate of a wheel or rail profile.

    Beyond the ends of the profile the arc length continues with slope 1.

    Attributes
    ----------
    y
        (n,) lateral coordinate, increasing [m].
    arc
        (n,) arc length from the running circle y = 0 of a wheel, from the top of a rail, increasing [m].
    """

    y: FloatArray
    arc: FloatArray

    @classmethod
    def of(cls, profile: Profile) -> "ProfileArc":
        """The arc of a profile, along the chords of its points."""
        origin = 0.0 if profile.kind == "wheel" else float(profile.y[np.argmax(profile.z)])
        arc = arc_length(profile.y, profile.z)
        arc -= np.interp(origin, profile.y, arc)
        ends = _MARGIN * np.array([-1.0, 1.0])
        y = np.concatenate([[profile.y[0] + ends[0]], profile.y, [profile.y[-1] + ends[1]]])
        return cls(y, np.concatenate([[arc[0] + ends[0]], arc, [arc[-1] + ends[1]]]))

    def __eq__(self, other: object) -> bool:
        """The same profile."""
        if not isinstance(other, ProfileArc):
            return NotImplemented
        return np.array_equal(self.y, other.y) and np.array_equal(self.arc, other.arc)

    def __hash__(self) -> int:
        return hash((self.y.tobytes(), self.arc.tobytes()))


@dataclass(frozen=True)
class LateralGrid:
    """Bins of equal width over a wheel or rail profile, in the grid's coordinate.

    The coordinate is the lateral one of the profile (side coordinates), or its arc length. The default spans
    from a wheel's flange back (+70 mm) to 70 mm on the field side in bins of 1 mm.

    Attributes
    ----------
    start
        Edge of the first bin, on the field side [m].
    step
        Width of a bin [m].
    count
        Number of bins.
    profile_arc
        Arc of the profile that the bins lie along; None for bins over the lateral coordinate.
    """

    start: float = -0.070
    step: float = 0.001
    count: int = 140
    profile_arc: ProfileArc | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        if not (math.isfinite(self.start) and math.isfinite(self.step) and self.step > 0.0):
            raise ValueError(f"grid with start = {self.start} m and step = {self.step} m: step must be > 0 m")
        if self.count < 1:
            raise ValueError(f"count = {self.count} bins must be at least 1")

    @classmethod
    def along(cls, profile: Profile, step: float = 0.001) -> "LateralGrid":
        """Bins over the whole arc of a profile, an edge at a wheel's running circle or at a rail's top.

        Parameters
        ----------
        profile
            Of the wheel or rail.
        step
            Width of a bin [m], > 0.

        Raises
        ------
        ValueError
            The step is not above zero.
        """
        check_above_zero("step", step, "m")
        arc = ProfileArc.of(profile)
        first, last = math.floor(arc.arc[0] / step), math.ceil(arc.arc[-1] / step)
        return cls(first * step, step, last - first, arc)

    @property
    def edges(self) -> NDArray[np.float64]:
        """(count + 1,) edges of the bins in the grid's coordinate [m]."""
        edges: NDArray[np.float64] = self.start + self.step * np.arange(self.count + 1, dtype=np.float64)
        return edges

    @property
    def centres(self) -> NDArray[np.float64]:
        """(count,) middles of the bins in the grid's coordinate [m]."""
        centres: NDArray[np.float64] = self.start + self.step * (
            np.arange(self.count, dtype=np.float64) + 0.5
        )
        return centres

    @property
    def lateral(self) -> NDArray[np.float64]:
        """(count,) lateral coordinate of the middles of the bins [m]."""
        if self.profile_arc is None:
            return self.centres
        lateral: NDArray[np.float64] = np.interp(self.centres, self.profile_arc.arc, self.profile_arc.y)
        return lateral

    def place(self, y: ArrayLike, contact_angle: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Place of a patch on the grid.

        Parameters
        ----------
        y
            (n,) lateral position of the contact on the profile [m].
        contact_angle
            (n,) [rad].

        Returns
        -------
        position, stretch
            (n,) the grid's coordinate of the contact [m], and the length on the grid over the length across
            the patch [-]: cos(contact angle) in the lateral coordinate; 1 on the arc, to which the contact
            plane is tangential.
        """
        lateral, angle = np.asarray(y, dtype=np.float64), np.asarray(contact_angle, dtype=np.float64)
        if self.profile_arc is None:
            return lateral, np.cos(angle)
        return np.interp(lateral, self.profile_arc.y, self.profile_arc.arc), np.ones_like(lateral)

    @property
    def table(self) -> PlaceTable:
        """The places for kernels: `place_of`."""
        arc = self.profile_arc
        return PlaceTable(np.empty(0), np.empty(0)) if arc is None else PlaceTable(arc.y, arc.arc)


@dataclass(frozen=True)
class PatchGrid:
    """Bins of equal width along the rolling direction, fixed to the patch: 0 is its middle.

    Attributes
    ----------
    start
        Rear edge of the first bin [m].
    step
        Length of a bin [m].
    count
        Number of bins.
    """

    start: float = -0.020
    step: float = 0.001
    count: int = 40

    def __post_init__(self) -> None:
        if not (math.isfinite(self.start) and math.isfinite(self.step) and self.step > 0.0):
            raise ValueError(
                f"patch grid with start = {self.start} m and step = {self.step} m: step must be > 0 m"
            )
        if self.count < 1:
            raise ValueError(f"count = {self.count} bins along the patch must be at least 1")

    @property
    def edges(self) -> NDArray[np.float64]:
        """(count + 1,) edges of the bins [m]."""
        edges: NDArray[np.float64] = self.start + self.step * np.arange(self.count + 1, dtype=np.float64)
        return edges


@kernel
def spread(centre: float, width: float, value: float, start: float, step: float, bins: FloatArray) -> None:
    """Distribute a strip over the bins: each gets the value times its covered share (kernel).

    The sum of bins times step grows by value times width. The strip must lie on the grid.

    Parameters
    ----------
    centre, width
        Of the strip in the coordinate of the bins [m].
    value
        In any unit.
    start, step
        Edge of the first bin, and width of a bin [m].
    bins
        (n,) result, added to.
    """
    low = (centre - 0.5 * width - start) / step
    high = (centre + 0.5 * width - start) / step
    first = max(math.floor(low), 0)
    last = min(math.floor(high), bins.size - 1)
    for index in range(first, last + 1):
        covered = min(high, index + 1.0) - max(low, float(index))
        if covered > 0.0:
            bins[index] += value * covered
