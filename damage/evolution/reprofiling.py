"""Reprofiling: the smallest cut on the wheel lathe that restores a target profile.

The wheel is turned about its axle with the flange back as the lateral reference, so a target may only move
radially. It lies inside the remaining metal where its line, moved into the wheel by the cut, is nowhere
outside that of the worn wheel; the smallest such cut is the largest height of the worn line above the
target's, both with their running circles at z = 0:

    cut = max over y (z_worn - z_target),    diameter lost = 2 cut

Restoring a loss of flange thickness takes a cut of that loss times the tangent of the flange angle. This is
why workshops have targets with thinner flanges: of several, the one with the smallest cut is chosen among
those with the required flange thickness.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pyarrow

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.measures import flange_thickness

_STEP = 0.05e-3  # m, spacing of the compared lateral positions, in addition to the points of both profiles


@dataclass(frozen=True)
class Reprofiling:
    """A cut, and the wheel after it.

    Attributes
    ----------
    profile
        The target: the profile of the wheel after the cut.
    radius
        At the running circle after the cut [m].
    cut
        Radius lost at the running circle [m].
    limited_at
        Lateral position where target and worn profile touch, which determines the cut [m].
    turned_area
        Cross-section that is turned off [m^2].
    """

    profile: Profile
    radius: float
    cut: float
    limited_at: float
    turned_area: float

    @property
    def diameter_lost(self) -> float:
        """Diameter lost by the cut [m]."""
        return 2.0 * self.cut

    def to_table(self) -> pyarrow.Table:
        """One row: target, diameter_mm after the cut, diameter_lost_mm, limited_at_mm, turned_area_mm2."""
        return pyarrow.table(
            {
                "target": [self.profile.name],
                "diameter_mm": [2e3 * self.radius],
                "diameter_lost_mm": [1e3 * self.diameter_lost],
                "limited_at_mm": [1e3 * self.limited_at],
                "turned_area_mm2": [1e6 * self.turned_area],
            }
        )


def reprofile(
    worn: Profile,
    radius: float,
    targets: Profile | Sequence[Profile],
    least_flange_thickness: float = 0.0,
    least_cut: float = 0.0,
) -> Reprofiling:
    """Turn a worn wheel to a target profile with the smallest cut.

    Parameters
    ----------
    worn, radius
        The worn wheel, and its radius at the running circle [m].
    targets
        The profile to restore; of several, the one with the smallest cut.
    least_flange_thickness
        Targets with a thinner flange (Sd) are left out [m].
    least_cut
        Radius that is turned off in any case, for instance to get below cracks [m], >= 0.

    Raises
    ------
    ValueError
        Rails, no target with such a flange, a target that reaches over the ends of the worn profile, or a
        number out of its range.
    """
    targets = [targets] if isinstance(targets, Profile) else list(targets)
    if not radius > 0.0:
        raise ValueError(f"radius = {radius} m of the worn wheel must be > 0 m")
    if not least_cut >= 0.0:
        raise ValueError(f"least_cut = {least_cut} m must be >= 0 m")
    thick = [target for target in targets if flange_thickness(target) >= least_flange_thickness]
    if not thick:
        offered = ", ".join(f"{target.name!r} {1e3 * flange_thickness(target):.2f}" for target in targets)
        raise ValueError(
            f"no target with a flange of at least {1e3 * least_flange_thickness:.2f} mm; there are: {offered}"
        )
    return min((_turned(worn, radius, target, least_cut) for target in thick), key=lambda one: one.cut)


def _turned(worn: Profile, radius: float, target: Profile, least_cut: float) -> Reprofiling:
    """The wheel turned to one target."""
    y, worn_z, target_z = _compared(worn, target)
    at = int(np.argmax(worn_z - target_z))
    cut = max(float((worn_z - target_z)[at]), least_cut)
    if not cut < radius:
        raise ValueError(
            f"a cut of {1e3 * cut:.4g} mm is more than the wheel's radius of {1e3 * radius:.4g} mm"
        )
    turned = float(np.trapezoid(target_z + cut - worn_z, y))
    return Reprofiling(target, radius - cut, cut, float(y[at]), turned)


def _compared(worn: Profile, target: Profile) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Lateral positions from the field side to the target's flange tip, and both heights there.

    Left out are the flange back, which is the lathe's reference and does not wear, and on the field side up
    to 5 mm beyond the worn profile, where measurements end early.
    """
    for profile in (worn, target):
        if profile.kind != "wheel":
            raise ValueError(f"profile {profile.name!r} is a {profile.kind}'s; reprofiling needs wheels")
    tip = float(target.y[np.argmin(target.z)])
    start = max(float(worn.y[0]), float(target.y[0]))
    if worn.y[-1] < tip or start > target.y[0] + 5e-3:
        raise ValueError(
            f"target {target.name!r} from y = {1e3 * target.y[0]:.2f} to its tip at {1e3 * tip:.2f} mm "
            f"is not covered by the worn profile {worn.name!r}, {1e3 * worn.y[0]:.2f} to "
            f"{1e3 * worn.y[-1]:.2f} mm"
        )
    even = np.arange(start, tip, _STEP)
    y = np.unique(np.concatenate([even, [start, tip], worn.y, target.y]))
    y = y[(y >= start) & (y <= tip)]
    heights = [
        np.interp(y, profile.y, profile.z) - np.interp(0.0, profile.y, profile.z)
        for profile in (worn, target)
    ]
    return y, heights[0], heights[1]
