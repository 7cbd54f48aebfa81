"""The command ``hh-exudyn``: run a case, demo, damage, playback. It knows everything and computes nothing.

The commands about one contact stand in `cli_contact`, those about track in `cli_track`, those about vehicles
in `cli_vehicle`, those of linear analysis in `cli_linear`, what all commands share in `cli_output`.

=========  ==================================================================================
exit code  meaning
=========  ==================================================================================
0          done
1          a fault of the program: one line, and where the traceback was written
2          bad input: one line that says what is allowed; nothing was begun or written over
3          the vehicle derailed or the run diverged; the log so far is kept
130        Ctrl-C; the log so far is kept
=========  ==================================================================================

Everything heavy is imported inside the commands, so that ``--help`` answers at once.
"""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from hh_exudyn import __version__, cli_contact, cli_linear, cli_track, cli_vehicle
from hh_exudyn.cli_output import (
    INTERRUPTED,
    STOPPED,
    Refused,
    err,
    fail,
    kept,
    new_table,
    out,
    print_table,
    told,
)

if TYPE_CHECKING:
    import pyarrow

    from damage.summary import WheelsetSummary
    from hh_exudyn.case import Case
    from hh_exudyn.log.store import Run

RECORDING = "playback.rrd"

app = typer.Typer(
    help="Wheel damage on heavy-haul railways.",
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)
cli_contact.register(app)
cli_track.register(app)
cli_vehicle.register(app)
cli_linear.register(app)

NewFolder = Annotated[Path, typer.Option("--out", metavar="DIR", help="New or empty folder for the run.")]
RunFolder = Annotated[Path, typer.Argument(metavar="DIR", help="Folder of a run.")]


def main() -> None:
    """Entry point of ``hh-exudyn``."""
    try:
        app()
    except KeyboardInterrupt:  # outside of a command: while a library is imported
        sys.exit(INTERRUPTED)


def _print_version(wanted: bool) -> None:
    if wanted:
        out.print(f"hh-exudyn {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Wheel damage on heavy-haul railways: simulate a wagon, compute wear and fatigue, play it back."""


@app.command()
def run(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file.")], out_folder: NewFolder
) -> None:
    """Simulate a case: logs, recording, and a table of the wheelsets in the last part of the run."""
    with told(out_folder):
        from hh_exudyn.case import read_case

        _require_new(out_folder)
        _show_run(_simulated(read_case(case), out_folder))


@app.command()
def demo(out_folder: NewFolder) -> None:
    """A loaded iron-ore wagon through a curve of 450 m: simulate, record, compute damage."""
    with told(out_folder):
        from hh_exudyn.case import Case

        _require_new(out_folder)
        text = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
        done = _simulated(Case.from_toml(text, source="demo.toml"), out_folder)
        _show_run(done)
        _show_damage(done, out_folder / "damage")


@app.command()
def damage(
    folder: RunFolder,
    out_folder: Annotated[
        Path | None,
        typer.Option("--out", metavar="DIR", help="New or empty folder; without, DIR/damage of the run."),
    ] = None,
) -> None:
    """Wear and rolling contact fatigue of a run's wheels, from its contact log: a table and figures."""
    with told(folder):
        if out_folder is not None:
            _require_new(out_folder)
        _show_damage(_opened(folder), out_folder or folder / "damage")


@app.command()
def playback(
    folder: RunFolder,
    save: Annotated[
        Path | None,
        typer.Option(metavar="F.rrd", help="Write the recording to this new file and open no viewer."),
    ] = None,
) -> None:
    """Play a run in the rerun viewer, or save its recording."""
    with told(folder):
        done = _opened(folder)
        if save is not None:
            if save.exists():
                raise Refused(f"--save {save}: exists already, allowed is a new file")
            _record(done, save)
            return
        from hh_exudyn.playback.viewer import open_viewer

        recording = folder / RECORDING
        if not recording.is_file():
            _record(done, recording)
        out.print(f"{recording} opens in the rerun viewer (process {open_viewer(recording)})")


def _simulated(case: "Case", folder: Path) -> "Run":
    """Run the case with a progress bar; every way to end early becomes one line and an exit code."""
    from hh_exudyn.multibody.equilibrium import NoEquilibrium
    from hh_exudyn.multibody.simulate import SimulationStopped, simulate

    try:
        with _progress_bar(case.name) as progress:
            return simulate(case, folder, progress=progress)
    except (SimulationStopped, NoEquilibrium) as error:
        fail(STOPPED, f"{error}; {kept(folder)}")
    except (ValueError, OSError) as error:
        if not folder.exists():  # nothing was begun: the case cannot be built, or the folder not be made
            raise Refused(str(error)) from None
        raise


def _show_run(done: "Run") -> None:
    """Record the run and print its table and where things are."""
    from damage.summary import steady_window, wheelset_summary

    window = steady_window(done)
    _record(done, done.directory / RECORDING)
    print_table(_wheelset_table(wheelset_summary(done, window), window))
    out.print("Y is positive outwards; attack and position are positive to the left")
    out.print(f"play it: hh-exudyn playback {done.directory}")


def _record(done: "Run", path: Path) -> None:
    from hh_exudyn.playback.run import record

    with err.status("recording"):
        record(done, path)
    out.print(f"recording: {path}")


def _show_damage(done: "Run", folder: Path) -> None:
    """Print the damage table and write table and figures."""
    import pyarrow.csv

    from damage.figures.profile_panels import fatigue_figure, wear_figure
    from damage.figures.working_points import shakedown_figure
    from damage.report import assess
    from hh_exudyn.case import Case

    with err.status("damage"):
        report = assess(done)
    wheel = Case.from_toml(done.case_text, source=f"{done.directory}/case.toml").wheel
    figures = {
        "wear.png": wear_figure(report, wheel),
        "fatigue.png": fatigue_figure(report, wheel),
        "shakedown.png": shakedown_figure(done),
    }
    table = report.to_table()
    folder.mkdir(parents=True, exist_ok=True)
    pyarrow.csv.write_csv(table, folder / "damage.csv")
    for name, figure in figures.items():
        figure.savefig(folder / name, dpi=150)
    print_table(_damage_table(table))
    out.print(f"damage: {folder} ({', '.join(['damage.csv', *figures])})")


def _opened(folder: Path) -> "Run":
    """The run in a folder, with at least one contact log row to look at."""
    from hh_exudyn.log.store import open_run

    try:
        done = open_run(folder)
        if done.read("contact", ["time"]).num_rows == 0:
            raise Refused(f"{folder}: the contact log has no rows")
    except (FileNotFoundError, ValueError) as error:
        raise Refused(str(error)) from None
    return done


def _wheelset_table(rows: "list[WheelsetSummary]", window: tuple[float, float]) -> Table:
    """The summary with units, a line per wheel; what belongs to the wheelset stands in its first line."""
    table = new_table(
        f"Means from {window[0]:.2f} to {window[1]:.2f} s",
        ("wheel", "Q [kN]", "Y [kN]", "Y/Q [-]", "angle\u00a0of attack [mrad]", "lateral position [mm]",
         "p_max [MPa]", "wear number [N]", "FI>0 [%]"),
    )  # fmt: skip
    for row in rows:
        of_wheelset = (f"{row.angle_of_attack * 1e3:.2f}", f"{row.lateral * 1e3:.2f}")
        for i, side in enumerate("LR"):
            table.add_row(
                f"{row.wheelset}{side}",
                f"{row.Q[i] * 1e-3:.1f}",
                f"{row.Y[i] * 1e-3:.1f}",
                f"{row.y_over_q[i]:.3f}",
                *(of_wheelset if i == 0 else ("", "")),
                f"{row.p_max[i] * 1e-6:.0f}",
                f"{row.wear_number[i]:.0f}",
                f"{row.fatigue_share[i] * 100:.0f}",
            )
    return table


DAMAGE_COLUMNS = {  # column of the report: heading, factor, format
    "p_max_MPa": ("p_max [MPa]", 1.0, ".0f"),
    "wear_number_N": ("wear number [N]", 1.0, ".0f"),
    "fatigue_share": ("FI>0 tread [%]", 100.0, ".1f"),
    "fatigue_area_index": ("FI area tread [%]", 100.0, ".1f"),
    "wear_depth_mm_per_1000_km": ("wear depth [µm/km]", 1.0, ".3g"),  # the same unit in short
    "wear_y_mm": ("at y [mm]", 1.0, ".1f"),
    "worn_area_mm2_per_km": ("worn area [mm²/km]", 1.0, ".3g"),
    "seizure_share": ("seizure [%]", 100.0, ".0f"),
    "flange_share": ("flange [%]", 100.0, ".0f"),
}


def _damage_table(columns: "pyarrow.Table") -> Table:
    """The damage of every wheel over the whole run; ``damage.csv`` has more columns."""
    table = new_table(
        "Damage over the whole run", ("wheel", *(heading for heading, _, _ in DAMAGE_COLUMNS.values()))
    )
    for row in columns.to_pylist():
        cells = (f"{row[name] * factor:{form}}" for name, (_, factor, form) in DAMAGE_COLUMNS.items())
        table.add_row(f"{row['wheelset']}{'L' if row['side'] > 0 else 'R'}", *cells)
    return table


def _require_new(folder: Path) -> None:
    """Refuse a folder that holds anything, before any work."""
    try:
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            kind = "is not empty" if folder.is_dir() else "is a file"
            raise Refused(f"--out {folder}: {kind}, allowed is a new or an empty folder")
    except OSError as error:
        raise Refused(f"--out {folder}: {error.strerror}") from None


@contextmanager
def _progress_bar(name: str) -> Iterator[Callable[[float, str], None]]:
    """A progress bar on stderr, as the function that `simulate` calls; nothing where stderr is a file."""
    columns = (TextColumn(name), BarColumn(), TextColumn("{task.description}"), TimeElapsedColumn())
    with Progress(*columns, console=err, transient=True, disable=not err.is_terminal) as bar:
        task = bar.add_task("equilibrium", total=1.0)
        yield lambda fraction, text: bar.update(task, completed=fraction, description=text)
