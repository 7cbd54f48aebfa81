"""Files to start a vehicle from: a whole vehicle each, with a head that explains the grammar."""

import difflib
import re
from collections.abc import Callable
from dataclasses import replace
from importlib.resources import files

from vehicles.catalogue import vehicle_names
from vehicles.variants import find_variant
from vehicles.whole.writing import to_toml

_NAME = re.compile(r'^name = ".*"$', re.MULTILINE)
_Y25 = "y25_wagon_loaded"
_GRAMMAR = """Lists place the bodies, couplings and wheelsets on the drawing: x forward from the middle, y to
the left, z up from the rail tops, in metres, all springs unloaded. Equal entries share a part, a table [name]
with their numbers in any unit that is named, each with its source: "published: ...", "derived: ..." or
"assumed: ...".
A number may be bare too (SI), or "1.5 MN/m"; mirror = true in an entry adds its copy on the right.

Look at it:      hh-exudyn vehicle show FILE --figure side.png
Run it:          hh-exudyn run CASE.toml --vehicle FILE --out DIR
Change a number: hh-exudyn run CASE.toml --vehicle FILE --set part.number=VALUE --out DIR"""


def _catalogued(vehicle: str, title: str) -> str:
    """The vehicle of the catalogue as the file of another one."""
    written = f'written from {vehicle}; a source "derived: from ..." names numbers of that'
    head = f"{title}\n{written}\n\n{_GRAMMAR}"
    document = find_variant(vehicle).document()
    return to_toml(replace(document, source=f"assumed: as in {vehicle}, or changed without a source"), head)


def _tank_wagon() -> str:
    """Written by hand, the Lenoir links linearised."""
    return files("vehicles").joinpath("data/tank_wagon.toml").read_text(encoding="utf-8")


def _y25_wagon() -> str:
    """The catalogue's, where it has one."""
    if _Y25 not in vehicle_names():
        return _tank_wagon()
    return _catalogued(_Y25, "A tank wagon on two Y25 bogies.")


TEMPLATES: dict[str, Callable[[], str]] = {
    "three_piece_wagon": lambda: _catalogued("iore_wagon_loaded", "A wagon on two three-piece bogies."),
    "y25_wagon": _y25_wagon,
    "tank_wagon": _tank_wagon,
    "co_co": lambda: _catalogued("iore_locomotive", "A locomotive on two bogies of three driven wheelsets."),
}
"""Text of every template by name."""


def template(name: str, called: str = "") -> str:
    """The text of a template.

    Parameters
    ----------
    name : str
        Of the template.
    called : str
        Name of the vehicle in it, in place of its own.

    Raises
    ------
    ValueError
        There is none of that name.
    """
    if name not in TEMPLATES:
        near = difflib.get_close_matches(name, TEMPLATES, n=1, cutoff=0.6)
        hint = f'; did you mean "{near[0]}"?' if near else ""
        raise ValueError(f"template {name!r} is not known; known: {', '.join(TEMPLATES)}{hint}")
    text = TEMPLATES[name]()
    return _NAME.sub(f'name = "{called}"', text, count=1) if called else text
