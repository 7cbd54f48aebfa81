"""The command ``damage``: wear and fatigue of a run's wheels, and of its rails. It computes nothing itself.

Conversion to millimetres and kilometres is here; the packages below use SI. Large packages are imported
inside the functions, so that ``--help`` is fast.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.table import Table

from hh_exudyn.cli import inputs, output
from hh_exudyn.cli.check_rails import check_rail_rows
from hh_exudyn.cli.evaluation import (
    SETTINGS_FILE,
    chosen_folder,
    complete_folder,
    law_and_steel,
    save_labelled,
    settings,
    write_settings,
)
from hh_exudyn.cli.names import NamesInHelp
from hh_exudyn.cli.rails import print_rails, rail_figures, rail_model, rail_places, rail_tables, rails_of
from hh_exudyn.cli.reports import assessed, films_of, whole_table

if TYPE_CHECKING:
    import pyarrow
    from matplotlib.figure import Figure

    from damage.rails.report import RailPlace
    from damage.report import DamageReport
    from damage.surface.wheel_surface import Wheel
    from hh_exudyn.contact.profile import Profile
    from hh_exudyn.log.store import Run


LEAST_DRY_FRICTION = 0.2  # of very humid weather (Hossein-Nia 2018, 1.1.5): below, there is lubricant
FIGURE_DISTANCE = 50_000.0  # km, of the figures without --distance-km: as in Hossein-Nia (2018)
_THEORY_HELP = "Tangential theory: {damage_theories}. [default: fastrip, with the half-space its own]"
_NORMAL_HELP = "Normal contact: {normal_contacts}. [default: strips, for a run without them ellipse]"


def register(app: typer.Typer) -> None:
    """Add the command of this file to the program."""
    app.command(cls=NamesInHelp)(damage)


def damage(
    folder: inputs.RunFolder,
    out_folder: Annotated[
        Path | None,
        typer.Option("--out", metavar="DIR", help="New or empty folder; without, damage in that of the run."),
    ] = None,
    model: Annotated[str, typer.Option(metavar="LAW", help="Wear law: {wear_laws}.")] = "archard",
    surface: Annotated[
        str | None,
        typer.Option(
            metavar="STATE",
            help="For Archard's wear coefficients, everywhere: {surfaces}. [default: by the case]",
        ),
    ] = None,
    theory: Annotated[str | None, typer.Option(metavar="NAME", help=_THEORY_HELP)] = None,
    normal: Annotated[str | None, typer.Option(metavar="NAME", help=_NORMAL_HELP)] = None,
    pressure_limit: Annotated[
        float | None,
        typer.Option(metavar="MPA", help="Upper bound of the half-space's pressure; force is kept."),
    ] = None,
    material: Annotated[str, typer.Option(metavar="STEEL", help="Wheel steel: {steels}.")] = "ER7",
    distance_km: Annotated[
        float | None, typer.Option(metavar="KM", help="Also give the damage after this distance.")
    ] = None,
    rails: Annotated[
        bool, typer.Option("--rails", help="Also the rails, by element of the track, per gross tonne.")
    ] = False,
    rail_material: Annotated[str, typer.Option(metavar="STEEL", help="Rail steel: {rail_steels}.")] = "R260",
    skip_bad_rows: Annotated[
        bool, typer.Option("--skip-bad-rows", help="Leave out rows that no contact can have; count them.")
    ] = False,
    unfinished: inputs.Unfinished = False,
    skip_broken_parts: inputs.SkipBrokenParts = False,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace the evaluation in the folder; without, a new folder.")
    ] = False,
) -> None:
    """Wear and rolling contact fatigue of a run's wheels and rails, from its contact log: tables and figures.
    \f
    Fifteen arguments: each is an option of the command.
    """
    with output.errors_in_one_line(folder):
        target = chosen_folder(folder, out_folder, overwrite)
        inputs.check_range("--distance-km", distance_km, 1e-3, 1e7, "km")
        inputs.check_range("--pressure-limit", pressure_limit, 1.0, 1e5, "MPa")
        options = _options(model, surface, theory, material)
        options |= {"normal": normal, "unfinished": unfinished}
        if pressure_limit is not None:
            options |= {"pressure_limit": 1e6 * pressure_limit}
        run = inputs.read_run(folder, skip_broken_parts)
        films = films_of(run)
        options |= {"films": films if surface is None else films.without()}
        places = rail_places(run) if rails else []
        if rails:
            options |= {"rails": rail_model(places, rail_material)}
        show_damage(run, target, distance_km, skip_bad_rows, surface, places, **options)


def _options(model: str, surface: str | None, theory: str | None, material: str) -> dict[str, Any]:
    """Arguments of `damage.report.assess` for the names on the command line; an unknown one is bad input."""
    from damage.material import wheel_material
    from damage.surface.patch_field import theory_number
    from damage.wear.laws import wear_law

    with inputs.refused_as_bad_input():
        if theory is not None:
            theory_number(theory)
        law = wear_law(model, **({} if surface is None else {"surface": surface}))
        return {"law": law, "theory": theory, "material": wheel_material(material)}


def show_damage(
    run: "Run",
    folder: Path,
    distance_km: float | None = None,
    skip_bad_rows: bool = False,
    surface: str | None = None,
    places: "Sequence[RailPlace]" = (),
    **options: Any,
) -> None:
    """Print the damage tables of a run and write tables and figures.

    Parameters
    ----------
    run
        The run.
    folder
        Folder for tables and figures; one with an earlier evaluation is replaced.
    distance_km
        Also give the damage after this distance; None for none.
    skip_bad_rows
        Leave out rows that no contact can have.
    surface
        State of the surfaces that the wear law was made for; None for its default.
    places
        Elements of the track whose rails are in the options too; empty for none.
    options
        Of `damage.report.assess`.
    """
    import pyarrow.csv

    from damage.report import NOT_EXTRAPOLATED

    reports = assessed(run, skip_bad_rows, **options)
    report = reports[0][0]
    rails = rails_of(run, [one for one, _ in reports], places) if places else None
    tables = {"damage.csv": whole_table([one.to_table() for one, _ in reports])}
    if distance_km is not None:
        tables["distance.csv"] = whole_table([one.distance_table(1e3 * distance_km) for one, _ in reports])
    if report.bad_rows.faults:
        tables["bad_rows.csv"] = report.bad_rows.to_table()
    distance = 1e3 * (FIGURE_DISTANCE if distance_km is None else distance_km)
    figures: dict[str, Figure] = {}
    for number, (one, profile) in enumerate(reports, 1):
        figures |= _figures(run, one, profile, distance, "" if number == 1 else f"_{number}")
    tables, figures = tables | rail_tables(rails), figures | rail_figures(rails)
    label = law_and_steel(report, surface)
    with complete_folder(folder) as partial:
        for name, table in tables.items():
            pyarrow.csv.write_csv(table, partial / name)
        for name, figure in figures.items():
            save_labelled(figure, label, partial / name)
        write_settings(partial, settings(run, report, surface, distance_km))
    output.print_left_out(run)
    output.print_line(f"law, steel, theory: {label}")
    whole = f"Damage over the whole run, normal contact: {report.normal_contact}"
    output.print_table(_table_of(whole + _early(report), tables["damage.csv"], RUN_COLUMNS))
    if distance_km is not None:
        after = f"Damage after {distance_km:,g} km{_early(report)}"
        output.print_table(_table_of(after, tables["distance.csv"], DISTANCE_COLUMNS))
    for one, profile in reports:
        which = f"{profile.name}: " if len(reports) > 1 else ""
        output.print_line(f"{which}{_coefficients(one, run)}")
    if "corrected_rcf_number_per_km" in tables["damage.csv"].column_names:
        output.print_line("RCF: revolutions beyond shakedown; corrected: less those worn off, after Burstow")
    if any(one.seized.any() for one, _ in reports):
        pressure = report.model.seizure_pressure * 1e-6
        output.print_line(
            f"{SEIZED} flange wear under seizure (above {pressure:.0f} MPa, 0.8 of the hardness): the "
            f"unworn profile wears in first; {NOT_EXTRAPOLATED}"
        )
    if rails is not None:
        print_rails(rails)
    if report.bad_rows.faults:
        output.print_line(f"left out: {report.bad_rows}")
    if backs := check_rail_rows(run):
        output.print_line(
            f"left out: {backs} rows of flange backs on check rails, whose damage is not computed"
        )
    output.print_line(f"damage: {folder} ({', '.join([*tables, *figures, SETTINGS_FILE])})")


def _early(report: "DamageReport") -> str:
    """Of a run that ended early: that and why, for the titles of its tables."""
    from hh_exudyn.log.ending import FINISHED

    return "" if report.ending in ("", FINISHED) else f" (unfinished run: {report.ending})"


def _coefficients(report: "DamageReport", run: "Run") -> str:
    """What the wear coefficients are for; doubtful where friction is that of a lubricated contact."""
    law = report.model.law
    wheels: dict[str, list[str]] = {}
    for wheel, surface in zip(report.surface.wheels, report.wear_surfaces, strict=True):
        wheels.setdefault(surface, []).append(_wheel_name(report, wheel))
    surfaces = "; ".join(
        text if len(wheels) == 1 else f"{text} ({', '.join(names)})" for text, names in wheels.items()
    )
    line = f"wear coefficients of {law.name}: {surfaces}"
    if set(wheels) != {"dry"}:
        return line
    if not films_of(run).dry:
        return f"{line}; doubtful: the case has lubricated zones"
    friction = report.surface.mean_friction[report.surface.patch_time > 0.0]
    least = float(friction.min(initial=1.0))
    return line + (f"; doubtful: friction is down to {least:.2f}" if least < LEAST_DRY_FRICTION else "")


def _wheel_name(report: "DamageReport", wheel: "Wheel") -> str:
    """A wheel as in the tables: "1L", of several vehicles "2.1L"."""
    several = len({other.vehicle for other in report.surface.wheels}) > 1
    return f"{f'{wheel.vehicle}.' if several else ''}{wheel.wheelset}{'L' if wheel.side > 0 else 'R'}"


def _figures(
    run: "Run", report: "DamageReport", profile: "Profile", distance: float, suffix: str
) -> "dict[str, Figure]":
    """The figures by file name; the map shows the wheel with most fatigue on its tread."""
    from damage.figures.profile_panels import fatigue_figure, wear_figure
    from damage.figures.rcf_bins import rcf_bins_figure
    from damage.figures.rcf_maps import energy_map_figure
    from damage.figures.working_points import shakedown_figure
    from damage.patch_strips import TREAD

    surface = report.surface
    figures = {
        f"wear{suffix}.png": wear_figure(report, profile),
        f"fatigue{suffix}.png": fatigue_figure(report, profile),
        f"rcf_bins{suffix}.png": rcf_bins_figure(report, distance),
    }
    if report.model.burstow is not None:
        worst = surface.wheels[int(surface.rcf_number[:, TREAD].max(axis=(1, 2)).argmax())]
        figures[f"rcf_map{suffix}.png"] = energy_map_figure(report, worst, distance)
    if not suffix:  # of the whole run
        figures["shakedown.png"] = shakedown_figure(
            run, report.model.material, skip_bad_rows=report.bad_rows.count > 0
        )
    return figures


SEIZED = "*"  # behind flange wear that is not to be extrapolated
Columns = dict[str, tuple[str, float, str]]  # column of a table: heading, factor, format
RUN_COLUMNS: Columns = {
    "p_max_MPa": ("p_max [MPa]", 1.0, ".0f"),
    "wear_number_N": ("wear number [N]", 1.0, ".0f"),
    "fatigue_share": ("FI>0 tread [%]", 100.0, ".1f"),
    "fatigue_area_index": ("FI area tread [%]", 100.0, ".1f"),
    "wear_depth_mm_per_1000_km": ("tread wear [mm per 1000 km]", 1.0, ".3g"),
    "flange_wear_depth_mm_per_1000_km": ("flange wear [mm per 1000 km]", 1.0, ".3g"),
    "wear_y_mm": ("at y [mm]", 1.0, ".1f"),
    "worn_area_mm2_per_km": ("worn area [mm²/km]", 1.0, ".3g"),
    "wear_seizure_share": ("seizure [%]", 100.0, ".0f"),
    "flange_share": ("flange [%]", 100.0, ".0f"),
    "rcf_number_per_km": ("RCF\u00a0tread [1/km]", 1.0, ".0f"),
    "corrected_rcf_number_per_km": ("corrected [1/km]", 1.0, ".0f"),
}
DISTANCE_COLUMNS: Columns = {
    "wear_depth_mm": ("tread wear [mm]", 1.0, ".3g"),
    "flange_wear_depth_mm": ("flange wear [mm]", 1.0, ".3g"),
    "worn_area_mm2": ("worn area [mm²]", 1.0, ".3g"),
    "rcf_number": ("RCF number", 1.0, ".3g"),
    "corrected_rcf_number": ("corrected", 1.0, ".3g"),
    "crack_damage": ("Miner's sum", 1.0, ".3g"),
    "flange_rcf_number": ("RCF flange", 1.0, ".3g"),
    "flange_corrected_rcf_number": ("corrected", 1.0, ".3g"),
    "flange_crack_damage": ("Miner's flange", 1.0, ".3g"),
}


def _table_of(title: str, table: "pyarrow.Table", columns: Columns) -> Table:
    """A line per wheel with the most important columns of the file, as far as the wear law gives them."""
    shown = {name: column for name, column in columns.items() if name in table.column_names}
    lines = output.new_table(title, ("wheel", *(heading for heading, _, _ in shown.values())))
    rows = table.to_pylist()
    several = len({row["vehicle"] for row in rows}) > 1
    for row in rows:
        unit = f"{row['vehicle']}." if several else ""
        seized = SEIZED if row["flange_wear_note"] else ""
        cells = (
            f"{row[name] * factor:{form}}{seized if name.startswith('flange_wear') else ''}"
            for name, (_, factor, form) in shown.items()
        )
        lines.add_row(f"{unit}{row['wheelset']}{'L' if row['side'] > 0 else 'R'}", *cells)
    return lines
