"""What ``assess`` prints and writes. Conversion to kilonewtons and millimetres is here; below it is SI.

Large packages are imported inside the functions, so that ``--help`` is fast.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, TypeVar

from rich.table import Table

from hh_exudyn.cli import output

if TYPE_CHECKING:
    import pyarrow

    from hh_exudyn.assessment.coupling_forces import CouplingRange
    from hh_exudyn.assessment.findings import Finding
    from hh_exudyn.assessment.report import Assessment
    from hh_exudyn.assessment.statistics import Estimate

_Row = TypeVar("_Row", "Finding", "Estimate")

_SHOWN = {  # quantity: heading, factor, digits
    "sum_y": ("sum Y, 2 m [kN]", 1e-3, 1),
    "q": ("Q [kN]", 1e-3, 1),
    "y_quasi_static": ("Y quasi-static [kN]", 1e-3, 1),
    "y_quasi_static_reduced": ("Y quasi-static, reduced [kN]", 1e-3, 1),
    "q_quasi_static": ("Q quasi-static [kN]", 1e-3, 1),
    "y_over_q": ("Y/Q, 2 m [-]", 1.0, 3),
    "y_over_q_nadal": ("Y/Q, 2 m, Nadal [-]", 1.0, 3),
    "axle_sum": ("|Y/Q| of wheelset, Weinstock [-]", 1.0, 3),
    "unloading": ("dQ/Q0 [-]", 1.0, 3),
    "unloading_quasi_static": ("dQ/Q0 quasi-static [-]", 1.0, 3),
    "body_lateral": ("body lateral [m/s2]", 1.0, 2),
    "body_vertical": ("body vertical [m/s2]", 1.0, 2),
    "body_lateral_rms": ("body lateral, rms [m/s2]", 1.0, 2),
    "body_vertical_rms": ("body vertical, rms [m/s2]", 1.0, 2),
    "body_lateral_quasi_static": ("body lateral, quasi-static [m/s2]", 1.0, 2),
    "sum_y_rms": ("sum Y about f0, rms [kN]", 1e-3, 1),
    "bogie_lateral_rms": ("bogie lateral about f0, rms [m/s2]", 1.0, 2),
}
_MOST_ROWS = 48  # of couplings that are printed


def print_run(name: str, found: "Assessment") -> None:
    """Test sections and the largest values by kind of section of a run.

    Parameters
    ----------
    name
        Of the run.
    found
        Its assessment.
    """
    from hh_exudyn.log.ending import FINISHED

    early = "" if found.ending == FINISHED else f" (unfinished run: {found.ending})"
    output.print_table(_section_table(found, name + early))
    for stretch in found.left_out:
        output.print_line(f"not assessed: {stretch}")
    output.print_table(_value_table(found, early))
    output.print_line(f"f0, the peak of the spectrum of sum Y: {found.instability_frequency:.2f} Hz")


def print_sources(found: "Assessment") -> None:
    """Where the limits are from."""
    output.print_line(
        "? limit unconfirmed: read neither in the standard nor where it is cited. Limits are from:"
    )
    for quantity, limit in found.limits.items():
        output.print_line(f"  {_SHOWN[quantity][0]}: {limit.source}")
    if found.beyond:
        output.print_line(
            "the axle load is above the 25 t that EN 14363 with EN 15687 goes to: limits are a comparison"
        )
    output.print_line("quality of the track of the run: hh-exudyn track plot DIR/case.toml")


def _section_table(found: "Assessment", name: str) -> Table:
    """A line per test section."""
    result = output.new_table(
        f"Test sections of {name}",
        ("from [m]", "to [m]", "kind", "radius [m]", "hand", "cant deficiency [mm]"),
    )
    for section in found.sections:
        curved = section.curved
        result.add_row(
            f"{section.start:.1f}",
            f"{section.end:.1f}",
            section.kind,
            f"{section.radius:.0f}" if curved else output.NOTHING,
            section.hand or output.NOTHING,
            output.number(1e3 * found.deficiency(section), 0) if curved else output.NOTHING,
        )
    return result


def _value_table(found: "Assessment", early: str) -> Table:
    """A line per kind of section and quantity: its largest value, where, and the limit."""
    result = output.new_table(
        f"Largest values by kind of section{early}",
        ("quantity", "value", "limit", "used\u00a0[%]", "from [m]", "place"),
    )
    kind = ""
    for finding in _in_order(found.worst(), lambda one: one.section.kind):
        if finding.section.kind != kind:
            kind = finding.section.kind
            result.add_row(kind, *[""] * 5)
        heading, factor, digits = _SHOWN[finding.quantity]
        limit = finding.limit
        result.add_row(
            heading,
            output.number(factor * finding.value, digits),
            output.NOTHING
            if limit is None
            else output.number(factor * limit.value, digits) + ("" if limit.confirmed else " ?"),
            output.number(100.0 * finding.share, 0),
            f"{finding.section.start:.0f}",
            finding.place,
        )
    return result


def print_estimates(estimates: "Sequence[Estimate]") -> None:
    """Estimated maxima of kinds of section with two sections or more; nothing without one.

    Parameters
    ----------
    estimates
        The largest of every quantity and kind.
    """
    if not estimates:
        output.print_line("no statistics: no kind of section has two sections")
        return
    result = output.new_table(
        "Estimated maxima from all sections of a kind",
        ("quantity", "N", "mean", "s", "k", "estimate", "used\u00a0[%]", "place"),
    )
    kind = ""
    for one in _in_order(estimates, lambda one: one.kind):
        if one.kind != kind:
            kind = one.kind
            result.add_row(kind, *[""] * 7)
        heading, factor, digits = _SHOWN[one.quantity]
        result.add_row(
            heading,
            f"{one.sections}" + ("" if one.enough else "*"),
            output.number(factor * one.mean, digits),
            output.number(factor * one.deviation, digits),
            "regr." if math.isnan(one.factor) else f"{one.factor:g}",
            output.number(factor * one.value, digits),
            output.number(100.0 * one.share, 0),
            one.place,
        )
    output.print_table(result)
    output.print_line(
        "estimate: mean + k s, or (regr.) the bound of a regression over cant deficiency at its largest; "
        "* fewer sections than the 25 of UIC 518, from memory: no acceptance"
    )


def _in_order(found: "Iterable[_Row]", kind_of: "Callable[[_Row], str]") -> "list[_Row]":
    """Rows by kind of section as they came, and within a kind in the order of the quantities."""
    rows = list(found)
    kinds, quantities = list(dict.fromkeys(map(kind_of, rows))), list(_SHOWN)
    return sorted(rows, key=lambda one: (kinds.index(kind_of(one)), quantities.index(one.quantity)))


def print_ride(name: str, found: "Assessment") -> None:
    """Ride index and comfort of the body over its bogies; nothing for a vehicle without.

    Parameters
    ----------
    name
        Of the run.
    found
        Its assessment.
    """
    from hh_exudyn.assessment.ride import COMFORT_SCALE, RIDE_SCALE, word_of

    if not found.ride:
        return
    result = output.new_table(
        f"Ride index (Sperling) and comfort (EN 12299) of {name}, whole run",
        ("place", "Wz lateral [-]", "Wz vertical [-]", "N_MV [-]", "windows of\u00a05\u00a0s"),
    )
    for one in found.ride:
        result.add_row(
            one.place,
            output.number(one.sperling_lateral, 2),
            output.number(one.sperling_vertical, 2),
            output.number(one.comfort, 2),
            f"{one.windows}",
        )
    output.print_table(result)
    worst = max(max(one.sperling_lateral, one.sperling_vertical) for one in found.ride)
    words = f"Wz {worst:.2f}: {word_of(RIDE_SCALE, worst)}"
    comfort = max(one.comfort for one in found.ride)
    if not math.isnan(comfort):
        words += f"; N_MV {comfort:.2f}: {word_of(COMFORT_SCALE, comfort)} (scale from memory)"
    output.print_line(words)


def print_couplings(name: str, ranges: "Sequence[CouplingRange]") -> None:
    """Forces and displacements of logged couplings over a run; nothing without their log.

    Parameters
    ----------
    name
        Of the run.
    ranges
        Over the whole run.
    """
    if not ranges:
        return
    found = {(one.coupling, one.component): one for one in ranges}
    rows = []
    for coupling in dict.fromkeys(one.coupling for one in ranges):
        for axis in "xyz":
            force, stretch = found[coupling, f"force_{axis}"], found[coupling, f"displacement_{axis}"]
            if any((force.least, force.largest, stretch.least, stretch.largest)):
                cells = [
                    output.number(factor * value, 2)
                    for one, factor in ((force, 1e-3), (stretch, 1e3))
                    for value in (one.mean, one.least, one.largest)
                ]
                rows.append((coupling, axis, *cells))
    result = output.new_table(
        f"Couplings of {name}, whole run: force on body B, and displacement, in the axes of body A",
        ("coupling", "axis", "force mean [kN]", "force min [kN]", "force max [kN]", "displacement mean [mm]",
         "displacement min [mm]", "displacement max [mm]"),
    )  # fmt: skip
    result.columns[0].justify = "left"
    for row in rows[:_MOST_ROWS]:
        result.add_row(*row)
    output.print_table(result)
    if len(rows) > _MOST_ROWS:
        output.print_line(f"and {len(rows) - _MOST_ROWS} more rows: --tables FOLDER writes all, by element")


def whole_table(found: "Mapping[str, Assessment]") -> "pyarrow.Table":
    """All findings of all runs."""
    return stacked({name: one.to_table() for name, one in found.items()})


def ride_table(found: "Mapping[str, Assessment]") -> "pyarrow.Table":
    """Ride index and comfort of all runs, SI."""
    import pyarrow

    names = ("place", "wz_lateral", "wz_vertical", "n_mv", "weighted_x_m_s2", "weighted_y_m_s2",
             "weighted_z_m_s2", "windows")  # fmt: skip
    kinds = {"place": "string", "windows": "int32"}
    schema = pyarrow.schema((name, kinds.get(name, "float64")) for name in names)
    return stacked(
        {
            run: pyarrow.Table.from_pylist(
                [
                    dict(
                        zip(
                            names,
                            (ride.place, ride.sperling_lateral, ride.sperling_vertical, ride.comfort,
                             *ride.weighted, ride.windows),
                            strict=True,
                        )
                    )
                    for ride in one.ride
                ],
                schema=schema,
            )
            for run, one in found.items()
        }
    )  # fmt: skip


def stacked(tables: "Mapping[str, pyarrow.Table]") -> "pyarrow.Table":
    """Tables of several runs below each other, the name of the run as first column."""
    import pyarrow

    return pyarrow.concat_tables(
        table.add_column(0, "folder", pyarrow.array([name] * table.num_rows, pyarrow.string()))
        for name, table in tables.items()
    )
