"""Cases that need not run again: no wheel has moved where it touches.

A result stands for other profiles as long as every wheel's profile, within the bins that were in contact,
lies no farther than a tolerance from the one that the case was run with, measured along the normal. In
running-in, of which the steps are some ten metres, only the flange root moves, and all cases that never touch
it stand.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.life.rates import GroupRates
from hh_exudyn.contact.profile import Profile

_MARGIN = 3e-3  # beside the bins in contact [m]: an edge of a patch, and half a bin


@dataclass(frozen=True)
class LastRun:
    """The last run of a case: its result, the profiles that it had, and where they were in contact.

    Attributes
    ----------
    key
        Of the result.
    profiles
        Digest of the profile of every group.
    """

    key: str
    profiles: Mapping[str, str]


def has_moved(
    before: Mapping[str, Profile],
    now: Mapping[str, Profile],
    rates: Mapping[str, GroupRates],
    tolerance: float,
) -> bool:
    """Whether a wheel of any group has moved within its contact by more than a tolerance.

    Parameters
    ----------
    before, now
        Profiles by group.
    rates
        Of the case that was run with `before`: with the bins in contact.
    tolerance
        [m], along the normal; 0: every change counts.
    """
    return any(_moved(before[group], now[group], rates[group]) > tolerance for group in rates)


def _moved(before: Profile, now: Profile, rates: GroupRates) -> float:
    """Largest distance of two profiles within the contact of one of them, along the normal [m]."""
    touched = rates.y[rates.contact > 0.0]
    if before is now or touched.size == 0:
        return 0.0
    y = now.y[_near(now.y, touched)]
    if y.size == 0:
        return 0.0
    slope = np.gradient(before.z, before.y)
    lift = np.interp(y, now.y, now.z) - np.interp(y, before.y, before.z)
    return float(np.abs(lift / np.hypot(1.0, np.interp(y, before.y, slope))).max())


def _near(y: FloatArray, places: FloatArray) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Which y lie within the margin of a place."""
    after = np.searchsorted(places, y)
    left = places[np.clip(after - 1, 0, places.size - 1)]
    right = places[np.clip(after, 0, places.size - 1)]
    near: np.ndarray[tuple[int], np.dtype[np.bool_]] = (
        np.minimum(np.abs(y - left), np.abs(y - right)) <= _MARGIN
    )
    return near
