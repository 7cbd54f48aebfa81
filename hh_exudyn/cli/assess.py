"""The command ``assess``: a run after UIC 518 / EN 14363. It computes nothing itself.

Conversion to kilonewtons and millimetres is here; the packages below use SI. Large packages are imported
inside the command, so that ``--help`` is fast.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from hh_exudyn.cli import inputs, output

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


NewTable = Annotated[
    Path | None,
    typer.Option(metavar="F.csv", help="Write every section and place to this new file, in SI."),
]


def register(app: typer.Typer) -> None:
    """Add the command of this file to the program."""
    app.command("assess")(assess_ride)


def assess_ride(
    folder: inputs.RunFolder,
    figure: inputs.NewFigure = None,
    table: NewTable = None,
    unit: Annotated[int, typer.Option(metavar="N", help="Of a vehicle of several units, 1 leading.")] = 1,
    section_length_m: Annotated[
        float | None,
        typer.Option(metavar="m", help="Of test sections. [default: 250 on straights, 70 or 100 in curves]"),
    ] = None,
    unfinished: inputs.Unfinished = False,
    skip_broken_parts: inputs.SkipBrokenParts = False,
) -> None:
    """Forces and accelerations of a run after UIC 518 / EN 14363, by test sections, and their limits."""
    with output.errors_in_one_line(folder):
        inputs.check_range("--section-length-m", section_length_m, 10.0, 1000.0, "m")
        inputs.require_new_file(figure, "--out", inputs.FIGURES)
        inputs.require_new_file(table, "--table", inputs.TABLES)
        found = _assessed(folder, unit, section_length_m, unfinished, skip_broken_parts)
        _show(found, folder.name)
        if table is not None:
            output.write_table(found.to_table(), table, "--table")
        if figure is not None:
            from hh_exudyn.figures.assessment import assessment_sheet

            output.write_figure(assessment_sheet(f"{folder.name}: {found.vehicle.name}", found), figure)


def _assessed(
    folder: Path, unit: int, section_length: float | None, unfinished: bool, skip_broken_parts: bool
) -> "Assessment":
    """The assessment of the run in a folder; a run that cannot be assessed is bad input."""
    from hh_exudyn.assessment.report import standard_assessment
    from hh_exudyn.log.store import open_run

    with inputs.refused_as_bad_input():
        run = open_run(folder, skip_broken_parts=skip_broken_parts)
        output.print_left_out(run)
        return standard_assessment(run, unit, section_length, unfinished)


def _show(found: "Assessment", name: str) -> None:
    """Test sections, the largest values by kind of section, and the sources of their limits."""
    from hh_exudyn.log.ending import FINISHED

    early = "" if found.ending == FINISHED else f" (unfinished run: {found.ending})"
    output.print_table(_section_table(found, name + early))
    for stretch in found.left_out:
        output.print_line(f"not assessed: {stretch}")
    output.print_table(_value_table(found, early))
    output.print_line(f"f0, the peak of the spectrum of sum Y: {found.instability_frequency:.2f} Hz")
    output.print_line(
        "? limit unconfirmed: read neither in the standard nor where it is cited. Limits are from:"
    )
    for quantity, limit in found.limits.items():
        output.print_line(f"  {_SHOWN[quantity][0]}: {limit.source}")
    if found.beyond:
        output.print_line(
            "the axle load is above the 25 t that EN 14363 with EN 15687 goes to: limits are a comparison"
        )
    output.print_line("quality of the track of the run: hh-exudyn track plot DIR/case.toml")


def _section_table(found: "Assessment", name: str) -> Table:
    """A line per test section."""
    result = output.new_table(
        f"Test sections of {name}", ("from [m]", "to [m]", "kind", "radius [m]", "hand")
    )
    for section in found.sections:
        radius = f"{section.radius:.0f}" if section.curved else output.NOTHING
        result.add_row(
            f"{section.start:.1f}", f"{section.end:.1f}", section.kind, radius, section.hand or output.NOTHING
        )
    return result


def _value_table(found: "Assessment", early: str) -> Table:
    """A line per kind of section and quantity: its largest value, where, and the limit."""
    result = output.new_table(
        f"Largest values by kind of section{early}",
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
            heading,
            output.number(factor * finding.value, digits),
            output.NOTHING
            if limit is None
            else output.number(factor * limit.value, digits) + ("" if limit.confirmed else " ?"),
            output.number(100.0 * finding.share, 0),
            f"{finding.section.start:.0f}",
            finding.place,
        )
    return result
