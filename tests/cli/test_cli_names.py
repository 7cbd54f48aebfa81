"""Help texts offer what the registries hold, and nothing else writes those names down."""

from collections.abc import Iterator
from typing import Any

import pytest
import typer
from command_line import call

from damage.material import wheel_materials
from damage.rails.steel import rail_materials
from damage.surface.patch_field import DAMAGE_THEORIES
from damage.wear.archard import SURFACES
from damage.wear.laws import law_names, law_record
from hh_exudyn.cli import names
from hh_exudyn.cli.app import app
from hh_exudyn.contact.profile import RAIL_PROFILES, WHEEL_PROFILES
from hh_exudyn.contact.tangential.registry import THEORIES
from track.line.line_file import line_names
from vehicles.catalogue import vehicle_names

OFFERED = {
    "patch": (("patch",), THEORIES),
    "theories of damage": (("damage",), DAMAGE_THEORIES),
    "steels": (("damage",), wheel_materials()),
    "rail steels": (("damage",), rail_materials()),
    "wear laws": (("damage",), [name for name in law_names() if not law_record(name).needs_options]),
    "surfaces": (("damage",), SURFACES),
    "wheels": (("conicity",), WHEEL_PROFILES),
    "rails": (("conicity",), RAIL_PROFILES),
    "vehicle": (("vehicle", "show"), vehicle_names()),
    "vehicles": (("vehicle", "compare"), vehicle_names()),
    "lines": (("track", "plot"), line_names()),
}


@pytest.mark.parametrize("name", OFFERED)
def test_help_offers_every_name_of_a_registry(name: str) -> None:
    command, known = OFFERED[name]
    shown = call(*command, "--help")
    assert shown.exit_code == 0
    assert ", ".join(known) in " ".join(shown.stdout.split())


def test_a_new_steel_is_offered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(names.LISTS, "steels", lambda: ("ER7", "mine"))
    assert "Wheel steel: ER7, mine." in " ".join(call("damage", "--help").stdout.split())


def commands(group: Any) -> Iterator[Any]:
    """Every command of the program."""
    for command in group.commands.values():
        yield from commands(command) if hasattr(command, "commands") else (command,)


def test_every_list_in_a_help_text_is_there_and_used() -> None:
    """A name in braces has a registry, and its command reads it."""
    used = set()
    for command in commands(typer.main.get_command(app)):
        lists = {name for part in command.params for name in names.PLACE.findall(part.help or "")}
        assert lists <= set(names.LISTS), command.name
        assert not lists or isinstance(command, names.NamesInHelp), command.name
        used |= lists
    assert used == set(names.LISTS)
