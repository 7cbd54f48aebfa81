"""The sheet of a wheel on a rail shows the reports that it was given."""

from io import BytesIO

import numpy as np
import pytest

from hh_exudyn.contact.geometry.merit import conicity_report
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.figures.conicity_sheet import conicity_sheet

WHEEL, RAIL = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)


def test_sheet_shows_conicity_and_differences_of_every_gauge() -> None:
    reports = {
        f"gauge {gauge} mm": conicity_report(WHEEL, RAIL, radius=0.46, gauge=gauge * 1e-3)
        for gauge in (1432, 1445)
    }
    figure = conicity_sheet(WHEEL, RAIL, reports)
    figure.savefig(BytesIO(), dpi=50)  # warnings are errors: the layout holds
    conicity, difference, *positions = figure.axes
    assert len(positions) == 2
    for k, (name, report) in enumerate(reports.items()):
        curve = conicity.lines[k]
        assert curve.get_label() == name
        np.testing.assert_allclose(curve.get_xdata(), 1e3 * report.amplitudes)
        np.testing.assert_allclose(curve.get_ydata(), report.conicity)
        np.testing.assert_allclose(difference.lines[k].get_ydata(), 1e3 * report.functions.radius_difference)
        assert positions[k].get_title().startswith(name)
        numbers = [float(text.get_text()) for text in positions[k].texts]
        assert numbers[0] < 0.0
        # the last line is the first beyond the flange clearance
        assert numbers[-2] <= 1e3 * report.clearance_left <= numbers[-1] + 1e-9


def test_without_reports_there_is_no_sheet() -> None:
    with pytest.raises(ValueError, match="at least one"):
        conicity_sheet(WHEEL, RAIL, {})
