"""`hh-exudyn modes` and `hh-exudyn critical-speed`."""

import re

import pytest
from typer.testing import CliRunner

from hh_exudyn.cli.app import app
from vehicles.models.suspended_wheelset import critical_speed_closed_form

CASE = """
name = "hunting"
vehicle = "{vehicle}"
speed_km_h = 100.0
friction = 0.3
[contact]
theory = "{theory}"
[track]
flexibility = "rigid"
[[track.sections]]
kind = "straight"
length_m = 60.0
gauge_mm = 1435.0
"""


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "hunting.toml"
    path.write_text(CASE.format(vehicle="suspended_wheelset", theory="given"))
    return path


def code_and_output(*arguments):
    result = CliRunner().invoke(app, [str(argument) for argument in arguments])
    return result.exit_code, result.output


def test_modes_are_listed(case):
    """One line a mode: the wheelset on its lateral and on its yaw spring, 5.3 and 7.1 Hz without creep."""
    code, output = code_and_output("modes", case, "--undamped", "--speed-km-h", "72")
    assert code == 0
    assert "Modes of suspended_wheelset at 72 km/h, dampers and creep off" in output
    frequencies = [float(line.split()[1]) for line in output.splitlines() if "wheelset_1" in line]
    assert frequencies == pytest.approx([5.3052, 7.1176, 16.7764], abs=2e-3)


def test_a_mode_is_recorded(case, tmp_path):
    target = tmp_path / "mode.rrd"
    code, output = code_and_output("modes", case, "--undamped", "--playback", target, "--mode", "2")
    assert code == 0 and f"recording: {target}" in output
    assert target.stat().st_size > 10_000
    code, output = code_and_output("modes", case, "--undamped", "--playback", target)
    assert code == 2 and "exists already" in output
    code, output = code_and_output(
        "modes", case, "--undamped", "--playback", tmp_path / "b.rrd", "--mode", "9"
    )
    assert code == 2 and "--mode 9: allowed 1 to 3" in output
    assert not (tmp_path / "b.rrd").exists()


def test_critical_speed_is_said_and_drawn(case, tmp_path):
    figure = tmp_path / "locus.png"
    code, output = code_and_output(
        "critical-speed", case, "--from-km-h", "150", "--step-km-h", "75", "--out", figure
    )
    assert code == 0
    speed = float(re.search(r"critical speed ([\d.]+) km/h", output)[1])
    wanted, _ = critical_speed_closed_form(1800.0, 1000.0, 2e6, 2e6, 1e7, 1e7, 0.75, 0.1, 0.46)
    assert speed == pytest.approx(3.6 * wanted, rel=1e-3)
    assert figure.stat().st_size > 10_000


def test_a_range_without_hunting_is_stable(case):
    code, output = code_and_output(
        "critical-speed", case, "--from-km-h", "60", "--to-km-h", "120", "--step-km-h", "60"
    )
    assert code == 0
    assert "suspended_wheelset: stable from 60 to 120 km/h" in output


def test_the_linear_figure_of_a_wagon_says_that_friction_sticks(tmp_path, case):
    path = tmp_path / "wagon.toml"
    path.write_text(CASE.format(vehicle="iore_wagon_loaded", theory="fastrip"))
    code, output = code_and_output("critical-speed", path, "--from-km-h", "60", "--to-km-h", "80")
    assert code == 0
    assert "friction elements stick everywhere here" in output and "--nonlinear" in output
    code, output = code_and_output("critical-speed", case, "--from-km-h", "60", "--to-km-h", "80")
    assert code == 0 and "friction" not in output  # it has none


def test_nonlinear_critical_speed_is_said_and_drawn(case, tmp_path):
    """From 288 km/h down; closed form 264.2 km/h. Run by run, what is left and how long it takes."""
    figure = tmp_path / "hunting.png"
    code, output = code_and_output(
        "critical-speed", case, "--nonlinear", "--from-km-h", "216", "--to-km-h", "288",
        "--step-km-h", "36", "--resolution-km-h", "20", "--out", figure,
    )  # fmt: skip
    assert code == 0
    assert "slows down from 288 km/h, at first with all wheelsets 5 mm to the left" in output
    assert "moves by 0.5 mm or more" in output and "friction elements slide" in output
    lines = re.findall(r"([\d.]+) km/h .*(hunts|dies out) +\(at most (\d+) s more\)", output)
    assert [line[1] for line in lines][:2] == ["hunts", "dies out"]
    found = re.search(r"nonlinear critical speed ([\d.]+) km/h .* at ([\d.]+) km/h it dies out", output)
    assert float(found[2]) < 264.2 < float(found[1])
    assert figure.stat().st_size > 10_000


def test_a_nonlinear_search_that_finds_no_hunting_says_so(case):
    code, output = code_and_output(
        "critical-speed", case, "--nonlinear", "--from-km-h", "100", "--to-km-h", "120"
    )
    assert code == 0 and "suspended_wheelset: no hunting from 100 to 120 km/h" in output


def test_bad_input_is_one_line(case):
    assert code_and_output("critical-speed", case, "--from-km-h", "200", "--to-km-h", "100")[0] == 2
    assert code_and_output("modes", case, "--speed-km-h", "0")[0] == 2
    assert code_and_output("critical-speed", case, "--nonlinear", "--resolution-km-h", "0")[0] == 2
    case.write_text(CASE.format(vehicle="manchester_vehicle_1", theory="given"))
    code, output = code_and_output("modes", case)
    assert code == 2
    assert "vehicle manchester_vehicle_1 states no contact" in output
