"""The damage reports of a run, one for the wheels of each profile, as the commands take them.

Large packages are imported inside the functions, so that ``--help`` is fast.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from hh_exudyn.cli import inputs, output

if TYPE_CHECKING:
    import pyarrow

    from damage.report import DamageReport
    from damage.wear.films import WearFilms
    from hh_exudyn.case import Case
    from hh_exudyn.contact.profile import Profile
    from hh_exudyn.log.store import Run
    from vehicles.description import Vehicle


def assessed(run: "Run", skip_bad_rows: bool = False, **options: Any) -> "list[tuple[DamageReport, Profile]]":
    """The damage of a run, a report for the wheels of each profile.

    A log without the necessary columns or with bad rows is bad input.
    """
    from damage.report import assess
    from hh_exudyn.contact.wheels import alike

    case = inputs.case_of(run)
    contact, found = case.contact_model(), []
    with _progress(run, "halfspace" in (options.get("normal"), options.get("theory"))) as progress:
        for profile, wheels, (i, s) in _wheels_by_profile(run, case):
            try:
                report = assess(
                    run,
                    profile=profile,
                    contact=contact if wheels is None else alike(contact, i, s),
                    skip_bad_rows=skip_bad_rows,
                    progress=progress,
                    wheels=wheels,
                    **options,
                )
            except ValueError as error:
                known = "rows are bad" in str(error) or "rows are missing" in str(error)
                hint = "; --skip-bad-rows leaves them out" if known else ""
                raise inputs.BadInput(f"{run.directory}: {error}{hint}") from None
            found.append((report, profile))
    return found


def _wheels_by_profile(
    run: "Run", case: "Case"
) -> "list[tuple[Profile, list[tuple[int, int, int]] | None, tuple[int, int]]]":
    """Each profile of a run with its wheels (None: all) and one of them by wheelset from 0 and side."""
    from hh_exudyn.case.wheels import wheel_names
    from hh_exudyn.conventions import LEFT, RIGHT

    if case.wheel_profiles is None:
        return [(case.wheel, None, (0, 0))]
    wheelsets = vehicle_of(run).wheelsets
    names = wheel_names(case.wheel_profiles, case.wheel_profile, len(wheelsets))
    profiles = case.wheels(len(wheelsets))
    found: dict[str, Any] = {}
    numbers: dict[int, int] = {}
    for i, wheelset in enumerate(wheelsets):
        number = numbers[wheelset.unit] = numbers.get(wheelset.unit, 0) + 1
        for s, side in enumerate((LEFT, RIGHT)):
            _, wheels, _ = found.setdefault(names[i][s], (profiles[i][s], [], (i, s)))
            wheels.append((wheelset.unit, number, side))
    return list(found.values())


def vehicle_of(run: "Run") -> "Vehicle":
    """The vehicle of a run."""
    from vehicles.stored import from_json

    text = run.vehicle_text
    return inputs.case_of(run).described_vehicle() if text is None else from_json(text)


def films_of(run: "Run") -> "WearFilms":
    """The lubricant of a run, by its case; and its wheelsets."""
    from damage.wear.films import WearFilms

    described = vehicle_of(run)
    table = inputs.case_of(run).film_table(len(described.wheelsets))
    units = [wheelset.unit for wheelset in described.wheelsets]
    return WearFilms(table, tuple(units.count(unit) for unit in described.units))


@contextmanager
def _progress(run: "Run", slow: bool) -> Iterator[Callable[[int], None] | None]:
    """A bar with the remaining time on stderr where the half-space solves every state, else a status."""
    if not slow:
        with output.status("damage"):
            yield None
        return
    rows = sum(batch.num_rows for batch in run.batches("contact", ["time"]))
    columns = (
        TextColumn("damage, {task.fields[states]} states"),
        BarColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=output.err, transient=True, disable=not output.err.is_terminal) as bar:
        task = bar.add_task("damage", total=rows, states=f"{rows:,}")
        yield lambda done: bar.update(task, completed=done)


def wear_table(run: "Run", unfinished: bool) -> "pyarrow.Table":
    """The damage of a run with all defaults, a row for each wheel.

    Parameters
    ----------
    run
        The run.
    unfinished
        Whether one that ended early is taken.

    Raises
    ------
    BadInput
        As `damage` refuses it.
    """
    return whole_table(
        [report.to_table() for report, _ in assessed(run, films=films_of(run), unfinished=unfinished)]
    )


def whole_table(tables: "list[pyarrow.Table]") -> "pyarrow.Table":
    """The rows of several tables in the order of the wheels, right before left as in one."""
    import pyarrow

    order = [("vehicle", "ascending"), ("wheelset", "ascending"), ("side", "ascending")]
    return tables[0] if len(tables) == 1 else pyarrow.concat_tables(tables).sort_by(order)
