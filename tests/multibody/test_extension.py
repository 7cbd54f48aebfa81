"""Exudyn items of the user's own in a vehicle: against couplings of ours, over borders, with their log."""

import re
from dataclasses import replace
from pathlib import Path

import exudyn
import numpy as np
import pytest
from exudyn.itemInterface import (
    LoadMassProportional,
    MarkerBodyMass,
    MarkerBodyPosition,
    NodePoint,
    ObjectConnectorCartesianSpringDamper,
    ObjectConnectorSpringDamper,
    ObjectMassPoint,
    SensorNode,
    SensorObject,
)
from two_axle_wagon import HALF_WHEELBASE, RADIUS, two_axle_wagon

from hh_exudyn.case import Case, CurveCase, StraightCase, TrackCase, TransitionCase, read_case
from hh_exudyn.log.store import Run
from hh_exudyn.multibody import build
from hh_exudyn.multibody.exudyn_system import ExudynSystem
from hh_exudyn.multibody.simulate import simulate
from vehicles.couplings import Rod

STIFFNESS, DAMPING = 3e5, 2e4  # N/m, N s/m
ENDS = ((HALF_WHEELBASE, 0.9, 1.2), (HALF_WHEELBASE, 0.9, RADIUS))
CURVE = CurveCase(length_m=6, radius_m=300, hand="left", cant_mm=80)
TRACK = TrackCase(sections=(StraightCase(length_m=14), TransitionCase(length_m=20), CURVE))
CASE = Case(name="extended", speed_km_h=60, friction=0.35, track=TRACK)
MASS, HANGER, PLACE = 400.0, 3e5, (0.0, 0.0, 0.8)  # kg, N/m, m


def rod(system: ExudynSystem) -> None:
    markers = [system.marker("body", ENDS[0]), system.marker("front", ENDS[1])]
    spring = ObjectConnectorSpringDamper(
        markerNumbers=markers, referenceLength=ENDS[0][2] - RADIUS, stiffness=STIFFNESS, damping=DAMPING
    )
    number = system.mbs.AddObject(spring)
    force = SensorObject(
        objectNumber=number, storeInternal=False, outputVariableType=exudyn.OutputVariableType.Force
    )
    system.sensors["rod"] = system.mbs.AddSensor(force)


def pendulum(system: ExudynSystem) -> None:
    """A mass that hangs under the body by springs, on a node of its own."""
    node = system.mbs.AddNode(NodePoint(referenceCoordinates=list(system.place(PLACE))))
    body = system.mbs.AddObject(ObjectMassPoint(mass=MASS, nodeNumber=node))
    weight = LoadMassProportional(
        markerNumber=system.mbs.AddMarker(MarkerBodyMass(bodyNumber=body)), loadVector=[0.0, 0.0, -9.81]
    )
    system.mbs.AddLoad(weight)
    markers = [system.marker("body", PLACE), system.mbs.AddMarker(MarkerBodyPosition(bodyNumber=body))]
    hanger = ObjectConnectorCartesianSpringDamper(
        markerNumbers=markers, stiffness=[HANGER] * 3, damping=[2e3] * 3
    )
    number = system.mbs.AddObject(hanger)
    for name, sensor in (
        ("force", SensorObject(objectNumber=number, outputVariableType=exudyn.OutputVariableType.Force)),
        ("speed", SensorNode(nodeNumber=node, outputVariableType=exudyn.OutputVariableType.Velocity)),
    ):
        sensor.storeInternal = False
        system.sensors[name] = system.mbs.AddSensor(sensor)


def component(run: Run, sensor: str, number: int) -> np.ndarray:
    log = run.read("sensors")
    wanted = np.array(log["sensor"].to_pylist()) == sensor
    return log["value"].to_numpy()[wanted & (log["component"].to_numpy() == number)]


@pytest.fixture(scope="module")
def extended(tmp_path_factory: pytest.TempPathFactory) -> Run:
    return simulate(CASE, tmp_path_factory.mktemp("rod") / "run", vehicle=two_axle_wagon(), extend=rod)


def test_a_connector_is_a_rod(extended: Run, tmp_path: Path) -> None:
    """The same spring and damper as Exudyn's connector and as a coupling of the description."""
    wagon = two_axle_wagon()
    own = Rod("rod", "body", "front", *ENDS, STIFFNESS, DAMPING)
    run = simulate(CASE, tmp_path / "run", vehicle=replace(wagon, couplings=(*wagon.couplings, own)))
    for column, tolerance in (("y", 1e-4), ("z", 2e-5), ("vy", 1e-3), ("wx", 1e-3)):  # from starts 5 N apart
        ours, theirs = (each.motion()[column].to_numpy() for each in (run, extended))
        assert np.abs(ours).max() > 10 * tolerance
        np.testing.assert_allclose(theirs, ours, rtol=0.0, atol=tolerance, err_msg=column)
    assert component(extended, "rod", 2).size == extended.read("energy").num_rows


def test_what_hangs_on_the_vehicle_is_at_rest_and_rolls_along(tmp_path: Path) -> None:
    """Its springs carry its weight at the start, and it has the speed of the train."""
    straight = CASE.with_changes(track={"sections": [{"kind": "straight", "length_m": 30.0}]})
    run = simulate(straight, tmp_path / "run", vehicle=two_axle_wagon(), extend=pendulum)
    vertical = component(run, "force", 2)
    assert abs(vertical[0]) == pytest.approx(MASS * 9.81, abs=1.0)
    assert np.abs(vertical - vertical[0]).max() < 5.0  # N, over the whole run
    np.testing.assert_allclose(component(run, "speed", 0), 60 / 3.6, atol=1e-3)
    weight = (two_axle_wagon().mass + MASS) * 9.81
    first = run.contact()["Q"].to_numpy()[:4]
    assert first.sum() == pytest.approx(weight, rel=1e-4)


def test_an_extension_of_nothing_changes_nothing(tmp_path: Path) -> None:
    """With all friction elements of the ore wagon: settled again in time, it starts and rolls as it did."""
    straight = CASE.with_changes(track={"sections": [{"kind": "straight", "length_m": 32.0}]})
    plain = simulate(straight, tmp_path / "plain")
    again = simulate(straight, tmp_path / "again", extend=lambda system: None)
    for column, tolerance in (("y", 2e-4), ("z", 2e-5), ("vz", 1e-3)):
        ours, theirs = (each.motion()[column].to_numpy() for each in (plain, again))
        np.testing.assert_allclose(theirs, ours, rtol=0.0, atol=tolerance, err_msg=column)
    before, after = (run.read("energy")["friction_power"].to_numpy() for run in (plain, again))
    assert np.abs(after).max() < 1.0 + 2.0 * np.abs(before).max()  # W


def test_borders_leave_no_trace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The state of the user's own nodes goes from segment to segment."""
    runs = []
    for name, segment in (("whole", 100.0), ("parts", 0.1)):
        monkeypatch.setattr("hh_exudyn.multibody.integration.SEGMENT", segment)
        runs.append(simulate(CASE, tmp_path / name, vehicle=two_axle_wagon(), extend=pendulum))
    for sensor, tolerance in (("force", 1e-3), ("speed", 1e-6)):
        for number in range(3):
            whole, parts = (component(run, sensor, number) for run in runs)
            np.testing.assert_allclose(parts, whole, atol=tolerance)


def test_the_case_of_an_extended_run_does_not_run_without(extended: Run, tmp_path: Path) -> None:
    case = read_case(extended.directory / "case.toml")
    assert case.extension is not None
    assert re.fullmatch(r".*test_extension\.rod [0-9a-f]{16}", case.extension)
    with pytest.raises(ValueError, match=r"Exudyn items added by .*test_extension\.rod"):
        simulate(case, tmp_path / "run")
    assert list(tmp_path.iterdir()) == []


def test_the_built_system_can_be_solved() -> None:
    """Items added to it by hand, then solved to the end of the track: it rolls by the speed's distance."""
    short = CASE.with_changes(track={"sections": [{"kind": "straight", "length_m": 30.0}]})
    system = build(short, vehicle=two_axle_wagon())
    rod(system)
    system.solve()
    end = system.mbs.GetNodeOutput(system.nodes["body"], exudyn.OutputVariableType.Position)
    began = system.place((0.0, 0.0, 1.6))
    assert end[0] - began[0] == pytest.approx(30.0 - 11.0, abs=0.05)


def test_an_extension_that_changes_is_refused(tmp_path: Path) -> None:
    calls = []

    def fickle(system: ExudynSystem) -> None:
        calls.append(system)
        if len(calls) > 1:
            pendulum(system)

    with pytest.raises(ValueError, match="must add the same ones each time"):
        simulate(CASE, tmp_path / "run", vehicle=two_axle_wagon(), extend=fickle)


def test_bad_names_and_shares() -> None:
    system = build(CASE, vehicle=two_axle_wagon())
    with pytest.raises(ValueError, match="'roof': the vehicle has body, front, rear"):
        system.marker("roof", (0.0, 0.0, 3.0))
    with pytest.raises(ValueError, match="share = 0"):
        system.make_light("body", 0.0)
