"""The rails of a run for the command ``damage``: stretches, table and figure. It computes nothing itself.

Large packages are imported inside the functions, so that ``--help`` is fast.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from hh_exudyn.cli import inputs, output
from hh_exudyn.cli.reports import vehicle_of

if TYPE_CHECKING:
    import pyarrow
    from matplotlib.figure import Figure

    from damage.rails.model import RailModel
    from damage.rails.report import RailPlace, RailReport
    from damage.report import DamageReport
    from hh_exudyn.log.store import Run

MOST_ELEMENTS = 12  # of the table; of more, those that wear most
_COLUMNS = {  # column of the file: heading, factor
    "p_max_MPa": ("p_max [MPa]", 1.0),
    "wear_number_N": ("wear number [N]", 1.0),
    "wear_mm_per_MGT": ("wear [mm]", 100.0),
    "wear_y_mm": ("at\u00a0y [mm]", 1.0),
    "worn_area_mm2_per_MGT": ("area [mm²]", 100.0),
    "beyond_shakedown_share": ("RCF passings [%]", 100.0),
    "miner_per_MGT": ("Miner\u00a0[-]", 100.0),
    "rcf_per_MGT": ("RCF\u00a0[-]", 100.0),
}
SEIZED = "*"


def rail_places(run: "Run") -> "list[RailPlace]":
    """The elements of a run's track with their rails, each of the profile in its middle.

    Parameters
    ----------
    run
        With its case.
    """
    from damage.rails.report import RailPlace
    from hh_exudyn.assessment.sections import track_elements

    case = inputs.case_of(run)
    along, places = case.track.rails_along(), []
    for one in track_elements(case.alignment()):
        rails = along.at(0.5 * (one.start + one.end)).rails
        sides = (rails.left_profile(), rails.right_profile())
        places.append(RailPlace(one.title, one.start, one.end, one.hand, *sides))
    return places


def rail_model(places: "Sequence[RailPlace]", steel: str) -> "RailModel":
    """The rails of places; an unknown steel is bad input.

    Parameters
    ----------
    places
        In the order of the track.
    steel
        Name of the rail steel.
    """
    from damage.rails.model import RailModel
    from damage.rails.steel import rail_material

    with inputs.refused_as_bad_input():
        return RailModel(tuple(place.stretch for place in places), rail_material(steel))


def rails_of(run: "Run", reports: "Sequence[DamageReport]", places: "Sequence[RailPlace]") -> "RailReport":
    """The damage of the rails of a run; where no element was passed by the whole vehicle it is bad input."""
    from damage.rails.report import rail_report

    with inputs.refused_as_bad_input():
        return rail_report(reports, places, vehicle_of(run).mass)


def rail_tables(report: "RailReport | None") -> "dict[str, pyarrow.Table]":
    """The tables by file name; none without rails."""
    if report is None:
        return {}
    return {"rails.csv": report.to_table(), "rails_profile.csv": report.profile_table()}


def rail_figures(report: "RailReport | None") -> "dict[str, Figure]":
    """The figures by file name; none without rails."""
    from damage.figures.rail_wear import rail_wear_figure

    return {} if report is None else {"rail_wear.png": rail_wear_figure(report)}


def print_rails(report: "RailReport") -> None:
    """Two lines for every element, and what their numbers mean."""
    rows = report.to_table().to_pylist()
    pairs = [rows[k : k + 2] for k in range(0, len(rows), 2)]
    shown = sorted(range(len(pairs)), key=lambda k: -sum(row["worn_area_mm2_per_MGT"] for row in pairs[k]))
    many = len(pairs) > MOST_ELEMENTS
    chosen = [pairs[k] for k in sorted(shown[:MOST_ELEMENTS])]
    note = f", the {MOST_ELEMENTS} of {len(pairs)} that wear most" if many else ""
    headings = ("element", "rail", *(heading for heading, _ in _COLUMNS.values()), "most by wheelset")
    title = f"Damage of the rails in 100 MGT by element of the track{note}"
    table = output.new_table(title, headings)
    table.columns[0].justify = table.columns[1].justify = "left"
    for pair in chosen:
        table.add_section()
        for row, first in zip(pair, _lines(pair[0]), strict=True):
            table.add_row(first, row["rail"], *_cells(row))
    rails, mass = report.rails, report.mass * 1e-3
    output.print_line(
        f"rails: {rails.material.name}; a million gross tonnes (MGT) are {1e6 / mass:,.0f} passings of this "
        f"vehicle of {mass:.0f} t"
    )
    output.print_table(table)
    output.print_line(
        "RCF passings: share of the wheel passings beyond shakedown at the worst place; Miner: after Kabo, "
        "failure at 1; RCF: whole-life rail model of R220, a visible crack at 1, below 0 wear prevails"
    )
    if any(row["wear_note"] for row in rows):
        output.print_line(
            f"{SEIZED} rail wear under seizure (above {report.model.rail_seizure_pressure * 1e-6:.0f} MPa): "
            "the unworn profiles wear in first; not to be extrapolated"
        )
    for place in report.left_out:
        output.print_line(f"left out: {place.title} from {place.start:.0f} m, less than half run by a wheel")


def _lines(row: dict[str, Any]) -> tuple[str, str]:
    """The element beside the lines of its rails."""
    return row["element"], f"{row['start_m']:.0f} to {row['end_m']:.0f} m"


def _cells(row: dict[str, Any]) -> list[str]:
    cells = []
    for name, (_, factor) in _COLUMNS.items():
        mark = SEIZED if row["wear_note"] and name == "wear_mm_per_MGT" else ""
        value = row[name] * factor
        digits = 0 if abs(value) >= 99.5 or name.endswith("share") else 1 if abs(value) >= 9.95 else 2
        cells.append(f"{value:,.{digits}f}{mark}")
    unit = f"{row['worst_vehicle']}." if row["worst_vehicle"] > 1 else ""
    share = f"{unit}{row['worst_wheelset']}: {100.0 * row['worst_share']:.0f} %" if row["worst_share"] else ""
    return [*cells, share or output.NOTHING]
