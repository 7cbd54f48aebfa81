"""The commands ``campaign new``, ``run``, ``vary``, ``error`` and ``status``; others have their own files.

They compute nothing themselves.

Large packages are imported inside the commands, so that ``--help`` is fast.
"""

import math
import re
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from hh_exudyn.cli import campaign_show, campaign_uncertainty, inputs, output
from hh_exudyn.cli.inputs import BadInput

if TYPE_CHECKING:
    from hh_exudyn.campaign.engine.workers import Workers
    from hh_exudyn.campaign.life.campaign import Campaign, CampaignStanding

campaign = typer.Typer(help="Run wheels over the distance of their life.", no_args_is_help=True)

CampaignFile = Annotated[Path, typer.Argument(metavar="FILE.toml", help="Campaign file.")]
CampaignFolder = Annotated[Path, typer.Argument(metavar="DIR", help="Folder of a campaign.")]
DistanceKm = Annotated[
    float | None, typer.Option(metavar="km", help="Distance since the start; else that of the file.")
]
WorkerCount = Annotated[
    int | None, typer.Option(metavar="N", help="Processes; else one a core.", min=1, max=1024)
]
SchedulerAddress = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="Dask scheduler, tcp://host:8786, for a cluster.")
]
_UNITS = {"s": 1.0, "min": 60.0, "h": 3600.0}


def register(app: typer.Typer) -> None:
    """Add the commands of this file to the program."""
    campaign_show.register(campaign)
    campaign_uncertainty.register(campaign)
    app.add_typer(campaign, name="campaign")


@campaign.callback()
def _campaign() -> None:
    """Run wheels over the distance of their life."""


@campaign.command()
def new(
    file: Annotated[Path, typer.Argument(metavar="FILE.toml", help="This new file.")],
    line: Annotated[str, typer.Option(metavar="NAME|FILE", help="Line.")] = "malmbanan",
    vehicle: Annotated[
        str, typer.Option(metavar="NAME", help="Vehicle, or the beginning of its loaded and empty names.")
    ] = "iore_wagon_pair",
) -> None:
    """Write a commented campaign file, every number with its source."""
    with output.errors_in_one_line():
        from hh_exudyn.campaign.life.template import campaign_text

        inputs.require_new_file(file, "FILE.toml", (".toml",))
        with inputs.refused_as_bad_input():
            text = campaign_text(line, vehicle)
        output.write_text(text, file, "FILE.toml", "campaign")


@campaign.command()
def run(
    file: CampaignFile,
    out: Annotated[
        Path, typer.Option("-o", "--out", metavar="DIR", help="Folder; one of the same file goes on.")
    ],
    distance_km: DistanceKm = None,
    workers: WorkerCount = None,
    scheduler: SchedulerAddress = None,
    budget: Annotated[
        str | None, typer.Option(metavar="TIME", help="Stop after this time, as 90s, 30min or 2h.")
    ] = None,
) -> None:
    """Wear wheels step by step until the distance; Ctrl-C and --budget leave a folder that goes on."""
    with output.errors_in_one_line():
        from hh_exudyn.campaign.life.campaign import Campaign

        inputs.check_range("--distance-km", distance_km, 1e-3, 1e7, "km")
        seconds = _seconds(budget)
        with inputs.refused_as_bad_input():
            begun = Campaign.begin(file, out)
            open_workers = _workers(workers, scheduler)
        output.print_line(begun.plan.of_steps.evaluation)
        goal = None if distance_km is None else 1e3 * distance_km
        with _kept(out), open_workers as pool, _progress() as report:
            reached = begun.run(pool, goal, seconds, report)
        _print_status(begun)
        if not reached:
            output.print_line(f"the time of --budget {budget} is over; the same command goes on")


@campaign.command()
def vary(
    file: CampaignFile,
    variations: Annotated[
        list[str],
        typer.Option(
            "--vary",
            metavar="KEY=VALUE,VALUE,...",
            help="Run all combinations of the values. KEY: axle_load [t], gauge [mm, mean of the line], "
            "lubrication [%], material; a key of the file (gauge.deviation_mm, season.dry.share_percent); "
            "or a number of its vehicles (wedge.friction). Several times.",
        ),
    ],
    out: Annotated[
        Path, typer.Option("-o", "--out", metavar="DIR", help="Folder of all; the same command goes on.")
    ],
    distance_km: DistanceKm = None,
    workers: WorkerCount = None,
    scheduler: SchedulerAddress = None,
    budget: Annotated[
        str | None, typer.Option(metavar="TIME", help="Time for all, shared alike, as 90s, 30min or 2h.")
    ] = None,
) -> None:
    """Run variants of a campaign, each in its folder with its own file, and compare them."""
    with output.errors_in_one_line():
        from hh_exudyn.cli.variation import run_variation, varied_texts

        inputs.check_range("--distance-km", distance_km, 1e-3, 1e7, "km")
        seconds = _seconds(budget)
        texts = varied_texts(file, variations)
        with inputs.refused_as_bad_input():
            open_workers = _workers(workers, scheduler)
        goal = None if distance_km is None else 1e3 * distance_km
        with _kept(out), open_workers as pool, _progress() as report:
            run_variation(texts, out, pool, goal, seconds, report)


@campaign.command()
def error(
    directory: CampaignFolder,
    runs: Annotated[int, typer.Option(metavar="N", help="Most cases to run.", min=1)],
    stated: Annotated[
        float, typer.Option("--error", metavar="%", help="Stop at this error, half the interval of 95 %.")
    ] = 5.0,
    workers: WorkerCount = None,
    scheduler: SchedulerAddress = None,
) -> None:
    """Errors of wear and crack rates at the last step: more samples, and axes with halved steps."""
    with output.errors_in_one_line():
        from hh_exudyn.campaign.life.campaign import Campaign

        inputs.check_range("--error", stated, 0.1, 100.0, "%")
        with inputs.refused_as_bad_input():
            found = Campaign(directory)
            open_workers = _workers(workers, scheduler)
        with _kept(directory), open_workers as pool, output.status("cases"):
            sizing = found.size(pool, runs, 1e-2 * stated)
        output.print_line(sizing.words())


@campaign.command()
def status(directory: CampaignFolder) -> None:
    """How far a campaign is: steps, distance, cases, wheels so far."""
    with output.errors_in_one_line():
        from hh_exudyn.campaign.life.campaign import Campaign

        with inputs.refused_as_bad_input():
            found = Campaign(directory)
        _print_status(found)


@contextmanager
def _kept(folder: Path) -> Iterator[None]:
    """What ends a campaign early, in one line that says that its folder goes on."""
    from hh_exudyn.campaign.engine.mapping import TooManyFailed
    from hh_exudyn.campaign.engine.workers import EngineStopped

    goes_on = f"{folder} is kept, and the same command goes on"
    try:
        yield
    except (TooManyFailed, EngineStopped) as error:
        output.fail(output.STOPPED, str(error))
    except KeyboardInterrupt:
        output.fail(output.INTERRUPTED, f"interrupted; {goes_on}")
    except SystemExit as end:
        if end.code != output.TERMINATED:
            raise
        output.fail(output.TERMINATED, f"terminated; {goes_on}")
    except (FileExistsError, ValueError) as error:  # another campaign's folder; what a case refuses
        raise BadInput(str(error)) from None
    except OSError as error:  # a full disk
        output.fail(output.FAULT, f"{error}; {goes_on}")


def _seconds(budget: str | None) -> float:
    """A time as 90s, 30min or 2h, in seconds."""
    if budget is None:
        return math.inf
    found = re.fullmatch(r"(\d+(?:\.\d+)?)\s*(s|min|h)", budget.strip())
    if found is None or float(found[1]) == 0.0:
        raise BadInput(f"--budget {budget}: allowed a time above zero, as 90s, 30min or 2h")
    return float(found[1]) * _UNITS[found[2]]


def _workers(count: int | None, scheduler: str | None) -> "AbstractContextManager[Workers]":
    """Processes, or the workers of a cluster."""
    from hh_exudyn.campaign.engine.workers import DaskWorkers, ProcessWorkers

    if scheduler is None:
        return ProcessWorkers(count)
    if count is not None:
        raise BadInput(f"--workers {count} with --scheduler: the cluster has its own; allowed is one of both")
    return DaskWorkers(scheduler)


def _print_status(found: "Campaign") -> None:
    """Distance, cases, and the wheels of every group."""
    plan, ends = found.plan.collective.plan, found.files.ends()
    if not ends:
        output.print_line(f"{plan.name}: 0 km of {1e-3 * plan.distance:.0f} km")
        return
    ran, reused = sum(end.ran for end in ends), sum(end.reused for end in ends)
    output.print_line(
        f"{plan.name}: {1e-3 * ends[-1].distance:.3f} km of {1e-3 * plan.distance:.0f} km, {len(ends) - 1} "
        f"steps, {ran} cases run, {reused} not run again as no wheel had moved in its contact"
    )
    for name, weight, reason in sorted({one for end in ends for one in end.failed}):
        output.print_line(f"failed and left out: {name} (weight {weight:.3g}): {reason}")
    headings = (
        "group",
        "worn [mm]",
        "Sh [mm]",
        "Sd [mm]",
        "qR [mm]",
        "hollow [mm]",
        "conicity",
        "p_max [MPa]",
    )
    table = output.new_table("Wheels, and the change from the start", headings)
    table.columns[0].justify = "left"
    for group, history in found.histories().items():
        first, last = history.steps[0], history.last
        flange = [
            (1e3 * getattr(last.measures, name), 1e3 * getattr(first.measures, name))
            for name in ("flange_height", "flange_thickness", "flange_steepness")
        ]
        table.add_row(
            group,
            f"{1e3 * (first.radius - last.radius):.3f}",
            *(f"{now:.2f} ({now - before:+.2f})" for now, before in flange),
            f"{1e3 * last.measures.hollow:.2f}",
            f"{last.measures.conicity:.3f}",
            output.number(1e-6 * last.pressure, 0),
        )
    output.print_table(table)


@contextmanager
def _progress() -> "Iterator[Callable[[CampaignStanding], None]]":
    """A bar with the time left on stderr, and a line for every step."""
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=output.err, transient=True, disable=not output.err.is_terminal) as bar:
        task = bar.add_task("campaign", total=1.0)

        def report(standing: "CampaignStanding") -> None:
            left = "" if math.isinf(standing.left) else f", about {_shown(standing.left)} left"
            cases = standing.cases
            of_cases = (
                f", evaluation {standing.evaluation}, {cases.done} of {cases.count} cases" if cases else ""
            )
            bar.update(
                task,
                completed=standing.distance / standing.goal,
                description=f"{1e-3 * standing.distance:.1f} km, step {standing.step}{of_cases}{left}",
            )
            if standing.text:
                output.print_line(f"{standing.text}{left}")
            if cases is not None and cases.reason:
                output.print_line(f"{cases.ended}: failed: {cases.reason}")

        yield report


def _shown(seconds: float) -> str:
    """A time in words."""
    return f"{seconds / 3600.0:.1f} h" if seconds >= 3600.0 else f"{seconds / 60.0:.0f} min"
