"""The rails in a case file: names of known profiles, or files. See `hh_exudyn.case.track`."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator

from hh_exudyn.case.fields import is_path
from hh_exudyn.contact.profile import Profile, read_rail_profile
from track.rails import Rails


def profile_in_file(reader: Callable[[Path], Profile], path: str) -> Profile:
    """Read a profile; an unreadable file raises ValueError as well.

    Parameters
    ----------
    reader : callable
        `read_wheel_profile` or `read_rail_profile`.
    path : str
        Of the profile file.
    """
    try:
        return reader(Path(path))
    except OSError as error:
        raise ValueError(f"cannot be read: {error.strerror}") from None


def _check_rail(name: str) -> str:
    """A rail is a known name, or a file that can be read."""
    if is_path(name):
        profile_in_file(read_rail_profile, name)
    else:
        Rails(left=name, right=name).left_profile()
    return name


RailName = Annotated[str, AfterValidator(_check_rail)]


def sided(rails: Rails, both: str | None, left: str | None, right: str | None) -> Rails:
    """`rails` with the profiles given for both sides and for each side in their place.

    Parameters
    ----------
    rails : Rails
        The default rails.
    both, left, right : str or None
        Names or paths for both sides, the left and the right one; None for the default.
    """
    return replace(rails, left=left or both or rails.left, right=right or both or rails.right)
