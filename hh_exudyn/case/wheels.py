"""Wheel profiles of a case: one for all wheels, others by side, wheelset or wheel.

::

    wheel_profile = "S1002"

    [wheel_profiles]
    R = "right.prf"       # all right wheels
    2 = "worn.prf"        # both wheels of wheelset 2, counted through all units from the leading end
    2R = "flat.prf"       # its right wheel

The most particular counts: a wheel before its wheelset, that before its side, that before all. Values are
names of profiles or files, as for ``wheel_profile``.
"""

import hashlib
import re
from collections.abc import Mapping
from functools import lru_cache
from typing import Any, Self

from pydantic import ConfigDict, model_validator

from hh_exudyn.case.fields import CaseTable, is_path
from hh_exudyn.contact.profile import Profile, read_wheel_profile, wheel_profile
from hh_exudyn.contact.profiles.measures import flange_thickness
from hh_exudyn.text_files import read_bytes

_KEY = re.compile(r"([1-9]\d*)?([LR])?")
_OTHER = {"L": "R", "R": "L"}


class WheelProfilesCase(CaseTable):
    """Profiles by ``"L"``, ``"R"``, ``"1"``, ``"1L"``, ...: side, wheelset, wheel."""

    model_config = ConfigDict(frozen=True, extra="allow", strict=True, allow_inf_nan=False)
    __pydantic_extra__: dict[str, str]

    @model_validator(mode="before")
    @classmethod
    def _check_keys(cls, data: Any) -> Any:
        for key, value in data.items() if isinstance(data, Mapping) else ():
            if not key or not _KEY.fullmatch(key):
                raise ValueError(f'key {key}: allowed a side "L" or "R", a wheelset "1", a wheel "1L"')
            if not isinstance(value, str):
                raise ValueError(f"{key} = {value!r}: allowed the name or the file of a wheel profile")
            try:
                read_wheel(value)
            except ValueError as error:
                raise ValueError(f"{key} = {value}: {error}") from None
        return data

    @property
    def by_place(self) -> dict[str, str]:
        """The table itself."""
        return dict(self.__pydantic_extra__)

    def mirrored(self) -> Self:
        """Left and right exchanged."""
        return type(self).model_validate({_mirrored(key): value for key, value in self.by_place.items()})


def read_wheel(name: str) -> Profile:
    """A wheel profile by its name, or from its file. Raises ValueError as these do."""
    if not is_path(name):
        return wheel_profile(name)
    try:
        content = read_bytes(name)
    except ValueError:
        return read_wheel_profile(name)  # which says what is wrong with the file
    return _of_content(name, hashlib.sha256(content).digest())


@lru_cache(maxsize=64)  # a case with a file for every wheel asks for them ten times, 40 ms each
def _of_content(path: str, digest: bytes) -> Profile:
    """The profile of a file; its content is part of the key, as a file may be written anew."""
    return read_wheel_profile(path)


def wheel_names(others: WheelProfilesCase | None, profile: str, wheelsets: int) -> list[tuple[str, str]]:
    """Names or files of the left and the right profile of every wheelset.

    Parameters
    ----------
    others : WheelProfilesCase or None
        The table of a case.
    profile : str
        Of the wheels that it does not name.
    wheelsets : int
        Of the vehicle.

    Raises
    ------
    ValueError
        The table names a wheelset that the vehicle does not have.
    """
    table = {} if others is None else others.by_place
    for key in table:
        number = key.rstrip("LR")
        if number and int(number) > wheelsets:
            raise ValueError(f"wheel_profiles.{key}: the vehicle has wheelsets 1 to {wheelsets}")
    return [(_of(table, i, "L", profile), _of(table, i, "R", profile)) for i in range(1, wheelsets + 1)]


def widest_flanges(names: list[tuple[str, str]]) -> float:
    """The largest sum of the flange thicknesses of a wheelset [m].

    Parameters
    ----------
    names : list of (str, str)
        Of `wheel_names`.
    """
    thickness = {name: flange_thickness(read_wheel(name)) for pair in names for name in pair}
    return max(thickness[left] + thickness[right] for left, right in names)


def _of(table: Mapping[str, str], wheelset: int, side: str, otherwise: str) -> str:
    """The most particular profile of a wheel."""
    keys = (f"{wheelset}{side}", f"{wheelset}", side)
    return next((table[key] for key in keys if key in table), otherwise)


def _mirrored(key: str) -> str:
    return key[:-1] + _OTHER[key[-1]] if key[-1] in _OTHER else key
