"""The commands about vehicles: ``vehicle list``, ``show``, ``compare``, ``export``, ``new``.

They compute nothing themselves.

Large packages are imported inside the commands, so that ``--help`` is fast.
"""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from hh_exudyn.cli import inputs, output
from hh_exudyn.cli.names import NamesInHelp

if TYPE_CHECKING:
    from hh_exudyn.sourced import Difference, Parameter, ParameterSet
    from vehicles.description import Vehicle
    from vehicles.variants import Variant

vehicle = typer.Typer(help="Look at vehicles, compare and write them.", no_args_is_help=True)

NewDrawing = Annotated[
    Path | None,
    typer.Option("--figure", metavar="FILE", help="Draw side and top view into this new file."),
]
Source = Annotated[
    str, typer.Argument(metavar="NAME|FILE", help="A vehicle file (.toml, .json), or one of {vehicles}.")
]
NewVehicleFile = Annotated[
    Path | None,
    typer.Option("-o", "--out", metavar="FILE.toml", help="Write to this new file, not to the screen."),
]


def register(app: typer.Typer) -> None:
    """Add the commands of this file to the program."""
    app.add_typer(vehicle, name="vehicle")


@vehicle.callback()
def _vehicle() -> None:
    """Look at vehicles, compare and write them."""


@vehicle.command(name="list")
def list_vehicles() -> None:
    """The vehicles of the catalogue."""
    with output.errors_in_one_line():
        from vehicles.catalogue import catalogued, vehicle_names
        from vehicles.catalogue import vehicle as described

        table = output.new_table("Vehicles", ("name", "mass [t]", "wheelsets", "description"))
        for column in (0, 3):
            table.columns[column].justify = "left"
        for name in vehicle_names():
            one = described(name)
            table.add_row(
                name, f"{1e-3 * one.mass:.1f}", f"{len(one.wheelsets)}", catalogued(name).description
            )
        output.print_table(table)


@vehicle.command(cls=NamesInHelp)
def show(source: Source, figure: NewDrawing = None) -> None:
    """Numbers of a vehicle with their sources, masses, axle loads, and a drawing to scale."""
    with output.errors_in_one_line():
        inputs.require_new_file(figure, "--figure", inputs.FIGURES)
        variant = _variant(source)
        from vehicles.variants import is_vehicle_file

        described = variant.vehicle()
        parameters = variant.parameters()
        places = variant.document().coordinates() if is_vehicle_file(variant.base) else frozenset()
        output.print_table(_parameter_table(f"Parameters of {variant.name}", parameters, places))
        if places:
            output.print_line(f"{len(places)} coordinates of places are in its file")
        if variant.description:
            output.print_line(f"{variant.name}: {variant.description}")
        output.print_line(_count(parameters))
        changes = variant.differences()
        if changes or (not is_vehicle_file(variant.base) and variant.name != variant.base):
            output.print_line(f"based on {variant.base}, {_difference_count(len(changes))}")
        if changes:
            output.print_table(_difference_table(f"Differences from {variant.base}", changes, variant.base))
        output.print_table(_mass_table(described))
        output.print_table(_axle_table(described))
        if figure is not None:
            from hh_exudyn.figures.vehicle import summary, vehicle_sheet

            title = f"{variant.name}: {summary(described)}"
            output.write_figure(vehicle_sheet(title, described), figure, "--figure")


@vehicle.command(cls=NamesInHelp)
def compare(first: Source, second: Source) -> None:
    """The numbers in which two vehicles differ."""
    with output.errors_in_one_line():
        from hh_exudyn.sourced import differences

        one, other = _variant(first), _variant(second)
        found = differences(one.parameters(), other.parameters())
        title = f"From {one.name} to {other.name}"
        if found:
            output.print_table(_difference_table(title, found, one.name))
        output.print_line(f"{title}: {_difference_count(len(found))}")


@vehicle.command(cls=NamesInHelp)
def export(source: Source, out: NewVehicleFile = None) -> None:
    """A vehicle as a file with all bodies, couplings and numbers, each with unit and source."""
    with output.errors_in_one_line():
        from vehicles.whole.writing import to_toml

        inputs.require_new_file(out, "-o", inputs.VEHICLES)
        variant = _variant(source)
        _write(to_toml(variant.document(), f"written by hh-exudyn vehicle export {source}"), out)


@vehicle.command(cls=NamesInHelp)
def new(
    template: Annotated[str, typer.Argument(metavar="TEMPLATE", help="One of {templates}.")],
    out: NewVehicleFile = None,
) -> None:
    """A vehicle file to start from: a whole vehicle, with a head that explains how it is written."""
    with output.errors_in_one_line():
        from vehicles.whole.templates import template as template_of

        inputs.require_new_file(out, "-o", inputs.VEHICLES)
        with inputs.refused_as_bad_input():
            text = template_of(template, "" if out is None else out.stem)
        _write(text, out)


def _write(text: str, out: Path | None) -> None:
    """Text of a file into a new file, or to the screen."""
    if out is None:
        typer.echo(text, nl=False)
        return
    output.write_text(text, out, "-o", "vehicle")


def _variant(source: str) -> "Variant":
    """The vehicle of a name or file; raises `BadInput` for anything else."""
    from hh_exudyn.case.vehicle import variant_behind
    from vehicles.variants import find_variant

    with inputs.refused_as_bad_input():
        return variant_behind(source) or find_variant(source)


def _difference_count(count: int) -> str:
    """Number of differences, as part of a message."""
    return "1 number differs" if count == 1 else f"{count or 'no'} numbers differ"


def _parameter_table(title: str, parameters: "ParameterSet", left_out: frozenset[str]) -> Table:
    """A line per number, the parts one after the other; assumed and changed ones are marked."""
    table = _text_table(title, ("part", "number", "value", "unit", "", "source"))
    part = ""
    for parameter in parameters.parameters:
        if parameter.name in left_out:
            continue
        own, number = parameter.name.split(".", 1)
        if part and own != part:
            table.add_section()
        table.add_row(
            "" if own == part else own,
            number,
            f"{parameter.value:g}",
            parameter.unit,
            _MARKS.get(parameter.kind, ""),
            parameter.source,
        )
        part = own
    return table


_MARKS = {"assumed": "?", "variant": "!"}


def _count(parameters: "ParameterSet") -> str:
    """Counts of published, derived, assumed and changed numbers, in one line."""
    from hh_exudyn.sourced import KINDS, VARIANT

    counts = {kind: len(parameters.of_kind(kind)) for kind in (*KINDS, VARIANT)}
    parts = [
        f"{count} {kind}{f' ({_MARKS[kind]})' if kind in _MARKS else ''}"
        for kind, count in counts.items()
        if count
    ]
    return f"{len(parameters.parameters)} numbers: {', '.join(parts)}"


def _difference_table(title: str, found: "tuple[Difference, ...]", base: str) -> Table:
    """A line per number that differs; a dash where one of the two vehicles lacks it."""
    table = _text_table(title, ("number", "unit", f"in\u00a0{base}", "here", "source"))
    for one in found:
        shown = one.after or one.before
        units = dict.fromkeys(side.unit for side in (one.before, one.after) if side is not None)
        table.add_row(
            one.name,
            " / ".join(units),
            _value(one.before),
            _value(one.after),
            shown.source if shown is not None and one.after is not None else output.NOTHING,
        )
    return table


def _value(parameter: "Parameter | None") -> str:
    return output.NOTHING if parameter is None else f"{parameter.value:g}"


def _text_table(title: str, headings: tuple[str, ...]) -> Table:
    """A table with wrapped text in its last column."""
    table = output.new_table(title, headings)
    for column, heading in zip(table.columns, headings, strict=True):
        if heading in ("part", "number", "unit", "", "source"):
            column.justify = "left"
    table.columns[-1].no_wrap = False
    table.columns[-1].overflow = "fold"
    return table


def _mass_table(described: "Vehicle") -> Table:
    """A line per group of equal bodies."""
    table = output.new_table(
        f"Masses of {described.name}, {1e-3 * described.mass:.2f} t",
        ("body", "number", "mass [kg]", "Ix [kg m²]", "Iy [kg m²]", "Iz [kg m²]", "height [m]"),
    )
    table.columns[0].justify = "left"
    counts: dict[tuple[str, float, tuple[float, ...], float], int] = {}
    for body in described.bodies:
        key = (body.kind, body.mass, body.inertia, body.position[2])
        counts[key] = counts.get(key, 0) + 1
    for (kind, mass, inertia, height), count in counts.items():
        moments = (f"{moment:.0f}" for moment in inertia)
        table.add_row(kind.replace("_", " "), f"{count}", f"{mass:.0f}", *moments, f"{height:.3f}")
    return table


def _axle_table(described: "Vehicle") -> Table:
    """A line per wheelset: place, wheels, static load."""
    from hh_exudyn.conventions import GRAVITY
    from vehicles.statics import axle_loads

    table = output.new_table(
        "Wheelsets at rest", ("wheelset", "bogie", "x [m]", "wheels [mm]", "load [kN]", "load [t]")
    )
    try:
        loads = axle_loads(described)
    except ValueError:  # a reference vehicle may be held by its train alone
        loads = [math.nan] * len(described.wheelsets)
    for number, (wheelset, load) in enumerate(zip(described.wheelsets, loads, strict=True), start=1):
        table.add_row(
            f"{number}",
            f"{wheelset.bogie}",
            f"{described.body(wheelset.body).position[0]:.3f}",
            f"{2e3 * wheelset.radius:.0f}",
            output.NOTHING if math.isnan(load) else f"{1e-3 * load:.1f}",
            output.NOTHING if math.isnan(load) else f"{1e-3 * load / GRAVITY:.2f}",
        )
    return table
