"""The locomotive on the track: balance with its train, energy, speed, adhesion and steering."""

import numpy as np
import pytest
from run_tables import table

from hh_exudyn.case import Case, CaseError
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.control import vehicle_control
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import Ledger, workspace
from hh_exudyn.multibody.simulate import simulate
from hh_exudyn.sourced import load_parameters
from track.course.alignment import inclined_frame
from vehicles.catalogue import vehicle
from vehicles.start import start_middle
from vehicles.traction.train import locomotive_resistance
from vehicles.variants import find_variant

LOCOMOTIVE = vehicle("iore_locomotive")
GAUGE = {"gauge_mm": 1440.0}
SPEED = 60 / 3.6


def on_slope(demo: Case, length: float, per_mille: float, friction: object = 0.4, **changes: object) -> Case:
    """Rigid straight track of one gradient; a coarse grid, for forces on bodies do not ask for a fine one."""
    track = {
        "flexibility": "rigid",
        "sections": [{"kind": "straight", "length_m": length, **GAUGE}],
        "grades": [{"length_m": length, "gradient_per_mille": per_mille}],
    }
    return demo.with_changes(
        vehicle="iore_locomotive", friction=friction, track=track, contact={"cells": [16, 8]}, **changes
    )


def slipping(demo: Case, **traction: object) -> Case:
    """Uphill, from s = 26 m on the rails are wet: 0.1 is less than the 0.18 that the train asks for."""
    friction = {"tread": 0.4, "gauge_corner": 0.4, "flange": 0.4}
    wet = {"start_m": 26.0, "tread": 0.1, "gauge_corner": 0.1, "flange": 0.1}
    return on_slope(demo, 62.0, 6.0, friction | {"sections": [wet]}, traction=traction)


def control_rows(run):
    """Columns of the control log as arrays (samples, wheelsets)."""
    log = run.read("control")
    return {name: log[name].to_numpy().reshape(-1, 6) for name in log.column_names}


@pytest.mark.parametrize("per_mille", [-4.0, 0.0, 6.0])
def test_drives_hold_locomotive_and_train(demo, per_mille):
    """Coupler force and torques from the weight along the slope and the resistances, and nothing else."""
    case = on_slope(demo, 60.0, per_mille)
    model = assemble(LOCOMOTIVE, case)
    work = workspace(model)
    control = vehicle_control(case, LOCOMOTIVE, model, work)
    assert control is not None
    equilibrium(LOCOMOTIVE, model, work)
    sine = np.sin(np.arctan(1e-3 * per_mille))
    wagons = 8160e3 * GRAVITY * sine + 8160.0 * 1.30 * GRAVITY
    unit = 180e3 * GRAVITY * sine + 180.0 * locomotive_resistance(SPEED)
    demand = (wagons + 2 * unit) / 2
    pull = work.ledger[Ledger.COUPLER_FORCE]
    assert pull == pytest.approx(unit - demand, abs=50.0)
    # rails push with what the coupler and the slope take; losses of the drives never reach the rails
    assert work.wrench[:, 0].sum() == pytest.approx(180e3 * GRAVITY * sine - pull, abs=100.0)
    assert np.ptp(work.inputs.drive_torque) == 0.0
    assert work.inputs.drive_torque.sum() / 0.625 == pytest.approx(
        180e3 * GRAVITY * sine - pull, rel=5e-3, abs=200.0
    )
    assert -work.rail_force[:, :, 1].sum() == pytest.approx(180e3 * GRAVITY * np.sqrt(1 - sine**2), rel=1e-4)
    # about the rails: hauling lifts the leading wheelsets and loads the trailing ones, as does the slope
    loads = -work.rail_force[:, :, 1].sum(axis=1)
    places = work.arc_length[:6] - start_middle(LOCOMOTIVE)
    cosine = np.sqrt(1 - sine**2)
    x, _, z = (work.position - inclined_frame(model.alignment, start_middle(LOCOMOTIVE))[:3]).T
    along, above = x * cosine + z * sine, z * cosine - x * sine
    head = 1.06 + above[0] - LOCOMOTIVE.body("car_body").position[2]  # as far down as the body
    tilting = GRAVITY * (model.mass @ (above * sine - along * cosine)) - head * pull
    assert -(loads * places).sum() == pytest.approx(tilting, abs=1e-3 * 180e3 * GRAVITY)  # 1 mm of the weight


def test_a_unit_alone_has_no_force_on_its_coupler(demo):
    """What its drives hold is then its own weight along the slope."""
    case = on_slope(demo, 60.0, 6.0, traction={"units": 1, "trailing_wagons": 0})
    model = assemble(LOCOMOTIVE, case)
    work = workspace(model)
    assert vehicle_control(case, LOCOMOTIVE, model, work) is not None
    equilibrium(LOCOMOTIVE, model, work)
    assert work.ledger[Ledger.COUPLER_FORCE] == 0.0
    assert work.wrench[:, 0].sum() == pytest.approx(180e3 * GRAVITY * np.sin(np.arctan(0.006)), abs=20.0)


def test_it_holds_its_speed_and_energy_closes(demo, runs):
    """6 per mille, which two units can: 60 km/h within 1 %, and no work is lost on the way."""
    run = simulate(on_slope(demo, 55.0, 6.0), runs / "uphill")
    assert run.status["curve_resistance_of_train"] == "roeckl"
    rows = control_rows(run)
    assert np.abs(rows["speed"] / SPEED - 1.0).max() < 0.01
    assert np.abs(rows["demand"] / rows["demand"][0] - 1.0).max() < 0.02
    assert rows["demand"].max() < 324e3  # the characteristic
    assert np.ptp(rows["coupler_force"]) < 5e3  # no jerk at the start
    assert rows["adhesion"].mean() == pytest.approx(
        rows["torque"].mean() / 0.625 / (30e3 * GRAVITY), rel=0.01
    )
    assert rows["utilisation"] == pytest.approx(rows["adhesion"] / 0.4, abs=0.03)
    energy = table(run, "energy")
    lost = energy.contact_power + energy.friction_power + energy.damper_power
    given = np.trapezoid(energy.drive_power + energy.coupler_power - lost, energy.time)
    gained = energy.potential_energy[-1] + energy.kinetic_energy[-1] - energy.kinetic_energy[0]
    work_of_drives = np.trapezoid(energy.drive_power, energy.time)
    assert given == pytest.approx(gained, abs=5e-4 * work_of_drives)


def test_slip_control_catches_the_loss_of_adhesion(demo, runs):
    with_control = control_rows(simulate(slipping(demo), runs / "slip_control"))
    without = control_rows(simulate(slipping(demo, slip_control=False), runs / "slip"))
    slip, free = (rows["wheel_speed"] / rows["speed"] - 1.0 for rows in (with_control, without))
    assert free[-1].max() > 0.5
    assert slip.max() < 0.05
    wet = with_control["s"] > 30.0
    # what adhesion there is is used, not given away
    assert 0.07 < with_control["adhesion"][wet].mean() <= 0.1
    assert without["torque"].max() == pytest.approx(without["torque"][0].max(), rel=0.1)


@pytest.mark.slow
@pytest.mark.parametrize("percent", [4.0, 8.0])
def test_over_slip_costs_what_friction_takes(demo, runs, percent):
    """Energy per metre and wheel = friction x load x dv: thesis Figure 5-2 has 4.4 kJ/m at 0.3, 10 %."""
    case = on_slope(demo, 75.0, 0.0, 0.2, speed_km_h=30.0, traction={"over_slip_percent": percent})
    run = simulate(case, runs / f"over_slip_{percent:g}")
    rows = control_rows(run)
    late = rows["time"][:, 0] > rows["time"][-1, 0] - 1.0
    slip = rows["wheel_speed"] / rows["speed"] - 1.0
    assert slip[late].mean() == pytest.approx(1e-2 * percent, rel=0.03)
    energy = table(run, "energy")
    late = energy.time > energy.time[-1] - 1.0
    per_metre = (energy.contact_power[late] / (30 / 3.6)).mean() / 12
    assert per_metre == pytest.approx(0.2 * 15e3 * GRAVITY * 1e-2 * percent, rel=0.05)


@pytest.mark.slow
def test_steering_turns_the_wheelsets_into_the_curve(demo, runs):
    """R = 450 m: radial references lower angle of attack and wear number of the leading wheelset."""
    sections = [
        {"kind": "straight", "length_m": 30.0, **GAUGE},
        {"kind": "transition", "length_m": 50.0},
        {"kind": "curve", "length_m": 50.0, "radius_m": 450.0, "hand": "left", "cant_mm": 65.0, **GAUGE},
    ]
    base = on_slope(demo, 62.0, 0.0).with_changes(track={"sections": sections, "grades": []})
    found = {}
    for name, steering in (("passive", None), ("active", {"gain": 1.0})):
        log = simulate(base.with_changes(steering=steering), runs / f"curve_{name}").contact()
        rows = {column: log[column].to_numpy() for column in log.column_names}
        late = (rows["time"] > rows["time"].max() - 0.5) & (rows["wheelset"] == 1)
        power = (
            rows["force_x"] * rows["nu_x"] + rows["force_y"] * rows["nu_y"] + rows["moment_z"] * rows["phi"]
        )
        found[name] = np.abs(rows["angle_of_attack"][late]).mean(), np.abs(power[late]).sum()
    assert found["active"][0] < 0.8 * found["passive"][0]
    assert found["active"][1] < found["passive"][1]


def test_a_wagon_has_no_driver(demo):
    with pytest.raises(CaseError, match="traction given: vehicle iore_wagon_loaded has no drives"):
        demo.with_changes(traction={"units": 1})
    with pytest.raises(CaseError, match=r"traction\.units = 9"):
        demo.with_changes(vehicle="iore_locomotive", traction={"units": 9})
    case = demo.with_changes(vehicle="iore_locomotive", traction={"trailing_wagons": 40})
    assert Case.from_toml(case.to_toml()) == case


def axle_loads_on(demo: Case, folder, side: float, per_mille: float) -> tuple[np.ndarray, np.ndarray]:
    """Vertical loads [kN] and torques [kN m] of the axles at 40 km/h, of motors on a side of their axles."""
    file = folder / f"side_{side:g}.toml"
    file.write_text(f'base = "iore_locomotive"\nmotor.side = {side}\n')
    case = on_slope(demo, 60.0, per_mille, speed_km_h=40.0).with_changes(vehicle=str(file))
    unit = case.described_vehicle()
    model = assemble(unit, case)
    work = workspace(model)
    vehicle_control(case, unit, model, work)
    equilibrium(unit, model, work)
    return -1e-3 * work.rail_force[:, :, 1].sum(axis=1), 1e-3 * work.inputs.drive_torque


def test_axle_loads_under_traction_are_those_of_statics(demo, tmp_path):
    """At 365 kN each bogie pitches by the moment of its traction rod, and motors press by their noses.

    Loads are level to 3 % when it coasts. The reaction of a motor's torque T at its nose, the distance n from
    the axle, takes T / n off an axle with its motor behind and adds it where the motor is ahead. With all
    motors of a bogie on one side this is the same for its axles and only their pitch is left: loads are
    linear along the bogie, by the rod's force times its height. On alternating sides the middle axle loses
    T / n to its neighbours besides.
    """
    numbers = load_parameters("vehicles", "iore_locomotive")
    spacing, sine = numbers["wheelset.spacing"], 7.72e-3
    frame, motor, wheelset = (numbers[f"{part}.mass"] for part in ("bogie_frame", "motor", "wheelset"))
    weight = 1e-3 * GRAVITY * sine * (frame + 3 * (motor + wheelset))  # of a bogie, along the slope [kN]
    lever = frame * numbers["bogie_frame.height"] + 3 * (motor + wheelset) * numbers["wheelset.radius"]
    lever /= frame + 3 * (motor + wheelset)
    zigzag = {}
    for side in (1.0, -1.0, 0.0):
        coasting, idle = axle_loads_on(demo, tmp_path, side, 0.0)
        hauling, torque = axle_loads_on(demo, tmp_path, side, 7.72)
        assert torque.sum() / 0.625 == pytest.approx(365.0, abs=10.0)
        assert np.ptp(coasting) < 0.03 * coasting.mean()
        nose = (torque - idle) / numbers["motor.nose_distance"]
        for bogie in (slice(0, 3), slice(3, 6)):
            change = (hauling - coasting)[bogie]
            rod = (torque - idle)[bogie].sum() / 0.625 - weight
            pitch = -(rod * numbers["traction_rod.height"] + weight * lever) / (2 * spacing)
            assert (change[0] - change[2]) / 2 == pytest.approx(pitch, rel=0.05)
            zigzag[side, bogie.start] = (change[1] - (change[0] + change[2]) / 2) / nose[0]
    assert [zigzag[side, first] for side in (1.0, -1.0) for first in (0, 3)] == pytest.approx(
        [0.0] * 4, abs=0.01
    )
    assert [zigzag[0.0, first] for first in (0, 3)] == pytest.approx([-1.0, 1.0], abs=0.02)


def test_a_side_that_is_none_is_refused(tmp_path):
    file = tmp_path / "odd.toml"
    file.write_text('base = "iore_locomotive"\nmotor.side = 0.5\n')
    with pytest.raises(ValueError, match=r"motor\.side 0\.5 must be 1"):
        find_variant(file)
