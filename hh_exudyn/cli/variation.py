"""Variants of a campaign on the command line: their files, their ends, their comparison.

Large packages are imported inside the functions, so that ``--help`` is fast.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from hh_exudyn.cli import inputs, output
from hh_exudyn.cli.changes import varied_values

if TYPE_CHECKING:
    import pyarrow

    from hh_exudyn.campaign.engine.workers import Workers
    from hh_exudyn.campaign.life.campaign import CampaignStanding
    from hh_exudyn.campaign.variation.runner import Outcome

COMPARISON = "comparison.csv"
_OF_CASE = "case."
_DIGITS = {
    "_km": 1,
    "_change_mm": 3,
    "_um_per_1000_km": 2,
    "_per_1000_km": 4,
}  # by the end of a column's name


def varied_texts(file: Path, variations: list[str]) -> dict[str, str]:
    """Texts of the campaigns of all combinations, by name.

    Parameters
    ----------
    file
        Of the campaign.
    variations
        Of the option ``--vary``.

    Raises
    ------
    BadInput
        A key or a value that is not allowed.
    """
    from hh_exudyn.campaign.variation import variants

    values = varied_values(variations, _OF_CASE)
    with inputs.refused_as_bad_input(), output.status("variants"):
        return variants(file, values)


def run_variation(
    texts: dict[str, str],
    folder: Path,
    workers: "Workers",
    distance: float | None,
    budget: float,
    report: "Callable[[CampaignStanding], None]",
) -> None:
    """Run variants, compare those that have made a step, and end with an error for those that failed.

    Parameters
    ----------
    texts, folder, workers, distance, budget
        As `hh_exudyn.campaign.variation.runner.run_variants`.
    report
        Of the standing.
    """
    from hh_exudyn.campaign.engine.workers import EngineStopped
    from hh_exudyn.campaign.variation import run_variants

    def named(name: str, standing: "CampaignStanding") -> None:
        report(replace(standing, text=f"{name}: {standing.text}") if standing.text else standing)

    try:
        with inputs.refused_as_bad_input():
            outcomes = run_variants(texts, folder, workers, distance, budget, named)
    except EngineStopped as error:
        output.fail(output.STOPPED, str(error))
    except KeyboardInterrupt:
        output.fail(output.INTERRUPTED, f"interrupted; {folder} is kept, and the same command goes on")
    reached = sum(one.reached for one in outcomes)
    output.print_line(f"{reached} of {len(outcomes)} campaigns have run their distance")
    compare_outcomes(outcomes, folder)
    if failed := [f"{one.name}: {one.reason}" for one in outcomes if one.reason]:
        output.fail(output.STOPPED, f"{len(failed)} of {len(outcomes)} campaigns failed: {'; '.join(failed)}")
    if reached < len(outcomes):
        output.print_line("the time of --budget is over; the same command goes on")


def compare_outcomes(outcomes: "tuple[Outcome, ...]", folder: Path) -> None:
    """Print and write the comparison of the variants that have made a step.

    Parameters
    ----------
    outcomes
        Of the variants.
    folder
        For `COMPARISON`.
    """
    import pyarrow.csv

    from hh_exudyn.campaign.variation.comparison import comparison_table

    begun = {one.name: one.campaign for one in outcomes if one.distance > 0.0}
    if not begun:
        return
    table = comparison_table(begun)
    pyarrow.csv.write_csv(table, folder / COMPARISON)
    _print(table)
    output.print_line(f"table: {folder / COMPARISON}")


def _print(table: "pyarrow.Table") -> None:
    """The table with a heading for each column."""
    shown = [name for name in table.column_names if name not in ("distance_km", "turnings")]
    headings = tuple(name.replace("_um_per_1000_km", " [um]").replace("_", " ") for name in shown)
    at = table["distance_km"][0].as_py()
    found = output.new_table(f"Wheels after {at:.1f} km; wear and Miner's sums per 1000 km", headings)
    found.columns[0].justify = found.columns[1].justify = "left"
    for row in table.to_pylist():
        found.add_row(*(_text(name, row[name]) for name in shown))
    output.print_table(found)


def _text(name: str, value: object) -> str:
    if value is None:
        return output.NOTHING
    if not isinstance(value, float) or math.isnan(value):
        return str(value)
    digits = next(digits for end, digits in _DIGITS.items() if name.endswith(end))
    return output.number(value, digits)
