"""The command ``creep-curve``: creep force over creepage by every theory, beside the half-space."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from hh_exudyn.cli import inputs, output

if TYPE_CHECKING:
    import pyarrow

    from hh_exudyn.contact.tangential.curves import CreepCurve


def register(app: typer.Typer) -> None:
    """Add the command to the program."""
    app.command("creep-curve")(creep_curve_command)


def creep_curve_command(
    a_mm: inputs.SemiAxisAlong,
    b_mm: inputs.SemiAxisAcross,
    load_kn: inputs.NormalForce,
    over: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME", help="longitudinal, lateral or spin; may be repeated. [default: all three]"
        ),
    ] = None,
    nu_x: Annotated[
        float, typer.Option(metavar="NUMBER", help="Longitudinal creepage while another varies.")
    ] = 0.0,
    nu_y: Annotated[float, typer.Option(metavar="NUMBER", help="Lateral creepage, likewise.")] = 0.0,
    spin: Annotated[float, typer.Option(metavar="1/m", help="Spin creepage, likewise.")] = 0.0,
    friction: inputs.Friction = 0.3,
    reach: Annotated[
        float,
        typer.Option(metavar="NUMBER", help="Largest creepage, over that of the linear theory at the limit."),
    ] = 3.0,
    points: Annotated[int, typer.Option(metavar="N", help="Creepages of a curve.")] = 25,
    cells: Annotated[int, typer.Option(metavar="N", help="Cells along the patch, and across it.")] = 30,
    theory: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="Only this theory beside the half-space; may be repeated."),
    ] = None,
    table: Annotated[
        Path | None, typer.Option(metavar="TABLE", help="Write all curves to this new file (.csv).")
    ] = None,
    figure: inputs.NewFigure = None,
) -> None:
    """Creep force over creepage and spin, all theories beside the exact half-space: errors, figure, table.

    \f
    Fourteen arguments: each is an option of the command. They are in its units; what is computed, and the
    table, is in SI.
    """
    with output.errors_in_one_line():
        inputs.check_patch(a_mm, b_mm, load_kn, nu_x, nu_y, spin, friction)
        inputs.check_range("--reach", reach, 0.01, 100.0)
        inputs.check_range("--points", points, 2, 1000)
        inputs.check_range("--cells", cells, 6, 200)
        inputs.require_new_file(figure, "--out", inputs.FIGURES)
        inputs.require_new_file(table, "--table", inputs.TABLES)
        names = _theories(theory or [])
        from hh_exudyn.contact.tangential.curves import CREEPAGES, CurvePatch, creep_curve

        for name in over or ():
            if name not in CREEPAGES:
                raise inputs.BadInput(f"--over {name}: unknown, allowed: {', '.join(CREEPAGES)}")
        patch = CurvePatch(a_mm * 1e-3, b_mm * 1e-3, load_kn * 1e3, friction, nu_x, nu_y, spin)
        curves = []
        for name in CREEPAGES:
            if name in (over or CREEPAGES):
                with output.status(f"{name} creepage"):
                    curves.append(creep_curve(patch, name, names, reach=reach, points=points, cells=cells))
        _print_errors(names, curves)
        if table is not None:
            output.write_table(_to_table(curves), table, "--table")
        if figure is not None:
            from hh_exudyn.figures.creep_curve import creep_curve_figure

            output.write_figure(creep_curve_figure(patch, curves), figure)


def _theories(wanted: list[str]) -> list[str]:
    """The named theories (all where none is named) with the half-space, in the order of the registry."""
    from hh_exudyn.contact.tangential.curves import EXACT
    from hh_exudyn.contact.tangential.registry import PATCH_THEORIES

    for name in wanted:
        if name not in PATCH_THEORIES:
            raise inputs.BadInput(f"--theory {name}: unknown, allowed: {', '.join(PATCH_THEORIES)}")
    return [name for name in PATCH_THEORIES if name in wanted or not wanted or name == EXACT]


def _print_errors(names: Sequence[str], curves: Sequence["CreepCurve"]) -> None:
    """A line per theory, a column per curve."""
    from hh_exudyn.contact.tangential.curves import EXACT

    table = output.new_table(
        "Largest errors against the half-space, in % of friction * normal force",
        ("theory", *(curve.creepage for curve in curves)),
    )
    for name in names:
        if name != EXACT:
            table.add_row(name, *(output.number(100.0 * curve.error(name), 1) for curve in curves))
    output.print_table(table)
    for curve in curves:
        scale, unit = (1.0, "1/m") if curve.creepage == "spin" else (1e3, "per mille")
        output.print_line(
            f"{curve.creepage}: {len(curve.values)} creepages to {curve.values[-1] * scale:.4g} {unit}"
        )


def _to_table(curves: Sequence["CreepCurve"]) -> "pyarrow.Table":
    """A row per curve, creepage and theory."""
    import pyarrow

    rows = [
        {
            "over": curve.creepage, "creepage": float(value),
            "unit": "1/m" if curve.creepage == "spin" else "-",
            "theory": name, "F_x_over_mu_N": float(x), "F_y_over_mu_N": float(y), "M_z_over_mu_N_c": float(m),
        }
        for curve in curves
        for name, forces in curve.forces.items()
        for value, (x, y, m) in zip(curve.values, forces, strict=True)
    ]  # fmt: skip
    return pyarrow.Table.from_pylist(rows)
