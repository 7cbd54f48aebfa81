"""The command ``twist-test``: a vehicle crawls over twisted track. It computes nothing itself.

Large packages are imported inside the command, so that ``--help`` is fast.
"""

from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from hh_exudyn.cli import inputs, output
from hh_exudyn.cli.changes import OtherVehicle, Settings, changed_case
from hh_exudyn.cli.run import simulated

if TYPE_CHECKING:
    from hh_exudyn.assessment.limits import Limit
    from hh_exudyn.assessment.twist_test import Twist, TwistResult
    from hh_exudyn.log.store import Run

PLACES = ("straight", "curve")


def register(app: typer.Typer) -> None:
    """Add the command of this file to the program."""
    app.command("twist-test")(twist_test)


def twist_test(
    case: inputs.CaseFile,
    out_folder: inputs.NewFolder,
    vehicle_: OtherVehicle = None,
    set_: Settings = None,
    curve: Annotated[bool, typer.Option(help="Also in a curve of 150 m.")] = True,
) -> None:
    """Twist test after EN 14363 (from memory) of a case's vehicle at 10 km/h.

    Unloading dQ/Q0 on twisted straight track, and Y/Q where the cant of a curve of 150 m runs out. The case's
    own track is not used.
    """
    with output.errors_in_one_line(out_folder):
        base = changed_case(case, vehicle_, set_)
        inputs.require_new_folder(out_folder)
        from hh_exudyn.assessment.twist_test import twist_case, twist_limits, twist_of, twist_result

        with inputs.refused_as_bad_input():
            twist = twist_of(base.described_vehicle())
            cases = {place: twist_case(base, place == "curve") for place in PLACES[: 1 + curve]}
        runs = {place: simulated(own, out_folder / place) for place, own in cases.items()}
        results = {place: twist_result(run) for place, run in runs.items()}
        _show(twist, results, runs, twist_limits())


def _show(
    twist: "Twist", results: "dict[str, TwistResult]", runs: "dict[str, Run]", limits: "dict[str, Limit]"
) -> None:
    """The twists, a line per wheel, and the verdicts."""
    output.print_line(
        f"twist of a bogie {1e3 * twist.of_bogie:.2f} per mille over {twist.wheelbase:.3f} m, of the body "
        f"{1e3 * twist.of_body:.2f} per mille over {twist.distance:.3f} m"
    )
    output.print_table(_table(results))
    _print_verdict("dQ/Q0 on straight track", float(results["straight"].unloading.max()), limits["unloading"])
    if "curve" in results:
        outer = results["curve"].y_over_q[1::2].max()  # the curve is left-hand
        _print_verdict("Y/Q of an outer wheel in the curve", float(outer), limits["y_over_q"])
        lifts = [wheel["lift_mm"] for wheel in runs["curve"].status.get("watch", [])]
        if lifts:
            _print_verdict("lift of a wheel in the curve [mm]", 1e-3 * max(lifts), limits["lift"], 1e3)


def _table(results: "dict[str, TwistResult]") -> Table:
    """A line per wheel."""
    headings = [f"{place} {quantity} [-]" for place in results for quantity in ("dQ/Q0", "Y/Q")]
    table = output.new_table(
        "Largest unloading and Y/Q (mean over 2 m) in the twist test", ("wheel", *headings)
    )
    for i, wheel in enumerate(results["straight"].wheels):
        cells = []
        for result in results.values():
            cells += [output.number(result.unloading[i], 3), output.number(result.y_over_q[i], 3)]
        table.add_row(wheel.removeprefix("wheel "), *cells)
    return table


def _print_verdict(what: str, value: float, limit: "Limit", factor: float = 1.0) -> None:
    """A value, its limit with its source, and whether it holds; the factor leads to the shown unit."""
    verdict = "holds" if value <= limit.value else "EXCEEDED"
    mark = "" if limit.confirmed else " ?"
    output.print_line(
        f"{what}: {factor * value:.3g}, limit {factor * limit.value:.3g}{mark}: {verdict} ({limit.source})"
    )
