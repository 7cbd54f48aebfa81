"""The commands about track: ``track plot`` shows a case's track or a line. They compute nothing themselves.

Conversion to millimetres and km/h is here; the packages below use SI. Large packages are imported inside the
commands, so that ``--help`` is fast.
"""

import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from hh_exudyn.cli import inputs, output
from hh_exudyn.cli.names import NamesInHelp
from hh_exudyn.text_files import read_toml

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from hh_exudyn.case import Case
    from track.course.alignment import Alignment
    from track.irregularity.irregularity import Irregularity
    from track.irregularity.quality import TrackQuality
    from track.line.line import TrackSection

track = typer.Typer(help="Look at tracks and lines.", no_args_is_help=True)

_OF_A_CASE = {"track", "vehicle", "friction", "wheel_profile"}  # keys at the top of a case file
_OF_A_LINE = {"length", "country", "curve", "gauge"}  # and of a line's file


def register(app: typer.Typer) -> None:
    """Add the commands of this file to the program."""
    app.add_typer(track, name="track")


@track.callback()
def _track() -> None:
    """Look at tracks and lines."""


@track.command(cls=NamesInHelp)
def plot(
    source: Annotated[
        str, typer.Argument(metavar="CASE|LINE", help="Case file, a line ({lines}), or a line's file.")
    ],
    figure: inputs.NewFigure = None,
    speed_km_h: Annotated[
        float | None,
        typer.Option(metavar="km/h", help="Speed of a case, for cant and quality. [default: the case's]"),
    ] = None,
    vehicle: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Vehicle of a line's speeds. [default: the first in its file]"),
    ] = None,
) -> None:
    """Sections, irregularities and quality of a case's track; or a line's classes and their shares."""
    with output.errors_in_one_line():
        inputs.check_range("--speed-km-h", speed_km_h, 5.0, 130.0, "km/h")
        inputs.require_new_file(figure, "--out", inputs.FIGURES)
        if _is_line(source):
            if speed_km_h is not None:
                raise inputs.BadInput(
                    f"--speed-km-h {speed_km_h:g}: for cases only, a line has speeds of its own"
                )
            _show_line(source, vehicle, figure)
        else:
            if vehicle is not None:
                raise inputs.BadInput(f"--vehicle {vehicle}: for lines only, a case has a vehicle of its own")
            _show_case(Path(source), speed_km_h, figure)


def _is_line(source: str) -> bool:
    """Whether the argument is a line; raises `BadInput` if it is neither a line nor a case file."""
    from track.line.line_file import line_names

    if source in line_names():
        return True
    path = Path(source)
    known = f"known lines: {', '.join(line_names())}"
    if path.is_dir():
        raise inputs.BadInput(
            f"CASE|LINE {source}: is a folder, allowed is a case file or a line's file; {known}"
        )
    if not path.exists():
        raise inputs.BadInput(f"CASE|LINE {source}: no such file and no known line; {known}")
    try:
        keys = set(read_toml(path))
    except ValueError as error:
        raise inputs.BadInput(str(error)) from None
    if not keys & (_OF_A_CASE | _OF_A_LINE):
        raise inputs.BadInput(
            f"{source}: neither a case file (with [track]) nor a line's file (with [length])"
        )
    return not keys & _OF_A_CASE


def _show_case(path: Path, speed_km_h: float | None, figure: Path | None) -> None:
    """Tables of a case's track, and its figure."""
    from hh_exudyn.case import read_case
    from track.irregularity.quality import quality_limits

    case = read_case(path)
    speed_km_h = case.speed_km_h if speed_km_h is None else speed_km_h
    alignment = case.alignment()
    irregular = _irregularity(case, alignment)
    quality, why_not = _quality(irregular, alignment.length, speed_km_h / 3.6)
    title = f"Track of {case.name} at {speed_km_h:g} km/h"
    if case.track.centre_line is None:
        output.print_table(_section_table(title, alignment, speed_km_h / 3.6))
        if any(grade.gradient or grade.end for grade in alignment.grades):
            output.print_table(_grade_table(alignment))
    else:
        output.print_line(f"{title}: {_survey_line(alignment)}")
    limits = quality_limits(speed_km_h / 3.6)
    if irregular is None:
        output.print_line("irregularity: none")
    else:
        output.print_line(f"irregularity: {case.track.irregularity}, {_deviations(irregular)};")
        output.print_line("a run fades them in and out at both ends of that")
    if why_not:
        output.print_line(f"quality: not judged, {why_not}")
    if quality is not None:
        output.print_table(_quality_table(quality, limits))
        output.print_line(
            "standard deviations over 100 m at wavelengths of 3 to 25 m, UIC 518; QN3 = 1.3 QN2 is assumed"
        )
    if figure is not None:
        from hh_exudyn.figures.track import track_sheet

        title = f"{case.name}, {speed_km_h:g} km/h, irregularity: {case.track.irregularity}"
        output.write_figure(track_sheet(title, alignment, irregular, quality, limits), figure)


def _irregularity(case: "Case", alignment: "Alignment") -> "Irregularity | None":
    """The irregularities of the case over the length of its run (random track depends on the length)."""
    from vehicles.start import start_front

    with inputs.refused_as_bad_input():
        return case.track.irregular(start_front(case.described_vehicle(), case.start_m), alignment.length)


def _quality(irregular: "Irregularity | None", end: float, speed: float) -> "tuple[TrackQuality | None, str]":
    """Quality of the sections up to the end of the track [m]; None with the reason where there is none."""
    from track.irregularity.quality import track_quality

    if irregular is None:
        return None, ""
    try:
        found = track_quality(irregular, speed)
    except ValueError as error:
        return None, str(error)
    on_track = found.start + found.section_length <= end + 1e-6  # a measured file may be longer than that
    if not on_track.any():
        return None, f"no whole section of {found.section_length:g} m lies on the track"
    found = replace(
        found,
        start=found.start[on_track],
        deviations=found.deviations[on_track],
        classes=found.classes[on_track],
    )
    return found, ""


def _section_table(title: str, alignment: "Alignment", speed: float) -> Table:
    """A line per section; a dash where a transition changes the number."""
    from track.course.alignment import Curve, Straight, cant_deficiency

    table = output.new_table(
        title,
        ("from [m]", "to [m]", "kind", "radius [m]", "hand", "cant [mm]", "gauge [mm]",
         "cant\u00a0deficiency [mm]"),
    )  # fmt: skip
    start = 0.0
    for section in alignment.sections:
        end = start + section.length
        cells = [output.NOTHING] * 5
        if isinstance(section, Curve):
            deficiency = cant_deficiency(speed, section.radius, section.cant)
            cells = [
                f"{section.radius:g}",
                section.hand,
                output.number(1e3 * section.cant, 1),
                output.number(1e3 * section.gauge, 1),
                output.number(1e3 * deficiency, 1),
            ]
        elif isinstance(section, Straight):
            cells = [
                output.NOTHING,
                output.NOTHING,
                output.number(0.0, 1),
                output.number(1e3 * section.gauge, 1),
                output.number(0.0, 1),
            ]
        table.add_row(f"{start:.1f}", f"{end:.1f}", type(section).__name__.lower(), *cells)
        start = end
    return table


def _grade_table(alignment: "Alignment") -> Table:
    """A line per grade: both ends and the gradients there, and the vertical radius."""
    table = output.new_table(
        "Gradients",
        ("from [m]", "to [m]", "from [\u2030]", "to [\u2030]", "vertical\u00a0radius [m]"),
    )
    from track.course.sections import Grade

    start = 0.0
    rest = alignment.length - math.fsum(grade.length for grade in alignment.grades)
    grades = alignment.grades
    if rest > 1e-3:  # the last gradient continues
        last = grades[-1].gradient if grades[-1].end is None else grades[-1].end
        grades += (Grade(rest, last),)
    for grade in grades:
        end = start + grade.length
        reached = grade.gradient if grade.end is None else grade.end
        change = abs(reached - grade.gradient)
        table.add_row(
            f"{start:.1f}",
            f"{end:.1f}",
            output.number(1e3 * grade.gradient, 2),
            output.number(1e3 * reached, 2),
            f"{grade.length / change:.0f}" if change else output.NOTHING,
        )
        start = end
    return table


def _survey_line(alignment: "Alignment") -> str:
    """Ranges of curvature, cant and gradient of a surveyed alignment, which is too long for a table."""
    table = alignment.table
    turn, slope = table.curvature, 1e3 * table.gradient
    return (
        f"surveyed, {alignment.length:.1f} m with the approach; curvature {1e3 * turn.min():.3f} to "
        f"{1e3 * turn.max():.3f} 1/km, left positive; cant up to {1e3 * abs(table.cant).max():.1f} mm; "
        f"gradient {slope.min():.2f} to {slope.max():.2f} per mille"
    )


def _deviations(irregular: "Irregularity") -> str:
    """Standard deviations of the four signals over the whole stretch, all wavelengths."""
    from track.irregularity.spectra import SIGNALS

    parts = [f"{name.replace('_', '-')} {1e3 * irregular.standard_deviation(name):.2f}" for name in SIGNALS]
    end = irregular.start + irregular.length
    return (
        f"{irregular.start:.1f} to {end:.1f} m, standard deviations of all wavelengths: {', '.join(parts)} mm"
    )


def _quality_table(quality: "TrackQuality", limits: "NDArray") -> Table:
    """A line per class: number and share of its sections, mean and largest standard deviations."""
    from track.irregularity.quality import CLASSES

    table = output.new_table(
        "Quality of sections of 100 m",
        ("class", "sections", "share [%]", "level mean [mm]", "level largest [mm]", "level\u00a0limit [mm]",
         "alignment mean [mm]", "alignment largest [mm]", "alignment\u00a0limit [mm]"),
    )  # fmt: skip
    for i, name in enumerate(CLASSES):
        own = quality.deviations[quality.classes == i]
        cells = []
        for j in range(2):
            cells += [output.NOTHING, output.NOTHING]
            if len(own):
                cells[-2:] = [
                    output.number(1e3 * own[:, j].mean(), 2),
                    output.number(1e3 * own[:, j].max(), 2),
                ]
            cells.append(output.number(1e3 * limits[j, i], 2) if i < limits.shape[1] else output.NOTHING)
        table.add_row(name, f"{len(own)}", output.number(100.0 * len(own) / len(quality.classes), 1), *cells)
    return table


def _show_line(source: str, vehicle: str | None, figure: Path | None) -> None:
    """Table of a line's classes, and its figure."""
    from track.line.line import load_sections, read_line

    with inputs.refused_as_bad_input():
        line = read_line(source)
        vehicle = vehicle or next(iter(line.speed.largest))
        sections = load_sections(line, vehicle)
    title = f"{line.name}, {1e-3 * line.length:g} km, speeds of {vehicle}"
    output.print_table(_class_table(title, sections, line.length))
    output.print_line("share of the line; QN1 to >QN3: share of the class in each quality class")
    if line.assumed():
        output.print_line(f"assumed in the line's file: {', '.join(line.assumed())}")
    if figure is not None:
        from hh_exudyn.figures.track import line_sheet

        output.write_figure(line_sheet(title, sections), figure)


def _class_table(title: str, sections: "tuple[TrackSection, ...]", length: float) -> Table:
    """A line per class of radius and hand, the tightest curves first, and their sum."""
    from track.irregularity.quality import CLASSES

    table = output.new_table(
        title,
        ("class [m]", "hand", "share [%]", "length [km]", "radius [m]", "cant [mm]", "gauge [mm]",
         "speed [km/h]", "deficiency [mm]", *(f"{name} [%]" for name in CLASSES)),
    )  # fmt: skip
    table.padding = (0, 0, 0, 1)  # many columns
    classes: dict[tuple[str, str], list[TrackSection]] = {}
    for part in sorted(sections, key=lambda part: (part.radius, part.hand)):
        classes.setdefault((part.name, part.hand), []).append(part)
    for (name, hand), parts in classes.items():
        share = math.fsum(part.weight for part in parts)
        one = parts[0]  # geometry and speed are the same all over a class
        by_quality = (
            math.fsum(part.weight for part in parts if part.quality == quality) / share for quality in CLASSES
        )
        table.add_row(
            name,
            output.NOTHING if math.isinf(one.radius) else hand,
            output.number(100.0 * share, 2),
            output.number(1e-3 * share * length, 2),
            output.NOTHING if math.isinf(one.radius) else f"{one.radius:.0f}",
            output.number(1e3 * one.cant, 1),
            output.number(1e3 * one.gauge, 1),
            output.number(3.6 * one.speed, 0),
            output.number(1e3 * one.cant_deficiency, 1),
            *(output.number(100.0 * part, 1) for part in by_quality),
        )
    whole = math.fsum(part.weight for part in sections)
    table.add_row("all", "", output.number(100.0 * whole, 2), output.number(1e-3 * whole * length, 2))
    return table
