"""The command ``parameters``: every number of the toolkit's data files with unit, source and kind.

Large packages are imported inside the command, so that ``--help`` is fast.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from hh_exudyn.cli import inputs, output

if TYPE_CHECKING:
    from hh_exudyn.sourced import Parameter

GROUPS = ("vehicle", "track", "profiles", "steel", "wear", "assessment")

_Numbers = Iterator[tuple[str, "tuple[Parameter, ...]"]]  # name of a file or record, its numbers


def register(app: typer.Typer) -> None:
    """Add the command of this file to the program."""
    app.command()(parameters)


def parameters(
    group: Annotated[
        str | None, typer.Argument(metavar="[GROUP]", help=f"One of {', '.join(GROUPS)}; all without it.")
    ] = None,
    assumed: Annotated[bool, typer.Option("--assumed", help="Only the numbers that are assumed.")] = False,
) -> None:
    """The numbers of vehicles, track, profiles, wheel steels, wear laws and the assessment, with sources."""
    with output.errors_in_one_line():
        if group is not None and group not in GROUPS:
            raise inputs.BadInput(f"GROUP {group}: allowed {', '.join(GROUPS)}")
        total = guessed = 0
        for name in GROUPS if group is None else (group,):
            for title, numbers in _GROUPS[name]():
                total += len(numbers)
                of_kind = tuple(number for number in numbers if number.kind == "assumed")
                guessed += len(of_kind)
                shown = of_kind if assumed else numbers
                if shown:
                    output.print_table(_table(f"{name}: {title}", shown))
        output.print_line(
            f"{total} numbers, {guessed} of them assumed; * not confirmed: from memory or second hand"
        )


def _table(title: str, numbers: "tuple[Parameter, ...]") -> Table:
    """A line per number."""
    table = output.new_table(title, ("number", "value", "unit", "range", "kind", "source"))
    for column in (0, 2, 4, 5):
        table.columns[column].justify = "left"
    table.columns[-1].no_wrap = False
    table.columns[-1].overflow = "fold"
    for number in numbers:
        span = "" if number.range is None else f"{number.range[0]:g} to {number.range[1]:g}"
        kind = number.kind if number.confirmed else f"{number.kind}*"
        source = number.source.removeprefix(number.kind).removeprefix(":").strip()
        table.add_row(number.name, f"{number.value:g}", number.unit, span, kind, source)
    return table


def _vehicles() -> _Numbers:
    """Each vehicle once: the loaded and the empty wagon share their file but for the payload."""
    from hh_exudyn.sourced import load_parameters
    from vehicles.catalogue import parameters as of_vehicle
    from vehicles.catalogue import vehicle_names

    shown: set[Parameter] = set()
    for name in vehicle_names():
        new = tuple(number for number in of_vehicle(name).parameters if number not in shown)
        shown.update(new)
        yield name, new
    yield "curve resistance of trains", load_parameters("vehicles", "curve_resistance").parameters


def _track() -> _Numbers:
    from hh_exudyn.sourced import load_parameters
    from track.line.line_file import line_names
    from track.line.line_numbers import line_numbers

    for file in ("flexibility", "friction", "quality", "spectra"):
        yield file, load_parameters("track", file).parameters
    for name in line_names():
        yield f"line {name}", line_numbers(name)


def _profiles() -> _Numbers:
    from hh_exudyn.sourced import load_parameters

    yield "line_profiles", load_parameters("hh_exudyn", "line_profiles").parameters


def _steel() -> _Numbers:
    from hh_exudyn.sourced import load_parameters

    for file in ("materials", "rail_materials"):
        yield file, load_parameters("damage", file).parameters


def _wear() -> _Numbers:
    from hh_exudyn.sourced import load_parameters

    yield "wear", load_parameters("damage", "wear").parameters


def _assessment() -> _Numbers:
    from hh_exudyn.sourced import load_parameters

    yield "assessment", load_parameters("hh_exudyn", "assessment").parameters


_GROUPS = dict(zip(GROUPS, (_vehicles, _track, _profiles, _steel, _wear, _assessment), strict=True))
