"""The table ``[track.check_rail]`` of a case file: check rails beside the running rails.

::

    [track.check_rail]
    below_radius_m = 300
    flangeway_mm = 44
"""

from typing import Literal, Self

import numpy as np
from pydantic import model_validator

from hh_exudyn.arrays import FloatArray
from hh_exudyn.case.errors import CaseError
from hh_exudyn.case.fields import CaseTable, number
from hh_exudyn.contact.check_rail.table import CheckRail, CheckRailTable, check_rail_table, no_check_rail
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.measures import flange_thickness
from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.sourced import load_parameters
from track.course.alignment import Alignment, track_frame

CHECK_RAIL_NUMBERS = load_parameters("track", "check_rail")  # the defaults, with their sources
_DEFAULT = CHECK_RAIL_NUMBERS.table("check_rail").values()
_STEP = 0.5  # m, of the search for tight curves
_LEAST_PLAY = 1e-3  # m, of a wheel between running rail and check rail
_MIRRORED = {"left": "right", "right": "left"}


class CheckRailCase(CaseTable):
    """Check rails where the radius is at most `below_radius_m`, or from `from_m` to `to_m` along the track.

    `side` "inner" is that of the low rail; the others do not depend on the hand of a curve. `flangeway_mm` is
    the distance of the faces of running rail and check rail (Indian Railways, Permanent Way Manual: 44 mm and
    more in sharp curves of broad gauge, 41 mm of metre gauge), `height_mm` that of the check rail's top above
    the running rail's, `corner_mm` the radius of its top corner. Beyond the stretch it flares out over
    `flare_m` by `flare_mm`. `friction` is that of the flange back, `stiffness_MN_per_m` the lateral one of
    check rail, fastening and wheel disc at a wheel. The defaults are assumed: `track/data/check_rail.toml`.
    """

    flangeway_mm: float = number("mm", 25, 120)
    side: Literal["inner", "left", "right", "both"] = "inner"
    below_radius_m: float | None = number("m", 20, 5000, None)
    from_m: float | None = number("m", 0, 200000, None)
    to_m: float | None = number("m", 0, 200000, None)
    height_mm: float = number("mm", -15, 80, _DEFAULT["height"])
    corner_mm: float = number("mm", 3, 30, _DEFAULT["corner"])
    flare_m: float = number("m", 0.2, 20, _DEFAULT["flare_length"])
    flare_mm: float = number("mm", 2, 100, _DEFAULT["flare_opening"])
    friction: float = number("-", 0, 1, _DEFAULT["friction"])
    stiffness_MN_per_m: float = number("MN/m", 5, 5000, _DEFAULT["stiffness"])

    @model_validator(mode="after")
    def _check_place(self) -> Self:
        """A radius, or both ends of a stretch."""
        ends = [self.from_m, self.to_m]
        if (self.below_radius_m is None) == (ends == [None, None]):
            raise ValueError("allowed either below_radius_m or from_m and to_m")
        if self.below_radius_m is None:
            if self.from_m is None or self.to_m is None:
                raise ValueError("allowed from_m and to_m together")
            if not self.from_m < self.to_m:
                raise ValueError(f"to_m = {self.to_m:g} m: allowed more than from_m = {self.from_m:g} m")
        return self

    def mirrored(self) -> Self:
        """The same check rails with left and right exchanged."""
        return self.model_copy(update={"side": _MIRRORED.get(self.side, self.side)})

    def described(self, alignment: Alignment) -> CheckRail:
        """The check rails on a track.

        Parameters
        ----------
        alignment : Alignment
            Says where curves are tight, and which rail is the inner one.

        Raises
        ------
        CaseError
            There is no such curve, or none at all for an inner rail.
        """
        stretches = self._stretches(alignment)
        if not stretches:
            where = (
                f"from_m = {self.from_m:g} m, to_m = {self.to_m:g} m: no curve there has an inner rail"
                if self.below_radius_m is None
                else f"below_radius_m = {self.below_radius_m:g} m: no curve of the track is that tight"
            )
            raise CaseError(f"track.check_rail.{where}")
        return CheckRail(
            stretches=stretches,
            flangeway=self.flangeway_mm / 1000,
            height=self.height_mm / 1000,
            corner_radius=self.corner_mm / 1000,
            flare_length=self.flare_m,
            flare_opening=self.flare_mm / 1000,
            friction=self.friction,
            stiffness=self.stiffness_MN_per_m * 1e6,
        )

    def _stretches(self, alignment: Alignment) -> tuple[tuple[int, float, float], ...]:
        """Side and ends of every stretch [m]."""
        s = np.arange(0.0, alignment.length + 0.5 * _STEP, _STEP)
        curvature = np.array([track_frame(alignment.table, place)[5] for place in s])
        if self.below_radius_m is None:
            here = (s >= (self.from_m or 0.0)) & (s <= (self.to_m or 0.0))
        else:
            here = np.abs(curvature) >= (1.0 - 1e-9) / self.below_radius_m
        sides = {"inner": (LEFT, RIGHT), "left": (LEFT,), "right": (RIGHT,), "both": (LEFT, RIGHT)}
        found: list[tuple[int, float, float]] = []
        for side in sides[self.side]:
            inside = here & (curvature * side > 0.0) if self.side == "inner" else here
            found += [(side, start, end) for start, end in _runs(s, inside)]
        return tuple(found)


def _runs(s: FloatArray, inside: "np.ndarray") -> list[tuple[float, float]]:
    """First and last place of every run of places inside, of two places at least."""
    steps = np.diff(np.concatenate([[0], inside.astype(int), [0]]))
    first, end = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1)
    return [(float(s[i]), float(s[j - 1])) for i, j in zip(first, end, strict=True) if j - i > 1]


def check_rails(
    given: CheckRailCase | None,
    alignment: Alignment,
    wheels: list[tuple[Profile, Profile]],
    back_to_back: float,
    radius: float,
) -> CheckRailTable:
    """The check rails of a track for the wheels of a vehicle.

    Parameters
    ----------
    given : CheckRailCase or None
        None for a track without.
    alignment : Alignment
        Of the track.
    wheels : list of (Profile, Profile)
        Left and right wheel of every wheelset.
    back_to_back : float
        Distance of the flange backs [m].
    radius : float
        Of the wheels at the running circle [m].

    Raises
    ------
    CaseError
        A flangeway through which a flange does not pass, two check rails further apart than the backs, or no
        curve that is tight enough.
    """
    if given is None:
        return no_check_rail()
    check = given.described(alignment)
    thickest = max(flange_thickness(wheel) for pair in wheels for wheel in pair)
    key = f"track.check_rail.flangeway_mm = {given.flangeway_mm:g} mm"
    if check.flangeway < thickest + _LEAST_PLAY:
        raise CaseError(
            f"{key}: allowed {1e3 * (thickest + _LEAST_PLAY):.1f} mm and more, for a flange of "
            f"{1e3 * thickest:.1f} mm between the rails"
        )
    if given.side == "both":
        for _, start, end in check.stretches:
            gauge = max(track_frame(alignment.table, s)[6] for s in np.linspace(start, end, 20))
            least = 0.5 * (gauge - back_to_back)
            if check.flangeway < least:
                raise CaseError(
                    f"{key}: allowed {1e3 * least:.1f} mm and more with check rails on both sides, at a "
                    f"gauge of {1e3 * gauge:.1f} mm and flange backs {1e3 * back_to_back:.1f} mm apart"
                )
    return check_rail_table(check, wheels, back_to_back, radius)
