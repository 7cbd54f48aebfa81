"""The command ``compare``: runs beside each other, what differs in their inputs and in their results.

It computes nothing itself. Large packages are imported inside the functions, so that ``--help`` is fast.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from hh_exudyn.cli import inputs, output

if TYPE_CHECKING:
    from damage.extremes import Extreme
    from hh_exudyn.log.store import Run

Folders = Annotated[
    list[Path], typer.Argument(metavar="DIR...", help="Folders of runs, or of the runs of a matrix.")
]
NewSheet = Annotated[
    Path | None,
    typer.Option("-o", "--figure", metavar="FILE", help="Draw into this new file (.png, .pdf, .svg)."),
]
NewTable = Annotated[
    Path | None, typer.Option("--csv", metavar="FILE", help="Write inputs and results to this new file.")
]


def register(app: typer.Typer) -> None:
    """Add the command of this file to the program."""
    app.command()(compare)


def compare(
    folders: Folders, figure: NewSheet = None, csv: NewTable = None, unfinished: inputs.Unfinished = False
) -> None:
    """Runs beside each other: inputs that differ, and the largest of each result with its wheel."""
    with output.errors_in_one_line():
        inputs.require_new_file(figure, "-o", inputs.FIGURES)
        inputs.require_new_file(csv, "--csv", inputs.TABLES)
        show_comparison([run for folder in folders for run in _runs_in(folder)], figure, csv, unfinished)


def show_comparison(
    folders: Sequence[Path], figure: Path | None = None, csv: Path | None = None, unfinished: bool = False
) -> None:
    """Print the comparison of runs, and write it where it is wanted.

    Parameters
    ----------
    folders
        Of the runs.
    figure, csv
        New files; None for none.
    unfinished
        Whether runs that ended early are taken.
    """
    from hh_exudyn.case.differences import differing_inputs

    runs = [inputs.read_run(folder) for folder in folders]
    with inputs.refused_as_bad_input():
        cases = [inputs.case_of(run) for run in runs]
        differing = differing_inputs(cases)
    results = []
    for run in runs:
        with output.status(f"results of {run.directory.name}"), inputs.refused_as_bad_input():
            results.append(_results(run, unfinished))
    names = _names(folders)
    _print(names, differing, results)
    if csv is not None:
        output.write_table(_table(names, differing, results), csv, "--csv")
    if figure is not None:
        from hh_exudyn.figures.comparison import comparison_sheet

        title = (
            f"{len(runs)} runs: largest of all wheels (wear over the run, else mean of an element of track)"
        )
        bars = {
            f"{one.quantity} [{one.unit}]": [(row[i].value, row[i].wheel) for row in results]
            for i, one in enumerate(results[0])
        }
        output.write_figure(comparison_sheet(title, names, bars), figure, "-o")


def _runs_in(folder: Path) -> list[Path]:
    """The run in a folder, or the runs in the folders in it."""
    if (folder / "case.toml").is_file() or not folder.is_dir():
        return [folder]
    found = sorted(path.parent for path in folder.glob("*/case.toml"))
    if not found:
        raise inputs.BadInput(f"{folder}: no run in it, nor in the folders in it")
    return found


def _names(folders: Sequence[Path]) -> list[str]:
    """Names of the folders, with those above them where two are the same."""
    short = [folder.resolve().name for folder in folders]
    return short if len(set(short)) == len(short) else [str(folder) for folder in folders]


def _results(run: "Run", unfinished: bool) -> "list[Extreme]":
    from damage.extremes import extremes
    from hh_exudyn.cli.elements import element_summaries
    from hh_exudyn.cli.reports import wear_table

    elements = {found.element.start: found.wheelsets for found in element_summaries(run)}
    return extremes(elements, wear_table(run, unfinished))


def _print(names: list[str], differing: dict[str, list[Any]], results: "list[list[Extreme]]") -> None:
    """The runs by number, then inputs and results."""
    numbers = [str(number) for number in range(1, len(names) + 1)]
    for number, name in zip(numbers, names, strict=True):
        output.print_line(f"{number}: {name}")
    if not differing:
        output.print_line("all inputs are the same")
    else:
        rows = {key: [_value(value) for value in values] for key, values in differing.items()}
        if len(names) <= _MOST_COLUMNS:
            _print_table(
                "Inputs that differ", ["input", *numbers], [[key, *row] for key, row in rows.items()]
            )
        else:
            runs = [list(row) for row in zip(numbers, *rows.values(), strict=True)]
            _print_table("Inputs that differ", ["run", *rows], runs)
    quantities = [f"{one.quantity} [{one.unit}]" for one in results[0]]
    lines = [[number, *(_shown(one) for one in row)] for number, row in zip(numbers, results, strict=True)]
    _print_table("Results, the largest with its wheel", ["run", *quantities], lines)
    output.print_line(
        "tread wear over the whole run, else means over elements of the track: 1R@100m is of wheel 1R on the "
        "element that begins at 100 m; Y is positive outwards"
    )


_MOST_COLUMNS = 8  # runs that stand beside each other


def _print_table(title: str, head: list[str], lines: list[list[str]]) -> None:
    table = output.new_table(title, tuple(head))
    for column in table.columns:
        column.no_wrap, column.overflow = False, "fold"
    table.columns[0].justify = "left"
    for line in lines:
        table.add_row(*line)
    output.print_table(table)


def _value(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _shown(one: "Extreme") -> str:
    text = output.NOTHING if one.value != one.value else f"{one.value:.4g}"
    return f"{text} {one.wheel}"


def _table(names: list[str], differing: dict[str, list[Any]], results: "list[list[Extreme]]") -> Any:
    """Inputs, results and their wheels as columns."""
    import pyarrow

    columns: dict[str, list[Any]] = {"run": names}
    for key, values in differing.items():
        numbers = all(isinstance(value, int | float) for value in values)
        columns[key] = values if numbers else [_value(value) for value in values]
    for i, one in enumerate(results[0]):
        columns[f"{one.quantity} [{one.unit}]"] = [row[i].value for row in results]
        columns[f"wheel of {one.quantity}"] = [row[i].wheel for row in results]
    return pyarrow.table(columns)
