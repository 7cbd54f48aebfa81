"""The commands about one contact: ``patch`` and ``conicity``. They compute nothing themselves.

Conversion to millimetres, kilonewtons and per mille is here; the packages below use SI. Large packages are
imported inside the commands, so that ``--help`` is fast.
"""

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from hh_exudyn.cli import inputs, output
from hh_exudyn.cli.names import NamesInHelp

if TYPE_CHECKING:
    from hh_exudyn.contact.geometry.merit import ConicityReport
    from hh_exudyn.contact.profile import Profile
    from hh_exudyn.contact.tangential.api import CreepForce, PatchLoad, TractionField


def register(app: typer.Typer) -> None:
    """Add the commands of this file to the program."""
    app.command(cls=NamesInHelp)(patch)
    app.command(cls=NamesInHelp)(conicity)


def patch(
    a_mm: inputs.SemiAxisAlong,
    b_mm: inputs.SemiAxisAcross,
    load_kn: inputs.NormalForce,
    nu_x: Annotated[
        float, typer.Option(metavar="NUMBER", help="Longitudinal creepage, wheel relative to rail.")
    ] = 0.0,
    nu_y: Annotated[
        float, typer.Option(metavar="NUMBER", help="Lateral creepage, positive to the left.")
    ] = 0.0,
    spin: Annotated[float, typer.Option(metavar="1/m", help="Spin creepage.")] = 0.0,
    friction: inputs.Friction = 0.3,
    theory: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="Only this theory; may be repeated. Theories: {theories}."),
    ] = None,
    cells: Annotated[int, typer.Option(metavar="N", help="Cells along, and strips across the patch.")] = 50,
    figure: inputs.NewFigure = None,
) -> None:
    """Creep forces of one elliptic patch after every theory, side by side: a table and a figure.
    \f
    Ten arguments: each is an option of the command.
    """
    with output.errors_in_one_line():
        inputs.check_patch(a_mm, b_mm, load_kn, nu_x, nu_y, spin, friction)
        inputs.check_range("--cells", cells, 5, 400)
        inputs.require_new_file(figure, "--out", inputs.FIGURES)
        names = _theories(theory or [])
        from hh_exudyn.contact.material import STEEL
        from hh_exudyn.contact.tangential.api import PatchLoad, creep_force, traction_field
        from hh_exudyn.contact.tangential.registry import PATCH_FIELD_THEORIES
        from hh_exudyn.figures.patch import patch_figure

        load = PatchLoad(a_mm * 1e-3, b_mm * 1e-3, load_kn * 1e3, nu_x, nu_y, spin, friction)
        forces = {name: creep_force(name, *load.arguments, cells=(cells, cells)) for name in names}
        fields = {
            name: traction_field(name, *load.arguments, cells=(cells, cells))
            for name in names
            if name in PATCH_FIELD_THEORIES
        }
        output.print_table(_patch_table(load, forces, fields))
        output.print_line(
            "forces on the wheel; limit: friction * normal force; "
            f"steel: G = {STEEL.shear_modulus * 1e-9:g} GPa, nu = {STEEL.poisson_ratio:g}"
        )
        if figure is not None:
            output.write_figure(patch_figure(load, forces, fields), figure)


def _patch_table(
    load: "PatchLoad", forces: Mapping[str, "CreepForce"], fields: Mapping[str, "TractionField"]
) -> Table:
    """A line per theory; dashes in the last two columns for theories without a stress field."""
    from hh_exudyn.contact.tangential.api import cell_areas

    limit = load.friction * load.normal_force
    pressure = 1.5 * load.normal_force / (math.pi * load.a * load.b)
    table = output.new_table(
        f"Patch of {2e3 * load.a:.4g} x {2e3 * load.b:.4g} mm under {load.normal_force * 1e-3:.4g} kN, "
        f"Hertz pressure {pressure * 1e-6:.0f} MPa",
        ("theory", "F_x [kN]", "F_y [kN]", "M_z [N\u00a0m]", "force over limit [%]", "max traction [MPa]",
         "slip [%\u00a0of\u00a0area]"),
    )  # fmt: skip
    for name, force in forces.items():
        stresses = [output.NOTHING, output.NOTHING]
        if name in fields:
            field = fields[name]
            traction = (field.q_x**2 + field.q_y**2) ** 0.5
            slides = (field.slip_x != 0.0) | (field.slip_y != 0.0)
            areas = cell_areas(load.a, load.b, *slides.shape)
            share = areas[slides].sum() / areas.sum()
            stresses = [f"{traction.max() * 1e-6:.0f}", f"{100.0 * share:.0f}"]
        table.add_row(
            name,
            output.number(force.x * 1e-3, 2),
            output.number(force.y * 1e-3, 2),
            output.number(force.moment, 2),
            output.number(100.0 * math.hypot(force.x, force.y) / limit, 1),
            *stresses,
        )
    return table


def conicity(
    wheel: Annotated[str, typer.Argument(metavar="WHEEL", help="Wheel profile: {wheels}, or a file.")],
    rail: Annotated[str, typer.Argument(metavar="RAIL", help="Rail profile: {rails}, or a file.")],
    gauge_mm: Annotated[
        list[float] | None, typer.Option(metavar="mm", help="Track gauge; may be repeated. [default: 1435]")
    ] = None,
    inclination: Annotated[
        str | None,
        typer.Option(metavar="1:N", help="Of a standard rail: 30, 1:30 or upright. [default: 1:30]"),
    ] = None,
    radius_mm: Annotated[float, typer.Option(metavar="mm", help="Wheel radius at the running circle.")] = 460,
    tape_distance_mm: Annotated[float, typer.Option(metavar="mm", help="Of the two running circles.")] = 1500,
    amplitude_mm: Annotated[
        list[float] | None, typer.Option(metavar="mm", help="May be repeated. [default: 1 to 10]")
    ] = None,
    figure: inputs.NewFigure = None,
) -> None:
    """Equivalent conicity (EN 15302) and rolling radius difference of a wheelset on a track."""
    with output.errors_in_one_line():
        gauges = sorted(set(gauge_mm or [1435.0]))
        amplitudes = sorted(set(amplitude_mm or map(float, range(1, 11))))
        for value in gauges:
            inputs.check_range("--gauge-mm", value, 500.0, 2000.0, "mm")
        for value in amplitudes:
            inputs.check_range("--amplitude-mm", value, 0.1, 20.0, "mm")
        inputs.check_range("--radius-mm", radius_mm, 100.0, 2000.0, "mm")
        inputs.check_range("--tape-distance-mm", tape_distance_mm, 300.0, 3000.0, "mm")
        inputs.require_new_file(figure, "--out", inputs.FIGURES)
        profiles = _wheel(wheel), _rail(rail, inclination)
        import numpy as np

        from hh_exudyn.contact.geometry.merit import conicity_report

        reports = {}
        for gauge in gauges:
            with inputs.refused_as_bad_input():  # the pair may not touch on this gauge
                reports[f"gauge {gauge:g} mm"] = conicity_report(
                    *profiles,
                    radius=radius_mm * 1e-3,
                    gauge=gauge * 1e-3,
                    tape_distance=tape_distance_mm * 1e-3,
                    amplitudes=np.array(amplitudes) * 1e-3,
                )
        output.print_table(_conicity_table(f"{profiles[0].name} on {profiles[1].name}", reports))
        for name, report in reports.items():
            output.print_line(f"{name}: {_summary(report)}")
        output.print_line(
            "conicity at the amplitude y; radius difference left - right at the displacement y to the left;\n"
            f"wheel radius {radius_mm:g} mm, tape distance {tape_distance_mm:g} mm"
        )
        if figure is not None:
            from hh_exudyn.figures.conicity_sheet import conicity_sheet

            output.write_figure(conicity_sheet(*profiles, reports), figure)


def _conicity_table(title: str, reports: Mapping[str, "ConicityReport"]) -> Table:
    """A line per amplitude, two columns per report."""
    import numpy as np

    amplitudes = next(iter(reports.values())).amplitudes
    headings, columns = ["y [mm]"], [[f"{1e3 * amplitude:g}" for amplitude in amplitudes]]
    for name, report in reports.items():
        at = name.replace(" mm", "\u00a0mm:")
        headings += [f"{at} conicity [-]", f"{at} radius\u00a0diff. [mm]"]
        differences = np.interp(
            amplitudes, report.functions.lateral, report.functions.radius_difference, right=math.nan
        )
        columns.append([output.number(value, 3) for value in report.conicity])
        columns.append([output.number(1e3 * value, 2) for value in differences])
    table = output.new_table(title, tuple(headings))
    for cells in zip(*columns, strict=True):
        table.add_row(*cells)
    return table


def _summary(report: "ConicityReport") -> str:
    """Flange clearance, conicity at 3 mm and nonlinearity of a report, in one line."""
    return (
        f"flange touches at {output.number(1e3 * report.clearance_right, 2)} and "
        f"{output.number(1e3 * report.clearance_left, 2)} mm, "
        f"conicity at 3 mm {output.number(report.reference_conicity, 3)}, "
        f"nonlinearity {output.number(1e-3 * report.nonlinearity, 3)} 1/mm"
    )


def _theories(wanted: list[str]) -> list[str]:
    """The named theories in the order of the registry; all of them where none is named."""
    from hh_exudyn.contact.tangential.registry import PATCH_THEORIES

    for name in wanted:
        if name not in PATCH_THEORIES:
            raise inputs.BadInput(f"--theory {name}: unknown, allowed: {', '.join(PATCH_THEORIES)}")
    return [name for name in PATCH_THEORIES if name in wanted or not wanted]


def _wheel(name: str) -> "Profile":
    """A standard wheel profile by its name, or one from a file."""
    from hh_exudyn.contact.profile import WHEEL_PROFILES, read_wheel_profile, wheel_profile

    if name in WHEEL_PROFILES:
        return wheel_profile(name)
    return _from_file("WHEEL", name, read_wheel_profile, WHEEL_PROFILES)


def _rail(name: str, inclination: str | None) -> "Profile":
    """A standard rail by its name, inclined, or a measured one from a file, with its own inclination."""
    from hh_exudyn.contact.profile import RAIL_PROFILES, rail_profile, read_rail_profile

    if name in RAIL_PROFILES:
        return rail_profile(name, _inclination(inclination or "1:30"))
    if inclination is not None and Path(name).is_file():
        raise inputs.BadInput(
            f"--inclination {inclination}: for standard rails only, a file holds its rail inclined"
        )
    return _from_file("RAIL", name, read_rail_profile, RAIL_PROFILES)


def _from_file(
    argument: str, name: str, reader: Callable[[str], "Profile"], known: tuple[str, ...]
) -> "Profile":
    """The profile in a file; raises `BadInput` for a missing file or one that is not a profile."""
    if not Path(name).is_file():
        raise inputs.BadInput(
            f"{argument} {name}: no file and no standard profile, known: {', '.join(known)}"
        )
    with inputs.refused_as_bad_input():
        return reader(name)


def _inclination(text: str) -> float:
    """Tangent of a rail's inclination from 30, 1:30 or upright."""
    if text == "upright":
        return 0.0
    try:
        slope = float(text.removeprefix("1:"))
    except ValueError:
        slope = math.nan
    if not 10.0 <= abs(slope) <= 1e6:
        raise inputs.BadInput(
            f"--inclination {text}: allowed upright, or 10 and more for 1:10 and less, as 30 or 1:30"
        )
    return 1.0 / slope
