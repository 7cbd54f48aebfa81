"""Figures of contact geometry show what they are given, in millimetres."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from hh_exudyn.contact.functions import wheelset_functions
from hh_exudyn.contact.geometry.merit import conicity_report
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.figures.conicity import (
    draw_conicity,
    draw_contact_positions,
    draw_radius_difference,
    draw_rail_profiles,
)


def test_lines_join_the_points_that_touch() -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)
    lateral = np.arange(-6, 7) * 1e-3
    functions = wheelset_functions(
        wheel, rail, wheel, rail, lateral=lateral, radius_left=0.46, radius_right=0.46
    )
    figure, axes = plt.subplots()
    draw_contact_positions(axes, wheel, rail, functions.right, np.array([-3e-3, 4e-3]))
    joined = axes.lines[2:]
    assert len(joined) == 2
    # 4 mm outwards on the right is the displacement -4 mm
    k = int(np.argmin(np.abs(lateral + 4e-3)))
    assert joined[1].get_xdata()[1] == pytest.approx(1e3 * functions.right.y_rail[k])
    assert joined[1].get_ydata()[0] > joined[1].get_ydata()[1]
    plt.close(figure)


def test_curves_are_in_millimetres() -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)
    report = conicity_report(wheel, rail, radius=0.46)
    figure, (above, middle, below) = plt.subplots(3)
    draw_conicity(above, {"pair": report})
    assert above.lines[0].get_xdata() == pytest.approx(np.arange(1, 9))
    assert above.lines[0].get_ydata()[2] == pytest.approx(report.reference_conicity)
    draw_radius_difference(middle, {"pair": report.functions})
    assert middle.lines[0].get_ydata() == pytest.approx(1e3 * report.functions.radius_difference, nan_ok=True)
    draw_rail_profiles(below, {"60E1": rail, "MB1": rail_profile("MB1_like", 1 / 40)})
    assert len(below.lines) == 2
    plt.close(figure)
