"""The commands of linear analysis: ``modes`` and ``critical-speed``. They compute nothing themselves.

Everything heavy is imported inside the commands, so that ``--help`` answers at once.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from hh_exudyn.cli import inputs, output

if TYPE_CHECKING:
    from hh_exudyn.multibody.linear.modes import CriticalSpeed, LinearVehicle

SLOWEST, FASTEST = 5.0, 500.0  # km/h
_LOCUS_SPEEDS = 25  # of the figure


def register(app: typer.Typer) -> None:
    """Give the commands of this file to the program."""
    app.command()(modes)
    app.command(name="critical-speed")(critical_speed)


def modes(
    case: inputs.CaseFile,
    speed_km_h: Annotated[
        float | None, typer.Option(metavar="km/h", help="Speed. [default: the case's]")
    ] = None,
    undamped: Annotated[bool, typer.Option("--undamped", help="Dampers and creep off.")] = False,
    playback: Annotated[
        Path | None, typer.Option(metavar="F.rrd", help="Write a mode as a recording to this new file.")
    ] = None,
    mode: Annotated[int, typer.Option(metavar="N", help="Which mode, by its number in the table.")] = 1,
) -> None:
    """Oscillating modes of a case's vehicle on straight track: frequency, damping, what moves most."""
    with output.errors_in_one_line():
        inputs.require_new_file(playback, "--playback", inputs.RECORDINGS)
        inputs.check_range("--speed-km-h", speed_km_h, SLOWEST, FASTEST, "km/h")
        vehicle, own = _linear(case)
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
            from hh_exudyn.case import read_case
            from hh_exudyn.playback.mode import record_mode

            shown = found[mode - 1]
            name = f"{vehicle.vehicle.name}, mode {mode}: {shown.frequency:.3f} Hz"
            record_mode(read_case(case), vehicle.vehicle, shown.shape, playback, name=name)
            output.print_line(f"recording: {playback}")


def critical_speed(
    case: inputs.CaseFile,
    from_km_h: Annotated[float, typer.Option(metavar="km/h", help="Lowest speed looked at.")] = 20.0,
    to_km_h: Annotated[float, typer.Option(metavar="km/h", help="Highest speed looked at.")] = 300.0,
    step_km_h: Annotated[float, typer.Option(metavar="km/h", help="Distance of the speeds.")] = 20.0,
    figure: inputs.NewFigure = None,
) -> None:
    """Speed at which a case's vehicle begins to hunt by its eigenvalues; a figure is the root locus."""
    with output.errors_in_one_line():
        inputs.check_range("--from-km-h", from_km_h, SLOWEST, FASTEST, "km/h")
        inputs.check_range("--to-km-h", to_km_h, SLOWEST, FASTEST, "km/h")
        inputs.check_range("--step-km-h", step_km_h, 0.1, FASTEST, "km/h")
        if not from_km_h < to_km_h:
            raise inputs.BadInput(f"--to-km-h {to_km_h:g} km/h: allowed above --from-km-h {from_km_h:g} km/h")
        inputs.require_new_file(figure, "--out", inputs.FIGURES)
        vehicle, _ = _linear(case)
        import hh_exudyn.multibody.linear.modes as linear
        from hh_exudyn.multibody.equilibrium import NoEquilibrium

        try:
            with output.status("critical speed"):
                found = linear.critical_speed(vehicle, from_km_h / 3.6, to_km_h / 3.6, step_km_h / 3.6)
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
        if figure is not None:
            import numpy as np

            from hh_exudyn.figures.root_locus import root_locus_figure

            speeds = np.linspace(from_km_h, to_km_h, _LOCUS_SPEEDS) / 3.6
            with output.status("root locus"):
                locus = linear.root_locus(vehicle, [float(speed) for speed in speeds])
            speed = None if found is None else found.speed
            output.write_figure(root_locus_figure(f"Root locus of {name}", speeds, locus, speed), figure)


def _what(found: "CriticalSpeed", vehicle: "LinearVehicle") -> str:
    mode = found.mode
    wavelength = found.speed / mode.frequency
    return f"{mode.frequency:.3f} Hz, {wavelength:.2f} m, {mode.largest(vehicle.names)} moves most"


def _linear(path: Path) -> "tuple[LinearVehicle, float]":
    """The vehicle of a case for linear analysis, and the case's speed [m/s]."""
    from hh_exudyn.case import read_case
    from hh_exudyn.multibody.linear.modes import LinearVehicle

    case = read_case(path)
    with inputs.refused_as_bad_input():
        return LinearVehicle(case.described_vehicle(), case), case.speed
