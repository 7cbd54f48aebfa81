"""The command ``campaign uncertainty``: bands of life and wear, and the assumptions that matter most.

It computes nothing itself. Large packages are imported inside the command, so that ``--help`` is fast.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from hh_exudyn.cli import inputs, output
from hh_exudyn.cli.inputs import BadInput

if TYPE_CHECKING:
    from hh_exudyn.campaign.uncertainty.assumptions import Assumptions
    from hh_exudyn.campaign.uncertainty.study import Influence, Study

_METHODS = ("morris", "sobol")
_WHOLE = 0.999


def register(campaign: typer.Typer) -> None:
    """Add the command of this file to the group of commands about campaigns."""
    campaign.command()(uncertainty)


def uncertainty(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="Folder of a campaign.")],
    samples: Annotated[int, typer.Option(metavar="N", help="Random samples of the bands.")] = 100,
    method: Annotated[
        str, typer.Option(metavar="morris|sobol", help="Of importance; sobol takes ten times as long.")
    ] = "morris",
    seed: Annotated[int, typer.Option(metavar="N", help="Of the random numbers.", min=0)] = 1,
    out: Annotated[Path | None, typer.Option("-o", "--out", metavar="FILE", help="Figure.")] = None,
    csv: Annotated[
        Path | None,
        typer.Option(metavar="FILE.csv", help="Bands; beside it FILE_assumptions.csv, their importance."),
    ] = None,
) -> None:
    """Bands of life and wear from all assumptions with a range, and the five that matter most.

    Nothing is simulated: the rates of the last evaluation are weighted and scaled anew, and carried on at
    constant rates from new wheels. Importance is by SALib (extra studies).
    """
    with output.errors_in_one_line():
        inputs.check_range("--samples", samples, 10, 1_000_000)
        if method not in _METHODS:
            raise BadInput(f"--method {method}: allowed {', '.join(_METHODS)}")
        second = None if csv is None else csv.with_name(f"{csv.stem}_assumptions{csv.suffix}")
        inputs.require_new_file(out, "--out", inputs.FIGURES)
        for file in (csv, second):
            inputs.require_new_file(file, "--csv", inputs.TABLES)
        from hh_exudyn.campaign.life.campaign import Campaign
        from hh_exudyn.campaign.uncertainty.fast_life import FastLife
        from hh_exudyn.campaign.uncertainty.study import study

        with inputs.refused_as_bad_input():
            life = FastLife(Campaign(directory))
            with _progress() as report:
                found = study(life, life.assumptions.varied, samples, method, seed, report)
        _print(found, life.assumptions, 1e-3 * life.distance)
        if life.told < _WHOLE:
            output.print_line(
                f"Shares of seasons act on {1e2 * life.told:.0f} % of the distance alone: elsewhere the few "
                "runs are of one season; more runs an evaluation tell more"
            )
        if csv is not None and second is not None:
            from hh_exudyn.campaign.uncertainty.tables import bands_table, influences_table

            output.write_table(bands_table(found), csv, "--csv")
            output.write_table(influences_table(found), second, "--csv")
        if out is not None:
            from hh_exudyn.campaign.uncertainty.figure import uncertainty_figure

            output.write_figure(uncertainty_figure(found), out)


@contextmanager
def _progress() -> Iterator[Callable[[int, int], None]]:
    """A bar with the time left on stderr."""
    columns = (TextColumn("lives"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=output.err, transient=True, disable=not output.err.is_terminal) as bar:
        task = bar.add_task("lives", total=None)
        yield lambda done, planned: bar.update(task, completed=done, total=planned)


def _print(found: "Study", assumptions: "Assumptions", kilometres: float) -> None:
    """Bands, causes, the assumptions that matter most, and what is not varied."""
    from hh_exudyn.campaign.uncertainty.assumptions import NO_RANGE
    from hh_exudyn.campaign.uncertainty.study import FIRST, MOST, UNITS

    title = f"Bands over {found.samples} samples; Sh, Sd, qR after {kilometres:.0f} km without turning"
    table = output.new_table(title, ("group", "quantity", "unit", "nominal", "5 %", "50 %", "95 %"))
    for column in table.columns[:3]:
        column.justify = "left"
    for band in found.bands:
        values = (band.nominal, band.low, band.median, band.high)
        table.add_row(band.group, band.quantity, UNITS[band.quantity], *map(_shown, values))
    output.print_table(table)
    if found.invalid:
        output.print_line(
            f"{found.invalid} samples have no Sh, Sd, qR: that much wear leaves no valid profile"
        )
    for group, shares in found.causes.items():
        named = ", ".join(f"{cause.replace('_', ' ')} {1e2 * share:.0f} %" for cause, share in shares.items())
        output.print_line(f"first limit of {group}: {named}")
    word = "mu* of ln" if found.method == "morris" else "S_T"
    for quantity, influences in found.influences.items():
        shown = word if quantity == FIRST or found.method == "sobol" else "mu*, relative"
        _print_influences(
            f"\n{quantity} of all wheels [{UNITS[quantity]}], nominal {_shown(found.nominal[quantity])}",
            shown,
            influences[:MOST],
        )
    output.print_line("\nNot varied:")
    fixed = [one for one in assumptions.not_varied if one.reason != NO_RANGE]
    for one in fixed:
        parameter = one.parameter
        span = "no range" if parameter.range is None else "{:g} to {:g}".format(*parameter.range)
        output.print_line(f"  {parameter.name} = {parameter.value:g} {parameter.unit} ({span}): {one.reason}")
    others = [one.parameter.name for one in assumptions.not_varied if one.reason == NO_RANGE]
    output.print_line(f"  assumed without a range: {', '.join(others) or 'none'}")
    output.print_line("  and the numbers of vehicles, profiles and track: hh-exudyn parameters lists them")


def _print_influences(title: str, word: str, influences: "tuple[Influence, ...]") -> None:
    """The assumptions that matter most for a quantity, with their sources below."""
    acting = [one for one in influences if one.at_ends is not None]
    if not acting:
        output.print_line(f"{title}: no assumption acts on it")
        return
    table = output.new_table(title, ("assumption", "value", "range", "unit", word, "at low", "at high"))
    table.columns[0].justify = "left"
    for one in acting:
        parameter, (low, high) = one.assumption.parameter, one.assumption.ends
        at_low, at_high = one.at_ends or (0.0, 0.0)
        table.add_row(
            one.assumption.label, f"{parameter.value:.4g}", f"{low:.3g} .. {high:.3g}", parameter.unit,
            f"{one.importance:.3f} ± {one.half_width:.3f}", _shown(at_low), _shown(at_high),
        )  # fmt: skip
    output.print_table(table)
    for one in acting:
        output.print_line(
            f"  {one.assumption.label}: {one.assumption.name}, {one.assumption.parameter.source}"
        )


def _shown(value: float) -> str:
    """Three digits, a dash for NaN."""
    return output.NOTHING if value != value else f"{value:.3g}" if abs(value) < 1e3 else f"{value:.0f}"
