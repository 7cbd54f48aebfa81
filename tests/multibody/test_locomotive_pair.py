"""Both units of the locomotive in one run: single ones at rest, one in effort, mirror images in curves."""

import dataclasses

import numpy as np
import pytest
from run_tables import table
from track_sections import into_left_curve

from hh_exudyn.case import Case, CaseError
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.control import vehicle_control
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import Ledger, workspace
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle
from vehicles.couplings import AxleBoxPad, Bushing, Rod

SINGLE, PAIR = vehicle("iore_locomotive"), vehicle("iore_locomotive_pair")
SPEED = 60 / 3.6


def on_slope(demo: Case, name: str, per_mille: float, length: float = 70.0, **changes: object) -> Case:
    """Rigid straight track of one gradient."""
    track = {
        "flexibility": "rigid",
        "sections": [{"kind": "straight", "length_m": length, "gauge_mm": 1440.0}],
        "grades": [{"length_m": length, "gradient_per_mille": per_mille}],
    }
    return demo.with_changes(vehicle=name, track=track, contact={"cells": [16, 8]}, **changes)


def at_rest(case: Case):
    """Model and work space of the vehicle in its equilibrium, driven."""
    described = case.described_vehicle()
    model = assemble(described, case)
    work = workspace(model)
    assert vehicle_control(case, described, model, work) is not None
    equilibrium(described, model, work)
    return model, work


def between(model, work) -> float:
    """Pull of the coupler between the units, positive in draft [N]."""
    number = next(i for i, coupling in enumerate(PAIR.couplings) if coupling.name == "unit_coupler")
    rod = PAIR.couplings[number]
    assert isinstance(rod, Rod)
    ends = [
        work.position[body] + work.rotation[body] @ arm
        for body, arm in (
            (model.couplings.body_a[number], model.couplings.point_a[number]),
            (model.couplings.body_b[number], model.couplings.point_b[number]),
        )
    ]
    return rod.stiffness * (float(np.linalg.norm(ends[1] - ends[0])) - rod.length)


def test_the_pair_is_two_units_and_a_coupler():
    assert PAIR.mass == pytest.approx(2 * SINGLE.mass)
    assert np.ptp([point[0] for point in PAIR.coupler.points]) == pytest.approx(2 * 22.89)
    assert PAIR.wheelset_places == tuple(
        (unit, bogie, 3 * (bogie - 1) + axle) for unit in (1, 2) for bogie in (1, 2) for axle in (1, 2, 3)
    )
    assert [PAIR.unit_of(w.body) for w in PAIR.wheelsets] == [w.unit for w in PAIR.wheelsets]
    assert len(PAIR.drives) == 12
    # mirror images of each other, and each unit a copy of the single one
    elastic = [(c.stiffness[2], *c.point) for c in PAIR.couplings if isinstance(c, AxleBoxPad | Bushing)]
    for points in ([(b.mass, *b.position) for b in PAIR.bodies], elastic):
        mirrored = [(mass, 0.0 - x, y, z) for mass, x, y, z in points]
        assert np.array(sorted(points)) == pytest.approx(np.array(sorted(mirrored)), abs=1e-9)
    own = [dataclasses.replace(b, name="", position=(b.position[0] - 11.445, *b.position[1:])) for b in
           PAIR.bodies[: len(SINGLE.bodies)]]  # fmt: skip
    for copy, body in zip(own, SINGLE.bodies, strict=True):
        assert dataclasses.replace(copy, position=body.position) == dataclasses.replace(body, name="")
        assert copy.position == pytest.approx(body.position, abs=1e-12)


def test_each_unit_stands_as_a_single_one(demo):
    alone = at_rest(on_slope(demo, SINGLE.name, 0.0, traction={"units": 1, "trailing_wagons": 0}))[1]
    both = at_rest(on_slope(demo, PAIR.name, 0.0, traction={"units": 2, "trailing_wagons": 0}))
    loads = -both[1].rail_force[:, :, 1]
    assert loads == pytest.approx(np.vstack(2 * [-alone.rail_force[:, :, 1]]), abs=2.0)
    assert loads.sum() == pytest.approx(2 * 180e3 * GRAVITY, rel=1e-6)
    assert both[1].ledger[Ledger.COUPLER_FORCE] == 0.0
    assert between(*both) == pytest.approx(0.0, abs=20.0)


def test_the_coupler_between_carries_half_of_what_the_train_gets(demo):
    """Both units haul 6 per mille with equal efforts: what the first has left goes through the coupler."""
    model, work = at_rest(on_slope(demo, PAIR.name, 6.0))
    pull = -work.ledger[Ledger.COUPLER_FORCE]
    assert pull > 500e3
    assert between(model, work) == pytest.approx(pull / 2, rel=1e-3)
    assert np.ptp(work.inputs.drive_torque) == 0.0
    # the driver asks each unit for what it asks of one with the other as a mass of the train
    single = at_rest(on_slope(demo, SINGLE.name, 6.0))[1]
    assert work.inputs.drive_torque[0] == pytest.approx(single.inputs.drive_torque[0], rel=1e-3)
    assert -single.ledger[Ledger.COUPLER_FORCE] == pytest.approx(pull / 2, rel=1e-3)
    # wheel loads of both units shift alike, by their own couplers' moments
    weight = work.rail_force[:, :, 1].sum()
    assert -weight == pytest.approx(2 * 180e3 * GRAVITY * np.cos(np.arctan(0.006)), rel=1e-4)


def test_it_hauls_its_train_and_energy_closes(demo, runs):
    case = on_slope(demo, PAIR.name, 6.0, 90.0)
    run = simulate(case.with_changes(integration={"logged_couplings": ["unit_coupler"]}), runs / "pair")
    control = run.read("control")
    rows = {name: control[name].to_numpy().reshape(-1, 12) for name in control.column_names}
    assert rows["vehicle"][0].tolist() == 6 * [1] + 6 * [2]
    assert rows["wheelset"][0].tolist() == 2 * list(range(1, 7))
    assert np.abs(rows["speed"] / SPEED - 1.0).max() < 0.01
    assert np.ptp(rows["coupler_force"]) < 10e3  # no jerk at the start
    coupling = table(run, "couplings")
    inner = np.abs(coupling.force_x)
    assert inner.mean() == pytest.approx(-rows["coupler_force"].mean() / 2, rel=0.02)
    energy = table(run, "energy")
    lost = energy.contact_power + energy.friction_power + energy.damper_power
    given = np.trapezoid(energy.drive_power + energy.coupler_power - lost, energy.time)
    gained = energy.potential_energy[-1] + energy.kinetic_energy[-1] - energy.kinetic_energy[0]
    assert given == pytest.approx(gained, abs=5e-4 * np.trapezoid(energy.drive_power, energy.time))


@pytest.mark.slow
def test_slip_control_sees_twelve_wheelsets(demo, runs):
    """Rails turn wet under the pair: each wheelset is caught when it comes there, those behind still grip."""
    friction = {"tread": 0.4, "gauge_corner": 0.4, "flange": 0.4}
    wet = {"start_m": 56.0, "tread": 0.1, "gauge_corner": 0.1, "flange": 0.1}
    case = on_slope(demo, PAIR.name, 6.0, 95.0, friction=friction | {"sections": [wet]})
    control = simulate(case, runs / "wet").read("control")
    rows = {name: control[name].to_numpy().reshape(-1, 12) for name in control.column_names}
    slip = rows["wheel_speed"] / rows["speed"] - 1.0
    assert slip.max() < 0.05
    on_wet = rows["s"] > 60.0
    assert 0.07 < rows["adhesion"][on_wet].mean() <= 0.1
    torque = rows["torque"]
    half_way = int(np.argmax(on_wet[:, 5]))  # the first unit is on wet rails, the second one is not
    assert not on_wet[half_way, 6:].any()
    assert torque[half_way, 6:] == pytest.approx(torque[0, 6:], rel=0.2)
    assert torque[half_way, :5].max() < 0.8 * torque[0, 0]


@pytest.mark.slow
def test_a_right_hand_curve_is_the_mirror_of_a_left_hand_one(demo, runs):
    found = {}
    for hand in ("left", "right"):
        sections = [section | ({"hand": hand} if "hand" in section else {}) for section in
                    into_left_curve((50.0, 30.0, 40.0), 450.0, 1440.0)]  # fmt: skip
        track = {"flexibility": "rigid", "sections": sections}
        case = demo.with_changes(vehicle=PAIR.name, track=track, contact={"cells": [16, 8]})
        found[hand] = table(simulate(case, runs / f"pair_{hand}"), "wheels")
    left, right = found["left"], found["right"]
    swap = np.arange(left.Q.size).reshape(-1, 2)[:, ::-1].ravel()  # the other wheel of the same wheelset
    assert right.Q[swap] == pytest.approx(left.Q, abs=1.0)
    assert right.Y[swap] == pytest.approx(left.Y, abs=1.0)
    assert -right.y_wheelset == pytest.approx(left.y_wheelset, abs=1e-7)


def test_fewer_units_than_the_vehicle_has_are_refused(demo):
    with pytest.raises(CaseError, match=r"traction\.units = 1: vehicle iore_locomotive_pair has 2 units"):
        on_slope(demo, PAIR.name, 0.0, traction={"units": 1})
