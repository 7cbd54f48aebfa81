"""Places of a wheel: tread, root and flange by where they lie on the profile, and the bands of RCF.

A contact angle does not tell a root from a tread: roots that are touched at 11 to 13 degrees count as tread
with a limit of 15 degrees (`damage.rcf.surface_index.FLANGE_CONTACT_ANGLE`). By place:

* flange: from the flange face 10 mm below the running circle (where Sd is measured) to the flange back;
* root: the 20 mm before it (`assumed`, ``damage/data/limits.toml``): S1002 y = 17.5 .. 37.5 mm, WP4
  23.1 .. 43.1 mm;
* tread: all on the field side of the root.

The places are those of the profile that the wheel is turned to, and do not move while it wears. On the tread
lie the two bands of cracks of LKAB's locomotives (Hossein-Nia 2018, page 4, in mm for the printed m).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from damage.bounds import check_above_zero
from damage.life.limits import limit
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.measures import flange_thickness
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE

PLACES = ("tread", "root", "flange")
BANDS = {"field_band": (-0.050, -0.020), "middle_band": (-0.020, 0.0)}
"""Bands of the tread: lateral coordinate from and to [m]."""


@dataclass(frozen=True)
class WheelPlaces:
    """Where root and flange of a wheel begin.

    Attributes
    ----------
    root
        Lateral coordinate at which the root begins [m].
    flange
        Lateral coordinate at which the flange begins [m].

    Raises
    ------
    ValueError
        The root does not begin between the running circle and the flange.
    """

    root: float
    flange: float

    def __post_init__(self) -> None:
        if not 0.0 < self.root < self.flange:
            raise ValueError(
                f"root from y = {1e3 * self.root:.4g} mm, flange from {1e3 * self.flange:.4g} mm: allowed "
                "is 0 < root < flange"
            )

    @classmethod
    def of(cls, wheel: Profile, root_width: float | None = None) -> "WheelPlaces":
        """Places of a wheel profile.

        Parameters
        ----------
        wheel
            The profile that the wheel is turned to.
        root_width
            Lateral width of the root [m]; None takes that of ``damage/data/limits.toml``.

        Raises
        ------
        ValueError
            A rail, or a width that is not above zero or reaches the running circle.
        """
        width = limit("places", "root_width") if root_width is None else root_width
        check_above_zero("root_width", width, "m", "a wheel")
        face = FLANGE_BACK_TO_RUNNING_CIRCLE - flange_thickness(wheel)
        return cls(face - width, face)

    def within(self, place: str, y: ArrayLike) -> NDArray[np.bool_]:
        """Whether lateral positions lie in a place or a band.

        Parameters
        ----------
        place
            One of `PLACES` or `BANDS`.
        y
            Lateral positions [m].

        Raises
        ------
        ValueError
            There is no such place.
        """
        ranges = {
            "tread": (-np.inf, self.root),
            "root": (self.root, self.flange),
            "flange": (self.flange, np.inf),
        } | BANDS
        if place not in ranges:
            raise ValueError(f"place {place!r} of a wheel; there are {', '.join(ranges)}")
        low, high = ranges[place]
        lateral = np.asarray(y, dtype=np.float64)
        return np.asarray((lateral >= low) & (lateral < high))

    def largest(self, values: ArrayLike, y: ArrayLike) -> dict[str, float]:
        """Largest value of each place and band; 0 where nothing lies in it.

        Parameters
        ----------
        values, y
            (n,) values >= 0 and their lateral positions [m].
        """
        of = np.asarray(values, dtype=np.float64)
        return {place: float(of[self.within(place, y)].max(initial=0.0)) for place in (*PLACES, *BANDS)}
