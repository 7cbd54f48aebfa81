"""The commands ``campaign show`` and ``campaign compare``: what campaigns have found.

They compute nothing themselves. Large packages are imported inside the functions, so that ``--help`` is fast.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from hh_exudyn.cli import inputs, output

if TYPE_CHECKING:
    import pyarrow
    from matplotlib.figure import Figure

    from hh_exudyn.campaign.results.recorded import Recorded

Folder = Annotated[Path, typer.Argument(metavar="DIR", help="Folder of a campaign.")]
_LABELS = {"curve_class": "curve class", "running": "load"}


def register(campaign: typer.Typer) -> None:
    """Add the commands of this file to those about campaigns."""
    campaign.command()(show)
    campaign.command()(compare)


def show(
    directory: Folder,
    page: Annotated[
        Path | None, typer.Option("--html", metavar="FILE", help="Write one page of it all to this new file.")
    ] = None,
    tables: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Write all tables as .csv to this new folder.")
    ] = None,
    figures: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Draw all figures as .png into this new folder.")
    ] = None,
) -> None:
    """What a campaign has found: wear, cracks, where they come from, when the wheels are due."""
    with output.errors_in_one_line():
        inputs.require_new_file(page, "--html", (".html",))
        for folder, option in ((tables, "--tables"), (figures, "--figures")):
            if folder is not None:
                inputs.require_new_folder(folder, option)
        recorded = _recorded(directory)
        with output.status("tables"), inputs.refused_as_bad_input():
            found = _tables(recorded)
        _print(recorded, found)
        if tables is not None:
            tables.mkdir(parents=True, exist_ok=True)
            for name, table in found.items():
                output.write_table(table, tables / f"{name}.csv", "--tables")
        if figures is not None:
            figures.mkdir(parents=True, exist_ok=True)
            for name, figure in _figures(recorded, found).items():
                output.write_figure(figure, figures / f"{name}.png", "--figures")
        if page is not None:
            from hh_exudyn.campaign.results.page import page as page_of

            output.write_text(page_of(recorded), page, "--html", "page")


def compare(
    first: Annotated[Path, typer.Argument(metavar="DIR1", help="Folder of a campaign.")],
    second: Annotated[Path, typer.Argument(metavar="DIR2", help="Folder of another one.")],
    figure: Annotated[
        Path | None,
        typer.Option("-o", "--figure", metavar="FILE", help="Draw into this new file (.png, .pdf, .svg)."),
    ] = None,
    csv: Annotated[
        Path | None, typer.Option("--csv", metavar="FILE", help="Write the measures to this new file.")
    ] = None,
) -> None:
    """Two campaigns beside each other, at the farthest distance that both have reached."""
    with output.errors_in_one_line():
        from hh_exudyn.campaign.results.comparison import comparison_figure, comparison_table

        inputs.require_new_file(figure, "-o", inputs.FIGURES)
        inputs.require_new_file(csv, "--csv", inputs.TABLES)
        one, two = _recorded(first), _recorded(second)
        with inputs.refused_as_bad_input():
            table = comparison_table(one, two)
        _print_comparison(table, first, second)
        if csv is not None:
            output.write_table(table, csv, "--csv")
        if figure is not None:
            output.write_figure(comparison_figure(one, two, _names(first, second)), figure, "-o")


def _recorded(directory: Path) -> "Recorded":
    """The steps of a campaign; a folder that holds none is bad input."""
    from hh_exudyn.campaign.life.campaign import Campaign
    from hh_exudyn.campaign.results.recorded import Recorded

    with inputs.refused_as_bad_input():
        return Recorded.of(Campaign(directory))


def _tables(recorded: "Recorded") -> "dict[str, pyarrow.Table]":
    """All tables that there are, by name."""
    from hh_exudyn.campaign.results import errors, lives, shares, tables
    from hh_exudyn.campaign.results import inputs as campaign_inputs

    found = {
        "measures": tables.measures_table(recorded),
        "wear": tables.wear_table(recorded),
        "running_in": tables.running_in_table(recorded),
        "cracks": tables.cracks_table(recorded),
        "profile": tables.profile_table(recorded),
        "shares": shares.shares_table(recorded),
        "rails": tables.rails_table(recorded),
        "turnings": lives.turnings_table(recorded),
        "forecast": lives.forecast_table(recorded),
        "errors": errors.errors_table(recorded),
        "assumed": campaign_inputs.assumed_table(recorded.campaign),
        "steps": tables.steps_table(recorded),
        "failed": tables.failures_table(recorded),
    }
    return {name: table for name, table in found.items() if table is not None}


def _figures(recorded: "Recorded", tables: "dict[str, pyarrow.Table]") -> "dict[str, Figure]":
    """All figures that there are, by name."""
    from damage.figures.evolution import profiles_figure
    from hh_exudyn.campaign.results import errors, figures

    found = {
        "over_distance": figures.over_distance_figure(recorded),
        "over_profile": figures.over_profile_figure(recorded),
    }
    for group in recorded.groups:
        name = group.replace(" ", "_")
        found[f"profiles_{name}"] = profiles_figure(recorded.history(group))
        found[f"shares_{name}"] = figures.shares_figure(tables["shares"], group)
    content = errors.errors_of(recorded)
    if content is not None:
        found["errors"] = figures.errors_figure(recorded, content)
    return found


def _print(recorded: "Recorded", found: "dict[str, pyarrow.Table]") -> None:
    """What fits a terminal: wear, cracks on the tread, shares of curve classes and loads, what is due."""
    plan = recorded.campaign.plan.collective.plan
    output.print_line(
        f"{plan.name}: {1e-3 * recorded.distance:.0f} km of {1e-3 * plan.distance:.0f} km, "
        f"{len(recorded.ends) - 1} steps"
    )
    _print_table("Wear by place, after running-in", found["wear"])
    _print_table("Running-in", found["running_in"])
    cracks = found["cracks"].drop_columns(["from_mm", "to_mm"])
    _print_table("Cracks, largest by place", cracks)
    for label, word in _LABELS.items():
        own = [row for row in found["shares"].to_pylist() if row["label"] == label]
        kept = [{name: value for name, value in row.items() if name != "label"} for row in own]
        _print_table(f"Shares by {word}, at the worst bin of each place", type(cracks).from_pylist(kept))
    if "turnings" in found:
        names = ["group", "life", "due_km", "distance_km", "cause", "measure", "cut_mm", "diameter_mm"]
        _print_table("Turnings", found["turnings"].select(names))
    if "forecast" in found:
        _print_table("Due next, extrapolated by the rates of the last evaluation", found["forecast"])
    if "errors" in found:
        from hh_exudyn.campaign.results.errors import errors_of

        content = errors_of(recorded)
        output.print_line("" if content is None else content["words"])
    for row in found["failed"].to_pylist():
        output.print_line(f"failed and left out: {row['case']} (weight {row['weight']:.3g}): {row['reason']}")


def _print_table(title: str, table: "pyarrow.Table") -> None:
    """A table in the terminal, numbers as on the page."""
    from hh_exudyn.campaign.results.html_parts import cell_text, heading

    shown = output.new_table(title, tuple(heading(name) for name in table.column_names))
    shown.columns[0].justify = "left"
    for row in table.to_pylist():
        shown.add_row(*(cell_text(name, value) for name, value in row.items()))
    output.print_table(shown)


def _print_comparison(table: "pyarrow.Table", first: Path, second: Path) -> None:
    """Measures of both, each to the digits of its unit."""
    from hh_exudyn.campaign.results.html_parts import heading, number_text

    title = f"At {table['distance_km'][0].as_py():.0f} km: {first} and {second}"
    shown = output.new_table(title, ("group", "measure", "first", "second", "difference"))
    for column in shown.columns[:2]:
        column.justify = "left"
    for row in table.to_pylist():
        name = row["measure"]
        values = (number_text(name, row[key]) for key in ("first", "second", "difference"))
        shown.add_row(row["group"], heading(name), *values)
    output.print_table(shown)


def _names(first: Path, second: Path) -> tuple[str, str]:
    """Names of two folders, with those above them where both are the same."""
    short = first.resolve().name, second.resolve().name
    return short if short[0] != short[1] else (str(first), str(second))
