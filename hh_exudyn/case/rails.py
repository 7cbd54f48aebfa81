"""The rails in a case file: names of known profiles, or files. See `hh_exudyn.case.track`."""

from dataclasses import replace
from typing import Annotated

from pydantic import AfterValidator

from track.rails import Rails


def _check_rail(name: str) -> str:
    """A rail is a known name, or a file that can be read."""
    rails = Rails(left=name, right=name)
    rails.left_profile()
    if name.lower().endswith(".rai"):  # VAMPIRE's, which holds both sides
        rails.right_profile()
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
