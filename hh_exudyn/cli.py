"""The command ``hh-exudyn``: run a case, demo, damage, playback. It knows everything and computes nothing.

The commands about one contact stand in `cli_contact`, those about track in `cli_track`, those about vehicles
in `cli_vehicle`, linear analysis in `cli_linear`, damage in `cli_damage`, the standard assessment in
`cli_assess`, what all commands share in `cli_output`.

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

from hh_exudyn import __version__, cli_assess, cli_contact, cli_damage, cli_linear, cli_track, cli_vehicle
from hh_exudyn.cli_damage import opened, show_damage
from hh_exudyn.cli_output import (
    INTERRUPTED,
    STOPPED,
    Refused,
    err,
    fail,
    kept,
    new_table,
    number,
    out,
    print_table,
    require_new_folder,
    told,
)

if TYPE_CHECKING:
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
cli_damage.register(app)
cli_track.register(app)
cli_assess.register(app)
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

        require_new_folder(out_folder)
        _show_run(_simulated(read_case(case), out_folder))


@app.command()
def demo(out_folder: NewFolder) -> None:
    """A loaded iron-ore wagon through a curve of 450 m: simulate, record, compute damage."""
    with told(out_folder):
        from hh_exudyn.case import Case

        require_new_folder(out_folder)
        text = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
        done = _simulated(Case.from_toml(text, source="demo.toml"), out_folder)
        _show_run(done)
        show_damage(done, out_folder / "damage")


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
        done = opened(folder)
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
    if (resistance := done.status.get("curve_resistance_of_train")) is not None:
        out.print(f"curve resistance of the wagons behind: {resistance}")
    out.print("Y is positive outwards; attack and position are positive to the left")
    out.print(f"play it: hh-exudyn playback {done.directory}")


def _record(done: "Run", path: Path) -> None:
    from hh_exudyn.playback.run import record

    with err.status("recording"):
        record(done, path)
    out.print(f"recording: {path}")


def _wheelset_table(rows: "list[WheelsetSummary]", window: tuple[float, float]) -> Table:
    """The summary with units, a line per wheel; what belongs to the wheelset stands in its first line."""
    table = new_table(
        f"Means from {window[0]:.2f} to {window[1]:.2f} s",
        ("wheel", "Q [kN]", "Y [kN]", "Y/Q [-]", "angle\u00a0of attack [mrad]", "lateral position [mm]",
         "p_max [MPa]", "wear number [N]", "FI>0 [%]"),
    )  # fmt: skip
    several = len({row.vehicle for row in rows}) > 1
    for row in rows:
        unit = f"{row.vehicle}." if several else ""
        of_wheelset = (number(row.angle_of_attack * 1e3, 2), number(row.lateral * 1e3, 2))
        for i, side in enumerate("LR"):
            table.add_row(
                f"{unit}{row.wheelset}{side}",
                number(row.Q[i] * 1e-3, 1),
                number(row.Y[i] * 1e-3, 1),
                number(row.y_over_q[i], 3),
                *(of_wheelset if i == 0 else ("", "")),
                f"{row.p_max[i] * 1e-6:.0f}",
                f"{row.wear_number[i]:.0f}",
                f"{row.fatigue_share[i] * 100:.0f}",
            )
    return table


@contextmanager
def _progress_bar(name: str) -> Iterator[Callable[[float, str], None]]:
    """A progress bar on stderr, as the function that `simulate` calls; nothing where stderr is a file."""
    columns = (TextColumn(name), BarColumn(), TextColumn("{task.description}"), TimeElapsedColumn())
    with Progress(*columns, console=err, transient=True, disable=not err.is_terminal) as bar:
        task = bar.add_task("equilibrium", total=1.0)
        yield lambda fraction, text: bar.update(task, completed=fraction, description=text)
