"""A car body that bends: Exudyn's beam elements in place of a rigid body of the catalogue's coach.

    python examples/13_flexible_car_body.py [FOLDER]

The coach rests on two light bodies above its bogies, which beams connect. Where does the first bending
frequency of the body appear in the spectrum of its motion? Free-free beam: f = (4.730^2/2 pi) sqrt(EI/m L^4).
"""

import sys
import tempfile
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import exudyn
import numpy as np
from exudyn.itemInterface import NodeRigidBodyRotVecLG, ObjectBeamGeometricallyExact, SensorNode

from hh_exudyn.case import Case, IntegrationCase, StraightCase, TrackCase
from hh_exudyn.log.store import Run
from hh_exudyn.multibody.exudyn_system import ExudynSystem
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle
from vehicles.description import Vehicle

FREQUENCY, LENGTH, SHARE = 9.0, 24.0, 0.05  # Hz, m, and the share of mass that the two light bodies keep
GYRATION, DAMPING = 0.4, 1e-4  # m, of the section in bending; s, of its stiffness
PLACES = np.array([-12.0, -9.5, -6.0, -2.0, 2.0, 6.0, 9.5, 12.0])  # m, of the beams' nodes; bogies at 9.5
COACH = vehicle("manchester_vehicle_1")
BODY = COACH.body("car_body")


def in_two_halves() -> Vehicle:
    """The coach with half its body above each bogie, so that its weight stands on the springs."""
    _, y, z = BODY.position
    inertia = tuple(about / 2 for about in BODY.inertia)
    half = replace(BODY, mass=BODY.mass / 2, inertia=inertia)
    halves = {
        "1": replace(half, name="front", position=(PLACES[-2], y, z)),
        "2": replace(half, name="rear", position=(PLACES[1], y, z)),
    }
    couplings = tuple(
        replace(c, body_b=halves[c.body_a[-1]].name) if c.body_b == BODY.name else c for c in COACH.couplings
    )
    bodies = (*halves.values(), *(body for body in COACH.bodies if body.name != BODY.name))
    coupler = replace(COACH.coupler, bodies=("front", "rear"))
    return replace(COACH, name="bending_coach", bodies=bodies, couplings=couplings, coupler=coupler)


def beams(system: ExudynSystem, frequency: float = FREQUENCY) -> None:
    """Add the beams of a body with this first bending frequency [Hz]."""
    line = (1 - SHARE) * BODY.mass / LENGTH  # kg/m
    bending = BODY.mass / LENGTH * (2 * np.pi * frequency * LENGTH**2 / 4.73004**2) ** 2  # N m^2
    section = exudyn.BeamSection()
    section.massPerLength = line
    section.inertia = np.diag([1.8 * line, GYRATION**2 * line, GYRATION**2 * line])
    shear = 2e3 * bending / LENGTH**2  # so stiff that it hardly lowers the frequency
    section.stiffnessMatrix = np.diag([shear, shear, shear, bending, bending, bending])
    section.dampingMatrix = DAMPING * np.array(section.stiffnessMatrix)
    nodes = {PLACES[-2]: system.nodes["front"], PLACES[1]: system.nodes["rear"]}
    for name in ("front", "rear"):
        system.make_light(name, SHARE)
    for x in PLACES:
        if x not in nodes:
            place = [*system.place((x, *BODY.position[1:])), 0.0, 0.0, 0.0]
            nodes[x] = system.mbs.AddNode(NodeRigidBodyRotVecLG(referenceCoordinates=place))
    for rear, front in pairwise(PLACES):
        ends = [nodes[rear], nodes[front]]
        element = ObjectBeamGeometricallyExact(nodeNumbers=ends, length=front - rear, sectionData=section)
        system.mbs.AddObject(element)
    for name, x in (("middle", PLACES[3]), ("end", PLACES[0])):
        kind = exudyn.OutputVariableType.Position
        sensor = SensorNode(nodeNumber=nodes[x], storeInternal=False, outputVariableType=kind)
        system.sensors[name] = system.mbs.AddSensor(sensor)


def bending(run: Run) -> np.ndarray:
    """Height of the body's middle over its rear end [m]."""
    log = run.read("sensors")
    name, component = np.array(log["sensor"].to_pylist()), log["component"].to_numpy()
    height = {at: log["value"].to_numpy()[(name == at) & (component == 2)] for at in ("middle", "end")}
    return height["middle"] - height["end"]


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp(prefix="bending-coach-"))
    track = TrackCase(rail="60E1", irregularity="erri_high", sections=(StraightCase(length_m=230),))
    steps = IntegrationCase(step_ms=0.1, output_interval_ms=4.0)
    case = Case(name="bending", speed_km_h=100, friction=0.35, track=track, integration=steps)
    run = simulate(case, folder / "run", vehicle=in_two_halves(), extend=beams)
    signal = bending(run)
    power = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(signal.size), 8 * signal.size)) ** 2
    frequency = np.fft.rfftfreq(8 * signal.size, 4e-3)
    band = (frequency > 0.6 * FREQUENCY) & (frequency < 1.6 * FREQUENCY)
    peak = frequency[band][power[band].argmax()]
    print(f"bending of the car body: {peak:.2f} Hz; free-free beam {FREQUENCY:.2f} Hz, {run.directory}")


if __name__ == "__main__":
    main()
