"""The commands ``modes`` and ``critical-speed``, linear and nonlinear. They compute nothing themselves.

Large packages are imported inside the commands, so that ``--help`` is fast.
"""

import math
import time as clock
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from hh_exudyn.cli import inputs, output
from hh_exudyn.cli.changes import OtherVehicle, Settings, changed_case

if TYPE_CHECKING:
    from hh_exudyn.case import Case
    from hh_exudyn.multibody.linear.modes import CriticalSpeed, LinearVehicle
    from hh_exudyn.multibody.linear.nonlinear_speed import HuntingRun

SLOWEST, FASTEST = 5.0, 500.0  # km/h
_HIGHEST, _HIGHEST_NONLINEAR = 300.0, 200.0  # km/h, default ends of the search
_LOCUS_SPEEDS = 25  # of the figure


def register(app: typer.Typer) -> None:
    """Add the commands of this file to the program."""
    app.command()(modes)
    app.command(name="critical-speed")(critical_speed)


def modes(
    case: inputs.CaseFile,
    vehicle_: OtherVehicle = None,
    set_: Settings = None,
    speed_km_h: Annotated[
        float | None, typer.Option(metavar="km/h", help="Speed. [default: the case's]")
    ] = None,
    undamped: Annotated[bool, typer.Option("--undamped", help="Dampers and creep off.")] = False,
    playback: Annotated[
        Path | None, typer.Option(metavar="F.rrd", help="Write a mode as a recording to this new file.")
    ] = None,
    mode: Annotated[int, typer.Option(metavar="N", help="Which mode, by its number in the table.")] = 1,
) -> None:
    """Oscillating modes of a case's vehicle on straight track: frequency, damping, largest motion."""
    with output.errors_in_one_line():
        inputs.require_new_file(playback, "--playback", inputs.RECORDINGS)
        inputs.check_range("--speed-km-h", speed_km_h, SLOWEST, FASTEST, "km/h")
        changed = changed_case(case, vehicle_, set_)
        vehicle, own = _linear(changed)
        speed = own if speed_km_h is None else speed_km_h / 3.6
        from hh_exudyn.multibody.equilibrium import NoEquilibrium

        try:
            found = vehicle.modes(speed, undamped=undamped)
        except NoEquilibrium as error:
            output.fail(output.STOPPED, str(error))
        kind = ", dampers and creep off" if undamped else ""
        table = output.new_table(
            f"Modes of {vehicle.vehicle.name} at {speed * 3.6:g} km/h{kind}",
            ("mode", "frequency [Hz]", "damping ratio [%]", "moves most"),
        )
        table.columns[3].justify = "left"
        for row, each in enumerate(found, 1):
            table.add_row(
                str(row),
                output.number(each.frequency, 4),
                output.number(100.0 * each.damping_ratio, 2),
                each.largest(vehicle.names),
            )
        output.print_table(table)
        output.print_line("friction elements stick; a negative damping ratio is a motion that grows")
        if playback is not None:
            inputs.check_range("--mode", mode, 1, len(found), "")
            from hh_exudyn.playback.mode import record_mode

            shown = found[mode - 1]
            name = f"{vehicle.vehicle.name}, mode {mode}: {shown.frequency:.3f} Hz"
            record_mode(changed, vehicle.vehicle, shown.shape, playback, name=name)
            output.print_line(f"recording: {playback}")


def critical_speed(
    case: inputs.CaseFile,
    vehicle_: OtherVehicle = None,
    set_: Settings = None,
    from_km_h: Annotated[float, typer.Option(metavar="km/h", help="Lowest speed looked at.")] = 20.0,
    to_km_h: Annotated[
        float | None,
        typer.Option(metavar="km/h", help="Highest speed looked at. [default: 300, nonlinear 200]"),
    ] = None,
    step_km_h: Annotated[float, typer.Option(metavar="km/h", help="Distance of the speeds.")] = 20.0,
    nonlinear: Annotated[
        bool, typer.Option("--nonlinear", help="By motion in time, down from a hunting limit cycle.")
    ] = False,
    resolution_km_h: Annotated[
        float, typer.Option(metavar="km/h", help="To which the nonlinear speed is found.")
    ] = 2.0,
    figure: inputs.NewFigure = None,
) -> None:
    """Speed at which a case's vehicle begins to hunt.

    By its eigenvalues: where its smallest motions begin to grow, all friction elements sticking; a figure is
    the root locus. With --nonlinear: below which hunting dies out, friction elements sliding; a figure is the
    amplitude over the speed. For a vehicle on friction, as a three-piece wagon, that is the one to quote.
    \f
    Nine arguments: each is an option of the command.
    """
    with output.errors_in_one_line():
        if to_km_h is None:
            to_km_h = _HIGHEST_NONLINEAR if nonlinear else _HIGHEST
        inputs.check_range("--from-km-h", from_km_h, SLOWEST, FASTEST, "km/h")
        inputs.check_range("--to-km-h", to_km_h, SLOWEST, FASTEST, "km/h")
        inputs.check_range("--step-km-h", step_km_h, 0.1, FASTEST, "km/h")
        inputs.check_range("--resolution-km-h", resolution_km_h, 0.1, FASTEST, "km/h")
        if not from_km_h < to_km_h:
            raise inputs.BadInput(f"--to-km-h {to_km_h:g} km/h: allowed above --from-km-h {from_km_h:g} km/h")
        inputs.require_new_file(figure, "--out", inputs.FIGURES)
        vehicle, _ = _linear(changed_case(case, vehicle_, set_))
        if nonlinear:
            _by_motion(vehicle, from_km_h, to_km_h, step_km_h, resolution_km_h, figure)
            return
        from hh_exudyn.multibody.equilibrium import NoEquilibrium
        from hh_exudyn.multibody.linear.modes import critical_speed as onset
        from hh_exudyn.multibody.linear.modes import root_locus

        try:
            with output.status("critical speed"):
                found = onset(vehicle, from_km_h / 3.6, to_km_h / 3.6, step_km_h / 3.6)
        except NoEquilibrium as error:
            output.fail(output.STOPPED, str(error))
        name = vehicle.vehicle.name
        if found is None:
            output.print_line(f"{name}: stable from {from_km_h:g} to {to_km_h:g} km/h")
        elif found.speed * 3.6 <= from_km_h + 1e-9:
            output.print_line(f"{name}: unstable already at {from_km_h:g} km/h, {_what(found, vehicle)}")
        else:
            output.print_line(
                f"{name}: critical speed {found.speed * 3.6:.2f} km/h ({found.speed:.3f} m/s), "
                f"{_what(found, vehicle)}"
            )
        if vehicle.on_friction:
            output.print_line(
                "its friction elements stick everywhere here: a motion that makes them slide hunts at other "
                "speeds; --nonlinear gives the one below which hunting dies out"
            )
        if figure is not None:
            import numpy as np

            from hh_exudyn.figures.root_locus import root_locus_figure

            speeds = np.linspace(from_km_h, to_km_h, _LOCUS_SPEEDS) / 3.6
            with output.status("root locus"):
                locus = root_locus(vehicle, [float(speed) for speed in speeds])
            speed = None if found is None else found.speed
            output.write_figure(root_locus_figure(f"Root locus of {name}", speeds, locus, speed), figure)


def _by_motion(
    vehicle: "LinearVehicle", low: float, high: float, step: float, resolution: float, figure: Path | None
) -> None:
    """Print every run, the nonlinear critical speed and the conditions of the search; speeds [km/h]."""
    from hh_exudyn.multibody.equilibrium import NoEquilibrium
    from hh_exudyn.multibody.linear import nonlinear_speed

    name = vehicle.vehicle.name
    output.print_line(
        f"{name}: the train slows down from {high:g} km/h, at first with all wheelsets "
        f"{nonlinear_speed.DISPLACEMENT * 1e3:g} mm to the left; it hunts while a wheelset moves by "
        f"{nonlinear_speed.SETTLED * 1e3:g} mm or more to either side; friction elements slide; "
        "smooth straight track"
    )
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=output.err, transient=True, disable=not output.err.is_terminal) as bar:
        reports = _RunReports(bar)
        try:
            found = nonlinear_speed.nonlinear_critical_speed(
                vehicle,
                low / 3.6,
                high / 3.6,
                step / 3.6,
                resolution / 3.6,
                report=reports.report,
                progress=reports.progress,
            )
        except NoEquilibrium as error:
            output.fail(output.STOPPED, str(error))
        except ValueError as error:
            raise inputs.BadInput(str(error)) from None
    if found.hunting is None:
        output.print_line(f"{name}: no hunting from {low:g} to {high:g} km/h")
    elif found.settled is None:
        output.print_line(f"{name}: hunting goes on down to {low:g} km/h")
    else:
        begins = "does not begin it"
        if found.begins is not None:
            begins = f"begins it from {found.begins * 3.6:.1f} km/h on"
        output.print_line(
            f"{name}: nonlinear critical speed {found.hunting * 3.6:.1f} km/h (hunting goes on there, at "
            f"{found.settled * 3.6:.1f} km/h it dies out); the disturbance of the resting vehicle {begins}"
        )
    if figure is not None:
        from hh_exudyn.figures.hunting import hunting_figure

        runs = [run for run in found.runs if math.isfinite(run.amplitude)]
        drawn = hunting_figure(
            f"Hunting of {name}",
            [run.speed for run in runs],
            [run.amplitude for run in runs],
            [run.from_cycle for run in runs],
            nonlinear_speed.SETTLED,
        )
        output.write_figure(drawn, figure)


class _RunReports:
    """A line for every finished run, and a bar for the current one, with the remaining time."""

    def __init__(self, bar: Progress) -> None:
        self._bar = bar
        self._task = bar.add_task("equilibrium", total=1.0)
        self._begun = clock.perf_counter()
        self._runs = 0

    def report(self, run: "HuntingRun", more: int) -> None:
        """Print a run and the longest time that at most `more` further runs may take."""
        self._runs += 1
        left = more * (clock.perf_counter() - self._begun) / self._runs
        wheels = "a wheel left its rail"
        if math.isfinite(run.amplitude):
            wheels = f"{run.amplitude * 1e3:6.2f} mm {output.number(run.frequency, 2):>5} Hz"
        begun = "cycle" if run.from_cycle else "disturbed"
        output.print_line(
            f"{run.speed * 3.6:6.1f} km/h {wheels} after {run.duration:4.1f} s, {begun:9} "
            f"{'hunts' if run.hunts else 'dies out':8} (at most {left:.0f} s more)"
        )

    def progress(self, speed: float, time: float, longest: float) -> None:
        """Move the bar of a run."""
        text = f"{speed * 3.6:.1f} km/h, {time:.1f} s of at most {longest:.0f} s of motion"
        self._bar.update(self._task, completed=time / longest, description=text)


def _what(found: "CriticalSpeed", vehicle: "LinearVehicle") -> str:
    mode = found.mode
    wavelength = found.speed / mode.frequency
    return f"{mode.frequency:.3f} Hz, {wavelength:.2f} m, {mode.largest(vehicle.names)} moves most"


def _linear(case: "Case") -> "tuple[LinearVehicle, float]":
    """The vehicle of a case for linear analysis, and the case's speed [m/s]."""
    from hh_exudyn.multibody.linear.modes import LinearVehicle

    with inputs.refused_as_bad_input():
        return LinearVehicle(case.described_vehicle(), case), case.speed
