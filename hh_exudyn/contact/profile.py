"""The front of `hh_exudyn.contact.profiles`: `Profile`, standard shapes, readers."""

from hh_exudyn.contact.profiles.library import (
    MAX_INCLINATION,
    RAIL_PROFILES,
    WHEEL_PROFILES,
    rail_profile,
    wheel_profile,
)
from hh_exudyn.contact.profiles.profile import Profile, gauge_point
from hh_exudyn.contact.profiles.reader import read_profile, read_rail_profile, read_wheel_profile

__all__ = [
    "MAX_INCLINATION",
    "RAIL_PROFILES",
    "WHEEL_PROFILES",
    "Profile",
    "gauge_point",
    "rail_profile",
    "read_profile",
    "read_rail_profile",
    "read_wheel_profile",
    "wheel_profile",
]
