"""One sheet of a wheel on a rail: conicity, rolling radius difference and contact positions."""

from collections.abc import Mapping

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.merit import ConicityReport
from hh_exudyn.contact.profile import Profile
from hh_exudyn.figures.conicity import draw_conicity, draw_contact_positions, draw_radius_difference
from hh_exudyn.figures.style import SMALL

_STEP = 1e-3  # m, at least, between the displacements whose contact positions are joined
_SHOWN = 12e-3  # m, of displacements


def conicity_sheet(wheel: Profile, rail: Profile, reports: Mapping[str, ConicityReport]) -> Figure:
    """Conicity and rolling radius difference of all reports, and the contact positions of each.

    Parameters
    ----------
    wheel, rail : Profile
        The profiles of both sides.
    reports : mapping
        By the name that the legends show, for example a gauge.

    Raises
    ------
    ValueError
        Without a report.
    """
    if not reports:
        raise ValueError("reports: none given, at least one is needed")
    with rc_context(SMALL):
        below = max(2, len(reports))
        figure = Figure(figsize=(3.9 * below, 5.6), layout="constrained")
        figure.suptitle(f"{wheel.name} on {rail.name}")
        grid = figure.add_gridspec(2, 2 * below)
        draw_conicity(figure.add_subplot(grid[0, :below]), reports)
        difference = figure.add_subplot(grid[0, below:])
        draw_radius_difference(difference, {name: report.functions for name, report in reports.items()})
        difference.set_ylabel("radius difference, left - right [mm]")
        difference.set_xlim(-1e3 * _SHOWN, 1e3 * _SHOWN)
        difference.set_ylim(*_range_of_differences(reports))
        width = 2 * below // len(reports)
        for k, (name, report) in enumerate(reports.items()):
            axes = figure.add_subplot(grid[1, k * width : (k + 1) * width])
            draw_contact_positions(axes, wheel, rail, report.functions.left, _displacements(report))
            axes.set_title(f"{name}, numbers: displacement outwards [mm]")
    return figure


def _range_of_differences(reports: Mapping[str, ConicityReport]) -> tuple[float, float]:
    """Limits of the differences that are shown [mm]."""
    largest = 0.0
    for report in reports.values():
        functions = report.functions
        shown = functions.radius_difference[np.abs(functions.lateral) <= _SHOWN]
        largest = max(largest, 1.1e3 * float(np.nanmax(np.abs(shown))))
    return -largest, largest


def _displacements(report: ConicityReport) -> FloatArray:
    """From a little inwards to just beyond the flange clearance, every millimetre or every second [m]."""
    last = min(report.clearance_left, _SHOWN)
    step = _STEP if last < 8.0 * _STEP else 2.0 * _STEP
    return np.asarray(np.arange(-2.0 * step, last + step, step))
