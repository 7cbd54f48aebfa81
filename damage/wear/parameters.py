"""The parameters of the wear laws, each with its source: `damage/data/wear.toml`."""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib import resources


@dataclass(frozen=True)
class Parameter:
    """A number of a wear law.

    Attributes
    ----------
    value
        In `unit`.
    unit
        Unit of the source, not always SI.
    source
        Begins with published, derived or assumed.
    confirmed
        Whether the number was read on the source's own page (T: the thesis's); if not, it is from memory or
        second hand.
    """

    value: float
    unit: str
    source: str
    confirmed: bool


@cache
def _tables() -> dict[str, dict[str, Parameter]]:
    text = resources.files("damage").joinpath("data/wear.toml").read_text(encoding="utf-8")
    return {
        law: {name: Parameter(**entry) for name, entry in entries.items()}
        for law, entries in tomllib.loads(text).items()
    }


def parameters(law: str) -> dict[str, Parameter]:
    """The parameters of a law by name: "jendel", "surface", "british_rail" or "usfd"."""
    return dict(_tables()[law])
