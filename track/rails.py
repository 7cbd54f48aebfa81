"""Which rail profile lies on the left and which on the right of the track.

On the iron-ore line the high and the low rail of a curve differ (Hossein-Nia 2018, table 1-7), so the two
sides are named one by one.
"""

from dataclasses import dataclass
from pathlib import Path

from hh_exudyn.contact.profile import Profile, rail_profile, read_rail_profile


@dataclass(frozen=True)
class Rails:
    """The two rails, each by the name of a standard profile or by the path of a measured one.

    Parameters
    ----------
    left, right : a name that `rail_profile` knows ("60E1"), or a path to an existing profile file
    inclination : of standard profiles towards the track centre, as a slope [-], 0 (upright) to 1/10.
        A measured profile is taken as it lies in its file.
    """

    left: str = "60E1"
    right: str = "60E1"
    inclination: float = 1.0 / 30.0  # Swedish standard track [assumed; not read in a source at hand]

    def __post_init__(self) -> None:
        if not 0.0 <= self.inclination <= 0.1:
            raise ValueError(f"inclination of Rails is {self.inclination} (slope), allowed are 0 to 0.1")

    def left_profile(self) -> Profile:
        """Profile of the left rail in side coordinates. Raises what the profile's reader raises."""
        return self._profile(self.left)

    def right_profile(self) -> Profile:
        """Profile of the right rail in side coordinates. Raises what the profile's reader raises."""
        return self._profile(self.right)

    def _profile(self, name: str) -> Profile:
        path = Path(name)
        if path.is_file():
            return read_rail_profile(path)
        return rail_profile(name, inclination=self.inclination)
