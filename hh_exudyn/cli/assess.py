"""The command ``assess``: a run after UIC 518 / EN 14363. It computes nothing itself.

Kilonewtons and millimetres exist here and nowhere deeper. Everything heavy is imported inside the command, so
that ``--help`` answers at once.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.markup import escape
from rich.table import Table

from hh_exudyn.cli.output import (
    NOTHING,
    NewFigure,
    Refused,
    check,
    new_table,
    number,
    out,
    print_table,
    require_new_figure,
    told,
    write_figure,
)

if TYPE_CHECKING:
    from hh_exudyn.assessment.report import Assessment

_SHOWN = {  # quantity: heading, factor, digits
    "sum_y": ("sum Y, 2 m [kN]", 1e-3, 1),
    "y_over_q": ("Y/Q, 2 m [-]", 1.0, 3),
    "q": ("Q [kN]", 1e-3, 1),
    "y_quasi_static": ("Y quasi-static [kN]", 1e-3, 1),
    "q_quasi_static": ("Q quasi-static [kN]", 1e-3, 1),
    "body_lateral": ("body lateral [m/s2]", 1.0, 2),
    "body_vertical": ("body vertical [m/s2]", 1.0, 2),
    "body_lateral_rms": ("body lateral, rms [m/s2]", 1.0, 2),
    "body_vertical_rms": ("body vertical, rms [m/s2]", 1.0, 2),
    "body_lateral_quasi_static": ("body lateral, quasi-static [m/s2]", 1.0, 2),
    "sum_y_rms": ("sum Y about f0, rms [kN]", 1e-3, 1),
    "bogie_lateral_rms": ("bogie lateral about f0, rms [m/s2]", 1.0, 2),
}


def register(app: typer.Typer) -> None:
    """Give the command of this file to the program."""
    app.command()(assess)


def assess(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder of a run.")],
    figure: NewFigure = None,
    table: Annotated[
        Path | None,
        typer.Option(metavar="F.csv", help="Write every section and place to this new file, in SI."),
    ] = None,
    unit: Annotated[int, typer.Option(metavar="N", help="Of a vehicle of several units, 1 leading.")] = 1,
    section_length_m: Annotated[
        float | None,
        typer.Option(metavar="m", help="Of test sections. [default: 250 on straights, 70 or 100 in curves]"),
    ] = None,
) -> None:
    """Forces and accelerations of a run after UIC 518 / EN 14363, by test sections, and their limits."""
    with told(folder):
        if section_length_m is not None:
            check("--section-length-m", section_length_m, 10.0, 1000.0, "m")
        require_new_figure(figure)
        _require_new_table(table)
        found = _assessed(folder, unit, section_length_m)
        _show(found, folder.name)
        if table is not None:
            import pyarrow.csv

            try:
                pyarrow.csv.write_csv(found.to_table(), table)
            except OSError as error:
                raise Refused(f"--table {table}: {error.strerror}") from None
            out.print(f"table: {table}")
        if figure is not None:
            from hh_exudyn.figures.assessment import assessment_sheet

            write_figure(assessment_sheet(f"{folder.name}: {found.vehicle.name}", found), figure)


def _require_new_table(path: Path | None) -> None:
    """Refuse a table that cannot be written, before any work."""
    if path is None:
        return
    if path.suffix.lower() != ".csv":
        raise Refused(f"--table {path}: allowed is .csv")
    if path.exists():
        raise Refused(f"--table {path}: exists already, allowed is a new file")
    if not path.parent.is_dir():
        raise Refused(f"--table {path}: there is no folder {path.parent}")


def _assessed(folder: Path, unit: int, section_length: float | None) -> "Assessment":
    """The assessment of the run in a folder; a run that cannot be assessed is bad input."""
    from hh_exudyn.assessment.report import assess as assess_run
    from hh_exudyn.log.store import open_run

    try:
        return assess_run(open_run(folder), unit, section_length)
    except (FileNotFoundError, ValueError) as error:
        raise Refused(str(error)) from None


def _show(found: "Assessment", name: str) -> None:
    """Test sections, the largest values by kind of section, and where their limits are from."""
    print_table(_section_table(found, name))
    print_table(_value_table(found))
    out.print(f"f0, the peak of the spectrum of sum Y: {found.instability_frequency:.2f} Hz")
    out.print("? limit unconfirmed: read neither in the standard nor where it is cited. Limits are from:")
    for quantity, limit in found.limits.items():
        out.print(f"  {_SHOWN[quantity][0]}: {limit.source}", markup=False)
    if found.beyond:
        out.print(
            "the axle load is above the 25 t that EN 14363 with EN 15687 goes to: limits are a comparison"
        )
    out.print("quality of the track of the run: hh-exudyn track plot DIR/case.toml")


def _section_table(found: "Assessment", name: str) -> Table:
    """A line per test section."""
    result = new_table(f"Test sections of {name}", ("from [m]", "to [m]", "kind", "radius [m]", "hand"))
    for section in found.sections:
        radius = f"{section.radius:.0f}" if section.curved else NOTHING
        result.add_row(
            f"{section.start:.1f}", f"{section.end:.1f}", section.kind, radius, section.hand or NOTHING
        )
    return result


def _value_table(found: "Assessment") -> Table:
    """A line per kind of section and quantity: its largest value, where, and the limit."""
    result = new_table(
        "Largest values by kind of section",
        ("quantity", "value", "limit", "used\u00a0[%]", "from [m]", "place"),
    )
    kind = ""
    for finding in found.worst():
        if finding.section.kind != kind:
            kind = finding.section.kind
            result.add_row(kind, *[""] * 5)
        heading, factor, digits = _SHOWN[finding.quantity]
        limit = finding.limit
        result.add_row(
            escape(heading),
            number(factor * finding.value, digits),
            NOTHING
            if limit is None
            else number(factor * limit.value, digits) + ("" if limit.confirmed else " ?"),
            number(100.0 * finding.share, 0),
            f"{finding.section.start:.0f}",
            finding.place,
        )
    return result
