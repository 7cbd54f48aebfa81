"""The command ``assess``: runs after UIC 518 / EN 14363. It computes nothing itself.

Large packages are imported inside the command, so that ``--help`` is fast.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from hh_exudyn.cli import assess_tables, inputs, output
from hh_exudyn.cli.elements import element_summaries
from hh_exudyn.cli.elements import to_table as element_table

if TYPE_CHECKING:
    from hh_exudyn.assessment.report import Assessment
    from hh_exudyn.log.store import Run

RunFolders = Annotated[
    list[Path], typer.Argument(metavar="DIR...", help="Folders of runs of one vehicle, judged together.")
]
NewTable = Annotated[
    Path | None,
    typer.Option(metavar="F.csv", help="Write every section and place to this new file, in SI."),
]
NewTables = Annotated[
    Path | None,
    typer.Option(
        metavar="FOLDER",
        help="Write sections, statistics, ride, elements and couplings as .csv, in SI, to this new folder.",
    ),
]


def register(app: typer.Typer) -> None:
    """Add the command of this file to the program."""
    app.command("assess")(assess_ride)


def assess_ride(
    folders: RunFolders,
    figure: inputs.NewFigure = None,
    table: NewTable = None,
    tables: NewTables = None,
    unit: Annotated[int, typer.Option(metavar="N", help="Of a vehicle of several units, 1 leading.")] = 1,
    section_length_m: Annotated[
        float | None,
        typer.Option(metavar="m", help="Of test sections. [default: 250 on straights, 70 or 100 in curves]"),
    ] = None,
    unfinished: inputs.Unfinished = False,
    skip_broken_parts: inputs.SkipBrokenParts = False,
) -> None:
    """Runs after UIC 518 / EN 14363, by test sections, with limits.

    Forces on the track, safety against derailment, unloading, accelerations; estimated maxima of many
    sections; ride index and comfort; forces and displacements of logged couplings.
    """
    with output.errors_in_one_line(folders[0] if len(folders) == 1 else None):
        inputs.check_range("--section-length-m", section_length_m, 10.0, 1000.0, "m")
        inputs.require_new_file(figure, "--out", inputs.FIGURES)
        inputs.require_new_file(table, "--table", inputs.TABLES)
        if tables is not None:
            inputs.require_new_folder(tables, "--tables")
        if figure is not None and len(folders) > 1:
            raise inputs.BadInput(f"--out {figure}: a figure is of one run, {len(folders)} are given")
        runs = [_opened(folder, skip_broken_parts) for folder in folders]
        found = {
            folder.name: _assessed(run, unit, section_length_m, unfinished)
            for folder, run in zip(folders, runs, strict=True)
        }
        if len(found) < len(folders):
            raise inputs.BadInput("DIR...: two runs have the same name, their tables would be one")
        _show(found, runs)
        if table is not None:
            output.write_table(assess_tables.whole_table(found), table, "--table")
        if tables is not None:
            _write_all(found, runs, tables)
        if figure is not None:
            from hh_exudyn.figures.assessment import assessment_sheet

            ((name, one),) = found.items()
            output.write_figure(assessment_sheet(f"{name}: {one.vehicle.name}", one), figure)


def _opened(folder: Path, skip_broken_parts: bool) -> "Run":
    """The run in a folder."""
    from hh_exudyn.log.store import open_run

    with inputs.refused_as_bad_input():
        run = open_run(folder, skip_broken_parts=skip_broken_parts)
        output.print_left_out(run)
        return run


def _assessed(run: "Run", unit: int, section_length: float | None, unfinished: bool) -> "Assessment":
    """The assessment of a run; a run that cannot be assessed is bad input."""
    from hh_exudyn.assessment.report import standard_assessment

    with inputs.refused_as_bad_input():
        return standard_assessment(run, unit, section_length, unfinished)


def _show(found: "dict[str, Assessment]", runs: "Sequence[Run]") -> None:
    """Every run's sections and largest values, then what they say together."""
    from hh_exudyn.assessment.coupling_forces import coupling_ranges
    from hh_exudyn.assessment.statistics import largest, zone_estimates

    with inputs.refused_as_bad_input():
        estimates = largest(zone_estimates(list(found.values())))
        ranges = [coupling_ranges(run) for run in runs]
    for name, one in found.items():
        assess_tables.print_run(name, one)
    assess_tables.print_estimates(estimates)
    for (name, one), own in zip(found.items(), ranges, strict=True):
        assess_tables.print_ride(name, one)
        assess_tables.print_couplings(name, own)
    assess_tables.print_sources(next(iter(found.values())))


def _write_all(found: "dict[str, Assessment]", runs: "Sequence[Run]", folder: Path) -> None:
    """All tables of all runs as files."""
    from hh_exudyn.assessment import coupling_forces, statistics
    from hh_exudyn.assessment.sections import track_elements

    folder.mkdir(parents=True, exist_ok=True)
    written = {
        "sections": assess_tables.whole_table(found),
        "statistics": statistics.to_table(statistics.zone_estimates(list(found.values()))),
        "ride": assess_tables.ride_table(found),
    }
    elements, couplings = {}, {}
    for name, run in zip(found, runs, strict=True):
        elements[name] = element_table(element_summaries(run))
        ranges = coupling_forces.coupling_ranges(run, track_elements(inputs.case_of(run).alignment()))
        if ranges:
            couplings[name] = coupling_forces.to_table(ranges)
    written["elements"] = assess_tables.stacked(elements)
    if couplings:
        written["couplings"] = assess_tables.stacked(couplings)
    for name, table in written.items():
        output.write_table(table, folder / f"{name}.csv", "--tables")
