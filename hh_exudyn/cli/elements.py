"""Tables of a run by element of its track: a line for every wheel on every curve, transition and straight.

Large packages are imported inside the functions, so that ``--help`` is fast.
"""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from rich.table import Table

from hh_exudyn.cli import inputs, output

if TYPE_CHECKING:
    import pyarrow

    from damage.summary import WheelsetSummary
    from hh_exudyn.assessment.sections import AssessedSection
    from hh_exudyn.log.store import Run

MOST_ELEMENTS = 6  # whose wheels are listed; of more, the largest of all wheels of each
_LEFT_OUT = ("q_mean_N", "y_over_q_mean")  # of the shorter table


class OfElement(NamedTuple):
    """An element of the track, and its wheelsets there; Q0 is the static load of a wheel [N]."""

    element: "AssessedSection"
    wheelsets: "list[WheelsetSummary]"
    static_load: float


class _Shown(NamedTuple):
    """A column: heading, name in SI tables, factor to the shown unit, digits, values of both wheels."""

    heading: str
    name: str
    factor: float
    digits: int
    of: "Callable[[WheelsetSummary, float], tuple[float, float]]"
    of_wheelset: bool = False  # the larger amount of either sign stands for an element


_FORCES = (
    _Shown("Q mean [kN]", "q_mean_N", 1e-3, 1, lambda row, q0: row.Q),
    _Shown("Q peak [kN]", "q_peak_N", 1e-3, 1, lambda row, q0: row.Q_peak),
    _Shown("Y mean [kN]", "y_mean_N", 1e-3, 1, lambda row, q0: row.Y),
    _Shown("Y peak [kN]", "y_peak_N", 1e-3, 1, lambda row, q0: row.Y_peak),
    _Shown("Y/Q mean [-]", "y_over_q_mean", 1.0, 3, lambda row, q0: row.y_over_q),
    _Shown("Y/Q peak [-]", "y_over_q_peak", 1.0, 3, lambda row, q0: row.y_over_q_peak),
    _Shown(
        "dQ/Q0 peak [-]", "unloading_peak", 1.0, 2,
        lambda row, q0: (1.0 - row.Q_least[0] / q0, 1.0 - row.Q_least[1] / q0),
    ),
)  # fmt: skip
_CONTACT = (
    _Shown(
        "angle\u00a0of attack [mrad]", "angle_of_attack_rad", 1e3, 2,
        lambda row, q0: (row.angle_of_attack, row.angle_of_attack), True,
    ),
    _Shown(
        "lateral position [mm]", "lateral_position_m", 1e3, 2,
        lambda row, q0: (row.lateral, row.lateral), True,
    ),
    _Shown("p_max [MPa]", "p_max_Pa", 1e-6, 0, lambda row, q0: row.p_max),
    _Shown("wear number [N]", "wear_number_N", 1.0, 0, lambda row, q0: row.wear_number),
    _Shown("FI>0 [%]", "fatigue_share", 100.0, 0, lambda row, q0: row.fatigue_share),
)  # fmt: skip


def element_summaries(run: "Run") -> list[OfElement]:
    """The elements that the wheelsets of a run were on, from the start of the track.

    Parameters
    ----------
    run
        With its case and contact log.
    """
    from damage.summary import stretch_summaries
    from hh_exudyn.assessment.limits import static_wheel_load
    from hh_exudyn.assessment.sections import track_elements
    from vehicles.stored import from_json

    case, text = inputs.case_of(run), run.vehicle_text
    load = static_wheel_load(case.described_vehicle() if text is None else from_json(text))
    elements = track_elements(case.alignment())
    summaries = stretch_summaries(run, [(element.start, element.end) for element in elements])
    return [OfElement(*pair, load) for pair in zip(elements, summaries, strict=True) if pair[1]]


def print_elements(found: Sequence[OfElement]) -> None:
    """Two tables, forces and contact; of many elements a line each with the largest of all wheels.

    Parameters
    ----------
    found
        By `element_summaries`.
    """
    many = len(found) > MOST_ELEMENTS
    note = ", the largest of all wheels and which" if many else ""
    for title, columns in (
        (f"Forces by element of the track{note}; peaks below 20 Hz", _FORCES),
        (f"Contact by element of the track, means{note}", _CONTACT),
    ):
        output.print_table((_largest_table if many else _wheel_table)(title, columns, found))


def to_table(found: Sequence[OfElement]) -> "pyarrow.Table":
    """All elements and wheels, a row each, SI.

    Parameters
    ----------
    found
        By `element_summaries`.
    """
    import pyarrow

    rows: list[dict[str, Any]] = []
    for element, wheelsets, load in found:
        for row in wheelsets:
            for i, side in enumerate("LR"):
                values = {one.name: one.of(row, load)[i] for one in (*_FORCES, *_CONTACT)}
                rows.append(
                    {
                        "element": element.title, "start_m": element.start, "end_m": element.end,
                        "vehicle": row.vehicle, "wheelset": row.wheelset, "side": side, **values,
                    }
                )  # fmt: skip
    return pyarrow.Table.from_pylist(rows)


def _wheel_table(title: str, columns: tuple[_Shown, ...], found: Sequence[OfElement]) -> Table:
    """A line for every wheel; numbers of the wheelset are in the line of its left wheel."""
    table = output.new_table(title, ("element", "wheel", *(one.heading for one in columns)))
    table.columns[0].justify = "left"
    for element, wheelsets, load in found:
        table.add_section()
        heading = iter(_lines(element))
        for row in wheelsets:
            for i, side in enumerate("LR"):
                cells = [
                    ""
                    if one.of_wheelset and i
                    else output.number(one.factor * one.of(row, load)[i], one.digits)
                    for one in columns
                ]
                table.add_row(next(heading, ""), f"{_number(row, wheelsets)}{side}", *cells)
    return table


def _largest_table(title: str, columns: tuple[_Shown, ...], found: Sequence[OfElement]) -> Table:
    """A line for every element, each number with its wheel."""
    columns = tuple(one for one in columns if one.name not in _LEFT_OUT)
    table = output.new_table(title, ("element", "from [m]", *(one.heading for one in columns)))
    table.columns[0].justify = "left"
    for element, wheelsets, load in found:
        cells: list[str] = []
        for one in columns:
            values = {
                f"{_number(row, wheelsets)}{'' if one.of_wheelset else side}": one.of(row, load)[i]
                for row in wheelsets
                for i, side in enumerate("LR")
            }
            finite = {name: value for name, value in values.items() if value == value}
            if not finite:
                cells.append(output.NOTHING)
                continue
            name = max(finite, key=lambda key: abs(finite[key]) if one.of_wheelset else finite[key])
            cells.append(f"{output.number(one.factor * finite[name], one.digits)} {name}")
        table.add_row(element.title, f"{element.start:.0f}", *cells)
    return table


def _lines(element: "AssessedSection") -> list[str]:
    """An element as short lines beside those of its wheels."""
    first = [f"curve R {element.radius:.0f} m", f"{element.hand}-hand"] if element.curved else [element.kind]
    return [*first, f"{element.start:.0f} to {element.end:.0f} m"]


def _number(row: "WheelsetSummary", wheelsets: "list[WheelsetSummary]") -> str:
    """Number of a wheelset, with the unit before it where there are several."""
    several = len({one.vehicle for one in wheelsets}) > 1
    return f"{row.vehicle}.{row.wheelset}" if several else f"{row.wheelset}"
