"""A matrix of runs on the command line: progress, what failed and why, the comparison of what did not.

Large packages are imported inside the functions, so that ``--help`` is fast.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from hh_exudyn.cli import output
from hh_exudyn.cli.compare import show_comparison
from hh_exudyn.cli.inputs import BadInput

if TYPE_CHECKING:
    from hh_exudyn.case import Case
    from hh_exudyn.multibody.many import Standing


def run_matrix(cases: "dict[str, Case]", folder: Path, workers: int | None) -> None:
    """Run the cases of a matrix, each in its folder, and compare those that finished.

    Parameters
    ----------
    cases
        By name.
    folder
        Holds their folders; may have finished ones.
    workers
        Processes; None for one a core.

    Raises
    ------
    BadInput
        The folder is a file, or a run itself.
    """
    from hh_exudyn.multibody.many import simulate_many

    if (folder / "case.toml").exists() or (folder.exists() and not folder.is_dir()):
        raise BadInput(f"--out {folder}: is a run or a file, allowed is a folder for the {len(cases)} runs")
    with _progress(len(cases)) as progress:
        outcomes = simulate_many(cases, folder, workers, progress)
    finished = [outcome for outcome in outcomes if outcome.finished]
    before = sum(outcome.done_before for outcome in finished)
    output.print_line(f"{len(finished)} of {len(outcomes)} runs finished, {before} of them before")
    if finished:
        show_comparison([folder / outcome.name for outcome in finished])
    if failed := [outcome.name for outcome in outcomes if not outcome.finished]:
        output.fail(
            output.STOPPED, f"{len(failed)} of {len(outcomes)} runs did not finish: {'; '.join(failed)}"
        )


@contextmanager
def _progress(count: int) -> "Iterator[Callable[[Standing], None]]":
    """A bar with the time left on stderr, and a line for every run that ends."""
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=output.err, transient=True, disable=not output.err.is_terminal) as bar:
        task = bar.add_task(f"{count} runs", total=1.0)
        ended = 0

        def report(standing: "Standing") -> None:
            nonlocal ended
            left = "" if standing.left == float("inf") else f", about {standing.left:.0f} s left"
            bar.update(task, completed=standing.fraction, description=f"{ended} of {count} runs{left}")
            if standing.ended is not None:
                ended += 1
                one = standing.ended
                how = one.reason or (
                    "finished before" if one.done_before else f"finished in {one.wall:.0f} s"
                )
                output.print_line(f"{one.name}: {how} ({ended} of {count}{left})")

        yield report
