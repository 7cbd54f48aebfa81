"""The commands ``run``, ``demo`` and ``playback``. They compute nothing themselves.

Large packages are imported inside the commands, so that ``--help`` is fast.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from hh_exudyn.cli import inputs, output
from hh_exudyn.cli.changes import OtherVehicle, Settings, Variations, changed_case, varied_cases
from hh_exudyn.cli.check_rails import largest_forces
from hh_exudyn.cli.damage import show_damage
from hh_exudyn.cli.elements import element_summaries, print_elements
from hh_exudyn.cli.matrix import run_matrix

if TYPE_CHECKING:
    from hh_exudyn.case import Case
    from hh_exudyn.log.store import Run

RECORDING = "playback.rrd"
NewRecording = Annotated[
    Path | None,
    typer.Option(metavar="F.rrd", help="Write the recording to this new file and open no viewer."),
]


def register(app: typer.Typer) -> None:
    """Add the commands of this file to the program."""
    for command in (run, demo, playback):
        app.command()(command)


def run(
    case: inputs.CaseFile,
    out_folder: inputs.NewFolder,
    vehicle_: OtherVehicle = None,
    set_: Settings = None,
    vary: Variations = None,
    workers: Annotated[
        int | None, typer.Option(metavar="N", help="Processes for --vary. [default: one a core]")
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on with the interrupted run of the case in the folder.")
    ] = False,
    exudyn_viewer: Annotated[
        bool,
        typer.Option("--exudyn-viewer", help="Watch the run in Exudyn's window; closing it ends the run."),
    ] = False,
) -> None:
    """Simulate a case: logs, recording, and tables of the wheels on every element of the track.

    With --vary every combination of the values is run, each in a folder of its name, by several processes at
    once; the same command again goes on with what is left.
    """
    with output.errors_in_one_line(out_folder):
        changed = changed_case(case, vehicle_, set_)
        inputs.check_range("--workers", workers, 1, 1024)
        if vary and exudyn_viewer:
            raise inputs.BadInput("--exudyn-viewer shows one run; without --vary")
        if vary:
            run_matrix(varied_cases(changed, vary), out_folder, workers)
            return
        if not resume:
            inputs.require_new_folder(out_folder)
        _show_run(simulated(changed, out_folder, resume, exudyn_viewer))


def demo(out_folder: inputs.NewFolder) -> None:
    """A loaded iron-ore wagon through a curve of 450 m: simulate, record, compute damage."""
    with output.errors_in_one_line(out_folder):
        from hh_exudyn.case import Case

        inputs.require_new_folder(out_folder)
        text = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
        finished = simulated(Case.from_toml(text, source="demo.toml"), out_folder)
        _show_run(finished)
        show_damage(finished, out_folder / "damage")


def playback(
    folder: inputs.RunFolder,
    save: NewRecording = None,
    skip_broken_parts: inputs.SkipBrokenParts = False,
) -> None:
    """Play a run in the rerun viewer, or save its recording."""
    with output.errors_in_one_line(folder):
        finished = inputs.read_run(folder, skip_broken_parts)
        output.print_left_out(finished)
        if save is not None:
            inputs.require_new_file(save, "--save", inputs.RECORDINGS)
            _record(finished, save)
            return
        from hh_exudyn.playback.viewer import open_viewer

        recording = folder / RECORDING
        if skip_broken_parts or not recording.is_file() or _older(recording, folder / "status.json"):
            _record(finished, recording)
        with output.status("opening the viewer"):
            viewer = open_viewer(recording)
        output.print_line(f"{recording} is open in the rerun viewer (process {viewer})")


def simulated(case: "Case", folder: Path, resume: bool = False, shown: bool = False) -> "Run":
    """The run of a case, with a progress bar; an early end is one line and an exit code.

    Parameters
    ----------
    case
        What is run.
    folder
        New folder of the run, or that of the interrupted one.
    resume
        Whether to go on with an interrupted run.
    shown
        Whether to show it in Exudyn's window.

    Raises
    ------
    BadInput
        A case or folder with which no run can begin.
    """
    from hh_exudyn.multibody.equilibrium import NoEquilibrium
    from hh_exudyn.multibody.simulate import SimulationStopped, simulate
    from hh_exudyn.multibody.viewer import NoScreen, Viewer

    try:
        viewer = Viewer(case) if shown else None
        with _progress_bar(case.name) as progress:
            return simulate(case, folder, progress=progress, resume=resume, viewer=viewer)
    except NoScreen as error:
        output.fail(output.FAULT, str(error))
    except (SimulationStopped, NoEquilibrium) as error:
        output.fail(output.STOPPED, f"{error}; {output.log_place(folder, resumable=False)}")
    except FileExistsError as error:  # another run has claimed the folder: nothing is written into it
        raise inputs.BadInput(f"--out {folder}: {error}") from None
    except (ValueError, OSError) as error:
        if not folder.exists():  # nothing was begun: the case or the folder cannot be made
            raise inputs.BadInput(str(error)) from None
        raise


def _show_run(run: "Run") -> None:
    """Record the run; print its table and the paths of its files."""
    from damage.summary import seizure_shares
    from hh_exudyn.case import Case
    from hh_exudyn.case.numbers import assumed_summary

    _record(run, run.directory / RECORDING)
    print_elements(element_summaries(run))
    if run.status.get("watch"):
        output.print_table(_watch_table(run.status["watch"], seizure_shares(run)))
    if forces := largest_forces(run):
        output.print_line(forces)
    output.print_line(assumed_summary(Case.from_toml(run.case_text, folder=run.directory)))
    if (resistance := run.status.get("curve_resistance_of_train")) is not None:
        output.print_line(f"curve resistance of the wagons behind: {resistance}")
    for wheel in run.status.get("chatter", []):
        output.print_line(
            f"doubtful: the contact of wheel {wheel['wheel']} jumps {wheel['changes_per_s']:g} times "
            f"a second (Q spreads by {wheel['spread_of_Q_kN']:g} kN) at s = {wheel['s_m']:g} m"
        )
    for wheel in run.status.get("wheel_climb", []):
        output.print_line(
            f"doubtful: wheel {wheel['wheel']} lifts up to {wheel['lift_mm']:g} mm from its rail "
            f"(s = {wheel['lift_s_m']:g} m) and runs up to {wheel['flange_alone_m']:g} m on its flange alone "
            f"(to s = {wheel['flange_alone_to_s_m']:g} m)"
        )
    output.print_line("Y is positive outwards; attack and position are positive to the left")
    output.print_line(f"play it: hh-exudyn playback {run.directory}")


def _older(recording: Path, status: Path) -> bool:
    """Whether a recording was made before the run in its folder ended."""
    return status.is_file() and recording.stat().st_mtime < status.stat().st_mtime


def _record(run: "Run", path: Path) -> None:
    from hh_exudyn.playback.run import record

    with output.status("recording"):
        record(run, path)
    output.print_line(f"recording: {path}")


def _watch_table(wheels: "list[dict[str, Any]]", seized: "dict[str, float]") -> Table:
    """What the watch over the whole run has seen, a line per wheel: zeros where nothing is doubtful."""
    table = output.new_table(
        "Watch over the whole run",
        ("wheel", "lift [mm]", "flange\u00a0alone [m]", "contact jumps [1/s]",
         "curvature floored [%]", "above seizure [%]"),
    )  # fmt: skip
    for wheel in wheels:
        table.add_row(
            wheel["wheel"],
            output.number(wheel["lift_mm"], 2),
            output.number(wheel["flange_alone_m"], 1),
            output.number(wheel["changes_per_s"], 0),
            output.number(100.0 * wheel["floored_share"], 1),
            output.number(100.0 * seized.get(wheel["wheel"], 0.0), 1),
        )
    return table


@contextmanager
def _progress_bar(name: str) -> Iterator[Callable[[float, str], None]]:
    """A progress bar on stderr, advanced by the callback of `simulate`; none where stderr is a file."""
    columns = (
        TextColumn("{task.fields[case]}", markup=False),  # a name may have braces and brackets
        BarColumn(),
        TextColumn("{task.description}", markup=False),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=output.err, transient=True, disable=not output.err.is_terminal) as bar:
        task = bar.add_task("equilibrium", total=1.0, case=name)
        yield lambda fraction, text: bar.update(task, completed=fraction, description=text)
