"""The command ``validate``: numbers of the toolkit beside numbers from outside, section by section.

Every section is a list of `hh_exudyn.contact.comparison.Comparison` that its package states; here they are
printed, all in one form. A row that does not hold ends the command with exit code 1.
"""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from hh_exudyn.cli import inputs, output

if TYPE_CHECKING:
    from hh_exudyn.contact.comparison import Comparison

HEADINGS = ("quantity", "source", "ours", "outside", "deviation [%]", "allowed [%]", "verdict")
Profiles = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Folder of EN 15302's profiles, RUIC519A/B/H/I.dat and SUIC519A.dat."),
]
LmWheel = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="Wheel profile LM (TB/T 449): GZ18 in a curve against SIMPACK, too."),
]
NOT_RUN = "not run: GZ18 in a curve against SIMPACK: profile LM (TB/T 449) is not at hand (--lm-wheel FILE)"

validate = typer.Typer(help="Compare the toolkit with outside numbers: all of it, or one section.")


def register(app: typer.Typer) -> None:
    """Add the command to the program."""
    app.add_typer(validate, name="validate")


@validate.callback(invoke_without_command=True)
def _all_by_default(context: typer.Context) -> None:
    """Compare the toolkit with outside numbers: all of it, or one section."""
    if context.invoked_subcommand is None:
        everything()


@validate.command("all")
def everything(profiles: Profiles = None, lm_wheel: LmWheel = None) -> None:
    """All sections, one after the other; some minutes."""
    with output.errors_in_one_line():
        _check_files(profiles, lm_wheel)
        files = {"geometry": profiles, "vehicles": lm_wheel}
        _print_verdict([row for name in SECTIONS for row in _compared(name, files.get(name))])


@validate.command("contact")
def validate_contact() -> None:
    """Creep forces and stresses of every theory against the exact solution; Kalker's coefficients."""
    with output.errors_in_one_line():
        from hh_exudyn.contact.tangential.validation import COLUMNS, contact_table, to_table
        from hh_exudyn.contact.validation import coefficient_rows, theory_rows

        with output.status("comparing theories"):
            errors = contact_table()
        rows = _shown("contact", lambda: [*theory_rows(errors), *coefficient_rows()])
        table = output.new_table(
            "Errors of the tangential theories against the exact half-space solution", COLUMNS
        )
        table.padding = (0, 0, 0, 1)  # many columns
        for row in to_table(errors):
            table.add_row(*row)
        output.print_table(table)
        output.print_line(
            "force: in % of friction * normal force; |q| traction, |s| slip, peak of |q|: in % of the exact"
        )
        _print_verdict(rows)


@validate.command("geometry")
def validate_geometry(profiles: Profiles = None) -> None:
    """Conicity against EN 15302's tables, and cones; with --profiles from the standard's wheels and rail."""
    _one("geometry", profiles)


@validate.command("strips")
def validate_strips() -> None:
    """Coupled strips against Hertz's ellipses and CONTACT's conformal poses from tread to flange."""
    _one("strips")


@validate.command("halfspace")
def validate_halfspace() -> None:
    """The exact half-space solver against Hertz, Johnson and CONTACT: pressure, rolling, wheel on rail."""
    _one("halfspace")


@validate.command("vehicles")
def validate_vehicles(lm_wheel: LmWheel = None) -> None:
    """Vehicles against weights, closed forms and other equations; the demo's curve against statics."""
    with output.errors_in_one_line():
        _check_files(None, lm_wheel)
        _print_verdict(_compared("vehicles", lm_wheel))


def _one(name: str, profiles: Path | None = None) -> None:
    """One section as a command."""
    with output.errors_in_one_line():
        _check_files(profiles, None)
        _print_verdict(_compared(name, profiles))


def _check_files(profiles: Path | None, lm_wheel: Path | None) -> None:
    """Raise `BadInput` for profiles that are not there, before anything is computed."""
    if profiles is not None and not profiles.is_dir():
        raise inputs.BadInput(f"--profiles {profiles}: there is no such folder")
    if lm_wheel is not None and not lm_wheel.is_file():
        raise inputs.BadInput(f"--lm-wheel {lm_wheel}: there is no such file")


def _contact() -> "list[Comparison]":
    from hh_exudyn.contact.tangential.validation import contact_table
    from hh_exudyn.contact.validation import coefficient_rows, theory_rows

    return [*theory_rows(contact_table()), *coefficient_rows()]


def _geometry(profiles: Path | None = None) -> "list[Comparison]":
    from hh_exudyn.contact.geometry.validation import geometry_table

    with inputs.refused_as_bad_input():  # a file is missing or is no profile
        return geometry_table(profiles)


def _strips() -> "list[Comparison]":
    from hh_exudyn.contact.strips.validation import strips_table

    return strips_table()


def _halfspace() -> "list[Comparison]":
    from hh_exudyn.contact.halfspace.validation import halfspace_table

    return halfspace_table()


def _vehicles(lm_wheel: Path | None = None) -> "list[Comparison]":
    from hh_exudyn.multibody.validation import vehicles_table

    with inputs.refused_as_bad_input():  # the file is no profile
        return vehicles_table(lm_wheel)


SECTIONS: "dict[str, tuple[str, Callable[..., list[Comparison]]]]" = {
    "contact": ("Theories of creep forces and Kalker's coefficients", _contact),
    "geometry": ("Contact geometry", _geometry),
    "strips": ("Coupled strips", _strips),
    "halfspace": ("The half-space solver", _halfspace),
    "vehicles": ("Vehicles on their track", _vehicles),
}


def _compared(name: str, file: Path | None) -> "list[Comparison]":
    """Compare and print a section, with the profiles of others where it has some."""
    compare = SECTIONS[name][1]
    rows = _shown(name, compare if file is None else lambda: compare(file))
    if name == "vehicles" and file is None:
        output.print_line(NOT_RUN)
    return rows


def _shown(name: str, compare: "Callable[[], list[Comparison]]") -> "list[Comparison]":
    """Compare and print a section."""
    with output.status(f"comparing {name}"):
        rows = compare()
    table = output.new_table(f"{SECTIONS[name][0]} against numbers from outside", HEADINGS)
    table.padding = (0, 0, 0, 1)  # many columns
    for column in table.columns[:2]:
        column.justify, column.no_wrap = "left", False  # in a narrow terminal words wrap, numbers stay whole
    for row in rows:
        table.add_row(
            row.quantity,
            row.source,
            f"{row.found:.4g}",
            f"{row.wanted:.4g}",
            output.number(100.0 * row.deviation, 2),
            f"{100.0 * row.allowed:.3g}",
            "holds" if row.holds else "FAILS",
        )
    output.print_table(table)
    return rows


def _print_verdict(rows: "list[Comparison]") -> None:
    """How many rows hold; exit code 1 where one does not."""
    output.print_line("an error, or a worst deviation of many: ours is the deviation itself, outside 0")
    failing = sum(not row.holds for row in rows)
    output.print_line(f"{len(rows) - failing} of {len(rows)} comparisons hold")
    if failing:
        output.fail(output.FAULT, f"{failing} of {len(rows)} comparisons fail")
