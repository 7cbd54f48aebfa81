"""Figures of the locomotive show what they are given, in the units of their axes."""

import numpy as np
import pytest

from hh_exudyn.figures.traction import bogie_curving_figure, control_figure, effort_figure
from hh_exudyn.log.channels import CONTROL


def control_log(samples=5, axles=6):
    rows = samples * axles
    log = {column.name: np.linspace(1.0, 2.0, rows) for column in CONTROL}
    log["time"] = np.repeat(0.01 * np.arange(samples), axles)
    log["wheelset"] = np.tile(np.arange(1, axles + 1), samples)
    log["vehicle"] = np.ones(rows)
    log["speed"] = np.full(rows, 10.0)
    log["wheel_speed"] = np.full(rows, 10.2)
    log["coupler_force"] = np.full(rows, -3e5)
    return log


def test_control_figure_has_a_line_for_each_wheelset():
    figure = control_figure("uphill", control_log())
    speed, force, torque, slip, use = figure.axes
    assert speed.lines[0].get_ydata() == pytest.approx(36.0)
    assert force.lines[1].get_ydata() == pytest.approx(300.0)  # pulling
    assert [len(axes.lines) for axes in (torque, slip, use)] == [6, 6, 6]
    assert slip.lines[3].get_ydata() == pytest.approx(2.0)
    assert use.lines[0].get_xdata() == pytest.approx(0.01 * np.arange(5))


def test_both_units_are_drawn():
    log = control_log(axles=12)
    log["vehicle"] = np.tile(np.repeat([1, 2], 6), 5)
    log["wheelset"] = np.tile(np.arange(1, 7), 10)
    assert [len(axes.lines) for axes in control_figure("pair", log).axes[2:]] == [12, 12, 12]


def test_a_torn_control_log_is_refused():
    log = control_log()
    with pytest.raises(ValueError, match="29 rows of 6 wheelsets"):
        control_figure("torn", {name: values[:-1] for name, values in log.items()})


def test_effort_figure_shows_limits_and_demands():
    figure = effort_figure(
        "train",
        lambda v: 6e5,
        lambda v: 5e5,
        lambda v, gradient: 1e5 + 8e7 * gradient,
        (-0.01, 0.0, 0.01),
        20.0,
    )
    (axes,) = figure.axes
    ends = [line.get_ydata()[-1] for line in axes.lines[:5]]
    assert ends == pytest.approx([600.0, -500.0, -700.0, 100.0, 900.0])
    assert axes.lines[0].get_xdata()[-1] == pytest.approx(72.0)


def test_bogie_curving_figure_sorts_radii():
    values = np.array([[3.0, 30.0], [1.0, 10.0], [2.0, 20.0]])
    figure = bogie_curving_figure("curves", np.array([900.0, 300.0, 600.0]), {"y [mm]": {"soft": values}})
    line = figure.axes[0].lines[1]
    assert line.get_xdata() == pytest.approx([300.0, 600.0, 900.0])
    assert line.get_ydata() == pytest.approx([10.0, 20.0, 30.0])
    with pytest.raises(ValueError, match="radii are 2"):
        bogie_curving_figure("curves", np.array([900.0, 300.0]), {"y [mm]": {"soft": values}})
