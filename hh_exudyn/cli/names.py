"""Names of registries in help texts: read from the registries themselves, where a help text is shown.

A help text has the name of a list in braces, as ``"Wheel steel: {steels}."``, and its command the class
`NamesInHelp`. The registries are imported no earlier: a program that only starts does not pay for them.
"""

import re
from collections.abc import Callable, Iterable
from typing import Any

from typer.core import TyperCommand


def _theories() -> Iterable[str]:
    from hh_exudyn.contact.tangential.registry import THEORIES

    return THEORIES


def _damage_theories() -> Iterable[str]:
    from damage.surface.patch_field import DAMAGE_THEORIES

    return DAMAGE_THEORIES


def _normal_contacts() -> Iterable[str]:
    from damage.surface.normal_contact import NORMAL_CONTACTS

    return NORMAL_CONTACTS


def _wear_laws() -> Iterable[str]:
    from damage.wear.laws import names_for_help

    return (names_for_help(),)


def _surfaces() -> Iterable[str]:
    from damage.wear.archard import SURFACES

    return SURFACES


def _steels() -> Iterable[str]:
    from damage.material import wheel_materials

    return wheel_materials()


def _rail_steels() -> Iterable[str]:
    from damage.rails.steel import rail_materials

    return rail_materials()


def _vehicles() -> Iterable[str]:
    from vehicles.catalogue import vehicle_names

    return vehicle_names()


def _templates() -> Iterable[str]:
    from vehicles.whole.templates import TEMPLATES

    return TEMPLATES


def _lines() -> Iterable[str]:
    from track.line.line_file import line_names

    return line_names()


def _wheels() -> Iterable[str]:
    from hh_exudyn.contact.profile import WHEEL_PROFILES

    return WHEEL_PROFILES


def _rails() -> Iterable[str]:
    from hh_exudyn.contact.profile import RAIL_PROFILES

    return RAIL_PROFILES


LISTS: dict[str, Callable[[], Iterable[str]]] = {
    "theories": _theories,
    "damage_theories": _damage_theories,
    "normal_contacts": _normal_contacts,
    "wear_laws": _wear_laws,
    "surfaces": _surfaces,
    "steels": _steels,
    "rail_steels": _rail_steels,
    "vehicles": _vehicles,
    "templates": _templates,
    "lines": _lines,
    "wheels": _wheels,
    "rails": _rails,
}
PLACE = re.compile(r"\{(\w+)\}")


class NamesInHelp(TyperCommand):
    """A command whose help texts hold names of `LISTS` in braces."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help, each name in braces replaced by the names of its registry."""
        for parameter in self.params:
            text = getattr(parameter, "help", None)
            if text:
                filled = PLACE.sub(lambda match: ", ".join(LISTS[match[1]]()), text)
                parameter.help = filled  # type: ignore[attr-defined]
        super().format_help(ctx, formatter)
